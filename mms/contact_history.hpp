#pragma once

#include "core/problem.hpp"
#include "mms/derivation.hpp"
#include "mms/expression/tape.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace tvbeam {

/// Where functions of t, some rows of the tape of a phase at x = 1, are looked at: at 257 times of
/// equal distance, and where one of them goes beyond what it is at these, as a narrow peak does.
Eigen::ArrayXd telling_times(const Tape& tape, const std::vector<Eigen::Index>& rows, double begin,
                             double end);

/// No higher power is looked for at an onset.
inline constexpr int highest_power = 6;

/// A time at which an exact solution begins to press on a stop.
struct ContactOnset {
    double t = 0.0;
    /// m: the tip comes up like (t_onset − t)^m; none: flatter than highest_power
    std::optional<double> approach;
    /// k ≥ 0: the force begins like (t − t_onset)^k, with k = 0 by a jump; none: as above
    std::optional<double> force;
};

/// What an exact solution does at rigid stops on [0, final_time].
struct ContactHistory {
    std::vector<ContactOnset> onsets;    ///< those after t = 0
    std::optional<double> pressed_until; ///< the end of the last phase with a force; none: no force
    /// The first time at which the tip is on a stop without a force while none begins or ends.
    std::optional<double> touch;
    std::optional<double> rests_until; ///< where it stays there from then on, in all of its phase
    /// About where the tip first comes to a stop, or leaves it, within a phase that has a force:
    /// no onset tells of that contact.
    std::optional<double> within;
};

/// Looked at at telling_times, and between them where the tip is nearest to a stop; what is 1e-9 of
/// the greatest size of u(1,t), or of σ̃(1,t), counts as nothing. Throws AlgebraError where a
/// derivative in time cannot be made.
ContactHistory contact_history(const DerivedSolution& solution, const Stops& stops,
                               double final_time);

/// The stops that the tip is on, or beyond, at some time.
struct ReachedStops {
    bool lower = false;
    bool upper = false;
};

/// Looked for as contact_history does, so that both find the same touches; the stops may be
/// penalised.
ReachedStops reached_stops(const DerivedSolution& solution, const Stops& stops, double final_time);

} // namespace tvbeam

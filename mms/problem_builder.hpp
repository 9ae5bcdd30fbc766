#pragma once

#include "core/joint_functions.hpp"
#include "core/problem.hpp"
#include "mms/separation.hpp"

#include <ginac/ginac.h>

#include <memory>
#include <optional>
#include <vector>

namespace tvbeam {

/// An interval of time in which a function has one formula.
struct TimePhase {
    double begin;
    double end; ///< infinite in the last phase
};

/// φ over a power of two, where its greatest value on the beam is beyond 2^±100: no double holds
/// the square of (43*x + 7)^103, a term of a sum that its amplitude divides by 50^103.
struct ScaledProfile {
    SpaceFunction function;  ///< φ/size; none if that is not finite
    GiNaC::numeric size = 1; ///< goes to the amplitude
};

ScaledProfile scaled_profile(const GiNaC::ex& profile);

/// Turns symbolic functions of x and t, one formula a phase, into the profiles, amplitudes and
/// fields of a ProblemData. Equal profiles and equal amplitudes of all fields become one.
class ProblemBuilder {
public:
    /// The phases follow each other from 0 on; a time that ends one phase and begins the next
    /// belongs to the former.
    ProblemBuilder(std::vector<TimePhase> phases, double final_time);

    /// A function of x and t. A product whose profile or amplitude overflows by itself where the
    /// whole does not, as in exp(1000*(x-t)), goes to the rest. Throws AlgebraError if a constant
    /// is beyond the range of a double.
    Field field(const std::vector<GiNaC::ex>& formulas);

    /// A function of t. None: it is zero.
    std::optional<Eigen::Index> amplitude(const std::vector<GiNaC::ex>& formulas);

    /// A profile that is no symbolic expression, with its amplitude: a term for a field.
    Field::Term term(const std::vector<GiNaC::ex>& amplitude, SpaceFunction profile);

    /// One function a phase, empty ones zero, as one; empty if all are.
    [[nodiscard]] SpaceTimeFunction in_phases(std::vector<SpaceTimeFunction> functions) const;

    /// Puts the profiles and amplitudes into the problem; the last call.
    void finish(ProblemData& problem) const;

private:
    /// A profile is symbolic, or else only a function.
    struct Profile {
        GiNaC::ex formula;
        ScaledProfile scaled;
        std::optional<Eigen::Index> index{}; ///< in the problem, if a term has it
    };

    /// What of a field does not separate, by phase, as a member of the family of all of them.
    SpaceTimeFunction rest(const std::vector<GiNaC::ex>& formulas);
    Profile& known_profile(const GiNaC::ex& formula);
    Eigen::Index index_of(Profile& profile);
    /// The products of a formula in its phase; none, and all of it the rest, where one overflows.
    Separation finite_separation(const GiNaC::ex& formula, const TimePhase& phase);
    Eigen::Index amplitude_index(const std::vector<GiNaC::ex>& formulas);
    [[nodiscard]] bool is_finite(const GiNaC::ex& amplitude, const TimePhase& phase) const;

    std::vector<TimePhase> phases_;
    double final_time_;
    std::vector<Profile> profiles_;
    Eigen::Index profile_count_ = 0;                 ///< of those with an index
    std::vector<std::vector<GiNaC::ex>> amplitudes_; ///< for each amplitude one formula a phase
    std::vector<std::vector<GiNaC::ex>> rests_;      ///< likewise for each rest
    std::shared_ptr<FunctionFamily> family_ = std::make_shared<FunctionFamily>(); ///< of the rests
};

} // namespace tvbeam

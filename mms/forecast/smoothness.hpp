#pragma once

#include "core/problem.hpp"
#include "mms/derivation.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A time at which a solution passes from one formula to the next, or at which the rates of one
/// jump, and by how much what the schemes difference jumps there: θ̃_t and u_xxt, or where ζ = 0
/// θ̃_t − α u_xxt alone, for θ̃_t. A jump that is 1e-9 of the largest size of what jumps is none.
struct Switch {
    enum class Where {
        phase_end,
        within_phase, ///< one of rough_times
        at_a_place    ///< within a phase, as far as is known for some x alone
    };
    double t = 0.0;
    double theta_t_jump = 0.0; ///< largest over x
    double u_xxt_jump = 0.0;   ///< largest over x
    Where where = Where::phase_end;
};

/// An end of a phase, the final time, or one of rough_times, to which a rate as in Switch goes with
/// an infinite slope: like s^β, with s the time to it and 0 < β < 1; infinite: it does not. The
/// less of both sides.
struct Cusp {
    double t = 0.0;
    bool is_within_phase = false;
    double theta_t_power = std::numeric_limits<double>::infinity();
    double u_xxt_power = std::numeric_limits<double>::infinity();
};

/// A place at which a derivative of u jumps in x within a phase, at one of the times looked at.
struct Kink {
    enum class Of {
        u_xx,
        u_xxt, ///< and u_xxx: the place moves
        u_xxx  ///< alone
    };
    Of of = Of::u_xx;
    double x = 0.0;
    double t = 0.0;
};

/// An end of the beam at which u_xxx has a value and a slope that is not square-integrable: it goes
/// there like s^β, with s the distance and 0 < β ≤ 1/2: of s^(β − 1) the square is not integrable,
/// at the limit by a logarithm.
struct RoughEnd {
    static constexpr double highest_power = 0.5;
    double x = 0.0;
    double power = 0.0; ///< β, the least of all times looked at
};

/// "u_xx jumps at x = 0.3"; of a place that moves the time, too.
std::string words_of(const Kink& kink);

/// "u_xxx goes to its value at x = 0 like s^0.1".
std::string words_of(const RoughEnd& end);

/// The phases that begin before the final time.
std::size_t phases_until(const DerivedSolution& derived, double final_time);

/// Where phases end, and where rates jump within one, up to the final time: at its rough_times, or
/// else where the jump is largest.
std::vector<Switch> find_switches(const DerivedSolution& derived, const Beam& beam,
                                  double final_time);

/// The largest jump of θ̃_tt or u_xxtt within the first phase, where a formula has one.
std::optional<double> find_second_rate_jump(const DerivedSolution& derived, double final_time);

std::vector<Cusp> find_cusps(const DerivedSolution& derived, const Beam& beam, double final_time);

/// A jump within a phase, where a formula has one: sqrt((x - a)^2).
std::optional<Kink> find_kink(const DerivedSolution& derived, double final_time);

/// The rougher of both ends, if one is.
std::optional<RoughEnd> find_rough_end(const DerivedSolution& derived, double final_time);

} // namespace tvbeam

#pragma once

#include "mms/admissible/admissibility.hpp"
#include "mms/contact_history.hpp"
#include "mms/forecast/smoothness.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// ζ over T. With less, steps may be longer than ζ, and a scheme behaves as without viscosity. So
/// of the time 3ζε in which a penalised stop answers: with less it behaves as a rigid one.
inline constexpr double least_viscosity = 0.01;

/// The order of one error, as far as theory says it.
struct Forecast {
    enum class Kind {
        no_error, ///< there is no error of this kind
        between,  ///< least ≤ order ≤ greatest
        unknown   ///< there may be an error, of an order that is not known
    };
    Kind kind = Kind::no_error;
    double least = 0.0;
    double greatest = 0.0;
    /// In dt: no error where each switch is at a time level.
    bool none_at_levels = false;

    [[nodiscard]] bool has_error() const { return kind != Kind::no_error; }
    [[nodiscard]] bool is_known() const { return kind == Kind::between; }
};

/// Of the square.
Forecast doubled(const Forecast& order);

/// Of one error or the other.
Forecast either(const Forecast& a, const Forecast& b);

/// "2", "1 to 2", "-" where there is no error, or "not known".
std::string words_of(const Forecast& forecast);

/// The forecast that these words say; none where they are no such words.
std::optional<Forecast> forecast_of(const std::string& words);

/// The orders that a norm's error shows once the asymptotic range is reached.
struct ExpectedOrder {
    std::string norm;
    Forecast in_h;
    Forecast euler, bdf2, sdirk2; ///< in dt

    /// By the name of the time scheme.
    [[nodiscard]] const Forecast& in_dt(const std::string& scheme) const {
        return scheme == "euler" ? euler : scheme == "bdf2" ? bdf2 : sdirk2;
    }
};

/// What is to be expected of a solution on a beam before it is run.
struct ExpectedOrders {
    bool theta_is_exact = false; ///< θ̃ is linear in x: the linear elements hold it
    bool u_is_exact = false;     ///< u is cubic in x: the C¹ cubics hold it
    bool theta_has_time_error = true;
    bool u_has_time_error = true;
    /// In t between its switches, with what is coupled to it: Euler and SDIRK2 are exact for that
    /// if those are time levels.
    bool theta_is_linear_in_pieces = false;
    bool u_is_linear_in_pieces = false;
    bool tip_is_linear = false;     ///< u(1,t), in t, in every phase
    bool tip_has_time_error = true; ///< in u(1,t), which without coupling answers to itself alone
    /// Of degree 2 at most in t, so that BDF2 has no error but that of its first step: both
    /// fields, where they are coupled; else each by itself.
    bool theta_is_quadratic = false;
    bool u_is_quadratic = false;
    [[nodiscard]] bool is_quadratic() const {
        return (theta_is_quadratic || !theta_has_time_error) &&
               (u_is_quadratic || !u_has_time_error) && (theta_is_quadratic || u_is_quadratic);
    }
    /// Without viscosity, or with little in steps longer than ζ, a stage's defect α Δt² u_xxtt
    /// enters the heat equation at an end, where Θ cannot follow it.
    bool stages_miss_ends = false;
    /// With little viscosity, in steps longer than ζ, and u_xx not linear in t: the stages of
    /// SDIRK2 leave ζΔt u_xxtt in u_xx; u_xxtt at t = 0 is what the first step of BDF2 leaves.
    bool stages_lag = false;
    bool first_step_lags = false;
    std::vector<Switch> switches; ///< those before final_time
    std::vector<Cusp> cusps;      ///< up to final_time
    std::optional<Kink> kink;
    std::optional<RoughEnd> rough_end;
    ContactHistory contact;    ///< at rigid stops; at penalised ones touch alone
    double law_distance = 0.0; ///< ExactSolution::law_distance
    bool is_in_stops = false;  ///< penalised stops: the tip passes one
    /// Of those: it is on one at t = 0 and goes on within it: the first step is made with a force.
    bool starts_in_stops = false;
    /// Of those, where steps may be longer than they take to answer: it comes to one from outside.
    bool enters_stiff_stops = false;
    /// Of those, too: the first time at which u_xxt jumps while it is on one.
    std::optional<double> jump_in_stiff_stops;
    std::vector<ExpectedOrder> orders;
    std::vector<std::string> reasons; ///< in sentences, why an order is not 2 in h, 1 or 2 in dt
};

/// Orders by theory, for a solution that is smooth within its phases:
///
/// - in h: 2 for θ̃ in L² and for u in H² (u_xx is projected on P1disc), 1 for θ̃ in H¹. The coupling
///   brings the error of α θ̃ into u_xx, so that u has 2 in every norm; with α = 0, or a linear θ̃,
///   it has 3 in H¹ and 4 in L². A linear θ̃ has no error in h, and neither has a cubic u if α = 0
///   or θ̃ is linear, too: what is left is a part of the time error that changes with h. Where u_xx,
///   or u_xxx alone, jumps within an element, u has 1/2, or 3/2, in H², one more in H¹ and two more
///   in L² at most. Where u_xxx goes to its value at an end of the beam like s^β, β < 1/2, u_xxxx
///   is not square-integrable, and u has 3/2 + β to 2 in H²; with β = 1/2 the error is of
///   h² √ln(1/h).
/// - in dt: that of the scheme; none where what is differenced is linear in time, for every scheme
///   is exact then: θ̃ and u_xx in the heat equation, where α = 0 θ̃ alone; in the beam equation
///   u_xx, and where ζ = 0 nothing. The coupling passes the errors on. Where θ̃_t or u_xxt jumps at
///   the part s of a step (with ζ = 0, θ̃_t − α u_xxt), at the end of a phase or within one, the
///   defect is of order 1: for BDF2, which looks one step behind, the sum
///   over the steps is (s − 1/2)Δt times the jump; SDIRK2 has none at a level, and neither it nor
///   Euler's scheme any error if all is linear on both sides. What of the jump is along 1 − x a
///   stop may take away. So the order is 1 to 2. Where one goes to its value like s^β, β < 1, the
///   defect of the steps beside it is of order β, over a time Δt: 1 + β to 2. Where what is
///   differenced is quadratic in time BDF2 is exact but for its first step, of SDIRK2, whose error
///   O(Δt³) stays: 3. Without viscosity u_xx answers to the load at once, and the stages of SDIRK2,
///   which are of order 1, leave Δt² u_xxtt in the heat equation: where that is not zero at an end,
///   its part in the mode k is 1/k, of modes up to Δt^(-1/2). So SDIRK2 has 7/4 to 2 in the norm of
///   θ̃_x, and 2 in the others; its single step in BDF2 leaves 9/4 to 3. With little viscosity, in
///   steps longer than ζ, the same stages leave ζΔt u_xxtt in u_xx, and by the coupling in θ̃: 1 to
///   2; the first step of BDF2 leaves it over a time Δt: 1 up to 3 in maxima over time, from 3/2 in
///   L² over time (Prothero and Robinson 1974: a stiff equation shows the order of the stages).
/// - of the stress without coupling: (1 − x, ·) of the beam equation has u(1,t) and its rate alone.
///   A tip that has been held from t = 0 on, or that is linear in t by one formula, has no time
///   error, and neither has σ.
/// - of the stress at rigid stops: as long as the tip is pressed and has been from t = 0 on, the
///   order p of u. When a contact begins, the computed tip has an error e = O(Δt^p) and comes to
///   the stop too early or too late by τ. Too early: the gap ~ τ^m is e, and the stop takes away a
///   velocity that is still ~ τ^(m−1). Too late: the missing force pushes the tip on by e, ∫ τ^k ~
///   e. Either way λ is wrong by ~ τ^j over a time τ = Δt^(p/(j+1)), with j = m − 1 or j = k, and
///   if that is less than a step by ~ e/Δt over one step. In L² over time that is the order
///
///       max(p − 1/2, p (2j + 1)/(2j + 2)),
///
///   and between its values for both j, as the sign of e decides. In h likewise with p = 2 and no
///   step to end it. Without viscosity the tip answers to the force at once: p. A tip that touches
///   a stop without a force leaves the order open; one that touches none has no error. Which of the
///   two the maximum is, the sizes of e and of the force decide as long as steps are not small: it
///   is p − 1/2 at least. What jumps when a tip leaves the stop makes it stick where the sign of e
///   is such: p, too.
/// - of the stress at penalised stops: that of u, as it is a Lipschitz function of u(1,t), once Δt
///   is below 3ζε; with greater steps as at rigid stops: p − 1/2 at least where the tip comes from
///   outside. A jump of its velocity on a stop leaves λ wrong by ~ 1 in one step, 1/2 in L² over
///   time, and u by ε times that, 0 in maxima over time. But for SDIRK2 where the tip moves within
///   a stop, other than linearly in t: its stages are of order 1, which the stiff stop lets
///   through, and it has 1 to 2. So has the first step of BDF2, which SDIRK2 makes, where the tip
///   is on a stop at t = 0: an error of order 1 over a time Δt, for 1 up to 3 in maxima over time,
///   and from 3/2 in L² over time, as below 3ζε it falls with the third power of Δt. The errors of
///   a solution of rigid stops stall, in an unknown way, at the distance of the two laws; without
///   coupling those of θ̃ do not.
///
/// Throws InputError where a derivative is too large.
ExpectedOrders expected_orders(const AdmissibleSolution& solution);

/// The errors that stall where a solution of rigid stops meets penalised ones.
inline const char* stalling_errors(const Beam& beam) {
    return beam.alpha == 0.0 ? "errors of u and sigma" : "errors";
}

} // namespace tvbeam

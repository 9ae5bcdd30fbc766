#pragma once

#include "core/problem.hpp"
#include "mms/solution.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A time at which a solution passes from one formula to the next, and by how much what the schemes
/// difference or measure jumps there.
struct Switch {
    double t = 0.0;
    double theta_t_jump = 0.0; ///< largest over x
    double u_xxt_jump = 0.0;   ///< largest over x
    double stress_jump = 0.0;
};

/// The orders that a norm's error shows once the asymptotic range is reached.
struct ExpectedOrder {
    std::string norm;
    std::optional<double> in_h;  ///< none: the spaces hold the solution, no error in h is there
    std::optional<double> euler; ///< in dt; none: no scheme has a time error
    std::optional<double> of_second_order; ///< in dt, by BDF2 and SDIRK2; none: the same
};

/// What is to be expected of a solution on a beam before it is run.
struct ExpectedOrders {
    bool theta_is_exact = false; ///< θ̃ is linear in x: the linear elements hold it
    bool u_is_exact = false;     ///< u is cubic in x: the C¹ cubics hold it
    bool theta_has_time_error = true;
    bool u_has_time_error = true;
    std::vector<Switch> switches; ///< those before final_time
    std::vector<ExpectedOrder> orders;
    std::vector<std::string> reasons; ///< in sentences, why an order is not 2 in h, 1 or 2 in dt
};

/// Orders by theory, for a solution that is smooth within its phases:
///
/// - in h: 2 for θ̃ in L² and for u in H² (u_xx is projected on P1disc), 1 for θ̃ in H¹. The coupling
///   brings the error of α θ̃ into u_xx, so that u has 2 in every norm; with α = 0 it has 3 in H¹
///   and 4 in L². A linear θ̃ has no error in h, and neither has a cubic u if α = 0 or θ̃ is linear,
///   too: what is left is a part of the time error that changes with h.
/// - in dt: that of the scheme; none where what is differenced is linear in time, for every scheme
///   is exact then: θ̃ and u_xx in the heat equation, where α = 0 θ̃ alone; in the beam equation
///   u_xx, and where ζ = 0 nothing. The coupling passes the errors on. Where θ̃_t or u_xxt jumps
///   within a step, and for BDF2 also one step behind, the error of that step is of order 1; where
///   the contact stress jumps, its norm has the order 1/2.
ExpectedOrders expected_orders(const Solution& solution, const Beam& beam, double final_time);

} // namespace tvbeam

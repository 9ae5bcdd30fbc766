#pragma once

#include "core/space/thermal_mass.hpp"
#include "mms/admissible/admissibility.hpp"
#include "mms/forecast/expected_orders.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// constant · width^order, the leading term of an error in one width when the other is zero.
struct LeadingTerm {
    double order = 0.0;
    double constant = 0.0;
    /// Of a maximum over time, what it is the maximum of, from 0 on in times of equal distance;
    /// else empty.
    std::vector<double> over_time = {};
    double time_step = 0.0;

    /// The part of the constant that levels n·step after 0 see: less than 1 where the maximum
    /// stands between them, as before the first. 1 of what is no maximum.
    [[nodiscard]] double seen_by(double step) const;
};

struct NormConstants {
    std::string norm;                 ///< the norm itself, not its square
    std::string unknown;              ///< why its sizes are not known; empty: they are
    std::optional<LeadingTerm> in_h;  ///< a h^p; none: no error of that kind
    std::optional<LeadingTerm> in_dt; ///< b Δt^q; likewise
    /// The h above which an error of a higher order is larger than a h^p; 0: none below 1 is. Of u
    /// or u_x, whose order 2 the coupling brings, the beam's own, of order 4 or 3. Of u_xx, where a
    /// strong coupling makes the discrete θ the L² projection of θ on its elements, what is left of
    /// that in an element, ‖P_Sθ − Πθ‖² α² = α² (√3/864 (θ_xx(0)² + θ_xx(1)²) h⁵ + ‖θ_xxx‖²
    /// h⁶/2700): known for α of 30 and more, in times beyond ζ, which w takes to answer.
    double shows_below = 0.0;
    bool hidden_by_coupling = false; ///< it is the latter
};

/// What the sizes depend on, beside the solution.
struct ForecastMethod {
    std::string time_scheme;
    ThermalMass mass = ThermalMass::consistent;
};

/// The sizes of the leading errors of a solution by one method, forecast without running it.
struct ErrorConstants {
    std::string unknown; ///< why they are not known; empty: they are
    std::vector<NormConstants> norms;

    [[nodiscard]] const NormConstants* of(const std::string& norm) const;
};

/// Forecasts on uniform meshes from the modified equations (Warming and Hyett 1974, J. Comput.
/// Phys. 14; Krueger, Mousseau and Hassan for manufactured solutions): the leading errors Δt^q (E,
/// e) and h² (N, d) of θ̃ and w = u_xx solve the linear problem driven by the truncation terms of
/// the scheme (driven_beam.hpp, F to the heat equation and H to the beam's).
///
/// Time. Euler: F = ½(θ̃_tt − α w_tt), H = ½ζ w_tt; BDF2: F = ⅓(θ̃_ttt − α w_ttt), H = ⅓ζ w_ttt; a
/// Runge–Kutta scheme of order 2, with C₁ = ½Σ b c² − 1/6 and C₂ = Σ_i b_i (Σ_j a_ij c_j − c_i²/2):
/// F = C₁(θ̃_ttt − α w_ttt) + C₂ θ̃_xxtt, H = C₁ζ w_ttt − C₂(w_tt + α θ̃_tt).
///
/// Space. Linear elements interpolate with I_hθ̃ − θ̃ = ½ξ(1 − ξ)h² θ̃_xx, on average h²θ̃_xx/12, and
/// what P1disc leaves of w is ½(ξ² − ξ + 1/6)h² w_xx. N = Θ − I_hθ̃ at the nodes and d = W − Πw obey
/// F = −θ̃_xxt/12, with the lumped mass matrix +θ̃_xxt/12 as it adds h²/6 (θ̃_xt, χ_x), and
/// H = −α θ̃_xx/12. So, over h⁴,
///
///     ‖e_θ‖² = ∫ N² + Nθ̃_xx/6 + θ̃_xx²/120,   ‖e_w‖² = ∫ d² + w_xx²/720,   ‖e_θx‖² = h⁻²∫ θ̃_xx²/12,
///
/// u_x and u have the integrals of d; without it h⁶∫w_xx²/30240 and h⁸∫w_xx²/362880.
///
/// Not known where a contact begins or ends, at penalised stops that are touched, where a phase
/// ends, for BDF2 where the solution is quadratic in time, for SDIRK2 where ζ is below T/100,
/// and there for BDF2, which it starts, maxima over time of errors in u, where a derivative is no
/// number, and where the driven problem does not settle to 0.2 %. Without viscosity W jumps to
/// equilibrium in the first step, and a coupled Θ with it, away from I_hθ̃: maxima over time of
/// errors in θ are not known; nor where ζ/(1 + α²), the time that this takes, is below T/200. One
/// result a method; expected: what expected_orders says of them.
std::vector<ErrorConstants> error_constants(const ExpectedOrders& expected,
                                            const AdmissibleSolution& solution,
                                            const std::vector<ForecastMethod>& methods);

} // namespace tvbeam

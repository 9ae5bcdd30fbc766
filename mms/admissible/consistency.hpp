#pragma once

#include "core/space/linear_elements.hpp"
#include "core/space/quadrature.hpp"
#include "mms/admissible/admissibility.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

class PiecewiseTape;
struct StepStates;

/// What is left of the two discrete equations when the exact solution is put into them. It tells,
/// without a run, from which h and dt on a scheme sees the solution as smooth, and that f, G and m
/// belong to it: the derivatives come from the solution, the loads from the derived problem.
struct Residual {
    std::int64_t count = 0; ///< elements, or steps up to final_time
    double heat = 0.0;      ///< of the heat equation, the largest L² norm over time
    double beam = 0.0;      ///< of the beam equation, likewise
    /// Against the refinement before; none: the first, zero, or beyond the range of doubles.
    std::optional<double> heat_order;
    std::optional<double> beam_order;
    /// False of a residual that is zero where it was looked at, and of which the formulas do not
    /// say that it vanishes: something narrow in space or time may have been missed.
    bool heat_is_known = true;
    bool beam_is_known = true;
};

/// The refinements at which the residuals are shown, and their last orders expected.
inline constexpr std::array<std::int64_t, 4> shown_elements{8, 16, 32, 64};
inline constexpr std::array<std::int64_t, 4> shown_steps{64, 128, 256, 512};

/// In space, the time derivatives exact: with the nodal interpolant I, the L² projection Π on
/// P1disc,
///
///     M Iθ̃_t + K Iθ̃ − α (Πu_xxt, χ) − (f, χ)     in the norm (rᵀ M_l⁻¹ r)^½ of its L²
///     representative, Πu_xx + ζ Πu_xxt + α Iθ̃ + Πμ − σ̃(1,t) (1 − x),
///
/// the largest over 17 times of each phase up to final_time, over those at which θ̃_xx and θ̃_xxt,
/// which leave them, are largest, and, ever closer, next to the largest. They vanish where θ̃_xxt =
/// 0 and where α θ̃_xx = 0.
std::vector<Residual> space_residuals(const AdmissibleSolution& solution, ThermalMass mass,
                                      const std::vector<std::int64_t>& elements);

/// In time, space exact: τ(θ̃) − α τ(u_xx) and ζ τ(u_xx), where τ(y) is the defect of a step of the
/// scheme with exact y_t in its stages. With the increments e of TimeScheme,
///
///     e_i = Δt y_t(t_i)/leading_i + Σ_j weights_ij e_j,     τ = leading/Δt (e_last − (y_n −
///     y_{n−1})),
///
/// the largest L² norm over all steps but those that the scheme leaves to its starter. They vanish
/// where θ̃ − α u_xx and ζ u_xx are polynomials in t, of no higher degree than the scheme's order.
/// The exact values are found once for all schemes, and those of a refinement among those of a
/// finer one, halved.
class TimeResiduals {
public:
    TimeResiduals(const AdmissibleSolution& solution, std::vector<std::int64_t> steps);
    ~TimeResiduals();

    /// One for each number of steps.
    [[nodiscard]] std::vector<Residual> of(const std::string& scheme) const;

private:
    Beam beam_;
    double final_time_;
    std::vector<std::int64_t> steps_;
    std::unique_ptr<const PiecewiseTape> exact_; ///< θ̃, u_xx and their rates
    /// The least number of derivatives in t by which θ̃ − α u_xx, and ζ u_xx, vanish in every phase.
    int heat_degree_, beam_degree_;
    GaussRule rule_; ///< of the norm over x
    /// exact_ at the levels of a number of steps.
    std::map<std::int64_t, std::unique_ptr<const StepStates>> levels_;
};

} // namespace tvbeam

#pragma once

#include "studies/stress/stress_block.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

enum class Outcome {
    certified, ///< all checks hold
    refused,   ///< before it ran, with a reason
    stopped,   ///< while it ran, with a reason
    failed     ///< a check does not hold: a wrong result, and the reason says which check
};

std::string name_of(Outcome outcome);

/// The worst of each check over a run.
struct StressChecks {
    double energy = 0.0;          ///< EnergyLaw::end_step
    double heat_residual = 0.0;   ///< Residuals, in units of round-off
    double beam_residual = 0.0;   ///< the same
    double penetration = 0.0;     ///< ContactDefects, over the scale of the tip
    double wrong_sign = 0.0;      ///< the same
    double complementarity = 0.0; ///< the same
    double initial = 0.0;         ///< initial_defect()
    /// What the form that was run leaves in the curvature, over its size: 0, or, of the Hermite
    /// form, the round-off that is predicted for it, and its iteration. The limits of the energy
    /// law, the residuals and the initial state are so much wider.
    double allowance = 0.0;
    /// Between the two bases of the direct algorithm, the norms of temperature, curvature and
    /// contact stress: their differences in ulp of their scales. None where not both apply.
    std::optional<double> path;
    double path_limit = 0.0;  ///< path_limit() of the case
    std::string path_skipped; ///< why there is none
    /// The error against the exact solution over the one that the two-term model predicts. None
    /// where the case has no exact solution.
    std::optional<double> error;
    std::string error_skipped; ///< why there is none
    /// The order in Δt by doubling the steps twice, less that which is claimed for the scheme. None
    /// where there is no error, or where the steps are too large to show the order.
    std::optional<double> order_defect;

    /// path over its limit.
    [[nodiscard]] std::optional<double> path_part() const;
    [[nodiscard]] double energy_limit() const;
    [[nodiscard]] double residual_limit() const;
    [[nodiscard]] double initial_limit() const;
    /// How near the checks come to their limits: the greatest of each over its own; > 1: one fails.
    [[nodiscard]] double closeness(bool has_stops) const;
};

/// What the checks must keep to, in their own units, where nothing is allowed for.
struct StressLimits {
    static constexpr double energy = 1e-12;
    static constexpr double residual = 64.0;
    static constexpr double contact = 1e-13;
    /// Gauss's rules of solver and certificate differ by 3e-10 of sin πx on a single element.
    static constexpr double initial = 1e-8;
    static constexpr double order = 0.2;
};

struct StressCase {
    StressParameters parameters;
    Outcome outcome = Outcome::certified;
    std::string reason;                 ///< empty when certified
    std::optional<StressChecks> checks; ///< none when refused or stopped
    double seconds = 0.0;
};

/// Runs a case and judges it. Never throws for what its parameters are.
StressCase judge(const StressParameters& parameters);

/// The first check that does not hold, in words; empty: all do.
std::string violation(const StressChecks& checks);

/// The greatest difference of temperature, curvature and contact stress (their norms) between nodal
/// values and the sine basis, in ulp of the scale; NaN where one is.
double path_difference(const std::vector<double>& nodal, const std::vector<double>& sine,
                       const std::array<double, 3>& scales);

/// What the two paths may differ by, in ulp of the scale: 30 up to 1000 elements, and beyond in
/// proportion, as the nodal elimination adds up the round-off of s rows. In nodal values every
/// difference of fluxes KΘ* is rounded by ε r/h, r the jump between neighbours; over s nodes these
/// add up like a random walk to the load ε r √s of the slowest mode, s^{3/2} ε r/(1 + c/π²) in Θ.
/// Of smooth data that is nothing, of sawtooths it is the larger part.
double path_limit(std::int64_t elements, double roughness, double c);

} // namespace tvbeam

#include "studies/stress/mode_solution.hpp"

#include "core/certify/stated_scheme.hpp"

#include <cmath>
#include <numbers>

namespace tvbeam {

namespace {

constexpr long double pi = std::numbers::pi_v<long double>;

Mode operator+(Mode a, Mode b) {
    return {a.theta + b.theta, a.w + b.w};
}

Mode operator-(Mode a, Mode b) {
    return {a.theta - b.theta, a.w - b.w};
}

Mode operator*(long double factor, Mode a) {
    return {factor * a.theta, factor * a.w};
}

/// (1 + α²) T' = −π²T.
std::vector<Mode> exact_mode_without_viscosity(long double alpha, Mode initial, double dt,
                                               std::int64_t steps) {
    const long double inertia = 1.0L + alpha * alpha;
    const long double start = (initial.theta - alpha * initial.w) / inertia;
    std::vector<Mode> modes{initial};
    for (std::int64_t n = 1; n <= steps; ++n) {
        const long double t = static_cast<long double>(dt) * static_cast<long double>(n);
        const long double theta = start * std::exp(-pi * pi / inertia * t);
        modes.push_back({theta, -alpha * theta});
    }
    return modes;
}

} // namespace

std::vector<Mode> exact_mode(const Beam& beam, Mode initial, double dt, std::int64_t steps) {
    const long double alpha = beam.alpha;
    const long double zeta = beam.zeta;
    if (zeta == 0.0L)
        return exact_mode_without_viscosity(alpha, initial, dt, steps);
    // (T, A)' = −S (T, A) with S = [π² + α²/ζ, α/ζ; α/ζ, 1/ζ], positive definite, det S = π²/ζ.
    const long double heat = pi * pi + alpha * alpha / zeta;
    const long double coupling = alpha / zeta;
    const long double bending = 1.0L / zeta;
    const long double half = (heat - bending) / 2.0L;
    const long double fast = (heat + bending) / 2.0L + std::hypot(half, coupling);
    const long double slow = pi * pi / zeta / fast;
    // The projection on the eigenvectors: P_fast = (S − slow)/(fast − slow).
    const long double gap = fast - slow;
    const auto applied = [&](Mode y) -> Mode {
        return {heat * y.theta + coupling * y.w, coupling * y.theta + bending * y.w};
    };
    const Mode in_fast = gap == 0.0L ? Mode{} : (1.0L / gap) * (applied(initial) - slow * initial);
    std::vector<Mode> modes;
    for (std::int64_t n = 0; n <= steps; ++n) {
        const long double t = static_cast<long double>(dt) * static_cast<long double>(n);
        modes.push_back(std::exp(-fast * t) * in_fast + std::exp(-slow * t) * (initial - in_fast));
    }
    return modes;
}

std::vector<Mode> discrete_mode(const Beam& beam, ThermalMass mass, const std::string& scheme,
                                std::int64_t elements, Mode initial, bool projected, double dt,
                                std::int64_t steps) {
    const long double alpha = beam.alpha;
    const long double zeta = beam.zeta;
    const long double h = 1.0L / static_cast<long double>(elements);
    const long double sine = std::sin(pi * h / 2.0L);
    const long double consistent = (3.0L - 2.0L * sine * sine) / 3.0L; // of M_c, over h
    const long double stiffness = 4.0L * sine * sine / (h * h) / consistent;
    const long double m = mass == ThermalMass::lumped ? 1.0L / consistent : 1.0L;
    if (projected) // (sin πx, χ_i) over (M_c sin πx_i)_i
        initial.w *= stiffness / (pi * pi);

    std::vector<Mode> modes{initial};
    for (std::int64_t n = 1; n <= steps; ++n) {
        const StatedStep step = stated_step(scheme, n);
        const Mode before = modes.back();
        std::vector<Mode> rates; // Δt F of the stages
        Mode now;
        for (Eigen::Index i = 0; i < step.solves(); ++i) {
            Mode star = before;
            if (step.two_step)
                star = star + 1.0L / 3.0L * (before - modes[modes.size() - 2]);
            for (std::size_t j = 0; j < rates.size(); ++j)
                star = star +
                       static_cast<long double>(step.a(i, static_cast<Eigen::Index>(j))) * rates[j];
            const long double factor = step.leading(i);
            const long double c = factor / dt;
            const long double kappa = 1.0L / (1.0L + zeta * c);
            now.theta = (c * m * star.theta - alpha * c * kappa * star.w) /
                        (c * m + stiffness + alpha * alpha * c * kappa);
            now.w = star.w - kappa * (star.w + alpha * now.theta);
            rates.push_back(factor * (now - star));
        }
        modes.push_back(now);
    }
    return modes;
}

} // namespace tvbeam

#pragma once

#include "core/certify/solve_record.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// The discrete energy law of a time scheme, as an identity. Each solve is tested with Θ and
/// ẇ = c (w − w*); with y = (Θ, w) in M × L², b the weights of the step,
///
///     E^n − E^{n−1} + N + Δt Σ_i b_i (D_i − W_i) = 0,
///     D = ΘᵀKΘ + ζ‖ẇ‖²,     W = (f, Θ) − (μ + αθ_A(1 − x), ẇ) + λ (1 − x, ẇ)
///
/// - one-step schemes: E = ½‖y‖², N = ½Δt² Σ_ij m_ij (ẏ_i, ẏ_j) with the matrix of algebraic
///   stability m_ij = b_i a_ij + b_j a_ji − b_i b_j (Burrage and Butcher 1979). N ≥ 0 for Euler,
///   where it is ½‖y^n − y^{n−1}‖²; Alexander's SDIRK2 has m = diag(−γ², γ²) of both signs and is
///   not algebraically stable: its energy falls because it is A-stable (von Neumann 1951);
/// - BDF2: E = ¼(‖y^n‖² + ‖2y^n − y^{n−1}‖²), the G-norm of Dahlquist (1976), and
///   N = ¼‖y^n − 2y^{n−1} + y^{n−2}‖².
class EnergyLaw {
public:
    /// mesh must outlive the object. underflow: in the units of the records, below which floating
    /// point is absolute; 0: never.
    EnergyLaw(const Beam& beam, const Mesh& mesh, ThermalMass mass, double underflow = 0.0);
    EnergyLaw(const Beam& beam, Mesh&& mesh, ThermalMass mass, double underflow = 0.0) = delete;

    /// Adds the work of a solve.
    void add(const SolveRecord& record);

    /// What the identity leaves over a step, relative to the sum of the sizes of its terms. KΘ
    /// counts with the fluxes of KΘ*, from which a solve forms the increment; those in ẇ count with
    /// the terms that w is the sum of, the exchange α(Θ, ẇ) between the two equations, which
    /// cancels, included. Call before SolveRecorder::end_step. Throws std::domain_error where these
    /// sizes are beyond the range of doubles.
    double end_step(const SolveRecorder& recorder, const SolveRecord& last);

    /// |Σ of what the identity left over all steps| over the greatest energy and all that was
    /// conducted away and lost to viscosity. Where α Θ is far larger than the w that it leaves, it
    /// is not small though each step keeps the law to round-off of its terms.
    [[nodiscard]] double missed_part() const;

    /// E of the last step; unit: the square of the record's.
    [[nodiscard]] double energy() const { return energy_; }

private:
    /// N of a one-step scheme, and the sizes of its terms.
    struct Dissipation {
        double sum = 0.0;
        double size = 0.0;
    };
    [[nodiscard]] Dissipation dissipation(const SolveRecorder& recorder,
                                          const StatedStep& step) const;
    [[nodiscard]] double square(const RecordedState& y) const;

    Beam beam_;
    const Mesh& mesh_;
    ThermalMass mass_;
    double underflow_;
    std::vector<double> balances_; // Δt (D − W) of each
    std::vector<double> sizes_;
    double energy_ = 0.0;
    double greatest_ = 0.0; ///< energy
    double spent_ = 0.0;    ///< Σ Δt D
    double missed_ = 0.0;   ///< Σ of what the identity leaves, with its signs
};

} // namespace tvbeam

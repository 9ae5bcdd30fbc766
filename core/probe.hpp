#pragma once

#include "core/problem.hpp"
#include "core/scheme.hpp"
#include "core/solver.hpp"
#include "core/space/mesh.hpp"
#include "core/space/tridiagonal.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// A number read of the discrete state at a time level.
struct Probe {
    enum class Quantity {
        temperature, ///< θ̃(x): Θ + θ_A (1 − x)
        deflection,  ///< U(x)
        stress,      ///< the contact stress σ̃; at t = 0, before any solve, not a number
        energy       ///< ½ ΘᵀMΘ + ½ ‖U_xx‖², M the mass matrix of the scheme
    };
    Quantity quantity = Quantity::temperature;
    double x = 0.0; ///< in [0, 1]; of temperature and deflection
};

/// What a run must solve for, and keep, for the probes.
Needs needs_of(const std::vector<Probe>& probes);

/// Reads probes off a solver.
class ProbeReader {
public:
    ProbeReader(const Beam& beam, Mesh mesh, ThermalMass mass, std::vector<Probe> probes);

    /// One value a probe, at the state of the solver at time t. The tip, u at x = 1, is the
    /// solver's own, which contact is decided by. Throws std::domain_error where the energy is
    /// beyond the range of doubles.
    [[nodiscard]] Eigen::VectorXd read(const Solver& solver, double t) const;

private:
    /// The element of x and the part of its length that lies left of x.
    struct Position {
        Eigen::Index element;
        double part;
    };
    [[nodiscard]] Position locate(double x) const;

    double theta_A_;
    Mesh mesh_;
    std::vector<Probe> probes_;
    Needs needs_;
    Tridiagonal mass_; // order 0: no probe reads the energy
};

} // namespace tvbeam

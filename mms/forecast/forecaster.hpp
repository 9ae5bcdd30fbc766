#pragma once

#include "core/norms/norms.hpp"
#include "core/problem.hpp"
#include "core/scheme.hpp"
#include "mms/derivation.hpp"
#include "mms/expression/tape.hpp"
#include "mms/forecast/driven_beam.hpp"
#include "mms/forecast/error_constants.hpp"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace tvbeam {

/// The squares of the leading error in each quantity at the times t, and its order there.
struct LeadingSquares {
    Eigen::ArrayXd t;
    std::array<Eigen::ArrayXd, quantity_count> values;
    std::array<double, quantity_count> orders{};
    Eigen::ArrayXd curvature = {}; ///< ∫ w_xx²
    Eigen::ArrayXd at_ends = {};   ///< θ_xx(0)² + θ_xx(1)²
    Eigen::ArrayXd bending = {};   ///< ∫ θ_xxx²
    double unit = 1.0;             ///< of the errors that these are the squares of

    Eigen::ArrayXd& of(Quantity quantity) { return values[static_cast<std::size_t>(quantity)]; }
    double& order(Quantity quantity) { return orders[static_cast<std::size_t>(quantity)]; }
};

/// Those of the errors of a mass matrix, and of a time scheme.
struct MethodSquares {
    LeadingSquares space;
    LeadingSquares time;
};

/// The squares of the leading errors of a smooth solution: those of the linear problem driven by
/// the truncation terms of a method, and what interpolation leaves.
class Forecaster {
public:
    /// The derivatives of the solution that truncation terms are made of, in the rows of a tape.
    enum Derivative : std::uint8_t {
        theta_xx,
        theta_xxt,
        theta_tt,
        theta_ttt,
        theta_xxtt,
        w_xx,
        w_tt,
        w_ttt
    };

    /// Their rows, of a phase.
    static Tape derivatives_of(const DerivedPhase& phase);

    /// Those that the truncation terms of a method are made of.
    static std::vector<Derivative> derivatives_in(const std::string& time_scheme);

    /// coupled: bending has an error of the order of that of heat.
    Forecaster(const Tape& tape, const Beam& beam, bool held, bool coupled, double final_time);

    /// Of each method.
    [[nodiscard]] std::vector<MethodSquares> squares(const std::vector<ForecastMethod>& methods,
                                                     Eigen::Index modes, Eigen::Index steps) const;

    /// Of each derivative, whether the points and times of the driven problem miss where it is
    /// large. One without a value at a point is seen there.
    [[nodiscard]] Eigen::Array<bool, Eigen::Dynamic, 1> missed_peaks(Eigen::Index modes,
                                                                     Eigen::Index steps) const;

    /// Whether the discrete temperature leaves that of the data within a first step of any length.
    [[nodiscard]] bool jumps_at_first() const { return beam_.zeta == 0.0 && beam_.alpha != 0.0; }

    /// Whether it leaves it in a layer that steps may be longer than: in about ζ/(1 + α²).
    [[nodiscard]] bool leaves_soon() const;

    /// Whether bending has an error of the order of that of heat.
    [[nodiscard]] bool is_coupled() const { return coupled_; }

    [[nodiscard]] double alpha() const { return beam_.alpha; }

    /// Whether α h is above 1 on all but fine meshes, and the run longer than ζ.
    [[nodiscard]] bool is_strongly_coupled() const {
        constexpr double strong = 30.0;
        return std::abs(beam_.alpha) >= strong && final_time_ >= beam_.zeta;
    }

    /// Whether the beam's numbers take errors of the size one beyond the squares of doubles.
    [[nodiscard]] bool is_beyond_doubles() const;

    /// Whether ζ is below T/100, so that steps may be longer than it.
    [[nodiscard]] bool is_hardly_viscous() const;

private:
    /// The greatest |value| of each derivative, with what one counts as that is none.
    static Eigen::ArrayXd sizes(const Eigen::ArrayXXd& values, double none);

    [[nodiscard]] Eigen::ArrayXXd at(const Eigen::ArrayXd& x, double t) const;

    [[nodiscard]] Eigen::Array2Xd truncated_in_time(const std::string& scheme,
                                                    const Eigen::ArrayXXd& y) const;

    [[nodiscard]] Eigen::Array2Xd truncated_in_space(ThermalMass mass,
                                                     const Eigen::ArrayXXd& y) const;

    [[nodiscard]] LeadingSquares in_time(const DrivenBeam& error, const Eigen::ArrayXd& t) const;

    /// Without what interpolation leaves.
    [[nodiscard]] LeadingSquares in_space(const DrivenBeam& error, const Eigen::ArrayXd& t) const;

    void add_interpolation(std::vector<MethodSquares>& all, const std::vector<DrivenBeam>& errors,
                           const Eigen::ArrayXd& t, Eigen::Index modes) const;

    /// θ_xx(0)² + θ_xx(1)² and ∫ θ_xxx² at the nth time, from θ_xx at the points of a rule and the
    /// Legendre polynomials there, a column each.
    static void add_third_derivative(LeadingSquares& squares, Eigen::Index n,
                                     const Eigen::ArrayXd& weighted,
                                     const Eigen::MatrixXd& at_points);

    static void add_deflection(LeadingSquares& squares, const Eigen::MatrixXd& w);

    const Tape& tape_;
    const Beam& beam_;
    bool held_;
    bool coupled_;
    double final_time_;
    /// A power of 2 near the greatest size of the derivatives, in which all is computed: the errors
    /// are linear in them, and their squares could leave the range of doubles.
    double unit_ = 1.0;
    Eigen::ArrayXd peaks_; ///< of each derivative the greatest size on scattered points
};

} // namespace tvbeam

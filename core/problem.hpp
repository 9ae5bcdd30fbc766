#pragma once

#include <Eigen/Core>

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace tvbeam {

class Resolution;

/// The two stops of the tip. Rigid ones (6): g1 ≤ u(1,t) ≤ g2. Penalised ones, the law of the
/// paper's reference [1], yield to the contact stress:
///
///     σ̃(1,t) = −((u − g2)⁺ − (g1 − u)⁺) / ε
///
/// An infinite value: no stop on that side. Unit: length.
struct Stops {
    double lower = -std::numeric_limits<double>::infinity(); ///< g1 < 0
    double upper = std::numeric_limits<double>::infinity();  ///< g2 > 0
    double epsilon = 0.0; ///< ε ≥ 0; 0: rigid. Unit: length per force

    [[nodiscard]] bool exist() const;
};

/// The constants of the model (1)–(10), scaled as README.md says.
struct Beam {
    double alpha = 0.0;   ///< coefficient of thermal expansion; ≥ 0; no unit
    double zeta = 0.0;    ///< viscosity coefficient; ≥ 0; unit: time
    double theta_A = 0.0; ///< end temperature θ̃(0,t) (10); unit: temperature
    Stops stops = {};
};

/// x ↦ φ(x), on an array of points in [0, 1].
using SpaceFunction = std::function<Eigen::ArrayXd(const Eigen::ArrayXd& x)>;

/// (x, t) ↦ g(x, t), on an array of points in [0, 1] at one time.
using SpaceTimeFunction = std::function<Eigen::ArrayXd(const Eigen::ArrayXd& x, double t)>;

/// t ↦ (A_0(t), …, A_{K-1}(t)) on an array of times; shape: K rows, one column a time.
/// All amplitudes of a problem are evaluated together, so that what they share is computed once.
using Amplitudes = std::function<Eigen::ArrayXXd(const Eigen::ArrayXd& t)>;

/// A function of space and time, g(x,t) = Σ A_{amplitude}(t) φ_{profile}(x) + rest(x,t).
/// Indices refer to ProblemData::amplitudes and ProblemData::profiles; an amplitude already
/// contains the numerical factor and the sign of its term. A profile may appear in several terms.
struct Field {
    struct Term {
        Eigen::Index amplitude;
        Eigen::Index profile;
    };
    std::vector<Term> terms;
    SpaceTimeFunction rest; ///< empty when g is a sum of products
    bool gentle = false;    ///< rest is known to hold no features narrower than 1/100 or so in x

    [[nodiscard]] bool is_separable() const { return !rest; }
    [[nodiscard]] bool is_zero() const { return terms.empty() && !rest; }
    [[nodiscard]] bool uses(Eigen::Index profile) const; ///< in one of its terms
};

/// The exact solution that a run is measured against. θ̃ is the temperature of (1)–(10), not the
/// transformed one. The three fields of u are those of one function with u = u_x = 0 at x = 0: its
/// errors may be found from the curvature alone.
struct ExactSolution {
    Field theta;   ///< θ̃
    Field theta_x; ///< θ̃_x
    Field u;       ///< deflection
    Field u_x;     ///< slope
    Field u_xx;    ///< curvature
    std::optional<Eigen::Index>
        stress; ///< amplitude of the contact stress σ̃(t); none: zero at all times
    /// Of a solution of rigid stops on a beam with penalised ones: by how much it misses their law,
    /// at most. Errors stall there. Unit: length.
    double law_distance = 0.0;
    /// That the tip stays between the stops was seen at sampled times, and is not proven.
    bool tip_is_sampled = false;

    /// A computed solution: its fields are polynomials of degree ≤ 5 on each of so many equal
    /// elements, a multiple of those of any mesh that it is compared on. 0: smooth on [0, 1].
    Eigen::Index elements = 0;

    /// θ̃, θ̃_x, u, u_x, u_xx: in the order of Quantity.
    [[nodiscard]] std::array<const Field*, 5> fields() const {
        return {&theta, &theta_x, &u, &u_x, &u_xx};
    }
};

/// The data of the problem (1)–(10), as functions of x and t on [0,1] × [0,T].
///
///     θ̃_t − θ̃_xx = α u_xxt + f,   σ̃_x = q,   σ̃ = −u_xxx − ζ u_xxxt − α θ̃_x + G,   m = u_xx(1,t) +
///     ζ u_xxt(1,t)
///
/// The moment form reads the loads through moment_load, the Hermite form through couple_load,
/// body_force and end_moment; the two descriptions must agree.
struct ProblemData {
    std::vector<SpaceFunction> profiles; ///< φ_0, φ_1, …; each distinct, none is identically zero
    /// Which of them are known to hold no features narrower than 1/100 or so; empty: none.
    std::vector<bool> gentle_profiles;
    Amplitudes amplitudes; ///< A_0, A_1, …; may be empty when no field has terms
    Eigen::Index amplitude_count = 0;

    /// Times in (0, ∞), increasing, at which the functions pass from one formula to the next; at
    /// the time itself the earlier one holds. TimeLevels meets them exactly.
    std::vector<double> phase_ends;

    Field theta_initial;     ///< θ̃(x,0): this field at t = 0
    Field curvature_initial; ///< u_xx(x,0): this field at t = 0

    Field heat_source; ///< f
    Field moment_load; ///< μ = Ĝ + q̂ − m with Ĝ(y,t) = ∫_y^1 G dx, q̂(y,t) = ∫_y^1 (x − y) q dx

    Field couple_load;                      ///< G
    Field body_force;                       ///< q
    std::optional<Eigen::Index> end_moment; ///< amplitude of m(t); none: zero at all times

    std::optional<ExactSolution> exact;

    /// How finely the functions must be cut to be integrated; null: run() finds out by itself.
    std::shared_ptr<const Resolution> resolution = nullptr;
};

/// The sum of two functions of the same profiles and amplitudes.
Field sum(const Field& a, const Field& b);

/// The problem with the sources and initial data of another added, times the factor. Exact solution
/// and ends of phases stay those of the first; the resolution is left to run().
ProblemData sum(const ProblemData& problem, const ProblemData& added, double factor = 1.0);

/// The values of a field of the problem at the points x and the time t.
Eigen::ArrayXd values(const ProblemData& data, const Field& field, const Eigen::ArrayXd& x,
                      double t);

} // namespace tvbeam

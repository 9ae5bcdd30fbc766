#include "mms/forecast/driven_beam.hpp"

#include "core/space/quadrature.hpp"

#include <Eigen/LU>

#include <cmath>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// The problem in coefficients: M y' + K y = the loads of F and H.
struct Matrices {
    MatrixXd theta; ///< basis of y in Legendre polynomials, one row each: P_k − P_{k+2}
    MatrixXd w;     ///< of w likewise: all of P_k, or what is orthogonal to 1 − x
    MatrixXd mass;
    MatrixXd stiffness;
};

Matrices matrices(const Beam& beam, bool held, Index modes) {
    const Index count = modes + 1;
    const VectorXd gram =
        (2.0 * ArrayXd::LinSpaced(count, 0.0, static_cast<double>(modes)) + 1.0).inverse().matrix();
    Matrices all;
    all.theta = MatrixXd::Zero(count - 2, count);
    MatrixXd slopes = all.theta; // (P_k − P_{k+2})' = −2 (2k + 3) P_{k+1}
    for (Index k = 0; k + 2 < count; ++k) {
        all.theta(k, k) = 1.0;
        all.theta(k, k + 2) = -1.0;
        slopes(k, k + 1) = -2.0 * (2.0 * static_cast<double>(k) + 3.0);
    }
    all.w = MatrixXd::Identity(count, count);
    if (held) {
        all.w = MatrixXd::Identity(count, count).bottomRows(count - 1);
        all.w.row(0).head(2) << 0.5, 1.5; // 3x − 1 is orthogonal to 1 − x, as is P_2, P_3, …
    }
    const auto products = [&](const MatrixXd& a, const MatrixXd& b) -> MatrixXd {
        return a * gram.asDiagonal() * b.transpose();
    };
    const Index of_theta = all.theta.rows();
    const Index of_w = all.w.rows();
    all.mass = MatrixXd::Zero(of_theta + of_w, of_theta + of_w);
    all.stiffness = all.mass;
    all.mass.topLeftCorner(of_theta, of_theta) = products(all.theta, all.theta);
    all.mass.topRightCorner(of_theta, of_w) = -beam.alpha * products(all.theta, all.w);
    all.mass.bottomRightCorner(of_w, of_w) = beam.zeta * products(all.w, all.w);
    all.stiffness.topLeftCorner(of_theta, of_theta) = products(slopes, slopes);
    all.stiffness.bottomLeftCorner(of_w, of_theta) = beam.alpha * products(all.w, all.theta);
    all.stiffness.bottomRightCorner(of_w, of_w) = products(all.w, all.w);
    return all;
}

constexpr Index stages = 3;

/// Radau IIA of order 5: A, and c in its last column.
Eigen::Matrix<double, stages, stages + 1> radau() {
    const double r = std::sqrt(6.0);
    Eigen::Matrix<double, stages, stages + 1> table;
    table << (88.0 - 7.0 * r) / 360.0, (296.0 - 169.0 * r) / 1800.0, (-2.0 + 3.0 * r) / 225.0,
        (4.0 - r) / 10.0, //
        (296.0 + 169.0 * r) / 1800.0, (88.0 + 7.0 * r) / 360.0, (-2.0 - 3.0 * r) / 225.0,
        (4.0 + r) / 10.0, //
        (16.0 - r) / 36.0, (16.0 + r) / 36.0, 1.0 / 9.0, 1.0;
    return table;
}

} // namespace

MatrixXd legendre(Index count, const ArrayXd& x) {
    MatrixXd values = MatrixXd::Ones(count, x.size());
    const ArrayXd s = 2.0 * x - 1.0;
    if (count > 1)
        values.row(1) = s.matrix().transpose();
    for (Index k = 1; k + 1 < count; ++k) {
        const auto n = static_cast<double>(k);
        values.row(k + 1) = ((2.0 * n + 1.0) * s.transpose() * values.row(k).array() -
                             n * values.row(k - 1).array()) /
                            (n + 1.0);
    }
    return values;
}

MatrixXd legendre_integral(Index count) {
    MatrixXd integral = MatrixXd::Zero(count + 1, count);
    integral(0, 0) = 0.5; // x = (P_0 + P_1)/2
    integral(1, 0) = 0.5;
    for (Index k = 1; k < count; ++k) {
        const double factor = 0.5 / (2.0 * static_cast<double>(k) + 1.0);
        integral(k + 1, k) = factor;
        integral(k - 1, k) = -factor;
    }
    return integral;
}

std::vector<DrivenBeam> driven_beams(const Beam& beam, bool held, double final_time, Index modes,
                                     Index steps, Index problems, const DrivingSources& sources) {
    const Matrices problem = matrices(beam, held, modes);
    const Index of_theta = problem.theta.rows();
    const Index size = problem.mass.rows();
    const GaussRule rule = GaussRule::of(2 * modes);
    const MatrixXd polynomials = legendre(modes + 1, rule.points);
    const MatrixXd weighted = polynomials * rule.weights.matrix().asDiagonal();
    const MatrixXd test_theta = problem.theta * weighted;
    const MatrixXd test_w = problem.w * weighted;
    const double dt = final_time / static_cast<double>(steps);

    const auto table = radau();
    const Eigen::Matrix3d inverse = table.leftCols<stages>().inverse() / dt;
    MatrixXd matrix(stages * size, stages * size);
    for (Index i = 0; i < stages; ++i)
        for (Index j = 0; j < stages; ++j)
            matrix.block(i * size, j * size, size, size) =
                inverse(i, j) * problem.mass +
                (i == j ? problem.stiffness : MatrixXd::Zero(size, size));
    // The last stage is the state at the end: what the loads of all stages make of it.
    const Eigen::PartialPivLU<MatrixXd> factors(matrix.transpose());
    const MatrixXd last =
        factors.solve(MatrixXd::Identity(stages * size, stages * size).rightCols(size)).transpose();

    std::vector<MatrixXd> states(static_cast<std::size_t>(problems),
                                 MatrixXd::Zero(size, steps + 1));
    MatrixXd state = MatrixXd::Zero(size, problems);
    MatrixXd loads(stages * size, problems);
    for (Index n = 0; n < steps; ++n) {
        const MatrixXd before = problem.mass * state;
        for (Index i = 0; i < stages; ++i) {
            const double t = final_time * static_cast<double>(n) / static_cast<double>(steps);
            const MatrixXd driven =
                sources(rule.points, t + table(i, stages) * dt).matrix().transpose();
            for (Index k = 0; k < problems; ++k) {
                loads.col(k).segment(i * size, of_theta) = test_theta * driven.col(2 * k);
                loads.col(k).segment(i * size + of_theta, size - of_theta) =
                    test_w * driven.col(2 * k + 1);
            }
            loads.middleRows(i * size, size) += inverse.row(i).sum() * before;
        }
        state = last * loads;
        for (Index k = 0; k < problems; ++k)
            states[static_cast<std::size_t>(k)].col(n + 1) = state.col(k);
    }
    std::vector<DrivenBeam> beams;
    beams.reserve(states.size());
    for (const MatrixXd& one : states)
        beams.push_back({problem.theta.transpose() * one.topRows(of_theta),
                         problem.w.transpose() * one.bottomRows(size - of_theta)});
    return beams;
}

} // namespace tvbeam

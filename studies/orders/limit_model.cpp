#include "studies/orders/limit_model.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

/// The standard deviation at weight one: from the residuals, with Student's factor, or known.
double deviation_of(const LinearFit& fit, const Weights& weights) {
    return std::max(fit.dof > 0 ? std::sqrt(fit.square / fit.dof) * student_over_normal(fit.dof)
                                : 0.0,
                    weights.scatter);
}

/// The width down to which the rows show where they turn: between the two finest they may, where
/// their last two steps go one way, but show nothing of it.
double seen_to(std::span<const ValueRow> rows) {
    const std::size_t n = rows.size();
    const auto step = [&](std::size_t i) { return rows[i].value - rows[i - 1].value; };
    return rows[n < 3 || step(n - 1) * step(n - 2) < 0 ? n - 1 : n - 2].h;
}

/// Of C h^p + D h^(p+k): how far it is from its extremum to zero, where that lies below h.
double back_from_turn(double c, double d, double p, double k, double h) {
    const double at = std::pow(-c * p / (d * (p + k)), 1 / k);
    return at > 0 && at < h ? std::abs(c) * std::pow(at, p) * k / (p + k) : 0.0;
}

/// For a given order all else is linear.
LinearFit fit_at(std::span<const ValueRow> rows, const Weights& weights, double order,
                 const LimitModel& model) {
    const auto n = static_cast<Eigen::Index>(rows.size());
    using Next = LimitModel::Next;
    const int columns = model.next == Next::none ? 2 : 3;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 64, 3> design(n, columns);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 64, 1> right(n);
    const double unit = rows.front().h;
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto& row = rows[static_cast<std::size_t>(i)];
        const double x = row.h / unit;
        const double w = std::sqrt(weights.relative[i]);
        design(i, 0) = w;
        design(i, 1) =
            w * (model.logarithmic > 0
                     ? std::pow(1 - order * std::log(x) / model.logarithmic, -model.logarithmic)
                     : std::pow(x, order));
        if (model.alternating && i % 2 == 1)
            design(i, 1) = -design(i, 1);
        if (model.next != Next::none)
            design(i, 2) = design(i, 1) * (model.next == Next::doubled ? std::pow(x, order) : x);
        right[i] = w * (row.value - rows.back().value);
    }
    const Eigen::HouseholderQR<decltype(design)> qr(design);
    const Eigen::VectorXd x = qr.solve(right);
    LinearFit fit{.limit = rows.back().value + x[0],
                  .order = order,
                  .square = (right - design * x).squaredNorm(),
                  .dof = static_cast<int>(n) - model.parameters()};
    fit.finest = rows.back().value + design.row(n - 1).dot(x) / std::sqrt(weights.relative[n - 1]);
    if (model.next != Next::none)
        fit.goes_back = back_from_turn(x[1], x[2], order, model.next == Next::doubled ? order : 1,
                                       seen_to(rows) / unit);
    if (const double deviation = deviation_of(fit, weights); deviation > 0) {
        const Eigen::MatrixXd root =
            qr.matrixQR().topRows(columns).template triangularView<Eigen::Upper>().solve(
                Eigen::MatrixXd::Identity(columns, columns));
        fit.limit_error = deviation * root.row(0).norm();
    }
    return fit;
}

} // namespace

std::optional<LinearFit> fit_limit_model(std::span<const ValueRow> rows, const Weights& weights,
                                         const LimitModel& model) {
    if (static_cast<int>(rows.size()) < model.parameters())
        return std::nullopt;
    const auto at = [&](double p) { return fit_at(rows, weights, p, model); };
    if (model.order)
        return at(*model.order);
    constexpr int net = 24;
    const double step = std::log(greatest_order / least_order) / net;
    int best = -1;
    double least = infinity;
    for (int k = -1; k <= net; ++k) // from below the least, which may be the best
        if (const double square = at(least_order * std::exp(k * step)).square; square < least) {
            least = square;
            best = k;
        }
    if (best == -1 || best == net)
        return std::nullopt;
    double low = least_order * std::exp((best - 1) * step);
    double high = least_order * std::exp((best + 1) * step);
    const double golden = (std::sqrt(5.0) - 1) / 2;
    for (int k = 0; k < 40; ++k) {
        const double left = high - golden * (high - low);
        const double right = low + golden * (high - low);
        (at(left).square < at(right).square ? high : low) =
            at(left).square < at(right).square ? right : left;
    }
    auto fit = at((low + high) / 2);
    if (fit.order < least_order * (1 - 1e-6)) // but for rounding
        return std::nullopt;
    // The standard error at the best order knows nothing of the order's own: that of the linearised
    // model does.
    if (const double deviation = deviation_of(fit, weights); deviation > 0) {
        const double d = 1e-3 * fit.order;
        const auto above = at(fit.order + d), below = at(fit.order - d);
        const double curvature = (above.square + below.square - 2 * fit.square) / (d * d) / 2;
        const double slope = (above.limit - below.limit) / (2 * d);
        if (curvature > 0)
            fit.limit_error =
                std::hypot(fit.limit_error, std::abs(slope) * deviation / std::sqrt(curvature));
    }
    return fit;
}

} // namespace tvbeam

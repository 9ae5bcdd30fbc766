#include "studies/orders/known_orders.hpp"

#include "studies/orders/least_squares.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

/// Powers of h and of Δt of each column; the leading ones of space and time come first.
std::vector<std::pair<double, double>> columns_of(std::optional<double> p,
                                                  std::optional<double> q) {
    std::vector<std::pair<double, double>> columns;
    if (p)
        columns.emplace_back(2.0 * *p, 0.0);
    if (q)
        columns.emplace_back(0.0, 2.0 * *q);
    if (p)
        columns.emplace_back(2.0 * *p + 2.0, 0.0);
    if (q)
        columns.emplace_back(0.0, 2.0 * *q + 1.0);
    if (p && q) {
        columns.emplace_back(*p, *q);
        columns.emplace_back(*p + 2.0, *q);
        columns.emplace_back(*p, *q + 1.0);
    }
    return columns;
}

/// The root of a square, if that is one; the square's uncertainty is a half-width.
std::optional<FittedSize> root(double square, double uncertainty) {
    if (!(square > 0.0))
        return std::nullopt;
    const double value = std::sqrt(square);
    return FittedSize{value, uncertainty / (2.0 * value)};
}

} // namespace

KnownOrderSizes fit_known_orders(std::span<const Refinement> records, std::optional<double> p,
                                 std::optional<double> q) {
    const auto columns = columns_of(p, q);
    if (columns.empty())
        return {};
    std::vector<Refinement> used;
    for (const auto& record : records)
        if (std::isfinite(record.error) && record.error > 0.0)
            used.push_back(record);
    if (used.size() < columns.size() + 2)
        return {std::to_string(used.size()) + " runs; the fit takes " +
                    std::to_string(columns.size() + 2),
                {},
                {}};
    const auto rows = static_cast<Eigen::Index>(used.size());
    const auto count = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd matrix(rows, count);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const auto& [h, dt, error, seconds, uncertainty] = used[static_cast<std::size_t>(i)];
        for (Eigen::Index k = 0; k < count; ++k) {
            const auto& [of_h, of_dt] = columns[static_cast<std::size_t>(k)];
            matrix(i, k) = std::pow(h, of_h) * std::pow(dt, of_dt) / (error * error);
        }
    }
    const Eigen::VectorXd sizes = matrix.colwise().norm();
    const Eigen::MatrixXd scaled = matrix * sizes.cwiseInverse().asDiagonal();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
    if (qr.rank() < count)
        return {"the runs do not determine the sizes", {}, {}};
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rows);
    const Eigen::VectorXd solved = qr.solve(ones);
    const double variance =
        (scaled * solved - ones).squaredNorm() / static_cast<double>(rows - count);
    const Eigen::MatrixXd covariance = variance * (scaled.transpose() * scaled).inverse();
    const double factor = 1.96 * student_over_normal(static_cast<int>(rows - count));
    const auto size = [&](Eigen::Index k) {
        return root(solved(k) / sizes(k), factor * std::sqrt(covariance(k, k)) / sizes(k));
    };
    KnownOrderSizes result;
    if (p)
        result.a = size(0);
    if (q)
        result.b = size(p ? 1 : 0);
    return result;
}

} // namespace tvbeam

#include "studies/orders/known_orders.hpp"

#include "studies/orders/least_squares.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
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

/// The fit of one set of rows.
class KnownOrderFit {
public:
    KnownOrderFit(std::span<const Refinement> records, std::optional<double> p,
                  std::optional<double> q)
        : p_(p), q_(q), columns_(columns_of(p, q)) {
        for (const auto& record : records)
            if (std::isfinite(record.error) && record.error > 0.0)
                used_.push_back(record);
        matrix_.resize(static_cast<Eigen::Index>(used_.size()),
                       static_cast<Eigen::Index>(columns_.size()));
        for (Eigen::Index i = 0; i < matrix_.rows(); ++i) {
            const Refinement& row = used_[static_cast<std::size_t>(i)];
            for (Eigen::Index k = 0; k < matrix_.cols(); ++k) {
                const auto& [of_h, of_dt] = columns_[static_cast<std::size_t>(k)];
                matrix_(i, k) =
                    std::pow(row.h, of_h) * std::pow(row.dt, of_dt) / (row.error * row.error);
            }
        }
    }

    [[nodiscard]] KnownOrderSizes sizes() const {
        return sizes(Eigen::VectorXd::Ones(matrix_.rows()));
    }

    /// Those of a maximum over time.
    [[nodiscard]] KnownOrderSizes sizes_of_maximum() const {
        if (!p_ || !q_)
            return sizes();
        const KnownOrderSizes all = sizes();
        if (!all.a || !all.b)
            return {all.failure, {}, {}};
        Eigen::ArrayXd ratio(matrix_.rows()); // of the term in Δt to that in h
        for (Eigen::Index i = 0; i < ratio.size(); ++i) {
            const Refinement& row = used_[static_cast<std::size_t>(i)];
            ratio(i) = all.b->value * std::pow(row.dt, *q_) / (all.a->value * std::pow(row.h, *p_));
        }
        const auto widened = [&](const FittedSize& size,
                                 std::optional<FittedSize> KnownOrderSizes::*which,
                                 const Eigen::ArrayXd& other) -> std::optional<FittedSize> {
            const auto its = sizes((1.0 + other.pow(8.0)).inverse().matrix()).*which;
            const double least = other.minCoeff();
            if (!its || !(least < 1.0))
                return std::nullopt;
            return FittedSize{size.value, size.uncertainty + std::abs(its->value - size.value) +
                                              0.5 * least * least * size.value};
        };
        return {"", widened(*all.a, &KnownOrderSizes::a, ratio),
                widened(*all.b, &KnownOrderSizes::b, ratio.inverse())};
    }

    [[nodiscard]] std::size_t rows() const { return used_.size(); }
    [[nodiscard]] std::size_t columns() const { return columns_.size(); }

private:
    [[nodiscard]] KnownOrderSizes sizes(const Eigen::VectorXd& weights) const {
        const Eigen::MatrixXd weighted = weights.asDiagonal() * matrix_;
        const Eigen::VectorXd norms = weighted.colwise().norm();
        const Eigen::MatrixXd scaled = weighted * norms.cwiseInverse().asDiagonal();
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
        if (qr.rank() < scaled.cols())
            return {"the runs do not determine the sizes", {}, {}};
        const Eigen::VectorXd solved = qr.solve(weights);
        const auto freedom = static_cast<int>(scaled.rows() - scaled.cols());
        const double variance = (scaled * solved - weights).squaredNorm() / freedom;
        const Eigen::MatrixXd covariance = variance * (scaled.transpose() * scaled).inverse();
        const double factor = 1.96 * student_over_normal(freedom);
        const auto size = [&](Eigen::Index k) {
            return root(solved(k) / norms(k), factor * std::sqrt(covariance(k, k)) / norms(k));
        };
        KnownOrderSizes result;
        if (p_)
            result.a = size(0);
        if (q_)
            result.b = size(p_ ? 1 : 0);
        return result;
    }

    std::optional<double> p_, q_;
    std::vector<std::pair<double, double>> columns_;
    std::vector<Refinement> used_;
    Eigen::MatrixXd matrix_; ///< a row a record, in parts of its e²
};

std::optional<KnownOrderSizes> sizes_of(std::span<const Refinement> records,
                                        std::optional<double> p, std::optional<double> q,
                                        bool is_maximum) {
    const KnownOrderFit fit(records, p, q);
    if (fit.rows() < fit.columns() + 2)
        return std::nullopt;
    return is_maximum ? fit.sizes_of_maximum() : fit.sizes();
}

/// Without the coarsest level of a width.
std::vector<Refinement> finer_of(std::span<const Refinement> records, double Refinement::*width) {
    double coarsest = 0.0;
    for (const auto& record : records)
        if (record.error > 0.0)
            coarsest = std::max(coarsest, record.*width);
    std::vector<Refinement> finer(records.begin(), records.end());
    std::erase_if(finer, [&](const Refinement& record) { return record.*width == coarsest; });
    return finer;
}

/// A size is known as far as it is that of finer rows, to what is known of that.
void widen(std::optional<FittedSize>& size, const std::optional<FittedSize>& finer) {
    if (size)
        size->uncertainty = std::max(
            size->uncertainty,
            finer ? std::abs(finer->value - size->value) - finer->uncertainty : size->value);
}

} // namespace

KnownOrderSizes fit_known_orders(std::span<const Refinement> records, std::optional<double> p,
                                 std::optional<double> q, bool is_maximum) {
    if (!p && !q)
        return {};
    const auto all = sizes_of(records, p, q, is_maximum);
    if (!all) {
        const KnownOrderFit fit(records, p, q);
        return {fmt::format("{} runs; the fit takes {}", fit.rows(), fit.columns() + 2), {}, {}};
    }
    KnownOrderSizes result = *all;
    for (const auto& [size, width, is_there] :
         {std::tuple(&KnownOrderSizes::a, &Refinement::h, p.has_value()),
          {&KnownOrderSizes::b, &Refinement::dt, q.has_value()}})
        if (is_there)
            if (const auto finer = sizes_of(finer_of(records, width), p, q, is_maximum))
                widen(result.*size, (*finer).*size);
    return result;
}

} // namespace tvbeam

#include "studies/orders/term_starts.hpp"

#include <boost/math/tools/minima.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace tvbeam {

namespace {

/// Most starts end in the same place.
constexpr std::size_t most_starts = 3;
constexpr std::size_t most_moved = 8; ///< starts of a model with a next term
constexpr double most_rho = 0.99;     ///< of a start

struct Start {
    Eigen::VectorXd theta;
    double left = infinity; ///< how far off it is: the sum of squares of e²_model / e² − 1
};

/// For given orders the squares are linear in a_i a_j ρ_ij, and where one width has a next term
/// x^k in these times its c, and in a² c², if each counts as a number of its own.
std::optional<Start> start_at(const Layout& layout, const TermRows& rows, Eigen::Index longer,
                              const Eigen::VectorXd& orders) {
    const Eigen::Index d = layout.widths();
    const auto power_of = [&](Eigen::Index i, double order) {
        Eigen::ArrayXd power = (order * rows.log_widths.col(i)).array().exp();
        const double reference = reference_of(rows.log_reference, i);
        if (!std::isnan(reference) && i == rows.in_squares)
            power = (power.square() - std::exp(2 * order * reference)).sqrt();
        else if (!std::isnan(reference))
            power -= std::exp(order * reference);
        return Eigen::VectorXd(power / rows.log_errors.array().exp());
    };
    Eigen::MatrixXd powers(rows.size(), d);
    for (Eigen::Index i = 0; i < d; ++i)
        powers.col(i) = power_of(i, orders[i]);
    const Eigen::Index of_next = longer < 0 ? 0 : d + 1;
    Eigen::MatrixXd design(rows.size(), d + d * (d - 1) / 2 + of_next);
    design.leftCols(d) = powers.cwiseAbs2();
    Eigen::Index column = d;
    for (Eigen::Index i = 0; i < d; ++i)
        for (Eigen::Index j = i + 1; j < d; ++j)
            design.col(column++) = powers.col(i).cwiseProduct(powers.col(j));
    if (longer >= 0) {
        const Eigen::VectorXd next = power_of(longer, orders[longer] + layout.power(longer));
        for (Eigen::Index j = 0; j < d; ++j)
            design.col(column++) = next.cwiseProduct(powers.col(j));
        design.col(column) = next.cwiseAbs2();
    }
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rows.size());
    const Eigen::VectorXd x = design.colPivHouseholderQr().solve(ones);
    if (!x.allFinite())
        return std::nullopt;
    Start start{Eigen::VectorXd::Zero(layout.size()), (design * x - ones).squaredNorm()};
    const double least = std::max(1e-12 * x.head(d).cwiseAbs().maxCoeff(), 1e-300);
    for (Eigen::Index i = 0; i < d; ++i) {
        start.theta[2 * i] = std::log(std::max(x[i], least)) / 2;
        start.theta[2 * i + 1] = orders[i];
        if (x[i] <= 0)
            start.left += 1; // no size has such a square: better starts come first
    }
    column = d;
    for (Eigen::Index i = 0; i < d; ++i)
        for (Eigen::Index j = i + 1; j < d; ++j) {
            const double rho = x[column++] / 2 / std::exp(start.theta[2 * i] + start.theta[2 * j]);
            start.theta[layout.pair(i, j)] = std::clamp(rho, -most_rho, most_rho);
        }
    if (longer >= 0)
        start.theta[layout.next(longer)] =
            x[column + longer] / 2 / std::exp(2 * start.theta[2 * longer]);
    return start;
}

/// To the best order of one width between its neighbours in the net: beside a next term a far
/// smaller one is seen there alone.
void move_order(const Layout& layout, const TermRows& rows, Eigen::Index i, Start& start) {
    constexpr double step = 0.5;
    constexpr int bits = 20;
    Eigen::VectorXd orders(layout.widths());
    for (Eigen::Index k = 0; k < layout.widths(); ++k)
        orders[k] = start.theta[2 * k + 1];
    const auto left_at = [&](double order) {
        orders[i] = order;
        return start_at(layout, rows, i, orders).value_or(Start()).left;
    };
    const auto [order, left] = boost::math::tools::brent_find_minima(
        left_at, std::max(orders[i] - step, step / 2), orders[i] + step, bits);
    if (!(left < start.left))
        return;
    orders[i] = order;
    if (auto other = start_at(layout, rows, i, orders))
        start = std::move(*other);
}

} // namespace

std::vector<Eigen::VectorXd> starts_of(const Layout& layout, const TermRows& rows) {
    const Eigen::Index d = layout.widths();
    Eigen::Index longer = -1; // the width with a next term
    for (Eigen::Index i = 0; i < d; ++i)
        if (layout.next(i) >= 0)
            longer = i;
    const std::vector<double> net{0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0};
    const auto most_still = longer < 0 ? std::min(d, Eigen::Index{2}) : 1;
    std::vector<Start> moving;
    std::optional<Start> standing;
    std::vector<std::size_t> at(static_cast<std::size_t>(d), 0);
    for (std::size_t i = 0; i < at.size();) {
        Eigen::VectorXd orders(d);
        for (Eigen::Index k = 0; k < d; ++k)
            orders[k] = net[at[static_cast<std::size_t>(k)]];
        const auto still = std::ranges::count(at, std::size_t{0});
        if (still < most_still)
            if (auto start = start_at(layout, rows, longer, orders)) {
                if (still == 0)
                    moving.push_back(std::move(*start));
                else if (!standing || start->left < standing->left)
                    standing = std::move(start);
            }
        for (i = 0; i < at.size() && ++at[i] == net.size(); ++i)
            at[i] = 0;
    }
    const auto sort = [&] {
        std::stable_sort(moving.begin(), moving.end(),
                         [](const Start& l, const Start& r) { return l.left < r.left; });
    };
    sort();
    if (longer >= 0) {
        for (auto& start : std::span(moving).first(std::min(most_moved, moving.size())))
            move_order(layout, rows, longer, start);
        sort();
    }
    std::vector<Eigen::VectorXd> starts;
    for (std::size_t k = 0; k < std::min(most_starts, moving.size()); ++k)
        starts.push_back(moving[k].theta);
    if (standing && (moving.empty() || standing->left < moving.front().left))
        starts.push_back(std::move(standing->theta));
    return starts;
}

Eigen::VectorXd lengthened(const Layout& layout, const TermRows& rows,
                           const Eigen::VectorXd& leading) {
    Eigen::VectorXd theta = Eigen::VectorXd::Zero(layout.size());
    theta.head(leading.size()) = leading;
    if (layout.floor() >= 0)
        theta[layout.floor()] = rows.log_errors.minCoeff() - 1;
    return theta;
}

Eigen::VectorXd lengthened(const Layout& layout, const TermRows& rows, const TermFit& simpler) {
    const Eigen::Index shared = layout.pair(layout.widths() - 1, layout.widths());
    return lengthened(layout, rows, Eigen::VectorXd(simpler.theta.head(shared)));
}

std::vector<Eigen::VectorXd> with_logarithms(const Layout& layout,
                                             std::vector<Eigen::VectorXd> starts) {
    constexpr double part = 0.25; // T stays positive over three halvings to either side
    for (Eigen::Index i = 0; i < layout.widths(); ++i) {
        if (layout.next(i) < 0 || layout.power(i) != TermShape::logarithm)
            continue;
        std::vector<Eigen::VectorXd> of_either_sign;
        for (const auto& start : starts)
            for (const double c : {0.0, -part, part}) {
                of_either_sign.push_back(start);
                of_either_sign.back()[layout.next(i)] = c;
                of_either_sign.back()[2 * i + 1] -= c;
            }
        starts = std::move(of_either_sign);
    }
    return starts;
}

Eigen::VectorXd in_units(const Layout& layout, const TermFit& fit, const Eigen::VectorXd& centre,
                         double log_unit) {
    Eigen::VectorXd theta = fit.theta;
    if (layout.floor() >= 0)
        theta[layout.floor()] += fit.log_unit - log_unit;
    if (layout.saturation() >= 0)
        theta[layout.saturation()] *= std::exp(log_unit - fit.log_unit);
    for (Eigen::Index i = 0; i < layout.widths(); ++i) {
        const double shift = centre[i] - fit.log_centre[i];
        theta[2 * i] += fit.log_unit - log_unit + theta[2 * i + 1] * shift;
        const Eigen::Index k = layout.next(i);
        if (k < 0)
            continue;
        if (layout.power(i) != TermShape::logarithm) {
            theta[k] *= std::exp(layout.power(i) == TermShape::constant ? -theta[2 * i + 1] * shift
                                                                        : layout.power(i) * shift);
            continue;
        }
        // 1 + c ln(x/x₀) = (1 + c ln(x₁/x₀)) (1 + c₁ ln(x/x₁))
        const double part = 1 + theta[k] * shift;
        theta[2 * i] += std::log(part); // NaN where the term has its zero there: no start then
        theta[k] /= part;
    }
    return theta;
}

} // namespace tvbeam

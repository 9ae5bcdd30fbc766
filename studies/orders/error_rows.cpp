#include "studies/orders/error_rows.hpp"

#include "studies/orders/observed_order.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// Which rows have the same widths, of these.
std::map<std::vector<double>, std::vector<Eigen::Index>>
rows_by(const TermRows& rows, const std::vector<Eigen::Index>& widths) {
    std::map<std::vector<double>, std::vector<Eigen::Index>> groups;
    for (Eigen::Index r = 0; r < rows.size(); ++r) {
        const Eigen::VectorXd at = rows.log_widths(r, widths).transpose();
        groups[std::vector<double>(at.begin(), at.end())].push_back(r);
    }
    return groups;
}

constexpr double cancelled = 64 * std::numeric_limits<double>::epsilon();

bool is_as_fine(const ErrorRow& row, const ErrorRow& as) {
    return std::ranges::equal(row.widths, as.widths, std::less_equal());
}

/// ln of the widths and of the error, and the weight.
Eigen::VectorXd log_point(const ErrorRow& row, bool weighted) {
    const auto d = static_cast<Eigen::Index>(row.widths.size());
    Eigen::VectorXd point(d + 2);
    for (Eigen::Index i = 0; i < d; ++i)
        point[i] = std::log(row.widths[static_cast<std::size_t>(i)]);
    point[d] = std::log(row.error);
    point[d + 1] = weighted ? 1 / (row.sigma * row.sigma) : 1.0;
    return point;
}

/// Of the points in one cell, by their weights.
struct CellSum {
    Eigen::VectorXd sum;
    double weight = 0;
    int count = 0;
    double mean = 0, squares = 0; ///< of ln e, by Welford's recurrence
};

} // namespace

bool vanishes_at_the_finest(std::span<const ErrorRow> rows) {
    constexpr double near_rounding = 1e-10;
    double least = infinity;
    double greatest = 0;
    for (const ErrorRow& row : rows)
        if (is_positive(row.error)) {
            least = std::min(least, row.error);
            greatest = std::max(greatest, row.error);
        }
    return least > near_rounding * greatest && std::isfinite(least) &&
           std::ranges::any_of(rows, [&](const ErrorRow& zero) {
               return zero.error == 0 &&
                      std::none_of(rows.rbegin(), rows.rend(), [&](const ErrorRow& other) {
                          return is_positive(other.error) && is_as_fine(other, zero);
                      });
           });
}

std::vector<bool> cancelled_rows(std::span<const ErrorRow> rows) {
    std::vector<bool> result(rows.size(), false);
    std::vector<double> errors;
    for (const ErrorRow& row : rows)
        if (row.widths.size() > 1 && is_positive(row.error))
            errors.push_back(row.error);
    if (errors.empty())
        return result;
    const auto middle = errors.begin() + std::ssize(errors) / 2;
    std::ranges::nth_element(errors, middle);
    const double small = cancelled * *middle;
    for (std::size_t i = 0; i < rows.size(); ++i)
        result[i] = rows[i].error < small &&
                    std::any_of(rows.rbegin(), rows.rend(), [&](const ErrorRow& other) {
                        return std::isfinite(other.error) &&
                               rows[i].error < cancelled * other.error &&
                               is_as_fine(other, rows[i]);
                    });
    return result;
}

TermRows usable_rows(std::span<const ErrorRow> given, std::size_t most_rows) {
    const auto d =
        given.empty() ? Eigen::Index{0} : static_cast<Eigen::Index>(given.front().widths.size());
    const auto is_cancelled = cancelled_rows(given);
    const auto usable = [&](const ErrorRow& row) {
        return is_positive(row.error) &&
               std::all_of(row.widths.begin(), row.widths.end(), is_positive) &&
               !is_cancelled[static_cast<std::size_t>(&row - given.data())];
    };
    const bool stated = std::all_of(given.begin(), given.end(), [&](const ErrorRow& row) {
        return !usable(row) || is_positive(row.sigma);
    });
    std::vector<Eigen::VectorXd> points;
    Eigen::VectorXd least = Eigen::VectorXd::Constant(d, infinity);
    Eigen::VectorXd greatest = -least;
    for (const auto& row : given)
        if (usable(row)) {
            points.push_back(log_point(row, stated));
            least = least.cwiseMin(points.back().head(d));
            greatest = greatest.cwiseMax(points.back().head(d));
        }
    const auto most = static_cast<double>(most_rows);
    const Eigen::VectorXd cell =
        (greatest - least) / std::max(1.0, std::pow(most, 1 / static_cast<double>(d)) - 1);
    std::map<std::vector<double>, CellSum> cells;
    std::vector<double> key(static_cast<std::size_t>(d));
    const bool lattice = points.size() > most_rows;
    for (const auto& point : points) {
        for (Eigen::Index i = 0; i < d; ++i)
            key[static_cast<std::size_t>(i)] =
                lattice && cell[i] > 0 ? std::floor((point[i] - least[i]) / cell[i]) : point[i];
        auto& [sum, weight, count, mean, squares] = cells[key];
        if (count++ == 0)
            sum = Eigen::VectorXd::Zero(d + 1);
        sum += point[d + 1] * point.head(d + 1);
        weight += point[d + 1];
        const double off = point[d] - mean;
        mean += off / count;
        squares += off * (point[d] - mean);
    }
    const auto n = static_cast<Eigen::Index>(cells.size());
    TermRows rows{Eigen::MatrixXd(n, d), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    Eigen::Index r = 0;
    double squares = 0;
    for (const auto& [at, one] : cells) {
        squares += one.squares;
        rows.log_widths.row(r) = one.sum.head(d).transpose() / one.weight;
        rows.log_errors[r] = one.sum[d] / one.weight;
        rows.weights[r++] = one.weight;
    }
    if (n == 0)
        return rows;
    const double mean_weight = rows.weights.mean();
    rows.weights /= mean_weight;
    rows.rounded = stated && std::ranges::all_of(given, &ErrorRow::rounded);
    if (stated)
        rows.scatter = 1 / std::sqrt(mean_weight);
    else if (const auto dof = static_cast<int>(points.size()) - static_cast<int>(n);
             dof > 0 && squares > 0 && !lattice)
        rows.scatter = std::sqrt(squares / dof / mean_weight) * student_over_normal(dof);
    return rows;
}

std::vector<Eigen::Index> moving_widths(const TermRows& rows, double most) {
    std::vector<Eigen::Index> moving;
    for (Eigen::Index i = 0; i < rows.widths(); ++i) {
        std::vector<Eigen::Index> others;
        for (Eigen::Index j = 0; j < rows.widths(); ++j)
            if (j != i)
                others.push_back(j);
        const auto groups = rows_by(rows, others);
        const auto finest = rows.log_widths(Eigen::all, others).colwise().minCoeff().eval();
        const auto at_finest = groups.find(std::vector<double>(finest.begin(), finest.end()));
        const bool is_shown = !others.empty() && at_finest != groups.end() &&
                              at_finest->second.size() >= fewest_levels;
        // One row shows no change, nor that there is none.
        const bool stands = std::ranges::all_of(groups, [&](const auto& group) {
            const auto errors = rows.log_errors(group.second).eval();
            return errors.size() > 1 && errors.maxCoeff() - errors.minCoeff() <= most;
        });
        if (!is_shown || !stands)
            moving.push_back(i);
    }
    return moving;
}

TermRows with_widths(const TermRows& rows, const std::vector<Eigen::Index>& widths) {
    const auto groups = rows_by(rows, widths);
    const auto n = static_cast<Eigen::Index>(groups.size());
    const auto d = static_cast<Eigen::Index>(widths.size());
    TermRows merged{Eigen::MatrixXd(n, d), Eigen::VectorXd(n), Eigen::VectorXd(n), rows.scatter,
                    rows.rounded};
    Eigen::Index r = 0;
    for (const auto& [at, group] : groups) {
        merged.log_widths.row(r) = Eigen::Map<const Eigen::RowVectorXd>(at.data(), d);
        merged.log_errors[r] = rows.log_errors(group).mean();
        merged.weights[r++] = rows.weights(group).mean();
    }
    if (rows.log_reference.size() > 0)
        merged.log_reference = rows.log_reference(widths);
    const auto squares = std::ranges::find(widths, rows.in_squares);
    merged.in_squares = squares == widths.end() ? -1 : squares - widths.begin();
    return merged;
}

std::vector<double> levels_of(Eigen::VectorXd log_widths, double one_level) {
    std::sort(log_widths.begin(), log_widths.end(), std::greater<>());
    std::vector<double> levels;
    for (const double width : log_widths)
        if (levels.empty() || width < levels.back() - std::log(one_level))
            levels.push_back(width);
    return levels;
}

int level_of(const std::vector<double>& levels, double log_width) {
    const auto finer = std::upper_bound(levels.begin(), levels.end(), log_width, std::greater<>());
    return static_cast<int>(finer - levels.begin()) - 1;
}

bool are_refined_apart(const TermRows& rows, const std::vector<std::vector<double>>& levels,
                       Eigen::Index first, Eigen::Index second) {
    const auto& of_first = levels[static_cast<std::size_t>(first)];
    const auto& of_second = levels[static_cast<std::size_t>(second)];
    // Levels that some rows have together, as a graph: which of its parts each belongs to.
    std::vector<std::size_t> part(of_first.size() + of_second.size());
    std::iota(part.begin(), part.end(), std::size_t{0});
    std::size_t parts = part.size();
    std::set<std::pair<int, int>> pairs;
    for (Eigen::Index r = 0; r < rows.size(); ++r) {
        const int one = level_of(of_first, rows.log_widths(r, first));
        const int other = level_of(of_second, rows.log_widths(r, second));
        if (!pairs.emplace(one, other).second)
            continue;
        const std::size_t from = part[static_cast<std::size_t>(one)];
        const std::size_t to = part[of_first.size() + static_cast<std::size_t>(other)];
        if (from == to)
            return true; // a circle
        --parts;
        std::ranges::replace(part, from, to);
    }
    return parts > 1; // drawn apart, and no tree
}

} // namespace tvbeam

#include "studies/orders/error_rows.hpp"

#include "studies/orders/observed_order.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace tvbeam {

TermRows usable_rows(std::span<const ErrorRow> given, std::size_t most_rows) {
    const auto d =
        given.empty() ? Eigen::Index{0} : static_cast<Eigen::Index>(given.front().widths.size());
    const auto usable = [](const ErrorRow& row) {
        return is_positive(row.error) &&
               std::all_of(row.widths.begin(), row.widths.end(), is_positive);
    };
    const bool stated = std::all_of(given.begin(), given.end(), [&](const ErrorRow& row) {
        return !usable(row) || is_positive(row.sigma);
    });
    std::vector<Eigen::VectorXd> points; // ln of the widths and the error, and the weight
    Eigen::VectorXd least = Eigen::VectorXd::Constant(d, infinity);
    Eigen::VectorXd greatest = -least;
    for (const auto& row : given)
        if (usable(row)) {
            Eigen::VectorXd point(d + 2);
            for (Eigen::Index i = 0; i < d; ++i)
                point[i] = std::log(row.widths[static_cast<std::size_t>(i)]);
            point[d] = std::log(row.error);
            point[d + 1] = stated ? 1 / (row.sigma * row.sigma) : 1.0;
            least = least.cwiseMin(point.head(d));
            greatest = greatest.cwiseMax(point.head(d));
            points.push_back(std::move(point));
        }
    const auto most = static_cast<double>(most_rows);
    const Eigen::VectorXd cell =
        (greatest - least) / std::max(1.0, std::pow(most, 1 / static_cast<double>(d)) - 1);
    struct Sum {
        Eigen::VectorXd sum;
        double weight = 0;
        int count = 0;
        double mean = 0, squares = 0; ///< of ln e, by Welford's recurrence
    };
    std::map<std::vector<double>, Sum> cells;
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
    if (stated)
        rows.scatter = 1 / std::sqrt(mean_weight);
    else if (const auto dof = static_cast<int>(points.size()) - static_cast<int>(n);
             dof > 0 && squares > 0 && !lattice)
        rows.scatter = std::sqrt(squares / dof / mean_weight) * student_over_normal(dof);
    return rows;
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

} // namespace tvbeam

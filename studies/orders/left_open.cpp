#include "studies/orders/left_open.hpp"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

namespace tvbeam {

namespace {

/// The least sum of squares of A a + B b − y with 0 ≤ |B| ≤ A. It is convex in A and B: where its
/// least is outside, one of the ends has the least of what is inside.
double least_square(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b, const Eigen::ArrayXd& y) {
    const double aa = a.square().sum();
    const double ab = (a * b).sum();
    const double bb = b.square().sum();
    const double ay = (a * y).sum();
    const double by = (b * y).sum();
    const double all = y.square().sum();
    const double determinant = aa * bb - ab * ab;
    const double leading = ay * bb - by * ab; // times the determinant, as what follows
    const double next = by * aa - ay * ab;
    if (determinant > 0 && leading > 0 && std::abs(next) <= leading)
        return all - (ay * leading + by * next) / determinant;
    const auto at_end = [&](double sign) {
        const double along = ay + sign * by;
        return all - along * along / (aa + 2 * sign * ab + bb);
    };
    return std::min(at_end(1), at_end(-1));
}

/// Of a smooth function over [−1, 1], where it is no more than `most`: how far from 0 that goes, if
/// it is so anywhere. It may have a minimum with a next term of either sign.
std::optional<double> farthest_below(const std::function<double(double)>& square_at, double most) {
    constexpr int steps = 40;
    constexpr int bits = 20;
    std::vector<double> squares;
    const auto at = [](int k) { return 2.0 * k / steps - 1; };
    for (int k = 0; k <= steps; ++k)
        squares.push_back(square_at(at(k)));
    std::optional<double> distance;
    for (int k = 1; k < steps; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (squares[i] > std::min(squares[i - 1], squares[i + 1]))
            continue;
        const auto [best, least] =
            boost::math::tools::brent_find_minima(square_at, at(k - 1), at(k + 1), bits);
        for (const double end : {-1.0, 1.0}) {
            double inside = best;
            double outside = end;
            for (int halving = 0; least <= most && halving < bits; ++halving) {
                const double middle = std::midpoint(inside, outside);
                (square_at(middle) <= most ? inside : outside) = middle;
            }
            if (least <= most)
                distance = std::max(distance.value_or(0), std::abs(inside));
        }
    }
    return distance;
}

/// ln of the width at which the next term is no larger: the finest whose error the digits show.
double log_finest_shown(const TermRows& rows, const Eigen::ArrayXd& sigma, double log_finest) {
    constexpr double is_shown = 0.25; // of an error, its deviation
    double shown = rows.log_widths.col(0).maxCoeff();
    for (Eigen::Index r = 0; r < rows.size(); ++r)
        if (sigma[r] < is_shown)
            shown = std::min(shown, rows.log_widths(r, 0));
    return shown > rows.log_widths.col(0).minCoeff() || std::isnan(log_finest) ? shown : log_finest;
}

} // namespace

double distance_left_open(const TermRows& rows, double log_finest, double order) {
    // Logarithms to the base 2 of how many orders on a next term is: a quarter to a half, or two.
    constexpr double closest = -2;
    constexpr double half_an_order = -1;
    constexpr double farthest = 1;
    constexpr double step = 0.5;            // between two lies one minimum
    constexpr double greatest = 1.1;        // of a next term over the leading one: as large counts
    constexpr double of_four_digits = 3e-4; // these terms are not followed more closely
    constexpr int fitted = 2;               // A and c, for given orders
    constexpr int bits = 12;
    // A leading term alone whose squares are so many times what rounding makes does not follow the
    // rows.
    constexpr double for_certain = 1.25;
    if (rows.widths() != 1 || !rows.rounded || rows.size() <= fitted + 1 || !std::isfinite(order))
        return 0;
    // In 99 of 100 cases the squares of what is uniform, of variance 0.8 each, are no more.
    const auto free = static_cast<double>(rows.size() - fitted);
    const double most = free + 2.326 * std::sqrt(0.8 * free);
    const Eigen::ArrayXd sigma = rows.scatter / rows.weights.array().sqrt();
    const Eigen::ArrayXd x =
        rows.log_widths.col(0).array() - log_finest_shown(rows, sigma, log_finest);
    const Eigen::ArrayXd y = 1 / sigma.max(of_four_digits);
    const Eigen::ArrayXd unit = y * (rows.log_errors.minCoeff() - rows.log_errors.array()).exp();
    const auto square_with = [&](double away, double log_next, double size) {
        const Eigen::ArrayXd leading = unit * ((order + away) * x).exp();
        return least_square(leading, leading * (size * (std::exp2(log_next) * x).exp()), y);
    };
    const bool is_seen_to_move = !farthest_below(
        [&](double away) { return square_with(away, half_an_order, 0); }, for_certain * most);
    const double last = is_seen_to_move ? farthest : half_an_order;
    const auto least_of_next_terms = [&](double away) {
        const auto square_at = [&](double log_next) {
            return square_with(away, log_next, greatest);
        };
        double best = closest;
        double least = square_at(best);
        for (double log_next = closest + step; log_next <= last; log_next += step)
            if (const double square = square_at(log_next); square < least) {
                best = log_next;
                least = square;
            }
        return boost::math::tools::brent_find_minima(square_at, std::max(best - step, closest),
                                                     std::min(best + step, last), bits)
            .second;
    };
    return farthest_below(least_of_next_terms, most).value_or(0);
}

} // namespace tvbeam

#include "mms/expression/agreement.hpp"

#include "mms/text/error_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

namespace tvbeam {

using Eigen::Index;
using Number = Bounded<long double>;

namespace {

constexpr long double roundoff = 0x1p-53L;
constexpr long double spared = 64.0L;
constexpr long double numerically_zero = 1e-25L;

/// The bound where it is one.
long double size_of(const Number& number) {
    return std::isfinite(number.value) && std::isfinite(number.bound) ? number.bound : 0.0L;
}

} // namespace

ComputedValues ComputedValues::of(const Eigen::ArrayXd& values) {
    return {values, Eigen::ArrayXd::Zero(values.size())};
}

Number written(double value) {
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    const auto decimal_value = decimal<long double>(std::string(buffer.data(), end));
    return {decimal_value, std::abs(decimal_value)};
}

Points points_to_compare(double begin, double end, bool with_begin) {
    // The fractional parts of multiples of these fill the unit square evenly: 1/p and 1/p² for the
    // root p of p³ = p + 1.
    constexpr double step_x = 0.7548776662466927;
    constexpr double step_t = 0.5698402909980532;
    std::vector<double> times = {end};
    for (const int k : {1, 2})
        times.push_back(begin + std::fmod(0.5 + k * step_t, 1.0) * (end - begin));
    if (with_begin)
        times.push_back(begin);
    Points points;
    points.x.resize(points_a_time * static_cast<Index>(times.size()));
    points.t.resize(points.x.size());
    for (Index k = 0; k < points.x.size(); ++k) {
        const Index place = k % points_a_time;
        const double inside = std::fmod(0.5 + static_cast<double>(k) * step_x, 1.0);
        points.x(k) = place == 0 ? 0.0 : place == 1 ? 1.0 : inside;
        points.t(k) = times[static_cast<std::size_t>(k / points_a_time)];
    }
    return points;
}

std::optional<Index> first_disagreement(const std::vector<Number>& text,
                                        const ComputedValues& computed,
                                        const std::function<bool(Index)>& counts) {
    long double largest = 0.0L;
    for (const Number& number : text)
        largest = std::max(largest, size_of(number));
    for (Index k = 0; k < computed.values.size(); ++k) {
        const Number& number = text[static_cast<std::size_t>(k)];
        if ((counts && !counts(k)) || !std::isfinite(number.value) || !std::isfinite(number.bound))
            continue;
        const long double tolerance =
            spared * roundoff * (number.bound + std::abs(number.value) + computed.terms(k)) +
            numerically_zero * largest + std::numeric_limits<double>::min();
        if (!(std::abs(computed.values(k) - number.value) <= tolerance))
            return k;
    }
    return std::nullopt;
}

std::string disagreement_text(const std::string& what, double x, double t, double computed,
                              long double text) {
    return fmt::format(
        "{} at x = {:g}, t = {:g} is {:.12g} as it is written, but {:.12g} in the double precision "
        "of a run; write it with fewer or smaller powers, or so that no part of it is far larger "
        "or smaller than the whole",
        what, x, t, text, computed);
}

void require_agreement(const SourceText& source, const std::string& what,
                       const PlainExpression& plain, const std::map<std::string, double>& values,
                       double computed) {
    constexpr long double pi = std::numbers::pi_v<long double>;
    std::map<std::string, BoundedJet<long double>> names = {
        {"pi", BoundedJet<long double>(Number{pi, pi})}};
    for (const auto& [name, value] : values)
        names[name] = BoundedJet<long double>(written(value));
    const Number text = evaluated(plain, names).at(0, 0);
    if (!first_disagreement({text}, ComputedValues::of(Eigen::ArrayXd::Constant(1, computed))))
        return;
    throw InputError(source.begin(), fmt::format("{} is {:.12g} as it is written, but comes out "
                                                 "as {:.12g} in double precision",
                                                 what, text.value, computed));
}

} // namespace tvbeam

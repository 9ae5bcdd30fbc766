#include "reports/plots/readable_axes.hpp"

#include "studies/text/number_text.hpp"

#include <boost/algorithm/string/split.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

namespace tvbeam {

namespace {

/// A number of few digits: so many times a power of ten, without the rounding of a product.
double decimal(std::int64_t times, int power) {
    return number_in(fmt::format("{}e{}", times, power));
}

/// Between ticks: 1, 2 or 5 times a power of ten.
struct Step {
    /// Of two to six in a span.
    explicit Step(double span) : power(static_cast<int>(std::floor(std::log10(span / most)))) {
        for (const int more : {2, 5, 10})
            if (size() < span / most * (1.0 - slack))
                times = more;
    }
    [[nodiscard]] double size() const { return decimal(times, power); }
    [[nodiscard]] double place(std::int64_t number) const { return decimal(number * times, power); }

    static constexpr double most = 6.0;
    static constexpr double slack = 1e-9; ///< of rounding
    int times = 1;
    int power = 0;
};

/// What is best taken off numbers that differ by this span: 0, or a round number near them.
double origin_of(const AxisRange& range, double span) {
    constexpr double far = 1e3;
    if (std::max(std::abs(range.first), std::abs(range.second)) <= far * span)
        return 0.0;
    const int power = static_cast<int>(std::ceil(std::log10(span))) + 1;
    return decimal(std::llround(range.first / decimal(1, power)), power);
}

std::vector<Tick> ticks_of(const Step& step, const AxisRange& range) {
    const auto first = std::llround(std::ceil(range.first / step.size() - Step::slack));
    const auto last = std::llround(std::floor(range.second / step.size() + Step::slack));
    std::vector<double> places;
    for (auto number = first; number <= last; ++number)
        places.push_back(step.place(number));
    const auto texts = alike(places);
    std::vector<Tick> ticks;
    for (std::size_t i = 0; i < places.size(); ++i)
        ticks.push_back({places[i], texts[i]});
    return ticks;
}

/// Whether there are digits to spare between the ends.
bool is_wide(double span) {
    return span > 1e-290 && std::isfinite(span);
}

void make_readable(Axis& axis, AxisRange range) {
    double span = range.second - range.first;
    constexpr double rounding = 1e-13;
    if (span <= rounding * std::max(std::abs(range.first), std::abs(range.second))) {
        span = range.first == 0.0 ? 1.0 : std::abs(range.first);
        range = {range.first - span / 2.0, range.second + span / 2.0};
    }
    if (!is_wide(span))
        return;
    axis.origin = origin_of(range, span);
    if (axis.origin != 0.0)
        axis.title += (axis.origin > 0.0 ? " − " : " + ") + shortest(std::abs(axis.origin));
    range = {range.first - axis.origin, range.second - axis.origin};
    const Step step(span);
    // Data without room around them end at ticks.
    if (!axis.range && axis.room == 0.0)
        range = {step.place(std::llround(std::floor(range.first / step.size() + Step::slack))),
                 step.place(std::llround(std::ceil(range.second / step.size() - Step::slack)))};
    axis.ticks = ticks_of(step, range);
    axis.range = {range.first - axis.room * span, range.second + axis.room * span};
}

/// At these multiples of powers of ten.
std::vector<Tick> decimal_ticks(const AxisRange& range, const std::vector<int>& multiples) {
    std::vector<Tick> ticks;
    if (!(range.first <= range.second))
        return {};
    const int last = static_cast<int>(std::floor(std::log10(range.second)));
    for (int power = static_cast<int>(std::floor(std::log10(range.first))); power <= last; ++power)
        for (const int times : multiples)
            if (const double value = decimal(times, power);
                value >= range.first && value <= range.second)
                ticks.push_back({value, scientific(value, 0)});
    return ticks;
}

void make_logarithmic_readable(Axis& axis, const AxisRange& range) {
    if (powers_of_ten(range).size() > 1 || !(range.first <= range.second))
        return;
    if (!axis.range) { // which is whole decades otherwise, without a number in most of them
        constexpr double one_value = 1.0 + 1e-6;
        const double ratio = range.second / range.first;
        const double room = ratio > one_value ? std::pow(ratio, 0.05) : 2.0;
        axis.range = {range.first / room, range.second * room};
    }
    auto ticks = decimal_ticks(*axis.range, {1, 2, 5});
    if (ticks.size() < 2)
        if (auto even = linear_ticks(*axis.range); !even.empty())
            ticks = std::move(even);
    if (!ticks.empty())
        axis.ticks = std::move(ticks);
}

} // namespace

std::vector<Tick> powers_of_ten(const AxisRange& range) {
    constexpr std::size_t most = 7;
    auto ticks = decimal_ticks(range, {1});
    for (auto& tick : ticks)
        tick.power = static_cast<int>(std::lround(std::log10(tick.value)));
    return thinned(ticks, most);
}

const std::string& field_of(const Row& row, int column) {
    return row.at(static_cast<std::size_t>(column - 1));
}

double number_of(const Row& row, int column) {
    return number_in(field_of(row, column));
}

std::vector<Row> rows_of(const Drawing& drawing, const CurveData& data) {
    std::vector<Row> rows;
    std::istringstream lines(drawing.blocks()[*data.block].rows);
    for (std::string line; std::getline(lines, line);) {
        Row row;
        boost::algorithm::split(row, line, [](char c) { return c == ' '; });
        if (!line.empty() && std::isfinite(number_of(row, data.x)) &&
            std::isfinite(number_of(row, data.y)))
            rows.push_back(std::move(row));
    }
    return rows;
}

AxisRange axis_range(const Drawing& drawing, bool is_x) {
    const Axis& axis = is_x ? drawing.x : drawing.y;
    if (axis.range)
        return *axis.range;
    AxisRange range{std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
    const auto add = [&](double number) {
        if (std::isfinite(number) && (!axis.is_logarithmic || number > 0.0))
            range = {std::min(range.first, number), std::max(range.second, number)};
    };
    for (const auto& curve : drawing.curves()) {
        if (curve.data.height && !is_x)
            add(*curve.data.height);
        if (!curve.data.block)
            continue;
        for (const auto& row : rows_of(drawing, curve.data)) {
            add(number_of(row, is_x ? curve.data.x : curve.data.y));
            if (!is_x && curve.look.kind == CurveLook::Kind::band)
                add(number_of(row, curve.data.third));
        }
    }
    return range;
}

std::vector<Tick> linear_ticks(const AxisRange& range) {
    const double span = range.second - range.first;
    return is_wide(span) ? ticks_of(Step(span), range) : std::vector<Tick>();
}

Drawing with_readable_axes(const Drawing& drawing) {
    Drawing readable = drawing;
    for (const bool is_x : {true, false}) {
        Axis& axis = is_x ? readable.x : readable.y;
        if (axis.ticks)
            continue;
        if (axis.is_logarithmic)
            make_logarithmic_readable(axis, axis_range(drawing, is_x));
        else
            make_readable(axis, axis_range(drawing, is_x));
    }
    for (auto& curve : readable.curves())
        if (curve.data.height)
            *curve.data.height -= readable.y.origin;
    for (auto& label : readable.labels) {
        label.x -= readable.x.origin;
        label.y -= readable.y.origin;
    }
    return readable;
}

} // namespace tvbeam

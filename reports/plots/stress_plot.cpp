#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/stress/stress.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

namespace tvbeam {

namespace {

/// A number that a case has, ≥ 0; infinite for the gap of a beam without stops.
struct Parameter {
    std::string name; ///< for an axis
    std::function<double(const StressParameters&)> value;
};

const std::vector<Parameter>& parameters() {
    static const std::vector<Parameter> all{
        {"thermal expansion α", [](const auto& p) { return std::abs(p.alpha); }},
        {"viscosity ζ", [](const auto& p) { return p.zeta; }},
        {"time step Δt", [](const auto& p) { return p.dt; }},
        {"elements s", [](const auto& p) { return static_cast<double>(p.elements); }},
        {"gap between tip and stop",
         [](const auto& p) { return std::min(-p.stops.lower, p.stops.upper); }},
        {"load", [](const auto& p) { return std::abs(p.load); }},
    };
    return all;
}

/// A parameter's values of all cases as decades of a logarithmic axis: zero stands two decades
/// below the smallest positive value, infinity two above the largest.
class Axis {
public:
    explicit Axis(const Parameter& parameter) : name(parameter.name), value_(parameter.value) {}

    /// Every case, before anything is asked.
    void add(const StressParameters& one) { values_.insert(value_(one)); }

    /// After the last.
    void close() {
        for (const double value : values_)
            if (value > 0.0 && std::isfinite(value)) {
                least = least.value_or(value);
                greatest = value;
            }
        const double low = least ? std::log10(*least) : 0.0;
        const double high = greatest ? std::log10(*greatest) : 0.0;
        const double apart = std::max(1.0, 0.12 * (high - low));
        zero = low - apart;
        infinity = high + apart;
        if (values_.empty())
            return;
        has_zero = *values_.begin() <= 0.0;
        has_infinity = std::isinf(*values_.rbegin());
        begin = place_of_value(*values_.begin());
        end = place_of_value(*values_.rbegin());
    }

    [[nodiscard]] bool varies() const { return end > begin; }
    [[nodiscard]] std::size_t distinct() const { return values_.size(); }

    /// Decimal logarithm of the value of a case.
    [[nodiscard]] double place(const StressParameters& one) const {
        return place_of_value(value_(one));
    }

    /// The fifth of the axis that a place lies in.
    [[nodiscard]] int bin(double place) const {
        constexpr int bins = 5;
        return std::min(bins - 1, static_cast<int>(bins * (place - begin) / (end - begin)));
    }

    [[nodiscard]] std::string ticks() const {
        std::string text;
        const auto add = [&text](const std::string& label, double place) {
            text += fmt::format("{}'{}' {}", text.empty() ? "" : ", ", label, place);
        };
        if (has_zero)
            add("0", zero);
        if (least) {
            const int first = static_cast<int>(std::ceil(std::log10(*least) - 1e-9));
            const int last = static_cast<int>(std::floor(std::log10(*greatest) + 1e-9));
            const int step = std::max(1, (last - first + 4) / 5);
            for (int power = first; power <= last; power += step)
                add(fmt::format("10^{{{}}}", power), power);
        }
        if (has_infinity)
            add("none", infinity);
        return "(" + text + ")";
    }

    std::string name;
    double begin = 0.0;
    double end = 0.0;

private:
    [[nodiscard]] double place_of_value(double value) const {
        return value <= 0.0 ? zero : std::isinf(value) ? infinity : std::log10(value);
    }

    std::function<double(const StressParameters&)> value_;
    std::set<double> values_;
    std::optional<double> least;
    std::optional<double> greatest;
    bool has_zero = false;
    bool has_infinity = false;
    double zero = 0.0;
    double infinity = 0.0;
};

/// What became of a case: its outcome, and by quarters how near its checks came to a limit.
std::pair<Outcome, int> fate_of(const StressCase& one) {
    constexpr double quarters = 4.0;
    const double closeness = one.checks ? one.checks->closeness(one.parameters.stops.exist()) : 0.0;
    return {one.outcome, static_cast<int>(std::clamp(quarters * closeness, 0.0, quarters))};
}

using Fate = std::pair<Outcome, int>;

/// How many cases of each fate lie in each fifth of two axes.
using Cells = std::map<std::pair<int, int>, std::map<Fate, double>>;

/// What the fifths of two axes together tell of the cases' fates: their mutual information, in
/// nats.
double information(const Cells& cells) {
    std::map<Fate, double> all;
    double total = 0.0;
    for (const auto& [place, counts] : cells)
        for (const auto& [fate, count] : counts) {
            all[fate] += count;
            total += count;
        }
    double sum = 0.0;
    for (const auto& [place, counts] : cells) {
        double inside = 0.0;
        for (const auto& [fate, count] : counts)
            inside += count;
        for (const auto& [fate, count] : counts)
            sum += count / total * std::log(count * total / (inside * all[fate]));
    }
    return sum;
}

/// Of the parameters that vary.
std::vector<Axis> axes_of(const StressCases& cases) {
    std::vector<Axis> axes;
    for (const auto& parameter : parameters())
        axes.emplace_back(parameter);
    cases.visit([&](const StressCase& one) {
        for (auto& axis : axes)
            axis.add(one.parameters);
    });
    for (auto& axis : axes)
        axis.close();
    std::erase_if(axes, [](const Axis& axis) { return !axis.varies(); });
    return axes;
}

/// The two axes that tell most; none where fewer than two parameters vary. Where outcomes tell
/// nothing, all being alike, the two with the most different values.
std::optional<std::pair<Axis, Axis>> most_telling(const StressCases& cases) {
    const std::vector<Axis> axes = axes_of(cases);
    std::map<std::pair<std::size_t, std::size_t>, Cells> cells;
    std::vector<int> bins(axes.size());
    cases.visit([&](const StressCase& one) {
        const Fate fate = fate_of(one);
        for (std::size_t k = 0; k < axes.size(); ++k)
            bins[k] = axes[k].bin(axes[k].place(one.parameters));
        for (std::size_t i = 0; i < axes.size(); ++i)
            for (std::size_t j = i + 1; j < axes.size(); ++j)
                ++cells[{i, j}][{bins[i], bins[j]}][fate];
    });
    std::optional<std::pair<Axis, Axis>> best;
    std::pair<double, double> most{-1.0, -1.0};
    for (const auto& [pair, counts] : cells) {
        const auto& [i, j] = pair;
        // Differences of round-off size are none.
        const std::pair<double, double> told{
            std::round(1e9 * information(counts)),
            static_cast<double>(axes[i].distinct() * axes[j].distinct())};
        if (told > most) {
            most = told;
            best.emplace(axes[i], axes[j]);
        }
    }
    return best;
}

/// Of cases that are not certified: colour, gnuplot's number of a point, its size.
struct OutcomeStyle {
    const char* colour;
    int point;
    double size;
};

OutcomeStyle style_of(Outcome outcome) {
    switch (outcome) {
    case Outcome::refused:
        return {"#E69F00", 8, 1.1};
    case Outcome::stopped:
        return {"#000000", 2, 1.0};
    default:
        return {"#D55E00", 4, 1.5};
    }
}

/// What the cases of an outcome at one place are together.
struct Place {
    int count = 0;
    double closeness = 0.0; ///< the greatest of those that were checked
};
using Places = std::map<std::pair<double, double>, Place>;

std::map<Outcome, Places> places_of(const StressCases& cases, const Axis& x, const Axis& y) {
    std::map<Outcome, Places> places;
    cases.visit([&](const StressCase& one) {
        Place& place = places[one.outcome][{x.place(one.parameters), y.place(one.parameters)}];
        ++place.count;
        if (one.checks)
            place.closeness =
                std::max(place.closeness, one.checks->closeness(one.parameters.stops.exist()));
    });
    return places;
}

/// Certified cases, each place in the colour of how near its checks came to a limit, the nearest on
/// top; the others by marks.
void add_outcome(Drawing& drawing, Outcome outcome, std::size_t count, const Places& places,
                 const Axis& x, const Axis& y) {
    std::vector<std::pair<std::pair<double, double>, Place>> sorted(places.begin(), places.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
        return a.second.closeness < b.second.closeness;
    });
    std::string rows;
    for (const auto& [at, place] : sorted)
        rows += fmt::format("{} {} {} {}\n", at.first, at.second, place.count, place.closeness);
    const std::string block = drawing.add_block(
        fmt::format("{}: log10 of {}, of {}, number of cases, greatest check over its limit",
                    name_of(outcome), x.name, y.name),
        rows);
    const OutcomeStyle style = style_of(outcome);
    const std::string title = fmt::format("{}: {}", name_of(outcome), count);
    if (outcome == Outcome::certified)
        drawing.add_curve(block + " using 1:2:4 with points pt 7 ps 0.8 lc palette", title);
    else
        drawing.add_curve(fmt::format("{} using 1:2 with points pt {} ps {} lc rgb '{}' lw 1.6",
                                      block, style.point, style.size, style.colour),
                          title);
}

} // namespace

std::vector<Plot> stress_plots(const StudyResult& result) {
    const auto* stress = result.get<StressResult>();
    if (stress == nullptr || stress->cases.empty())
        return {};
    const auto& cases = stress->cases;
    const auto axes = most_telling(cases);
    if (!axes)
        return {};
    const auto& [x, y] = *axes;
    Drawing drawing;
    for (const auto& [outcome, places] : places_of(cases, x, y))
        add_outcome(drawing, outcome, cases.count(outcome), places, x, y);
    const double room_x = 0.06 * (x.end - x.begin);
    const double room_y = 0.06 * (y.end - y.begin);
    const std::string settings =
        fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nset xtics {}\nset ytics {}\n"
                    "set xlabel {} noenhanced\nset ylabel {} noenhanced\nset grid\n"
                    // From yellow, far from every limit, to dark: alike in grey.
                    "set palette defined (0 '#FDE725', 0.25 '#5EC962', 0.5 '#21918C', 0.75 "
                    "'#3B528B', 1 '#440154')\nset cbrange [0:1]\n"
                    "set cblabel 'greatest check over its limit'\n",
                    x.begin - room_x, x.end + room_x, y.begin - room_y, y.end + room_y, x.ticks(),
                    y.ticks(), gnuplot_text(x.name), gnuplot_text(y.name));
    return {drawing.plot(
        "stress_outcomes",
        fmt::format("Outcomes of {} cases over the two parameters that tell most about them, "
                    "{} and {}, on logarithmic axes. The colour of certified ones says how near "
                    "the nearest of their checks comes to its limit, 1.",
                    cases.size(), x.name, y.name),
        settings)};
}

} // namespace tvbeam

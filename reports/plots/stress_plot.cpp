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
class Decades {
public:
    explicit Decades(const Parameter& parameter) : name(parameter.name), value_(parameter.value) {}

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

    [[nodiscard]] std::vector<Tick> ticks() const {
        std::vector<Tick> all;
        if (has_zero)
            all.push_back({zero, "0"});
        if (least) {
            const int first = static_cast<int>(std::ceil(std::log10(*least) - 1e-9));
            const int last = static_cast<int>(std::floor(std::log10(*greatest) + 1e-9));
            const int step = std::max(1, (last - first + 4) / 5);
            for (int power = first; power <= last; power += step)
                all.push_back({static_cast<double>(power), "", power});
        }
        if (has_infinity)
            all.push_back({infinity, "none"});
        return all;
    }

    /// As it is drawn.
    [[nodiscard]] Axis drawn() const {
        const double room = 0.06 * (end - begin);
        return {.title = name, .range = {{begin - room, end + room}}, .ticks = ticks()};
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
std::vector<Decades> axes_of(const StressCases& cases) {
    std::vector<Decades> axes;
    for (const auto& parameter : parameters())
        axes.emplace_back(parameter);
    cases.visit([&](const StressCase& one) {
        for (auto& axis : axes)
            axis.add(one.parameters);
    });
    for (auto& axis : axes)
        axis.close();
    std::erase_if(axes, [](const Decades& axis) { return !axis.varies(); });
    return axes;
}

/// The two axes that tell most; none where fewer than two parameters vary. Where outcomes tell
/// nothing, all being alike, the two with the most different values.
std::optional<std::pair<Decades, Decades>> most_telling(const StressCases& cases) {
    const std::vector<Decades> axes = axes_of(cases);
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
    std::optional<std::pair<Decades, Decades>> best;
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

CurveLook look_of(Outcome outcome) {
    using Kind = CurveLook::Kind;
    switch (outcome) {
    case Outcome::certified:
        return {.kind = Kind::shades, .point = 7, .size = 0.8};
    case Outcome::refused:
        return {.kind = Kind::points, .colour = "#E69F00", .point = 8, .size = 1.1};
    case Outcome::stopped:
        return {.kind = Kind::points, .colour = "#000000", .point = 2, .size = 1.0};
    default:
        return {.kind = Kind::points, .colour = "#D55E00", .point = 4, .size = 1.5};
    }
}

/// What the cases of an outcome at one place are together.
struct Place {
    int count = 0;
    double closeness = 0.0; ///< the greatest of those that were checked
};
using Places = std::map<std::pair<double, double>, Place>;

std::map<Outcome, Places> places_of(const StressCases& cases, const Decades& x, const Decades& y) {
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
                 const Decades& x, const Decades& y) {
    std::vector<std::pair<std::pair<double, double>, Place>> sorted(places.begin(), places.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
        return a.second.closeness < b.second.closeness;
    });
    std::string rows;
    for (const auto& [at, place] : sorted)
        rows += fmt::format("{} {} {} {}\n", at.first, at.second, place.count, place.closeness);
    const std::size_t block = drawing.add_block(
        fmt::format("{}: log10 of {}, of {}, number of cases, greatest check over its limit",
                    name_of(outcome), x.name, y.name),
        rows);
    drawing.add_curve({.block = block, .third = outcome == Outcome::certified ? 4 : 0},
                      look_of(outcome), fmt::format("{}: {}", name_of(outcome), count));
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
    drawing.x = x.drawn();
    drawing.y = y.drawn();
    drawing.scale = "greatest check over its limit";
    return {
        {"stress_outcomes",
         fmt::format("Outcomes of {} cases over the two parameters that tell most about them, "
                     "{} and {}, on logarithmic axes. The colour of certified ones says how near "
                     "the nearest of their checks comes to its limit, 1.",
                     cases.size(), x.name, y.name),
         drawing}};
}

} // namespace tvbeam

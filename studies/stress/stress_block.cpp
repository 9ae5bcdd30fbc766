#include "studies/stress/stress_block.hpp"

#include "core/certify/stated_scheme.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/scene/study_keys.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace tvbeam {

namespace {

constexpr std::int64_t most_cases = 2'000'000; // of all sweeps
constexpr std::size_t longest_list = 65'535;   // StressSweep counts in 16 bits
constexpr std::int64_t most_work = 10'000'000'000;

using Axis = StressAxis;

template <typename Value>
Axis axis_of(std::vector<Value> values, Value StressParameters::*member) {
    return {values.size(), [values, member](StressParameters& parameters, std::size_t i) {
                parameters.*member = values[i];
            }};
}

enum class Admitted { all, not_negative, positive };

/// Numbers of a range, one at least.
std::vector<double> numbers(TableReader& table, const char* key, double otherwise, Admitted range,
                            TableReader::Infinity infinity = TableReader::Infinity::refused) {
    auto values = table.numbers(key, infinity).value_or(std::vector<double>{otherwise});
    if (values.empty())
        throw table.error(key, " is empty; it must hold a value");
    for (std::size_t i = 0; i < values.size(); ++i)
        if (range != Admitted::all &&
            !(range == Admitted::positive ? values[i] > 0.0 : values[i] >= 0.0))
            throw table.error(key,
                              " holds " + message_text(values[i]) +
                                  (range == Admitted::positive ? "; its values must be > 0"
                                                               : "; its values must be >= 0"),
                              i);
    return values;
}

std::vector<std::int64_t> elements_or_ten(TableReader& table) {
    return table.has("elements") ? read_elements(table) : std::vector<std::int64_t>{10};
}

std::int64_t count(TableReader& table, const char* key, std::int64_t otherwise,
                   std::int64_t greatest) {
    const std::int64_t value = table.integer(key).value_or(otherwise);
    if (value < 1 || value > greatest)
        throw table.error(key, " is " + std::to_string(value) + "; it must be 1 to " +
                                   std::to_string(greatest));
    return value;
}

/// Words out of the choices, as their indices.
std::vector<std::size_t> words(TableReader& table, const char* key,
                               const std::vector<std::string>& choices) {
    const auto given = table.texts(key).value_or(std::vector<std::string>{choices.front()});
    std::string known;
    for (const auto& choice : choices)
        known += (known.empty() ? "'" : ", '") + choice + "'";
    if (given.empty())
        throw table.error(key, " is empty; it must hold some of " + known);
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const auto found = std::find(choices.begin(), choices.end(), given[i]);
        if (found == choices.end())
            throw table.error(key, " holds '" + given[i] + "'; its values must be of " + known, i);
        indices.push_back(static_cast<std::size_t>(found - choices.begin()));
    }
    return indices;
}

template <typename Value>
std::vector<Value> of_words(TableReader& table, const char* key,
                            const std::vector<std::string>& choices,
                            const std::vector<Value>& values) {
    std::vector<Value> result;
    for (const std::size_t index : words(table, key, choices))
        result.push_back(values[index]);
    return result;
}

std::vector<ThermalMass> read_mass(TableReader& table) {
    return of_words<ThermalMass>(table, "thermal_mass", {"consistent", "lumped"},
                                 {ThermalMass::consistent, ThermalMass::lumped});
}

std::vector<std::string> read_time(TableReader& table) {
    return of_words(table, "time", stated_schemes(), stated_schemes());
}

Axis gap_axis(const std::vector<double>& gaps, const std::vector<std::size_t>& sides) {
    std::vector<Stops> stops;
    for (const double gap : gaps)
        for (const std::size_t side : sides) {
            const double none = std::numeric_limits<double>::infinity();
            stops.push_back({side == 2 ? -none : -gap, side == 1 ? none : gap});
            if (std::isinf(gap))
                break; // no stops have no sides
        }
    return axis_of(stops, &StressParameters::stops);
}

std::vector<Axis> read_axes(TableReader& table) {
    std::vector<Axis> axes;
    axes.push_back(
        axis_of(numbers(table, "alpha", 0.5, Admitted::not_negative), &StressParameters::alpha));
    axes.push_back(
        axis_of(numbers(table, "zeta", 0.1, Admitted::not_negative), &StressParameters::zeta));
    axes.push_back(axis_of(numbers(table, "dt", 0.01, Admitted::positive), &StressParameters::dt));
    axes.push_back(axis_of(elements_or_ten(table), &StressParameters::elements));
    const double none = std::numeric_limits<double>::infinity();
    const auto gaps =
        numbers(table, "gap", none, Admitted::positive, TableReader::Infinity::allowed);
    axes.push_back(gap_axis(gaps, words(table, "sides", {"both", "lower", "upper"})));
    axes.push_back(
        axis_of(numbers(table, "load", 1.0, Admitted::not_negative), &StressParameters::load));
    axes.push_back(
        axis_of(of_words<InitialData>(table, "initial", {"zero", "smooth", "rough", "random"},
                                      {InitialData::zero, InitialData::smooth, InitialData::rough,
                                       InitialData::random}),
                &StressParameters::initial));
    axes.push_back(axis_of(read_time(table), &StressParameters::time));
    axes.push_back(axis_of(read_mass(table), &StressParameters::thermal_mass));
    axes.push_back(axis_of(of_words<Algorithm>(table, "algorithm", {"direct", "fixed-point"},
                                               {Algorithm::direct, Algorithm::fixed_point}),
                           &StressParameters::algorithm));
    axes.push_back(
        axis_of(numbers(table, "theta_A", 0.0, Admitted::all), &StressParameters::theta_A));
    return axes;
}

/// left: how many cases all sweeps together may have still.
StressSweep read_sweep(TableReader table, const std::string& name, std::int64_t left) {
    std::vector<Axis> axes = read_axes(table);
    const auto sampling = table.choice("sampling", {"each", "product", "sobol"}).value_or(0);
    const std::int64_t steps = count(table, "steps", 20, most_work);
    const std::int64_t work = count(table, "work", 2'000'000, most_work);
    const std::int64_t points = count(table, "points", 100, most_cases);
    if (sampling != 2 && table.has("points"))
        throw table.error("points", " belongs to sampling = \"sobol\"; remove it");
    double all = 1.0;
    for (const auto& axis : axes) {
        all *= static_cast<double>(axis.values);
        if (axis.values > longest_list)
            throw InputError(table.place(""), "a list of '" + name + "' makes more than " +
                                                  std::to_string(longest_list) +
                                                  " values; shorten it");
    }
    if (sampling == 1 && all > static_cast<double>(most_cases))
        throw InputError(table.place("sampling"), "the product of the lists has more than " +
                                                      std::to_string(most_cases) +
                                                      " cases; shorten them, or take \"sobol\"");
    double cases = sampling == 2 ? static_cast<double>(points) : sampling == 1 ? all : 1.0;
    if (sampling == 0)
        for (const auto& axis : axes)
            cases += static_cast<double>(axis.values - 1);
    if (cases > static_cast<double>(left))
        throw InputError(table.place(""), "'" + name + "' makes them more than " +
                                              std::to_string(most_cases) +
                                              " cases, which all sweeps together may have; "
                                              "shorten its lists");
    table.finish();

    return {name,
            std::move(axes),
            static_cast<Sampling>(sampling),
            static_cast<std::size_t>(points),
            steps,
            work};
}

double single(TableReader& table, const char* key, double otherwise, bool positive) {
    const double value = table.number(key).value_or(otherwise);
    if (!(positive ? value > 0.0 : value >= 0.0))
        throw table.error(key, " is " + message_text(value) +
                                   (positive ? "; it must be > 0" : "; it must be >= 0"));
    return value;
}

/// Points in equal ratios: { from, to, count }.
std::vector<double> geometric(TableReader& table, const char* key) {
    auto range = table.table(key);
    if (!range)
        throw table.error(key, " is missing; give { from = …, to = …, count = … }");
    for (const char* end : {"from", "to"})
        if (!range->has(end))
            throw range->error(end, " is missing; give { from = …, to = …, count = … }");
    const double from = single(*range, "from", 0.0, true);
    const double to = single(*range, "to", 0.0, true);
    const auto points = count(*range, "count", 20, 1000);
    if (points == 1 && from != to)
        throw range->error("count", " is 1, of a range of more than one value; make it 2 or more, "
                                    "or to the same as from");
    range->finish();
    std::vector<double> values{from};
    for (std::int64_t i = 1; i + 1 < points; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(points - 1);
        const double ratio = to / from;
        values.push_back(std::isnormal(ratio) ? from * std::pow(ratio, part)
                                              : std::pow(from, 1.0 - part) * std::pow(to, part));
    }
    if (points > 1)
        values.push_back(to);
    return values;
}

std::string read_one_time(TableReader& table, const std::vector<std::string>& names) {
    return names[table.choice("time", names).value_or(0)];
}

ThermalMass read_one_mass(TableReader& table) {
    return table.choice("thermal_mass", {"consistent", "lumped"}).value_or(0) == 0
               ? ThermalMass::consistent
               : ThermalMass::lumped;
}

ContractionBlock read_contraction(TableReader table) {
    ContractionBlock block;
    block.alpha = geometric(table, "alpha");
    block.dt = geometric(table, "dt");
    block.zeta = single(table, "zeta", 0.1, false);
    block.elements = count(table, "elements", 20, 10'000);
    block.time = read_one_time(table, TimeScheme::names());
    block.thermal_mass = read_one_mass(table);
    table.finish();
    return block;
}

RoundOffBlock read_roundoff(TableReader table) {
    RoundOffBlock block;
    block.alpha = single(table, "alpha", 0.3, true);
    block.zeta = single(table, "zeta", 0.1, false);
    block.dt = single(table, "dt", 1e-3, true);
    block.steps = count(table, "steps", 3, 1'000'000);
    block.time = read_one_time(table, stated_schemes());
    block.thermal_mass = read_one_mass(table);
    block.elements = elements_or_ten(table);
    block.finest_hermite = count(table, "finest_hermite", 10'000, most_elements);
    table.finish();
    return block;
}

} // namespace

std::size_t StressBlock::cases() const {
    std::size_t count = 0;
    for (const auto& sweep : sweeps)
        count += sweep.size();
    return count;
}

StressParameters StressBlock::case_at(std::size_t index) const {
    auto sweep = sweeps.begin();
    for (; index >= sweep->size(); ++sweep)
        index -= sweep->size();
    return sweep->at(index);
}

StressBlock read_stress(TableReader& table) {
    StressBlock block;
    if (auto sweeps = table.table("sweep")) {
        for (const auto& name : sweeps->unread())
            block.sweeps.push_back(read_sweep(
                *sweeps->table(name), name, most_cases - static_cast<std::int64_t>(block.cases())));
        sweeps->finish();
    }
    if (auto contraction = table.table("contraction"))
        block.contraction = read_contraction(*std::move(contraction));
    if (auto roundoff = table.table("roundoff"))
        block.roundoff = read_roundoff(*std::move(roundoff));
    table.finish();
    if (block.sweeps.empty() && !block.contraction && !block.roundoff)
        throw InputError(table.place(""),
                         "the block [stress] asks for nothing; add [stress.sweep.NAME], "
                         "[stress.contraction] or [stress.roundoff]");
    return block;
}

} // namespace tvbeam

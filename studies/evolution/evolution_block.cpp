#include "studies/evolution/evolution_block.hpp"

#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tvbeam {

namespace {

using Quantity = Probe::Quantity;

/// Numbers that a result may hold: 800 MB.
constexpr double most_values = 1e8;

/// Each is compared with all others, and looked at in every step.
constexpr std::size_t most_probes = 1000;

std::optional<double> position(const std::string& text) {
    double x = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, x);
    // Not a number is not between 0 and 1 either.
    return error == std::errc() && stop == end && x >= 0.0 && x <= 1.0 ? std::optional(x)
                                                                       : std::nullopt;
}

Probe read_probe(const std::string& name, const Place& place) {
    if (name == "stress")
        return {Quantity::stress};
    if (name == "energy")
        return {Quantity::energy};
    const std::size_t at = name.find('@');
    const std::string quantity = name.substr(0, at);
    if (quantity != "theta" && quantity != "u")
        throw InputError(place, "unknown probe '" + name + "'" +
                                    did_you_mean(quantity, {"theta", "u", "stress", "energy"}) +
                                    "; a probe is theta@X or u@X, with X between 0 and 1, stress "
                                    "or energy");
    const auto x = at == std::string::npos ? std::nullopt : position(name.substr(at + 1));
    if (!x)
        throw InputError(place, "the probe '" + name + "' must say where it stands: " + quantity +
                                    "@X with X between 0 and 1, e.g. " + quantity + "@0.5");
    return {quantity == "u" ? Quantity::deflection : Quantity::temperature, *x};
}

std::vector<NamedProbe> read_probes(TableReader& table) {
    const auto names = table.texts("probes");
    if (!names || names->empty())
        throw table.error("probes",
                          " is missing or empty; name what to look at, e.g. [\"theta@0.5\", "
                          "\"u@1\", \"stress\", \"energy\"]");
    if (names->size() > most_probes)
        throw table.error("probes", " names " + std::to_string(names->size()) +
                                        "; an evolution has at most " +
                                        std::to_string(most_probes));
    std::vector<NamedProbe> probes;
    for (std::size_t i = 0; i < names->size(); ++i) {
        const std::string& name = (*names)[i];
        if (std::find(names->begin(), names->begin() + static_cast<std::ptrdiff_t>(i), name) !=
            names->begin() + static_cast<std::ptrdiff_t>(i))
            throw table.error("probes", " names '" + name + "' twice; remove one", i);
        const Probe probe = read_probe(name, table.place("probes", i));
        for (const auto& other : probes)
            if (other.probe.quantity == probe.quantity && other.probe.x == probe.x)
                throw InputError(table.place("probes", i), "the probe '" + name +
                                                               "' is the same as '" + other.name +
                                                               "'; remove one");
        probes.push_back({name, probe});
    }
    return probes;
}

Rung read_rung(TableReader& table, double final_time) {
    const auto elements = table.integer("elements");
    if (!elements || *elements < 1 || *elements > most_elements)
        throw table.error("elements",
                          (elements ? " is " + std::to_string(*elements) : " is missing") +
                              "; a mesh has 1 to " + std::to_string(most_elements) + " elements");
    const auto dt = table.number("dt");
    if (!dt)
        throw table.error("dt", " is missing; give the length of a step");
    return {*elements, steps_of(table, 0, final_time, *dt), *dt};
}

/// How many steps lie between two samples.
std::int64_t read_every(TableReader& table, const EvolutionBlock& block) {
    const std::int64_t every = table.integer("every").value_or(1);
    if (every < 1 || block.rung.steps % every != 0)
        throw table.error("every", " is " + std::to_string(every) +
                                       "; it must be >= 1 and divide the " +
                                       std::to_string(block.rung.steps) + " steps");
    const auto samples = 1.0 + static_cast<double>(block.rung.steps) / static_cast<double>(every);
    const double values = samples * static_cast<double>(block.probes.size());
    if (values > most_values)
        throw InputError(table.place("every"),
                         "the samples would hold " + message_text(values) +
                             " numbers, and at most 1e8 are kept; give a larger " +
                             table.full("every"));
    return every;
}

std::optional<std::int64_t> read_period(TableReader& table, const EvolutionBlock& block) {
    const auto period = table.number("period");
    if (!period)
        return std::nullopt;
    const double samples = *period / (block.rung.dt * static_cast<double>(block.every));
    const double whole = std::round(samples);
    if (!(whole >= 1.0 && std::abs(samples - whole) <= 1e-9 * whole))
        throw table.error("period", " is " + message_text(*period) +
                                        "; it must be a whole number of samples, not " +
                                        message_text(samples));
    if (!(2.0 * *period <= block.final_time * (1.0 + 1e-9)))
        throw table.error("period", " is " + message_text(*period) +
                                        "; two of them must fit into final_time = " +
                                        message_text(block.final_time) + " to be compared");
    return static_cast<std::int64_t>(whole) * block.every;
}

} // namespace

std::vector<Probe> EvolutionBlock::quantities() const {
    std::vector<Probe> all;
    all.reserve(probes.size());
    for (const auto& named : probes)
        all.push_back(named.probe);
    return all;
}

EvolutionBlock read_evolution(TableReader& table) {
    EvolutionBlock block;
    block.final_time = read_final_time(table, {});
    block.rung = read_rung(table, block.final_time);
    block.probes = read_probes(table);
    block.every = read_every(table, block);
    block.period = read_period(table, block);
    table.finish();
    return block;
}

} // namespace tvbeam

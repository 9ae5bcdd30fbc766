#include "studies/work_precision/work_precision_block.hpp"

#include "studies/scene/scheme_keys.hpp"
#include "studies/scene/toml_reader.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

constexpr std::int64_t most_runs = 10'000;
/// In bytes. Names stand in tables of 80 columns.
constexpr std::size_t longest_name = 28;

std::string default_name(const Scheme& scheme) {
    return scheme.time.name + ", " + name_of(scheme.algorithm) +
           (scheme.thermal_mass == ThermalMass::lumped ? ", lumped" : "");
}

std::string read_name(TableReader& table, const Scheme& scheme,
                      const std::vector<TimedScheme>& others) {
    std::string name = table.text("name").value_or(default_name(scheme));
    if (name.empty() || name.size() > longest_name)
        throw InputError(table.place("name"),
                         table.full("name") + " has " + std::to_string(name.size()) +
                             " characters; it must have 1 to " + std::to_string(longest_name));
    if (std::any_of(name.begin(), name.end(),
                    [](char c) { return static_cast<unsigned char>(c) < ' '; }))
        throw InputError(table.place("name"), table.full("name") + " must be one line of text");
    if (std::any_of(others.begin(), others.end(),
                    [&](const TimedScheme& other) { return other.name == name; }))
        throw InputError(table.place("name"), "two schemes are called '" + name + "'; give " +
                                                  table.full("name") + " another value");
    return name;
}

std::vector<TimedScheme> read_schemes(TableReader& block, double final_time,
                                      const Scheme& defaults) {
    std::vector<TimedScheme> schemes;
    for (auto& table : block.tables("scheme")) {
        TimedScheme timed;
        timed.scheme = read_scheme_keys(table, defaults);
        timed.name = read_name(table, timed.scheme, schemes);
        timed.rungs = read_rungs(table, final_time);
        table.finish();
        schemes.push_back(std::move(timed));
    }
    if (schemes.empty())
        throw InputError(block.place("scheme"),
                         block.full("scheme") + " is missing; add a block [[" +
                             block.full("scheme") + "]] for each scheme to time");
    return schemes;
}

/// Errors to reach may stand there for norms that are not asked for, e.g. after --set
/// work_precision.norms=…
std::map<std::string, std::vector<double>> read_targets(TableReader table,
                                                        const std::vector<Norm>& norms) {
    std::map<std::string, std::vector<double>> targets;
    for (const auto& root : Norm::names())
        for (const auto& name : {root, root + "_sq"}) {
            const auto errors = Norm::named(name) ? table.numbers(name) : std::nullopt;
            if (!errors)
                continue;
            for (std::size_t i = 0; i < errors->size(); ++i)
                if (!((*errors)[i] > 0.0))
                    throw InputError(table.place(name, i), table.full(name) + " holds " +
                                                               message_text((*errors)[i]) +
                                                               "; an error to reach is > 0");
            if (std::any_of(norms.begin(), norms.end(),
                            [&](const Norm& norm) { return norm.name == name; }))
                targets[name] = *errors;
        }
    table.finish();
    return targets;
}

} // namespace

WorkPrecisionBlock read_work_precision(TableReader table, const Scheme& scheme) {
    WorkPrecisionBlock block;
    block.final_time = read_final_time(table);
    block.norms = read_norms(table);
    if (block.norms.empty())
        throw InputError(table.place("norms"),
                         table.full("norms") +
                             " is missing or empty; name the norms that the schemes are timed for");
    const std::int64_t runs = table.integer("runs").value_or(block.runs);
    if (runs < 1 || runs > most_runs)
        throw InputError(table.place("runs"), table.full("runs") + " is " + std::to_string(runs) +
                                                  "; it must be 1 to " + std::to_string(most_runs));
    block.runs = static_cast<int>(runs);
    if (auto targets = table.table("targets"))
        block.targets = read_targets(*std::move(targets), block.norms);
    block.schemes = read_schemes(table, block.final_time, scheme);
    table.finish();
    return block;
}

} // namespace tvbeam

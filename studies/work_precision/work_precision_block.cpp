#include "studies/work_precision/work_precision_block.hpp"

#include "mms/text/toml_reader.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

constexpr std::int64_t most_timed_runs = 10'000;
constexpr std::size_t most_schemes = 1000;
/// In bytes. Names stand in tables of 80 columns.
constexpr std::size_t longest_name = 28;

std::string read_name(TableReader& table, const Method& method,
                      const std::vector<TimedScheme>& others) {
    const auto given = table.text("name");
    std::string name = given.value_or(method.name);
    if (!given && name.size() > longest_name)
        throw table.error("name", " is missing, and what its keys make of it, '" + name +
                                      "', is longer than " + std::to_string(longest_name) +
                                      " characters; give it a name");
    if (name.empty() || name.size() > longest_name)
        throw table.error("name", " has " + std::to_string(name.size()) +
                                      " characters; it must have 1 to " +
                                      std::to_string(longest_name));
    if (std::any_of(name.begin(), name.end(),
                    [](char c) { return static_cast<unsigned char>(c) < ' '; }))
        throw table.error("name", " must be one line of text");
    if (std::any_of(others.begin(), others.end(),
                    [&](const TimedScheme& other) { return other.name == name; }))
        throw InputError(table.place("name"), "two schemes are called '" + name + "'; give " +
                                                  table.full("name") + " another value");
    return name;
}

std::vector<TimedScheme> read_schemes(TableReader& block, double final_time,
                                      const SolverKeys& keys) {
    std::vector<TimedScheme> schemes;
    auto tables = block.tables("scheme");
    if (tables.size() > most_schemes)
        throw block.error("scheme", " stands " + std::to_string(tables.size()) +
                                        " times; at most " + std::to_string(most_schemes) +
                                        " schemes are timed");
    for (auto& table : tables) {
        TimedScheme timed;
        timed.method = keys.read_method(table);
        timed.name = read_name(table, timed.method, schemes);
        timed.rungs = read_rungs(table, final_time, keys);
        table.finish();
        schemes.push_back(std::move(timed));
    }
    if (schemes.empty())
        throw block.error("scheme", " is missing; add a block [[" + block.full("scheme") +
                                        "]] for each scheme to time");
    return schemes;
}

std::map<std::string, std::vector<double>> read_targets(TableReader table,
                                                        const std::vector<Measure>& norms,
                                                        const Place& place,
                                                        const SolverKeys& keys) {
    return read_by_measure(
        table, keys, norms, place, [&](const std::string& name, const std::vector<double>& errors) {
            for (std::size_t i = 0; i < errors.size(); ++i)
                if (!(errors[i] > 0.0))
                    throw table.error(
                        name, " holds " + message_text(errors[i]) + "; an error to reach is > 0",
                        i);
        });
}

} // namespace

WorkPrecisionBlock read_work_precision(TableReader& table, const SolverKeys& keys) {
    WorkPrecisionBlock block;
    block.final_time = read_final_time(table, keys);
    block.norms = read_norms(table, keys);
    if (block.norms.empty())
        throw table.error("norms",
                          " is missing or empty; name the norms that the schemes are timed for");
    for (const auto& norm : block.norms)
        for (const char* column : {"seconds_min", "seconds_q1", "seconds_median", "seconds_q3",
                                   "runs", "node_steps", "heat_solves", "fixed_point_iterations"})
            if (norm.name == column)
                throw table.error("norms", std::string(" name ") + column +
                                               ", and tables of times have a column of this name; "
                                               "give the number another");
    const std::int64_t runs = table.integer("runs").value_or(block.runs);
    if (runs < 1 || runs > most_timed_runs)
        throw table.error("runs", " is " + std::to_string(runs) + "; it must be 1 to " +
                                      std::to_string(most_timed_runs));
    block.runs = static_cast<int>(runs);
    if (auto targets = table.table("targets"))
        block.targets = read_targets(*std::move(targets), block.norms, table.place("norms"), keys);
    block.schemes = read_schemes(table, block.final_time, keys);
    table.finish();
    return block;
}

} // namespace tvbeam

#include "reports/document/work_precision_section.hpp"

#include "studies/text/number_text.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <span>

namespace tvbeam {

namespace {

/// Of a clock's step, as 0.01 or 1/60; 0.013 between two rows.
std::string step_text(double step) {
    constexpr std::size_t most_digits = 8;
    constexpr double rounding = 1e-9;
    const double steps = 1.0 / step;
    const std::string text = shortest(step);
    return text.size() <= most_digits ? text
           : steps > 1.5 && std::abs(steps - std::round(steps)) <= rounding * steps
               ? fmt::format("1/{:.0f}", steps)
               : fmt::format("{:.2g}", step);
}

/// Two significant digits, more before the point.
std::string ratio_text(double ratio) {
    return ratio < 9.95 ? fixed(ratio, 1) : ratio < 1e5 ? fixed(ratio, 0) : scientific(ratio, 1);
}

/// Too long for more than one run, or interrupted before.
bool ran_once(const std::optional<Timing>& timing, const WorkPrecisionBlock& block) {
    return timing && timing->runs == 1 && block.runs > 1;
}

/// Marked where it is of one run; blank where there is none.
std::string median_text(const std::optional<Timing>& timing, const WorkPrecisionBlock& block) {
    return timing ? scientific(timing->median, 2) + (ran_once(timing, block) ? "*" : "") : "";
}

Table::Column column(const SchemeRuns& scheme, const std::string& heading,
                     const std::function<std::string(std::size_t)>& cell) {
    Table::Column result{heading, {}};
    for (std::size_t i = 0; i < scheme.runs.size(); ++i)
        result.cells.push_back(cell(i));
    return result;
}

Table::Group time_group(const SchemeRuns& scheme, const WorkPrecisionBlock& block) {
    const auto quartile = [&](const char* heading, double Timing::*value) {
        return column(scheme, heading, [&, value](std::size_t i) {
            const auto& timing = scheme.timings[i];
            return timing && timing->runs > 1 ? scientific((*timing).*value, 2) : std::string();
        });
    };
    return {"seconds",
            {column(scheme, "median",
                    [&](std::size_t i) { return median_text(scheme.timings[i], block); }),
             quartile("q1", &Timing::q1), quartile("q3", &Timing::q3),
             column(scheme, "runs", [&](std::size_t i) {
                 return scheme.timings[i] ? std::to_string(scheme.timings[i]->runs) : std::string();
             })}};
}

std::vector<Table::Group> counter_groups(const SchemeRuns& scheme, const Method& method) {
    const auto count = [&](const char* heading, const auto& counter) {
        return column(scheme, heading, [&](std::size_t i) {
            return scheme.timings[i] ? std::to_string(counter(scheme.runs[i])) : std::string();
        });
    };
    std::vector<Table::Group> groups;
    const auto some = [&](const auto& counter) {
        return std::any_of(scheme.runs.begin(), scheme.runs.end(),
                           [&](const RungResult& run) { return counter(run) > 0; });
    };
    const auto steps = [](const RungResult& run) { return run.count("steps"); };
    if (some(steps)) // a program of another counts none
        groups.push_back({"", {count("steps", steps)}});
    if (some([](const RungResult& run) { return node_steps(run.rung); }))
        groups.push_back(
            {"node-", {column(scheme, "steps", [&](std::size_t i) {
                 return scheme.timings[i]
                            ? scientific(static_cast<double>(node_steps(scheme.runs[i].rung)), 1)
                            : std::string();
             })}});
    // An iteration is a solve of the heat equation too.
    if (!method.iterations.empty())
        groups.push_back({"", {count("iter.", [&](const RungResult& run) {
                              return run.count(method.iterations);
                          })}});
    else if (std::any_of(scheme.runs.begin(), scheme.runs.end(),
                         [](const RungResult& run) { return run.count("heat_solves") > 0; }))
        groups.push_back({"heat", {count("solves", [](const RungResult& run) {
                              return run.count("heat_solves");
                          })}});
    return groups;
}

/// The rows of one scheme, below its name.
std::vector<Block> rows_blocks(const SchemeRuns& scheme, const TimedScheme& timed,
                               const WorkPrecisionBlock& block) {
    const auto& norms = block.norms;
    Table::Group key{"", {}};
    if (timed.rungs.front().has_mesh())
        key.columns.push_back(column(scheme, "s", [&](std::size_t i) {
            return std::to_string(scheme.runs[i].rung.elements);
        }));
    if (timed.rungs.front().has_steps())
        key.columns.push_back(
            column(scheme, "dt", [&](std::size_t i) { return shortest(scheme.runs[i].rung.dt); }));
    std::vector<Table::Group> groups;
    for (std::size_t k = 0; k < norms.size(); ++k)
        groups.push_back({norms[k].name, {column(scheme, "error", [&](std::size_t i) {
                              const auto& errors = scheme.runs[i].errors;
                              return errors.empty() ? name_of(scheme.runs[i].status)
                                                    : scientific(errors[k], 4);
                          })}});
    groups.push_back(time_group(scheme, block));
    for (auto& group : counter_groups(scheme, timed.method))
        groups.push_back(std::move(group));
    std::vector<Block> blocks{
        Paragraph{timed.name + ": " + timed.method.words},
        Table{timed.name +
                  ": errors, seconds of a run, their quartiles and of how many runs, and counters.",
              std::move(key), std::move(groups)}};
    for (const auto& run : scheme.runs)
        if (run.status != RungStatus::ok)
            blocks.emplace_back(Paragraph{run.trouble(shortest)});
    return blocks;
}

bool some_ran_once(const WorkPrecisionResult& result, const WorkPrecisionBlock& block) {
    return std::any_of(result.schemes.begin(), result.schemes.end(), [&](const SchemeRuns& scheme) {
        return std::any_of(scheme.timings.begin(), scheme.timings.end(),
                           [&](const auto& timing) { return ran_once(timing, block); });
    });
}

bool reached(const ReachedError& error) {
    return std::any_of(error.times.begin(), error.times.end(),
                       [](const auto& time) { return time.has_value(); });
}

/// The times to reach an error, a column a scheme; rows that no scheme has are left out.
Table costs_table(const NormCosts& costs, const WorkPrecisionBlock& block) {
    Table::Group key{"", {{costs.norm.name, {}}}};
    std::vector<Table::Group> groups;
    for (const auto& scheme : block.schemes)
        groups.push_back({"", {{scheme.name, {}}}});
    for (const auto& error : costs.errors) {
        if (!reached(error) && !error.target)
            continue;
        key.columns[0].cells.push_back(shortest(error.error));
        for (std::size_t k = 0; k < groups.size(); ++k)
            groups[k].columns[0].cells.push_back(median_text(error.times[k], block));
    }
    return {"Seconds to reach an error of " + costs.norm.name + ", by scheme.", key, groups};
}

/// caveats: those of both.
Finding comparison(const SchemeComparison& pair, const ReachedError& error,
                   const WorkPrecisionBlock& block, const std::string& caveats) {
    const std::string& faster = block.schemes[pair.faster].name;
    const std::string& slower = block.schemes[pair.slower].name;
    const bool once = error.times[pair.faster]->runs == 1 || error.times[pair.slower]->runs == 1;
    const std::string clock =
        pair.times.clock_step > 0.0
            ? fmt::format(", of times known to {} s", step_text(pair.times.clock_step))
            : "";
    const std::string range =
        std::isfinite(pair.times.highest)
            ? ratio_text(pair.times.lowest) + " … " + ratio_text(pair.times.highest)
            : ratio_text(pair.times.lowest) + " and more";
    const std::string spread =
        once && clock.empty()
            ? "(of one run)"
            : fmt::format("({} {}{})", once ? "of one run:" : "quartiles", range, clock);
    const std::string ratio = ratio_text(pair.times.ratio);
    return {(pair.times.distinguishable
                 ? fmt::format("{} is {} times faster than {} {}", faster, ratio, slower, spread)
                 : fmt::format("{} and {} are equally fast, {}: ratio {} {}", faster, slower,
                               !once && pair.times.lowest > 1.0 ? "but for less than a fifth"
                                                                : "as far as can be told",
                               ratio, spread)) +
                caveats,
            4};
}

/// The scheme of the least median.
std::size_t fastest_of(const ReachedError& error) {
    const auto seconds = [](const std::optional<Timing>& time) {
        return time ? time->median : std::numeric_limits<double>::infinity();
    };
    const auto least =
        std::min_element(error.times.begin(), error.times.end(),
                         [&](const auto& a, const auto& b) { return seconds(a) < seconds(b); });
    return static_cast<std::size_t>(least - error.times.begin());
}

/// What is said of a scheme that has no larger error, behind its name.
std::string less_in_every_row(const SchemeRuns& scheme) {
    double soonest = std::numeric_limits<double>::infinity();
    bool all_timed = true;
    bool has_failed = false;
    for (std::size_t i = 0; i < scheme.runs.size(); ++i)
        if (scheme.runs[i].errors.empty())
            has_failed = true;
        else if (has_time(scheme.timings[i]))
            soonest = std::min(soonest, scheme.timings[i]->median);
        else
            all_timed = false;
    return fmt::format(
        " has less in every row{}{}", has_failed ? " that did not fail" : "",
        all_timed ? fmt::format(", after {} s in the quickest", scientific(soonest, 2)) : "");
}

/// Why no time goes from a row to the next, or through it; empty where nothing is in the way.
std::string hindrance(const RungResult& run, const std::optional<Timing>& timing,
                      std::size_t norm) {
    if (run.errors.empty())
        return run.status == RungStatus::failed ? "one has failed" : "one was not run";
    const double error = run.errors.at(norm);
    if (!std::isfinite(error) || error == 0.0)
        return "one has the error " + shortest(error);
    return !timing ? "one was not timed" : !has_time(timing) ? "in one the clock shows 0 s" : "";
}

/// Of a scheme that has a time to reach an error, what it does not say: that it is of a finest row
/// above the error, and that finer rows have none.
std::string caveat(const SchemeRuns& scheme, const std::string& name, std::size_t norm,
                   double error) {
    const auto& runs = scheme.runs;
    std::size_t end = runs.size(); // of the rows up to the finest that can be compared
    while (end > 1 && !hindrance(runs[end - 1], scheme.timings[end - 1], norm).empty())
        --end;
    const auto reaches = [&](const RungResult& run) {
        return !run.errors.empty() && run.errors.at(norm) <= error;
    };
    const auto timed = std::span(runs).first(end);
    const auto finer = std::span(runs).subspan(end);
    std::string text;
    if (!reaches(runs[end - 1]))
        text =
            fmt::format(fmt::runtime(std::ranges::any_of(finer, reaches)
                                         ? "; {} comes within {:g} % of it, and below it in a row "
                                           "without a time"
                                     : std::ranges::any_of(timed, reaches)
                                         ? "; {} ends above it, by {:g} % at most"
                                         : "; {} comes within {:g} % of it, no nearer"),
                        name, 100.0 * same_error);
    for (; end < runs.size(); ++end)
        if (runs[end].status == RungStatus::failed ||
            (!runs[end].errors.empty() && std::isinf(runs[end].errors.at(norm))))
            return text + fmt::format("; of the finer rows of {} {}", name,
                                      hindrance(runs[end], scheme.timings[end], norm));
    return text;
}

/// Why a scheme has no time to reach an error, behind its name.
std::string without_time(const SchemeRuns& scheme, std::size_t norm, double error) {
    const auto& runs = scheme.runs;
    const auto has = [&](const auto& relation) {
        return [&, relation](const RungResult& run) {
            return !run.errors.empty() && relation(run.errors.at(norm), error);
        };
    };
    const auto reaches = has(std::less_equal());
    if (std::ranges::none_of(runs, reaches))
        return " does not, as far as measured";
    const auto finest = std::find_if(runs.rbegin(), runs.rend(), has(std::greater()));
    if (finest == runs.rend())
        return less_in_every_row(scheme);
    if (std::none_of(runs.rbegin(), finest, reaches))
        return " does, but a finer row is above it again";
    std::set<std::string> hindrances;
    for (auto i = static_cast<std::size_t>(runs.rend() - finest) - 1; i < runs.size(); ++i) {
        const std::string one = hindrance(runs[i], scheme.timings[i], norm);
        if (!one.empty())
            hindrances.insert(one);
        else if (reaches(runs[i]))
            break;
    }
    return fmt::format(" does, but not from one row to the next: {}",
                       fmt::join(hindrances, ", and "));
}

/// Which scheme reaches an error sooner: of few, every two; of many, the fastest beside each.
///
/// @param norm its place among the norms
std::vector<Block> comparisons(const ReachedError& error, const WorkPrecisionResult& result,
                               std::size_t norm, const WorkPrecisionBlock& block) {
    std::vector<Block> findings{Finding{
        fmt::format("To reach {} = {}:", result.norms[norm].norm.name, shortest(error.error))}};
    const auto of = [&](std::size_t scheme) {
        return caveat(result.schemes[scheme], block.schemes[scheme].name, norm, error.error);
    };
    constexpr std::size_t most_pairs = 15;
    const bool all = error.comparisons.size() <= most_pairs;
    const std::size_t fastest = fastest_of(error);
    for (const auto& pair : error.comparisons)
        if (all || pair.faster == fastest || pair.slower == fastest)
            findings.emplace_back(
                comparison(pair, error, block, of(pair.faster) + of(pair.slower)));
    if (!all)
        findings.emplace_back(Finding{"the table has the others' times", 4});
    for (std::size_t k = 0; k < block.schemes.size(); ++k)
        if (error.times[k] && error.comparisons.empty())
            findings.emplace_back(
                Finding{block.schemes[k].name + " alone has a time to reach it" + of(k), 4});
    std::vector<std::string> without;
    for (std::size_t k = 0; k < block.schemes.size(); ++k)
        if (!error.times[k])
            without.push_back(block.schemes[k].name +
                              without_time(result.schemes[k], norm, error.error));
    constexpr std::size_t most = 4;
    if (without.size() > most)
        findings.emplace_back(Finding{
            fmt::format("{} of {} schemes have no time to compare; the tables show their rows",
                        without.size(), block.schemes.size()),
            4});
    else
        for (const auto& sentence : without)
            findings.emplace_back(Finding{sentence, 4});
    return findings;
}

/// The errors at which the schemes are compared in words.
std::vector<const ReachedError*> compared_errors(const NormCosts& costs) {
    std::vector<const ReachedError*> errors;
    for (const auto& error : costs.errors)
        if (error.target)
            errors.push_back(&error);
    if (!errors.empty())
        return errors;
    const auto smallest =
        std::find_if(costs.errors.rbegin(), costs.errors.rend(),
                     [](const ReachedError& error) { return !error.comparisons.empty(); });
    if (smallest != costs.errors.rend())
        errors.push_back(&*smallest);
    return errors;
}

/// A program of another counts none.
bool counts_steps(const WorkPrecisionResult& result) {
    return std::ranges::any_of(result.schemes, [](const SchemeRuns& scheme) {
        return std::ranges::any_of(scheme.runs,
                                   [](const RungResult& run) { return run.count("steps") > 0; });
    });
}

} // namespace

Section work_precision_section(const WorkPrecisionResult& result, const WorkPrecisionBlock& block) {
    const bool has_end = block.final_time > 0.0;
    Section section{
        "Work and precision",
        {Paragraph{fmt::format(
            "Work and precision{}; timed runs a row: at most {}, in turns, one at a time, "
            "{}{}",
            has_end ? " up to T = " + shortest(block.final_time) : "", block.runs,
            counts_steps(result) ? "without error norms"
                                 : "whole processes, or as the program's own clock says",
            has_end ? "; node-steps: elements times steps" : "")}}};
    auto& blocks = section.blocks;
    const auto add = [&blocks](const std::vector<Block>& more) {
        blocks.emplace_back(BlankLine{});
        blocks.insert(blocks.end(), more.begin(), more.end());
    };
    for (std::size_t k = 0; k < block.schemes.size(); ++k)
        add(rows_blocks(result.schemes[k], block.schemes[k], block));
    if (some_ran_once(result, block))
        add({Paragraph{result.interrupted ? "*: of one run"
                                          : "*: of one run, as a run takes long"}});
    bool introduced = false;
    for (const auto& costs : result.norms) {
        const Table table = costs_table(costs, block);
        if (table.rows() == 0)
            continue;
        if (!introduced)
            add({Paragraph{"Seconds to reach an error, on the log-log line between two rows, "
                           "or of a finer row that takes less; blank: not between two timed "
                           "rows next to each other"}});
        introduced = true;
        add({table});
    }
    for (std::size_t norm = 0; norm < result.norms.size(); ++norm) {
        for (const auto* error : compared_errors(result.norms[norm]))
            add(comparisons(*error, result, norm, block));
        for (const auto& remark : result.norms[norm].remarks)
            add({Finding{remark}});
    }
    if (!result.busy_remark.empty())
        add({Finding{result.busy_remark}});
    return section;
}

} // namespace tvbeam

#include "reports/document/ladder_section.hpp"

#include "reports/document/ending_text.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>

namespace tvbeam {

namespace {

Table::Column column(const LadderResult& ladder, const std::string& heading,
                     const std::function<std::string(std::size_t)>& cell) {
    Table::Column result{heading, {}};
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i)
        result.cells.push_back(cell(i));
    return result;
}

std::string ratio_cell(double ratio) {
    return ratio >= 0.01 && ratio < 100.0 ? fixed(ratio, 4) : scientific(ratio, 1);
}

Table::Group norm_group(const LadderResult& ladder, const LadderBlock& block, std::size_t k) {
    const auto error = [&ladder, k](std::size_t i) {
        const auto& errors = ladder.rungs[i].errors;
        return errors.empty() ? std::optional<double>() : errors[k];
    };
    const std::string& name = ladder.norms[k].norm.name;
    const bool is_value = ladder.norms[k].norm.is_value;
    Table::Group group{name, {}};
    group.columns.push_back(column(ladder, is_value ? "value" : "error", [&](std::size_t i) {
        return error(i) ? scientific(error(i), is_value ? 8 : 4) : name_of(ladder.rungs[i].status);
    }));
    if (block.printed) {
        if (const auto found = block.printed->figures.find(name);
            found != block.printed->figures.end()) {
            const auto& figures = found->second;
            group.columns.push_back(column(ladder, "publ.", [&](std::size_t i) {
                return scientific(figures[i], is_value ? 8 : 3);
            }));
            group.columns.push_back(column(ladder, "ratio", [&](std::size_t i) {
                const auto value = error(i);
                return value && figures[i] != 0.0 ? ratio_cell(*value / figures[i]) : std::string();
            }));
        }
    }
    if (!is_value)
        group.columns.push_back(column(
            ladder, "ord.", [&](std::size_t i) { return fixed(ladder.norms[k].orders[i], 2); }));
    return group;
}

/// Two significant digits in at most four characters, up to a few hours.
std::string seconds_text(double seconds) {
    if (seconds < 0.0095)
        return scientific(seconds, 0);
    if (seconds < 0.995)
        return fixed(seconds, 2);
    return fixed(seconds, seconds < 99.95 ? 1 : 0);
}

/// What published figures stand beside, and of what there are orders.
std::string legend(const LadderBlock& block) {
    bool errors = false;
    bool values = false;
    for (const auto& measure : block.norms)
        if (block.printed->figures.contains(measure.name))
            (measure.is_value ? values : errors) = true;
    const bool orders =
        std::ranges::any_of(block.norms, [](const Measure& measure) { return !measure.is_value; });
    return "publ.: published, " + block.printed->source + "; ratio: " + (errors ? "error" : "") +
           (errors && values ? " or " : "") + (values ? "value" : "") + " / published" +
           (orders ? "; ord.: observed order" : "");
}

/// "Errors up to T = 2": of errors, values or both, and until when, if that is known.
std::string what_is_shown(const LadderBlock& block) {
    bool errors = block.norms.empty();
    bool values = false;
    for (const auto& measure : block.norms)
        (measure.is_value ? values : errors) = true;
    const std::string what = errors && values ? "Errors and values" : values ? "Values" : "Errors";
    return block.final_time > 0.0 ? what + " up to T = " + shortest(block.final_time) : what;
}

Table ladder_table(const LadderResult& ladder, const LadderBlock& block, const Method& method) {
    Table::Group key{"", {}};
    const Rung& first = block.rungs.front();
    if (first.has_mesh())
        key.columns.push_back(column(ladder, "s", [&](std::size_t i) {
            return std::to_string(ladder.rungs[i].rung.elements);
        }));
    if (first.has_steps()) {
        std::vector<double> steps;
        for (const auto& rung : ladder.rungs)
            steps.push_back(rung.rung.dt);
        key.columns.push_back(
            column(ladder, "dt", [texts = alike(steps)](std::size_t i) { return texts[i]; }));
    }
    std::vector<Table::Group> groups;
    for (std::size_t k = 0; k < ladder.norms.size(); ++k)
        groups.push_back(norm_group(ladder, block, k));
    Table::Group cost{"", {}};
    if (!method.iterations.empty())
        cost.columns.push_back(column(ladder, "iter.", [&](std::size_t i) {
            return std::to_string(ladder.rungs[i].count(method.iterations));
        }));
    cost.columns.push_back(column(
        ladder, "sec", [&](std::size_t i) { return seconds_text(ladder.rungs[i].seconds); }));
    groups.push_back(cost);
    const bool own_clock = std::ranges::any_of(
        ladder.rungs, [](const RungResult& run) { return run.wall_clock.has_value(); });
    return {fmt::format("{}{}{}; {}; sec: seconds of a run, {}.", what_is_shown(block),
                        first.has_mesh() ? " on s elements" : "",
                        first.has_steps() ? " with the step dt" : "", method.words,
                        own_clock ? "by the program's own clock" : "error norms included"),
            key, groups};
}

/// What a ladder says nothing by: a level that is given twice, errors that are all zero.
std::vector<std::string> empty_words(const LadderResult& ladder) {
    std::vector<std::string> sentences;
    for (std::size_t i = 0, end = 0; i < ladder.rungs.size(); i = end) {
        const Rung& rung = ladder.rungs[i].rung;
        const auto is_same = [&](const Rung& other) {
            return other.elements == rung.elements && other.dt == rung.dt;
        };
        for (end = i + 1; end < ladder.rungs.size() && is_same(ladder.rungs[end].rung);)
            ++end;
        if (end - i > 1)
            sentences.push_back(fmt::format(
                "{} stands there {}: runs of one level have no order.", rung.name(shortest),
                end - i == 2 ? "twice" : fmt::format("{} times", end - i)));
    }
    bool measured = false;
    bool all_zero = true;
    for (const auto& run : ladder.rungs)
        for (std::size_t k = 0; k < run.errors.size(); ++k)
            if (!ladder.norms[k].norm.is_value) {
                measured = true;
                all_zero = all_zero && run.errors[k] == 0.0;
            }
    if (measured && all_zero)
        sentences.emplace_back("Every error is zero: what the norms measure is zero, or the scheme "
                               "is exact for it. That tests nothing of its order.");
    return sentences;
}

} // namespace

Section ladder_section(const LadderResult& ladder, const LadderBlock& block, const Method& method) {
    Section section{"Errors and observed orders", {ladder_table(ladder, block, method)}, {}};
    if (block.final_time > 0.0) {
        section.head.push_back(what_is_shown(block));
        section.head.back().front() = static_cast<char>(std::tolower(section.head.back().front()));
    }
    auto& blocks = section.blocks;
    const auto add = [&blocks](Block&& block) {
        blocks.emplace_back(BlankLine{});
        blocks.emplace_back(std::move(block));
    };
    if (block.printed && !block.printed->figures.empty())
        add(Paragraph{legend(block)});
    for (const auto& rung : ladder.rungs)
        if (rung.status != RungStatus::ok)
            add(Finding{rung.trouble(shortest)});
    for (const auto& sentence : empty_words(ladder))
        add(Finding{sentence});
    if (!ladder.quadrature_remark.empty())
        add(Finding{ladder.quadrature_remark});
    if (!ladder.reference_remark.empty())
        add(Finding{ladder.reference_remark});
    if (ladder.refined)
        add(Finding{ending_text(*ladder.refined, *block.until,
                                fmt::format("{} levels", ladder.rungs.size()))});
    for (const auto& norm : ladder.norms)
        for (std::size_t i = 0; i < norm.remarks.size(); ++i)
            if (i == 0)
                add(Finding{norm.remarks[i]});
            else
                blocks.emplace_back(Finding{norm.remarks[i]});
    return section;
}

} // namespace tvbeam

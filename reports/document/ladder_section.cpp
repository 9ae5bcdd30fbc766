#include "reports/document/ladder_section.hpp"

#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <functional>

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
    Table::Group group{name, {}};
    group.columns.push_back(column(ladder, "error", [&](std::size_t i) {
        return error(i) ? scientific(error(i), 4) : name_of(ladder.rungs[i].status);
    }));
    if (block.printed) {
        if (const auto found = block.printed->figures.find(name);
            found != block.printed->figures.end()) {
            const auto& figures = found->second;
            group.columns.push_back(
                column(ladder, "publ.", [&](std::size_t i) { return scientific(figures[i], 3); }));
            group.columns.push_back(column(ladder, "ratio", [&](std::size_t i) {
                const auto value = error(i);
                return value && figures[i] != 0.0 ? ratio_cell(*value / figures[i]) : std::string();
            }));
        }
    }
    group.columns.push_back(
        column(ladder, "ord.", [&](std::size_t i) { return fixed(ladder.norms[k].orders[i], 2); }));
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

Table ladder_table(const LadderResult& ladder, const LadderBlock& block, const Method& method) {
    Table::Group key{"", {}};
    key.columns.push_back(column(
        ladder, "s", [&](std::size_t i) { return std::to_string(ladder.rungs[i].rung.elements); }));
    key.columns.push_back(
        column(ladder, "dt", [&](std::size_t i) { return shortest(ladder.rungs[i].rung.dt); }));
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
    return {fmt::format("Errors up to T = {} on s elements with the step dt; {}; sec: seconds of "
                        "a run, error norms included.",
                        shortest(block.final_time), method.words),
            key, groups};
}

} // namespace

Section ladder_section(const LadderResult& ladder, const LadderBlock& block, const Method& method) {
    Section section{"Errors and observed orders",
                    {ladder_table(ladder, block, method)},
                    {"errors up to T = " + shortest(block.final_time)}};
    auto& blocks = section.blocks;
    const auto add = [&blocks](Block&& block) {
        blocks.emplace_back(BlankLine{});
        blocks.emplace_back(std::move(block));
    };
    if (block.printed && !block.printed->figures.empty())
        add(Paragraph{"publ.: published, " + block.printed->source +
                      "; ratio: error / published; ord.: observed order"});
    for (const auto& rung : ladder.rungs)
        if (rung.status != RungStatus::ok)
            add(Finding{fmt::format("s = {}, dt = {} {}: {}", rung.rung.elements,
                                    shortest(rung.rung.dt), name_of(rung.status), rung.reason)});
    if (!ladder.quadrature_remark.empty())
        add(Finding{ladder.quadrature_remark});
    if (!ladder.reference_remark.empty())
        add(Finding{ladder.reference_remark});
    for (const auto& norm : ladder.norms)
        for (std::size_t i = 0; i < norm.remarks.size(); ++i)
            if (i == 0)
                add(Finding{norm.remarks[i]});
            else
                blocks.emplace_back(Finding{norm.remarks[i]});
    return section;
}

} // namespace tvbeam

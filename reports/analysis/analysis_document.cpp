#include "reports/analysis/analysis_document.hpp"

#include "reports/document/orders_section.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tvbeam {

namespace {

constexpr std::size_t most_rows = 60;
constexpr std::size_t rows_at_an_end = 20;

/// The rows that are shown; where many are left out, a gap stands for them.
struct ShownRows {
    explicit ShownRows(std::size_t rows) {
        for (std::size_t i = 0; i < rows; ++i)
            if (rows <= most_rows || i < rows_at_an_end || i + rows_at_an_end >= rows)
                shown.push_back(i);
        has_gap = shown.size() < rows;
    }
    template <class Cell>
    Table::Column column(const std::string& heading, const Cell& cell) const {
        Table::Column result{heading, {}};
        for (std::size_t k = 0; k < shown.size(); ++k) {
            if (has_gap && k == rows_at_an_end)
                result.cells.emplace_back("...");
            result.cells.push_back(cell(shown[k]));
        }
        return result;
    }
    std::vector<std::size_t> shown;
    bool has_gap = false;
};

Table rows_table(const DataAnalysis& analysis, const ColumnAnalysis& column) {
    const ShownRows rows(analysis.rows());
    Table table{fmt::format("The rows of {}, from coarse to fine.", column.name), {"", {}}, {}};
    for (const auto& width : analysis.widths)
        table.key.columns.push_back(
            rows.column(width.name, [&](std::size_t i) { return shortest(width.numbers[i]); }));
    Table::Group group{"", {rows.column(column.name, [&](std::size_t i) {
                           const double number = column.numbers[i];
                           const bool is_missing = !column.missing.empty() && column.missing[i];
                           return is_missing               ? std::string("-")
                                  : !std::isfinite(number) ? std::string("failed")
                                  : column.is_value        ? shortest(number)
                                                           : scientific(number, 4);
                       })}};
    if (!column.verdicts.empty()) {
        if (!column.orders.empty())
            group.columns.push_back(
                rows.column("order", [&](std::size_t i) { return fixed(column.orders[i], 3); }));
        group.columns.push_back(rows.column("verdict", [&](std::size_t i) {
            return std::string(name_of(column.verdicts[i].verdict));
        }));
    }
    table.groups.push_back(std::move(group));
    return table;
}

/// Each reason once, with the rows that it holds for.
void add_reasons(const ColumnAnalysis& column, std::vector<Block>& blocks) {
    const auto& verdicts = column.verdicts;
    std::size_t shown = 0;
    for (std::size_t first = 0, next = 0; first < verdicts.size() && shown < most_rows;
         first = next, ++shown) {
        for (next = first + 1; next < verdicts.size() &&
                               verdicts[next].verdict == verdicts[first].verdict &&
                               verdicts[next].reason == verdicts[first].reason;)
            ++next;
        const std::string rows = next == first + 1 ? fmt::format("row {}", next)
                                                   : fmt::format("rows {} to {}", first + 1, next);
        blocks.emplace_back(Paragraph{fmt::format(
            "{}: {}, {}", rows, name_of(verdicts[first].verdict), verdicts[first].reason)});
    }
}

void add_limit(const ColumnAnalysis& column, std::vector<Block>& blocks) {
    for (const auto& [name, method] : {std::pair("GCI", &column.limit->gci),
                                       {"Celik et al.", &column.limit->celik},
                                       {"Eca and Hoekstra", &column.limit->eca_hoekstra}})
        if (!*method && !method->silence.empty())
            blocks.emplace_back(
                Paragraph{fmt::format("beside it, {} says nothing: {}", name, method->silence)});
        else if (*method)
            blocks.emplace_back(Paragraph{fmt::format(
                "beside it, {}: limit {:.{}g}, finest value ± {}, order {}, model {}", name,
                (*method)->limit, digits_within((*method)->limit, (*method)->uncertainty),
                scientific((*method)->uncertainty, 2), fixed((*method)->order, 3),
                (*method)->model)});
}

/// Whose names h and dt of the model are.
std::string names_in_model(const DataAnalysis& analysis, const ColumnAnalysis& column) {
    const auto& h = analysis.widths[column.of_model.first].name;
    const auto& dt = analysis.widths[column.of_model.second].name;
    return h == "h" && dt == "dt" ? std::string() : fmt::format(", {} for h and {} for dt", h, dt);
}

Section section_of(const DataAnalysis& analysis, const ColumnAnalysis& column) {
    Section section{column.name, {rows_table(analysis, column), BlankLine{}}};
    auto& blocks = section.blocks;
    if (!column.verdicts.empty()) {
        add_reasons(column, blocks);
        blocks.emplace_back(BlankLine{});
    }
    if (column.two_term) {
        blocks.emplace_back(
            Paragraph{fmt::format("a grid of {} runs: e^2 = a^2 h^2p + 2 rho a b h^p dt^q + b^2 "
                                  "dt^2q{}",
                                  analysis.rows(), names_in_model(analysis, column))});
        if (column.two_term->holds())
            blocks.emplace_back(fit_table({{column.name, &*column.two_term}}, analysis.rows()));
    }
    for (const auto& finding : column.findings)
        blocks.emplace_back(Finding{finding});
    if (column.limit)
        add_limit(column, blocks);
    return section;
}

} // namespace

Document analysis_document(const DataAnalysis& analysis) {
    Document document;
    document.title = "Analysis of " + analysis.name;
    document.head.push_back(
        fmt::format("{} row{}; ±: 95 %", analysis.rows(), analysis.rows() == 1 ? "" : "s"));
    document.head.insert(document.head.end(), analysis.remarks.begin(), analysis.remarks.end());
    document.provenance = {{"file", analysis.name}};
    for (const auto& column : analysis.columns)
        document.sections.push_back(section_of(analysis, column));
    return document;
}

} // namespace tvbeam

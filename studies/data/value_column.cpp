#include "studies/data/value_column.hpp"

#include "studies/data/refined_widths.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tvbeam {

namespace {

/// The units of the last digits printed, as they are seen in the values: those of the width change
/// a value by its slope there, which is no more than the steeper one to the rows beside it. None
/// where all is exact.
std::vector<double> units_seen_in_values(const DataColumn& width, const DataColumn& values) {
    auto units = values.units;
    if (width.units.empty())
        return units;
    units.resize(values.numbers.size());
    std::optional<std::size_t> before;
    std::vector<double> slopes(units.size());
    for (std::size_t r = 0; r < units.size(); ++r) {
        if (!std::isfinite(values.numbers[r]))
            continue;
        if (before && width.numbers[*before] != width.numbers[r]) {
            const double slope = std::abs((values.numbers[r] - values.numbers[*before]) /
                                          (width.numbers[r] - width.numbers[*before]));
            slopes[*before] = std::max(slopes[*before], slope);
            slopes[r] = slope;
        } else if (before) {
            slopes[r] = slopes[*before];
        }
        before = r;
    }
    for (std::size_t r = 0; r < units.size(); ++r)
        units[r] = std::hypot(units[r], slopes[r] * width.units[r]);
    return units;
}

} // namespace

ColumnAnalysis analyse_values(const DataAnalysis& data, const DataColumn& values,
                              const std::vector<double>& sigma) {
    ColumnAnalysis column;
    column.name = values.name;
    column.is_value = true;
    column.numbers = values.numbers;
    column.missing = values.missing;
    column.by_width.resize(data.widths.size());
    const std::size_t along = leading_width(data.widths);
    std::vector<ValueRow> rows(data.rows());
    const auto units = units_seen_in_values(data.widths[along], values);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        rows[r] = {data.widths[along].numbers[r], column.numbers[r]};
        if (!sigma.empty())
            rows[r].sigma = sigma[r];
        else if (!units.empty())
            rows[r].unit = units[r];
    }
    const bool on_one_path = is_one_path(data.widths, along);
    std::string still;
    for (const auto& width : data.widths)
        if (const auto at = standing_still(width, data.widths[along], column.numbers))
            still = fmt::format(
                "{0} stands still at {1:.4g} in the finest rows and is refined in coarser ones, so "
                "that the values go to no one limit; refine it to the end, leave out what is finer "
                "in {2} alone, or all rows with another {0}",
                width.name, *at, data.widths[along].name);
    if (on_one_path && !still.empty()) {
        column.limit.emplace();
        column.limit->limit.status = column.limit->order.status = still;
    } else if (on_one_path) {
        column.limit = estimate_limit(rows);
    } else {
        column.limit.emplace();
        column.limit->limit.status = column.limit->order.status =
            "a limit is found along one way of refinement, and these rows refine several widths "
            "apart from each other";
    }
    const auto& [limit, order, uncertainty, basis, gci, celik, eca, step] = *column.limit;
    column.by_width[along] = order;
    for (std::size_t i = 0; i < data.widths.size(); ++i)
        if (i != along)
            column.by_width[i].status =
                on_one_path || !varies(data.widths[i].numbers)
                    ? path_words(data.widths[i], data.widths[along], column.numbers)
                    : column.limit->order.status;
    std::string held; // its error is in the limit
    for (const auto& width : data.widths)
        if (const auto found = of_rows_with_numbers(width.numbers, column.numbers);
            on_one_path && !found.empty() && is_held(width, data.widths[along], column.numbers))
            held += varies(found) ? fmt::format(" at {} = {:.4g} to {:.4g}", width.name,
                                                found.front(), found.back())
                                  : fmt::format(" at {} = {:.4g}", width.name, found.front());
    column.findings.push_back(
        column.name + ": " +
        (limit.determined
             ? fmt::format("limit {0:.{3}g}{6}, 95 % from {1:.{3}g} to {2:.{3}g} ({4}); the finest "
                           "value ± {5}; ",
                           limit.value, limit.low, limit.high,
                           digits_within(limit.value, limit.half_width()), basis,
                           scientific(uncertainty, 2), held) +
                   order_words(data.widths[along].name, order)
             : "no limit: " + limit.status));
    if (step)
        column.findings.push_back(
            fmt::format("{}: the digits printed limit it: the finest step is {:.0f} in the last",
                        column.name, *step));
    return column;
}

} // namespace tvbeam

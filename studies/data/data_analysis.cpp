#include "studies/data/data_analysis.hpp"

#include "studies/data/error_column.hpp"
#include "studies/data/value_column.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace tvbeam {

namespace {

/// Of one value a record; empty stays empty.
template <typename Value>
std::vector<Value> in_order(const std::vector<Value>& values,
                            const std::vector<std::size_t>& order) {
    std::vector<Value> sorted;
    if (values.empty())
        return sorted;
    sorted.reserve(values.size());
    for (const std::size_t i : order)
        sorted.push_back(values[i]);
    return sorted;
}

DataColumn in_order(const DataColumn& column, const std::vector<std::size_t>& order) {
    return {column.name, in_order(column.numbers, order), in_order(column.units, order),
            in_order(column.missing, order)};
}

} // namespace

DataAnalysis analyse(const DataFile& data) {
    DataAnalysis analysis{data.name, {}, {}, data.remarks, data.chosen};
    std::vector<std::size_t> order(data.widths.front().numbers.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t left, std::size_t right) {
        for (const auto& width : data.widths)
            if (width.numbers[left] != width.numbers[right])
                return width.numbers[left] > width.numbers[right];
        return false;
    });
    for (const auto& width : data.widths)
        analysis.widths.push_back(in_order(width, order));
    const auto sigma = in_order(data.sigma, order);
    for (const auto& errors : data.errors)
        analysis.columns.push_back(analyse_errors(analysis, in_order(errors, order), sigma));
    for (const auto& values : data.values)
        analysis.columns.push_back(analyse_values(analysis, in_order(values, order), sigma));
    for (auto& column : analysis.columns) {
        if (finest_failed(analysis, column) &&
            std::ranges::any_of(column.numbers,
                                [](double number) { return std::isfinite(number); }))
            column.findings.push_back(column.name + ": a finest row has no " +
                                      (column.is_value ? "value" : "error") +
                                      "; what is said is of the others");
        if (vanishes_at_the_finest(analysis, column))
            column.findings.push_back(
                column.name +
                ": the error of the finest row is zero; what is said is of the rows before it");
    }
    return analysis;
}

bool has_failed(const ColumnAnalysis& column, std::size_t row) {
    const double number = column.numbers[row];
    return !(std::isfinite(number) && (column.is_value || number >= 0)) &&
           (column.missing.empty() || !column.missing[row]);
}

bool finest_failed(const DataAnalysis& analysis, const ColumnAnalysis& column) {
    const auto is_finer = [&](std::size_t row, std::size_t than) {
        bool is_somewhere = false;
        for (const DataColumn& width : analysis.widths) {
            if (width.numbers[row] > width.numbers[than])
                return false;
            is_somewhere = is_somewhere || width.numbers[row] < width.numbers[than];
        }
        return is_somewhere;
    };
    for (std::size_t row = 0; row < analysis.rows(); ++row) {
        bool is_finest = has_failed(column, row);
        for (std::size_t other = analysis.rows(); other-- > 0 && is_finest;) // finest first
            is_finest = !std::isfinite(column.numbers[other]) || has_failed(column, other) ||
                        !is_finer(other, row);
        if (is_finest)
            return true;
    }
    return false;
}

bool vanishes_at_the_finest(const DataAnalysis& analysis, const ColumnAnalysis& column) {
    if (column.is_value)
        return false;
    std::vector<ErrorRow> rows(column.numbers.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (const auto& width : analysis.widths)
            rows[r].widths.push_back(width.numbers[r]);
        rows[r].error = column.numbers[r];
        // Zero to its digits, or within its deviation.
        if (r < column.verdicts.size() && column.verdicts[r].verdict == Verdict::unresolved)
            rows[r].error = std::numeric_limits<double>::quiet_NaN();
    }
    return vanishes_at_the_finest(rows);
}

} // namespace tvbeam

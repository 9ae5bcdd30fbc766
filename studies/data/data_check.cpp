#include "studies/data/data_check.hpp"

#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"

#include <filesystem>
#include <system_error>

namespace tvbeam {

namespace {

std::string row_text(const DataAnalysis& analysis, std::size_t row) {
    std::string text;
    for (const auto& width : analysis.widths)
        text +=
            (text.empty() ? " at " : ", ") + width.name + " = " + metric_text(width.numbers[row]);
    return text;
}

/// The bands of one column.
class ColumnCheck {
public:
    ColumnCheck(const DataAnalysis& analysis, const ColumnAnalysis& column, TableReader& table,
                std::vector<CheckedExpectation>& checked)
        : analysis_(analysis), column_(column), table_(table), checked_(checked) {}

    void run() {
        check_order();
        check_rows();
        check_errors();
        if (column_.limit) {
            const auto& limit = column_.limit->limit;
            hold(table_, "limit", {{"limit", known(limit.determined, limit.value), limit.status}});
            hold(table_, "uncertainty",
                 {{"uncertainty", known(limit.determined, column_.limit->uncertainty),
                   limit.status}});
        }
        table_.finish();
    }

private:
    static std::optional<double> known(bool is_known, double value) {
        return is_known ? std::optional(value) : std::nullopt;
    }

    void hold(TableReader& table, const std::string& key, std::vector<Metric> metrics) {
        const auto band = table.band(key);
        if (!band)
            return;
        for (auto& metric : metrics) {
            metric.what = column_.name + ": " + metric.what;
            checked_.push_back(held(metric, band->lowest, band->highest, table.place(key)));
        }
    }

    Metric order_in(std::size_t width) const {
        const auto& order = column_.by_width[width];
        return {"order in " + analysis_.widths[width].name, known(order.determined, order.value),
                "not determined: " + order.status};
    }

    void check_order() {
        if (auto inner = table_.is_table("order") ? table_.table("order") : std::nullopt) {
            for (std::size_t i = 0; i < analysis_.widths.size(); ++i)
                hold(*inner, analysis_.widths[i].name, {order_in(i)});
            inner->finish();
        } else {
            hold(table_, "order", {order_in(0)});
        }
    }

    void check_rows() {
        std::vector<Metric> metrics;
        for (std::size_t row = 1; row < column_.orders.size(); ++row)
            if (column_.orders[row])
                metrics.push_back(
                    {"observed order" + row_text(analysis_, row), column_.orders[row], ""});
        if (metrics.empty())
            metrics.push_back({"observed order", std::nullopt, "none: no row refines another"});
        hold(table_, "orders", std::move(metrics));
    }

    void check_errors() {
        const double within = table_.number("within").value_or(1e-3);
        const auto errors = table_.numbers("errors");
        if (!errors)
            return;
        if (errors->size() != analysis_.rows())
            throw table_.error("errors", " has " + std::to_string(errors->size()) + " values for " +
                                             std::to_string(analysis_.rows()) +
                                             " rows; give one a row");
        for (std::size_t row = 0; row < errors->size(); ++row)
            checked_.push_back(held(
                {column_.name + ": error" + row_text(analysis_, row), column_.numbers[row], ""},
                (*errors)[row] * (1 - within), (*errors)[row] * (1 + within),
                table_.place("errors", row)));
    }

    const DataAnalysis& analysis_;
    const ColumnAnalysis& column_;
    TableReader& table_;
    std::vector<CheckedExpectation>& checked_;
};

} // namespace

std::vector<CheckedExpectation> check(const DataAnalysis& analysis,
                                      const std::string& expectations) {
    std::error_code ignored;
    const bool is_text = expectations.find('=') != std::string::npos &&
                         !std::filesystem::exists(expectations, ignored);
    const TomlDocument document =
        is_text ? parse_toml(expectations, "--expect") : read_toml(expectations);
    TableReader table(document, document.table, "");
    std::vector<CheckedExpectation> checked;
    for (const auto& column : analysis.columns)
        if (auto inner = table.table(column.name))
            ColumnCheck(analysis, column, *inner, checked).run();
    table.finish();
    if (checked.empty())
        throw InputError({document.file},
                         "expects nothing; give a metric, as 'L2.order = [1.9, 2.1]'");
    return checked;
}

} // namespace tvbeam

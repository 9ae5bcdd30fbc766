#include "studies/data/data_check.hpp"

#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/data/refined_widths.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
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
        : analysis_(analysis), column_(column), table_(table), checked_(checked),
          finest_failed_(finest_failed(analysis, column)),
          vanishes_(vanishes_at_the_finest(analysis, column)) {}

    void run() {
        const std::size_t before = checked_.size();
        check_order();
        check_rows();
        check_errors();
        if (!column_.is_value)
            expect_verdicts(table_, {analysis_.rows(), "row"}, [&](const JudgeVerdicts& judge) {
                checked_.push_back(judge(column_.name, column_.verdicts));
            });
        if (column_.limit)
            check_limit(*column_.limit);
        table_.finish();
        if (checked_.size() == before)
            throw table_.error("", " expects nothing; give it a bound, or remove it");
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

    /// As a gate, an order or a limit must not pass because the finest run failed.
    OrderInterval gated(OrderInterval interval) const {
        if (vanishes_) {
            interval.determined = false;
            interval.status = finest_is_zero;
        }
        if (finest_failed_) {
            interval.determined = false;
            interval.status = column_.is_value
                                  ? "the finest row failed: its value is not finite"
                                  : "the finest row failed: its error is not a number, infinite or "
                                    "negative";
        }
        return interval;
    }

    Metric order_in(std::size_t width) const {
        const auto order = gated(column_.by_width[width]);
        return {"order in " + analysis_.widths[width].name, known(order.determined, order.value),
                "not determined: " + order.status};
    }

    void hold_interval(TableReader& table, const std::string& key, const std::string& what,
                       const OrderInterval& interval) {
        expect_interval(table, key, [&](const JudgeInterval& judge) {
            checked_.push_back(judge(column_.name + ": " + what, interval));
        });
    }

    void hold_order(TableReader& table, const std::string& key, std::size_t width) {
        const Metric metric = order_in(width);
        hold(table, key, {metric});
        hold_interval(table, key, metric.what, gated(column_.by_width[width]));
    }

    /// Several widths are refined apart, each with an order of its own.
    bool is_grid() const { return !column_.is_value && column_.orders.empty(); }

    void check_order() {
        if (auto inner = table_.is_table("order") ? table_.table("order") : std::nullopt) {
            for (std::size_t i = 0; i < analysis_.widths.size(); ++i)
                hold_order(*inner, analysis_.widths[i].name, i);
            inner->finish();
        } else if (is_grid()) {
            name_orders_by_width();
        } else {
            // Of widths that are refined together one order speaks for all.
            hold_order(table_, "order", leading_width(analysis_.widths));
        }
    }

    void name_orders_by_width() {
        for (const std::string ending : {"", "_determined", "_holds", "_half_width"}) {
            if (table_.has("order" + ending))
                throw table_.error("order" + ending,
                                   " is of one width, and several are refined apart; say which, "
                                   "as " +
                                       column_.name + ".order." + analysis_.widths.front().name +
                                       ending);
            for (const auto& width : analysis_.widths)
                table_.offer("order." + width.name + ending);
        }
    }

    void check_limit(const LimitEstimate& estimate) {
        const auto limit = gated(estimate.limit);
        hold(table_, "limit", {{"limit", known(limit.determined, limit.value), limit.status}});
        hold_interval(table_, "limit", "limit", limit);
        hold(table_, "uncertainty",
             {{"uncertainty", known(limit.determined, estimate.uncertainty), limit.status}});
        for (const auto& named :
             {std::pair("gci", estimate.gci), std::pair("celik", estimate.celik),
              std::pair("eca_hoekstra", estimate.eca_hoekstra)})
            if (auto inner = table_.table(named.first)) {
                const auto& method = named.second;
                const auto number = [&](const std::string& key, double MethodLimit::*figure) {
                    hold(
                        *inner, key,
                        {{named.first + (", " + key),
                          method && !finest_failed_ ? std::optional(*method.*figure) : std::nullopt,
                          finest_failed_
                              ? "none: the finest row failed"
                              : "the method says nothing of these values: " + method.silence}});
                };
                number("limit", &MethodLimit::limit);
                number("uncertainty", &MethodLimit::uncertainty);
                number("order", &MethodLimit::order);
                inner->finish();
            }
    }

    /// Any row before it that has an error, or is at equal widths: of h and dt refined in turns a
    /// row is often coarser than the one before it and finer than another.
    bool refines_another(std::size_t row) const {
        for (std::size_t other = 0; other < row; ++other) {
            const bool is_coarser =
                std::ranges::any_of(analysis_.widths, [&](const DataColumn& width) {
                    return width.numbers[row] > width.numbers[other];
                });
            if (is_positive(column_.numbers[other]) && !is_coarser)
                return true;
        }
        return row == 0;
    }

    void check_rows() {
        for (const char* key : {"orders", "verdicts"})
            if (column_.is_value && table_.has(key))
                throw table_.error(key, " is of errors, and " + column_.name +
                                            " holds values; of these there are limit and order");
        if (table_.has("orders") && is_grid())
            throw table_.error("orders",
                               " are those from one row to the next, and these rows are a grid; "
                               "order.WIDTH is that of all rows in one width");
        if (column_.orders.empty())
            return; // orders is not offered where it is refused
        std::vector<Metric> metrics;
        // Rows of one width have one order between them. A row without an error has none, nor one
        // that is coarser in some width than each before it: these are not passed over.
        for (std::size_t row = 0; row < column_.orders.size(); ++row) {
            const bool has_error = is_positive(column_.numbers[row]);
            if (column_.orders[row] || !has_error || !refines_another(row))
                metrics.push_back({"observed order" + row_text(analysis_, row), column_.orders[row],
                                   has_error ? "none: it refines no row before it that has an error"
                                             : "none: the error is not a positive number"});
        }
        if (metrics.empty())
            metrics.push_back({"observed order", std::nullopt, "none: no row refines another"});
        hold(table_, "orders", std::move(metrics));
    }

    void check_errors() {
        read_error_bands(
            table_, {analysis_.rows(), "row"},
            [&](std::size_t row, double lowest, double highest, const Place& place) {
                checked_.push_back(held(
                    {column_.name + ": error" + row_text(analysis_, row), column_.numbers[row], ""},
                    lowest, highest, place));
            });
    }

    const DataAnalysis& analysis_;
    const ColumnAnalysis& column_;
    TableReader& table_;
    std::vector<CheckedExpectation>& checked_;
    bool finest_failed_;
    bool vanishes_; ///< the error, at the finest row
};

} // namespace

std::vector<CheckedExpectation> check(const DataAnalysis& analysis, const NamedToml& expectations) {
    const TomlDocument document = parse_toml(expectations.text, expectations.name);
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

std::vector<CheckedExpectation> check(const DataAnalysis& analysis,
                                      const std::string& expectations) {
    std::error_code ignored;
    if (expectations.empty())
        throw InputError({"--expect"}, "is empty; give a file of expectations, or one of them as "
                                       "'L2.order = [1.9, 2.1]'");
    const bool is_text = expectations.find('=') != std::string::npos &&
                         !std::filesystem::exists(expectations, ignored);
    return check(analysis, is_text ? NamedToml{expectations, "--expect"}
                                   : NamedToml{toml_text(expectations), expectations});
}

} // namespace tvbeam

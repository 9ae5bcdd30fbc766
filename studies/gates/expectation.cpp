#include "studies/gates/expectation.hpp"

#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/study.hpp"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <sstream>

namespace tvbeam {

namespace {

/// The finished runs of a series.
const std::vector<RungResult>& runs_of(const StudyResult& result, const std::string& study) {
    const auto all = result.runs();
    return *std::find_if(all.begin(), all.end(), [&](const MeasuredRuns& one) {
                return one.series.study == study;
            })->results;
}

} // namespace

std::string metric_text(double value) {
    std::ostringstream text;
    text.precision(6);
    text << value;
    return text.str();
}

std::optional<double> error_of(const RungResult& run, std::size_t k) {
    return run.errors.empty() ? std::nullopt : std::optional(run.errors[k]);
}

Metric row_metric(const Series& series, const RungResult& run, std::size_t k,
                  const std::string& name, std::optional<double> value,
                  const std::string& otherwise) {
    return {series.study + "." + series.measures[k].name + ": " + name + " at s = " +
                std::to_string(run.rung.elements) + ", dt = " + metric_text(run.rung.dt),
            value, run.reason.empty() ? otherwise : "no error: " + run.reason};
}

void expect_band(TableReader& table, const std::string& key, std::vector<Expectation>& expectations,
                 Metrics metrics) {
    if (const auto band = table.band(key))
        expectations.push_back({band->lowest, band->highest, table.place(key), std::move(metrics)});
}

void expect_orders(TableReader& table, const Series& series, std::size_t k,
                   std::vector<Expectation>& expectations) {
    expect_band(table, "orders", expectations, [series, k](const StudyResult& result) {
        const auto& runs = runs_of(result, series.study);
        const auto orders = observed_orders(records_of(runs, k));
        std::vector<Metric> metrics;
        for (std::size_t row = 1; row < orders.size(); ++row)
            metrics.push_back(row_metric(series, runs[row], k, "observed order", orders[row]));
        if (metrics.empty())
            metrics.push_back(row_metric(series, runs[0], k, "observed order", std::nullopt,
                                         "nothing: a ladder of one rung has no order"));
        return metrics;
    });
}

void expect_errors(TableReader& table, const Series& series, std::size_t k,
                   std::vector<Expectation>& expectations) {
    const double within = table.number("within").value_or(1e-3);
    if (!(within > 0.0 && within < 1.0))
        throw table.error("within", " must be a part between 0 and 1");
    const auto errors = table.numbers("errors");
    if (!errors)
        return;
    if (errors->size() != series.rungs.size())
        throw table.error("errors", " has " + std::to_string(errors->size()) + " values for " +
                                        std::to_string(series.rungs.size()) +
                                        " rungs; give one a rung");
    for (std::size_t row = 0; row < errors->size(); ++row)
        expectations.push_back(
            {(*errors)[row] * (1.0 - within), (*errors)[row] * (1.0 + within),
             table.place("errors", row), [series, k, row](const StudyResult& result) {
                 const RungResult& run = runs_of(result, series.study)[row];
                 return std::vector{row_metric(series, run, k, "error", error_of(run, k))};
             }});
}

void expect_figures(TableReader& table, const std::string& study,
                    std::vector<Expectation>& expectations) {
    for (const auto& name : table.keys())
        expect_band(table, name, expectations, [study, name](const StudyResult& result) {
            const auto figures = result.figures(study);
            std::vector<std::string> names;
            names.reserve(figures.size());
            for (const auto& [known, figure] : figures)
                names.push_back(known);
            const auto found = figures.find(name);
            return std::vector{
                Metric{study + "." + name,
                       found == figures.end() ? std::nullopt : std::optional(found->second),
                       "no figure of this name" + did_you_mean(name, names) + "; the study has " +
                           boost::algorithm::join(names, ", ")}};
        });
}

void for_each_measure(TableReader& table, const std::vector<Measure>& measures,
                      const std::function<void(TableReader&, std::size_t k)>& read) {
    for (std::size_t k = 0; k < measures.size(); ++k)
        if (auto inner = table.table(measures[k].name)) {
            read(*inner, k);
            inner->finish();
        }
}

} // namespace tvbeam

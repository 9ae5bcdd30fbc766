#pragma once

#include "mms/text/input_error.hpp"
#include "studies/runs/run.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

struct StudyResult;
class TableReader;

/// A number that a result has, or why it has none.
struct Metric {
    std::string what; ///< e.g. "ladder.theta_L2L2_sq: error at s = 40, dt = 2.5e-4"
    std::optional<double> value;
    std::string absence; ///< said where there is no value
};

/// A two-sided band that metrics of the result must lie in.
struct Expectation {
    double lowest = 0.0;
    double highest = 0.0;
    Place place; ///< where the scene says so
    std::function<std::vector<Metric>(const StudyResult&)> metrics;
};

/// What a table of [expect] holds, key by key: each reads a band and adds an expectation, where the
/// key is there.
using Metrics = std::function<std::vector<Metric>(const StudyResult&)>;
void expect_band(TableReader& table, const std::string& key, std::vector<Expectation>& expectations,
                 Metrics metrics);

/// orders = [lo, hi], for every observed order of measure k along the series; errors = one a rung,
/// with within = the relative half-width of their bands, default 1e-3.
void expect_orders(TableReader& table, const Series& series, std::size_t k,
                   std::vector<Expectation>& expectations);
void expect_errors(TableReader& table, const Series& series, std::size_t k,
                   std::vector<Expectation>& expectations);

/// A band for any of the figures of a study.
void expect_figures(TableReader& table, const std::string& study,
                    std::vector<Expectation>& expectations);

/// Reads a table for each measure that is there, by its name, with read(table, k).
void for_each_measure(TableReader& table, const std::vector<Measure>& measures,
                      const std::function<void(TableReader&, std::size_t k)>& read);

/// The metric of one row of a series: its value, or what the run or `otherwise` says instead.
Metric row_metric(const Series& series, const RungResult& run, std::size_t k,
                  const std::string& name, std::optional<double> value,
                  const std::string& otherwise = "undefined");

/// The error of measure k, if the run has one.
std::optional<double> error_of(const RungResult& run, std::size_t k);

/// A number as messages of gates show it.
std::string metric_text(double value);

} // namespace tvbeam

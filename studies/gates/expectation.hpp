#pragma once

#include "mms/text/input_error.hpp"
#include "studies/runs/run.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

struct DataAnalysis;
struct OrderInterval;
struct Refined;
struct RowVerdict;
struct StudyResult;
class TableReader;

/// A number that a result has, or why it has none.
struct Metric {
    std::string what; ///< e.g. "ladder.theta_L2L2_sq: error at s = 40, dt = 2.5e-4"
    std::optional<double> value;
    std::string absence; ///< said where there is no value
};

/// One expectation held against a result.
struct CheckedExpectation {
    std::string what;     ///< of a Metric, or of what else the result says
    std::string expected; ///< e.g. "0.9 to 1.1"
    std::string found;    ///< the figure, or why there is none
    Place place;          ///< where the scene says so
    bool holds = false;
    /// What was looked at beside the result, in full, at the first expectation of it: a message, a
    /// text that is derived, or the analysis of a table.
    std::string examined = {};
    std::shared_ptr<const DataAnalysis> analysed = {};
};

/// A metric held against a band. One that has no value does not meet any.
CheckedExpectation held(const Metric& metric, double lowest, double highest, const Place& place);

/// What a key of [expect] is about: of "expect.left_out" left_out.
std::string what_of(const TableReader& table, const std::string& key);

/// What a scene expects of its result, held against it.
using Expectation = std::function<std::vector<CheckedExpectation>(const StudyResult&)>;

/// What a table of [expect] holds, key by key: each reads what is expected and adds it, where the
/// key is there.
using Metrics = std::function<std::vector<Metric>(const StudyResult&)>;
void expect_band(TableReader& table, const std::string& key, std::vector<Expectation>& expectations,
                 Metrics metrics);
Expectation in_band(double lowest, double highest, const Place& place, Metrics metrics);

/// The rows of which a list has one value each, and what one is called. Where `until` may add to
/// them, a list may have more; how many there are is judged with what it holds.
struct ListedRows {
    std::size_t count = 0;
    std::string name;
    bool may_grow = false;
};

/// verdicts = one a row (name_of(Verdict)).
using JudgeVerdicts =
    std::function<CheckedExpectation(const std::string&, const std::vector<RowVerdict>&)>;
void expect_verdicts(TableReader& table, const ListedRows& rows,
                     const std::function<void(JudgeVerdicts)>& add);

/// KEY = [ … ]: all that the result says, word by word or number by number, to six digits.
/// expect_sentences: sentence by sentence, each by how it begins.
using Words = std::function<std::vector<std::string>(const StudyResult&)>;
using Numbers = std::function<std::vector<double>(const StudyResult&)>;
void expect_words(TableReader& table, const std::string& key,
                  std::vector<Expectation>& expectations, const Words& found);
void expect_sentences(TableReader& table, const std::string& key,
                      std::vector<Expectation>& expectations, const Words& found);
void expect_numbers(TableReader& table, const std::string& key,
                    std::vector<Expectation>& expectations, const Numbers& found);

/// What refining by `until` came to: ended_by and open, in words; elements and dt, the different
/// ones of all runs of the study, from coarse to fine.
void expect_refined(TableReader& table, const std::string& study,
                    std::vector<Expectation>& expectations,
                    const std::function<Refined(const StudyResult&)>& refined);

/// Of an order or a limit with its 95 % interval: KEY_determined = true or false, KEY_holds = a
/// number that the interval must hold, KEY_half_width = [lo, hi]. add(judge): for each that the
/// table has. One that is not determined holds nothing and has no width.
using JudgeInterval = std::function<CheckedExpectation(const std::string&, const OrderInterval&)>;
void expect_interval(TableReader& table, const std::string& key,
                     const std::function<void(JudgeInterval)>& add);

/// orders = [lo, hi], for every observed order of measure k along the series; errors = one a rung.
void expect_orders(TableReader& table, const Series& series, std::size_t k,
                   std::vector<Expectation>& expectations);
void expect_errors(TableReader& table, const Series& series, std::size_t k,
                   std::vector<Expectation>& expectations);

/// The table counters = { NAME = one a rung } of the series: what its runs did, so many times.
void expect_counters(TableReader& table, const Series& series,
                     std::vector<Expectation>& expectations);

/// Relative bands that are wider hold nearly anything.
inline constexpr double widest_part = 0.5;

/// errors = one a row, within = the relative half-width of their bands (widest_part), default 1e-3:
/// add(row, lowest, highest, place) for each. Their number; 0 without a list.
std::size_t
read_error_bands(TableReader& table, const ListedRows& rows,
                 const std::function<void(std::size_t, double, double, const Place&)>& add);

/// A band for any of the figures of a study, by every key that nobody has read.
void expect_figures(TableReader& table, const std::string& study,
                    std::vector<Expectation>& expectations);

/// Refuses the table of a measure that is called as a key of its own, before that key is read.
void require_free_names(const TableReader& table, const std::vector<Measure>& measures);

/// Reads a table for each measure that is there, by its name, with read(table, k).
void for_each_measure(TableReader& table, const std::vector<Measure>& measures,
                      std::vector<Expectation>& expectations,
                      const std::function<void(TableReader&, std::size_t k)>& read);

/// Ends the reading of a table, and refuses one that has added nothing to the `before` expectations
/// that there were.
void finish_expecting(const TableReader& table, std::size_t before,
                      const std::vector<Expectation>& expectations);

/// The metric of one row of a series: its value, or what the run or `otherwise` says instead.
Metric row_metric(const Series& series, const RungResult& run, std::size_t k,
                  const std::string& name, std::optional<double> value,
                  const std::string& otherwise = "undefined");

/// The error of measure k, if the run has one.
std::optional<double> error_of(const RungResult& run, std::size_t k);

/// A number as messages of gates show it.
std::string metric_text(double value);

/// So much of a text as they show.
std::string beginning_of(const std::string& text);

} // namespace tvbeam

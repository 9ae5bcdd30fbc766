#include "studies/gates/expectation.hpp"

#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/orders/order_engine.hpp"
#include "studies/orders/verdict.hpp"
#include "studies/scene/until.hpp"
#include "studies/study.hpp"

#include <boost/algorithm/string/join.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace tvbeam {

using boost::algorithm::join;

namespace {

/// The finished runs of a series.
const std::vector<RungResult>& runs_of(const StudyResult& result, const std::string& study) {
    const auto all = result.runs();
    return *std::find_if(all.begin(), all.end(), [&](const MeasuredRuns& one) {
                return one.series.study == study;
            })->results;
}

constexpr int shown_digits = 6;

/// In so many digits.
std::string in_digits(double number, int digits) {
    return fmt::format("{:.{}g}", number, digits);
}

struct Texts {
    std::vector<std::string> wanted, found;
};

/// As metric_text, or in so many digits that no number found looks like another that is wanted.
Texts texts_of(const std::vector<double>& wanted, const std::vector<double>& found) {
    Texts texts;
    const auto look_alike = [&] {
        for (std::size_t i = 0; i < wanted.size(); ++i)
            for (std::size_t k = 0; k < found.size(); ++k)
                if (texts.wanted[i] == texts.found[k] && wanted[i] != found[k])
                    return true;
        return false;
    };
    const auto all_of = [](const std::vector<double>& numbers, int digits) {
        std::vector<std::string> all;
        all.reserve(numbers.size());
        for (const double number : numbers)
            all.push_back(digits == shown_digits ? metric_text(number) : in_digits(number, digits));
        return all;
    };
    for (int digits = shown_digits; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
        texts = {all_of(wanted, digits), all_of(found, digits)};
        if (!look_alike())
            break;
    }
    return texts;
}

/// Whole numbers are the same to the last digit, others to all that are written, at least six.
bool is_as_written(double wanted, double found) {
    if (std::rint(wanted) == wanted && std::rint(found) == found)
        return found == wanted;
    constexpr int most = std::numeric_limits<double>::max_digits10;
    int digits = shown_digits;
    while (digits < most && std::stod(in_digits(wanted, digits)) != wanted)
        ++digits;
    return in_digits(wanted, digits) == in_digits(found, digits);
}

/// Words held against those that are expected, all of them.
CheckedExpectation same(const std::string& what, const std::vector<std::string>& wanted,
                        const std::vector<std::string>& found, const Place& place) {
    const auto text = [](const auto& all) { return all.empty() ? "nothing" : join(all, ", "); };
    return {what, text(wanted), text(found), place, found == wanted};
}

Expectation all_of(const TableReader& table, const std::string& key,
                   const std::vector<std::string>& wanted, const Words& found) {
    return [what = what_of(table, key), wanted, place = table.place(key),
            found](const StudyResult& result) {
        return std::vector{same(what, wanted, found(result), place)};
    };
}

std::string rungs_text(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " rung" : " rungs");
}

std::vector<std::string> all_verdicts() {
    std::vector<std::string> names;
    for (auto verdict = 0; verdict <= static_cast<int>(Verdict::failed); ++verdict)
        names.emplace_back(name_of(static_cast<Verdict>(verdict)));
    return names;
}

/// As many values as there are rows.
void require_count(const TableReader& table, const std::string& key, std::size_t values,
                   const ListedRows& rows) {
    if (values < rows.count || (values > rows.count && !rows.may_grow))
        throw table.error(
            key, " has " + std::to_string(values) + (values == 1 ? " value for " : " values for ") +
                     std::to_string(rows.count) + " " + rows.name +
                     (rows.may_grow ? "s, or more; give one a " : "s; give one a ") + rows.name);
}

ListedRows rungs_of(const Series& series) {
    return {series.rungs.size(), "rung", series.may_grow};
}

/// Of a table for a norm, or a value, that the study does not have.
InputError not_measured(const TableReader& table, const std::string& name,
                        const std::vector<Measure>& measures) {
    std::vector<std::string> names;
    names.reserve(measures.size());
    for (const auto& measure : measures)
        names.push_back(measure.name);
    return {table.place_of_key(name),
            table.full(name) + " expects something of what the study does not measure" +
                did_you_mean(name, names) + "; it measures " + join(names, ", ")};
}

} // namespace

CheckedExpectation held(const Metric& metric, double lowest, double highest, const Place& place) {
    const auto texts = texts_of({lowest, highest},
                                metric.value ? std::vector{*metric.value} : std::vector<double>());
    return {.what = metric.what,
            .expected = texts.wanted[0] + " to " + texts.wanted[1],
            .found = metric.value ? texts.found[0] : metric.absence,
            .place = place,
            // A figure that is not a number lies in no band.
            .holds = metric.value && *metric.value >= lowest && *metric.value <= highest};
}

std::string what_of(const TableReader& table, const std::string& key) {
    return table.full(key).substr(std::string("expect.").size());
}

std::string metric_text(double value) {
    std::ostringstream text;
    text.precision(shown_digits);
    text << value;
    return text.str();
}

std::string beginning_of(const std::string& text) {
    constexpr std::size_t most = 600;
    return text.size() <= most ? text : text.substr(0, most) + "…";
}

std::optional<double> error_of(const RungResult& run, std::size_t k) {
    return run.errors.empty() ? std::nullopt : std::optional(run.errors[k]);
}

Metric row_metric(const Series& series, const RungResult& run, std::size_t k,
                  const std::string& name, std::optional<double> value,
                  const std::string& otherwise) {
    return {series.study + "." + series.measures[k].name + ": " + name + " at " +
                run.rung.name(metric_text),
            value, run.reason.empty() ? otherwise : "no error: " + run.reason};
}

Expectation in_band(double lowest, double highest, const Place& place, Metrics metrics) {
    return [lowest, highest, place, metrics = std::move(metrics)](const StudyResult& result) {
        std::vector<CheckedExpectation> checked;
        for (const auto& metric : metrics(result))
            checked.push_back(held(metric, lowest, highest, place));
        return checked;
    };
}

void expect_band(TableReader& table, const std::string& key, std::vector<Expectation>& expectations,
                 Metrics metrics) {
    if (const auto band = table.band(key))
        expectations.push_back(
            in_band(band->lowest, band->highest, table.place(key), std::move(metrics)));
}

void expect_verdicts(TableReader& table, const ListedRows& rows,
                     const std::function<void(JudgeVerdicts)>& add) {
    const auto wanted = table.texts("verdicts");
    if (!wanted)
        return;
    require_count(table, "verdicts", wanted->size(), rows);
    const auto known = all_verdicts();
    for (std::size_t row = 0; row < wanted->size(); ++row)
        if (const auto& word = (*wanted)[row];
            std::find(known.begin(), known.end(), word) == known.end())
            throw table.error("verdicts",
                              " holds '" + word + "', which is no verdict" +
                                  did_you_mean(word, known) + "; they are " + join(known, ", "),
                              row);
    add([wanted = *wanted, place = table.place("verdicts")](
            const std::string& what, const std::vector<RowVerdict>& verdicts) {
        std::vector<std::string> found;
        found.reserve(verdicts.size());
        for (const auto& verdict : verdicts)
            found.emplace_back(name_of(verdict.verdict));
        return same(what + ": verdicts", wanted, found, place);
    });
}

void expect_words(TableReader& table, const std::string& key,
                  std::vector<Expectation>& expectations, const Words& found) {
    if (const auto wanted = table.texts(key))
        expectations.push_back(all_of(table, key, *wanted, found));
}

void expect_sentences(TableReader& table, const std::string& key,
                      std::vector<Expectation>& expectations, const Words& found) {
    const auto wanted = table.texts(key);
    if (wanted && std::ranges::find(*wanted, "") != wanted->end())
        throw table.error(key,
                          " has a text without a letter, with which any sentence begins; write "
                          "how the sentence begins");
    expect_words(table, key, expectations, [found, wanted](const auto& result) {
        auto sentences = found(result);
        for (std::size_t i = 0; i < sentences.size() && i < wanted->size(); ++i)
            if (sentences[i].starts_with((*wanted)[i]))
                sentences[i] = (*wanted)[i];
        return sentences;
    });
}

void expect_numbers(TableReader& table, const std::string& key,
                    std::vector<Expectation>& expectations, const Numbers& found) {
    const auto wanted = table.numbers(key);
    if (!wanted)
        return;
    expectations.push_back([what = what_of(table, key), wanted = *wanted, found,
                            place = table.place(key)](const StudyResult& result) {
        const auto numbers = found(result);
        const auto texts = texts_of(wanted, numbers);
        auto checked = same(what, texts.wanted, texts.found, place);
        checked.holds = std::ranges::equal(wanted, numbers, is_as_written);
        return std::vector{checked};
    });
}

void expect_refined(TableReader& table, const std::string& study,
                    std::vector<Expectation>& expectations,
                    const std::function<Refined(const StudyResult&)>& refined) {
    expect_words(table, "ended_by", expectations, [refined](const StudyResult& result) {
        return std::vector{name_of(refined(result).end)};
    });
    expect_words(table, "open", expectations,
                 [refined](const StudyResult& result) { return refined(result).open; });
    expect_numbers(table, "elements", expectations, [study](const StudyResult& result) {
        std::set<double> elements;
        for (const auto& run : runs_of(result, study))
            elements.insert(static_cast<double>(run.rung.elements));
        return std::vector<double>(elements.begin(), elements.end());
    });
    expect_numbers(table, "dt", expectations, [study](const StudyResult& result) {
        std::set<double> steps;
        for (const auto& run : runs_of(result, study))
            steps.insert(run.rung.dt);
        return std::vector<double>(steps.rbegin(), steps.rend());
    });
}

void expect_interval(TableReader& table, const std::string& key,
                     const std::function<void(JudgeInterval)>& add) {
    const auto unknown = [](const OrderInterval& interval) {
        return "not determined: " + interval.status;
    };
    const auto wanted = table.flag(key + "_determined");
    if (wanted && !*wanted)
        for (const char* figure : {"", "_holds", "_half_width"})
            if (table.has(key + figure))
                throw table.error(key + figure, " asks for a number, which " + key +
                                                    "_determined = false wants not to be there; "
                                                    "leave out one of the two");
    if (wanted)
        add([unknown, wanted, place = table.place(key + "_determined")](
                const std::string& what, const OrderInterval& interval) -> CheckedExpectation {
            return {what + ", as determined", *wanted ? "determined" : "not determined",
                    interval.determined ? "determined" : unknown(interval), place,
                    interval.determined == *wanted};
        });
    if (const auto number = table.number(key + "_holds"))
        add([unknown, number, place = table.place(key + "_holds")](
                const std::string& what, const OrderInterval& interval) -> CheckedExpectation {
            const auto texts =
                texts_of({*number}, interval.determined ? std::vector{interval.low, interval.high}
                                                        : std::vector<double>());
            return {
                what + ", interval", "one that holds " + texts.wanted[0],
                interval.determined ? texts.found[0] + " to " + texts.found[1] : unknown(interval),
                place, interval.determined && interval.low <= *number && *number <= interval.high};
        });
    if (const auto band = table.band(key + "_half_width"))
        add([unknown, band, place = table.place(key + "_half_width")](
                const std::string& what, const OrderInterval& interval) {
            return held({what + ", half of its interval",
                         interval.determined ? std::optional(interval.half_width()) : std::nullopt,
                         unknown(interval)},
                        band->lowest, band->highest, place);
        });
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

/// To the last digit.
std::string count_text(double count) {
    return fmt::format("{:.17g}", count);
}

/// A counter of each run; where none has it, what they count.
std::vector<std::string> counts_of(const std::string& name, const std::vector<RungResult>& runs) {
    std::vector<std::string> counts;
    std::vector<std::string> names;
    bool is_known = false;
    for (const auto& run : runs) {
        counts.emplace_back("none");
        for (const auto& one : run.counters) {
            if (std::ranges::find(names, one.name) == names.end())
                names.push_back(one.name);
            if (one.name == name) {
                counts.back() = count_text(static_cast<double>(one.value));
                is_known = true;
            }
        }
    }
    if (!is_known)
        counts = {"no counter of this name" + did_you_mean(name, names) + "; the runs count " +
                  (names.empty() ? "nothing" : join(names, ", "))};
    return counts;
}

void expect_counters(TableReader& table, const Series& series,
                     std::vector<Expectation>& expectations) {
    auto counters = table.table("counters");
    if (!counters)
        return;
    for (const auto& name : counters->unread()) {
        const auto wanted = counters->numbers(name);
        if (!wanted)
            continue;
        require_count(*counters, name, wanted->size(), rungs_of(series));
        std::vector<std::string> counts;
        for (const double count : *wanted)
            counts.push_back(count_text(count));
        expectations.push_back(
            all_of(*counters, name, counts, [series, name](const StudyResult& result) {
                return counts_of(name, runs_of(result, series.study));
            }));
    }
    counters->finish();
}

std::size_t
read_error_bands(TableReader& table, const ListedRows& rows,
                 const std::function<void(std::size_t, double, double, const Place&)>& add) {
    const auto given = table.number("within");
    const double within = given.value_or(1e-3);
    if (!(within > 0.0 && within <= widest_part))
        throw table.error("within", " is " + message_text(within) +
                                        "; it must be > 0 and at most 0.5: a part of each error");
    const auto errors = table.numbers("errors");
    if (!errors) {
        if (given)
            throw table.error("within", " is how near the errors must come: give errors = […]");
        return 0;
    }
    require_count(table, "errors", errors->size(), rows);
    for (std::size_t row = 0; row < errors->size(); ++row) {
        const double error = (*errors)[row];
        if (error < 0.0)
            throw table.error("errors",
                              " holds " + message_text(error) + "; errors are not below 0", row);
        add(row, error * (1.0 - within), error * (1.0 + within), table.place("errors", row));
    }
    return errors->size();
}

void expect_errors(TableReader& table, const Series& series, std::size_t k,
                   std::vector<Expectation>& expectations) {
    const std::size_t count = read_error_bands(
        table, rungs_of(series),
        [&](std::size_t row, double lowest, double highest, const Place& place) {
            expectations.push_back(
                in_band(lowest, highest, place, [series, k, row](const StudyResult& result) {
                    const auto& runs = runs_of(result, series.study);
                    if (row >= runs.size()) // their number is judged below
                        return std::vector<Metric>();
                    return std::vector{
                        row_metric(series, runs[row], k, "error", error_of(runs[row], k))};
                }));
        });
    if (count > 0 && series.may_grow)
        expectations.push_back(all_of(table, "errors", {rungs_text(count)},
                                      [study = series.study](const StudyResult& result) {
                                          return std::vector{
                                              rungs_text(runs_of(result, study).size())};
                                      }));
}

void expect_figures(TableReader& table, const std::string& study,
                    std::vector<Expectation>& expectations) {
    for (const auto& name : table.unread())
        expect_band(table, name, expectations, [study, name](const StudyResult& result) {
            const auto figures = result.figures(study);
            std::vector<std::string> names;
            names.reserve(figures.size());
            for (const auto& [known, figure] : figures)
                names.push_back(known);
            const auto found = figures.find(name);
            return std::vector{
                Metric{fmt::format("{}.{}", study, name),
                       found == figures.end() ? std::nullopt : std::optional(found->second),
                       "no figure of this name" + did_you_mean(name, names) + "; the study has " +
                           (names.empty() ? "none" : join(names, ", "))}};
        });
}

void finish_expecting(const TableReader& table, std::size_t before,
                      const std::vector<Expectation>& expectations) {
    table.finish();
    if (expectations.size() == before)
        throw table.error("", " expects nothing; give it a bound, or remove it");
}

void require_free_names(const TableReader& table, const std::vector<Measure>& measures) {
    for (const auto& measure : measures)
        if (table.is_table(measure.name))
            table.require_free(measure.name);
}

void for_each_measure(TableReader& table, const std::vector<Measure>& measures,
                      std::vector<Expectation>& expectations,
                      const std::function<void(TableReader&, std::size_t k)>& read) {
    for (std::size_t k = 0; k < measures.size(); ++k)
        if (auto inner = table.table(measures[k].name)) {
            const std::size_t before = expectations.size();
            read(*inner, k);
            finish_expecting(*inner, before, expectations);
        }
    for (const auto& name : table.unread())
        if (table.is_table(name))
            throw not_measured(table, name, measures);
}

} // namespace tvbeam

// The report of a work-precision study: what it says of made-up rows, in 80 columns.

#include "studies/work_precision/work_precision.hpp"
#include "reports/document/text_document.hpp"
#include "reports/document/work_precision_section.hpp"
#include "reports/plots/plot.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/study.hpp"
#include "studies/text/number_text.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <regex>
#include <sstream>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(work_precision_report)

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

struct Row {
    std::optional<double> error; ///< none: the run failed
    double seconds;
    int runs = 20;
};

/// Names of the greatest length, and quartiles a hundredth off the median.
struct Study {
    WorkPrecisionBlock block;
    WorkPrecisionResult result;

    void add(const std::string& name, const std::vector<Row>& rows) {
        TimedScheme scheme{name, {}, {}};
        SchemeRuns runs;
        std::int64_t elements = 10;
        for (const auto& row : rows) {
            scheme.rungs.push_back(
                {elements, 100 * elements, 0.02 / static_cast<double>(elements)});
            RungResult run;
            run.rung = scheme.rungs.back();
            run.counters = {{"steps", run.rung.steps}, {"heat_solves", run.rung.steps}};
            if (row.error)
                run.errors.assign(block.norms.size(), *row.error);
            else
                run.status = RungStatus::failed;
            run.reason = row.error ? "" : "the fixed point did not converge in step 1 of 20";
            runs.runs.push_back(run);
            Timing timing{row.seconds, 0.99 * row.seconds, row.seconds, 1.01 * row.seconds,
                          row.runs};
            runs.timings.push_back(row.error ? std::optional(timing) : std::nullopt);
            elements *= 2;
        }
        block.schemes.push_back(scheme);
        result.schemes.push_back(runs);
    }

    [[nodiscard]] std::string text() {
        result.norms = costs_of(block, result.schemes);
        return text_section(work_precision_section(result, block));
    }
};

Study study(const std::vector<std::string>& norms) {
    Study made;
    for (const auto& norm : norms)
        made.block.norms.push_back(measure_of(*Norm::named(norm)));
    made.block.final_time = 2.0;
    return made;
}

std::size_t shown(const std::string& line) {
    return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
}

} // namespace

BOOST_AUTO_TEST_CASE(every_line_fits_into_80_columns) {
    Study wide = study({"theta_LinfL2_sq", "u_LinfH2semi_sq", "theta_L2L2", "u_L2H2_sq"});
    for (const char last : {'a', 'b', 'c', 'd', 'e'})
        wide.add("a scheme of twenty-eight l." + std::string(1, last),
                 {{1e-3, 1.234e-5}, {1.5e-7, 3.21e-1}, {std::nullopt, 1.0}, {1.2e-9, 123.0, 1}});
    wide.block.targets["theta_L2L2"] = {1.23456789e-5};
    std::istringstream lines(wide.text());
    for (std::string line; std::getline(lines, line);)
        BOOST_TEST(shown(line) <= 80u, line);
}

BOOST_AUTO_TEST_CASE(the_faster_scheme_is_named_with_its_ratio_and_quartiles) {
    Study two = study({"theta_L2L2"});
    two.add("Euler", {{1e-2, 1.0}, {1e-4, 62.0}});
    two.add("BDF2", {{1e-2, 0.1}, {1e-4, 1.0}});
    two.block.targets["theta_L2L2"] = {1e-4};
    // 62 · 0.99/1.01 = 60.8 and 62 · 1.01/0.99 = 63.3
    BOOST_TEST(has(two.text(), "To reach theta_L2L2 = 1e-4:\n"
                               "BDF2 is 62 times faster than Euler (quartiles 61 … 63)\n"),
               two.text());
}

BOOST_AUTO_TEST_CASE(without_targets_the_smallest_power_of_ten_that_two_reach_is_spoken_of) {
    Study two = study({"theta_L2L2"});
    two.add("Euler", {{1e-2, 1.0}, {0.9e-4, 2.0}});
    two.add("BDF2", {{1e-2, 0.1}, {1e-6, 0.2}});
    BOOST_TEST(has(two.text(), "To reach theta_L2L2 = 1e-4:\nBDF2 is "), two.text());
}

BOOST_AUTO_TEST_CASE(times_too_near_each_other_are_not_distinguishable) {
    Study two = study({"theta_L2L2"});
    two.add("one", {{1e-2, 1.0}, {1e-4, 2.0}});
    two.add("other", {{1e-2, 1.1}, {1e-4, 2.2}});
    BOOST_TEST(
        has(two.text(), "one and other are equally fast, but for less than a fifth: ratio 1.1 "),
        two.text());
    BOOST_TEST(!has(two.text(), "faster"));
}

BOOST_AUTO_TEST_CASE(what_is_not_reached_is_blank_and_said) {
    Study two = study({"theta_L2L2"});
    two.add("coarse", {{1e-2, 1.0}, {1e-3, 2.0}});
    two.add("fine", {{1e-2, 1.0}, {1e-4, 8.0}});
    two.block.targets["theta_L2L2"] = {1e-4};
    const std::string text = two.text();
    BOOST_TEST(has(text, "fine alone has a time to reach it\n"), text);
    BOOST_TEST(has(text, "coarse does not, as far as measured\n"), text);
    BOOST_TEST(has(text, "\n      1e-4        8.00\n"), text);
    BOOST_TEST(!has(text, "1e-5"), text); // reached by none, and no target
}

BOOST_AUTO_TEST_CASE(what_is_more_accurate_in_every_row_is_not_said_to_fall_short) {
    Study two = study({"theta_L2L2"});
    two.add("one", {{1e-1, 1.0}, {1e-2, 2.0}});
    two.add("better", {{1e-3, 0.7}, {1e-4, 8.0}});
    two.add("failing", {{std::nullopt, 1.0}});
    two.block.targets["theta_L2L2"] = {1e-2};
    const std::string text = two.text();
    BOOST_TEST(has(text, "better has less in every row, after 7.00e-1 s in the quickest\n"), text);
    BOOST_TEST(has(text, "failing does not, as far as measured\n"), text);
    Study torn = study({"theta_L2L2"});
    torn.add("between", {{1e-1, 1.0}, {std::nullopt, 2.0}, {1e-3, 4.0}});
    torn.add("again", {{1e-1, 1.0}, {1e-3, 2.0}, {2e-2, 4.0}});
    torn.add("later", {{std::nullopt, 1.0}, {1e-3, 0.7}});
    torn.block.targets["theta_L2L2"] = {1e-2};
    BOOST_TEST(has(torn.text(), "between does, but not from one row to the next: one has failed\n"),
               torn.text());
    BOOST_TEST(has(torn.text(), "again does, but a finer row is above it again\n"), torn.text());
    BOOST_TEST(has(torn.text(), "later has less in every row that did not fail, after 7.00e-1 s"),
               torn.text());
}

BOOST_AUTO_TEST_CASE(of_a_scheme_without_a_time_the_reason_is_the_one_there_is) {
    Study made = study({"theta_L2L2"});
    made.add("standing", {{1e-1, 1.0}, {1e-3, 0.0}});
    made.add("coarse", {{1e-1, 0.0}, {1e-3, 1.0}});
    made.add("exact", {{1e-1, 1.0}, {0.0, 2.0}});
    made.add("quick", {{1e-3, 0.0}, {1e-4, 1.0}});
    made.block.targets["theta_L2L2"] = {1e-2};
    const std::string text = made.text();
    for (const std::string name : {"standing", "coarse"})
        BOOST_TEST(has(text, name + " does, but not from one row to the next: in one the clock "
                                    "shows 0 s\n"),
                   text);
    BOOST_TEST(has(text, "exact does, but not from one row to the next: one has the error 0\n"),
               text);
    BOOST_TEST(has(text, "quick has less in every row\n"), text); // the quickest took who knows
    // What was not timed, as an interruption came before, has not failed.
    Study cut = study({"theta_L2L2"});
    cut.add("cut", {{1e-1, 1.0}, {1e-3, 2.0}});
    cut.block.targets["theta_L2L2"] = {1e-2};
    cut.result.schemes[0].timings[1].reset();
    BOOST_TEST(has(cut.text(), "cut does, but not from one row to the next: one was not timed\n"),
               cut.text());
}

// Seven have 21 pairs, of which six are of the fastest; the first of all reaches nothing.
// 1.0077e-3 is no nearer to 1e-3 than 1 %: its time counts, and the sentence says so.
BOOST_AUTO_TEST_CASE(a_scheme_that_stays_above_an_error_is_not_said_to_reach_it) {
    Study close = study({"theta_L2L2"});
    close.add("euler", {{4e-3, 1e-3}, {1.0077e-3, 5e-3}});
    close.add("sd", {{4e-3, 5e-4}, {5e-4, 2e-3}});
    close.block.targets["theta_L2L2"] = {1e-3};
    const std::string text = close.text();
    BOOST_TEST(has(text, "sd is 4.0 times faster than euler"), text);
    BOOST_TEST(has(text, "; euler comes within 1 %\n    of it, no nearer"), text);
    BOOST_TEST(!has(text, "sd comes within"), text);
}

// By its coarser row, which is below it, the error is not reached either.
BOOST_AUTO_TEST_CASE(a_scheme_whose_errors_rise_above_an_error_again_is_not_said_to_reach_it) {
    Study rises = study({"theta_L2L2"});
    rises.add("euler", {{4e-3, 1e-3}, {5e-4, 2e-3}, {1.0077e-3, 5e-3}});
    rises.add("sd", {{4e-3, 5e-4}, {5e-4, 2e-3}});
    rises.block.targets["theta_L2L2"] = {1e-3};
    const std::string text = rises.text();
    BOOST_TEST(has(text, "; euler ends above it, by\n    1 % at most"), text);
    BOOST_TEST(!has(text, "sd ends"), text);
    // A finer row is below it, in which the clock shows nothing.
    Study quick = study({"theta_L2L2"});
    quick.add("euler", {{4e-3, 1e-3}, {1.0077e-3, 5e-3}, {5e-4, 0.0}});
    quick.add("sd", {{4e-3, 5e-4}, {5e-4, 2e-3}});
    quick.block.targets["theta_L2L2"] = {1e-3};
    const std::string short_of = std::regex_replace(quick.text(), std::regex("\\s+"), " ");
    BOOST_TEST(
        has(short_of, "; euler comes within 1 % of it, and below it in a row without a time"),
        short_of);
}

BOOST_AUTO_TEST_CASE(a_scheme_that_fails_on_finer_rows_is_said_to_beside_its_time) {
    Study fails = study({"theta_L2L2"});
    fails.add("fails", {{1e-1, 1.0}, {1e-3, 2.0}, {std::nullopt, 4.0}});
    fails.add("blows", {{1e-1, 1.0}, {1e-3, 9.0}, {std::numeric_limits<double>::infinity(), 12.0}});
    fails.add("sd", {{1e-1, 1.0}, {1e-3, 5.0}, {1e-4, 10.0}});
    fails.block.targets["theta_L2L2"] = {1e-2};
    const std::string text = std::regex_replace(fails.text(), std::regex("\\s+"), " ");
    BOOST_TEST(has(text, "; of the finer rows of fails one has failed"), text);
    BOOST_TEST(has(text, "; of the finer rows of blows one has the error inf"), text);
    BOOST_TEST(!has(text, "finer rows of sd"), text);
}

BOOST_AUTO_TEST_CASE(of_many_the_fastest_is_compared_with_each) {
    Study many = study({"theta_L2L2"});
    many.add("coarse", {{1.0, 1.0}, {1e-1, 2.0}});
    for (const double seconds : {3.0, 2.0, 5.0, 1.0, 7.0, 4.0, 6.0})
        many.add("of " + fixed(seconds, 0), {{1e-1, 0.1 * seconds}, {1e-3, seconds}});
    many.block.targets["theta_L2L2"] = {1e-3};
    const std::string text = many.text();
    for (const char slower : {'2', '3', '4', '5', '6', '7'})
        BOOST_TEST(has(text, "of 1 is " + std::string(1, slower) + ".0 times faster than of " +
                                 std::string(1, slower)),
                   text);
    BOOST_TEST(!has(text, "of 2 is "), text);
    BOOST_TEST(has(text, "the table has the others' times"), text);
}

BOOST_AUTO_TEST_CASE(quartiles_stand_below_their_headings) {
    Study one = study({"theta_L2L2"});
    one.add("plain", {{1e-3, 2e-3}});
    const std::string text = one.text();
    const auto heading = text.find("median");
    BOOST_REQUIRE(heading != std::string::npos);
    BOOST_TEST(heading < text.find("q1"));
    BOOST_TEST(text.find("q1") < text.find("q3"));
    const auto lower = text.find("1.98e-3");
    BOOST_REQUIRE(lower != std::string::npos);
    const auto upper = text.find("2.02e-3");
    BOOST_REQUIRE(upper != std::string::npos);
    BOOST_TEST(lower < upper);
}

BOOST_AUTO_TEST_CASE(one_run_is_marked_and_has_no_quartiles) {
    Study one = study({"theta_L2L2"});
    one.add("slow", {{1e-2, 1.0}, {1e-4, 3.0, 1}});
    one.add("fast", {{1e-2, 0.1}, {1e-4, 0.3}});
    const std::string text = one.text();
    BOOST_TEST(has(text, " 3.00* "), text);
    BOOST_TEST(!has(text, " 2.97 "), text);
    BOOST_TEST(has(text, "*: of one run, as a run takes long\n"), text);
    BOOST_TEST(has(text, "faster than slow (of one run)"), text);
    one.result.interrupted = true; // perhaps it was not that long
    BOOST_TEST(has(one.text(), "*: of one run\n"), one.text());
    Study many = study({"theta_L2L2"});
    many.add("fast", {{1e-2, 0.1}, {1e-4, 0.3}});
    BOOST_TEST(!has(many.text(), "*"));
}

BOOST_AUTO_TEST_CASE(a_busy_machine_is_said_behind_the_ratios) {
    Study two = study({"theta_L2L2"});
    two.add("Euler", {{1e-2, 1.0}, {1e-4, 62.0}});
    two.add("BDF2", {{1e-2, 0.1}, {1e-4, 1.0}});
    two.result.busy_remark = busy_remark(1.0, 8.0);
    const std::string text = two.text();
    BOOST_TEST(text.find("The machine was busy") > text.find("times faster"), text);
    BOOST_TEST(has(text, "The machine was busy"));
}

BOOST_AUTO_TEST_CASE(a_failed_run_stays_in_the_table_with_its_reason) {
    Study failing = study({"theta_L2L2"});
    failing.add("paper's", {{std::nullopt, 0.0}, {1e-4, 3.0}});
    const std::string text = failing.text();
    BOOST_TEST(has(text, "failed\n"), text);
    BOOST_TEST(has(text, "s = 10, dt = 2e-3 failed: the fixed point did not converge"), text);
}

BOOST_AUTO_TEST_CASE(a_ratio_is_written_without_an_exponent_where_it_is_of_usual_size) {
    for (const auto& [value, text] : {std::pair{192.3, "190"},
                                      {1.96, "2.0"},
                                      {0.0314, "0.031"},
                                      {9.97, "10"},
                                      {98765.0, "99000"},
                                      {1.9e5, "1.9e5"},
                                      {3.14e-5, "3.1e-5"},
                                      {-0.5, "-0.50"},
                                      {0.0, "0"}})
        BOOST_TEST(significant(value, 2) == text);
}

// However many errors are to be reached.
BOOST_AUTO_TEST_CASE(every_norm_has_a_figure_of_error_against_run_time) {
    for (const bool has_target : {false, true}) {
        Study made = study({"theta_L2L2", "u_LinfH2semi"});
        made.add("Euler", {{1e-2, 1.0}, {1e-4, 62.0}});
        if (has_target)
            made.block.targets["theta_L2L2"] = {1e-3, 1e-9, 1e9};
        StudyResult result = run_study(read_scene("cubic-deflection"));
        result.scene.blocks.set(made.block);
        result.records.set(made.result);
        const auto plots = run_time_plots(result);
        BOOST_REQUIRE(plots.size() == 2U);
        BOOST_TEST(plots[0].name == "run_time_theta_L2L2");
        BOOST_TEST(plots[1].name == "run_time_u_LinfH2semi");
        // Of the errors to reach those between the errors of the runs.
        std::vector<double> heights;
        for (const auto& curve : plots[0].drawing.curves())
            if (curve.data.height)
                heights.push_back(*curve.data.height);
        BOOST_TEST(heights == (has_target ? std::vector{1e-3} : std::vector<double>()),
                   boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_SUITE_END()

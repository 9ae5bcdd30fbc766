// Errors of any solver, from a CSV file: what is read, and what the analysis makes of it.

#include "mms/text/input_error.hpp"
#include "studies/data/csv_records.hpp"
#include "studies/data/record_analysis.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(records)

namespace {

std::vector<Refinement> records_of_text(const std::string& text,
                                        const std::optional<std::string>& column = {}) {
    const TemporaryDirectory directory;
    return read_records(directory.write("e.csv", text), column).records;
}

/// The message without the directory that the file stood in.
std::string message_of(const std::string& text, const std::optional<std::string>& column = {}) {
    try {
        records_of_text(text, column);
    } catch (const InputError& error) {
        const std::string what = error.what();
        return what.substr(what.find("e.csv"));
    }
    return "accepted";
}

} // namespace

BOOST_AUTO_TEST_CASE(columns_are_found_by_name_in_any_order) {
    const auto records =
        records_of_text("seconds,error,dt,note,h\n1.5,1e-2,0.1,\"a, b\",0.5\n,2.5e-3,0.05,,0.25\n");
    BOOST_REQUIRE(records.size() == 2u);
    BOOST_TEST(records[0].h == 0.5);
    BOOST_TEST(records[0].dt == 0.1);
    BOOST_TEST(records[0].error == 1e-2);
    BOOST_TEST(records[0].seconds == 1.5);
    BOOST_TEST(std::isnan(records[1].seconds));
}

BOOST_AUTO_TEST_CASE(either_width_may_be_absent_and_elements_stand_for_h) {
    BOOST_TEST(std::isnan(records_of_text("dt,error\n0.1,1\n")[0].h));
    BOOST_TEST(std::isnan(records_of_text("h,error\n0.1,1\n")[0].dt));
    BOOST_TEST(records_of_text("elements,error\n8,1\n")[0].h == 0.125);
}

BOOST_AUTO_TEST_CASE(an_empty_or_nan_error_is_a_failed_run) {
    const auto records = records_of_text("h,error\n0.1,\n0.05,nan\n0.02,1e-3\n");
    BOOST_TEST(std::isnan(records[0].error));
    BOOST_TEST(std::isnan(records[1].error));
    BOOST_TEST(records[2].error == 1e-3);
}

BOOST_AUTO_TEST_CASE(the_error_column_can_be_chosen) {
    BOOST_TEST(records_of_text("h,l2,h1\n0.1,1,2\n", "h1")[0].error == 2.0);
}

BOOST_AUTO_TEST_CASE(wrong_files_are_told_at_their_line) {
    BOOST_TEST(message_of("").starts_with("e.csv: is empty"));
    BOOST_TEST(message_of("h,error\n").starts_with("e.csv: has no records"));
    BOOST_TEST(message_of("x,error\n1,2\n").starts_with("e.csv:1: no column h, elements or dt"));
    BOOST_TEST(message_of("h,eror\n1,2\n")
                   .starts_with("e.csv:1: no column 'error'; did you mean 'eror'?"));
    BOOST_TEST(message_of("h,error\n0.1,1\n0.05\n")
                   .starts_with("e.csv:3: has 1 fields; the first line names 2"));
    BOOST_TEST(message_of("h,error\n0.1,abc\n")
                   .starts_with("e.csv:2: 'abc' in column error is not a number"));
    BOOST_TEST(message_of("h,error\n0,1\n")
                   .starts_with("e.csv:2: '0' in column h must be a positive number"));
    BOOST_TEST(message_of("h,error\n0.1,1,\"2\n").starts_with("e.csv:2:"));
    BOOST_CHECK_THROW(read_records("/no/such/file.csv", {}), InputError);
}

BOOST_AUTO_TEST_CASE(numbers_are_taken_as_other_programs_write_them) {
    const auto records = records_of_text("\xEF\xBB\xBFh,error\n+0.5,+1e-2\n0.25,1e-400\n");
    BOOST_REQUIRE(records.size() == 2u);
    BOOST_TEST(records[0].h == 0.5);
    BOOST_TEST(records[0].error == 1e-2);
    BOOST_TEST(records[1].error == 0.0);
    BOOST_TEST(message_of("h,error\n0.5,1e9999\n").find("'1e9999' in column error is too large") !=
               std::string::npos);
    BOOST_TEST(message_of("h,error\n0.5,1e400\n")
                   .starts_with("e.csv:2: '1e400' in column error is too large"));
    BOOST_TEST(message_of("h,error\n0.5,+-1\n")
                   .starts_with("e.csv:2: '+-1' in column error is not a number"));
}

BOOST_AUTO_TEST_CASE(comments_are_passed_over_and_their_lines_counted) {
    const auto records = records_of_text("# my solver\nh,error\n0.5,1\n# refined\n0.25,2\n");
    BOOST_REQUIRE(records.size() == 2u);
    BOOST_TEST(records[1].h == 0.25);
    BOOST_TEST(message_of("# my solver\nh,error\n#\n0.5,x\n").starts_with("e.csv:4: 'x'"));
}

BOOST_AUTO_TEST_CASE(a_column_named_twice_is_refused_where_it_is_used) {
    BOOST_TEST(message_of("h,error,error\n1,2,3\n").starts_with("e.csv:1: names the column error"));
    BOOST_TEST(message_of("h,note,note,error\n1,2,3,4\n") == "accepted");
}

BOOST_AUTO_TEST_CASE(other_separators_than_a_comma_are_told) {
    BOOST_TEST(message_of("h;error\n0,5;1\n").find("fields are separated by commas") !=
               std::string::npos);
}

// The order in the file is that of whoever wrote it: fine first, or as the runs came to an end.
BOOST_AUTO_TEST_CASE(a_ladder_is_sorted_from_coarse_to_fine) {
    const auto analysis = analyse(records_of_text("h,error\n0.1,0.03\n0.4,0.48\n0.05,0.0075\n"
                                                  "0.2,0.12\n"));
    BOOST_REQUIRE(analysis.records.size() == 4u);
    BOOST_TEST(analysis.records[0].h == 0.4);
    BOOST_TEST(analysis.records[3].h == 0.05);
    BOOST_REQUIRE(analysis.verdict->window);
    BOOST_TEST(analysis.verdict->window->first == 0u);
    BOOST_TEST(analysis.verdict->window->last == 3u);
    const auto in_time = analyse(records_of_text("h,dt,error\n1,0.1,3\n1,0.2,6\n1,0.4,12\n"));
    BOOST_TEST(in_time.records[0].dt == 0.4);
}

// h and dt halved in turn: five records of each width's two, 9 of 5 · 5 pairs.
BOOST_AUTO_TEST_CASE(a_staircase_is_a_ladder) {
    std::vector<Refinement> staircase;
    double h = 0.4;
    double dt = 0.1;
    for (int step = 0; step < 9; ++step) {
        staircase.push_back({.h = h, .dt = dt, .error = h * h + dt});
        (step % 2 == 0 ? h : dt) /= 2;
    }
    const auto analysis = analyse(staircase);
    BOOST_TEST(!analysis.two_term);
    BOOST_TEST(analysis.orders.size() == 9u);
}

BOOST_AUTO_TEST_CASE(a_ladder_gets_orders_and_a_power_law) {
    // e = 3 h²
    const auto analysis =
        analyse(records_of_text("h,error\n0.4,0.48\n0.2,0.12\n0.1,0.03\n0.05,0.0075\n"));
    BOOST_TEST(!analysis.two_term);
    BOOST_REQUIRE(analysis.orders.size() == 4u);
    BOOST_TEST(!analysis.orders[0]);
    BOOST_TEST(*analysis.orders[3] == 2.0, boost::test_tools::tolerance(1e-12));
    BOOST_REQUIRE(analysis.power_law);
    BOOST_TEST(analysis.power_law->p == 2.0, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(analysis.power_law->c == 3.0, boost::test_tools::tolerance(1e-10));
}

// 3 h² + 1e-3: the rows on the floor have no order, and say where the floor is.
BOOST_AUTO_TEST_CASE(a_floor_is_fitted_with_the_rows_that_show_it) {
    std::vector<Refinement> ladder;
    for (int halvings = 0; halvings < 10; ++halvings) {
        const double h = 0.8 * std::exp2(-halvings);
        ladder.push_back({.h = h, .error = 3 * h * h + 1e-3});
    }
    const auto analysis = analyse(ladder);
    BOOST_REQUIRE(analysis.power_law);
    BOOST_TEST(analysis.power_law->floor == 1e-3, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(analysis.power_law->p == 2.0, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(a_missing_fit_has_its_cause) {
    const auto cause = [](const std::string& rows) {
        return analyse(records_of_text("h,error\n" + rows)).no_power_law;
    };
    BOOST_TEST(cause("0.4,nan\n0.2,0\n") == "no row has a positive error");
    BOOST_TEST(cause("0.4,nan\n0.2,1\n") == "one row alone has a positive error");
    BOOST_TEST(cause("0.2,2\n0.2,1\n") == "all rows with a positive error have the same width");
    BOOST_TEST(cause("0.4,4\n0.2,1\n").empty());
}

// f = 2 + 3 h², fine grids first: the limit is 2, and 1.25 · 3 · 0.05² = 9.375e-3 is the index.
BOOST_AUTO_TEST_CASE(values_without_errors_are_extrapolated) {
    const TemporaryDirectory directory;
    const auto analysis = analyse(read_records(
        directory.write("v.csv", "h,value\n0.05,2.0075\n0.1,2.03\n0.2,2.12\n0.4,2.48\n"), {}));
    BOOST_REQUIRE(analysis.values);
    BOOST_TEST(analysis.values->grids.front().h == 0.4);
    BOOST_REQUIRE(analysis.values->finest);
    BOOST_TEST(analysis.values->finest->order == 2.0, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(analysis.values->finest->limit == 2.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(analysis.values->finest->gci == 9.375e-3, boost::test_tools::tolerance(1e-10));
    BOOST_REQUIRE(analysis.values->limit);
    BOOST_TEST(analysis.values->limit->limit == 2.0, boost::test_tools::tolerance(1e-8));
}

BOOST_AUTO_TEST_CASE(values_are_extrapolated_along_the_width_that_is_refined) {
    const TemporaryDirectory directory;
    const auto analysis = analyse(read_records(
        directory.write("v.csv", "h,dt,value\n0.1,0.05,2.0075\n0.1,0.1,2.03\n0.1,0.2,2.12\n"), {}));
    BOOST_TEST(analysis.values->finest->order == 2.0, boost::test_tools::tolerance(1e-10));
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"h,dt,value\n0.1,0.1,1\n0.05,0.1,2\n0.05,0.05,3\n", "has two values at h = 0.05"},
        {"h,dt,value\n0.1,0.1,1\n0.05,0.2,2\n", "makes dt coarser"},
        {"dt,value\n0.1,1\n0.1,2\n", "has two values at dt = 0.1"}};
    for (const auto& [text, message] : wrong)
        BOOST_CHECK_EXCEPTION(read_records(directory.write("w.csv", text), {}), InputError,
                              [&message = message](const InputError& error) {
                                  return std::string(error.what()).find(message) !=
                                         std::string::npos;
                              });
}

BOOST_AUTO_TEST_CASE(too_few_or_oscillating_values_have_no_order) {
    BOOST_TEST(!analyse_values({{0.4, 1}, {0.2, 2}, {0.2, 3}}).finest);
    BOOST_TEST(analyse_values({{0.4, 1}, {0.2, 2}}).no_extrapolation.find("three") !=
               std::string::npos);
    BOOST_TEST(!analyse_values({{0.4, 1}, {0.2, 2}, {0.1, 1}}).finest);
    // A file with an error column, or one that is asked for, is one of errors.
    BOOST_TEST(!analyse(records_of_text("h,value,error\n0.1,1,2\n")).values);
    BOOST_TEST(message_of("h,value\n0.1,1\n", "eror").starts_with("e.csv:1: no column 'eror'"));
}

BOOST_AUTO_TEST_CASE(a_grid_gets_the_two_term_model) {
    std::vector<Refinement> grid;
    for (const double dt : {0.1, 0.05, 0.025})
        for (const double h : {0.2, 0.1, 0.05, 0.025})
            grid.push_back(
                {.h = h, .dt = dt, .error = std::hypot(3.0 * h * h, 0.2 * dt)}); // rho = 0
    const auto analysis = analyse(grid);
    BOOST_REQUIRE(analysis.two_term);
    BOOST_TEST(analysis.orders.empty());
    BOOST_TEST(analysis.two_term->model.p == 2.0, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(analysis.two_term->model.q == 1.0, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_SUITE_END()

// Errors of any solver, from a CSV file: what is read, and what the analysis makes of it.

#include "mms/input_error.hpp"
#include "studies/csv_records.hpp"
#include "studies/record_analysis.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace tvbeam;

namespace {

std::vector<Refinement> records_of_text(const std::string& text,
                                        const std::optional<std::string>& column = {}) {
    const TemporaryDirectory directory;
    return read_records(directory.write("e.csv", text), column);
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

BOOST_AUTO_TEST_SUITE(records)

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

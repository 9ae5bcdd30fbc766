#include "studies/text/column_sizes.hpp"

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

#include <cmath>
#include <string>

BOOST_AUTO_TEST_SUITE(sizes_of_columns)

namespace {

/// Two blocks of data; each number is so many times as large.
std::string data(double factor = 1.0) {
    return fmt::format("# h, error\n{} {}\n{} {}\n\n# others\n{} {}\n{} {}\n", 0.25 * factor,
                       1e-2 * factor, 0.125 * factor, 2.5e-3 * factor, 0.5 * factor, 4e-2 * factor,
                       1.0 * factor, 0.16 * factor);
}

/// A curve from (0, 0) to (1, 1) with so many points.
std::string curve(int points) {
    std::string text = "# curve\n";
    for (int i = 0; i < points; ++i)
        text += fmt::format("{0} {0}\n", i / (points - 1.0));
    return text;
}

} // namespace

// By hand: 1 + ln(1 + 0.5/1e-6) and 1 + 0.7 ln(1 + 0.25/1e-6).
BOOST_AUTO_TEST_CASE(are_logarithms_above_a_millionth) {
    const std::string hand =
        fmt::format(" {:.3f} {:.3f}", 1.0 + std::log1p(0.5e6), 1.0 + 0.7 * std::log1p(0.25e6));
    BOOST_TEST(tvbeam::column_sizes("0.5 -0.25\n") == hand);
    BOOST_TEST(tvbeam::column_sizes("a,b\n0.5,-0.25\n") == hand);
    BOOST_TEST(tvbeam::column_sizes("1e-14 -3e-15\n") == " 1.000 1.000");
    BOOST_TEST(tvbeam::column_sizes("words alone, nan\n") == "");
    BOOST_TEST(tvbeam::column_sizes("a, b\r\n0.5, -0.25\r\n") == hand);
}

BOOST_AUTO_TEST_CASE(do_not_see_rounding_and_see_half_a_percent) {
    BOOST_TEST(tvbeam::column_sizes(data(1.0 + 1e-9)) == tvbeam::column_sizes(data()));
    BOOST_TEST(tvbeam::column_sizes(data(1.005)) != tvbeam::column_sizes(data()));
}

// Columns, rows or blocks that stand in each other's place, and a number of another row.
BOOST_AUTO_TEST_CASE(see_what_stands_elsewhere) {
    const std::string whole = tvbeam::column_sizes("1 2\n3 4\n\n5 6\n");
    for (const std::string other :
         {"2 1\n4 3\n\n6 5\n", "3 4\n1 2\n\n5 6\n", "5 6\n\n1 2\n3 4\n", "1 4\n3 2\n\n5 6\n"})
        BOOST_TEST(tvbeam::column_sizes(other) != whole);
}

// To 0.1 %, which is what a record of it allows.
BOOST_AUTO_TEST_CASE(of_a_curve_are_those_of_its_line_and_not_of_its_points) {
    const auto first = [](const std::string& text) { return std::stod(text); };
    const double size = first(tvbeam::column_sizes(curve(100)));
    BOOST_TEST(std::abs(first(tvbeam::column_sizes(curve(101))) - size) < 1e-3 * size);
}

BOOST_AUTO_TEST_CASE(are_of_blocks_that_count_as_one) {
    BOOST_TEST(tvbeam::column_sizes("1 1\n1 1\n1 1\n\n2 2\n") ==
               tvbeam::column_sizes("1 1\n\n2 2\n"));
}

BOOST_AUTO_TEST_CASE(leave_seconds_out) {
    const std::string without = tvbeam::column_sizes("h,error,reason\n0.5,0.25,\n");
    BOOST_TEST(tvbeam::column_sizes("h,error,seconds,reason\n0.5,0.25,3.5,\n") == without);
    BOOST_TEST(tvbeam::column_sizes("  h error  sec\n0.5  0.25 3.5\n") ==
               tvbeam::column_sizes("0.5 0.25\n"));
    BOOST_TEST(tvbeam::column_sizes("h,seconds_median,error\n0.5,3.5,0.25\n") == "");
    BOOST_TEST(tvbeam::column_sizes("# median of the seconds, error\n3.5 0.25\n") == "");
}

BOOST_AUTO_TEST_SUITE_END()

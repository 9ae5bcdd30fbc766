// Quartiles, the time to reach an error, and when two times are distinguishable, on made-up rows.

#include "studies/work_precision/timing.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(timings)

namespace {

constexpr double failed = std::numeric_limits<double>::quiet_NaN();

/// Quartiles a tenth off the median.
TimedError row(double error, double seconds) {
    return {error,
            {.min = 0.8 * seconds,
             .q1 = 0.9 * seconds,
             .median = seconds,
             .q3 = 1.1 * seconds,
             .runs = 20}};
}

double median(const std::vector<TimedError>& rows, double error) {
    const auto time = time_to_reach(rows, error);
    return time ? time->median : failed;
}

bool reached(const std::vector<TimedError>& rows, double error) {
    return time_to_reach(rows, error).has_value();
}

Timing timing(double q1, double median, double q3) {
    return {.min = q1, .q1 = q1, .median = median, .q3 = q3, .runs = 20};
}

const auto tight = boost::test_tools::tolerance(1e-12);

} // namespace

BOOST_AUTO_TEST_CASE(quartiles_lie_a_quarter_of_the_way_along_the_sorted_values) {
    // (n − 1)/4 = 1 and 3(n − 1)/4 = 3: the second and fourth of five.
    const Timing five = timing_of({5.0, 1.0, 3.0, 2.0, 4.0});
    BOOST_TEST(five.min == 1.0);
    BOOST_TEST(five.q1 == 2.0);
    BOOST_TEST(five.median == 3.0);
    BOOST_TEST(five.q3 == 4.0);
    BOOST_TEST(five.runs == 5);
    // Of four they are at 3/4, 3/2 and 9/4 from the first.
    const Timing four = timing_of({4.0, 3.0, 2.0, 1.0});
    BOOST_TEST(four.q1 == 1.75);
    BOOST_TEST(four.median == 2.5);
    BOOST_TEST(four.q3 == 3.25);
}

BOOST_AUTO_TEST_CASE(one_run_is_its_own_quartiles) {
    const Timing one = timing_of({3.0});
    BOOST_TEST(one.min == 3.0);
    BOOST_TEST(one.q1 == 3.0);
    BOOST_TEST(one.median == 3.0);
    BOOST_TEST(one.q3 == 3.0);
    BOOST_TEST(one.runs == 1);
}

BOOST_DATA_TEST_CASE(the_time_to_reach_an_error_is_exact_on_a_power_law,
                     data::make({0.9, 0.3, 1e-2, 5e-4, 2.0e-8}), error) {
    // An error h^4 in a time h^−2 takes error^(−1/2).
    std::vector<TimedError> rows;
    for (const double h : {1.0, 0.5, 0.1, 0.01})
        rows.push_back(row(h * h * h * h, 1.0 / (h * h)));
    const auto time = time_to_reach(rows, error);
    BOOST_REQUIRE(time);
    const double expected = 1.0 / std::sqrt(error);
    BOOST_TEST(time->median == expected, tight);
    BOOST_TEST(time->min == 0.8 * expected, tight);
    BOOST_TEST(time->q1 == 0.9 * expected, tight);
    BOOST_TEST(time->q3 == 1.1 * expected, tight);
}

BOOST_AUTO_TEST_CASE(nothing_is_extrapolated) {
    const std::vector<TimedError> rows{row(1e-2, 1.0), row(1e-4, 10.0)};
    BOOST_TEST(!reached(rows, 2e-2));
    BOOST_TEST(!reached(rows, 5e-5));
    BOOST_TEST(!reached({}, 1e-3));
    BOOST_TEST(!reached({row(failed, 1.0), row(failed, 1.0)}, 1e-3));
}

BOOST_AUTO_TEST_CASE(the_errors_of_the_rows_themselves_are_inside_also_as_they_are_written_down) {
    const std::vector<TimedError> rows{row(1.24547e-3, 1.0), row(1.666565e-8, 10.0)};
    for (const double error : {1.24547e-3, 1.2455e-3, 1.25e-3})
        BOOST_TEST(median(rows, error) == 1.0);
    for (const double error : {1.666565e-8, 1.6665e-8, 1.66e-8})
        BOOST_TEST(median(rows, error) == 10.0, tight);
    BOOST_TEST(median(rows, 1.6666e-8) == 10.0, boost::test_tools::tolerance(1e-4));
    // More than 1 % off is another error.
    BOOST_TEST(!reached(rows, 1.6e-8));
    BOOST_TEST(!reached(rows, 1.3e-3));
}

BOOST_AUTO_TEST_CASE(one_row_reaches_its_own_error_only) {
    const std::vector<TimedError> rows{row(1e-4, 2.0)};
    BOOST_TEST(median(rows, 1e-4) == 2.0);
    BOOST_TEST(!reached(rows, 1e-3));
    BOOST_TEST(!reached(rows, 1e-5));
}

BOOST_AUTO_TEST_CASE(nothing_is_interpolated_across_a_row_without_error) {
    for (const double missing : {failed, 0.0, std::numeric_limits<double>::infinity()}) {
        const std::vector<TimedError> rows{row(1e-1, 1.0), row(1e-2, 2.0), row(missing, 4.0),
                                           row(1e-4, 8.0), row(1e-5, 16.0)};
        BOOST_TEST(reached(rows, 3e-2));
        BOOST_TEST(!reached(rows, 1e-3));
        BOOST_TEST(reached(rows, 3e-5));
        // The rows beside it have their own errors still.
        BOOST_TEST(median(rows, 1e-2) == 2.0, tight);
        BOOST_TEST(median(rows, 0.995e-2) == 2.0);
        BOOST_TEST(median(rows, 1e-4) == 8.0);
    }
    // A coarsest or finest row that failed takes nothing from the others.
    const std::vector<TimedError> ends{row(failed, 1.0), row(1e-2, 2.0), row(1e-4, 4.0),
                                       row(failed, 8.0)};
    BOOST_TEST(median(ends, 1e-3) == 2.0 * std::sqrt(2.0), tight);
    BOOST_TEST(median(ends, 1e-2) == 2.0);
    BOOST_TEST(median(ends, 1e-4) == 4.0);
    BOOST_TEST(!reached(ends, 1e-5));
}

BOOST_AUTO_TEST_CASE(a_dip_is_not_an_error_reached) {
    const std::vector<TimedError> rows{row(1e-1, 1.0), row(1e-5, 2.0), row(1e-2, 4.0),
                                       row(1e-3, 8.0)};
    BOOST_TEST(!reached(rows, 1e-4)); // the finest row exceeds it
    // Below the third row's error the line from the third to the fourth counts.
    BOOST_TEST(median(rows, std::sqrt(1e-5)) == 4.0 * std::sqrt(2.0), tight);
    // Above it, that from the first to the second.
    const double weight = std::log(1e-1 / 5e-2) / std::log(1e-1 / 1e-5);
    BOOST_TEST(median(rows, 5e-2) == std::exp2(weight), tight);
}

// Whoever wants an error below 1e-2 takes the third row.
BOOST_AUTO_TEST_CASE(a_finer_row_that_is_cheaper_counts) {
    const std::vector<TimedError> rows{row(1e-1, 1.0), row(1e-2, 10.0), row(1e-3, 2.0),
                                       row(1e-4, 4.0)};
    BOOST_TEST(median(rows, 1e-2) == 2.0, tight);
    BOOST_TEST(median(rows, 5e-2) == 2.0, tight);
    BOOST_TEST(median(rows, 9e-2) < 2.0); // so near to the first row it is cheaper yet
    BOOST_TEST(median(rows, 1e-4) == 4.0, tight);
}

BOOST_AUTO_TEST_CASE(a_row_with_the_error_of_its_neighbour_is_no_division_by_zero) {
    const std::vector<TimedError> rows{row(1e-1, 1.0), row(1e-2, 2.0), row(1e-2, 4.0),
                                       row(1e-3, 8.0)};
    BOOST_TEST(median(rows, 1e-2) == 2.0, tight); // the first of the two
    BOOST_TEST(median(rows, 0.999e-2) > 4.0);
    BOOST_TEST(median(rows, 0.999e-2) < 4.01);
    BOOST_TEST(median({row(1e-2, 2.0), row(1e-2, 4.0)}, 1e-2) == 2.0);
}

BOOST_AUTO_TEST_CASE(the_fewer_runs_of_two_rows_count) {
    std::vector<TimedError> rows{row(1e-1, 1.0), row(1e-2, 2.0)};
    rows[1].timing.runs = 1;
    BOOST_TEST(time_to_reach(rows, 5e-2)->runs == 1);
}

BOOST_AUTO_TEST_CASE(a_ratio_above_1_2_with_disjoint_quartiles_is_distinguishable) {
    const Comparison apart = compare(timing(0.9, 1.0, 1.1), timing(1.2, 1.3, 1.4));
    BOOST_TEST(apart.first_is_faster);
    BOOST_TEST(apart.distinguishable);
    BOOST_TEST(apart.ratio == 1.3, tight);
    BOOST_TEST(apart.lowest == 1.2 / 1.1, tight);
    BOOST_TEST(apart.highest == 1.4 / 0.9, tight);
    // Below 1.2, however small the spread.
    BOOST_TEST(!compare(timing(1.0, 1.0, 1.0), timing(1.19, 1.19, 1.19)).distinguishable);
    BOOST_TEST(!compare(timing(1.0, 1.0, 1.0), timing(1.2, 1.2, 1.2)).distinguishable);
    // With quartiles that meet, however large the ratio.
    BOOST_TEST(!compare(timing(0.5, 1.0, 2.0), timing(2.0, 3.0, 4.0)).distinguishable);
    // Of equal times.
    const Comparison same = compare(timing(1.0, 1.0, 1.0), timing(1.0, 1.0, 1.0));
    BOOST_TEST(!same.distinguishable);
    BOOST_TEST(same.ratio == 1.0);
}

BOOST_AUTO_TEST_CASE(single_runs_are_distinguishable_from_twice_the_time_on) {
    const Timing many = timing(1.0, 1.0, 1.0);
    Timing once = timing(1.9, 1.9, 1.9);
    BOOST_TEST(compare(many, once).distinguishable);
    once.runs = 1;
    BOOST_TEST(!compare(many, once).distinguishable);
    once.q1 = once.median = once.q3 = 2.1;
    BOOST_TEST(compare(many, once).distinguishable);
}

BOOST_AUTO_TEST_CASE(the_step_of_a_clock_is_the_greatest_that_divides_its_times) {
    BOOST_TEST(clock_step_of({0.12, 0.3, 7.0}) == 0.01);
    BOOST_TEST(clock_step_of({3.0, 12.0}) == 1.0);
    BOOST_TEST(clock_step_of({0.12, 0.123456}) == 1e-6);
    BOOST_TEST(clock_step_of({0.12, 0.1234567}) == 0.0);
    BOOST_TEST(clock_step_of({1234567.89}) == 0.01);
    // Ticks, to all their digits and as printed with few decimals.
    BOOST_TEST(clock_step_of({1 / 60.0, 7 / 60.0, 12 / 60.0}) == 1 / 60.0);
    BOOST_TEST(clock_step_of({0.015625, 0.046875, 1.0}) == 1 / 64.0);
    BOOST_TEST(clock_step_of({0.016, 0.047, 0.156}) == 1 / 64.0);
    BOOST_TEST(clock_step_of({0.004, 0.012, 0.028, 0.056, 0.064}) == 0.004);
    BOOST_TEST(clock_step_of({0.004, 0.013, 0.028, 0.056, 0.064}) == 0.001);
    // Few times to the millisecond may be whole ticks by chance, or have eight in each.
    BOOST_TEST(clock_step_of({0.004, 0.008}) == 0.001);
    BOOST_TEST(clock_step_of({0.008, 0.016, 0.032, 0.016}) == 0.001);
    BOOST_TEST(clock_step_of({0.003, 0.007, 0.010, 0.017}) == 0.001);
    BOOST_TEST(clock_step_of({0.0, 0.003}) == 0.001);
    BOOST_TEST(clock_step_of({0.125, 0.25, 0.375}) == 0.001);
    BOOST_TEST(clock_step_of({0.00333, 0.01333, 0.02}) == 1 / 300.0);
}

BOOST_AUTO_TEST_CASE(the_step_of_a_clock_is_no_less_than_the_last_digit_printed) {
    BOOST_TEST(clock_step_of({0.1, 0.003}, 0.1) == 0.1); // 1e-01 and 3e-03
    BOOST_TEST(clock_step_of({200.0}, 100.0) == 100.0);
    // 0.10 is a multiple of 0.1 by chance, one in ten; so are two, one in a hundred.
    BOOST_TEST(clock_step_of({0.1, 0.1, 0.1}, 0.01) == 0.01);
    BOOST_TEST(clock_step_of({0.1, 0.2}, 0.01) == 0.01);
    // 0.120000 and 0.130000 are by a clock of hundredths, but for one chance in 1e8.
    BOOST_TEST(clock_step_of({0.12, 0.13}, 1e-6) == 0.01);
    BOOST_TEST(clock_step_of({0.016, 0.047, 0.156}, 0.001) == 1 / 64.0);
    // Milliseconds are no whole sixtieths, though 2.00 and 4.02 are, to a hundredth.
    BOOST_TEST(clock_step_of({0.0012, 0.0041, 0.0023, 0.0017, 2.0, 4.02}, 0.01) == 0.01);
}

// What both rows are off by in part, a time between them is off by in the same part.
BOOST_AUTO_TEST_CASE(between_rows_a_time_is_known_as_well_as_in_them) {
    const auto step = [](double coarse, double fine) {
        std::vector<TimedError> rows{row(1e-2, 1.0), row(1e-4, 100.0)};
        rows[0].timing.clock_step = coarse;
        rows[1].timing.clock_step = fine;
        return time_to_reach(rows, 1e-3)->clock_step; // after 10 s
    };
    BOOST_TEST(step(0.1, 10.0) == 1.0, tight);
    BOOST_TEST(step(0.2, 0.0) == 1.0, tight); // 20 % and 0 %
    BOOST_TEST(step(0.0, 0.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(times_that_a_step_of_the_clock_may_have_made_are_not_distinguishable) {
    // 0.026 s and 0.024 s, to two decimals, as often as one likes.
    Timing fast = timing(0.02, 0.02, 0.02);
    Timing slow = timing(0.04, 0.04, 0.04);
    BOOST_TEST(compare(fast, slow).distinguishable);
    fast.clock_step = slow.clock_step = 0.01;
    const Comparison coarse = compare(fast, slow);
    BOOST_TEST(!coarse.distinguishable);
    BOOST_TEST(coarse.lowest == 1.0, tight);
    BOOST_TEST(coarse.highest == 5.0, tight);
    BOOST_TEST(coarse.clock_step == 0.01);
    // What shows one step may have taken no time at all.
    fast = timing(0.01, 0.01, 0.01);
    fast.clock_step = 0.01;
    BOOST_TEST(compare(fast, slow).highest == std::numeric_limits<double>::infinity());
    // Of two clocks that which tells less of its time is spoken of.
    fast = {.q1 = 1, .median = 1, .q3 = 1, .runs = 5, .clock_step = 0.02};
    slow = {.q1 = 100, .median = 100, .q3 = 100, .runs = 5, .clock_step = 0.5};
    BOOST_TEST(compare(fast, slow).clock_step == 0.02);
    // A step that is small beside the times has no word.
    BOOST_TEST(compare(timing(2.0, 2.0, 2.0),
                       {.q1 = 4, .median = 4, .q3 = 4, .runs = 5, .clock_step = 0.01})
                   .clock_step == 0.0);
}

BOOST_AUTO_TEST_CASE(the_order_of_two_schemes_changes_only_which_is_called_faster) {
    const Timing a = timing(1.0, 2.0, 3.0);
    const Timing b = timing(7.0, 8.0, 9.0);
    const Comparison forth = compare(a, b);
    const Comparison back = compare(b, a);
    BOOST_TEST(forth.first_is_faster != back.first_is_faster);
    BOOST_TEST(forth.ratio == back.ratio);
    BOOST_TEST(forth.lowest == back.lowest);
    BOOST_TEST(forth.highest == back.highest);
    BOOST_TEST(forth.distinguishable == back.distinguishable);
}

BOOST_AUTO_TEST_SUITE_END()

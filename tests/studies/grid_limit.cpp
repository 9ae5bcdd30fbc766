// The limit of values on a grid of h and Δt, where no exact solution is known.

#include "studies/grid/grid_limit.hpp"
#include "studies/data/printed_digits.hpp"

#include <boost/test/unit_test.hpp>

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(limits_on_grids)

namespace {

using Value = std::function<double(double h, double dt)>;

std::vector<RungResult> grid_of(const Value& value, double ratio_of_steps = 2.0) {
    std::vector<RungResult> runs;
    for (double dt = 0.2; dt > 0.19 * std::pow(ratio_of_steps, -4.0); dt /= ratio_of_steps)
        for (const std::int64_t s : {4, 8, 16, 32, 64}) {
            const Rung rung{s, 0, dt};
            runs.push_back({.rung = rung, .errors = {value(rung.h(), dt)}});
        }
    return runs;
}

bool holds(const OrderInterval& interval, double number) {
    return interval.determined && interval.low <= number && number <= interval.high;
}

} // namespace

BOOST_AUTO_TEST_CASE(powers_that_add_up_have_their_orders_and_limit) {
    const GridLimit found =
        limit_of("drag", grid_of([](double h, double dt) { return 3.0 + h * h - 0.5 * dt; }), 0);
    BOOST_TEST(holds(found.limit, 3.0));
    BOOST_TEST(holds(found.p, 2.0));
    BOOST_TEST(holds(found.q, 1.0));
    // Of the finest value both errors are uncertain.
    const double error = 0.5 * 0.0125 - 1.0 / 64 / 64;
    BOOST_TEST(found.uncertainty >= error);
    BOOST_TEST(found.uncertainty < 2.0 * error);
    BOOST_TEST(found.limit.half_width() < 0.2 * error);
}

// The sum of the two limits lacks what both widths do together: the interval holds it.
BOOST_AUTO_TEST_CASE(what_both_widths_do_together_is_in_the_interval) {
    for (const double mixed : {30.0, -30.0, 300.0}) {
        const auto runs = grid_of(
            [&](double h, double dt) { return 3.0 + h * h - 0.5 * dt + mixed * h * h * dt; });
        const GridLimit found = limit_of("drag", runs, 0);
        BOOST_TEST(holds(found.limit, 3.0), mixed);
        // m at the finest run; the limits alone are known far better than that.
        BOOST_TEST(found.limit.half_width() >= std::abs(mixed) / 64 / 64 * 0.0125);
        BOOST_TEST(std::abs(found.limit.value - 3.0) > 0.5 * std::abs(mixed) / 64 / 64 * 0.0125);
    }
}

// What both do together is known from four runs: without one of them it may be anything.
BOOST_AUTO_TEST_CASE(a_failed_run_next_to_the_finest_leaves_no_limit) {
    auto runs = grid_of([](double h, double dt) { return 3.0 + h * h - 0.5 * dt + 3.0 * h * dt; });
    const GridLimit whole = limit_of("drag", runs, 0);
    BOOST_TEST(holds(whole.limit, 3.0));
    std::set<double> h, dt;
    for (const auto& run : runs) {
        h.insert(run.rung.h());
        dt.insert(run.rung.dt);
    }
    for (auto& run : runs)
        if (run.rung.h() == *std::next(h.begin()) && run.rung.dt == *std::next(dt.begin()))
            run.errors.clear();
    const GridLimit found = limit_of("drag", runs, 0);
    BOOST_TEST(!found.limit.determined);
    BOOST_TEST(found.limit.status.find("next to the finest") != std::string::npos);
}

// The limit is that of the finest runs; one that has nothing to do with them is named, and none
// that differs by terms of both widths.
BOOST_AUTO_TEST_CASE(values_out_of_line_are_named) {
    for (const double mixed : {0.0, 3.0, -300.0}) {
        auto runs = grid_of([&](double h, double dt) {
            return 3.0 + h * h - 0.5 * dt + mixed * h * h * dt + mixed * h * dt * dt;
        });
        BOOST_TEST(limit_of("drag", runs, 0).out_of_line.empty(), mixed);
        runs.front().errors[0] += 1e6;
        const auto named = limit_of("drag", runs, 0).out_of_line;
        BOOST_REQUIRE(named.size() == 1U);
        BOOST_TEST(named[0].elements == runs.front().rung.elements);
        BOOST_TEST(named[0].dt == runs.front().rung.dt);
    }
}

// Rounding of the four finest values is multiplied by what grows with the widths.
BOOST_AUTO_TEST_CASE(values_of_few_digits_are_in_line) {
    const auto laws = {+[](double h, double dt) { return 2.5 + 20.0 * h * dt * dt; },
                       +[](double h, double dt) { return 0.5 * (1.0 + 48.0 * h * h * dt); },
                       +[](double h, double dt) { return 1.0 + 32.0 * h * h * dt * dt; }};
    for (const auto& law : laws)
        for (const int decimals : {3, 4, 5}) {
            const double unit = std::pow(10.0, -decimals);
            auto runs =
                grid_of([&](double h, double dt) { return unit * std::round(law(h, dt) / unit); });
            for (auto& run : runs)
                run.printed = {printed_digits(fmt::format("{:.{}f}", run.errors[0], decimals))};
            const GridLimit found = limit_of("drag", runs, 0);
            BOOST_TEST(found.out_of_line.empty(), decimals);
        }
}

// Of m h² Δt, where h is halved and Δt a third, (2² − 1)(3 − 1) m h² Δt is what four runs show;
// each order belongs to its own width.
BOOST_AUTO_TEST_CASE(what_both_widths_do_together_is_sized_by_their_own_orders) {
    const double mixed = 3000.0;
    const double dt = 0.2 / 625.0;
    const GridLimit found = limit_of(
        "drag",
        grid_of(
            [&](double h, double step) { return 3.0 + h * h - 0.5 * step + mixed * h * h * step; },
            5.0),
        0);
    const double both = mixed / 64 / 64 * dt;
    BOOST_TEST(found.limit.half_width() >= 0.99 * both);
    BOOST_TEST(found.limit.half_width() <= 1.3 * both);
}

BOOST_AUTO_TEST_CASE(of_many_grids_the_intervals_hold_the_limit) {
    std::mt19937_64 generator(7);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(generator() >> 11U), -53);
    };
    int determined = 0;
    int held = 0;
    for (int i = 0; i < 60; ++i) {
        const double p = between(0.6, 3.0), q = between(0.6, 2.2);
        const double a = between(-2.0, 2.0), b = between(-2.0, 2.0), c = between(-3.0, 3.0);
        const double d = between(-1.0, 1.0), e = between(-1.0, 1.0);
        const GridLimit found = limit_of("drag", grid_of([&](double h, double dt) {
                                             return 1.0 + a * std::pow(h, p) * (1.0 + d * h) +
                                                    b * std::pow(dt, q) * (1.0 + e * dt) +
                                                    c * std::pow(h, p) * std::pow(dt, q);
                                         }),
                                         0);
        determined += found.limit.determined ? 1 : 0;
        held += holds(found.limit, 1.0) ? 1 : 0;
    }
    BOOST_TEST_MESSAGE("determined " << determined << " of 60, of these held " << held);
    BOOST_TEST(determined >= 50);
    BOOST_TEST(held >= 0.95 * determined);
}

BOOST_AUTO_TEST_CASE(without_a_limit_it_is_said_why) {
    auto runs = grid_of([](double h, double dt) { return 3.0 + h * h - 0.5 * dt; });
    runs.back().errors.clear();
    BOOST_TEST(limit_of("drag", runs, 0).limit.status == "the finest run has no value");
    // Steps that grow up to the finest.
    const GridLimit found = limit_of(
        "drag", grid_of([](double h, double dt) { return h * h + std::pow(dt, -0.5); }), 0);
    BOOST_TEST(!found.limit.determined);
    BOOST_TEST(found.limit.status.starts_with("in dt: "), found.limit.status);
}

BOOST_AUTO_TEST_SUITE_END()

// The power with which a difference goes to zero, when that is below one.

#include "mms/local_power.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <limits>

using Eigen::ArrayXd;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(local_power)

namespace {

/// Of g(s) - g(0), which doubles of the size of g hold, at t = 0.3 of a phase of length 1.
double power_of(const std::function<double(double)>& g, double size = 1.0) {
    return power_below_one(
        [&](double s) -> ArrayXd { return ArrayXd::Constant(1, (size + g(s)) - size); }, 0.3, 1.0,
        size);
}

} // namespace

// However steep the smooth part is, another power is not named; and none is missed beside which
// the smooth part is not the greater one.
BOOST_AUTO_TEST_CASE(a_power_is_known_beside_what_is_smooth_or_not_named) {
    for (double beta = 0.05; beta < 0.93; beta += 0.01)
        for (double decade = -1.0; decade < 5.0; decade += 0.05)
            for (const double sign : {1.0, -1.0}) {
                const double slope = sign * std::pow(10.0, decade);
                const double found =
                    power_of([&](double s) { return std::pow(s, beta) + slope * s; });
                BOOST_TEST((std::isinf(found) || std::abs(found - beta) < 5e-3),
                           "s^" << beta << " + " << slope << " s: " << found);
                const bool leads = std::abs(slope) * std::pow(1e-12, 1.0 - beta) < 1.0;
                if (leads && beta < 0.8)
                    BOOST_TEST(!std::isinf(found), "s^" << beta << " + " << slope << " s");
            }
}

BOOST_AUTO_TEST_CASE(what_has_a_slope_has_no_power_below_one_however_steep_it_is) {
    for (int k = 0; k <= 140; ++k)
        for (const double slope : {0.0, 40.0, -40.0}) {
            const double width = std::pow(10.0, -1.0 - 0.1 * k);
            const auto is_none = [&](const auto& layer) {
                const double found =
                    power_of([&](double s) { return layer(s / width) + slope * s; });
                BOOST_TEST(std::isinf(found), width << " and " << slope << ": " << found);
            };
            is_none([](double s) { return -std::expm1(-s); });
            is_none([](double s) { return std::tanh(s); });
            is_none([](double s) { return std::atan(s); });
            is_none([](double s) { return 1.0 - std::cos(s); });
            is_none([](double s) { return s / (1.0 + s); });
            is_none([](double s) { return std::tanh(s) + 0.2 * std::tanh(s / 30.0); });
            is_none([](double s) { return std::log1p(s) / 30.0; });
            is_none([](double s) { return std::asinh(s) / 30.0; });
        }
    // A sine that has turned may seem a power by two ratios of three.
    for (double decade = -16.0; decade < -9.0; decade += 2e-4) {
        const double width = std::pow(10.0, decade);
        BOOST_TEST(std::isinf(power_of([&](double s) { return std::sin(s / width); })), width);
    }
    BOOST_TEST(std::isinf(power_of([](double s) { return s; })));
    BOOST_TEST(std::isinf(power_of([](double s) { return s * s; })));
    BOOST_TEST(std::isinf(power_of([](double /*s*/) { return 0.0; })));
}

// A value that is another one than the limit.
BOOST_AUTO_TEST_CASE(a_jump_is_no_power) {
    for (const double slope : {0.0, 1.0, -40.0})
        BOOST_TEST(std::isinf(power_of([&](double s) { return 0.3 + slope * s; })));
}

// With a logarithm, or a larger power that is nearly as large, it changes slowly with s: the order
// is one near it, and not a full one.
BOOST_AUTO_TEST_CASE(what_is_nearly_a_power_is_told_as_one_near_it) {
    const double with_logarithm = power_of([](double s) { return std::sqrt(s) * std::log(s); });
    const double two = power_of([](double s) { return std::sqrt(s) + 10.0 * std::pow(s, 0.6); });
    BOOST_TEST(std::abs(with_logarithm - 0.5) < 0.06);
    BOOST_TEST(std::abs(two - 0.5) < 0.06);
}

// Times of a late, short phase are rounded to what is a part of each distance.
BOOST_AUTO_TEST_CASE(a_smooth_pulse_of_a_late_and_short_phase_has_a_slope) {
    for (const auto& [begin, length] :
         {std::pair(0.9, 6e-5), std::pair(10.0, 1e-3), std::pair(600.0, 0.06),
          std::pair(1000.0, 0.06), std::pair(100.0, 0.0077)}) {
        const auto pulse = [&, from = begin, over = length](double t) {
            return std::sin(6.283185307179586 * 3.0 * (t - from) / over);
        };
        for (const double at : {begin, begin + length / 7.0}) {
            const double found = power_below_one(
                [&](double s) -> ArrayXd {
                    return ArrayXd::Constant(1, pulse(at + s) - pulse(at));
                },
                at, length, 1.0);
            BOOST_TEST(std::isinf(found), at << ", " << length << ": " << found);
        }
    }
}

// At t = 1000 doubles are 1e-13 apart.
BOOST_AUTO_TEST_CASE(a_power_is_known_late_in_time) {
    for (const double begin : {1.0, 30.0, 1000.0})
        for (const double beta : {0.1, 0.5, 0.7})
            for (const double direction : {1.0, -1.0}) {
                const double found = power_below_one(
                    [&](double s) -> ArrayXd {
                        const double apart = std::abs(begin + direction * s - begin);
                        return ArrayXd::Constant(1, std::pow(apart, beta));
                    },
                    begin, 1.0, 1.0);
                BOOST_TEST(std::abs(found - beta) < 1e-3, begin << ": " << found);
            }
}

BOOST_AUTO_TEST_CASE(what_stands_beyond_the_phase_is_not_read) {
    for (const double length : {1.0, 1e-3, 1e-6, 1e-9})
        power_below_one(
            [&](double s) -> ArrayXd {
                BOOST_TEST(2.0 * s <= length);
                return ArrayXd::Constant(1, std::sqrt(s));
            },
            1000.0, length, 1.0);
}

// At the first place the power is the greater one at the nearest distance alone.
BOOST_AUTO_TEST_CASE(powers_of_different_places_are_not_mixed) {
    const double found = power_below_one(
        [](double s) -> ArrayXd {
            return ArrayXd{{6e-3 * std::sqrt(s), 1e3 * std::pow(s, 0.9)}};
        },
        0.3, 1.0, 1.0);
    BOOST_TEST(std::abs(found - 0.5) < 1e-3);
}

BOOST_AUTO_TEST_CASE(a_power_is_known_beside_a_slope_at_another_place) {
    const double found = power_below_one(
        [](double s) -> ArrayXd {
            return ArrayXd{{0.0, std::pow(s, 0.8), 100.0 * s, 0.5 * std::pow(s, 0.8) - 200.0 * s}};
        },
        0.3, 1.0, 1.0);
    BOOST_TEST(std::abs(found - 0.8) < 2e-3);
}

BOOST_AUTO_TEST_CASE(a_power_is_said_to_a_hundredth) {
    BOOST_TEST(local_power_text(0.8) == "0.8");
    BOOST_TEST(local_power_text(2.0 / 3) == "0.67");
    BOOST_TEST(local_power_text(1.8004) == "1.8");
    BOOST_TEST(local_power_text(0.5049) == "0.5");
}

BOOST_AUTO_TEST_SUITE_END()

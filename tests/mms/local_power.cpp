// The power with which a difference goes to zero, when that is below one.

#include "mms/local_power.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(local_power)

namespace {

/// Of |g(s) - g(0)|, which doubles of the size of g hold.
double power_of(const std::function<double(double)>& g, double size) {
    return power_below_one([&](double s) { return std::abs((size + g(s)) - size); }, 1.0, size);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_power_is_known_beside_what_is_smooth) {
    for (const double beta : {0.05, 0.2, 0.5, 2.0 / 3, 0.8, 0.9})
        for (const double slope : {0.0, 1.0, 5.0, -5.0, 40.0, -40.0}) {
            // Beyond, it is the greater one of both nearly everywhere.
            if (std::abs(slope) * std::pow(1e-12, 1.0 - beta) > 0.2)
                continue;
            const double found =
                power_of([&](double s) { return std::pow(s, beta) + slope * s; }, 1.0);
            BOOST_TEST(std::abs(found - beta) < 5e-3,
                       "s^" << beta << " + " << slope << " s: " << found);
        }
}

BOOST_AUTO_TEST_CASE(what_has_a_slope_has_no_power_below_one_however_steep_it_is) {
    for (int k = 0; k <= 140; ++k)
        for (const double slope : {0.0, 40.0, -40.0}) {
            const double width = std::pow(10.0, -1.0 - 0.1 * k);
            const double of_exp =
                power_of([&](double s) { return -std::expm1(-s / width) + slope * s; }, 1.0);
            const double of_tanh =
                power_of([&](double s) { return std::tanh(s / width) + slope * s; }, 1.0);
            BOOST_TEST(std::isinf(of_exp), width << " and " << slope << ": " << of_exp);
            BOOST_TEST(std::isinf(of_tanh), width << " and " << slope << ": " << of_tanh);
        }
    BOOST_TEST(std::isinf(power_of([](double s) { return s; }, 1.0)));
    BOOST_TEST(std::isinf(power_of([](double s) { return s * s; }, 1.0)));
    BOOST_TEST(std::isinf(power_of([](double /*s*/) { return 0.0; }, 1.0)));
}

// A value that is another one than the limit: no power of s.
BOOST_AUTO_TEST_CASE(a_jump_is_no_power) {
    for (const double slope : {0.0, 1.0, -40.0})
        BOOST_TEST(std::isinf(power_of([&](double s) { return 0.3 + slope * s; }, 1.0)));
}

BOOST_AUTO_TEST_CASE(a_power_is_said_to_a_hundredth) {
    BOOST_TEST(local_power_text(0.8) == "0.8");
    BOOST_TEST(local_power_text(2.0 / 3) == "0.67");
    BOOST_TEST(local_power_text(1.8004) == "1.8");
    BOOST_TEST(local_power_text(0.5049) == "0.5");
}

BOOST_AUTO_TEST_SUITE_END()

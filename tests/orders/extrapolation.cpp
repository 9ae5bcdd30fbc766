#include "studies/orders/extrapolation.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(extrapolation)

// f = f₀ + C hᵖ is what the formula inverts: order and limit come back at any two ratios, equal or
// not.
void extrapolates_exactly(double p, double ratio) {
    const auto value = [p](double h) { return GridValue{h, -2.0 + 5.0 * std::pow(h, p)}; };
    const auto found = richardson(value(0.2), value(0.1), value(0.1 / ratio));
    BOOST_REQUIRE(found.has_value());
    // Differences of values near 2 carry an absolute error of 4e-16, on a smallest difference of
    // about 5 · 0.1^3.7 = 1e-3: 1e-12 in the order, with room for the quotient.
    BOOST_TEST(std::abs(found->order - p) < 1e-10);
    BOOST_TEST(std::abs(found->limit + 2.0) < 1e-11);
    // The index is 1.25 times the distance to the limit, 5 (0.1 / r)ᵖ here.
    BOOST_TEST(std::abs(found->gci - 1.25 * 5.0 * std::pow(0.1 / ratio, p)) < 1e-11);
}

BOOST_AUTO_TEST_CASE(a_pure_power_is_extrapolated_exactly) {
    for (const double p : {0.5, 1.0, 2.0, 3.7})
        for (const double ratio : {1.3, 2.0, 10.0})
            BOOST_TEST_CONTEXT("order " << p << ", ratio " << ratio) {
                extrapolates_exactly(p, ratio);
            }
}

// Values that run apart, 1, 2, 4: the differences double, so the order is −1 and there is no limit.
BOOST_AUTO_TEST_CASE(divergence_has_a_negative_order_and_no_limit) {
    const auto found = richardson({1.0, 1.0}, {0.5, 2.0}, {0.25, 4.0});
    BOOST_TEST(found->order == -1.0, boost::test_tools::tolerance(1e-11));
    BOOST_TEST(std::isnan(found->limit));
    BOOST_TEST(std::isinf(found->gci));
}

// Equal differences: f runs like the logarithm of h, order zero.
BOOST_AUTO_TEST_CASE(equal_differences_have_order_zero) {
    BOOST_TEST(std::abs(*observed_order({1.0, 3.0}, {0.5, 2.0}, {0.25, 1.0})) < 1e-11);
}

BOOST_AUTO_TEST_CASE(oscillating_or_standing_values_have_no_order) {
    BOOST_TEST(!richardson({1.0, 1.0}, {0.5, 2.0}, {0.25, 1.5}).has_value());
    BOOST_TEST(!richardson({1.0, 1.0}, {0.5, 1.0}, {0.25, 1.0}).has_value());
    BOOST_TEST(!richardson({1.0, 2.0}, {0.5, 1.0}, {0.25, 1.0}).has_value());
    BOOST_TEST(!richardson({1.0, 2.0}, {0.5, std::nan("")}, {0.25, 1.0}).has_value());
}

// Roache's own numbers for two grids of ratio 2 and order 2: F |ε| / (r² − 1) = 3 |ε| / 3 = |ε|.
BOOST_AUTO_TEST_CASE(with_order_two_assumed_and_halving_the_index_is_the_difference) {
    const auto found = richardson({0.2, 1.4}, {0.1, 1.1}, 2.0);
    BOOST_TEST(found.gci == 0.3, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(found.limit == 1.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(grids_that_are_not_refined_are_refused) {
    BOOST_CHECK_THROW(observed_order({1, 1}, {1, 2}, {0.5, 3}), std::invalid_argument);
    BOOST_CHECK_THROW(richardson({0.5, 1}, {1.0, 2}, 2.0), std::invalid_argument);
    BOOST_CHECK_THROW(richardson({1.0, 1}, {0.5, 2}, 0.0), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(the_fit_to_many_grids_finds_order_and_limit) {
    std::vector<GridValue> grids;
    for (const double h : {0.3, 0.2, 0.1, 0.05, 0.02})
        grids.push_back({h, 1e6 + 40 * std::pow(h, 1.5)});
    const auto fit = fit_limit(grids);
    BOOST_REQUIRE(fit.has_value());
    // Values near 1e6 are known to 1e-10; the finest difference is 0.3, so orders to some 1e-9.
    BOOST_TEST(std::abs(fit->order - 1.5) < 1e-7);
    BOOST_TEST(std::abs(fit->limit - 1e6) < 1e-6);
    BOOST_TEST(fit->order_uncertainty() < 1e-6);
    BOOST_TEST(fit->uncertainty >= 1.25 * 40 * std::pow(0.02, 1.5) - 1e-5);
}

// One third-order term beside the second-order one: the triplets' orders run from 2.3 down to 2,
// and the quoted uncertainty reaches from the fitted order to each of them.
BOOST_AUTO_TEST_CASE(the_uncertainty_of_the_order_covers_the_scatter) {
    std::vector<GridValue> grids;
    for (const double h : {0.4, 0.2, 0.1, 0.05, 0.025})
        grids.push_back({h, h * h + h * h * h});
    const auto fit = fit_limit(grids);
    BOOST_REQUIRE(fit.has_value());
    for (std::size_t i = 2; i < grids.size(); ++i) {
        const double order = *observed_order(grids[i - 2], grids[i - 1], grids[i]);
        BOOST_TEST(std::abs(order - fit->order) <= fit->order_uncertainty() + 1e-12);
    }
    BOOST_TEST(std::abs(fit->limit) <= fit->uncertainty);
}

BOOST_AUTO_TEST_CASE(too_few_grids_have_no_fit) {
    const std::vector<GridValue> three{{0.4, 1}, {0.2, 0.5}, {0.1, 0.25}};
    BOOST_TEST(!fit_limit(three).has_value());
    const std::vector<GridValue> flat{{0.4, 1}, {0.2, 1}, {0.1, 1}, {0.05, 1}};
    BOOST_TEST(!fit_limit(flat).has_value());
}

BOOST_AUTO_TEST_SUITE_END()

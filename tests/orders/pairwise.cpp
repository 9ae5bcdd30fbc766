#include "studies/orders/observed_order.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(pairwise_orders)

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A quotient of two logarithms, each good to an ulp or two.
constexpr double few_ulp = 1e-14;

} // namespace

// e = C hᵖ makes ln(e₁/e₂) = p ln(h₁/h₂), whatever C and the ratio: 1.01 and 10 as well as 2.
void has_its_exponent(double p, double ratio) {
    std::vector<Refinement> ladder;
    for (int i = 0; i < 5; ++i) {
        const double h = 0.3 * std::pow(ratio, -i);
        ladder.push_back({.h = h, .error = 7 * std::pow(h, p)});
    }
    const auto orders = observed_orders(ladder);
    BOOST_TEST(orders.size() == ladder.size());
    BOOST_TEST(!orders[0].has_value());
    // Rounding of e itself, 2⁻⁵³ and some ulp of pow, is divided by the ln of the ratio.
    for (std::size_t i = 1; i < ladder.size(); ++i)
        BOOST_TEST(std::abs(*orders[i] - p) < 20 * few_ulp / std::log(ratio));
}

BOOST_AUTO_TEST_CASE(a_power_law_has_its_exponent_at_any_ratio) {
    for (const double p : {-1.0, 0.5, 1.0, 2.0, 4.0})
        for (const double ratio : {1.01, 2.0, 10.0})
            BOOST_TEST_CONTEXT("order " << p << ", ratio " << ratio) {
                has_its_exponent(p, ratio);
            }
}

BOOST_AUTO_TEST_CASE(a_growing_error_has_a_negative_order) {
    const std::vector<Refinement> ladder{{.h = 1.0, .error = 1.0}, {.h = 0.1, .error = 10.0}};
    BOOST_TEST(*observed_orders(ladder)[1] == -1.0, boost::test_tools::tolerance(few_ulp));
}

BOOST_AUTO_TEST_CASE(equal_errors_have_order_zero) {
    const std::vector<Refinement> ladder{{.h = 1.0, .error = 0.3}, {.h = 0.5, .error = 0.3}};
    BOOST_TEST(*observed_orders(ladder)[1] == 0.0);
}

// Neither a zero nor a failed error has a logarithm; the row itself and the next have no order.
void has_no_order(double error) {
    const std::vector<Refinement> ladder{{.h = 1.0, .error = 1.0},
                                         {.h = 0.5, .error = error},
                                         {.h = 0.25, .error = 0.25},
                                         {.h = 0.125, .error = 0.125}};
    const auto orders = observed_orders(ladder);
    BOOST_TEST(!orders[1].has_value());
    BOOST_TEST(!orders[2].has_value());
    BOOST_TEST(*orders[3] == 1.0, boost::test_tools::tolerance(few_ulp));
}

BOOST_AUTO_TEST_CASE(an_error_without_logarithm_has_no_order) {
    for (const double error : {0.0, -1.0, not_a_number, infinity, -infinity})
        BOOST_TEST_CONTEXT("error " << error) {
            has_no_order(error);
        }
}

BOOST_AUTO_TEST_CASE(no_order_without_refinement) {
    const std::vector<Refinement> ladder{{.h = 0.5, .dt = 0.1, .error = 1.0},
                                         {.h = 0.5, .dt = 0.1, .error = 0.5},
                                         {.h = 0.5, .error = 0.25},
                                         {.error = 0.125},
                                         {.h = 0.0, .error = 0.1},
                                         {.h = -1.0, .error = 0.1}};
    for (const auto& order : observed_orders(ladder))
        BOOST_TEST(!order.has_value());
    BOOST_TEST(observed_orders({}).empty());
}

// Error 8 → 1. h halves: order 3 in h. Only Δt, by 4: order 3/2 in Δt. Both (Δt ∝ h²): in h.
BOOST_AUTO_TEST_CASE(the_ratio_is_that_of_h_where_h_is_refined) {
    const Refinement coarse{.h = 1.0, .dt = 1.0, .error = 8.0};
    const auto order_to = [&](double h, double dt) {
        const std::vector<Refinement> ladder{coarse, {.h = h, .dt = dt, .error = 1.0}};
        return *observed_orders(ladder)[1];
    };
    BOOST_TEST(order_to(0.5, 1.0) == 3.0, boost::test_tools::tolerance(few_ulp));
    BOOST_TEST(order_to(1.0, 0.25) == 1.5, boost::test_tools::tolerance(few_ulp));
    BOOST_TEST(order_to(0.5, 0.25) == 3.0, boost::test_tools::tolerance(few_ulp));

    const std::vector<Refinement> in_time{{.dt = 1.0, .error = 8.0}, {.dt = 0.5, .error = 2.0}};
    BOOST_TEST(*observed_orders(in_time)[1] == 2.0, boost::test_tools::tolerance(few_ulp));
}

BOOST_AUTO_TEST_CASE(one_width_finer_and_the_other_coarser_is_no_refinement) {
    const Refinement fine_in_h{.h = 0.05, .dt = 0.1, .error = 0.9};
    const Refinement fine_in_dt{.h = 0.1, .dt = 0.05, .error = 0.5};
    BOOST_TEST(!refinement_ratio(fine_in_h, fine_in_dt).has_value());
    BOOST_TEST(!refinement_ratio(fine_in_dt, fine_in_h).has_value());
    BOOST_TEST(!observed_orders(std::array{fine_in_dt, fine_in_h})[1].has_value());
}

// 1e200 / 1e-200 is not a double; its logarithm is.
BOOST_AUTO_TEST_CASE(no_overflow_between_far_errors) {
    const std::vector<Refinement> ladder{{.h = 1.0, .error = 1e200}, {.h = 0.1, .error = 1e-200}};
    BOOST_TEST(*observed_orders(ladder)[1] == 400.0, boost::test_tools::tolerance(few_ulp));
}

BOOST_AUTO_TEST_SUITE_END()

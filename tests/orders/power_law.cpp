#include "studies/orders/convergence_fit.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(power_law)

namespace {

std::vector<Refinement> ladder_of(const std::vector<double>& widths, auto error) {
    std::vector<Refinement> ladder;
    ladder.reserve(widths.size());
    for (const double h : widths)
        ladder.push_back({.h = h, .error = error(h)});
    return ladder;
}

const std::vector<double> uneven{0.5, 0.3, 0.1, 0.08, 0.01, 0.004};

} // namespace

// On data that obey the model the least squares are zero at the truth, and the truth is the answer.
BOOST_AUTO_TEST_CASE(a_power_law_is_recovered_with_its_sign) {
    for (const double p : {-1.0, 0.5, 2.0, 4.0}) {
        const auto fit =
            fit_power_law(ladder_of(uneven, [&](double h) { return 7 * std::pow(h, p); }));
        BOOST_REQUIRE(fit.has_value());
        BOOST_TEST(std::abs(fit->p - p) < 1e-12);
        BOOST_TEST(fit->c == 7.0, boost::test_tools::tolerance(1e-11));
        BOOST_TEST(fit->p_uncertainty() < 1e-11);
        BOOST_TEST(fit->dof == 4);
    }
}

// ln e = 0, 1, 0 at ln h = 0, 1, 2: slope 0, mean 1/3, residuals −1/3, 2/3, −1/3, χ² = 2/3 with one
// degree of freedom; Σ(x − 1)² = 2, so var p = (2/3) / 2 = 1/3 and var ln C = (2/3)(1/3 + 1/2) =
// 5/9. The 97.5 % point of Student's t with one degree of freedom is tan(0.475 π).
BOOST_AUTO_TEST_CASE(standard_errors_are_those_of_linear_regression) {
    const double e = std::exp(1.0);
    const std::vector<Refinement> ladder{
        {.h = 1, .error = 1}, {.h = e, .error = e}, {.h = e * e, .error = 1}};
    const auto fit = fit_power_law(ladder);
    BOOST_TEST(std::abs(fit->p) < 1e-12);
    BOOST_TEST(fit->c == std::exp(1.0 / 3), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(fit->rms == std::sqrt(2.0 / 3), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(fit->p_se == std::sqrt(1.0 / 3), boost::test_tools::tolerance(1e-10));
    BOOST_TEST(fit->log_c_se == std::sqrt(5.0 / 9), boost::test_tools::tolerance(1e-10));
    BOOST_TEST(fit->p_half_width == std::tan(0.475 * M_PI) * std::sqrt(1.0 / 3),
               boost::test_tools::tolerance(1e-8));
    // In the middle of the ladder, at ln h = 1, the value does not depend on the slope, so that
    // cov(ln C, p) = −1 · var p.
    BOOST_TEST(fit->covariance(0, 1) == -1.0 / 3, boost::test_tools::tolerance(1e-10));
    // The pairs have orders 1 and −1 about a fit of 0.
    BOOST_TEST(fit->p_scatter == 1.0, boost::test_tools::tolerance(1e-10));
}

// A weight of k is k equal records, in the estimate.
BOOST_AUTO_TEST_CASE(a_weight_counts_as_that_many_records) {
    const std::vector<Refinement> once{
        {.h = 1, .error = 1}, {.h = 0.5, .error = 0.3}, {.h = 0.2, .error = 0.02}};
    std::vector<Refinement> thrice = once;
    thrice.push_back(once[2]);
    thrice.push_back(once[2]);
    const std::vector<double> weights{1, 1, 3};
    const auto weighted = fit_power_law(once, {.weights = weights});
    const auto repeated = fit_power_law(thrice);
    BOOST_TEST(weighted->p == repeated->p, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(weighted->c == repeated->c, boost::test_tools::tolerance(1e-10));
}

// Any two errors lie on a power law. Its exponent is right and says nothing: the interval is the
// whole line.
BOOST_AUTO_TEST_CASE(two_points_have_an_order_and_an_infinite_uncertainty) {
    const auto fit = fit_power_law(ladder_of({1.0, 0.1}, [](double h) { return h; }));
    BOOST_TEST(std::abs(fit->p - 1) < 1e-12);
    BOOST_TEST(std::isinf(fit->p_se));
    BOOST_TEST(std::isinf(fit->p_uncertainty()));
}

BOOST_AUTO_TEST_CASE(less_than_two_widths_have_no_fit) {
    BOOST_TEST(!fit_power_law({}).has_value());
    BOOST_TEST(!fit_power_law(ladder_of({1.0}, [](double) { return 1.0; })).has_value());
    BOOST_TEST(!fit_power_law(ladder_of({1.0, 1.0, 1.0}, [](double) { return 1.0; })).has_value());
}

BOOST_AUTO_TEST_CASE(records_without_logarithm_are_left_out) {
    auto ladder = ladder_of(uneven, [](double h) { return h * h; });
    ladder[1].error = 0;
    ladder[3].error = std::numeric_limits<double>::quiet_NaN();
    const auto fit = fit_power_law(ladder);
    BOOST_TEST(fit->used == (std::vector<std::size_t>{0, 2, 4, 5}));
    BOOST_TEST(std::abs(fit->p - 2) < 1e-12);
}

BOOST_AUTO_TEST_CASE(the_time_step_is_the_width_where_h_stands_still) {
    std::vector<Refinement> ladder;
    ladder.reserve(uneven.size());
    for (const double dt : uneven)
        ladder.push_back({.h = 0.1, .dt = dt, .error = 3 * dt});
    BOOST_TEST(fit_power_law(ladder)->p == 1.0, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_floor_is_recovered) {
    for (const double p : {1.0, 2.0, 4.0}) {
        const auto ladder = ladder_of({0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625},
                                      [&](double h) { return 3 * std::pow(h, p) + 1e-3; });
        const auto fit = fit_power_law(ladder, {.with_floor = true});
        BOOST_REQUIRE(fit.has_value());
        BOOST_TEST(fit->p == p, boost::test_tools::tolerance(1e-6));
        BOOST_TEST(fit->floor == 1e-3, boost::test_tools::tolerance(1e-6));
        BOOST_TEST(fit->error(0.1) == 3 * std::pow(0.1, p) + 1e-3,
                   boost::test_tools::tolerance(1e-6));
        // Without the floor one line goes through a bend. The uncertainty reaches to every pair.
        const auto blind = fit_power_law(ladder);
        for (const auto& order : observed_orders(ladder))
            BOOST_TEST((!order || std::abs(*order - blind->p) <= blind->p_uncertainty() + 1e-12));
    }
}

BOOST_AUTO_TEST_CASE(no_floor_is_read_out_of_a_power_law) {
    const auto ladder = ladder_of(uneven, [](double h) { return 3 * h * h; });
    const auto fit = fit_power_law(ladder, {.with_floor = true});
    BOOST_TEST(fit->floor == 0.0);
    BOOST_TEST(fit->p == 2.0, boost::test_tools::tolerance(1e-12));
}

// Differences to the run at h = 0.05 are 3 (h² − 0.05²). Taken for errors they look like an order
// above 2, for the finest is too small; the model with the reference in it has the order.
BOOST_AUTO_TEST_CASE(the_error_of_a_reference_run_is_accounted_for) {
    const double reference = 0.05;
    const auto ladder = ladder_of({0.4, 0.2, 0.1, 0.075},
                                  [&](double h) { return 3 * (h * h - reference * reference); });
    const auto fit = fit_power_law(ladder, {.reference_width = reference});
    BOOST_TEST(fit->p == 2.0, boost::test_tools::tolerance(1e-7));
    BOOST_TEST(fit->c == 3.0, boost::test_tools::tolerance(1e-7));
    BOOST_TEST(fit_power_law(ladder)->p > 2.2);
    BOOST_CHECK_THROW(fit_power_law(ladder, {.reference_width = 0.1}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(unsound_weights_are_refused) {
    const auto ladder = ladder_of({1.0, 0.5, 0.25}, [](double h) { return h; });
    const std::vector<double> two{1, 1};
    const std::vector<double> zero{1, 1, 0};
    BOOST_CHECK_THROW(fit_power_law(ladder, {.weights = two}), std::invalid_argument);
    BOOST_CHECK_THROW(fit_power_law(ladder, {.weights = zero}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

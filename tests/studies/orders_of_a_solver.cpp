// The order analysis of any solver that can be called: it knows of widths and errors alone.

#include "studies/data/solver_analysis.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(solvers)

namespace {

using Errors = std::map<std::string, double>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// y' = y cos t up to t = 1, y(0) = 1; y = e^{sin t}. One method of order 4 and one of order 2.
Errors ordinary(double /*h*/, double dt) {
    const auto slope = [](double t, double y) { return y * std::cos(t); };
    double fourth = 1.0;
    double second = 1.0;
    const int steps = static_cast<int>(std::lround(1.0 / dt));
    for (int n = 0; n < steps; ++n) {
        const double t = n * dt;
        const double k1 = slope(t, fourth);
        const double k2 = slope(t + dt / 2.0, fourth + dt / 2.0 * k1);
        const double k3 = slope(t + dt / 2.0, fourth + dt / 2.0 * k2);
        const double k4 = slope(t + dt, fourth + dt * k3);
        fourth += dt * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
        second += dt * slope(t + dt / 2.0, second + dt / 2.0 * slope(t, second));
    }
    const double exact = std::exp(std::sin(1.0));
    return {{"Runge-Kutta", std::abs(fourth - exact)}, {"midpoint", std::abs(second - exact)}};
}

/// u_t = u_xx with u0 = sin πx up to t = 0.1, by central differences and implicit Euler: sin πx_i
/// is an eigenvector, so the amplitude is multiplied by 1/(1 + Δt λ_h), λ_h = 4 sin²(πh/2)/h².
Errors heat(double h, double dt) {
    const double final_time = 0.1;
    const double sine = std::sin(std::numbers::pi * h / 2.0);
    const double steps = std::round(final_time / dt);
    const double amplitude = std::pow(1.0 + dt * 4.0 * sine * sine / (h * h), -steps);
    return {{"max", std::abs(amplitude - std::exp(-std::pow(std::numbers::pi, 2) * final_time))}};
}

std::vector<Widths> steps(int first, int count) {
    std::vector<Widths> widths;
    for (int k = 0; k < count; ++k)
        widths.push_back({none, 1.0 / (first << k)});
    return widths;
}

} // namespace

BOOST_AUTO_TEST_CASE(orders_of_a_ladder_are_those_of_the_methods) {
    const SolverAnalysis analysis = analyse(ordinary, steps(32, 5));
    BOOST_REQUIRE(analysis.runs.size() == 5U);
    BOOST_REQUIRE(analysis.errors.size() == 2U);
    for (const auto& [name, order] : {std::pair("Runge-Kutta", 4.0), std::pair("midpoint", 2.0)}) {
        const RecordAnalysis& one = analysis.errors.at(name);
        BOOST_TEST(!one.two_term);
        BOOST_TEST(one.along.order.determined);
        BOOST_TEST(std::abs(one.along.order.value - order) <= one.along.order.half_width());
        BOOST_REQUIRE(one.orders.back());
        BOOST_TEST(std::abs(*one.orders.back() - order) <= 0.05);
        BOOST_TEST((one.verdict->rows.back().verdict == Verdict::asymptotic));
        // The errors are those of the runs, in their order.
        for (std::size_t i = 0; i < 5; ++i) {
            BOOST_TEST(one.records[i].error == analysis.runs[i].errors.at(name));
            BOOST_TEST(one.records[i].dt == analysis.runs[i].widths.dt);
            BOOST_TEST(one.records[i].seconds >= 0.0);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_grid_gives_the_orders_in_both_widths_and_their_constants) {
    std::vector<Widths> grid;
    for (const int s : {8, 16, 32, 64})
        for (const int n : {40, 80, 160, 320})
            grid.push_back({1.0 / s, 0.1 / n});
    const RecordAnalysis found = analyse(heat, grid).errors.at("max");
    BOOST_REQUIRE(found.two_term);
    const TwoTermFit& fit = *found.two_term;
    BOOST_REQUIRE_MESSAGE(fit.holds(), fit.failure);
    BOOST_TEST(std::abs(fit.model.p - 2.0) <= 0.05);
    BOOST_TEST(std::abs(fit.model.q - 1.0) <= 0.05);
    // λ_h = π² − π⁴h²/12 + …, and (1 + Δtλ)^{−T/Δt} = e^{−λT} (1 + λ²TΔt/2 + …): both terms make
    // the amplitude too large.
    const double fourth = std::pow(std::numbers::pi, 4) * 0.1 * std::exp(-0.1 * 9.8696);
    BOOST_TEST(fit.model.spatial(1.0 / 32) == fourth / 12.0 / 1024.0,
               boost::test_tools::tolerance(0.03));
    BOOST_TEST(fit.model.temporal(0.1 / 80) == fourth / 2.0 * 0.1 / 80,
               boost::test_tools::tolerance(0.03));
}

BOOST_AUTO_TEST_CASE(a_run_that_throws_is_one_that_failed_and_keeps_its_reason) {
    const auto breaks = [](double h, double dt) -> Errors {
        if (dt == 1.0 / 16)
            throw std::runtime_error("the factor is not positive");
        Errors errors = ordinary(h, dt);
        if (dt == 1.0 / 32)
            errors.erase("midpoint");
        return errors;
    };
    const SolverAnalysis analysis = analyse(breaks, steps(8, 5));
    BOOST_TEST(analysis.runs[1].failure == "the factor is not positive");
    BOOST_TEST(analysis.runs[1].errors.empty());
    BOOST_TEST(analysis.runs[0].failure.empty());
    const RecordAnalysis& fourth = analysis.errors.at("Runge-Kutta");
    BOOST_TEST(std::isnan(fourth.records[1].error));
    BOOST_TEST((fourth.verdict->rows[1].verdict == Verdict::failed));
    BOOST_TEST(std::isfinite(fourth.records[2].error));
    const RecordAnalysis& second = analysis.errors.at("midpoint");
    BOOST_TEST(std::isnan(second.records[1].error));
    BOOST_TEST(std::isnan(second.records[2].error));
    BOOST_TEST(std::isfinite(second.records[3].error));
}

BOOST_AUTO_TEST_CASE(an_error_that_the_first_run_does_not_give_is_analysed) {
    const auto fails_first = [](double h, double dt) -> Errors {
        if (dt == 1.0 / 8)
            throw std::runtime_error("no step is that long");
        return ordinary(h, dt);
    };
    const SolverAnalysis analysis = analyse(fails_first, steps(8, 6));
    BOOST_REQUIRE(analysis.errors.contains("midpoint"));
    const RecordAnalysis& found = analysis.errors.at("midpoint");
    BOOST_TEST(std::isnan(found.records.front().error));
    BOOST_TEST(std::abs(found.along.order.value - 2.0) <= found.along.order.half_width());
}

// A method with a defect: what must not pass for convergence.
BOOST_AUTO_TEST_CASE(an_error_that_stands_still_is_not_asymptotic) {
    const auto stuck = [](double h, double dt) -> Errors {
        return {{"midpoint", ordinary(h, dt).at("midpoint") + 0.01}};
    };
    const RecordAnalysis found = analyse(stuck, steps(8, 6)).errors.at("midpoint");
    BOOST_TEST((found.verdict->rows.back().verdict == Verdict::floor),
               name_of(found.verdict->rows.back().verdict));
    BOOST_TEST(analyse(stuck, {}).runs.empty());
    BOOST_TEST(analyse(stuck, {}).errors.empty());
}

BOOST_AUTO_TEST_SUITE_END()

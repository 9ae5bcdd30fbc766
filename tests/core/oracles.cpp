// Oracles that are not a solver: statics in closed form, scalar problems and their recurrences.

#include "studies/stress/mode_solution.hpp"
#include "tests/marching.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(oracles)

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// f = L 4x(1 − x) and G = A, so that μ = A (1 − x), both constant in time.
ProblemData constant_loads(double heating, double shear) {
    return forced_problem(
        {{[=](double) { return heating; },
          [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 4.0 * x * (1.0 - x); }},
         {[=](double) { return shear; }, {}}});
}

} // namespace

BOOST_DATA_TEST_CASE(long_steps_end_in_the_static_solution,
                     data::make(all_schemes) * data::make({0.0, 0.4, 1e3}) *
                         data::make({1, 2, 7, 40}),
                     scheme, gap, elements) {
    // −θ'' = f has θ = L (x − 2x³ + x⁴)/3, which linear elements have at the nodes; w = −αΘ − A(1 −
    // x) + λ(1 − x), so the tip stands at u = −α ∫(1 − x)I_hθ − A/3 + λ/3, free or on the stop. A
    // step forgets all but 1/(π²Δt) = 1e-4 of the state before, so eight leave nothing.
    const double heating = 3.0;
    const double shear = -4.0;
    const Beam beam{.alpha = 0.5, .zeta = 0.1, .stops = {-1.0, gap == 0.0 ? 1e300 : gap}};
    const Mesh mesh = Mesh::uniform(elements);
    const Eigen::ArrayXd& x = mesh.nodes;
    const Eigen::ArrayXd theta = heating * (x - 2.0 * x.cube() + x.square().square()) / 3.0;
    DiscontinuousLinear ends(2, elements);
    ends.row(0) = theta.head(elements).transpose();
    ends.row(1) = theta.tail(elements).transpose();
    const double free_tip = -beam.alpha * tip_moment(mesh, ends) - shear / 3.0;
    const double stress = std::min(0.0, 3.0 * (beam.stops.upper - free_tip));
    const ProblemData problem = constant_loads(heating, shear);
    const double dt = 1e3;
    const auto solver = make_solver(beam, problem, mesh, scheme, dt, Needs{});
    march(*solver, problem, scheme.time, dt, 8, [](double) {});
    const double tolerance = scheme.algorithm == Algorithm::direct
                                 ? 30.0 * epsilon
                                 : 1e-12 * std::max(1.0, std::pow(elements / 10.0, 4));
    BOOST_TEST((solver->temperature().array() - theta).abs().maxCoeff() <= tolerance);
    BOOST_TEST(std::abs(solver->tip_displacement() - free_tip - stress / 3.0) <= tolerance);
    BOOST_TEST(std::abs(solver->contact_stress() - stress) <= 3.0 * tolerance);
    BOOST_TEST((stress != 0.0) == (gap == 0.4));
}

BOOST_DATA_TEST_CASE(stability_function_is_the_schemes,
                     data::make(TimeScheme::names()) * data::xrange(-10, 13), time, power) {
    // Two elements have one inner node: MΘ' + KΘ = 0 with M = 1/2, K = 4, so z = −8Δt; and
    // the curvature of a beam without heat has w' = −w/ζ, z = −Δt/ζ. R is 1/(1 − z) of Euler and
    // (1 + (1 − 2γ)z)/(1 − γz)² of SDIRK2; BDF2 has y_2 = (4y_1 − y_0)/(3 − 2z) after a step of
    // SDIRK2. A solver keeps increments, so its round-off is that of the state before.
    const double minus_z = std::pow(10.0, power);
    const long double z = -static_cast<long double>(minus_z);
    const long double gamma = 1.0L - std::sqrt(0.5L);
    const long double sdirk2 =
        (1.0L + (1.0L - 2.0L * gamma) * z) / ((1.0L - gamma * z) * (1.0L - gamma * z));
    std::vector<long double> expected{1.0L};
    if (time == "euler")
        expected = {1.0L / (1.0L - z), 1.0L / ((1.0L - z) * (1.0L - z))};
    else if (time == "sdirk2")
        expected = {sdirk2, sdirk2 * sdirk2};
    else
        expected = {sdirk2, (4.0L * sdirk2 - 1.0L) / (3.0L - 2.0L * z)};

    ProblemData problem;
    const auto one = [](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return 0.0 * x + 1.0;
    };
    problem.theta_initial.rest = one;
    problem.curvature_initial.rest = one;
    const Mesh mesh = Mesh::uniform(2);
    const double dt = minus_z / 8.0;
    const Beam beam{.zeta = dt / minus_z};
    const Scheme scheme{Algorithm::direct, ThermalMass::lumped, 0.0, TimeScheme::named(time)};
    const auto solver = make_solver(beam, problem, mesh, scheme, dt, Needs{true, true, true});
    std::size_t n = 0;
    march(*solver, problem, scheme.time, dt, 2, [&](double) {
        const auto r = static_cast<double>(expected[n++]);
        BOOST_TEST(std::abs(solver->temperature()(1) - r) <= 30.0 * epsilon);
        BOOST_TEST((solver->curvature() - r).abs().maxCoeff() <= 30.0 * epsilon);
    });
}

BOOST_DATA_TEST_CASE(a_million_steps_neither_grow_nor_drift, data::make(TimeScheme::names()),
                     time) {
    // Without sources the mode sin πx obeys a recurrence in two numbers, here in long double. Its
    // energy falls in every step (Euler: energy law; the others: A-stability), and a million steps
    // add up at most a million roundings.
    const int steps = short_tests ? 10'000 : 1'000'000;
    const int elements = 4;
    const double dt = 1.0 / steps;
    const Beam beam{.alpha = 0.6, .zeta = 0.2};
    ProblemData problem;
    problem.theta_initial.rest = [](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return (std::numbers::pi * x).sin();
    };
    const Mesh mesh = Mesh::uniform(elements);
    const Scheme scheme{Algorithm::direct, ThermalMass::consistent, 0.0, TimeScheme::named(time)};
    const auto modes = discrete_mode(beam, ThermalMass::consistent, scheme.time.name, elements,
                                     {1.0L, 0.0L}, false, dt, steps);
    const auto solver = make_solver(beam, problem, mesh, scheme, dt, Needs{true, true, true});
    double before = std::numeric_limits<double>::infinity();
    int grown = 0;
    march(*solver, problem, scheme.time, dt, steps, [&](double) {
        // ½‖Θ‖² + ½‖w‖² but for a factor: both are multiples of the same function.
        const double theta = solver->temperature()(2);
        const double w = solver->curvature()(0, 2);
        const double energy = theta * theta + w * w;
        grown += energy > before * (1.0 + 4.0 * epsilon) ? 1 : 0;
        before = energy;
    });
    BOOST_TEST(grown == 0);
    const auto end = static_cast<double>(modes.back().theta);
    BOOST_TEST(std::abs(solver->temperature()(2) - end) <= 1e-11);
}

BOOST_DATA_TEST_CASE(contact_begins_and_ends_when_the_scalar_problem_says,
                     data::make(all_schemes) * data::make({100, 1000, 10000}), scheme, steps) {
    // A load in proportion to the moment arm, μ = (−a + bt)(1 − x), bends the beam in proportion to
    // it: w = v (1 − x), ζv' + v = a − bt + λ, u = v/3, from rest v = a − bt + bζ − (a + bζ)
    // e^{−t/ζ}. The tip meets g2 when v = 3g2; on the stop v' = 0 and λ = 3g2 − a + bt, which ends
    // at t = (a − 3g2)/b; afterwards v falls for ever. So there are two switches.
    const double a = 2.0;
    const double b = 1.5;
    const double zeta = 0.5;
    const double g2 = 0.25;
    const auto free_v = [&](double t) {
        return a - b * t + b * zeta - (a + b * zeta) * std::exp(-t / zeta);
    };
    double onset = 0.0;
    double above = 0.6; // the top of v lies behind
    for (int i = 0; i < 100; ++i)
        (free_v((onset + above) / 2.0) < 3.0 * g2 ? onset : above) = (onset + above) / 2.0;
    const double release = (a - 3.0 * g2) / b;

    const Beam beam{.zeta = zeta, .stops = {-10.0, g2}};
    const ProblemData problem = forced_problem({{[=](double t) { return -a + b * t; }, {}}});
    const double dt = 1.5 / steps;
    const Mesh mesh = Mesh::uniform(3);
    const auto solver = make_solver(beam, problem, mesh, scheme, dt, Needs{});
    int switches = 0;
    bool touching = false;
    double first = 0.0;
    double last = 0.0;
    march(*solver, problem, scheme.time, dt, steps, [&](double t) {
        const bool now = solver->contact_stress() != 0.0;
        if (now != touching)
            ++switches;
        if (now && !touching)
            first = t;
        if (now)
            last = t;
        touching = now;
    });
    BOOST_TEST(switches == 2);
    // A time on the grid is at most one step late. Euler's v is behind by up to t/(2ζ) of a step
    // besides (its e^{−t/ζ} decays like (1 + Δt/ζ)^{−n}); that of the others by less than a step.
    const double behind = scheme.time.order == 1 ? onset / (2.0 * zeta) : 0.0;
    BOOST_TEST(first - onset >= -0.1 * dt);
    BOOST_TEST(first - onset <= dt * (1.05 + behind));
    BOOST_TEST(last <= release + 1e-9);
    BOOST_TEST(last >= release - 1.05 * dt);
}

BOOST_DATA_TEST_CASE(a_tip_that_rests_on_a_stop_stays_there,
                     data::make(TimeScheme::names()) *
                         data::make({ThermalMass::consistent, ThermalMass::lumped}),
                     time, mass) {
    // After the transient nothing moves: λ is the static one in every step, without chatter.
    const int steps = short_tests ? 5'000 : 100'000;
    const Beam beam{.alpha = 0.5, .zeta = 0.1, .stops = {-0.1, 0.1}};
    const ProblemData problem = constant_loads(1.0, -3.0);
    const Scheme scheme{Algorithm::direct, mass, 0.0, TimeScheme::named(time)};
    const double dt = 0.01;
    const Mesh mesh = Mesh::uniform(6);
    const auto solver = make_solver(beam, problem, mesh, scheme, dt, Needs{});
    int switches = 0;
    bool touching = false;
    march(*solver, problem, scheme.time, dt, steps, [&](double) {
        const bool now = solver->contact_stress() != 0.0;
        switches += now != touching ? 1 : 0;
        touching = now;
    });
    BOOST_TEST(switches == 1);
    BOOST_TEST(touching);
    BOOST_TEST(std::abs(solver->tip_displacement() - 0.1) <= 4.0 * epsilon);
}

BOOST_AUTO_TEST_SUITE_END()

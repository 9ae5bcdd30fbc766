// Contact of the tip: the scalar step by regime, and complementarity along whole runs.

#include "core/contact/contact.hpp"
#include "tests/marching.hpp"

#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(contact)

BOOST_AUTO_TEST_CASE(no_stress_between_the_stops_and_none_where_the_tip_just_touches) {
    const Stops stops{-0.5, 2.0};
    for (const double tip : {-0.5, -0.499, 0.0, 1.999, 2.0})
        BOOST_TEST(contact_stress(stops, tip, 0.25) == 0.0);
}

BOOST_AUTO_TEST_CASE(stress_puts_the_tip_on_the_stop_it_passed_with_the_sign_of_the_reaction) {
    // u(1) = free tip + λ·compliance = stop, so λ = (stop − free tip)/compliance.
    const Stops stops{-0.5, 2.0};
    BOOST_TEST(contact_stress(stops, -1.0, 0.25) == 2.0);
    BOOST_TEST(contact_stress(stops, 3.0, 0.25) == -4.0);
}

BOOST_AUTO_TEST_CASE(an_absent_stop_never_pushes) {
    const double none = std::numeric_limits<double>::infinity();
    BOOST_TEST(contact_stress({-none, none}, 1e300, 1.0) == 0.0);
    BOOST_TEST(contact_stress({-none, 1.0}, -1e300, 1.0) == 0.0);
    BOOST_TEST(contact_stress({-1.0, none}, 1e300, 1.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(a_tip_that_is_not_a_number_is_not_taken_for_free) {
    BOOST_TEST(std::isnan(contact_stress({-1.0, 1.0}, NAN, 1.0)));
}

/// In every step: λ ≠ 0 only on a stop, with the sign of the reaction, and the tip never beyond a
/// stop. The tip is integrated anew from the curvature. It is the difference of what the load does,
/// up to 3 ∫(1 − x)² dx = 1, and of what the reaction does, so the tolerance is a few ulp of 1.
BOOST_DATA_TEST_CASE(complementarity_holds_in_every_step,
                     boost::unit_test::data::make(all_schemes) *
                         boost::unit_test::data::make({1, 2, 3, 10, 40}),
                     scheme, elements) {
    // Loads that swing the tip from one stop to the other, and a strong coupling.
    const Beam beam{.alpha = 0.8, .zeta = 0.02, .theta_A = 0.3, .stops = {-0.02, 0.1}};
    const ProblemData data = forced_problem(
        {{[](double t) { return -3.0 * std::sin(9.0 * t); }, {}},
         {[](double t) { return 40.0 * std::cos(5.0 * t); },
          [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return (3.0 * x).sin(); }}});
    const Mesh mesh = Mesh::uniform(elements);
    const double dt = 0.004;
    const auto solver = make_solver(beam, data, mesh, scheme, dt, Needs{});
    int on_lower = 0;
    int on_upper = 0;
    int released = 0;
    double previous = 0.0;
    march(*solver, data, scheme.time, dt, 500, [&](double) {
        const DiscontinuousLinear w = solver->curvature();
        const double tip = tip_moment(mesh, w);
        const double stress = solver->contact_stress();
        const double tolerance =
            4.0 * std::numeric_limits<double>::epsilon() *
            (scheme.algorithm == Algorithm::direct
                 ? 1.0
                 : std::pow(elements, 2)); // U is differenced to w and summed back
        BOOST_TEST(tip >= beam.stops.lower - tolerance);
        BOOST_TEST(tip <= beam.stops.upper + tolerance);
        if (stress > 0.0)
            BOOST_TEST(std::abs(tip - beam.stops.lower) <= tolerance);
        if (stress < 0.0)
            BOOST_TEST(std::abs(tip - beam.stops.upper) <= tolerance);
        on_lower += stress > 0.0 ? 1 : 0;
        on_upper += stress < 0.0 ? 1 : 0;
        released += previous != 0.0 && stress == 0.0 ? 1 : 0;
        previous = stress;
    });
    // The load is strong enough to reach both stops and to leave them again.
    BOOST_TEST(on_lower > 10);
    BOOST_TEST(on_upper > 10);
    BOOST_TEST(released > 2);
}

/// A penalised stop in the static law: the load −A of an elastic beam without coupling bends w =
/// (A + λ)(1 − x), so u(1) = (A + λ)/3, and λ = −(u(1) − g2)/ε makes
/// u(1) − g2 = (A/3 − g2)/(1 + 1/(3ε)). One Euler step of such a beam is the static solution.
BOOST_DATA_TEST_CASE(a_penalised_stop_yields_by_the_closed_static_law,
                     boost::unit_test::data::make(schemes_of("euler")) *
                         boost::unit_test::data::make({1, 7}),
                     scheme, elements) {
    const double load = 3.0;
    const double stop = 0.1;
    const ProblemData data = forced_problem({{[load](double) { return -load; }, {}}});
    double before = 0.0;
    for (int decade = 1; decade <= 12; ++decade) {
        const double epsilon = std::pow(10.0, -decade);
        const Beam beam{.stops = {-0.02, stop, epsilon}};
        const Mesh mesh = Mesh::uniform(elements);
        const auto solver = make_solver(beam, data, mesh, scheme, 0.1, Needs{});
        const double beyond = (load / 3.0 - stop) / (1.0 + 1.0 / (3.0 * epsilon));
        march(*solver, data, scheme.time, 0.1, 1, [&](double) {
            BOOST_TEST(std::abs(solver->tip_displacement() - stop - beyond) <= 1e-12);
            BOOST_TEST(solver->contact_stress() == -beyond / epsilon,
                       boost::test_tools::tolerance(1e-10));
        });
        // Towards the rigid stop the slope in ε is 1; at ε = 0.1 the beam yields as much as the
        // stop.
        if (decade > 3)
            BOOST_TEST(std::abs(std::log10(before / beyond) - 1.0) <= 0.02);
        before = beyond;
    }
}

BOOST_AUTO_TEST_SUITE_END()

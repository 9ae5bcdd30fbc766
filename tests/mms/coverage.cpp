// What a solution tests, and what the discrete equations make of it, before anything is run.

#include "mms/coverage.hpp"
#include "core/time/time_scheme.hpp"
#include "mms/admissible/consistency.hpp"
#include "mms/forecast/expected_orders.hpp"
#include "tests/suited_beam.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace data = boost::unit_test::data;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_coverage)

namespace {

const Beam coupled = {0.4, 0.15, 0.8, {-0.02, 0.1}};

std::vector<std::string> shipped() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(TVBEAM_SOLUTIONS_DIR))
        names.push_back(entry.path().stem().string());
    return names;
}

Solution shipped_solution(const std::string& name) {
    return read_solution(std::string(TVBEAM_SOLUTIONS_DIR "/") + name + ".toml");
}

/// The use of one term; equation and term begin as given.
TermUse use(const std::vector<TermUse>& terms, const std::string& equation,
            const std::string& term) {
    const auto found = std::find_if(terms.begin(), terms.end(), [&](const TermUse& candidate) {
        return candidate.equation == equation && candidate.term == term;
    });
    BOOST_REQUIRE_MESSAGE(found != terms.end(), equation << " " << term);
    return *found;
}

void check_unused(const std::vector<TermUse>& terms, const std::string& equation,
                  const std::string& term, const std::string& why_not) {
    const TermUse found = use(terms, equation, term);
    BOOST_TEST(!found.is_exercised(), equation << " " << term);
    BOOST_TEST(found.why_not == why_not);
}

bool is_smooth(const std::string& name) {
    return shipped_solution(name).phases.size() == 1;
}

std::vector<std::string> smooth() {
    std::vector<std::string> names = shipped();
    std::erase_if(names, [](const std::string& name) { return !is_smooth(name); });
    return names;
}

} // namespace

// θ̃ = t x (1 − x), u = x² t/100: each size is the largest of a polynomial on [0,1] × [0,2].
BOOST_AUTO_TEST_CASE(sizes_of_terms_are_those_of_their_formulas) {
    const auto terms =
        coverage({parse_solution("theta = 't*x*(1 - x)'\nu = 'x^2*t/100'\n", "my.toml"),
                  {0.4, 0.15, 0.0, {-0.02, 0.1}},
                  2.0});
    const auto close = boost::test_tools::tolerance(1e-12);
    BOOST_TEST(use(terms, "(1)", "theta_t").largest == 0.25, close); // at x = 1/2
    BOOST_TEST(use(terms, "(1)", "theta_xx").largest == 4.0, close); // 2 t
    BOOST_TEST(use(terms, "(1)", "alpha*u_xxt").largest == 0.4 * 0.02, close);
    BOOST_TEST(use(terms, "(3)", "alpha*theta_x").largest == 0.4 * 2.0, close); // t (1 − 2x)
    BOOST_TEST(use(terms, "(9)", "an end moment m").largest == 0.04 + 0.15 * 0.02, close);
    check_unused(terms, "(3)", "u_xxx", "u is quadratic in x");
    check_unused(terms, "(3)", "zeta*u_xxxt", "u_xxxt is zero");
    check_unused(terms, "(2)", "a body force q", "sigma does not depend on x");
    check_unused(terms, "(8)", "a force at the stop g1", "the tip never reaches g1");
    check_unused(terms, "(10)", "an end temperature theta_A", "theta_A = 0");
    check_unused(terms, "t = 0", "an initial temperature", "theta0 is zero");
}

// Within 1e-4 of t = 0.31 theta_t is up to 85, and f = theta_t − theta_xx with it; within 1e-4 of x
// = 0.31 theta_x up to 6, and G = alpha theta_x + … with it.
BOOST_AUTO_TEST_CASE(a_layer_that_is_met_in_one_term_is_seen_in_all) {
    const std::string u = "u = '0.001*x^2*(3 - x)*sin(t)'\n";
    const auto terms = [&](const std::string& theta) {
        return coverage(
            {parse_solution("theta = '" + theta + "'\n" + u, "my.toml"), {0.3, 0.1, 0.0, {}}, 1.0});
    };
    const auto pulse = terms("sin(pi*x)*(cos(t) + 0.01*exp(-1e8*(t - 0.31)^2))");
    const double rate = use(pulse, "(1)", "theta_t").largest;
    BOOST_TEST(rate > 80.0);
    BOOST_TEST(use(pulse, "(1)", "a heat source f").largest > rate - 10.0); // theta_xx
    const auto hump = terms("cos(t)*sin(pi*x) + 0.01*x*(1 - x)*exp(-1e8*(x - 0.31)^2)");
    BOOST_TEST(use(hump, "(1)", "theta_xx").largest > 4e5);
    BOOST_TEST(use(hump, "(1)", "a heat source f").largest > 4e5);
}

BOOST_AUTO_TEST_CASE(cases_of_contact_are_distinguishable) {
    const auto on = [&](const std::string& name, const Beam& beam) {
        const Solution solution = shipped_solution(name);
        return coverage({solution, suited(beam, solution), 2.0});
    };
    const auto touching = on("touch-without-force", coupled);
    check_unused(touching, "(8)", "a force at the stop g2", "the tip touches g2 without a force");
    BOOST_TEST(use(touching, "(6)(7)", "a free tip between stops").is_exercised());
    const auto pressed = on("pressed-front", coupled);
    check_unused(pressed, "(6)(7)", "a free tip between stops",
                 "the tip is on a stop all the time");
    BOOST_TEST(use(pressed, "(8)", "a force at the stop g1").largest == 3.0); // 1 + t
    const auto released = on("released-from-g2", coupled);
    BOOST_TEST(use(released, "(8)", "a force at the stop g2").largest == 0.5625); // (3/4)²
    const auto still = coverage({parse_solution("theta = 'sin(pi*x)'\nu = '0'\n", "still.toml"),
                                 {0.4, 0.15, 0.0, {-0.02, 0.1}},
                                 2.0});
    check_unused(still, "(6)(7)", "a free tip between stops", "u(1,t) is zero");
    const auto unstopped = on("free-oscillation", {0.4, 0.15, 0.0, {}});
    check_unused(unstopped, "(6)(7)", "a free tip between stops", "the beam has no stops");
    check_unused(unstopped, "(8)", "a force at the stop g2", "there is no stop g2");
}

// Stops that yield let the tip pass by 0.119; between them it is free.
BOOST_AUTO_TEST_CASE(a_free_tip_is_as_large_as_it_is_between_the_stops) {
    const auto terms =
        coverage({parse_solution("theta = 'sin(pi*x)*exp(-t)'\nu = '0.06*x^2*(3-x)*sin(pi*t)'\n",
                                 "yielding.toml"),
                  {0.3, 0.1, 0.0, {-0.001, 0.001, 0.01}},
                  2.0});
    const double size = use(terms, "(6)(7)", "a free tip between stops").largest;
    BOOST_TEST(size > 0.00099);
    BOOST_TEST(size <= 0.001);
}

// Between the times of any grid, and of both stops.
BOOST_AUTO_TEST_CASE(a_smooth_touch_is_one_without_a_force) {
    const auto on = [](const std::string& u, double epsilon) {
        return coverage(
            {parse_solution("theta = 'sin(pi*x)'\nu = '" + u + "'\nsigma = '0'\n", "touch.toml"),
             {0.5, 0.1, 0.0, {-0.1, 0.1, epsilon}},
             1.0});
    };
    for (const double epsilon : {0.0, 0.05}) {
        const auto one = on("g2*x^2*(1 - (t - 0.7003)^2)", epsilon);
        check_unused(one, "(8)", "a force at the stop g2", "the tip touches g2 without a force");
        check_unused(one, "(8)", "a force at the stop g1", "the tip never reaches g1");
        const auto both = on("g2*x^2*sin(3*pi*(t + 0.01))", epsilon);
        for (const std::string stop : {"g1", "g2"})
            check_unused(both, "(8)", "a force at the stop " + stop,
                         "the tip touches " + stop + " without a force");
        // A sample at t = 0.5 is nearer to g2, by 2e-8 of it, than any beside the touch.
        const auto beside = on("g2*x^2*(1 - 2*(t - 0.7003)^2*((t - 0.5)^2 + 2.5e-7))", epsilon);
        check_unused(beside, "(8)", "a force at the stop g2", "the tip touches g2 without a force");
        const auto close = on("g2*x^2*(1 - 1e-6 - (t - 0.7003)^2)", epsilon);
        check_unused(close, "(8)", "a force at the stop g2", "the tip never reaches g2");
    }
}

// The largest |θ_xx| is at t = 1. Of a hump e^(−((x−c)/w)²) it is all but at c, where its second
// derivative is −2/w²; of a wave x(1 − x) sin 40x all but at the peak next to x = 1/2, 40x = 13π/2.
BOOST_AUTO_TEST_CASE(a_size_is_followed_to_where_it_is_largest) {
    const Beam beam{0.4, 0.15, 0.0, {-0.1, 0.1}};
    const auto largest = [&](const std::string& theta) {
        const Solution solution = parse_solution("theta = '" + theta + "'\nu = '0'\n", "my.toml");
        return use(coverage({solution, beam, 1.0}), "(1)", "theta_xx").largest;
    };
    const auto close = boost::test_tools::tolerance(1e-4);
    const double pi = std::acos(-1.0);
    const double c = 0.4567;
    const double hump = 2.0 * pi * pi * std::sin(pi * c) + 2.0 + 2.0 * c * (1.0 - c) / 1e-4;
    BOOST_TEST(largest("sin(pi*x)*(1+t) + x*(1-x)*exp(-((x-0.4567)/0.01)^2)*t") == hump, close);
    const double x = 6.5 * pi / 40.0;
    BOOST_TEST(largest("x*(1-x)*sin(40*x)*exp(-50*(1-t))") == 1600.0 * x * (1.0 - x) + 2.0, close);
}

// One hundredth of the run, in which everything happens.
BOOST_AUTO_TEST_CASE(a_phase_is_seen_however_short_it_is) {
    const std::string shape = "(t - 10.05)^3*(10.25 - t)^3*1e6";
    const std::string still = "theta = '0'\nu = '0'\n";
    const Solution solution = parse_solution(
        "[[phase]]\nuntil = 10.05\n" + still + "[[phase]]\nuntil = 10.25\ntheta = 'sin(pi*x)*" +
            shape + "'\nu = 'x^5*" + shape + "'\n[[phase]]\n" + still,
        "my.toml");
    const Beam beam{0.5, 0.1, 0.0, {-2.0, 1.0}};
    const auto terms = coverage({solution, beam, 20.0});
    for (const std::string term : {"theta_t", "theta_xx", "alpha*u_xxt", "a heat source f"})
        BOOST_TEST(use(terms, "(1)", term).is_exercised(), term);
    // With s = 10 (t - 10.15): 1e6 times the shape is (1 - s²)³, and its slope is largest at
    // s² = 1/5.
    const auto close = boost::test_tools::tolerance(1e-4);
    BOOST_TEST(use(terms, "(1)", "theta_t").largest == 60.0 * std::sqrt(0.2) * 0.64, close);
    BOOST_TEST(use(terms, "(1)", "theta_xx").largest == std::pow(std::acos(-1.0), 2.0), close);
    BOOST_TEST(use(terms, "(3)", "u_xxx").largest == 60.0, close);
    check_unused(terms, "(8)", "a force at the stop g2", "the tip touches g2 without a force");
    check_unused(terms, "(8)", "a force at the stop g1", "the tip never reaches g1");
    const auto residuals =
        space_residuals({solution, beam, 20.0}, ThermalMass::consistent, {32, 64});
    BOOST_TEST(std::abs(residuals.back().heat_order.value_or(0.0) - 2.0) < 0.03);
    BOOST_TEST(std::abs(residuals.back().beam_order.value_or(0.0) - 2.0) < 0.03);
}

// θ̃_t = x (1 − x) 2 k² (x − t) e^(−k² (x − t)²), which is largest beside the line x = t, at a
// distance of 1/(√2 k).
BOOST_DATA_TEST_CASE(a_narrow_peak_is_seen_at_its_height, data::make({50.0, 200.0, 1000.0}), k) {
    const std::string peak = "x*(1 - x)*exp(-(" + std::to_string(k) + "*(x - t))^2)";
    for (const std::string beside : {"", " + sin(pi*x)*t"}) {
        const Solution solution =
            parse_solution("theta = '" + peak + beside + "'\nu = 'x^2*t/100'\n", "my.toml");
        const auto terms = coverage({solution, {0.4, 0.15, 0.0, {}}, 1.0});
        const double height = 0.25 * k * std::sqrt(2.0 / std::exp(1.0));
        BOOST_TEST(use(terms, "(1)", "theta_t").largest == height + (beside.empty() ? 0.0 : 1.0),
                   boost::test_tools::tolerance(0.03));
        BOOST_TEST(use(terms, "(1)", "theta_xx").largest == 0.5 * k * k,
                   boost::test_tools::tolerance(0.03));
    }
}

// A peak in time alone, by a stop that the tip stays away from, and in the force on it.
BOOST_AUTO_TEST_CASE(a_narrow_peak_of_the_force_is_seen_at_its_height) {
    const Solution solution = parse_solution("theta = 'sin(pi*x)'\nu = 'g2*(3*x^2 - x^3)/2'\n"
                                             "sigma = '-1 - 4*exp(-(700*(t - 0.4567))^2)'\n",
                                             "my.toml");
    const auto terms = coverage({solution, {0.4, 0.15, 0.0, {-0.1, 0.1}}, 1.0});
    BOOST_TEST(use(terms, "(8)", "a force at the stop g2").largest == 5.0,
               boost::test_tools::tolerance(1e-3));
}

// What is not zero by its formula is not said to be zero, but to be so where it was looked at.
BOOST_AUTO_TEST_CASE(a_term_that_was_not_seen_is_not_said_to_be_zero) {
    const Solution solution = parse_solution(
        "theta = 'sin(pi*x)*exp(-(1e7*(t - 0.4567))^2)'\nu = 'x^2*t/100'\n", "my.toml");
    check_unused(coverage({solution, {0.4, 0.15, 0.0, {}}, 1.0}), "(1)", "theta_t",
                 "theta is steady, as far as was seen");
}

// The shipped solutions together leave nothing untested.
BOOST_AUTO_TEST_CASE(every_term_is_exercised_by_some_shipped_solution) {
    std::vector<TermUse> all;
    for (const std::string& name : shipped()) {
        const Solution solution = shipped_solution(name);
        const auto terms = coverage({solution, suited(coupled, solution), 2.0});
        if (all.empty())
            all = terms;
        for (std::size_t i = 0; i < terms.size(); ++i)
            all[i].largest = std::max(all[i].largest, terms[i].largest);
    }
    for (const TermUse& term : all)
        BOOST_TEST(term.is_exercised(), term.equation << " " << term.term);
}

// Interpolation and projection have the order 2, unless the spaces hold the solution; a wrong load
// would leave a residual that no refinement takes away.
BOOST_DATA_TEST_CASE(space_residuals_have_order_two_or_vanish,
                     data::make(shipped()) * data::make({false, true}), name, lumped) {
    const ThermalMass mass = lumped ? ThermalMass::lumped : ThermalMass::consistent;
    const Solution solution = shipped_solution(name);
    const Beam beam = suited(coupled, solution);
    const ExpectedOrders expected = expected_orders({solution, beam, 2.0});
    const auto residuals = space_residuals({solution, beam, 2.0}, mass, {64, 128});
    const Residual& finest = residuals.back();
    BOOST_TEST((finest.heat == 0.0) == expected.theta_is_exact, finest.heat);
    BOOST_TEST((finest.beam == 0.0) == expected.theta_is_exact, finest.beam);
    if (expected.theta_is_exact)
        return;
    BOOST_TEST(std::abs(finest.heat_order.value() - 2.0) < 0.03, *finest.heat_order);
    BOOST_TEST(std::abs(finest.beam_order.value() - 2.0) < 0.03, *finest.beam_order);
}

// The pulse stands between all times of equal distance; of 1e-7 it is narrower than anything that
// is looked at, and the formulas alone say that it is there.
BOOST_AUTO_TEST_CASE(the_residual_of_a_narrow_pulse_is_not_said_to_be_zero) {
    const auto of = [](const std::string& shape, double alpha) {
        const AdmissibleSolution solution(
            parse_solution("theta = '" + shape + "'\nu = 'x^2*(3-x)*0.01'\n", "my.toml"),
            {alpha, 0.1, 0.0, {}}, 1.0);
        return std::pair(space_residuals(solution, ThermalMass::consistent, {32, 64}).back(),
                         TimeResiduals(solution, {32, 64}).of("euler").back());
    };
    for (const std::string narrow : {"1e6", "3e6", "1e7"}) {
        const auto [space, time] = of("sin(pi*x)*exp(-" + narrow + "*(t-0.3)^2)", 0.3);
        BOOST_TEST(space.heat > 0.0, narrow);
        BOOST_TEST(std::abs(space.heat_order.value_or(0.0) - 2.0) < 0.03, narrow);
        BOOST_TEST(std::abs(space.beam_order.value_or(0.0) - 2.0) < 0.03, narrow);
        BOOST_TEST((time.heat > 0.0 || !time.heat_is_known), narrow);
        BOOST_TEST(time.beam == 0.0, narrow);
        BOOST_TEST(time.beam_is_known, narrow);
    }
    const auto [space, time] = of("sin(pi*x)*exp(-(1e9*(t-0.4567))^2)", 0.3);
    BOOST_TEST(!space.heat_is_known);
    BOOST_TEST(!space.beam_is_known);
    BOOST_TEST(!time.heat_is_known);
    // Without coupling the beam does not see it; where it is linear in x neither does the mesh.
    BOOST_TEST(of("sin(pi*x)*exp(-(1e9*(t-0.4567))^2)", 0.0).first.beam_is_known);
    const Residual steady = of("sin(pi*x)", 0.3).first;
    BOOST_TEST(steady.heat == 0.0);
    BOOST_TEST(steady.heat_is_known);
}

// Of 1e191 the square is beyond the range of doubles; of 1e305 terms of the residual are, too.
BOOST_AUTO_TEST_CASE(residuals_whose_squares_overflow_have_a_size_and_none_has_the_order_nan) {
    const auto of = [](double alpha) {
        return space_residuals({parse_solution("theta = 'x*(1-x)*exp(3*x)'\nu = '0'\n", "my.toml"),
                                {alpha, 0.3, 0.0, {}},
                                100.0},
                               ThermalMass::consistent, {32, 64})
            .back();
    };
    const Residual large = of(1e191);
    BOOST_TEST(large.beam == 1e191 * of(1.0).beam, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(std::abs(large.beam_order.value_or(0.0) - 2.0) < 0.03);
    BOOST_TEST(!std::isnan(of(1e305).beam_order.value_or(0.0)));
}

BOOST_DATA_TEST_CASE(time_residuals_have_the_order_of_the_scheme,
                     data::make(smooth()) * data::make(TimeScheme::names()), name, scheme) {
    const Solution solution = shipped_solution(name);
    const Beam beam = suited(coupled, solution);
    // The layer e^(−1000 t) must be resolved.
    const double final_time = name == "stiff-layer" ? 0.01 : 2.0;
    const auto residuals = TimeResiduals({solution, beam, final_time}, {256, 512}).of(scheme);
    const int order = TimeScheme::named(scheme).order;
    // exp(−π² t) has next terms of about one part in fifteen at these steps.
    constexpr double tolerance = 0.08;
    BOOST_TEST(std::abs(residuals.back().heat_order.value() - order) < tolerance,
               *residuals.back().heat_order);
    // Over so short a time the deflection hardly moves: its residual is rounding.
    if (name == "stiff-layer")
        return;
    BOOST_TEST(std::abs(residuals.back().beam_order.value() - order) < tolerance,
               *residuals.back().beam_order);
}

// u_xxt jumps by 0.3 at t = 1: BDF2 sees half of it in the step behind a time level, however small.
BOOST_AUTO_TEST_CASE(a_jump_leaves_a_residual_in_schemes_that_look_across_it) {
    const Solution solution = shipped_solution("impact");
    const Beam beam = suited(coupled, solution);
    const auto back = TimeResiduals({solution, beam, 2.0}, {256, 512}).of("bdf2");
    BOOST_TEST(std::abs(back.back().beam_order.value()) < 0.05);
    const auto across = TimeResiduals({solution, beam, 2.0}, {255, 511}).of("sdirk2");
    BOOST_TEST(std::abs(across.back().beam_order.value()) < 0.05);
    const auto level = TimeResiduals({solution, beam, 2.0}, {256, 512}).of("sdirk2");
    BOOST_TEST(std::abs(level.back().beam_order.value() - 2.0) < 0.05);
    const auto switches = expected_orders({solution, beam, 2.0}).switches;
    BOOST_REQUIRE(switches.size() == 1U);
    BOOST_TEST(switches[0].t == 1.0);
    // g2 times the largest curvature of (3 x² − x³)/2, which is 3.
    BOOST_TEST(switches[0].u_xxt_jump == 0.3, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(switches[0].theta_t_jump == 0.0);
    BOOST_TEST(expected_orders({solution, beam, 1.0}).switches.empty());
}

// Of |x - 0.2 - t/2|^3 u_xxx jumps, at a place that moves, and so does u_xxt: zeta u_xxxt has a
// delta function. Of one that rests u_xxx jumps alone.
BOOST_AUTO_TEST_CASE(the_formula_of_G_lacks_a_delta_function_where_u_xx_or_a_viscous_rate_jumps) {
    const auto said = [](const std::string& kink, double zeta) {
        const Beam beam{.alpha = 0.3, .zeta = zeta};
        std::string all;
        for (const auto& reason :
             expected_orders(
                 {parse_solution("theta = '0'\nu = '0.01*x^2*(1 + t)*" + kink + "'\n", "my.toml"),
                  beam, 1.0})
                 .reasons)
            all += reason + "\n";
        return all;
    };
    const auto lacks = [](const std::string& text) {
        return text.find("The formula of G lacks a delta function") != std::string::npos;
    };
    const std::string moving = "((x - 0.2 - t/2)^2)^1.5";
    BOOST_TEST(lacks(said(moving, 0.1)));
    BOOST_TEST(said(moving, 0.1).find("u_xxt jumps at x = 0.261728, t = 0.123457: ") !=
               std::string::npos);
    BOOST_TEST(!lacks(said(moving, 0.0)));
    BOOST_TEST(!lacks(said("((x - 0.2)^2)^1.5", 0.1)));
    BOOST_TEST(lacks(said("sqrt((x - 0.2)^2)*(x - 0.2)", 0.1)));
    BOOST_TEST(lacks(said("sqrt((x - 0.2)^2)*(x - 0.2)", 0.0)));
}

// The tip is pressed on g2 up to t = 1. A jump of u_xxt at t = 2 spoils the deflection, not a
// stress that is over; one at t = 1/2 spoils both.
BOOST_AUTO_TEST_CASE(a_jump_after_the_last_contact_spares_the_contact_stress) {
    const std::string start = "theta = 'cos(t)*sin(pi*x)'\n[[phase]]\n";
    const std::string on_g2 = "u = 'g2*(3*x^2 - x^3)/2'\nsigma = 't - 1'\n[[phase]]\nuntil = ";
    const std::string bent = "u = 'g2*(3*x^2 - x^3)/2 + g2*x^2*(1 - x)^2*(t - 1/2)'\n"
                             "sigma = 't - 1'\n[[phase]]\n";
    const Solution late =
        parse_solution(start + "until = 1\n" + on_g2 +
                           "2\nu = 'g2*(3*x^2 - x^3)/2*(1 - (t - 1)^2/4)'\n[[phase]]\n"
                           "u = 'g2*(3*x^2 - x^3)/2*(11/4 - t)'\n",
                       "late.toml");
    const Solution early = parse_solution(
        start + "until = '1/2'\n" + on_g2 + "1\n" + bent +
            "u = 'g2*(3*x^2 - x^3)/2*(1 - (t - 1)^2/4) + g2*x^2*(1 - x)^2*(t - 1/2)'\n",
        "early.toml");
    const auto least_order = [](const Solution& solution, const std::string& norm) {
        const auto orders = expected_orders({solution, suited(coupled, solution), 2.5}).orders;
        const auto row = std::find_if(orders.begin(), orders.end(),
                                      [&](const auto& order) { return order.norm == norm; });
        BOOST_REQUIRE(row != orders.end());
        return row->bdf2.least;
    };
    BOOST_TEST(least_order(late, "u_LinfH2semi") == 1.0);
    BOOST_TEST(least_order(late, "sigma_L2") == 2.0);
    BOOST_TEST(least_order(early, "u_LinfH2semi") == 1.0);
    BOOST_TEST(least_order(early, "sigma_L2") == 1.0);
}

// What begins after the final time, and phases that go on with the same formulas, change nothing.
BOOST_AUTO_TEST_CASE(orders_are_of_what_is_run_however_it_is_written) {
    const std::string theta = "theta = 't^2*x*(1 - x)'\n";
    const std::string u = "u = 't^2*x^2*(3 - x)/50'\n";
    const auto words = [](const std::string& text) {
        std::string all;
        for (const auto& row :
             expected_orders({parse_solution(text, "my.toml"), {0.3, 0.1, 0.0, {}}, 1.0}).orders)
            all += row.norm + " " + words_of(row.in_h) + " " + words_of(row.euler) + " " +
                   words_of(row.bdf2) + " " + words_of(row.sdirk2) + "\n";
        return all;
    };
    const std::string whole = words(theta + u);
    BOOST_TEST(whole.find("theta_L2L2 2 1 3 2") != std::string::npos, whole);
    BOOST_TEST(words(theta + "[[phase]]\nuntil = 0.5\n" + u + "[[phase]]\n" + u) == whole);
    BOOST_TEST(words(theta + "[[phase]]\nuntil = 5\n" + u +
                     "[[phase]]\nu = 't^2*x^2*(3 - x)/50 + (t - 5)^4*x^2*sin(x)'\n") == whole);
}

// Without coupling the beam equation with 1 - x has u(1,t) and its rate alone.
BOOST_AUTO_TEST_CASE(the_stress_of_a_tip_without_a_time_error_has_none_without_coupling) {
    const auto of_stress = [](const std::string& text, double alpha, double epsilon) {
        const Beam beam{alpha, 0.1, 0.0, {-0.1, 0.1, epsilon}};
        const auto orders = expected_orders({parse_solution(text, "my.toml"), beam, 1.0}).orders;
        return words_of(orders.back().bdf2);
    };
    const std::string bent = "theta = 'cos(t)*sin(pi*x)'\n";
    const std::string held =
        bent + "u = 'g2*x^2*(3 - x)/2 + x^2*(1 - x)^2*cos(3*t)/20'\nsigma = '-(2 + sin(t))'\n";
    BOOST_TEST(of_stress(held, 0.0, 0.0) == "-");
    BOOST_TEST(of_stress(held, 0.3, 0.0) == "2");
    const std::string even =
        bent + "u = '(g2 + (1 + t)/20)*x^2*(3 - x)/2 + x^2*(1 - x)^2*cos(3*t)/20'\n";
    BOOST_TEST(of_stress(even, 0.0, 0.01) == "-");
    BOOST_TEST(of_stress(even, 0.3, 0.01) == "2");
}

// u linear in t and theta zero: no scheme has a time error, and none has half an order less of it.
BOOST_AUTO_TEST_CASE(penalised_stops_have_no_reason_to_lose_an_order_where_the_tip_has_none) {
    const auto says = [](const std::string& in_time) {
        const Beam beam{.alpha = 0.3, .zeta = 0.1, .stops = {-0.1, 0.1, 0.01}};
        const auto known = expected_orders(
            {parse_solution("theta = '0'\nu = '0.15*x^2*(3 - x)/2*" + in_time + "'\n", "my.toml"),
             beam, 1.0});
        BOOST_TEST(known.is_in_stops);
        return std::ranges::any_of(known.reasons, [](const std::string& reason) {
            return reason.find("penalised stop") != std::string::npos;
        });
    };
    BOOST_TEST(says("t^2"));
    BOOST_TEST(!says("t"));
}

// Where a contact begins within a phase, or the tip touches a stop without a force, it is not held
// from the start: there is an error, of an order that nobody knows.
BOOST_AUTO_TEST_CASE(a_contact_within_a_phase_and_a_touch_leave_the_stress_an_error) {
    for (const double alpha : {0.0, 0.3}) {
        const Beam beam{alpha, 0.1, 0.0, {-0.1, 0.2, 0.0}};
        for (const std::string text :
             {"theta = 'sin(pi*x)*cos(t)'\n"
              "u = 'g2*(3*x^2 - x^3)/2*(1 - (0.4 - t + sqrt((0.4 - t)^2))^3)'\n"
              "sigma = '-(t - 0.4 + sqrt((t - 0.4)^2))^2'\n",
              "theta = 'sin(pi*x)*cos(t)'\nu = '0.2*x^2*(3 - x)/2*(1 - (t - 1)^2)'\n"}) {
            const auto stress =
                expected_orders({parse_solution(text, "my.toml"), beam, 2.0}).orders.back();
            BOOST_TEST(stress.norm == "sigma_L2");
            for (const Forecast& order : {stress.euler, stress.bdf2, stress.sdirk2})
                BOOST_TEST(words_of(order) == "not known", alpha);
        }
    }
}

// In steps longer than ζ a layer of the stages stays at the ends, and their order shows in u, and
// by the coupling in θ̃; that of the first step of BDF2 where u_xxtt is not zero at t = 0. Of θ = 0,
// u ~ t², runs at ζ = 1e-6 … 5e-3, α = 0 … 0.3 and dt = 0.04 … 0.0025 have, from level to
// level, 1.00 to 1.99 by SDIRK2 in u_LinfH2; by BDF2 1.00 to 2.65 there, 1.50 to 2.82 in u_L2H2
// and 1.24 to 2.58 in theta_LinfL2.
BOOST_AUTO_TEST_CASE(little_viscosity_shows_the_order_of_the_stages) {
    const auto words = [](const std::string& u, double alpha, double zeta, std::size_t norm,
                          Forecast ExpectedOrder::*in_dt) {
        const auto orders =
            expected_orders({parse_solution("theta = '0'\nu = '" + u + "'\n", "my.toml"),
                             {alpha, zeta, 0.0, {}},
                             1.0})
                .orders;
        return words_of(orders[norm].*in_dt);
    };
    constexpr std::size_t theta_L2L2 = 0;
    constexpr std::size_t theta_L2H1 = 2;
    constexpr std::size_t u_LinfH2 = 3;
    constexpr std::size_t u_L2H2 = 5;
    const auto bdf2 = &ExpectedOrder::bdf2;
    const auto sdirk2 = &ExpectedOrder::sdirk2;
    const std::string quadratic = "x^2*(1 + x)*t^2";
    const std::string swing = "x^2*(1 + x)*sin(3*t)"; // u_xxtt = 0 at t = 0
    BOOST_TEST(words(quadratic, 0.7, 0.0, theta_L2L2, bdf2) == "2.25 to 3");
    BOOST_TEST(words(swing, 0.7, 0.0, theta_L2H1, sdirk2) == "1.75 to 2");
    for (const double zeta : {1e-6, 9e-3}) {
        BOOST_TEST(words(quadratic, 0.7, zeta, theta_L2L2, bdf2) == "1.5 to 3", zeta);
        BOOST_TEST(words(swing, 0.7, zeta, theta_L2H1, sdirk2) == "1 to 2", zeta);
        for (const double alpha : {0.0, 0.7}) {
            BOOST_TEST(words(quadratic, alpha, zeta, u_LinfH2, bdf2) == "1 to 3", zeta);
            BOOST_TEST(words(quadratic, alpha, zeta, u_L2H2, bdf2) == "1.5 to 3", zeta);
            BOOST_TEST(words(quadratic, alpha, zeta, u_L2H2, sdirk2) == "1 to 2", zeta);
            BOOST_TEST(words(swing, alpha, zeta, u_LinfH2, bdf2) == "2", zeta);
            BOOST_TEST(words(swing, alpha, zeta, u_LinfH2, sdirk2) == "1 to 2", zeta);
        }
        BOOST_TEST(words("x^2*(1 + x)*t", 0.0, zeta, u_LinfH2, sdirk2) == "-", zeta);
    }
    // A second rate that has a pole at t = 0 is none that vanishes.
    BOOST_TEST(words("x^2*(3 - x)*t^(3/2)", 0.3, 1e-4, u_LinfH2, bdf2) == "1 to 3");
    BOOST_TEST(words(quadratic, 0.7, 0.1, theta_L2L2, bdf2) == "3");
    BOOST_TEST(words(swing, 0.7, 0.1, theta_L2H1, sdirk2) == "2");
    BOOST_TEST(words(swing, 0.0, 0.1, u_LinfH2, sdirk2) == "2");
}

BOOST_AUTO_TEST_CASE(a_solution_linear_in_time_has_no_time_residual) {
    const Solution solution = parse_solution("theta = 'x*(1 - x)*t'\nu = 'x^2*t/100'\n", "my.toml");
    const Beam beam = {0.4, 0.15, 0.0, {}};
    const ExpectedOrders expected = expected_orders({solution, beam, 1.0});
    BOOST_TEST(!expected.theta_has_time_error);
    BOOST_TEST(!expected.u_has_time_error);
    for (const auto& scheme : TimeScheme::names()) {
        const auto residuals = TimeResiduals({solution, beam, 1.0}, {16, 32}).of(scheme);
        BOOST_TEST(residuals.back().heat == 0.0);
        BOOST_TEST(residuals.back().beam == 0.0);
    }
}

// A rate that goes to its value like s^β, s the time to an end of a phase, is wrong by Δt^β in the
// steps beside it: 1 + β in dt where β < 1. A layer that is thin is none.
BOOST_AUTO_TEST_CASE(a_rate_of_infinite_slope_takes_its_part_of_the_order) {
    const auto least = [](const std::string& theta, const std::string& u, double alpha) {
        const Solution solution = parse_solution(
            "theta = 'sin(pi*x)*(" + theta + ")'\nu = 'x^2*(" + u + ")/100'\n", "my.toml");
        const auto expected = expected_orders({solution, {alpha, 0.15, 0.0, {}}, 1.0});
        std::map<std::string, double> orders;
        for (const auto& row : expected.orders) {
            BOOST_TEST(row.euler.least == (row.norm == "corollary" ? 2.0 : 1.0), row.norm);
            BOOST_TEST(row.bdf2.least == row.sdirk2.least, row.norm);
            orders[row.norm] = row.bdf2.least;
        }
        return orders;
    };
    for (const std::string power : {"5/4", "3/2", "7/4", "5/2", "7/2"})
        for (const double alpha : {0.0, 0.4}) {
            const double k = static_cast<double>(power[0] - '0') / (power[2] - '0');
            const double own = std::min(k, 2.0);
            const double other = alpha > 0 ? own : 2.0;
            for (const std::string base : {"t", "1 - t"}) { // at the begin, and at the end
                const auto of_theta = least("(" + base + ")^(" + power + ")", "cos(t)", alpha);
                BOOST_TEST(std::abs(of_theta.at("theta_L2L2") - own) < 0.03, power << base);
                BOOST_TEST(std::abs(of_theta.at("u_LinfH2semi") - other) < 0.03, power << base);
                const auto of_u = least("cos(t)", "(" + base + ")^(" + power + ")", alpha);
                BOOST_TEST(std::abs(of_u.at("theta_L2L2") - other) < 0.03, power << base);
                BOOST_TEST(std::abs(of_u.at("u_LinfH2semi") - own) < 0.03, power << base);
            }
        }
    for (const std::string layer : {"1e3", "1e6", "1e7", "1e8", "1e9"})
        BOOST_TEST(least("exp(-" + layer + "*t)", "cos(t)", 0.4).at("theta_L2L2") == 2.0, layer);
}

// A quadratic is what BDF2 differentiates exactly; its first step is one of another scheme.
BOOST_AUTO_TEST_CASE(bdf2_has_order_three_where_a_solution_is_quadratic_in_time) {
    const auto of_bdf2 = [](const std::string& theta, const std::string& u) {
        const Solution solution = parse_solution(
            "theta = 'x*(1 - x)*(" + theta + ")'\nu = 'x^2*(" + u + ")/100'\n", "my.toml");
        const Beam beam{0.4, 0.15, 0.0, {}};
        if (const Forecast order = expected_orders({solution, beam, 1.0}).orders[0].bdf2;
            order.is_known() && order.least == order.greatest)
            return order.least;
        return 0.0;
    };
    BOOST_TEST(of_bdf2("1 - 2*t^2", "t") == 3.0);
    BOOST_TEST(of_bdf2("t", "t^2") == 3.0);
    BOOST_TEST(of_bdf2("t^2", "t^3") == 2.0);
    BOOST_TEST(of_bdf2("t^3", "t") == 2.0);
    // Without coupling each field has its own.
    const Solution apart =
        parse_solution("theta = 'x*(1 - x)*t^2'\nu = 'x^2*t^3/100'\n", "my.toml");
    for (const auto& row : expected_orders({apart, {0.0, 0.15, 0.0, {}}, 1.0}).orders)
        if (row.norm.starts_with("theta") || row.norm.starts_with("u_"))
            BOOST_TEST(row.bdf2.least == (row.norm.starts_with("theta") ? 3.0 : 2.0), row.norm);
    const Solution solution =
        parse_solution("theta = 'sin(pi*x)*t^2'\nu = 'x^2*t^2/100'\n", "my.toml");
    BOOST_TEST(
        TimeResiduals({solution, {0.4, 0.15, 0.0, {}}, 1.0}, {16, 32}).of("bdf2").back().heat ==
        0.0);
}

// Without coupling each equation has the time error of what it differences itself: the heat
// equation of theta, the beam equation, if zeta is not 0, of u_xx.
BOOST_AUTO_TEST_CASE(a_time_error_is_forecast_where_a_residual_is) {
    for (const std::string theta : {"t", "t^2"})
        for (const std::string u : {"t", "t^2"})
            for (const double alpha : {0.0, 0.4})
                for (const double zeta : {0.0, 0.15}) {
                    const Solution solution = parse_solution(
                        "theta = 'sin(pi*x)*" + theta + "'\nu = 'x^2*" + u + "/100'\n", "my.toml");
                    const Beam beam{alpha, zeta, 0.0, {}};
                    const ExpectedOrders expected = expected_orders({solution, beam, 1.0});
                    const Residual residual =
                        TimeResiduals({solution, beam, 1.0}, {16, 32}).of("euler").back();
                    const bool heat = residual.heat > 0.0;
                    const bool bending = residual.beam > 0.0;
                    BOOST_TEST_CONTEXT(theta << ", " << u << ", " << alpha << ", " << zeta) {
                        // The coupling passes an error on.
                        BOOST_TEST(expected.theta_has_time_error ==
                                   (heat || (alpha != 0.0 && bending)));
                        BOOST_TEST(expected.u_has_time_error ==
                                   (bending || (alpha != 0.0 && heat)));
                        for (const ExpectedOrder& order : expected.orders) {
                            const bool of_theta = order.norm.starts_with("theta");
                            const bool of_both = order.norm == "corollary";
                            BOOST_TEST(order.euler.has_error() ==
                                       ((!of_theta && expected.u_has_time_error) ||
                                        ((of_theta || of_both) && expected.theta_has_time_error)));
                        }
                    }
                }
}

BOOST_AUTO_TEST_SUITE_END()

// Evolutions: probes, contact events, and what changes from period to period.

#include "studies/evolution/evolution.hpp"
#include "core/contact/contact_events.hpp"
#include "core/run.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/gates/check.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/study.hpp"
#include "tests/marching.hpp"
#include "tests/temporary_directory.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <regex>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(evolution_study)

namespace {

using Kind = ContactEvent::Kind;
using Stop = ContactEvent::Stop;

EvolutionResult evolution(const Scene& scene) {
    return *run_study(scene).get<EvolutionResult>();
}

/// The paper's second experiment with another scheme, mesh and step.
EvolutionResult figure1(const Scheme& scheme, int elements, double dt, double final_time) {
    Scene scene = read_scene(
        "figure1",
        {"evolution.elements=" + std::to_string(elements),
         "evolution.final_time=" + message_text(final_time), "evolution.dt=" + message_text(dt),
         "evolution.period=" + message_text(final_time < 2.0 ? final_time / 2.0 : 1.0)});
    scene.scheme = scheme;
    return evolution(scene);
}

Scheme direct(const std::string& time) {
    return {Algorithm::direct, ThermalMass::lumped, 0.0, TimeScheme::named(time)};
}

/// The evolution of a scene given as text.
EvolutionResult evolution_of(const std::string& text) {
    const TemporaryDirectory directory;
    return evolution(read_scene(directory.write("scene.toml", text)));
}

double greatest_difference(const ProbeHistory& a, const ProbeHistory& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        if (!std::isnan(a.values[i])) {
            BOOST_REQUIRE(!std::isnan(b.values[i]));
            greatest = std::max(greatest, std::abs(a.values[i] - b.values[i]));
        }
    return greatest;
}

const std::vector<std::string> time_schemes = TimeScheme::names();

} // namespace

// At t = 0 the temperature is the interpolant of θ̃, and the deflection the H² projection of u,
// which is u itself where u is a cubic. On this mesh (j/4)², t = 0.5 at step 1 of 2.
BOOST_AUTO_TEST_CASE(probes_read_the_state_at_any_point) {
    const EvolutionResult result = evolution_of(R"toml(
[beam]
alpha   = 0.0
zeta    = 0.2
theta_A = 0.8
[mesh]
grading = 2.0
[data]
theta0 = "theta_A*(1 - x) + sin(pi*x)"
u0     = "0.3*x^2 - 0.2*x^3"
[evolution]
final_time = 1.0
elements   = 4
dt         = 0.5
probes     = ["theta@0", "theta@0.25", "theta@0.125", "theta@1", "u@0", "u@0.4", "u@1", "energy"]
)toml");
    BOOST_REQUIRE(result.t == (std::vector<double>{0.0, 0.5, 1.0}));
    const auto start = [&](std::size_t k) { return result.probes[k].values[0]; };
    const auto sine = [](double x) { return std::sin(std::numbers::pi * x); };
    const double ulps = 4e-16;
    BOOST_TEST(start(0) == 0.8);
    BOOST_TEST(std::abs(start(1) - (0.6 + sine(0.25))) < ulps); // a node
    // 0.125 lies a third of the way from node 1/16 to node 1/4.
    const double part = (0.125 - 0.0625) / 0.1875;
    BOOST_TEST(std::abs(start(2) - (0.7 + (1.0 - part) * sine(0.0625) + part * sine(0.25))) < ulps);
    BOOST_TEST(start(3) == 0.0);
    BOOST_TEST(start(4) == 0.0);
    BOOST_TEST(std::abs(start(5) - (0.3 * 0.16 - 0.2 * 0.064)) < ulps);
    BOOST_TEST(std::abs(start(6) - 0.1) < ulps);
    // ½ΘᵀMΘ of the interpolant on the consistent mass matrix, and ½∫(0.6 − 1.2x)² = 0.06.
    double energy = 0.06;
    const std::array<double, 5> nodes{0.0, 0.0625, 0.25, 0.5625, 1.0};
    for (std::size_t j = 1; j < nodes.size(); ++j) {
        const double left = sine(nodes[j - 1]);
        const double right = sine(nodes[j]);
        energy += (nodes[j] - nodes[j - 1]) * (left * left + left * right + right * right) / 6.0;
    }
    BOOST_TEST(std::abs(start(7) - energy) < ulps);
}

// The tip is computed by itself, without the deflection elsewhere; u is continuous, and |u_x| < 1
// here.
BOOST_DATA_TEST_CASE(the_tip_is_where_the_deflection_ends, data::make(all_schemes), scheme) {
    for (const char* ends : {"", "stops = [-0.004, 0.006]\n", "theta_A = 0.3\n"}) {
        const std::string text = std::string("[beam]\nalpha = 0.9\nzeta = 0.15\n") + ends +
                                 "[data]\ntheta0 = \"" +
                                 (*ends == 't' ? "theta_A*(1 - x) + " : "") +
                                 "2*sin(pi*x)\"\nu0 = \"0.03*x^2*(1 - x)\"\n"
                                 "[evolution]\nfinal_time = 0.5\nelements = 6\ndt = 0.05\n"
                                 "probes = ['u@1', 'u@0.99999999']\n";
        const TemporaryDirectory directory;
        Scene scene = read_scene(directory.write("scene.toml", text));
        scene.scheme = scheme;
        const EvolutionResult result = evolution(scene);
        BOOST_TEST(std::abs(result.probes[0].values.back()) > 1e-3);
        BOOST_TEST(greatest_difference(result.probes[0], result.probes[1]) < 1e-8);
    }
}

// (5) and (10), whatever the mesh: its nodes are j/s, its elements 1/s long, both rounded.
BOOST_DATA_TEST_CASE(what_is_given_at_an_end_is_read_there_to_the_last_digit,
                     data::make(all_schemes), scheme) {
    for (int elements = 1; elements <= 60; elements += short_tests ? 7 : 1)
        for (const double grading : {1.0, 1.5}) {
            Scene scene = read_scene(
                "heated-end", {"evolution={final_time=0.04,elements=" + std::to_string(elements) +
                                   ",dt=0.02,probes=['theta@0',"
                                   "'theta@1','u@0']}",
                               "mesh={grading=" + message_text(grading) + "}"});
            scene.blocks.remove<LadderBlock>();
            scene.blocks.remove<OrdersBlock>();
            scene.scheme = scheme;
            const EvolutionResult result = evolution(scene);
            BOOST_TEST_CONTEXT(elements << " elements, grading " << grading) {
                const std::array given{scene.beam.theta_A, 0.0, 0.0};
                for (std::size_t k = 0; k < 3; ++k)
                    for (std::size_t n = 0; n < result.t.size(); ++n) {
                        BOOST_TEST(result.probes[k].values[n] == given.at(k));
                        BOOST_TEST(result.probes[k].exact[n] == given.at(k));
                    }
            }
        }
}

// The spaces hold this solution, and Euler is exact for a motion that is linear in time.
BOOST_AUTO_TEST_CASE(a_solution_that_the_scheme_represents_is_followed_exactly) {
    const TemporaryDirectory directory;
    directory.write("linear.toml", "name = \"linear\"\nsource = \"a test\"\n"
                                   "theta = \"theta_A*(1 - x)\"\nu = \"(3*x^2 - x^3)*t/20\"\n");
    const EvolutionResult result = evolution(read_scene(directory.write("scene.toml", R"toml(
solution = "linear.toml"
[beam]
alpha   = 0.3
zeta    = 0.2
theta_A = 0.8
[evolution]
final_time = 1.0
elements   = 5
dt         = 0.25
probes     = ["theta@0.3", "u@0.7", "u@1", "stress"]
)toml")));
    for (const auto& probe : result.probes) {
        BOOST_REQUIRE(probe.exact.size() == 5U);
        BOOST_TEST(probe.greatest_error().value() < 1e-15, probe.name);
    }
    BOOST_TEST(std::abs(result.probes[1].values.back() - (3.0 * 0.49 - 0.343) / 20.0) < 1e-15);
    BOOST_TEST(std::isnan(result.probes[3].values[0]));
}

BOOST_DATA_TEST_CASE(the_tip_of_figure_1_stays_between_the_stops, data::make(all_schemes), scheme) {
    const auto result = figure1(scheme, 20, 0.01, 2.0);
    // Load and reaction, the parts of u(1), are of size one: a few of their last digits.
    BOOST_TEST(result.beyond_stops <= 4.0 * std::numeric_limits<double>::epsilon());
    // It starts on g2, in the Hermite form to the round-off ε h⁻⁴ of U⁰.
    const auto near =
        boost::test_tools::tolerance(scheme.algorithm == Algorithm::direct ? 1e-13 : 4e-11);
    const auto& tip = result.probes[1];
    BOOST_TEST(tip.values[*tip.least()] == -0.02, near);
    BOOST_TEST(tip.values[*tip.greatest()] == 0.1, near);
    BOOST_TEST(result.events.size() == 8U);
}

// What the start leaves behind decays by exp(−1/ζ) = 4.5e-5 in a period, the slower one of the two:
// to below 1e-6 in the fourth.
BOOST_DATA_TEST_CASE(figure_1_becomes_periodic, data::make(all_schemes), scheme) {
    const auto result = figure1(scheme, 20, 0.01, 4.0);
    BOOST_REQUIRE(result.periods.size() == 3U);
    BOOST_TEST(result.periods[0].changes[0] > 1.0);
    for (const double change : result.periods[2].changes)
        BOOST_TEST(change < 1e-6);
}

// Discretely they are the same equations: what differs is the round-off of the Hermite form,
// ε h⁻⁴ = 4e-11 at s = 20, and the tolerance of the iteration.
BOOST_DATA_TEST_CASE(both_algorithms_give_the_curves_of_figure_1, data::make(time_schemes), time) {
    const auto one = figure1(direct(time), 20, 0.01, 2.0);
    Scheme paper = direct(time);
    paper.algorithm = Algorithm::fixed_point;
    paper.tolerance = 1e-13;
    const auto other = figure1(paper, 20, 0.01, 2.0);
    for (std::size_t k = 0; k < one.probes.size(); ++k)
        BOOST_TEST(greatest_difference(one.probes[k], other.probes[k]) < 1e-9, one.probes[k].name);
    BOOST_REQUIRE(one.events.size() == other.events.size());
    for (std::size_t i = 0; i < one.events.size(); ++i)
        BOOST_TEST(std::abs(one.events[i].t - other.events[i].t) < 1e-9);
}

// sin(x − 0.3)/(x − 0.3) is 1 at 0.3, where its text is 0/0.
BOOST_AUTO_TEST_CASE(an_exact_value_that_is_none_meets_no_expectation) {
    const TemporaryDirectory directory;
    directory.write("hole.toml", "theta = \"cos(t)*sin(pi*x)*sin(x - 0.3)/(x - 0.3)\"\n"
                                 "u = \"x^2*(3 - x)*sin(t)/100\"\n");
    const Scene scene = read_scene(directory.write("scene.toml", R"toml(
solution = "./hole.toml"
[beam]
alpha = 0.1
zeta  = 0.1
[evolution]
final_time = 1.0
elements   = 8
dt         = 0.1
probes     = ["theta@0.3"]
[expect.evolution]
"theta@0.3.error" = [0.0, 1.0]
)toml"),
                                   {}, {.expectations = true});
    const StudyResult result = run_study(scene);
    BOOST_TEST(std::isnan(result.get<EvolutionResult>()->probes[0].greatest_error().value()));
    const auto checked = check(result);
    BOOST_REQUIRE(checked.size() == 1U);
    BOOST_TEST(!checked[0].holds);
}

BOOST_AUTO_TEST_CASE(a_figure_of_no_name_meets_no_band_and_is_told_of_a_near_one) {
    const TemporaryDirectory directory;
    const Scene scene = read_scene(directory.write("scene.toml", R"toml(
solution = "free-decay"
[beam]
alpha = 0.1
zeta  = 0.1
[evolution]
final_time = 0.1
elements   = 2
dt         = 0.1
probes     = ["theta@0.5"]
[expect.evolution]
"theta@0.5.eror" = [-1e9, 1e9]
"theta@0.5.error" = [-1e9, 1e9]
)toml"),
                                   {}, {.expectations = true});
    const auto checked = check(run_study(scene));
    BOOST_REQUIRE(checked.size() == 2U);
    for (const auto& one : checked) {
        const bool known = one.what == "evolution.theta@0.5.error";
        BOOST_TEST(one.holds == known, one.what);
        if (!known)
            BOOST_TEST(one.found.find("did you mean 'theta@0.5.error'?") != std::string::npos,
                       one.found);
    }
}

// The tip rises to g2 at t = 1/4, rests there while the stress rises to zero at t = 3/4, and falls.
BOOST_AUTO_TEST_CASE(events_of_straight_lines_are_found_exactly) {
    ContactEvents contact({.lower = -1.0, .upper = 0.5}, 0.0);
    const double dt = 0.07;
    for (int n = 1; n * dt < 2.0; ++n) {
        const double t = n * dt;
        const bool pressed = t >= 0.25 && t <= 0.75;
        contact.add(t, pressed ? 0.5 : (t < 0.25 ? 2.0 * t : 0.5 - (t - 0.75)),
                    pressed ? t - 0.75 : 0.0);
    }
    const auto& events = contact.events();
    BOOST_REQUIRE(events.size() == 2U);
    BOOST_TEST(int(events[0].kind == Kind::onset && events[0].stop == Stop::upper));
    BOOST_TEST(events[0].t == 0.25, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(int(events[1].kind == Kind::release && events[1].stop == Stop::upper));
    BOOST_TEST(events[1].t == 0.75, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(contact.beyond_stops() == 0.0);
}

BOOST_AUTO_TEST_CASE(a_tip_thrown_from_stop_to_stop_in_one_step_leaves_one_and_meets_the_other) {
    ContactEvents contact({.lower = -1.0, .upper = 0.5}, 0.5);
    contact.add(1.0, 0.5, -2.0);
    contact.add(2.0, 0.5 + 0x1p-52, -1.0);
    contact.add(3.0, -1.0, 3.0);
    const auto& events = contact.events();
    BOOST_REQUIRE(events.size() == 3U);
    BOOST_TEST(events[0].t == 0.0); // it starts on the stop
    BOOST_TEST(int(events[1].kind == Kind::release && events[1].stop == Stop::upper));
    BOOST_TEST(events[1].t == 3.0);
    BOOST_TEST(int(events[2].kind == Kind::onset && events[2].stop == Stop::lower));
    BOOST_TEST(events[2].t == 3.0);
    BOOST_TEST(contact.beyond_stops() == 0x1p-52);
}

// After the release the tip has been free at t = 3 alone: a line through that level and one of
// before the contact, 0.1 t + 0.15, would reach g2 at 3.5.
BOOST_AUTO_TEST_CASE(levels_before_a_contact_say_nothing_of_the_next_one) {
    ContactEvents contact({.lower = -1.0, .upper = 0.5}, 0.0);
    contact.add(1.0, 0.25, 0.0);
    contact.add(2.0, 0.5, -1.0);
    contact.add(3.0, 0.45, 0.0);
    contact.add(4.0, 0.5, -1.0);
    const auto& events = contact.events();
    BOOST_REQUIRE(events.size() == 3U);
    BOOST_TEST(int(events[2].kind == Kind::onset));
    BOOST_TEST(events[2].t == 4.0);
}

// The other stop is infinitely far away.
BOOST_AUTO_TEST_CASE(how_far_the_tip_passes_an_only_stop_is_said) {
    ContactEvents below({.lower = -0.5, .epsilon = 0.125}, 0.0);
    below.add(1.0, -0.75, 2.0);
    below.add(2.0, 1e3, 0.0);
    BOOST_TEST(below.beyond_stops() == 0.25);
    ContactEvents above({.upper = 0.5, .epsilon = 0.125}, 0.0);
    above.add(1.0, 0.75, -2.0);
    above.add(2.0, -1e3, 0.0);
    BOOST_TEST(above.beyond_stops() == 0.25);
    // A start beyond a rigid stop, as a deliberate defect makes it, is the first to pass it.
    const ContactEvents started({.lower = -0.5, .upper = 0.5}, 0.75);
    BOOST_TEST(started.beyond_stops() == 0.25);
}

// Free, on g1 or on g2 in any order, also from the first step on a stop that the tip starts on.
BOOST_AUTO_TEST_CASE(an_event_lies_in_the_step_in_which_the_regime_changed) {
    const double dt = 0.05;
    std::mt19937 generator(17);
    for (int run = 0; run < 200; ++run) {
        const int start = std::uniform_int_distribution<int>(-1, 1)(generator);
        const auto tip = [](int regime) { return regime < 0 ? -1e-3 : regime > 0 ? 2e-3 : 1e-4; };
        ContactEvents contact({.lower = -1e-3, .upper = 2e-3}, tip(start));
        std::vector<ContactEvent> expected; // at the end of the step
        int before = 0;
        for (int n = 1; n <= 20; ++n) {
            // It starts on a stop that it is held by, or in between.
            const int regime =
                n == 1 ? start : std::uniform_int_distribution<int>(-1, 1)(generator);
            if (before != 0 && regime != before)
                expected.push_back({Kind::release, before < 0 ? Stop::lower : Stop::upper, n * dt});
            if (regime != 0 && regime != before)
                expected.push_back({Kind::onset, regime < 0 ? Stop::lower : Stop::upper, n * dt});
            contact.add(n * dt, tip(regime), -regime * (1.0 + 0.1 * n));
            before = regime;
        }
        const auto& events = contact.events();
        BOOST_REQUIRE(events.size() == expected.size());
        for (std::size_t i = 0; i < events.size(); ++i) {
            BOOST_TEST((events[i].kind == expected[i].kind && events[i].stop == expected[i].stop));
            BOOST_TEST(events[i].t <= expected[i].t);
            BOOST_TEST(events[i].t >= expected[i].t - dt * (1.0 + 1e-12));
        }
        if (start != 0)
            BOOST_TEST(events[0].t == 0.0);
    }
}

// Into g2 by 1/8 and 1/4, out, and into g1 by 1/2: how far is said of the run, and of each contact.
BOOST_AUTO_TEST_CASE(how_far_the_tip_passes_penalised_stops_is_said) {
    ContactEvents contact({.lower = -1.0, .upper = 0.5, .epsilon = 0.125}, 0.0);
    contact.add(1.0, 0.625, -1.0);
    contact.add(2.0, 0.75, -2.0);
    contact.add(3.0, 0.0, 0.0);
    contact.add(4.0, -1.5, 4.0);
    contact.add(5.0, -1.25, 2.0);
    BOOST_TEST(contact.beyond_stops() == 0.5);
    const auto& events = contact.events();
    BOOST_REQUIRE(events.size() == 3U);
    BOOST_TEST(events[0].beyond == 0.25);
    BOOST_TEST(events[1].beyond == 0.25);
    BOOST_TEST(events[2].beyond == 0.5);
    // Each where the line through the tips of its step passes the stop, from 0 to 0.625, from 0.75
    // to 0, and from there to −1.5: of a first free level, of stresses that grow, and of one level
    // alone.
    BOOST_TEST(events[0].t == 0.8, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(events[1].t == 2.0 + 1.0 / 3.0, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(events[2].t == 3.0 + 2.0 / 3.0, boost::test_tools::tolerance(1e-14));
}

// Where there is no stop nothing is passed, however far the tip goes.
BOOST_AUTO_TEST_CASE(only_a_stop_that_there_is_can_be_passed) {
    for (const double side : {-1.0, 1.0}) {
        const Stops one = side < 0.0 ? Stops{.lower = -0.5} : Stops{.upper = 0.5};
        ContactEvents contact(one, 0.0);
        contact.add(1.0, -3.0 * side, 0.0);
        BOOST_TEST(contact.beyond_stops() == 0.0);
        contact.add(2.0, 0.75 * side, -side);
        BOOST_TEST(contact.beyond_stops() == 0.25);
        BOOST_REQUIRE(contact.events().size() == 1U);
        BOOST_TEST(int(contact.events()[0].stop == (side < 0.0 ? Stop::lower : Stop::upper)));
    }
}

// One free level since the release is no line: that from before the contact is not taken for it.
BOOST_AUTO_TEST_CASE(a_contact_right_after_a_release_begins_at_the_end_of_its_step) {
    ContactEvents contact({.lower = -1.0, .upper = 0.5}, 0.0);
    contact.add(1.0, 0.25, 0.0);
    contact.add(2.0, 0.5, -1.0);
    contact.add(3.0, 0.375, 0.0); // with the level at t = 1 a line that meets g2 at t = 5
    contact.add(6.0, 0.5, -1.0);
    BOOST_REQUIRE(contact.events().size() == 3U);
    BOOST_TEST(contact.events()[2].t == 6.0);
}

// At t = 0 a tip may be in a stop that yields, and is in contact then.
BOOST_AUTO_TEST_CASE(a_tip_that_starts_in_a_penalised_stop_has_its_onset_at_zero) {
    ContactEvents contact({.lower = -1.0, .upper = 0.5, .epsilon = 0.1}, 0.75);
    contact.add(1.0, 0.625, -1.25);
    BOOST_REQUIRE(contact.events().size() == 1U);
    BOOST_TEST(contact.events()[0].t == 0.0);
    BOOST_TEST(contact.events()[0].beyond == 0.25);
    BOOST_TEST(contact.beyond_stops() == 0.25);
}

BOOST_AUTO_TEST_CASE(a_penalised_stop_that_is_left_within_the_first_step_was_met_at_zero) {
    for (const double side : {1.0, -1.0}) {
        ContactEvents contact({.lower = -0.5, .upper = 0.5, .epsilon = 0.1}, 0.75 * side);
        contact.add(1.0, 0.25 * side, 0.0);
        const auto& events = contact.events();
        BOOST_REQUIRE(events.size() == 2U);
        BOOST_TEST(int(events[0].kind == Kind::onset && events[1].kind == Kind::release));
        for (const auto& event : events) {
            BOOST_TEST(int(event.stop == (side > 0.0 ? Stop::upper : Stop::lower)));
            BOOST_TEST(event.beyond == 0.25);
        }
        BOOST_TEST(events[0].t == 0.0);
        BOOST_TEST(events[1].t == 0.5);
    }
}

// The tip of a start on the stop, as the state's round-off leaves it, is on it.
BOOST_AUTO_TEST_CASE(a_start_on_a_penalised_stop_is_no_contact_by_round_off) {
    for (const double off : {-5e-17, 0.0, 5e-17}) {
        ContactEvents contact({.lower = -0.3, .upper = 0.3, .epsilon = 0.5}, 0.3 + off);
        contact.add(1.0, 0.25, 0.0);
        BOOST_TEST(contact.events().empty());
        BOOST_TEST(contact.beyond_stops() == 0.0);
    }
}

// By the stresses before, −1 and −0.4, g2 would be left at t = 8/3, but the tip, which goes from
// 0.14 to −0.6, passes it at 2 + 0.04/0.74 and meets g1 at 2 + 0.24/0.74.
BOOST_AUTO_TEST_CASE(one_penalised_stop_is_left_before_the_other_is_met) {
    ContactEvents contact({.lower = -0.1, .upper = 0.1, .epsilon = 0.1}, 0.0);
    contact.add(1.0, 0.2, -1.0);
    contact.add(2.0, 0.14, -0.4);
    contact.add(3.0, -0.6, 5.0);
    const auto& events = contact.events();
    BOOST_REQUIRE(events.size() == 3U);
    BOOST_TEST(int(events[1].kind == Kind::release && events[1].stop == Stop::upper));
    BOOST_TEST(events[1].t == 2.0 + 0.04 / 0.74, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(int(events[2].kind == Kind::onset && events[2].stop == Stop::lower));
    BOOST_TEST(events[2].t == 2.0 + 0.24 / 0.74, boost::test_tools::tolerance(1e-14));
}

// The tip is 1/40 + 9/80 sin 3t: 3/80 beyond either stop at its turning points.
BOOST_AUTO_TEST_CASE(a_run_tells_how_far_its_tip_passes_penalised_stops) {
    const EvolutionResult result =
        evolution_of("solution = 'penalised-stops'\n[beam]\nalpha = 0.4\nzeta = 0.15\n"
                     "stops = [-0.05, 0.1]\ncontact = {law = 'penalty', epsilon = 0.05}\n"
                     "[scheme]\ntime = 'sdirk2'\n[evolution]\nfinal_time = 2.0\nelements = 40\n"
                     "dt = 0.005\nprobes = ['u@1', 'stress']\n");
    BOOST_TEST(result.beyond_stops == 3.0 / 80.0, boost::test_tools::tolerance(1e-2));
    BOOST_REQUIRE(result.events.size() == 4U); // into g2, out, into g1, out
    const double into_g2 = std::asin(2.0 / 3.0) / 3.0;
    BOOST_TEST(result.events[0].t == into_g2, boost::test_tools::tolerance(1e-2));
    BOOST_TEST(result.events[1].t == std::numbers::pi / 3.0 - into_g2,
               boost::test_tools::tolerance(1e-2));
    BOOST_TEST(result.events[2].t == std::numbers::pi / 3.0 + into_g2,
               boost::test_tools::tolerance(1e-2));
    for (const auto& event : result.events)
        BOOST_TEST(event.beyond == 3.0 / 80.0, boost::test_tools::tolerance(1e-2));
}

// The Hermite form solves for the initial deflection, with the round-off that grows like h⁻⁴: 9e-12
// of the tip at s = 20, 1.4e-8 at 320.
BOOST_DATA_TEST_CASE(a_tip_that_starts_on_a_stop_has_its_onset_at_zero,
                     data::make({"direct", "fixed-point"}) * data::make({20, 320}), algorithm,
                     elements) {
    const EvolutionResult result =
        evolution_of(std::string("solution = 'pressed-on-g1'\n[beam]\nalpha = 0.4\nzeta = 0.15\n") +
                     "stops = [-0.05, 0.1]\n[scheme]\nalgorithm = '" + algorithm +
                     "'\n[evolution]\nfinal_time = 0.02\nelements = " + std::to_string(elements) +
                     "\ndt = 0.01\nprobes = ['u@1']\n");
    BOOST_REQUIRE(!result.events.empty());
    BOOST_TEST(result.events[0].t == 0.0);
}

// The first onset and the first release of Figure 1, against a run of 1e5 steps a period.
BOOST_DATA_TEST_CASE(events_converge_with_the_order_of_the_scheme, data::make(time_schemes), time) {
    const auto fine = figure1(direct("sdirk2"), 20, 1e-5, 0.6);
    const auto error = [&](double dt, std::size_t event) {
        return std::abs(figure1(direct(time), 20, dt, 0.6).events[event].t - fine.events[event].t);
    };
    const int order = TimeScheme::named(time).order;
    // Where the event lies in its step changes the constant of an onset from run to run: two
    // halvings are taken together, and the finest error bounded.
    BOOST_TEST(error(1.25e-3, 0) < (order == 1 ? 0.25 * 1.25e-3 : 6.0 * 1.25e-3 * 1.25e-3));
    BOOST_TEST(error(0.01, 0) / error(1.25e-3, 0) > (order == 1 ? 5.0 : 20.0));
    BOOST_TEST(std::log2(error(0.01, 1) / error(1.25e-3, 1)) / 3.0 > order - 0.4);
}

BOOST_AUTO_TEST_CASE(samples_are_thinned_and_events_are_not) {
    const Scene every = read_scene("figure1", {"evolution.final_time=2"});
    const Scene tenth = read_scene("figure1", {"evolution.final_time=2", "evolution.every=10"});
    const auto all = evolution(every);
    const auto few = evolution(tenth);
    BOOST_REQUIRE(few.t.size() == 201U);
    for (std::size_t i = 0; i < few.t.size(); ++i) {
        BOOST_TEST(few.t[i] == all.t[10 * i]);
        BOOST_TEST(few.probes[1].values[i] == all.probes[1].values[10 * i]);
    }
    BOOST_REQUIRE(few.events.size() == all.events.size());
    for (std::size_t i = 0; i < few.events.size(); ++i)
        BOOST_TEST(few.events[i].t == all.events[i].t);
}

// θ = e^{−π²t} sin πx decays with the rate of the mode; a period of 1/4 changes it by its own size
// a period before, less what is left.
BOOST_AUTO_TEST_CASE(changes_from_period_to_period_are_the_greatest_of_each_probe) {
    const std::string decay = R"toml(
[beam]
alpha = 0.0
zeta  = 0.1
[data]
theta0 = "sin(pi*x)"
[scheme]
time = "sdirk2"
[evolution]
final_time = 1.0
elements   = 8
dt         = 0.01
every      = 5
period     = 0.25
probes     = ["theta@0.5"]
)toml";
    const EvolutionResult result = evolution_of(decay);
    BOOST_REQUIRE(result.periods.size() == 3U);
    const auto& theta = result.probes[0].values;
    for (std::size_t k = 0; k < 3; ++k) {
        BOOST_TEST(result.periods[k].end == 0.25 * static_cast<double>(k + 2));
        // It falls: the change is greatest in the first sample of the period.
        BOOST_TEST(result.periods[k].changes[0] == theta[5 * k + 1] - theta[5 * k + 6]);
    }
    // A sample a period: its end is all of it.
    const EvolutionResult single =
        evolution_of(std::regex_replace(decay, std::regex("every      = 5"), "every      = 25"));
    BOOST_REQUIRE(single.periods.size() == 3U);
    for (std::size_t k = 0; k < 3; ++k)
        BOOST_TEST(single.periods[k].changes[0] ==
                   single.probes[0].values[k + 1] - single.probes[0].values[k + 2]);
}

BOOST_AUTO_TEST_CASE(what_no_probe_reads_is_not_computed) {
    const std::string heat = R"toml(
[beam]
alpha = 0.0
zeta  = 0.1
[data]
theta0 = "sin(pi*x)"
[evolution]
final_time = 1.0
elements   = 8
dt         = 0.1
probes     = ["theta@0.5"]
)toml";
    const TemporaryDirectory directory;
    const Scene scene = read_scene(directory.write("scene.toml", heat));
    const StudyResult result = run_study(scene);
    BOOST_TEST(result.get<EvolutionResult>()->run.count("heat_solves") == 10);
    BOOST_TEST(result.get<EvolutionResult>()->run.count("beam_solves") == 0);
    BOOST_TEST(result.get<EvolutionResult>()->run.count("norm_evaluations") == 0);
    BOOST_TEST(std::count(result.left_out.begin(), result.left_out.end(),
                          "deflection: no norm or probe asks for it") == 1);
}

// As the temperature grows, the last digit of a nodal value passes the tolerance of the fixed
// point, which then cannot be met.
BOOST_AUTO_TEST_CASE(a_run_that_fails_keeps_what_it_reached) {
    const EvolutionResult result = evolution_of(R"toml(
[beam]
alpha = 0.99
zeta  = 0.0
[data]
heat_source = "exp(40*t)"
[scheme]
algorithm = "fixed-point"
tolerance = 1e-13
[evolution]
final_time = 0.5
elements   = 4
dt         = 0.001
probes     = ["theta@0.5"]
)toml");
    BOOST_TEST(int(result.run.status == RungStatus::failed));
    BOOST_TEST(result.run.reason.find("in step") != std::string::npos, result.run.reason);
    BOOST_TEST(result.t.size() > 1U);
    BOOST_TEST(result.t.size() < 501U);
    for (const double value : result.probes[0].values)
        BOOST_TEST(std::isfinite(value));
}

// A temperature of 1e199 has a square that no double holds.
BOOST_AUTO_TEST_CASE(an_energy_beyond_the_range_of_floating_point_ends_the_run) {
    const EvolutionResult result = evolution_of(R"toml(
[beam]
alpha = 0.5
zeta  = 0.1
[data]
heat_source = "1e200*t"
[evolution]
final_time = 0.2
elements   = 7
dt         = 0.01
probes     = ["energy", "theta@0.5"]
)toml");
    BOOST_TEST(int(result.run.status == RungStatus::failed));
    BOOST_TEST(result.run.reason.find("the energy is beyond the range") != std::string::npos,
               result.run.reason);
    BOOST_TEST(result.t.size() == result.probes[0].values.size());
    for (const double value : result.probes[0].values)
        BOOST_TEST(std::isfinite(value));
}

// ε α: of α = 1e4 less than any digit that is printed, of 1e8 2e-8, of 1e16 2.
BOOST_AUTO_TEST_CASE(what_a_strong_coupling_makes_of_rounding_is_said) {
    const TemporaryDirectory directory;
    const auto remarks_of = [&](const std::string& alpha) {
        const Scene scene = read_scene(directory.write("scene.toml", "[beam]\nalpha = " + alpha +
                                                                         R"toml(
zeta  = 0.0
[data]
theta0 = "sin(pi*x)"
[evolution]
final_time = 0.02
elements   = 4
dt         = 0.01
probes     = ["u@1"]
)toml"));
        std::string text;
        for (const auto& remark : run_study(scene).remarks)
            text += remark;
        return text;
    };
    BOOST_TEST(remarks_of("1e4").find("rounding") == std::string::npos);
    BOOST_TEST(remarks_of("1e8").find("to about 2e-08 of its greatest value") != std::string::npos);
    BOOST_TEST(remarks_of("1e16").find("nothing is known of u_xx") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(expectations_hold_every_figure_from_both_sides) {
    const auto figures = evolution(read_scene("figure1")).figures();
    BOOST_TEST(figures.at("onsets") == 10.0);
    BOOST_TEST(figures.at("releases") == 10.0);
    BOOST_TEST(figures.at("theta@0.5.greatest") == 2.0);
    BOOST_TEST(figures.at("theta@0.5.first") == 2.0);
    BOOST_TEST(figures.count("stress.first") == 0U); // not defined at t = 0
    BOOST_TEST(std::isfinite(figures.at("stress.mean")));
    BOOST_TEST(figures.at("samples") == 5001.0);
    BOOST_TEST(figures.at("u@1.period_change") <= figures.at("period_change"));
    BOOST_TEST(figures.at("u@1.last") < 0.1);
    BOOST_TEST(figures.at("period_change") < 1e-6);
    BOOST_TEST(figures.count("u@1.error") == 0U); // there is no exact solution
}

BOOST_AUTO_TEST_CASE(mistakes_in_the_block_are_pointed_at) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"probes=[]", "missing or empty"},
        {"probes=[\"theta\"]", "must say where it stands"},
        {"probes=[\"u@1.5\"]", "X between 0 and 1"},
        {"probes=[\"u@x\"]", "X between 0 and 1"},
        {"probes=[\"thta@0.5\"]", "did you mean 'theta'?"},
        {"probes=[\"u@1\", \"u@1\"]", "twice"},
        {"probes=[\"u@0.5\", \"stress\", \"u@.5\"]", "the same as"},
        {"elements=0", "a mesh has 1 to"},
        {"dt=0.3", "whole number of steps"},
        {"every=7", "divide the 5000 steps"},
        {"period=0.00051", "whole number of samples"},
        {"period=4", "two of them must fit"},
        {"sample=4", "unknown key"},
    };
    for (const auto& [assignment, message] : mistakes) {
        const auto says = [&wanted = message](const InputError& error) {
            return std::string(error.what()).find(wanted) != std::string::npos;
        };
        BOOST_CHECK_EXCEPTION(read_scene("figure1", {"evolution." + assignment}), InputError, says);
    }
}

// It would have no error to measure.
BOOST_AUTO_TEST_CASE(a_reference_without_a_ladder_is_refused) {
    BOOST_CHECK_THROW(read_scene("figure1", {"reference.elements=200", "reference.dt=1e-4"}),
                      InputError);
}

// A load of 0.01 about the first stage of the step from 0.5 presses the tip on g2 there, and no
// step's end shows it; without the stop nothing is met.
BOOST_AUTO_TEST_CASE(a_contact_in_a_stage_alone_is_not_taken_for_none) {
    const auto run = [](const std::string& stops) {
        return evolution_of("[data]\ntheta0 = '0'\nu0 = '0'\n"
                            "body_force = '-60*exp(-((t - 0.52929)/0.01)^2)'\n[beam]\nalpha = 0\n"
                            "zeta = 0.01\nstops = " +
                            stops +
                            "\n[scheme]\ntime = 'sdirk2'\n[evolution]\nfinal_time = 1\n"
                            "elements = 4\ndt = 0.1\nprobes = ['u@1', 'stress']\n");
    };
    const EvolutionResult met = run("[-0.02, 0.1]");
    const EvolutionResult free = run("[-20, 20]");
    BOOST_TEST(met.events.empty());
    BOOST_TEST(met.presses_within_steps());
    BOOST_TEST(greatest_difference(met.probes[0], free.probes[0]) > 0.0);
    BOOST_TEST(!free.presses_within_steps());
}

// The round-off of U⁰ grows with the shortest element. The tip leaves g2 at once, or is pressed on
// it by the load from t = 0 on.
BOOST_AUTO_TEST_CASE(a_start_on_a_stop_is_one_on_a_mesh_with_a_short_element) {
    const auto run = [](const std::string& nodes, const std::string& beam,
                        const std::string& force) {
        return evolution_of("[data]\ntheta0 = '0'\nu0 = '0.1*x^2'\nbody_force = '" + force +
                            "'\n[beam]\nalpha = 0\nzeta = 0.1\nstops = [-0.02, 0.1]\n" + beam +
                            "[scheme]\nalgorithm = 'fixed-point'\n[mesh]\nnodes = " + nodes +
                            "\n[evolution]\nfinal_time = 1\nelements = 6\ndt = 0.1\n"
                            "probes = ['u@1']\n");
    };
    const std::string yields = "contact = { law = 'penalty', epsilon = 1e-3 }\n";
    const EvolutionResult left = run("[0, 0.5, 0.501, 1]", yields, "0");
    BOOST_TEST(left.events.empty());
    BOOST_TEST(left.beyond_stops == 0.0);
    const EvolutionResult held = run("[0, 0.5, 0.51, 1]", "", "-20");
    BOOST_REQUIRE(!held.events.empty());
    BOOST_TEST(held.events[0].t == 0.0);
}

// Elements of 1e-5 at the clamped end.
BOOST_AUTO_TEST_CASE(a_start_off_the_stops_is_none_on_one_on_a_graded_mesh) {
    const EvolutionResult pushed = evolution_of(
        "[data]\ntheta0 = '0'\nu0 = '0.05*x^2'\nbody_force = '10'\n[beam]\nalpha = 0\n"
        "zeta = 0.1\nstops = [-0.02, 0.1]\n[scheme]\nalgorithm = 'fixed-point'\n"
        "[mesh]\ngrading = 2.5\n[evolution]\nfinal_time = 0.3\nelements = 100\ndt = 0.1\n"
        "probes = ['u@1']\n");
    BOOST_REQUIRE(!pushed.events.empty());
    BOOST_TEST(pushed.events[0].t > 0.0);
}

// The fixed point does not come to rest in its first step.
BOOST_AUTO_TEST_CASE(a_run_that_failed_has_no_figures_of_the_part_that_it_made) {
    const EvolutionResult failed =
        evolution_of("[data]\ntheta0 = 'sin(pi*x)'\nu0 = '0'\n[beam]\nalpha = 1.5\n"
                     "zeta = 0.01\nstops = [-0.1, 0.1]\n[scheme]\nalgorithm = 'fixed-point'\n"
                     "[evolution]\nfinal_time = 1\nelements = 8\ndt = 0.1\nprobes = ['u@1']\n");
    BOOST_REQUIRE((failed.run.status == RungStatus::failed));
    const auto figures = failed.figures();
    BOOST_TEST(figures.count("u@1.last") == 1U);
    BOOST_TEST(figures.count("onsets") == 1U);
    for (const auto& [name, figure] : figures)
        BOOST_TEST(std::isnan(figure), name << " = " << figure);
}

BOOST_AUTO_TEST_SUITE_END()

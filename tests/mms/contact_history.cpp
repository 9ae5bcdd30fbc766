// What an exact solution does at the stops: touches, onsets and their powers.

#include "mms/contact_history.hpp"
#include "mms/forecast/expected_orders.hpp"
#include "mms/solution.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace data = boost::unit_test::data;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_contact_history)

namespace {

constexpr double final_time = 2.0;

ContactHistory history(const std::string& document) {
    const Beam beam{.alpha = 0.4, .zeta = 0.15, .theta_A = 0.0, .stops = {-0.02, 0.1}};
    return contact_history(
        derive_on(parse_solution("theta = 'sin(pi*x)'\n" + document, "my.toml"), beam), beam.stops,
        final_time);
}

/// A formula for u whose tip is g2 times this one.
std::string tip(const std::string& share) {
    return "u = 'g2*(3*x^2 - x^3)/2*(" + share + ")'\n";
}

/// Until t = 1 the tip is short of g2 by this share of it; then a force presses it on.
ContactHistory onset(const std::string& gap, const std::string& force) {
    return history("[[phase]]\nuntil = 1\n" + tip("1 - " + gap) + "[[phase]]\n" + tip("1") +
                   "sigma = '-" + force + "'\n");
}

} // namespace

// Free until t = c, and pressed from then on, in one formula each.
BOOST_AUTO_TEST_CASE(a_contact_that_begins_within_a_phase_is_not_one_from_the_start) {
    const auto history_of = [](const std::string& u, const std::string& sigma) {
        return expected_orders(
            {parse_solution("theta = 'sin(pi*x)*exp(-t)'\nu = 'g2*(3*x^2 - x^3)/2" + u +
                                "'\nsigma = '" + sigma + "'\n[parameters]\nc = 1.037\n",
                            "within.toml"),
             {0.4, 0.15, 0.0, {-0.1, 0.1}},
             2.0});
    };
    const auto begins = history_of("*(1 - ((c - t) + sqrt((c - t)^2))^3/8/c^3)",
                                   "-((t - c) + sqrt((t - c)^2))^2/4");
    BOOST_REQUIRE(begins.contact.within);
    BOOST_TEST(std::abs(*begins.contact.within - 1.037) < 1e-2); // the gap is flat there
    const auto ends = history_of("*(1 - ((t - c) + sqrt((t - c)^2))^3/8/c^3)",
                                 "-((c - t) + sqrt((c - t)^2))^2/4");
    BOOST_REQUIRE(ends.contact.within);
    for (const auto& known : {begins, ends}) {
        const ExpectedOrder& stress = known.orders.back();
        BOOST_REQUIRE(stress.norm == "sigma_L2");
        BOOST_TEST((stress.bdf2.kind == Forecast::Kind::unknown));
        BOOST_TEST(std::ranges::any_of(known.reasons, [](const std::string& reason) {
            return reason.starts_with("about t = 1.0");
        }));
    }
    BOOST_TEST(!history_of("", "-1 - t").contact.within);
    // At the stop all the time, and pressed from c on; no rest is the zero of a force, or its
    // begin.
    const auto presses = history_of("", "-((t - c) + sqrt((t - c)^2))/2");
    const auto lets_go = history_of("", "-((c - t) + sqrt((c - t)^2))/2");
    for (const auto& known : {presses, lets_go}) {
        BOOST_REQUIRE(known.contact.within);
        BOOST_TEST(std::abs(*known.contact.within - 1.037) < 1e-2);
    }
    for (const std::string sigma : {"-sin(3*t)^2", "-t^6"})
        BOOST_TEST(!history_of("", sigma).contact.within, sigma);
}

BOOST_DATA_TEST_CASE(a_touch_without_a_force_is_seen_wherever_it_is,
                     data::make({"0", "0.003", "0.0075", "0.3", "1.2345", "1.995", "1.998", "2"}),
                     at) {
    const ContactHistory found = history(tip("1 - (t - " + std::string(at) + ")^2/9"));
    BOOST_TEST(found.onsets.empty());
    BOOST_TEST(!found.pressed_until);
    BOOST_REQUIRE(found.touch);
    // Where a parabola is flat it does not change within the square root of round-off.
    BOOST_TEST(std::abs(*found.touch - std::stod(at)) <= 1e-6);
}

BOOST_DATA_TEST_CASE(an_onset_has_the_powers_of_its_formulas,
                     data::make({1, 2, 6}) * data::make({0, 1, 6}), m, k) {
    const ContactHistory found =
        onset("(1 - t)^" + std::to_string(m), "(1 + t)*(t - 1)^" + std::to_string(k));
    BOOST_TEST(!found.touch);
    BOOST_REQUIRE(found.onsets.size() == 1);
    BOOST_TEST(found.onsets[0].t == 1.0);
    BOOST_TEST((found.onsets[0].approach == m));
    BOOST_TEST((found.onsets[0].force == k));
    BOOST_TEST((found.pressed_until == final_time));
}

// Over a phase of length 1 a term c (1 − t)^6 is c at most: less than 1e-9 is nothing, though its
// sixth derivative is 720 c. What is left is flatter than any power looked for.
BOOST_AUTO_TEST_CASE(a_term_that_is_nothing_over_its_phase_is_no_power) {
    const ContactHistory nothing = onset("((1 - t)^8 + 5e-10*(1 - t)^6)", "(t - 1)");
    BOOST_REQUIRE(nothing.onsets.size() == 1);
    BOOST_TEST(!nothing.onsets[0].approach);
    const ContactHistory something = onset("((1 - t)^8 + 2e-9*(1 - t)^6)", "(t - 1)");
    BOOST_REQUIRE(something.onsets.size() == 1);
    BOOST_TEST((something.onsets[0].approach == 6));
}

// The pulse is far narrower than the times between which the tip is looked at, and comes from where
// the tip is nearer to the other stop.
BOOST_DATA_TEST_CASE(a_touch_by_a_narrow_pulse_is_said_to_be_one,
                     data::make({"2e5", "1e6", "1e7", "1e9"}), narrow) {
    const Beam beam{.alpha = 0.3, .zeta = 0.1, .theta_A = 0.0, .stops = {-0.1, 0.2}};
    const AdmissibleSolution solution(
        parse_solution(std::string("theta = 'sin(pi*x)*t'\nu = 'x^2*(3-x)*0.1*exp(-") + narrow +
                           "*(t-0.123456)^2)'\n",
                       "my.toml"),
        beam, 1.0);
    const ExpectedOrders expected = expected_orders(solution);
    BOOST_REQUIRE(expected.contact.touch);
    BOOST_TEST(std::abs(*expected.contact.touch - 0.123456) < 1e-6);
    for (const std::string& reason : expected.reasons)
        BOOST_TEST(!reason.starts_with("The tip never reaches a stop"), reason);
    const ReachedStops reached = reached_stops(solution.derived(), beam.stops, 1.0);
    BOOST_TEST(reached.upper);
    BOOST_TEST(!reached.lower);
}

BOOST_AUTO_TEST_SUITE_END()

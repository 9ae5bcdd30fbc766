// [expect.derive]: what theory says of a solution before any run is held against what a scene says.

#include "mms/text/input_error.hpp"
#include "studies/gates/check.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(derived_expectations)

namespace {

const std::string ladder = "[ladder]\nfinal_time = 1.0\nelements = [5]\ndt = [0.1]\n"
                           "norms = ['theta_L2L2']\n";
const std::string oscillation =
    "solution = 'free-oscillation'\n[beam]\nalpha = 0.3\nzeta = 0.05\nstops = [-0.1, 0.1]\n" +
    ladder;
const std::string paper = "solution = 'copetti-fernandez-2011'\n[beam]\nalpha = 0.017\n"
                          "zeta = 0.1\nstops = [-0.02, 0.1]\n" +
                          ladder;

/// What `[expect.derive]` with this line below it comes to.
std::vector<CheckedExpectation> checked(const std::string& scene, const std::string& line,
                                        const std::vector<std::string>& overrides = {}) {
    const TemporaryDirectory directory;
    directory.write("quadratic.toml", "theta = 't^2*sin(pi*x)'\nu = '0'\n");
    const auto file = directory.write("s.toml", scene + "[expect.derive]\n" + line + "\n");
    return check(run_study(read_scene(file, overrides, {.expectations = true})));
}

std::string refusal(const std::string& scene, const std::string& line) {
    try {
        checked(scene, line);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

struct Claim {
    std::string line;
    std::string violated; ///< by what is found; empty: it holds
};

std::ostream& operator<<(std::ostream& stream, const Claim& claim) {
    return stream << claim.line;
}

// θ = sin 3t (sin πx + sin(2πx)/2) and u, a cubic in x with a tip below g2, times cos 2t: q = 0,
// θ0 = 0, u0 and m are not; what order in h u has comes through the coupling.
const std::vector<Claim> of_the_oscillation{
    {"exercises = ['theta_xx', 'an initial deflection', 'an end moment m']", ""},
    {"untested = ['a force at the stop g2', 'an initial temperature']", ""},
    {"exercises = ['theta_xx', 'a body force q']", "untested: sigma does not depend on x"},
    {"untested = ['a body force q', 'theta_xx']", "exercised, up to "},
    {"reasons = ['u is cubic in x', 'The tip never reaches a stop']", ""},
    {"reasons = ['u is cubic in x']", "The tip never reaches a stop"},
    {"reasons = []", "u is cubic in x"},
    {"formulas_within = 1e-14", ""},
    {"formulas_within = 1e-30", "e-1"},
    {"space_residual = [1.9, 2.1]", ""},
    {"exact = ['beam in time']", "one of order "},
    {"exact = ['heat in space']", "one of order "},
    {"largest = { u_xxx = [0.01, 0.02] }", "0.075"},
    {"residual = { 'beam in time' = [0, 1e-9] }", "e-0"},
    {"time_residual = { euler = [0.9, 1.1], bdf2 = [1.9, 2.1], sdirk2 = [1.9, 2.1] }", ""},
    {"theta_L2H1 = { h = 1, euler = 1, bdf2 = 2, sdirk2 = 2.0 }", ""},
    {"u_LinfL2 = { h = '2' }", ""},
    {"u_LinfL2 = { h = 4 }", "2"},
    {"theta_L2L2 = { sdirk2 = 1 }", "2"},
    {"theta_L2L2 = { bdf2 = '1 to 2' }", "2"},
    {"theta_L2L2 = { euler = 2 }", "1"},
    {"theta_L2L2 = { h = 'not known' }", "2"},
    {"sigma_L2 = { h = '-', euler = '-' }", ""},
    {"sigma_L2 = { euler = 1 }", "-"},
    {"sigma_L2 = { a = [0, 1] }", "no error of that kind"},
};

// At g2 (√2t − t²/2) the tip comes up like (√2 − t)², and σ jumps to −√2: j = 1 and j = 0.
const std::vector<Claim> of_the_paper_s{
    {"exercises = ['a force at the stop g2', 'a free tip between stops']", ""},
    {"sigma_L2 = { h = '1 to 2', euler = '0.5 to 0.75', bdf2 = 1.5, sdirk2 = 1.5 }", ""},
    {"sigma_L2 = { euler = 0.5 }", "0.5 to 0.75"},
    {"sigma_L2 = { euler = '0.50 to 0.750', bdf2 = '1.5 to 1.5' }", ""},
    {"theta_L2L2 = { a = [0, 10] }", "not known: a contact begins at t = 1.41421"},
    {"theta_L2L2 = { b = { euler = [0, 10] } }", "not known: a contact begins at t = 1.41421"},
};

void check_claim(const std::string& scene, const Claim& claim,
                 const std::vector<std::string>& overrides = {}) {
    const auto all = checked(scene, claim.line, overrides);
    BOOST_TEST(!all.empty());
    std::size_t violated = 0;
    for (const auto& one : all)
        if (!one.holds) {
            ++violated;
            BOOST_TEST(!claim.violated.empty(), one.what << ": " << one.found);
            BOOST_TEST(one.found.find(claim.violated) != std::string::npos, one.found);
            BOOST_TEST(one.what.starts_with("derive."), one.what);
            BOOST_TEST(one.place.line > 0);
        }
    BOOST_TEST(violated == (claim.violated.empty() ? 0U : 1U));
}

} // namespace

BOOST_DATA_TEST_CASE(a_right_claim_holds_and_no_other, data::make(of_the_oscillation)) {
    check_claim(oscillation, sample);
}

BOOST_DATA_TEST_CASE(an_onset_of_contact_is_claimed_as_derive_says, data::make(of_the_paper_s)) {
    check_claim(paper, sample, {"ladder.final_time=2"});
}

// BDF2 differs from what is quadratic in t by its first step alone: O(dt³).
BOOST_AUTO_TEST_CASE(each_order_in_dt_is_of_its_own_scheme) {
    const std::string quadratic =
        "solution = './quadratic.toml'\n[beam]\nalpha = 0\nzeta = 0.05\n" + ladder;
    check_claim(quadratic, {"theta_L2L2 = { h = 2, euler = 1, bdf2 = 3, sdirk2 = 2 }", ""});
    check_claim(quadratic, {"theta_L2L2 = { bdf2 = 2 }", "3"});
    check_claim(quadratic, {"theta_L2L2 = { sdirk2 = 3 }", "2"});
}

// What is derived is of the scene's beam, up to the end of its own studies.
BOOST_AUTO_TEST_CASE(claims_are_of_the_scene_s_beam_and_time) {
    const Claim pressed{"untested = ['a force at the stop g2']", "exercised, up to "};
    check_claim(paper, pressed, {"ladder.final_time=2"});
    check_claim(paper, {pressed.line, ""}); // the contact begins at sqrt(2)
    check_claim(oscillation, {"theta_L2L2 = { h = 2 }\nu_LinfL2 = { h = 2 }", ""});
    check_claim(oscillation, {"u_LinfL2 = { h = 2 }", "-"}, {"beam.alpha=0"});
}

BOOST_AUTO_TEST_CASE(every_residual_order_is_held_from_both_sides) {
    const auto violations = [](const std::string& line) {
        const auto all = checked(oscillation, line);
        return std::count_if(all.begin(), all.end(), [](const auto& one) { return !one.holds; });
    };
    for (const std::string band : {"[1.0, 1.9]", "[2.1, 3.0]"}) // heat and beam
        BOOST_TEST(violations("space_residual = " + band) == 2, band);
    BOOST_TEST(violations("time_residual = { euler = [1.9, 2.1] }") == 2);
    BOOST_TEST(violations("time_residual = { bdf2 = [0.9, 1.1], sdirk2 = [0.9, 1.1] }") == 4);
    // Without viscosity the beam has no step that could leave a residual.
    const auto elastic =
        checked(oscillation, "time_residual = { euler = [0.9, 1.1] }", {"beam.zeta=0"});
    BOOST_REQUIRE(elastic.size() == 2U);
    BOOST_TEST(elastic[0].holds);
    BOOST_TEST(elastic[1].found == "none: the residual is zero");
}

// What linear elements leave of θ_x is θ_xx h/√12 at most, in L² over time that of sin 3t:
// a² = 5π⁴/2 · ∫ sin²3t dt/12. With a lumped mass matrix it is the same; ‖e_θ‖ is not.
BOOST_AUTO_TEST_CASE(sizes_are_those_of_the_scene_s_mass_matrix) {
    const double pi = boost::math::constants::pi<double>();
    const double a = pi * pi * std::sqrt(2.5 * (0.5 - std::sin(6.0) / 12.0) / 12.0);
    const auto band = [](double value) {
        return "[" + std::to_string(0.9995 * value) + ", " + std::to_string(1.0005 * value) + "]";
    };
    check_claim(oscillation, {"theta_L2H1 = { a = " + band(a) + " }", ""});
    check_claim(oscillation, {"theta_L2H1 = { a = " + band(1.002 * a) + " }", "3.25"});
    const std::string lumped = "scheme.thermal_mass=lumped";
    check_claim(oscillation, {"theta_L2H1 = { a = " + band(a) + " }", ""}, {lumped});
    // Fitted to runs with either mass matrix: 1.018 and 1.050.
    check_claim(oscillation, {"theta_L2L2 = { a = [1.016, 1.020] }", ""});
    check_claim(oscillation, {"theta_L2L2 = { a = [1.016, 1.020] }", "1.05"}, {lumped});
}

// What a size multiplies, a power of h, is of uniform meshes.
BOOST_AUTO_TEST_CASE(no_size_is_known_on_graded_meshes) {
    for (const std::string size : {"a = [1.016, 1.020]", "b = { euler = [0.2218, 0.2226] }"})
        check_claim(oscillation, {"theta_L2L2 = { " + size + " }", "the meshes are not uniform"},
                    {"mesh.grading=3"});
}

// Fitted to runs on fine meshes: 0.2222, 0.3565 and 0.1493.
BOOST_AUTO_TEST_CASE(each_time_scheme_has_a_size_of_its_own) {
    check_claim(oscillation, {"theta_L2L2 = { b = { euler = [0.2218, 0.2226], bdf2 = [0.3558, "
                              "0.3572], sdirk2 = [0.149, 0.1496] } }",
                              ""});
    check_claim(oscillation, {"theta_L2L2 = { b = { sdirk2 = [0.2218, 0.2226] } }", "0.149"});
}

BOOST_AUTO_TEST_CASE(what_cannot_be_claimed_is_refused_at_its_place) {
    const auto said = [](const std::string& line, const std::string& text) {
        const std::string message = refusal(oscillation, line);
        BOOST_TEST(message.find(text) != std::string::npos, line << ": " << message);
    };
    said("exercises = ['theta_t', 'theta_x']",
         "s.toml:12:25: expect.derive.exercises holds 'theta_x', which is no term; did you mean "
         "'theta_");
    said("untested = ['a force']", "they are theta_t, theta_xx, alpha*u_xxt, a heat source f");
    said("theta_L2H2 = { h = 1 }", "nothing is derived; did you mean 'theta_L2L2'?");
    said("corollary_2 = { h = 1 }", "the norms are theta_L2L2, theta_LinfL2");
    said("", "expect.derive expects nothing; give it a bound, or remove it");
    // Nor does an empty table hide behind another.
    for (const std::string table : {"time_residual", "theta_L2L2", "theta_L2L2.b"})
        said(fmt::format("space_residual = [1.9, 2.1]\n{} = {{}}", table),
             fmt::format("expect.derive.{} expects nothing", table));
    for (const std::string order : {"'two'", "'1 To 2'", "'2 to 1'", "-1", "true", "'2 '", "''"})
        said("theta_L2L2 = { h = " + order + " }", "it must be an order, as 2 or");
    said("exercises = ['theta_t']\nuntested = []", "untested is empty, and expects nothing");
    said("reasons = ['']", "a text without a letter");
    said("space_residual = 2", "a gate has two sides");
    said("theta_L2L2 = { b = { euler = 0.2 } }", "a gate has two sides");
    said("time_residual = { rk4 = [3.9, 4.1] }", "unknown key");
}

// A pulse that stands between the times that are looked at is none the less there.
BOOST_AUTO_TEST_CASE(no_pulse_is_claimed_to_be_exact) {
    const auto of = [](const std::string& narrow, const std::string& exact) {
        const TemporaryDirectory directory;
        directory.write("pulse.toml", "theta = 'sin(pi*x)*exp(-" + narrow +
                                          "*(t-0.3)^2)'\nu = 'x^2*(3-x)*0.01'\n");
        const auto file = directory.write(
            "s.toml", "solution = './pulse.toml'\n[beam]\nalpha = 0.3\nzeta = 0.1\n" + ladder +
                          "[expect.derive]\nexact = ['" + exact + "']\n");
        return check(run_study(read_scene(file, {}, {.expectations = true}))).front();
    };
    for (const std::string narrow : {"1e6", "3e6", "1e7"})
        BOOST_TEST(of(narrow, "heat in space").found.starts_with("one of order "), narrow);
    for (const std::string equation : {"heat in space", "heat in time"})
        BOOST_TEST(of("1e20", equation).found.starts_with("none where it was looked at"), equation);
    BOOST_TEST(of("1e20", "beam in time").holds);
}

BOOST_AUTO_TEST_CASE(nothing_is_derived_where_a_scene_runs_no_solution) {
    const std::string text = "expect.derive expects something of what is derived from a solution, "
                             "and the scene runs none";
    const std::string beam = "[beam]\nalpha = 0.3\nzeta = 0.05\n";
    const std::string evolution = "[evolution]\nfinal_time = 1.0\nelements = 4\ndt = 0.5\n"
                                  "probes = ['u@1']\n";
    for (const std::string& scene :
         {fmt::format("{}[data]\ntheta0 = 'x*(1 - x)'\n{}", beam, evolution),
          std::string("[solver]\ncommand = ['true']\nerrors = { L2 = '(.*)' }\n[ladder]\n"
                      "elements = [4, 8]\nnorms = ['L2']\n"),
          std::string("[stress.roundoff]\nelements = [4]\n"),
          fmt::format("solution = 'free-oscillation'\n{}[stress.roundoff]\nelements = [4]\n",
                      beam)})
        BOOST_TEST(refusal(scene, "exercises = ['theta_t']").find(text) != std::string::npos,
                   scene << refusal(scene, "exercises = ['theta_t']"));
}

BOOST_AUTO_TEST_SUITE_END()

// Expectations: two-sided, met by the right result, and by no other.

#include "studies/gates/check.hpp"
#include "mms/text/input_error.hpp"
#include "studies/data/data_check.hpp"
#include "studies/data/data_file.hpp"
#include "studies/ladder/ladder.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(expectations)

namespace {

const std::string head = R"(solution = "copetti-fernandez-2011"
[beam]
alpha = 0.017
zeta  = 0.1
stops = [-0.02, 0.1]
[scheme]
thermal_mass = "lumped"
[ladder]
final_time = 2.0
elements   = [10, 20]
dt         = [1e-3, 5e-4]
norms      = ["theta_L2L2_sq"]
[ladder.printed]
theta_L2L2_sq = [1.245e-3, 7.734e-5]
)";

std::vector<CheckedExpectation> checked(const std::string& expect,
                                        const std::vector<std::string>& overrides = {}) {
    const TemporaryDirectory directory;
    return check(run_study(
        read_scene(directory.write("s.toml", head + expect), overrides, {.expectations = true})));
}

std::size_t violations(const std::vector<CheckedExpectation>& all) {
    return static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [](const CheckedExpectation& one) { return !one.holds; }));
}

std::string message_of(const std::string& expect) {
    try {
        checked(expect);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

BOOST_AUTO_TEST_CASE(a_remark_is_expected_by_how_it_begins_and_none_may_be_missing) {
    const auto violated = [](const std::string& wanted) {
        return violations(checked("[expect.ladder.theta_L2L2_sq]\nremarks = " + wanted,
                                  {"ladder.elements=[10, 20, 40]", "ladder.dt=[1e-3, 5e-4, 2.5e-4]",
                                   "ladder.printed.theta_L2L2_sq=[1, 1, 1]"}));
    };
    BOOST_TEST(violated("['theta_L2L2_sq: order 4.01 to 4.02 (the square']") == 0U);
    BOOST_TEST(violated("['theta_L2L2_sq: order 3.9']") == 1U);
    BOOST_TEST(violated("[]") == 1U);
    BOOST_TEST(violated("['theta', 'theta']") == 1U);
    BOOST_TEST(violations(checked("[expect]\nremarks = []")) == 0U);
    BOOST_TEST(violations(checked("[expect.ladder]\nremarks = ['The reference']")) == 1U);
}

// A step of Euler has one solve of each equation; T = 2.
BOOST_AUTO_TEST_CASE(what_runs_did_is_expected_level_by_level) {
    const std::string counters = "[expect.ladder]\ncounters = ";
    BOOST_TEST(violations(checked(
                   counters + "{ heat_solves = [2000, 4000], beam_solves = [2000, 4000] }")) == 0U);
    BOOST_TEST(violations(checked(counters + "{ heat_solves = [2000, 4001] }")) == 1U);
    // A counter that there is not is not zero.
    BOOST_TEST(violations(checked(counters + "{ heat_solve = [0, 0] }")) == 1U);
    BOOST_TEST(message_of(counters + "{ heat_solves = [2000] }")
                   .find("heat_solves has 1 value for 2 rungs; give one a rung") !=
               std::string::npos);
}

BOOST_AUTO_TEST_CASE(right_bands_hold) {
    const auto all =
        checked("[expect.ladder.theta_L2L2_sq]\norders = [3.9, 4.1]\nratios = [0.99, 1.01]\n"
                "errors = [1.24547e-3, 7.74087e-5]\n");
    BOOST_TEST(all.size() == 1u + 2u + 2u);
    BOOST_TEST(violations(all) == 0u);
}

BOOST_AUTO_TEST_CASE(every_gate_has_two_sides) {
    // The observed order is 4.01, the first ratio 1.0004.
    for (const std::string band : {"orders = [4.1, 4.5]", "orders = [3.5, 3.9]"})
        BOOST_TEST(violations(checked("[expect.ladder.theta_L2L2_sq]\n" + band + "\n")) == 1u,
                   band);
    for (const std::string band : {"ratios = [1.1, 1.2]", "ratios = [0.8, 0.9]"})
        BOOST_TEST(violations(checked("[expect.ladder.theta_L2L2_sq]\n" + band + "\n")) == 2u,
                   band);
    for (const std::string errors : {"errors = [1.3e-3, 8e-5]", "errors = [1.2e-3, 7e-5]"})
        BOOST_TEST(violations(checked("[expect.ladder.theta_L2L2_sq]\n" + errors + "\n")) == 2u,
                   errors);
}

BOOST_AUTO_TEST_CASE(a_band_holds_its_ends_and_nothing_beyond_or_that_is_no_number) {
    const auto holds = [](std::optional<double> value, double lowest, double highest) {
        return held({"a figure", value, "none"}, lowest, highest, {}).holds;
    };
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double inside : {1.0, 1.5, 2.0})
        BOOST_TEST(holds(inside, 1.0, 2.0));
    for (const double outside :
         {std::nextafter(1.0, 0.0), std::nextafter(2.0, 3.0), -1.5, infinite})
        BOOST_TEST(!holds(outside, 1.0, 2.0));
    BOOST_TEST(!holds(std::numeric_limits<double>::quiet_NaN(), -infinite, infinite));
    BOOST_TEST(!holds(std::nullopt, -infinite, infinite));
}

BOOST_AUTO_TEST_CASE(every_order_along_a_ladder_is_held) {
    const auto all = checked("[expect.ladder.theta_L2L2_sq]\norders = [3.9, 4.1]\n",
                             {"ladder.elements=[5, 10, 20, 40]",
                              "ladder.dt=[2e-3, 1e-3, 5e-4, 2.5e-4]", "ladder.printed={}"});
    BOOST_REQUIRE(all.size() == 3U);
    for (const std::size_t row : {1U, 2U, 3U})
        BOOST_TEST(all[row - 1].what.find("s = " + std::to_string(5 << row) + ",") !=
                       std::string::npos,
                   all[row - 1].what);
}

BOOST_AUTO_TEST_CASE(a_defect_of_the_scheme_s_own_order_shows_in_the_constant_alone) {
    // The consistent mass matrix has the same orders and 0.74 times the error.
    const auto all = checked(
        "[expect.ladder.theta_L2L2_sq]\norders = [3.9, 4.1]\nerrors = [1.24547e-3, 7.74087e-5]\n",
        {"scheme.thermal_mass=consistent"});
    BOOST_TEST(all[0].holds);
    BOOST_TEST(!all[1].holds);
    BOOST_TEST(!all[2].holds);
}

BOOST_AUTO_TEST_CASE(a_scene_whose_expectations_find_nothing_to_check_does_not_pass) {
    const auto all = checked("[expect.ladder.theta_L2L2_sq]\norders = [3.9, 4.1]\n",
                             {"ladder.elements=[10]", "ladder.dt=[1e-3]", "ladder.printed={}"});
    BOOST_TEST(all.size() == 1u);
    BOOST_TEST(violations(all) == 1u);
    // Nor does it hide behind another expectation that holds.
    const auto two = checked("[expect.ladder.theta_L2L2_sq]\norders = [3.9, 4.1]\nerrors = "
                             "[1.2455e-3]\n",
                             {"ladder.elements=[10]", "ladder.dt=[1e-3]", "ladder.printed={}"});
    BOOST_TEST(two.size() == 2u);
    BOOST_TEST(violations(two) == 1u);
}

BOOST_AUTO_TEST_CASE(an_order_that_is_not_determined_does_not_hold_and_says_why) {
    // Steps of T/4 and more: the error in time hides that in space, whose order the grid does not
    // tell.
    const auto all = checked(
        "[orders]\nfinal_time = 1\nelements = [40, 60, 80, 120]\ndt = [0.25, 0.2, 0.125, 0.1]\n"
        "norms = [\"u_LinfH2semi\"]\n[expect.orders.u_LinfH2semi]\np = [1.7, 1.76]\n");
    BOOST_TEST(all.size() == 1u);
    BOOST_TEST(violations(all) == 1u, all[0].found);
    BOOST_TEST(all[0].found.starts_with("not determined: hidden"), all[0].found);
}

BOOST_AUTO_TEST_CASE(a_run_that_failed_meets_no_expectation) {
    const auto all =
        checked("[expect.ladder.theta_L2L2_sq]\norders = [-1e9, 1e9]\nratios = [-1e9, 1e9]\n"
                "errors = [1.2e-3, 7.7e-5]\nwithin = 0.5\n",
                {"beam.alpha=1e200"});
    BOOST_TEST(all.size() == 5u);
    BOOST_TEST(violations(all) == 5u);
    BOOST_TEST(all[1].found.find("no error:") != std::string::npos, all[1].found);
}

BOOST_AUTO_TEST_CASE(a_violation_says_what_was_expected_found_and_where) {
    const auto all = checked("[expect.ladder.theta_L2L2_sq]\norders = [1.9, 2.1]\n");
    BOOST_TEST(all[0].what == "ladder.theta_L2L2_sq: observed order at s = 20, dt = 0.0005");
    BOOST_TEST(all[0].expected == "1.9 to 2.1");
    BOOST_TEST(all[0].found.starts_with("4.00"));
    BOOST_TEST(all[0].place.line == 16);
    BOOST_TEST(all[0].place.column == 10);
}

BOOST_AUTO_TEST_CASE(published_figures_are_one_a_level) {
    for (const std::string figures : {"[1.2e-3]", "[1.2e-3, 7.7e-5, 4.8e-6]"})
        BOOST_CHECK_THROW(checked("[expect.ladder.theta_L2L2_sq]\norders = [3, 5]\n",
                                  {"ladder.printed={theta_L2L2_sq=" + figures + "}"}),
                          InputError);
}

BOOST_AUTO_TEST_CASE(a_level_beyond_the_grid_in_one_width_is_a_prediction) {
    const auto all = checked(
        "[orders]\nfinal_time = 1\nelements = [4, 8, 16, 32]\ndt = [0.1, 0.05, 0.025, 0.0125]\n"
        "norms = [\"theta_L2L2\"]\n[expect.ladder.theta_L2L2_sq]\npredicted = [0.5, 2]\n",
        {"ladder.final_time=1", "ladder.elements=[32, 64]", "ladder.dt=[0.0125, 0.0125]",
         "ladder.printed={}"});
    BOOST_REQUIRE(all.size() == 1U);
    BOOST_TEST(all[0].holds, all[0].found);
    BOOST_TEST(all[0].what.find("s = 64,") != std::string::npos, all[0].what);
}

BOOST_AUTO_TEST_CASE(orders_of_the_grid_are_expected_by_their_names) {
    const std::string grid =
        "[orders]\nfinal_time = 1\nelements = [4, 8, 16, 32]\ndt = [0.1, 0.05, 0.025, 0.0125]\n"
        "norms = [\"theta_L2L2\"]\n[expect.orders.theta_L2L2]\n";
    BOOST_TEST(
        violations(checked(grid + "p = [1.8, 2.2]\nq = [0.8, 1.2]\nrho = [-1, 1]\na = [0.1, 10]\n"
                                  "b = [0.001, 1]\n")) == 0u);
    BOOST_TEST(violations(checked(grid + "p = [0.8, 1.2]\nq = [1.8, 2.2]\n")) == 2u);
}

BOOST_AUTO_TEST_CASE(a_prediction_without_a_model_or_a_finer_rung_does_not_hold) {
    BOOST_TEST(violations(checked("[expect.ladder.theta_L2L2_sq]\npredicted = [-1e9, 1e9]\n")) ==
               1u);
}

BOOST_AUTO_TEST_CASE(wrong_expectations_are_told) {
    const auto says = [](const std::string& expect, const std::string& part) {
        const std::string message = message_of(expect);
        BOOST_TEST(message.find(part) != std::string::npos, message << " must say " << part);
    };
    says("[expect.ladder.theta_L2L2_sq]\norders = 4\n",
         "must be a band [lowest, highest]: a gate has two sides");
    says("[expect.ladder.theta_L2L2_sq]\norders = [4.1, 3.9]\n",
         "lowest value is not below its highest");
    says("[expect.ladder.theta_L2L2_sq]\norders = [3.9, inf]\n", "finite");
    says("[expect.ladder.theta_L2L2_sq]\nerrors = [1e-3]\n", "has 1 value for 2 rungs");
    says("[expect.ladder.theta_L2L2_sq]\norder = [3.9, 4.1]\n", "did you mean 'orders'?");
    says("[expect.ladder.u_LinfH2]\norders = [3.9, 4.1]\n",
         "expect.ladder.u_LinfH2 expects something of what the study does not measure");
    says("[expect.orders.theta_L2L2]\np = [1, 2]\n", "it has no block [orders] with norms");
    says("[expect.ladder.theta_L2L2_sq]\nratios = [[0.9, 1.1], [0.9, 1.1], [0.9, 1.1]]\n",
         "has 3 bands for 2 levels");
    const std::string ladder = "[expect.ladder.theta_L2L2_sq]\n";
    for (const std::string within : {"2", "0.51", "0", "-1", "nan", "inf"})
        says(ladder + "errors = [1, 2]\nwithin = " + within + "\n",
             ":17:10: expect.ladder.theta_L2L2_sq.within is " + within + "; it must be ");
    says(ladder + "orders = [3.9, 4.1]\nwithin = 1e-3\n",
         ":17:10: expect.ladder.theta_L2L2_sq.within");
    says(ladder + "errors = [1e-3, -1e-5]\n",
         ":16:17: expect.ladder.theta_L2L2_sq.errors holds -1e-05");
    says(ladder + "verdicts = [\"asymptotic\"]\n", "has 1 value for 2 rungs");
    says(ladder + "verdicts = [\"asymptotic\", \"asymtotic\"]\n",
         ":16:27: expect.ladder.theta_L2L2_sq.verdicts holds 'asymtotic', which is no verdict; did "
         "you mean 'asymptotic'?");
    says("[expect.reference]\nlevels = [1, 2]\n", "which the scene does not have");
}

BOOST_AUTO_TEST_CASE(a_table_that_expects_nothing_is_refused_at_its_place) {
    for (const std::string table :
         {"[expect]", "[expect.ladder]", "[expect.ladder.theta_L2L2_sq]"}) {
        const std::string message = message_of(table + "\n");
        const std::string name = table.substr(1, table.size() - 2);
        BOOST_TEST(message.find("s.toml:15:1: " + name + " expects nothing") != std::string::npos,
                   message);
    }
    // On the command line it takes away what the file expects.
    BOOST_TEST(
        checked("[expect.ladder.theta_L2L2_sq]\norders = [3.9, 4.1]\n", {"expect={}"}).empty());
}

BOOST_AUTO_TEST_CASE(what_the_toolkit_says_is_expected_word_by_word) {
    // Two rows show one order, which nothing confirms; nothing is left out.
    const std::string two = "[expect.ladder.theta_L2L2_sq]\nverdicts = ";
    BOOST_TEST(violations(checked(two + "[\"pre-asymptotic\", \"pre-asymptotic\"]\n")) == 0u);
    const auto other = checked(two + "[\"pre-asymptotic\", \"asymptotic\"]\n");
    BOOST_REQUIRE(other.size() == 1u);
    BOOST_TEST(!other[0].holds);
    BOOST_TEST(other[0].what == "ladder.theta_L2L2_sq: verdicts");
    BOOST_TEST(other[0].expected == "pre-asymptotic, asymptotic");
    BOOST_TEST(other[0].found == "pre-asymptotic, pre-asymptotic");
    const std::string left_out = "[expect]\nleft_out = ";
    BOOST_TEST(violations(checked(left_out + "[]\n")) == 0u);
    BOOST_TEST(violations(checked(left_out + "[\"contact\"]\n")) == 1u);
    BOOST_TEST(
        violations(checked(left_out + "[\"coupling\", \"deflection\"]\n", {"beam.alpha=0"})) == 0u);
}

BOOST_AUTO_TEST_CASE(intervals_are_expected_to_be_determined_to_hold_and_to_be_narrow) {
    const std::string grid =
        "[orders]\nfinal_time = 1\nelements = [4, 8, 16, 32]\ndt = [0.1, 0.05, 0.025, 0.0125]\n"
        "norms = [\"theta_L2L2\"]\n[expect.orders.theta_L2L2]\n";
    BOOST_TEST(violations(checked(grid + "p_determined = true\np_holds = 2\nq_holds = 1\n"
                                         "p_half_width = [0, 0.3]\n")) == 0u);
    BOOST_TEST(violations(checked(grid + "p_determined = false\n")) == 1u);
    BOOST_TEST(violations(checked(grid + "p_holds = 1\nq_holds = 2\n"
                                         "p_half_width = [0, 1e-3]\n")) == 3u);
    // Of an order that shall not be determined nothing else can be expected.
    for (const std::string beside : {"p_holds = 2\n", "p_half_width = [0, 1]\n"})
        BOOST_CHECK_THROW(checked(grid + "p_determined = false\n" + beside), InputError);
    // An order that is not determined holds nothing and has no width, however wide the band.
    const std::string hidden =
        "[orders]\nfinal_time = 1\nelements = [40, 60, 80, 120]\ndt = [0.25, 0.2, 0.125, 0.1]\n"
        "norms = [\"u_LinfH2semi\"]\n[expect.orders.u_LinfH2semi]\n";
    BOOST_TEST(violations(checked(hidden + "p_determined = false\n")) == 0u);
    const auto all = checked(hidden + "p_holds = 2\np_half_width = [0, 1e9]\n");
    BOOST_REQUIRE(all.size() == 2u);
    BOOST_TEST(!all[0].holds);
    BOOST_TEST(!all[1].holds);
    BOOST_TEST(all[1].found.starts_with("not determined: hidden"), all[1].found);
}

BOOST_AUTO_TEST_CASE(what_refining_came_to_and_what_is_said_of_a_program_is_expected) {
    // An error h² and a value 1 + h²: known with the fourth level; Richardson's limit of the three
    // finest values is 1, and Roache's index 1.25 (f_2 − f_1)/3 = 1.25/64 = 0.0195.
    const auto of = [](const std::string& expect) {
        const TemporaryDirectory directory;
        const std::string file = directory.write("s.toml", R"([solver]
command = ["awk", "-v", "h={h}", 'BEGIN { print "L2 = " h^2; printf "drag = %.17g\n", 1 + h^2 }']
errors  = { L2 = 'L2 = (\S+)' }
values  = { drag = 'drag = (\S+)' }
[ladder]
elements = [1, 2, 4]
norms    = ["L2"]
values   = ["drag"]
until    = { order = 0.05, levels = 6 }
)" + expect);
        return violations(check(run_study(read_scene(file, {}, {.expectations = true}))));
    };
    BOOST_TEST(of("[expect.ladder]\nended_by = [\"known\"]\nopen = []\n"
                  "elements = [1, 2, 4, 8]\n") == 0u);
    BOOST_TEST(of("[expect.ladder]\nended_by = [\"levels\"]\nopen = [\"L2\"]\n"
                  "elements = [1, 2, 4]\n") == 3u);
    const std::string said = "[expect.ladder.L2]\nremarks = ";
    BOOST_TEST(of(said + "[\"L2: order 2.00 up to s = 8.\", \"L2: order 2.0\"]\n") == 0u);
    BOOST_TEST(of(said + "[\"L2: order 2.00 up to s = 4.\"]\n") == 1u);
    const std::string value = "[expect.ladder.drag]\n";
    BOOST_TEST(of(value +
                  "order_holds = 2\ngci = { limit = [0.999, 1.001], order = [1.999, 2.001], "
                  "uncertainty = [0.0195, 0.0196] }\n"
                  "celik.order = [1.999, 2.001]\n"
                  "eca_hoekstra.limit = [0.999, 1.001]\n") == 0u);
    BOOST_TEST(of(value + "order_holds = 1\ngci = { limit = [1.001, 1.002], order = [1, 1.9], "
                          "uncertainty = [0.0196, 0.02] }\n"
                          "celik.order = [1, 1.9]\n"
                          "eca_hoekstra.limit = [1.001, 1.002]\n") == 6u);
}

BOOST_AUTO_TEST_CASE(the_runs_that_a_fit_leaves_out_are_expected_with_their_reasons) {
    // e = h² + Δt, but for one run, which has three times as much: its ln e is off by ln 3.
    const auto of = [](const std::string& expect) {
        const TemporaryDirectory directory;
        const std::string file = directory.write("s.toml", R"([solver]
command = ["awk", "-v", "h={h}", "-v", "dt={dt}", "-v", "level={level}",
           'BEGIN { print "L2 = " (level == 5 ? 3 : 1) * (h^2 + dt) }']
errors  = { L2 = 'L2 = (\S+)' }
[orders]
final_time = 1.0
elements   = [4, 8, 16, 32]
dt         = [0.1, 0.05, 0.025, 0.0125]
norms      = ["L2"]
[expect.orders.L2]
)" + expect);
        return violations(check(run_study(read_scene(file, {}, {.expectations = true}))));
    };
    BOOST_TEST(of("left_out = [\"s = 8, dt = 0.05: out of line with its neighbours: the error is 3 "
                  "times the model's\"]\n") == 0u);
    BOOST_TEST(of("left_out = []\n") == 1u);
}

BOOST_AUTO_TEST_CASE(the_schedule_of_a_reference_is_expected_number_by_number) {
    // Extrapolated from (h, Δt), (2h, Δt) and (h, 2Δt); known at the ends of the steps of both
    // rungs: the multiples of 0.05, which those of 0.1 are among.
    const auto of = [](const std::string& expect) {
        return checked("[reference]\nelements = 40\ndt = 0.0125\nrichardson = true\n"
                       "[expect.reference]\n" +
                           expect,
                       {"ladder.dt=[0.1, 0.05]", "ladder.final_time=1"});
    };
    BOOST_TEST(violations(of("elements = [40, 20, 40]\ndt = [0.0125, 0.0125, 0.025]\n"
                             "times = [0.05, 1]\nlevels = [19.5, 20.5]\n")) == 0u);
    BOOST_TEST(violations(of("elements = [40, 40, 20]\ndt = [0.0125, 0.025, 0.0125]\n"
                             "times = [0.1, 1]\nlevels = [39.5, 40.5]\n")) == 4u);
}

BOOST_AUTO_TEST_CASE(the_events_of_an_evolution_are_expected_in_their_order) {
    // From t = sqrt(2) on the tip is on g2.
    const auto of = [](const std::string& events) {
        return violations(checked("[evolution]\nfinal_time = 2\nelements = 10\ndt = 0.01\n"
                                  "probes = [\"u@1\"]\n[expect.evolution]\nevents = " +
                                  events + "\n"));
    };
    BOOST_TEST(of("[\"onset g2\"]") == 0u);
    for (const std::string wrong :
         {"[]", "[\"onset g1\"]", "[\"release g2\"]", "[\"onset g2\", \"release g2\"]"})
        BOOST_TEST(of(wrong) == 1u, wrong);
}

BOOST_AUTO_TEST_CASE(a_prediction_is_expected_in_its_interval) {
    const std::string grid =
        "[orders]\nfinal_time = 2\nelements = [10, 20, 40, 80]\ndt = [0.1, 0.05, 0.025, 0.0125]\n"
        "norms = [\"theta_L2L2\"]\n[expect.ladder.theta_L2L2_sq]\npredicted_place = ";
    BOOST_TEST(violations(checked(grid + "[0, 1]\n")) == 0u);
    BOOST_TEST(violations(checked(grid + "[1.0, 2.0]\n")) == 2u);
}

BOOST_AUTO_TEST_CASE(the_short_form_replaces_what_its_block_names_and_nothing_else) {
    const TemporaryDirectory directory;
    const std::string file =
        directory.write("s.toml", head + "[short.ladder]\nelements = [5, 10]\n");
    BOOST_TEST(read_scene(file).get<LadderBlock>()->rungs[0].elements == 10);
    const Scene shortened = read_scene(file, {}, {.short_form = true});
    BOOST_TEST(shortened.get<LadderBlock>()->rungs[0].elements == 5);
    BOOST_TEST(shortened.get<LadderBlock>()->final_time == 2.0);
    BOOST_TEST(shortened.get<LadderBlock>()->norms.size() == 1u);
    BOOST_TEST(read_scene(file, {"ladder.elements=[7,8]"}, {.short_form = true})
                   .get<LadderBlock>()
                   ->rungs[0]
                   .elements == 7);
    // A key of the block itself, too; it changes nothing where the block is not read.
    const std::vector<std::string> of_short{"short.ladder.elements=[3,6]"};
    BOOST_TEST(
        read_scene(file, of_short, {.short_form = true}).get<LadderBlock>()->rungs[0].elements ==
        3);
    BOOST_TEST(read_scene(file, of_short).get<LadderBlock>()->rungs[0].elements == 10);
}

BOOST_AUTO_TEST_CASE(what_is_said_of_anybody_s_data_is_expected_as_of_scenes) {
    // Errors h², and values 1 + h²: Richardson's limit of the three finest is 1, and Roache's index
    // 1.25 (f_1/4 − f_1/8)/3 = 1.25/64 = 0.0195.
    const TemporaryDirectory directory;
    const std::string file = directory.write(
        "d.csv",
        "h,error,value\n1,1,2\n0.5,0.25,1.25\n0.25,0.0625,1.0625\n0.125,0.015625,1.015625\n");
    const auto of = [&](const std::string& text) {
        return check(analyse(read_data(file, {.errors = {"error"}, .values = {"value"}})), text);
    };
    BOOST_TEST(
        violations(of("error.verdicts = [\"asymptotic\", \"asymptotic\", \"asymptotic\", "
                      "\"asymptotic\"]\nerror.order_holds = 2\nerror.order_determined = true\n"
                      "value.order_half_width = [0, 0.2]\nvalue.limit_holds = 1\n"
                      "value.gci = { limit = [0.999, 1.001], order = [1.999, 2.001], "
                      "uncertainty = [0.0195, 0.0196] }\n")) == 0u);
    BOOST_TEST(violations(of("error.verdicts = [\"asymptotic\", \"floor\", \"asymptotic\", "
                             "\"asymptotic\"]\nerror.order_holds = 1\n"
                             "value.order_half_width = [1, 2]\nvalue.limit_holds = 1.1\n"
                             "value.gci = { limit = [1.001, 1.1], order = [1.9, 1.99], "
                             "uncertainty = [0.01, 0.019] }\n")) == 7u);
    BOOST_TEST(violations(of("error.order_determined = false\n")) == 1u);
    for (const std::string nothing : {"[error]", "error.within = 1e-3", "value = {}"})
        BOOST_CHECK_THROW(of(nothing + "\n"), InputError);
}

BOOST_AUTO_TEST_SUITE_END()

// Expectations: two-sided, met by the right result, and by no other.

#include "studies/gates/check.hpp"
#include "mms/text/input_error.hpp"
#include "studies/ladder/ladder.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>

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
                "errors = [1.2e-3, 7.7e-5]\nwithin = 0.9\n",
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
    says("[expect.ladder.theta_L2L2_sq]\nerrors = [1e-3]\n", "has 1 values for 2 rungs");
    says("[expect.ladder.theta_L2L2_sq]\norder = [3.9, 4.1]\n", "did you mean 'orders'?");
    says("[expect.ladder.u_LinfH2]\norders = [3.9, 4.1]\n", "unknown key 'expect.ladder.u_LinfH2'");
    says("[expect.orders.theta_L2L2]\np = [1, 2]\n", "it has no block [orders] with norms");
    says("[expect.ladder.theta_L2L2_sq]\nratios = [[0.9, 1.1], [0.9, 1.1], [0.9, 1.1]]\n",
         "has 3 bands for 2 levels");
    says("[expect.ladder.theta_L2L2_sq]\nerrors = [1, 2]\nwithin = 2\n", "between 0 and 1");
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
}

BOOST_AUTO_TEST_SUITE_END()

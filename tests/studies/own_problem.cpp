// Studies of a problem that the caller brings: as of the scene's own.

#include "mms/autodiff_problem.hpp"
#include "studies/gates/check.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/runs/beam_runs.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <string>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(own_problem)

namespace {

const std::string beam = R"([beam]
alpha = 0.5
zeta  = 0.1
stops = [-0.02, 0.1]
)";

const std::string studies = R"(
[scheme]
time = "sdirk2"

[ladder]
final_time = 1.0
elements   = [4, 8, 16]
dt         = "0.5/s"
norms      = ["theta_L2L2", "u_LinfH2semi_sq"]

[orders]
final_time = 1.0
elements   = [4, 8, 12]
dt         = [0.1, 0.05, 0.025]
norms      = ["theta_L2L2"]

[expect.ladder.theta_L2L2]
orders = [1.95, 2.05]

[expect.ladder.u_LinfH2semi_sq]
orders = [3.9, 4.1]

[expect.orders.theta_L2L2]
p = [1.9, 2.1]
)";

const std::string text = R"toml(
theta = "cos(t)*sin(pi*x)"
u     = "g2*x^2*(3 - x)*sin(t)/2"
)toml";

/// The same.
struct OwnSolution {
    double g2;

    template <typename Real>
    Real theta(const Real& x, const Real& t) const {
        return cos(t) * sin(std::numbers::pi * x);
    }
    template <typename Real>
    Real u(const Real& x, const Real& t) const {
        return g2 * x * x * (3.0 - x) * sin(t) / 2.0;
    }
};

Scene own_scene(const std::string& document, bool own_problem = true) {
    const TemporaryDirectory directory;
    directory.write("text.toml", text);
    return read_scene(directory.write("scene.toml", document), {},
                      {.expectations = true, .own_problem = own_problem});
}

/// The message without the directory that the file stood in.
template <typename Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const InputError& error) {
        const std::string what = error.what();
        const auto at = what.find("scene.toml");
        return at == std::string::npos ? what : what.substr(at);
    }
    return "accepted";
}

} // namespace

BOOST_AUTO_TEST_CASE(every_study_of_it_is_that_of_the_same_solution_as_text) {
    const Scene scene = own_scene(beam + studies);
    const ProblemData data = autodiff_problem(OwnSolution{0.1}, scene.beam, 1.0);
    const StudyResult own = run_study(scene, data, {.jobs = 2});
    const StudyResult shared =
        run_study(own_scene("solution = \"./text.toml\"\n" + beam + studies, false));
    for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t i = 0; i < 3; ++i) {
            BOOST_TEST(own.get<LadderResult>()->rungs[i].errors.at(k) ==
                           shared.get<LadderResult>()->rungs[i].errors.at(k),
                       boost::test_tools::tolerance(1e-10));
            BOOST_TEST((own.get<LadderResult>()->norms[k].verdicts[i].verdict ==
                        shared.get<LadderResult>()->norms[k].verdicts[i].verdict));
            if (i > 0)
                BOOST_TEST(*own.get<LadderResult>()->norms[k].orders[i] ==
                               *shared.get<LadderResult>()->norms[k].orders[i],
                           boost::test_tools::tolerance(1e-9));
        }
    BOOST_TEST(own.get<OrdersResult>()->norms[0].fit.model.p ==
                   shared.get<OrdersResult>()->norms[0].fit.model.p,
               boost::test_tools::tolerance(1e-6));
    const auto checked = check(own);
    BOOST_TEST(checked.size() == 2U + 2U + 1U);
    for (const auto& expectation : checked)
        BOOST_TEST(expectation.holds, expectation.what << ": " << expectation.found);
}

// The errors are of the problem and not of the scene alone: with sources of another beam they do
// not converge.
BOOST_AUTO_TEST_CASE(a_problem_of_another_beam_does_not_meet_the_expectations) {
    const Scene scene = own_scene(beam + studies);
    Beam other = scene.beam;
    other.alpha = 0.6;
    const auto checked = check(run_study(scene, autodiff_problem(OwnSolution{0.1}, other, 1.0)));
    for (const auto& expectation : checked)
        BOOST_TEST(!expectation.holds, expectation.what << ": " << expectation.found);
}

BOOST_AUTO_TEST_CASE(a_scene_has_one_problem_and_says_when_it_has_none_or_two) {
    BOOST_TEST(message_of([] { own_scene(beam + studies); }) == "accepted");
    BOOST_TEST(message_of([] {
                   own_scene(beam + studies, false);
               }).find("neither a solution nor a [data] block") != std::string::npos);
    BOOST_TEST(message_of([] {
                   own_scene("solution = \"./text.toml\"\n" + beam + studies);
               }).find("scene.toml:1:12: the program that reads the scene brings its problem") ==
               0U);
    BOOST_TEST(message_of([] {
                   own_scene("[data]\n" + beam + studies);
               }).find("scene.toml:1:1: the program that reads the scene brings its problem") ==
               0U);
    BOOST_TEST(message_of([] { run_study(own_scene(beam + studies)); }) ==
               "scene.toml: the scene has no problem of its own; run it on one");
}

BOOST_AUTO_TEST_CASE(a_scene_put_together_in_code_is_checked_before_it_is_run) {
    Scene scene;
    scene.beam = {.alpha = 0.5, .zeta = 0.1, .stops = {-0.02, 0.1}};
    scene.scheme.time = TimeScheme::named("bdf2");
    scene.blocks.set(LadderBlock{.final_time = 1.0,
                                 .rungs = {{4, 8, 1.0 / 8}, {8, 16, 1.0 / 16}, {16, 32, 1.0 / 32}},
                                 .norms = {measure_of(*Norm::named("theta_L2L2"))},
                                 .printed = {}});
    const ProblemData data = autodiff_problem(OwnSolution{0.1}, scene.beam, 1.0);
    const StudyResult result = run_study(scene, data);
    BOOST_TEST(std::abs(*result.get<LadderResult>()->norms[0].orders[2] - 2.0) <= 0.05);

    ProblemData without = data;
    without.exact.reset();
    BOOST_TEST(message_of([&] {
                   run_study(scene, without);
               }).find("the problem has no exact solution") != std::string::npos);
    scene.get<LadderBlock>()->rungs[1].dt = 0.1;
    BOOST_TEST(message_of([&] { run_study(scene, data); }) ==
               "a run has 8 elements and 16 steps of 0.1; they must fill the final time 1");
    scene.get<LadderBlock>()->rungs[1] = {0, 16, 1.0 / 16};
    BOOST_TEST(message_of([&] { run_study(scene, data); }).find("a run has 0 elements") == 0U);
}

BOOST_AUTO_TEST_SUITE_END()

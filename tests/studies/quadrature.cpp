// A ladder over what quadrature resolves, and over what it does not.

#include "mms/manufactured_problem.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/runs/run.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(quadrature)

namespace {

/// The ladder of θ(x, t) on [0, 1], with u = 0.
LadderResult ladder_of(const std::string& theta) {
    const TemporaryDirectory directory;
    directory.write("mine.toml", "theta = \"" + theta + "\"\nu = \"0\"\n");
    const auto scene = read_scene(directory.write("scene.toml", R"(
solution = "./mine.toml"
[beam]
alpha = 0.3
zeta = 0.1
[scheme]
time = "bdf2"
[ladder]
final_time = 1.0
elements = [8, 16, 32]
dt = "0.1/s"
norms = ["theta_L2L2", "theta_LinfL2_sq"]
)"));
    return *run_study(scene).get<LadderResult>();
}

bool says(const LadderNorm& norm, Verdict verdict) {
    return std::any_of(norm.verdicts.begin(), norm.verdicts.end(),
                       [&](const RowVerdict& row) { return row.verdict == verdict; });
}

} // namespace

BOOST_AUTO_TEST_CASE(a_spike_between_the_points_is_not_taken_for_nothing) {
    // ‖θ‖ of the spike is (1/5) sin(0.337 π) (10⁻⁴ √(π/2))^½ e^−t = 1.9e-3 e^−t. Half an element
    // and more away from it the discrete function cannot follow: most of the norm is left as an
    // error.
    const LadderResult ladder =
        ladder_of("(exp(-((x - 0.337)/1e-4)^2)/5 + 1e-4)*sin(pi*x)*exp(-t)");
    for (const auto& rung : ladder.rungs) {
        BOOST_REQUIRE_EQUAL(rung.reason, "");
        BOOST_TEST(rung.errors[0] > 1e-3);
        BOOST_TEST(rung.uncertainties.empty());
    }
    for (const auto& norm : ladder.norms)
        BOOST_TEST(!says(norm, Verdict::asymptotic));
    BOOST_TEST(ladder.quadrature_remark == "");
}

BOOST_AUTO_TEST_CASE(what_quadrature_does_not_resolve_is_said_and_nowhere_asymptotic) {
    const LadderResult ladder = ladder_of("exp(-((x - 0.2 - t/2)*3e4)^2)*x*(1 - x)*exp(-t)");
    for (const auto& rung : ladder.rungs) {
        BOOST_REQUIRE_EQUAL(rung.reason, "");
        BOOST_REQUIRE(rung.uncertainties.size() == 2);
        for (const double part : rung.uncertainties)
            BOOST_TEST(part > 0.01);
    }
    for (const auto& norm : ladder.norms)
        for (const auto& row : norm.verdicts)
            BOOST_TEST((row.verdict == Verdict::unresolved), row.reason);
    BOOST_TEST(ladder.quadrature_remark.find("s = 8: theta_L") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(every_norm_keeps_its_own_uncertainty) {
    RungResult rung;
    rung.rung = {.elements = 8, .steps = 10, .dt = 0.1};
    rung.errors = {0.5, 0.25};
    rung.uncertainties = {0.0, 0.125};
    BOOST_TEST(records_of({rung}, 0).front().uncertainty == 0.0);
    BOOST_TEST(records_of({rung}, 1).front().uncertainty == 0.125);
    BOOST_TEST(records_of({rung}, 1).front().error == 0.25);
}

BOOST_AUTO_TEST_SUITE_END()

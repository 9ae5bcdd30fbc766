// [[expect.refused]]: a change with which the scene must be refused, before anything runs, in the
// words that it says.

#include "mms/text/input_error.hpp"
#include "studies/gates/check.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <ostream>
#include <string>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(refused_expectations)

namespace {

const std::string scene = "solution = 'free-oscillation'\n[beam]\nalpha = 0.3\nzeta = 0.05\n"
                          "stops = [-0.1, 0.1]\n[ladder]\nfinal_time = 1.0\nelements = [5]\n"
                          "dt = [0.1]\nnorms = ['theta_L2L2']\n[[expect.refused]]\n";

std::vector<CheckedExpectation> checked(const std::string& lines,
                                        const std::vector<std::string>& overrides = {}) {
    const TemporaryDirectory directory;
    const auto file = directory.write("s.toml", scene + lines);
    return check(run_study(read_scene(file, overrides, {.expectations = true})));
}

struct Claim {
    std::string lines;
    std::string found; ///< in place of what is expected; empty: it holds
};

std::ostream& operator<<(std::ostream& stream, const Claim& claim) {
    return stream << claim.lines;
}

const std::vector<Claim> claims{
    // By the reader of the scene, of a solution that is no solution, by the problem, by the work
    // that it asks for.
    {"set = ['beam.zeta=-1']\nsays = ['beam.zeta is -1']", ""},
    {"set = ['beam.zeta=-1']\nsays = ['beam.zeta is -2']", "beam.zeta is -1; it must be >= 0"},
    {"set = ['beam.zeta=-1']\nsays = ['beam.zeta', 'it must be >= 0']", ""},
    {"set = ['ladder.dt=[0.3]']\nsays = ['it must divide']", ""},
    {"set = ['beam.alpha=0.4']\nsays = ['beam.alpha']", "it is not refused"},
    {"solution = \"theta = 'sin(pi*x)'\\nu = 'x^2*y'\"\nsays = ['solution:2:10: unknown symbol']",
     ""},
    {"solution = \"theta = 'sin(pi*x)'\\nu = 'x/100'\"\nsays = ['(5): u_x(0,t) is 0.01']", ""},
    {"solution = \"theta = 'sin(pi*x)'\\nu = 'x^2/100'\"\nsays = ['(5)']", "it is not refused"},
    // g2 = 0.1 is above x²t/100 up to the final time, 1; g2 = 0.005 is not.
    {"set = ['beam.stops=[-0.1, 0.005]']\nsolution = \"theta = '0'\\nu = 'x^2*t/100'\"\n"
     "says = ['(6): u(1,t)', 'at most g2 = 0.005']",
     ""},
    {"set = ['ladder.elements=[10000000]', 'ladder.dt=[1e-9]']\nsays = ['long = true']", ""},
    // By a run: α²Δt/((Δt + ζ)(1 + λ₁Δt)) is 6.25/(6·11) = 0.0947 for α = 2.5, Δt = 1 and ζ = 5,
    // and
    // 2.5²·0.1/(0.1·2) = 3.1 with Δt = 0.1 and ζ = 0; λ₁ ≈ 10.
    {"set = ['beam.alpha=2.5', 'beam.zeta=0', 'scheme.algorithm=fixed-point']\n"
     "says = ['would not contract']",
     ""},
    {"set = ['beam.alpha=2.5', 'beam.zeta=5', 'ladder.dt=[1]', 'scheme.algorithm=fixed-point']\n"
     "says = ['would not contract']",
     "it is not refused"},
    // What is wrong may be an expectation; those of the scene itself are not read again.
    {"set = ['expect.ladder.theta_L2L2.orders=[2, 1]']\nsays = ['lowest value is not below']", ""},
    {"set = ['expect.ladder.u_L2H2.orders=[1, 2]']\nsays = ['it measures theta_L2L2']", ""},
    // Or what it comes to: a single level has no order, and its error is not 1 but below.
    {"set = ['expect.ladder.theta_L2L2.orders=[1, 2]']\nsays = ['a ladder of one rung']", ""},
    {"set = ['expect.ladder.theta_L2L2.errors=[1]']\nsays = ['expected 0.999 to 1.001, found']",
     ""},
    {"set = ['expect={ladder={theta_L2L2={errors=[1]}}}']\nsays = ['expected 0.999']", ""},
    {"set = ['expect.law_distance=[0, 1]']\nsays = ['there are no stops that yield']", ""},
    {"set = ['expect.derive.theta_L2L2.h=2']\nsays = ['expected']", "it is not refused"},
};

} // namespace

BOOST_DATA_TEST_CASE(a_refusal_is_expected_in_its_words, data::make(claims)) {
    std::size_t violated = 0;
    for (const auto& one : checked(sample.lines)) {
        BOOST_TEST(one.place.line > 0);
        if (one.holds)
            continue;
        ++violated;
        BOOST_TEST(!sample.found.empty(), one.found);
        BOOST_TEST(one.found.find(sample.found) != std::string::npos, one.found);
    }
    BOOST_TEST(violated == (sample.found.empty() ? 0U : 1U));
}

// What the caller sets stays: with a stop further away the tip is admissible.
BOOST_AUTO_TEST_CASE(what_is_overridden_is_overridden_in_what_is_refused) {
    const std::string lines =
        "solution = \"theta = '0'\\nu = 'x^2*t/5'\"\nsays = ['(6): u(1,t)']\n";
    BOOST_TEST(checked(lines).front().holds);
    const auto apart = checked(lines, {"beam.stops=[-1, 1]"});
    BOOST_TEST(!apart.front().holds);
    BOOST_TEST(apart.front().found == "it is not refused");
}

// What takes longer than a moment is not run to see whether it fails, whatever the change permits.
BOOST_AUTO_TEST_CASE(a_change_that_asks_for_much_is_not_run) {
    for (const std::string permission : {"", "'long=true', "}) {
        const auto one = checked("set = [" + permission +
                                 "'ladder.elements=[100000]', 'ladder.dt=[0.000001]']\n"
                                 "says = ['x']")
                             .front();
        BOOST_TEST(!one.holds);
        BOOST_TEST(one.found.find("too long to see whether a run fails") != std::string::npos,
                   one.found);
    }
}

// Without its expectations a scene has nothing to judge, and is no worse for that.
BOOST_AUTO_TEST_CASE(a_change_of_a_scene_with_a_sensitivity_is_judged_by_itself) {
    const TemporaryDirectory directory;
    const auto outcome = [&](const std::string& change) {
        const auto file = directory.write(
            "s.toml", scene + change +
                          "\n[expect.ladder.theta_L2L2]\nerrors = [1]\nwithin = 0.5\n"
                          "[sensitivity]\nrange = [1, 10]\n"
                          "[sensitivity.defect.warmer]\nheat_source = '1'\n");
        const Scene read = read_scene(file, {}, {.expectations = true});
        return check(run_study(read)).front();
    };
    BOOST_TEST(outcome("set = ['beam.alpha=0.2']\nsays = ['expects nothing']").found ==
               "it is not refused");
    BOOST_TEST(outcome("set = ['beam.zeta=-1']\nsays = ['must be >= 0']").holds);
}

BOOST_AUTO_TEST_CASE(a_refusal_that_changes_or_says_nothing_is_refused) {
    const auto said = [](const std::string& lines, const std::string& part) {
        BOOST_CHECK_EXCEPTION(checked(lines), InputError, [&](const InputError& error) {
            BOOST_TEST_INFO(error.what());
            return std::string(error.what()).find(part) != std::string::npos;
        });
    };
    said("says = ['x']", "expect.refused.0 changes nothing");
    said("set = []\nsays = ['x']", "expect.refused.0 changes nothing");
    said("set = ['beam.zeta=-1']", "expect.refused.0.says must hold words");
    said("set = ['beam.zeta=-1']\nsays = []", "expect.refused.0.says must hold words");
    said("set = ['beam.zeta=-1']\nsays = ['zeta', '']", "expect.refused.0.says must hold words");
    said("set = ['beam.zeta=-1']\nsays = [' (:']", "expect.refused.0.says must hold words");
    said("set = ['beam.zeta=-1']\nsay = ['zeta']", "did you mean 'says'");
}

BOOST_AUTO_TEST_SUITE_END()

// How large a defect must be for each expectation to catch it.

#include "studies/sensitivity/sensitivity.hpp"

#include "mms/text/input_error.hpp"
#include "studies/gates/check.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <sstream>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(sensitivity)

namespace {

const std::string studies = R"(solution = "free-oscillation"
[beam]
alpha = 0.3
zeta = 0.05
stops = [-0.1, 0.1]
[ladder]
final_time = 0.5
elements = [4, 8, 16]
dt = [0.025, 0.0125, 0.00625]
norms = ["theta_L2L2", "u_LinfH2semi"]
[evolution]
final_time = 0.5
elements = 4
dt = 0.025
probes = ["u@1"]
)";

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const TemporaryDirectory directory;
    return read_scene(directory.write("s.toml", text), overrides, {.expectations = true});
}

/// Bands of 1 % about what the scene gives without defects; that of the orders is 0.02 wide.
std::string expectations(const std::vector<std::string>& overrides) {
    const StudyResult result = run_study(scene_of(studies, overrides));
    std::ostringstream text;
    text.precision(15);
    for (const auto& run : result.runs())
        for (std::size_t k = 0; k < run.series.measures.size(); ++k) {
            text << "[expect.ladder." << run.series.measures[k].name
                 << "]\nwithin = 0.01\nerrors = [";
            for (const auto& one : *run.results)
                text << one.errors[k] << ", ";
            text << "]\n";
            const auto orders = observed_orders(records_of(*run.results, k));
            text << "orders = [" << std::min(*orders[1], *orders[2]) - 0.02 << ", "
                 << std::max(*orders[1], *orders[2]) + 0.02 << "]\n";
        }
    const double greatest = result.figures("evolution").at("u@1.greatest");
    text << "[expect.evolution]\n'u@1.greatest' = [" << 0.99 * greatest << ", " << 1.01 * greatest
         << "]\n";
    return text.str();
}

struct Defect {
    std::string name, key, expression;
};
const std::vector<Defect> defects{{"zeta", "moment_load", "zeta*u_xxt"},
                                  {"late", "heat_source", "-dt*(theta_t - theta_xx)"},
                                  {"shifted", "heat_source", "h*theta_xx"},
                                  {"start", "u0", "u"}};

/// Whether an expectation holds with a defect in [defect].
bool holds(const std::string& text, const std::vector<std::string>& base, const Defect& defect,
           double factor, const std::string& expectation) {
    std::ostringstream added;
    added.precision(17);
    added << "defect." << defect.key << "='" << factor << "*(" << defect.expression << ")'";
    auto overrides = base;
    overrides.push_back(added.str());
    for (const auto& one : check(run_study(scene_of(text, overrides))))
        if (one.what.starts_with(expectation) && !one.holds)
            return false;
    return true;
}

} // namespace

// By its definition; also on top of a defect that the scene itself has.
BOOST_AUTO_TEST_CASE(the_least_factor_is_caught_and_one_that_is_less_is_not) {
    for (const auto& base :
         std::vector<std::vector<std::string>>{{}, {"defect.theta0='x*(1 - x)/10'"}}) {
        const std::string text = studies + expectations(base);
        std::string block = "[sensitivity]\nrange = [1e-5, 1]\n";
        for (const auto& defect : defects)
            block += "[sensitivity.defect." + defect.name + "]\n" + defect.key + " = '" +
                     defect.expression + "'\n";
        const StudyResult result = run_study(scene_of(text + block, base));
        const auto& record = *result.get<SensitivityResult>();
        BOOST_TEST(record.violated.empty());
        BOOST_TEST(record.expectations.size() == 5u);
        BOOST_REQUIRE(record.defects.size() == defects.size());
        std::size_t caught = 0;
        for (const auto& [name, least] : record.defects) {
            const auto& defect = *std::find_if(defects.begin(), defects.end(),
                                               [&](const Defect& one) { return one.name == name; });
            for (std::size_t i = 0; i < least.size(); ++i) {
                const auto& expectation = record.expectations[i];
                BOOST_TEST_INFO(name << ", " << expectation << ", " << base.size());
                if (!least[i]) {
                    BOOST_TEST(holds(text, base, defect, 1.0, expectation));
                    continue;
                }
                ++caught;
                BOOST_TEST(*least[i] > 1e-5);
                BOOST_TEST(!holds(text, base, defect, *least[i], expectation));
                BOOST_TEST(holds(text, base, defect, *least[i] / 1.05, expectation));
            }
        }
        BOOST_TEST(caught > 10u);
    }
}

// An expectation that is violated anyhow says nothing of a defect; metrics are those of gates.
BOOST_AUTO_TEST_CASE(what_is_violated_without_a_defect_is_named_and_left_out) {
    const std::string text = studies + expectations({}) +
                             "releases = [1, 2]\n[expect.sensitivity]\nstart = [1e-5, 1]\n"
                             "[sensitivity]\nrange = [1e-4, 0.1]\n"
                             "[sensitivity.defect.start]\nu0 = 'u'\n";
    const StudyResult result = run_study(scene_of(text));
    const auto& record = *result.get<SensitivityResult>();
    BOOST_TEST(record.violated == std::vector<std::string>{"evolution.releases"},
               boost::test_tools::per_element());
    BOOST_TEST(record.expectations.size() == 5u);
    const auto checked = check(result);
    const auto gate = std::find_if(checked.begin(), checked.end(),
                                   [](const auto& one) { return one.what == "sensitivity.start"; });
    BOOST_REQUIRE(gate != checked.end());
    BOOST_TEST(gate->holds, gate->found);
}

// The defect leaves the grid without a model, and with it the ratio to what the model predicts.
BOOST_AUTO_TEST_CASE(a_defect_that_leaves_no_model_is_caught_by_what_the_model_predicts) {
    const TemporaryDirectory directory;
    directory.write("f8-solution.toml", "theta = \"sin(pi*x)*exp(t)*cos(3*t) + x*(1-x)*sin(5*t)\"\n"
                                        "u = \"x^2*(sin(4*x)+ x^3)*cos(2*t)*0.001\"\n");
    const std::string norms = "norms = [\"theta_L2L2\"]\n";
    const Scene scene =
        read_scene(directory.write("f8.toml", "solution = \"./f8-solution.toml\"\n"
                                              "[beam]\nalpha = 0.7\nzeta = 0.3\n"
                                              "[orders]\nfinal_time = 1.0\n"
                                              "elements = [8, 16, 32, 64]\n"
                                              "dt = [0.1, 0.05, 0.025, 0.0125]\n" +
                                                  norms +
                                                  "[ladder]\nfinal_time = 1.0\n"
                                                  "elements = [8, 16, 32]\ndt = \"0.02/s\"\n" +
                                                  norms +
                                                  "[expect.ladder.theta_L2L2]\n"
                                                  "predicted = [0.8, 1.25]\n"
                                                  "predicted_place = [-9, 10]\n"
                                                  "[sensitivity]\nrange = [1e-3, 1]\n"
                                                  "[sensitivity.defect.a]\n"
                                                  "heat_source = \"theta_t\"\n"),
                   {}, {.expectations = true});
    const StudyResult result = run_study(scene);
    const auto& record = *result.get<SensitivityResult>();
    BOOST_TEST(record.violated.empty());
    BOOST_REQUIRE(record.expectations.size() == 2u);
    BOOST_REQUIRE(record.defects.size() == 1u);
    for (const auto& least : record.defects.front().least)
        BOOST_TEST((least && *least <= 1.0));
}

BOOST_AUTO_TEST_CASE(a_block_that_cannot_be_is_refused_at_its_place) {
    const auto refusal = [](const std::string& text) {
        try {
            run_study(scene_of(text));
        } catch (const InputError& error) {
            const std::string message = error.what();
            return message.substr(message.find("s.toml:"));
        }
        return std::string("accepted");
    };
    const std::string expect = "[expect.evolution]\nonsets = [-1, 1]\n";
    const auto begins = [&](const std::string& text, const std::string& start) {
        const std::string found = refusal(studies + text);
        BOOST_TEST(found.starts_with(start), found);
    };
    begins("[sensitivity.defect.a]\nu0 = 'u'\n", "s.toml:16:1: sensitivity asks what");
    begins(expect + "[sensitivity]\n", "s.toml:18:1: the block has no defect");
    begins(expect + "[sensitivity.defect.a]\n", "s.toml:18:1: a defect is empty");
    begins(expect + "[sensitivity]\nrange = [0, 1]\ndefect.a.u0 = 'u'\n",
           "s.toml:19:9: sensitivity.range must be");
    begins(expect + "[sensitivity]\nrange = [1e-8]\ndefect.a.u0 = 'u'\n",
           "s.toml:19:9: sensitivity.range must be a band [lowest, highest] of factors > 0");
    begins(expect + "[sensitivity.defect.a]\nu0 = 'u*y'\n", "s.toml:19:9: unknown symbol 'y'");
}

BOOST_AUTO_TEST_SUITE_END()

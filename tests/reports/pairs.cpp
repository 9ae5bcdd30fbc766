// Every pair of blocks in one scene runs and is reported, or is refused with a reason before
// anything runs.

#include "mms/text/input_error.hpp"
#include "reports/document/result_document.hpp"
#include "reports/document/text_document.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/gates/check.hpp"
#include "studies/ladder/ladder.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <ostream>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(pairs_of_blocks)

namespace {

/// A block, or a choice within one, as overrides of a scene.
struct Part {
    std::string name;
    std::vector<std::string> overrides;
};

std::ostream& operator<<(std::ostream& stream, const Part& part) {
    return stream << part.name;
}

const std::string ladder = "ladder={final_time=0.5, elements=[4, 8], dt=[0.05, 0.025], "
                           "norms=['theta_L2L2', 'u_LinfH2semi_sq', 'sigma_L2']}";

const std::vector<Part> parts{
    {"ladder", {ladder}},
    {"ladder without norms", {"ladder={final_time=0.5, elements=[4, 8], dt=[0.05, 0.025]}"}},
    {"printed", {"ladder.printed={theta_L2L2=[1e-2, 2e-3]}"}},
    {"orders",
     {"orders={final_time=1, elements=[2, 4, 8], dt=[0.1, 0.05, 0.025], "
      "norms=['theta_L2L2', 'corollary']}"}},
    {"work_precision",
     {"work_precision={final_time=0.5, norms=['u_L2H2'], runs=1, "
      "scheme=[{elements=[4, 8], dt=[0.05, 0.025]}, {time='bdf2', elements=[4], dt=[0.05]}]}"}},
    {"evolution",
     {"evolution={final_time=0.7625, elements=8, dt=0.0125, "
      "probes=['theta@0.5', 'u@1', 'stress', 'energy']}"}},
    {"stress", {"stress.sweep.a={alpha=[0.0, 1.0], elements=[2, 4], steps=3}"}},
    {"contraction",
     {"stress.contraction={alpha={from=0.1, to=10, count=2}, dt={from=1e-3, to=0.1, count=2}, "
      "elements=4}"}},
    {"roundoff", {"stress.roundoff={elements=[4, 8]}"}},
    {"reference", {"reference={elements=16, dt=0.0125}"}},
    {"reference that is a rung", {"reference={elements=8, dt=0.025}"}},
    {"richardson", {"reference={elements=16, dt=0.0125, richardson=true}"}},
    {"graded mesh", {"mesh.grading=1.5"}},
    {"mesh nodes", {"mesh.nodes=[0, 0.3, 1]"}},
    {"penalty", {"beam.contact={law='penalty', epsilon=1e-6}"}},
    {"no stops", {"beam.stops=[-inf, inf]"}},
    {"no coupling", {"beam.alpha=0"}},
    {"no viscosity", {"beam.zeta=0"}},
    {"end temperature", {"beam.theta_A=0.5"}},
    {"fixed point", {"scheme.algorithm=fixed-point"}},
    {"bdf2", {"scheme.time=bdf2"}},
    {"sdirk2", {"scheme.time=sdirk2"}},
    {"lumped", {"scheme.thermal_mass=lumped"}},
    {"nodal", {"scheme.basis=nodal"}},
    {"short", {"short={ladder={elements=[2, 4]}, orders={dt=[0.1, 0.05]}}"}},
    {"expect of a ladder", {"expect.ladder={theta_L2L2={orders=[0.1, 9], predicted=[0.1, 9]}}"}},
    {"expect of orders", {"expect.orders={theta_L2L2={p=[0.1, 9]}}"}},
    {"expect of an evolution", {"expect.evolution={onsets=[-1, 9], 'nothing'=[0, 1]}"}},
    {"expect of stress", {"expect.stress={failed=[-1, 1]}"}},
    {"report", {"report.files=['json']"}},
};

const std::string problems[] = {
    "solution = 'pressed-on-g1'\n[beam]\nalpha = 0.4\nzeta = 0.15\nstops = [-0.05, 0.1]\n",
    "[data]\ntheta0 = 'sin(pi*x)'\nu0 = '0.02*x^2*(3 - x)'\nbody_force = 'sin(9*t)'\n"
    "[beam]\nalpha = 0.4\nzeta = 0.15\nstops = [-0.05, 0.1]\n"};

/// "ran", or why it was refused.
std::string outcome_of(const std::string& problem, const std::vector<std::string>& overrides) {
    const TemporaryDirectory directory;
    try {
        const Scene scene = read_scene(
            directory.write("s.toml", problem), overrides,
            {.short_form = true, .expectations = true, .report_files = report_format_names()});
        const StudyResult result = run_study(scene);
        BOOST_TEST(!result.failed(), result.ending().reason);
        check(result);
        const Document document = result_document(result);
        BOOST_TEST(!text_document(document).empty());
        const auto plots = plots_of(result);
        const DrawnPlots none{std::vector<DrawnPlot>(plots.size()), "not drawn"};
        for (const auto& format : report_formats())
            format->write({result, document, plots, none});
        return "ran";
    } catch (const InputError& error) {
        const std::string reason = error.what();
        BOOST_TEST(reason.find('\n') == std::string::npos, reason);
        return reason;
    }
}

std::vector<std::string> together(std::vector<std::string> first,
                                  const std::vector<std::string>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

} // namespace

BOOST_DATA_TEST_CASE(runs_or_is_refused_before_anything_runs, data::make(parts), first) {
    for (const auto& problem : problems)
        for (const auto& second : parts) {
            const auto pair = together(first.overrides, second.overrides);
            BOOST_TEST_CONTEXT(second.name << ", " << problem.substr(0, 8)) {
                outcome_of(problem, together({ladder}, pair));
                if (!TVBEAM_SHORT_TESTS && first.name < second.name) // by themselves
                    outcome_of(problem, pair);
            }
        }
}

// What is not refused: otherwise the test above could be met by refusing everything.
BOOST_AUTO_TEST_CASE(a_reference_runs_beside_everything_that_measures_or_looks) {
    for (const std::string reference : {"reference", "reference that is a rung", "richardson"})
        for (const std::string beside :
             {"orders", "evolution", "stress", "contraction", "roundoff", "penalty", "no stops",
              "no coupling", "no viscosity", "fixed point", "bdf2", "sdirk2", "lumped", "nodal",
              "expect of a ladder", "report"})
            for (const auto& problem : problems) {
                // The solution presses on a stop.
                if (beside == "no stops" && &problem == &problems[0])
                    continue;
                const auto named = [](const std::string& name) {
                    return std::find_if(parts.begin(), parts.end(),
                                        [&](const Part& part) { return part.name == name; })
                        ->overrides;
                };
                const std::string outcome = outcome_of(
                    problem, together({ladder}, together(named(reference), named(beside))));
                BOOST_TEST(outcome == "ran", reference << " beside " << beside << ": " << outcome);
            }
}

BOOST_AUTO_TEST_SUITE_END()

// What is said of an evolution, alone and in a sweep.

#include "studies/evolution/evolution.hpp"
#include "reports/document/evolution_section.hpp"
#include "reports/document/text_document.hpp"
#include "reports/files/baseline.hpp"
#include "reports/sweep/sweep.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(evolution_report)

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The fixed point does not contract where zeta is 0.01 and nothing holds the tip.
const std::string fixed_point =
    "[data]\ntheta0 = 'sin(pi*x)'\nu0 = '0'\n[beam]\nalpha = 1.5\nzeta = 0.01\n"
    "stops = [-0.1, 0.1]\n[scheme]\nalgorithm = 'fixed-point'\n[evolution]\nfinal_time = 1\n"
    "elements = 8\ndt = 0.1\nprobes = ['u@1']\n";

} // namespace

BOOST_AUTO_TEST_CASE(that_a_tip_never_presses_is_not_said_of_one_that_does_in_a_stage) {
    const TemporaryDirectory directory;
    const auto said = [&](const std::string& stops) {
        const Scene scene = read_scene(directory.write(
            "scene.toml", "[data]\ntheta0 = '0'\nu0 = '0'\n"
                          "body_force = '-60*exp(-((t - 0.52929)/0.01)^2)'\n[beam]\nalpha = 0\n"
                          "zeta = 0.01\nstops = " +
                              stops +
                              "\n[scheme]\ntime = 'sdirk2'\n[evolution]\nfinal_time = 1\n"
                              "elements = 4\ndt = 0.1\nprobes = ['u@1']\n"));
        const StudyResult result = run_study(scene);
        Document document;
        document.sections = {evolution_section(*result.get<EvolutionResult>(), scene)};
        return text_document(document);
    };
    const std::string met = said("[-0.02, 0.1]");
    BOOST_TEST(has(met, "The tip presses on a stop within steps alone"), met);
    BOOST_TEST(!has(met, "never"), met);
    BOOST_TEST(has(said("[-20, 20]"), "The tip never presses on a stop."));
}

BOOST_AUTO_TEST_CASE(a_run_that_failed_has_no_figures_in_a_sweep_and_in_a_record) {
    const TemporaryDirectory directory;
    const std::string file = directory.write("scene.toml", fixed_point);
    const Sweep sweep{"beam.zeta", {"0.01", "0.1", "0.2"}, {}};
    std::vector<StudyResult> results;
    for (const auto& value : sweep.values)
        results.push_back(run_study(read_scene(file, {"beam.zeta=" + value})));
    BOOST_REQUIRE(results[0].failed());
    BOOST_REQUIRE(!results[1].failed());
    const Reported all = reported(sweep, results);
    const std::string text = text_document(all.document);
    BOOST_TEST(has(text, "0.01       failed failed   failed  failed"), text);
    const auto rows = nlohmann::json::parse(all.json()).at("rows");
    BOOST_TEST(rows.at(0).at("u@1.last").is_null());
    BOOST_TEST(rows.at(1).at("u@1.last").is_number());
    BOOST_TEST(has(sweep_csv(sweep, results), "\n0.01,nan,nan,nan,nan,"));
    for (const auto& plot : all.plots())
        for (const auto& block : plot.drawing.blocks())
            BOOST_TEST(!has(block.rows, "0.01 "), block.rows);
    const BaselineEntry recorded = baseline_entry(results[0]);
    BOOST_TEST(recorded.figures.contains("evolution.u@1.last"));
    for (const auto& [name, figure] : recorded.figures)
        BOOST_TEST(std::isnan(figure), name << " = " << figure);
}

BOOST_AUTO_TEST_SUITE_END()

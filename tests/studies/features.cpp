// Shipped scenes use, and expect something of, all that a scene can use.

#include "studies/gates/features.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(features)

namespace {

/// The names of those that no scene uses.
std::vector<std::string> unused(const std::vector<Feature>& features) {
    std::vector<std::string> names;
    for (const auto& feature : features)
        if (feature.scenes.empty())
            names.push_back(feature.name);
    return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

BOOST_AUTO_TEST_CASE(every_feature_and_every_pair_stands_in_a_scene_with_expectations) {
    const FeatureTable table = feature_table();
    for (const auto& name : unused(table.features))
        BOOST_ERROR("no scene with [expect] has the feature: " << name);
    for (const auto& name : unused(table.pairs))
        BOOST_ERROR("no run that [expect] looks at has both: " << name);
}

// Without the scenes that have them, features and pairs are missed: those of keys, words of
// choices, functions, norms, probes and runs.
BOOST_AUTO_TEST_CASE(what_no_scene_uses_is_told) {
    std::vector<ShippedFile> few;
    for (const auto& file : shipped_files(Shipped::scene))
        if (file.name == "table1" || file.name == "figure1")
            few.push_back(file);
    const FeatureTable table = feature_table(few);
    const auto features = unused(table.features);
    for (const std::string missed :
         {"key mesh", "key reference", "key scheme.time = bdf2", "formula atan",
          "formula x^n, n > 4", "norm sigma_L2", "probe of deflection between nodes", "mesh graded",
          "zeta zero", "contact by penalty", "march by the fixed point"})
        BOOST_TEST(has(features, missed), missed);
    for (const std::string used : {"key beam.stops", "formula sin", "norm theta_L2L2",
                                   "probe of tip", "march in sines", "contact with two stops"})
        BOOST_TEST(!has(features, used), used);
    const auto pairs = unused(table.pairs);
    BOOST_TEST(has(pairs, "time bdf2, mesh graded"));
    BOOST_TEST(has(pairs, "theta_A not zero, source that does not separate"));
    BOOST_TEST(!has(pairs, "time euler, contact with two stops"));
    BOOST_TEST(!has(pairs, "mesh graded, march in sines")); // which cannot be
}

// A norm of which only theory is expected is not one that a run measures.
BOOST_AUTO_TEST_CASE(what_is_derived_of_a_norm_does_not_stand_for_its_errors) {
    const TemporaryDirectory directory;
    const auto file = directory.write(
        "derived.toml", "solution = 'free-oscillation'\n[beam]\nalpha = 0.3\nzeta = 0.05\n"
                        "[ladder]\nfinal_time = 1\nelements = [4]\ndt = [0.5]\n"
                        "norms = ['u_L2H2', 'theta_L2L2']\n[expect.derive.u_L2H2]\nh = 2\n"
                        "[expect.ladder.theta_L2L2]\nerrors = [1.0]\n");
    const auto missed = unused(feature_table({{"derived", file}}).features);
    BOOST_TEST(has(missed, "norm u_L2H2"));
    BOOST_TEST(!has(missed, "norm theta_L2L2"));
    BOOST_TEST(!has(missed, "key expect.derive.NORM.h"));
}

// What a run consists of counts by the expectations of its own study.
BOOST_AUTO_TEST_CASE(a_run_in_time_counts_where_something_is_expected_of_it) {
    const auto shipped = shipped_files(Shipped::scene);
    const auto figure1 = std::find_if(shipped.begin(), shipped.end(),
                                      [](const auto& file) { return file.name == "figure1"; });
    BOOST_REQUIRE(figure1 != shipped.end());
    const std::string pair = "time euler, contact with two stops";
    BOOST_TEST(!has(unused(feature_table({*figure1}).pairs), pair));
    const TemporaryDirectory directory;
    const std::string text = directory.read(figure1->path.string()); // of an absolute path
    const auto without = directory.write("without.toml", text.substr(0, text.find("[expect.")));
    BOOST_TEST(has(unused(feature_table({{"without", without}}).pairs), pair));
}

BOOST_AUTO_TEST_SUITE_END()

// What differs between two results, and what is rounding alone.

#include "reports/files/compared_results.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(compared_results)

namespace {

/// How many numbers of an evolution differ where its tip was so far beyond a stop.
std::size_t differences(const std::string& result, double first, double second) {
    const TemporaryDirectory directory;
    const auto written = [&](const char* name, double beyond) {
        return directory.write(name, fmt::format(fmt::runtime(result), beyond));
    };
    return compare_results(written("a.json", first), written("b.json", second), 0.0).results.size();
}

} // namespace

// As check --baseline has it (held_values).
BOOST_AUTO_TEST_CASE(how_far_a_tip_is_beyond_a_rigid_stop_is_rounding) {
    const std::string evolution =
        R"({{"schema": "tvbeam-result/1", "evolution": {{"beyond_stops": {0},
        "events": [{{"kind": "onset", "beyond": {0}}}], "other_beyond": 1}}}})";
    const std::string sweep = R"({{"schema": "tvbeam-sweep/1", "key": "beam.alpha",
        "rows": [{{"value": 1, "beyond.1": {0}, "beyond_stops": {0}}}]}})";
    for (const auto& result : {evolution, sweep}) {
        BOOST_TEST(differences(result, 2.77556e-17, 6.93889e-17) == 0U);
        BOOST_TEST(differences(result, 2.77556e-17, 0.0) == 0U);
        BOOST_TEST(differences(result, 1e-17, 2e-14) == 2U);
        BOOST_TEST(differences(result, 0.01, 0.02) == 2U);
    }
    const std::string other =
        R"({{"schema": "tvbeam-result/1", "evolution": {{"beyond_all": {0}, "x": [{0}]}}}})";
    BOOST_TEST(differences(other, 2.77556e-17, 6.93889e-17) == 2U);
    const std::string error =
        R"({{"schema": "tvbeam-result/1", "ladder": {{"rungs": [{{"elements": 4,
        "errors": {{"beyond": {0}, "beyond_stops": {0}}}}}]}}}})";
    BOOST_TEST(differences(error, 4e-15, 8e-15) == 2U);
}

BOOST_AUTO_TEST_SUITE_END()

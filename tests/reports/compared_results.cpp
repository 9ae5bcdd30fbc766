// What differs between two results, and what is rounding alone.

#include "reports/files/compared_results.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>

#include <set>
#include <string>

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

// One that has more of them than the other differs in those alone.
BOOST_AUTO_TEST_CASE(rows_are_compared_by_widths_cases_by_parameters_and_evolutions_by_times) {
    const TemporaryDirectory directory;
    const auto differing = [&](const std::string& first, const std::string& second) {
        std::set<std::string> named;
        for (const auto& one :
             compare_results(directory.write("a.json", first), directory.write("b.json", second))
                 .results)
            named.insert(one.what.substr(0, one.what.rfind(':')));
        return named;
    };
    const auto table = [](const std::string& rows) {
        return R"({"schema": "tvbeam-analysis/1", "sizes": ["h", "dt"], "columns": [{"name": "e",
            "rows": [)" +
               rows + "]}]}";
    };
    const std::string coarse = R"({"h": 0.4, "dt": 0.1, "error": 3})";
    const std::string rows = R"({"h": 0.2, "dt": 0.1, "error": 2}, {"h": 0.2, "dt": 0.05,
        "error": 1})";
    using Names = std::set<std::string>;
    BOOST_TEST(differing(table(coarse + ", " + rows), table(rows)) ==
                   Names{R"(columns "e": rows "h = 0.4", dt = 0.1)"},
               boost::test_tools::per_element());
    const auto stress = [](const std::string& cases) {
        return R"({"schema": "tvbeam-result/1", "stress": {"cases": [)" + cases + "]}}";
    };
    const std::string weak = R"({"parameters": {"alpha": 0.1, "time": "euler"}, "path": 3})";
    const std::string strong = R"({"parameters": {"alpha": 10, "time": "euler"}, "path": 1})";
    BOOST_TEST(differing(stress(weak + ", " + strong), stress(strong)).size() == 1U);
    const auto evolution = [](const std::string& t, const std::string& values) {
        return R"({"schema": "tvbeam-result/1", "evolution": {"t": [)" + t +
               R"(], "probes": {"u@1": [)" + values + "]}}}";
    };
    BOOST_TEST(compare_results(directory.write("a.json", evolution("0, 0.1, 0.2", "1, 2, 3")),
                               directory.write("b.json", evolution("0, 0.2", "1, 3")))
                   .results.size() == 1U);
    // What is no list is none of its own, nor what holds nothing by a name.
    const std::string damaged =
        R"({"schema": "tvbeam-result/1", "stress": {"cases": [1, {"parameters": 2}]},
        "evolution": {"t": [0, 1], "probes": {"u@1": 3, "energy": [1]}, "exact": 4}})";
    BOOST_TEST(
        compare_results(directory.write("a.json", damaged), directory.write("b.json", damaged))
            .results.empty());
    BOOST_TEST(compare_results(directory.write("a.json", table("1")),
                               directory.write("b.json", R"({"schema": "tvbeam-result/1",
                                   "sizes": 1, "columns": {}, "stress": 1, "evolution": 2})"))
                   .results.size() > 0U);
}

BOOST_AUTO_TEST_SUITE_END()

// In files a figure stands under its own name: made-up ones, no two alike, are found there again.

#include "reports/document/orders_section.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study.hpp"
#include "studies/work_precision/work_precision.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(named_figures)

namespace {

StudyResult result_of(const std::string& blocks) {
    const TemporaryDirectory directory;
    return run_study(
        read_scene(directory.write("s.toml", "solution = 'free-oscillation'\n[beam]\nalpha = 0.3\n"
                                             "zeta = 0.05\n" +
                                                 blocks),
                   {}));
}

const std::string grid = "[orders]\nfinal_time = 0.5\nelements = [4, 8, 16]\n"
                         "dt = [0.1, 0.05, 0.025]\nnorms = ['theta_L2L2']\n";

const StudyReport& only_report(const StudyResult& result, const std::string& study) {
    for (const StudyReport* report : reports_of(result))
        if (report->study() == study)
            return *report;
    throw std::logic_error("no report of " + study);
}

/// The fields of the first row by the names in the head.
std::map<std::string, double> first_row(const StudyResult& result, const std::string& study) {
    std::istringstream lines(only_report(result, study).csvs(result).front().text.whole());
    std::string line;
    const auto fields = [&] {
        std::getline(lines, line);
        std::vector<std::string> all;
        std::istringstream rest(line);
        for (std::string field; std::getline(rest, field, ',');)
            all.push_back(field);
        return all;
    };
    const auto head = fields();
    const auto row = fields();
    std::map<std::string, double> named;
    for (std::size_t i = 0; i < std::min(head.size(), row.size()); ++i)
        if (!row[i].empty() && row[i].find_first_not_of("0123456789.e-") == std::string::npos)
            named[head[i]] = std::stod(row[i]);
    return named;
}

} // namespace

BOOST_AUTO_TEST_CASE(of_a_prediction_and_its_interval) {
    StudyResult result = result_of("[ladder]\nfinal_time = 0.5\nelements = [4, 8]\n"
                                   "dt = '0.4/s'\nnorms = ['theta_L2L2']\n" +
                                   grid);
    auto& predictions = result.get<LadderResult>()->norms.at(0).predictions;
    predictions.assign(2, {.value = 0.5, .low = 0.25, .high = 0.75, .determined = true});
    const auto row = first_row(result, "ladder");
    BOOST_TEST(row.at("theta_L2L2_predicted") == 0.5);
    BOOST_TEST(row.at("theta_L2L2_predicted_low") == 0.25);
    BOOST_TEST(row.at("theta_L2L2_predicted_high") == 0.75);
    const auto rung = only_report(result, "ladder").json(result)["rungs"][0];
    BOOST_TEST(rung["predicted"]["theta_L2L2"] == 0.5);
    BOOST_TEST(rung["predicted_interval"]["theta_L2L2"] == nlohmann::ordered_json({0.25, 0.75}));
}

BOOST_AUTO_TEST_CASE(of_a_fit) {
    StudyResult result = result_of(grid);
    TwoTermFit& fit = result.get<OrdersResult>()->norms.at(0).fit;
    fit.model = {.a = 3.0, .p = 2.0, .b = 0.5, .q = 1.0, .rho = -0.25};
    fit.p = {.value = 2.0, .low = 1.875, .high = 2.125, .determined = true};
    fit.q = {.value = 1.0, .low = 0.75, .high = 1.25, .determined = true};
    fit.p_se = 0.0625;
    fit.q_se = 0.03125;
    fit.rho_se = 0.015625;
    fit.rms = 0.0078125;
    fit.a_uncertainty = 0.5;
    fit.b_uncertainty = 0.75;
    fit.failure.clear();
    const auto json = only_report(result, "orders").json(result)["norms"]["theta_L2L2"];
    const std::map<std::string, double> wanted{{"a", 3.0},
                                               {"p", 2.0},
                                               {"b", 0.5},
                                               {"q", 1.0},
                                               {"rho", -0.25},
                                               {"p_se", 0.0625},
                                               {"q_se", 0.03125},
                                               {"rho_se", 0.015625},
                                               {"rms", 0.0078125},
                                               {"p_uncertainty", 0.125},
                                               {"q_uncertainty", 0.25},
                                               {"a_uncertainty", 0.5},
                                               {"b_uncertainty", 0.75}};
    for (const auto& [name, figure] : wanted)
        BOOST_TEST(json.at(name) == figure, name);
}

BOOST_AUTO_TEST_CASE(of_a_timing) {
    StudyResult result = result_of("[work_precision]\nfinal_time = 0.5\nruns = 1\n"
                                   "norms = ['theta_L2L2']\n[[work_precision.scheme]]\n"
                                   "name = 'Euler'\nelements = [4]\ndt = [0.1]\n");
    result.get<WorkPrecisionResult>()->schemes.at(0).timings.at(0) =
        Timing{.min = 0.125, .q1 = 0.25, .median = 0.5, .q3 = 0.75, .runs = 17};
    const auto row = first_row(result, "work_precision");
    const auto json = only_report(result, "work_precision").json(result);
    const auto seconds = json["schemes"][0]["rows"][0]["seconds"];
    for (const auto& [name, figure] : std::map<std::string, double>{
             {"min", 0.125}, {"q1", 0.25}, {"median", 0.5}, {"q3", 0.75}}) {
        BOOST_TEST(row.at("seconds_" + name) == figure);
        BOOST_TEST(seconds.at(name) == figure, name);
    }
    BOOST_TEST(row.at("runs") == 17.0);
    BOOST_TEST(seconds.at("runs") == 17);
}

// The last digit is known to what stands in brackets, which is rounded up.
BOOST_AUTO_TEST_CASE(of_a_size_as_many_digits_are_shown_as_its_interval_tells) {
    struct Case {
        double size, uncertainty;
        std::string text;
    };
    for (const auto& [size, uncertainty, text] :
         {Case{3.5601, 0.098, "3.6(4)"}, Case{0.16781, 0.148, "0.17(3)"},
          Case{1.6781e-5, 0.148, "1.7(3)e-5"}, Case{9.97, 0.01, "10.0(1)"},
          Case{234567, 0.02, "2.35(5)e5"}, Case{350, 0.2, "3.5(7)e2"}, Case{2.0, 0.001, "2.000(2)"},
          Case{0.5, 1.5, ""}, Case{9.6, 0.97, ""},
          Case{0.5, std::numeric_limits<double>::infinity(), ""}}) {
        TwoTermFit fit;
        fit.model = {.a = size, .p = 2.0, .b = size, .q = 1.0, .rho = 0.0};
        fit.p.determined = fit.q.determined = true;
        fit.a_uncertainty = fit.b_uncertainty = uncertainty;
        const Table table = fit_table({{"theta_L2L2", &fit}}, 16);
        for (const std::size_t column : {2, 3})
            BOOST_TEST(table.groups.at(0).columns.at(column).cells.at(0) == text);
        // Which sign ρ has hangs on sizes.
        BOOST_TEST(table.groups.at(0).columns.at(4).cells.at(0) == (uncertainty < 1 ? "0.00" : ""));
    }
}

BOOST_AUTO_TEST_SUITE_END()

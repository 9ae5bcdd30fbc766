// The grid study of the paper's problem, and what it says of the ladder.

#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/study.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <string>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(orders_study)

namespace {

const NormOrders& orders_of(const OrdersResult& orders, const std::string& norm) {
    return *std::find_if(orders.norms.begin(), orders.norms.end(),
                         [&](const NormOrders& one) { return one.norm == norm; });
}

/// The grid of the paper's problem; each is run once.
const OrdersResult& papers_grid(const std::string& mass) {
    static std::map<std::string, StudyResult> results;
    const auto [place, is_new] = results.try_emplace(mass);
    if (is_new)
        place->second = run_study(read_scene("table1-orders", {"scheme.thermal_mass=" + mass}));
    return *place->second.get<OrdersResult>();
}

} // namespace

BOOST_DATA_TEST_CASE(the_paper_s_scheme_has_order_two_in_h_and_one_in_dt,
                     boost::unit_test::data::make({"lumped", "consistent"}), mass) {
    const OrdersResult& grid = papers_grid(mass);
    const TwoTermFit& theta = orders_of(grid, "theta_L2L2").fit;
    const TwoTermFit& u = orders_of(grid, "u_LinfH2semi").fit;
    BOOST_REQUIRE(theta.holds());
    BOOST_REQUIRE(u.holds());
    BOOST_TEST(std::abs(theta.model.p - 2.0) <= 0.02);
    BOOST_TEST(std::abs(theta.model.q - 1.0) <= 0.02);
    BOOST_TEST(std::abs(u.model.p - 2.0) <= 0.05);
    BOOST_TEST(std::abs(u.model.q - 1.0) <= 0.02);
    BOOST_TEST(theta.model.rho < -0.8); // the two errors of θ have opposite signs
}

BOOST_AUTO_TEST_CASE(the_constant_of_corollary_2_2_stays_bounded_over_the_grid) {
    const OrdersResult& grid = papers_grid("lumped");
    BOOST_REQUIRE(grid.corollary);
    // Where the first-order term rules, corollary ≈ (b Δt)²: C tends to b²; where the second-order
    // term rules, to (a h)², which falls. Its greatest value is a² h² on the coarsest mesh with the
    // finest step.
    const TwoTermModel& model = orders_of(grid, "corollary").fit.model;
    BOOST_TEST(grid.corollary->greatest <= 1.05 * model.a * model.a * 0.05 * 0.05);
    BOOST_TEST(grid.corollary->finest <= model.b * model.b);
}

// C = corollary/(h² + Δt²), run by run.
BOOST_AUTO_TEST_CASE(constants_of_a_theorem_are_the_least_the_greatest_and_that_of_the_finest_run) {
    const OrdersResult& grid = papers_grid("lumped");
    const auto k = static_cast<std::size_t>(&orders_of(grid, "corollary") - grid.norms.data());
    std::map<double, double> by_width;
    for (const auto& run : grid.runs) {
        const double h = 1.0 / static_cast<double>(run.rung.elements);
        const double width = h * h + run.rung.dt * run.rung.dt;
        by_width[width] = run.errors[k] / width;
    }
    const auto [least, greatest] =
        std::minmax_element(by_width.begin(), by_width.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto near = boost::test_tools::tolerance(1e-12);
    BOOST_TEST(grid.corollary->least == least->second, near);
    BOOST_TEST(grid.corollary->greatest == greatest->second, near);
    BOOST_TEST(grid.corollary->finest == by_width.begin()->second, near);
}

BOOST_AUTO_TEST_CASE(the_grid_predicts_finer_rungs_and_explains_the_order_of_the_table) {
    const StudyResult result =
        run_study(read_scene("table1-extended", {"ladder.elements=[40, 80, 160, 320]"}));
    const LadderResult& ladder = *result.get<LadderResult>();
    // No point of the grid is finer than s = 160 or Δt = 1e-3.
    for (const auto& run : result.get<OrdersResult>()->runs)
        BOOST_TEST((run.rung.elements <= 160 && run.rung.dt >= 1e-3));
    for (const auto& norm : ladder.norms) {
        BOOST_REQUIRE(norm.predictions.size() == 4u);
        const auto k = static_cast<std::size_t>(&norm - ladder.norms.data());
        const double ratio = std::sqrt(ladder.rungs[3].errors[k] / norm.predictions[3].value);
        BOOST_TEST(std::abs(ratio - 1.0) <= 0.1, norm.norm.name << " " << ratio);
        BOOST_TEST(norm.predictions[3].low <= ladder.rungs[3].errors[k]);
        BOOST_TEST(ladder.rungs[3].errors[k] <= norm.predictions[3].high);
        BOOST_REQUIRE(norm.remarks.size() == 2u);
        BOOST_TEST(norm.remarks[1].find("cancel in part") != std::string::npos, norm.remarks[1]);
        BOOST_TEST(norm.remarks[1].find("The order that remains, 2.0") != std::string::npos,
                   norm.remarks[1]);
    }
    // θ: the terms are equally large where a h² = b h/100, h = b/(100 a).
    const TwoTermModel& theta = orders_of(*result.get<OrdersResult>(), "theta_L2L2").fit.model;
    const double s = 100.0 * theta.a / theta.b;
    BOOST_TEST(s > 1500.0);
    BOOST_TEST(s < 3000.0);
}

BOOST_AUTO_TEST_CASE(a_ladder_is_judged_by_orders_of_its_own_final_time_only) {
    const auto predictions = [](const std::string& final_time) {
        const StudyResult result = run_study(
            read_scene("table1", {"ladder.elements=[10, 20, 40]", "ladder.dt=\"0.01/s\"",
                                  "ladder.printed={}", "ladder.final_time=" + final_time}));
        return result.get<LadderResult>()->norms[0].predictions.size();
    };
    BOOST_TEST(predictions("2") == 3u); // that of [orders]
    BOOST_TEST(predictions("1") == 0u);
}

BOOST_AUTO_TEST_CASE(verdicts_stand_in_every_rung) {
    const StudyResult result = run_study(read_scene(
        "table1", {"ladder.elements=[10, 20, 40]", "ladder.dt=\"0.01/s\"", "ladder.printed={}"}));
    for (const auto& norm : result.get<LadderResult>()->norms) {
        BOOST_TEST(norm.verdicts.size() == 3u);
        for (const auto& verdict : norm.verdicts)
            BOOST_TEST(!verdict.reason.empty());
    }
}

BOOST_AUTO_TEST_SUITE_END()

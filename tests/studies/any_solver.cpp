// Ladder, grid and work-precision know no solver: a run is a call, here of a function whose error
// is known exactly.

#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/study.hpp"
#include "studies/work_precision/work_precision.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(any_solver)

namespace {

const std::vector<Measure> norms{{"L2", false, "the error in L²", ""},
                                 {"L2_sq", true, "the error in L², squared", ""}};

/// e = 3h² + 2Δt of the method "first"; the other's is a tenth of it.
RungResult made_up(const RunTask& task) {
    RungResult result;
    result.rung = task.rung;
    const double h = 1.0 / static_cast<double>(task.rung.elements);
    const double error = (3.0 * h * h + 2.0 * task.rung.dt) *
                         (std::any_cast<std::string>(task.method.scheme) == "first" ? 1.0 : 0.1);
    if (!task.advance(0) || !task.advance(task.rung.steps)) {
        result.status = RungStatus::interrupted;
        return result;
    }
    result.seconds = 1e-3;
    result.counters = {{"calls", 1}};
    for (const auto& measure : task.measures)
        result.errors.push_back(measure.squared ? error * error : error);
    return result;
}

Method method(const std::string& name) {
    return {.scheme = name, .name = name, .words = "made up", .cost = 1.0, .iterations = ""};
}

std::vector<Rung> levels(const std::vector<std::int64_t>& elements) {
    std::vector<Rung> rungs;
    rungs.reserve(elements.size());
    for (const auto s : elements)
        rungs.push_back({s, s * s, 1.0 / static_cast<double>(s * s)});
    return rungs;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_ladder_of_calls_shows_the_order_of_what_is_called) {
    // Δt = h²: e = 5h².
    const LadderBlock block{
        .final_time = 1.0, .rungs = levels({4, 8, 16}), .norms = norms, .printed = {}};
    const LadderResult ladder = run_ladder(block, method("first"), {.run = made_up});
    BOOST_REQUIRE(ladder.rungs.size() == 3U);
    for (std::size_t i = 1; i < 3; ++i) {
        BOOST_TEST(*ladder.norms[0].orders[i] == 2.0, boost::test_tools::tolerance(1e-12));
        BOOST_TEST(*ladder.norms[1].orders[i] == 4.0, boost::test_tools::tolerance(1e-12));
        BOOST_TEST(int(ladder.norms[0].verdicts[i].verdict == Verdict::asymptotic));
        BOOST_TEST(ladder.rungs[i].count("calls") == 1);
    }
}

// e = h + h^1.5: orders from 1.23 down to 1.11, pairs of which agree, and go to 1.
BOOST_AUTO_TEST_CASE(a_ladder_of_calls_is_asymptotic_at_the_order_that_it_goes_to) {
    const auto drifting = [](const RunTask& task) {
        RungResult result = made_up(task);
        const double h = 1.0 / static_cast<double>(task.rung.elements);
        result.errors.assign(task.measures.size(), h + std::pow(h, 1.5));
        return result;
    };
    const LadderBlock block{
        .final_time = 1.0, .rungs = levels({1, 2, 4, 8, 16}), .norms = {norms[0]}, .printed = {}};
    const LadderResult ladder = run_ladder(block, method("first"), {.run = drifting});
    for (const auto& verdict : ladder.norms[0].verdicts)
        BOOST_TEST(int(verdict.verdict != Verdict::asymptotic), verdict.reason);
    BOOST_TEST(ladder.norms[0].verdicts.back().reason.find("that of the end is 1.00 ± ") !=
               std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_grid_of_calls_has_the_orders_and_constants_of_what_is_called) {
    OrdersBlock block{.final_time = 1.0, .grid = {}, .norms = {norms[0]}};
    for (const std::int64_t steps : {10, 20, 40, 80})
        for (const std::int64_t s : {4, 8, 16, 32})
            block.grid.push_back({s, steps, 1.0 / static_cast<double>(steps)});
    for (const int jobs : {1, 3}) {
        const OrdersResult grid =
            run_orders(block, method("first"), {.run = made_up}, {.jobs = jobs});
        const TwoTermFit* fit = grid.fit_of(norms[1]);
        BOOST_REQUIRE(fit != nullptr);
        const TwoTermModel* model = &fit->model;
        BOOST_TEST(model->p == 2.0, boost::test_tools::tolerance(1e-4));
        BOOST_TEST(model->q == 1.0, boost::test_tools::tolerance(1e-4));
        BOOST_TEST(model->a == 3.0, boost::test_tools::tolerance(1e-4));
        BOOST_TEST(model->b == 2.0, boost::test_tools::tolerance(1e-4));
    }
}

// e² = 25 h⁴ with Δt = h², so that C = e² / (h² + Δt²) = 25 / (s² + 1): the coarsest and the finest
// run have none.
BOOST_AUTO_TEST_CASE(constants_of_a_theorem_are_those_of_the_runs_that_have_an_error) {
    const auto breaks = [](const RunTask& task) {
        RungResult result = made_up(task);
        if (task.level == 0 || task.level == 3) {
            result.status = RungStatus::failed;
            result.errors.clear();
        }
        return result;
    };
    const OrdersBlock block{.final_time = 1.0,
                            .grid = levels({4, 8, 16, 32}),
                            .norms = {{"L2_sq", true, "", "Theorem 1"}}};
    const OrdersResult grid = run_orders(block, method("first"), {.run = breaks});
    BOOST_REQUIRE(grid.corollary.has_value());
    const auto near = boost::test_tools::tolerance(1e-12);
    BOOST_TEST(grid.corollary->greatest == 25.0 / (8 * 8 + 1), near);
    BOOST_TEST(grid.corollary->least == 25.0 / (16 * 16 + 1), near);
    BOOST_TEST(grid.corollary->finest == 25.0 / (16 * 16 + 1), near);
}

BOOST_AUTO_TEST_CASE(a_row_without_an_error_says_whether_its_run_failed) {
    const auto ends = [](const RunTask& task) {
        RungResult result = made_up(task);
        if (task.level == 1)
            result.status = RungStatus::failed;
        if (task.level == 3)
            result.status = RungStatus::interrupted;
        if (result.status != RungStatus::ok)
            result.errors.clear();
        return result;
    };
    const LadderBlock block{
        .final_time = 1.0, .rungs = levels({4, 8, 16, 32}), .norms = {norms[0]}};
    const LadderResult ladder = run_ladder(block, method("first"), {.run = ends});
    const auto& verdicts = ladder.norms.at(0).verdicts;
    BOOST_TEST(verdicts.at(1).reason == "the run failed");
    BOOST_TEST(verdicts.at(3).reason == "the run was not made, or not to its end");
    BOOST_TEST(verdicts.at(2).reason != "the run failed");
}

BOOST_AUTO_TEST_CASE(the_first_run_that_failed_is_named_and_those_after_it_are_counted) {
    const auto ending = [](const std::string& command) {
        const TemporaryDirectory directory;
        return run_study(read_scene(directory.write("s.toml", "[solver]\ncommand = ['sh', '-c', '" +
                                                                  command +
                                                                  "']\nerrors = { e = 'e = (.*)' "
                                                                  "}\n[ladder]\nelements = "
                                                                  "[4, 8, 16]\nnorms = ['e']\n")))
            .ending();
    };
    const Ending two = ending("test {elements} = 4 && echo e = 1 || exit $(({elements} / 4))");
    BOOST_TEST(two.failures == 2);
    BOOST_TEST(two.reason.starts_with("2 runs failed; the first, s = 8: exit 2"), two.reason);
    const Ending one = ending("test {elements} = 16 && exit 3 || echo e = 1");
    BOOST_TEST(one.reason.starts_with("s = 16: exit 3"), one.reason);
}

// e = 3 h², whatever Δt: the fit holds, and knows no order in Δt.
BOOST_AUTO_TEST_CASE(a_grid_that_shows_one_order_alone_predicts_nothing) {
    const auto in_space = [](const RunTask& task) {
        RungResult result = made_up(task);
        result.errors = {3.0 * task.rung.h() * task.rung.h()};
        return result;
    };
    OrdersBlock block{.final_time = 1.0, .grid = {}, .norms = {norms[0]}};
    for (const std::int64_t steps : {10, 20, 40, 80})
        for (const std::int64_t s : {4, 8, 16, 32})
            block.grid.push_back({s, steps, 1.0 / static_cast<double>(steps)});
    const OrdersResult grid = run_orders(block, method("first"), {.run = in_space});
    BOOST_TEST(grid.norms[0].fit.holds());
    BOOST_TEST(grid.fit_of(norms[0]) == nullptr);
}

// e = 5 h², but for the coarsest run, known to 2 %, and the finest, with half the reference's
// elements, which are wrong.
BOOST_AUTO_TEST_CASE(remarks_rest_on_the_levels_that_are_resolved_and_not_close_to_the_reference) {
    const auto wrong_at_the_ends = [](const RunTask& task) {
        RungResult result = made_up(task);
        if (task.level == 0 || task.level == 4)
            result.errors[0] *= 10.0;
        result.uncertainties = {task.level == 0 ? 0.02 : 0.01};
        return result;
    };
    const LadderBlock block{
        .final_time = 1.0, .rungs = levels({4, 8, 16, 32, 64}), .norms = {norms[0]}, .printed = {}};
    const LadderResult ladder =
        run_ladder(block, method("first"),
                   {.run = wrong_at_the_ends,
                    .reference = ReferenceBlock{.elements = 128, .dt = 1.0 / (128 * 128)}});
    BOOST_TEST(ladder.norms[0].remarks == std::vector<std::string>{"L2: order 2.00 up to s = 32."},
               boost::test_tools::per_element());
    BOOST_TEST(ladder.quadrature_remark.find("s = 4: L2 is uncertain by up to 0.02 of itself.") !=
                   std::string::npos,
               ladder.quadrature_remark);
}

// A norm and its square are one; what is certain is not named.
BOOST_AUTO_TEST_CASE(every_norm_that_quadrature_leaves_uncertain_is_named) {
    const auto made_uncertain = [](const RunTask& task) {
        RungResult result = made_up(task);
        result.errors = {1.0, 1.0, 1.0, 1.0};
        result.uncertainties = {0.02, 0.05, 0.05, 0.001};
        return result;
    };
    const LadderBlock block{.final_time = 1.0,
                            .rungs = levels({4}),
                            .norms = {{"H1"}, {"L2"}, {"L2_sq", true}, {"max"}},
                            .printed = {}};
    const LadderResult ladder =
        run_ladder(block, method("first"), {.run = made_uncertain, .reference = {}});
    BOOST_TEST(ladder.quadrature_remark.find(
                   "s = 4: L2 is uncertain by up to 0.05 of itself, H1 by no more.") !=
                   std::string::npos,
               ladder.quadrature_remark);
}

BOOST_AUTO_TEST_CASE(a_race_of_calls_gives_each_scheme_its_own_errors) {
    WorkPrecisionBlock block;
    block.final_time = 1.0;
    block.norms = {norms[0]};
    block.runs = 2;
    block.schemes = {{"first", method("first"), levels({4, 8})},
                     {"second", method("second"), levels({4, 8})}};
    const WorkPrecisionResult race = run_work_precision(block, {.run = made_up});
    BOOST_REQUIRE(race.schemes.size() == 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        BOOST_TEST(race.schemes[0].runs[i].errors.at(0) / race.schemes[1].runs[i].errors.at(0) ==
                       10.0,
                   boost::test_tools::tolerance(1e-12));
        BOOST_TEST(race.schemes[0].timings[i]->runs == 2);
    }
}

BOOST_AUTO_TEST_CASE(the_size_of_the_largest_run_is_no_negative_number) {
    const Rung largest{most_elements, static_cast<std::int64_t>(most_steps), 1e-12};
    BOOST_TEST(node_steps(largest) == 10'000'000'000'000'000'000ULL);
}

// What says that errors are rounding is asked with all runs, and with those that refine both
// widths: three meshes with four steps have three of them.
BOOST_AUTO_TEST_CASE(a_grid_of_rounding_has_no_orders) {
    std::vector<Rung> grid;
    for (const std::int64_t s : {8, 4, 16})
        for (const std::int64_t steps : {10, 80, 20, 40})
            grid.push_back({s, steps, 1.0 / static_cast<double>(steps)});
    const OrdersBlock block{.final_time = 1.0, .grid = grid, .norms = norms};
    const auto run_with = [&](bool is_rounding) {
        return run_orders(
            block, method("first"),
            {.run = made_up,
             .rounding = [&](const Series& series, const std::vector<RungResult>& runs,
                             const std::vector<RungResult>& refined,
                             std::size_t k) -> std::optional<RoundingErrors> {
                 BOOST_TEST(series.study == "orders");
                 BOOST_TEST(runs.size() == 12U);
                 BOOST_REQUIRE(refined.size() == 3U);
                 for (std::size_t i = 0; i < 3; ++i) {
                     BOOST_TEST(refined[i].rung.elements == 4 << i);
                     BOOST_TEST(refined[i].rung.steps == 10 << i);
                 }
                 if (!is_rounding || k != 1)
                     return std::nullopt;
                 return RoundingErrors{1e-15, "every error is rounding", "its error is rounding"};
             }});
    };
    const OrdersResult plain = run_with(false);
    const OrdersResult rounded = run_with(true);
    for (const OrdersResult* result : {&plain, &rounded}) {
        BOOST_REQUIRE(result->norms.size() == 2U);
        BOOST_TEST(result->norms[0].fit.holds());
        BOOST_TEST(!result->norms[0].rounding);
    }
    BOOST_TEST(plain.norms[1].fit.holds());
    BOOST_TEST(!rounded.norms[1].fit.holds());
    BOOST_TEST(rounded.norms[1].fit.failure == "every error is rounding");
    BOOST_TEST(rounded.norms[1].rounding.value() == 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()

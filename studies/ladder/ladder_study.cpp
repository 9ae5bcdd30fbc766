#include "mms/text/toml_reader.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study.hpp"
#include "studies/table_row.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

/// The orders that may judge the ladder: the constants of a model are those of its final time.
const OrdersResult* orders_beside(const LadderBlock& block, const StudyResult& all) {
    const auto* orders = all.scene.get<OrdersBlock>();
    return orders != nullptr && orders->final_time == block.final_time ? all.get<OrdersResult>()
                                                                       : nullptr;
}

/// Rungs finer in h or dt than every run of the grid: there a prediction is one.
bool beyond(const Rung& rung, const std::vector<RungResult>& grid) {
    return std::all_of(grid.begin(), grid.end(), [&](const RungResult& run) {
        return rung.elements > run.rung.elements || rung.dt < run.rung.dt;
    });
}

/// ratios = [lo, hi], or one such pair a rung: of the errors to the printed figures.
void expect_ratios(TableReader& table, const Series& series, std::size_t k,
                   const std::optional<PublishedFigures>& printed,
                   std::vector<Expectation>& expectations) {
    const auto bands = table.bands("ratios");
    if (!bands)
        return;
    const std::string& norm = series.measures[k].name;
    if (!printed || !printed->figures.contains(norm))
        throw table.error("ratios", " compares with published values, but "
                                    "ladder.printed has none for " +
                                        norm);
    const std::size_t rungs = series.rungs.size();
    if (bands->size() != 1 && bands->size() != rungs)
        throw table.error("ratios", " has " + std::to_string(bands->size()) + " bands for " +
                                        std::to_string(rungs) +
                                        " levels; give one for all, or one a level");
    for (std::size_t row = 0; row < rungs; ++row) {
        const auto& band = (*bands)[bands->size() == 1 ? 0 : row];
        const double figure = printed->figures.at(norm)[row];
        expectations.push_back(
            in_band(band.lowest, band.highest, table.place("ratios"),
                    [series, k, row, figure](const StudyResult& result) {
                        const auto& run = result.get<LadderResult>()->rungs[row];
                        const auto error = error_of(run, k);
                        return std::vector{
                            row_metric(series, run, k, "ratio to the published value",
                                       error ? std::optional(*error / figure) : std::nullopt)};
                    }));
    }
}

/// Why a ladder has no prediction of a norm.
std::string why_not_predicted(const StudyResult& result, const Measure& norm) {
    const auto* orders = result.get<OrdersResult>();
    if (orders == nullptr)
        return "there is no [orders]";
    if (result.scene.get<OrdersBlock>()->final_time != result.scene.get<LadderBlock>()->final_time)
        return "[orders] has another final_time";
    const auto found = std::ranges::find(orders->norms, norm.root(), &NormOrders::norm);
    if (found == orders->norms.end())
        return "[orders] has no " + norm.root();
    const TwoTermFit& fit = found->fit;
    if (!fit.holds())
        return "the fit of [orders] failed: " + fit.failure;
    if (!fit.misfit.empty())
        return fit.misfit;
    if (!fit.p_determined())
        return "its order in h is not determined: " + fit.p.status;
    return "its order in dt is not determined: " + fit.q.status;
}

/// Error over prediction, both of the norm itself; or where in the predicted interval the error
/// lies: 0 at its low end, 1 at its high one.
std::optional<double> against_prediction(std::optional<double> error,
                                         const OrderInterval& predicted, bool squared,
                                         bool in_interval) {
    if (!error)
        return std::nullopt;
    if (in_interval)
        return (*error - predicted.low) / (predicted.high - predicted.low);
    return squared ? std::sqrt(*error / predicted.value) : *error / predicted.value;
}

/// Of every rung finer than the grid. The names are the same where the model does not hold: a
/// defect that spoils it must not take the expectation away.
std::vector<Metric> predicted_metrics(const Series& series, std::size_t k, bool in_interval,
                                      const StudyResult& result) {
    const LadderResult& ladder = *result.get<LadderResult>();
    const LadderNorm& norm = ladder.norms[k];
    const auto* orders = result.get<OrdersResult>();
    const bool predicts = !norm.predictions.empty();
    const std::string why_not =
        predicts ? "" : "no two-term model: " + why_not_predicted(result, norm.norm);
    const std::string name = in_interval ? "place in the predicted interval"
                                         : "ratio to the two-term model's prediction";
    std::vector<Metric> metrics;
    for (std::size_t row = 0; orders != nullptr && row < ladder.rungs.size(); ++row) {
        const RungResult& run = ladder.rungs[row];
        if (!beyond(run.rung, orders->runs))
            continue;
        const auto part = predicts ? against_prediction(error_of(run, k), norm.predictions[row],
                                                        norm.norm.squared, in_interval)
                                   : std::nullopt;
        metrics.push_back(row_metric(series, run, k, name, part, why_not));
    }
    if (metrics.empty())
        metrics.push_back({"ladder." + norm.norm.name + ": " + name, std::nullopt,
                           predicts ? "no level is finer than the grid of [orders]" : why_not});
    return metrics;
}

using FindInterval = std::function<const OrderInterval&(const ColumnAnalysis&)>;

bool finest_failed(const StudyResult& result) {
    return finest_failed(result.get<LadderResult>()->rungs);
}

/// KEY = [lo, hi], and what expect_interval reads, of an interval in the analysis of measure k.
void expect_found(TableReader& table, const std::string& key, const std::string& what,
                  std::size_t k, const FindInterval& find, std::vector<Expectation>& expectations) {
    const auto found = [k, find](const StudyResult& result) {
        const DataAnalysis& analysis = *result.get<LadderResult>()->analysis;
        OrderInterval interval = find(analysis.columns[k]);
        const bool failed = finest_failed(result);
        if (failed || vanishes_at_the_finest(analysis, analysis.columns[k])) {
            interval.determined = false;
            interval.status = failed ? finest_run_failed : finest_is_zero;
        }
        return interval;
    };
    expect_band(table, key, expectations, [what, found](const StudyResult& result) {
        const OrderInterval interval = found(result);
        return std::vector{
            Metric{what, interval.determined ? std::optional(interval.value) : std::nullopt,
                   "not determined: " + interval.status}};
    });
    expect_interval(table, key, [&](const JudgeInterval& judge) {
        expectations.push_back([what, found, judge](const StudyResult& result) {
            return std::vector{judge(what, found(result))};
        });
    });
}

/// gci = { limit = [lo, hi], uncertainty = …, order = … }: what a method that has a name says.
void expect_method(TableReader& table, const std::string& key, const std::string& name,
                   std::size_t k, MethodAnswer LimitEstimate::*method,
                   std::vector<Expectation>& expectations) {
    auto inner = table.table(key);
    if (!inner)
        return;
    const std::size_t before = expectations.size();
    for (const auto& [word, figure] : {std::pair("limit", &MethodLimit::limit),
                                       {"uncertainty", &MethodLimit::uncertainty},
                                       {"order", &MethodLimit::order}})
        expect_band(
            *inner, word, expectations,
            [what = name + key + ", " + word, k, method,
             figure = figure](const StudyResult& result) {
                const auto& column = result.get<LadderResult>()->analysis->columns[k];
                const auto& found = (*column.limit).*method;
                const bool no_finest = finest_failed(result);
                return std::vector{Metric{
                    what, found && !no_finest ? std::optional((*found).*figure) : std::nullopt,
                    no_finest ? finest_run_failed
                              : "the method says nothing of these values: " + found.silence}};
            });
    finish_expecting(*inner, before, expectations);
}

/// Of an error the order along the ladder; of a value also its limit, the uncertainty of the finest
/// and what methods that have names say.
void expect_analysis(TableReader& table, const Measure& measure, std::size_t k,
                     std::vector<Expectation>& expectations) {
    const std::string name = "ladder." + measure.name + ": ";
    const std::string of = measure.squared ? ", of " + measure.of_orders() : "";
    expect_found(
        table, "order", name + "order along the ladder" + of, k,
        [](const ColumnAnalysis& column) -> const OrderInterval& {
            return column.by_width.front();
        },
        expectations);
    if (!measure.is_value)
        return;
    expect_method(table, "gci", name, k, &LimitEstimate::gci, expectations);
    expect_method(table, "celik", name, k, &LimitEstimate::celik, expectations);
    expect_method(table, "eca_hoekstra", name, k, &LimitEstimate::eca_hoekstra, expectations);
    expect_found(
        table, "limit", name + "limit", k,
        [](const ColumnAnalysis& column) -> const OrderInterval& { return column.limit->limit; },
        expectations);
    expect_band(table, "uncertainty", expectations, [name, k](const StudyResult& result) {
        const LimitEstimate& estimate = *result.get<LadderResult>()->analysis->columns[k].limit;
        return std::vector{
            Metric{name + "uncertainty of the finest value",
                   estimate.limit.determined && !finest_failed(result)
                       ? std::optional(estimate.uncertainty)
                       : std::nullopt,
                   estimate.limit.determined ? finest_run_failed : estimate.limit.status}};
    });
}

} // namespace

/// The block [ladder].
struct LadderStudy final : KindOf<LadderBlock, LadderResult> {
    std::string name() const override { return "ladder"; }
    bool measures() const override { return true; }

    std::any read(TableReader& table, const SolverKeys& keys) const override {
        return read_ladder(table, keys);
    }
    std::vector<Series> series(const std::any& block, const Method& own) const override {
        return {series_of(block_in(block), own)};
    }
    using StudyKind::until;
    Until* until(std::any& block) const override { return until_in(block); }
    std::vector<Rung> addable(const std::any& block) const override {
        return block_in(block).until ? added_levels(block_in(block)) : std::vector<Rung>();
    }
    std::any run(const std::any& block, const StudyContext& context) const override {
        return make_runs(block_in(block), context.method, context.solver.run, context.execution);
    }
    void conclude(const std::any& block, std::any& record, const StudyResult& all,
                  const StudyContext& context) const override {
        const auto refined = record_in(record).refined;
        auto analysed = analyse_ladder(block_in(block), context.method, record_in(record).rungs,
                                       context.solver, orders_beside(block_in(block), all));
        analysed.refined = refined;
        record = std::move(analysed);
    }
    Runs runs(const std::any& record) const override { return {&record_in(record).rungs}; }

    void expect(TableReader& table, const std::any& block,
                std::vector<Expectation>& expectations) const override {
        const Series series = series_of(block_in(block), {});
        require_free_names(table, series.measures);
        if (block_in(block).until)
            expect_refined(table, name(), expectations, [](const StudyResult& result) {
                return *result.get<LadderResult>()->refined;
            });
        expect_counters(table, series, expectations);
        expect_sentences(table, "remarks", expectations, [](const StudyResult& result) {
            std::vector<std::string> remarks = {result.get<LadderResult>()->quadrature_remark,
                                                result.get<LadderResult>()->reference_remark};
            std::erase(remarks, "");
            return remarks;
        });
        const auto read = [&](TableReader& norm, std::size_t k) {
            if (block_in(block).says_orders)
                expect_analysis(norm, series.measures[k], k, expectations);
            expect_sentences(norm, "remarks", expectations, [k](const StudyResult& result) {
                return result.get<LadderResult>()->norms[k].remarks;
            });
            if (series.measures[k].is_value)
                return;
            expect_orders(norm, series, k, expectations);
            expect_ratios(norm, series, k, block_in(block).printed, expectations);
            expect_errors(norm, series, k, expectations);
            for (const bool in_interval : {false, true})
                expect_band(norm, in_interval ? "predicted_place" : "predicted", expectations,
                            [series, k, in_interval](const StudyResult& result) {
                                return predicted_metrics(series, k, in_interval, result);
                            });
            expect_verdicts(
                norm, {series.rungs.size(), "rung", series.may_grow},
                [&](const JudgeVerdicts& judge) {
                    expectations.push_back([series, k, judge](const StudyResult& result) {
                        return std::vector{judge("ladder." + series.measures[k].name,
                                                 result.get<LadderResult>()->norms[k].verdicts)};
                    });
                });
        };
        for_each_measure(table, block_in(block).norms, expectations, read);
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, LadderStudy>();

} // namespace tvbeam

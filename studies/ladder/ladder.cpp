#include "studies/ladder/ladder.hpp"

#include "studies/ladder/order_remarks.hpp"
#include "studies/orders/error_rows.hpp"
#include "studies/orders/ladder_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace tvbeam {

namespace {

/// Errors against a reference, with what the model says the reference hides put back.
std::vector<Refinement> made_whole(std::vector<Refinement> roots, const Refinement& reference,
                                   const TwoTermModel& model) {
    for (auto& record : roots)
        if (const double seen = error_against(reference, model, record.h, record.dt); seen > 0.0)
            record.error *= model.error(record.h, record.dt) / seen;
    return roots;
}

/// Whether the orders of a window move: only then is it worth the time to ask where they go.
bool moves(const LadderVerdict& verdict) {
    constexpr double still = 0.025; // of the order
    if (!verdict.window)
        return false;
    const auto& [first, last, order] = *verdict.window;
    std::vector<double> orders;
    for (std::size_t i = first + 1; i <= last; ++i)
        if (verdict.orders[i])
            orders.push_back(*verdict.orders[i]);
    return !orders.empty() && std::abs(orders.back() - orders.front()) > still * order;
}

LadderNorm analysed(const Measure& norm, const std::vector<RungResult>& rungs, std::size_t k,
                    const TwoTermFit* fit, const std::optional<Refinement>& reference) {
    const TwoTermModel* model = fit != nullptr ? &fit->model : nullptr;
    LadderNorm result;
    result.norm = norm;
    if (norm.is_value)
        return result;
    result.orders = observed_orders(records_of(rungs, k));
    // Verdicts rest on the norm itself, in which the two terms of the error add up.
    const auto roots = root_records_of(rungs, k, norm);
    auto verdict =
        judge(model != nullptr && reference ? made_whole(roots, *reference, *model) : roots,
              {.model = model});
    if (model == nullptr && moves(verdict)) {
        const auto along = order_along(roots);
        verdict = judge(roots, {.order = &along.order});
    }
    result.verdicts = std::move(verdict.rows);
    for (std::size_t i = 0; i < rungs.size(); ++i)
        if (rungs[i].status != RungStatus::ok)
            result.verdicts[i].reason = rungs[i].status == RungStatus::failed
                                            ? "the run failed"
                                            : "the run was not made, or not to its end";
    const auto figure = [&norm](double root) { return norm.squared ? root * root : root; };
    if (fit != nullptr)
        for (const auto& record : roots) {
            auto prediction = fit->ensemble->forecast({record.h, record.dt}, true);
            for (double* root : {&prediction.value, &prediction.low, &prediction.high})
                *root = figure(*root);
            result.predictions.push_back(std::move(prediction));
        }
    return result;
}

/// From rung to rung, of a ladder that is refined in Δt, whatever h does.
std::vector<std::optional<double>> orders_in_dt(const std::vector<RungResult>& rungs,
                                                std::size_t k) {
    auto records = records_of(rungs, k);
    for (auto& record : records)
        record.h = std::numeric_limits<double>::quiet_NaN();
    return observed_orders(records);
}

/// The order along the ladder with its interval, in the width that is refined.
std::string order_sentence(const std::string& width, const ColumnAnalysis& column) {
    const OrderInterval& order = column.by_width.front();
    return order.determined ? fmt::format("{}: order {:.3f} ± {:.3f} (95 %) in {}.", column.name,
                                          order.value, order.half_width(), width)
                            : fmt::format("{}: its order in {} is not determined: {}.", column.name,
                                          width, order.status);
}

bool is_square_of_another(const Measure& norm, const std::vector<Measure>& all) {
    return norm.squared && norm.name != norm.root() &&
           std::ranges::find(all, norm.root(), &Measure::name) != all.end();
}

/// The rungs whose orders mean something: not those close to the reference.
std::vector<RungResult> telling(const std::optional<ReferenceBlock>& reference,
                                const std::vector<RungResult>& rungs) {
    std::vector<RungResult> result;
    std::copy_if(rungs.begin(), rungs.end(), std::back_inserter(result),
                 [&](const RungResult& rung) {
                     return !reference || !reference->is_close_to(rung.rung, rungs);
                 });
    return result;
}

/// A sentence about the rungs whose errors quadrature leaves uncertain; empty when there are none.
std::string quadrature_remark(const std::vector<RungResult>& rungs,
                              const std::vector<Measure>& norms) {
    constexpr double worth_telling = 0.01;
    std::string named;
    for (const auto& run : rungs) {
        const auto worst = std::max_element(run.uncertainties.begin(), run.uncertainties.end());
        if (worst == run.uncertainties.end() || *worst <= worth_telling)
            continue;
        std::set<std::string> others; // a norm and its square are one
        for (std::size_t k = 0; k < run.uncertainties.size(); ++k)
            if (run.uncertainties[k] > worth_telling)
                others.insert(norms[k].root());
        const auto k = static_cast<std::size_t>(worst - run.uncertainties.begin());
        others.erase(norms[k].root());
        named += fmt::format(
            "{}s = {}: {} is uncertain by up to {:.2g} of itself{}", named.empty() ? "" : "; ",
            run.rung.elements, norms[k].root(), *worst,
            others.empty() ? "" : fmt::format(", {} by no more", fmt::join(others, ", ")));
    }
    if (named.empty())
        return {};
    return "Quadrature does not resolve what is integrated, in loads or norms: " + named +
           ". Errors may be off by far less; orders that they enter are not confirmed.";
}

/// Whether some error is printed in so few digits that an order of two of them may be 0.1 off: why
/// it moves is not to be guessed then.
bool is_coarsely_printed(const std::vector<RungResult>& rungs, std::size_t k) {
    constexpr double coarse = 0.05;
    const auto units = units_of(rungs, k, false);
    for (std::size_t i = 0; i < units.size(); ++i)
        if (!rungs[i].errors.empty() && units[i] > coarse * rungs[i].errors[k])
            return true;
    return false;
}

} // namespace

Series series_of(const LadderBlock& block, const Method& method) {
    return {"ladder", block.final_time, method, block.norms, block.rungs, block.until.has_value()};
}

LadderResult make_runs(const LadderBlock& block, const Method& method, const RunCall& run,
                       const Execution& execution) {
    Series series = series_of(block, method);
    LadderResult result{.rungs = run_series(series, run, execution)};
    if (block.until)
        result.refined = refine(block, series, result.rungs, run, execution);
    return result;
}

LadderResult analyse_ladder(const LadderBlock& block, const Method& method,
                            std::vector<RungResult> rungs, const StudiedSolver& solver,
                            const OrdersResult* orders) {
    const Series series = series_of(block, method);
    LadderResult result{.rungs = std::move(rungs)};
    if (block.says_orders && !series.measures.empty())
        result.analysis = analysis_of(series, result.rungs);
    const auto remarked = telling(solver.reference, result.rungs);
    const auto widths = solver.reference ? solver.reference->widths() : std::nullopt;
    for (std::size_t k = 0; k < series.measures.size(); ++k) {
        const Measure& norm = series.measures[k];
        const TwoTermFit* fit = orders != nullptr ? orders->fit_of(norm) : nullptr;
        result.norms.push_back(analysed(norm, result.rungs, k, fit, widths));
        auto roots = root_records_of(remarked, k, norm);
        std::erase_if(roots, [](const Refinement& record) { return !record.is_resolved(); });
        LadderNorm& shown = result.norms.back();
        auto remark = solver.remark ? solver.remark(series, result.rungs, k) : "";
        if (!norm.is_value)
            shown.remarks = order_remarks(
                norm, roots, fit != nullptr ? &fit->model : nullptr,
                solver.has_defect || !remark.empty() || is_coarsely_printed(result.rungs, k),
                fit != nullptr ? TermsKnown{fit->p_uncertainty(), fit->q_uncertainty(),
                                            fit->a_uncertainty, fit->b_uncertainty}
                               : TermsKnown{});
        if (result.analysis) {
            const ColumnAnalysis& column = result.analysis->columns[k];
            if (norm.is_value)
                shown.remarks = column.findings;
            else if (!is_square_of_another(norm, series.measures)) // which has said it
                shown.remarks.push_back(
                    order_sentence(result.analysis->widths.front().name, column));
            if (vanishes_at_the_finest(*result.analysis, column))
                shown.remarks.push_back(column.name + ": " + finest_is_zero +
                                        "; what is said is of the levels before it.");
            if (fit == nullptr && !norm.is_value && !column.verdicts.empty())
                shown.verdicts = column.verdicts;
            if (!norm.is_value && result.analysis->widths.front().name == "dt")
                shown.orders = orders_in_dt(result.rungs, k);
        }
        if (!remark.empty())
            shown.remarks.push_back(std::move(remark));
        if (const auto rounding = solver.rounding
                                      ? solver.rounding(series, result.rungs, result.rungs, k)
                                      : std::nullopt) {
            shown.rounding = rounding->most;
            std::ranges::fill(shown.orders, std::nullopt);
            shown.remarks = {norm.name + ": " + rounding->sentence};
            for (auto& row : shown.verdicts)
                if (row.verdict != Verdict::failed && row.verdict != Verdict::exact)
                    row = {Verdict::unresolved, rounding->reason};
        }
    }
    result.quadrature_remark = quadrature_remark(result.rungs, series.measures);
    if (!series.measures.empty() && solver.reference)
        result.reference_remark =
            reference_remark(*solver.reference, result.rungs, series.measures, solver.roughness);
    return result;
}

LadderResult run_ladder(const LadderBlock& block, const Method& method, const StudiedSolver& solver,
                        const OrdersResult* orders, const Execution& execution) {
    LadderResult made = make_runs(block, method, solver.run, execution);
    LadderResult result = analyse_ladder(block, method, std::move(made.rungs), solver, orders);
    result.refined = made.refined;
    return result;
}

} // namespace tvbeam

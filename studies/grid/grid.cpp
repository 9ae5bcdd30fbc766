#include "studies/grid/grid.hpp"

#include "studies/data/printed_digits.hpp"
#include "studies/grid/grid_refining.hpp"
#include "studies/orders/error_rows.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <utility>

namespace tvbeam {

namespace {

std::optional<TheoremConstants> constants_of(const std::string& theorem,
                                             const std::vector<Refinement>& squares) {
    TheoremConstants constants;
    constants.theorem = theorem;
    double finest_width = 0.0;
    bool first = true;
    for (const auto& record : squares) {
        if (!std::isfinite(record.error))
            continue;
        const double width = record.h * record.h + record.dt * record.dt;
        const double c = record.error / width;
        constants.least = first ? c : std::min(constants.least, c);
        constants.greatest = first ? c : std::max(constants.greatest, c);
        if (first || width < finest_width) {
            finest_width = width;
            constants.finest = c;
        }
        first = false;
    }
    return first ? std::nullopt : std::optional(constants);
}

std::optional<Refinement> reference_of(const std::optional<ReferenceBlock>& against,
                                       std::span<const Refinement> records) {
    auto reference = against ? against->widths() : std::nullopt;
    // A step that is the reference's may be smaller by rounding.
    if (reference)
        for (const auto& record : records)
            reference->dt = std::min(reference->dt, record.dt);
    return reference;
}

/// Of errors that a program printed: none is a square.
std::vector<double> rounding(std::span<const Refinement> records,
                             const std::vector<double>& units) {
    std::vector<double> errors;
    std::vector<double> meshes;
    std::vector<double> steps;
    for (const auto& record : records) {
        errors.push_back(record.error);
        meshes.push_back(record.h);
        steps.push_back(record.dt);
    }
    return deviations_of_rounding(errors, units, std::min(level_ratio(meshes), level_ratio(steps)),
                                  true);
}

/// The runs that refine both widths, in their order: the i-th mesh with the i-th step.
std::vector<RungResult> refined_in_both(const std::vector<RungResult>& runs) {
    std::map<std::int64_t, std::map<double, const RungResult*, std::greater<>>> grid;
    for (const auto& run : runs)
        grid[run.rung.elements][run.rung.dt] = &run;
    std::vector<RungResult> refined;
    for (const auto& [elements, line] : grid)
        if (refined.size() < line.size())
            refined.push_back(*std::next(line.begin(), std::ssize(refined))->second);
    return refined;
}

} // namespace

const TwoTermFit* OrdersResult::fit_of(const Measure& norm) const {
    const auto found = std::find_if(norms.begin(), norms.end(), [&](const NormOrders& orders) {
        return orders.norm == norm.root();
    });
    return found != norms.end() && found->fit.predicts() ? &found->fit : nullptr;
}

Series series_of(const OrdersBlock& block, const Method& method) {
    return {"orders", block.final_time, method, block.norms, block.grid};
}

bool vanishes_at_the_finest(const std::vector<RungResult>& runs, std::size_t k) {
    std::vector<ErrorRow> rows;
    for (const auto& run : runs) {
        const bool is_rounded = k < run.printed.size() && !run.printed[k].is_zero;
        const bool is_none = k >= run.errors.size() || (run.errors[k] == 0 && is_rounded);
        ErrorRow& row = rows.emplace_back();
        row.widths = {1.0 / static_cast<double>(run.rung.elements), run.rung.dt};
        if (!is_none)
            row.error = run.errors[k];
    }
    return vanishes_at_the_finest(rows);
}

OrdersResult analyse_grid(const std::vector<RungResult>& runs, const std::vector<Measure>& measures,
                          const std::optional<ReferenceBlock>& reference) {
    OrdersResult result;
    for (std::size_t k = 0; k < measures.size(); ++k) {
        const Measure& norm = measures[k];
        if (norm.is_value) {
            result.values.push_back(limit_of(norm.name, runs, k));
            continue;
        }
        const auto roots = root_records_of(runs, k, norm);
        const auto sigma = rounding(roots, units_of(runs, k, false));
        result.norms.push_back(
            {norm.root(), fit_two_term(roots, reference_of(reference, roots), sigma)});
        if (!norm.theorem.empty())
            result.corollary = constants_of(norm.theorem, records_of(runs, k));
    }
    return result;
}

OrdersResult run_orders(const OrdersBlock& block, const Method& method, const StudiedSolver& solver,
                        const Execution& execution) {
    const Series series = series_of(block, method);
    auto runs = run_series(series, solver.run, execution);
    std::optional<Refined> refined;
    if (block.until)
        refined = refine(block, series, runs, solver.run, execution);
    OrdersResult result = analyse_grid(runs, block.norms, solver.reference);
    const auto both = refined_in_both(runs);
    for (std::size_t k = 0; k < result.norms.size(); ++k)
        if (const auto rounding =
                solver.rounding ? solver.rounding(series, runs, both, k) : std::nullopt) {
            NormOrders& orders = result.norms[k];
            orders.fit = {};
            orders.fit.failure = rounding->sentence;
            orders.rounding = rounding->most;
        }
    if (!result.norms.empty() && solver.reference)
        result.reference_remark = grid_reference_remark(*solver.reference, runs, solver.roughness);
    result.runs = std::move(runs);
    result.refined = std::move(refined);
    return result;
}

} // namespace tvbeam

#include "studies/ladder/grid.hpp"

#include "studies/reference/reference_solution.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace tvbeam {

namespace {

std::optional<CorollaryConstants> corollary_constants(const std::vector<Refinement>& squares) {
    CorollaryConstants constants;
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

TwoTermOptions fit_options(const Scene& scene, std::span<const Refinement> records) {
    auto reference = reference_widths(scene);
    // A step that is the reference's may be smaller by rounding.
    if (reference)
        for (const auto& record : records)
            reference->dt = std::min(reference->dt, record.dt);
    return {.reference = reference};
}

} // namespace

const TwoTermModel* OrdersResult::model_of(const Norm& norm) const {
    const auto found = std::find_if(norms.begin(), norms.end(), [&](const NormOrders& orders) {
        return orders.norm == norm.root();
    });
    return found != norms.end() && found->fit.holds() ? &found->fit.model : nullptr;
}

OrdersResult run_orders(const Scene& scene, const OrdersBlock& block, const ProblemData& data,
                        const Execution& execution) {
    OrdersResult result;
    result.runs =
        run_rungs("orders", scene, block.norms, block.final_time, block.grid, data, execution);
    for (std::size_t k = 0; k < block.norms.size(); ++k) {
        const Norm& norm = block.norms[k];
        const auto roots = root_records_of(result.runs, k, norm);
        result.norms.push_back({norm.root(), fit_two_term(roots, fit_options(scene, roots))});
        if (norm.name == "corollary")
            result.corollary = corollary_constants(records_of(result.runs, k));
    }
    return result;
}

} // namespace tvbeam

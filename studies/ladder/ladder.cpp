#include "studies/ladder/ladder.hpp"

#include "studies/ladder/order_remarks.hpp"
#include "studies/ladder/round_off_remark.hpp"
#include "studies/reference/reference_solution.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

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

LadderNorm analysed(const Norm& norm, const std::vector<RungResult>& rungs, std::size_t k,
                    const TwoTermModel* model, const std::optional<Refinement>& reference) {
    LadderNorm result;
    result.norm = norm;
    result.orders = observed_orders(records_of(rungs, k));
    // Verdicts rest on the norm itself, in which the two terms of the error add up.
    const auto roots = root_records_of(rungs, k, norm);
    result.verdicts =
        judge(model != nullptr && reference ? made_whole(roots, *reference, *model) : roots,
              {.model = model})
            .rows;
    if (model != nullptr)
        for (const auto& record : roots) {
            const double root =
                error_against(reference.value_or(Refinement{}), *model, record.h, record.dt);
            result.predictions.emplace_back(norm.squared ? root * root : root);
        }
    return result;
}

/// The rungs whose orders mean something: not those close to the reference.
std::vector<RungResult> telling(const Scene& scene, const std::vector<RungResult>& rungs) {
    std::vector<RungResult> result;
    std::copy_if(rungs.begin(), rungs.end(), std::back_inserter(result),
                 [&](const RungResult& rung) {
                     return !scene.reference || !scene.reference->is_close_to(rung.rung);
                 });
    return result;
}

/// A sentence about the rungs whose errors quadrature leaves uncertain; empty when there are none.
std::string quadrature_remark(const std::vector<RungResult>& rungs,
                              const std::vector<Norm>& norms) {
    std::ostringstream named;
    named.precision(2);
    for (const auto& [rung, status, reason, seconds, counters, errors, uncertainties] : rungs) {
        const auto worst = std::max_element(uncertainties.begin(), uncertainties.end());
        if (worst == uncertainties.end() || *worst <= 0.01)
            continue;
        const auto k = static_cast<std::size_t>(worst - uncertainties.begin());
        named << (named.str().empty() ? "" : "; ") << "s = " << rung.elements << ": "
              << norms[k].root() << " is uncertain by " << *worst << " of itself";
    }
    if (named.str().empty())
        return {};
    return "Quadrature does not resolve what is integrated, in loads or norms: " + named.str() +
           ". Orders that these figures enter say nothing.";
}

} // namespace

LadderResult run_ladder(const Scene& scene, const LadderBlock& ladder, const ProblemData& data,
                        const OrdersResult* orders, const Execution& execution) {
    LadderResult result;
    result.rungs =
        run_rungs("ladder", scene, ladder.norms, ladder.final_time, ladder.rungs, data, execution);
    const auto remarked = telling(scene, result.rungs);
    for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
        const Norm& norm = ladder.norms[k];
        const TwoTermModel* model = orders != nullptr ? orders->model_of(norm) : nullptr;
        result.norms.push_back(analysed(norm, result.rungs, k, model, reference_widths(scene)));
        auto roots = root_records_of(remarked, k, norm);
        std::erase_if(roots, [](const Refinement& record) { return !record.is_resolved(); });
        result.norms.back().remarks = order_remarks(norm, roots, model);
        if (auto remark = round_off_remark(scene, data, ladder.final_time, result.rungs, norm, k);
            !remark.empty())
            result.norms.back().remarks.push_back(std::move(remark));
    }
    result.quadrature_remark = quadrature_remark(result.rungs, ladder.norms);
    if (!ladder.norms.empty())
        result.reference_remark = reference_remark(scene, result.rungs);
    return result;
}

} // namespace tvbeam

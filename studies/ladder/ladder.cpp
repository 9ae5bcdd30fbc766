#include "studies/ladder/ladder.hpp"

#include "studies/ladder/order_remarks.hpp"
#include "studies/ladder/round_off_remark.hpp"
#include "studies/reference/reference_solution.hpp"

#include <algorithm>
#include <iterator>

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

} // namespace

LadderResult run_ladder(const Scene& scene, const LadderBlock& ladder, const ProblemData& data,
                        const OrdersResult* orders, const Execution& execution) {
    LadderResult result;
    result.rungs =
        run_rungs("ladder", scene, ladder.norms, ladder.final_time, ladder.rungs, data, execution);
    const auto remarked = telling(scene, result.rungs);
    for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
        const Norm& norm = ladder.norms[k];
        // The constants of a model are those of its final time.
        const bool same_time = scene.orders && scene.orders->final_time == ladder.final_time;
        const TwoTermModel* model =
            orders != nullptr && same_time ? orders->model_of(norm) : nullptr;
        result.norms.push_back(analysed(norm, result.rungs, k, model, reference_widths(scene)));
        result.norms.back().remarks =
            order_remarks(norm, root_records_of(remarked, k, norm), model);
        if (auto remark = round_off_remark(scene, data, ladder.final_time, result.rungs, norm, k);
            !remark.empty())
            result.norms.back().remarks.push_back(std::move(remark));
    }
    if (!ladder.norms.empty())
        result.reference_remark = reference_remark(scene, result.rungs);
    return result;
}

} // namespace tvbeam

#include "studies/ladder.hpp"

#include "studies/order_remarks.hpp"

namespace tvbeam {

namespace {

LadderNorm analysed(const Norm& norm, const std::vector<RungResult>& rungs, std::size_t k,
                    const TwoTermModel* model) {
    LadderNorm result;
    result.norm = norm;
    result.orders = observed_orders(records_of(rungs, k));
    // Verdicts rest on the norm itself, in which the two terms of the error add up.
    const auto roots = root_records_of(rungs, k, norm);
    result.verdicts = judge(roots, {.model = model}).rows;
    if (model != nullptr)
        for (const auto& record : roots) {
            const double root = model->error(record.h, record.dt);
            result.predictions.emplace_back(norm.squared ? root * root : root);
        }
    result.remarks = order_remarks(norm, roots, model);
    return result;
}

} // namespace

LadderResult run_ladder(const Scene& scene, const LadderBlock& ladder, const ProblemData& data,
                        const OrdersResult* orders) {
    LadderResult result;
    for (const auto& rung : ladder.rungs)
        result.rungs.push_back(run_rung(scene, ladder.norms, ladder.final_time, rung, data));
    for (std::size_t k = 0; k < ladder.norms.size(); ++k)
        result.norms.push_back(
            analysed(ladder.norms[k], result.rungs, k,
                     orders != nullptr ? orders->model_of(ladder.norms[k]) : nullptr));
    return result;
}

} // namespace tvbeam

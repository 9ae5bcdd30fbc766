#include "studies/ladder.hpp"

#include "studies/observed_order.hpp"
#include "studies/order_remarks.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace tvbeam {

namespace {

RungResult run_rung(const Scene& scene, const LadderBlock& ladder, const Rung& rung,
                    const ProblemData& data) {
    const auto start = std::chrono::steady_clock::now();
    const RunResult run = tvbeam::run({.beam = scene.beam,
                                       .mesh = Mesh::uniform(rung.elements),
                                       .scheme = scene.scheme,
                                       .final_time = ladder.final_time,
                                       .steps = rung.steps,
                                       .norms = ladder.norms},
                                      data);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return {rung, run.status, run.reason, elapsed.count(), run.counters, run.errors, {}};
}

} // namespace

bool LadderResult::failed() const {
    return std::any_of(rungs.begin(), rungs.end(),
                       [](const RungResult& rung) { return rung.status != RunStatus::ok; });
}

LadderResult run_ladder(const Scene& scene, const LadderBlock& ladder, const ProblemData& data) {
    LadderResult result;
    for (const auto& norm : ladder.norms)
        result.norms.push_back(norm.name);
    for (const auto& rung : ladder.rungs) {
        result.rungs.push_back(run_rung(scene, ladder, rung, data));
        result.rungs.back().orders.resize(ladder.norms.size());
    }
    for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
        std::vector<Refinement> records;
        for (const auto& rung : result.rungs)
            records.push_back({.h = 1.0 / static_cast<double>(rung.rung.elements),
                               .dt = rung.rung.dt,
                               .error = rung.errors.empty()
                                            ? std::numeric_limits<double>::quiet_NaN()
                                            : rung.errors[k],
                               .seconds = rung.seconds});
        const auto orders = observed_orders(records);
        for (std::size_t i = 0; i < orders.size(); ++i)
            result.rungs[i].orders[k] = orders[i];
        const auto remarks = order_remarks(ladder.norms[k], records, orders);
        result.remarks.insert(result.remarks.end(), remarks.begin(), remarks.end());
    }
    return result;
}

} // namespace tvbeam

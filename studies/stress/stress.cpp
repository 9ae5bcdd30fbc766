#include "studies/stress/stress.hpp"

#include "studies/runs/parallel.hpp"

#include <algorithm>

namespace tvbeam {

std::int64_t StressResult::count(Outcome outcome) const {
    return std::count_if(cases.begin(), cases.end(),
                         [&](const StressCase& one) { return one.outcome == outcome; });
}

std::map<std::string, double> StressResult::figures() const {
    std::map<std::string, double> figures;
    if (!cases.empty()) {
        for (const Outcome outcome :
             {Outcome::certified, Outcome::refused, Outcome::stopped, Outcome::failed})
            figures[name_of(outcome)] = static_cast<double>(count(outcome));
        figures["cases"] = static_cast<double>(cases.size());
    }
    if (contraction) {
        figures["contraction_least"] = contraction->least_ratio();
        figures["contraction_greatest"] = contraction->greatest_ratio();
        figures["contraction_refused"] = static_cast<double>(contraction->refused());
    }
    if (roundoff) {
        figures["moment_floor"] = roundoff->greatest_moment_floor();
        figures["hermite_least"] = roundoff->least_hermite_ratio();
        figures["hermite_greatest"] = roundoff->greatest_hermite_ratio();
    }
    return figures;
}

double work_of(const StressParameters& parameters) {
    return static_cast<double>(parameters.elements) * static_cast<double>(parameters.steps);
}

StressResult run_stress(const StressBlock& block, const Execution& execution) {
    std::vector<const StressParameters*> all;
    std::vector<double> costs;
    for (const auto& sweep : block.sweeps)
        for (const auto& parameters : sweep.cases) {
            all.push_back(&parameters);
            costs.push_back(work_of(parameters));
        }
    std::vector<std::optional<StressCase>> cases(all.size());
    for_each_longest_first(costs, execution.jobs, [&](std::size_t i) {
        if (execution.finished != nullptr)
            cases[i] = execution.finished->find_case(i);
        if (cases[i]) {
            cases[i]->parameters = *all[i];
            execution.expect(-costs[i]);
        } else if (execution.advance(0.0)) {
            cases[i] = judge(*all[i]);
            if (execution.finished != nullptr)
                execution.finished->add_case(i, *cases[i]);
            execution.advance(costs[i]);
        }
    });
    StressResult result;
    for (auto& one : cases)
        if (one)
            result.cases.push_back(*std::move(one));
    result.interrupted = result.cases.size() < cases.size();
    if (block.contraction && execution.advance(0.0))
        result.contraction = measure_contraction(*block.contraction);
    if (block.roundoff && execution.advance(0.0))
        result.roundoff = measure_round_off(*block.roundoff);
    result.interrupted = result.interrupted || !execution.advance(0.0);
    return result;
}

} // namespace tvbeam

#include "studies/stress.hpp"

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

StressResult run_stress(const StressBlock& block) {
    StressResult result;
    for (const auto& sweep : block.sweeps)
        for (const auto& parameters : sweep.cases)
            result.cases.push_back(judge(parameters));
    if (block.contraction)
        result.contraction = measure_contraction(*block.contraction);
    if (block.roundoff)
        result.roundoff = measure_round_off(*block.roundoff);
    return result;
}

} // namespace tvbeam

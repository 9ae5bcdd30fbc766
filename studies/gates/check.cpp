#include "studies/gates/check.hpp"

namespace tvbeam {

CheckedExpectation held(const Metric& metric, double lowest, double highest, const Place& place) {
    return {.what = metric.what,
            .expected = metric_text(lowest) + " to " + metric_text(highest),
            .found = metric.value ? metric_text(*metric.value) : metric.absence,
            .place = place,
            // A figure that is not a number lies in no band.
            .holds = metric.value && *metric.value >= lowest && *metric.value <= highest};
}

std::vector<CheckedExpectation> check(const StudyResult& result) {
    std::vector<CheckedExpectation> checked;
    for (const auto& [lowest, highest, place, metrics] : result.scene.expectations)
        for (const auto& metric : metrics(result))
            checked.push_back(held(metric, lowest, highest, place));
    return checked;
}

} // namespace tvbeam

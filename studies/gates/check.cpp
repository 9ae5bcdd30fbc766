#include "studies/gates/check.hpp"

namespace tvbeam {

std::vector<CheckedExpectation> check(const StudyResult& result) {
    std::vector<CheckedExpectation> checked;
    for (const auto& [lowest, highest, place, metrics] : result.scene.expectations)
        for (const auto& [what, value, absence] : metrics(result))
            checked.push_back({.what = what,
                               .expected = metric_text(lowest) + " to " + metric_text(highest),
                               .found = value ? metric_text(*value) : absence,
                               .place = place,
                               // A figure that is not a number lies in no band.
                               .holds = value && *value >= lowest && *value <= highest});
    return checked;
}

} // namespace tvbeam

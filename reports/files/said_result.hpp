#pragma once

#include "studies/gates/expectation.hpp"
#include "studies/study.hpp"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace tvbeam {

/// All that a result says, but what is another number in the next run (times) or elsewhere (where
/// it comes from): its JSON, the figures of its studies, its sentences, and what its expectations
/// looked at beside it. Numbers have ten digits. Of a long list its digest stands there: how many,
/// the least, the greatest, the mean and a few of its numbers, or how many there are of each text;
/// of a long list of objects that of each key.
nlohmann::ordered_json said_by(const StudyResult& result,
                               const std::vector<CheckedExpectation>& checked);

} // namespace tvbeam

#pragma once

#include "studies/study.hpp"

#include <vector>

namespace tvbeam {

/// Holds a result against the expectations of its scene. A figure that the result does not have
/// does not meet any expectation: a failed run, an undefined order, or a fit without a model.
std::vector<CheckedExpectation> check(const StudyResult& result);

} // namespace tvbeam

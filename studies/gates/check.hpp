#pragma once

#include "studies/study.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// One expectation held against a result.
struct CheckedExpectation {
    std::string what;     ///< e.g. "ladder.theta_L2L2_sq: error at s = 40, dt = 2.5e-4"
    std::string expected; ///< e.g. "0.9 to 1.1"
    std::string found;    ///< the figure, or why there is none
    Place place;          ///< where the scene says so
    bool holds = false;
};

/// A metric held against a band. One that has no value does not meet any.
CheckedExpectation held(const Metric& metric, double lowest, double highest, const Place& place);

/// Holds a result against the expectations of its scene. A figure that the result does not have
/// does not meet any expectation: a failed run, an undefined order, or a fit without a model.
std::vector<CheckedExpectation> check(const StudyResult& result);

} // namespace tvbeam

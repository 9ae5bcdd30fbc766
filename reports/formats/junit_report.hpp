#pragma once

#include "studies/gates/check.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// One scene put through its expectations.
struct CheckedScene {
    std::string name;
    double seconds = 0.0;
    std::string error; ///< why a run of it failed; empty when none did
    std::vector<CheckedExpectation> expectations;

    [[nodiscard]] bool passed() const;
};

/// JUnit XML as CI services read it: a testsuite a scene, a testcase an expectation; a run that
/// failed is an error.
std::string junit_report(const std::vector<CheckedScene>& scenes);

} // namespace tvbeam

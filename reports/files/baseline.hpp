#pragma once

#include "studies/gates/check.hpp"
#include "studies/study.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// The errors of every run of some scenes, and the figures() of their evolutions and stress
/// studies that are above round-off, as JSON (schema tvbeam-baseline/1), to hold later runs
/// against. Throws InputError where two scenes have one name, or one has nothing to keep.
std::string baseline_of(const std::vector<StudyResult>& results);

/// A recorded baseline.
class Baseline {
public:
    /// Throws InputError when the file is missing or is not a baseline.
    explicit Baseline(const std::string& file);

    /// Holds a new result against what was recorded for its scene: every error within the relative
    /// tolerance of the recorded one, on both sides. A scene, run or norm that was not recorded, or
    /// that is not there any more, does not hold. The figures found are always those of the new
    /// result.
    [[nodiscard]] std::vector<CheckedExpectation> check(const StudyResult& result,
                                                        double tolerance) const;

private:
    std::string file_;
    std::string text_;
};

} // namespace tvbeam

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Something that two results say differently: a number, or a text; none where one does not have
/// it.
struct ResultDifference {
    std::string what; ///< e.g. "ladder.rungs s = 10, dt = 0.001: errors.theta_L2L2_sq"
    std::optional<std::string> first;
    std::optional<std::string> second;
    /// |second − first| over the greater of both; none where they are not two numbers.
    std::optional<double> relative;
};

struct ComparedResults {
    std::size_t equal = 0; ///< what is the same in both
    /// What was asked for, in the order of the scene; then what was found, the largest first.
    std::vector<ResultDifference> scene;
    std::vector<ResultDifference> results;
    /// What neither file holds, though the study has it: "stress: 30000 cases are more than …".
    std::vector<std::string> not_compared;
};

/// Compares two files that `tvbeam run --json` or `--out` has written, or the directories that hold
/// a result.json. Found numbers that differ by a part of at most `tolerance` of the greater are the
/// same, those in sentences too. Not compared: run times, where the results come from, and how many
/// runs were found again. Throws InputError where one is not such a file.
ComparedResults compare_results(const std::string& first, const std::string& second,
                                double tolerance = 0.0);

} // namespace tvbeam

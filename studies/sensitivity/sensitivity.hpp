#pragma once

#include "mms/given_problem.hpp"
#include "studies/study_kind.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A defect of the size 1, by name.
struct NamedDefect {
    std::string name;
    GivenData adds;
};

/// The block [sensitivity]: how large a defect must be for the scene's expectations to catch it.
struct SensitivityBlock {
    std::vector<NamedDefect> defects; ///< at least one
    double smallest = 1e-8;           ///< of the factors that scale them
    double largest = 1.0;
};

/// For each expectation the factor at which it first catches a defect, of those that are tried.
struct CaughtDefect {
    std::string name;
    std::vector<std::optional<double>> least; ///< none: at no factor that was tried

    /// By any expectation.
    [[nodiscard]] std::optional<double> least_of_all() const;
};

/// The record of a sensitivity study.
struct SensitivityResult {
    /// In words, e.g. "ladder.theta_L2L2: observed order", at all rungs together.
    std::vector<std::string> expectations;
    std::vector<std::string> violated; ///< without any defect, too; they are not among the others
    std::vector<CaughtDefect> defects;
    double smallest = 0.0; ///< the first factor that is tried
    bool interrupted = false;
};

/// Runs the studies of the scene's problem, but for those that are timed, again and again with the
/// defects times a factor. Decades are scanned from the smallest factor on; between the first at
/// which an expectation is violated and the one before, the least factor is sought by bisection of
/// the logarithm, to 5 % above; larger factors are not tried, and may be caught or not. So may
/// lesser ones between two decades, where a defect takes an error away before it adds to it. all:
/// the results without defects.
SensitivityResult find_sensitivity(const SensitivityBlock& block, const StudyResult& all,
                                   const StudyContext& context);

} // namespace tvbeam

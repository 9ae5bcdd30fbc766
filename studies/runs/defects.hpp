#pragma once

#include "core/problem.hpp"
#include "mms/given_problem.hpp"
#include "studies/runs/run.hpp"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace tvbeam {

struct Scene;

/// What a deliberate defect adds to the problem of a scene: in every run something else, as its
/// expressions may name h and dt.
class Defects {
public:
    Defects() = default; ///< none

    /// In all runs that the scene's studies make of its problem. Throws InputError as given_defect
    /// does.
    Defects(const GivenData& defect, const Scene& scene);

    [[nodiscard]] bool none() const { return by_run_.empty(); }

    /// These and others, of the same scene, times a factor.
    [[nodiscard]] Defects with(const Defects& others, double factor) const;

    /// The problem of a run: the scene's, and the defects.
    [[nodiscard]] ProblemData added_to(const ProblemData& problem, const Rung& rung) const;

private:
    std::map<std::pair<std::int64_t, double>, ProblemData> by_run_; ///< by elements and dt
};

} // namespace tvbeam

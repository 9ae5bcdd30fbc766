#pragma once

#include "studies/reference/reference_block.hpp"
#include "studies/runs/run.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// That every error of a measure is rounding: the scheme is exact for the solution. Or that it may
/// be, where fewer than three levels do not tell.
struct RoundingErrors {
    double most = 0;      ///< of the measure: no discretisation error is told from less
    std::string sentence; ///< said in place of what the orders mean, behind the measure's name
    std::string reason;   ///< of each row's verdict
};

/// A solver under study: how it is run, and what an analysis of its runs must know besides them.
struct StudiedSolver {
    RunCall run;

    /// What is measured costs a run nothing: a program prints it in any case.
    bool measures_for_nothing = false;

    /// A finer run that errors are measured against; none: the exact solution.
    std::optional<ReferenceBlock> reference = std::nullopt;

    /// A sentence on measure k along a ladder, from its finished runs; empty: there is none.
    using Remark =
        std::function<std::string(const Series&, const std::vector<RungResult>&, std::size_t k)>;
    Remark remark = {}; ///< on what limits it; an empty function: nothing ever does

    /// Of measure k: that its errors are rounding. refined: those of the runs that refine every
    /// width, in their order. An empty function: nothing says.
    std::function<std::optional<RoundingErrors>(const Series&, const std::vector<RungResult>& runs,
                                                const std::vector<RungResult>& refined,
                                                std::size_t k)>
        rounding = {};

    /// Its runs are made with a deliberate defect.
    bool has_defect = false;

    /// Why the solution is not smooth in time; empty: nothing says so.
    std::string roughness = {};
};

} // namespace tvbeam

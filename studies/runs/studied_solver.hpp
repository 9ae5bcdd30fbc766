#pragma once

#include "studies/reference/reference_block.hpp"
#include "studies/runs/run.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A solver under study: how it is run, and what an analysis of its runs must know besides them.
struct StudiedSolver {
    RunCall run;

    /// A finer run that errors are measured against; none: the exact solution.
    std::optional<ReferenceBlock> reference = std::nullopt;

    /// A sentence on measure k along a ladder, from its finished runs; empty: there is none.
    using Remark =
        std::function<std::string(const Series&, const std::vector<RungResult>&, std::size_t k)>;
    Remark remark = {}; ///< on what limits it; an empty function: nothing ever does
    Remark exact = {};  ///< that its errors are rounding: said in place of what their orders mean

    /// Its runs are made with a deliberate defect.
    bool has_defect = false;
};

} // namespace tvbeam

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

    /// A sentence on what limits measure k along a ladder, from its finished runs; empty: nothing
    /// does. An empty function: nothing ever does.
    std::function<std::string(const Series&, const std::vector<RungResult>&, std::size_t k)>
        remark = {};

    /// Its runs are made with a deliberate defect.
    bool has_defect = false;
};

} // namespace tvbeam

#pragma once

#include "studies/external/keeper.hpp"
#include "studies/external/solver_block.hpp"
#include "studies/runs/studied_solver.hpp"

#include <cstddef>
#include <string>

namespace tvbeam {

/// What can be told before anything runs: throws InputError where a placeholder is not known or has
/// nothing to stand for; where there is no such program, or an argument names a file beside the
/// scene that no run would find in its own directory.
void require_placeholders(const SolverBlock& solver, const std::vector<Series>& all);
void require_programs(const SolverBlock& solver, const std::vector<Series>& all);

/// Says of runs that differ in elements or dt, of which the program is told nothing: its command
/// and files are the same in both. Empty where there are none.
std::string remark_on_untold_widths(const SolverBlock& solver, const std::vector<Series>& all);

/// An external program as a solver under study. Each run has a directory of its own, with the
/// block's files in it, which is removed after it. A run fails, with the reason and the last lines
/// that it wrote, where one of the files is not any more what it was, and where it exits with
/// another code than 0, is killed, takes too long, or does not give each figure that is asked for
/// as one finite number, an error ≥ 0. Its processes are ended with it. Both must outlive the
/// result.
StudiedSolver external_runs(const SolverBlock& solver, const Keeper& keeper);

/// What runs are known again by: a digest of whatever their figures depend on, which is the
/// command, the contents of the files, the environment that the block gives and what it inherits of
/// where code is looked for (LD_LIBRARY_PATH, PYTHONPATH and the like), how figures are read, and
/// of a program that is none of the files its absolute path, size and time. The way to the scene,
/// as it was written, is no part of it. Several threads may call at a time. The block must outlive
/// it.
class RunIdentities {
public:
    explicit RunIdentities(const SolverBlock& solver) : solver_(solver) {}
    [[nodiscard]] std::string of(const Series& series, std::size_t level) const;

private:
    const SolverBlock& solver_;
};

} // namespace tvbeam

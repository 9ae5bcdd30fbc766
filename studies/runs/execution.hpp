#pragma once

#include "studies/runs/run.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

struct StressCase;

/// Told of work as it is done, by several threads at a time.
class Progress {
public:
    virtual ~Progress() = default;

    /// So much more is to be done, or, negative, less. Unit: work_of.
    virtual void expect(double work) = 0;

    /// So much of it has been done. false: what is left is to be left undone.
    virtual bool advance(double work) = 0;
};

/// Results of single runs, kept from an earlier attempt at the same scene and for a later one.
/// Asked and told by several threads at a time.
class FinishedRuns {
public:
    virtual ~FinishedRuns() = default;

    /// The result of run `index` of a series, if it is there.
    virtual std::optional<RungResult> find(const Series& series, std::size_t index) = 0;
    virtual void add(const Series& series, std::size_t index, const RungResult& result) = 0;

    /// The same for the cases of [stress], all sweeps in turn; found without its parameters.
    virtual std::optional<StressCase> find_case(std::size_t index) = 0;
    virtual void add_case(std::size_t index, const StressCase& result) = 0;
};

/// How the runs of a study are carried out. Nothing of it changes a result, but a study that is
/// interrupted lacks some.
struct Execution {
    int jobs = 1;                     ///< runs at a time, ≥ 1
    Progress* progress = nullptr;     ///< null: nobody is told
    FinishedRuns* finished = nullptr; ///< null: nothing is kept

    void expect(double work) const {
        if (progress != nullptr)
            progress->expect(work);
    }
    bool advance(double work) const { return progress == nullptr || progress->advance(work); }

    /// RunTask::advance of a run of so much work.
    [[nodiscard]] std::function<bool(std::int64_t)> steps_of(const Method& method,
                                                             const Rung& rung) const;
};

/// The result of run `index` of a series: one that was kept, or else a new one, which is kept
/// unless it was interrupted.
RungResult run_or_find(const Series& series, std::size_t index, const RunCall& run,
                       const Execution& execution);

/// Makes every run of the series, in up to `execution.jobs` threads; the results stand in the order
/// of the rungs and do not depend on the number of jobs, but for their seconds.
std::vector<RungResult> run_series(const Series& series, const RunCall& run,
                                   const Execution& execution);

} // namespace tvbeam

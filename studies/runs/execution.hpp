#pragma once

#include "studies/runs/run.hpp"

#include <any>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Told of work as it is done, by several threads at a time.
class Progress {
public:
    virtual ~Progress() = default;

    /// So much more is to be done, or, negative, less. Unit: work_of.
    virtual void expect(double work) = 0;

    /// So much of it has been done. false: what is left is to be left undone.
    virtual bool advance(double work) = 0;
};

/// Work of a study besides its series, in parts that are done apart from each other, in any order.
struct Parts {
    std::string study; ///< by which results are kept, e.g. "stress"
    std::size_t count = 0;
    std::function<double(std::size_t)> work;   ///< of a part; unit: work_of
    std::function<std::any(std::size_t)> make; ///< its result; several threads call at a time
    /// Whether a result says that it has failed; empty: none does.
    std::function<bool(const std::any&)> has_failed = {};
};

/// Results of single runs, kept from an earlier attempt at the same scene and for a later one.
/// Asked and told by several threads at a time.
class FinishedRuns {
public:
    virtual ~FinishedRuns() = default;

    /// The result of run `index` of a series, if it is there.
    virtual std::optional<RungResult> find(const Series& series, std::size_t index) = 0;
    virtual void add(const Series& series, std::size_t index, const RungResult& result) = 0;

    /// The same for a part of Parts::study; empty where it is not there.
    virtual std::any find_part(const std::string& study, std::size_t index) = 0;
    virtual void add_part(const std::string& study, std::size_t index, const std::any& result) = 0;
};

/// How the runs of a study are carried out. Nothing of it changes a result, but a study that is
/// interrupted lacks some.
struct Execution {
    int jobs = 1;                     ///< runs at a time, ≥ 1
    Progress* progress = nullptr;     ///< null: nobody is told
    FinishedRuns* finished = nullptr; ///< null: nothing is kept
    bool only_finished = false;       ///< what is not there is left undone, as interrupted

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

/// The same for those of its runs whose indices are given, in their order.
std::vector<RungResult> run_series(const Series& series, const std::vector<std::size_t>& indices,
                                   const RunCall& run, const Execution& execution);

/// The result of a part, in the same manner; empty where the work was interrupted before it.
std::any make_or_find(const Parts& parts, std::size_t index, const Execution& execution);

/// Makes every part, in up to `execution.jobs` threads. Those that are there, kept or new, are
/// given to `take`, one at a time and in any order.
void run_parts(const Parts& parts, const Execution& execution,
               const std::function<void(std::size_t index, std::any result)>& take);

} // namespace tvbeam

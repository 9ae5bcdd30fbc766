#include "studies/data/solver_analysis.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace tvbeam {

namespace {

SolverRun timed_run(const MeasuredSolver& solver, const Widths& widths) {
    SolverRun run;
    run.widths = widths;
    const auto start = std::chrono::steady_clock::now();
    try {
        run.errors = solver(widths.h, widths.dt);
    } catch (const std::exception& error) {
        run.failure = error.what();
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    run.seconds = elapsed.count();
    return run;
}

/// The records of one error; of a run that does not have it, with NaN.
std::vector<Refinement> records_of(const std::vector<SolverRun>& runs, const std::string& name) {
    std::vector<Refinement> records;
    records.reserve(runs.size());
    for (const SolverRun& run : runs) {
        Refinement record{.h = run.widths.h, .dt = run.widths.dt};
        if (const auto found = run.errors.find(name); found != run.errors.end())
            record.error = found->second;
        record.seconds = run.seconds;
        records.push_back(record);
    }
    return records;
}

} // namespace

SolverAnalysis analyse(const MeasuredSolver& solver, const std::vector<Widths>& widths) {
    SolverAnalysis analysis;
    for (const Widths& pair : widths)
        analysis.runs.push_back(timed_run(solver, pair));
    for (const SolverRun& run : analysis.runs)
        for (const auto& [name, error] : run.errors)
            if (!analysis.errors.contains(name))
                analysis.errors.emplace(name, analyse(records_of(analysis.runs, name)));
    return analysis;
}

} // namespace tvbeam

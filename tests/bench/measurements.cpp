#include "tests/bench/measurements.hpp"

#include "tests/bench/cases.hpp"

namespace tvbeam::bench {

namespace {

using Run = benchmark::BenchmarkReporter::Run;

double counter(const Run& run, const std::string& name, double otherwise) {
    const auto found = run.counters.find(name);
    return found == run.counters.end() ? otherwise : found->second.value;
}

double value(const Run& run, Reading reading) {
    const auto iterations = static_cast<double>(run.iterations);
    switch (reading) {
    case Reading::processor:
        return counter(run, processor_counter, run.cpu_accumulated_time / iterations);
    case Reading::wall:
        return run.real_accumulated_time / iterations;
    default:
        return counter(run, doubles_counter, 0.0);
    }
}

} // namespace

void Measurements::ReportRuns(const std::vector<Run>& runs) {
    for (const auto& run : runs) {
        if (run.run_type != Run::RT_Iteration)
            continue;
        if (run.error_occurred)
            failures_[run.run_name.function_name] = run.error_message;
        else
            runs_[run.run_name.function_name].push_back(run);
    }
}

std::vector<double> Measurements::of(const std::string& name, Reading reading) const {
    std::vector<double> values;
    if (const auto found = runs_.find(name); found != runs_.end())
        for (const auto& run : found->second)
            values.push_back(value(run, reading));
    return values;
}

} // namespace tvbeam::bench

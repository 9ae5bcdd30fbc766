#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace tvbeam::bench {

/// What is read of a case.
enum class Reading {
    processor, ///< seconds of processor time: what others take on a shared machine is not in it
    wall,      ///< seconds
    doubles    ///< held through the run
};

/// Collects the repetitions of every case, and prints nothing.
class Measurements final : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context& /*context*/) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override;

    /// One value a repetition; none for a case that was not measured.
    [[nodiscard]] std::vector<double> of(const std::string& name, Reading reading) const;

    /// Cases that failed, with the reason.
    [[nodiscard]] const std::map<std::string, std::string>& failures() const { return failures_; }

private:
    std::map<std::string, std::vector<Run>> runs_;
    std::map<std::string, std::string> failures_;
};

} // namespace tvbeam::bench

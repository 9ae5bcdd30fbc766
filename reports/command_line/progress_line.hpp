#pragma once

#include "studies/runs/execution.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace tvbeam {

/// A line on standard error that says how much of the work is done and how long the rest takes, at
/// the pace so far; after the first second, five times a second. What is left is left undone when
/// the end was asked for: a run ends within its next steps, a stress case with its last one.
class ProgressLine final : public Progress {
public:
    /// shown: whether there is a line; not, if standard error is not a terminal.
    explicit ProgressLine(bool shown);
    ~ProgressLine() override; ///< takes the line away
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ProgressLine(ProgressLine&&) = delete;
    ProgressLine& operator=(ProgressLine&&) = delete;

    void expect(double work) override;
    bool advance(double work) override;

private:
    void show(double done, double all);

    using Clock = std::chrono::steady_clock;
    bool shown_;
    Clock::time_point start_ = Clock::now();
    std::atomic<double> expected_ = 0.0;
    std::atomic<double> done_ = 0.0;
    std::mutex mutex_; // of the line
    Clock::time_point drawn_;
    bool visible_ = false;
};

/// "4 s", "3 min 20 s", "2 h 5 min"
std::string duration_text(double seconds);

} // namespace tvbeam

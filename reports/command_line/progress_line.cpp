#include "reports/command_line/progress_line.hpp"

#include "reports/command_line/end_requests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <unistd.h>

namespace tvbeam {

namespace {

constexpr std::chrono::milliseconds before_the_first{1000};
constexpr std::chrono::milliseconds between{200};
/// Of the work; below it the pace says little.
constexpr double telling = 0.01;

} // namespace

std::string duration_text(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    constexpr long minute = 60;
    constexpr long hour = 60 * minute;
    if (whole < minute)
        return fmt::format("{} s", whole);
    if (whole < hour)
        return fmt::format("{} min {} s", whole / minute, whole % minute);
    return fmt::format("{} h {} min", whole / hour, whole % hour / minute);
}

ProgressLine::ProgressLine(bool shown) : shown_(shown && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (visible_)
        std::fputs("\r\033[K", stderr);
}

void ProgressLine::expect(double work) {
    expected_ += work;
}

bool ProgressLine::advance(double work) {
    const double done = done_ += work;
    if (shown_ && Clock::now() - start_ >= before_the_first) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock && Clock::now() - drawn_ >= between)
            show(done, expected_);
    }
    return !EndRequests::made();
}

void ProgressLine::show(double done, double all) {
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    const double part = all > 0.0 ? std::clamp(done / all, 0.0, 1.0) : 0.0;
    std::string line = fmt::format("{:3.0f} % done", 100.0 * part);
    if (part > telling)
        line += ", " + duration_text(elapsed.count() * (1.0 - part) / part) + " to go";
    fmt::print(stderr, "\r{}\033[K", line);
    std::fflush(stderr);
    drawn_ = Clock::now();
    visible_ = true;
}

} // namespace tvbeam

#include "reports/command_line/progress_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>

#include <unistd.h>

namespace tvbeam {

namespace {

constexpr std::chrono::milliseconds before_the_first{1000};
constexpr std::chrono::milliseconds between{200};
/// Of the work; below it the pace says little.
constexpr double telling = 0.01;

constexpr std::array<int, 2> ending_signals{SIGINT, SIGTERM};

std::atomic<bool> asked_to_end = false;
static_assert(std::atomic<bool>::is_always_lock_free); // so that a signal handler may set it

/// When the end was asked for, in milliseconds; a signal handler reads and sets it.
std::atomic<std::int64_t> asked_at = 0;
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// `timeout` sends its signal twice, to the program and to its group: what comes so soon after the
/// first is the same request.
constexpr std::int64_t same_request = 500;

extern "C" void ask_to_end(int signal) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t milliseconds = now.tv_sec * 1000 + now.tv_nsec / 1'000'000;
    if (!asked_to_end.exchange(true)) {
        asked_at = milliseconds;
    } else if (milliseconds - asked_at >= same_request) {
        std::signal(signal, SIG_DFL); // NOLINT(cert-sig30-c): for the signal being handled
        std::raise(signal);
    }
}

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

EndRequests::EndRequests() {
    for (const int signal : ending_signals)
        if (std::signal(signal, ask_to_end) == SIG_IGN)
            std::signal(signal, SIG_IGN);
}

EndRequests::~EndRequests() {
    for (const int signal : ending_signals)
        if (std::signal(signal, SIG_DFL) == SIG_IGN)
            std::signal(signal, SIG_IGN);
}

bool EndRequests::made() {
    return asked_to_end;
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

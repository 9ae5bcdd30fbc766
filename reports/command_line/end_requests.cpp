#include "reports/command_line/end_requests.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <utility>

#include <semaphore.h>
#include <unistd.h>

namespace tvbeam {

namespace {

constexpr std::array<int, 3> ending_signals{SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> asked_to_end = false;
static_assert(std::atomic<bool>::is_always_lock_free); // so that a signal handler may set it

/// When the end was asked for, in milliseconds; a signal handler reads and sets it.
std::atomic<std::int64_t> asked_at = 0;
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// `timeout` sends its signal twice, to the program and to its group: what comes so soon after the
/// first is the same request.
constexpr std::int64_t same_request = 500;

/// For what the watching thread waits for; a signal handler may post it.
sem_t wake;

std::chrono::duration<double> seconds_of(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// For work to end by itself: of computing, which a busy machine gives late, and at most.
constexpr std::chrono::duration<double> grace{0.1};
constexpr std::chrono::duration<double> longest_grace{2.0};
constexpr int run_failed = 3; // the exit code

extern "C" void ask_to_end(int signal) {
    const int error = errno;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t milliseconds = now.tv_sec * 1000 + now.tv_nsec / 1'000'000;
    if (!asked_to_end.exchange(true)) {
        asked_at = milliseconds;
        sem_post(&wake);
    } else if (milliseconds - asked_at >= same_request) {
        std::signal(signal, SIG_DFL); // NOLINT(cert-sig30-c): for the signal being handled
        std::raise(signal);
    }
    errno = error;
}

} // namespace

EndRequests::EndRequests(std::function<void()> abandon) : abandon_(std::move(abandon)) {
    sem_init(&wake, 0, 0);
    watcher_ = std::jthread([this] { watch(); });
    for (const int signal : ending_signals)
        if (std::signal(signal, ask_to_end) == SIG_IGN)
            std::signal(signal, SIG_IGN);
}

EndRequests::~EndRequests() {
    for (const int signal : ending_signals)
        if (std::signal(signal, SIG_DFL) == SIG_IGN)
            std::signal(signal, SIG_IGN);
    settle();
    sem_post(&wake);
    watcher_.join();
    sem_destroy(&wake);
}

void EndRequests::settle() {
    Phase before = Phase::working;
    if (!phase_.compare_exchange_strong(before, Phase::settled) && before == Phase::abandoned)
        for (;;)
            pause(); // the program is being ended
}

void EndRequests::watch() {
    while (sem_wait(&wake) != 0) // a signal cut it short
        ;
    const auto start = seconds_of(CLOCK_MONOTONIC);
    const auto computed = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    while (phase_ == Phase::working) {
        const auto waited = seconds_of(CLOCK_MONOTONIC) - start;
        const bool over =
            waited >= longest_grace ||
            (waited >= grace && seconds_of(CLOCK_PROCESS_CPUTIME_ID) - computed >= grace);
        Phase before = Phase::working;
        if (over && phase_.compare_exchange_strong(before, Phase::abandoned)) {
            try {
                abandon_();
            } catch (const std::exception& error) {
                std::fprintf(stderr, "tvbeam: %s\n", error.what());
            }
            std::_Exit(run_failed);
        }
        constexpr std::chrono::milliseconds between{5};
        std::this_thread::sleep_for(between);
    }
}

bool EndRequests::made() {
    return asked_to_end;
}

} // namespace tvbeam

#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace tvbeam {

/// As long as it exists, Ctrl-C, a polite kill and a terminal that goes (SIGINT, SIGTERM, SIGHUP)
/// ask for the end; a second one, half a second later or more, ends the program at once. A signal
/// that the caller of the program has set to be ignored is. Where none exists, as while scenes are
/// read, the first ends the program.
///
/// Work that asks made() often enough ends by itself and is reported. Work that does not, because
/// one array takes long, is left as it is after 0.1 s of computing: `abandon` is called, in
/// another thread, and the program ends with exit code 3.
class EndRequests {
public:
    explicit EndRequests(std::function<void()> abandon);
    ~EndRequests();
    EndRequests(const EndRequests&) = delete;
    EndRequests& operator=(const EndRequests&) = delete;
    EndRequests(EndRequests&&) = delete;
    EndRequests& operator=(EndRequests&&) = delete;

    static bool made(); ///< since the program began

    /// The work has come to its end, and nothing is abandoned any more.
    void settle();

private:
    void watch();

    enum class Phase { working, settled, abandoned };
    std::function<void()> abandon_;
    std::atomic<Phase> phase_ = Phase::working;
    std::jthread watcher_;
};

} // namespace tvbeam

#include "studies/external/process.hpp"

#include "studies/external/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tvbeam {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_questions{100};
constexpr std::chrono::seconds before_the_kill{1};
constexpr std::size_t shown_lines = 5;
/// After the program's end its pipe may still hold this much; who writes more was left behind.
constexpr std::size_t most_after_the_end = std::size_t{1} << 20U;

class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&&) = delete;
    Descriptor& operator=(Descriptor&&) = delete;

    [[nodiscard]] int number() const { return number_; }
    void set(int number) {
        close();
        number_ = number;
    }
    void close() {
        if (number_ >= 0)
            ::close(number_);
        number_ = -1;
    }

private:
    int number_;
};

struct Pipe {
    Pipe() {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
        read.set(ends[0]);
        write.set(ends[1]);
        fcntl(ends[0], F_SETFL, O_NONBLOCK);
    }
    Descriptor read;
    Descriptor write;
};

/// No handler of this process's runs in a new one that still has its memory.
class BlockedSignals {
public:
    BlockedSignals() {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~BlockedSignals() { release(); }
    BlockedSignals(const BlockedSignals&) = delete;
    BlockedSignals& operator=(const BlockedSignals&) = delete;
    BlockedSignals(BlockedSignals&&) = delete;
    BlockedSignals& operator=(BlockedSignals&&) = delete;

    void release() const { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

private:
    sigset_t before_{};
};

/// A handler is not to run in the new process before it has become the program; what this one was
/// begun without, as by nohup, the program goes without too.
void forget_handler(int signal) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN &&
        action.sa_handler != SIG_DFL)
        std::signal(signal, SIG_DFL);
}

/// Texts as exec wants them.
std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    result.reserve(texts.size() + 1);
    for (auto& text : texts)
        result.push_back(text.data());
    result.push_back(nullptr);
    return result;
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& own) {
    std::vector<std::string> all;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string text = *entry;
        if (!own.contains(text.substr(0, text.find('='))))
            all.push_back(text);
    }
    for (const auto& [name, value] : own)
        all.push_back(fmt::format("{}={}", name, value));
    return all;
}

std::string ending_of(int status) {
    if (WIFEXITED(status))
        return WEXITSTATUS(status) == 0 ? "" : "exit " + std::to_string(WEXITSTATUS(status));
    const int signal = WTERMSIG(status);
    return "killed by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

/// One run of a program, from fork to its end.
class Process {
public:
    Process(const ProcessTask& task, const Keeper& keeper)
        : task_(task), keeper_(keeper), output_(task.line), errors_([](const std::string&) {}) {}

    ProcessResult run() {
        begin();
        watch();
        end();
        return std::move(result_);
    }

private:
    void begin() {
        std::vector<std::string> words{task_.program.string()};
        words.insert(words.end(), task_.arguments.begin(), task_.arguments.end());
        auto environment = environment_with(task_.environment);
        const auto arguments = pointers(words);
        const auto variables = pointers(environment);
        Pipe failure; // tells why exec failed; closes where it did not
        start_ = Clock::now();
        const BlockedSignals blocked;
        // The new process has this one's memory until it has become the program, and this thread
        // waits for that: a copy of the memory's tables would take longer than a small program.
        process_ = vfork(); // NOLINT(clang-analyzer-*): the calls of become() allocate nothing
        if (process_ == 0)
            become(arguments.data(), variables.data(), failure.write.number(), blocked);
        if (process_ < 0)
            throw std::system_error(errno, std::generic_category(), "cannot begin a process");
        standard_output_.write.close();
        standard_error_.write.close();
        failure.write.close();
        fcntl(failure.read.number(), F_SETFL, 0);
        int error = 0;
        ssize_t count = 0;
        while ((count = read(failure.read.number(), &error, sizeof error)) < 0 && errno == EINTR) {
        }
        if (count == sizeof error)
            result_.failure = "cannot be run: " + std::generic_category().message(error);
        // The declaration of glibc 2.36 is for C alone.
        ended_.set(static_cast<int>(syscall(SYS_pidfd_open, process_, 0)));
        if (ended_.number() < 0) {
            const int reason = errno;
            end();
            throw std::system_error(reason, std::generic_category(), "cannot watch a process");
        }
    }

    /// In the new process: nothing but system calls.
    [[noreturn, gnu::noinline]] void become(char* const* arguments, char* const* variables,
                                            int failure, const BlockedSignals& blocked) const {
        const pid_t own = getpid();
        setpgid(own, own);
        keeper_.begun(own);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        const int nowhere = open("/dev/null", O_RDONLY);
        dup2(nowhere, STDIN_FILENO);
        dup2(standard_output_.write.number(), STDOUT_FILENO);
        dup2(standard_error_.write.number(), STDERR_FILENO);
        for (int signal = 1; signal < NSIG; ++signal)
            forget_handler(signal);
        std::signal(SIGPIPE, SIG_DFL); // which tvbeam ignores
        blocked.release();
        if (chdir(task_.directory.c_str()) == 0)
            execve(task_.program.c_str(), arguments, variables);
        const int error = errno;
        [[maybe_unused]] const auto count = write(failure, &error, sizeof error);
        _exit(127);
    }

    /// Until the program has ended.
    void watch() {
        std::array<pollfd, 3> watched{{{standard_output_.read.number(), POLLIN, 0},
                                       {standard_error_.read.number(), POLLIN, 0},
                                       {ended_.number(), POLLIN, 0}}};
        auto asked = start_;
        while (true) {
            poll(watched.data(), watched.size(), static_cast<int>(until_a_question().count()));
            if ((watched[0].revents != 0 && !take(watched[0].fd, output_)))
                watched[0].fd = -1;
            if ((watched[1].revents != 0 && !take(watched[1].fd, errors_)))
                watched[1].fd = -1;
            if (watched[2].revents != 0)
                return;
            const auto now = Clock::now();
            if (now - asked >= between_questions || is_over(now)) {
                asked = now;
                question(now);
            }
        }
    }

    [[nodiscard]] bool is_over(Clock::time_point now) const {
        const std::chrono::duration<double> elapsed = now - start_;
        return task_.timeout && !told_to_end_ && elapsed.count() > *task_.timeout;
    }

    /// Not beyond the time-out, which would else be noticed late.
    [[nodiscard]] std::chrono::milliseconds until_a_question() const {
        if (!task_.timeout || told_to_end_)
            return between_questions;
        const std::chrono::duration<double> elapsed = Clock::now() - start_;
        const double left = std::max(0.0, *task_.timeout - elapsed.count());
        return left > 1.0 ? between_questions
                          : std::min(between_questions,
                                     std::chrono::milliseconds(1 + std::lround(1e3 * left)));
    }

    /// One buffer of what there is; false: there will be no more.
    static bool take(int descriptor, OutputLines& lines) {
        std::array<char, 65536> buffer;
        const ssize_t count = read(descriptor, buffer.data(), buffer.size());
        if (count > 0)
            lines.take({buffer.data(), static_cast<std::size_t>(count)});
        return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
    }

    /// Whether the program is to be ended, and how.
    void question(Clock::time_point now) {
        if (!told_to_end_) {
            if (is_over(now))
                timed_out_ = true;
            else if (!task_.go_on())
                result_.interrupted = true;
            else
                return;
            told_to_end_ = now;
            kill(-process_, SIGTERM);
            kill(-process_, SIGCONT);
        } else if (now - *told_to_end_ >= before_the_kill) {
            kill(-process_, SIGKILL);
        }
    }

    void end() {
        // The group's number is nobody else's until its first process is waited for.
        kill(-process_, SIGKILL);
        int status = 0;
        pid_t waited = 0;
        while ((waited = waitpid(process_, &status, 0)) < 0 && errno == EINTR) {
        }
        keeper_.ended(process_);
        const std::chrono::duration<double> elapsed = Clock::now() - start_;
        result_.seconds = elapsed.count();
        drain(standard_output_.read.number(), output_);
        drain(standard_error_.read.number(), errors_);
        output_.finish();
        result_.last_lines = errors_.last_lines(shown_lines, task_.directory);
        result_.are_of_errors = !result_.last_lines.empty();
        if (!result_.are_of_errors)
            result_.last_lines = output_.last_lines(shown_lines, task_.directory);
        if (timed_out_)
            result_.failure = "timed out";
        else if (result_.failure.empty())
            // The system keeps no statuses for whoever ignores SIGCHLD.
            result_.failure =
                waited == process_ ? ending_of(status) : "it is not known how it ended";
        // A scheduler ends all of a job at once: what was asked to end with us has not failed,
        // whether a signal ended it or it heard one and says so by its exit.
        if (!result_.failure.empty() && !task_.go_on())
            result_.interrupted = true;
    }

    static void drain(int descriptor, OutputLines& lines) {
        std::array<char, 65536> buffer;
        for (std::size_t taken = 0; taken < most_after_the_end;) {
            const ssize_t count = read(descriptor, buffer.data(), buffer.size());
            if (count <= 0)
                return;
            lines.take({buffer.data(), static_cast<std::size_t>(count)});
            taken += static_cast<std::size_t>(count);
        }
    }

    const ProcessTask& task_;
    const Keeper& keeper_;
    OutputLines output_;
    OutputLines errors_;
    Pipe standard_output_;
    Pipe standard_error_;
    Descriptor ended_; ///< readable when the program has ended
    pid_t process_ = -1;
    Clock::time_point start_;
    std::optional<Clock::time_point> told_to_end_;
    bool timed_out_ = false;
    ProcessResult result_;
};

} // namespace

ProcessResult run_process(const ProcessTask& task, const Keeper& keeper) {
    return Process(task, keeper).run();
}

} // namespace tvbeam

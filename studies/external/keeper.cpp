#include "studies/external/keeper.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <random>
#include <string>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tvbeam {

namespace {

/// Another thread may have been within an allocation when this process was forked: it allocates
/// nothing, and leaves the removing to a program.
void remove_whole(const char* directory) {
    // What was killed a moment ago may still be writing.
    for (int attempt = 0; attempt < 20 && access(directory, F_OK) == 0; ++attempt) {
        if (attempt > 0)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        const pid_t remover = fork();
        if (remover == 0) {
            execlp("rm", "rm", "-rf", "--", directory, nullptr);
            execl("/bin/rm", "rm", "-rf", "--", directory, nullptr); // whatever PATH says
            _exit(127);
        }
        while (waitpid(remover, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
}

/// As many as run at a time; jobs are far fewer.
constexpr std::size_t most_groups = 4096;

/// Notes the groups that begin and end until the pipe closes: with its other end, this process's
/// parent is gone.
[[noreturn]] void keep(int pipe, const char* directory) {
    setsid(); // no Ctrl-C of a terminal is for this one
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        std::signal(signal, SIG_IGN);
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        dup2(nowhere, standard);
    std::array<pid_t, most_groups> groups{}; // 0: none
    const auto replace = [&](pid_t old, pid_t with) {
        const auto at = std::find(groups.begin(), groups.end(), old);
        if (at != groups.end())
            *at = with;
    };
    pid_t group = 0;
    while (true) {
        const ssize_t count = read(pipe, &group, sizeof group);
        if (count < 0 && errno == EINTR)
            continue;
        if (count != sizeof group)
            break;
        if (group > 0)
            replace(0, group);
        else
            replace(-group, 0);
    }
    for (const pid_t left : groups)
        if (left > 0)
            kill(-left, SIGKILL);
    remove_whole(directory);
    _exit(0);
}

} // namespace

Keeper::Keeper() {
    // Its name is known to both before it is there: no moment is without somebody to remove it.
    std::random_device random;
    directory_ = std::filesystem::temp_directory_path() /
                 ("tvbeam-runs-" + std::to_string(getpid()) + "-" + std::to_string(random()) +
                  std::to_string(random()));
    int ends[2] = {-1, -1};
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
    process_ = fork();
    if (process_ < 0)
        throw std::system_error(errno, std::generic_category(), "cannot begin a process");
    if (process_ == 0) {
        close(ends[1]);
        keep(ends[0], directory_.c_str());
    }
    close(ends[0]);
    pipe_ = ends[1];
    if (mkdir(directory_.c_str(), S_IRWXU) != 0) {
        const int error = errno;
        kill(process_, SIGKILL); // it would remove what is not its own
        close(pipe_);
        waitpid(process_, nullptr, 0);
        throw std::system_error(error, std::generic_category(),
                                "cannot make the directory " + directory_.string());
    }
}

Keeper::~Keeper() {
    close(pipe_);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void Keeper::tell(pid_t group) const {
    // Shorter than what a pipe takes in one piece; the reader never tires.
    while (write(pipe_, &group, sizeof group) < 0 && errno == EINTR) {
    }
}

} // namespace tvbeam

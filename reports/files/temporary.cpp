#include "reports/files/temporary.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <string_view>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace tvbeam {

namespace {

/// Processes are told apart by their number on one machine only.
const std::string& prefix() {
    static const std::string text = [] {
        std::array<char, 65> host{};
        gethostname(host.data(), host.size() - 1);
        return std::string(".tvbeam-") + host.data() + "-";
    }();
    return text;
}

/// The process in the name of a temporary; 0 where it is none of this machine.
pid_t process_in(std::string_view name) {
    if (!name.starts_with(prefix()))
        return 0;
    name.remove_prefix(prefix().size());
    pid_t process = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
    return error == std::errc() && *end == '-' ? process : 0;
}

bool is_mine(const std::filesystem::path& path) {
    struct stat status = {};
    return lstat(path.c_str(), &status) == 0 && status.st_uid == geteuid();
}

} // namespace

std::filesystem::path temporary_path(const std::filesystem::path& directory) {
    static std::atomic<unsigned> number = 0;
    return directory / (prefix() + std::to_string(getpid()) + "-" + std::to_string(number++));
}

void remove_left_behind(const std::filesystem::path& directory) {
    std::error_code error;
    for (std::filesystem::directory_iterator entry(directory, error), end; !error && entry != end;
         entry.increment(error)) {
        const pid_t process = process_in(entry->path().filename().native());
        if (process <= 0 || kill(process, 0) == 0 || errno != ESRCH || !is_mine(entry->path()))
            continue;
        std::error_code ignored;
        std::filesystem::remove_all(entry->path(), ignored);
    }
}

} // namespace tvbeam

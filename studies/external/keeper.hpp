#pragma once

#include <filesystem>

#include <sys/types.h>

namespace tvbeam {

/// A directory for the runs of programs, which is removed with all that it holds, and a process
/// beside this one that sees to it also where this one is killed: it then ends the process groups
/// that are left, and removes the directory.
class Keeper {
public:
    /// Begins the process, and makes the directory among the temporary files. Throws
    /// std::system_error.
    Keeper();
    ~Keeper();
    Keeper(const Keeper&) = delete;
    Keeper& operator=(const Keeper&) = delete;
    Keeper(Keeper&&) = delete;
    Keeper& operator=(Keeper&&) = delete;

    [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }

    /// A group is to be ended with this process, or has ended. The first is called by the group's
    /// first process, between vfork and exec: it does nothing else than write.
    void begun(pid_t group) const { tell(group); }
    void ended(pid_t group) const { tell(-group); }

private:
    void tell(pid_t group) const;

    std::filesystem::path directory_;
    int pipe_ = -1;
    pid_t process_ = -1;
};

} // namespace tvbeam

#pragma once

#include <filesystem>

namespace tvbeam {

/// As long as it exists, no other program has one of this file: it waits for theirs. A file that is
/// not there is made, and goes again where nothing was put in its place. There is none of a file
/// that cannot be opened for writing, and on file systems that have no locks.
class FileLock {
public:
    explicit FileLock(std::filesystem::path file);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    FileLock(FileLock&&) = delete;
    FileLock& operator=(FileLock&&) = delete;

private:
    [[nodiscard]] bool is_named() const; ///< the file that is open is the one of the name

    std::filesystem::path file_;
    bool made_;
    int descriptor_ = -1;
};

} // namespace tvbeam

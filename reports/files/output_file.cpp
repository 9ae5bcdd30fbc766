#include "reports/files/output_file.hpp"

#include "reports/files/descriptor.hpp"
#include "reports/files/temporary.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace tvbeam {

namespace {

std::string reason() {
    return std::generic_category().message(errno);
}

/// A new file of this user's in the directory, open for writing; −1 and errno.
int make_temporary(const std::filesystem::path& directory, std::filesystem::path& path) {
    constexpr int attempts = 100; // somebody else may have made files of such names
    int descriptor = -1;
    for (int i = 0; i < attempts && descriptor < 0; ++i) {
        path = temporary_path(directory);
        descriptor = uncut(
            [&] { return open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
        if (descriptor < 0 && errno != EEXIST)
            break;
    }
    if (descriptor < 0)
        path.clear();
    return descriptor;
}

} // namespace

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    if (std::filesystem::is_directory(path_, error))
        throw OutputError("cannot write '" + path_.string() +
                          "': it is a directory; name a file in it");
    const bool exists = std::filesystem::exists(path_, error);
    if (error) // a name that is too long, say
        throw OutputError("cannot write '" + path_.string() + "': " + error.message());
    if (exists) {
        // What a link points to is replaced, not the link; and a device or pipe is written to, not
        // replaced.
        if (std::filesystem::is_regular_file(path_, error)) {
            path_ = std::filesystem::canonical(path_, error);
        } else {
            descriptor_ = uncut([&] { return open(path_.c_str(), O_WRONLY | O_CLOEXEC); });
            if (descriptor_ < 0)
                fail();
            return;
        }
    }
    if (access(directory().c_str(), W_OK | X_OK) != 0)
        fail();
    remove_left_behind(directory());
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0)
        close(descriptor_);
    if (!temporary_.empty())
        unlink(temporary_.c_str());
}

std::filesystem::path OutputFile::directory() const {
    return path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".");
}

void OutputFile::fail() const {
    throw OutputError("cannot write '" + path_.string() + "': " + reason());
}

void OutputFile::prepare(const LongText& text) {
    const bool replaced = descriptor_ < 0;
    if (replaced)
        descriptor_ = make_temporary(directory(), temporary_);
    if (descriptor_ < 0)
        fail();
    text.tell([this](std::string_view piece) {
        if (!write_whole(descriptor_, piece))
            fail();
    });
    if (!replaced)
        return;
    if (uncut([&] { return fsync(descriptor_); }) != 0)
        fail();
    // A directory of results has more files than a process may have open. What close says cut
    // short is closed.
    const int closed = close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 && errno != EINTR)
        fail();
}

void OutputFile::publish() {
    if (temporary_.empty())
        return;
    const auto exchange = [&] {
        return renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE);
    };
    if (uncut(exchange) == 0) {
        state_ = State::exchanged;
        return;
    }
    // There is none yet, or the file system exchanges nothing.
    if (errno != ENOENT && errno != EINVAL && errno != ENOSYS && errno != ENOTSUP)
        fail();
    const bool added = errno == ENOENT;
    if (uncut([&] { return rename(temporary_.c_str(), path_.c_str()); }) != 0)
        fail();
    temporary_.clear();
    state_ = added ? State::added : State::older;
}

void OutputFile::revoke() {
    if (state_ == State::exchanged)
        rename(temporary_.c_str(), path_.c_str());
    else if (state_ == State::added)
        unlink(path_.c_str());
    state_ = State::older;
}

void OutputFile::sync() const {
    if (descriptor_ < 0 && !sync_directory(directory()))
        fail();
}

void OutputFile::commit(const LongText& text) {
    prepare(text);
    publish();
    sync();
}

void write_standard_output(const LongText& text) {
    const auto require = [](bool written) {
        if (!written && errno == EPIPE)
            throw ClosedPipe("cannot write to standard output: nobody reads it");
        if (!written)
            throw OutputError("cannot write to standard output: " + reason());
    };
    // What the library of the command line has printed comes first.
    require(std::fflush(stdout) == 0);
    text.tell([&](std::string_view piece) { require(write_whole(STDOUT_FILENO, piece)); });
}

} // namespace tvbeam

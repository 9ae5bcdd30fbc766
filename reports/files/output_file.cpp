#include "reports/files/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace tvbeam {

namespace {

std::string reason() {
    return std::generic_category().message(errno);
}

} // namespace

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    if (std::filesystem::is_directory(path_, error))
        throw OutputError("cannot write '" + path_.string() +
                          "': it is a directory; name a file in it");
    if (std::filesystem::exists(path_, error)) {
        // What a link points to is replaced, not the link; and a device or pipe is written to, not
        // replaced.
        path_ = std::filesystem::canonical(path_, error);
        if (!std::filesystem::is_regular_file(path_, error)) {
            descriptor_ = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
            if (descriptor_ < 0)
                throw OutputError("cannot write '" + path_.string() + "': " + reason());
            return;
        }
    }
    const auto directory =
        path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".");
    if (access(directory.c_str(), W_OK | X_OK) != 0)
        throw OutputError("cannot write '" + path_.string() + "': " + reason());
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0)
        close(descriptor_);
    if (!temporary_.empty())
        unlink(temporary_.c_str());
}

void OutputFile::fail() const {
    throw OutputError("cannot write '" + path_.string() + "': " + reason());
}

void OutputFile::prepare(const std::string& text) {
    if (descriptor_ < 0) {
        temporary_ = path_.string() + ".XXXXXX";
        descriptor_ = mkstemp(temporary_.data());
        if (descriptor_ < 0)
            fail();
    }
    for (std::size_t written = 0; written < text.size();) {
        const ssize_t count = write(descriptor_, text.data() + written, text.size() - written);
        if (count < 0 && errno != EINTR)
            fail();
        if (count > 0)
            written += static_cast<std::size_t>(count);
    }
    if (temporary_.empty())
        return;
    // mkstemp makes files for their owner alone; a result is readable as any new file is.
    const mode_t mask = umask(0);
    umask(mask);
    if (fchmod(descriptor_, 0666 & ~mask) != 0 || fsync(descriptor_) != 0)
        fail();
    // A directory of results has more files than a process may have open.
    close(descriptor_);
    descriptor_ = -1;
}

void OutputFile::publish() {
    if (temporary_.empty())
        return;
    if (rename(temporary_.c_str(), path_.c_str()) != 0)
        fail();
    temporary_.clear();
}

void OutputFile::commit(const std::string& text) {
    prepare(text);
    publish();
}

void write_standard_output(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        throw OutputError("cannot write to standard output: " + reason());
}

} // namespace tvbeam

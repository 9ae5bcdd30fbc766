#include "reports/files/line_file.hpp"

#include "reports/files/output_file.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace tvbeam {

namespace {

constexpr std::chrono::milliseconds between_flushes{500};

} // namespace

LineFile::~LineFile() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

void LineFile::fail() const {
    throw OutputError("cannot write '" + path_.string() +
                      "': " + std::generic_category().message(errno));
}

bool LineFile::read(const std::function<void(std::size_t number, const std::string& line)>& visit) {
    std::ifstream stream(path_, std::ios::binary);
    std::size_t number = 0;
    size_ = 0;
    for (std::string line; std::getline(stream, line);) {
        if (stream.eof())
            return true;
        visit(++number, line);
        size_ += static_cast<std::int64_t>(line.size()) + 1;
    }
    return false;
}

void LineFile::open() {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    // What is behind the whole lines is a line that was cut short.
    if (descriptor_ < 0 || ftruncate(descriptor_, size_) != 0)
        fail();
}

void LineFile::append(const std::string& line) {
    if (descriptor_ < 0)
        open();
    const std::string text = line + "\n";
    for (std::size_t written = 0; written < text.size();) {
        const ssize_t count = ::write(descriptor_, text.data() + written, text.size() - written);
        if (count < 0 && errno != EINTR) {
            const int error = errno;
            const bool cut = ftruncate(descriptor_, size_) == 0;
            errno = cut ? error : errno;
            fail();
        }
        if (count > 0)
            written += static_cast<std::size_t>(count);
    }
    size_ += static_cast<std::int64_t>(text.size());
    flushed_ = false;
    if (std::chrono::steady_clock::now() - flush_time_ >= between_flushes)
        flush();
}

void LineFile::flush() {
    if (flushed_)
        return;
    if (fdatasync(descriptor_) != 0)
        fail();
    flushed_ = true;
    flush_time_ = std::chrono::steady_clock::now();
}

void LineFile::remove() {
    std::filesystem::remove(path_);
    flushed_ = true;
}

} // namespace tvbeam

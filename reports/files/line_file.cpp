#include "reports/files/line_file.hpp"

#include "mms/text/file_text.hpp"
#include "reports/files/descriptor.hpp"
#include "reports/files/output_file.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace tvbeam {

namespace {

constexpr std::chrono::milliseconds between_flushes{500};
constexpr std::size_t largest_line_file = std::size_t{1} << 30; // bytes

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
    const std::string text = file_text(path_.string(), largest_line_file);
    std::size_t number = 0;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
        visit(++number, text.substr(begin, end - begin));
    size_ = static_cast<std::int64_t>(begin);
    return begin < text.size();
}

void LineFile::open() {
    descriptor_ = uncut(
        [&] { return ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666); });
    // What is behind the whole lines is a line that was cut short.
    if (descriptor_ < 0 || uncut([&] { return ftruncate(descriptor_, size_); }) != 0 ||
        !sync_directory(path_.has_parent_path() ? path_.parent_path() : "."))
        fail();
}

void LineFile::append(const std::string& line) {
    if (descriptor_ < 0)
        open();
    const std::string text = line + "\n";
    if (!write_whole(descriptor_, text)) {
        const int error = errno;
        const bool cut = uncut([&] { return ftruncate(descriptor_, size_); }) == 0;
        errno = cut ? error : errno;
        fail();
    }
    size_ += static_cast<std::int64_t>(text.size());
    flushed_ = false;
    if (std::chrono::steady_clock::now() - flush_time_ >= between_flushes)
        flush();
}

void LineFile::flush() {
    if (flushed_)
        return;
    if (uncut([&] { return fdatasync(descriptor_); }) != 0)
        fail();
    flushed_ = true;
    flush_time_ = std::chrono::steady_clock::now();
}

void LineFile::remove() {
    std::error_code error;
    if (!std::filesystem::remove(path_, error) && error)
        throw OutputError("cannot remove '" + path_.string() + "': " + error.message());
    flushed_ = true;
}

} // namespace tvbeam

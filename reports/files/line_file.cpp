#include "reports/files/line_file.hpp"

#include "mms/text/input_error.hpp"
#include "reports/files/descriptor.hpp"
#include "reports/files/output_file.hpp"

#include <boost/crc.hpp>
#include <fmt/format.h>

#include <cerrno>
#include <optional>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tvbeam {

namespace {

constexpr std::chrono::milliseconds between_flushes{500};
constexpr std::size_t longest_line = std::size_t{1} << 22; // bytes
constexpr std::size_t at_a_time = std::size_t{1} << 16;    // bytes

std::string seal_of(std::string_view members) {
    boost::crc_32_type crc;
    crc.process_bytes(members.data(), members.size());
    return fmt::format(R"({{"crc":"{:08x}",)", crc.checksum());
}

bool is_whole(std::string_view line) {
    static const std::size_t length = seal_of("").size();
    return line.size() > length && line.substr(0, length) == seal_of(line.substr(length));
}

std::string last_error() {
    return std::generic_category().message(errno);
}

/// A regular file, open for reading.
class Reader {
public:
    explicit Reader(const std::filesystem::path& path) : place_{path.string()} {
        // Without waiting for whoever writes to a pipe.
        descriptor_ = uncut([&] { return open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); });
        struct stat status {};
        if (descriptor_ < 0 || fstat(descriptor_, &status) != 0)
            fail();
        if (!S_ISREG(status.st_mode)) {
            close(descriptor_);
            throw InputError(place_, "is no file of results; remove it");
        }
    }
    ~Reader() { close(descriptor_); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    Reader(Reader&&) = delete;
    Reader& operator=(Reader&&) = delete;

    /// Appends what comes next; false at the end.
    bool more(std::string& text) {
        const std::size_t before = text.size();
        text.resize(before + at_a_time);
        const ssize_t count =
            uncut([&] { return ::read(descriptor_, text.data() + before, at_a_time); });
        if (count < 0)
            fail();
        text.resize(before + static_cast<std::size_t>(count));
        return count > 0;
    }

private:
    [[noreturn]] void fail() const { throw InputError(place_, "cannot be read: " + last_error()); }

    Place place_;
    int descriptor_ = -1;
};

} // namespace

std::string sealed(const std::string& object) {
    const auto members = std::string_view(object).substr(1);
    return seal_of(members).append(members);
}

std::string TornLines::text() const {
    if (count == 0)
        return {};
    return count == 1 ? fmt::format("line {} is not whole and is left out", first)
                      : fmt::format("{} lines, from line {} on, are not whole and are left out",
                                    count, first);
}

LineFile::~LineFile() {
    for (const int descriptor : {descriptor_, reader_})
        if (descriptor >= 0)
            close(descriptor);
}

void LineFile::fail() const {
    throw OutputError("cannot write '" + path_.string() + "': " + last_error());
}

TornLines LineFile::read(const std::function<void(const KeptLine&)>& visit) const {
    Reader file(path_);
    TornLines torn;
    std::string text;     // of the file from `offset` on
    std::size_t size = 0; // of a line that is longer than any that is written
    std::int64_t offset = 0;
    std::size_t number = 0;
    const auto take = [&](std::string_view line, bool ends) {
        ++number;
        if (size == 0 && is_whole(line)) {
            visit({number, offset, line});
        } else if (size > 0 || !line.empty()) {
            torn.first = torn.count == 0 ? number : torn.first;
            torn.has_an_end = torn.has_an_end || ends;
            ++torn.count;
        }
        size = 0;
    };
    while (file.more(text)) {
        std::size_t begin = 0;
        for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos;
             begin = end + 1) {
            take(std::string_view(text).substr(begin, end - begin), true);
            offset += static_cast<std::int64_t>(end + 1 - begin);
        }
        text.erase(0, begin);
        if (text.size() > longest_line) {
            size += text.size();
            offset += static_cast<std::int64_t>(text.size());
            text.clear();
        }
    }
    if (size > 0 || !text.empty())
        take("{", false);
    return torn;
}

std::string LineFile::line_at(std::int64_t offset, std::size_t size) const {
    {
        const std::scoped_lock lock(reader_mutex_);
        if (reader_ < 0)
            reader_ = uncut([&] { return ::open(path_.c_str(), O_RDONLY | O_CLOEXEC); });
    }
    std::string line(size, '\0');
    for (std::size_t done = 0; done < size;) {
        const ssize_t count = uncut([&] {
            return pread(reader_, line.data() + done, size - done,
                         offset + static_cast<std::int64_t>(done));
        });
        if (count <= 0)
            throw std::runtime_error("cannot read '" + path_.string() +
                                     "': " + (count < 0 ? last_error() : "it has become shorter"));
        done += static_cast<std::size_t>(count);
    }
    if (!is_whole(line))
        throw std::runtime_error("cannot read '" + path_.string() + "': it has changed");
    return line;
}

void LineFile::open() {
    descriptor_ =
        uncut([&] { return ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666); });
    if (descriptor_ < 0 || !sync_directory(path_.has_parent_path() ? path_.parent_path() : "."))
        fail();
    const auto size = lseek(descriptor_, 0, SEEK_END);
    char last = '\n';
    if (size > 0 && uncut([&] { return pread(descriptor_, &last, 1, size - 1); }) < 0)
        fail();
    before_ = last == '\n' ? "" : "\n";
}

void LineFile::append(const std::string& object) {
    if (descriptor_ < 0)
        open();
    const std::string text = before_ + sealed(object) + "\n";
    if (!write_whole(descriptor_, text)) {
        before_ = "\n"; // of what is there of it, which no reader takes for a line
        fail();
    }
    before_.clear();
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

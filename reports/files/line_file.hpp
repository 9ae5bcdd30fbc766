#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace tvbeam {

/// A line of a LineFile.
struct KeptLine {
    std::size_t number = 0;  ///< from 1
    std::int64_t offset = 0; ///< of its first byte in the file
    std::string_view text;   ///< an object of JSON
};

/// What of a file was not whole.
struct TornLines {
    std::size_t count = 0;
    std::size_t first = 0;   ///< its number
    bool has_an_end = false; ///< one of them; otherwise it is one line that was being written

    /// "2 lines, from line 7 on, are not whole and are left out"; empty: all are.
    [[nodiscard]] std::string text() const;
};

/// An object of JSON, on one line, with its checksum as the first member.
std::string sealed(const std::string& object);

/// A file that only grows, by lines that each hold an object of JSON and a checksum of it: a line
/// is there, or what is there of it is known to be no whole one, whatever ends the program, fills
/// the disk, or writes between two halves of it. Several programs may append to one file; what a
/// file system mixes then is left out when it is read.
class LineFile {
public:
    /// Nothing is made until the first line is appended.
    explicit LineFile(std::filesystem::path path) : path_(std::move(path)) {}
    ~LineFile();
    LineFile(const LineFile&) = delete;
    LineFile& operator=(const LineFile&) = delete;
    LineFile(LineFile&&) = delete;
    LineFile& operator=(LineFile&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Visits the lines that are whole. Throws InputError where the file cannot be read or is no
    /// regular one.
    TornLines read(const std::function<void(const KeptLine&)>& visit) const;

    /// A line again, of which read() told the place. Several threads may call. Throws
    /// std::runtime_error where it is not there any more.
    [[nodiscard]] std::string line_at(std::int64_t offset, std::size_t size) const;

    /// Appends an object of JSON. It survives the program at once, and a crash of the machine half
    /// a second later. Throws OutputError where it does not fit; a part of it may stay, which
    /// read() knows to be no whole line.
    void append(const std::string& object);

    void flush();  ///< all of it to the disk; throws OutputError
    void remove(); ///< the file

private:
    void open();
    [[noreturn]] void fail() const;

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::string before_; ///< the next line: the end of one that was cut short, which is then a line
    bool flushed_ = true;
    std::chrono::steady_clock::time_point flush_time_;
    mutable std::mutex reader_mutex_;
    mutable int reader_ = -1;
};

} // namespace tvbeam

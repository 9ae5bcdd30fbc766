#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace tvbeam {

/// A file that only grows, by whole lines: each is there, but for a last one that was cut short,
/// whatever ends the program. For one writer at a time.
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

    /// Visits the lines that are there, numbered from 1. Returns whether a last one had no end: it
    /// is not visited, and gone once a line is appended. Throws InputError where the file cannot be
    /// read.
    bool read(const std::function<void(std::size_t number, const std::string& line)>& visit);

    /// Appends a line, without its end. It survives the program at once, and a crash of the machine
    /// half a second later. Throws OutputError, and leaves what was there, where it does not fit.
    void append(const std::string& line);

    void flush();  ///< all of it to the disk; throws OutputError
    void remove(); ///< the file

private:
    void open();
    [[noreturn]] void fail() const;

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::int64_t size_ = 0; // of the whole lines, in bytes
    bool flushed_ = true;
    std::chrono::steady_clock::time_point flush_time_;
};

} // namespace tvbeam

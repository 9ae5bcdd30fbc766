#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace tvbeam {

/// Results could not be written.
class OutputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A file that appears whole or not at all: what is written goes to a temporary file beside it,
/// which commit() flushes to the disk and renames. Opened before a long run, so that a place that
/// cannot be written is known at once. A device or a pipe is written to as it is.
class OutputFile {
public:
    /// Throws OutputError when the temporary file cannot be made.
    explicit OutputFile(std::filesystem::path path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile(OutputFile&&) = delete;
    OutputFile& operator=(OutputFile&&) = delete;

    /// Throws OutputError, and leaves an older file of the name as it was, when the text cannot be
    /// written.
    void commit(const std::string& text);

private:
    std::filesystem::path path_;
    std::string temporary_;
    int descriptor_ = -1;
};

/// Writes to standard output; throws OutputError when that fails (a closed pipe, a full disk).
void write_standard_output(const std::string& text);

} // namespace tvbeam

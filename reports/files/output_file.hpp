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

/// A file that appears whole or not at all: the text goes to a temporary file beside it, which is
/// flushed to the disk and renamed. A place that cannot be written is told when the object is made,
/// before a long run, and nothing is made there until the text is at hand. A device or a pipe is
/// written to as it is.
class OutputFile {
public:
    /// Throws OutputError when no file can be made there.
    explicit OutputFile(std::filesystem::path path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile(OutputFile&&) = delete;
    OutputFile& operator=(OutputFile&&) = delete;

    /// Brings the text to the disk, not yet under the file's name. Throws OutputError when it
    /// cannot be written.
    void prepare(const std::string& text);

    /// Gives what was prepared the file's name.
    void publish();

    /// Both. Throws OutputError, and leaves an older file of the name as it was, when the text
    /// cannot be written.
    void commit(const std::string& text);

private:
    [[noreturn]] void fail() const;

    std::filesystem::path path_;
    std::string temporary_;
    int descriptor_ = -1;
};

/// Writes to standard output; throws OutputError when that fails (a closed pipe, a full disk).
void write_standard_output(const std::string& text);

} // namespace tvbeam

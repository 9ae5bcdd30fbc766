#pragma once

#include "reports/files/long_text.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>

namespace tvbeam {

/// Results could not be written.
class OutputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Whoever read standard output does not any more, as `head` when it has its lines.
class ClosedPipe : public OutputError {
public:
    using OutputError::OutputError;
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
    void prepare(const LongText& text);

    /// Gives what was prepared the file's name. The machine may forget that until sync(). Throws
    /// OutputError, and leaves an older file of the name as it was.
    void publish();

    /// Undoes publish(), where the file system can exchange two files.
    void revoke();

    /// Brings the file's name to the disk; throws OutputError.
    void sync() const;

    /// All of it. Throws OutputError, and leaves an older file of the name as it was, when the text
    /// cannot be written.
    void commit(const LongText& text);

private:
    /// What stands under the file's name, and under the temporary one.
    enum class State {
        older,     ///< an older file or none; the text once it is prepared
        exchanged, ///< the text; the older file
        added      ///< the text; nothing
    };

    [[nodiscard]] std::filesystem::path directory() const;
    [[noreturn]] void fail() const;

    std::filesystem::path path_;
    std::filesystem::path temporary_; // empty: nothing stands there
    int descriptor_ = -1;
    State state_ = State::older;
};

/// Writes to standard output; throws ClosedPipe, or OutputError when it fails otherwise (a full
/// disk).
void write_standard_output(const LongText& text);

} // namespace tvbeam

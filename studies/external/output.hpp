/// What a program writes, however much: its lines, and the last of them, in bounded memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace tvbeam {

/// The text with files of the directory by their names alone, and the directory itself as ".".
std::string without_directory(std::string text, const std::filesystem::path& directory);

class OutputLines {
public:
    /// What a line is longer than is passed over: whoever reads one of this length knows that.
    static constexpr std::size_t longest_line = 1 << 20;

    /// visit: told of each line, without its end: a line feed, a carriage return, or both.
    explicit OutputLines(std::function<void(const std::string& line)> visit)
        : visit_(std::move(visit)) {}

    void take(std::string_view chunk);
    void finish(); ///< the last line may have no end

    /// The last lines with something in them, at most `count`, in one line of text, "a | b", with
    /// what is no UTF-8 as \xF6, without_directory().
    [[nodiscard]] std::string last_lines(std::size_t count,
                                         const std::filesystem::path& directory = {}) const;

private:
    std::function<void(const std::string&)> visit_;
    std::string line_;
    std::string tail_;
    bool after_return_ = false;
};

} // namespace tvbeam

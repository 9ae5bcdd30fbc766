#include "studies/external/output.hpp"

#include "mms/text/visible_text.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

constexpr std::size_t longest_tail = 4096;
constexpr std::size_t longest_shown_line = 200;

/// Without what a terminal, a table or a file of JSON would stumble over.
std::string printable(std::string_view line) {
    std::string text(whole_characters(line, longest_shown_line));
    std::replace_if(
        text.begin(), text.end(),
        [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
    const auto first = text.find_first_not_of(' ');
    if (first == std::string::npos)
        return {};
    text.erase(text.find_last_not_of(' ') + 1);
    return visible(text.substr(first)) + (line.size() > longest_shown_line ? " ..." : "");
}

/// Of one of its names.
std::string without_name(const std::string& text, const std::string& directory) {
    const auto is_of_path = [&](std::size_t at) {
        return at < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '/' ||
                text[at] == '.' || text[at] == '_' || text[at] == '-');
    };
    std::string result;
    std::size_t begin = 0;
    for (std::size_t at = 0;
         !directory.empty() && (at = text.find(directory, at)) != std::string::npos;) {
        const std::size_t end = at + directory.size();
        const bool names_a_file = end < text.size() && text[end] == '/' && is_of_path(end + 1);
        if ((at > 0 && is_of_path(at - 1)) || (is_of_path(end) && text[end] != '/')) {
            at = end;
            continue;
        }
        result += text.substr(begin, at - begin) + (names_a_file ? "" : ".");
        begin = at = names_a_file ? end + 1 : end;
    }
    return result + text.substr(begin);
}

} // namespace

std::string without_directory(std::string text, const std::filesystem::path& directory) {
    std::error_code error;
    for (const auto& path :
         {std::filesystem::weakly_canonical(directory, error).string(), directory.string()})
        text = without_name(text, path);
    return text;
}

void OutputLines::take(std::string_view chunk) {
    const auto tail = chunk.substr(chunk.size() - std::min(chunk.size(), longest_tail));
    tail_ += tail;
    if (tail_.size() > longest_tail)
        tail_.erase(0, tail_.size() - longest_tail);
    while (!chunk.empty()) {
        if (after_return_ && chunk.front() == '\n')
            chunk.remove_prefix(1);
        after_return_ = false;
        const std::size_t end = chunk.find_first_of("\n\r");
        const auto part = chunk.substr(0, end);
        line_ += part.substr(0, longest_line - line_.size());
        if (end == std::string_view::npos)
            return;
        visit_(line_);
        line_.clear();
        after_return_ = chunk[end] == '\r';
        chunk.remove_prefix(end + 1);
    }
}

void OutputLines::finish() {
    if (!line_.empty())
        visit_(line_);
    line_.clear();
}

std::string OutputLines::last_lines(std::size_t count,
                                    const std::filesystem::path& directory) const {
    std::vector<std::string> lines;
    std::string_view rest = tail_;
    const auto is_inner = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    while (tail_.size() == longest_tail && !rest.empty() && is_inner(rest.front()))
        rest.remove_prefix(1); // what is left of a character that the tail begins within
    while (!rest.empty() && lines.size() < count) {
        const std::size_t end = rest.find_last_of("\n\r");
        const auto line = end == std::string_view::npos ? rest : rest.substr(end + 1);
        // Before it is cut, so that what is shown does not hang on the length of a name.
        if (auto text = printable(without_directory(std::string(line), directory)); !text.empty())
            lines.push_back(std::move(text));
        rest = end == std::string_view::npos ? std::string_view() : rest.substr(0, end);
    }
    std::string text;
    std::reverse(lines.begin(), lines.end());
    for (const auto& line : lines)
        text += (text.empty() ? "" : " | ") + line;
    return text;
}

} // namespace tvbeam

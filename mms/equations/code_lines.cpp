#include "mms/equations/code_lines.hpp"

#include "mms/text/visible_text.hpp"

namespace tvbeam {

namespace {

constexpr std::size_t longest_line = 100;

/// Whether a line may end behind this character: no operator of two, as **, and no sign of a
/// number's exponent is parted.
bool may_break(const std::string& text, std::size_t at) {
    const char c = text[at];
    const char next = at + 1 < text.size() ? text[at + 1] : '\0';
    const char before = at > 0 ? text[at - 1] : '\0';
    return c == ' ' || (c == '*' && next != '*' && before != '*') || (c == '/' && next != '/');
}

/// Where there is no such place: within brackets, beside one.
bool may_break_at_bracket(const std::string& text, std::size_t at) {
    return text[at] == '(' || (text[at] == ')' && text[at + 1] == ')');
}

/// How much of the text a line of at most this length takes; no more than `least` where it breaks
/// nowhere behind that.
std::size_t length_of_line(const std::string& text, std::size_t longest, std::size_t least) {
    for (const auto may : {may_break, may_break_at_bracket})
        for (std::size_t end = longest; end > least; --end)
            if (may(text, end - 1))
                return end;
    return least;
}

} // namespace

bool is_long(const std::string& text) {
    return text.size() > longest_line;
}

std::string wrapped_code(const std::string& text, std::size_t indent, const std::string& ending) {
    std::string result;
    std::string rest = text;
    while (is_long(rest)) {
        const std::size_t least = indent + 20;
        const std::size_t end = length_of_line(rest, longest_line - ending.size(), least);
        if (end == least)
            break;
        std::string line = rest.substr(0, end);
        while (!line.empty() && line.back() == ' ')
            line.pop_back();
        result += line + ending + "\n";
        rest = std::string(indent, ' ') + rest.substr(end);
    }
    return result + rest + "\n";
}

std::string wrapped_comment(const std::string& text, const std::string& sign) {
    constexpr std::size_t indent =
        2; // of all lines but the first, whose blanks are no place to break
    const std::size_t room = longest_line - sign.size() - 1;
    std::string result;
    std::string rest = text;
    while (rest.size() > room) {
        std::size_t end = room;
        while (end > indent && rest[end - 1] != ' ')
            --end;
        if (end <= indent) // a formula without blanks
            end = whole_characters(rest, room).size();
        result += sign + " " + rest.substr(0, rest[end - 1] == ' ' ? end - 1 : end) + "\n";
        rest = std::string(indent, ' ') + rest.substr(end);
    }
    return result + sign + " " + rest + "\n";
}

} // namespace tvbeam

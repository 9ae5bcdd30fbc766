#include "reports/document/text_table.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

/// Characters that a terminal shows: code points, which is enough for the letters used here.
std::size_t shown(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
}

std::string padded(const std::string& text, std::size_t width) {
    const std::size_t length = shown(text);
    return std::string(width > length ? width - length : 0, ' ') + text;
}

std::size_t width_of(const Table::Column& column) {
    std::size_t width = shown(column.heading);
    for (const auto& cell : column.cells)
        width = std::max(width, shown(cell));
    return width;
}

std::size_t width_of(const Table::Group& group) {
    std::size_t width = 0;
    for (const auto& column : group.columns)
        width += width_of(column) + 1;
    return std::max(width, shown(group.heading) + 1) - 1;
}

std::string line_of(const std::vector<const Table::Group*>& groups, std::size_t row, bool heading) {
    std::string line;
    for (const auto* group : groups) {
        std::string part;
        for (const auto& column : group->columns)
            part += (part.empty() ? "" : " ") +
                    padded(heading ? column.heading : column.cells[row], width_of(column));
        line += (line.empty() ? "" : " ") + padded(part, width_of(*group));
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

std::string part_text(const Table& part) {
    std::vector<const Table::Group*> side_by_side{&part.key};
    for (const auto& group : part.groups)
        side_by_side.push_back(&group);
    std::string headings;
    for (const auto* group : side_by_side)
        headings += (headings.empty() ? "" : " ") + padded(group->heading, width_of(*group));
    headings.erase(headings.find_last_not_of(' ') + 1);
    std::string text = headings.empty() ? "" : headings + "\n";
    text += line_of(side_by_side, 0, true);
    for (std::size_t row = 0; row < part.rows(); ++row)
        text += line_of(side_by_side, row, false);
    return text;
}

} // namespace

std::vector<Table> parts_of(const Table& table, std::size_t width) {
    std::vector<Table> parts;
    std::size_t next = 0;
    do {
        Table part{table.caption, table.key, {}};
        std::size_t used = width_of(part.key);
        while (next < table.groups.size() &&
               (part.groups.empty() || used + 1 + width_of(table.groups[next]) <= width)) {
            used += 1 + width_of(table.groups[next]);
            part.groups.push_back(table.groups[next++]);
        }
        parts.push_back(std::move(part));
    } while (next < table.groups.size());
    return parts;
}

std::string text_table(const Table& table, std::size_t width) {
    std::string text;
    for (const auto& part : parts_of(table, width))
        text += (text.empty() ? "" : "\n") + part_text(part);
    return text;
}

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
    constexpr const char* blanks = " \t\n";
    std::string result;
    std::string line;
    for (std::size_t at = 0, begin = 0;
         (begin = text.find_first_not_of(blanks, at)) != text.npos;) {
        // What is quoted from elsewhere keeps its blanks.
        std::string gap = text.substr(at, begin - at);
        if (gap.find('\n') != gap.npos)
            gap = " ";
        at = std::min(text.find_first_of(blanks, begin), text.size());
        const std::string word = text.substr(begin, at - begin);
        if (!line.empty() && shown(line) + gap.size() + shown(word) > width) {
            result += line + "\n";
            line = std::string(indent, ' ') + word;
        } else {
            line += (line.empty() ? "" : gap) + word;
        }
    }
    return line.empty() ? result : result + line + "\n";
}

} // namespace tvbeam

#include "reports/document/text_table.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

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

/// The widths of a group: found once, as they take all of its cells.
struct Widths {
    std::vector<std::size_t> columns;
    std::size_t whole;
};

Widths widths_of(const Table::Group& group) {
    Widths widths{{}, 0};
    for (const auto& column : group.columns) {
        std::size_t width = shown(column.heading);
        for (const auto& cell : column.cells)
            width = std::max(width, shown(cell));
        widths.columns.push_back(width);
        widths.whole += width + 1;
    }
    widths.whole = std::max(widths.whole, shown(group.heading) + 1) - 1;
    return widths;
}

using Groups = std::vector<std::pair<const Table::Group*, Widths>>;

/// text: of a column, what stands in this line.
std::string line_of(const Groups& groups,
                    const std::function<const std::string&(const Table::Column&)>& text) {
    std::string line;
    for (const auto& [group, widths] : groups) {
        std::string part;
        for (std::size_t i = 0; i < group->columns.size(); ++i)
            part += (part.empty() ? "" : " ") + padded(text(group->columns[i]), widths.columns[i]);
        line += (line.empty() ? "" : " ") + padded(part, widths.whole);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

std::string part_text(const Table& part) {
    Groups side_by_side{{&part.key, widths_of(part.key)}};
    for (const auto& group : part.groups)
        side_by_side.emplace_back(&group, widths_of(group));
    std::string headings;
    for (const auto& [group, widths] : side_by_side)
        headings += (headings.empty() ? "" : " ") + padded(group->heading, widths.whole);
    headings.erase(headings.find_last_not_of(' ') + 1);
    std::string text = headings.empty() ? "" : headings + "\n";
    text += line_of(side_by_side,
                    [](const auto& column) -> const std::string& { return column.heading; });
    for (std::size_t row = 0; row < part.rows(); ++row)
        text += line_of(side_by_side, [row](const auto& column) -> const std::string& {
            return column.cells[row];
        });
    return text;
}

} // namespace

std::vector<Table> parts_of(const Table& table, std::size_t width) {
    std::vector<Table> parts;
    std::size_t next = 0;
    do {
        Table part{table.caption, table.key, {}};
        std::size_t used = widths_of(part.key).whole;
        while (next < table.groups.size()) {
            used += 1 + widths_of(table.groups[next]).whole;
            if (!part.groups.empty() && used > width)
                break;
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

#include "reports/files/said_report.hpp"

#include "reports/document/result_document.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/text/column_sizes.hpp"

#include <boost/crc.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

/// Rows of a longer table: about as many, the first and the last among them.
constexpr std::size_t rows_of_excerpt = 12;

bool is_of_seconds(const Table::Column& column) {
    return column.heading == "sec";
}

/// Its columns but those of seconds.
std::vector<std::pair<std::string, const Table::Column*>> columns_of(const Table& table) {
    std::vector<std::pair<std::string, const Table::Column*>> columns;
    const auto add = [&](const Table::Group& group) {
        for (const auto& column : group.columns)
            if (!is_of_seconds(column))
                columns.emplace_back(
                    (group.heading.empty() ? "" : group.heading + ": ") + column.heading, &column);
    };
    add(table.key);
    for (const auto& group : table.groups)
        add(group);
    return columns;
}

Json table_of(const Table& table) {
    const auto columns = columns_of(table);
    Json headings = Json::array();
    for (const auto& [heading, column] : columns)
        headings.push_back(heading);
    Json rows = Json::array();
    const std::size_t count = table.rows();
    const std::size_t step =
        count <= rows_of_excerpt ? 1 : (count - 1 + rows_of_excerpt - 2) / (rows_of_excerpt - 1);
    for (std::size_t i = 0; i < count; i = i + 1 == count ? count : std::min(i + step, count - 1)) {
        std::string row;
        for (const auto& [heading, column] : columns)
            row += (column == columns.front().second ? "" : " | ") + column->cells.at(i);
        rows.push_back(row);
    }
    return {{"caption", table.caption}, {"headings", headings}, {"count", count}, {"rows", rows}};
}

/// Without what stands between `begin` and `end`, and these.
std::string without(std::string text, std::string_view begin, std::string_view end) {
    for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
        const auto last = text.find(end, at + begin.size());
        if (last == std::string::npos)
            break;
        text.erase(at, last + end.size() - at);
    }
    return text;
}

/// With a number for each formula of LaTeX that has digits in it.
std::string with_numbers_for_formulas(const std::string& line) {
    std::string text;
    for (std::size_t at = 0; at < line.size();) {
        const std::size_t begin = std::min(line.find('$', at), line.size());
        text += line.substr(at, begin - at);
        const std::size_t end = line.find('$', begin + 1);
        if (begin == line.size() || end == std::string::npos)
            return text + line.substr(begin);
        const std::string formula = line.substr(begin, end + 1 - begin);
        text += formula.find_first_of("0123456789") == std::string::npos ? formula : "0";
        at = end + 1;
    }
    return text;
}

/// One # for numbers side by side, also in a row of a table: how many digits and powers of ten they
/// have, and which cells are empty, is the numbers' own. One blank for blanks, one of the dashes
/// and dots of a line.
std::string shape_of(const std::string& given) {
    const std::string line = with_numbers_for_formulas(without(given, " × 10<sup>", "</sup>"));
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    std::string shape;
    for (std::size_t i = 0; i < line.size();) {
        const char c = line[i];
        const bool is_signed =
            (c == '-' || c == '+') && i + 1 < line.size() && is_digit(line[i + 1]);
        if (is_digit(c) || is_signed) {
            ++i;
            while (i < line.size() &&
                   (is_digit(line[i]) || line[i] == '.' ||
                    (line[i] == 'e' && i + 1 < line.size() &&
                     (is_digit(line[i + 1]) || line[i + 1] == '-' || line[i + 1] == '+')) ||
                    ((line[i] == '-' || line[i] == '+') && line[i - 1] == 'e')))
                ++i;
            const auto before = shape.find_last_not_of(" ,;&|");
            if (before != std::string::npos && shape[before] == '#')
                shape.erase(before);
            shape += '#';
            continue;
        }
        ++i;
        const char kept = std::isspace(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
        if ((kept == ' ' || kept == '-' || kept == '.') && shape.ends_with(kept))
            continue;
        shape += kept;
    }
    return shape;
}

/// Of data alone: those of a stress study are rounding.
bool has_data(std::string_view name) {
    const std::string_view file = name.substr(name.find('/') + 1);
    return (file.ends_with(".dat") || file.ends_with(".csv")) && !file.starts_with("stress") &&
           !file.starts_with("round");
}

std::string file_of(const std::string& name, const std::string& text) {
    boost::crc_32_type sum;
    std::size_t lines = 0;
    std::string before;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string shape = shape_of(text.substr(at, end - at));
        at = end + 1;
        // Points of a line are as many as it took.
        if (shape == before)
            continue;
        sum.process_bytes(shape.data(), shape.size());
        sum.process_byte('\n');
        before = shape;
        ++lines;
    }
    return fmt::format("{} lines, {:08x}{}", lines, sum.checksum(),
                       has_data(name) ? "," + column_sizes(text) : "");
}

} // namespace

Json tables_said_by(const StudyResult& result) {
    Json tables = Json::array();
    for (const auto& section : result_document(result).sections)
        for (const auto& block : section.blocks)
            if (const auto* table = std::get_if<Table>(&block))
                tables.push_back(table_of(*table));
    return tables;
}

Json files_said_by(const StudyResult& result) {
    Reported all = reported(result);
    all.document.provenance.clear();
    for (auto& section : all.document.sections)
        for (auto& block : section.blocks) {
            if (auto* table = std::get_if<Table>(&block)) {
                for (auto& group : table->groups)
                    std::erase_if(group.columns, is_of_seconds);
                std::erase_if(table->groups,
                              [](const auto& group) { return group.columns.empty(); });
            }
            if (auto* item = std::get_if<Item>(&block))
                item->text = "item"; // of cases alike, round-off decides which is the worst
        }
    all.source_text.clear();
    all.formulas = {}; // said by themselves
    const std::vector<Plot> plots = all.plots();
    DrawnPlots drawn; // by no program
    drawn.plots.resize(plots.size());
    Json files = Json::object();
    for (const auto& format : report_formats())
        if (format->name() != "json" && format->name() != "pdf")
            for (const auto& [name, text] : format->write({all, plots, drawn}))
                files[name] = file_of(name, text.whole());
    return files;
}

} // namespace tvbeam

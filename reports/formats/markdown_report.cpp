#include "reports/formats/markdown_report.hpp"

#include "mms/text/visible_text.hpp"
#include "reports/document/written_number.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/table_row.hpp"

#include <cctype>

namespace tvbeam {

namespace {

std::string markdown_of(const Table& table) {
    std::vector<std::string> lines(2 + table.rows());
    const auto add = [&](const Table::Group& group) {
        for (const auto& column : group.columns) {
            const std::string heading = group.heading.empty() ? column.heading
                                        : column.heading.empty()
                                            ? group.heading
                                            : group.heading + " " + column.heading;
            lines[0] += " " + markdown_text(heading) + " |";
            lines[1] += number_column(column.cells).is_text ? " :--- |" : " ---: |";
            for (std::size_t row = 0; row < table.rows(); ++row)
                lines[2 + row] += " " + markdown_text(column.cells[row]) + " |";
        }
    };
    add(table.key);
    for (const auto& group : table.groups)
        add(group);
    std::string text = table.caption.empty() ? "" : "*" + markdown_text(table.caption) + "*\n\n";
    for (const auto& line : lines)
        text += "|" + line + "\n";
    return text + "\n";
}

std::string markdown_of(const Paragraph& paragraph) {
    return paragraph.introduces ? "" : markdown_text(paragraph.text) + "\n\n";
}

std::string markdown_of(const Item& item) {
    return "- " + markdown_text(item.text) + "\n";
}

std::string markdown_of(const Finding& /*unused*/) {
    return {}; // at the head
}

std::string markdown_of(const Preformatted& text) {
    return "```\n" + text.lines + "```\n\n";
}

std::string markdown_of(const BlankLine& /*unused*/) {
    return {};
}

std::string markdown_heading(const std::string& title) {
    return "## " + markdown_text(title) + "\n\n";
}

std::string markdown_of(const Section& section) {
    std::string text = markdown_heading(section.title);
    bool in_list = false;
    for (const auto& block : section.blocks) {
        const std::string one =
            std::visit([](const auto& shown) { return markdown_of(shown); }, block);
        if (in_list && !one.empty() && !std::holds_alternative<Item>(block))
            text += "\n";
        in_list = std::holds_alternative<Item>(block) || (in_list && one.empty());
        text += one;
    }
    return in_list ? text + "\n" : text;
}

std::string rows(const std::vector<std::pair<std::string, std::string>>& pairs) {
    std::string text;
    for (const auto& [name, value] : pairs)
        text += "- " + markdown_text(name) + ": " + markdown_text(value) + "\n";
    return text + "\n";
}

} // namespace

std::string markdown_text(const std::string& given) {
    const std::string text = visible(given);
    const auto is_word = [&text](std::size_t at) {
        return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])) != 0;
    };
    std::string markdown;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        // A _ within a word is no markup, and names are full of them.
        const bool within = c == '_' && i > 0 && is_word(i - 1) && is_word(i + 1);
        if (std::string("\\`*_[]<>|&#~$").find(c) != std::string::npos && !within)
            markdown += '\\';
        markdown += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
    return markdown;
}

std::string markdown_report(const Document& document) {
    std::string text = "# " + markdown_text(document.title) + "\n\n";
    for (const auto& sentence : document.head)
        text += markdown_text(sentence) + "\n\n";
    const auto findings = findings_of(document);
    if (!findings.empty())
        text += markdown_heading("What it shows");
    for (const auto& finding : findings)
        text += (finding.indent > 2 ? "  - " : "- ") + markdown_text(finding.text) + "\n";
    text += findings.empty() ? "" : "\n";
    for (const auto& section : document.sections)
        text += markdown_of(section);
    if (!document.norms.empty())
        text += markdown_heading("Norms of the errors") + rows(document.norms);
    if (!document.left_out.empty()) {
        text += markdown_heading("Left out, as the scene does not need it");
        for (const auto& part : document.left_out)
            text += "- " + markdown_text(part) + "\n";
        text += "\n";
    }
    return text + "## Where it comes from\n\n" + rows(document.provenance);
}

struct MarkdownFormat final : ReportFormat {
    std::string name() const override { return "markdown"; }
    std::vector<std::string> certain_files() const override { return {"table.md"}; }
    std::vector<NamedText> write(const ReportContents& contents) const override {
        return {{"table.md", markdown_report(contents.reported.document)}};
    }
};

template std::unique_ptr<const ReportFormat> make_row<ReportFormat, MarkdownFormat>();

} // namespace tvbeam

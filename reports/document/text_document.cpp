#include "reports/document/text_document.hpp"

#include "mms/text/visible_text.hpp"
#include "reports/document/text_table.hpp"

namespace tvbeam {

namespace {

std::string text_of(const Paragraph& paragraph) {
    return wrapped(paragraph.text, paragraph.indent);
}

std::string text_of(const Item& item) {
    return wrapped(item.text, item.indent);
}

std::string text_of(const Finding& finding) {
    return finding.on_terminal ? wrapped(finding.text, finding.indent) : std::string();
}

std::string text_of(const Table& table) {
    return text_table(table);
}

std::string text_of(const Preformatted& text) {
    return text.lines;
}

std::string text_of(const BlankLine& /*unused*/) {
    return "\n";
}

} // namespace

std::string text_section(const Section& section) {
    std::string text;
    for (const auto& block : section.blocks)
        text += std::visit([](const auto& one) { return text_of(one); }, block);
    return text;
}

std::string text_document(const Document& document) {
    std::string text = wrapped(document.title);
    for (const auto& sentence : document.head)
        text += wrapped(sentence);
    for (const auto& section : document.sections)
        text += "\n" + text_section(section);
    if (!document.left_out.empty()) {
        text += "\nLeft out, as the scene does not need it:\n";
        for (const auto& part : document.left_out)
            text += wrapped(part, 4);
    }
    return visible(text);
}

} // namespace tvbeam

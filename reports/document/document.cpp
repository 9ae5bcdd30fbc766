#include "reports/document/document.hpp"

namespace tvbeam {

namespace {

/// The words of the norm whose name the text begins with, "theta_L2L2: …", in place of the name.
std::string with_norm_in_words(const Document& document, const std::string& text) {
    for (const auto& [name, words] : document.norms)
        if (text.starts_with(name + ": "))
            return words + text.substr(name.size());
    return text;
}

} // namespace

std::vector<Finding> findings_of(const Document& document) {
    std::vector<Finding> findings;
    for (const auto& section : document.sections)
        for (const auto& block : section.blocks)
            if (const auto* finding = std::get_if<Finding>(&block)) {
                findings.push_back(*finding);
                findings.back().text = with_norm_in_words(document, finding->text);
            }
    return findings;
}

} // namespace tvbeam

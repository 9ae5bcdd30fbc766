#include "reports/document/document.hpp"

namespace tvbeam {

std::vector<Finding> findings_of(const Document& document) {
    std::vector<Finding> findings;
    for (const auto& section : document.sections)
        for (const auto& block : section.blocks)
            if (const auto* finding = std::get_if<Finding>(&block))
                findings.push_back(*finding);
    return findings;
}

} // namespace tvbeam

#pragma once

#include "reports/document/document.hpp"

#include <string>

namespace tvbeam {

/// A document for a terminal, 80 columns wide.
std::string text_document(const Document& document);

/// One section of it.
std::string text_section(const Section& section);

} // namespace tvbeam

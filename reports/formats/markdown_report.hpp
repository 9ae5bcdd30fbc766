#pragma once

#include "reports/document/document.hpp"

#include <string>

namespace tvbeam {

/// A document as Markdown with pipe tables, as GitHub has them.
std::string markdown_report(const Document& document);

/// Text with everything that Markdown takes for markup written so that it is shown.
std::string markdown_text(const std::string& text);

} // namespace tvbeam

#pragma once

#include "reports/document/document.hpp"

#include <string>

namespace tvbeam {

/// A document as LaTeX that compiles as it stands under pdflatex (amsmath, booktabs, geometry,
/// graphicx): what was run, what it shows, and the tables, with the points of their numbers below
/// each other and powers of ten as mathematics.
std::string latex_report(const Document& document);

/// Text with everything that LaTeX takes for a command written so that it is printed. Letters that
/// pdflatex's default fonts have not are printed as "?".
std::string latex_text(const std::string& text);

/// The same of a sentence, its numbers with an exponent as mathematics, and what stands behind a ^
/// raised.
std::string latex_sentence(const std::string& text);

} // namespace tvbeam

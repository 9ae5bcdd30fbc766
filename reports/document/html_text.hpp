#pragma once

#include <string>

namespace tvbeam {

/// Text with everything that HTML takes for markup written so that it is shown, in attributes too.
std::string html_text(const std::string& text);

/// A formula as formula_text (mms/expression/printing.hpp) or a solution file writes it, set for
/// reading: exponents raised, Greek letters, products without asterisks. Lines may break within it.
std::string html_formula(const std::string& formula);

} // namespace tvbeam

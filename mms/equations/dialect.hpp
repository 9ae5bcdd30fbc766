#pragma once

#include "mms/equations/code.hpp"
#include "mms/equations/code_lines.hpp"
#include "mms/equations/infix.hpp"

#include <string>

namespace tvbeam {

/// A language: how expressions look in it, what it makes of names, and how a file is written.
struct Dialect {
    CodeLanguage language;
    std::string name;
    InfixStyle infix;
    bool ignores_case = false;
    std::string (*write)(const Dialect& dialect, const CodeFile& file);
    bool underscores = true; ///< in names
    std::size_t longest_name = std::string::npos;
    /// Whether compilers refuse a function of numbers whose value over- or underflows.
    bool refuses_numbers = false;

    /// The name, without what names may not have, and with a _ (or 0) at its end where it is
    /// reserved.
    [[nodiscard]] std::string identifier(const std::string& name) const;
    /// Equal for names that the language takes for one.
    [[nodiscard]] std::string folded(const std::string& name) const;
};

const Dialect& dialect_of(CodeLanguage language);

} // namespace tvbeam

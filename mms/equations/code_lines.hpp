#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// What is computed once and used more than once, by name, and the values.
struct CodeBody {
    std::vector<std::pair<std::string, std::string>> shared;
    std::vector<std::string> values;

    /// Of a function with one.
    [[nodiscard]] const std::string& value() const { return values.front(); }
};

struct CodeFunction {
    std::string name;
    std::string comment;
    CodeBody body;
    std::vector<std::string> unused = {}; ///< arguments
};

/// A file of functions of the same arguments, before it is written in a language.
struct CodeFile {
    std::string name;
    std::string comment = {};
    std::vector<std::string> arguments = {};
    std::vector<std::pair<std::string, std::string>> constants = {};
    std::vector<std::string> library = {}; ///< functions of the standard library in use
    bool uses_pi = false;
    std::vector<CodeFunction> functions = {};
    /// All sources at once, with what they have in common computed once; where there are several.
    std::optional<CodeFunction> together = {};
};

/// Text of code in lines of at most 100 characters where it can be broken: behind an operator or a
/// comma, or else beside brackets. `ending`: what stands at the end of a line that goes on, as
/// Fortran's &.
std::string wrapped_code(const std::string& text, std::size_t indent, const std::string& ending);

/// A comment in lines of at most 100 characters, each behind the sign.
std::string wrapped_comment(const std::string& text, const std::string& sign);

/// Whether wrapped_code would break the text.
bool is_long(const std::string& text);

} // namespace tvbeam

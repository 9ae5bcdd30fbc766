#include "mms/equations/dialect.hpp"

#include "mms/equations/reserved_words.hpp"
#include "mms/text/characters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace tvbeam {

namespace {

constexpr const char* pi_digits = "3.141592653589793";

std::string joined(const std::vector<std::string>& words, const std::string& before = {}) {
    std::string text;
    for (const auto& word : words)
        text.append(text.empty() ? "" : ", ").append(before).append(word);
    return text;
}

/// A name made of a title.
std::string identifier_of(const std::string& title) {
    std::string name;
    for (const char c : title)
        name += is_letter(c) || is_digit(c) ? c : '_';
    return is_letter(name.front()) ? name : "tvbeam_" + name;
}

/// A name made of the file's for what holds its functions: none of those `taken`, which are folded,
/// and no longer than the language allows.
std::string module_of(const Dialect& dialect, const CodeFile& file,
                      const std::set<std::string>& taken) {
    const std::string wanted = dialect.identifier(identifier_of(file.name));
    const auto cut = [&](const std::string& ending) {
        return wanted.substr(0, dialect.longest_name - ending.size()) + ending;
    };
    std::string name = cut("");
    for (std::string ending = "_module"; taken.contains(dialect.folded(name)); ending += '_')
        name = cut(ending);
    return name;
}

/// { in C, C++ and FreeFEM }: declarations, the value, with what a line begins with.
struct Braces {
    std::string comment = "//";
    std::string declaration; ///< "const double "
    std::string function;    ///< "double "
    std::string argument;    ///< "double "
    bool marks_unused = false;
};

/// (void)x; for arguments that a function does not use.
std::string unused_marks(const CodeFunction& function) {
    std::string text;
    for (const auto& name : function.unused)
        text += " (void)" + name + ";";
    return text.empty() ? "" : "   " + text + "\n";
}

/// As many to a line as fit.
std::string declarations(const Braces& braces, const CodeBody& body) {
    std::string text;
    std::string line;
    for (const auto& [name, value] : body.shared) {
        const std::string one = fmt::format("{} = {}", name, value);
        if (!line.empty() && is_long(fmt::format("{}, {};", line, one))) {
            text += wrapped_code(line + ";", 8, "");
            line.clear();
        }
        line += (line.empty() ? "    " + braces.declaration : ", ") + one;
    }
    return line.empty() ? text : text + wrapped_code(line + ";", 8, "");
}

/// void sources(…, double values[n]), with the values from 0.
std::string together_in_braces(const Braces& braces, const CodeFile& file) {
    if (!file.together)
        return {};
    const CodeFunction& function = *file.together;
    const std::string count = std::to_string(function.body.values.size());
    const std::string storage = braces.function == "double " ? "void " : "inline void ";
    std::string text = "\n" + wrapped_comment(function.comment, braces.comment);
    text += storage + function.name + "(" + joined(file.arguments, braces.argument) +
            (file.arguments.empty() ? "" : ", ") + "double values[" + count + "]) {\n" +
            unused_marks(function) + declarations(braces, function.body);
    for (std::size_t i = 0; i < function.body.values.size(); ++i)
        text += wrapped_code(
            "    values[" + std::to_string(i) + "] = " + function.body.values[i] + ";", 8, "");
    return text + "}\n";
}

std::string written_in_braces(const Braces& braces, const CodeFile& file) {
    std::string text;
    for (const auto& function : file.functions) {
        text += "\n" + wrapped_comment(function.comment, braces.comment);
        text += braces.function + function.name + "(" + joined(file.arguments, braces.argument) +
                ") {\n";
        if (braces.marks_unused)
            text += unused_marks(function);
        text += declarations(braces, function.body) +
                wrapped_code("    return " + function.body.value() + ";", 8, "") + "}\n";
    }
    return text;
}

std::string write_c(const Dialect& /*dialect*/, const CodeFile& file) {
    std::string text = wrapped_comment(file.comment, "//") + "#include <math.h>\n\n";
    if (file.uses_pi)
        text += fmt::format("static const double pi = {};\n", pi_digits);
    for (const auto& [name, value] : file.constants)
        text += fmt::format("static const double {} = {};\n", name, value);
    const Braces braces{.declaration = "const double ",
                        .function = "double ",
                        .argument = "double ",
                        .marks_unused = true};
    return text + written_in_braces(braces, file) + together_in_braces(braces, file);
}

std::string write_cpp(const Dialect& dialect, const CodeFile& file) {
    std::string text = wrapped_comment(file.comment, "//") + "#include <cmath>\n\nnamespace " +
                       module_of(dialect, file, global_names(dialect.language)) + " {\n\n";
    if (file.uses_pi)
        text += fmt::format("constexpr double pi = {};\n", pi_digits);
    for (const auto& [name, value] : file.constants)
        text += fmt::format("constexpr double {} = {};\n", name, value);
    const Braces braces{.declaration = "const double ",
                        .function = "inline double ",
                        .argument = "double ",
                        .marks_unused = true};
    return text + written_in_braces(braces, file) + together_in_braces(braces, file) + "\n}\n";
}

std::string write_freefem(const Dialect& /*dialect*/, const CodeFile& file) {
    std::string text = wrapped_comment(file.comment, "//");
    for (const auto& [name, value] : file.constants)
        text += fmt::format("real {} = {};\n", name, value);
    return text +
           written_in_braces(
               {.declaration = "real ", .function = "func real ", .argument = "real "}, file);
}

std::string fortran_arguments(const CodeFile& file) {
    return file.arguments.empty() ? ""
                                  : "    real(dp), intent(in) :: " + joined(file.arguments) + "\n";
}

/// Declarations and values of what is shared.
std::string fortran_body(const CodeFunction& function) {
    std::vector<std::string> names;
    std::string values;
    for (const auto& [name, value] : function.body.shared) {
        names.push_back(name);
        values += wrapped_code(fmt::format("    {} = {}", name, value), 8, " &");
    }
    return (names.empty() ? "" : wrapped_code("    real(dp) :: " + joined(names), 8, " &")) +
           values;
}

/// A module may not have the name of what is in it, nor that of an intrinsic function, which it
/// would hide.
std::string fortran_module(const Dialect& dialect, const CodeFile& file) {
    std::set<std::string> taken = global_names(dialect.language);
    for (const auto& name : file.arguments)
        taken.insert(dialect.folded(name));
    for (const auto& function : file.functions)
        taken.insert(dialect.folded(function.name));
    for (const auto& [name, value] : file.constants)
        taken.insert(dialect.folded(name));
    return module_of(dialect, file, taken);
}

std::string write_fortran(const Dialect& dialect, const CodeFile& file) {
    std::string text = wrapped_comment(file.comment, "!") + "module " +
                       fortran_module(dialect, file) +
                       "\n  implicit none\n  integer, parameter :: dp = kind(1.0d0)\n";
    // No named constants, of which compilers compute formulas and refuse those that underflow.
    if (file.uses_pi)
        text += fmt::format("  real(dp), protected :: pi = {}_dp\n", pi_digits);
    for (const auto& [name, value] : file.constants)
        text += fmt::format("  real(dp), protected :: {} = {}\n", name, value);
    text += "contains\n";
    for (const auto& function : file.functions) {
        text += "\n" + wrapped_comment(function.comment, "  !");
        text +=
            fmt::format("  pure real(dp) function {}({})\n", function.name, joined(file.arguments));
        text += fortran_arguments(file) + fortran_body(function);
        text += wrapped_code("    " + function.name + " = " + function.body.value(), 8, " &") +
                "  end function\n";
    }
    if (file.together) {
        const CodeFunction& function = *file.together;
        const std::string comma = file.arguments.empty() ? "" : ", ";
        text += "\n" + wrapped_comment(function.comment, "  !");
        text += fmt::format("  pure subroutine {}({}{}values)\n", function.name,
                            joined(file.arguments), comma);
        text += fortran_arguments(file);
        text +=
            fmt::format("    real(dp), intent(out) :: values({})\n", function.body.values.size());
        text += fortran_body(function);
        for (std::size_t i = 0; i < function.body.values.size(); ++i)
            text += wrapped_code(fmt::format("    values({}) = {}", i + 1, function.body.values[i]),
                                 8, " &");
        text += "  end subroutine\n";
    }
    return text + "end module\n";
}

/// A value that goes on in the next line stands in brackets.
std::string bracketed_if_long(const std::string& line, const std::string& value) {
    return is_long(line + value) ? line + "(" + value + ")" : line + value;
}

/// All functions, where one may return several values.
std::vector<CodeFunction> with_together(const CodeFile& file) {
    std::vector<CodeFunction> all = file.functions;
    if (file.together)
        all.push_back(*file.together);
    return all;
}

/// Functions of Python, with or without arrays.
std::string python_functions(const CodeFile& file) {
    std::string text;
    for (const auto& function : with_together(file)) {
        text += "\n\n" + wrapped_comment(function.comment, "#");
        text += "def " + function.name + "(" + joined(file.arguments) + "):\n";
        for (const auto& [name, value] : function.body.shared)
            text += wrapped_code(bracketed_if_long("    " + name + " = ", value), 8, "");
        text += wrapped_code(bracketed_if_long("    return ", joined(function.body.values)), 8, "");
    }
    return text;
}

std::string assignments(const CodeFile& file) {
    std::string text;
    for (const auto& [name, value] : file.constants)
        text += fmt::format("{} = {}\n", name, value);
    return text.empty() ? "" : "\n" + text;
}

std::string write_python(const Dialect& /*dialect*/, const CodeFile& file) {
    std::vector<std::string> numpy;
    std::vector<std::string> plain;
    for (const auto& name : file.library) {
        const bool inverse = name == "asin" || name == "acos" || name == "atan";
        numpy.push_back(inverse ? "arc" + name.substr(1) + " as " + name : name);
        plain.push_back(name);
    }
    if (file.uses_pi) {
        numpy.emplace_back("pi");
        plain.emplace_back("pi");
    }
    // Those of math raise an error where numpy's are infinite.
    constexpr const char* infinite = "float(\"inf\")";
    std::string bounded;
    for (auto& name : plain)
        if (name == "exp" || name == "sinh" || name == "cosh") {
            const bool is_exp = name == "exp";
            bounded += fmt::format("    {0} = lambda x: {3}{4} if {1} > {2} else _{0}(x)\n", name,
                                   is_exp ? "x" : "abs(x)",
                                   is_exp ? "709.782712893384" : "710.4758600739439",
                                   name == "sinh" ? "x * " : "", infinite);
            name += " as _" + name;
        }
    std::string text = wrapped_comment(file.comment, "#");
    if (!plain.empty())
        text += "try:\n    from numpy import " + joined(numpy) +
                "\nexcept ImportError:\n    from math import " + joined(plain) + "\n" + bounded;
    return text + assignments(file) + python_functions(file);
}

std::string write_ufl(const Dialect& /*dialect*/, const CodeFile& file) {
    std::vector<std::string> names = file.library;
    std::replace(names.begin(), names.end(), std::string("log"), std::string("ln as log"));
    if (file.uses_pi)
        names.emplace_back("pi");
    std::string text = wrapped_comment(file.comment, "#");
    if (!names.empty())
        text += "from ufl import " + joined(names) + "\n";
    return text + assignments(file) + python_functions(file);
}

std::string write_julia(const Dialect& /*dialect*/, const CodeFile& file) {
    std::string text = wrapped_comment(file.comment, "#");
    for (const auto& [name, value] : file.constants)
        text += fmt::format("const {} = {}\n", name, value);
    for (const auto& function : with_together(file)) {
        text += "\n" + wrapped_comment(function.comment, "#");
        text += "function " + function.name + "(" + joined(file.arguments) + ")\n";
        for (const auto& [name, value] : function.body.shared)
            text += wrapped_code(bracketed_if_long("    " + name + " = ", value), 8, "");
        text +=
            wrapped_code(bracketed_if_long("    return ", joined(function.body.values)), 8, "") +
            "end\n";
    }
    return text;
}

std::string write_moose(const Dialect& /*dialect*/, const CodeFile& file) {
    std::string names;
    std::string values;
    for (const auto& [name, value] : file.constants) {
        names += (names.empty() ? "" : " ") + name;
        values += (values.empty() ? "" : " ") + value;
    }
    std::string text = wrapped_comment(file.comment, "#") + "[Functions]\n";
    for (const auto& function : file.functions) {
        std::string expression;
        for (const auto& [name, value] : function.body.shared)
            expression += fmt::format("{} := {}; ", name, value);
        text += wrapped_comment(function.comment, "  #");
        text += "  [" + function.name + "]\n    type = ParsedFunction\n";
        text +=
            wrapped_code("    expression = '" + expression + function.body.value() + "'", 8, "");
        if (!names.empty())
            text +=
                fmt::format("    symbol_names = '{}'\n    symbol_values = '{}'\n", names, values);
        text += "  []\n";
    }
    return text + "[]\n";
}

const std::array<Dialect, 8>& dialects() {
    using enum CodeLanguage;
    static const std::array<Dialect, 8> all = {
        Dialect{c, "c", {}, false, write_c},
        Dialect{cpp, "c++", {.function_prefix = "std::"}, false, write_cpp},
        Dialect{fortran,
                "fortran",
                {.number_ending = "_dp", .power = "**"},
                true,
                write_fortran,
                true,
                63,
                true},
        Dialect{python, "python", {.power = "**"}, false, write_python},
        Dialect{julia, "julia", {.power = "^"}, false, write_julia},
        Dialect{freefem, "freefem", {.power = "^"}, false, write_freefem, false},
        Dialect{ufl, "ufl", {.power = "**"}, false, write_ufl},
        Dialect{moose, "moose", {.decimal_point = false, .power = "^"}, false, write_moose},
    };
    return all;
}

} // namespace

std::string Dialect::folded(const std::string& text) const {
    std::string result = text;
    if (ignores_case)
        std::transform(result.begin(), result.end(), result.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::string Dialect::identifier(const std::string& text) const {
    std::string result = text;
    if (!underscores)
        result.erase(std::remove(result.begin(), result.end(), '_'), result.end());
    if (reserved_words(language).contains(folded(result)))
        result += underscores ? "_" : "0";
    return result;
}

const Dialect& dialect_of(CodeLanguage language) {
    return *std::find_if(dialects().begin(), dialects().end(),
                         [&](const Dialect& one) { return one.language == language; });
}

const std::vector<std::string>& code_language_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        for (const Dialect& one : dialects())
            result.push_back(one.name);
        return result;
    }();
    return names;
}

std::optional<CodeLanguage> code_language(const std::string& name) {
    for (const Dialect& one : dialects())
        if (one.name == name)
            return one.language;
    return std::nullopt;
}

} // namespace tvbeam

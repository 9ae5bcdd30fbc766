#include "mms/equations/dialect.hpp"

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
                       dialect.identifier(identifier_of(file.name)) + " {\n\n";
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

/// A module may not have the name of what is in it.
std::string module_of(const Dialect& dialect, const CodeFile& file) {
    const std::string name = identifier_of(file.name);
    const auto is_name = [&](const std::string& other) {
        return dialect.folded(other) == dialect.folded(name);
    };
    const bool is_taken =
        std::ranges::any_of(file.functions, is_name, &CodeFunction::name) ||
        std::ranges::any_of(file.constants, is_name, &std::pair<std::string, std::string>::first) ||
        is_name("sources") || is_name("dp") || is_name("pi");
    return is_taken ? name + "_module" : name;
}

std::string write_fortran(const Dialect& dialect, const CodeFile& file) {
    std::string text = wrapped_comment(file.comment, "!") + "module " + module_of(dialect, file) +
                       "\n  implicit none\n  integer, parameter :: dp = kind(1.0d0)\n";
    if (file.uses_pi)
        text += fmt::format("  real(dp), parameter :: pi = {}_dp\n", pi_digits);
    for (const auto& [name, value] : file.constants)
        text += fmt::format("  real(dp), parameter :: {} = {}\n", name, value);
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
    std::string text = wrapped_comment(file.comment, "#");
    if (!plain.empty())
        text += "try:\n    from numpy import " + joined(numpy) +
                "\nexcept ImportError:\n    from math import " + joined(plain) + "\n";
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

std::set<std::string> words(const char* text) {
    std::set<std::string> result;
    std::string word;
    for (const char* c = text;; ++c) {
        if (*c != ' ' && *c != '\0') {
            word += *c;
            continue;
        }
        result.insert(word);
        word.clear();
        if (*c == '\0')
            return result;
    }
}

constexpr const char* words_of_c =
    "auto break case char const continue default do double else enum extern float for goto if "
    "inline int long main register restrict return short signed sizeof static struct switch "
    "typedef typeof union unsigned void volatile while asm abs signgam lgamma_r lgammaf_r "
    "lgammal_r float_t double_t alignas alignof bool constexpr false nullptr static_assert "
    "thread_local true typeof_unqual values";
/// Functions of math.h, which also have an f and an l behind their names.
constexpr const char* functions_of_c =
    "acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh drem erf erfc exp exp2 "
    "expm1 fabs fdim finite floor fma fmax fmin fmod frexp gamma hypot ilogb isinf isnan j0 j1 jn "
    "ldexp lgamma llrint llround log log10 log1p log2 logb lrint lround modf nan nearbyint "
    "nextafter nexttoward pow remainder remquo rint round scalb scalbln scalbn significand sin "
    "sinh sqrt tan tanh tgamma trunc y0 y1 yn";
/// Macros of math.h, of what C++ includes with it, and of the compilers.
constexpr const char* macros_of_c =
    "NAN INFINITY NULL HUGE_VAL HUGE_VALF HUGE_VALL FP_NAN FP_INFINITE FP_ZERO FP_SUBNORMAL "
    "FP_NORMAL FP_ILOGB0 FP_ILOGBNAN MATH_ERRNO MATH_ERREXCEPT math_errhandling MAXFLOAT SNAN "
    "SNANF SNANL RAND_MAX EXIT_SUCCESS EXIT_FAILURE BYTE_ORDER BIG_ENDIAN LITTLE_ENDIAN "
    "PDP_ENDIAN isless islessgreater islessequal isnormal issubnormal fpclassify isgreater "
    "isgreaterequal isfinite signbit isunordered alloca linux unix i386";
constexpr const char* words_of_cpp =
    "alignas alignof and bitand bitor bool break case catch char class compl concept const "
    "constexpr continue decltype default delete do double else enum explicit export extern false "
    "float for friend goto if inline int long mutable namespace new noexcept not nullptr operator "
    "or private protected public register requires return short signed sizeof static std struct "
    "switch template this throw true try typedef typeid typename union unsigned using virtual void "
    "volatile while xor asm auto typeof wchar_t char8_t char16_t char32_t float_t double_t and_eq "
    "or_eq xor_eq not_eq static_cast const_cast dynamic_cast reinterpret_cast static_assert "
    "thread_local co_await co_return co_yield consteval constinit values";
constexpr const char* words_of_fortran = "dp kind real values";
constexpr const char* words_of_python =
    "and as assert async await break class continue def del elif else except finally for from "
    "global if import in is lambda nonlocal not or pass raise return try while with None True "
    "False";
constexpr const char* words_of_julia =
    "baremodule begin break catch const continue do else elseif end export false finally for "
    "function global if import let local macro module quote return struct true try using while "
    "in isa where im ℯ";
constexpr const char* words_of_freefem =
    "N P R R2 R3 area bool border break catch cin complex continue cout element else end endl "
    "false "
    "fespace "
    "for func hTriangle if ifstream include int intalledges lenEdge label load macro matrix mesh "
    "mesh3 nTonEdge nuEdge nuTriangle ofstream plot problem real region return solve string true "
    "try varf vertex volume while int1d int2d int3d on dx dy dz dxx dxy dyx dyy mean jump average "
    "abs arg conj det diag norm real imag trace max min pow rint round floor ceil erf erfc gamma "
    "lgamma tgamma j0 j1 jn y0 y1 yn i verbosity version time clock";
constexpr const char* words_of_moose =
    "e abs max min if int pow plog acosh arg asinh atan2 atanh cbrt ceil conj cot csc erf erfc "
    "exp2 floor hypot imag log10 log2 polar real rint round sec trunc";

/// With M_PI and the like, also with the endings of types.
std::set<std::string> all_macros() {
    std::set<std::string> all = words(macros_of_c);
    for (const auto& number :
         words("E LOG2E LOG10E LN2 LN10 PI PI_2 PI_4 1_PI 2_PI 2_SQRTPI SQRT2 SQRT1_2"))
        for (const char* end : {"", "f", "l", "f32", "f64", "f128", "f32x", "f64x"})
            all.insert("M_" + number + end);
    return all;
}

std::set<std::string> all_words_of_c() {
    std::set<std::string> all = words(words_of_c);
    all.merge(all_macros());
    for (const auto& function : words(functions_of_c))
        for (const char* end : {"", "f", "l"})
            all.insert(function + end);
    return all;
}

std::set<std::string> all_words_of_cpp() {
    std::set<std::string> all = words(words_of_cpp);
    all.merge(all_macros());
    return all;
}

const std::array<Dialect, 8>& dialects() {
    using enum CodeLanguage;
    static const std::array<Dialect, 8> all = {
        Dialect{c, "c", {}, all_words_of_c(), false, write_c},
        Dialect{cpp, "c++", {.function_prefix = "std::"}, all_words_of_cpp(), false, write_cpp},
        Dialect{fortran,
                "fortran",
                {.number_ending = "_dp", .power = "**"},
                words(words_of_fortran),
                true,
                write_fortran},
        Dialect{python, "python", {.power = "**"}, words(words_of_python), false, write_python},
        Dialect{julia, "julia", {.power = "^"}, words(words_of_julia), false, write_julia},
        Dialect{freefem,
                "freefem",
                {.power = "^"},
                words(words_of_freefem),
                false,
                write_freefem,
                false},
        Dialect{ufl, "ufl", {.power = "**"}, words(words_of_python), false, write_ufl},
        Dialect{moose,
                "moose",
                {.decimal_point = false, .power = "^"},
                words(words_of_moose),
                false,
                write_moose},
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
    if (reserved.contains(folded(result)))
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

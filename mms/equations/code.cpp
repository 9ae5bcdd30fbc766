#include "mms/equations/code.hpp"

#include "mms/equations/code_lines.hpp"
#include "mms/equations/dialect.hpp"
#include "mms/equations/infix.hpp"
#include "mms/equations/program.hpp"
#include "mms/expression/algebra.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

namespace tvbeam {

namespace {

using Operation = Program::Operation;
using Role = DerivedFunction::Role;

constexpr std::size_t longest_inline = 20'000;
constexpr const char* all_sources = "sources"; // require_names keeps it free

Program program_for(const DerivedSystem& derived, const DerivedFunction& function) {
    try {
        return program_of({function.formula}, derived.fields);
    } catch (const AlgebraError& error) {
        throw InputError(function.source, function.name + ": " + error.what());
    }
}

/// The names of a program that mean something else in the language replaced.
Program renamed(Program program, const Dialect& dialect) {
    program.rename([&](const std::string& name) { return dialect.identifier(name); });
    return program;
}

/// How many operations a step takes; infinitely many where a function is among them.
std::vector<double> operation_counts(const Program& program) {
    std::vector<double> counts;
    for (const auto& step : program.steps()) {
        double count = 0.0;
        for (const int operand : {step.left, step.right})
            if (operand >= 0)
                count += 1.0 + counts[static_cast<std::size_t>(operand)];
        const bool cheap = step.operation != Operation::function &&
                           step.operation != Operation::power &&
                           step.operation != Operation::square_root;
        counts.push_back(cheap ? count : std::numeric_limits<double>::infinity());
    }
    return counts;
}

/// By step: whether there is no name in it, not even pi.
std::vector<bool> numbers_in(const Program& program) {
    std::vector<bool> numbers;
    for (const auto& step : program.steps()) {
        const auto is = [&](int operand) {
            return operand < 0 || numbers[static_cast<std::size_t>(operand)];
        };
        numbers.push_back(step.operation != Operation::name && is(step.left) && is(step.right));
    }
    return numbers;
}

/// Steps that get a name: those that are read more than once and worth one (compilers find pi*y/2
/// again by themselves), and numbers of functions that over- or underflow, where the compiler would
/// refuse exp(-800.0).
std::vector<int> named_steps(const Program& program, const Dialect& dialect) {
    constexpr double worth_a_name = 4.0; // operands: of two operations
    const auto& steps = program.steps();
    const std::vector<double> counts = operation_counts(program);
    const std::vector<bool> numbers = numbers_in(program);
    std::vector<int> reads(steps.size(), 0);
    for (const auto& step : steps)
        for (const int operand : {step.left, step.right})
            if (operand >= 0)
                ++reads[static_cast<std::size_t>(operand)];
    for (const int output : program.outputs())
        ++reads[static_cast<std::size_t>(output)];
    std::vector<int> shared;
    std::vector<bool> named(steps.size(), false);
    if (dialect.refuses_numbers)
        for (const auto& step : steps)
            if (step.operation == Operation::function &&
                (step.text == "exp" || step.text == "sinh" || step.text == "cosh"))
                named[static_cast<std::size_t>(step.left)] =
                    numbers[static_cast<std::size_t>(step.left)];
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (named[i] || (reads[i] > 1 && counts[i] > worth_a_name))
            shared.push_back(static_cast<int>(i));
    return shared;
}

/// The body of a function: what is shared, and the value.
/// `taken`: names of the file, which those of shared parts must not hide.
CodeBody body_of(const Program& program, const Dialect& dialect, std::set<std::string> taken) {
    std::map<int, std::string> names;
    CodeBody body;
    int count = 0;
    const auto free_name = [&](const std::string& wanted) {
        std::string name = dialect.identifier(wanted);
        while (wanted.empty() || !taken.insert(dialect.folded(name)).second) {
            name = "s" + std::to_string(++count);
            if (taken.insert(dialect.folded(name)).second)
                break;
        }
        return name;
    };
    const auto named = [&](int step) {
        const auto found = names.find(step);
        return found == names.end() ? std::string() : found->second;
    };
    for (const int step : named_steps(program, dialect)) {
        const std::string text = infix_text(program, step, dialect.infix, named);
        names[step] = free_name(program.steps()[static_cast<std::size_t>(step)].field);
        body.shared.emplace_back(names[step], text);
    }
    for (const int output : program.outputs())
        body.values.push_back(named(output).empty()
                                  ? infix_text(program, output, dialect.infix, named)
                                  : named(output));
    return body;
}

/// In a comment nothing may end it, or join it to the next line, as the trigraph ??/ of C does.
std::string comment_text(const std::string& text) {
    std::string line;
    for (const char c : text) {
        const bool blank = c == '\n' || c == '\t' || c == '\r' || c == ' ';
        if (blank && (line.empty() || line.back() == ' '))
            continue;
        if (c == '/' && line.ends_with("??"))
            line += ' ';
        const auto byte = static_cast<unsigned char>(c);
        line += blank ? ' ' : (c == '\\' || byte < 0x20U || byte == 0x7FU) ? '?' : c;
    }
    return line;
}

/// The names of a file, as the language tells them apart.
std::set<std::string> require_distinct(const DerivedSystem& derived, const Dialect& dialect) {
    std::map<std::string, std::string> taken = {{"pi", "pi"}};
    const auto add = [&](const std::string& name, const Place& place) {
        const auto [entry, is_new] =
            taken.try_emplace(dialect.folded(dialect.identifier(name)), name);
        if (!is_new && entry->second != name)
            throw InputError(place, "'" + name + "' and '" + entry->second + "' are one name in " +
                                        dialect.name + "; rename one of them");
    };
    for (const auto& name : derived.system.coordinates)
        add(name, {});
    for (std::size_t i = 0; i < derived.parameters.size(); ++i)
        add(derived.parameters[i].name, derived.system.parameters[i].place);
    for (const auto& function : derived.functions)
        add(function.name, function.source);
    std::set<std::string> names;
    for (const auto& [name, written] : taken)
        names.insert(name);
    return names;
}

CodeFile empty_file(const DerivedSystem& derived, const Dialect& dialect) {
    CodeFile file{.name = derived.system.name, .arguments = derived.system.coordinates};
    file.comment = comment_text("Derived from " +
                                std::filesystem::path(derived.system.file).filename().string() +
                                " by tvbeam: " + derived.system.name);
    for (const auto& parameter : derived.parameters)
        if (!parameter.is_number)
            file.constants.emplace_back(dialect.identifier(parameter.name),
                                        (parameter.value < 0.0 ? "-" : "") +
                                            literal_text(std::abs(parameter.value), dialect.infix));
    return file;
}

/// What a program takes of the library, and which arguments it leaves alone.
void note_uses(const Program& program, CodeFile& file, CodeFunction& function) {
    std::set<std::string> library(file.library.begin(), file.library.end());
    for (const auto& step : program.steps())
        if (step.operation == Operation::function || step.operation == Operation::square_root)
            library.insert(step.operation == Operation::function ? step.text : "sqrt");
    file.library.assign(library.begin(), library.end());
    file.uses_pi = file.uses_pi || program.uses("pi");
    for (const auto& argument : file.arguments)
        if (!program.uses(argument))
            function.unused.push_back(argument);
}

/// All sources, of which the parts are shared.
void add_together(const DerivedSystem& derived, const Dialect& dialect,
                  const std::set<std::string>& taken, CodeFile& file) {
    std::vector<GiNaC::ex> formulas;
    std::string names;
    for (const DerivedFunction* source : derived.of_role(Role::source)) {
        formulas.push_back(source->formula);
        names += (names.empty() ? "" : ", ") + source->of;
    }
    if (formulas.size() < 2)
        return;
    const Program program = renamed(program_of(formulas, derived.fields), dialect);
    CodeFunction code{.name = all_sources,
                      .comment = "all sources at once: " + names,
                      .body = body_of(program, dialect, taken)};
    note_uses(program, file, code);
    file.together = code;
}

} // namespace

std::string description_of(const DerivedFunction& function) {
    const std::string place = function.place.empty() ? "" : " at " + function.place;
    const std::string where = " (" +
                              std::filesystem::path(function.source.file).filename().string() +
                              ":" + std::to_string(function.source.line) + ")";
    switch (function.role) {
    case Role::source:
        return "source " + function.of + " = " + function.origin + where;
    case Role::exact:
        return "exact " + function.of + " = " + function.origin + where;
    case Role::gradient:
        return "derivative of the exact " + function.of + " by " +
               std::string(1, function.name.back());
    case Role::boundary:
        return "boundary value " + function.of + place + " = " + function.origin + where;
    case Role::initial:
        break;
    }
    return "initial value " + function.of + place + " = " + function.origin + where;
}

std::string system_code(const DerivedSystem& derived, CodeLanguage language) {
    const Dialect& dialect = dialect_of(language);
    const std::set<std::string> taken = require_distinct(derived, dialect);
    CodeFile file = empty_file(derived, dialect);
    for (const auto& function : derived.functions) {
        const Program program = renamed(program_for(derived, function), dialect);
        CodeFunction code{.name = dialect.identifier(function.name),
                          .comment = comment_text(description_of(function)),
                          .body = body_of(program, dialect, taken)};
        note_uses(program, file, code);
        file.functions.push_back(code);
    }
    add_together(derived, dialect, taken, file);
    return dialect.write(dialect, file);
}

std::string inline_code(const DerivedSystem& derived, const DerivedFunction& function,
                        CodeLanguage language) {
    const Dialect& dialect = dialect_of(language);
    GiNaC::exmap values;
    for (const auto& parameter : derived.parameters)
        values[parameter.symbol] = parameter.exact;
    DerivedFunction numbers = function;
    try {
        numbers.formula = substituted(derived.fields.exact(function.formula), values);
    } catch (const AlgebraError& error) {
        throw InputError(function.source, function.name + ": " + error.what());
    }
    const Program program = program_for(derived, numbers);
    // A text doubles with each part that is used twice.
    std::vector<double> lengths;
    for (const auto& step : program.steps()) {
        double length = 8.0;
        for (const int operand : {step.left, step.right})
            length += operand < 0 ? 0.0 : lengths[static_cast<std::size_t>(operand)];
        lengths.push_back(length);
    }
    if (lengths[static_cast<std::size_t>(program.outputs().front())] > longest_inline)
        throw InputError(function.source,
                         function.name + " is too long for one expression; take the functions of "
                                         "`tvbeam derive --code` in its place");
    return "(" +
           infix_text(program, program.outputs().front(), dialect.infix,
                      [](int) { return std::string(); }) +
           ")";
}

bool is_code_of(CodeLanguage language, const std::string& file) {
    static const std::map<CodeLanguage, std::vector<std::string>> endings{
        {CodeLanguage::c, {".c", ".h"}},
        {CodeLanguage::cpp, {".cpp", ".cc", ".cxx", ".C", ".hpp", ".hh", ".h"}},
        {CodeLanguage::fortran, {".f90", ".F90", ".f95", ".f03", ".f08", ".f", ".F", ".for"}},
        {CodeLanguage::python, {".py"}},
        {CodeLanguage::julia, {".jl"}},
        {CodeLanguage::freefem, {".edp", ".idp"}},
        {CodeLanguage::ufl, {".py", ".ufl"}},
        {CodeLanguage::moose, {}}}; // its input file has values
    return std::ranges::any_of(endings.at(language),
                               [&](const std::string& ending) { return file.ends_with(ending); });
}

std::string inline_number(double value, CodeLanguage language) {
    std::string text = literal_text(value, dialect_of(language).infix);
    constexpr std::string_view as_real = ".0";
    const bool is_python = language == CodeLanguage::python || language == CodeLanguage::ufl;
    if (is_python && text.ends_with(as_real))
        text.resize(text.size() - as_real.size()); // range(2.0) is none, and 1/2 a half
    return value < 0.0 ? "(" + text + ")" : text;
}

} // namespace tvbeam

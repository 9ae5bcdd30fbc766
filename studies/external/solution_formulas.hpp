#pragma once

#include "mms/equations/code.hpp"
#include "studies/external/placeholders.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace tvbeam {

/// What a file of equations gives to templates, in a language:
///
///     {source.f}      the source of an equation; of a vector f by components: {source.f1}
///     {exact.u}       the exact value; {exact.u_x}, {exact.u_y}, {exact.u_z}: its gradient
///     {boundary.q}    a boundary value
///     {initial.u}     an initial value
///     {parameter.k}   the number: in code, by the file's name (is_code_of), as the language writes
///                     an operand (inline_number), else bare
///     {functions}     the functions of `tvbeam derive --code`
///
/// All but the last two are expressions in brackets, of the coordinates, in which parameters are
/// numbers (inline_code).
class SolutionFormulas {
public:
    /// Derives and checks the file. Throws InputError.
    SolutionFormulas(const std::filesystem::path& file, CodeLanguage language);

    /// The template with these filled in, and all others left as they are. Throws InputError at the
    /// first that the file does not have.
    [[nodiscard]] Template filled(const Template& original);

    /// The parameters of the file, which are numbers in its formulas.
    [[nodiscard]] const std::vector<DerivedParameter>& parameters() const {
        return derived_.parameters;
    }

    /// Whether any was.
    [[nodiscard]] bool used() const { return used_; }

private:
    [[nodiscard]] std::string text_of(const std::string& name, const Place& place,
                                      bool is_code) const;

    DerivedSystem derived_;
    CodeLanguage language_;
    std::map<std::string, const DerivedFunction*> functions_; ///< by source.f, exact.u_x, …
    std::map<std::string, double> parameters_;                ///< by parameter.k
    bool used_ = false;
};

} // namespace tvbeam

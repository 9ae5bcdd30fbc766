#pragma once

#include "mms/expression/algebra.hpp"
#include "mms/text/source_text.hpp"

#include <cmath>
#include <sstream>
#include <string>

namespace tvbeam {

/// A number as messages show it.
inline std::string number_text(double value) {
    std::ostringstream stream;
    stream << value;
    return std::isnan(value) ? "nan" : stream.str();
}

/// What the operation gives; where the algebra refuses, an InputError at the beginning of the
/// source, opened by `what`.
template <typename Operation>
auto located(const SourceText& source, const std::string& what, const Operation& operation) {
    try {
        return operation();
    } catch (const AlgebraError& error) {
        throw InputError(source.begin(), what + ": " + error.what());
    }
}

} // namespace tvbeam

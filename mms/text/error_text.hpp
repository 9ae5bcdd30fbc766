#pragma once

#include "mms/expression/algebra.hpp"
#include "mms/text/number_text.hpp"
#include "mms/text/source_text.hpp"

#include <string>

namespace tvbeam {

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

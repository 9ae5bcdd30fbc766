#pragma once

#include "mms/equations/fields.hpp"
#include "mms/equations/tensor.hpp"
#include "mms/text/source_text.hpp"

#include <map>
#include <string>

namespace tvbeam {

/// The names that equations may use, besides pi, identity and the functions.
using TensorTable = std::map<std::string, Tensor>;

/// Reads an expression of a file of equations (equation_system.hpp), by the grammar of all
/// expressions. Derivatives are taken at once; those of unknowns become fields. Throws InputError
/// at the character at fault; a power that is 0^0 with these values of the parameters is one.
Tensor parse_tensor(const SourceText& source, const TensorTable& names, Fields& fields,
                    int dimension, const GiNaC::exmap& parameters = {});

} // namespace tvbeam

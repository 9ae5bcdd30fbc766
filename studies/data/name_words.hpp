#pragma once

#include <set>
#include <string>

namespace tvbeam {

/// The words of a column's name, in small letters: what stands between other characters than
/// letters and digits, as a whole, and its parts that begin with capitals. n, dofs and ndofs of
/// nDofs.
std::set<std::string> words_in(const std::string& name);

} // namespace tvbeam

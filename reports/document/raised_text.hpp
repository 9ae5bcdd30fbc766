#pragma once

#include <string>
#include <string_view>

namespace tvbeam {

/// The text with every letter and digit that stands behind a mark between two others, and without
/// the mark: of "h^2 + 1" with the mark "^" is made "h<sup>2</sup> + 1".
std::string with_raised(std::string_view text, std::string_view mark, std::string_view before,
                        std::string_view behind);

} // namespace tvbeam

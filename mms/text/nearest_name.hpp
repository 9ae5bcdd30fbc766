#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tvbeam {

/// The known name that was probably meant: the one at the smallest edit distance (insertions,
/// deletions, substitutions, swaps of neighbours), if that distance is at most 2 and less than half
/// the longer name's length, rounded up. Upper and lower case count as equal. Empty: none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// `; did you mean 'alpha'?`, or nothing when no known name is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

} // namespace tvbeam

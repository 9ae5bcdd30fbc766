#pragma once

#include <cstddef>
#include <cstdlib>

namespace tvbeam {

/// Whether one of the cases of a sweep over several factors is run: all with TVBEAM_WHOLE_SWEEPS
/// set in the environment; otherwise one in `of`, by the sum of its positions in the factors, so
/// that each value of each factor of `of` or more values is met with every value of the others in
/// turn.
inline bool is_swept(std::size_t sum_of_positions, std::size_t of) {
    return std::getenv("TVBEAM_WHOLE_SWEEPS") != nullptr || sum_of_positions % of == 0;
}

/// Where a value stands in a list.
template <class List, class Value>
std::size_t position(const List& list, const Value& value) {
    std::size_t found = 0;
    while (list[found] != value)
        ++found;
    return found;
}

} // namespace tvbeam

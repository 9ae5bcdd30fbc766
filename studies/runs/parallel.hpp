#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace tvbeam {

/// The indices of costs, the dearest first; of equal ones the first in the list first.
std::vector<std::size_t> longest_first(const std::vector<double>& costs);

/// Calls work(i) once for every index i of costs, in up to `jobs` ≥ 1 threads, each of which takes
/// the dearest index left: then no long piece is begun last. One job makes no thread and takes them
/// as they stand in the list, so that most are done when it is cut short. After a call that throws,
/// no further one is begun; when all have ended, the exception of the first in that order is
/// thrown.
void for_each_longest_first(const std::vector<double>& costs, int jobs,
                            const std::function<void(std::size_t)>& work);

} // namespace tvbeam

#pragma once

#include "studies/gates/expectation.hpp"

#include <vector>

namespace tvbeam {

struct Scene;

/// Reads [[expect.analyse]]: a table of anyone's errors or values (data_file.hpp), analysed as
/// `tvbeam analyse` does it, with expectations of its columns (data_check.hpp), which a file that
/// is no such table violates. That is done here; the result of a run has no part in it. Throws
/// InputError as the other tables do, and what check throws.
void expect_analysed(TableReader& expect, const Scene& scene,
                     std::vector<Expectation>& expectations);

} // namespace tvbeam

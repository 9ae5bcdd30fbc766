#pragma once

#include "studies/gates/expectation.hpp"

#include <vector>

namespace tvbeam {

struct Scene;

/// Reads [expect.derive]: what theory says of the scene's solution before any run, as `tvbeam
/// derive` prints it. What is asked for is computed here, and nothing else; the result of a run
/// has no part in it. Throws InputError as the other tables do, where a term or a norm has none of
/// the names, and where the scene runs no solution.
void expect_derived(TableReader& table, const Scene& scene, std::vector<Expectation>& expectations);

} // namespace tvbeam

#pragma once

#include "studies/gates/expectation.hpp"

#include <vector>

namespace tvbeam {

struct Scene;

/// Reads [[expect.equations]]: a file of equations, or the text of one, and what `tvbeam derive`
/// says of it: `says`, words of its report, or of its code in a `language`, which is not looked at
/// for more; `remarks`, all of them, each by how it begins; or `refused`, words of the message by
/// which it is refused. It is derived when the expectation is asked; the result of a run has no
/// part in it. Throws InputError as the other tables do.
void expect_equations(TableReader& expect, const Scene& scene,
                      std::vector<Expectation>& expectations);

} // namespace tvbeam

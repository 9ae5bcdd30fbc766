#pragma once

#include "studies/gates/expectation.hpp"

#include <vector>

namespace tvbeam {

struct Scene;
struct Reading;

/// Reads [[expect.refused]]: the scene with the keys `set`, or on the solution whose text is
/// `solution`, is refused before anything runs, or a run of it fails, or an expectation among `set`
/// is violated, with a message that holds all of `says`. The result of the scene itself has no part
/// in it. Throws InputError as the other tables do.
void expect_refused(TableReader& expect, const Scene& scene, const Reading& reading,
                    std::vector<Expectation>& expectations);

} // namespace tvbeam

#pragma once

#include "core/certify/solve_record.hpp"

namespace tvbeam {

/// The defects of contact with rigid stops (6)–(8), as the beam has them, after a solve, in lengths
/// over the scale of the tip:
/// the size of the terms that u(1) = ∫ (1 − x) w dx is the sum of. A reaction λ counts with the
/// length |λ| κ/3 by which it moves the tip of a beam without heat.
struct ContactDefects {
    double penetration = 0.0; ///< max(g1 − u, u − g2, 0)
    double wrong_sign = 0.0;  ///< λ of the sign that the nearer stop cannot give
    double complementarity = 0.0; ///< the greater of min(u − g1, λ⁺) and min(g2 − u, λ⁻), or of
                                  ///< their sizes
};

ContactDefects contact_defects(const Beam& beam, const Mesh& mesh, const SolveRecord& record);

} // namespace tvbeam

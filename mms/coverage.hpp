#pragma once

#include "mms/admissible/admissibility.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// A term of (1)–(10), or a case of a condition, and how much a solution makes of it. A defect in a
/// term of size zero stays unseen.
struct TermUse {
    std::string equation; ///< "(1)" … "(10)", or "t = 0"
    std::string term;     ///< e.g. "alpha*u_xxt", "a force at the stop g1"
    double largest =
        0.0; ///< its largest absolute value on [0,1] × [0, final_time] (largest_size.hpp)
    std::string why_not; ///< of a term of size zero

    [[nodiscard]] bool is_exercised() const { return largest > 0.0; }
};

/// Every term in the order of the equations.
std::vector<TermUse> coverage(const AdmissibleSolution& solution);

} // namespace tvbeam

#pragma once

#include "core/norms/norms.hpp"
#include "core/problem.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tvbeam {

/// A problem whose fields are sums of products, as far as runs of the moment form read them.
struct SeparatedProblem {
    ProblemData data;
    Eigen::Index rank = 0; ///< profiles that stand for what did not separate; 0: nothing was done
    /// The greatest difference between a field and its products that was found where neither was
    /// built from, over the greatest |g|.
    double residual = 0.0;
    /// Why what does not separate is left as it is; empty: all of it separates now, or did before.
    std::string reason = {};
};

/// Replaces what does not separate in the heat source, the moment load, the initial curvature and
/// the exact fields of these norms by products, one set of profiles for all of them,
///
///     g(x,t) = Σ_k A_k(t) φ_k(x) + a few ulp of max |g|,
///
/// so that a step no longer evaluates them at every point. In each phase g is expanded in Chebyshev
/// polynomials of x and, piece by piece, of t, until the coefficients have fallen to round-off
/// (Townsend and Trefethen, SIAM J. Sci. Comput. 35 (2013) C495, expand likewise); the φ_k are an
/// orthonormal basis of all the columns of coefficients, by a QR factorisation with pivoting. The
/// result is compared with g in 16 places at a time in every eight steps, at least at 512 and at
/// most at 65536 times, and at 16 more a piece. What is there for a shorter time than between two
/// of these can be missed, and what is narrower than 1/160 and there for few of them. Where a layer
/// or a kink would take too high a degree, the rank would not pay, or the comparison fails, the
/// problem stays as it is, with a reason. The paper's algorithm reads other fields, which stay as
/// they are: it checks this.
///
/// steps: the most that a run makes of the final time; 0: not known, as few as are compared.
///
/// data.resolution, where it is there, is kept: that of the functions themselves.
SeparatedProblem separated(const ProblemData& data, const std::vector<Norm>& norms,
                           double final_time, std::int64_t steps = 0);

} // namespace tvbeam

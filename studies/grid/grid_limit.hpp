/// What a grid of values says of their limit, where no exact solution is known.
///
/// With v(h, Δt) = v₀ + A(h) + B(Δt) + m(h, Δt), where m vanishes with either width, the limit L_h
/// in h at the finest Δt and the limit L_Δt in Δt at the finest h (limit_engine.hpp) give
///
///     v₀ = L_h + L_Δt − v_f + m_f                 v_f: the value of the finest run, m_f: m there
///
/// The second difference D of the finest two meshes and steps is one of m alone: with the orders p
/// and q and the ratios r and k of these widths m_f ≈ D / ((r^p − 1)(k^q − 1)). The interval is as
/// wide as both together, and holds m_f, which is not put in.
#pragma once

#include "studies/orders/order_engine.hpp"
#include "studies/runs/run.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace tvbeam {

struct GridLimit {
    std::string value;   ///< its name
    OrderInterval limit; ///< in both widths, 95 %
    OrderInterval p;     ///< order in h, along the finest Δt
    OrderInterval q;     ///< order in Δt, along the finest h
    double uncertainty =
        std::numeric_limits<double>::infinity(); ///< of the finest value, 95 %, half width
    /// Half of the interval of L_h, and of L_Δt; infinite where they are not determined.
    double half_in_h = std::numeric_limits<double>::infinity();
    double half_in_dt = std::numeric_limits<double>::infinity();
    /// Runs that the limit does not come from, and that no such v goes with.
    std::vector<Rung> out_of_line = {};
};

/// Of measure k of the runs, a grid. Where one of the two limits is not determined, or a run failed
/// that v_f or D comes from, there is none, and the status says which.
GridLimit limit_of(const std::string& name, const std::vector<RungResult>& runs, std::size_t k);

} // namespace tvbeam

#include "core/certify/contact_law.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

ContactDefects contact_defects(const Beam& beam, const Mesh& mesh, const SolveRecord& record) {
    const double kappa = 1.0 / (1.0 + beam.zeta * record.leading);
    const double tip = certify::tip_moment(mesh, record.now.w);
    const double reaction = record.stress * kappa / 3.0;
    const double scale = record.now.curvature_size / 2.0; // ∫ (1 − x) dx = 1/2
    if (scale == 0.0)
        return {};
    const double above_lower = tip - beam.stops.lower / record.unit;
    const double below_upper = beam.stops.upper / record.unit - tip;
    ContactDefects defects;
    defects.penetration = std::max({-above_lower, -below_upper, 0.0}) / scale;
    const double at_lower = std::min(above_lower, std::max(reaction, 0.0));
    const double at_upper = std::min(below_upper, std::max(-reaction, 0.0));
    defects.complementarity = std::max(std::abs(at_lower), std::abs(at_upper)) / scale;
    if ((reaction > 0.0 && below_upper < above_lower) ||
        (reaction < 0.0 && above_lower < below_upper))
        defects.wrong_sign =
            std::min(std::abs(reaction), std::max(above_lower, below_upper)) / scale;
    return defects;
}

} // namespace tvbeam

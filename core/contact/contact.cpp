#include "core/contact/contact.hpp"

#include <cmath>

namespace tvbeam {

double contact_stress(const Stops& stops, double free_tip, double compliance) {
    if (free_tip < stops.lower)
        return (stops.lower - free_tip) / (compliance + stops.epsilon);
    if (free_tip > stops.upper)
        return (stops.upper - free_tip) / (compliance + stops.epsilon);
    return std::isnan(free_tip) ? free_tip : 0.0;
}

} // namespace tvbeam

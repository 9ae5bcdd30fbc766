#include "mms/admissible/sampled_rules.hpp"

#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;

double largest_on_grid(const SpaceTimeFunction& g, const ArrayXd& times, double final_time,
                       const Place& place, const std::string& what) {
    const ArrayXd x = sample_points(0.0, 1.0);
    double result = 0.0;
    for (const double t : times) {
        const ArrayXd values = g(x, t);
        for (Index k = 0; k < x.size(); ++k) {
            if (!std::isfinite(values(k)))
                throw InputError(place, what + " is not finite at x = " + number_text(x(k)) +
                                            ", t = " + number_text(t) + " (it is " +
                                            number_text(values(k)) +
                                            "); write it so that it and its derivatives exist "
                                            "everywhere on [0, 1] x [0, " +
                                            number_text(final_time) + "]" +
                                            (t > 0.0 ? ", or end the run before that time" : ""));
            result = std::max(result, std::abs(values(k)));
        }
    }
    return result;
}

void require_value(const ArrayXd& differences, const ArrayXd& times, double value, double tolerance,
                   const Place& place, const std::string& what, const std::string& rule) {
    const auto broken = std::find_if(differences.begin(), differences.end(),
                                     [tolerance](double d) { return !(std::abs(d) <= tolerance); });
    if (broken != differences.end())
        throw InputError(place, what + " is " + number_text(value + *broken) +
                                    " at t = " + number_text(times(broken - differences.begin())) +
                                    "; it must be " + rule);
}

std::string jump_text(const std::string& what, double jump, double t, double x) {
    return what + " jumps by " + number_text(jump) + " at t = " + number_text(t) +
           ", x = " + number_text(x) + "; it must be continuous: ";
}

} // namespace tvbeam

#include "core/problem.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

bool Stops::exist() const {
    return std::isfinite(lower) || std::isfinite(upper);
}

bool Field::uses(Eigen::Index profile) const {
    return std::any_of(terms.begin(), terms.end(),
                       [&](const Term& term) { return term.profile == profile; });
}

Eigen::ArrayXd values(const ProblemData& data, const Field& field, const Eigen::ArrayXd& x,
                      double t) {
    Eigen::ArrayXd result = Eigen::ArrayXd::Zero(x.size());
    if (!field.terms.empty()) {
        const Eigen::ArrayXXd amplitudes = data.amplitudes(Eigen::ArrayXd::Constant(1, t));
        for (const auto& term : field.terms)
            result += amplitudes(term.amplitude, 0) *
                      data.profiles[static_cast<std::size_t>(term.profile)](x);
    }
    if (field.rest)
        result += field.rest(x, t);
    return result;
}

} // namespace tvbeam

#include "mms/sampled_fields.hpp"

#include <cmath>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;

SampledFields::SampledFields(const ProblemData& problem, const ArrayXd& x, const ArrayXd& t)
    : x_(x), t_(t) {
    if (problem.amplitude_count > 0)
        amplitudes_ = problem.amplitudes(t);
    for (const SpaceFunction& profile : problem.profiles)
        profiles_.push_back(profile(x));
}

ComputedValues SampledFields::of(const Field& field) const {
    ComputedValues result = ComputedValues::of(ArrayXd::Zero(x_.size()));
    const auto add = [&result](const ArrayXd& term) {
        result.values += term;
        result.terms += term.abs();
    };
    for (const Field::Term& term : field.terms)
        add(amplitudes_.row(term.amplitude).transpose() *
            profiles_[static_cast<std::size_t>(term.profile)]);
    ArrayXd rest = ArrayXd::Zero(x_.size());
    for (Index k = 0; field.rest && k < x_.size(); ++k)
        rest(k) = field.rest(x_.segment(k, 1), t_(k))(0);
    add(rest);
    return result;
}

ComputedValues SampledFields::of(const std::optional<Index>& amplitude) const {
    return ComputedValues::of(amplitude ? ArrayXd(amplitudes_.row(*amplitude))
                                        : ArrayXd(ArrayXd::Zero(x_.size())));
}

} // namespace tvbeam

#pragma once

#include "core/problem.hpp"
#include "mms/expression/agreement.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace tvbeam {

/// The fields of a problem at points of space and time, with the sizes of their products.
class SampledFields {
public:
    SampledFields(const ProblemData& problem, const Eigen::ArrayXd& x, const Eigen::ArrayXd& t);

    [[nodiscard]] ComputedValues of(const Field& field) const;

    /// Of an amplitude; none: zero.
    [[nodiscard]] ComputedValues of(const std::optional<Eigen::Index>& amplitude) const;

private:
    Eigen::ArrayXd x_, t_;
    Eigen::ArrayXXd amplitudes_;           ///< one row each, one column a point
    std::vector<Eigen::ArrayXd> profiles_; ///< at the points
};

} // namespace tvbeam

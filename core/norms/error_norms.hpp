#pragma once

#include "core/norms/norm_sums.hpp"
#include "core/problem.hpp"
#include "core/solver.hpp"
#include "core/space/profile.hpp"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace tvbeam {

class MomentForm;

/// Accumulates error norms against an exact solution along a run. Only the quantities that a
/// requested norm needs are integrated. Two ways of integrating one quantity, the same to
/// round-off:
///
/// - split: where the exact function is a sum of products, ‖Θ − θ‖ and ‖U_xx − u_xx‖ of the moment
/// form come from nodal
///   errors and constants (ErrorProfiles), a few operations a node;
/// - pointwise: anything else is evaluated at the quadrature points of every element, or of every
///   element of a computed solution that it is compared with.
class ErrorNorms {
public:
    /// data.exact must be set; data must outlive the object. moment_form: the solver when it is
    /// one, else null.
    ErrorNorms(const Beam& beam, const ProblemData& data, const Mesh& mesh,
               const std::vector<Norm>& norms, const MomentForm* moment_form);
    ~ErrorNorms();
    ErrorNorms(const ErrorNorms&) = delete;
    ErrorNorms& operator=(const ErrorNorms&) = delete;
    ErrorNorms(ErrorNorms&&) = delete;
    ErrorNorms& operator=(ErrorNorms&&) = delete;

    /// What a solver must provide for these norms with these data.
    static Needs needs(const ProblemData& data, const std::vector<Norm>& norms);

    /// Adds the time level t = t_n of weight dt.
    void add(double t, double dt, const Solver& solver,
             const Eigen::Ref<const Eigen::VectorXd>& amplitudes);

    /// The norms so far, in the order in which they were asked for; NaN or infinite when the error
    /// is.
    [[nodiscard]] std::vector<double> values() const { return sums_.values(); }

    /// Spatial norms integrated so far.
    [[nodiscard]] std::int64_t evaluations() const { return sums_.evaluations(); }

    /// Doubles held by the tables of this object.
    [[nodiscard]] std::int64_t doubles_allocated() const;

private:
    class SplitTemperature;
    class SplitCurvatureError;
    class Pointwise;

    const ProblemData& data_;
    NormSums sums_;
    const MomentForm* moment_form_;
    std::unique_ptr<SplitTemperature> temperature_;
    std::unique_ptr<SplitCurvatureError> curvature_;
    std::unique_ptr<Pointwise> pointwise_;
};

} // namespace tvbeam

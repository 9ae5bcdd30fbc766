#include "core/norms/error_norms.hpp"

#include "core/dense_kernels.hpp"
#include "core/moment_form.hpp"
#include "core/space/cells.hpp"
#include "core/space/deflection.hpp"
#include "core/space/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace tvbeam {

namespace {

/// Whether ‖U_xx − u_xx‖ can be split: w then has no part that is known on points only.
bool curvature_splits(const ProblemData& data) {
    return data.exact->u_xx.is_separable() && data.moment_load.is_separable() &&
           data.curvature_initial.is_separable();
}

/// The mesh with the cells of the pointwise norms. Where the exact solution is a computed one on a
/// finer mesh, its kinks lie inside: each of its elements is then a cell, on which the rule is
/// exact for both.
Mesh pointwise_mesh(const ExactSolution& exact, const Mesh& mesh) {
    if (exact.elements == 0)
        return mesh;
    if (exact.elements % mesh.elements() != 0)
        throw std::invalid_argument("a solution on " + std::to_string(exact.elements) +
                                    " elements cannot be compared with one on " +
                                    std::to_string(mesh.elements()));
    return with_equal_cells(mesh, exact.elements / mesh.elements());
}

/// The distinct profiles of some fields, with the functions that belong to them.
struct ProfileSelection {
    std::vector<Eigen::Index> profiles;
    std::vector<SpaceFunction> functions;

    void add(const ProblemData& data, const Field& field) {
        for (const auto& term : field.terms)
            if (std::find(profiles.begin(), profiles.end(), term.profile) == profiles.end()) {
                profiles.push_back(term.profile);
                functions.push_back(data.profiles[static_cast<std::size_t>(term.profile)]);
            }
    }
    [[nodiscard]] Eigen::Index column(Eigen::Index profile) const {
        return std::find(profiles.begin(), profiles.end(), profile) - profiles.begin();
    }
};

/// eᵀM_c e + 2 γ·(defectᵀe) + γᵀQγ with the nodal error e.
double split_square(const Mesh& mesh, const ErrorProfiles& profiles, const Eigen::VectorXd& error,
                    const Eigen::VectorXd& gamma, const Eigen::MatrixXd& gram) {
    Eigen::VectorXd with_defects = Eigen::VectorXd::Zero(gamma.size());
    add_inner_products(with_defects, profiles.defect_load, error);
    return squared_norm(mesh, error) + 2.0 * gamma.dot(with_defects) + gamma.dot(gram * gamma);
}

/// A square that round-off made negative is zero; NaN stays NaN.
double non_negative(double square) {
    return square < 0.0 ? 0.0 : square;
}

} // namespace

/// ‖Θ̃ − θ̃‖² for θ̃ = Σ τ_r φ_r: the error is (Θ̃ − I_hθ̃) − Σ τ_r (φ_r − I_hφ_r).
class ErrorNorms::SplitTemperature {
public:
    SplitTemperature(const Beam& beam, const ProblemData& data, const Mesh& mesh)
        : mesh_(mesh), field_(data.exact->theta) {
        selection_.add(data, field_);
        profiles_ = error_profiles(mesh, selection_.functions);
        lift_ = beam.theta_A * (1.0 - mesh.nodes).matrix();
    }

    double square(const Solver& solver, const Eigen::Ref<const Eigen::VectorXd>& amplitudes) {
        gamma_.setZero(static_cast<Eigen::Index>(selection_.profiles.size()));
        for (const auto& term : field_.terms)
            gamma_(selection_.column(term.profile)) -= amplitudes(term.amplitude);
        error_ = solver.temperature() + lift_;
        add_product(error_, profiles_.nodal, gamma_, error_.size());
        return non_negative(
            split_square(mesh_, profiles_, error_, gamma_, profiles_.interpolation));
    }

    [[nodiscard]] std::int64_t size() const {
        return profiles_.nodal.size() + profiles_.defect_load.size() + lift_.size() + error_.size();
    }

private:
    const Mesh& mesh_;
    const Field& field_;
    ProfileSelection selection_;
    ErrorProfiles profiles_;
    Eigen::VectorXd lift_;
    Eigen::VectorXd gamma_;
    Eigen::VectorXd error_;
};

/// ‖w − u_xx‖² for w = a + Σ c_r Πφ_r + c_arm(1 − x) and u_xx = Σ τ_r φ_r: with γ = c − τ the
/// error is (a + c_arm(1 − x) + Σ γ_r I_hφ_r) + Σ γ_r (Πφ_r − I_hφ_r) − Σ τ_r (φ_r − Πφ_r).
class ErrorNorms::SplitCurvatureError {
public:
    SplitCurvatureError(const ProblemData& data, const Mesh& mesh)
        : mesh_(mesh), field_(data.exact->u_xx), arm_((1.0 - mesh.nodes).matrix()) {
        selection_.add(data, field_);
        selection_.add(data, data.moment_load);
        selection_.add(data, data.curvature_initial);
        profiles_ = error_profiles(mesh, selection_.functions);
        between_ = profiles_.interpolation - profiles_.projection;
    }

    double square(const MomentForm& solver, const Eigen::Ref<const Eigen::VectorXd>& amplitudes) {
        const SplitCurvature& w = solver.split_curvature();
        tau_.setZero(static_cast<Eigen::Index>(selection_.profiles.size()));
        for (const auto& term : field_.terms)
            tau_(selection_.column(term.profile)) += amplitudes(term.amplitude);
        gamma_ = -tau_;
        for (Eigen::Index r = 0; r < gamma_.size(); ++r)
            gamma_(r) += w.weights(selection_.profiles[static_cast<std::size_t>(r)]);
        error_ = w.weights.tail<1>()(0) * arm_;
        if (w.nodal.size() > 0)
            error_ += w.nodal;
        add_product(error_, profiles_.nodal, gamma_, error_.size());
        return non_negative(split_square(mesh_, profiles_, error_, gamma_, between_) +
                            tau_.dot(profiles_.projection * tau_));
    }

    [[nodiscard]] std::int64_t size() const {
        return profiles_.nodal.size() + profiles_.defect_load.size() + arm_.size() + error_.size();
    }

private:
    const Mesh& mesh_;
    const Field& field_;
    ProfileSelection selection_;
    ErrorProfiles profiles_;
    Eigen::MatrixXd
        between_; // (Πφ_r − I_hφ_r, Πφ_s − I_hφ_s) = Q − P, as φ − Πφ is orthogonal to P1disc
    Eigen::VectorXd arm_;
    Eigen::VectorXd tau_;
    Eigen::VectorXd gamma_;
    Eigen::VectorXd error_;
};

/// Squares of errors by quadrature of the pointwise error; exact functions are read through their
/// profiles at all quadrature points where they separate.
class ErrorNorms::Pointwise {
public:
    Pointwise(const Beam& beam, const ProblemData& data, const Mesh& mesh,
              const QuantitySet& needed)
        : beam_(beam), data_(data), mesh_(pointwise_mesh(*data.exact, mesh)), needed_(needed),
          cells_(integration_mesh(mesh_)), rule_(element_rule()),
          points_((rule_.points.matrix() * cells_.lengths.matrix().transpose()).array().rowwise() +
                  cells_.nodes.head(cells_.elements()).transpose()),
          weights_((rule_.weights.matrix() * cells_.lengths.matrix().transpose()).array()) {
        const auto exact = data.exact->fields();
        tables_.resize(data.profiles.size());
        for (std::size_t q = 0; q < exact.size(); ++q)
            if (needed_[q])
                for (const auto& term : exact[q]->terms) {
                    const auto r = static_cast<std::size_t>(term.profile);
                    if (tables_[r].size() == 0)
                        tables_[r] = at_points(data.profiles[r], points_);
                }
    }

    Squares squares(double t, const Solver& solver,
                    const Eigen::Ref<const Eigen::VectorXd>& amplitudes) {
        const auto exact = data_.exact->fields();
        const Eigen::ArrayXd& xi = rule_.points;
        const Eigen::Index s = mesh_.elements();
        Squares result = unmeasured();
        const auto integrate = [&](Quantity quantity, const Eigen::ArrayXXd& discrete) {
            const std::size_t q = index(quantity);
            Eigen::ArrayXXd error = discrete;
            for (const auto& term : exact[q]->terms)
                error -=
                    amplitudes(term.amplitude) * tables_[static_cast<std::size_t>(term.profile)];
            if (const auto& rest = exact[q]->rest)
                error -= rest(points_.reshaped(), t).reshaped(points_.rows(), points_.cols());
            result[q] = (error.square() * weights_).sum();
        };
        if (needs(Quantity::theta) || needs(Quantity::theta_x)) {
            const Eigen::ArrayXd nodal =
                solver.temperature().array() + beam_.theta_A * (1.0 - mesh_.nodes);
            Eigen::Array2Xd ends(2, s);
            ends << nodal.head(s).transpose(), nodal.tail(s).transpose();
            if (needs(Quantity::theta)) {
                const Eigen::Array2Xd theta = at_cell_ends(mesh_, 0, ends);
                integrate(Quantity::theta, ((1.0 - xi).matrix() * theta.row(0).matrix() +
                                            xi.matrix() * theta.row(1).matrix())
                                               .array());
            }
            if (needs(Quantity::theta_x)) {
                const Eigen::ArrayXd slope = (nodal.tail(s) - nodal.head(s)) / mesh_.lengths;
                ends << slope.transpose(), slope.transpose();
                integrate(Quantity::theta_x,
                          at_cell_ends(mesh_, 0, ends).row(0).replicate(xi.size(), 1));
            }
        }
        if (needs(Quantity::u) || needs(Quantity::u_x) || needs(Quantity::u_xx))
            integrate_deflection(solver, integrate);
        return result;
    }

private:
    [[nodiscard]] bool needs(Quantity quantity) const { return needed_[index(quantity)]; }

    template <typename Integrate>
    void integrate_deflection(const Solver& solver, const Integrate& integrate) {
        const Eigen::ArrayXd& xi = rule_.points;
        const Eigen::Index s = cells_.elements();
        const DiscontinuousLinear w = at_cell_ends(mesh_, 0, solver.curvature());
        // On a cell: U = U_l + h ξ U_l' + h² (w_l ξ²/2 + (w_r − w_l) ξ³/6).
        const Eigen::RowVectorXd h = cells_.lengths.matrix().transpose();
        const Eigen::RowVectorXd left = w.row(0).matrix();
        const Eigen::RowVectorXd change = (w.row(1) - w.row(0)).matrix();
        const Eigen::RowVectorXd ones = Eigen::RowVectorXd::Ones(s);
        const Eigen::VectorXd at = xi.matrix();
        const Eigen::VectorXd one = Eigen::VectorXd::Ones(xi.size());
        if (needs(Quantity::u_xx))
            integrate(Quantity::u_xx, (one * left + at * change).array());
        if (!needs(Quantity::u) && !needs(Quantity::u_x))
            return;
        const Deflection nodal = deflection(cells_, w);
        const Eigen::RowVectorXd value = nodal.value.head(s).transpose();
        const Eigen::RowVectorXd slope = nodal.slope.head(s).transpose();
        const Eigen::VectorXd half_square = (xi.square() / 2.0).matrix();
        const Eigen::VectorXd sixth_cube = (xi.cube() / 6.0).matrix();
        if (needs(Quantity::u_x))
            integrate(Quantity::u_x, (one * slope + at * h.cwiseProduct(left) +
                                      half_square * h.cwiseProduct(change))
                                         .array());
        if (needs(Quantity::u)) {
            const Eigen::RowVectorXd h2 = h.cwiseProduct(h);
            integrate(Quantity::u,
                      (one * value + at * h.cwiseProduct(slope) +
                       half_square * h2.cwiseProduct(left) + sixth_cube * h2.cwiseProduct(change))
                          .array());
        }
    }

public:
    [[nodiscard]] std::int64_t size() const {
        std::int64_t total = points_.size() + weights_.size();
        for (const auto& table : tables_)
            total += table.size();
        return total;
    }

private:
    Beam beam_;
    const ProblemData& data_;
    const Mesh mesh_;
    QuantitySet needed_;
    const Mesh& cells_;
    const GaussRule& rule_;
    Eigen::ArrayXXd points_;
    Eigen::ArrayXXd weights_;
    std::vector<Eigen::ArrayXXd> tables_; // φ_r at the points; empty where no norm needs it
};

ErrorNorms::ErrorNorms(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                       const std::vector<Norm>& norms, const MomentForm* moment_form)
    : data_(data), sums_(norms), moment_form_(moment_form) {
    const QuantitySet& needed = sums_.needed();
    QuantitySet pointwise = needed;
    pointwise[index(Quantity::stress)] = false;
    if (needed[index(Quantity::theta)] && data.exact->theta.is_separable()) {
        temperature_ = std::make_unique<SplitTemperature>(beam, data, mesh);
        pointwise[index(Quantity::theta)] = false;
    }
    if (needed[index(Quantity::u_xx)] && moment_form != nullptr && curvature_splits(data)) {
        curvature_ = std::make_unique<SplitCurvatureError>(data, mesh);
        pointwise[index(Quantity::u_xx)] = false;
    }
    if (std::find(pointwise.begin(), pointwise.end(), true) != pointwise.end())
        pointwise_ = std::make_unique<Pointwise>(beam, data, mesh, pointwise);
}

ErrorNorms::~ErrorNorms() = default;

Needs ErrorNorms::needs(const ProblemData& data, const std::vector<Norm>& norms) {
    if (norms.empty())
        return {};
    const QuantitySet set = quantities_of(norms);
    const bool integrates = set[index(Quantity::u)] || set[index(Quantity::u_x)];
    const bool bends = integrates || set[index(Quantity::u_xx)];
    return {.temperature = set[index(Quantity::theta)] || set[index(Quantity::theta_x)],
            .deflection = bends || set[index(Quantity::stress)],
            .curvature = integrates || (bends && !curvature_splits(data))};
}

void ErrorNorms::add(double t, double dt, const Solver& solver,
                     const Eigen::Ref<const Eigen::VectorXd>& amplitudes) {
    Squares squares = unmeasured();
    if (pointwise_)
        squares = pointwise_->squares(t, solver, amplitudes);
    if (temperature_)
        squares[index(Quantity::theta)] = temperature_->square(solver, amplitudes);
    if (curvature_)
        squares[index(Quantity::u_xx)] = curvature_->square(*moment_form_, amplitudes);
    if (sums_.needed()[index(Quantity::stress)]) {
        const double exact = data_.exact->stress ? amplitudes(*data_.exact->stress) : 0.0;
        const double error = solver.contact_stress() - exact;
        squares[index(Quantity::stress)] = error * error;
    }
    sums_.add(dt, squares);
}

std::int64_t ErrorNorms::doubles_allocated() const {
    return (temperature_ ? temperature_->size() : 0) + (curvature_ ? curvature_->size() : 0) +
           (pointwise_ ? pointwise_->size() : 0);
}

} // namespace tvbeam

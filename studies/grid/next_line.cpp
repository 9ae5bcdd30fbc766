#include "studies/grid/next_line.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tvbeam {

namespace {

/// Where ln a, p, ln b, q, ρ stand among the parameters; behind them β of each mesh, γ of each
/// step.
constexpr Eigen::Index place_of_p = 1;
constexpr Eigen::Index place_of_q = 3;
constexpr Eigen::Index shared_parameters = 5;

/// Half of an interval that says nothing, over what is wanted.
constexpr double says_nothing = 100.0;

/// The leading terms of a fit, as a function of where they are evaluated.
class LeadingTerms {
public:
    explicit LeadingTerms(const TermFit& fit)
        : fit_(fit), rho_(fit.correlation(0, 1).value),
          variance_(std::max(fit.scale * fit.scale, least_variance)) {}

    /// The standard error of a parameter on a grid.
    [[nodiscard]] double error_on(const GridLines& lines, Eigen::Index parameter) const {
        const auto meshes = static_cast<Eigen::Index>(lines.meshes.size());
        const auto steps = static_cast<Eigen::Index>(lines.steps.size());
        const Eigen::Index count = shared_parameters + meshes + steps;
        Eigen::MatrixXd information = Eigen::MatrixXd::Identity(count, count);
        information.diagonal().head(shared_parameters).setConstant(variance_); // of one
        for (Eigen::Index i = 0; i < meshes; ++i)
            for (Eigen::Index j = 0; j < steps; ++j) {
                const Rung run =
                    lines.run(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
                Eigen::VectorXd row = Eigen::VectorXd::Zero(count);
                row.head(shared_parameters) = gradient(std::log(run.h()), std::log(run.dt));
                row[shared_parameters + i] = row[0];
                row[shared_parameters + meshes + j] = row[2];
                information += row * row.transpose();
            }
        const Eigen::VectorXd unit = Eigen::VectorXd::Unit(count, parameter);
        return std::sqrt(variance_ * information.ldlt().solve(unit)[parameter]);
    }

private:
    /// Below this the fit is exact, and the solve is not.
    static constexpr double least_variance = 1e-8;

    /// ∂ ln e / ∂ (ln a, p, ln b, q, ρ), with a and b in the units of the fit.
    [[nodiscard]] Eigen::VectorXd gradient(double log_h, double log_dt) const {
        const double t = fit_.term(0, log_h);
        const double s = fit_.term(1, log_dt);
        const double square = t * t + 2.0 * rho_ * t * s + s * s;
        const double by_t = (t * t + rho_ * t * s) / square;
        const double by_s = (s * s + rho_ * t * s) / square;
        Eigen::VectorXd row(shared_parameters);
        row << by_t, by_t * (log_h - fit_.log_centre[0]), by_s,
            by_s * (log_dt - fit_.log_centre[1]), t * s / square;
        return row.allFinite() ? row : Eigen::VectorXd::Zero(shared_parameters);
    }

    const TermFit& fit_;
    double rho_;
    double variance_;
};

double part_of(double half, double wanted) {
    return std::isfinite(half) ? std::min(half / wanted, says_nothing) : says_nothing;
}

/// (fine / coarse)^order of the last two lines: by what part of itself a term is smaller.
double shrunk(double coarse, double fine, const OrderInterval& order) {
    return std::pow(fine / coarse, order.determined ? order.value : 1.0);
}

template <typename With>
double gain(const std::vector<OpenInterval>& open, double cost, const With& with) {
    const auto widest =
        std::max_element(open.begin(), open.end(),
                         [](const auto& left, const auto& right) { return left.now < right.now; });
    return (1.0 - with(*widest) / widest->now) / cost;
}

} // namespace

OpenInterval open_order(const TwoTermFit& fit, bool in_h, double wanted, const GridLines& lines,
                        const GridLines& finer_mesh, const GridLines& finer_step) {
    const OrderInterval& order = in_h ? fit.p : fit.q;
    const double now = part_of(order.determined ? order.half_width() : infinity, wanted);
    OpenInterval open{now, now, now};
    // What is narrow, and still open, is not what its grid shows without its finest line: another
    // line of its own is to say which of the two is wrong.
    if (now <= 1.0) {
        (in_h ? open.with_mesh : open.with_step) = 0.0;
        return open;
    }
    const auto* steadiest = fit.ensemble ? fit.ensemble->steadiest() : nullptr;
    if (steadiest == nullptr)
        return open;
    const LeadingTerms terms(steadiest->fit);
    const Eigen::Index parameter = in_h ? place_of_p : place_of_q;
    const double present = terms.error_on(lines, parameter);
    open.with_mesh *= std::min(1.0, terms.error_on(finer_mesh, parameter) / present);
    open.with_step *= std::min(1.0, terms.error_on(finer_step, parameter) / present);
    return open;
}

OpenInterval open_limit(const GridLimit& limit, double wanted, const GridLines& lines,
                        const GridLines& finer_mesh, const GridLines& finer_step) {
    const double in_h = part_of(limit.half_in_h, wanted);
    const double in_dt = part_of(limit.half_in_dt, wanted);
    const double finer_h =
        in_h * shrunk(lines.meshes.back().h(), finer_mesh.meshes.back().h(), limit.p);
    const double finer_dt =
        in_dt * shrunk(lines.steps.back().dt, finer_step.steps.back().dt, limit.q);
    return {in_h + in_dt, finer_h + in_dt, in_h + finer_dt};
}

double gain_of_mesh(const std::vector<OpenInterval>& open, double cost) {
    return gain(open, cost, [](const OpenInterval& one) { return one.with_mesh; });
}

double gain_of_step(const std::vector<OpenInterval>& open, double cost) {
    return gain(open, cost, [](const OpenInterval& one) { return one.with_step; });
}

ForecastSeconds::ForecastSeconds(const GridLines& lines, const std::vector<RungResult>& runs) {
    constexpr std::size_t finest = 3;
    const auto least = lines.meshes[lines.meshes.size() - std::min(finest, lines.meshes.size())];
    const auto longest = lines.steps[lines.steps.size() - std::min(finest, lines.steps.size())];
    std::vector<Eigen::Vector3d> rows;
    std::vector<double> logs;
    for (const auto& run : runs)
        if (run.rung.elements >= least.elements && run.rung.dt <= longest.dt &&
            run.seconds_taken() > 0.0) {
            rows.emplace_back(1.0, -std::log(run.rung.h()), -std::log(run.rung.dt));
            logs.push_back(std::log(run.seconds_taken()));
        }
    if (rows.size() < 4) { // a clock that shows nothing
        log_factor_ = -infinity;
        return;
    }
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), 3);
    for (std::size_t i = 0; i < rows.size(); ++i)
        matrix.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
    const Eigen::Map<const Eigen::VectorXd> wanted(logs.data(), matrix.rows());
    const Eigen::Vector3d law = matrix.colPivHouseholderQr().solve(wanted);
    in_elements_ = std::max(0.0, law[1]);
    in_steps_ = std::max(0.0, law[2]);
    // With powers that are not the fit's own the factor is another.
    log_factor_ = (wanted - in_elements_ * matrix.col(1) - in_steps_ * matrix.col(2)).mean();
}

double ForecastSeconds::operator()(const Rung& run) const {
    return std::exp(log_factor_ - in_elements_ * std::log(run.h()) - in_steps_ * std::log(run.dt));
}

} // namespace tvbeam

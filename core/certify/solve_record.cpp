#include "core/certify/solve_record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tvbeam {

namespace {

double largest(const certify::BrokenLinear& p) {
    return p.abs().maxCoeff();
}

/// to += factor · (later − earlier), and the sizes of what it is the sum of.
void add_increment(RecordedState& to, double factor, const RecordedState& later,
                   const RecordedState& earlier) {
    to.theta += factor * (later.theta - earlier.theta);
    to.w += factor * (later.w - earlier.w);
    for (const auto size : {&RecordedState::temperature_size, &RecordedState::terms_size,
                            &RecordedState::curvature_size})
        to.*size = std::max({to.*size, later.*size, earlier.*size});
}

} // namespace

SolveRecorder::SolveRecorder(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                             std::string scheme, double dt, const RecordOptions& options,
                             SolverState initial)
    : beam_(beam), data_(data), mesh_(mesh), scheme_(std::move(scheme)), options_(options) {
    record_.dt = dt;
    record_.unit = options.unit;
    for (std::size_t r = 0; r < data_.profiles.size(); ++r) {
        const bool heats = data_.heat_source.uses(static_cast<Eigen::Index>(r));
        const bool bends = data_.moment_load.uses(static_cast<Eigen::Index>(r));
        certify::Load load;
        if (heats || bends)
            load = certify::load_of(mesh_, data_.profiles[r]);
        heat_loads_.push_back(heats ? std::move(load.hat) : Eigen::VectorXd());
        moments_.push_back(bends ? std::move(load.projection) : certify::BrokenLinear(2, 0));
    }
    RecordedState state = in_units(std::move(initial));
    state.temperature_size = state.theta.cwiseAbs().maxCoeff();
    state.terms_size = std::max(largest(state.w), options_.least_size);
    state.curvature_size = state.terms_size;
    levels_.push_back(std::move(state));
}

RecordedState SolveRecorder::in_units(SolverState state) const {
    state.theta /= options_.unit;
    state.w /= options_.unit;
    return {std::move(state.theta), std::move(state.w)};
}

const RecordedState& SolveRecorder::before(std::size_t steps) const {
    return levels_[steps - 1];
}

const RecordedState& SolveRecorder::stage(Eigen::Index i) const {
    return i + 1 < made_ ? stages_[static_cast<std::size_t>(i)] : record_.now;
}

void SolveRecorder::read_loads(double t) {
    record_.heat_load.setZero(mesh_.elements() + 1);
    record_.moment.setZero(2, mesh_.elements());
    Eigen::ArrayXXd amplitudes;
    if (data_.amplitudes)
        amplitudes = data_.amplitudes(Eigen::ArrayXd::Constant(1, t)) / options_.unit;
    for (const auto& term : data_.heat_source.terms)
        record_.heat_load +=
            amplitudes(term.amplitude, 0) * heat_loads_[static_cast<std::size_t>(term.profile)];
    for (const auto& term : data_.moment_load.terms)
        record_.moment +=
            amplitudes(term.amplitude, 0) * moments_[static_cast<std::size_t>(term.profile)];
    const auto load_of_rest = [&](const SpaceTimeFunction& rest) {
        return certify::load_of(mesh_, [&](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
            return rest(x, t) / options_.unit;
        });
    };
    if (const auto& rest = data_.heat_source.rest)
        record_.heat_load += load_of_rest(rest).hat;
    if (const auto& rest = data_.moment_load.rest)
        record_.moment += load_of_rest(rest).projection;
}

/// y* such that the rate of the stage is c (Y − y*): y^{n−1} + Δt Σ_{j < i} a_ij F_j with
/// Δt F_j = (Y_j − y*_j)/a_jj, written in the increments Y_j − y^{n−1}; or (4y^{n−1} − y^{n−2})/3.
void SolveRecorder::read_star() {
    const StatedStep& step = record_.step;
    const RecordedState& before = levels_.front();
    record_.star = before;
    if (step.two_step) {
        add_increment(record_.star, 1.0 / 3.0, before, levels_[1]);
        return;
    }
    // Rows of Δt F_j = Σ_k factors(j, k) (Y_k − y^{n−1}): the inverse of a.
    const Eigen::MatrixXd factors = step.a.triangularView<Eigen::Lower>().solve(
        Eigen::MatrixXd::Identity(step.solves(), step.solves()));
    const Eigen::Index i = record_.stage;
    for (Eigen::Index k = 0; k < i; ++k) {
        double weight = 0.0;
        for (Eigen::Index j = k; j < i; ++j)
            weight += step.a(i, j) * factors(j, k);
        add_increment(record_.star, weight, stages_[static_cast<std::size_t>(k)], before);
    }
}

/// That of the last record, as later solves and steps read it.
RecordedState SolveRecorder::last_state() {
    record_.now.temperature_size = record_.now.theta.cwiseAbs().maxCoeff();
    return std::move(record_.now);
}

const SolveRecord& SolveRecorder::record(SolverState state) {
    if (made_ > 0)
        stages_.push_back(last_state());
    record_.step = stated_step(scheme_, n_);
    record_.stage = std::min(made_++, record_.step.solves() - 1);
    record_.leading = record_.step.leading(record_.stage) / record_.dt;
    record_.stress = state.stress / options_.unit;
    read_star();
    read_loads((static_cast<double>(n_ - 1) + record_.step.fraction(record_.stage)) * record_.dt);
    record_.now = in_units(std::move(state));
    const RecordedState& star = record_.star;
    RecordedState& now = record_.now;
    const double kappa = 1.0 / (1.0 + beam_.zeta * record_.leading);
    now.temperature_size = now.theta.cwiseAbs().maxCoeff() +
                           std::max(star.theta.cwiseAbs().maxCoeff(), star.temperature_size) +
                           std::abs(record_.stress) * beam_.alpha * kappa * record_.leading /
                               (record_.leading + std::numbers::pi * std::numbers::pi);
    const double forces =
        beam_.alpha * (now.temperature_size + std::abs(beam_.theta_A / options_.unit)) +
        largest(record_.moment) + std::abs(record_.stress);
    now.terms_size = std::max(
        {(1.0 - kappa) * star.terms_size + kappa * forces, largest(now.w), options_.least_size});
    now.curvature_size =
        (1.0 - kappa) * star.curvature_size + star.terms_size + kappa * forces + now.terms_size;
    return record_;
}

std::string SolveRecorder::end_step() {
    const Eigen::Index stated = stated_step(scheme_, n_).solves();
    std::string difference;
    if (made_ != stated)
        difference = "step " + std::to_string(n_) + " made " + std::to_string(made_) + " solves; " +
                     scheme_ + " has " + std::to_string(stated) + " there";
    ++n_;
    if (made_ > 0) {
        levels_.insert(levels_.begin(), last_state());
        levels_.resize(stated_step(scheme_, n_).two_step ? 2 : 1);
    }
    stages_.clear();
    made_ = 0;
    record_.star = {}; // the memory of these is for the next step of the solver
    record_.heat_load.resize(0);
    record_.moment.resize(2, 0);
    return difference;
}

} // namespace tvbeam

#include "core/solve_record.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

double largest(const DiscontinuousLinear& p) {
    return p.abs().maxCoeff();
}

} // namespace

SolveRecorder::SolveRecorder(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                             const Solver& solver, double dt, const RecordOptions& options)
    : beam_(beam), data_(data), mesh_(mesh), solver_(solver), options_(options) {
    record_.dt = dt;
    record_.unit = options.unit;
    loads_.resize(data_.profiles.size());
    for (std::size_t r = 0; r < loads_.size(); ++r) {
        const auto index = static_cast<Eigen::Index>(r);
        if (data_.heat_source.uses(index))
            loads_[r].hat = hat_loads(mesh_, data_.profiles[r]);
        if (data_.moment_load.uses(index))
            loads_[r].projection = project(mesh_, data_.profiles[r]);
    }
    levels_.push_back({solver_.temperature() / options_.unit, solver_.curvature() / options_.unit});
    RecordedState& initial = levels_.front();
    initial.temperature_size = initial.theta.cwiseAbs().maxCoeff();
    initial.terms_size = largest(initial.w) * options_.amplification + options_.iteration_size;
    initial.curvature_size = initial.terms_size;
}

const RecordedState& SolveRecorder::before(std::size_t steps) const {
    return levels_[steps - 1];
}

void SolveRecorder::read_loads(const Solve& solve) {
    record_.heat_load = Eigen::VectorXd::Zero(mesh_.elements() + 1);
    record_.moment = DiscontinuousLinear::Zero(2, mesh_.elements());
    for (const auto& term : data_.heat_source.terms)
        record_.heat_load += (solve.amplitudes(term.amplitude) / options_.unit) *
                             loads_[static_cast<std::size_t>(term.profile)].hat;
    for (const auto& term : data_.moment_load.terms)
        record_.moment += (solve.amplitudes(term.amplitude) / options_.unit) *
                          loads_[static_cast<std::size_t>(term.profile)].projection;
    const auto at_time = [&](const SpaceTimeFunction& rest) -> SpaceFunction {
        return [&](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
            return rest(x, solve.t) / options_.unit;
        };
    };
    if (const auto& rest = data_.heat_source.rest)
        record_.heat_load += hat_loads(mesh_, at_time(rest));
    if (const auto& rest = data_.moment_load.rest)
        record_.moment += project(mesh_, at_time(rest));
}

/// y* = y^{n−1} + Σ_j weights_j e_j (Stage).
void SolveRecorder::read_star(const Solve& solve) {
    const Stage& stage = solve.scheme->stages[solve.stage];
    record_.star = levels_.front();
    const auto history = static_cast<std::size_t>(solve.scheme->history);
    for (std::size_t j = 0; j < stage.weights.size(); ++j) {
        const RecordedState& later = j < history ? levels_[j] : stages_[j - history];
        const RecordedState& earlier = j < history ? levels_[j + 1] : levels_.front();
        record_.star.theta += stage.weights[j] * (later.theta - earlier.theta);
        record_.star.w += stage.weights[j] * (later.w - earlier.w);
        for (const auto size : {&RecordedState::temperature_size, &RecordedState::terms_size,
                                &RecordedState::curvature_size})
            record_.star.*size = std::max({record_.star.*size, later.*size, earlier.*size});
    }
}

const SolveRecord& SolveRecorder::record(const Solve& solve) {
    record_.scheme = solve.scheme;
    record_.stage = solve.stage;
    record_.leading = solve.leading;
    record_.stress = solver_.contact_stress() / options_.unit;
    read_star(solve);
    read_loads(solve);
    record_.now.theta = solver_.temperature() / options_.unit;
    record_.now.w = solver_.curvature() / options_.unit;
    const RecordedState& star = record_.star;
    RecordedState& now = record_.now;
    const double kappa = 1.0 / (1.0 + beam_.zeta * solve.leading);
    now.temperature_size = now.theta.cwiseAbs().maxCoeff() +
                           std::max(star.theta.cwiseAbs().maxCoeff(), star.temperature_size);
    const double forces =
        (beam_.alpha * (now.temperature_size + std::abs(beam_.theta_A / options_.unit)) +
         largest(record_.moment) + std::abs(record_.stress)) *
        options_.amplification;
    now.terms_size = std::max((1.0 - kappa) * star.terms_size + kappa * forces,
                              largest(now.w) * options_.amplification + options_.iteration_size);
    now.curvature_size =
        (1.0 - kappa) * star.curvature_size + star.terms_size + kappa * forces + now.terms_size;
    stages_.push_back(now);
    stages_.back().temperature_size = now.theta.cwiseAbs().maxCoeff();
    return record_;
}

void SolveRecorder::end_step() {
    constexpr std::size_t history = 2; // what BDF2 reads, which reads most
    levels_.insert(levels_.begin(), std::move(stages_.back()));
    if (levels_.size() > history)
        levels_.resize(history);
    stages_.clear();
}

} // namespace tvbeam

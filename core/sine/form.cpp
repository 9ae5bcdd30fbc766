#include "core/sine/form.hpp"

#include "core/contact/contact.hpp"
#include "core/dense_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace tvbeam {

namespace {

/// Steps that the modes march on their own: enough to share what a block costs by itself.
constexpr std::int64_t block_steps = 64;

bool wants(const QuantitySet& set, Quantity quantity) {
    return set[index(quantity)];
}

Eigen::Index profile_count(const ProblemData& data) {
    return static_cast<Eigen::Index>(data.profiles.size());
}

/// Whether errors are made of that of the curvature.
bool wants_curvature(const QuantitySet& set) {
    return wants(set, Quantity::u) || wants(set, Quantity::u_x) || wants(set, Quantity::u_xx);
}

/// Whether the norms measure something of which the profiles of the run are a part.
bool measures_fields(const std::vector<Norm>& norms) {
    const QuantitySet needed = quantities_of(norms);
    return wants(needed, Quantity::theta) || wants_curvature(needed);
}

/// Whether they measure what is integrated from the curvature.
bool integrates_curvature(const std::vector<Norm>& norms) {
    const QuantitySet needed = quantities_of(norms);
    return wants(needed, Quantity::u) || wants(needed, Quantity::u_x);
}

/// The fields in whose profiles the run is written.
std::vector<const Field*> used_fields(const ProblemData& data, const QuantitySet& needed, bool heat,
                                      bool bending) {
    std::vector<const Field*> fields;
    if (heat)
        fields.push_back(&data.heat_source);
    if (bending) {
        fields.push_back(&data.moment_load);
        fields.push_back(&data.curvature_initial);
    }
    if (wants(needed, Quantity::theta))
        fields.push_back(&data.exact->theta);
    if (wants_curvature(needed))
        fields.push_back(&data.exact->u_xx);
    return fields;
}

std::vector<bool> used_profiles(const ProblemData& data, const std::vector<const Field*>& fields) {
    std::vector<bool> used(data.profiles.size(), false);
    for (const Field* field : fields)
        for (const auto& term : field->terms)
            used[static_cast<std::size_t>(term.profile)] = true;
    return used;
}

} // namespace

bool SineForm::suits(const ProblemData& data, const Mesh& mesh, const Scheme& scheme,
                     const std::vector<Norm>& norms) {
    if (scheme.algorithm != Algorithm::direct || scheme.basis != Basis::automatic)
        return false;
    if (!(mesh.lengths == mesh.lengths(0)).all() || !SineBasis::suits(mesh.elements()))
        return false;
    // One elimination a step, and a history that one starting step fills.
    const auto one_coefficient = [](const TimeScheme& time) {
        return std::all_of(time.stages.begin(), time.stages.end(), [&](const Stage& stage) {
            return stage.leading == time.stages.front().leading;
        });
    };
    if (!one_coefficient(scheme.time) || !one_coefficient(scheme.time.at_step(1)) ||
        scheme.time.history > 1 || scheme.time.increments() > most_increments)
        return false;
    if (!data.heat_source.is_separable() || !data.moment_load.is_separable() ||
        !data.curvature_initial.is_separable())
        return false;
    const QuantitySet needed = quantities_of(norms);
    QuantitySet others = needed;
    for (const Quantity quantity : SineErrors::measured)
        others[index(quantity)] = false;
    if (others != QuantitySet{})
        return false;
    for (const Quantity quantity : SineErrors::on_whole_elements)
        if (wants(needed, quantity) && mesh.cells)
            return false;
    if (wants(needed, Quantity::theta) && !data.exact->theta.is_separable())
        return false;
    if (wants(needed, Quantity::theta_x) && !data.exact->theta_x.is_separable())
        return false;
    return !wants_curvature(needed) || data.exact->u_xx.is_separable();
}

SineForm::SineForm(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                   const Scheme& scheme, double final_time, std::int64_t steps,
                   const std::vector<Norm>& norms, const Needs& needs)
    : beam_(beam), data_(data), scheme_(scheme), heat_(needs.temperature || beam.alpha != 0.0),
      bending_(needs.deflection || beam.alpha != 0.0), coupled_(beam.alpha != 0.0),
      stops_(bending_ && beam.stops.exist()), basis_(mesh.elements()),
      profiles_(mesh, basis_, data.profiles,
                used_profiles(data, used_fields(data, quantities_of(norms), heat_, bending_)),
                {heat_, measures_fields(norms), integrates_curvature(norms)}),
      levels_(data, scheme.time, final_time, steps), most_steps_(std::min(block_steps, steps)),
      errors_(beam, data, mesh, basis_, profiles_, norms, coupled_, most_steps_) {
    find_sources();
    find_initial_state(mesh);
    make_room();
    counters_.doubles_allocated += mesh.nodes.size() + mesh.lengths.size();
}

/// The sources by amplitude, and which amplitudes anything reads.
void SineForm::find_sources() {
    const Eigen::Index rows = profile_count(data_) + 1;
    const Eigen::Index amplitudes = data_.amplitude_count;
    if (bending_)
        moment_ = by_profile(data_.moment_load, amplitudes, rows);
    if (heat_)
        heat_source_ =
            by_profile(data_.heat_source, amplitudes, rows) * profiles_.expansion.transpose();

    const QuantitySet& needed = errors_.sums().needed();
    std::vector<bool> read(static_cast<std::size_t>(amplitudes), false);
    std::vector<const Field*> fields = used_fields(data_, needed, heat_, bending_);
    if (wants(needed, Quantity::theta_x))
        fields.push_back(&data_.exact->theta_x);
    for (const Field* field : fields)
        for (const auto& term : field->terms)
            read[static_cast<std::size_t>(term.amplitude)] = true;
    if (wants(needed, Quantity::stress) && data_.exact->stress)
        read[static_cast<std::size_t>(*data_.exact->stress)] = true;
    for (Eigen::Index k = 0; k < amplitudes; ++k)
        if (read[static_cast<std::size_t>(k)])
            amplitudes_.push_back(k);
}

void SineForm::find_initial_state(const Mesh& mesh) {
    const Eigen::Index rows = profile_count(data_) + 1;
    const Eigen::Index increments = scheme_.time.increments();
    weights_ = Eigen::MatrixXd::Zero(rows, 1 + increments);
    if (bending_ && !data_.curvature_initial.terms.empty())
        weights_.col(0) =
            by_profile(data_.curvature_initial, data_.amplitude_count, rows).transpose() *
            data_.amplitudes(Eigen::ArrayXd::Zero(1)).matrix();
    next_weights_ = weights_;
    for (Eigen::Index r = 0; r + 1 < rows; ++r)
        if (bending_ && (data_.moment_load.uses(r) || data_.curvature_initial.uses(r)))
            moving_.push_back(r);
    moving_.push_back(rows - 1);
    if (heat_) {
        const Eigen::Index fields = coupled_ ? 2 : 1;
        state_ = ModeArrays(basis_.size(), fields * (1 + increments));
        next_ = state_;
        operators_ = ModeArrays(basis_.size(), 2);
        operators_[0].head(basis_.size()) = basis_.stiffness();
        state_[0].head(basis_.size()) =
            basis_.of_nodal((values(data_, data_.theta_initial, mesh.nodes, 0.0) -
                             beam_.theta_A * (1.0 - mesh.nodes))
                                .matrix());
    }
}

void SineForm::make_room() {
    const Eigen::Index rows = weights_.rows();
    const Eigen::Index amplitudes = data_.amplitude_count;
    const std::size_t most_stages =
        std::max(scheme_.time.stages.size(), scheme_.time.at_step(1).stages.size());
    const Eigen::Index solves = static_cast<Eigen::Index>(most_stages) * most_steps_;
    block_.amplitudes = TimeSeries::Zero(solves, amplitudes);
    block_.weights = TimeSeries::Zero(solves, rows);
    block_.changes = block_.weights;
    block_.loads.resize(solves, profiles_.columns());
    block_.stress = Eigen::VectorXd::Zero(solves);
    if (most_stages > 1) {
        block_.end_amplitudes.resize(most_steps_, amplitudes);
        block_.end_weights.resize(most_steps_, rows);
    }
    if (coupled_ && (stops_ || errors_.of_deflection()))
        block_.tip.resize(static_cast<std::size_t>(solves));
    counters_.doubles_allocated = profiles_.table.size() + operators_.size() + 2 * state_.size() +
                                  8 * basis_.size() + block_.amplitudes.size() +
                                  block_.weights.size() + block_.changes.size() +
                                  block_.loads.size() + errors_.doubles_allocated() +
                                  static_cast<std::int64_t>(block_.tip.size()) * Pack::size;
}

void SineForm::use(const TimeScheme& scheme) {
    running_ = &scheme;
    leading_ = scheme.stages.front().leading / levels_.dt();
    kappa_ = 1.0 / (1.0 + beam_.zeta * leading_);
    responses_.resize(0, 0);
    if (coupled_)
        change_loads_ = (beam_.alpha * leading_) * profiles_.expansion.transpose();
    increment_weights_ = Eigen::MatrixXd::Zero(scheme.increments(), stages());
    for (Eigen::Index i = 0; i < stages(); ++i) {
        const auto& weights = scheme.stages[static_cast<std::size_t>(i)].weights;
        for (std::size_t e = 0; e < weights.size(); ++e)
            increment_weights_(static_cast<Eigen::Index>(e), i) = weights[e];
    }
    if (!heat_)
        return;
    const Eigen::Index modes = basis_.size();
    auto inverse = operators_[1].head(modes);
    inverse = basis_.stiffness();
    if (scheme_.thermal_mass == ThermalMass::lumped)
        inverse += leading_ * basis_.lumped_mass();
    else
        inverse += leading_;
    inverse += beam_.alpha * beam_.alpha * leading_ * kappa_;
    inverse = inverse.inverse().eval();
}

RunStatus SineForm::march(const std::function<bool(std::int64_t steps)>& advance) {
    for (std::int64_t n = 1; n <= levels_.steps();) {
        const TimeScheme& scheme = scheme_.time.at_step(n);
        if (&scheme != running_) {
            use(scheme);
            if (heat_ && !operators_[1].isFinite().all())
                return RunStatus::failed;
        }
        const bool starting = n <= scheme_.time.history;
        const std::int64_t steps = starting ? 1 : std::min(block_steps, levels_.available(n));
        read_amplitudes(n, steps);
        if (!march_block(steps))
            return RunStatus::failed;
        if (starting)
            remember_starting_step();
        std::swap(state_, next_);
        std::swap(weights_, next_weights_);
        n += steps;
        if (advance && !advance(steps))
            return RunStatus::interrupted;
    }
    return RunStatus::ok;
}

void SineForm::read_amplitudes(std::int64_t n, std::int64_t steps) {
    const StepSources sources = levels_.at(n, steps);
    for (const Eigen::Index k : amplitudes_)
        block_.amplitudes.col(k).head(sources.times.size()) = sources.amplitudes.row(k);
}

/// Marches from state_ and weights_ to next_ and next_weights_, and adds to the norms. False: not
/// finite.
bool SineForm::march_block(std::int64_t steps) {
    const std::int64_t solves = steps * stages();
    const Start now{weights_, state_, true};
    count(steps);
    block_.stress.setZero();
    march_weights(solves, now);
    // A tip on a stop mostly stays there: the first march is then for its free positions alone.
    const bool on_stop = coupled_ && in_contact_;
    bool finite = true;
    if (on_stop) {
        march_modes(steps, now, Wanted::tips);
    } else {
        weigh_errors(steps);
        finite = march_modes(steps, now, stops_ ? Wanted::tips_and_end : Wanted::end);
    }
    if (stops_ && (find_contact(tips(solves)) || on_stop)) {
        march_weights(solves, now);
        weigh_errors(steps);
        if (coupled_)
            finite = march_modes(steps, now, Wanted::end);
    }
    in_contact_ = block_.stress(solves - 1) != 0.0;
    for (std::int64_t n = 1; n <= steps; ++n)
        counters_.contact_steps += block_.stress(n * stages() - 1) != 0.0 ? 1 : 0;
    for (const double stress : block_.stress.head(solves))
        counters_.contact_changes += pressed_.changes(stress) ? 1 : 0;
    add_errors(steps);
    // What is not finite once stays so: the end of the block shows it.
    return finite && next_weights_.allFinite() && std::isfinite(block_.stress.sum());
}

void SineForm::count(std::int64_t steps) {
    const std::int64_t solves = steps * stages();
    counters_.steps += steps;
    counters_.sine_steps += steps;
    counters_.heat_solves += heat_ ? solves : 0;
    counters_.beam_solves += bending_ ? solves : 0;
    counters_.coupling_updates += coupled_ ? solves : 0;
    counters_.tip_evaluations += stops_ ? solves : 0;
    counters_.load_updates +=
        !data_.heat_source.is_zero() || !data_.moment_load.is_zero() ? solves : 0;
}

/// The weights c_r through the block, as MomentForm::solve has them, to next_weights_, and what
/// they load the modes with.
void SineForm::march_weights(std::int64_t solves, const Start& start) {
    const Eigen::Index arm = weights_.rows() - 1;
    if (bending_) {
        // First what drives them, which is used up where it stands.
        for (const Eigen::Index r : moving_)
            block_.changes.col(r).head(solves).setZero();
        if (start.driven) {
            add_product(block_.changes, block_.amplitudes, moment_, solves);
            block_.changes.col(arm).array() += beam_.alpha * beam_.theta_A;
        }
        block_.changes.col(arm).head(solves) -= block_.stress.head(solves);
        next_weights_ = start.weights;
        if (stages() == 1 && increment_weights_.rows() == 0)
            step_weights_by_one_solve_each(solves);
        else
            for (std::int64_t step = 0; step < solves / stages(); ++step)
                step_weights(step);
    }
    if (!heat_)
        return;
    block_.loads.setZero();
    if (coupled_)
        add_product(block_.loads, block_.changes, change_loads_, solves);
    if (start.driven)
        add_product(block_.loads, block_.amplitudes, heat_source_, solves);
}

/// One step of the weights that anything moves, from and to next_weights_. The weights are the
/// inner loop: their recurrences do not wait for each other.
void SineForm::step_weights(std::int64_t step) {
    const Eigen::Index rows = next_weights_.rows();
    const Eigen::Index times = block_.changes.rows();
    const Eigen::Index increments = increment_weights_.rows();
    double* now = next_weights_.data(); // then come the increments
    for (Eigen::Index stage = 0; stage < stages(); ++stage) {
        const double* mix = increment_weights_.data() + stage * increments;
        double* changes = block_.changes.data() + step * stages() + stage;
        double* weights = block_.weights.data() + step * stages() + stage;
        // What comes last in a step becomes its increment, if the scheme has a history; suits()
        // admits one of a single increment.
        const bool last = stage + 1 == stages();
        const Eigen::Index kept = last ? 0 : running_->history + stage;
        const bool keep = !last || running_->history > 0;
        for (const Eigen::Index r : moving_) {
            double star = now[r];
            for (Eigen::Index e = 0; e < increments; ++e)
                star += mix[e] * now[(e + 1) * rows + r];
            const double change = -kappa_ * (star + changes[r * times]);
            changes[r * times] = change;
            weights[r * times] = star + change;
            if (keep)
                now[(kept + 1) * rows + r] = star + change - now[r];
            if (last)
                now[r] = star + change;
        }
    }
}

/// All steps of a scheme without increments.
void SineForm::step_weights_by_one_solve_each(std::int64_t solves) {
    const Eigen::Index times = block_.changes.rows();
    double* now = next_weights_.data();
    double* changes = block_.changes.data();
    double* weights = block_.weights.data();
    for (std::int64_t solve = 0; solve < solves; ++solve)
        for (const Eigen::Index r : moving_) {
            const Eigen::Index at = r * times + solve;
            changes[at] = -kappa_ * (now[r] + changes[at]);
            now[r] += changes[at];
            weights[at] = now[r];
        }
}

/// Marches the modes with the loads of the block: for the tips, for the end, which is next_ and the
/// squares of the errors, or for both. False: a temperature at the end is not finite.
bool SineForm::march_modes(std::int64_t steps, const Start& start, Wanted wanted) {
    if (!heat_)
        return true;
    const ModeArrays& state = start.modes;
    const bool tips = wanted != Wanted::end;
    const bool end = wanted != Wanted::tips;
    Pack sum{};
    SineBlock block;
    block.groups = state.groups();
    block.stride = state.stride();
    block.steps = steps;
    block.stages = stages();
    block.columns = profiles_.columns();
    block.increments = increment_weights_.rows();
    block.history = running_->history;
    block.increment_weights = increment_weights_.data();
    block.coupled = coupled_;
    block.alpha = beam_.alpha;
    block.kappa = kappa_;
    block.exchange = beam_.alpha * leading_ * kappa_;
    block.stiffness = operators_.data();
    block.inverse = operators_.data() + operators_.stride();
    block.table = profiles_.table.data();
    block.active_columns = profiles_.active.data();
    block.loads = block_.loads.data();
    block.load_stride = block_.loads.rows();
    block.before = state.data();
    block.after = end ? next_.data() : nullptr;
    block.sum = &sum;
    if (coupled_ && (tips || errors_.of_deflection()))
        block.tip = cleared(block_.tip, steps * stages());
    if (end) {
        block.of_temperature = errors_.temperature_squares();
        block.of_curvature = errors_.curvature_squares();
    }
    tvbeam::march(block);
    return std::all_of(std::begin(sum.lanes), std::end(sum.lanes),
                       [](double lane) { return std::isfinite(lane); });
}

/// u(1) after every solve.
Eigen::VectorXd SineForm::tips(std::int64_t solves) const {
    Eigen::VectorXd tips = block_.weights.topRows(solves) * profiles_.tip_moments;
    if (coupled_)
        for (Eigen::Index n = 0; n < solves; ++n)
            tips(n) += total(block_.tip[static_cast<std::size_t>(n)]);
    return tips;
}

/// The contact stresses of the block; false when there is no contact.
bool SineForm::find_contact(const Eigen::VectorXd& free_tips) {
    const auto free = free_tips.array();
    if ((free >= beam_.stops.lower && free <= beam_.stops.upper).all())
        return false;
    const Eigen::Index solves = free.size();
    if (responses_.rows() < solves)
        find_responses(solves);
    Eigen::VectorXd tip = free_tips;
    for (Eigen::Index m = 0; m < solves; ++m) {
        const auto response = responses_.col(m % stages()).head(solves - m);
        const double stress = tvbeam::contact_stress(beam_.stops, tip(m), response(0));
        block_.stress(m) = stress;
        if (stress != 0.0)
            tip.tail(solves - m) += stress * response;
    }
    return true;
}

void SineForm::find_responses(std::int64_t solves) {
    const Eigen::MatrixXd no_weights = Eigen::MatrixXd::Zero(weights_.rows(), weights_.cols());
    const ModeArrays no_modes(heat_ ? basis_.size() : 0, (coupled_ ? 2 : 1) * weights_.cols());
    const Start rest{no_weights, no_modes, false};
    Eigen::MatrixXd responses(solves, stages());
    for (Eigen::Index i = 0; i < stages(); ++i) {
        block_.stress.setZero();
        block_.stress(i) = 1.0;
        march_weights(solves, rest);
        march_modes(solves / stages(), rest, Wanted::tips);
        responses.col(i).head(solves - i) = tips(solves).tail(solves - i);
    }
    block_.stress.setZero();
    responses_ = std::move(responses);
}

/// The values after each step among those after each solve.
const TimeSeries& SineForm::at_step_ends(const TimeSeries& by_solve, TimeSeries& by_step,
                                         std::int64_t steps) const {
    if (stages() == 1)
        return by_solve;
    for (std::int64_t n = 0; n < steps; ++n)
        by_step.row(n) = by_solve.row((n + 1) * stages() - 1);
    return by_step;
}

void SineForm::weigh_errors(std::int64_t steps) {
    errors_.weigh(steps, at_step_ends(block_.amplitudes, block_.end_amplitudes, steps),
                  at_step_ends(block_.weights, block_.end_weights, steps));
}

void SineForm::add_errors(std::int64_t steps) {
    if (errors_.sums().needed() == QuantitySet{})
        return;
    Eigen::VectorXd stress(steps);
    for (std::int64_t n = 0; n < steps; ++n)
        stress(n) = block_.stress((n + 1) * stages() - 1);
    Eigen::VectorXd tips;
    if (errors_.of_deflection()) {
        tips.setZero(steps);
        for (std::int64_t n = 0; coupled_ && n < steps; ++n)
            tips(n) = total(block_.tip[static_cast<std::size_t>((n + 1) * stages() - 1)]);
    }
    errors_.add(steps, levels_.dt(), at_step_ends(block_.amplitudes, block_.end_amplitudes, steps),
                tips, stress);
}

/// After the step that starts a scheme with history: its increment.
void SineForm::remember_starting_step() {
    next_weights_.col(1) = next_weights_.col(0) - weights_.col(0);
    if (!heat_)
        return;
    const Eigen::Index fields = coupled_ ? 2 : 1;
    for (Eigen::Index field = 0; field < fields; ++field)
        next_[fields + field] = next_[field] - state_[field];
}

Counters SineForm::counters() const {
    Counters counters = counters_;
    counters.norm_evaluations = errors_.sums().evaluations();
    return counters;
}

} // namespace tvbeam

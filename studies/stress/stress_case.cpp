#include "studies/stress/stress_case.hpp"

#include "core/certify/contact_law.hpp"
#include "core/certify/energy_law.hpp"
#include "core/certify/initial_state.hpp"
#include "core/certify/residuals.hpp"
#include "core/round_off.hpp"
#include "core/run.hpp"
#include "core/sine/sine_run.hpp"
#include "core/time/time_levels.hpp"
#include "core/worse.hpp"
#include "mms/text/number_text.hpp"
#include "studies/stress/mode_solution.hpp"
#include "studies/stress/stress_problem.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tvbeam {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Checks that allow for more than this part of the curvature see too little.
constexpr double largest_allowance = 1e-3;
/// Of EnergyLaw::missed_part. What is missed is chance, and another compiler's is up to ten times
/// as much: the bound is well below what would matter.
constexpr double largest_missed_part = 5e-6;
/// The beam residual of the fixed points of `stress-beam` is up to 3.1 times the predicted floor,
/// their initial state and energy law less; the tip, an unknown of that form, has no part of it.
constexpr double allowed_floors = 10.0;
/// Tolerances that the iteration, which stops at one, may leave in the curvature.
constexpr double allowed_tolerances = 10.0;

std::string text_of(double value) {
    return number_text(value, 3);
}

/// The size of what bends the beam; 1 where nothing does. The heated end acts as the force αθ_A.
double size_of(const StressParameters& parameters) {
    const double size =
        std::max({parameters.load, parameters.initial == InitialData::zero ? 0.0 : 1.0,
                  parameters.alpha * std::abs(parameters.theta_A)});
    return size == 0.0 ? 1.0 : size;
}

/// A power of two near that size, which everything linear in the data is measured in.
double unit_of(const StressParameters& parameters) {
    return std::ldexp(1.0, std::ilogb(size_of(parameters)));
}

Scheme scheme_of(const StressParameters& parameters) {
    Scheme scheme;
    scheme.algorithm = parameters.algorithm;
    scheme.thermal_mass = parameters.thermal_mass;
    scheme.time = TimeScheme::named(parameters.time);
    scheme.basis = Basis::nodal;
    scheme.tolerance = 1e-13 * unit_of(parameters);
    return scheme;
}

Beam beam_of(const StressParameters& parameters) {
    return {parameters.alpha, parameters.zeta, parameters.theta_A, parameters.stops};
}

/// Of temperature, curvature and contact stress.
const std::vector<std::string> path_norms{"theta_LinfL2", "u_LinfH2semi", "sigma_L2"};

/// The largest values of a run, for the scales of its norms.
struct Sizes {
    double roughness = 0.0; // the largest difference of neighbours in Θ*, over twice that of Θ*
    double slowest = std::numeric_limits<double>::infinity(); // the least c
    double temperature = 0.0;
    double curvature = 0.0;
    double stress = 0.0;
    double leading = 0.0;
};

/// Marches the case and collects its checks. Returns why it stopped, or nothing.
class Marcher {
public:
    Marcher(const StressParameters& parameters, const Mesh& mesh, const ProblemData& data)
        : parameters_(parameters), mesh_(mesh), data_(data), beam_(beam_of(parameters)),
          scheme_(scheme_of(parameters)), unit_(unit_of(parameters)) {
        if (parameters.algorithm == Algorithm::fixed_point) {
            const double floor = hermite_floor(parameters.elements, parameters.zeta, parameters.dt,
                                               parameters.steps);
            checks_.allowance =
                allowed_floors * floor + allowed_tolerances * scheme_.tolerance / unit_;
            if (checks_.allowance > largest_allowance)
                throw std::domain_error("round-off of the Hermite form grows like h^-4: its "
                                        "predicted floor is " +
                                        text_of(floor) +
                                        " of the curvature; ten times that is allowed for, which "
                                        "is above 1e-3 of the curvature: nothing could be "
                                        "certified; use the direct algorithm");
            options_.least_size = 1.0;
        }
        // What is made of these is to be in the range of floating point, too.
        constexpr double most = 1e300;
        if (parameters.zeta / parameters.dt > most)
            throw std::domain_error("zeta/dt is above 1e300, near the end of floating point");
        if (std::abs(parameters.theta_A) / size_of(parameters) > most)
            throw std::domain_error("theta_A is above 1e300 times what bends the beam, near the "
                                    "end of floating point");
        options_.unit = unit_;
        solver_ = make_solver(beam_, data_, mesh_, scheme_, parameters.dt, Needs{true, true, true});
    }

    /// underflow: what counts as zero, over the unit.
    std::string march(double underflow) {
        const auto state = [this]() -> SolverState {
            return {solver_->temperature(), solver_->curvature(), solver_->contact_stress()};
        };
        checks_.initial = initial_defect(beam_, data_, mesh_, options_, state());
        SolveRecorder recorder(beam_, data_, mesh_, parameters_.time, parameters_.dt, options_,
                               state());
        EnergyLaw energy(beam_, mesh_, parameters_.thermal_mass, underflow);
        const SolveRecord* last = nullptr;
        solver_->observe([&](const Solve&) {
            const SolveRecord& record = recorder.record(state());
            add(record, underflow);
            energy.add(record);
            last = &record;
        });
        TimeLevels levels(data_, scheme_.time,
                          parameters_.dt * static_cast<double>(parameters_.steps),
                          parameters_.steps);
        for (std::int64_t n = 1; n <= parameters_.steps; ++n) {
            const std::string reason = solver_->step(levels.at(n));
            if (!reason.empty())
                return reason + " in step " + std::to_string(n) + " of " +
                       std::to_string(parameters_.steps);
            take(checks_.energy, energy.end_step(recorder, *last));
            add_norms(*last);
            if (other_steps_ = recorder.end_step(); !other_steps_.empty())
                return {};
        }
        missed_part_ = energy.missed_part();
        return {};
    }

    [[nodiscard]] const StressChecks& checks() const { return checks_; }
    [[nodiscard]] const Sizes& sizes() const { return sizes_; }
    /// In the order of path_norms.
    [[nodiscard]] std::vector<double> norms() const {
        return {norms_[0] * unit_, norms_[1] * unit_, std::sqrt(norms_[2]) * unit_};
    }
    [[nodiscard]] Eigen::VectorXd temperature() const { return solver_->temperature(); }
    /// Of the energy, what its law leaves over all steps.
    [[nodiscard]] double missed_part() const { return missed_part_; }
    /// How the steps differ from those of the scheme; empty: not at all.
    [[nodiscard]] const std::string& other_steps() const { return other_steps_; }

private:
    static void take(double& worst, double value) { worst = worse(worst, value); }

    void add(const SolveRecord& record, double underflow) {
        const Residuals residual =
            residuals(beam_, mesh_, parameters_.thermal_mass, record, underflow);
        take(checks_.heat_residual, residual.heat);
        take(checks_.beam_residual, residual.beam);
        const ContactDefects contact = contact_defects(beam_, mesh_, record);
        take(checks_.penetration, contact.penetration);
        take(checks_.wrong_sign, contact.wrong_sign);
        take(checks_.complementarity, contact.complementarity);
        take(sizes_.temperature, record.now.temperature_size * unit_);
        take(sizes_.curvature, record.now.curvature_size * unit_);
        take(sizes_.stress, std::abs(record.stress * unit_));
        if (const double most = record.star.theta.cwiseAbs().maxCoeff(); most > 0.0) {
            const Eigen::Index s = mesh_.elements();
            const Eigen::VectorXd& theta = record.star.theta;
            take(sizes_.roughness,
                 (theta.tail(s) - theta.head(s)).cwiseAbs().maxCoeff() / (2.0 * most));
        }
        sizes_.slowest = std::min(sizes_.slowest, record.leading);
        take(sizes_.leading, record.leading);
    }

    /// At the end of a step.
    void add_norms(const SolveRecord& record) {
        const auto theta =
            record.now.theta + parameters_.theta_A / unit_ * (1.0 - mesh_.nodes).matrix();
        take(norms_[0],
             std::sqrt(certify::mass_product(mesh_, ThermalMass::consistent, theta, theta)));
        take(norms_[1], std::sqrt(certify::product(mesh_, record.now.w, record.now.w)));
        norms_[2] += record.dt * record.stress * record.stress;
    }

    const StressParameters& parameters_;
    const Mesh& mesh_;
    const ProblemData& data_;
    Beam beam_;
    Scheme scheme_;
    double unit_;
    RecordOptions options_;
    std::unique_ptr<Solver> solver_;
    StressChecks checks_;
    Sizes sizes_;
    std::array<double, 3> norms_{}; // in units; the last squared
    std::string other_steps_;
    double missed_part_ = 0.0;
};

/// What is left of a march: a large one takes far more memory.
struct Marched {
    std::string stopped; ///< why it stopped; empty: it did not
    std::string other_steps;
    StressChecks checks;
    Sizes sizes;
    std::vector<double> norms; ///< of path_norms
    double missed_part = 0.0;  ///< EnergyLaw::missed_part
    Eigen::VectorXd temperature;
};

Marched march(const StressParameters& parameters, const Mesh& mesh, const ProblemData& data,
              double underflow) {
    Marcher marcher(parameters, mesh, data);
    Marched marched{.stopped = marcher.march(underflow),
                    .other_steps = marcher.other_steps(),
                    .checks = marcher.checks(),
                    .sizes = marcher.sizes(),
                    .norms = marcher.norms(),
                    .missed_part = marcher.missed_part(),
                    .temperature = {}};
    marched.temperature = marcher.temperature();
    return marched;
}

/// What the round-off of the path_norms is measured in.
std::array<double, 3> path_scales(const StressParameters& parameters, const Sizes& sizes,
                                  double final_time) {
    // A reaction is a length over the compliance of the tip, and that length has the round-off of
    // the tip. Without heat the compliance is κ/3; heat that is coupled strongly leaves of the
    // moment arm 1 − x what is orthogonal to the hat functions, a part of about h. Θ and w answer
    // to the reaction.
    const double kappa = 1.0 / (1.0 + parameters.zeta * sizes.leading);
    const double coupled = parameters.alpha * parameters.alpha * kappa;
    const double part = std::min(1.0 + coupled, 1.0 + static_cast<double>(parameters.elements));
    const double reaction = 3.0 / kappa * part * sizes.curvature / 2.0;
    const bool contact = sizes.stress > 0.0;
    return {sizes.temperature + std::abs(parameters.theta_A) +
                (contact ? reaction * parameters.alpha * kappa / (1.0 + coupled) : 0.0),
            sizes.curvature * (contact ? 1.0 + std::sqrt(3.0 * part) / 2.0 : 1.0),
            std::sqrt(final_time) * (sizes.stress + reaction)};
}

/// Runs the case in the sine basis and compares the norms of the solution with those of the march
/// in nodal values, which its certifier has integrated.
void compare_paths(const StressParameters& parameters, const Mesh& mesh, const ProblemData& data,
                   const Marched& nodal, StressChecks& checks) {
    if (parameters.algorithm != Algorithm::direct) {
        checks.path_skipped = "the paper's algorithm has one path";
        return;
    }
    RunRequest request{beam_of(parameters),   mesh,
                       scheme_of(parameters), parameters.dt * static_cast<double>(parameters.steps),
                       parameters.steps,      {}};
    for (const auto& name : path_norms)
        request.norms.push_back(*Norm::named(name));
    const auto scales = path_scales(parameters, nodal.sizes, request.final_time);
    // Norms are roots of squares, whose range is half that of the numbers.
    if (std::any_of(scales.begin(), scales.end(), [](double scale) {
            return scale > 1e140 || (scale != 0.0 && scale < 1e-140);
        })) {
        checks.path_skipped = "the squares of the norms are beyond the range of floating point";
        return;
    }
    request.scheme.basis = Basis::automatic;
    std::optional<RunResult> sine;
    try {
        sine = run_in_sines(request, data, mesh, Needs());
    } catch (const std::domain_error& error) {
        checks.path_skipped = error.what();
        return;
    }
    if (!sine) {
        checks.path_skipped = "the sine basis does not suit mesh or data, or its norms are beyond "
                              "the range of floating point";
        return;
    }
    checks.path_limit = path_limit(parameters.elements, nodal.sizes.roughness, nodal.sizes.slowest);
    checks.path = path_difference(nodal.norms, sine->errors, scales);
}

/// The error of the temperature at the end over the one that the scheme's recurrence for the mode
/// sin πx predicts: the sum of a term of h, by the eigenvalue of the mesh, and one of Δt.
void compare_error(const StressParameters& parameters, const Mesh& mesh,
                   const Eigen::VectorXd& temperature, StressChecks& checks) {
    const Beam beam = beam_of(parameters);
    if (parameters.load != 0.0 || parameters.theta_A != 0.0 || beam.stops.exist() ||
        parameters.initial != InitialData::smooth || beam.zeta == 0.0) {
        checks.error_skipped = "no exact solution: it is known of the mode sin(pi x), without "
                               "load, heated end and stops, for zeta > 0";
        return;
    }
    const auto n = static_cast<std::size_t>(parameters.steps);
    const Mode initial{1.0L, -1.0L};
    const Mode exact = exact_mode(beam, initial, parameters.dt, parameters.steps)[n];
    const Mode discrete =
        discrete_mode(beam, parameters.thermal_mass, parameters.time, parameters.elements, initial,
                      true, parameters.dt, parameters.steps)[n];
    const auto predicted = static_cast<double>(std::abs(discrete.theta - exact.theta));
    const double round_off =
        1e4 * epsilon * std::max(1.0, 1e-3 * static_cast<double>(parameters.elements));
    if (parameters.elements == 1 || predicted < round_off) {
        checks.error_skipped = "the predicted error is not above round-off";
        return;
    }
    const Eigen::ArrayXd sine = (std::numbers::pi * mesh.nodes).sin();
    const double error =
        (temperature.array() - static_cast<double>(exact.theta) * sine).abs().maxCoeff() /
        sine.maxCoeff();
    checks.error = error / predicted;
}

/// The order in Δt that three runs show, of N, 2N and 4N steps, where they show that of the scheme
/// when they are exact: where the steps are small and the differences above round-off.
void compare_order(const StressParameters& parameters, const Mesh& mesh, const ProblemData& data,
                   const Eigen::VectorXd& coarsest, StressChecks& checks) {
    const Beam beam = beam_of(parameters);
    const int claimed = stated_order(parameters.time);
    const auto order_of = [](auto coarse, auto medium, auto fine) {
        return static_cast<double>(std::log2(std::abs(coarse - medium) / std::abs(medium - fine)));
    };
    long double expected[3];
    for (int k = 0; k < 3; ++k) {
        const std::int64_t steps = parameters.steps << k;
        expected[k] =
            discrete_mode(beam, parameters.thermal_mass, parameters.time, parameters.elements,
                          {1.0L, -1.0L}, true, std::ldexp(parameters.dt, -k), steps)
                .back()
                .theta;
    }
    const double round_off =
        1e5 * epsilon * std::max(1.0, 1e-3 * static_cast<double>(parameters.elements));
    if (std::abs(expected[1] - expected[2]) < round_off ||
        std::abs(order_of(expected[0], expected[1], expected[2]) - claimed) > 0.1)
        return;
    const Eigen::Index middle = mesh.elements() / 2;
    double found[3] = {coarsest(middle)};
    for (int k = 1; k < 3; ++k) {
        const Scheme scheme = scheme_of(parameters);
        const std::int64_t steps = parameters.steps << k;
        const double dt = std::ldexp(parameters.dt, -k);
        const auto solver = make_solver(beam, data, mesh, scheme, dt, Needs());
        TimeLevels levels(data, scheme.time, dt * static_cast<double>(steps), steps);
        for (std::int64_t n = 1; n <= steps; ++n)
            if (!solver->step(levels.at(n)).empty())
                return;
        found[k] = solver->temperature()(middle);
    }
    checks.order_defect = order_of(found[0], found[1], found[2]) - claimed;
}

/// What is compared with the case: the other path, the predicted error, the order in Δt.
void compare(const StressParameters& parameters, const Mesh& mesh, const ProblemData& data,
             const Marched& marched, StressChecks& checks) {
    compare_paths(parameters, mesh, data, marched, checks);
    if (parameters.algorithm != Algorithm::direct) {
        checks.error_skipped = "measured with the direct algorithm";
        return;
    }
    compare_error(parameters, mesh, marched.temperature, checks);
    if (checks.error)
        compare_order(parameters, mesh, data, marched.temperature, checks);
}

/// The same as before: underflow excuses none of it.
void compare_as(const StressChecks& before, StressChecks& checks) {
    checks.path = before.path;
    checks.path_limit = before.path_limit;
    checks.path_skipped = before.path_skipped;
    checks.error = before.error;
    checks.error_skipped = before.error_skipped;
    checks.order_defect = before.order_defect;
}

std::string round_off_words(const StressParameters& parameters, double bound) {
    const std::string left = "round-off: over all steps the energy law leaves more than " +
                             text_of(bound) + " of the energy";
    constexpr double unseen = 1e-9;
    return parameters.alpha * epsilon > unseen
               ? left + ", of the rounding of the temperature, which alpha multiplies"
               : left;
}

void stop(StressCase& result, const std::string& reason) {
    result.outcome = Outcome::stopped;
    result.reason = reason;
    result.checks.reset();
}

void run_case(StressCase& result) {
    const StressParameters& parameters = result.parameters;
    constexpr double least = std::numeric_limits<double>::min();
    if (parameters.load > 0.0 && parameters.load < least)
        throw std::domain_error("the load is below " + text_of(least) +
                                ", where floating point has lost digits of it already");
    const Mesh mesh = Mesh::uniform(parameters.elements);
    const ProblemData data = stress_problem(parameters, mesh);
    // The smallest normalised number, over the unit; what the temperature loses there the coupling
    // takes into the curvature.
    const double underflow = (1.0 + parameters.alpha) * least / unit_of(parameters);
    for (const double floor : {0.0, underflow}) {
        const Marched marched = march(parameters, mesh, data, floor);
        if (!marched.stopped.empty())
            return stop(result, marched.stopped);
        const auto before = std::exchange(result.checks, marched.checks);
        if (!marched.other_steps.empty()) {
            result.outcome = Outcome::failed;
            result.reason = marched.other_steps;
            return;
        }
        if (before)
            compare_as(*before, *result.checks);
        else
            compare(parameters, mesh, data, marched, *result.checks);
        const std::string reason = violation(*result.checks);
        if (reason.empty() && before)
            return stop(result, "underflow: the solution falls below " + text_of(least) +
                                    ", where floating point loses its digits");
        const double bound = std::max(largest_missed_part, marched.checks.allowance);
        if (reason.empty() && marched.missed_part > bound)
            return stop(result, round_off_words(parameters, bound));
        result.outcome = reason.empty() ? Outcome::certified : Outcome::failed;
        result.reason = reason;
        if (reason.empty())
            return;
    }
}

} // namespace

std::string name_of(Outcome outcome) {
    switch (outcome) {
    case Outcome::certified:
        return "certified";
    case Outcome::refused:
        return "refused";
    case Outcome::stopped:
        return "stopped";
    default:
        return "failed";
    }
}

std::optional<double> StressChecks::path_part() const {
    return path ? std::optional(*path / path_limit) : std::nullopt;
}

double StressChecks::energy_limit() const {
    return StressLimits::energy + allowance;
}

double StressChecks::residual_limit() const {
    return StressLimits::residual + allowance / epsilon;
}

double StressChecks::initial_limit() const {
    return StressLimits::initial + allowance;
}

double StressChecks::closeness(bool has_stops) const {
    double greatest = std::max({energy / energy_limit(), heat_residual / residual_limit(),
                                beam_residual / residual_limit(), initial / initial_limit(),
                                path_part().value_or(0.0),
                                std::abs(order_defect.value_or(0.0)) / StressLimits::order});
    if (has_stops)
        greatest =
            std::max({greatest, penetration / StressLimits::contact,
                      wrong_sign / StressLimits::contact, complementarity / StressLimits::contact});
    return greatest;
}

std::string violation(const StressChecks& checks) {
    const auto exceeds = [](double value, double limit) { return !(value <= limit); };
    if (exceeds(checks.initial, checks.initial_limit()))
        return "the initial state is not that of the data: it differs by " +
               text_of(checks.initial) + " of its size";
    if (exceeds(checks.heat_residual, checks.residual_limit()))
        return "the heat equation is left with a residual of " + text_of(checks.heat_residual) +
               " units of round-off";
    if (exceeds(checks.beam_residual, checks.residual_limit()))
        return "the beam equation is left with a residual of " + text_of(checks.beam_residual) +
               " units of round-off";
    if (exceeds(checks.energy, checks.energy_limit()))
        return "the energy law is missed by " + text_of(checks.energy) + " of its terms";
    if (exceeds(checks.penetration, StressLimits::contact))
        return "the tip is beyond a stop by " + text_of(checks.penetration) + " of its scale";
    if (exceeds(checks.wrong_sign, StressLimits::contact))
        return "the reaction has the wrong sign, " + text_of(checks.wrong_sign) + " of the scale";
    if (exceeds(checks.complementarity, StressLimits::contact))
        return "there is a reaction without contact, " + text_of(checks.complementarity) +
               " of the scale";
    if (checks.path && exceeds(*checks.path, checks.path_limit))
        return "sine basis and nodal values differ by " + text_of(*checks.path) +
               " ulp of the scale";
    if (checks.order_defect && exceeds(std::abs(*checks.order_defect), StressLimits::order))
        return "the order in dt is " + text_of(*checks.order_defect) +
               " beside the one that the scheme is known for";
    if (checks.error && exceeds(std::abs(std::log(*checks.error)), std::log(1.1)))
        return "the error is " + text_of(*checks.error) + " of the predicted one";
    return {};
}

double path_difference(const std::vector<double>& nodal, const std::vector<double>& sine,
                       const std::array<double, 3>& scales) {
    double worst = 0.0;
    for (std::size_t k = 0; k < scales.size(); ++k) {
        const double a = nodal[k];
        const double b = sine[k];
        if (a == b)
            continue;
        // ‖Θ‖ and ‖w‖ are roots of squares in which larger ones cancel: round-off is of the
        // squares.
        const double square = k == 2 ? 1.0 : (a + b) / scales[k];
        worst = worse(worst, std::abs(a - b) / (epsilon * scales[k]) * square);
    }
    return worst;
}

double path_limit(std::int64_t elements, double roughness, double c) {
    const auto s = static_cast<double>(elements);
    constexpr double pi = std::numbers::pi;
    return 30.0 * std::max(1.0, s / 1000.0) +
           10.0 * roughness * s * std::sqrt(s) / (1.0 + c / (pi * pi));
}

StressCase judge(const StressParameters& parameters) {
    const auto start = std::chrono::steady_clock::now();
    StressCase result;
    result.parameters = parameters;
    try {
        run_case(result);
    } catch (const std::domain_error& error) {
        result.outcome = Outcome::refused;
        result.reason = error.what();
    } catch (const std::bad_alloc&) {
        result.outcome = Outcome::refused;
        result.reason =
            "not enough memory for " + std::to_string(parameters.elements) + " elements";
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    result.seconds = elapsed.count();
    return result;
}

} // namespace tvbeam

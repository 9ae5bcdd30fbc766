#include "mms/forecast/smoothness.hpp"

#include "mms/admissible/admissibility.hpp"
#include "mms/admissible/jumps.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/piecewise_tape.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/local_power.hpp"
#include "mms/rough_times.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using GiNaC::ex;

namespace {

constexpr double jump_tolerance = 1e-9; ///< relative to what jumps

/// θ̃_t and u_xxt in every phase, over x. Without viscosity θ̃ − α u_xx alone has a rate in (1)–(3).
PiecewiseTape rates(const DerivedSolution& derived, const Beam& beam) {
    const ex alpha = exact_rational(beam.alpha);
    return {derived, [&](const DerivedPhase& phase) -> std::vector<ex> {
                if (beam.zeta > 0.0)
                    return {phase.theta_t, phase.u_xxt};
                return {checked_difference(phase.theta_t, checked_product(alpha, phase.u_xxt)), 0};
            }};
}

/// The greatest of each rate, or of the terms of their difference, at any time. A jump is one
/// beside that: beside its own terms at a switch, which may cancel there, round-off would be one.
ArrayXd sizes_of(const DerivedSolution& derived, const Beam& beam, double final_time) {
    const PiecewiseTape tape(derived, [](const DerivedPhase& phase) {
        return std::vector<ex>{phase.theta_t, phase.u_xxt};
    });
    const ArrayXd x = sample_points(0.0, 1.0);
    ArrayXd sizes = ArrayXd::Zero(2);
    for (const PhaseExpressions& phase : derived.phases)
        if (phase.begin_value < final_time)
            for (const double t :
                 sample_points(phase.begin_value, std::min(phase.end_value, final_time)))
                // Within a phase a rate may have no value right where it jumps.
                if (const ArrayXd here = tape.at(x, t).abs().rowwise().maxCoeff();
                    here.isFinite().all())
                    sizes = sizes.max(here);
    if (beam.zeta == 0.0)
        sizes(0) += beam.alpha * sizes(1);
    return sizes;
}

} // namespace

std::size_t phases_until(const DerivedSolution& derived, double final_time) {
    return static_cast<std::size_t>(
        std::ranges::count_if(derived.phases, [&](const PhaseExpressions& phase) {
            return phase.begin_value < final_time;
        }));
}

namespace {

/// The largest jump in time of the functions of a tape within phase i, at some place.
std::optional<Jump> jump_within(const Tape& tape, const PhaseExpressions& phase,
                                double final_time) {
    const double end = std::min(phase.end_value, final_time);
    // Right at its begin a rate may have no value.
    const double begin = phase.begin_value + 1e-9 * (end - phase.begin_value);
    const bool is_expected = may_jump(phase.theta) || may_jump(phase.u);
    const double least = least_jump(is_expected);
    std::optional<Jump> greatest;
    for (const double place : parts_to_search(is_expected)) {
        const auto in_time = [&](const ArrayXd& s) {
            return tape.evaluate(ArrayXd::Constant(1, place), s);
        };
        const auto jump = find_jump(in_time, uneven_grid(begin, end), least);
        if (jump && !(greatest && std::abs(jump->size) <= std::abs(greatest->size)))
            greatest = jump;
    }
    return greatest;
}

} // namespace

std::optional<double> find_second_rate_jump(const DerivedSolution& derived, double final_time) {
    const PhaseExpressions& phase = derived.phases.front();
    if (!may_jump(phase.theta) && !may_jump(phase.u))
        return std::nullopt;
    const DerivedPhase& rates = derived.derived.front();
    const GiNaC::symbol& t = model_symbols().t;
    const Tape tape = compile_tape({derivative(rates.theta_t, t), derivative(rates.u_xxt, t)});
    const auto jump = jump_within(tape, phase, final_time);
    return jump ? std::optional(jump->at) : std::nullopt;
}

namespace {

constexpr std::array rate_jumps{&Switch::theta_t_jump, &Switch::u_xxt_jump};

/// The switches within phase i.
std::vector<Switch> switches_within(const PiecewiseTape& tape, const ArrayXd& sizes,
                                    const PhaseExpressions& phase, std::size_t i,
                                    double final_time) {
    const ArrayXd x = sample_points(0.0, 1.0);
    const double length = std::min(phase.end_value, final_time) - phase.begin_value;
    const std::vector<double> rough = rough_times(phase, final_time);
    std::vector<Switch> result;
    for (const double t : rough) {
        Switch change{.t = t, .where = Switch::Where::within_phase};
        const Eigen::ArrayXXd jumps =
            jump_across([&](double at) { return tape.at(x, at); }, t, length);
        for (Eigen::Index row : {0, 1})
            if (const double jump = jumps.row(row).abs().maxCoeff();
                jump > jump_tolerance * sizes(row))
                change.*rate_jumps.at(static_cast<std::size_t>(row)) = jump;
        if (change.theta_t_jump > 0.0 || change.u_xxt_jump > 0.0)
            result.push_back(change);
    }
    for (Eigen::Index row : {0, 1}) {
        const auto jump = rate_jumps.at(static_cast<std::size_t>(row));
        if (std::ranges::any_of(result, [&](const Switch& known) { return known.*jump > 0.0; }))
            continue;
        // What is rough all over the beam is told of all of it, as a slope without a bound is.
        constexpr double near = 1e-6;
        const auto is_known = [&](double at) {
            return std::ranges::any_of(rough,
                                       [&](double t) { return std::abs(t - at) <= near * length; });
        };
        if (const auto found = jump_within(tape.of_phase(i).only({row}), phase, final_time);
            found && !is_known(found->at)) {
            result.push_back({.t = found->at, .where = Switch::Where::at_a_place});
            result.back().*jump = std::abs(found->size);
        }
    }
    return result;
}

} // namespace

std::vector<Switch> find_switches(const DerivedSolution& derived, const Beam& beam,
                                  double final_time) {
    const PiecewiseTape tape = rates(derived, beam);
    const ArrayXd x = sample_points(0.0, 1.0);
    const ArrayXd sizes = sizes_of(derived, beam, final_time);
    std::vector<Switch> result;
    for (std::size_t i = 0; i < derived.phases.size(); ++i) {
        const PhaseExpressions& phase = derived.phases[i];
        if (!(phase.begin_value < final_time))
            break;
        for (const Switch& change : switches_within(tape, sizes, phase, i, final_time))
            result.push_back(change);
        if (!(phase.end_value < final_time))
            break;
        const Eigen::ArrayXXd before = tape.at(x, phase.end_value);
        const Eigen::ArrayXXd after = tape.at(x, phase.end_value, true);
        const ArrayXd jumps = (after - before).abs().rowwise().maxCoeff();
        const auto jump = [&](Eigen::Index row) {
            return jumps(row) > jump_tolerance * sizes(row) ? jumps(row) : 0.0;
        };
        result.push_back({phase.end_value, jump(0), jump(1)});
    }
    return result;
}

std::vector<Cusp> find_cusps(const DerivedSolution& derived, const Beam& beam, double final_time) {
    const PiecewiseTape tape = rates(derived, beam);
    const ArrayXd x = sample_points(0.0, 1.0);
    const ArrayXd sizes = sizes_of(derived, beam, final_time);
    std::vector<Cusp> result;
    // late: the end of a phase is read in the one that begins there. Within one the rates may have
    // no value, and two differ at times s and 2s from it as they do from their limit, like s^β.
    const auto look = [&](double t, bool late, double direction, double length,
                          bool within = false) {
        const Eigen::ArrayXXd at_end = tape.at(x, t, late);
        const auto power = [&](Eigen::Index row) {
            return power_below_one(
                [&](double s) -> ArrayXd {
                    const Eigen::ArrayXXd other =
                        within ? tape.at(x, t + 2.0 * direction * s) : at_end;
                    return (tape.at(x, t + direction * s).row(row) - other.row(row)).transpose();
                },
                t, length, sizes(row));
        };
        const Cusp cusp{t, within, power(0), power(1)};
        if (std::isinf(cusp.theta_t_power) && std::isinf(cusp.u_xxt_power))
            return;
        if (!result.empty() && result.back().t == t) {
            result.back().theta_t_power = std::min(result.back().theta_t_power, cusp.theta_t_power);
            result.back().u_xxt_power = std::min(result.back().u_xxt_power, cusp.u_xxt_power);
        } else
            result.push_back(cusp);
    };
    for (const PhaseExpressions& phase : derived.phases) {
        if (!(phase.begin_value < final_time))
            break;
        const double end = std::min(phase.end_value, final_time);
        const double length = end - phase.begin_value;
        look(phase.begin_value, true, 1.0, length);
        for (const double t : rough_times(phase, final_time))
            for (const double direction : {-1.0, 1.0})
                look(t, false, direction, length, true);
        look(end, false, -1.0, length);
    }
    return result;
}

std::optional<Kink> find_kink(const DerivedSolution& derived, double final_time) {
    for (std::size_t i = 0; i < derived.phases.size(); ++i) {
        const PhaseExpressions& phase = derived.phases[i];
        if (phase.begin_value >= final_time)
            break;
        const double end = std::min(phase.end_value, final_time);
        const bool is_expected = may_jump(phase.u) || may_jump(phase.theta);
        const double least = least_jump(is_expected);
        const DerivedPhase& formulas = derived.derived[i];
        for (const auto& [of, formula] : {std::pair(Kink::Of::u_xx, &formulas.u_xx),
                                          {Kink::Of::u_xxt, &formulas.u_xxt},
                                          {Kink::Of::u_xxx, &formulas.u_xxx}}) {
            const Tape tape = compile_tape({*formula});
            for (const double part : parts_to_search(is_expected)) {
                const ArrayXd t =
                    ArrayXd::Constant(1, phase.begin_value + part * (end - phase.begin_value));
                const auto in_x = [&](const ArrayXd& x) { return tape.evaluate(x, t); };
                const auto exactly = [&](const ArrayXd& x) { return tape.evaluate_wide(x, t); };
                if (const auto jump = find_jump(in_x, exactly, uneven_grid(0.0, 1.0), least))
                    return Kink{of, jump->at, t(0)};
            }
        }
    }
    return std::nullopt;
}

std::optional<RoughEnd> find_rough_end(const DerivedSolution& derived, double final_time) {
    const PiecewiseTape tape(
        derived, [](const DerivedPhase& phase) { return std::vector<ex>{phase.u_xxx}; });
    constexpr double measured = 5e-3; // β is known so well beside what is smooth
    std::optional<RoughEnd> roughest;
    for (std::size_t i = 0; i < phases_until(derived, final_time); ++i) {
        const PhaseExpressions& phase = derived.phases[i];
        if (!may_jump(phase.u))
            continue;
        const double length = std::min(phase.end_value, final_time) - phase.begin_value;
        for (const double part : parts_to_search(false))
            for (const double x : {0.0, 1.0}) {
                const auto at = [&](const ArrayXd& places) -> ArrayXd {
                    return tape.of_phase(i)
                        .evaluate(places, ArrayXd::Constant(1, phase.begin_value + part * length))
                        .row(0);
                };
                const double size = at(sample_points(0.0, 1.0)).abs().maxCoeff();
                const double value = at(ArrayXd::Constant(1, x))(0);
                double power = power_below_one(
                    [&](double s) -> ArrayXd {
                        return at(ArrayXd::Constant(1, std::abs(x - s))) - value;
                    },
                    x, 1.0, size);
                if (std::abs(power - RoughEnd::highest_power) < measured)
                    power = RoughEnd::highest_power;
                if (power <= RoughEnd::highest_power && !(roughest && roughest->power <= power))
                    roughest = RoughEnd{x, power};
            }
    }
    return roughest;
}

std::string words_of(const RoughEnd& end) {
    return fmt::format("u_xxx goes to its value at x = {} like s^{}", number_text(end.x),
                       local_power_text(end.power));
}

std::string words_of(const Kink& kink) {
    const std::string at = " jumps at x = " + number_text(kink.x);
    switch (kink.of) {
    case Kink::Of::u_xx:
        return "u_xx" + at;
    case Kink::Of::u_xxt:
        return "u_xxt" + at + ", t = " + number_text(kink.t);
    case Kink::Of::u_xxx:
        break;
    }
    return "u_xxx" + at;
}

} // namespace tvbeam

#include "mms/admissible/consistency.hpp"

#include "core/point_grid.hpp"
#include "core/space/mesh.hpp"
#include "core/space/point_values.hpp"
#include "core/space/quadrature.hpp"
#include "core/time/time_scheme.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/piecewise_tape.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/largest_size.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;
using GiNaC::ex;

namespace {

constexpr Index time_samples = 17;

/// Below so much of the terms that a residual is the sum of, it is rounding: zero.
constexpr double rounding = 1e-14;

PiecewiseTape tape_of(const AdmissibleSolution& solution,
                      const std::function<GiNaC::exvector(const DerivedPhase&)>& formulas) {
    return located(solution.place(), "the solution",
                   [&] { return PiecewiseTape(solution.derived(), formulas); });
}

/// The size of the terms that the residuals of one refinement are sums of.
struct Sizes {
    double heat = 0.0;
    double beam = 0.0;
};

/// heat_vanishes, beam_vanishes: by the formulas.
void finish(std::vector<Residual>& residuals, const std::vector<Sizes>& sizes, bool heat_vanishes,
            bool beam_vanishes) {
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        Residual& fine = residuals[i];
        if (fine.heat <= rounding * sizes[i].heat)
            fine.heat = 0.0;
        if (fine.beam <= rounding * sizes[i].beam)
            fine.beam = 0.0;
        fine.heat_is_known = heat_vanishes || fine.heat != 0.0;
        fine.beam_is_known = beam_vanishes || fine.beam != 0.0;
        if (i == 0)
            continue;
        const Residual& coarse = residuals[i - 1];
        const double ratio =
            std::log(static_cast<double>(fine.count) / static_cast<double>(coarse.count));
        const auto order = [ratio](double before, double now) -> std::optional<double> {
            const bool has_order = now > 0.0 && before > 0.0 && std::isfinite(before + now);
            return has_order ? std::optional(std::log(before / now) / ratio) : std::nullopt;
        };
        fine.heat_order = order(coarse.heat, fine.heat);
        fine.beam_order = order(coarse.beam, fine.beam);
    }
}

/// A norm of values whose squares may leave the range of doubles.
double scaled_norm(const auto& values, const auto& norm) {
    const double largest = values.abs().maxCoeff();
    return largest > 0.0 && std::isfinite(largest) ? largest * norm(values / largest) : largest;
}

/// What is asked for at nodes, and within elements.
enum NodalRow : Index { theta, theta_t, stress };
enum InnerRow : Index { u_xx, u_xxt, f, mu };

/// Both of one phase.
struct SpaceTapes {
    const Tape& nodal;
    const Tape& inner;
};

/// What the residuals of one mesh are made with.
struct MeshForms {
    Mesh mesh;
    Eigen::ArrayXd points; ///< element_points, one after the other
    Tridiagonal mass, stiffness;
    VectorXd weights; ///< of the lumped mass matrix

    MeshForms(std::int64_t elements, ThermalMass kind)
        : mesh(Mesh::uniform(elements)), points(element_points(mesh, 0, elements).reshaped()),
          mass(thermal_mass_matrix(mesh, kind)), stiffness(stiffness_matrix(mesh)),
          weights(thermal_mass_matrix(mesh, ThermalMass::lumped).diagonal) {}
};

/// The two residuals in space at one time; values: the inner rows at forms.points, nodal: the nodal
/// ones at the nodes.
Residual space_residual(const Eigen::Ref<const Eigen::ArrayXXd>& values,
                        const Eigen::Ref<const Eigen::ArrayXXd>& nodal, const Beam& beam,
                        const MeshForms& forms) {
    const Mesh& mesh = forms.mesh;
    const Index s = mesh.elements();
    const auto projected = [&](const auto& row) {
        return project(mesh, PointValues(row.reshaped(element_rule_size, s)));
    };
    const VectorXd homogeneous =
        (nodal.row(theta).transpose() - beam.theta_A * (1.0 - mesh.nodes)).matrix();
    const VectorXd rate = nodal.row(theta_t).transpose().matrix();
    const DiscontinuousLinear curvature_rate = projected(values.row(u_xxt));
    const PointValues source = values.row(f).reshaped(element_rule_size, s);
    const VectorXd loads = hat_loads(mesh, source) + beam.alpha * hat_loads(mesh, curvature_rate);
    const VectorXd residual = forms.mass * VectorXd(rate.segment(1, s - 1)) +
                              forms.stiffness * VectorXd(homogeneous.segment(1, s - 1)) -
                              loads.segment(1, s - 1);

    DiscontinuousLinear balance =
        projected(values.row(u_xx) + values.row(mu)) + beam.zeta * curvature_rate;
    const ArrayXd at_nodes =
        beam.alpha * nodal.row(theta).transpose() - nodal(stress, 0) * (1.0 - mesh.nodes);
    balance.row(0) += at_nodes.head(s).transpose();
    balance.row(1) += at_nodes.tail(s).transpose();
    return {.count = s,
            .heat = scaled_norm(residual.array(),
                                [&](const ArrayXd& one) {
                                    return std::sqrt((one.square() / forms.weights.array()).sum());
                                }),
            .beam = scaled_norm(balance,
                                [&](const DiscontinuousLinear& one) {
                                    return std::sqrt(inner_product(mesh, one, one));
                                }),
            .heat_order = std::nullopt,
            .beam_order = std::nullopt,
            .heat_is_known = true,
            .beam_is_known = true};
}

/// Those of a phase's formulas at these times.
std::vector<Residual> space_residuals_at(const SpaceTapes& tapes, const Beam& beam,
                                         const MeshForms& forms, const ArrayXd& times) {
    const auto values_at = [&](const Tape& tape, const ArrayXd& x) {
        const Points points = point_grid(x, times);
        return tape.evaluate(points.x, points.t);
    };
    const Index at_points = forms.points.size();
    const Index at_nodes = forms.mesh.nodes.size();
    const Eigen::ArrayXXd values = values_at(tapes.inner, forms.points);
    const Eigen::ArrayXXd nodal = values_at(tapes.nodal, forms.mesh.nodes);
    std::vector<Residual> residuals;
    for (Index n = 0; n < times.size(); ++n)
        residuals.push_back(space_residual(values.middleCols(n * at_points, at_points),
                                           nodal.middleCols(n * at_nodes, at_nodes), beam, forms));
    return residuals;
}

bool vanishes_in_all(const DerivedSolution& derived, double final_time, const auto& formula) {
    for (std::size_t i = 0; i < derived.phases.size(); ++i)
        if (derived.phases[i].begin_value < final_time &&
            !is_identically_zero(formula(derived.derived[i])))
            return false;
    return true;
}

/// How many derivatives in t of a formula vanish at the least; one more than matters where it is
/// more, or where they are too large to be made.
int derivatives_until_zero(const DerivedSolution& derived, double final_time, const auto& formula) {
    constexpr int most = 4; // of which each scheme leaves something
    try {
        for (int times = 0; times < most; ++times)
            if (vanishes_in_all(derived, final_time, [&](const DerivedPhase& phase) {
                    ex result = formula(phase);
                    for (int k = 0; k < times; ++k)
                        result = derivative(result, model_symbols().t);
                    return result;
                }))
                return times;
    } catch (const AlgebraError&) {
        // Nothing is known of it.
    }
    return most;
}

/// Times of a phase of equal distance, and behind them those at which θ̃_xx and θ̃_xxt are largest: a
/// narrow pulse may stand between the others.
ArrayXd times_to_look_at(const DerivedPhase& phase, const CloseLook& span) {
    const ArrayXd even = ArrayXd::LinSpaced(time_samples, span.begin, span.end);
    std::vector<double> times(even.begin(), even.end());
    for (const ex& formula : {phase.theta_xx, derivative(phase.theta_xx, model_symbols().t)}) {
        if (is_identically_zero(formula))
            continue;
        const Tape tape = compile_tape({formula});
        const auto values = [&tape](const ArrayXd& x, const ArrayXd& t) -> ArrayXd {
            return tape.evaluate(x, t).row(0);
        };
        if (const LargestPoint found = largest_point(values, {0.0, 1.0}, span); found.size > 0.0)
            times.push_back(found.t);
    }
    return Eigen::Map<const ArrayXd>(times.data(), static_cast<Index>(times.size()));
}

/// The largest residuals in space over one phase, looked at ever more closely next to the largest
/// of the times given.
template <typename ResidualAt>
Residual largest_residual(const CloseLook& phase, const ArrayXd& times, const ResidualAt& at) {
    const std::vector<Residual> sampled = at(times);
    Residual largest = sampled.front();
    for (const auto size : {&Residual::heat, &Residual::beam}) {
        const auto greatest = std::ranges::max_element(sampled, {}, size);
        double best = times(greatest - sampled.begin());
        largest.*size = (*greatest).*size;
        constexpr double least_growth = 1e-3;
        bool grows = true;
        for (double distance = times(1) - times(0); grows; distance *= 0.25) {
            const double before = largest.*size;
            const ArrayXd closer = phase.next_to(best, distance).samples();
            const std::vector<Residual> residuals = at(closer);
            for (Index n = 0; n < closer.size(); ++n)
                if (const double here = residuals[static_cast<std::size_t>(n)].*size;
                    here > largest.*size) {
                    largest.*size = here;
                    best = closer(n);
                }
            grows = largest.*size > (1.0 + least_growth) * before;
        }
    }
    return largest;
}

double level_time(double final_time, double level, std::int64_t steps) {
    return final_time * level / static_cast<double>(steps);
}

/// Whether the times of one are among those of the other, to the last bit: a level that falls on
/// the end of a phase must not miss it.
bool has_levels_of(std::int64_t finer, std::int64_t coarse) {
    return finer % coarse == 0 && std::has_single_bit(static_cast<std::uint64_t>(finer / coarse));
}

} // namespace

/// So many steps at a time stay in the cache.
constexpr Index steps_at_once = 64;

/// θ̃ over x and, below it, u_xx, column by column at the levels or stages of all steps.
struct StepStates {
    Eigen::ArrayXXd values, rates; ///< shape of each: twice the points × levels

    /// tape: θ̃, u_xx and their rates.
    StepStates(const PiecewiseTape& tape, const ArrayXd& x, const ArrayXd& times)
        : values(2 * x.size(), times.size()), rates(2 * x.size(), times.size()) {
        for (Index first = 0; first < times.size(); first += steps_at_once) {
            const Index count = std::min(steps_at_once, times.size() - first);
            const Eigen::ArrayXXd all = tape.at_all(x, times.segment(first, count));
            const auto row = [&](Index k) { return all.row(k).reshaped(x.size(), count); };
            values.middleCols(first, count) << row(0), row(1);
            rates.middleCols(first, count) << row(2), row(3);
        }
    }
};

namespace {

/// The levels of so many steps, or of a multiple of them.
class Steps {
public:
    Steps(const PiecewiseTape& tape, const ArrayXd& x, const StepStates& levels, double final_time,
          std::int64_t steps)
        : tape_(tape), x_(x), final_time_(final_time), steps_(steps),
          stride_((levels.values.cols() - 1) / steps), levels_(levels) {}

    /// θ̃ and u_xx at the ends of so many steps from this one on.
    [[nodiscard]] Eigen::ArrayXXd values(Index first, Index count) const {
        return levels_.values(Eigen::all, ends(first, count));
    }

    /// The defects of both in these steps, none of which the scheme leaves to its starter.
    [[nodiscard]] Eigen::ArrayXXd defects(const TimeScheme& scheme, Index first,
                                          Index count) const {
        const double dt = final_time_ / static_cast<double>(steps_);
        const auto difference = [&](Index step) -> Eigen::ArrayXXd {
            return values(step, count) - values(step - 1, count);
        };
        std::vector<Eigen::ArrayXXd> increments;
        for (Index j = 1; j <= scheme.history; ++j)
            increments.push_back(difference(first - j));
        for (const Stage& stage : scheme.stages) {
            Eigen::ArrayXXd increment = dt / stage.leading * rates(first, count, stage.fraction);
            for (std::size_t j = 0; j < stage.weights.size(); ++j)
                increment += stage.weights[j] * increments[j];
            increments.push_back(std::move(increment));
        }
        return scheme.stages.back().leading / dt * (increments.back() - difference(first));
    }

private:
    [[nodiscard]] Eigen::ArithmeticSequence<Index, Index, Index> ends(Index first,
                                                                      Index count) const {
        return Eigen::seqN(first * stride_, count, stride_);
    }

    /// In a stage of these steps.
    [[nodiscard]] Eigen::ArrayXXd rates(Index first, Index count, double fraction) const {
        if (fraction == 1.0)
            return levels_.rates(Eigen::all, ends(first, count));
        ArrayXd times(count);
        for (Index k = 0; k < count; ++k)
            times(k) =
                level_time(final_time_, static_cast<double>(first + k) - (1.0 - fraction), steps_);
        return StepStates(tape_, x_, times).rates;
    }

    const PiecewiseTape& tape_;
    const ArrayXd& x_;
    double final_time_;
    Index steps_, stride_;
    const StepStates& levels_;
};

double norm(const GaussRule& rule, const ArrayXd& values) {
    return scaled_norm(
        values, [&](const ArrayXd& one) { return std::sqrt((rule.weights * one.square()).sum()); });
}

/// Of the defects of several steps, one a column.
Sizes largest_norms(const GaussRule& rule, const Beam& beam, const Eigen::ArrayXXd& defects) {
    const Index points = rule.points.size();
    Sizes largest;
    for (const auto& defect : defects.colwise()) {
        const ArrayXd of_beam = defect.tail(points);
        largest.heat =
            std::max(largest.heat, norm(rule, defect.head(points) - beam.alpha * of_beam));
        largest.beam = std::max(largest.beam, beam.zeta * norm(rule, of_beam));
    }
    return largest;
}

/// What they are differences of, at the largest.
Sizes largest_terms(const Beam& beam, const Eigen::ArrayXXd& values) {
    const Index points = values.rows() / 2;
    const ArrayXd largest = values.abs().rowwise().maxCoeff();
    const double of_beam = largest.tail(points).maxCoeff();
    return {.heat = largest.head(points).maxCoeff() + beam.alpha * of_beam,
            .beam = beam.zeta * of_beam};
}

} // namespace

std::vector<Residual> space_residuals(const AdmissibleSolution& solution, ThermalMass mass,
                                      const std::vector<std::int64_t>& elements) {
    const Beam& beam = solution.beam();
    const double final_time = solution.final_time();
    const PiecewiseTape nodal = tape_of(solution, [](const DerivedPhase& phase) -> GiNaC::exvector {
        return {phase.theta, phase.theta_t, phase.contact_stress};
    });
    const PiecewiseTape inner = tape_of(solution, [](const DerivedPhase& phase) -> GiNaC::exvector {
        return {phase.u_xx, phase.u_xxt, phase.heat_source, phase.moment_load};
    });
    const ArrayXd grid = sample_points(0.0, 1.0);
    std::vector<Residual> result(elements.size());
    std::vector<Sizes> terms(elements.size());
    const DerivedSolution& derived = solution.derived();
    for (std::size_t k = 0; k < derived.phases.size(); ++k) {
        const PhaseExpressions& phase = derived.phases[k];
        if (!(phase.begin_value < final_time))
            break;
        const CloseLook span{phase.begin_value, std::min(phase.end_value, final_time)};
        const ArrayXd times = located(solution.place(), "the solution",
                                      [&] { return times_to_look_at(derived.derived[k], span); });
        const SpaceTapes tapes{nodal.of_phase(k), inner.of_phase(k)};
        const Points everywhere = point_grid(grid, times);
        const auto largest = [&](const Tape& tape) -> ArrayXd {
            return tape.evaluate(everywhere.x, everywhere.t).abs().rowwise().maxCoeff();
        };
        const ArrayXd at_nodes = largest(tapes.nodal);
        const ArrayXd inside = largest(tapes.inner);
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const MeshForms forms(elements[i], mass);
            const Residual here = largest_residual(span, times, [&](const ArrayXd& at) {
                return space_residuals_at(tapes, beam, forms, at);
            });
            // K has entries of the size s, and the norm multiplies by s once more.
            const auto s = static_cast<double>(elements[i]);
            terms[i].heat =
                std::max(terms[i].heat, at_nodes(theta_t) + inside(f) + s * s * at_nodes(theta));
            terms[i].beam = std::max(terms[i].beam, inside(u_xx) + inside(mu));
            result[i].count = here.count;
            result[i].heat = std::max(result[i].heat, here.heat);
            result[i].beam = std::max(result[i].beam, here.beam);
        }
    }
    const bool heat_vanishes = derivatives_until_zero(derived, final_time, [](const auto& phase) {
                                   return phase.theta_xx;
                               }) <= 1;
    const bool beam_vanishes =
        beam.alpha == 0.0 || vanishes_in_all(derived, final_time, [](const DerivedPhase& phase) {
            return phase.theta_xx;
        });
    finish(result, terms, heat_vanishes, beam_vanishes);
    return result;
}

TimeResiduals::TimeResiduals(const AdmissibleSolution& solution, std::vector<std::int64_t> steps)
    : beam_(solution.beam()), final_time_(solution.final_time()), steps_(std::move(steps)),
      exact_(std::make_unique<PiecewiseTape>(
          tape_of(solution,
                  [](const DerivedPhase& phase) -> GiNaC::exvector {
                      return {phase.theta, phase.u_xx, phase.theta_t, phase.u_xxt};
                  }))),
      heat_degree_(derivatives_until_zero(solution.derived(), final_time_,
                                          [&](const DerivedPhase& phase) -> ex {
                                              return phase.theta -
                                                     exact_rational(beam_.alpha) * phase.u_xx;
                                          })),
      beam_degree_(beam_.zeta == 0.0
                       ? 0
                       : derivatives_until_zero(solution.derived(), final_time_,
                                                [](const auto& phase) { return phase.u_xx; })),
      rule_(GaussRule::of(grid_points)) {
    for (const std::int64_t count : steps_) {
        const bool among_finer = std::ranges::any_of(steps_, [&](std::int64_t finer) {
            return finer > count && has_levels_of(finer, count);
        });
        if (among_finer || levels_.contains(count))
            continue;
        ArrayXd times(count + 1);
        for (Index n = 0; n <= count; ++n)
            times(n) = level_time(final_time_, static_cast<double>(n), count);
        levels_.emplace(count, std::make_unique<StepStates>(*exact_, rule_.points, times));
    }
}

TimeResiduals::~TimeResiduals() = default;

std::vector<Residual> TimeResiduals::of(const std::string& scheme) const {
    const TimeScheme& method = TimeScheme::named(scheme);
    std::vector<Residual> result;
    std::vector<Sizes> terms;
    for (const std::int64_t count : steps_) {
        Residual residual;
        residual.count = count;
        const double dt = final_time_ / static_cast<double>(count);
        const auto known = std::ranges::find_if(
            levels_, [&](const auto& one) { return has_levels_of(one.first, count); });
        const Steps exact(*exact_, rule_.points, *known->second, final_time_, count);
        for (Index first = 1 + method.history; first <= count; first += steps_at_once) {
            const Index now = std::min(steps_at_once, count - first + 1);
            const auto [heat, beam] =
                largest_norms(rule_, beam_, exact.defects(method, first, now));
            residual.heat = std::max(residual.heat, heat);
            residual.beam = std::max(residual.beam, beam);
        }
        result.push_back(residual);
        const Sizes size = largest_terms(beam_, known->second->values);
        terms.push_back({.heat = size.heat / dt, .beam = size.beam / dt});
    }
    finish(result, terms, heat_degree_ <= method.order + 1, beam_degree_ <= method.order + 1);
    return result;
}

} // namespace tvbeam

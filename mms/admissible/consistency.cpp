#include "mms/admissible/consistency.hpp"

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

enum Row : Index { theta, u_xx, theta_t, u_xxt, f, mu, stress };

/// The rows, where `wanted` begins; those behind it are left out.
PiecewiseTape rows(const AdmissibleSolution& solution, bool with_loads) {
    return located(solution.place(), "the solution", [&] {
        return PiecewiseTape(solution.derived(), [&](const DerivedPhase& phase) {
            std::vector<ex> result = {phase.theta, phase.u_xx, phase.theta_t, phase.u_xxt};
            if (with_loads)
                result.insert(result.end(),
                              {phase.heat_source, phase.moment_load, phase.contact_stress});
            return result;
        });
    });
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

/// The two residuals in space at one time; late: of the phase that begins there.
Residual space_residual(const PiecewiseTape& tape, const Beam& beam, const MeshForms& forms,
                        double t, bool late) {
    const Mesh& mesh = forms.mesh;
    const Index s = mesh.elements();
    const Eigen::ArrayXXd values = tape.at(forms.points, t, late);
    const auto projected = [&](const auto& row) {
        return project(mesh, PointValues(row.reshaped(element_rule_size, s)));
    };
    const Eigen::ArrayXXd nodal = tape.at(mesh.nodes, t, late);
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
    std::vector<Residual> sampled;
    std::transform(times.begin(), times.end(), std::back_inserter(sampled), at);
    Residual largest = sampled.front();
    for (const auto size : {&Residual::heat, &Residual::beam}) {
        const auto greatest = std::ranges::max_element(sampled, {}, size);
        double best = times(greatest - sampled.begin());
        largest.*size = (*greatest).*size;
        constexpr double least_growth = 1e-3;
        bool grows = true;
        for (double distance = times(1) - times(0); grows; distance *= 0.25) {
            const double before = largest.*size;
            for (const double t : phase.next_to(best, distance).samples())
                if (const double here = at(t).*size; here > largest.*size) {
                    largest.*size = here;
                    best = t;
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

/// θ̃, u_xx and their rates in the steps of one refinement.
class Steps {
public:
    /// levels: at the ends of these steps, or of a multiple of them; shape of each: points × 4.
    Steps(const PiecewiseTape& tape, const ArrayXd& x, const std::vector<Eigen::ArrayXXd>& levels,
          double final_time, std::int64_t steps)
        : tape_(tape), x_(x), levels_(levels), final_time_(final_time), steps_(steps),
          stride_(static_cast<std::int64_t>(levels.size() - 1) / steps) {}

    [[nodiscard]] const Eigen::ArrayXXd& at(std::int64_t level) const {
        return levels_[static_cast<std::size_t>(level * stride_)];
    }

    /// The defects of θ̃ and u_xx in the step that ends at level n; shape: points × 2.
    [[nodiscard]] Eigen::ArrayXXd defect(const TimeScheme& scheme, std::int64_t n) const {
        const double dt = final_time_ / static_cast<double>(steps_);
        const auto difference = [&](std::int64_t level) -> Eigen::ArrayXXd {
            return at(level).leftCols(2) - at(level - 1).leftCols(2);
        };
        std::vector<Eigen::ArrayXXd> increments;
        for (int j = 1; j <= scheme.history; ++j)
            increments.push_back(difference(n - j));
        for (const Stage& stage : scheme.stages) {
            Eigen::ArrayXXd increment = dt / stage.leading * rates(n, stage.fraction);
            for (std::size_t j = 0; j < stage.weights.size(); ++j)
                increment += stage.weights[j] * increments[j];
            increments.push_back(increment);
        }
        return scheme.stages.back().leading / dt * (increments.back() - difference(n));
    }

private:
    [[nodiscard]] Eigen::ArrayXXd rates(std::int64_t n, double fraction) const {
        if (fraction == 1.0)
            return at(n).rightCols(2);
        const double level = static_cast<double>(n) - (1.0 - fraction);
        return tape_.at(x_, level_time(final_time_, level, steps_)).bottomRows(2).transpose();
    }

    const PiecewiseTape& tape_;
    const ArrayXd& x_;
    const std::vector<Eigen::ArrayXXd>& levels_;
    double final_time_;
    std::int64_t steps_, stride_;
};

double norm(const GaussRule& rule, const ArrayXd& values) {
    return scaled_norm(
        values, [&](const ArrayXd& one) { return std::sqrt((rule.weights * one.square()).sum()); });
}

} // namespace

std::vector<Residual> space_residuals(const AdmissibleSolution& solution, ThermalMass mass,
                                      const std::vector<std::int64_t>& elements) {
    const Beam& beam = solution.beam();
    const double final_time = solution.final_time();
    const PiecewiseTape tape = rows(solution, true);
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
        ArrayXd sizes = ArrayXd::Zero(stress + 1);
        for (const double t : times)
            sizes = sizes.max(tape.at(grid, t, t == span.begin).abs().rowwise().maxCoeff());
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const MeshForms forms(elements[i], mass);
            const Residual here = largest_residual(span, times, [&](double t) {
                return space_residual(tape, beam, forms, t, t == span.begin);
            });
            // K has entries of the size s, and the norm multiplies by s once more.
            const auto s = static_cast<double>(elements[i]);
            terms[i].heat =
                std::max(terms[i].heat, sizes(theta_t) + sizes(f) + s * s * sizes(theta));
            terms[i].beam = std::max(terms[i].beam, sizes(u_xx) + sizes(mu));
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
      exact_(std::make_unique<PiecewiseTape>(rows(solution, false))),
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
        auto& levels = levels_[count];
        for (std::int64_t n = 0; n <= count; ++n)
            levels.emplace_back(
                exact_->at(rule_.points, level_time(final_time_, static_cast<double>(n), count))
                    .transpose());
    }
}

TimeResiduals::~TimeResiduals() = default;

std::vector<Residual> TimeResiduals::of(const std::string& scheme) const {
    const TimeScheme& method = TimeScheme::named(scheme);
    std::vector<Residual> result;
    std::vector<Sizes> terms;
    for (const std::int64_t count : steps_) {
        Residual residual;
        Sizes size;
        residual.count = count;
        const double dt = final_time_ / static_cast<double>(count);
        const auto known = std::ranges::find_if(
            levels_, [&](const auto& one) { return has_levels_of(one.first, count); });
        const Steps exact(*exact_, rule_.points, known->second, final_time_, count);
        for (std::int64_t n = 1 + method.history; n <= count; ++n) {
            const Eigen::ArrayXXd defect = exact.defect(method, n);
            residual.heat =
                std::max(residual.heat, norm(rule_, defect.col(0) - beam_.alpha * defect.col(1)));
            residual.beam = std::max(residual.beam, beam_.zeta * norm(rule_, defect.col(1)));
            const ArrayXd sizes = exact.at(n).abs().colwise().maxCoeff();
            size.heat = std::max(size.heat, (sizes(theta) + beam_.alpha * sizes(u_xx)) / dt);
            size.beam = std::max(size.beam, beam_.zeta * sizes(u_xx) / dt);
        }
        result.push_back(residual);
        terms.push_back(size);
    }
    finish(result, terms, heat_degree_ <= method.order + 1, beam_degree_ <= method.order + 1);
    return result;
}

} // namespace tvbeam

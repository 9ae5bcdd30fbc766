#include "mms/admissible/admissibility.hpp"

#include "mms/admissible/contact_rules.hpp"
#include "mms/admissible/jumps.hpp"
#include "mms/admissible/repair.hpp"
#include "mms/admissible/sampled_rules.hpp"
#include "mms/derivation.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/plain_solution.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using GiNaC::ex;

namespace {

/// Of single operations, to prove that the tip stays between the stops: a few tenths of a second.
constexpr std::int64_t most_enclosures = 1'000'000;

/// The largest sizes of the solution's parts over all phases; tolerances are relative to them.
struct Scales {
    double theta = 0.0;
    double u = 0.0;
    double u_x = 0.0;
    double u_xx = 0.0;
    double sigma = 0.0;
};

class AdmissibilityCheck {
public:
    AdmissibilityCheck(const Solution& solution, const DerivedSolution& derived,
                       const PlainSolution& plain, const Beam& beam, double final_time)
        : solution_(solution), derived_(derived), plain_(plain), beam_(beam),
          final_time_(final_time) {}

    Admissible run() {
        // Finite first: no comparison below can be trusted with a NaN.
        for (std::size_t i = 0; i < phase_count(); ++i) {
            require_finite(i);
            require_no_jump_within(i);
        }
        ContactRules contact = contact_rules();
        for (std::size_t i = 0; i < phase_count(); ++i) {
            require_end_values(i);
            contact.require(i);
            if (i + 1 < phase_count())
                require_continuity(i);
        }
        return {contact.law_distance(), contact.tip_is_sampled()};
    }

private:
    /// Phases that begin at the final time or later are not looked at.
    [[nodiscard]] std::size_t phase_count() const {
        const auto& phases = derived_.phases;
        return static_cast<std::size_t>(
            std::count_if(phases.begin(), phases.end(), [this](const PhaseExpressions& phase) {
                return phase.begin_value < final_time_;
            }));
    }

    [[nodiscard]] ArrayXd times(std::size_t i, Index count) const {
        const PhaseExpressions& phase = derived_.phases[i];
        return sample_points(phase.begin_value, std::min(phase.end_value, final_time_), count);
    }

    // Finite values.

    void require_finite(std::size_t i) {
        const DerivedPhase& phase = derived_.derived[i];
        const SolutionPhase& source = solution_.phases[i];
        const SourceText& sigma = source.sigma ? *source.sigma : source.u;
        const auto of = [&](const ex& formula, const SourceText& text, const std::string& what,
                            Computed quantity) {
            return largest(i, formula, text, what, quantity);
        };
        const auto scale = [](double& known, double largest) { known = std::max(known, largest); };
        using Q = Computed;
        scale(scales_.theta, of(phase.theta, source.theta, "theta", Q::theta));
        scale(scales_.u, of(phase.u, source.u, "u", Q::u));
        scale(scales_.u_x, of(phase.u_x, source.u, "u_x", Q::u_x));
        scale(scales_.u_xx, of(phase.u_xx, source.u, "u_xx", Q::u_xx));
        scale(scales_.sigma, of(phase.sigma, sigma, "sigma", Q::sigma));
        of(phase.theta_x, source.theta, "theta_x", Q::theta_x);
        of(phase.theta_t, source.theta, "theta_t", Q::theta_t);
        of(phase.theta_xx, source.theta, "theta_xx", Q::theta_xx);
        of(phase.u_xxx, source.u, "u_xxx", Q::u_xxx);
        if (beam_.zeta != 0.0)
            of(phase.u_xxxt, source.u, "u_xxxt", Q::u_xxxt);
        if (beam_.alpha != 0.0 || beam_.zeta != 0.0)
            of(phase.u_xxt, source.u, "u_xxt", Q::u_xxt);
        of(phase.body_force, sigma, "q of (2)", Q::body_force);
        of(phase.heat_source, source.theta, "f of (1)", Q::heat_source);
        of(phase.couple_load, source.u, "G of (3)", Q::couple_load);
        of(phase.moment_load, source.u, "the integral of G of (3)", Q::moment_load);
    }

    /// The largest absolute value on the grid; InputError where it is not finite, or not what the
    /// text says.
    double largest(std::size_t i, const ex& formula, const SourceText& source,
                   const std::string& what, Computed quantity) const {
        const Tape tape = located(source, what, [&] { return compile_tape({formula}); });
        if (formula.is_zero()) {
            require_as_written(i, tape, 0, quantity, what);
            return 0.0;
        }
        const auto values = [&](const ArrayXd& x, double t) -> ArrayXd {
            return tape.evaluate(x, ArrayXd::Constant(1, t)).row(0);
        };
        const double result =
            largest_on_grid(values, times(i, grid_points), final_time_, source.begin(), what);
        require_as_written(i, tape, 0, quantity, what);
        return result;
    }

    /// That a row of a tape is what the text says; only_x: at this end of the beam.
    void require_as_written(std::size_t i, const Tape& tape, Index row, Computed quantity,
                            const std::string& what, std::optional<double> only_x = {}) const {
        const ArrayXd values = tape.evaluate(plain_.x(i), plain_.t(i)).row(row);
        plain_.require(i, quantity, what, ComputedValues::of(values), only_x);
    }

    // Continuity within a phase: what a formula lacks of a derivative where it jumps.

    void require_no_jump_within(std::size_t i) const {
        const DerivedPhase& phase = derived_.derived[i];
        const SolutionPhase& source = solution_.phases[i];
        constexpr std::array names{"theta", "theta_x", "u", "u_x", "u_xx", "sigma"};
        const Tape tape = located(source.theta, "theta", [&] {
            return compile_tape(
                {phase.theta, phase.theta_x, phase.u, phase.u_x, phase.u_xx, phase.sigma});
        });
        const auto refuse = [&](std::size_t row, double jump, double x, double t,
                                const std::string& derivative) {
            const SourceText& text = row < 2    ? source.theta
                                     : row == 5 ? source.sigma.value_or(source.u)
                                                : source.u;
            const std::string load = row < 2 ? "heat source" : row == 5 ? "body force" : "load";
            throw InputError(text.begin(), jump_text(names.at(row), jump, t, x) +
                                               "the formula of its " + derivative +
                                               " lacks a delta function there, and the " + load +
                                               " with it");
        };
        const double begin = derived_.phases[i].begin_value;
        const double end = std::min(derived_.phases[i].end_value, final_time_);
        constexpr std::array<std::size_t, 2> in_t{0, 4};
        const bool is_expected = may_jump(phase.theta) || may_jump(phase.u);
        const double least = least_jump(is_expected);
        std::vector<std::array<std::size_t, 2>> pairs{{0, 2}, {1, 3}};
        if (may_jump(phase.sigma))
            pairs.push_back({5, 5});
        for (const double part : parts_to_search(is_expected || may_jump(phase.sigma))) {
            const ArrayXd t = ArrayXd::Constant(1, begin + part * (end - begin));
            for (const auto& in_x : pairs) {
                const auto in_space = [&](const ArrayXd& x) -> Eigen::ArrayXXd {
                    return tape.evaluate(x, t)(in_x, Eigen::all);
                };
                const auto exactly = [&](const ArrayXd& x) -> Eigen::ArrayXXd {
                    return tape.evaluate_wide(x, t)(in_x, Eigen::all);
                };
                if (const auto jump = find_jump(in_space, exactly, uneven_grid(0.0, 1.0),
                                                in_x[0] == 5 ? least_jump(true) : least))
                    refuse(in_x.at(static_cast<std::size_t>(jump->row)), jump->size, jump->at, t(0),
                           "derivative in x");
            }
            const ArrayXd x = ArrayXd::Constant(1, part);
            const auto in_time = [&](const ArrayXd& s) -> Eigen::ArrayXXd {
                return tape.evaluate(x, s)(in_t, Eigen::all);
            };
            const auto exactly = [&](const ArrayXd& s) -> Eigen::ArrayXXd {
                return tape.evaluate_wide(x, s)(in_t, Eigen::all);
            };
            if (const auto jump = find_jump(in_time, exactly, uneven_grid(begin, end), least))
                refuse(in_t.at(static_cast<std::size_t>(jump->row)), jump->size, part, jump->at,
                       "rate");
        }
    }

    // End values (5), (10).

    /// An expression at one end of the beam.
    [[nodiscard]] ex at_end(const ex& formula, int x, const SourceText& source,
                            const std::string& what) const {
        return located(source, what + " at x = " + std::to_string(x), [&] {
            return substituted(formula, {{model_symbols().x, x}});
        });
    }

    [[nodiscard]] ArrayXd series(const ex& formula, const ArrayXd& in_time,
                                 const SourceText& source, const std::string& what) const {
        const Tape tape = located(source, what, [&] { return compile_tape({formula}); });
        return tape.evaluate(ArrayXd::Zero(1), in_time).row(0);
    }

    void require_end_values(std::size_t i) const {
        const DerivedPhase& phase = derived_.derived[i];
        const SolutionPhase& source = solution_.phases[i];
        const ex x = model_symbols().x;
        const ex theta_A = exact_rational(beam_.theta_A);
        const auto at = [&](const ex& formula, int end, const SourceText& text,
                            const std::string& what) { return at_end(formula, end, text, what); };
        const ex u = at(phase.u, 0, source.u, "(5): u(0,t)");
        const ex u_x = at(phase.u_x, 0, source.u, "(5): u_x(0,t)");
        const ex theta_0 = at(phase.theta, 0, source.theta, "(10): theta(0,t)");
        const ex theta_1 = at(phase.theta, 1, source.theta, "(10): theta(1,t)");
        const std::string clamped = "0 at the clamped end: ";
        const std::string or_factor = ", or give u a factor x^2";
        const auto as_written = [&](const ex& formula, double end, Computed quantity,
                                    const SourceText& text, const std::string& what) {
            const Tape tape = located(text, what, [&] { return compile_tape({formula}); });
            require_as_written(i, tape, 0, quantity, what, end);
        };
        as_written(u, 0.0, Computed::u, source.u, "u(0,t)");
        as_written(u_x, 0.0, Computed::u_x, source.u, "u_x(0,t)");
        as_written(theta_0, 0.0, Computed::theta, source.theta, "theta(0,t)");
        as_written(theta_1, 1.0, Computed::theta, source.theta, "theta(1,t)");
        require_formula(i, u, 0.0, scales_.u, source.u, "(5): u(0,t)",
                        clamped + subtraction(u, "u(0,t)", "u") + or_factor);
        require_formula(i, u_x, 0.0, scales_.u_x, source.u, "(5): u_x(0,t)",
                        clamped + subtraction(u_x * x, "u_x(0,t)*x", "u") + or_factor);
        require_formula(
            i, theta_0, beam_.theta_A, scales_.theta, source.theta, "(10): theta(0,t)",
            exact_text(beam_.theta_A) + " = theta_A: " +
                (theta_0.is_zero()
                     ? "add theta_A*(1 - x) to theta"
                     : subtraction((theta_0 - theta_A) * (1 - x) + theta_1 * x,
                                   "(theta(0,t) - theta_A)*(1 - x) + theta(1,t)*x", "theta")));
        require_formula(i, theta_1, 0.0, scales_.theta, source.theta, "(10): theta(1,t)",
                        "0: " + subtraction(theta_1 * x, "theta(1,t)*x", "theta"));
    }

    /// That the formula, in t alone, has this value. rule: what it must be, and the repair.
    void require_formula(std::size_t i, const ex& formula, double value, double scale,
                         const SourceText& source, const std::string& what,
                         const std::string& rule) const {
        const ex difference = formula - exact_rational(value);
        if (is_identically_zero(difference))
            return;
        const ArrayXd in_time = times(i, time_points);
        require_value(series(difference, in_time, source, what), in_time, value,
                      relative_tolerance * scale, source.begin(), what, rule);
    }

    // The stops (6) and the contact stress (7), (8).

    [[nodiscard]] ContactRules contact_rules() const {
        std::vector<ContactPhase> phases;
        for (std::size_t i = 0; i < phase_count(); ++i) {
            const DerivedPhase& phase = derived_.derived[i];
            const SolutionPhase& source = solution_.phases[i];
            const ex tip = at_end(phase.u, 1, source.u, "u");
            Tape tape = located(source.u, "u(1,t)", [&] {
                return compile_tape({tip, phase.contact_stress});
            });
            require_as_written(i, tape, 0, Computed::u, "u(1,t)", 1.0);
            require_as_written(i, tape, 1, Computed::contact_stress, "sigma(1,t)");
            ContactPhase contact;
            contact.times = times(i, time_points);
            contact.tip = [tape](double begin, double end) {
                return tape.enclose(0, 0.0, begin, end);
            };
            contact.stress = [tape](double begin, double end) {
                return tape.enclose(1, 0.0, begin, end);
            };
            contact.most_parts =
                most_enclosures / (1 + static_cast<std::int64_t>(tape.instruction_count()));
            contact.ends = [tape = std::move(tape)](const ArrayXd& in_time) {
                return tape.evaluate(ArrayXd::Zero(1), in_time);
            };
            contact.u = source.u.begin();
            contact.u_names_g1 = first_use(source.u, "g1").has_value();
            contact.u_names_g2 = first_use(source.u, "g2").has_value();
            if (source.sigma) {
                contact.sigma = source.sigma->begin();
                contact.sigma_formula = source.sigma->text();
            }
            phases.push_back(std::move(contact));
        }
        return {beam_, std::move(phases), scales_.u, scales_.sigma};
    }

    // Continuity in time.

    void require_continuity(std::size_t i) const {
        const DerivedPhase& before = derived_.derived[i];
        const DerivedPhase& after = derived_.derived[i + 1];
        const SolutionPhase& source = solution_.phases[i + 1];
        require_no_jump(i, before.theta, after.theta, scales_.theta, source.theta, "(1)", "theta");
        require_no_jump(i, before.u, after.u, scales_.u, source.u, "(3)", "u");
        require_no_jump(i, before.u_xx, after.u_xx, scales_.u_xx, source.u, "(3)", "u_xx");
    }

    void require_no_jump(std::size_t i, const ex& before, const ex& after, double scale,
                         const SourceText& source, const std::string& equation,
                         const std::string& what) const {
        const PhaseExpressions& phase = derived_.phases[i];
        const ex jump = after - before;
        const ex at_time = located(source, what, [&] {
            return substituted(jump, {{model_symbols().t, phase.end}});
        });
        if (is_identically_zero(at_time))
            return;
        const ArrayXd x = sample_points(0.0, 1.0);
        const Tape tape = located(source, what, [&] { return compile_tape({at_time, jump}); });
        const ArrayXd values = tape.evaluate(x, ArrayXd::Constant(1, phase.end_value)).row(0);
        Index largest = 0;
        const double size = values.abs().maxCoeff(&largest);
        if (size <= relative_tolerance * scale)
            return;
        const auto distance = [&](double t) {
            return tape.evaluate(x, ArrayXd::Constant(1, t)).row(1).abs().maxCoeff();
        };
        // The later phase must be left a time of its own, unless the run ends before it does.
        const double last =
            std::min(std::nextafter(derived_.phases[i + 1].end_value, 0.0), final_time_);
        const auto meeting = meeting_time(distance, phase.begin_value, last, phase.end_value,
                                          relative_tolerance * scale);
        throw InputError(
            source.begin(),
            jump_text(equation + ": " + what, values(largest), phase.end_value, x(largest)) +
                subtraction(at_time, "the difference of the phases there",
                            what + " of the later phase") +
                (meeting ? ", or move until to " + *meeting + ", where the phases meet" : ""));
    }

    const Solution& solution_;
    const DerivedSolution& derived_;
    const PlainSolution& plain_;
    const Beam& beam_;
    double final_time_;
    Scales scales_;
};

} // namespace

double require_final_time(double final_time) {
    if (!(final_time > 0.0) || !std::isfinite(final_time))
        throw InputError({}, "the final time is " + number_text(final_time) +
                                 "; it must be positive and finite");
    return final_time;
}

AdmissibleSolution::AdmissibleSolution(const Solution& solution, const Beam& beam,
                                       double final_time)
    : solution_(solution), beam_(beam), final_time_(require_final_time(final_time)),
      derived_(std::make_unique<DerivedSolution>(derive_on(solution, beam))),
      plain_(std::make_unique<PlainSolution>(solution, *derived_, beam, final_time)),
      remarks_(located(place(), "the solution", [&] {
          return AdmissibilityCheck(solution, *derived_, *plain_, beam_, final_time).run();
      })) {}

AdmissibleSolution::~AdmissibleSolution() = default;

} // namespace tvbeam

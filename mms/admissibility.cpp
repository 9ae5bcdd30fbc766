#include "mms/admissibility.hpp"

#include "mms/admissibility_check.hpp"
#include "mms/algebra.hpp"
#include "mms/error_text.hpp"
#include "mms/repair.hpp"
#include "mms/symbols.hpp"
#include "mms/tape_compiler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using GiNaC::ex;

namespace {

constexpr double relative_tolerance = 1e-12;
constexpr Index grid_points = 33;  ///< in space, and in time for the grid
constexpr Index time_points = 257; ///< for what depends on time only; both ends are among them

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
    AdmissibilityCheck(const Solution& solution, const DerivedSolution& derived, const Beam& beam,
                       double final_time)
        : solution_(solution), derived_(derived), beam_(beam), final_time_(final_time) {}

    void run() {
        // Finite first: no comparison below can be trusted with a NaN.
        for (std::size_t i = 0; i < phase_count(); ++i)
            require_finite(i);
        for (std::size_t i = 0; i < phase_count(); ++i) {
            require_end_values(i);
            require_contact(i);
            if (i + 1 < phase_count())
                require_continuity(i);
        }
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
        return ArrayXd::LinSpaced(count, phase.begin_value, std::min(phase.end_value, final_time_));
    }

    [[nodiscard]] static ArrayXd points() { return ArrayXd::LinSpaced(grid_points, 0.0, 1.0); }

    // Finite values.

    void require_finite(std::size_t i) {
        const DerivedPhase& phase = derived_.derived[i];
        const SolutionPhase& source = solution_.phases[i];
        const SourceText& sigma = source.sigma ? *source.sigma : source.u;
        scales_.theta = std::max(scales_.theta, largest(i, phase.theta, source.theta, "theta"));
        scales_.u = std::max(scales_.u, largest(i, phase.u, source.u, "u"));
        scales_.u_x = std::max(scales_.u_x, largest(i, phase.u_x, source.u, "u_x"));
        scales_.u_xx = std::max(scales_.u_xx, largest(i, phase.u_xx, source.u, "u_xx"));
        scales_.sigma = std::max(scales_.sigma, largest(i, phase.sigma, sigma, "sigma"));
        largest(i, phase.theta_x, source.theta, "theta_x");
        for (const ex& term : phase.theta_terms)
            largest(i, term, source.theta, "a derivative of theta");
        for (const ex& term : phase.u_terms)
            largest(i, term, source.u, "a derivative of u");
        largest(i, phase.body_force, sigma, "q of (2)");
        largest(i, phase.heat_source, source.theta, "f of (1)");
        largest(i, phase.couple_load, source.u, "G of (3)");
        largest(i, phase.moment_load, source.u, "the integral of G of (3)");
    }

    /// The largest absolute value on the grid; InputError where it is not finite.
    double largest(std::size_t i, const ex& formula, const SourceText& source,
                   const std::string& what) const {
        if (formula.is_zero())
            return 0.0;
        const Tape tape = located(source, what, [&] { return compile_tape({formula}); });
        const ArrayXd x = points();
        double result = 0.0;
        for (const double t : times(i, grid_points)) {
            const ArrayXd values = tape.evaluate(x, ArrayXd::Constant(1, t)).row(0);
            for (Index k = 0; k < x.size(); ++k) {
                if (!std::isfinite(values(k)))
                    throw InputError(source.begin(),
                                     what + " is not finite at x = " + number_text(x(k)) +
                                         ", t = " + number_text(t) + " (it is " +
                                         number_text(values(k)) +
                                         "); write it so that it and its derivatives exist "
                                         "everywhere on [0, 1] x [0, " +
                                         number_text(final_time_) + "]" +
                                         (t > 0.0 ? ", or end the run before that time" : ""));
                result = std::max(result, std::abs(values(k)));
            }
        }
        return result;
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
        require_value(i, u, 0.0, scales_.u, source.u, "(5): u(0,t)",
                      clamped + subtraction(u, "u(0,t)", "u") + or_factor);
        require_value(i, u_x, 0.0, scales_.u_x, source.u, "(5): u_x(0,t)",
                      clamped + subtraction(u_x * x, "u_x(0,t)*x", "u") + or_factor);
        require_value(i, theta_0, beam_.theta_A, scales_.theta, source.theta, "(10): theta(0,t)",
                      number_text(beam_.theta_A) + " = theta_A: " +
                          (theta_0.is_zero()
                               ? "add theta_A*(1 - x) to theta"
                               : subtraction((theta_0 - theta_A) * (1 - x),
                                             "(theta(0,t) - theta_A)*(1 - x)", "theta")));
        require_value(i, theta_1, 0.0, scales_.theta, source.theta, "(10): theta(1,t)",
                      "0: " + subtraction(theta_1 * x, "theta(1,t)*x", "theta"));
    }

    /// That the formula, in t alone, has this value. rule: what it must be, and the repair.
    void require_value(std::size_t i, const ex& formula, double value, double scale,
                       const SourceText& source, const std::string& what,
                       const std::string& rule) const {
        const ex difference = formula - exact_rational(value);
        if (is_identically_zero(difference))
            return;
        const ArrayXd in_time = times(i, time_points);
        const ArrayXd error = series(difference, in_time, source, what);
        const double tolerance = relative_tolerance * scale;
        const auto broken = std::find_if(error.begin(), error.end(), [tolerance](double e) {
            return !(std::abs(e) <= tolerance);
        });
        if (broken != error.end())
            throw InputError(source.begin(),
                             what + " is " + number_text(value + *broken) +
                                 " at t = " + number_text(in_time(broken - error.begin())) +
                                 "; it must be " + rule);
    }

    // The stops (6) and the contact stress (7), (8).

    /// u(1,t) and σ̃(1,t) of a phase, on arrays of times.
    struct Contact {
        Tape tape;

        [[nodiscard]] Eigen::ArrayXXd at(const ArrayXd& in_time) const {
            return tape.evaluate(ArrayXd::Zero(1), in_time);
        }
        [[nodiscard]] double tip(double t) const { return at(ArrayXd::Constant(1, t))(0, 0); }
        [[nodiscard]] double stress(double t) const { return at(ArrayXd::Constant(1, t))(1, 0); }
    };

    [[nodiscard]] Contact contact(std::size_t i) const {
        const DerivedPhase& phase = derived_.derived[i];
        const SourceText& source = solution_.phases[i].u;
        const ex tip = at_end(phase.u, 1, source, "u");
        return {located(source, "u(1,t)", [&] {
            return compile_tape({tip, phase.contact_stress});
        })};
    }

    void require_contact(std::size_t i) const {
        const SolutionPhase& source = solution_.phases[i];
        const ArrayXd in_time = times(i, time_points);
        const Contact ends = contact(i);
        const Eigen::ArrayXXd values = ends.at(in_time);
        for (Index k = 0; k < in_time.size(); ++k) {
            require_between_stops(in_time(k), values(0, k), source.u);
            if (source.sigma)
                require_stress(i, ends, in_time(k), values(0, k), values(1, k));
        }
    }

    [[nodiscard]] double tip_tolerance() const { return relative_tolerance * scales_.u; }
    [[nodiscard]] double stress_tolerance() const { return relative_tolerance * scales_.sigma; }
    [[nodiscard]] bool at_lower(double tip) const {
        return tip <= beam_.stops.lower + tip_tolerance();
    }
    [[nodiscard]] bool at_upper(double tip) const {
        return tip >= beam_.stops.upper - tip_tolerance();
    }

    void require_between_stops(double t, double tip, const SourceText& source) const {
        const bool below = tip < beam_.stops.lower - tip_tolerance();
        const bool above = tip > beam_.stops.upper + tip_tolerance();
        if (!below && !above)
            return;
        throw InputError(source.begin(),
                         "(6): u(1,t) is " + number_text(tip) + " at t = " + number_text(t) +
                             "; it must be at " + (below ? "least g1 = " : "most g2 = ") +
                             number_text(below ? beam_.stops.lower : beam_.stops.upper) + "; " +
                             repair_of_tip(below));
    }

    /// What brings the tip back between the stops: measured where it is farthest out.
    [[nodiscard]] std::string repair_of_tip(bool below) const {
        double least = 0.0;
        double greatest = 0.0;
        double least_at = 0.0;
        double greatest_at = 0.0;
        bool pressed = false;
        for (std::size_t i = 0; i < phase_count(); ++i) {
            const ArrayXd in_time = times(i, time_points);
            const Eigen::ArrayXXd values = contact(i).at(in_time);
            pressed = pressed || values.row(1).abs().maxCoeff() > stress_tolerance();
            for (Index k = 0; k < in_time.size(); ++k) {
                if (values(0, k) < least) {
                    least = values(0, k);
                    least_at = in_time(k);
                }
                if (values(0, k) > greatest) {
                    greatest = values(0, k);
                    greatest_at = in_time(k);
                }
            }
        }
        const double stop = below ? beam_.stops.lower : beam_.stops.upper;
        const double extreme = below ? least : greatest;
        const std::string name = below ? "g1" : "g2";
        const std::string text = std::string("it is ") + (below ? "least, " : "greatest, ") +
                                 number_text(extreme) +
                                 ", at t = " + number_text(below ? least_at : greatest_at) + ": ";
        // A solution that presses on a stop would come off it if all of u were made smaller.
        if (pressed)
            return text + "change u(1,t) by " + number_text(rounded_out(stop - extreme)) +
                   " there; (3*x^2 - x^3)/2 is a deflection that is 1 at the tip";
        const double factor = std::min({1.0, least < 0.0 ? beam_.stops.lower / least : 1.0,
                                        greatest > 0.0 ? beam_.stops.upper / greatest : 1.0});
        return text + "multiply u by " + number_text(rounded_in(factor)) + ", or move " + name +
               " to " + number_text(rounded_out(extreme));
    }

    void require_stress(std::size_t i, const Contact& ends, double t, double tip,
                        double stress) const {
        if (std::abs(stress) <= stress_tolerance())
            return;
        const SourceText& source = *solution_.phases[i].sigma;
        const auto fail = [&](const std::string& equation, const std::string& rule) {
            throw InputError(source.begin(), equation + ": sigma(1,t) is " + number_text(stress) +
                                                 " at t = " + number_text(t) +
                                                 ", where u(1,t) is " + number_text(tip) +
                                                 "; it must be " + rule);
        };
        if (!beam_.stops.exist())
            fail("(7)", "0, as the beam has no stops; leave sigma out or give the beam stops");
        if (!at_lower(tip) && !at_upper(tip))
            fail("(7)", "0 strictly between the stops: " + repair_of_free_stress(tip));
        if (at_lower(tip) && !at_upper(tip) && stress < 0.0)
            fail("(8)", "at least 0 at the stop g1: " + repair_of_sign(i, ends, t));
        if (at_upper(tip) && !at_lower(tip) && stress > 0.0)
            fail("(8)", "at most 0 at the stop g2: " + repair_of_sign(i, ends, t));
    }

    /// A stress while the tip is free.
    [[nodiscard]] std::string repair_of_free_stress(double tip) const {
        const double to_upper = beam_.stops.upper - tip;
        const double to_lower = tip - beam_.stops.lower;
        const bool upper = to_upper <= to_lower;
        return std::string("set sigma to 0 in this phase, or bring the tip to ") +
               (upper ? "g2, " : "g1, ") + number_text(upper ? to_upper : to_lower) + " away";
    }

    /// A stress of the wrong sign: all of it, or from the time on when it changes sign.
    [[nodiscard]] std::string repair_of_sign(std::size_t i, const Contact& ends, double t) const {
        const bool positive = ends.stress(t) > 0.0;
        const ArrayXd stress = ends.at(times(i, time_points)).row(1);
        const double tolerance = stress_tolerance();
        const bool all =
            positive ? stress.minCoeff() >= -tolerance : stress.maxCoeff() <= tolerance;
        if (all)
            return "change its sign, sigma = \"-(" + solution_.phases[i].sigma->text() + ")\"";
        const auto has_sign = [&](double time) { return (ends.stress(time) > 0.0) == positive; };
        const ArrayXd in_time = times(i, time_points);
        const bool from_start = has_sign(in_time(0)) && std::abs(stress(0)) > tolerance;
        double other = t;
        for (Index k = 0; k < in_time.size(); ++k)
            if (std::abs(stress(k)) > tolerance && (stress(k) > 0.0) != positive &&
                (from_start ? in_time(k) > t : in_time(k) < t)) {
                other = in_time(k);
                if (from_start)
                    break;
            }
        const double change = switch_time(has_sign, std::min(t, other), std::max(t, other));
        return "it changes its sign at t = " + number_text(change) +
               (from_start ? "; begin the contact there" : "; end the phase there");
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
        const ArrayXd x = points();
        const Tape tape = located(source, what, [&] { return compile_tape({at_time, jump}); });
        const ArrayXd values = tape.evaluate(x, ArrayXd::Constant(1, phase.end_value)).row(0);
        Index largest = 0;
        const double size = values.abs().maxCoeff(&largest);
        if (size <= relative_tolerance * scale)
            return;
        const auto distance = [&](double t) {
            return tape.evaluate(x, ArrayXd::Constant(1, t)).row(1).abs().maxCoeff();
        };
        const double last = std::min(derived_.phases[i + 1].end_value, final_time_);
        const auto meeting = meeting_time(distance, phase.begin_value, last, 1e-9 * scale);
        throw InputError(
            source.begin(),
            equation + ": " + what + " jumps by " + number_text(values(largest)) +
                " at t = " + number_text(phase.end_value) + ", x = " + number_text(x(largest)) +
                "; it must be continuous: " +
                subtraction(at_time, "the difference of the phases there",
                            what + " of the later phase") +
                (meeting && *meeting > phase.begin_value
                     ? ", or move until to " + number_text(*meeting) + ", where the phases meet"
                     : ""));
    }

    const Solution& solution_;
    const DerivedSolution& derived_;
    const Beam& beam_;
    double final_time_;
    Scales scales_;
};

} // namespace

void require_final_time(double final_time) {
    if (!(final_time > 0.0) || !std::isfinite(final_time))
        throw InputError({}, "the final time is " + number_text(final_time) +
                                 "; it must be positive and finite");
}

void check_admissible(const Solution& solution, const DerivedSolution& derived, const Beam& beam,
                      double final_time) {
    AdmissibilityCheck(solution, derived, beam, final_time).run();
}

void require_admissible(const Solution& solution, const Beam& beam, double final_time) {
    require_final_time(final_time);
    check_admissible(solution, derive_on(solution, beam), beam, final_time);
}

} // namespace tvbeam

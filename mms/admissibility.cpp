#include "mms/admissibility.hpp"

#include "mms/admissibility_check.hpp"
#include "mms/algebra.hpp"
#include "mms/error_text.hpp"
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
                                         number_text(final_time_) + "]");
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
        const std::string clamped = "at the clamped end; a factor x^2 in u makes it so";
        const std::string heated = "; add theta_A*(1 - x) to a theta that is zero at both ends";
        require_value(i, phase.u, 0, 0.0, scales_.u, source.u, "(5): u(0,t)", " " + clamped);
        require_value(i, phase.u_x, 0, 0.0, scales_.u_x, source.u, "(5): u_x(0,t)", " " + clamped);
        require_value(i, phase.theta, 0, beam_.theta_A, scales_.theta, source.theta,
                      "(10): theta(0,t)", " = theta_A" + heated);
        require_value(i, phase.theta, 1, 0.0, scales_.theta, source.theta, "(10): theta(1,t)",
                      "; a factor 1 - x, or sin(pi*x), makes it so");
    }

    void require_value(std::size_t i, const ex& formula, int x, double value, double scale,
                       const SourceText& source, const std::string& what,
                       const std::string& repair) const {
        const ex difference = at_end(formula, x, source, what) - exact_rational(value);
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
                                 "; it must be " + number_text(value) + repair);
    }

    // The stops (6) and the contact stress (7), (8).

    void require_contact(std::size_t i) const {
        const DerivedPhase& phase = derived_.derived[i];
        const SolutionPhase& source = solution_.phases[i];
        const ArrayXd in_time = times(i, time_points);
        const ArrayXd tip = series(at_end(phase.u, 1, source.u, "u"), in_time, source.u, "u(1,t)");
        const ArrayXd stress =
            series(phase.contact_stress, in_time, source.sigma ? *source.sigma : source.u, "sigma");
        for (Index k = 0; k < in_time.size(); ++k) {
            require_between_stops(in_time(k), tip(k), source.u);
            if (source.sigma)
                require_stress(in_time(k), tip(k), stress(k), *source.sigma);
        }
    }

    [[nodiscard]] double tip_tolerance() const { return relative_tolerance * scales_.u; }

    void require_between_stops(double t, double tip, const SourceText& source) const {
        const auto fail = [&](const std::string& stop, double value, const std::string& rule) {
            throw InputError(source.begin(), "(6): u(1,t) is " + number_text(tip) +
                                                 " at t = " + number_text(t) + "; it must be " +
                                                 rule + " " + stop + " = " + number_text(value) +
                                                 "; scale u down or move the stop");
        };
        if (tip < beam_.stops.lower - tip_tolerance())
            fail("g1", beam_.stops.lower, "at least");
        if (tip > beam_.stops.upper + tip_tolerance())
            fail("g2", beam_.stops.upper, "at most");
    }

    void require_stress(double t, double tip, double stress, const SourceText& source) const {
        const double tolerance = relative_tolerance * scales_.sigma;
        if (std::abs(stress) <= tolerance)
            return;
        const auto fail = [&](const std::string& equation, const std::string& rule) {
            throw InputError(source.begin(), equation + ": sigma(1,t) is " + number_text(stress) +
                                                 " at t = " + number_text(t) +
                                                 ", where u(1,t) is " + number_text(tip) +
                                                 "; it must be " + rule);
        };
        const bool at_lower = tip <= beam_.stops.lower + tip_tolerance();
        const bool at_upper = tip >= beam_.stops.upper - tip_tolerance();
        if (!beam_.stops.exist())
            fail("(7)", "0, as the beam has no stops; leave sigma out or give the beam stops");
        if (!at_lower && !at_upper)
            fail("(7)", "0 strictly between the stops; end the phase where the tip leaves the "
                        "stop, or set sigma to 0");
        if (at_lower && !at_upper && stress < 0.0)
            fail("(8)", "at least 0 at the stop g1; change its sign");
        if (at_upper && !at_lower && stress > 0.0)
            fail("(8)", "at most 0 at the stop g2; change its sign");
    }

    // Continuity in time.

    void require_continuity(std::size_t i) const {
        const DerivedPhase& before = derived_.derived[i];
        const DerivedPhase& after = derived_.derived[i + 1];
        const SolutionPhase& source = solution_.phases[i + 1];
        require_no_jump(i, before.theta, after.theta, scales_.theta, source.theta, "(1): theta");
        require_no_jump(i, before.u, after.u, scales_.u, source.u, "(3): u");
        require_no_jump(i, before.u_xx, after.u_xx, scales_.u_xx, source.u, "(3): u_xx");
    }

    void require_no_jump(std::size_t i, const ex& before, const ex& after, double scale,
                         const SourceText& source, const std::string& what) const {
        const PhaseExpressions& phase = derived_.phases[i];
        const ex jump = after - before;
        const ex at_time = located(source, what, [&] {
            return substituted(jump, {{model_symbols().t, phase.end}});
        });
        if (is_identically_zero(at_time))
            return;
        const ArrayXd x = points();
        const Tape tape = located(source, what, [&] { return compile_tape({at_time}); });
        const ArrayXd values = tape.evaluate(x, ArrayXd::Zero(1)).row(0);
        for (Index k = 0; k < x.size(); ++k)
            if (!(std::abs(values(k)) <= relative_tolerance * scale))
                throw InputError(source.begin(),
                                 what + " jumps by " + number_text(values(k)) + " at t = " +
                                     number_text(phase.end_value) + ", x = " + number_text(x(k)) +
                                     "; it must be continuous; make both phases agree at that "
                                     "time, or move until");
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

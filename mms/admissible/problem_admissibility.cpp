#include "mms/admissible/admissibility.hpp"

#include "mms/admissible/contact_rules.hpp"
#include "mms/admissible/jumps.hpp"
#include "mms/admissible/sampled_rules.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {

class ProblemAdmissibilityCheck {
public:
    ProblemAdmissibilityCheck(const ProblemData& problem, const std::string& name, const Beam& beam,
                              double final_time)
        : problem_(problem), exact_(*problem.exact), place_{name}, beam_(beam),
          final_time_(final_time) {}

    Admissible run() {
        // Finite first: no comparison below can be trusted with a NaN.
        theta_scale_ = largest(exact_.theta, "theta");
        u_scale_ = largest(exact_.u, "u");
        u_x_scale_ = largest(exact_.u_x, "u_x");
        largest(exact_.u_xx, "u_xx");
        // Where q is not zero, the stress at the tip is a difference.
        sigma_scale_ =
            std::max(largest(stress(), "sigma(1,t)"), largest(problem_.body_force, "q of (2)"));
        largest(exact_.theta_x, "theta_x");
        largest(problem_.heat_source, "f of (1)");
        largest(problem_.couple_load, "G of (3)");
        largest(problem_.moment_load, "the integral of G of (3)");
        require_end_values();
        ContactRules rules(beam_, {contact()}, u_scale_, sigma_scale_);
        rules.require(0);
        require_continuity(exact_.theta, "(1): theta");
        // As u(0,t) = u_x(0,t) = 0, no jump of u is without one of u_xx.
        require_continuity(exact_.u_xx, "(3): u_xx");
        return {rules.law_distance(), rules.tip_is_sampled()};
    }

private:
    [[nodiscard]] ArrayXd times(Index count) const {
        return sample_points(0.0, final_time_, count);
    }

    [[nodiscard]] SpaceTimeFunction function(const Field& field) const {
        return [this, &field](const ArrayXd& x, double t) { return values(problem_, field, x, t); };
    }

    [[nodiscard]] SpaceTimeFunction stress() const {
        return [this](const ArrayXd& x, double t) -> ArrayXd {
            const double here =
                exact_.stress ? problem_.amplitudes(ArrayXd::Constant(1, t))(*exact_.stress, 0)
                              : 0.0;
            return ArrayXd::Constant(x.size(), here);
        };
    }

    [[nodiscard]] double largest(const SpaceTimeFunction& g, const std::string& what) const {
        return largest_on_grid(g, times(grid_points), final_time_, place_, what);
    }
    double largest(const Field& field, const std::string& what) const {
        return field.is_zero() ? 0.0 : largest(function(field), what);
    }

    /// A function at one point, at every time.
    [[nodiscard]] static ArrayXd series(const SpaceTimeFunction& g, double x,
                                        const ArrayXd& in_time) {
        return in_time.unaryExpr([&](double t) { return g(ArrayXd::Constant(1, x), t)(0); });
    }

    // (5), (10)

    void require_end_values() const {
        const std::string clamped = "0 at the clamped end: ";
        const std::string or_factor = ", or give u a factor x^2";
        require_at(0.0, exact_.u, 0.0, u_scale_, "(5): u(0,t)",
                   clamped + "subtract u(0,t) from u" + or_factor);
        require_at(0.0, exact_.u_x, 0.0, u_x_scale_, "(5): u_x(0,t)",
                   clamped + "subtract u_x(0,t)*x from u" + or_factor);
        require_at(0.0, exact_.theta, beam_.theta_A, theta_scale_, "(10): theta(0,t)",
                   exact_text(beam_.theta_A) +
                       " = theta_A: subtract (theta(0,t) - theta_A)*(1 - x) from theta");
        require_at(1.0, exact_.theta, 0.0, theta_scale_, "(10): theta(1,t)",
                   "0: subtract theta(1,t)*x from theta");
    }

    void require_at(double x, const Field& field, double value, double scale,
                    const std::string& what, const std::string& rule) const {
        const ArrayXd in_time = times(time_points);
        require_value(series(function(field), x, in_time) - value, in_time, value,
                      relative_tolerance * scale, place_, what, rule);
    }

    // (6)–(8)

    [[nodiscard]] ContactPhase contact() const {
        ContactPhase phase;
        phase.times = times(time_points);
        phase.ends = [this](const ArrayXd& in_time) {
            Eigen::ArrayXXd ends(2, in_time.size());
            ends.row(0) = series(function(exact_.u), 1.0, in_time);
            ends.row(1) = series(stress(), 1.0, in_time);
            return ends;
        };
        phase.u = place_;
        if (exact_.stress)
            phase.sigma = place_;
        return phase;
    }

    // Continuity in time.

    void require_continuity(const Field& field, const std::string& what) const {
        constexpr double least_distance = 1e-9;
        const SpaceTimeFunction g = function(field);
        // A jump is one nearly everywhere; these are no nodes of a sine, but the ends may be.
        const ArrayXd x = sample_points(0.0, 1.0, 9)({1, 2, 3, 5, 6});
        const auto in_time = [&](const ArrayXd& s) {
            Eigen::ArrayXXd rows(x.size(), s.size());
            for (Index n = 0; n < s.size(); ++n)
                rows.col(n) = g(x, s(n));
            return rows;
        };
        if (const auto jump = find_jump(in_time, times(time_points), least_distance))
            throw InputError(place_, jump_text(what, jump->size, jump->at, x(jump->row)) +
                                         "let the phases meet there");
    }

    const ProblemData& problem_;
    const ExactSolution& exact_;
    Place place_;
    const Beam& beam_;
    double final_time_;
    double theta_scale_ = 0.0;
    double u_scale_ = 0.0;
    double u_x_scale_ = 0.0;
    double sigma_scale_ = 0.0;
};

} // namespace

Admissible require_admissible(const ProblemData& problem, const std::string& name, const Beam& beam,
                              double final_time) {
    require_final_time(final_time);
    return ProblemAdmissibilityCheck(problem, name, beam, final_time).run();
}

} // namespace tvbeam

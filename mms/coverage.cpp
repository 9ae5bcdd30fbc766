#include "mms/coverage.hpp"

#include "mms/admissible/admissibility.hpp"
#include "mms/admissible/sampled_rules.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/piecewise_tape.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using GiNaC::ex;

namespace {

constexpr double tolerance = 1e-12;

/// What the rows of the two tapes are.
enum Inside : Index { theta_t, theta_xx, u_xxt, f, q, sigma, u_xxx, u_xxxt, theta_x, G };
enum AtTip : Index { tip, stress, moment };

/// A formula that vanishes identically is zero, whatever rounding makes of it.
ex simplified(const ex& formula) {
    return is_identically_zero(formula) ? ex(0) : formula;
}

class Coverage {
public:
    Coverage(const Solution& solution, const Beam& beam, double final_time)
        : beam_(beam), derived_(derive_on(solution, beam)) {
        check_admissible(solution, derived_, PlainSolution(solution, derived_, beam, final_time),
                         beam, final_time);
        const SourceText& source = solution.phases.front().u;
        const auto compiled = [&](const auto& formulas) {
            return located(source, "the solution",
                           [&] { return PiecewiseTape(derived_, formulas); });
        };
        const PiecewiseTape inside = compiled([](const DerivedPhase& phase) {
            std::vector<ex> rows = {phase.theta_t,    phase.theta_xx,
                                    phase.u_xxt,      phase.heat_source,
                                    phase.body_force, phase.sigma,
                                    phase.u_xxx,      derivative(phase.u_xxt, model_symbols().x),
                                    phase.theta_x,    phase.couple_load};
            std::transform(rows.begin(), rows.end(), rows.begin(), simplified);
            return rows;
        });
        const PiecewiseTape at_tip = compiled([](const DerivedPhase& phase) {
            const ex u = substituted(phase.u, {{model_symbols().x, 1}});
            return std::vector<ex>{u, simplified(phase.contact_stress),
                                   simplified(phase.end_moment)};
        });
        const ArrayXd x = sample_points(0.0, 1.0);
        for (const double t : sample_points(0.0, final_time)) {
            const ArrayXd sizes = inside.at(x, t).abs().rowwise().maxCoeff();
            inside_ = t == 0.0 ? sizes : ArrayXd(inside_.max(sizes));
        }
        tip_.resize(3, time_points);
        const ArrayXd times = ArrayXd::LinSpaced(time_points, 0.0, final_time);
        for (Index k = 0; k < time_points; ++k)
            tip_.col(k) = at_tip.at(ArrayXd::Zero(1), times(k)).col(0);
    }

    std::vector<TermUse> terms() {
        add("(1)", "theta_t", inside_(theta_t), "theta is steady");
        add("(1)", "theta_xx", inside_(theta_xx), "theta is linear in x");
        add("(1)", "alpha*u_xxt", beam_.alpha * inside_(u_xxt), of("alpha", beam_.alpha, "u_xxt"));
        add("(1)", "a heat source f", inside_(f), "f is zero");
        add("(2)", "a body force q", inside_(q), "sigma does not depend on x");
        add("(3)", "sigma", inside_(sigma), "sigma is zero");
        add("(3)", "u_xxx", inside_(u_xxx), "u is quadratic in x");
        add("(3)", "zeta*u_xxxt", beam_.zeta * inside_(u_xxxt), of("zeta", beam_.zeta, "u_xxxt"));
        add("(3)", "alpha*theta_x", beam_.alpha * inside_(theta_x),
            of("alpha", beam_.alpha, "theta_x"));
        add("(3)", "a load G", inside_(G), "G is zero");
        add_contact();
        add("(9)", "an end moment m", tip_.row(moment).abs().maxCoeff(), "m is zero");
        add("(10)", "an end temperature theta_A", std::abs(beam_.theta_A), "theta_A = 0");
        add_start();
        return std::move(terms_);
    }

private:
    void add(const std::string& equation, const std::string& term, double largest,
             const std::string& why_not) {
        terms_.push_back({equation, term, largest, largest > 0.0 ? "" : why_not});
    }

    static std::string of(const std::string& factor, double value, const std::string& other) {
        return value == 0.0 ? factor + " = 0" : other + " is zero";
    }

    void add_contact() {
        const ArrayXd u = tip_.row(tip);
        const ArrayXd force = tip_.row(stress);
        const double near = tolerance * u.abs().maxCoeff();
        const double small = tolerance * force.abs().maxCoeff();
        const Eigen::Array<bool, Eigen::Dynamic, 1> low = u <= beam_.stops.lower + near;
        const Eigen::Array<bool, Eigen::Dynamic, 1> high = u >= beam_.stops.upper - near;
        const auto largest_where = [&](const auto& chosen, const ArrayXd& values) {
            return chosen.select(values.abs(), 0.0).maxCoeff();
        };
        const bool stops = beam_.stops.exist();
        const std::string none = "the beam has no stops";
        add("(6)(7)", "a free tip between stops",
            stops && !(low || high).all() ? u.abs().maxCoeff() : 0.0,
            stops ? "the tip is on a stop all the time" : none);
        add_stop("g1", low, largest_where(low && force > small, force), beam_.stops.lower);
        add_stop("g2", high, largest_where(high && force < -small, force), beam_.stops.upper);
    }

    void add_stop(const std::string& name, const Eigen::Array<bool, Eigen::Dynamic, 1>& there,
                  double force, double stop) {
        if (!std::isfinite(stop)) {
            add("(8)", "a force at the stop " + name, 0.0, "there is no stop " + name);
            return;
        }
        add("(8)", "a force at the stop " + name, force,
            there.any() ? "the tip touches " + name + " without a force"
                        : "the tip never reaches " + name);
    }

    void add_start() {
        const ArrayXd x = sample_points(0.0, 1.0);
        const PiecewiseTape start(derived_, [](const DerivedPhase& phase) {
            return std::vector<ex>{phase.theta, phase.u};
        });
        const ArrayXd sizes = start.at(x, 0.0).abs().rowwise().maxCoeff();
        add("t = 0", "an initial temperature", sizes(0), "theta0 is zero");
        add("t = 0", "an initial deflection", sizes(1), "u0 is zero");
    }

    Beam beam_;
    DerivedSolution derived_;
    ArrayXd inside_;
    Eigen::ArrayXXd tip_; // one row each of AtTip, one column a time
    std::vector<TermUse> terms_;
};

} // namespace

std::vector<TermUse> coverage(const Solution& solution, const Beam& beam, double final_time) {
    require_final_time(final_time);
    return Coverage(solution, beam, final_time).terms();
}

} // namespace tvbeam

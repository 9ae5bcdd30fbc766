#include "mms/coverage.hpp"

#include "mms/admissible/admissibility.hpp"
#include "mms/contact_history.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/largest_size.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using GiNaC::ex;

namespace {

constexpr double tolerance = 1e-12;

/// How large something becomes in all phases.
struct Size {
    double largest = 0.0;
    bool is_zero = true; ///< by its formulas
};

class Coverage {
public:
    explicit Coverage(const AdmissibleSolution& solution)
        : beam_(solution.beam()), final_time_(solution.final_time()), derived_(solution.derived()) {
        for (const PhaseExpressions& phase : derived_.phases)
            if (phase.begin_value < final_time_)
                times_.push_back({phase.begin_value, std::min(phase.end_value, final_time_)});
    }

    std::vector<TermUse> terms() {
        using Phase = DerivedPhase;
        add("(1)", "theta_t", inside(&Phase::theta_t), "theta is steady");
        add("(1)", "theta_xx", inside(&Phase::theta_xx), "theta is linear in x");
        add_product("(1)", "alpha", beam_.alpha, "u_xxt", inside(&Phase::u_xxt));
        add("(1)", "a heat source f", inside(&Phase::heat_source), "f is zero");
        add("(2)", "a body force q", inside(&Phase::body_force), "sigma does not depend on x");
        add("(3)", "sigma", inside(&Phase::sigma), "sigma is zero");
        add("(3)", "u_xxx", inside(&Phase::u_xxx), "u is quadratic in x");
        // The one that derive leaves out where ζ = 0.
        const Size u_xxxt = size_of(along_beam, [](const DerivedPhase& phase) {
            return derivative(phase.u_xxt, model_symbols().x);
        });
        add_product("(3)", "zeta", beam_.zeta, "u_xxxt", u_xxxt);
        add_product("(3)", "alpha", beam_.alpha, "theta_x", inside(&Phase::theta_x));
        add("(3)", "a load G", inside(&Phase::couple_load), "G is zero");
        add_contact();
        add("(9)", "an end moment m",
            size_of(at_one_end, [](const DerivedPhase& phase) { return phase.end_moment; }),
            "m is zero");
        add("(10)", "an end temperature theta_A", {std::abs(beam_.theta_A)}, "theta_A = 0");
        add("t = 0", "an initial temperature", at_start(&Phase::theta), "theta0 is zero");
        add("t = 0", "an initial deflection", at_start(&Phase::u), "u0 is zero");
        return std::move(terms_);
    }

private:
    static constexpr CloseLook along_beam{0.0, 1.0};
    static constexpr CloseLook at_one_end{0.0, 0.0}; ///< of what does not depend on x

    void add(const std::string& equation, const std::string& term, const Size& size,
             const std::string& why_not) {
        const std::string seen = size.is_zero ? "" : ", as far as was seen";
        terms_.push_back({equation, term, size.largest, size.largest > 0.0 ? "" : why_not + seen});
    }

    void add_product(const std::string& equation, const std::string& factor, double value,
                     const std::string& other, const Size& size) {
        add(equation, factor + "*" + other, {value * size.largest, value == 0.0 || size.is_zero},
            value == 0.0 ? factor + " = 0" : other + " is zero");
    }

    /// A formula that vanishes identically is zero, whatever rounding makes of it.
    static void grow(Size& size, const ex& formula, const CloseLook& x, const CloseLook& t) {
        if (is_identically_zero(formula))
            return;
        size.is_zero = false;
        const Tape tape = compile_tape({formula});
        const auto values = [&tape](const ArrayXd& at_x, const ArrayXd& at_t) -> ArrayXd {
            return tape.evaluate(at_x, at_t).row(0);
        };
        size.largest = std::max(size.largest, largest_size(values, x, t));
    }

    template <typename Formula>
    [[nodiscard]] Size size_of(const CloseLook& x, const Formula& formula) const {
        Size size;
        for (std::size_t i = 0; i < times_.size(); ++i)
            grow(size, formula(derived_.derived[i]), x, times_[i]);
        return size;
    }

    [[nodiscard]] Size inside(ex DerivedPhase::*part) const {
        return size_of(along_beam, [&](const DerivedPhase& phase) { return phase.*part; });
    }

    [[nodiscard]] Size at_start(ex DerivedPhase::*part) const {
        Size size;
        grow(size, substituted(derived_.derived.front().*part, {{model_symbols().t, 0}}),
             along_beam, {0.0, 0.0});
        return size;
    }

    /// Something made of u(1,t) and σ̃(1,t) of one time.
    using OfTip = std::function<double(double tip, double stress)>;

    /// The largest size of such a thing.
    [[nodiscard]] double largest_of_tip(const std::vector<Tape>& tips, const OfTip& of) const {
        double largest = 0.0;
        for (std::size_t i = 0; i < times_.size(); ++i) {
            const auto values = [&](const ArrayXd& x, const ArrayXd& t) -> ArrayXd {
                const ArrayXXd ends = tips[i].evaluate(x, t);
                return ends.row(0).binaryExpr(ends.row(1), of).transpose();
            };
            largest = std::max(largest, largest_size(values, at_one_end, times_[i]));
        }
        return largest;
    }

    void add_contact() {
        std::vector<Tape> tips;
        for (std::size_t i = 0; i < times_.size(); ++i) {
            const DerivedPhase& phase = derived_.derived[i];
            const ex stress = is_identically_zero(phase.contact_stress) ? 0 : phase.contact_stress;
            tips.push_back(compile_tape({substituted(phase.u, {{model_symbols().x, 1}}), stress}));
        }
        const auto largest = [&](const OfTip& of) { return largest_of_tip(tips, of); };
        const double tip_size = largest([](double u, double /*stress*/) { return u; });
        const double near = tolerance * tip_size;
        const double small = tolerance * largest([](double /*u*/, double force) { return force; });
        const double lower = beam_.stops.lower;
        const double upper = beam_.stops.upper;
        const auto is_low = [&](double u) { return u <= lower + near; };
        const auto is_high = [&](double u) { return u >= upper - near; };
        const bool stops = beam_.stops.exist();
        const bool free = stops && largest([&](double u, double /*stress*/) {
                                       return is_low(u) || is_high(u) ? 0.0 : 1.0;
                                   }) > 0.0;
        const ReachedStops reached =
            stops ? reached_stops(derived_, beam_.stops, final_time_) : ReachedStops();
        // A tip that reaches a stop was free next to it, closer than any sample.
        const double free_size = std::max({largest([&](double u, double /*stress*/) {
                                               return is_low(u) || is_high(u) ? 0.0 : u;
                                           }),
                                           reached.lower ? std::abs(lower) : 0.0,
                                           reached.upper ? std::abs(upper) : 0.0});
        add("(6)(7)", "a free tip between stops", {free ? free_size : 0.0},
            !stops ? "the beam has no stops"
            : free ? "u(1,t) is zero"
                   : "the tip is on a stop all the time");
        add_stop("g1", lower, reached.lower, largest([&](double u, double force) {
                     return is_low(u) && force > small ? force : 0.0;
                 }));
        add_stop("g2", upper, reached.upper, largest([&](double u, double force) {
                     return is_high(u) && force < -small ? force : 0.0;
                 }));
    }

    void add_stop(const std::string& name, double stop, bool reached, double force) {
        add("(8)", "a force at the stop " + name, {force},
            !std::isfinite(stop) ? "there is no stop " + name
            : reached            ? "the tip touches " + name + " without a force"
                                 : "the tip never reaches " + name);
    }

    const Beam& beam_;
    double final_time_;
    const DerivedSolution& derived_;
    std::vector<CloseLook> times_; ///< of each phase that begins before the final time
    std::vector<TermUse> terms_;
};

} // namespace

std::vector<TermUse> coverage(const AdmissibleSolution& solution) {
    return located(solution.place(), "the solution", [&] { return Coverage(solution).terms(); });
}

} // namespace tvbeam

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
#include <optional>
#include <utility>
#include <vector>

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
        const auto part = [](ex Phase::*member) -> Formula {
            return [member](const Phase& phase) { return phase.*member; };
        };
        // The one that derive leaves out where ζ = 0.
        const auto u_xxxt = [](const Phase& phase) {
            return derivative(phase.u_xxt, model_symbols().x);
        };
        add_inside({
            {"(1)", "theta_t", part(&Phase::theta_t), "theta is steady"},
            {"(1)", "theta_xx", part(&Phase::theta_xx), "theta is linear in x"},
            {"(1)", "u_xxt", part(&Phase::u_xxt), "u_xxt is zero", "alpha", beam_.alpha},
            {"(1)", "a heat source f", part(&Phase::heat_source), "f is zero"},
            {"(2)", "a body force q", part(&Phase::body_force), "sigma does not depend on x"},
            {"(3)", "sigma", part(&Phase::sigma), "sigma is zero"},
            {"(3)", "u_xxx", part(&Phase::u_xxx), "u is quadratic in x"},
            {"(3)", "u_xxxt", u_xxxt, "u_xxxt is zero", "zeta", beam_.zeta},
            {"(3)", "theta_x", part(&Phase::theta_x), "theta_x is zero", "alpha", beam_.alpha},
            {"(3)", "a load G", part(&Phase::couple_load), "G is zero"},
        });
        add_contact();
        add("(9)", "an end moment m", end_moment(), "m is zero");
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

    /// A formula that vanishes identically is zero, whatever rounding makes of it.
    static std::optional<Tape> tape_unless_zero(const ex& formula) {
        return is_identically_zero(formula) ? std::nullopt : std::optional(compile_tape({formula}));
    }

    static void grow(Size& size, const std::optional<Tape>& tape, const CloseLook& x,
                     const CloseLook& t) {
        if (!tape)
            return;
        size.is_zero = false;
        size.largest = std::max(size.largest, largest_size(values_of(*tape), x, t));
    }

    static PointFunction values_of(const Tape& tape) {
        return [&tape](const ArrayXd& x, const ArrayXd& t) -> ArrayXd {
            return tape.evaluate(x, t).row(0);
        };
    }

    using Formula = std::function<ex(const DerivedPhase&)>;

    /// A term inside the beam, and the parameter that it is multiplied by.
    struct Field {
        std::string equation, name;
        Formula formula;
        std::string why_not;
        std::string factor = {}; ///< empty: none
        double value = 1.0;
    };

    void add_inside(const std::vector<Field>& fields) {
        const std::vector<Size> sizes = sizes_of(fields);
        for (std::size_t k = 0; k < fields.size(); ++k) {
            const Field& field = fields[k];
            const bool is_off = field.value == 0.0;
            add(field.equation, field.factor.empty() ? field.name : field.factor + "*" + field.name,
                {field.value * sizes[k].largest, is_off || sizes[k].is_zero},
                is_off ? field.factor + " = 0" : field.why_not);
        }
    }

    /// Each is looked at where another is largest, too: a layer that is met in one of them is seen
    /// in all.
    [[nodiscard]] std::vector<Size> sizes_of(const std::vector<Field>& fields) const {
        std::vector<Size> sizes(fields.size());
        for (std::size_t i = 0; i < times_.size(); ++i) {
            std::vector<std::optional<Tape>> tapes;
            std::vector<double> x;
            std::vector<double> t;
            for (const Field& field : fields) {
                tapes.push_back(tape_unless_zero(field.formula(derived_.derived[i])));
                const auto found =
                    tapes.back() ? largest_point(values_of(*tapes.back()), along_beam, times_[i])
                                 : LargestPoint();
                if (found.size > 0.0) {
                    x.push_back(found.x);
                    t.push_back(found.t);
                }
            }
            const auto count = static_cast<Eigen::Index>(x.size());
            for (std::size_t k = 0; k < fields.size(); ++k) {
                if (!tapes[k])
                    continue;
                sizes[k].is_zero = false;
                if (count == 0)
                    continue;
                const ArrayXd found = values_of(*tapes[k])(Eigen::Map<ArrayXd>(x.data(), count),
                                                           Eigen::Map<ArrayXd>(t.data(), count));
                sizes[k].largest = std::max(sizes[k].largest,
                                            found.isFinite().select(found.abs(), 0.0).maxCoeff());
            }
        }
        return sizes;
    }

    [[nodiscard]] Size end_moment() const {
        Size size;
        for (std::size_t i = 0; i < times_.size(); ++i)
            grow(size, tape_unless_zero(derived_.derived[i].end_moment), at_one_end, times_[i]);
        return size;
    }

    [[nodiscard]] Size at_start(ex DerivedPhase::*part) const {
        Size size;
        grow(
            size,
            tape_unless_zero(substituted(derived_.derived.front().*part, {{model_symbols().t, 0}})),
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

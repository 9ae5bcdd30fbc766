#include "mms/given_problem.hpp"

#include "core/space/resolution.hpp"
#include "core/space/tail_moment.hpp"
#include "mms/admissible/admissibility.hpp"
#include "mms/admissible/jumps.hpp"
#include "mms/admissible/repair.hpp"
#include "mms/admissible/sampled_rules.hpp"
#include "mms/derivation.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/number_expression.hpp"
#include "mms/expression/printing.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/plain_solution.hpp"
#include "mms/problem_builder.hpp"
#include "mms/sampled_fields.hpp"
#include "mms/separation.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using GiNaC::ex;

namespace {

ArrayXd values(const ex& formula, const ArrayXd& x, double t) {
    return compile_tape({formula}).evaluate(x, ArrayXd::Constant(1, t)).row(0);
}

/// What expressions may name, and what that is in each phase of time.
struct Names {
    SymbolTable symbols = model_symbol_table();
    std::vector<TimePhase> phases{{0.0, std::numeric_limits<double>::infinity()}};
    std::vector<GiNaC::exmap> values; ///< one a phase
    std::map<std::string, BoundedJet<long double>> constants;
    std::vector<std::string> fields; ///< of a solution, which texts are not evaluated with

    explicit Names(const Beam& beam)
        : values{beam_values(beam)}, constants(plain_constants(beam)) {}

    void add(const std::string& name, double value) {
        const ex symbol = symbols[name] = GiNaC::realsymbol(name);
        for (GiNaC::exmap& phase : values)
            phase[symbol] = exact_rational(value);
        constants[name] = BoundedJet<long double>(written(value));
    }
};

/// The parts of a solution that a defect may name.
constexpr std::pair<const char*, ex DerivedPhase::*> named_fields[] = {
    {"theta", &DerivedPhase::theta},
    {"theta_x", &DerivedPhase::theta_x},
    {"theta_t", &DerivedPhase::theta_t},
    {"theta_xx", &DerivedPhase::theta_xx},
    {"u", &DerivedPhase::u},
    {"u_x", &DerivedPhase::u_x},
    {"u_xx", &DerivedPhase::u_xx},
    {"u_xxx", &DerivedPhase::u_xxx},
    {"u_xxt", &DerivedPhase::u_xxt},
    {"u_xxxt", &DerivedPhase::u_xxxt},
    {"sigma", &DerivedPhase::sigma}};

void add_solution(Names& names, const Solution& solution, const Beam& beam) {
    const DerivedSolution derived = derive_on(solution, beam);
    names.phases.clear();
    for (const PhaseExpressions& phase : derived.phases)
        names.phases.push_back({phase.begin_value, phase.end_value});
    names.values.resize(names.phases.size(), names.values.front());
    for (const auto& [name, field] : named_fields) {
        const ex symbol = names.symbols[name] = GiNaC::realsymbol(name);
        for (std::size_t i = 0; i < derived.derived.size(); ++i) {
            const DerivedPhase& phase = derived.derived[i];
            // The one that derive leaves out where ζ = 0.
            names.values[i][symbol] = field == &DerivedPhase::u_xxxt
                                          ? derivative(phase.u_xxt, model_symbols().x)
                                          : phase.*field;
        }
        names.fields.emplace_back(name);
    }
    for (const auto& [name, value] : solution.parameters) {
        if (names.symbols.contains(name))
            throw InputError(value.begin(), "the parameter '" + name +
                                                "' has a name that [defect] has a meaning for; "
                                                "call it something else");
        names.add(name, number_from_expression(value));
    }
}

/// One of the given expressions with the values of all names in it.
struct Given {
    const SourceText* source; ///< null: it is left out
    std::string what;
    std::vector<ex> formulas;   ///< one a phase; zero if it is left out
    PlainExpression plain = {}; ///< as it is written; empty where a field is in it

    explicit operator bool() const { return source != nullptr; }

    /// Something made of every formula.
    template <typename Operation>
    [[nodiscard]] std::vector<ex> each(const Operation& operation) const {
        std::vector<ex> result;
        for (const ex& formula : formulas)
            result.push_back(source == nullptr ? ex(0) : located(*source, what, [&] {
                return operation(formula);
            }));
        return result;
    }
};

Given given(const std::optional<SourceText>& source, const Names& names, const Beam& beam,
            bool at_start, const std::string& what) {
    Given result{source ? &*source : nullptr, what, std::vector<ex>(names.phases.size(), 0)};
    if (!source)
        return result;
    SymbolTable symbols = names.symbols;
    if (at_start)
        symbols.erase("t");
    const ex expression = parse_expression(*source, symbols, &result.plain);
    require_stops_in_use(*source, beam);
    for (std::size_t i = 0; i < result.formulas.size(); ++i)
        result.formulas[i] = located(*source, what, [&] {
            const ex value = substituted(expression, names.values[at_start ? 0 : i]);
            return at_start ? substituted(value, {{model_symbols().t, 0}}) : value;
        });
    for (const auto& field : names.fields)
        if (first_use(*source, field))
            result.plain.clear();
    return result;
}

void require_finite(const Names& names, const std::vector<ex>& formulas, const SourceText& source,
                    double final_time, const std::string& what) {
    for (std::size_t i = 0; i < formulas.size(); ++i) {
        const auto [begin, end] = names.phases[i];
        if (!(begin < final_time))
            break;
        const Tape tape = located(source, what, [&] { return compile_tape({formulas[i]}); });
        const auto values = [&](const ArrayXd& x, double t) -> ArrayXd {
            return tape.evaluate(x, ArrayXd::Constant(1, t)).row(0);
        };
        largest_on_grid(values, sample_points(begin, std::min(end, final_time)), final_time,
                        source.begin(), what, "it exists");
    }
}

void require_clamped(const ex& u, const ex& u_x, const SourceText& source) {
    const ArrayXd points = sample_points(0.0, 1.0);
    const ArrayXd deflection = values(u, points, 0.0);
    const ArrayXd slope = values(u_x, points, 0.0);
    if (std::abs(deflection(0)) > 1e-12 * deflection.abs().maxCoeff())
        throw InputError(source.begin(), "(5): u0(0) is " + number_text(deflection(0)) +
                                             "; it must be 0; a factor x^2 makes it so");
    if (std::abs(slope(0)) > 1e-12 * slope.abs().maxCoeff())
        throw InputError(source.begin(), "(5): the slope of u0 at x = 0 is " +
                                             number_text(slope(0)) +
                                             "; it must be 0; a factor x^2 makes it so");
}

/// Where the slope jumps, the formula of u0'' lacks a delta function.
void require_no_kink(const ex& u, const ex& u_x, const SourceText& source) {
    constexpr double least_jump = 1e-3;
    const Tape tape = located(source, "u0", [&] { return compile_tape({u, u_x}); });
    const auto in_x = [&](const ArrayXd& x) { return tape.evaluate(x, ArrayXd::Zero(1)); };
    const auto exactly = [&](const ArrayXd& x) { return tape.evaluate_wide(x, ArrayXd::Zero(1)); };
    if (const auto jump = find_jump(in_x, exactly, uneven_grid(0.0, 1.0), least_jump))
        throw InputError(source.begin(),
                         std::string(jump->row == 0 ? "u0" : "the slope of u0") + " jumps by " +
                             number_text(jump->size) + " at x = " + number_text(jump->at) +
                             "; it must be continuous: the beam has no hinge there");
}

/// (10) at t = 0: a run takes the values at the ends from (10), whatever theta0 is there.
void require_end_temperatures(const ex& theta, const SourceText& source, const Beam& beam) {
    const GiNaC::realsymbol& x = model_symbols().x;
    const double tolerance =
        relative_tolerance * values(theta, sample_points(0.0, 1.0), 0.0).abs().maxCoeff();
    const auto require = [&](int end, double wanted, const std::string& name, const ex& shape) {
        const ex at_end = located(source, "theta0", [&] { return substituted(theta, {{x, end}}); });
        const double here = values(at_end, ArrayXd::Zero(1), 0.0)(0);
        if (std::abs(here - wanted) <= tolerance)
            return;
        const std::string what = "theta0(" + std::to_string(end) + ")";
        throw InputError(source.begin(),
                         "(10): " + what + " is " + number_text_beside(here, wanted) +
                             "; it must be " + exact_text(wanted) + name + ": " +
                             subtraction((at_end - exact_rational(wanted)) * shape,
                                         "what it is too large by, times " + formula_text(shape),
                                         "theta0"));
    };
    require(0, beam.theta_A, " = theta_A", 1 - x);
    require(1, 0.0, "", x);
}

/// Where stops are rigid g1 ≤ u(1) ≤ g2 (6); penalised ones yield.
void require_between_stops(const ex& u, const SourceText& source, const Beam& beam) {
    const ArrayXd deflection = values(u, sample_points(0.0, 1.0), 0.0);
    const double tolerance = 1e-12 * deflection.abs().maxCoeff();
    const double tip = deflection(deflection.size() - 1);
    const bool rigid = beam.stops.epsilon == 0.0;
    if (rigid && (tip < beam.stops.lower - tolerance || tip > beam.stops.upper + tolerance))
        throw InputError(source.begin(),
                         "(6): u0(1) is " +
                             number_text_beside(tip, tip < beam.stops.lower ? beam.stops.lower
                                                                            : beam.stops.upper) +
                             "; it must be between the stops " + number_text(beam.stops.lower) +
                             " and " + number_text(beam.stops.upper));
}

/// ∫_y^1 (x − y) q dx for q = x^n, by parts twice: the antiderivative's antiderivative is
/// x^{n+2}/((n+1)(n+2)), so it is (y^{n+2} − 1)/((n+1)(n+2)) + (1 − y)/(n+1).
ex moment_of_power(int n) {
    const GiNaC::realsymbol& y = model_symbols().x;
    const GiNaC::numeric first(n + 1);
    return (pow(y, n + 2) - 1) / (first * (n + 2)) + (1 - y) / first;
}

/// The same for a polynomial in x with coefficients in t.
ex moment_of_polynomial(const ex& q) {
    const ex polynomial = expanded(q);
    ex moment = 0;
    for (int n = 0; n <= polynomial.degree(model_symbols().x); ++n)
        moment += polynomial.coeff(model_symbols().x, n) * moment_of_power(n);
    return moment;
}

/// y ↦ ∫_y^1 (x − y) q dx for a profile q.
SpaceFunction moment_of_profile(const SpaceFunction& profile) {
    ProblemData alone;
    alone.profiles = {profile};
    alone.body_force.terms = {{0, 0}};
    return [profile, resolution = resolve(alone, {&alone.body_force}, 0.0)](const ArrayXd& y) {
        return tail_moment(resolution.intervals(), profile, y);
    };
}

/// The same for what does not separate.
SpaceTimeFunction moment_in_time(const ex& q, double final_time) {
    ProblemData alone;
    alone.body_force.rest = [tape = compile_tape({q})](const ArrayXd& x, double t) -> ArrayXd {
        return tape.evaluate(x, ArrayXd::Constant(1, t)).row(0);
    };
    return
        [rest = alone.body_force.rest,
         resolution = resolve(alone, {&alone.body_force}, final_time)](const ArrayXd& y, double t) {
            return tail_moment(
                resolution.intervals(), [&](const ArrayXd& x) { return rest(x, t); }, y);
        };
}

/// The moment of the body force: closed where q is polynomial in x, integrated where not.
Field moment_of(const std::vector<ex>& q, double final_time, ProblemBuilder& builder) {
    const GiNaC::realsymbol& x = model_symbols().x;
    std::vector<ex> closed(q.size(), 0);
    std::vector<SpaceTimeFunction> rests(q.size());
    std::vector<Field::Term> integrated;
    for (std::size_t i = 0; i < q.size(); ++i) {
        const Separation parts = separated(q[i]);
        ex rest = parts.rest;
        for (const SeparatedProduct& product : parts.products) {
            if (product.profile.is_polynomial(x) && product.profile.degree(x) <= 16) {
                closed[i] += product.amplitude * moment_of_polynomial(product.profile);
                continue;
            }
            const ScaledProfile scaled = scaled_profile(product.profile);
            if (scaled.function) {
                std::vector<ex> amplitude(q.size(), 0);
                amplitude[i] = product.amplitude * scaled.size;
                integrated.push_back(builder.term(amplitude, moment_of_profile(scaled.function)));
            } else {
                rest += product.amplitude * product.profile;
            }
        }
        if (!rest.is_zero())
            rests[i] = moment_in_time(rest, final_time);
    }
    Field result = builder.field(closed);
    result.terms.insert(result.terms.end(), integrated.begin(), integrated.end());
    result.rest = builder.in_phases(std::move(rests));
    return result;
}

/// Holds computed values against what the data's texts say at sampled points.
class GivenTexts {
public:
    GivenTexts(const Names& names, double final_time)
        : constants_(names.constants), points_(points_to_compare(0.0, final_time, true)) {}

    [[nodiscard]] const Points& points() const { return points_; }

    /// Throws InputError where the values are not those of ∂_x^order of the expression.
    void require(const Given& data, int order, const std::string& what,
                 const ComputedValues& computed) const {
        if (data.plain.empty())
            return;
        auto names = constants_;
        std::vector<Bounded<long double>> text;
        for (Index k = 0; k < points_.x.size(); ++k) {
            names["x"] = BoundedJet<long double>::x(points_.x(k), order);
            names["t"] = BoundedJet<long double>::t(points_.t(k), 0);
            text.push_back(evaluated(data.plain, names).derivative(order, 0));
        }
        if (const auto k = first_disagreement(text, computed))
            throw InputError(data.source->begin(),
                             disagreement_text(what, points_.x(*k), points_.t(*k),
                                               computed.values(*k),
                                               text[static_cast<std::size_t>(*k)].value));
    }

    /// Of formulas, which are the same in every phase where there is a text to evaluate.
    void require(const Given& data, int order, const std::string& what,
                 const std::vector<ex>& formulas) const {
        if (data.plain.empty())
            return;
        const ArrayXd computed =
            compile_tape({formulas.front()}).evaluate(points_.x, points_.t).row(0);
        require(data, order, what, ComputedValues::of(computed));
    }

private:
    std::map<std::string, BoundedJet<long double>> constants_;
    Points points_;
};

/// defect: what is given is added to another problem.
ProblemData problem_with(const GivenData& data, const Names& names, const Beam& beam,
                         double final_time, bool defect) {
    const Given theta = given(data.theta0, names, beam, true, "theta0");
    const Given u = given(data.u0, names, beam, true, "u0");
    const Given heat_source = given(data.heat_source, names, beam, false, "heat_source");
    const Given body_force = given(data.body_force, names, beam, false, "body_force");
    const Given moment_load = given(data.moment_load, names, beam, false, "moment_load");
    const GivenTexts texts(names, final_time);
    for (const Given* one : {&theta, &u, &heat_source, &body_force, &moment_load})
        if (*one)
            require_finite(names, one->formulas, *one->source, final_time, one->what);

    const GiNaC::realsymbol& x = model_symbols().x;
    const auto slope = [&](const ex& formula) { return derivative(formula, x); };
    const auto curvature = u.each([&](const ex& formula) { return slope(slope(formula)); });
    if (theta && !defect)
        require_end_temperatures(theta.formulas.front(), *data.theta0, beam);
    if (u) {
        const auto u_x = u.each(slope);
        require_finite(names, u_x, *data.u0, final_time, "u0'");
        require_finite(names, curvature, *data.u0, final_time, "u0''");
        texts.require(u, 0, "u0", u.formulas);
        texts.require(u, 1, "u0'", u_x);
        require_clamped(u.formulas.front(), u_x.front(), *data.u0);
        require_no_kink(u.formulas.front(), u_x.front(), *data.u0);
        if (!defect)
            require_between_stops(u.formulas.front(), *data.u0, beam);
    }
    const auto shear = moment_load.each([&](const ex& formula) { return -slope(formula); });
    if (moment_load)
        require_finite(names, shear, *data.moment_load, final_time, "the slope of moment_load");

    ProblemBuilder builder(names.phases, final_time);
    ProblemData problem;
    problem.theta_initial = builder.field(theta.formulas);
    problem.curvature_initial = builder.field(curvature);
    problem.heat_source = builder.field(heat_source.formulas);
    problem.body_force = builder.field(body_force.formulas);
    const Field moment = builder.field(moment_load.formulas);
    problem.moment_load = sum(moment_of(body_force.formulas, final_time, builder), moment);
    problem.couple_load = builder.field(shear);
    problem.end_moment = builder.amplitude(moment_load.each([&](const ex& formula) {
        return -substituted(formula, {{x, 1}});
    }));
    builder.finish(problem);
    const SampledFields sampled(problem, texts.points().x, texts.points().t);
    texts.require(theta, 0, "theta0", sampled.of(problem.theta_initial));
    texts.require(u, 2, "u0''", sampled.of(problem.curvature_initial));
    texts.require(heat_source, 0, "heat_source", sampled.of(problem.heat_source));
    texts.require(body_force, 0, "body_force", sampled.of(problem.body_force));
    texts.require(moment_load, 0, "moment_load", sampled.of(moment));
    return problem;
}

} // namespace

std::vector<std::pair<std::string, std::string>> named_parts(const GivenData& data) {
    std::vector<std::pair<std::string, std::string>> parts;
    for (const auto& [name, source] : {std::pair("theta0", &data.theta0),
                                       {"u0", &data.u0},
                                       {"heat_source", &data.heat_source},
                                       {"moment_load", &data.moment_load},
                                       {"body_force", &data.body_force}})
        if (*source)
            parts.emplace_back(name, (*source)->text());
    return parts;
}

ProblemData given_problem(const GivenData& data, const Beam& beam, double final_time) {
    require_final_time(final_time);
    return problem_with(data, Names(beam), beam, final_time, false);
}

ProblemData given_defect(const GivenData& defect, const Solution* solution, const Beam& beam,
                         double final_time, double h, double dt) {
    require_final_time(final_time);
    Names names(beam);
    names.add("h", h);
    names.add("dt", dt);
    if (solution != nullptr && !solution->phases.empty())
        add_solution(names, *solution, beam);
    return problem_with(defect, names, beam, final_time, true);
}

} // namespace tvbeam

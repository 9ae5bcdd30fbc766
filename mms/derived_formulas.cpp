#include "mms/derived_formulas.hpp"

#include "mms/derivation.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/printing.hpp"
#include "mms/expression/shortened.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::is_a;

namespace {

/// A sum with the terms put together that have the same factors in x and t:
/// e^t sin πx + π² e^t sin πx becomes (1 + π²) e^t sin πx.
ex collected(const ex& expression) {
    if (!is_a<GiNaC::add>(expression))
        return expression;
    std::map<ex, ex, GiNaC::ex_is_less> coefficients;
    for (const ex& term : expression) {
        ex coefficient = 1;
        ex variable = 1;
        const GiNaC::exvector factors = is_a<GiNaC::mul>(term)
                                            ? GiNaC::exvector(term.begin(), term.end())
                                            : GiNaC::exvector{term};
        for (const ex& factor : factors) {
            const bool varies =
                depends_on(factor, model_symbols().x) || depends_on(factor, model_symbols().t);
            (varies ? variable : coefficient) *= factor;
        }
        coefficients[variable] += coefficient;
    }
    ex result = 0;
    for (const auto& [variable, coefficient] : coefficients)
        result += coefficient * variable;
    return result;
}

/// The times of a phase, as text and in LaTeX.
struct WrittenTimes {
    std::string text;
    std::string latex;
};

WrittenTimes times_of(const PhaseExpressions& phase, bool first, bool last) {
    const auto written = [&](const auto& formula, const std::string& at_most) -> std::string {
        const std::string end = last ? std::string() : formula(phase.end);
        if (first)
            return last ? "" : "0 " + at_most + " t " + at_most + " " + end;
        const std::string begin = formula(phase.begin);
        return last ? "t > " + begin : begin + " < t " + at_most + " " + end;
    };
    if (first && last)
        return {"t >= 0", "t \\ge 0"};
    return {written(formula_text, "<="), written(formula_latex, "\\le")};
}

ex at_start(const ex& expression, const SourceText& source) {
    try {
        return substituted(expression, {{model_symbols().t, 0}});
    } catch (const AlgebraError& error) {
        throw InputError(source.begin(), std::string("at t = 0: ") + error.what());
    }
}

/// A formula's text as a solution file would be read that holds it, with the beam's numbers.
ex read_again(const std::string& text, const Solution& solution, const Beam& beam) {
    const SourceText zero("0", {solution.name, 1, 1});
    Solution one = solution;
    one.phases = {
        {.until = {}, .theta = SourceText(text, {solution.name, 1, 1}), .u = zero, .sigma = zero}};
    return expressions_on(one, beam).phases.front().theta;
}

/// What a run makes of the formula of that symbol.
ex computed(const std::string& symbol, const DerivedPhase& phase) {
    static const std::map<std::string, ex DerivedPhase::*> parts = {
        {"f", &DerivedPhase::heat_source}, {"G", &DerivedPhase::couple_load},
        {"q", &DerivedPhase::body_force},  {"m", &DerivedPhase::end_moment},
        {"theta0", &DerivedPhase::theta},  {"u0", &DerivedPhase::u}};
    return phase.*parts.at(symbol);
}

/// A body force that is not printed is said to be zero: what a run has of one then shows.
std::vector<DerivedFormula> with_body_force(std::vector<DerivedFormula> formulas) {
    if (std::ranges::find(formulas, "q", &DerivedFormula::symbol) == formulas.end())
        for (std::size_t i = formulas.size(); i-- > 0;)
            if (const DerivedFormula& heat = formulas[i]; heat.symbol == "f")
                formulas.insert(formulas.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                {"q", heat.interval, heat.interval_latex, "0", "0"});
    return formulas;
}

} // namespace

std::vector<DerivedFormula> derived_formulas(const Solution& solution, bool penalised_stops) {
    SolutionExpressions expressions = expressions_of(solution);
    const GiNaC::realsymbol sigma("sigma");
    std::vector<DerivedFormula> formulas;
    const auto add = [&formulas](const std::string& symbol, const WrittenTimes& times,
                                 const ex& formula) {
        const ex readable = shortened(collected(formula));
        formulas.push_back(
            {symbol, times.text, times.latex, formula_text(readable), formula_latex(readable)});
    };
    const ModelSymbols& s = model_symbols();
    const bool driven =
        std::any_of(expressions.phases.begin(), expressions.phases.end(),
                    [&s](const PhaseExpressions& phase) { return depends_on(phase.sigma, s.x); });
    for (std::size_t i = 0; i < expressions.phases.size(); ++i) {
        PhaseExpressions& phase = expressions.phases[i];
        const bool by_law = penalised_stops && !solution.phases[i].sigma;
        if (by_law)
            phase.sigma = sigma;
        const WrittenTimes times = times_of(phase, i == 0, i + 1 == expressions.phases.size());
        const DerivedPhase derived = derive(phase, solution.phases[i], s.alpha, s.zeta);
        add("f", times, derived.heat_source);
        add("G", times, derived.couple_load);
        if (driven)
            add("q", times, derived.body_force);
        add("m", times, derived.end_moment);
        if (by_law)
            formulas.push_back({"sigma", times.text, times.latex,
                                "-(max(u(1,t) - g2, 0) - max(g1 - u(1,t), 0))/epsilon",
                                "-\\frac{(u(1,t) - g_2)^+ - (g_1 - u(1,t))^+}{\\varepsilon}"});
    }
    const WrittenTimes at_zero{"t = 0", "t = 0"};
    add("theta0", at_zero,
        at_start(expressions.phases.front().theta, solution.phases.front().theta));
    add("u0", at_zero, at_start(expressions.phases.front().u, solution.phases.front().u));
    return formulas;
}

double distance_of_formulas(const Solution& solution, const Beam& beam, double final_time) {
    struct Sizes {
        double distance = 0.0;
        double greatest = 0.0;
    };
    const bool penalised = beam.stops.epsilon > 0.0;
    const DerivedSolution derived = derive_on(solution, beam);
    std::size_t next = 0; // the phase that the next f is of
    std::map<std::string, Sizes> sizes;
    for (const auto& formula : with_body_force(derived_formulas(solution, penalised))) {
        const bool at_start = formula.interval == "t = 0";
        next += formula.symbol == "f" ? 1 : 0;
        const std::size_t i = at_start ? 0 : next - 1;
        const bool by_law = penalised && !solution.phases[i].sigma;
        const double begin = derived.phases[i].begin_value;
        if (begin >= final_time || formula.symbol == "sigma" || (formula.symbol == "G" && by_law))
            continue;
        const double end = at_start ? 0.0 : std::min(derived.phases[i].end_value, final_time);
        const bool of_heat = formula.symbol == "f" || formula.symbol == "theta0";
        const Tape tape =
            located(of_heat ? solution.phases[i].theta : solution.phases[i].u,
                    formula.symbol + " as it is printed", [&] {
                        return compile_tape({read_again(formula.text, solution, beam),
                                             computed(formula.symbol, derived.derived[i])});
                    });
        Sizes& size = sizes[formula.symbol];
        for (const double t : sample_points(begin, end)) {
            const Eigen::ArrayXXd both =
                tape.evaluate(sample_points(0.0, 1.0), Eigen::ArrayXd::Constant(1, t));
            for (Eigen::Index k = 0; k < both.cols(); ++k) {
                // Neither may have a value, as 1/sqrt(t) at t = 0.
                const bool is_finite = std::isfinite(both(1, k));
                if (std::isfinite(both(0, k)) != is_finite)
                    return std::numeric_limits<double>::infinity();
                if (!is_finite)
                    continue;
                size.distance = std::max(size.distance, std::abs(both(0, k) - both(1, k)));
                size.greatest = std::max(size.greatest, std::abs(both(1, k)));
            }
        }
    }
    double greatest = 0.0;
    for (const auto& [symbol, size] : sizes)
        greatest = std::max(greatest, size.greatest);
    // Of terms that cancel, rounding is left.
    constexpr double nothing = 1e-12;
    double result = 0.0;
    for (const auto& [symbol, size] : sizes)
        if (size.distance > 0.0)
            result = std::max(result, size.distance / std::max(size.greatest, nothing * greatest));
    return result;
}

} // namespace tvbeam

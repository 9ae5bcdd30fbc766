#include "mms/derived_formulas.hpp"

#include "mms/derivation.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/printing.hpp"
#include "mms/expression/shortened.hpp"
#include "mms/expression/symbols.hpp"

#include <algorithm>
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

} // namespace tvbeam

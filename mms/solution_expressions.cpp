#include "mms/solution_expressions.hpp"

#include "mms/expression/agreement.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/numeric_value.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/text/error_text.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace tvbeam {

using GiNaC::ex;

namespace {

/// The value of a constant expression, or InputError.
double constant_value(const ex& expression, const SourceText& source, const std::string& what,
                      const PlainExpression& plain, const std::map<std::string, double>& names) {
    const double value = located(source, what, [&] { return numeric_value(expression); });
    require_agreement(source, what, plain, names, value);
    return value;
}

void require_later(double end, const PhaseExpressions& phase, const SourceText& until) {
    if (!(end > phase.begin_value))
        throw InputError(until.begin(),
                         "until is " + exact_text(end) + "; it must be greater than " +
                             (phase.begin_value > 0.0 ? "the end of the phase before, " : "") +
                             exact_text(phase.begin_value));
}

ex on_beam(const ex& expression, const GiNaC::exmap& values, const SourceText& source,
           const std::string& what) {
    try {
        return substituted(expression, values);
    } catch (const AlgebraError& error) {
        throw InputError(source.begin(),
                         what + " cannot be computed with this beam's numbers: " + error.what());
    }
}

/// σ̃(1,t) = −((u − g2)⁺ − (g1 − u)⁺)/ε, with y⁺ = y·step(y).
ex penalised_stress(const ex& u, const Stops& stops) {
    const ex tip = substituted(u, {{model_symbols().x, 1}});
    ex stress = 0;
    const auto add = [&](const ex& excess, int sign) {
        stress += sign * excess * GiNaC::step(excess) / exact_rational(stops.epsilon);
    };
    if (std::isfinite(stops.upper))
        add(tip - exact_rational(stops.upper), -1);
    if (std::isfinite(stops.lower))
        add(exact_rational(stops.lower) - tip, 1);
    return stress;
}

} // namespace

SolutionExpressions expressions_of(const Solution& solution) {
    SolutionExpressions result;
    SymbolTable in_formulas = model_symbol_table();
    SymbolTable in_times;
    std::map<std::string, double> parameters;
    for (const SolutionParameter& parameter : solution.parameters) {
        PlainExpression& plain = result.plain_parameters[parameter.name];
        const ex value = parse_expression(parameter.value, {}, &plain);
        parameters[parameter.name] =
            constant_value(value, parameter.value, "parameter " + parameter.name, plain, {});
        const GiNaC::realsymbol symbol(parameter.name);
        result.parameters[symbol] = value;
        in_formulas[parameter.name] = symbol;
        in_times[parameter.name] = symbol;
    }

    double begin_value = 0.0;
    ex begin = 0;
    for (const SolutionPhase& source : solution.phases) {
        PhaseExpressions phase;
        phase.begin = begin;
        phase.begin_value = begin_value;
        phase.end_value = std::numeric_limits<double>::infinity();
        if (source.until) {
            PlainExpression plain;
            const ex end = parse_expression(*source.until, in_times, &plain);
            phase.end = on_beam(end, result.parameters, *source.until, "until");
            phase.end_value = constant_value(phase.end, *source.until, "until", plain, parameters);
            require_later(phase.end_value, phase, *source.until);
        }
        phase.theta = parse_expression(source.theta, in_formulas, &phase.plain_theta);
        phase.u = parse_expression(source.u, in_formulas, &phase.plain_u);
        if (source.sigma)
            phase.sigma = parse_expression(*source.sigma, in_formulas, &phase.plain_sigma);
        begin = phase.end;
        begin_value = phase.end_value;
        result.phases.push_back(phase);
    }
    return result;
}

SolutionExpressions expressions_on(const Solution& solution, const Beam& beam) {
    SolutionExpressions result = expressions_of(solution);
    GiNaC::exmap values = beam_values(beam);
    values.insert(result.parameters.begin(), result.parameters.end());
    for (std::size_t i = 0; i < result.phases.size(); ++i) {
        const SolutionPhase& source = solution.phases[i];
        PhaseExpressions& phase = result.phases[i];
        require_stops_in_use(source.theta, beam);
        require_stops_in_use(source.u, beam);
        phase.theta = on_beam(phase.theta, values, source.theta, "theta");
        phase.u = on_beam(phase.u, values, source.u, "u");
        if (source.sigma) {
            require_stops_in_use(*source.sigma, beam);
            phase.sigma = on_beam(phase.sigma, values, *source.sigma, "sigma");
        } else if (beam.stops.epsilon > 0.0) {
            phase.sigma = located(source.u, "u at x = 1",
                                  [&] { return penalised_stress(phase.u, beam.stops); });
        }
    }
    return result;
}

} // namespace tvbeam

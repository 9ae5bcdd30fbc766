#include "mms/expression/number_expression.hpp"

#include "mms/expression/agreement.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/numeric_value.hpp"

#include <cmath>

namespace tvbeam {

double number_from_expression(const SourceText& expression,
                              const std::map<std::string, double>& values) {
    SymbolTable symbols;
    GiNaC::exmap exact;
    for (const auto& [name, value] : values) {
        if (!std::isfinite(value))
            throw InputError(expression.begin(), name + " is not finite");
        const GiNaC::realsymbol symbol(name);
        symbols[name] = symbol;
        exact[symbol] = exact_rational(value);
    }
    PlainExpression plain;
    const GiNaC::ex parsed = parse_expression(expression, symbols, &plain);
    double value = 0.0;
    try {
        value = numeric_value(substituted(parsed, exact));
    } catch (const AlgebraError& error) {
        throw InputError(expression.begin(), error.what());
    }
    require_agreement(expression, expression.text(), plain, values, value);
    return value;
}

} // namespace tvbeam

#include "mms/expression/printing.hpp"
#include "mms/derived_formulas.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/canonical.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/shortened.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/solution_expressions.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace data = boost::unit_test::data;
using Eigen::ArrayXd;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_printing)

namespace {

GiNaC::ex parsed(const std::string& text) {
    return parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table());
}

struct Printed {
    std::string formula;
    std::string text;
    std::string latex;
};

std::ostream& operator<<(std::ostream& stream, const Printed& printed) {
    return stream << printed.formula;
}

const std::vector<Printed> printed = {
    {"0", "0", "0"},
    {"-3/4", "-3/4", "-\\frac{3}{4}"},
    {"1-x", "1 - x", "1 - x"},
    {"-x-1", "-x - 1", "-x - 1"},
    {"x^2*t", "t*x^2", "t x^{2}"},
    {"-x^2", "-x^2", "-x^{2}"},
    {"(-x)^2", "x^2", "x^{2}"},
    {"2^-t", "2^(-t)", "2^{-t}"},
    {"(x^2)^t", "(x^2)^t", "\\left(x^{2}\\right)^{t}"},
    {"x^(2^t)", "x^(2^t)", "x^{2^{t}}"},
    {"3*2^t", "3*2^t", "3 \\cdot 2^{t}"},
    {"x^(1/3)", "x^(1/3)", "x^{1/3}"},
    {"x^(3/2)", "x^(3/2)", "x^{3/2}"},
    {"1/x", "1/x", "\\frac{1}{x}"},
    {"-1/x^2", "-1/x^2", "-\\frac{1}{x^{2}}"},
    {"1/(2*x)", "1/(2*x)", "\\frac{1}{2 x}"},
    {"x/(1+x)/t", "x/(t*(x + 1))", "\\frac{x}{t \\left(x + 1\\right)}"},
    {"(1+x)/2", "x/2 + 1/2", "\\frac{x}{2} + \\frac{1}{2}"},
    {"t*(1+x)/2", "t*(x + 1)/2", "\\frac{t \\left(x + 1\\right)}{2}"},
    {"1/sqrt(x)", "1/sqrt(x)", "\\frac{1}{\\sqrt{x}}"},
    {"sqrt(2)*t", "sqrt(2)*t", "\\sqrt{2} t"},
    {"exp(t)*sin(pi*x)", "exp(t)*sin(pi*x)", "e^{t} \\sin\\left(\\pi x\\right)"},
    {"asin(x)^2+log(t)", "asin(x)^2 + log(t)",
     "\\left(\\arcsin\\left(x\\right)\\right)^{2} + \\ln\\left(t\\right)"},
    {"exp(x)^t", "exp(x)^t", "\\left(e^{x}\\right)^{t}"},
    {"alpha*theta_A*g1", "alpha*g1*theta_A", "\\alpha g_{1} \\theta_A"},
};

std::vector<std::string> shipped() {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(TVBEAM_SOLUTIONS_DIR))
        paths.push_back(entry.path().string());
    return paths;
}

} // namespace

BOOST_DATA_TEST_CASE(formulas_read_well, data::make(printed)) {
    BOOST_TEST(formula_text(parsed(sample.formula)) == sample.text);
    BOOST_TEST(formula_latex(parsed(sample.formula)) == sample.latex);
}

BOOST_DATA_TEST_CASE(printed_text_reads_back, data::make(printed)) {
    const GiNaC::ex expression = parsed(sample.formula);
    BOOST_TEST((parsed(formula_text(expression)) - expression).expand().is_zero());
}

// The derived formulas of every shipped solution, read back, have the same values: both sides are
// sums of a few dozen terms of moderate size in different order.
BOOST_DATA_TEST_CASE(derived_formulas_read_back, data::make(shipped())) {
    const Solution solution = read_solution(sample);
    SymbolTable symbols = model_symbol_table();
    GiNaC::exmap values = beam_values({0.017, 0.1, 0.5, {-0.02, 0.1}});
    for (const SolutionParameter& parameter : solution.parameters) {
        const GiNaC::realsymbol symbol(parameter.name);
        symbols[parameter.name] = symbol;
        values[symbol] = parse_expression(parameter.value, {});
    }
    const std::vector<DerivedFormula> formulas = derived_formulas(solution);
    const bool driven =
        std::any_of(formulas.begin(), formulas.end(),
                    [](const DerivedFormula& formula) { return formula.symbol == "q"; });
    BOOST_TEST(formulas.size() == (driven ? 4 : 3) * solution.phases.size() + 2);
    for (const DerivedFormula& formula : formulas) {
        const GiNaC::ex once =
            parse_expression(SourceText(formula.text, {"derived", 1, 1}), symbols);
        const std::string again = formula_text(once);
        const GiNaC::ex twice = parse_expression(SourceText(again, {"again", 1, 1}), symbols);
        BOOST_TEST(formula_text(twice) == again);
        const Tape tape = compile_tape({substituted(once, values), substituted(twice, values)});
        const ArrayXd x = ArrayXd::LinSpaced(17, 0.0, 1.0);
        const Eigen::ArrayXXd both = tape.evaluate(x, ArrayXd::LinSpaced(17, 0.1, 1.9));
        const double scale = std::max(1.0, both.abs().maxCoeff());
        BOOST_TEST((both.row(0) - both.row(1)).abs().maxCoeff() <= 1e-13 * scale);
    }
}

// What derive prints is what a run is driven by, to rounding of sums of a few dozen terms.
BOOST_DATA_TEST_CASE(derived_formulas_are_what_runs, data::make(shipped())) {
    const Solution solution = read_solution(sample);
    const Beam beam{0.4, 0.15, 0.5, {-0.02, 0.1}};
    Beam yielding = beam;
    yielding.stops.epsilon = 0.1;
    BOOST_TEST(distance_of_formulas(solution, beam, 2.0) <= 1e-14);
    BOOST_TEST(distance_of_formulas(solution, yielding, 2.0) <= 1e-14);
}

// Neither has a value at t = 0, where f is like 1/sqrt(t).
BOOST_AUTO_TEST_CASE(formulas_agree_where_neither_has_a_value) {
    const Solution solution = parse_solution("theta = 'sqrt(t)*sin(pi*x)'\nu = 0\n", "my.toml");
    BOOST_TEST(distance_of_formulas(solution, {0.4, 0.15, 0.0, {}}, 1.0) <= 1e-14);
}

BOOST_AUTO_TEST_CASE(what_terms_have_in_common_is_taken_out_where_that_is_shorter) {
    for (const auto& [given, expected] : std::vector<std::pair<std::string, std::string>>{
             {"2*t*x + t*(x - 3)", "3*t*(x - 1)"},
             {"2*alpha*(2*t*x + t*(x - 3))/5", "6*alpha*t*(x - 1)/5"},
             {"exp(t)*x^2 + 2*exp(t)*x*(x - 3)", "3*exp(t)*x*(x - 2)"},
             {"sin(t)*x + cos(t) + sin(t)*(x - 1)", "cos(t) + sin(t)*(2*x - 1)"},
             {"pi*cos(x) + pi*sin(x)", "pi*(cos(x) + sin(x))"},
             {"(x + 1)^9*t - t", "t*(x + 1)^9 - t"},
             {"(x - 1)^2", "(x - 1)^2"},
             {"x + 1", "x + 1"}})
        BOOST_TEST(formula_text(shortened(parsed(given))) == expected);
}

// Of every shipped solution, α u_xxt + θ_x: both are sums of a few dozen terms of
// moderate size, in different order.
BOOST_DATA_TEST_CASE(a_shortened_formula_is_the_same_function_and_no_longer,
                     data::make(shipped())) {
    const SolutionExpressions solution = expressions_of(read_solution(sample));
    const GiNaC::exmap values = beam_values({0.017, 0.1, 0.5, {-0.02, 0.1}});
    const ModelSymbols& s = model_symbols();
    for (const PhaseExpressions& phase : solution.phases) {
        const GiNaC::ex curvature = derivative(derivative(phase.u, s.x), s.x);
        const GiNaC::ex formula =
            s.alpha * derivative(curvature, s.t) + derivative(phase.theta, s.x);
        const GiNaC::ex brief = shortened(formula);
        BOOST_TEST(formula_text(brief).size() <= formula_text(formula).size());
        const auto at = [&](const GiNaC::ex& one) {
            return substituted(substituted(one, solution.parameters), values);
        };
        const Tape tape = compile_tape({at(formula), at(brief)});
        const Eigen::ArrayXXd both =
            tape.evaluate(ArrayXd::LinSpaced(17, 0.0, 1.0), ArrayXd::LinSpaced(17, 0.1, 1.9));
        const double scale = std::max(1.0, both.abs().maxCoeff());
        BOOST_TEST((both.row(0) - both.row(1)).abs().maxCoeff() <= 1e-12 * scale);
    }
}

// sigma_x = q where the stress depends on x, and what (3) then leaves of G is nothing.
BOOST_AUTO_TEST_CASE(a_stress_that_depends_on_x_has_a_body_force) {
    const std::vector<DerivedFormula> formulas = derived_formulas(
        parse_solution("theta = 0\nu = 'x^4*t'\nsigma = '-24*x*(t + zeta)'\n", "my.toml"));
    BOOST_REQUIRE(formulas.size() == 6U);
    BOOST_TEST(formulas[1].symbol == "G");
    BOOST_TEST(formulas[1].text == "0");
    BOOST_TEST(formulas[2].symbol == "q");
    BOOST_TEST(formulas[2].text == "-24*t - 24*zeta");
}

BOOST_AUTO_TEST_CASE(the_papers_formulas_are_as_in_its_text) {
    const std::vector<DerivedFormula> formulas =
        derived_formulas(read_solution(TVBEAM_SOLUTIONS_DIR "/copetti-fernandez-2011.toml"));
    BOOST_REQUIRE(formulas.size() == 8U);
    BOOST_TEST(formulas[0].symbol == "f");
    BOOST_TEST(formulas[0].interval == "0 <= t <= sqrt(2)");
    BOOST_TEST(formulas[0].text ==
               "(pi^2 + 1)*exp(t)*sin(pi*x) - 3*alpha*g2*(t - sqrt(2))*(x - 1)");
    BOOST_TEST(formulas[3].interval == "t > sqrt(2)");
    BOOST_TEST(formulas[4].symbol == "G");
    BOOST_TEST(formulas[4].text == "pi*alpha*exp(t)*cos(pi*x) - t - 3*g2");
    BOOST_TEST(formulas[5].text == "0");
    BOOST_TEST(formulas[6].symbol == "theta0");
    BOOST_TEST(formulas[6].text == "sin(pi*x)");
    BOOST_TEST(formulas[7].text == "0");
}

// GiNaC writes either sign, as its addresses fall; the symbols here are new in every round.
BOOST_AUTO_TEST_CASE(the_order_does_not_depend_on_addresses) {
    std::string first;
    for (int round = 0; round < 20; ++round) {
        const GiNaC::realsymbol a("a");
        const GiNaC::realsymbol b("b");
        const GiNaC::realsymbol c("c");
        const std::vector<GiNaC::realsymbol> unused(static_cast<std::size_t>(round));
        const GiNaC::ex expression = a * pow(b - c, 3) * (1 - a) / (c - a) + sin(a * (c - b)) - b;
        const std::string text = formula_text(expression);
        if (round == 0)
            first = text;
        BOOST_TEST(text == first);
        BOOST_TEST(formula_text(pow(b - a, 2) + c) == "(a - b)^2 + c");
        BOOST_TEST(formula_text(pow(b - a, 3) + c) == "c - (a - b)^3");
    }
}

BOOST_AUTO_TEST_SUITE_END()

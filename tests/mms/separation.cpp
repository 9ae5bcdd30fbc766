#include "mms/separation.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/printing.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <ostream>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace data = boost::unit_test::data;
using Eigen::ArrayXd;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_separation)

namespace {

GiNaC::ex parsed(const std::string& text) {
    return parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table());
}

struct Case {
    std::string text;
    std::size_t products;
    bool rest;
};

std::ostream& operator<<(std::ostream& stream, const Case& c) {
    return stream << c.text;
}

const std::vector<Case> cases = {
    {"0", 0, false},
    {"x - x", 0, false},
    {"(x+t)^2 - x^2 - 2*x*t - t^2", 0, false},
    {"7", 1, false},
    {"t", 1, false},
    {"x - 1", 1, false},
    {"x + t", 2, false},
    {"x + t + 3", 2, false},
    {"(x-1)^10", 1, false},
    {"exp(t)*sin(pi*x)", 1, false},
    {"exp(t)*sin(pi*x) + pi^2*exp(t)*sin(pi*x)", 1, false},
    {"t*(1-x) + 3*sin(t)*(x-1)", 1, false},
    {"t*(x + t)", 2, false},
    {"sin(x)*(x + t)", 2, false},
    {"(x + t)^3", 4, false},
    {"(x + t)*(x - t)", 2, false},
    {"exp(2*x - 3*t)", 1, false},
    {"exp(-(x + t))*x", 1, false},
    {"2^(x + t)", 1, false},
    {"sin(pi*x - t)", 2, false},
    {"cos(pi*(x - t))", 2, false},
    {"sinh(x + t)*t", 2, false},
    {"cosh(x + t)", 2, false},
    {"sin(x*t)", 0, true},
    {"x + sin(x*t)", 1, true},
    {"t*sin(x*t) + exp(x^2*t)", 0, true},
    {"t*x*(1 + sin(x*t))", 0, true},
    {"1/(x + t)", 0, true},
    {"sqrt(x + t)", 0, true},
    {"(x + t)^8", 9, false},
    {"(x + t)^9", 0, true},
    {"(sin(x)+t)*(cos(x)+t^2)*(x+exp(t))*(x^5+cos(t))*(x^7+sin(t))", 32, false},
    {"(sin(x)+t)*(cos(x)+t^2)*(x+exp(t))*(x^5+cos(t))*(x^7+sin(t))*(tan(x)+t)", 0, true},
};

/// Σ τ φ + rest
GiNaC::ex put_together(const Separation& parts) {
    GiNaC::ex sum = parts.rest;
    for (const SeparatedProduct& product : parts.products)
        sum += product.amplitude * product.profile;
    return sum;
}

std::set<std::string> profiles(const std::string& text) {
    std::set<std::string> names;
    for (const SeparatedProduct& product : separated(parsed(text)).products)
        names.insert(formula_text(product.profile));
    return names;
}

} // namespace

BOOST_DATA_TEST_CASE(products_and_rest_add_up_to_the_function, data::make(cases)) {
    const GiNaC::ex expression = parsed(sample.text);
    const Separation parts = separated(expression);
    BOOST_TEST(parts.products.size() == sample.products);
    BOOST_TEST(!parts.rest.is_zero() == sample.rest);
    for (const SeparatedProduct& product : parts.products) {
        BOOST_TEST(!depends_on(product.amplitude, model_symbols().x));
        BOOST_TEST(!depends_on(product.profile, model_symbols().t));
    }
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0.1, 1.0);
    const Tape tape = compile_tape({expression, put_together(parts)});
    const ArrayXd x = ArrayXd::NullaryExpr(50, [&](Eigen::Index) { return uniform(random); });
    const ArrayXd t = ArrayXd::NullaryExpr(50, [&](Eigen::Index) { return uniform(random); });
    const Eigen::ArrayXXd values = tape.evaluate(x, t);
    // Distributing (x+t)^8 adds terms of one sign; differences cancel a digit or two.
    const double scale = std::max(1.0, values.row(0).abs().maxCoeff());
    BOOST_TEST((values.row(0) - values.row(1)).abs().maxCoeff() <= 1e-13 * scale);
}

BOOST_AUTO_TEST_CASE(multiples_of_a_profile_are_one_profile) {
    const std::set<std::string> affine = {"x - 1"};
    BOOST_TEST((profiles("t*(x - 1)") == affine));
    BOOST_TEST((profiles("t*(1 - x)") == affine));
    BOOST_TEST((profiles("3*t*(1 - x)/7") == affine));
    BOOST_TEST((profiles("exp(t)*(pi*x - pi)") == affine));
    BOOST_TEST((profiles("t*(1 - x) + 3*exp(t)*(x - 1) - 2*(x - 1)") == affine));
    BOOST_TEST((profiles("-2*t*sin(pi*x)") == std::set<std::string>{"sin(pi*x)"}));
    BOOST_TEST((profiles("t*(1-x)^3*sin(x)") == profiles("-5*exp(t)*(2*x-2)^3*sin(x)")));
}

BOOST_AUTO_TEST_CASE(the_profiles_of_the_papers_source_are_its_sine_and_the_affine_one) {
    const std::string f = "(1 + pi^2)*exp(t)*sin(pi*x) - 3*(17/1000)*(1/10)*(sqrt(2) - t)*(1 - x)";
    BOOST_TEST((profiles(f) == std::set<std::string>{"sin(pi*x)", "x - 1"}));
}

BOOST_AUTO_TEST_CASE(what_needs_no_distributing_stays_as_it_is_written) {
    BOOST_TEST((profiles("exp(t)*(x-1)^10") == std::set<std::string>{"(x - 1)^10"}));
    const Separation parts = separated(parsed("(t - 1)^10*x"));
    BOOST_REQUIRE(parts.products.size() == 1U);
    BOOST_TEST(formula_text(parts.products[0].amplitude) == "(t - 1)^10");
}

BOOST_AUTO_TEST_SUITE_END()

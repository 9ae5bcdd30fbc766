#include "mms/expression/agreement.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/given_problem.hpp"
#include "mms/plain_solution.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

using Eigen::ArrayXd;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_agreement)

namespace {

const std::string document = "theta = \"sin(pi*x)*exp(-t)\"\nu = \"x^2*cos(t)/10\"\n";

PlainExpression plain(const std::string& text) {
    PlainExpression result;
    parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table(), &result);
    return result;
}

} // namespace

// sin(π x) e^-t with its value right to round-off, then 1e-10 off at one point.
BOOST_AUTO_TEST_CASE(a_wrong_value_is_named_with_expression_and_point) {
    const Solution solution = parse_solution(document, "my.toml");
    const Beam beam{.alpha = 0.1};
    const DerivedSolution derived = derive_on(solution, beam);
    const PlainSolution text(solution, derived, beam, 2.0);
    ArrayXd values = (std::numbers::pi * text.x(0)).sin() * (-text.t(0)).exp();
    BOOST_CHECK_NO_THROW(text.require(0, Computed::theta, "theta", ComputedValues::of(values)));
    const Eigen::Index inside = 2;
    values(inside) *= 1 + 1e-10;
    BOOST_CHECK_EXCEPTION(text.require(0, Computed::theta, "theta", ComputedValues::of(values)),
                          InputError, [](const InputError& error) {
                              const std::string what = error.what();
                              return what.find("my.toml:1:10: theta at x = 0.0") == 0 &&
                                     what.find(", t = 2 is ") != std::string::npos &&
                                     what.find("as it is written") != std::string::npos;
                          });
}

// (x + 1e8)^2 - x^2 - 2e8 x - 1e16 is 0, and so many digits of its terms are that doubles make 1 of
// it: what cancels is no error.
BOOST_AUTO_TEST_CASE(honest_cancellation_is_no_disagreement) {
    const double x = 1.0 / 3;
    const auto jet =
        evaluated<long double>(plain("(x + 1e8)^2 - x^2 - 2e8*x - 1e16"),
                               {{"x", BoundedJet<long double>::x(static_cast<long double>(x), 0)}});
    const double computed = 1.0;
    BOOST_TEST(
        !first_disagreement({jet.at(0, 0)}, ComputedValues::of(ArrayXd::Constant(1, computed))));
    BOOST_TEST(
        first_disagreement({jet.at(0, 0)}, ComputedValues::of(ArrayXd::Constant(1, 1e16 * 1e-10)))
            .has_value());
}

// asin has no finite derivative at 1: what an error of its argument makes of it, and of what
// follows from it, is not known.
BOOST_AUTO_TEST_CASE(what_is_behind_an_infinite_slope_has_no_finite_bound) {
    for (const std::string text : {"asin(x/x)", "sin(16*asin(x/x))", "exp(sin(asin(x/x)))"})
        BOOST_TEST(!std::isfinite(evaluated<long double>(
                                      plain(text), {{"x", BoundedJet<long double>::x(0.5L, 0)}})
                                      .derivative(0, 0)
                                      .bound),
                   text);
}

BOOST_AUTO_TEST_CASE(what_is_not_a_number_disagrees) {
    for (const double computed : {std::nan(""), std::numeric_limits<double>::infinity()})
        BOOST_TEST(
            first_disagreement({written(0.5)}, ComputedValues::of(ArrayXd::Constant(1, computed)))
                .has_value());
}

// What is written is -(x^2), 2^(3^2), 1 - 2 - 3.
BOOST_AUTO_TEST_CASE(the_text_is_evaluated_in_the_order_of_the_grammar) {
    const auto value = [](const std::string& text) {
        return static_cast<double>(
            evaluated<long double>(plain(text), {{"x", BoundedJet<long double>::x(3.0L, 0)}})
                .at(0, 0)
                .value);
    };
    BOOST_TEST(value("-x^2") == -9.0);
    BOOST_TEST(value("2^x^2") == 512.0);
    BOOST_TEST(value("1 - 2 - x") == -4.0);
    BOOST_TEST(value("12/x/2*5") == 10.0);
    BOOST_TEST(value("2e-1*x + .5") == static_cast<double>(0.2L * 3 + 0.5L));
}

BOOST_AUTO_TEST_CASE(data_are_held_against_their_text) {
    GivenData data;
    data.heat_source = SourceText("log(1 + exp(20000*(x - t)))", {"my.toml", 3, 1});
    BOOST_CHECK_THROW(given_problem(data, {}, 2.0), InputError);
}

BOOST_AUTO_TEST_SUITE_END()

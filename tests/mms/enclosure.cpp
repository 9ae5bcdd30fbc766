// Bounds of a tape's values and slopes over an interval of time hold every value and slope in it.

#include "mms/admissible/greatest_value.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/text/input_error.hpp"
#include "tests/mms/random_grammar.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace data = boost::unit_test::data;
using namespace tvbeam;
using Eigen::ArrayXd;

BOOST_AUTO_TEST_SUITE(mms_enclosure)

namespace {

/// A function of t, with its derivative as a second row.
Tape with_derivative(const std::string& text) {
    const GiNaC::ex formula =
        parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table());
    return compile_tape({formula, derivative(formula, model_symbols().t)});
}

GreatestValue greatest(const std::string& text, double begin, double end, double limit) {
    const Tape tape = with_derivative(text);
    return greatest_value([&](double a, double b) { return tape.enclose(0, 1.0, a, b); }, begin,
                          end, limit, 1e-12, 20000);
}

bool holds(const Range& range, double value, double slack) {
    return std::isnan(value) ? std::isinf(range.lower) || std::isinf(range.upper)
                             : range.lower - slack <= value && value <= range.upper + slack;
}

} // namespace

BOOST_AUTO_TEST_CASE(values_and_slopes_of_random_expressions_are_within_the_bounds) {
    const int count = short_tests ? 100 : 2000;
    Grammar grammar(3);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> uniform(0.0, 2.0);
    int bounded = 0;
    for (int n = 0; n < count; ++n) {
        const std::string text = grammar.expression();
        try {
            const Tape tape = with_derivative(text);
            const double begin = uniform(random);
            const double end = begin + std::pow(10.0, -4.0 * uniform(random));
            const ArrayXd times = ArrayXd::LinSpaced(33, begin, end);
            const Eigen::ArrayXXd values = tape.evaluate(ArrayXd::Constant(1, 0.75), times);
            const Enclosure bounds = tape.enclose(0, 0.75, begin, end);
            bounded += std::isfinite(bounds.value.upper) ? 1 : 0;
            for (Eigen::Index k = 0; k < times.size(); ++k) {
                // What the tapes round: of a value by itself, of a slope as a formula of its own.
                const double slope = values(1, k);
                BOOST_TEST(holds(bounds.value, values(0, k), 0.0), text << " at " << times(k));
                if (std::isfinite(values(0, k)) && std::isfinite(slope))
                    BOOST_TEST(holds(bounds.slope, slope, 1e-9 * (1e-200 + std::abs(slope))),
                               text << ", its slope at " << times(k));
            }
        } catch (const InputError&) {
        } catch (const AlgebraError&) {
        }
    }
    BOOST_TEST(bounded > count / 3);
}

// Of functions that fall and rise by sections: at every such place.
BOOST_AUTO_TEST_CASE(bounds_are_near_the_values_where_the_interval_is_short) {
    for (const std::string& text : std::vector<std::string>{
             "sin(t)", "cos(3*t)", "tan(t/2)", "asin(t/4)", "acos(t/4)", "atan(t)", "sinh(t)",
             "cosh(t - 1)", "tanh(t)", "exp(t)", "log(t)", "sqrt(t)", "t^(1/3)", "t^t", "2^t",
             "1/t", "t^5/(1 + t^2)", "t*log(t)"}) {
        const Tape tape = with_derivative(text);
        for (const double t : {0.25, 1.0, 1.5, 2.0}) {
            const Enclosure bounds = tape.enclose(0, 1.0, t, t + 1e-6);
            const Eigen::ArrayXXd value = tape.evaluate(ArrayXd::Zero(1), ArrayXd::Constant(1, t));
            BOOST_TEST(bounds.value.upper - bounds.value.lower < 1e-4, text << " at " << t);
            BOOST_TEST(std::abs(bounds.slope.upper - value(1, 0)) < 1e-3, text << " at " << t);
        }
    }
}

namespace {

struct Peak {
    std::string text;
    double value;
    double t;
};

std::ostream& operator<<(std::ostream& stream, const Peak& peak) {
    return stream << peak.text;
}

const std::vector<Peak> peaks = {
    {"exp(-1e6*(t - 0.3333)^2)", 1.0, 0.3333},
    {"exp(-1e18*(t - 0.3333)^2)", 1.0, 0.3333},
    {"1/(1 + 1e18*(t - 0.3333)^2)", 1.0, 0.3333},
    {"sin(pi*t) + exp(-1e12*(t - 1/7)^2)/2 + exp(-1e12*(t - 6/7)^2)", 1.4338837391175581,
     6.0 / 7.0},
    {"t*(1 - t)", 0.25, 0.5},
    {"t", 1.0, 1.0},
    {"1 - t", 1.0, 0.0},
    {"0.25 - sqrt((t - 0.3)^2)", 0.25, 0.3},
    {"sin(500*t)*t", 0.995887, 0.995888},
};

} // namespace

BOOST_DATA_TEST_CASE(a_peak_of_any_width_is_found, data::make(peaks)) {
    const GreatestValue found = greatest(sample.text, 0.0, 1.0, 0.1);
    BOOST_TEST(found.value == sample.value, boost::test_tools::tolerance(1e-5));
    BOOST_TEST(std::abs(found.t - sample.t) < 1e-5);
    // Nothing is above it, and to know that takes no more parts than there may be.
    const GreatestValue none = greatest(sample.text, 0.0, 1.0, found.value + 1e-9);
    BOOST_TEST(none.value == found.value + 1e-9);
    BOOST_TEST(none.proven);
}

// A limit that is reached, and kept: at the end with no slope, inside with none, all the time.
BOOST_AUTO_TEST_CASE(a_limit_that_is_touched_is_proven_to_be_kept) {
    for (const std::string& text :
         std::vector<std::string>{"2*t - t^2", "1 - (1 - t)^6", "1 - (t - 1/3)^2", "1",
                                  "sin(pi*t)^2", "exp(-(t - 0.7)^2)"})
        BOOST_TEST(greatest(text, 0.0, 1.0, 1.0 + 1e-12).proven, text);
}

BOOST_AUTO_TEST_CASE(what_is_not_proven_is_said_not_to_be) {
    // 1 by an identity that arithmetic on intervals does not know.
    BOOST_TEST(!greatest("sin(t)^2 + cos(t)^2", 0.0, 1.0, 1.0 + 1e-12).proven);
    // A pole: its neighbourhood is never bounded.
    BOOST_TEST(greatest("1e-30/(t - 1/3)", 0.0, 1.0, 1.0).proven == false);
    for (const std::string& factor : std::vector<std::string>{"1e-12", "1e-6", "-1e-6", "1e-3"}) {
        const auto found = greatest("0.05 + " + factor + "*tan(3*t)", 0.0, 1.0, 0.1);
        BOOST_TEST((!found.proven || found.value > 0.1), factor);
    }
}

BOOST_AUTO_TEST_SUITE_END()

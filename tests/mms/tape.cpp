#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/magnitude.hpp"
#include "mms/expression/numeric_value.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace data = boost::unit_test::data;
using Eigen::ArrayXd;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_tape)

namespace {

GiNaC::ex parsed(const std::string& text) {
    return parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table());
}

ArrayXd random_array(Eigen::Index size, double low, double high, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(low, high);
    return ArrayXd::NullaryExpr(size, [&](Eigen::Index) { return uniform(random); });
}

/// The value by GiNaC in 30 digits.
double evaluated(const GiNaC::ex& expression, double x, double t) {
    const long digits = GiNaC::Digits;
    GiNaC::Digits = 30;
    const GiNaC::ex value = expression
                                .subs({{model_symbols().x, GiNaC::ex(exact_rational(x)).evalf()},
                                       {model_symbols().t, GiNaC::ex(exact_rational(t)).evalf()}})
                                .evalf();
    const double result = GiNaC::ex_to<GiNaC::numeric>(value).to_double();
    GiNaC::Digits = digits;
    return result;
}

const std::vector<std::string> formulas = {
    "x",
    "t",
    "7/3",
    "pi^2*sqrt(2)",
    "exp(t)*sin(pi*x)",
    "-3*(x^3/6 - x^2/2)*(sqrt(2)*t - t^2/2)/10",
    "(x-1)^10",
    "(1-x)^2 + 2*(t-x)^4",
    "(1-x)^3 - (x-t)^3 + (x-1)^2",
    "x^7 + x^-3 + 1/x",
    "x^(x^2) - (x^x)^2", // two powers, whatever stands in them
    "(x^t)^x*x^(t^x) + (2^x)^x - 2^(x^2)",
    "1/(1+x)^3/(2+t)^2",
    "t/(1+x)",
    "-x-t-1",
    "-x*t",
    "(1+x*t)^(3/2) + sqrt(x) + 1/sqrt(t)",
    "(1+x)^t + 2^x + t^(1/3)",
    "tan(x) + asin(x/2) + acos(x/2) + atan(t)",
    "sinh(x) + cosh(t) + tanh(x*t) + log(1+x) + cos(t)",
    "tanh(5*(x-1/4-t/4)) + sin(pi*x*(1+t*(1-x)))",
    "exp(-pi^2*t)*cos(pi*x)^2*(1 - cos(pi*x))",
    "sinh(x)^2/cosh(x) + sinh(t)/cosh(t)^3",
    "sinh(x)/cosh(t)",
};

} // namespace

// Against GiNaC's own evaluation in 30 digits. The conditioning of these formulas is below 30 or
// so; a tape with a wrong operation is off by far more than 1e-13.
BOOST_DATA_TEST_CASE(values_are_those_of_the_expression, data::make(formulas)) {
    const GiNaC::ex expression = parsed(sample);
    const Tape tape = compile_tape({expression});
    const ArrayXd x = random_array(20, 0.05, 1.0, 1);
    const ArrayXd t = random_array(20, 0.05, 2.0, 2);
    const Eigen::ArrayXXd values = tape.evaluate(x, t);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double expected = evaluated(expression, x(i), t(i));
        BOOST_TEST(std::abs(values(0, i) - expected) <= 1e-13 * std::max(1.0, std::abs(expected)));
    }
}

BOOST_AUTO_TEST_CASE(many_expressions_together_are_each_by_itself) {
    std::vector<GiNaC::ex> expressions;
    expressions.reserve(formulas.size());
    for (const std::string& formula : formulas)
        expressions.push_back(parsed(formula));
    const Tape together = compile_tape(expressions);
    const ArrayXd x = random_array(300, 0.05, 1.0, 3);
    const ArrayXd t = random_array(300, 0.05, 2.0, 4);
    const Eigen::ArrayXXd values = together.evaluate(x, t);
    BOOST_REQUIRE(values.rows() == static_cast<Eigen::Index>(expressions.size()));
    for (Eigen::Index k = 0; k < values.rows(); ++k) {
        const Tape alone = compile_tape({expressions[static_cast<std::size_t>(k)]});
        BOOST_TEST((values.row(k) == alone.evaluate(x, t).row(0)).all());
    }
}

// Of a tape of all formulas, with parts that depend on t alone, and one that is a constant.
BOOST_AUTO_TEST_CASE(chosen_expressions_keep_their_values_and_what_they_need) {
    std::vector<GiNaC::ex> expressions;
    for (const std::string& formula : formulas)
        expressions.push_back(parsed(formula));
    expressions.push_back(parsed("exp(t)"));
    expressions.push_back(parsed("3"));
    expressions.push_back(parsed("cos(x)"));
    const Tape all = compile_tape(expressions);
    const ArrayXd x = random_array(300, 0.05, 1.0, 3);
    const ArrayXd t = random_array(300, 0.05, 2.0, 4);
    for (Eigen::Index k = 0; k < all.output_count(); ++k) {
        const Eigen::Index other = (k + 5) % all.output_count();
        const Tape two = all.only({k, other});
        const std::size_t needed = compile_tape({expressions[static_cast<std::size_t>(k)],
                                                 expressions[static_cast<std::size_t>(other)]})
                                       .instruction_count();
        BOOST_TEST(two.instruction_count() == needed);
        for (const ArrayXd& times : {t, ArrayXd(t.head(1))}) {
            const Eigen::ArrayXXd values = two.evaluate(x, times);
            const Eigen::ArrayXXd expected = all.evaluate(x, times);
            BOOST_REQUIRE(values.rows() == 2);
            BOOST_TEST((values.row(0) == expected.row(k)).all());
            BOOST_TEST((values.row(1) == expected.row(other)).all());
        }
    }
}

// More points than a block, in part blocks too; one time for many points, one point for many times.
BOOST_AUTO_TEST_CASE(a_value_does_not_depend_on_its_place_in_the_array) {
    std::vector<GiNaC::ex> expressions;
    expressions.reserve(formulas.size());
    for (const std::string& formula : formulas)
        expressions.push_back(parsed(formula));
    const Tape tape = compile_tape(expressions);
    const ArrayXd x = random_array(1000, 0.05, 1.0, 5);
    const ArrayXd one = ArrayXd::Constant(1, 0.7);
    const Eigen::ArrayXXd over_x = tape.evaluate(x, one);
    const Eigen::ArrayXXd over_t = tape.evaluate(one, x);
    const Eigen::ArrayXXd over_both = tape.evaluate(x, ArrayXd::Constant(1000, 0.7));
    BOOST_TEST((over_x == over_both).all());
    for (const Eigen::Index i : {0, 1, 127, 128, 129, 511, 999}) {
        const ArrayXd point = x.segment(i, 1);
        BOOST_TEST((over_x.col(i) == tape.evaluate(point, one).col(0)).all());
        BOOST_TEST((over_t.col(i) == tape.evaluate(one, point).col(0)).all());
    }
}

/// Whether the values of one tape are, at these points, those that it has at them in reverse order,
/// which is no grid that starts with a place.
void require_values_of_points(const Tape& tape, const ArrayXd& x, const ArrayXd& t) {
    const ArrayXd extra = ArrayXd::LinSpaced(x.size(), 0.3, 0.4);
    ArrayXd mixed_x(2 * x.size());
    ArrayXd mixed_t(2 * x.size());
    mixed_x << x.reverse(), extra;
    mixed_t << t.reverse(), extra.reverse();
    const Eigen::ArrayXXd expected = tape.evaluate(mixed_x, mixed_t).leftCols(x.size());
    BOOST_TEST((tape.evaluate(x, t) == expected.rowwise().reverse()).all());
}

// Fewer points than a block and more, blocks that hold several times and parts of one; and what is
// no grid but for one place, or one time.
BOOST_AUTO_TEST_CASE(points_of_a_grid_have_the_values_that_they_have_alone) {
    std::vector<GiNaC::ex> expressions;
    expressions.reserve(formulas.size() + 1);
    for (const std::string& formula : formulas)
        expressions.push_back(parsed(formula));
    expressions.push_back(parsed("sin(x) + cos(2*x)"));
    for (const Tape& tape : {compile_tape(expressions), compile_tape({parsed("x*sin(x*t)")}),
                             compile_tape({parsed("x^2")}), compile_tape({parsed("t^2")})})
        for (const Eigen::Index places : {1, 2, 9, 127, 128, 129, 300})
            for (const Eigen::Index times : {1, 2, 9, 150}) {
                const ArrayXd x = random_array(places, 0.05, 1.0, 5).replicate(times, 1);
                const ArrayXd t =
                    random_array(times, 0.05, 2.0, 6).transpose().replicate(places, 1).reshaped();
                require_values_of_points(tape, x, t);
                for (const Eigen::Index moved : {Eigen::Index{0}, x.size() / 2, x.size() - 1}) {
                    ArrayXd other = x;
                    other(moved) = 0.5;
                    require_values_of_points(tape, other, t);
                    other = t;
                    other(moved) = 0.5;
                    require_values_of_points(tape, x, other);
                }
            }
}

// Without any operation of t alone, too.
BOOST_AUTO_TEST_CASE(a_chosen_expression_of_both_has_its_values_at_one_time) {
    const Tape all = compile_tape({parsed("sin(x*t)"), parsed("x*t^2*cos(x*t)")});
    const ArrayXd x = random_array(300, 0.05, 1.0, 7);
    const ArrayXd t = ArrayXd::Constant(1, 0.7);
    for (const Eigen::Index k : {0, 1})
        BOOST_TEST((all.only({k}).evaluate(x, t).row(0) == all.evaluate(x, t).row(k)).all());
}

BOOST_AUTO_TEST_CASE(no_points_give_no_values) {
    const Tape tape = compile_tape({parsed("x*t"), parsed("1")});
    BOOST_TEST(tape.evaluate(ArrayXd(0), ArrayXd::Zero(1)).cols() == 0);
    BOOST_TEST(tape.evaluate(ArrayXd::Zero(1), ArrayXd(0)).rows() == 2);
    BOOST_CHECK_THROW(tape.evaluate(ArrayXd::Zero(2), ArrayXd::Zero(3)), std::invalid_argument);
}

// pi x, its sine, exp t, their product; then one addition.
BOOST_AUTO_TEST_CASE(common_subexpressions_are_computed_once) {
    const Tape tape = compile_tape(
        {parsed("exp(t)*sin(pi*x)"), parsed("1 + exp(t)*sin(pi*x)"), parsed("exp(t)")});
    BOOST_TEST(tape.instruction_count() == 5U);
    BOOST_TEST(compile_tape({parsed("exp(t)"), parsed("exp(t)")}).instruction_count() == 1U);
}

// x + sin(x + sin(x + …)) needs x, one intermediate value, and no more however long it is.
BOOST_AUTO_TEST_CASE(registers_are_used_again) {
    std::string text = "x";
    for (int i = 0; i < 40; ++i)
        text.insert(0, "x + sin(").append(")");
    const Tape tape = compile_tape({parsed(text)});
    BOOST_TEST(tape.instruction_count() >= 80U);
    BOOST_TEST(tape.register_count() <= 4);
}

// 2^10 = ((2^2)^2·2)^2: four products. A power function would be off in the last digit for some of
// these.
BOOST_AUTO_TEST_CASE(integer_powers_are_products) {
    const Tape tape = compile_tape({parsed("x^10")});
    BOOST_TEST(tape.instruction_count() == 4U);
    const ArrayXd x = random_array(100, 0.5, 1.5, 6);
    const ArrayXd squared = x * x;
    const ArrayXd fifth = squared * squared * x;
    BOOST_TEST((tape.evaluate(x, ArrayXd::Zero(1)).row(0).transpose() == fifth * fifth).all());
}

BOOST_AUTO_TEST_CASE(rationals_round_to_the_nearest_double) {
    std::mt19937_64 random(7);
    for (int i = 0; i < 2000; ++i) {
        // Any double of ordinary size, written out and read back.
        const double value = std::ldexp(1.0 + std::uniform_real_distribution<>(0, 1)(random),
                                        int(random() % 600) - 300);
        BOOST_TEST(nearest_double(exact_rational(value)) == value);
    }
    BOOST_TEST(nearest_double(GiNaC::numeric(1, 3)) == 1.0 / 3.0);
    BOOST_TEST((exact_rational(0.017).is_equal(GiNaC::numeric(17, 1000))));
    BOOST_TEST((exact_rational(-2.5e-7).is_equal(GiNaC::numeric(-1, 4000000))));
    BOOST_TEST((exact_rational(0.0).is_zero()));
    BOOST_TEST((exact_rational(1e22).is_equal(GiNaC::numeric("10000000000000000000000"))));
}

BOOST_AUTO_TEST_CASE(constants_beyond_the_range_are_refused_and_tiny_ones_vanish) {
    BOOST_CHECK_THROW(compile_tape({parsed("1e400*x")}), AlgebraError);
    BOOST_CHECK_THROW(compile_tape({parsed("x*exp(1000)")}), AlgebraError);
    BOOST_CHECK_THROW(compile_tape({parsed("x + exp(exp(1000.0))")}), AlgebraError);
    BOOST_CHECK_THROW(compile_tape({parsed("alpha*x")}), AlgebraError);
    BOOST_TEST(numeric_value(parsed("1e-400")) == 0.0);
    BOOST_TEST(numeric_value(parsed("exp(-1000)")) == 0.0);
}

// GiNaC takes the common denominator out of the power: 100^-154, and (99*x + t)^154 beside it. The
// exact values are those of the text, by powers of the base in long double; each has n roundings.
BOOST_AUTO_TEST_CASE(powers_of_sums_with_decimals_are_what_they_say) {
    const double x = 0.7;
    const double t = 1.7;
    const auto value = [&](const std::string& text) {
        return compile_tape({parsed(text)})
            .evaluate(ArrayXd::Constant(1, x), ArrayXd::Constant(1, t))(0, 0);
    };
    const auto check = [&](const std::string& text, long double base, int exponent) {
        const long double expected = std::pow(base, exponent);
        const long double tolerance = 4e-16L * std::abs(exponent) * std::abs(expected);
        BOOST_TEST(std::abs(value(text) - expected) <= tolerance,
                   text << " is " << value(text) << " for " << expected);
    };
    check("(0.99*x + 0.01*t)^154", 0.99L * x + 0.01L * t, 154);
    check("(1 - 0.001*x)^103", 1 - 0.001L * x, 103);
    check("(1 - 0.01*x*t)^160", 1 - 0.01L * x * t, 160);
    check("(1 - 0.001*x)^(-300)", 1 - 0.001L * x, -300);
    check("(0.001*x)^200*1000^200", x, 200);
    check("1/(1 + (0.001*x + 0.5)^200)^3", 1 + std::pow(0.001L * x + 0.5L, 200), -3);
    check("(1 - 0.001*x)^200*(0.002*t + 0.99)^200", (1 - 0.001L * x) * (0.002L * t + 0.99L), 200);
    check("exp(-1000)*10^434*x/x", std::exp(-1000.0L) * 1e434L, 1);
}

// |g|^p has p - k for the power of its k-th derivative, times p(p-1)..., and the sign of g for odd
// k; by GiNaC's rules alone those are 0/0 at g = 0. A sign is 0 there, the mean of both sides.
BOOST_AUTO_TEST_CASE(derivatives_of_powers_of_a_square_have_their_values_at_its_zero) {
    const GiNaC::symbol& x = model_symbols().x;
    for (const std::string g : {"(x - 0.5)", "((1 - 2*x)/2)", "(0.25*(4*x - 2))"})
        for (const auto& [formula, p, is_odd] : std::vector<std::tuple<std::string, double, bool>>{
                 {"*sqrt(" + g + "^2)", 2.0, true},
                 {"^2*sqrt(" + g + "^2)", 3.0, false},
                 {"^0*(" + g + "^2)^1.75", 3.5, false},
                 {"^3/(" + g + "^4)^(1/4)", 2.0, true}}) {
            double factor = 1.0;
            GiNaC::ex derived = parsed(g + formula);
            for (int k = 0; k <= std::floor(p); ++k) {
                const Eigen::ArrayXXd values =
                    compile_tape({derived}).evaluate(ArrayXd{{0.3, 0.5, 0.9}}, ArrayXd::Zero(1));
                const double slope = g[1] == '(' ? -1.0 : 1.0;
                const auto expected = [&](double at) {
                    const double sign = at > 0.0 ? 1.0 : at < 0.0 ? -1.0 : 0.0;
                    const bool has_sign = (k % 2 == 1) != is_odd;
                    return (is_odd ? slope : 1.0) * factor * (has_sign ? sign : 1.0) *
                           std::pow(std::abs(at), p - k);
                };
                BOOST_TEST_CONTEXT(g + formula << ", derivative " << k) {
                    BOOST_TEST(std::abs(values(0, 0) - expected(-0.2)) < 1e-13);
                    BOOST_TEST(values(0, 1) == expected(0.0));
                    BOOST_TEST(std::abs(values(0, 2) - expected(0.4)) < 1e-13);
                }
                factor *= p - k;
                derived = derivative(derived, x);
            }
        }
}

BOOST_AUTO_TEST_CASE(a_derivative_of_a_square_times_its_root_has_no_quotient) {
    const GiNaC::symbol& x = model_symbols().x;
    for (const std::string g : {"(x - 0.3)", "(1 - 2*x + t)"})
        BOOST_TEST((derivative(parsed(g + "*sqrt(" + g + "^2)"), x) -
                    2 * derivative(parsed(g), x) * parsed("sqrt(" + g + "^2)"))
                       .is_zero());
}

// In a step at that time a sign's mean would be its rate, which no scheme's order holds for; of
// |g|^(1/2) the slope is infinite.
BOOST_AUTO_TEST_CASE(a_sign_of_the_time_and_an_infinite_derivative_have_no_value_at_the_zero) {
    for (const std::string text : {"(t - 0.5)/sqrt((t - 0.5)^2)", "(x - 0.5)/((x - 0.5)^2)^0.75"}) {
        const Tape tape = compile_tape({parsed(text)});
        BOOST_TEST(!std::isfinite(tape.evaluate(ArrayXd{{0.5}}, ArrayXd{{0.5}})(0, 0)), text);
    }
}

// Of the law of penalised stops. GiNaC folds step(0) to 1/2 where it can.
BOOST_AUTO_TEST_CASE(a_step_is_one_half_where_it_jumps) {
    const Tape tape = compile_tape({GiNaC::step(model_symbols().t)});
    const ArrayXd t{{-1.0, 0.0, 1.0}};
    const Eigen::ArrayXXd values = tape.evaluate(ArrayXd::Zero(1), t);
    BOOST_TEST(values(0, 0) == 0.0);
    BOOST_TEST(values(0, 1) == 0.5);
    BOOST_TEST(values(0, 2) == 1.0);
}

// 4^600 is beyond the range of a double, though no number in the text is large.
BOOST_AUTO_TEST_CASE(powers_of_sums_of_ones_have_room) {
    const Tape tape = compile_tape({parsed("(1 + x + t + x*t)^600/(1 + x + t + x^2)^599")});
    const ArrayXd one = ArrayXd::Ones(1);
    BOOST_TEST(tape.evaluate(one, one)(0, 0) == 4.0, boost::test_tools::tolerance(1e-12));
}

// x^(a-1) x log x and e^z/(1 + e^z)^2 are 0 times infinity, or infinity over infinity, as they
// stand; their limits are 0.
BOOST_AUTO_TEST_CASE(limits_of_derivatives_are_reached) {
    const ModelSymbols& s = model_symbols();
    const ArrayXd zero = ArrayXd::Zero(1);
    const ArrayXd later = ArrayXd::Constant(1, 0.5);
    GiNaC::ex power = parsed("x^(4 + t)");
    for (const GiNaC::symbol& symbol : {s.x, s.x, s.t, s.x}) {
        power = derivative(power, symbol);
        BOOST_TEST(compile_tape({power}).evaluate(zero, later)(0, 0) == 0.0);
    }
    for (const std::string text : {"1/(1 + exp(1000*(x - t)))", "1/cosh(1000*(x - t))",
                                   "1/(1 + exp(100000*(x - t)))", "1/(2 + 3*exp(1000*x))^2"}) {
        GiNaC::ex front = parsed(text);
        for (const GiNaC::symbol& symbol : {s.x, s.x, s.x, s.t}) {
            front = derivative(front, symbol);
            for (const double x : {0.0, 0.25, 0.75, 1.0}) {
                // At a distance of 0.25 from the front, e^-250 of its height.
                const double value =
                    compile_tape({front}).evaluate(ArrayXd::Constant(1, x), later)(0, 0);
                BOOST_TEST((x == 0.0 && text.back() == '2' ? std::isfinite(value)
                                                           : std::abs(value) < 1e-90));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(threads_may_evaluate_one_tape_together) {
    const Tape tape = compile_tape({parsed("exp(t)*sin(pi*x) + tanh(x*t)")});
    const ArrayXd x = random_array(5000, 0.0, 1.0, 8);
    const ArrayXd t = ArrayXd::Constant(1, 0.3);
    const Eigen::ArrayXXd expected = tape.evaluate(x, t);
    std::vector<int> differing(4, 0);
    {
        std::vector<std::jthread> threads;
        threads.reserve(differing.size());
        for (int& count : differing)
            threads.emplace_back([&] {
                for (int i = 0; i < 20; ++i)
                    count += (tape.evaluate(x, t) != expected).any() ? 1 : 0;
            });
    }
    for (const int count : differing)
        BOOST_TEST(count == 0);
}

// At x = 1/16 the sum is 2^308 to rounding, its fourth power no double, and the value 2^800 over
// it; and the other way round, the fourth power of x^77 + x^78 is too small.
BOOST_AUTO_TEST_CASE(a_part_that_leaves_the_range_at_one_point_is_not_lost_there) {
    const Tape tape = compile_tape(
        {parsed("x^(-200)/(x + x^(-77))^4"), parsed("x*t"), parsed("x^(-200)*(x^77 + x^78)^4")});
    const ArrayXd x = ArrayXd::LinSpaced(300, 0.0625, 1.0);
    const Eigen::ArrayXXd values = tape.evaluate(x, ArrayXd::Constant(1, 0.5));
    BOOST_TEST(values(0, 0) == std::ldexp(1.0, -432), boost::test_tools::tolerance(1e-13));
    BOOST_TEST(values(0, 299) == 0.0625, boost::test_tools::tolerance(1e-13));
    BOOST_TEST(values(2, 0) == std::ldexp(std::pow(1.0625, 4), -432),
               boost::test_tools::tolerance(1e-13));
    // The others are what they are alone.
    for (Eigen::Index k = 0; k < x.size(); ++k)
        BOOST_TEST(
            (tape.evaluate(x.segment(k, 1), ArrayXd::Constant(1, 0.5)).col(0) == values.col(k))
                .all());
    // The tail of an exponential is zero; what is infinite stays so.
    BOOST_TEST(compile_tape({parsed("exp(-10000*t)")})
                   .evaluate(ArrayXd::Zero(1), ArrayXd::Ones(1))(0, 0) == 0.0);
    const Tape pole = compile_tape({parsed("1/x")});
    BOOST_TEST(std::isinf(pole.evaluate(ArrayXd::Zero(1), ArrayXd::Zero(1))(0, 0)));
}

// The sizes of coefficients and exponents, by hand: x and t count as 1.
BOOST_AUTO_TEST_CASE(how_large_an_expression_becomes_is_told_by_its_coefficients) {
    const std::pair<std::string, double> sizes[] = {
        {"8*x", 3.0},           {"x + t", 1.0},        {"(x + 1)^10", 10.0},  {"x + 3*t + 4", 3.0},
        {"(2*x + 2*t)^3", 6.0}, {"sin(64*x)/4", -2.0}, {"2^(-600)*x", -600.0}};
    for (const auto& [text, bits] : sizes)
        BOOST_TEST(std::abs(magnitude(*canonical(parsed(text))).whole - bits) < 0.01, text);
    // Beyond doubles to a bit.
    BOOST_TEST(std::abs(magnitude(*canonical(parsed("1000^118"))).whole - 1175.96) < 1.0);
    BOOST_TEST(fits_doubles(magnitude(*canonical(parsed("1000^50*x")))));
    BOOST_TEST(!fits_doubles(magnitude(*canonical(parsed("(1000*x + 1)^118/1000^118")))));
}

BOOST_AUTO_TEST_SUITE_END()

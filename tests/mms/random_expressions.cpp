#include "mms/expression/agreement.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/problem_builder.hpp"
#include "mms/separation.hpp"
#include "tests/mms/random_grammar.hpp"
#include "tests/this_build.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

// Expressions from a random grammar, with what is derived from them, against 50 digits: a tape is
// right, or the comparison with the text in long double says that it is not. Many more of them on
// demand, others by another seed:
// TVBEAM_RANDOM_EXPRESSIONS=20000 TVBEAM_RANDOM_SEED=2 mms_tests --run_test=mms_random_expressions

using Eigen::ArrayXd;
using Eigen::Index;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_random_expressions)

namespace {

using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                               boost::multiprecision::et_off>;

template <typename Real>
BoundedJet<Real> jet_at(const PlainExpression& plain, double x, double t, const Real& pi) {
    return evaluated<Real>(plain, {{"x", BoundedJet<Real>::x(Real(x), 3)},
                                   {"t", BoundedJet<Real>::t(Real(t), 1)},
                                   {"pi", BoundedJet<Real>(Bounded<Real>{pi, pi})}});
}

/// The values of a formula at points, by its tape and by the products that it separates into.
std::vector<ComputedValues> computed(const GiNaC::ex& formula, const ArrayXd& x, const ArrayXd& t) {
    const auto tape = [&](const GiNaC::ex& part) -> ArrayXd {
        return compile_tape({part}).evaluate(x, t).row(0);
    };
    const Separation parts = separated(formula);
    ComputedValues sum = ComputedValues::of(tape(parts.rest));
    sum.terms = sum.values.abs();
    for (const SeparatedProduct& product : parts.products) {
        const ScaledProfile profile = scaled_profile(product.profile);
        if (!profile.function)
            return {ComputedValues::of(tape(formula))};
        const ArrayXd term = tape(product.amplitude * profile.size) * profile.function(x);
        sum.values += term;
        sum.terms += term.abs();
    }
    std::vector<ComputedValues> result = {ComputedValues::of(tape(formula))};
    // What overflows by itself is not taken apart (problem_builder.cpp).
    if (sum.values.isFinite().all())
        result.push_back(sum);
    return result;
}

struct Counts {
    int compared = 0; ///< formulas
    int refused = 0;  ///< by the parser, the algebra or the compiler
    int alarms = 0;
    int false_alarms = 0;
    int silent = 0;
    double worst = 0.0; ///< error over the bound, in units of 2^-53, where there is no alarm
};

const std::vector<std::pair<int, int>> orders = {{0, 0}, {1, 0}, {2, 0}, {3, 0},
                                                 {0, 1}, {2, 1}, {3, 1}};

void compare(const std::string& text, const PlainExpression& plain, const GiNaC::ex& formula, int i,
             int j, Counts& counts) {
    const ArrayXd x{{0.0625, 0.37109375, 0.7548828125, 0.9375}};
    const ArrayXd t{{0.5703125, 1.140625, 0.0859375, 1.703125}};
    std::vector<Bounded<long double>> written_values;
    for (Index k = 0; k < x.size(); ++k)
        written_values.push_back(
            jet_at<long double>(plain, x(k), t(k), std::numbers::pi_v<long double>)
                .derivative(i, j));
    std::vector<Bounded<Digits50>> exact;
    Digits50 largest = 0;
    for (Index k = 0; k < x.size(); ++k) {
        exact.push_back(jet_at<Digits50>(plain, x(k), t(k), boost::math::constants::pi<Digits50>())
                            .derivative(i, j));
        largest = std::max(largest, exact.back().bound);
    }
    for (const ComputedValues& values : computed(formula, x, t)) {
        ++counts.compared;
        const bool alarm = first_disagreement(written_values, values).has_value();
        counts.alarms += alarm ? 1 : 0;
        bool wrong = false;
        for (Index k = 0; k < x.size(); ++k) {
            const Bounded<Digits50>& expected = exact[static_cast<std::size_t>(k)];
            const double value = values.values(k);
            const Digits50 terms = expected.bound + Digits50(values.terms(k));
            double ratio = std::numeric_limits<double>::infinity();
            if (std::isfinite(value) && isfinite(terms))
                ratio = static_cast<double>(Digits50(
                    (abs(value - expected.value) - 1e-25 * largest - 1e-300) / (terms + 1e-300)));
            if (!isfinite(terms))
                continue;
            wrong = wrong || ratio > 1e-13;
            // What is not finite is refused in any case (admissibility.cpp, given_problem.cpp).
            if (alarm || !std::isfinite(value))
                continue;
            counts.worst = std::max(counts.worst, ratio * 0x1p53);
            if (ratio > 1e-12) {
                ++counts.silent;
                BOOST_TEST_MESSAGE("silent: " << text << " order " << i << j << " at " << x(k)
                                              << ", " << t(k) << ": " << value << " for "
                                              << expected.value);
            }
        }
        if (alarm)
            BOOST_TEST_MESSAGE((wrong ? "alarm: " : "false alarm: ")
                               << text << " order " << i << j);
        counts.false_alarms += alarm && !wrong ? 1 : 0;
    }
}

} // namespace

BOOST_AUTO_TEST_CASE(a_tape_is_what_the_text_says_or_is_refused) {
    const char* wanted = std::getenv("TVBEAM_RANDOM_EXPRESSIONS");
    const int count = wanted ? std::atoi(wanted) : short_tests ? 50 : 600;
    const char* seed = std::getenv("TVBEAM_RANDOM_SEED");
    Grammar grammar(seed ? static_cast<unsigned>(std::atoi(seed)) : 1);
    Counts counts;
    for (int n = 0; n < count; ++n) {
        const std::string text = grammar.expression();
        PlainExpression plain;
        try {
            const GiNaC::ex formula =
                parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table(), &plain);
            const auto [i, j] = orders[static_cast<std::size_t>(n) % orders.size()];
            GiNaC::ex derived = formula;
            for (int k = 0; k < i; ++k)
                derived = derivative(derived, model_symbols().x);
            for (int k = 0; k < j; ++k)
                derived = derivative(derived, model_symbols().t);
            compare(text, plain, derived, i, j, counts);
        } catch (const InputError&) {
            ++counts.refused;
        } catch (const AlgebraError&) {
            ++counts.refused;
        }
    }
    BOOST_TEST_MESSAGE(counts.compared << " compared, " << counts.refused << " refused, "
                                       << counts.alarms << " alarms, worst error " << counts.worst
                                       << " times the bound");
    BOOST_TEST(counts.silent == 0);
    BOOST_TEST(counts.false_alarms == 0);
    BOOST_TEST(counts.compared > count / 2);
}

BOOST_AUTO_TEST_SUITE_END()

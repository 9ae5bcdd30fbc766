// A jump of a function between two points of a grid is found with its place and size; what is steep
// or fast but smooth has none.

#include "mms/admissible/jumps.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/symbols.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

using namespace tvbeam;
using Eigen::ArrayXd;
using Eigen::ArrayXXd;

BOOST_AUTO_TEST_SUITE(mms_jumps)

namespace {

constexpr double pi = std::numbers::pi;

std::optional<Jump> jump_of(const std::function<ArrayXd(const ArrayXd&)>& f) {
    return find_jump([&](const ArrayXd& s) -> ArrayXXd { return f(s).transpose(); },
                     uneven_grid(0.0, 1.0), 1e-6);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_jump_beside_a_smooth_trend_is_found_with_its_place_and_size) {
    std::mt19937 random(1); // NOLINT(cert-msc*): the same in every run
    std::uniform_real_distribution<double> place(0.01, 0.99);
    std::uniform_real_distribution<double> power(-4.0, 0.0);
    for (int i = 0; i < 200; ++i) {
        const double a = place(random);
        const double size = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, power(random));
        const auto found = jump_of([&](const ArrayXd& s) -> ArrayXd {
            return (7.0 * s).sin() + s.square() + size * (s > a).cast<double>();
        });
        BOOST_REQUIRE_MESSAGE(found, "none found: " << size << " at " << a);
        BOOST_TEST(std::abs(found->at - a) < 1e-6, found->at << " for " << a);
        // Smooth parts change by their slope, 9 at most, over a millionth.
        BOOST_TEST(std::abs(found->size - size) < 1e-5, found->size << " for " << size);
    }
}

BOOST_AUTO_TEST_CASE(a_formula_may_jump_only_by_a_part_that_changes) {
    const auto may = [](const std::string& text) {
        return may_jump(parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table()));
    };
    for (const std::string smooth :
         {"sin(pi*x)*exp(t)", "sqrt(2)*t - t^2/2", "x^3/6", "x/tan(1)", "log(3)^x", "t/(1 + pi)"})
        BOOST_TEST(!may(smooth), smooth);
    for (const std::string suspect : {"sqrt(x^2)", "sqrt(2)*sqrt((t - 1)^2)", "1/(1 + x)", "tan(t)",
                                      "log(x + 1)", "acos(cos(pi*t))", "asin(x)", "x^(1/3)"})
        BOOST_TEST(may(suspect), suspect);
}

BOOST_AUTO_TEST_CASE(a_formula_without_a_value_at_its_jump_has_it_all_the_same) {
    for (const double a : {0.123, 0.25, 0.3, 0.5, 0.6180339887, 0.7071, 0.9}) {
        const auto quotient =
            jump_of([&](const ArrayXd& s) -> ArrayXd { return (s - a) / (s - a).square().sqrt(); });
        BOOST_REQUIRE(quotient);
        BOOST_TEST(std::abs(quotient->size - 2.0) < 1e-9);
        // Rounding leaves 0/0 within 1e-8 of it.
        const auto of_cosine = jump_of([&](const ArrayXd& s) -> ArrayXd {
            const ArrayXd c = (pi * (s - a)).cos();
            return (pi * (s - a)).sin() / (1.0 - c.square()).sqrt();
        });
        BOOST_REQUIRE(of_cosine);
        BOOST_TEST(std::abs(of_cosine->at - a) < 1e-5);
    }
}

BOOST_AUTO_TEST_CASE(what_is_steep_or_fast_but_continuous_has_no_jump) {
    for (const double a : {0.2, 0.31, 0.7}) {
        for (const double width : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
            const auto layer = [&](const ArrayXd& s) -> ArrayXd {
                return ((s - a) / width).tanh();
            };
            BOOST_TEST(!jump_of(layer), "tanh of width " << width << " at " << a);
            const auto spike = [&](const ArrayXd& s) -> ArrayXd {
                return s + (-((s - a) / width).square()).exp();
            };
            BOOST_TEST(!jump_of(spike), "a spike of width " << width << " at " << a);
        }
        BOOST_TEST(!jump_of([&](const ArrayXd& s) -> ArrayXd { return (s - a).abs(); }));
        BOOST_TEST(!jump_of([&](const ArrayXd& s) -> ArrayXd { return (s - a).abs().sqrt(); }));
    }
    for (const double n : {10.0, 1e3, 1e5, 1e7, 1e13})
        BOOST_TEST(!jump_of([&](const ArrayXd& s) -> ArrayXd { return (n * s).sin(); }), n);
}

BOOST_AUTO_TEST_CASE(where_doubles_lie_far_apart_the_search_ends) {
    for (const double begin : {3600.0, 86400.0, 1e6, 1e6 + 1e-9})
        for (const double length : {1e-5, 3e-5, 1e-4}) {
            const auto fast = [&](const ArrayXd& t) -> ArrayXXd {
                return (100.0 * (t - begin) / length).cos().transpose();
            };
            static_cast<void>(find_jump(fast, uneven_grid(begin, begin + length), 1e-6));
        }
    BOOST_TEST(true);
}

BOOST_AUTO_TEST_CASE(of_several_functions_the_one_that_jumps_most_is_named) {
    const auto rows = [](const ArrayXd& s) -> ArrayXXd {
        ArrayXXd values(3, s.size());
        values.row(0) = s.sin();
        values.row(1) = (s > 0.4).cast<double>();
        values.row(2) = 3.0 * (s > 0.4).cast<double>();
        return values;
    };
    const auto found = find_jump(rows, uneven_grid(0.0, 1.0), 1e-6);
    BOOST_REQUIRE(found);
    BOOST_TEST(found->row == 2);
    BOOST_TEST(found->size == 3.0);
}

BOOST_AUTO_TEST_SUITE_END()

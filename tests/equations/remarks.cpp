// What is no error and yet to be said of equations and their solution.

#include "mms/equations/system_checks.hpp"
#include "mms/text/number_text.hpp"

#include <boost/test/unit_test.hpp>

using namespace tvbeam;

namespace {

std::vector<std::string> remarks_of(const std::string& unknown, const std::string& equation,
                                    const std::string& rest = {}) {
    DerivedSystem derived = derive_system(parse_equation_system(
        "[unknowns]\nu = \"" + unknown + "\"\n[equations]\nf = \"" + equation + "\"\n" + rest,
        "my.toml"));
    std::vector<std::string> texts;
    for (const Remark& remark : checked_system(derived))
        texts.push_back(InputError(remark.place, remark.text).what());
    return texts;
}

/// The one remark, or all of them.
std::string remark_of(const std::string& unknown, const std::string& equation,
                      const std::string& rest = {}) {
    std::string all;
    for (const auto& text : remarks_of(unknown, equation, rest))
        all += (all.empty() ? "" : "\n") + text;
    return all;
}

} // namespace

BOOST_AUTO_TEST_SUITE(equation_remarks)

BOOST_AUTO_TEST_CASE(of_a_solution_that_exercises_all_nothing_is_said) {
    BOOST_TEST(remark_of("sin(x + 2*y)*exp(-t)", "diff(u, t) - k*laplace(u)",
                         "[parameters]\nk = 2\n") == "");
}

BOOST_AUTO_TEST_CASE(an_equation_that_is_met_already_is_named) {
    const std::string said = remark_of("sin(x)*exp(-t)", "diff(u, t) - diff(u, x, 2)");
    BOOST_TEST(said.starts_with("my.toml:4:6: f is zero everywhere"), said);
}

BOOST_AUTO_TEST_CASE(zero_is_seen_where_the_algebra_does_not_see_it) {
    // sin² + cos² − 1
    const std::string said = remark_of("t*x^2", "u*(sin(x)^2 + cos(x)^2 - 1)");
    BOOST_TEST(said.find("f is zero, to rounding, at all") != std::string::npos, said);
}

BOOST_AUTO_TEST_CASE(a_small_source_is_not_zero) {
    BOOST_TEST(remark_of("1e-15*sin(x)*exp(-2*t)", "diff(u, t) - diff(u, x, 2)") == "");
}

// The round-off of 1e22 is above a period, and yet sin and cos are at most 1, and atan pi/2.
BOOST_AUTO_TEST_CASE(a_bounded_function_of_a_large_argument_does_not_make_a_sum_zero) {
    for (const std::string large :
         {"sin(1e22)", "sin(sin(1e8)*1e12)", "cos(1e22)", "tanh(sin(1e22)*1e-1)",
          "atan(sin(1e22)*1e22)", "asin(sin(1e22))", "acos(sin(1e22)) - pi"}) {
        const std::string said = remark_of("x", "u + 4 + " + large);
        BOOST_TEST(said.find("zero") == std::string::npos, said);
        const std::string close = remark_of("x", "u + 2 + " + large);
        BOOST_TEST(close.find("zero") == std::string::npos, close);
    }
    // Beside terms of 1e12 that cancel, the sum is small and yet above what is uncertain of sin.
    const std::string beside =
        remark_of("x", "u + 4 + sin(1e22) + (K + 1)*(K - 1) - K^2 + 1", "[parameters]\nK = 1e6\n");
    BOOST_TEST(beside.find("zero") == std::string::npos, beside);
    const std::string unknown = remark_of("x + 2 + sin(1e22*t)", "u");
    BOOST_TEST(unknown.find("zero") == std::string::npos, unknown);
}

// What is uncertain is not said to be zero: e^0 = 1, and tan has a pole near 1e22.
BOOST_AUTO_TEST_CASE(what_cannot_be_computed_is_not_called_zero) {
    for (const std::string uncertain :
         {"exp(K*(x + 1)*(x - 1) - K*x^2 + K)", "tan(K*x)", "sin(K*x)", "cosh(sin(K*x))"}) {
        const std::string said = remark_of("x", "(u + 1)*" + uncertain, "[parameters]\nK = 1e22\n");
        BOOST_TEST(said.find("zero") == std::string::npos, said);
    }
    const std::string small = remark_of("x", "u*sin(k*pi)", "[parameters]\nk = 1\n");
    BOOST_TEST(small.find("f is zero, to rounding, at all") != std::string::npos, small);
}

BOOST_AUTO_TEST_CASE(zero_at_one_of_the_points_is_not_zero_everywhere) {
    const auto points = points_inside(
        parse_equation_system("[unknowns]\nu = \"x\"\n[equations]\nf = \"u\"\n", "my.toml"), 1);
    const std::string place = number_text(points.front().at("x"), 17);
    BOOST_TEST(remark_of("(x - " + place + ")*(x - " + place + ")", "u") == "");
}

BOOST_AUTO_TEST_CASE(a_term_that_is_not_exercised_is_named_with_its_coefficient) {
    const std::string said =
        remark_of("sin(x)*y*t", "diff(u, t) - k*laplace(u)", "[parameters]\nk = 2\n");
    BOOST_TEST(said == "my.toml:4:6: u_yy is zero everywhere: its coefficient in f, -k, is not "
                       "tested");
}

BOOST_AUTO_TEST_CASE(a_parameter_without_effect_is_named) {
    const std::string said =
        remark_of("sin(x)*exp(-2*t)", "diff(u, t) - diff(u, x, 2)", "[parameters]\nq = 2\n");
    BOOST_TEST(said == "my.toml:6:1: parameter q has no effect on anything that is derived");
}

// div v = 0 in the plane, and u is harmonic: their coefficients stand for nothing.
BOOST_AUTO_TEST_CASE(a_parameter_of_a_sum_that_vanishes_is_named) {
    const std::string named = "parameter k has no effect on anything that is derived: f is the "
                              "same for all values of it, and what it multiplies there is not "
                              "tested";
    const std::string k = "[parameters]\nk = 2\n";
    const std::string harmonic = "t*sin(pi*x)*cosh(pi*y)";
    BOOST_TEST(remark_of(harmonic, "diff(u, t) - k*laplace(u)", k) == "my.toml:6:1: " + named);
    BOOST_TEST(remark_of(harmonic, "diff(u, t) - sin(1 + k*laplace(u))", k).ends_with(named));
    BOOST_TEST(
        remark_of("t*x*y", "diff(u, t) - u + k*(diff(u, x)*diff(u, y) - u*t)", k).ends_with(named));
    DerivedSystem elastic = derive_system(parse_equation_system(
        "[parameters]\nlambda = 2\nmu = 1\n[unknowns]\n"
        "v = ['sin(x)*cos(y)', '-cos(x)*sin(y)']\n[definitions]\n"
        "s = '2*mu*sym(grad(v)) + lambda*div(v)*identity'\n[equations]\nf = '-div(s)'\n",
        "my.toml"));
    const auto remarks = checked_system(elastic);
    BOOST_REQUIRE(remarks.size() == 1U);
    BOOST_TEST(remarks[0].text.starts_with("parameter lambda has no effect on anything"));
}

// Upwind: the part of a that is positive is zero, but not of another a.
BOOST_AUTO_TEST_CASE(
    a_parameter_without_effect_about_its_value_is_not_said_to_have_none_at_others) {
    const std::string said = remark_of("sin(x)*exp(t)", "diff(u, t) + (a + sqrt(a^2))/2*diff(u, x)",
                                       "[parameters]\na = -1\n");
    BOOST_TEST(said.find(": f is the same at and beside its value, to rounding, at all ") !=
                   std::string::npos,
               said);
}

BOOST_AUTO_TEST_CASE(a_parameter_that_something_depends_on_is_not_named) {
    for (const auto& [unknown, equation] :
         {std::pair<std::string, std::string>{"sin(x)*exp(-k*t)", "diff(u, t) + k*u"},
          {"sin(x)*exp(-t)", "diff(u, t) - (k - 2)^2*diff(u, x, 2)"},
          {"sin(x)*exp(-t)", "diff(u, t) - cos(k - 2)*diff(u, x, 2)"},
          {"sin(x)*exp(-t)*1e-9", "diff(u, t) - 1e-9*k*diff(u, x, 2)"},
          {"sin(x)*exp(-t)", "diff(u, t) - diff(u, x, 2)*(1 + k*1e-12)"}}) {
        const std::string said = remark_of(unknown, equation, "[parameters]\nk = 2\n");
        BOOST_TEST(said.find("no effect") == std::string::npos, said);
    }
}

// sqrt(x) has a kink at 0, which its time derivative has as well; its slope 1/(2 sqrt(x)) has
// worse.
BOOST_AUTO_TEST_CASE(a_kink_is_said_once_and_the_pole_of_its_derivative_too) {
    const auto said = remarks_of("sqrt(x)*exp(t)", "diff(u, t) + u");
    BOOST_REQUIRE(said.size() == 2U);
    BOOST_TEST(said[0].starts_with("my.toml:2:6: u is not smooth: "), said[0]);
    BOOST_TEST(said[1].starts_with("my.toml:2:6: u_exact_x has no value: "), said[1]);
    const auto with_slope = remarks_of("sqrt(x)*exp(t)", "diff(u, t) - diff(u, x)");
    BOOST_REQUIRE(with_slope.size() == 3U);
    BOOST_TEST(with_slope[1].starts_with("my.toml:4:6: f has no value: "), with_slope[1]);
}

BOOST_AUTO_TEST_CASE(a_kink_in_another_place_than_the_solution_s_is_said_of_the_source) {
    const auto said =
        remarks_of("x^2.5*(1-x)*cos(t)", "diff(u,t) - diff(u,x,2) + sqrt(sqrt((x-0.5)^2))*u");
    BOOST_REQUIRE(said.size() == 2U);
    BOOST_TEST(said[0].find("u is not smooth: the argument x of a root is 0 at t = 0, x = 0") !=
                   std::string::npos,
               said[0]);
    BOOST_TEST(said[1].find("f is not smooth: ") != std::string::npos, said[1]);
    BOOST_TEST(said[1].find("x = 0.5") != std::string::npos, said[1]);
}

BOOST_AUTO_TEST_CASE(a_boundary_or_initial_value_is_singular_where_it_is_given) {
    const auto remark = [](const std::string& values) {
        return remark_of("sin(x + y)*exp(-t)", "diff(u, t) - laplace(u)",
                         values + "[domain]\nx = [1, 2]\ny = [0, 3]\nt = [5, 6]\n");
    };
    BOOST_TEST(remark("[boundary]\nright = { on = 'x = 2', value = 'diff(u,x)/(y - 1/2)' }\n")
                   .ends_with("the divisor 2*y - 1 is 0 at t = 5, x = 2, y = 0.5"));
    BOOST_TEST(remark("[boundary]\ntop = { on = 'y = 3', value = 'sqrt(x - 5/4)*u' }\n")
                   .find("of a root is 0 at t = 5, x = 1.25, y = 3, and negative") !=
               std::string::npos);
    BOOST_TEST(remark("[initial]\nstart = 'sqrt((x - 1.3137)^2)'\n")
                   .find(" is 0 at t = 5, x = 1.3137, y = ") != std::string::npos);
    // In six digits x were 1.5, where the divisor is -1.
    BOOST_TEST(remark("[initial]\nstart = '1/(x - 1.5000001)'\n")
                   .find("the divisor 1e+07*x - 15000001 is 0 at t = 5, x = 1.5000001, y = ") !=
               std::string::npos);
    // Without a place it is for any boundary, of a hole, too.
    BOOST_TEST(
        remark("[boundary]\nall = '1/((x - 1.5)^2 + (y - 1)^2)'\n").ends_with(", x = 1.5, y = 1"));
    BOOST_TEST(remark("[boundary]\nall = '1/((x - 1.5)^2 + (y - 3)^2)'\n")
                   .ends_with(" is 0 at t = 5, x = 1.5, y = 3"));
}

BOOST_AUTO_TEST_CASE(a_pole_of_a_source_alone_is_said_of_it) {
    const std::string said = remark_of("exp(x)*(2 + t)", "diff(u, t) - u/(x - 1/2)");
    BOOST_TEST(said.starts_with("my.toml:4:6: f has no value: the divisor 2*x - 1 is 0 at "), said);
    BOOST_TEST(said.find("x = 0.5") != std::string::npos, said);
    const std::string wide =
        remark_of("x*(2 + t)", "diff(u, t) - u/(x - 1/2)", "[domain]\nx = [0, 1e300]\n");
    BOOST_TEST(wide.ends_with("is 0 at t = 0, x = 0.5"), wide);
    // The domain's length is beyond a double, and t = 1e-304 is not 0.
    const std::string widest =
        remark_of("cos(t + 1)*t", "diff(u, t) - u/(x - 1/2)", "[domain]\nx = [-9e307, 9e307]\n");
    BOOST_TEST(widest.ends_with("is 0 at t = 0, x = 0.5"), widest);
    const std::string tiny = remark_of("exp(x)*(2 + t)", "diff(u, t) - u/(1e300*t - 1e-4)");
    BOOST_TEST(tiny.find("t = 1e-304") != std::string::npos, tiny);
}

// The base of r^3 is a root at its centre and, in what is derived, a divisor.
BOOST_AUTO_TEST_CASE(a_root_that_becomes_a_divisor_is_a_pole_also_between_the_points) {
    for (const std::string place : {"0.37", "0.5"}) {
        const auto said = remarks_of("((x - " + place + ")^2)^1.25 + x^2", "diff(u, x, 3)");
        bool has_pole = false;
        for (const auto& remark : said)
            has_pole = has_pole || remark.find("f has no value: ") != std::string::npos;
        BOOST_TEST(has_pole, place);
    }
}

BOOST_AUTO_TEST_CASE(a_narrow_pole_between_the_points_is_not_overlooked) {
    // (x − 1/π)² has no change of sign, and no point of a grid is at 1/π.
    const std::string said =
        remark_of("exp(x)*(2 + t)", "diff(u, t) + u/((x - 1/pi)*(x - 1/pi)*(2 + sin(x)))");
    BOOST_TEST(said.find("f has no value: the divisor") != std::string::npos, said);
    BOOST_TEST(said.find("x = 0.318") != std::string::npos, said);
    // Nor beside a kink, which is found first.
    const std::string kinked =
        remark_of("exp(x)*(2 + t)", "diff(u, t) + u*x^(5/2)/((x - 1/pi)*(x - 1/pi)*(2 + sin(x)))");
    BOOST_TEST(kinked.find("f has no value: the divisor") != std::string::npos, kinked);
    // And what only comes close to 0 is not said to be there.
    const std::string close =
        remark_of("exp(x)*(2 + t)", "diff(u, t) + u*sqrt((x - 1/pi)*(x - 1/pi) + 1e-12)");
    BOOST_TEST(close.find("could not be excluded") != std::string::npos, close);
    const std::string large = remark_of("exp(x)*(2 + t)", "diff(u, t) + u*(x^(5/2) + exp(1000*x))");
    BOOST_TEST(large.find("is beyond the range of doubles") != std::string::npos, large);
}

// 3 + sin … is at least 2; intervals of tanh are unknown, but of a constant none is needed.
BOOST_AUTO_TEST_CASE(a_divisor_of_constants_is_looked_at_once) {
    BOOST_TEST(remark_of("x*t/(3 + sin(tanh(1.5e-3)))", "diff(u, t)") == "");
}

// (1e200)² = 1e400, and e^(e^8) = 10^1294, where doubles end at 1.8e308.
BOOST_AUTO_TEST_CASE(a_source_that_a_double_cannot_hold_is_said_with_what_overflows) {
    BOOST_TEST(
        remark_of("1e200*sin(x)", "u*u").ends_with("is beyond the range of doubles at x = 0.125"));
    const std::string nested = remark_of("x", "exp(exp(8*u))");
    BOOST_TEST(nested.ends_with("exp(exp(8*u)) is beyond the range of doubles at x = 0.875"),
               nested);
    // 1/(1 + exp(-800 u)), as the code has it, is held.
    BOOST_TEST(remark_of("x", "exp(800*u)/(1 + exp(800*u))") == "");
}

BOOST_AUTO_TEST_CASE(an_argument_beyond_what_a_function_is_defined_on_is_said_as_that) {
    for (const std::string equation : {"sqrt(u - 1e-17)", "sqrt(u^2 - 1e-17)"}) {
        const std::string root = remark_of("x", equation);
        BOOST_TEST(root.find("f has no value in places: the argument u") != std::string::npos,
                   root);
        BOOST_TEST(root.ends_with(" of a root is negative at x = 0"), root);
    }
    const std::string inverse = remark_of("x", "asin(u*(1+3e-16))");
    BOOST_TEST(inverse.find("of asin or acos is above 1 in size at x = 1") != std::string::npos,
               inverse);
    const std::string power = remark_of("x", "(u - 1e-17)^0.3");
    BOOST_TEST(power.ends_with("the argument u - 1e-17 of a root is negative at x = 0"), power);
    const std::string constant = remark_of("x", "u*n*n^q", "[parameters]\nn = 0\nq = -0.2\n");
    BOOST_TEST(constant.ends_with("f has no value: the base n of a power is 0 everywhere"),
               constant);
}

BOOST_AUTO_TEST_CASE(the_logarithm_in_the_derivatives_of_a_power_has_no_value_at_zero) {
    const auto said = remarks_of("x^x*y", "u-diff(u,x,2)", "[domain]\nx = [0, 10]\n");
    BOOST_REQUIRE(said.size() == 3U);
    BOOST_TEST(said[0].starts_with("my.toml:2:6: u is not smooth: the base x of a power is 0"));
    BOOST_TEST(said[1].starts_with("my.toml:4:6: f has no value: the argument x of log is 0 at "
                                   "x = 0, "),
               said[1]);
    BOOST_TEST(said[2].starts_with("my.toml:2:6: u_exact_x has no value: the argument x of log "),
               said[2]);
}

// Halves of the domain are halved down to the smallest double, whose tenth is 0.
BOOST_AUTO_TEST_CASE(a_place_is_looked_into_down_to_the_smallest_double) {
    for (const std::string unknown : {"1/x^x", "log(x^x)", "sqrt(x^x)", "1/(x^x)^2"}) {
        const std::string said = remark_of(unknown, "u", "[domain]\nx = [0, 10]\n");
        BOOST_TEST(said.starts_with("my.toml:2:6: u is not smooth: the base x of a power is 0 at "
                                    "x = 0"),
                   said);
    }
    const std::string plane = remark_of("sqrt(y)/x^x", "u", "[domain]\nx = [0, 10]\n");
    BOOST_TEST(plane.starts_with("my.toml:2:6: u is not smooth: "), plane);
    const std::string source = remark_of("x", "1/u^u", "[domain]\nx = [0, 10]\n");
    BOOST_TEST(source.starts_with("my.toml:4:6: f is not smooth: the base x of a power is 0 at "),
               source);
}

// Doubles give 0, π/2 and 1e-22 there: no overflow, no pole.
BOOST_AUTO_TEST_CASE(what_comes_out_well_is_not_called_an_overflow_or_a_pole) {
    BOOST_TEST(remark_of("1/(1 + exp(900*x))", "u") == "");
    // Of the slope 2000 e^s/(1 + e^2s) doubles make ∞/∞.
    const auto said = remarks_of("atan(exp(2000*(x - 0.5)))", "u");
    BOOST_REQUIRE(said.size() == 1U);
    BOOST_TEST(said[0].starts_with("my.toml:2:6: u_exact_x: "), said[0]);
    BOOST_TEST(remark_of("x", "u/(1 + exp(1000*x))") == "");
    BOOST_TEST(remark_of("x", "u/exp(-50*x)") == "");
}

BOOST_AUTO_TEST_CASE(what_is_singular_by_its_parameters_is_so_everywhere) {
    BOOST_TEST(remark_of("x", "sqrt(k + 1)*u + u", "[parameters]\nk = -1\n").find("not smooth") ==
               std::string::npos);
    const std::string pole = remark_of("x", "u/k", "[parameters]\nk = 0\n");
    BOOST_TEST(pole.find("the divisor k is 0 everywhere") != std::string::npos, pole);
    BOOST_TEST(pole.find("f is zero") == std::string::npos, pole);
}

// (-1.3)² = 1.69; 1.3 needs no whole exponent, and its power stays one of parameters.
BOOST_AUTO_TEST_CASE(a_whole_power_of_a_negative_parameter_has_a_value) {
    const std::string parameters = "[parameters]\nb = -1.3\nn = 2\n";
    const std::string whole =
        "my.toml:7:1: parameter n stands in whole exponents, and 2 for it everywhere";
    BOOST_TEST(remark_of("sin(x)*t", "diff(u, t) - b^n*diff(u, x, 2)", parameters) == whole);
    BOOST_TEST(remark_of("sin(x)*t*b^n", "diff(u, t) - diff(u, x, 2)", parameters) == whole);
    BOOST_TEST(remark_of("sin(x)*t", "diff(u, t) - sin(b)^n*diff(u, x, 2)", parameters) == whole);
    BOOST_TEST(remark_of("sin(x)*t", "diff(u, t) - b^n*diff(u, x, 2)",
                         "[parameters]\nb = -1.3\nn = 101\n") ==
               "my.toml:7:1: parameter n stands in whole exponents, and 101 for it everywhere");
    BOOST_TEST(remark_of("sin(x)*t", "diff(u, t) - b^n*diff(u, x, 2)",
                         "[parameters]\nb = 1.3\nn = 2\n") == "");
    BOOST_TEST(
        remark_of("sin(x)*t", "diff(u, t) - b^n*diff(u, x, 2)", "[parameters]\nb = -1.3\nn = 0.5\n")
            .find("the base b of a power is 0 or beyond everywhere") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(every_singularity_of_a_source_is_said) {
    const std::string many =
        remark_of("x", "1/(u - 0.3) + 1/(u - 0.4) + 1/(u - 0.6) + 1/(u - 0.7)");
    BOOST_TEST(many.find("(and 1 more)") != std::string::npos, many);
    const auto said = remarks_of("x", "1/(u - 0.25) + 1/(u - 0.75)");
    BOOST_REQUIRE(said.size() == 2U);
    for (const char* place : {"x = 0.25", "x = 0.75"})
        BOOST_TEST((said[0].ends_with(place) || said[1].ends_with(place)), place);
}

// (x^1.5)'' = 0.75/√x
BOOST_AUTO_TEST_CASE(a_source_that_is_infinite_at_an_end_has_a_pole_there) {
    const auto said = remarks_of("x^1.5", "diff(u, x, 2)");
    BOOST_REQUIRE(!said.empty());
    const std::string all = remark_of("x^1.5", "diff(u, x, 2)");
    BOOST_TEST(all.find("f has no value: ") != std::string::npos, all);
    BOOST_TEST(all.find("x = 0") != std::string::npos, all);
    // Also where the power is a parameter's.
    const std::string named = remark_of("x^k", "diff(u, x, 2)", "[parameters]\nk = 1.5\n");
    BOOST_TEST(named.find("f has no value: ") != std::string::npos, named);
}

BOOST_AUTO_TEST_CASE(what_is_smooth_is_proven_to_be) {
    BOOST_TEST(remark_of("exp(-x*t)/(1.01 + sin(5*x))*sqrt(1 + x*t) + atan(x)/(2 + cos(t))",
                         "diff(u, t) - diff(u, x, 2)") == "");
}

BOOST_AUTO_TEST_CASE(the_domain_is_what_the_file_says) {
    const std::string pole = "1/(3 - x)*t";
    BOOST_TEST(remark_of(pole, "diff(u, t) + diff(u, x)") == "");
    BOOST_CHECK_THROW(remark_of(pole, "diff(u, t) + diff(u, x)", "[domain]\nx = [0, 4]\n"),
                      InputError);
}

BOOST_AUTO_TEST_SUITE_END()

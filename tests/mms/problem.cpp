#include "mms/expression/symbols.hpp"
#include "mms/given_problem.hpp"
#include "mms/manufactured_problem.hpp"
#include "mms/problem_builder.hpp"
#include "tests/suited_beam.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace data = boost::unit_test::data;
using Eigen::ArrayXd;
using Eigen::Index;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_problem)

namespace {

constexpr double pi = 3.14159265358979323846;
const Beam papers_beam = {0.017, 0.1, 0.0, {-0.02, 0.1}};

ArrayXd one(double value) {
    return ArrayXd::Constant(1, value);
}

double field_value(const Field& field, const ProblemData& problem, double x, double t) {
    double sum = field.rest ? field.rest(one(x), t)(0) : 0.0;
    for (const Field::Term& term : field.terms)
        sum += problem.amplitudes(one(t))(term.amplitude, 0) *
               problem.profiles[static_cast<std::size_t>(term.profile)](one(x))(0);
    return sum;
}

double amplitude_value(const std::optional<Index>& amplitude, const ProblemData& problem,
                       double t) {
    return amplitude ? problem.amplitudes(one(t))(*amplitude, 0) : 0.0;
}

Solution papers_solution() {
    return read_solution(TVBEAM_SOLUTIONS_DIR "/copetti-fernandez-2011.toml");
}

std::vector<std::string> shipped() {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(TVBEAM_SOLUTIONS_DIR))
        paths.push_back(entry.path().string());
    return paths;
}

/// ∫_y^1 g dx to about 1e-14 of the integral of |g|.
template <typename Function>
double integral(const Function& g, double y) {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(g, y, 1.0, 8, 1e-14);
}

GivenData given(const std::string& q) {
    GivenData data;
    data.body_force = SourceText(q, {"scene.toml", 5, 15});
    return data;
}

} // namespace

BOOST_AUTO_TEST_CASE(the_papers_problem_is_a_few_products) {
    const ProblemData problem = manufactured_problem({papers_solution(), papers_beam, 2.0});
    BOOST_TEST(problem.heat_source.is_separable());
    BOOST_TEST(problem.moment_load.is_separable());
    // f: sin πx and x − 1. μ: sin πx, and x − 1 for σ, u_xx and u_xxt together.
    BOOST_TEST(problem.heat_source.terms.size() == 2U);
    BOOST_TEST(problem.moment_load.terms.size() == 2U);
    BOOST_TEST(problem.heat_source.terms[0].profile != problem.heat_source.terms[1].profile);
    // G: cos πx and 1.
    BOOST_TEST(problem.couple_load.terms.size() == 2U);
    BOOST_TEST(problem.exact->theta.terms.size() == 1U);
    BOOST_TEST(problem.exact->u_xx.terms.size() == 1U);
    // sin πx, cos πx, x − 1, 1, x³ − 3x², x² − 2x.
    BOOST_TEST(problem.profiles.size() == 6U);
    BOOST_TEST(problem.body_force.is_zero());
    BOOST_TEST(!problem.end_moment.has_value());
    BOOST_TEST(problem.exact->stress.has_value());
}

BOOST_AUTO_TEST_CASE(what_the_beam_does_not_have_leaves_no_terms) {
    Beam beam = papers_beam;
    beam.alpha = 0.0;
    const ProblemData problem = manufactured_problem({papers_solution(), beam, 2.0});
    BOOST_TEST(problem.heat_source.terms.size() == 1U);
    BOOST_TEST(problem.moment_load.terms.size() == 1U);
    BOOST_TEST(problem.couple_load.terms.size() == 1U);
    const ProblemData at_rest =
        manufactured_problem({parse_solution("theta = 0\nu = 0\n", "rest.toml"), Beam{}, 1.0});
    BOOST_TEST(at_rest.heat_source.is_zero());
    BOOST_TEST(at_rest.moment_load.is_zero());
    BOOST_TEST(at_rest.exact->u.is_zero());
    BOOST_TEST(at_rest.profiles.empty());
    BOOST_TEST(at_rest.amplitude_count == 0);
    BOOST_TEST(!at_rest.exact->stress.has_value());
}

BOOST_DATA_TEST_CASE(profiles_and_amplitudes_are_finite_and_distinct, data::make(shipped())) {
    const Solution solution = read_solution(sample);
    const ProblemData problem =
        manufactured_problem({solution, suited(papers_beam, solution), 2.0});
    const ArrayXd x = ArrayXd::LinSpaced(50, 0.0, 1.0);
    for (std::size_t i = 0; i < problem.profiles.size(); ++i) {
        const ArrayXd values = problem.profiles[i](x);
        BOOST_TEST(values.isFinite().all());
        BOOST_TEST(values.abs().maxCoeff() > 0.0);
        for (std::size_t j = 0; j < i; ++j)
            BOOST_TEST((values - problem.profiles[j](x)).abs().maxCoeff() > 1e-6);
    }
    if (problem.amplitude_count == 0)
        return;
    const Eigen::ArrayXXd amplitudes = problem.amplitudes(ArrayXd::LinSpaced(50, 0.0, 2.0));
    BOOST_TEST(amplitudes.rows() == problem.amplitude_count);
    BOOST_TEST(amplitudes.isFinite().all());
    for (Index i = 0; i < amplitudes.rows(); ++i)
        for (Index j = 0; j < i; ++j)
            BOOST_TEST((amplitudes.row(i) - amplitudes.row(j)).abs().maxCoeff() > 1e-9);
}

// GiNaC writes (0.86 x + 0.14)^n as (43 x + 7)^n/50^n, and a profile that is a sum of such powers
// leaves the 1/50^n to the amplitude. The norms of an error need the squares of both.
BOOST_DATA_TEST_CASE(profiles_of_powers_of_sums_have_squares,
                     data::make({-103, -40, 40, 103, 154, 180, 300, 500})) {
    const std::string power = "(0.86*x + 0.14)^(" + std::to_string(sample) + ")";
    const Beam beam = {0.4, 0.1, 0.0, {}};
    for (const std::string scale : {"t", "1e-30*(1 + 1.15*t)"}) {
        const ProblemData problem = manufactured_problem(
            {parse_solution("theta = \"x*(1 - x)*" + power + "*" + scale +
                                "\"\nu = \"x^2*(1 - x)*" + power + "*" + scale + "\"\n",
                            "power.toml"),
             beam, 1.0});
        const ArrayXd x = ArrayXd::LinSpaced(200, 0.0, 1.0);
        for (const SpaceFunction& profile : problem.profiles) {
            const double square = profile(x).square().maxCoeff();
            BOOST_TEST(std::isnormal(square));
            BOOST_TEST(std::isfinite(square));
        }
    }
    // The body force has its profile, and its moment one too.
    const ProblemData pushed =
        given_problem(given("t*(1 + x)*(1 - (x + 1)*" + power + ")"), beam, 1.0);
    for (const SpaceFunction& profile : pushed.profiles)
        BOOST_TEST(std::isnormal(profile(ArrayXd::LinSpaced(200, 0.0, 1.0)).square().maxCoeff()));
}

// The two descriptions of the load: μ in closed form against ∫_y^1 (G + (x − y) q) dx − m by
// quadrature.
BOOST_DATA_TEST_CASE(moment_load_is_the_integral_of_the_couple_load, data::make(shipped())) {
    const Solution solution = read_solution(sample);
    Beam beam = papers_beam;
    beam.theta_A = 0.75;
    const ProblemData problem = manufactured_problem({solution, suited(beam, solution), 2.0});
    for (const double t : {0.0, 0.3, 1.2, 1.25, 1.3, 1.9})
        for (const double y : {0.0, 0.2, 0.55, 1.0}) {
            const auto load = [&](double x) {
                return field_value(problem.couple_load, problem, x, t) +
                       (x - y) * field_value(problem.body_force, problem, x, t);
            };
            const double expected = (y < 1.0 ? integral(load, y) : 0.0) -
                                    amplitude_value(problem.end_moment, problem, t);
            BOOST_TEST(std::abs(field_value(problem.moment_load, problem, y, t) - expected) <
                       1e-12);
        }
}

// Also where times are not in order, and at the very end of a phase, which is still its own.
BOOST_AUTO_TEST_CASE(amplitudes_follow_the_phases) {
    const ProblemData problem = manufactured_problem({papers_solution(), papers_beam, 2.0});
    const Index stress = *problem.exact->stress;
    const double end = std::sqrt(2.0);
    ArrayXd t(7);
    t << 1.9, 0.0, end, std::nextafter(end, 2.0), 1.0, 100.0, 1.5;
    const Eigen::ArrayXXd values = problem.amplitudes(t);
    ArrayXd expected(7);
    expected << -1.9, 0.0, 0.0, -std::nextafter(end, 2.0), 0.0, -100.0, -1.5;
    BOOST_TEST((values.row(stress).transpose() == expected).all());
    for (Index i = 0; i < t.size(); ++i)
        BOOST_TEST((values.col(i) == problem.amplitudes(one(t(i))).col(0)).all());
    BOOST_TEST(problem.amplitudes(ArrayXd(0)).cols() == 0);
}

BOOST_AUTO_TEST_CASE(rests_follow_the_phases) {
    const Solution solution = parse_solution("u = 0\n[[phase]]\nuntil = 1\n"
                                             "theta = \"x*(1-x)*exp(x*t)\"\n"
                                             "[[phase]]\ntheta = \"x*(1-x)*exp(x*t^2)\"\n",
                                             "my.toml");
    const ProblemData problem = manufactured_problem({solution, papers_beam, 2.0});
    const auto theta = [&](double x, double t) {
        return field_value(problem.exact->theta, problem, x, t);
    };
    BOOST_TEST(!problem.exact->theta.is_separable());
    BOOST_TEST(theta(0.5, 0.5) == 0.25 * std::exp(0.25));
    BOOST_TEST(theta(0.5, 1.0) == 0.25 * std::exp(0.5));
    BOOST_TEST(theta(0.5, 1.5) == 0.25 * std::exp(1.125));
}

// Phases, and a part that a phase does not have; points whose times go back and forth.
BOOST_AUTO_TEST_CASE(what_does_not_separate_is_the_same_together_as_alone) {
    const auto solution = parse_solution(R"toml(
        name = "two-phases"
        theta = "sin(pi*x*(1 + t*(1 - x)))"
        [[phase]]
        until = "0.5"
        u = "x^2*exp(x*t)/100"
        [[phase]]
        u = "x^2*exp(x/2)*cos(x*(t - 1/2))/100"
    )toml",
                                         "two-phases");
    const Beam beam = {0.017, 0.1, 0.0, {}};
    const ProblemData problem = manufactured_problem({solution, beam, 1.0});
    const std::vector<SpaceTimeFunction> functions{
        problem.heat_source.rest, problem.moment_load.rest, problem.exact->u_xx.rest};
    BOOST_TEST(are_same(problem.curvature_initial.rest, problem.exact->u_xx.rest));
    BOOST_TEST(!are_same(problem.heat_source.rest, problem.exact->u_xx.rest));
    BOOST_TEST(!!*functions.front().target<FamilyMember>()->family); // else each goes alone
    const JointFunctions together = in_one(functions);
    ArrayXd x(5), t(5);
    x << 0.1, 0.9, 0.4, 1.0, 0.0;
    t << 0.2, 0.8, 0.5, 0.5, 0.9;
    const Eigen::ArrayXXd values = together(x, t);
    BOOST_REQUIRE(values.rows() == 3);
    BOOST_REQUIRE(values.cols() == 5);
    for (Index i = 0; i < x.size(); ++i)
        for (Index f = 0; f < 3; ++f) {
            const double alone = functions[static_cast<std::size_t>(f)](x.segment(i, 1), t(i))(0);
            BOOST_TEST(std::abs(values(f, i) - alone) <= 1e-14 * (1.0 + std::abs(alone)));
        }
    // The same for functions that know of no family.
    const JointFunctions strangers =
        in_one({SpaceTimeFunction(functions[0].target<FamilyMember>()->alone), functions[1]});
    BOOST_TEST((strangers(x, t) - values.topRows(2)).abs().maxCoeff() <= 1e-13);
}

BOOST_AUTO_TEST_CASE(phases_after_the_final_time_do_no_harm) {
    const Solution solution =
        parse_solution("theta = \"t*sin(pi*x)\"\n[[phase]]\nuntil = 2\nu = \"x^2*t\"\n"
                       "[[phase]]\nuntil = 3\nu = \"x^2*log(t - 2)\"\n[[phase]]\nu = \"x*t\"\n",
                       "my.toml");
    const ProblemData problem = manufactured_problem({solution, {0.5, 0.1, 0.0, {}}, 2.0});
    BOOST_TEST(field_value(problem.exact->u, problem, 0.5, 2.0) == 0.5);
    BOOST_TEST(problem.heat_source.is_separable());
}

// exp(1000x) overflows although exp(1000(x − 1) − t) does not.
BOOST_AUTO_TEST_CASE(products_that_overflow_by_themselves_are_not_taken_apart) {
    const Solution solution =
        parse_solution("theta = \"x*(1-x)*exp(1000*(x - 1 - t))\"\nu = 0\n", "my.toml");
    const ProblemData problem = manufactured_problem({solution, {}, 2.0});
    for (const double t : {0.0, 0.01, 0.5, 2.0}) {
        const double expected = 0.9 * 0.1 * std::exp(1000.0 * (0.9 - 1.0 - t));
        BOOST_TEST(std::abs(field_value(problem.exact->theta, problem, 0.9, t) - expected) <=
                   1e-12 * expected);
    }
}

// The argument moves by 20 t along the beam: 40 are too many for a few places in x to show it.
// Its size would be a number of some 10^18 digits; 2^1000, of 302, is one that a formula may hold.
BOOST_AUTO_TEST_CASE(a_profile_of_no_size_that_can_be_written_has_none) {
    const auto profile = [](const std::string& text) {
        return scaled_profile(
            parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table()));
    };
    BOOST_TEST(!profile("sinh((1 + x)^60)/(1 + sinh((1 + x)^60)^2)").function);
    BOOST_TEST(bool(profile("2^1000*sin(x)").function));
}

// As they stand one is no double but 0, one is below 2^-1060, where doubles have 14 binary digits
// left at most; of the last, which is greatest at x = 1, far above what its coefficients suggest,
// an amplitude of 1/3, times its size, must stay a normal double.
BOOST_AUTO_TEST_CASE(a_profile_below_normal_doubles_keeps_its_digits) {
    const auto profile = [](const std::string& text) {
        return scaled_profile(
            parse_expression(SourceText(text, {"file", 1, 1}), model_symbol_table()));
    };
    const ScaledProfile none = profile("x^5/(3*2^800*2^600*2^600)");
    const ScaledProfile lowest = profile("x^5/(3*2^530*2^530)");
    const ScaledProfile low = profile("1/(1 + exp(731*(1 - 0.0926*x)))");
    for (const ScaledProfile& one : {none, lowest}) {
        BOOST_REQUIRE(bool(one.function));
        const Eigen::ArrayXd values = one.function(Eigen::ArrayXd{{0.3, 0.6}});
        BOOST_TEST(std::abs(values(1) / values(0) - 32.0) <= 1e-13);
    }
    BOOST_REQUIRE(bool(low.function));
    BOOST_TEST(GiNaC::ex_to<GiNaC::numeric>(low.size).to_double() / 3.0 >=
               std::numeric_limits<double>::min());
}

// exp(-K (x - c)^2) with the square multiplied out: 1 at c, and below 2^-900 in all 33 places that
// are looked at first.
BOOST_AUTO_TEST_CASE(a_spike_is_not_taken_for_a_tiny_profile) {
    const ScaledProfile profile = scaled_profile(parse_expression(
        SourceText("exp(-(x - 0.031)*x*2700000 - 648.675)", {"file", 1, 1}), model_symbol_table()));
    BOOST_REQUIRE(bool(profile.function));
    const double peak = profile.function(Eigen::ArrayXd{{0.0155}})(0);
    BOOST_TEST(std::isfinite(peak * peak));
    BOOST_TEST(std::abs(peak * GiNaC::ex_to<GiNaC::numeric>(profile.size).to_double() - 1.0) <=
               1e-11);
}

BOOST_AUTO_TEST_CASE(a_source_that_steepens_with_time_is_gentle_for_a_while) {
    const ModelSymbols& symbols = model_symbols();
    const auto is_gentle = [&](const GiNaC::ex& formula, double final_time) {
        ProblemBuilder builder({{0.0, std::numeric_limits<double>::infinity()}}, final_time);
        const Field field = builder.field({formula});
        BOOST_REQUIRE(field.rest);
        return field.gentle;
    };
    const GiNaC::ex slow = sin(20 * symbols.x * symbols.t);
    BOOST_TEST(is_gentle(slow, 1.9));
    BOOST_TEST(!is_gentle(slow, 2.1));
    // tanh has poles: a quarter of that.
    const GiNaC::ex layer = tanh(20 * symbols.x * symbols.t);
    BOOST_TEST(is_gentle(layer, 0.49));
    BOOST_TEST(!is_gentle(layer, 0.51));
    // Powers of t add up, each at the final time; of x, by the chain rule.
    const GiNaC::ex curved = cos(symbols.x * symbols.x * (1 + GiNaC::pow(symbols.t, 2)));
    BOOST_TEST(is_gentle(curved, 4.3)); // 2 (1 + t^2) = 38.98
    BOOST_TEST(!is_gentle(curved, 4.4));
}

BOOST_AUTO_TEST_CASE(a_beam_is_taken_at_its_shortest_decimal) {
    const Solution solution =
        parse_solution("theta = \"alpha*x*(1-x)*(1000/17)*t\"\nu = 0\n", "my.toml");
    const ProblemData problem = manufactured_problem({solution, papers_beam, 1.0});
    BOOST_TEST(field_value(problem.exact->theta, problem, 0.5, 1.0) == 0.25);
}

BOOST_AUTO_TEST_CASE(given_data_are_the_problem) {
    GivenData data = given("5*sin(2*pi*t)");
    data.theta0 = SourceText("2*sin(pi*x)", {"scene.toml", 2, 11});
    data.u0 = SourceText("g2*x^2", {"scene.toml", 3, 7});
    data.heat_source = SourceText("x*t + alpha", {"scene.toml", 4, 16});
    const ProblemData problem = given_problem(data, papers_beam, 2.0);
    BOOST_TEST(!problem.exact.has_value());
    BOOST_TEST(!problem.end_moment.has_value());
    BOOST_TEST(problem.couple_load.is_zero());
    const auto value = [&](const Field& field, double x, double t) {
        return field_value(field, problem, x, t);
    };
    for (const double x : {0.0, 0.3, 1.0}) {
        BOOST_TEST(std::abs(value(problem.theta_initial, x, 0.0) - 2.0 * std::sin(pi * x)) < 1e-15);
        BOOST_TEST(std::abs(value(problem.curvature_initial, x, 0.0) - 0.2) < 1e-15);
        for (const double t : {0.1, 0.8}) {
            const double q = 5.0 * std::sin(2.0 * pi * t);
            BOOST_TEST(std::abs(value(problem.heat_source, x, t) - (x * t + 0.017)) < 1e-15);
            BOOST_TEST(std::abs(value(problem.body_force, x, t) - q) < 1e-14);
            BOOST_TEST(std::abs(value(problem.moment_load, x, t) - q * (1 - x) * (1 - x) / 2) <
                       1e-14);
        }
    }
}

// Of the paper's solution u_xxxt = −3 g2 (√2 − t) up to t = √2 and 0 after it, θ = e^t sin πx, and
// u0 = 0, so that u_xx is zero at the start.
BOOST_AUTO_TEST_CASE(a_defect_knows_the_run_and_the_solution_in_its_phases) {
    const Solution solution = papers_solution();
    GivenData defect;
    defect.heat_source = SourceText("-alpha*h/2*u_xxxt", {"scene.toml", 2, 16});
    defect.moment_load = SourceText("dt*theta_x*x", {"scene.toml", 3, 16});
    defect.theta0 = SourceText("theta*u_xx + h", {"scene.toml", 4, 10});
    const ProblemData added = given_defect(defect, &solution, papers_beam, 2.0, 0.1, 1e-3);
    for (const double t : {0.5, 1.4, 1.5, 2.0})
        for (const double x : {0.0, 0.4, 1.0}) {
            const double u_xxxt = t < std::sqrt(2.0) ? -0.3 * (std::sqrt(2.0) - t) : 0.0;
            BOOST_TEST(std::abs(field_value(added.heat_source, added, x, t) -
                                -0.017 * 0.05 * u_xxxt) < 1e-18);
            const double moment = 1e-3 * std::exp(t) * pi * std::cos(pi * x) * x;
            const double slope =
                1e-3 * std::exp(t) * pi * (std::cos(pi * x) - pi * x * std::sin(pi * x));
            BOOST_TEST(std::abs(field_value(added.moment_load, added, x, t) - moment) < 1e-15);
            BOOST_TEST(std::abs(field_value(added.couple_load, added, x, t) + slope) < 1e-15);
            BOOST_TEST(std::abs(field_value(added.theta_initial, added, x, 0.0) - 0.1) < 1e-16);
            BOOST_TEST(std::abs(amplitude_value(added.end_moment, added, t) -
                                1e-3 * std::exp(t) * pi) < 1e-15);
        }
}

BOOST_DATA_TEST_CASE(body_forces_have_their_moments,
                     data::make({"1", "x", "(x-1)^3*t + 2*x^5 - t", "exp(x)*t", "sin(20*x)",
                                 "exp(x*t) + x", "t/(1+x)", "sqrt(1 + x) + x*t"})) {
    const ProblemData problem = given_problem(given(sample), papers_beam, 2.0);
    for (const double t : {0.0, 0.7, 2.0})
        for (const double y : {0.0, 0.1, 0.6, 1.0}) {
            const auto moment = [&](double x) {
                return (x - y) * field_value(problem.body_force, problem, x, t);
            };
            const double expected = y < 1.0 ? integral(moment, y) : 0.0;
            BOOST_TEST(std::abs(field_value(problem.moment_load, problem, y, t) - expected) <
                       1e-13);
        }
}

BOOST_AUTO_TEST_CASE(given_data_that_break_a_rule_are_refused_at_their_place) {
    const auto refused_at = [](const GivenData& data, const Beam& beam, const std::string& start) {
        BOOST_CHECK_EXCEPTION(
            given_problem(data, beam, 2.0), InputError, [&](const InputError& error) {
                BOOST_TEST_INFO(error.what());
                BOOST_TEST(std::string(error.what()).substr(0, start.size()) == start);
                return true;
            });
    };
    const auto deflected = [](const std::string& u) {
        GivenData data;
        data.u0 = SourceText(u, {"scene.toml", 3, 7});
        return data;
    };
    refused_at(given("5*sin(2*pi*s)"), papers_beam, "scene.toml:5:26: unknown symbol 's'");
    refused_at(given("1/(t-1)"), papers_beam, "scene.toml:5:15: body_force is not finite");
    refused_at(given("g1"), {}, "scene.toml:5:15: 'g1' is used");
    refused_at(deflected("x^2*t"), papers_beam, "scene.toml:3:11: unknown symbol 't'");
    refused_at(deflected("x^2 + 1"), papers_beam, "scene.toml:3:7: (5): u0(0) is 1");
    refused_at(deflected("x/100"), papers_beam, "scene.toml:3:7: (5): the slope of u0");
    refused_at(deflected("x^2"), papers_beam, "scene.toml:3:7: (6): u0(1) is 1");
    refused_at(deflected("x^(3/2)/100"), papers_beam, "scene.toml:3:7: u0'' is not finite");
}

// A run has theta_A and 0 at the ends from the first step on. What is left out begins at zero, and
// is heated from the end.
BOOST_AUTO_TEST_CASE(a_given_initial_temperature_has_the_end_values) {
    const Beam heated = {0.017, 0.1, 0.7, {-0.02, 0.1}};
    const auto refusal = [&](const std::string& theta) -> std::string {
        GivenData data;
        data.theta0 = SourceText(theta, {"scene.toml", 2, 11});
        try {
            given_problem(data, heated, 1.0);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    BOOST_TEST(refusal("1 + x") == "scene.toml:2:11: (10): theta0(0) is 1; it must be 0.7 = "
                                   "theta_A: subtract 3/10 - 3*x/10 from theta0");
    BOOST_TEST(refusal("1 + x - (3/10 - 3*x/10)") ==
               "scene.toml:2:11: (10): theta0(1) is 2; it must be 0: subtract 2*x from theta0");
    BOOST_TEST(refusal("1 + x - (3/10 - 3*x/10) - 2*x") == "");
    BOOST_TEST(refusal("sin(pi*x)").find("theta0(0) is 0; it must be 0.7 = theta_A") !=
               std::string::npos);
    BOOST_TEST(refusal("(theta_A + 1e-10)*(1 - x)")
                   .find("theta0(0) is 0.7000000001; it must be "
                         "0.7 = theta_A") != std::string::npos);
    BOOST_TEST(refusal("theta_A*cos(pi*x/2) + 2*sin(pi*x)") == "");
    BOOST_CHECK_NO_THROW(given_problem(GivenData(), heated, 1.0));
}

// Between the points of the grid, none of which a pole need hit, and on one.
BOOST_AUTO_TEST_CASE(given_data_with_a_pole_are_refused) {
    const auto refusal = [](const GivenData& data) -> std::string {
        try {
            given_problem(data, papers_beam, 1.0);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const auto heated = [](const std::string& source) {
        GivenData data;
        data.heat_source = SourceText(source, {"scene.toml", 4, 16});
        return data;
    };
    const std::string unbounded = " grows without bound towards x = ";
    for (const std::string pole : {"1/(x-0.3127)", "1/(x-0.3127)^2", "1 + t/(x-0.3127)^2"})
        BOOST_TEST(refusal(heated(pole))
                       .starts_with("scene.toml:4:16: heat_source" + unbounded + "0.3127, t = "),
                   refusal(heated(pole)));
    BOOST_TEST(refusal(heated("1/(t-0.505)")).find("t = 0.505 ") != std::string::npos);
    BOOST_TEST(refusal(given("tan(pi*x)"))
                   .starts_with("scene.toml:5:15: body_force" + unbounded + "0.5, t = "));
    BOOST_TEST(refusal(given("sin(pi*x)/(t-0.505)"))
                   .starts_with("scene.toml:5:15: body_force" + unbounded));
    GivenData start;
    start.theta0 = SourceText("theta_A*(1-x) + sin(pi*x)/(x-0.3127)", {"scene.toml", 2, 11});
    BOOST_TEST(refusal(start).starts_with("scene.toml:2:11: theta0" + unbounded));
    start.theta0.reset();
    // A weak one is seen next to a sample, here the one at 0.3075.
    start.u0 = SourceText("x^2*((x-0.3077)^2)^(3/4)/1e3", {"scene.toml", 3, 7});
    BOOST_TEST(refusal(start).starts_with("scene.toml:3:7: u0''" + unbounded));
    // Steep, and bounded.
    BOOST_TEST(refusal(heated("exp(-((x-0.3127)*1e4)^2) + tanh(1e4*(t-0.505))")) == "");
}

// From text to compiled problem, whatever the formulas: a problem or an InputError, in reasonable
// time. Factors in front make most of them admissible. Fixed seeds.
BOOST_AUTO_TEST_CASE(any_formulas_are_a_problem_or_an_input_error) {
    std::mt19937 random(31);
    const auto below = [&random](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    const std::vector<std::string> leaves = {"x",  "t", "alpha", "zeta",
                                             "pi", "2", "0.3",   "theta_A"};
    const std::vector<std::string> functions = {"sin",  "cos",  "tan",  "asin", "acos", "atan",
                                                "sinh", "cosh", "tanh", "exp",  "log",  "sqrt"};
    const std::function<std::string(int)> formula = [&](int depth) -> std::string {
        if (depth == 0 || below(8) == 0)
            return leaves[below(leaves.size())];
        const std::string left = "(" + formula(depth - 1) + ")";
        if (below(3) == 0)
            return functions[below(functions.size())] + left;
        const std::string right = "(" + formula(depth - 1) + ")";
        return left + "+-*/^+*"[below(7)] + right;
    };
    int accepted = 0;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 200; ++i) {
        const std::string theta = "x*(1-x)*(" + formula(int(below(6))) + ")";
        const std::string u = "x^2*(" + formula(int(below(5))) + ")";
        std::string document = "theta = '";
        document.append(theta).append("'\nu = '").append(u).append("'\n");
        try {
            const Solution solution = parse_solution(document, "my.toml");
            const ProblemData problem = manufactured_problem({solution, {0.5, 0.25, 0.0, {}}, 2.0});
            BOOST_TEST(std::isfinite(field_value(problem.heat_source, problem, 0.4, 1.1)));
            ++accepted;
        } catch (const InputError&) {
            // Expected of many.
        }
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    BOOST_TEST(accepted > 40);
    // Some seconds at most even with sanitizers; a hang is minutes.
    BOOST_TEST(elapsed.count() < 120.0);
}

BOOST_AUTO_TEST_SUITE_END()

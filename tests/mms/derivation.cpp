#include "mms/derivation.hpp"
#include "core/problem.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/manufactured_problem.hpp"
#include "tests/suited_beam.hpp"

#include <boost/math/differentiation/autodiff.hpp>
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

// Every shipped solution a second time, as C++ that Boost.Math differentiates automatically. GiNaC
// and this share nothing but the paper.

namespace autodiff = boost::math::differentiation;
namespace data = boost::unit_test::data;
using Eigen::ArrayXd;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_derivation)

namespace {

constexpr double pi = 3.14159265358979323846;

const auto jet_variables = autodiff::make_ftuple<double, 3, 1>(0.5, 0.5);
using X = std::decay_t<decltype(std::get<0>(jet_variables))>;
using T = std::decay_t<decltype(std::get<1>(jet_variables))>;
/// A function of x and t with its derivatives up to ∂_x³ ∂_t.
using Jet = decltype(X() + T());

/// θ̃, u and σ̃ at a point; σ̃ with its derivative in x.
struct Point {
    Jet theta;
    Jet u;
    Jet sigma;
};

using Formula = std::function<Point(const X& x, const T& t, const Beam& beam)>;

double value(const T& t) {
    return t.derivative(0, 0);
}

Point copetti_fernandez(const X& x, const T& t, const Beam& beam) {
    const Jet shape = -3.0 * beam.stops.upper * (x * x * x / 6.0 - x * x / 2.0) + 0.0 * t;
    const Jet theta = exp(t) * sin(pi * x);
    if (value(t) <= std::sqrt(2.0))
        return {theta, shape * (std::sqrt(2.0) * t - t * t / 2.0), 0.0};
    return {theta, shape, -1.0 * t};
}

Point pressed_on_g1(const X& x, const T& t, const Beam& beam) {
    constexpr double release = 1.25;
    const Jet theta = cos(t) * x * (1.0 - x) * (1.0 + x);
    const Jet bump = beam.stops.upper * x * x * (1.0 - x) * (1.0 - x) * sin(t);
    const Jet bent = beam.stops.lower * (3.0 * x * x - x * x * x) / 2.0 + 0.0 * t;
    const T late = t - release;
    if (value(t) <= release)
        return {theta, bent + bump, late * late};
    return {theta, bent * exp(-late * late) + bump, 0.0};
}

Point free_oscillation(const X& x, const T& t, const Beam& /*beam*/) {
    return {sin(3.0 * t) * (sin(pi * x) + sin(2.0 * pi * x) / 2.0),
            x * x * (2.0 - x) * cos(2.0 * t) / 80.0, 0.0};
}

Point moving_front(const X& x, const T& t, const Beam& beam) {
    const Jet theta = beam.theta_A * (1.0 - x) + x * (1.0 - x) * tanh(5.0 * (x - 0.25 - t / 4.0)) +
                      sin(pi * x * (1.0 + t * (1.0 - x))) / 2.0;
    return {theta, x * x * exp(-x * t) / 100.0, 0.0};
}

Point heated_end(const X& x, const T& t, const Beam& beam) {
    const Jet decay = exp(-pi * pi * t) * sin(pi * x);
    const X bend = 1.0 - cos(pi * x);
    return {beam.theta_A * (1.0 - x) + decay,
            (x * x / 2.0 - x * x * x / 6.0) * sin(t) / 200.0 + bend * bend * t / 1000.0, 0.0};
}

/// (3 x² − x³)/2: one at the tip.
Jet bent(const X& x, const T& t) {
    return (3.0 * x * x - x * x * x) / 2.0 + 0.0 * t;
}

/// x² (1 − x)²: leaves the tip where it is.
X bump(const X& x) {
    return x * x * (1.0 - x) * (1.0 - x);
}

Point pressed_front(const X& x, const T& t, const Beam& beam) {
    return {sin(pi * x * (1.0 + t * (1.0 - x))) / 2.0,
            beam.stops.lower * bent(x, t) + beam.stops.upper * bump(x) * exp(-x * t), 1.0 + t};
}

Point released_from_g2(const X& x, const T& t, const Beam& beam) {
    const Jet theta = (1.0 + t) * sin(pi * x) + sin(2.0 * pi * x) / 4.0;
    const Jet moving = beam.stops.upper * bump(x) * cos(t);
    const Jet held = beam.stops.upper * bent(x, t);
    const T late = t - 0.75;
    if (value(late) <= 0.0)
        return {theta, held + moving, -late * late};
    return {theta, held / (1.0 + late * late * late) + moving, 0.0};
}

Point touch_without_force(const X& x, const T& t, const Beam& beam) {
    const T late = t - 1.0;
    return {cos(t) * sin(pi * x),
            beam.stops.upper * (bent(x, t) * (1.0 - late * late) + bump(x) * sin(t)), 0.0};
}

Point three_phases(const X& x, const T& t, const Beam& beam) {
    const Jet theta = exp(-t) * sin(pi * x);
    const Jet moving = beam.stops.upper * bump(x) * sin(t);
    const Jet held = beam.stops.upper * bent(x, t);
    const T early = 0.5 - t;
    const T late = t - 1.25;
    if (value(early) >= 0.0)
        return {theta, held * (1.0 - 8.0 * early * early * early) + moving, 0.0};
    if (value(late) <= 0.0)
        return {theta, held + moving, -8.0 * early * early * late * late};
    return {theta, held * exp(-late * late * late) + moving, 0.0};
}

Point impact(const X& x, const T& t, const Beam& beam) {
    const Jet theta = cos(t) * sin(pi * x);
    const Jet moving = beam.stops.upper * bump(x) * sin(t);
    if (value(t) <= 1.0)
        return {theta, beam.stops.upper * bent(x, t) * t + moving, 0.0};
    return {theta, beam.stops.upper * bent(x, t) + moving, 1.0 - t};
}

Point end_moment(const X& x, const T& t, const Beam& /*beam*/) {
    return {cos(2.0 * t) * x * (1.0 - x) * exp(x), x * x * sin(2.0 * t) / 60.0, 0.0};
}

Point stiff_layer(const X& x, const T& t, const Beam& /*beam*/) {
    return {(1.0 + exp(-1000.0 * t)) * sin(pi * x), (1.0 - cos(pi * x)) * exp(-t) / 200.0, 0.0};
}

Point cubic_deflection(const X& x, const T& t, const Beam& beam) {
    return {beam.theta_A * (1.0 - x) + 0.0 * t, bent(x, t) * sin(2.0 * t) / 100.0, 0.0};
}

Point trigonometric_deflection(const X& x, const T& t, const Beam& beam) {
    const X bend = 1.0 - cos(pi * x);
    return {beam.theta_A * (1.0 - x) + 0.0 * t, bend * bend * sin(2.0 * t) / 400.0, 0.0};
}

Point uncoupled(const X& x, const T& t, const Beam& /*beam*/) {
    const X bend = 1.0 - cos(pi * x);
    return {exp(-t) * (sin(pi * x) + sin(3.0 * pi * x) / 3.0), bend * bend * sin(2.0 * t) / 400.0,
            0.0};
}

Point free_decay(const X& x, const T& t, const Beam& beam) {
    return {exp(-pi * pi * t) * sin(pi * x), x * x * exp(-t / beam.zeta) / 50.0, 0.0};
}

/// The stress is what (3) gives with G = 0.
Point force_driven(const X& x, const T& t, const Beam& beam) {
    const Jet stress =
        pi * pi * pi / 200.0 * sin(pi * x) * (sin(2.0 * t) + 2.0 * beam.zeta * cos(2.0 * t)) -
        beam.alpha * pi * exp(-t) * sin(2.0 * pi * x);
    return {exp(-t) * (1.0 - cos(2.0 * pi * x)) / 2.0, (1.0 - cos(pi * x)) * sin(2.0 * t) / 200.0,
            stress};
}

/// The tip, 1/2 (g1 + g2) + 3/4 (g2 − g1) sin 3t, and the law of the stops.
Point penalised_stops(const X& x, const T& t, const Beam& beam) {
    const auto [g1, g2, epsilon] = beam.stops;
    const double width = g2 - g1;
    const Jet tip = 0.5 * (g1 + g2) + 0.75 * width * sin(3.0 * t) + 0.0 * x;
    const Jet stress = tip > g2   ? Jet((g2 - tip) / epsilon)
                       : tip < g1 ? Jet((g1 - tip) / epsilon)
                                  : Jet(0.0 * tip);
    return {cos(t) * (sin(pi * x) + sin(2.0 * pi * x) / 3.0),
            tip * (3.0 * x * x - x * x * x) / 2.0 +
                width / 4.0 * x * x * (1.0 - x) * (1.0 - x) * cos(t),
            stress};
}

Point penalised_mixed(const X& x, const T& t, const Beam& beam) {
    const double g2 = beam.stops.upper;
    const Jet tip = g2 * (5.0 + t) / 4.0 + 0.0 * x;
    return {beam.theta_A * (1.0 - x) + sin(pi * x * (1.0 + t * (1.0 - x))) / 2.0,
            tip * bent(x, t) + g2 * bump(x) * exp(-x * t), (g2 - tip) / beam.stops.epsilon};
}

Point every_function(const X& x, const T& t, const Beam& beam) {
    const Jet inner = tan(x) * asin(t / 3.0) + acos(x / 2.0) * log(1.0 + t) + cos(x + t);
    return {beam.theta_A * (1.0 - x) + x * (1.0 - x) * inner,
            (x * x * atan(x) * cos(t) + x * x * x * x * x * x * x * exp(-t)) / 100.0,
            (exp(x + t) - exp(1.0 + t)) / 50.0};
}

Point every_function_pressed(const X& x, const T& t, const Beam& beam) {
    const Jet inner = sin(x + t) + tanh(x) * cosh(t) + sqrt(1.0 + x) * sinh(t);
    return {beam.theta_A * (1.0 - x) + x * (1.0 - x) * inner,
            beam.stops.upper * (bent(x, t) + bump(x) * (sinh(x + t) + cosh(x) * sin(t))),
            -1.0 - t + (1.0 - x) * cosh(x + t) / 10.0};
}

Point mixed(const X& x, const T& t, const Beam& beam) {
    return {beam.theta_A * (1.0 - x) + x * (1.0 - x) * atan(2.0 * x * (1.0 + t) - 1.0),
            x * x * exp(-x * t) / 100.0, (1.0 - x) * (1.0 - x) * (1.0 - x) * cos(t) / 20.0};
}

Point jumping_front(const X& x, const T& t, const Beam& beam) {
    const Jet steady = beam.theta_A * (1.0 - x) + 0.0 * t;
    const Jet late = t - 0.5 + 0.0 * x;
    if (value(t) <= 0.5)
        return {steady + x * (1.0 - x) * atan(2.0 * x * (1.0 + t) - 1.0),
                x * x * exp(-x * t) / 20.0, (1.0 - x) * (1.0 - x) * cos(t) / 20.0};
    return {steady + x * (1.0 - x) * (atan(3.0 * x - 1.0) + exp(x * late) - 1.0),
            x * x * (exp(-0.5 * x) + sin((1.0 + x) * late)) / 20.0,
            (1.0 - x) * (1.0 - x) * cos(2.0 * x * late + 0.5) / 20.0};
}

Point mixed_pressed(const X& x, const T& t, const Beam& beam) {
    return {beam.theta_A * (1.0 - x) + x * (1.0 - x) * log(1.0 + t + x * t),
            beam.stops.upper * (bent(x, t) + bump(x) * exp(-x * t)),
            -1.0 - t + x * (1.0 - x) * sin(2.0 * t) / 10.0};
}

Point sheared(const X& x, const T& t, const Beam& beam) {
    return {beam.theta_A * (1.0 - x) + cos(t) * sin(pi * x),
            (1.0 - cos(pi * x)) * sin(2.0 * t) / 200.0, (1.0 - x * x) * cos(t) / 20.0};
}

const std::map<std::string, Formula> counterparts = {
    {"copetti-fernandez-2011", copetti_fernandez},
    {"cubic-deflection", cubic_deflection},
    {"end-moment", end_moment},
    {"every-function", every_function},
    {"every-function-pressed", every_function_pressed},
    {"force-driven", force_driven},
    {"free-decay", free_decay},
    {"free-oscillation", free_oscillation},
    {"heated-end", heated_end},
    {"impact", impact},
    {"jumping-front", jumping_front},
    {"mixed", mixed},
    {"mixed-pressed", mixed_pressed},
    {"moving-front", moving_front},
    {"penalised-mixed", penalised_mixed},
    {"penalised-stops", penalised_stops},
    {"pressed-front", pressed_front},
    {"pressed-on-g1", pressed_on_g1},
    {"released-from-g2", released_from_g2},
    {"sheared", sheared},
    {"stiff-layer", stiff_layer},
    {"three-phases", three_phases},
    {"touch-without-force", touch_without_force},
    {"trigonometric-deflection", trigonometric_deflection},
    {"uncoupled", uncoupled},
};

Point at(const Formula& formula, double x, double t, const Beam& beam) {
    const auto variables = autodiff::make_ftuple<double, 3, 1>(x, t);
    return formula(std::get<0>(variables), std::get<1>(variables), beam);
}

/// A sum and the sum of the sizes of its terms, to which rounding errors are relative.
struct Sum {
    double value = 0.0;
    double size = 0.0;

    explicit Sum(const std::vector<double>& terms) {
        for (const double term : terms) {
            value += term;
            size += std::abs(term);
        }
    }
};

void check_near(double found, const Sum& expected, double scale) {
    BOOST_TEST(std::abs(found - expected.value) <= 1e-12 * std::max(expected.size, scale));
}

std::vector<std::string> shipped() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(TVBEAM_SOLUTIONS_DIR))
        names.push_back(entry.path().stem().string());
    return names;
}

const std::vector<Beam> beams = {
    {0.017, 0.1, 0.5, {-0.02, 0.1}},
    {2.5, 0.0, -0.3, {-0.02, 0.1}},
    {0.0, 3.0, 0.0, {-0.02, 0.1}},
};

double field_value(const Field& field, const ProblemData& problem, double x, double t) {
    const ArrayXd point = ArrayXd::Constant(1, x);
    double sum = field.rest ? field.rest(point, t)(0) : 0.0;
    for (const Field::Term& term : field.terms)
        sum += problem.amplitudes(ArrayXd::Constant(1, t))(term.amplitude, 0) *
               problem.profiles[static_cast<std::size_t>(term.profile)](point)(0);
    return sum;
}

double amplitude_value(const std::optional<Eigen::Index>& amplitude, const ProblemData& problem,
                       double t) {
    return amplitude ? problem.amplitudes(ArrayXd::Constant(1, t))(*amplitude, 0) : 0.0;
}

/// Floors of the scale that rounding is relative to: where all terms of a sum vanish together, what
/// their own computation rounded off counts, which is relative to the size of the fields
/// themselves.
constexpr double size_of_theta = 1.0;
constexpr double size_of_u = 1e-2;

void check_point(const Formula& formula, const Beam& beam, const ProblemData& problem,
                 const DerivedSolution& derived, double x, double t) {
    const Point here = at(formula, x, t, beam);
    const Point tip = at(formula, 1.0, t, beam);
    const Jet& theta = here.theta;
    const Jet& u = here.u;
    const Sum f(
        {theta.derivative(0, 1), -theta.derivative(2, 0), -beam.alpha * u.derivative(2, 1)});
    const double contact_stress = tip.sigma.derivative(0, 0);
    const Sum G({here.sigma.derivative(0, 0), u.derivative(3, 0), beam.zeta * u.derivative(3, 1),
                 beam.alpha * theta.derivative(1, 0)});
    const Sum m({tip.u.derivative(2, 0), beam.zeta * tip.u.derivative(2, 1)});
    const Sum q({here.sigma.derivative(1, 0)});
    const Sum load({contact_stress * (1.0 - x), beam.alpha * tip.theta.derivative(0, 0),
                    -u.derivative(2, 0), -beam.zeta * u.derivative(2, 1),
                    -beam.alpha * theta.derivative(0, 0)});

    const auto field = [&](const Field& g) { return field_value(g, problem, x, t); };
    check_near(field(problem.heat_source), f, size_of_theta);
    check_near(field(problem.couple_load), G, size_of_u);
    check_near(field(problem.body_force), q, size_of_u);
    check_near(field(problem.moment_load), load, size_of_u);
    check_near(amplitude_value(problem.end_moment, problem, t), m, size_of_u);
    check_near(field(problem.exact->theta), Sum({theta.derivative(0, 0)}), size_of_theta);
    check_near(field(problem.exact->theta_x), Sum({theta.derivative(1, 0)}), size_of_theta);
    check_near(field(problem.exact->u), Sum({u.derivative(0, 0)}), size_of_u);
    check_near(field(problem.exact->u_x), Sum({u.derivative(1, 0)}), size_of_u);
    check_near(field(problem.exact->u_xx), Sum({u.derivative(2, 0)}), size_of_u);
    check_near(amplitude_value(problem.exact->stress, problem, t), Sum({contact_stress}),
               here.sigma.derivative(1, 0) == 0.0 ? 0.0 : size_of_u);

    std::size_t phase = 0;
    while (t > derived.phases[phase].end_value)
        ++phase;
    const DerivedPhase& symbolic = derived.derived[phase];
    const Eigen::ArrayXXd values =
        compile_tape({symbolic.heat_source, symbolic.couple_load, symbolic.end_moment})
            .evaluate(ArrayXd::Constant(1, x), ArrayXd::Constant(1, t));
    check_near(values(0, 0), f, size_of_theta);
    check_near(values(1, 0), G, size_of_u);
    check_near(values(2, 0), m, size_of_u);
}

void check_start(const Formula& formula, const Beam& beam, const ProblemData& problem, double x) {
    const Point start = at(formula, x, 0.0, beam);
    check_near(field_value(problem.theta_initial, problem, x, 0.0),
               Sum({start.theta.derivative(0, 0)}), size_of_theta);
    check_near(field_value(problem.curvature_initial, problem, x, 0.0),
               Sum({start.u.derivative(2, 0)}), size_of_u);
}

} // namespace

BOOST_DATA_TEST_CASE(every_shipped_solution_has_a_counterpart, data::make(shipped())) {
    BOOST_TEST(counterparts.contains(sample));
}

// f, G, m and the solution itself, both as GiNaC derives them and as they arrive in a ProblemData,
// separated and compiled.
BOOST_DATA_TEST_CASE(derived_functions_agree_with_automatic_differentiation,
                     data::make(shipped()) * data::make({0, 1, 2}), name, which) {
    BOOST_REQUIRE(counterparts.contains(name));
    const Solution solution = read_solution(std::string(TVBEAM_SOLUTIONS_DIR "/") + name + ".toml");
    const Beam beam = suited(beams[static_cast<std::size_t>(which)], solution);
    const ProblemData problem = manufactured_problem({solution, beam, 2.0});
    const DerivedSolution derived = derive_on(solution, beam);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 60; ++i) {
        const double x = uniform(random);
        const double t = 2.0 * uniform(random);
        check_point(counterparts.at(name), beam, problem, derived, x, t);
    }
    for (const double x : ArrayXd::LinSpaced(11, 0.0, 1.0))
        check_start(counterparts.at(name), beam, problem, x);
}

// f has u with two derivatives in x, G with three: formulas that grow without bound are refused in
// time.
BOOST_AUTO_TEST_CASE(derivatives_that_grow_too_large_are_refused) {
    std::string product = "x^2";
    for (int i = 1; i <= 300; ++i)
        product += "*sin(" + std::to_string(i) + "*x)";
    const Solution solution =
        parse_solution("theta = \"sin(pi*x)\"\nu = \"" + product + "\"\n", "my.toml");
    BOOST_CHECK_EXCEPTION(derive_on(solution, {}), InputError, [](const InputError& error) {
        const std::string what = error.what();
        return what.find("my.toml:2:6: u: the derivatives are too large") == 0;
    });
}

// The algebra takes negative factors out of this root of a product and in again, without an end.
BOOST_AUTO_TEST_CASE(a_root_of_a_product_with_negative_factors_is_no_endless_one) {
    for (const std::string theta :
         {"x*(1 - x)/sqrt((tanh(-pi)/(t + 3))/((x - t + 4)*tanh(-pi^12)))",
          "x*(1 - x)*sin(x/sqrt((tanh(-pi)/tanh(-2))/(tanh(-5)*tanh(-pi^12))))"})
        BOOST_CHECK_NO_THROW(
            manufactured_problem({parse_solution("theta = '" + theta + "'\nu = '0'\n", "my.toml"),
                                  {0.1, 0.1, 0.0, {}},
                                  1.0}));
}

BOOST_AUTO_TEST_SUITE_END()

// Exact solutions in C++, differentiated automatically: the same problem as the text gives, and the
// same rules.

#include "core/run.hpp"
#include "mms/autodiff_problem.hpp"
#include "mms/manufactured_problem.hpp"
#include "tests/marching.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace data = boost::unit_test::data;
using Eigen::ArrayXd;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_autodiff)

namespace {

constexpr double pi = std::numbers::pi;

/// The paper's test problem: two phases in time.
struct CopettiFernandez {
    double g2;

    template <typename Real>
    Real theta(const Real& x, const Real& t) const {
        return exp(t) * sin(pi * x);
    }
    template <typename Real>
    Real u(const Real& x, const Real& t) const {
        const Real shape = -3.0 * g2 * (x * x * x / 6.0 - x * x / 2.0);
        if (t <= std::sqrt(2.0))
            return shape * (std::sqrt(2.0) * t - t * t / 2.0);
        return shape;
    }
    template <typename Real>
    Real sigma(const Real& t) const {
        if (t <= std::sqrt(2.0))
            return 0.0;
        return -t;
    }
};

struct MovingFront {
    template <typename Real>
    Real theta(const Real& x, const Real& t) const {
        return x * (1.0 - x) * tanh(5.0 * (x - 0.25 - t / 4.0)) +
               sin(pi * x * (1.0 + t * (1.0 - x))) / 2.0;
    }
    template <typename Real>
    Real u(const Real& x, const Real& t) const {
        return x * x * exp(-x * t) / 100.0;
    }
};

/// A solution whose functions are members that hold what can be called.
template <typename Theta, typename U>
struct Members {
    Theta theta;
    U u;
};

const Members stiff_layer{
    [](const auto& x, const auto& t) { return (1.0 + exp(-1000.0 * t)) * sin(pi * x); },
    [](const auto& x, const auto& t) { return (1.0 - cos(pi * x)) * exp(-t) / 200.0; }};

/// With an end temperature.
struct HeatedEnd {
    double theta_A;

    template <typename Real>
    Real theta(const Real& x, const Real& t) const {
        return theta_A * (1.0 - x) + exp(-pi * pi * t) * sin(pi * x);
    }
    template <typename Real>
    Real u(const Real& x, const Real& t) const {
        const Real bend = 1.0 - cos(pi * x);
        return (x * x / 2.0 - x * x * x / 6.0) * sin(t) / 200.0 + bend * bend * t / 1000.0;
    }
};

/// The stress depends on x: a body force.
struct ForceDriven {
    Beam beam;

    template <typename Real>
    Real theta(const Real& x, const Real& t) const {
        return exp(-t) * (1.0 - cos(2.0 * pi * x)) / 2.0;
    }
    template <typename Real>
    Real u(const Real& x, const Real& t) const {
        return (1.0 - cos(pi * x)) * sin(2.0 * t) / 200.0;
    }
    template <typename Real>
    Real sigma(const Real& x, const Real& t) const {
        return pi * pi * pi / 200.0 * sin(pi * x) *
                   (sin(2.0 * t) + 2.0 * beam.zeta * cos(2.0 * t)) -
               beam.alpha * pi * exp(-t) * sin(2.0 * pi * x);
    }
};

ProblemData in_cpp(const std::string& name, const Beam& beam) {
    if (name == "copetti-fernandez-2011")
        return autodiff_problem(CopettiFernandez{beam.stops.upper}, beam, 2.0);
    if (name == "moving-front")
        return autodiff_problem(MovingFront{}, beam, 2.0);
    if (name == "stiff-layer")
        return autodiff_problem(stiff_layer, beam, 2.0);
    if (name == "heated-end")
        return autodiff_problem(HeatedEnd{beam.theta_A}, beam, 2.0);
    return autodiff_problem(ForceDriven{beam}, beam, 2.0);
}

ProblemData as_text(const std::string& name, const Beam& beam) {
    return manufactured_problem(
        {read_solution(std::string(TVBEAM_SOLUTIONS_DIR "/") + name + ".toml"), beam, 2.0});
}

const std::vector<std::string> names{"copetti-fernandez-2011", "moving-front", "stiff-layer",
                                     "heated-end", "force-driven"};

Beam beam_of(const std::string& name) {
    return {.alpha = 0.3,
            .zeta = 0.1,
            .theta_A = name == "heated-end" ? 0.5 : 0.0,
            .stops = {-0.02, 0.1}};
}

double amplitude(const ProblemData& problem, const std::optional<Eigen::Index>& index, double t) {
    return index ? problem.amplitudes(ArrayXd::Constant(1, t))(*index, 0) : 0.0;
}

/// Largest difference of two functions of x and t at the points, over the largest value.
double difference(const ArrayXd& found, const ArrayXd& expected) {
    const double size = expected.abs().maxCoeff();
    const double largest = (found - expected).abs().maxCoeff();
    return size > 0.0 ? largest / size : largest;
}

std::vector<Norm> all_norms() {
    std::vector<Norm> norms;
    for (const auto& name : Norm::names())
        norms.push_back(*Norm::named(name));
    return norms;
}

} // namespace

// Two derivations that share nothing but the formula: GiNaC's and Boost.Math's. The second
// derivative in x and the first in t of functions that vary over a length of 1/5 and a time of
// 1/1000 lose about three digits.
BOOST_DATA_TEST_CASE(a_solution_in_cpp_makes_the_problem_that_its_text_makes, data::make(names),
                     name) {
    const Beam beam = beam_of(name);
    const ProblemData found = in_cpp(name, beam);
    const ProblemData expected = as_text(name, beam);
    ArrayXd x = ArrayXd::Random(40).abs();
    x(0) = 0.0;
    x(1) = 1.0;
    const std::map<std::string, std::pair<const Field*, const Field*>> fields{
        {"f", {&found.heat_source, &expected.heat_source}},
        {"mu", {&found.moment_load, &expected.moment_load}},
        {"G", {&found.couple_load, &expected.couple_load}},
        {"q", {&found.body_force, &expected.body_force}},
        {"theta", {&found.exact->theta, &expected.exact->theta}},
        {"theta_x", {&found.exact->theta_x, &expected.exact->theta_x}},
        {"u", {&found.exact->u, &expected.exact->u}},
        {"u_x", {&found.exact->u_x, &expected.exact->u_x}},
        {"u_xx", {&found.exact->u_xx, &expected.exact->u_xx}},
        {"theta0", {&found.theta_initial, &expected.theta_initial}},
        {"u_xx0", {&found.curvature_initial, &expected.curvature_initial}}};
    // Both sides of the change of phase, and the time itself, which belongs to the phase before it.
    for (const double t :
         {0.0, 0.001, 0.4, 1.1, std::sqrt(2.0), std::sqrt(2.0) + 1e-12, 1.7, 2.0}) {
        for (const auto& [what, pair] : fields)
            BOOST_TEST(difference(values(found, *pair.first, x, t),
                                  values(expected, *pair.second, x, t)) <= 1e-12,
                       what << " at t = " << t);
        BOOST_TEST(std::abs(amplitude(found, found.end_moment, t) -
                            amplitude(expected, expected.end_moment, t)) <= 1e-14);
        BOOST_TEST(std::abs(amplitude(found, found.exact->stress, t) -
                            amplitude(expected, expected.exact->stress, t)) <= 1e-14);
    }
}

// Sources that separate and sources that are evaluated at every point round differently; on the
// Hermite basis the difference grows like h⁻⁴.
BOOST_DATA_TEST_CASE(a_solution_in_cpp_has_the_errors_of_its_text, data::make(names), name) {
    const Beam beam = beam_of(name);
    ProblemData in_code = in_cpp(name, beam);
    const ProblemData in_text = as_text(name, beam);
    // Once for all runs, as a study has it.
    in_code.resolution = std::make_shared<const Resolution>(
        resolution_of(in_code, {Algorithm::direct, Algorithm::fixed_point}, all_norms(), 2.0));
    for (const Scheme& scheme : schemes_of("sdirk2")) {
        const RunRequest request{beam, Mesh::uniform(6), scheme, 2.0, 20, all_norms()};
        const RunResult found = run(request, in_code);
        const RunResult expected = run(request, in_text);
        BOOST_REQUIRE_MESSAGE(found.status == RunStatus::ok, found.reason);
        for (std::size_t k = 0; k < request.norms.size(); ++k)
            BOOST_TEST(std::abs(found.errors[k] - expected.errors[k]) <=
                           1e-10 * expected.errors[k] + 1e-14,
                       scheme << ", " << request.norms[k].name << ": " << found.errors[k] << " and "
                              << expected.errors[k]);
    }
}

namespace {

/// A solution put together from parts.
struct Parts {
    std::string name;
    std::function<Jet<2>(const Jet<2>& x, const Jet<2>& t)> theta;
    std::function<Jet<3>(const Jet<3>& x, const Jet<3>& t)> u;
    std::function<Jet<2>(const Jet<2>& t)> sigma;
};

const auto sine = [](const auto& x, const auto&) { return sin(pi * x); };
const auto small = [](const auto& x, const auto& t) { return x * x * t / 100.0; };
const auto none = [](const auto&) { return 0.0; };
/// Rises to g2 = 0.1 at t = 1 and is held there.
const auto pressed = [](const auto& x, const auto& t) {
    const auto bent = 0.1 * (3.0 * x * x - x * x * x) / 2.0;
    return t <= 1.0 ? bent * t : bent;
};

const Beam between_stops{.alpha = 0.017, .zeta = 0.1, .stops = {-0.02, 0.1}};

std::string refusal(const Parts& parts, const Beam& beam = between_stops) {
    try {
        autodiff_problem(parts, beam, 2.0);
    } catch (const InputError& error) {
        return error.what();
    }
    return "admissible";
}

void contains(const std::string& message, const std::vector<std::string>& parts) {
    for (const auto& part : parts)
        BOOST_TEST(message.find(part) != std::string::npos, "'" << part << "' in: " << message);
}

} // namespace

BOOST_AUTO_TEST_CASE(an_admissible_solution_is_not_refused) {
    BOOST_TEST(refusal({"mine", sine, small, none}) == "admissible");
    const auto held = [](const auto& t) { return t <= 1.0 ? 0.0 * t : 1.0 - t; };
    BOOST_TEST(refusal({"mine", sine, pressed, held}) == "admissible");
}

BOOST_AUTO_TEST_CASE(end_values_are_checked_as_for_a_text) {
    const auto lifted = [](const auto& x, const auto& t) { return x * x * t / 100.0 + 1e-3 * t; };
    contains(refusal({"mine", sine, lifted, none}),
             {"mine: (5): u(0,t) is 0.002 at t = 2; it must be 0", "x^2"});
    const auto turned = [](const auto& x, const auto& t) { return x * t / 100.0; };
    contains(refusal({"mine", sine, turned, none}),
             {"mine: (5): u_x(0,t) is 0.02 at t = 2; it must be 0"});
    const auto warm = [](const auto& x, const auto&) { return cos(pi * x / 2.0); };
    contains(refusal({"mine", warm, small, none}),
             {"mine: (10): theta(0,t) is 1 at t = 0; it must be 0 = theta_A"});
    const auto warm_tip = [](const auto& x, const auto& t) { return t * x; };
    contains(refusal({"mine", warm_tip, small, none}),
             {"mine: (10): theta(1,t) is 2 at t = 2; it must be 0"});
    Beam heated = between_stops;
    heated.theta_A = 0.5;
    contains(refusal({"mine", sine, small, none}, heated),
             {"mine: (10): theta(0,t) is 0 at t = 0; it must be 0.5 = theta_A"});
}

BOOST_AUTO_TEST_CASE(the_stops_and_the_sign_of_the_stress_are_checked_as_for_a_text) {
    const auto large = [](const auto& x, const auto& t) { return x * x * t; };
    contains(refusal({"mine", sine, large, none}),
             {"mine: (6): u(1,t) is 0.109971 at t = 0.109971; it must be at most g2 = 0.1",
              "it is greatest, 2, at t = 2 as far as was seen: multiply u by 0.05"});
    const auto rising = [](const auto& t) { return t - 1.0; };
    contains(refusal({"mine", sine, small, rising}),
             {"mine: (7): sigma(1,t) is -1 at t = 0", "must be 0 strictly between the stops"});
    const auto pulling = [](const auto& t) { return t <= 1.0 ? 0.0 * t : t - 1.0; };
    contains(refusal({"mine", sine, pressed, pulling}),
             {"mine: (8): sigma(1,t) is 1 at t = 2", "it must be at most 0", "its sign"});
    const auto pushing = [](const auto& t) { return -t; };
    contains(refusal({"mine", sine, small, pushing}, Beam{.zeta = 0.1}),
             {"mine: (7): sigma(1,t) is -2 at t = 2", "as the beam has no stops"});
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_is_refused_with_its_point) {
    const auto pole = [](const auto& x, const auto& t) { return sin(pi * x) / (t - 1.0); };
    contains(refusal({"mine", pole, small, none}), {"mine: theta is not finite at x = ", "t = 1 "});
    // u and u_x exist at x = 0, u_xx does not; the rule of the product meets 0·∞ sooner.
    const auto cusp = [](const auto& x, const auto& t) { return x * sqrt(x) * t / 100.0; };
    contains(refusal({"mine", sine, cusp, none}), {"mine: u", "is not finite at x = 0, t = "});
    BOOST_CHECK_THROW(autodiff_problem(stiff_layer, between_stops, 0.0), InputError);
}

// Phases are not declared: the check finds where one begins, and no jump where there is none.
BOOST_AUTO_TEST_CASE(a_jump_between_phases_is_found_with_its_time) {
    const auto late = [](const auto& x, const auto& t) {
        return x * x * (t <= std::sqrt(2.0) ? t : t + 1e-3) / 100.0;
    };
    contains(refusal({"mine", sine, late, none}),
             {"mine: (3): u_xx jumps by 2.0000", " at t = 1.41421, x = "});
    const auto falling = [](const auto& x, const auto& t) {
        return sin(pi * x) * (t <= 0.123 ? 1.0 + t : 1.2 - t);
    };
    contains(refusal({"mine", falling, small, none}),
             {"mine: (1): theta jumps by -0.04", "at t = 0.123, x = 0.599"});
    // A kink and a layer in time, be it thin, are no jumps.
    const auto kinked = [](const auto& x, const auto& t) {
        return x * x * (t <= 1.0 ? t : 2.0 - t) / 100.0;
    };
    for (const double rate : {1.0, 1e3, 1e6}) {
        const auto layer = [rate](const auto& x, const auto& t) {
            return sin(pi * x) * (2.0 - exp(-rate * t));
        };
        BOOST_TEST(refusal({"mine", layer, kinked, none}) == "admissible");
    }
}

BOOST_AUTO_TEST_SUITE_END()

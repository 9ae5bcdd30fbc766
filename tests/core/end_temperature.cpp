// The end temperature is taken up by the transformed problem (11)–(20): θ = θ̃ + θ_A (x − 1), which
// is zero at both ends, and σ = σ̃ − α θ_A. Its beam equation (13) in terms of the stress that
// contact (17)(18) is about is
//
//     σ̃ = −u_xxx − ζ u_xxxt − α θ_x + (G + α θ_A),
//
// so that the couple load has the constant α θ_A more, and μ = Ĝ + q̂ − m has α θ_A (1 − x) more.
// The heat equation (11) stays: θ_A (x − 1) has neither a derivative in t nor a second one in x.
// Without contact it is σ = −α θ_A that stands in the beam, and no load.

#include "tests/marching.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(end_temperature)

namespace {

constexpr double none = std::numeric_limits<double>::infinity();
constexpr int steps = 120;
constexpr double dt = 0.01;

struct Contact {
    const char* name;
    Stops stops;
    bool is_met;
};

std::ostream& operator<<(std::ostream& stream, const Contact& contact) {
    return stream << contact.name;
}

const std::vector<Contact> contacts{{"without stops", {-none, none, 0.0}, false},
                                    {"rigid stops", {-0.02, 0.1, 0.0}, true},
                                    {"penalised stops", {-0.02, 0.1, 1e-3}, true}};

Eigen::ArrayXd arm(const Eigen::ArrayXd& x) {
    return 1.0 - x;
}

/// θ̃, u and σ̃ are driven by a heat source and a couple load that swing the tip from stop to stop,
/// from θ̃(x,0) = θ_A (1 − x) + sin πx − sin 2πx and u_xx(x,0) = x/10, both with the end temperature
/// and transformed.
ProblemData problem(const Beam& beam, bool transformed) {
    const double lift = transformed ? 0.0 : beam.theta_A;
    const double constant = transformed ? beam.alpha * beam.theta_A : 0.0;
    ProblemData result;
    result.amplitude_count = 5;
    result.amplitudes = [=](const Eigen::ArrayXd& t) {
        Eigen::ArrayXXd values(5, t.size());
        values.row(0) = 1.0;
        values.row(1) = 20.0 * (5.0 * t.transpose()).cos();
        values.row(2) = -3.0 * (9.0 * t.transpose()).sin();
        values.row(3) = lift;
        values.row(4) = constant;
        return values;
    };
    const auto one = [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 0.0 * x + 1.0; };
    const auto heated = [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return (3.0 * x).sin(); };
    const auto waves = [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
        return (std::numbers::pi * x).sin() - (2.0 * std::numbers::pi * x).sin();
    };
    const auto bent = [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return x / 10.0; };
    result.profiles = {arm, one, heated, waves, bent};
    result.heat_source.terms = {{1, 2}};
    result.moment_load.terms = {{2, 0}, {4, 0}};
    result.couple_load.terms = {{2, 1}, {4, 1}};
    result.theta_initial.terms = {{0, 3}, {3, 0}};
    result.curvature_initial.terms = {{0, 4}};
    // At rest at the end temperature; the error is then the solution itself.
    result.exact = ExactSolution{
        .theta = {{{3, 0}}, {}}, .theta_x = {}, .u = {}, .u_x = {}, .u_xx = {}, .stress = {}};
    return result;
}

Beam without_end_temperature(Beam beam) {
    beam.theta_A = 0.0;
    return beam;
}

} // namespace

BOOST_DATA_TEST_CASE(every_step_is_that_of_the_transformed_problem,
                     data::make(all_schemes) * data::make(contacts) * data::make({0.7, -3.0}) *
                         data::make({1.0, 2.0}),
                     scheme, contact, theta_A, grading) {
    const Beam beam{.alpha = 0.8, .zeta = 0.05, .theta_A = theta_A, .stops = contact.stops};
    const Beam cold = without_end_temperature(beam);
    const Mesh mesh = MeshFamily{grading, {}}.with(9);
    const ProblemData heated = problem(beam, false);
    const ProblemData transformed = problem(beam, true);
    const auto with = make_solver(beam, heated, mesh, scheme, dt, Needs{});
    const auto without = make_solver(cold, transformed, mesh, scheme, dt, Needs{});
    // The sums that make up a step have terms of size 1 to 10; a reaction is a difference of tips
    // over the compliance of a step, κ/3 = 1/18. The iteration stops within 1e-13, and what it
    // leaves adds up over the steps.
    const double tolerance = scheme.algorithm == Algorithm::direct ? 2e-14 : 1e-10;
    int touching = 0;
    TimeLevels levels(transformed, scheme.time, dt * steps, steps);
    std::int64_t n = 0;
    march(*with, heated, scheme.time, dt, steps, [&](double) {
        BOOST_REQUIRE_EQUAL(without->step(levels.at(++n)), "");
        BOOST_TEST((with->temperature() - without->temperature()).cwiseAbs().maxCoeff() <=
                   tolerance);
        BOOST_TEST((with->curvature() - without->curvature()).abs().maxCoeff() <= tolerance);
        BOOST_TEST(std::abs(with->tip_displacement() - without->tip_displacement()) <= tolerance);
        BOOST_TEST(std::abs(with->contact_stress() - without->contact_stress()) <=
                   18.0 * tolerance);
        touching += with->contact_stress() != 0.0 ? 1 : 0;
    });
    BOOST_TEST((touching > 10) == contact.is_met);
    BOOST_TEST(touching < steps);
}

// The basis of sines and the error norms read the end temperature in their own ways.
BOOST_DATA_TEST_CASE(every_norm_of_a_run_is_that_of_the_transformed_problem,
                     data::make(all_runs) * data::make(contacts), scheme, contact) {
    const Beam beam{.alpha = 0.8, .zeta = 0.05, .theta_A = 0.7, .stops = contact.stops};
    RunRequest request{beam, Mesh::uniform(16), scheme, dt * steps, steps, {}};
    for (const std::string name : {"theta_L2L2", "theta_LinfL2", "u_LinfH2semi", "sigma_L2"})
        request.norms.push_back(*Norm::named(name));
    const RunResult with = run(request, problem(beam, false));
    request.beam = without_end_temperature(beam);
    const RunResult without = run(request, problem(beam, true));
    BOOST_REQUIRE_MESSAGE(with.status == RunStatus::ok, with.reason);
    BOOST_REQUIRE_MESSAGE(without.status == RunStatus::ok, without.reason);
    const double tolerance = scheme.algorithm == Algorithm::direct ? 1e-12 : 1e-8;
    for (std::size_t k = 0; k < request.norms.size(); ++k)
        BOOST_TEST(std::abs(with.errors[k] - without.errors[k]) <= tolerance * without.errors[k],
                   request.norms[k].name << ": " << with.errors[k] << " and " << without.errors[k]);
    BOOST_TEST((with.errors[3] > 0.0) == contact.is_met);
    BOOST_TEST(with.errors[0] > 0.01);
}

// What the transformation leaves out shows: without the constant in the load the two differ.
BOOST_AUTO_TEST_CASE(without_the_constant_load_the_problems_are_different) {
    const Beam beam{.alpha = 0.8, .zeta = 0.05, .theta_A = 0.7};
    const Scheme scheme{Algorithm::direct, ThermalMass::consistent, 0.0};
    const ProblemData heated = problem(beam, false);
    ProblemData wrong = problem(beam, true);
    wrong.moment_load.terms.pop_back();
    const Mesh mesh = Mesh::uniform(9);
    const auto with = make_solver(beam, heated, mesh, scheme, dt, Needs{});
    const auto without =
        make_solver(without_end_temperature(beam), wrong, mesh, scheme, dt, Needs{});
    march(*with, heated, scheme.time, dt, steps, [](double) {});
    march(*without, wrong, scheme.time, dt, steps, [](double) {});
    // u(1) = −∫ (1 − x) α θ_A (1 − x) dx = −α θ_A/3, once viscosity has yielded.
    BOOST_TEST(with->tip_displacement() - without->tip_displacement() ==
                   -beam.alpha * beam.theta_A / 3.0,
               boost::test_tools::tolerance(0.02));
}

BOOST_AUTO_TEST_SUITE_END()

// Patch tests: data that the spaces and implicit Euler represent exactly are reproduced to
// round-off, for each term alone.

#include "core/run.hpp"
#include "mms/manufactured_problem.hpp"
#include "mms/solution.hpp"
#include "tests/marching.hpp"

#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <string>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(exactness)

namespace {

/// Implicit Euler differences a function linear in t exactly; U is a cubic and Θ linear in x, so
/// the discrete solution is the exact one. Every line of `text` is a solution of this kind.
struct Patch {
    std::string term; ///< what it exercises
    Beam beam;
    std::string text;
};

std::ostream& operator<<(std::ostream& stream, const Patch& patch) {
    return stream << patch.term;
}

const std::string cubic = "(x^3/6 - x^2/2)"; // curvature x − 1, tip −1/3

const std::vector<Patch> patches{
    {"shear load, elastic",
     {.alpha = 0.0, .zeta = 0.0},
     "theta = '0'\nu = '" + cubic + "*(1 + t)'"},
    {"viscosity", {.alpha = 0.0, .zeta = 0.7}, "theta = '0'\nu = '" + cubic + "*(1 + t)'"},
    {"end moment", {.alpha = 0.0, .zeta = 0.7}, "theta = '0'\nu = 'x^2*(2 - t)'"},
    {"beam heats: alpha u_xxt against the source",
     {.alpha = 1.3, .zeta = 0.1},
     "theta = '0'\nu = '" + cubic + "*(1 + t)'"},
    {"heat bends: end temperature",
     {.alpha = 1.3, .zeta = 0.1, .theta_A = 2.0},
     "theta = 'theta_A*(1 - x)'\nu = '0*x'"},
    {"all terms without contact",
     {.alpha = 1.3, .zeta = 0.4, .theta_A = -2.0},
     "theta = 'theta_A*(1 - x)'\nu = '" + cubic + "*(1 + t) - x^2*t'"},
    {"contact at g2",
     {.alpha = 0.9, .zeta = 0.2, .stops = {-0.02, 0.1}},
     "theta = '0'\nu = '-3*g2*" + cubic + "'\nsigma = '-1 - t'"},
    {"contact at g1",
     {.alpha = 0.9, .zeta = 0.2, .stops = {-0.02, 0.1}},
     "theta = '0'\nu = '-3*g1*" + cubic + "'\nsigma = '1 + t'"},
    {"contact at g2 while the shape moves",
     {.alpha = 0.9, .zeta = 0.2, .theta_A = 0.5, .stops = {-0.02, 0.1}},
     "theta = 'theta_A*(1 - x)'\nu = '-3*g2*" + cubic + " + t*x^2*(1 - x)/9'\nsigma = '-4 - t'"},
};

} // namespace

BOOST_DATA_TEST_CASE(representable_data_are_reproduced_to_round_off,
                     data::make(patches) * data::make(all_schemes) * data::make({1, 2, 5, 16}),
                     patch, scheme, elements) {
    const double final_time = 1.5;
    const ProblemData problem =
        manufactured_problem({parse_solution(patch.text, "patch"), patch.beam, final_time});
    // The moment form keeps round-off; the Hermite form multiplies it by the condition of B, h⁻⁴,
    // and by the tolerance of its iteration.
    const double s = elements;
    const double bound =
        scheme.algorithm == Algorithm::direct ? 1e-14 : 1e-14 * s * s * s * s + 1e-11;
    // The norms of u want nodal values; the others alone are measured in the sine basis.
    for (const auto& names : {std::vector<std::string>{"u_LinfL2", "u_LinfH1", "theta_LinfL2",
                                                       "u_LinfH2semi", "sigma_L2"},
                              {"theta_LinfL2", "u_LinfH2semi", "sigma_L2"}}) {
        std::vector<Norm> norms;
        for (const auto& name : names)
            norms.push_back(*Norm::named(name));
        const RunResult result =
            run({patch.beam, Mesh::uniform(elements), scheme, final_time, 30, norms}, problem);
        BOOST_REQUIRE_MESSAGE(result.status == RunStatus::ok, result.reason);
        for (std::size_t k = 0; k < norms.size(); ++k)
            BOOST_TEST(result.errors[k] <= 20.0 * bound, norms[k].name << " " << result.errors[k]);
    }
}

BOOST_DATA_TEST_CASE(stationary_heat_is_exact_at_the_nodes,
                     data::make(all_schemes) * data::make({2, 3, 10}), scheme, elements) {
    // −θ_xx = f has piecewise linear Galerkin solutions exact at the nodes: with θ = x(1 − x), f =
    // 2, nothing moves.
    const Beam beam{.alpha = 0.0, .zeta = 0.1};
    const ProblemData problem =
        manufactured_problem({parse_solution("theta = 'x*(1 - x)'\nu = '0'", "patch"), beam, 1.0});
    const Mesh mesh = Mesh::uniform(elements);
    const auto solver = make_solver(beam, problem, mesh, scheme, 0.05, Needs{});
    march(*solver, problem, scheme.time, 0.05, 20, [&](double) {
        BOOST_TEST(
            (solver->temperature().array() - mesh.nodes * (1.0 - mesh.nodes)).abs().maxCoeff() <=
            1e-15);
    });
}

BOOST_DATA_TEST_CASE(heat_source_warms_a_mode_as_the_discrete_eigenvalue_says,
                     data::make(schemes_of("euler")), scheme) {
    // With f = sin πx and α = 0, Θ stays a multiple of the discrete mode v_i = sin πx_i, an
    // eigenvector of M and K: Kv = k v with k = 2(1 − cos πh)/h, Mv = m v with m = h(2 + cos πh)/3
    // (lumped: h). The load of sin πx is 2(1 − cos πh)/(hπ²) v. One step: (m + Δt k) c¹ = Δt·load.
    const double pi = std::acos(-1.0);
    const Eigen::Index s = 8;
    const double h = 1.0 / static_cast<double>(s);
    const double dt = 0.3;
    const Beam beam{.alpha = 0.0, .zeta = 1.0};
    const ProblemData problem = forced_problem(
        {{[](double) { return 1.0; },
          [pi](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return (pi * x).sin(); }}});
    const Mesh mesh = Mesh::uniform(s);
    const double k = 2.0 * (1.0 - std::cos(pi * h)) / h;
    const double m =
        scheme.thermal_mass == ThermalMass::lumped ? h : h * (2.0 + std::cos(pi * h)) / 3.0;
    const double load = 2.0 * (1.0 - std::cos(pi * h)) / (h * pi * pi);
    double expected = 0.0;
    const auto solver = make_solver(beam, problem, mesh, scheme, dt, Needs{});
    march(*solver, problem, scheme.time, dt, 5, [&](double) {
        expected = (m * expected + dt * load) / (m + dt * k);
        BOOST_TEST(
            (solver->temperature().array() - expected * (pi * mesh.nodes).sin()).abs().maxCoeff() <=
            1e-14);
    });
}

BOOST_AUTO_TEST_SUITE_END()

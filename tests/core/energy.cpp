// Without sources the discrete energy ½ΘᵀMΘ + ½‖w‖² never grows: the step tested with (Θⁿ, wⁿ −
// wⁿ⁻¹) leaves −½‖Θⁿ − Θⁿ⁻¹‖² − ΔtΘᵀKΘ − ½‖wⁿ − wⁿ⁻¹‖² − (ζ/Δt)‖wⁿ − wⁿ⁻¹‖² + λ(uⁿ − uⁿ⁻¹)(1), and
// the last term is ≤ 0 when the tip was admissible before.

#include "core/run.hpp"
#include "tests/marching.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(energy_law)

namespace {

/// Random Θ⁰ in S_0^h and w⁰ in P1disc of the size given.
ProblemData random_state(const Mesh& mesh, double temperature, double curvature, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Eigen::Index s = mesh.elements();
    Eigen::ArrayXd nodal = Eigen::ArrayXd::Zero(s + 1);
    for (Eigen::Index i = 1; i < s; ++i)
        nodal(i) = temperature * uniform(random);
    DiscontinuousLinear w(2, s);
    for (Eigen::Index j = 0; j < s; ++j)
        for (Eigen::Index side = 0; side < 2; ++side)
            w(side, j) = curvature * uniform(random);
    const auto locate = [mesh](double x) {
        const Eigen::Index last = mesh.elements() - 1;
        return std::min(last, static_cast<Eigen::Index>(x * static_cast<double>(mesh.elements())));
    };
    ProblemData data;
    data.theta_initial.rest = [=](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return x.unaryExpr([&](double at) {
            const Eigen::Index j = locate(at);
            const double xi = (at - mesh.nodes(j)) / mesh.lengths(j);
            return (1.0 - xi) * nodal(j) + xi * nodal(j + 1);
        });
    };
    data.curvature_initial.rest = [=](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return x.unaryExpr([&](double at) {
            const Eigen::Index j = locate(at);
            const double xi = (at - mesh.nodes(j)) / mesh.lengths(j);
            return (1.0 - xi) * w(0, j) + xi * w(1, j);
        });
    };
    return data;
}

double energy(const Solver& solver, const Mesh& mesh, ThermalMass mass) {
    const Eigen::VectorXd inner = solver.temperature().segment(1, mesh.elements() - 1);
    const DiscontinuousLinear w = solver.curvature();
    const double bending =
        (mesh.lengths.transpose() * (w.row(0).square() + w.row(0) * w.row(1) + w.row(1).square()))
            .sum() /
        3.0;
    return 0.5 * inner.dot(thermal_mass_matrix(mesh, mass) * inner) + 0.5 * bending;
}

} // namespace

BOOST_DATA_TEST_CASE(energy_never_grows_without_sources,
                     data::make({ThermalMass::consistent, ThermalMass::lumped}) *
                         data::make({0.0, 1e-4, 1.0, 1e4, 1e8}) *
                         data::make({0.0, 1e-9, 1e-2, 1.0, 1e9}) *
                         data::make({1e-10, 1e-5, 1e-2, 1.0, 1e3}) * data::make({1, 2, 3, 17}),
                     mass, alpha, zeta, dt, elements) {
    const Mesh mesh = Mesh::uniform(elements);
    for (const bool stops : {false, true}) {
        ProblemData problem = random_state(mesh, 1.0, 1.0, static_cast<unsigned>(elements));
        Beam beam{.alpha = alpha, .zeta = zeta};
        const Scheme scheme{Algorithm::direct, mass, 0.0};
        if (stops) {
            // Stops that the initial tip touches from within, so that contact is likely.
            const double tip =
                make_solver(beam, problem, mesh, scheme, dt, Needs{})->tip_displacement();
            beam.stops = {std::min(tip, -1e-3), std::max(tip, 1e-3)};
        }
        const auto solver = make_solver(beam, problem, mesh, scheme, dt, Needs{});
        const double start = energy(*solver, mesh, mass);
        double before = start;
        march(*solver, problem, scheme.time, dt, 12, [&](double) {
            const double now = energy(*solver, mesh, mass);
            // Round-off of a sum of 3s squares of the initial size.
            BOOST_TEST(now <= before + 1e-14 * start);
            before = now;
        });
    }
}

BOOST_AUTO_TEST_CASE(energy_decays_to_zero_in_one_huge_elastic_step) {
    // ζ = 0 and Δt → ∞ leave the static solution without loads: zero.
    const Mesh mesh = Mesh::uniform(12);
    const ProblemData problem = random_state(mesh, 1.0, 1.0, 7);
    const Beam beam{.alpha = 0.5, .zeta = 0.0};
    const auto solver = make_solver(beam, problem, mesh, Scheme{}, 1e12, Needs{});
    march(*solver, problem, Scheme{}.time, 1e12, 1,
          [&](double) { BOOST_TEST(energy(*solver, mesh, ThermalMass::consistent) <= 1e-22); });
}

BOOST_AUTO_TEST_SUITE_END()

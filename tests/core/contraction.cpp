// The contraction of the paper's fixed point, predicted before it runs.

#include "core/contraction.hpp"
#include "core/hermite_form.hpp"
#include "tests/marching.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(fixed_point_contraction)

BOOST_DATA_TEST_CASE(prediction_is_the_closed_form,
                     data::make({ThermalMass::consistent, ThermalMass::lumped}) *
                         data::make({2, 3, 20, 400}) * data::make({1e-6, 1e-2, 1e3}),
                     mass, elements, dt) {
    // On a uniform mesh sin πx_i is an eigenvector of all matrices: M_c has h (2 + cos πh)/3, the
    // lumped M has h, K has 2 (1 − cos πh)/h.
    const Beam beam{.alpha = 0.7, .zeta = 0.03};
    const double h = 1.0 / elements;
    const double cosine = std::cos(std::numbers::pi * h);
    const double consistent = h * (2.0 + cosine) / 3.0;
    const double stiffness = 4.0 * std::pow(std::sin(std::numbers::pi * h / 2.0), 2) / h;
    const double m = mass == ThermalMass::lumped ? h : consistent;
    const double expected = 0.49 * dt / (dt + 0.03) * consistent / (m + dt * stiffness);
    BOOST_TEST(contraction(beam, Mesh::uniform(elements), mass, 1.0 / dt) == expected,
               boost::test_tools::tolerance(1e-10));
    BOOST_TEST(contraction(beam, Mesh::uniform(1), mass, 1.0 / dt) == 0.0);
}

// BDF2 solves with c = 3/(2Δt), and its first step, one of SDIRK2, with 1/(γΔt), about 2.3 times as
// much. Steps far below ζ contract less the shorter they are, steps far above 1/π² the longer.
BOOST_AUTO_TEST_CASE(the_greatest_contraction_is_that_of_whichever_step_contracts_least) {
    const Beam beam{.alpha = 0.7, .zeta = 0.03};
    const Mesh mesh = Mesh::uniform(20);
    const Scheme scheme{Algorithm::fixed_point, ThermalMass::lumped, 1e-14,
                        TimeScheme::named("bdf2")};
    const double gamma = 1.0 - std::sqrt(0.5);
    for (const double dt : {1e-4, 10.0}) {
        const double running = contraction(beam, mesh, ThermalMass::lumped, 1.5 / dt);
        const double starting = contraction(beam, mesh, ThermalMass::lumped, 1.0 / (gamma * dt));
        BOOST_TEST((running > starting) == (dt < 1.0));
        BOOST_TEST(greatest_contraction(beam, mesh, scheme, dt) == std::max(running, starting),
                   boost::test_tools::tolerance(1e-12));
    }
}

BOOST_DATA_TEST_CASE(measured_contraction_is_the_predicted_one, data::make(TimeScheme::names()),
                     time) {
    // The third change over the second, of a solve with the coefficient of the scheme's first
    // stage; the mode sin πx is the one that contracts least.
    ProblemData problem;
    problem.theta_initial.rest = [](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return (std::numbers::pi * x).sin();
    };
    const Mesh mesh = Mesh::uniform(12);
    for (const double alpha : {0.1, 0.8, 3.0})
        for (const double dt : {1e-3, 0.1}) {
            const Beam beam{.alpha = alpha, .zeta = 0.05};
            const Scheme scheme{Algorithm::fixed_point, ThermalMass::lumped, 1e-14,
                                TimeScheme::named(time)};
            HermiteForm form(beam, problem, mesh, scheme, dt);
            TimeLevels levels(problem, scheme.time, dt, 1);
            std::vector<double> changes;
            form.observe([&](const Solve& solve) {
                if (solve.stage == 0)
                    changes = form.temperature_changes();
            });
            if (!form.step(levels.at(1)).empty())
                changes = form.temperature_changes();
            BOOST_REQUIRE(changes.size() >= 3);
            const double c = scheme.time.at_step(1).stages.front().leading / dt;
            BOOST_TEST(changes[2] / changes[1] == contraction(beam, mesh, scheme.thermal_mass, c),
                       boost::test_tools::tolerance(1e-2));
        }
}

BOOST_AUTO_TEST_CASE(an_iteration_that_cannot_contract_is_refused_with_the_number) {
    // α²Δt/((Δt + ζ)(1 + π²Δt)) = 25/1.1/1.1 = 20.7 for α = 5, ζ = 0.001, Δt = 0.01; with Δt/100
    // it is 25·0.0001/0.0011 = 2.27.
    const ProblemData problem = forced_problem({{[](double) { return 1.0; }, {}}});
    for (const auto& [dt, number] : {std::pair{0.01, "20.7"}, {0.0001, "2.27"}}) {
        const RunResult result = run({{.alpha = 5.0, .zeta = 1e-3},
                                      Mesh::uniform(40),
                                      {Algorithm::fixed_point, ThermalMass::consistent, 1e-7},
                                      dt,
                                      1,
                                      {}},
                                     problem);
        BOOST_TEST((result.status == RunStatus::failed));
        BOOST_TEST(result.reason.find(number) != std::string::npos, result.reason);
        BOOST_TEST(result.reason.find("use the direct algorithm") != std::string::npos);
        BOOST_TEST(result.counters.steps == 0);
    }
}

namespace {

/// A beam that its couple load, −50, bends far past the stop g2, or would, were there one.
ProblemData pressing_load() {
    ProblemData problem;
    problem.theta_initial.rest = [](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return (std::numbers::pi * x).sin();
    };
    problem.couple_load.rest = [](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return Eigen::ArrayXd::Constant(x.size(), -50.0);
    };
    return problem;
}

constexpr Stops near_stops{-0.1, 0.1};

} // namespace

// Late changes, as those of the first iterations are of several modes.
BOOST_DATA_TEST_CASE(a_held_tip_s_contraction_is_the_predicted_one_and_better_than_a_free_one_s,
                     data::make({ThermalMass::consistent, ThermalMass::lumped}) *
                         data::make({0.01, 0.1}),
                     mass, dt) {
    const Mesh mesh = Mesh::uniform(12);
    const ProblemData problem = pressing_load();
    const Scheme scheme{Algorithm::fixed_point, mass, 1e-14, TimeScheme::named("euler")};
    for (const double alpha : {0.8, 1.1}) {
        const Beam beam{.alpha = alpha, .zeta = 1e-3, .stops = near_stops};
        HermiteForm form(beam, problem, mesh, scheme, dt);
        TimeLevels levels(problem, scheme.time, dt, 1);
        form.step(levels.at(1));
        BOOST_TEST(form.contact_stress() < 0.0);
        const auto& changes = form.temperature_changes();
        const auto late =
            std::ranges::find_if(changes, [](double change) { return change < 1e-9; });
        BOOST_REQUIRE((late - changes.begin() > 5 && late != changes.end()));
        const double held = contraction(beam, mesh, mass, 1.0 / dt, Tip::held);
        BOOST_TEST(*late / *std::prev(late) == held, boost::test_tools::tolerance(0.02));
        BOOST_TEST(held < 0.9 * contraction(beam, mesh, mass, 1.0 / dt));
    }
}

// With α = 1.1, ζ = 0, Δt = 0.01 the factor is 1.1 of a free tip and 0.91 of a held one.
BOOST_AUTO_TEST_CASE(a_held_iteration_that_contracts_is_not_refused_for_what_a_free_one_would_do) {
    const auto run_of = [](const ProblemData& problem, double alpha) {
        return run({{.alpha = alpha, .zeta = 0.0, .stops = near_stops},
                    Mesh::uniform(10),
                    {Algorithm::fixed_point, ThermalMass::consistent, 1e-10},
                    0.1,
                    10,
                    {}},
                   problem);
    };
    const RunResult held = run_of(pressing_load(), 1.1);
    BOOST_TEST((held.status == RunStatus::ok), held.reason);
    BOOST_TEST(held.counters.contact_steps == 10);
    ProblemData without_load = pressing_load();
    without_load.couple_load = {};
    const RunResult free = run_of(without_load, 1.1);
    BOOST_TEST((free.status == RunStatus::failed));
    BOOST_TEST(free.reason.find("where nothing holds the tip, each iteration multiplies the error "
                                "by 1.1, predicted") != std::string::npos,
               free.reason);
    const RunResult neither = run_of(pressing_load(), 5.0);
    BOOST_TEST(neither.reason.starts_with("the fixed-point iteration would not contract"),
               neither.reason);
    BOOST_TEST(neither.reason.find("where a stop holds the tip") != std::string::npos);
    BOOST_TEST(neither.counters.fixed_point_iterations == 0);
}

BOOST_AUTO_TEST_SUITE_END()

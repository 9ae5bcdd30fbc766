// What certifies a run from outside: the energy law, the residuals and contact, read from a
// solver's results.

#include "core/certify/energy_law.hpp"
#include "core/certify/contact_law.hpp"
#include "core/certify/residuals.hpp"
#include "core/worse.hpp"
#include "tests/marching.hpp"

#include <Eigen/LU>

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(energy_law_with_sources)

namespace {

/// Loads that swing the tip from one stop to the other, a strong coupling and a heated end.
const Beam swinging_beam{.alpha = 0.8, .zeta = 0.02, .theta_A = 0.3, .stops = {-0.02, 0.1}};

/// Their phase is known to round-off at every time: a radian takes 28 steps.
ProblemData swinging_problem(double dt) {
    const double rate = 1.0 / (28.0 * dt);
    return forced_problem(
        {{[rate](double t) { return -3.0 * std::sin(rate * t); }, {}},
         {[rate](double t) { return 40.0 * std::cos(0.6 * rate * t); },
          // Exact in every rule: solver and certificate integrate it each by its own.
          [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return x * (3.0 - 2.0 * x * x); }}});
}

/// The worst of each check over a run.
struct Worst {
    double energy = 0.0;
    double heat = 0.0;
    double beam = 0.0;
    double contact = 0.0;
};

/// spoil: changes the record before it is judged.
Worst worst_of(const Scheme& scheme, const Beam& beam, int elements, double dt, int steps,
               const std::function<void(SolveRecord&)>& spoil = {}) {
    const Mesh mesh = Mesh::uniform(elements);
    const ProblemData problem = swinging_problem(dt);
    const auto solver = make_solver(beam, problem, mesh, scheme, dt, Needs{true, true, true});
    const auto state = [&]() -> SolverState {
        return {solver->temperature(), solver->curvature(), solver->contact_stress()};
    };
    SolveRecorder recorder(beam, problem, mesh, scheme.time.name, dt, {}, state());
    EnergyLaw energy(beam, mesh, scheme.thermal_mass);
    Worst worst;
    SolveRecord last;
    solver->observe([&](const Solve&) {
        last = recorder.record(state());
        if (spoil)
            spoil(last);
        const Residuals residual = residuals(beam, mesh, scheme.thermal_mass, last, 0.0);
        worst.heat = worse(worst.heat, residual.heat);
        worst.beam = worse(worst.beam, residual.beam);
        const ContactDefects contact = contact_defects(beam, mesh, last);
        worst.contact = std::max(
            {worst.contact, contact.penetration, contact.wrong_sign, contact.complementarity});
        energy.add(last);
    });
    march(*solver, problem, scheme.time, dt, steps, [&](double) {
        worst.energy = std::max(worst.energy, energy.end_step(recorder, last));
        BOOST_TEST(recorder.end_step() == "");
    });
    return worst;
}

const std::vector<Scheme> direct_schemes = [] {
    std::vector<Scheme> direct;
    std::copy_if(all_schemes.begin(), all_schemes.end(), std::back_inserter(direct),
                 [](const Scheme& scheme) { return scheme.algorithm == Algorithm::direct; });
    return direct;
}();

} // namespace

BOOST_AUTO_TEST_CASE(algebraic_stability_is_that_of_the_literature) {
    // Alexander's SDIRK2: A = [γ, 0; 1 − γ, γ], b = (1 − γ, γ); so m_11 = 2γ(1 − γ) − (1 − γ)² =
    // −γ² for γ = 1 − 1/√2 (γ² − 2γ + 1/2 = 0), m_12 = 0, m_22 = γ²: not algebraically stable.
    const double gamma = 1.0 - std::sqrt(0.5);
    const auto close = [](double a, double b) { return std::abs(a - b) <= 1e-15; };
    const Eigen::MatrixXd m = stated_step("sdirk2", 1).algebraic_stability();
    BOOST_TEST(close(m(0, 0), -gamma * gamma));
    BOOST_TEST(close(m(0, 1), 0.0));
    BOOST_TEST(close(m(1, 1), gamma * gamma));
    // Euler: A = b = m = 1, which makes N = ½‖y^n − y^{n−1}‖².
    BOOST_TEST(stated_step("euler", 1).algebraic_stability()(0, 0) == 1.0);
}

// y' = λy in one step: stability functions and, of two steps, the recurrence of BDF2 from the
// textbooks, which state them apart from any table of coefficients.
BOOST_AUTO_TEST_CASE(stated_schemes_are_those_of_the_literature) {
    const auto close = [](double a, double b) { return std::abs(a - b) <= 1e-15; };
    for (const double z : {-0.3, -1.0, -7.0}) {
        const auto runge_kutta = [z](const StatedStep& step) { // 1 + z bᵀ (I − zA)⁻¹ 1
            const auto identity = Eigen::MatrixXd::Identity(step.solves(), step.solves());
            const Eigen::VectorXd stages =
                (identity - z * step.a).inverse() * Eigen::VectorXd::Ones(step.solves());
            return stages(step.solves() - 1);
        };
        const double gamma = 1.0 - std::sqrt(0.5);
        BOOST_TEST(close(runge_kutta(stated_step("euler", 1)), 1.0 / (1.0 - z)));
        BOOST_TEST(close(runge_kutta(stated_step("sdirk2", 5)),
                         (1.0 + (1.0 - 2.0 * gamma) * z) / std::pow(1.0 - gamma * z, 2)));
        BOOST_TEST(
            close(runge_kutta(stated_step("bdf2", 1)), runge_kutta(stated_step("sdirk2", 1))));
    }
    BOOST_TEST(stated_step("bdf2", 2).two_step);
    BOOST_TEST(close(stated_step("sdirk2", 1).fraction(0), 1.0 - std::sqrt(0.5)));
    BOOST_TEST(close(stated_step("sdirk2", 1).fraction(1), 1.0));
    BOOST_CHECK_THROW(stated_step("rk4", 1), std::domain_error);
    BOOST_TEST(stated_schemes() == TimeScheme::names(), boost::test_tools::per_element());
    for (const auto& name : TimeScheme::names())
        BOOST_TEST(stated_order(name) == TimeScheme::named(name).order);
}

BOOST_DATA_TEST_CASE(energy_residuals_and_contact_hold_to_round_off,
                     data::make(direct_schemes) * data::make({1, 2, 3, 40}) *
                         data::make({1e-200, 1e-6, 4e-3, 10.0}),
                     scheme, elements, dt) {
    const Worst worst = worst_of(scheme, swinging_beam, elements, dt, 60);
    BOOST_TEST(worst.energy <= 1e-14);
    // A residual is a sum of a few rounded terms, and the elimination's of a few more.
    BOOST_TEST(worst.heat <= 16.0);
    BOOST_TEST(worst.beam <= 16.0);
    BOOST_TEST(worst.contact <= 1e-15);
}

BOOST_DATA_TEST_CASE(a_result_wrong_in_the_tenth_digit_is_noticed, data::make(direct_schemes),
                     scheme) {
    // 1e-9 of a term is 4.5e6 units of round-off of it; half a dozen terms share the unit.
    const auto spoilt = [&](const std::function<void(SolveRecord&)>& spoil) {
        return worst_of(scheme, swinging_beam, 20, 4e-3, 20, spoil);
    };
    BOOST_TEST(spoilt([](SolveRecord& r) { r.now.theta *= 1.0 + 1e-9; }).heat > 1e4);
    BOOST_TEST(spoilt([](SolveRecord& r) { r.now.w *= 1.0 + 1e-9; }).beam > 1e4);
    BOOST_TEST(spoilt([](SolveRecord& r) { r.heat_load *= 1.0 + 1e-6; }).energy > 1e-12);
    BOOST_TEST(spoilt([](SolveRecord& r) { r.moment *= 1.0 + 1e-6; }).energy > 1e-12);
    BOOST_TEST(spoilt([](SolveRecord& r) { r.stress += 1e-9; }).contact > 1e-13);
    const auto not_a_number = [](SolveRecord& r) { r.now.theta(1) = std::nan(""); };
    BOOST_TEST(std::isnan(spoilt(not_a_number).heat));
    BOOST_TEST(std::isnan(spoilt(not_a_number).beam));
    // Its sizes are none, or beyond the range, and it is no reason to refuse the case.
    for (const double size : {std::nan(""), std::numeric_limits<double>::infinity()})
        BOOST_TEST(std::isnan(spoilt([size](SolveRecord& r) {
                                  r.now.theta(1) = std::nan("");
                                  r.now.temperature_size = size;
                              }).heat));
    // Terms beyond the range of doubles of a state within it are.
    BOOST_CHECK_THROW(spoilt([](SolveRecord& r) {
                          r.now.temperature_size = std::numeric_limits<double>::infinity();
                      }),
                      std::domain_error);
}

// A tip at rest, closer to one of the stops. A reaction of that stop pushes away from it; one that
// pulls, λ = 0.3, counts with the length |λ|/3 (κ = 1).
BOOST_AUTO_TEST_CASE(a_reaction_that_pulls_has_the_wrong_sign_at_either_stop) {
    const Mesh mesh = Mesh::uniform(2);
    SolveRecord record;
    record.now.w = certify::BrokenLinear::Zero(2, 2);
    record.now.curvature_size = 2.0; // a scale of 1
    const auto wrong_sign = [&](const Stops& stops, double stress) {
        record.stress = stress;
        return contact_defects({.stops = stops}, mesh, record).wrong_sign;
    };
    const Stops lower_is_near{-0.25, 0.5};
    const Stops upper_is_near{-0.5, 0.25};
    BOOST_TEST(wrong_sign(lower_is_near, 0.3) == 0.0);
    BOOST_TEST(wrong_sign(upper_is_near, -0.3) == 0.0);
    BOOST_TEST(wrong_sign(lower_is_near, -0.3) == 0.1, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(wrong_sign(upper_is_near, 0.3) == 0.1, boost::test_tools::tolerance(1e-15));
    // A tip that is held at the stop itself.
    BOOST_TEST(wrong_sign({0.0, 0.5}, -0.3) == 0.1, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(wrong_sign({-0.5, 0.0}, 0.3) == 0.1, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(a_step_of_too_few_or_too_many_solves_is_told) {
    const ProblemData problem;
    const SolverState rest{Eigen::VectorXd::Zero(3), certify::BrokenLinear::Zero(2, 2)};
    const Mesh mesh = Mesh::uniform(2);
    SolveRecorder recorder({}, problem, mesh, "sdirk2", 0.1, {}, rest);
    for (const int solves : {2, 1, 3}) {
        for (int i = 0; i < solves; ++i)
            recorder.record(rest);
        BOOST_TEST(recorder.end_step().empty() == (solves == 2));
    }
}

// One nodal value off by δ leaves (2/h + 2ch/3) δ in its row, beside terms of sizes 4/h and ch: for
// steps that are long beside h², δ/2ε units of round-off, on coarse and on fine meshes alike.
BOOST_DATA_TEST_CASE(the_unit_of_the_heat_residual_is_that_of_the_fluxes, data::make({4, 32, 1024}),
                     elements) {
    const Mesh mesh = Mesh::uniform(elements);
    SolveRecord record;
    record.step = stated_step("euler", 1);
    record.leading = 1e-6;
    for (RecordedState* state : {&record.now, &record.star}) {
        state->theta = Eigen::VectorXd::Zero(elements + 1);
        state->w = certify::BrokenLinear::Zero(2, elements);
        state->temperature_size = 1.0;
    }
    record.heat_load = Eigen::VectorXd::Zero(elements + 1);
    record.moment = record.now.w;
    const double delta = 64.0 * std::numeric_limits<double>::epsilon();
    record.now.theta(elements / 2) = delta;
    const double units = residuals({}, mesh, ThermalMass::consistent, record, 0.0).heat;
    BOOST_TEST(std::abs(units / 32.0 - 1.0) < 1e-4, units);
}

BOOST_AUTO_TEST_SUITE_END()

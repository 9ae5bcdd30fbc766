// The moment form and the paper's own algorithm solve the same discrete equations.

#include "core/hermite_form.hpp"
#include "core/moment_form.hpp"
#include "core/norms/error_norms.hpp"
#include "mms/manufactured_problem.hpp"
#include "studies/scene/shipped.hpp"
#include "tests/marching.hpp"
#include "tests/suited_beam.hpp"
#include "tests/sweep.hpp"
#include "tests/this_build.hpp"

#include <Eigen/Dense>
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <limits>
#include <map>
#include <numbers>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(algorithms)

namespace {

const Beam paper_beam{.alpha = 0.017, .zeta = 0.1, .stops = {-0.02, 0.1}};

std::vector<std::string> shipped_names() {
    std::vector<std::string> names;
    for (const auto& file : shipped_files(Shipped::solution))
        names.push_back(file.name);
    return names;
}

/// Largest differences of temperature (at nodes) and curvature (L²) over a run.
struct Difference {
    double temperature = 0.0;
    double curvature = 0.0;
};

Difference difference(const Beam& beam, const ProblemData& problem, const TimeScheme& time,
                      ThermalMass mass, Eigen::Index elements, double dt, int steps,
                      double tolerance) {
    const Mesh mesh = Mesh::uniform(elements);
    const auto direct =
        make_solver(beam, problem, mesh, {Algorithm::direct, mass, 0.0, time}, dt, Needs{});
    const auto iterated = make_solver(beam, problem, mesh,
                                      {Algorithm::fixed_point, mass, tolerance, time}, dt, Needs{});
    Difference largest;
    TimeLevels levels(problem, time, dt * steps, steps);
    for (int n = 1; n <= steps; ++n) {
        const StepSources sources = levels.at(n);
        BOOST_REQUIRE_EQUAL(direct->step(sources), "");
        BOOST_REQUIRE_EQUAL(iterated->step(sources), "");
        largest.temperature =
            std::max(largest.temperature,
                     (direct->temperature() - iterated->temperature()).cwiseAbs().maxCoeff());
        largest.curvature =
            std::max(largest.curvature, distance(mesh, direct->curvature(), iterated->curvature()));
    }
    return largest;
}

} // namespace

BOOST_DATA_TEST_CASE(moment_form_equals_hermite_form,
                     data::make(shipped_names()) * data::make(TimeScheme::names()) *
                         data::make({ThermalMass::consistent, ThermalMass::lumped}) *
                         data::make({1, 2, 5, 20}),
                     name, time, mass, elements) {
    if (short_tests &&
        !is_swept(position(shipped_names(), name) + position(TimeScheme::names(), time) +
                      static_cast<std::size_t>(elements) + (mass == ThermalMass::lumped ? 1 : 0),
                  4))
        return;
    Beam beam = paper_beam;
    beam.theta_A = name == "heated-end" ? 0.7 : 0.0;
    beam.stops.epsilon = epsilon_for(name);
    static std::map<std::string, ProblemData> derived; // which takes longer than a run
    const auto [place, is_new] = derived.try_emplace(name);
    if (is_new)
        place->second =
            manufactured_problem({read_solution(find_file(Shipped::solution, name)), beam, 2.0});
    const ProblemData& problem = place->second;
    const Difference largest =
        difference(beam, problem, TimeScheme::named(time), mass, elements, 0.01, 200, 1e-13);
    // G is integrated where the moment form integrates its antiderivative, so on few elements the
    // two differ by the quadrature error of functions that are no polynomials (measured: 1e-4 on
    // one element, from the steepest front); on twenty elements it is below round-off.
    const double h = 1.0 / elements;
    const double quadrature = 1e-3 * std::pow(h, 8);
    const double round_off = 2e-15 / std::pow(h, 4);
    // The iteration stops within 1e-13, and histories of several states pass that on enlarged.
    const double iteration = 2e-12;
    BOOST_TEST(largest.temperature <= iteration + quadrature);
    BOOST_TEST(largest.curvature <= iteration + quadrature + round_off);
}

BOOST_AUTO_TEST_CASE(difference_of_the_rows_of_table_1_grows_no_faster_than_round_off_predicts) {
    // A solve with B loses ε·cond(B), and cond(B) = c h⁻⁴: c is measured on a small mesh, by the
    // eigenvalues of the matrix itself. Each step of the paper's algorithm multiplies by B and
    // solves with it.
    const auto condition = [](Eigen::Index s) {
        const double k = static_cast<double>(s);
        Eigen::MatrixXd b = Eigen::MatrixXd::Zero(2 * s + 2, 2 * s + 2);
        Eigen::Matrix4d element;
        element << 12, 6, -12, 6, 6, 4, -6, 2, -12, -6, 12, -6, 6, 2, -6,
            4; // slopes scaled by h: entries alike
        for (Eigen::Index j = 0; j < s; ++j)
            b.block<4, 4>(2 * j, 2 * j) += element * k * k * k;
        const Eigen::VectorXd eigenvalues =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(b.bottomRightCorner(2 * s, 2 * s))
                .eigenvalues();
        return eigenvalues(2 * s - 1) / eigenvalues(0);
    };
    const double c = condition(20) / std::pow(20.0, 4);
    BOOST_TEST(condition(10) / 1e4 == c, boost::test_tools::tolerance(0.3)); // it is c h⁻⁴
    const ProblemData problem = manufactured_problem(
        {read_solution(find_file(Shipped::solution, "copetti-fernandez-2011")), paper_beam, 2.0});
    const double epsilon = std::numeric_limits<double>::epsilon();
    for (const int s : {10, 20, 40, 80, 160}) {
        // All steps of the row; under the sanitizers, which are slow, the first 400.
        const int steps = short_tests ? 400 : 200 * s;
        const Difference largest = difference(paper_beam, problem, TimeScheme::named("euler"),
                                              ThermalMass::lumped, s, 0.01 / s, steps, 1e-13);
        // A step multiplies by B and solves with it: two such errors, and they add up over the
        // steps until viscosity has damped them.
        const double predicted = 4.0 * epsilon * c * std::pow(s, 4);
        BOOST_TEST_MESSAGE("s = " << s << ": curvatures differ by " << largest.curvature
                                  << ", predicted " << predicted);
        BOOST_TEST(largest.curvature <= predicted);
        BOOST_TEST(largest.temperature <= predicted);
    }
}

// Couples that bend the outer half of a beam at rest, and nothing else: the first iteration leaves
// the temperature and the inner half as they are, and the heat of the bending is still to come.
BOOST_AUTO_TEST_CASE(the_iteration_waits_for_the_deflection_of_the_whole_beam) {
    using Eigen::ArrayXd;
    ProblemData problem;
    problem.amplitudes = [](const ArrayXd& t) { return Eigen::ArrayXXd::Ones(1, t.size()); };
    problem.amplitude_count = 1;
    problem.profiles = {
        [](const ArrayXd& x) -> ArrayXd {
            return (x > 0.5).select((x < 0.75).select(0 * x + 1, -1), 0);
        },
        // ∫_y^1 of it
        [](const ArrayXd& y) -> ArrayXd { return -(y - 0.5).min(1.0 - y).max(0.0); }};
    problem.couple_load.terms = {{0, 0}};
    problem.moment_load.terms = {{0, 1}};
    const Difference largest =
        difference({.alpha = 0.3, .zeta = 0.1}, problem, TimeScheme::named("euler"),
                   ThermalMass::consistent, 4, 0.1, 1, 1e-13);
    BOOST_TEST(largest.temperature <= 1e-13);
}

BOOST_AUTO_TEST_CASE(fixed_point_that_does_not_converge_is_given_up_with_a_reason) {
    // It contracts, by 0.999 in an iteration; a thousand of them leave e^{-1} of the first change.
    const double pi = std::numbers::pi;
    const double dt = 0.01;
    const double zeta = 1e-3;
    const double alpha = std::sqrt(0.999 * (dt + zeta) * (1.0 + pi * pi * dt) / dt);
    const Beam beam{.alpha = alpha, .zeta = zeta};
    const ProblemData problem = manufactured_problem(
        {read_solution(find_file(Shipped::solution, "free-oscillation")), beam, 1.0});
    const RunResult result = run({beam,
                                  Mesh::uniform(40),
                                  {Algorithm::fixed_point, ThermalMass::consistent, 1e-12},
                                  1.0,
                                  100,
                                  {*Norm::named("theta_L2L2")}},
                                 problem);
    BOOST_TEST((result.status == RunStatus::failed));
    BOOST_TEST(result.reason.find("does not reach its tolerance") != std::string::npos,
               result.reason);
    BOOST_TEST(result.reason.find("in step 1 of 100") != std::string::npos, result.reason);
    BOOST_TEST(result.errors.empty());
}

// The matrices depend on c = c_i/Δt alone: c_i is 1 of Euler, 3/2 of BDF2, whose first step is one
// of SDIRK2, and 1/γ of both stages of SDIRK2. Steps for which 1/(1/c) is c, and others.
BOOST_DATA_TEST_CASE(matrices_are_factored_once_for_each_coefficient,
                     data::make(TimeScheme::names()) * data::make({0.25, 0.1, 1.0 / 49.0, 0.03}),
                     time, dt) {
    const ProblemData problem = manufactured_problem(
        {read_solution(find_file(Shipped::solution, "free-decay")), paper_beam, 1.0});
    const Scheme scheme{
        .algorithm = Algorithm::fixed_point, .tolerance = 1e-10, .time = TimeScheme::named(time)};
    const Mesh mesh = Mesh::uniform(8);
    HermiteForm form(paper_beam, problem, mesh, scheme, dt);
    march(form, problem, scheme.time, dt, 10, [](double) {});
    BOOST_TEST(form.factorizations() == (time == "bdf2" ? 2 : 1));
}

BOOST_AUTO_TEST_CASE(a_request_without_a_meaning_fails_with_the_reason) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const RunRequest sound{paper_beam, Mesh::uniform(2), {}, 1.0, 2, {}};
    BOOST_TEST((run(sound, ProblemData{}).status == RunStatus::ok));
    const std::vector<std::pair<std::function<void(RunRequest&)>, std::string>> wrong{
        {[](RunRequest& of) { of.steps = 0; }, "steps is 0"},
        {[](RunRequest& of) { of.steps = -1; }, "steps is -1"},
        {[](RunRequest& of) { of.final_time = 0.0; }, "final_time is 0"},
        {[](RunRequest& of) { of.final_time = infinity; }, "final_time is inf"},
        {[](RunRequest& of) { of.beam.alpha = -1.0; }, "alpha is -1"},
        {[](RunRequest& of) { of.beam.zeta = -1.0; }, "zeta is -1"},
        {[](RunRequest& of) { of.beam.theta_A = nan; }, "theta_A is nan"},
        {[](RunRequest& of) {
             of.beam.stops = {0.1, 0.2};
         },
         "the lower stop is 0.1"},
        {[](RunRequest& of) {
             of.beam.stops = {-0.1, -0.05};
         },
         "the upper stop is -0.05"},
        {[](RunRequest& of) {
             of.beam.stops = {nan, 0.1};
         },
         "the lower stop is nan"},
        {[](RunRequest& of) { of.beam.stops.epsilon = -1.0; }, "epsilon is -1"}};
    for (const auto& [change, words] : wrong) {
        RunRequest request = sound;
        change(request);
        const RunResult result = run(request, ProblemData{});
        BOOST_TEST((result.status == RunStatus::failed), words);
        BOOST_TEST(result.reason.starts_with(words + "; it must be"), result.reason);
    }
}

BOOST_AUTO_TEST_CASE(a_run_tells_of_no_step_before_it_is_made) {
    std::int64_t visited = -1; // t = 0 is no step
    std::int64_t told = 0;
    const Observer observer{{}, [&](double, const Solver&) { ++visited; }};
    const RunRequest request{{}, Mesh::uniform(2), {}, 1.0, 200, {}, [&](std::int64_t steps) {
                                 told += steps;
                                 BOOST_TEST(told <= std::max<std::int64_t>(visited, 0));
                                 return true;
                             }};
    BOOST_TEST((run(request, ProblemData{}, &observer).status == RunStatus::ok));
    BOOST_TEST(visited == 200);
    BOOST_TEST(told > 0);
}

BOOST_AUTO_TEST_SUITE_END()

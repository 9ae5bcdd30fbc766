// Error norms: names, and the two ways of integrating them.

#include "core/norms/error_norms.hpp"
#include "mms/manufactured_problem.hpp"
#include "studies/scene/shipped.hpp"
#include "tests/marching.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(error_norms)

namespace {

const Beam paper_beam{.alpha = 0.017, .zeta = 0.1, .stops = {-0.02, 0.1}};

std::vector<Norm> all_norms() {
    std::vector<Norm> norms;
    for (const auto& name : Norm::names())
        norms.push_back(*Norm::named(name));
    return norms;
}

} // namespace

BOOST_AUTO_TEST_CASE(every_norm_has_a_square_except_the_corollary_which_is_one) {
    for (const auto& name : Norm::names()) {
        const auto norm = Norm::named(name);
        BOOST_REQUIRE(norm);
        BOOST_TEST(norm->squared == (name == "corollary"));
        const auto square = Norm::named(name + "_sq");
        BOOST_TEST(square.has_value() == (name != "corollary"));
        if (square)
            BOOST_TEST(square->squared);
    }
    BOOST_TEST(!Norm::named("theta_l2l2"));
    BOOST_TEST(!Norm::named(""));
}

BOOST_DATA_TEST_CASE(separated_and_pointwise_norms_agree,
                     data::make({ThermalMass::consistent, ThermalMass::lumped}) *
                         data::make({1, 3, 16}),
                     mass, elements) {
    const Scheme scheme{Algorithm::direct, mass, 0.0};
    ProblemData problem = manufactured_problem(
        {read_solution(find_file(Shipped::solution, "copetti-fernandez-2011")), paper_beam, 2.0});
    const RunRequest request{paper_beam, Mesh::uniform(elements), scheme, 2.0, 160, all_norms()};
    const RunResult split = run(request, problem);
    const ProblemData original = problem;
    for (Field* field : {&problem.exact->theta, &problem.exact->theta_x, &problem.exact->u,
                         &problem.exact->u_x, &problem.exact->u_xx})
        *field = unseparated(*field, original);
    const RunResult pointwise = run(request, problem);
    // Gauss points see the square of a trigonometric error to the degree of the rule; on one
    // element that is 1e-7.
    for (std::size_t k = 0; k < request.norms.size(); ++k)
        BOOST_TEST(split.errors[k] == pointwise.errors[k],
                   boost::test_tools::tolerance(elements == 1 ? 1e-5 : 1e-9));
}

BOOST_DATA_TEST_CASE(separated_and_general_sources_give_the_same_errors, data::make(all_schemes),
                     scheme) {
    ProblemData problem = manufactured_problem(
        {read_solution(find_file(Shipped::solution, "copetti-fernandez-2011")), paper_beam, 2.0});
    problem.body_force = problem.heat_source; // any one, which the Hermite form alone reads
    const RunRequest request{paper_beam, Mesh::uniform(12), scheme, 2.0, 100, all_norms()};
    const RunResult separated = run(request, problem);
    const ProblemData original = problem;
    for (Field* field : {&problem.heat_source, &problem.moment_load, &problem.couple_load,
                         &problem.body_force, &problem.curvature_initial, &problem.theta_initial})
        *field = unseparated(*field, original);
    const RunResult general = run(request, problem);
    BOOST_REQUIRE_MESSAGE(general.status == RunStatus::ok, general.reason);
    BOOST_TEST(separated.counters.source_evaluations == 0);
    std::int64_t solves = 0;
    for (std::int64_t n = 1; n <= request.steps; ++n)
        solves += static_cast<std::int64_t>(scheme.time.at_step(n).stages.size());
    const bool direct = scheme.algorithm == Algorithm::direct;
    BOOST_TEST(general.counters.source_evaluations == (direct ? 2 : 3) * solves);
    const double tolerance = direct ? 1e-11 : 1e-6; // h⁻⁴ round-off in the Hermite form
    for (std::size_t k = 0; k < request.norms.size(); ++k)
        BOOST_TEST(general.errors[k] == separated.errors[k],
                   boost::test_tools::tolerance(tolerance));
}

BOOST_AUTO_TEST_CASE(a_square_is_the_square_and_the_corollary_is_the_sum_of_its_three_terms) {
    const ProblemData problem = manufactured_problem(
        {read_solution(find_file(Shipped::solution, "copetti-fernandez-2011")), paper_beam, 2.0});
    const auto errors =
        run({paper_beam,
             Mesh::uniform(8),
             Scheme{},
             2.0,
             50,
             {*Norm::named("theta_L2L2"), *Norm::named("theta_L2L2_sq"), *Norm::named("u_LinfH2"),
              *Norm::named("u_L2H2"), *Norm::named("corollary")}},
            problem)
            .errors;
    BOOST_TEST(errors[1] == errors[0] * errors[0], boost::test_tools::tolerance(1e-14));
    BOOST_TEST(errors[4] == errors[2] * errors[2] + errors[1] + errors[3] * errors[3],
               boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(an_error_that_is_not_a_number_at_one_level_is_not_passed_over) {
    // The exact solution is NaN at the second of four levels only; the run must fail and say so.
    ProblemData problem;
    problem.amplitude_count = 1;
    problem.amplitudes = [](const Eigen::ArrayXd& t) {
        return Eigen::ArrayXXd(
            t.unaryExpr([](double at) { return at == 0.5 ? std::nan("") : 1.0; }).transpose());
    };
    problem.profiles = {[](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return x * (1.0 - x); }};
    problem.exact = ExactSolution{.theta = {{{0, 0}}, {}},
                                  .theta_x = {},
                                  .u = {{{0, 0}}, {}},
                                  .u_x = {},
                                  .u_xx = {{{0, 0}}, {}},
                                  .stress = {}};
    for (const std::string name : {"theta_LinfL2", "theta_L2L2", "u_LinfH2semi", "u_LinfL2"}) {
        const RunResult result = run({Beam{.alpha = 0.1, .zeta = 0.1},
                                      Mesh::uniform(3),
                                      Scheme{},
                                      1.0,
                                      4,
                                      {*Norm::named(name)}},
                                     problem);
        BOOST_TEST((result.status == RunStatus::failed), name);
        BOOST_TEST(result.errors.empty());
    }
}

BOOST_AUTO_TEST_CASE(norms_of_a_known_error_are_its_integrals) {
    // Nothing moves (no data), so the error is the exact solution itself: θ = 3t x(1 − x), u = t
    // x², σ = 5, over the levels t = 1/2 and 1 with Δt = 1/2. ‖x(1−x)‖² = 1/30, ‖1−2x‖² = 1/3,
    // ‖x²‖² = 1/5, ‖2x‖² = 4/3, ‖2‖² = 4.
    ProblemData problem;
    problem.amplitude_count = 3;
    problem.amplitudes = [](const Eigen::ArrayXd& t) {
        Eigen::ArrayXXd values(3, t.size());
        values.row(0) = 3.0 * t.transpose();
        values.row(1) = t.transpose();
        values.row(2) = 5.0;
        return values;
    };
    problem.profiles = {[](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return x * (1.0 - x); },
                        [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 1.0 - 2.0 * x; },
                        [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return x * x; },
                        [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 2.0 * x; },
                        [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 0.0 * x + 2.0; }};
    problem.exact = ExactSolution{.theta = {{{0, 0}}, {}},
                                  .theta_x = {{{0, 1}}, {}},
                                  .u = {{{1, 2}}, {}},
                                  .u_x = {{{1, 3}}, {}},
                                  .u_xx = {{{1, 4}}, {}},
                                  .stress = 2};
    const double time_square = 0.5 * (0.25 + 1.0); // Δt Σ t_n²
    const std::vector<std::pair<std::string, double>> expected{
        {"theta_L2L2_sq", 9.0 * time_square / 30.0},
        {"theta_LinfL2_sq", 9.0 / 30.0},
        {"theta_L2H1_sq", 9.0 * time_square * (1.0 / 30.0 + 1.0 / 3.0)},
        {"u_LinfL2_sq", 1.0 / 5.0},
        {"u_LinfH1_sq", 1.0 / 5.0 + 4.0 / 3.0},
        {"u_LinfH2_sq", 1.0 / 5.0 + 4.0 / 3.0 + 4.0},
        {"u_LinfH2semi_sq", 4.0},
        {"u_L2H2_sq", time_square * (1.0 / 5.0 + 4.0 / 3.0 + 4.0)},
        {"sigma_L2_sq", 25.0},
    };
    for (const auto& scheme : all_schemes) {
        RunRequest request{Beam{.alpha = 0.1, .zeta = 0.1}, Mesh::uniform(3), scheme, 1.0, 2, {}};
        for (const auto& [name, value] : expected)
            request.norms.push_back(*Norm::named(name));
        const auto errors = run(request, problem).errors;
        for (std::size_t k = 0; k < expected.size(); ++k)
            BOOST_TEST(errors[k] == expected[k].second, boost::test_tools::tolerance(1e-13));
    }
}

BOOST_AUTO_TEST_SUITE_END()

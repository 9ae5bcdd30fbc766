// What does not separate, by products: Chebyshev expansions, and runs with them against runs that
// evaluate the functions themselves.

#include "core/low_rank/separated.hpp"

#include "core/low_rank/chebyshev.hpp"
#include "core/run.hpp"
#include "mms/manufactured_problem.hpp"
#include "studies/scene/shipped.hpp"
#include "tests/marching.hpp"
#include "tests/suited_beam.hpp"
#include "tests/sweep.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <memory>
#include <set>

using namespace tvbeam;
namespace data = boost::unit_test::data;
using Eigen::ArrayXd;

BOOST_AUTO_TEST_SUITE(low_rank)

namespace {

std::vector<std::string> shipped_names() {
    std::vector<std::string> names;
    for (const auto& file : shipped_files(Shipped::solution))
        names.push_back(file.name);
    return names;
}

std::vector<Norm> all_norms() {
    std::vector<Norm> norms;
    for (const auto& name : Norm::names())
        norms.push_back(*Norm::named(name));
    return norms;
}

/// Each of the fields that the moment form reads as a function of x and t alone.
ProblemData without_products(const ProblemData& problem) {
    ProblemData general = problem;
    for (Field* field : {&general.heat_source, &general.moment_load, &general.curvature_initial,
                         &general.exact->theta, &general.exact->theta_x, &general.exact->u,
                         &general.exact->u_x, &general.exact->u_xx})
        if (!field->is_zero())
            *field = unseparated(*field, problem);
    return general;
}

double greatest_value(const ProblemData& problem, const Field& field, double final_time) {
    double greatest = 0.0;
    for (int n = 0; n <= 50; ++n)
        greatest = std::max(greatest, values(problem, field, ArrayXd::LinSpaced(51, 0.0, 1.0),
                                             final_time * n / 50.0)
                                          .abs()
                                          .maxCoeff());
    return greatest;
}

/// Of the temperature and the curvature, and what drives them.
double greatest_value(const ProblemData& problem, double final_time) {
    double greatest = 0.0;
    for (const Field* field :
         {&problem.exact->theta, &problem.exact->u_xx, &problem.heat_source, &problem.moment_load})
        greatest = std::max(greatest, greatest_value(problem, *field, final_time));
    return greatest;
}

RunResult run_on(const ProblemData& problem, const Beam& beam, const Scheme& scheme, int elements) {
    return run({beam, Mesh::uniform(elements), scheme, 1.0, 60, all_norms()}, problem);
}

/// A problem with these sources and no exact solution.
ProblemData problem_of(SpaceTimeFunction heat_source, SpaceTimeFunction moment_load) {
    ProblemData data;
    data.heat_source.rest = std::move(heat_source);
    data.moment_load.rest = std::move(moment_load);
    return data;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_polynomial_comes_back_from_its_values) {
    // 3 − 2y + y³ = 3 T_0 − (5/4) T_1 + T_3/4, since T_3 = 4y³ − 3y.
    const ArrayXd y = chebyshev_points(6);
    const Eigen::VectorXd c = chebyshev_transform(6) * (3.0 - 2.0 * y + y.pow(3)).matrix();
    Eigen::VectorXd expected(6);
    expected << 3.0, -1.25, 0.0, 0.25, 0.0, 0.0;
    BOOST_TEST((c - expected).cwiseAbs().maxCoeff() <= 1e-15);
    const ArrayXd at = ArrayXd::LinSpaced(700, -1.0, 1.0); // more than a block
    const ArrayXd exact = 3.0 - 2.0 * at + at.pow(3);
    BOOST_TEST((chebyshev_sum(c, at) - exact).abs().maxCoeff() <= 1e-14);
    BOOST_TEST((chebyshev_values(6, at).transpose() * c - exact.matrix()).cwiseAbs().maxCoeff() <=
               1e-14);
}

// Every field is made a function that does not separate, also those that do; the results are those
// of the problem itself.
BOOST_DATA_TEST_CASE(errors_are_those_of_the_functions_themselves,
                     data::make(shipped_names()) * data::make(TimeScheme::names()), name, time) {
    if (short_tests &&
        !is_swept(position(shipped_names(), name) + position(TimeScheme::names(), time), 3))
        return;
    const Solution solution = read_solution(find_file(Shipped::solution, name));
    const Beam beam =
        suited({.alpha = 0.3, .zeta = 0.1, .theta_A = 0.4, .stops = {-0.02, 0.1}}, solution);
    const ProblemData problem = manufactured_problem({solution, beam, 1.0});
    const SeparatedProblem products = separated(without_products(problem), all_norms(), 1.0);
    // The layers of these are too thin in time or space.
    static const std::set<std::string> left{};
    BOOST_REQUIRE_MESSAGE(products.reason.empty() != left.contains(name), products.reason);
    if (left.contains(name))
        return;
    BOOST_TEST(products.rank > 0);
    const double scale = greatest_value(problem, 1.0);
    for (const Basis basis : {Basis::automatic, Basis::nodal}) {
        Scheme scheme;
        scheme.time = TimeScheme::named(time);
        scheme.basis = basis;
        const RunResult expected = run_on(problem, beam, scheme, 12);
        const RunResult found = run_on(products.data, beam, scheme, 12);
        BOOST_REQUIRE_MESSAGE(found.status == RunStatus::ok, found.reason);
        BOOST_TEST(found.counters.source_evaluations == 0);
        for (std::size_t k = 0; k < expected.errors.size(); ++k)
            BOOST_TEST(std::abs(found.errors[k] - expected.errors[k]) <=
                           1e-10 * expected.errors[k] + 1e-13 * scale,
                       Norm::names()[k] << ": " << found.errors[k] << " for "
                                        << expected.errors[k]);
    }
}

BOOST_DATA_TEST_CASE(generated_sources_drive_the_same_run, data::xrange(20), i) {
    // Frequencies, shifts and rates without pattern: multiples of √2 and √3, modulo 1.
    const auto part = [i](double step) { return std::fmod((i + 1) * step, 1.0); };
    const double a = 1.0 + 5.0 * part(std::sqrt(2.0));
    const double b = 3.0 * part(std::sqrt(3.0));
    const double c = 0.5 + 2.0 * part(std::sqrt(5.0));
    const ProblemData problem = problem_of(
        [=](const ArrayXd& x, double t) -> ArrayXd { return (a * x * t + b).sin() / (c + x + t); },
        [=](const ArrayXd& x, double t) -> ArrayXd {
            return (-c * x * (b + t)).exp() * (a * t + x).cos();
        });
    const SeparatedProblem products = separated(problem, {}, 2.0);
    BOOST_REQUIRE_MESSAGE(products.reason.empty(), products.reason);
    BOOST_TEST(products.rank <= 24);
    const Mesh mesh = Mesh::uniform(10);
    const auto temperature = [&](const ProblemData& of) {
        Eigen::VectorXd last;
        const Observer observer{Needs{},
                                [&](double, const Solver& solver) { last = solver.temperature(); }};
        BOOST_REQUIRE(
            run({{.alpha = 0.5, .zeta = 0.1}, mesh, Scheme{}, 2.0, 40, {}}, of, &observer).status ==
            RunStatus::ok);
        return last;
    };
    const Eigen::VectorXd expected = temperature(problem);
    BOOST_TEST((temperature(products.data) - expected).cwiseAbs().maxCoeff() <=
               1e-13 * expected.cwiseAbs().maxCoeff());
}

// On 200 elements most combinations of the profiles end before the highest modes. Both bases march
// the same products; their errors, 1e-5 of fields of size 1, differ by round-off.
BOOST_DATA_TEST_CASE(combined_profiles_give_the_errors_of_the_nodal_form,
                     data::make(TimeScheme::names()), time) {
    const Beam beam{.alpha = 0.4, .zeta = 0.1, .theta_A = 0.5};
    const Solution solution =
        parse_solution("name = \"swaying\"\ntheta = \"theta_A*(1-x)+sin(pi*x*(1+t*(1-x)))\"\n"
                       "u = \"x^2*sin(x*t)/20\"\n",
                       "swaying");
    const std::vector<Norm> norms{*Norm::named("theta_L2L2"), *Norm::named("u_LinfH2semi")};
    const SeparatedProblem products =
        separated(manufactured_problem({solution, beam, 1.0}), norms, 1.0);
    BOOST_TEST_REQUIRE(products.rank >= 12);
    for (const std::vector<Norm>& asked : {norms, std::vector<Norm>{norms.back()}}) {
        Scheme scheme{.time = TimeScheme::named(time)};
        const auto errors = [&](Basis basis) {
            scheme.basis = basis;
            const RunResult result =
                run({beam, Mesh::uniform(200), scheme, 1.0, 100, asked}, products.data);
            BOOST_TEST(result.counters.sine_steps == (basis == Basis::nodal ? 0 : 100));
            return result.errors;
        };
        const std::vector<double> in_sines = errors(Basis::automatic);
        const std::vector<double> nodal = errors(Basis::nodal);
        BOOST_TEST_REQUIRE(in_sines.size() == nodal.size());
        for (std::size_t i = 0; i < nodal.size(); ++i)
            BOOST_TEST(std::abs(in_sines[i] - nodal[i]) <= 1e-8 * nodal[i]);
    }
}

BOOST_AUTO_TEST_CASE(the_rank_is_that_of_all_fields_together) {
    // Both sources are sums of e^−t sin πx, cos 3t · x² and t² e^x: three profiles, not five.
    const ProblemData problem = problem_of(
        [](const ArrayXd& x, double t) -> ArrayXd {
            return std::exp(-t) * (M_PI * x).sin() + std::cos(3.0 * t) * x.square();
        },
        [](const ArrayXd& x, double t) -> ArrayXd {
            return std::cos(3.0 * t) * x.square() - t * t * x.exp() + t * (M_PI * x).sin();
        });
    BOOST_TEST(separated(problem, {}, 1.0).rank == 3);
}

// x cos t begins as the x of the initial curvature; t x² has a profile of its own.
BOOST_AUTO_TEST_CASE(the_initial_curvature_is_that_of_the_start) {
    ProblemData problem = problem_of(
        {}, [](const ArrayXd& x, double t) -> ArrayXd { return x * std::cos(t) + t * x.square(); });
    problem.curvature_initial.rest = [](const ArrayXd& x, double t) -> ArrayXd {
        return 2.0 * x + t * x.exp(); // is read at t = 0 alone
    };
    const SeparatedProblem products = separated(problem, {}, 1.0);
    BOOST_TEST(products.rank == 2);
    const ArrayXd x = ArrayXd::LinSpaced(17, 0.0, 1.0);
    const auto of = [&](const Field& field, double t) {
        return values(products.data, field, x, t);
    };
    BOOST_TEST((of(products.data.curvature_initial, 0.0) - 2.0 * x).abs().maxCoeff() <= 1e-14);
    BOOST_TEST(
        (of(products.data.moment_load, 0.7) - problem.moment_load.rest(x, 0.7)).abs().maxCoeff() <=
        1e-14);
}

BOOST_AUTO_TEST_CASE(each_phase_has_its_own_function_up_to_its_end) {
    const double end = 0.3;
    ProblemData problem = problem_of(
        [=](const ArrayXd& x, double t) -> ArrayXd {
            return t <= end ? ArrayXd((x * t).sin()) : ArrayXd(5.0 - (x * t).exp());
        },
        {});
    problem.phase_ends = {end};
    const SeparatedProblem products = separated(problem, {}, 1.0);
    BOOST_REQUIRE_MESSAGE(products.reason.empty(), products.reason);
    const ArrayXd x = ArrayXd::LinSpaced(17, 0.0, 1.0);
    for (const double t : {0.0, 0.1, end, std::nextafter(end, 1.0), 0.7, 1.0}) {
        const ArrayXd expected = problem.heat_source.rest(x, t);
        BOOST_TEST(
            (values(products.data, products.data.heat_source, x, t) - expected).abs().maxCoeff() <=
                2e-14,
            "at t = " << t);
    }
}

BOOST_AUTO_TEST_CASE(layers_kinks_and_what_is_not_finite_stay_as_they_are_with_a_reason) {
    const auto reason_of = [](const SpaceTimeFunction& source) {
        const SeparatedProblem same = separated(problem_of(source, {}), {}, 1.0);
        BOOST_TEST(same.rank == 0);
        BOOST_TEST(static_cast<bool>(same.data.heat_source.rest));
        BOOST_TEST(same.data.profiles.empty());
        return same.reason;
    };
    BOOST_TEST(reason_of([](const ArrayXd& x, double t) -> ArrayXd {
                   return (1000.0 * (x - t)).tanh();
               }).find("polynomial of x") != std::string::npos);
    BOOST_TEST(reason_of([](const ArrayXd& x, double t) -> ArrayXd {
                   return x * std::abs(std::sin(40.0 * t));
               }).find("pieces in time") != std::string::npos);
    BOOST_TEST(reason_of([](const ArrayXd& x, double t) -> ArrayXd {
                   return 1.0 / (x - x + (t > 0.9 ? 0.0 : 1.0));
               }).find("not finite") != std::string::npos);
    // A flash that no Chebyshev point sees, beside something that is always there.
    BOOST_TEST(reason_of([](const ArrayXd& x, double t) -> ArrayXd {
                   return (x * t).cos() + x * std::exp(-1e6 * (t - 0.3333) * (t - 0.3333));
               }).find("differ") != std::string::npos);
    // A spot of the width 0.006, for as short a time: with it also where it may stand.
    for (const double at : {0.31, 0.5, 0.69})
        BOOST_TEST(reason_of([=](const ArrayXd& x, double t) -> ArrayXd {
                       return (3.0 * x * t).cos() +
                              100.0 * (-3e4 * ((x - at).square() + (t - 0.58) * (t - 0.58))).exp();
                   }) != "");
    // Smooth, but cos cy has about c/2π products for y in [0, 1], and some 20 more to round-off.
    BOOST_TEST(reason_of([](const ArrayXd& x, double t) -> ArrayXd {
                   return (200.0 * t * x).cos();
               }).find("more than the") != std::string::npos);
}

// Two steps long and 1/100 wide, wherever and whenever, in one phase and in several.
BOOST_AUTO_TEST_CASE(bumps_that_the_steps_resolve_are_found_in_long_runs_too) {
    const auto is_missed = [](double x0, double t0, std::int64_t steps, bool phases) {
        const double d = 2.0 / static_cast<double>(steps);
        ProblemData problem = problem_of(
            [=](const ArrayXd& x, double t) -> ArrayXd {
                const double late = (t - t0) / d;
                return (3.0 * x * t).cos() + (-((x - x0) / 0.01).square() - late * late).exp();
            },
            {});
        if (phases)
            problem.phase_ends = {0.1, 0.47};
        return separated(problem, {}, 1.0, steps).reason.empty();
    };
    for (int k = 1; k <= 200; ++k) {
        const double x0 = 1.0 / 32 + std::fmod(0.754878 * k, 1.0) * 15.0 / 16;
        const double t0 = std::fmod(0.569840 * k, 1.0);
        BOOST_TEST(!is_missed(x0, t0, 12000, k % 2 == 0), "x = " << x0 << ", t = " << t0);
    }
    for (const double t0 : {0.185, 0.1856, 0.61803})
        BOOST_TEST(!is_missed(0.4, t0, 400000, false), "t = " << t0);
}

BOOST_AUTO_TEST_CASE(what_separates_is_left_alone) {
    const ProblemData problem =
        manufactured_problem({read_solution(find_file(Shipped::solution, "copetti-fernandez-2011")),
                              {.alpha = 0.017, .zeta = 0.1, .stops = {-0.02, 0.1}},
                              1.0});
    const SeparatedProblem same = separated(problem, all_norms(), 1.0);
    BOOST_TEST(same.rank == 0);
    BOOST_TEST(same.reason.empty());
    BOOST_TEST(same.data.profiles.size() == problem.profiles.size());
    BOOST_TEST(same.data.amplitude_count == problem.amplitude_count);
}

BOOST_AUTO_TEST_SUITE_END()

// The sine basis: its transforms, and the run in it against the run in nodal values.

#include "core/sine/form.hpp"

#include "core/norms/error_norms.hpp"
#include "mms/manufactured_problem.hpp"
#include "studies/scene/shipped.hpp"
#include "tests/marching.hpp"
#include "tests/suited_beam.hpp"
#include "tests/sweep.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(sine_form)

namespace {

std::vector<std::string> shipped_names() {
    std::vector<std::string> names;
    for (const auto& file : shipped_files(Shipped::solution))
        names.push_back(file.name);
    return names;
}

std::vector<Norm> norms_of(const std::vector<std::string>& names) {
    std::vector<Norm> norms;
    for (const auto& name : names)
        norms.push_back(*Norm::named(name));
    return norms;
}

/// Those that are measured on meshes with cells too.
const std::vector<std::string> sine_norms{"theta_L2L2", "theta_LinfL2", "u_LinfH2semi", "sigma_L2"};

/// Nodal values without symmetry, zero at both ends.
Eigen::VectorXd some_nodal_values(Eigen::Index elements) {
    Eigen::VectorXd nodal = Eigen::VectorXd::Zero(elements + 1);
    for (Eigen::Index i = 1; i < elements; ++i)
        nodal(i) = std::sin(1.7 * static_cast<double>(i * i));
    return nodal;
}

/// Loads that swing the tip from one stop to the other, and a strong coupling.
ProblemData swinging_problem() {
    return forced_problem(
        {{[](double t) { return -3.0 * std::sin(9.0 * t); }, {}},
         {[](double t) { return 40.0 * std::cos(5.0 * t); },
          [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return (3.0 * x).sin(); }}});
}

} // namespace

BOOST_DATA_TEST_CASE(basis_diagonalises_mass_and_stiffness, data::make({1, 2, 3, 10, 13, 60, 125}),
                     elements) {
    // Parseval: with the coefficients c of v, vᵀM_c v = Σ c², vᵀKv = Σ K_k c², vᵀMv = Σ M_k c² for
    // the lumped M.
    const Mesh mesh = Mesh::uniform(elements);
    const SineBasis basis(elements);
    const Eigen::VectorXd nodal = some_nodal_values(elements);
    const Eigen::VectorXd inner = nodal.segment(1, elements - 1);
    const Eigen::ArrayXd square = basis.of_nodal(nodal).square();
    const auto form = [&](const Tridiagonal& matrix) { return inner.dot(matrix * inner); };
    const auto tolerance = boost::test_tools::tolerance(1e-13);
    BOOST_TEST(square.sum() == squared_norm(mesh, nodal), tolerance);
    BOOST_TEST((basis.stiffness() * square).sum() == form(stiffness_matrix(mesh)), tolerance);
    BOOST_TEST((basis.lumped_mass() * square).sum() ==
                   form(thermal_mass_matrix(mesh, ThermalMass::lumped)),
               tolerance);
}

BOOST_DATA_TEST_CASE(coefficients_of_a_load_are_its_products_with_the_modes,
                     data::make({2, 3, 10, 77}), elements) {
    // (v, φ̂_k) of v in S_0^h is its coefficient, whether v comes by nodal values or by its products
    // with the hat functions; and 1 − x and x have theirs in closed form.
    const Mesh mesh = Mesh::uniform(elements);
    const SineBasis basis(elements);
    const Eigen::VectorXd nodal = some_nodal_values(elements);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(elements + 1);
    loads.segment(1, elements - 1) =
        thermal_mass_matrix(mesh, ThermalMass::consistent) * nodal.segment(1, elements - 1).eval();
    BOOST_TEST((basis.of_load(loads) - basis.of_nodal(nodal)).abs().maxCoeff() <= 1e-14);
    const auto of = [&](const SpaceFunction& g) { return basis.of_load(hat_loads(mesh, g)); };
    BOOST_TEST(
        (basis.left_hat() - of([](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 1.0 - x; }))
            .abs()
            .maxCoeff() <= 1e-15);
    BOOST_TEST((basis.right_hat() - of([](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return x; }))
                   .abs()
                   .maxCoeff() <= 1e-15);
}

BOOST_AUTO_TEST_CASE(meshes_without_a_fast_transform_and_graded_ones_go_the_general_way) {
    const ProblemData problem = swinging_problem();
    BOOST_TEST(SineForm::suits(problem, Mesh::uniform(1000000), Scheme{}, {}));
    BOOST_TEST(SineForm::suits(problem, Mesh::uniform(1), Scheme{}, {}));
    BOOST_TEST(!SineForm::suits(problem, Mesh::uniform(34), Scheme{}, {}));
    Mesh graded = Mesh::uniform(10);
    graded.nodes(5) += 0.01;
    graded.lengths(4) += 0.01;
    graded.lengths(5) -= 0.01;
    BOOST_TEST(!SineForm::suits(problem, graded, Scheme{}, {}));
    BOOST_TEST(!SineForm::suits(problem, Mesh::uniform(10), {.basis = Basis::nodal}, {}));
}

BOOST_DATA_TEST_CASE(errors_are_those_of_the_nodal_form,
                     data::make(shipped_names()) * data::make(TimeScheme::names()) *
                         data::make({ThermalMass::consistent, ThermalMass::lumped}) *
                         data::make({1, 2, 3, 14, 40, 64}) * data::make({false, true}),
                     name, time, mass, elements, all) {
    if (short_tests &&
        !is_swept(position(shipped_names(), name) + position(TimeScheme::names(), time) +
                      static_cast<std::size_t>(elements) + (all ? 1 : 0) +
                      (mass == ThermalMass::lumped ? 1 : 0),
                  4))
        return;
    const Beam beam{.alpha = 0.4,
                    .zeta = 0.1,
                    .theta_A = name == "heated-end" ? 0.7 : 0.0,
                    .stops = {-0.02, 0.1, epsilon_for(name)}};
    static std::map<std::string, ProblemData> derived; // which takes longer than a run
    const auto [place, is_new] = derived.try_emplace(name);
    if (is_new)
        place->second =
            manufactured_problem({read_solution(find_file(Shipped::solution, name)), beam, 2.0});
    const ProblemData& problem = place->second;
    const auto norms = norms_of(all ? Norm::names() : sine_norms);
    const Mesh mesh =
        resolution_of(problem, {Algorithm::direct}, norms, 2.0).on(Mesh::uniform(elements));
    Scheme scheme{Algorithm::direct, mass, 0.0, TimeScheme::named(time)};
    if (!SineForm::suits(problem, mesh, scheme, norms))
        return; // a source that does not separate
    // 150 steps: blocks of 64 and a shorter one, contact and release within them.
    SineForm form(beam, problem, mesh, scheme, 2.0, 150, norms, ErrorNorms::needs(problem, norms));
    BOOST_REQUIRE((form.march({}) == RunStatus::ok));
    scheme.basis = Basis::nodal;
    const RunResult nodal = run({beam, mesh, scheme, 2.0, 150, norms}, problem);
    for (std::size_t k = 0; k < norms.size(); ++k)
        BOOST_TEST(std::abs(form.errors()[k] - nodal.errors[k]) <= 1e-12 + 1e-10 * nodal.errors[k],
                   norms[k].name << " " << form.errors()[k] << " " << nodal.errors[k]);
    BOOST_TEST(form.counters().contact_steps == nodal.counters.contact_steps);
    BOOST_TEST(form.counters().contact_changes == nodal.counters.contact_changes);
}

// A strong coupling for a short time: the curvature's modes are large, and cancel in the errors up
// to the highest.
BOOST_DATA_TEST_CASE(errors_are_those_of_the_nodal_form_where_many_modes_cancel,
                     data::make({160, 1000}) * data::make({20.0, 1000.0}) *
                         data::make({ThermalMass::consistent, ThermalMass::lumped}),
                     elements, alpha, mass) {
    const Beam beam{.alpha = alpha, .zeta = 1e-3};
    const ProblemData problem =
        manufactured_problem({parse_solution("name = \"strong\"\n"
                                             "theta = \"-0.5*(x - x^3)*exp(-t)\"\n"
                                             "u = \"0.01*(1 - cos(3*x))*cos(t)\"\n",
                                             "strong"),
                              beam, 0.01});
    const auto norms = norms_of(Norm::names());
    Scheme scheme{Algorithm::direct, mass, 0.0, TimeScheme::named("sdirk2")};
    const RunResult sine = run({beam, Mesh::uniform(elements), scheme, 0.01, 100, norms}, problem);
    scheme.basis = Basis::nodal;
    const RunResult nodal = run({beam, Mesh::uniform(elements), scheme, 0.01, 100, norms}, problem);
    BOOST_TEST(sine.counters.sine_steps > 0);
    // Of αθ, of which the curvature is a part, where |θ| < 0.2: a few units.
    const double round_off = 4.0 * std::numeric_limits<double>::epsilon() * 0.2 * alpha;
    for (std::size_t k = 0; k < norms.size(); ++k)
        BOOST_TEST(std::abs(sine.errors[k] - nodal.errors[k]) <= 1e-4 * nodal.errors[k] + round_off,
                   norms[k].name << " " << sine.errors[k] << " " << nodal.errors[k]);
}

// Modes march in blocks of 64 steps. Here the contact ends anywhere in one: also with its last
// step, so that the march begins the next block on a stop and finds it free throughout.
BOOST_DATA_TEST_CASE(a_contact_may_end_with_any_step_of_a_block, data::make(TimeScheme::names()),
                     time) {
    const Beam beam{.alpha = 0.4, .zeta = 0.15, .stops = {-0.02, 0.1}};
    const ProblemData problem = manufactured_problem(
        {read_solution(find_file(Shipped::solution, "released-from-g2")), beam, 2.0});
    const auto norms = norms_of(sine_norms);
    const Mesh mesh = resolution_of(problem, {Algorithm::direct}, norms, 2.0).on(Mesh::uniform(20));
    Scheme scheme{Algorithm::direct, ThermalMass::consistent, 0.0, TimeScheme::named(time)};
    bool ends_a_block = false;
    for (std::int64_t steps = 146; steps < 160; ++steps) {
        scheme.basis = Basis::automatic;
        SineForm form(beam, problem, mesh, scheme, 2.0, steps, norms,
                      ErrorNorms::needs(problem, norms));
        BOOST_REQUIRE((form.march({}) == RunStatus::ok));
        scheme.basis = Basis::nodal;
        const RunResult nodal = run({beam, mesh, scheme, 2.0, steps, norms}, problem);
        for (std::size_t k = 0; k < norms.size(); ++k)
            BOOST_TEST(std::abs(form.errors()[k] - nodal.errors[k]) <= 1e-10 * nodal.errors[k],
                       norms[k].name << ", " << steps << " steps");
        ends_a_block =
            ends_a_block || (nodal.counters.contact_steps - scheme.time.history) % 64 == 0;
    }
    BOOST_TEST(ends_a_block);
}

BOOST_DATA_TEST_CASE(a_wave_that_vanishes_at_the_nodes_is_not_taken_for_linear,
                     data::make({1, 2, 3, 16}), elements) {
    // 1 − cos(2sπx) heats every element alike and is zero at all nodes; so is the exact solution.
    const double waves = 2.0 * std::numbers::pi * elements;
    ProblemData problem = forced_problem(
        {{[](double t) { return 1.0 + t; },
          [waves](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 1.0 - (waves * x).cos(); }}});
    problem.exact = ExactSolution{};
    problem.exact->theta = problem.heat_source;
    const auto norms = norms_of({"theta_L2L2", "u_LinfH2semi"});
    const Beam beam{.alpha = 0.4, .zeta = 0.1};
    Scheme scheme;
    const RunResult sine = run({beam, Mesh::uniform(elements), scheme, 2.0, 50, norms}, problem);
    scheme.basis = Basis::nodal;
    const RunResult nodal = run({beam, Mesh::uniform(elements), scheme, 2.0, 50, norms}, problem);
    for (std::size_t k = 0; k < norms.size(); ++k)
        BOOST_TEST(sine.errors[k] == nodal.errors[k], boost::test_tools::tolerance(1e-11));
}

BOOST_DATA_TEST_CASE(contact_is_that_of_the_nodal_form_through_onsets_and_releases,
                     data::make({0.0, 0.8}) * data::make(TimeScheme::names()) *
                         data::make({1, 3, 40}),
                     alpha, time, elements) {
    // Against θ = 0, u = 0 the errors are the norms of the solution itself.
    const Beam beam{.alpha = alpha, .zeta = 0.02, .theta_A = 0.3, .stops = {-0.02, 0.1}};
    ProblemData problem = swinging_problem();
    problem.exact = ExactSolution{};
    const auto norms = norms_of(elements > 3 ? Norm::names() : sine_norms);
    Scheme scheme{.time = TimeScheme::named(time)};
    const RunResult sine = run({beam, Mesh::uniform(elements), scheme, 2.0, 500, norms}, problem);
    scheme.basis = Basis::nodal;
    const RunResult nodal = run({beam, Mesh::uniform(elements), scheme, 2.0, 500, norms}, problem);
    BOOST_TEST(nodal.counters.contact_steps > 100);
    BOOST_TEST(nodal.counters.contact_steps < 470);
    BOOST_TEST(sine.counters.contact_steps == nodal.counters.contact_steps);
    BOOST_TEST(sine.counters.contact_changes == nodal.counters.contact_changes);
    BOOST_TEST(sine.counters.sine_steps == sine.counters.steps);
    BOOST_TEST(nodal.counters.sine_steps == 0);
    for (std::size_t k = 0; k < norms.size(); ++k)
        BOOST_TEST(sine.errors[k] == nodal.errors[k], boost::test_tools::tolerance(1e-11));
}

// With contact, without, and in each case with and without coupling: what falls back to nodal
// values gives the same results and would not be noticed.
BOOST_DATA_TEST_CASE(every_scheme_and_mass_runs_in_the_sine_basis,
                     data::make(TimeScheme::names()) *
                         data::make({ThermalMass::consistent, ThermalMass::lumped}) *
                         data::make({0.0, 0.8}) * data::make({false, true}),
                     time, mass, alpha, stops) {
    Beam beam{.alpha = alpha, .zeta = 0.02};
    if (stops)
        beam.stops = {-0.02, 0.1};
    ProblemData problem = swinging_problem();
    problem.exact = ExactSolution{};
    const Scheme scheme{.thermal_mass = mass, .time = TimeScheme::named(time)};
    const RunResult result =
        run({beam, Mesh::uniform(40), scheme, 2.0, 150, norms_of(sine_norms)}, problem);
    BOOST_TEST((result.status == RunStatus::ok), result.reason);
    BOOST_TEST(result.counters.steps == 150);
    BOOST_TEST(result.counters.sine_steps == 150);
    BOOST_TEST((result.counters.contact_steps > 0) == stops);
}

// What the sine basis cannot measure goes the general way, and neither takes for 0 what it does not
// measure: against u = 0, θ = 0 every quantity of the swinging beam is an error, so that one which
// is added to the list and measured by neither fails here.
BOOST_DATA_TEST_CASE(every_quantity_is_measured_in_one_of_the_bases_at_least,
                     data::xrange(quantity_count), q) {
    Norm norm{"one quantity", "", {{TimeNorm::Kind::L2, {}}}};
    norm.parts.front().quantities[q] = true;
    ProblemData problem = swinging_problem();
    problem.exact = ExactSolution{};
    const Beam beam{.alpha = 0.8, .zeta = 0.02, .stops = {-0.02, 0.1}};
    const auto run_in = [&](Basis basis) {
        return run({beam, Mesh::uniform(10), {.basis = basis}, 2.0, 150, {norm}}, problem);
    };
    const RunResult automatic = run_in(Basis::automatic);
    const RunResult nodal = run_in(Basis::nodal);
    BOOST_TEST_REQUIRE((nodal.status == RunStatus::ok), nodal.reason);
    BOOST_TEST(nodal.errors[0] > 1e-3);
    BOOST_TEST(automatic.errors[0] == nodal.errors[0], boost::test_tools::tolerance(1e-11));
    const bool measured = std::any_of(SineErrors::measured.begin(), SineErrors::measured.end(),
                                      [&](Quantity quantity) { return index(quantity) == q; });
    BOOST_TEST(automatic.counters.sine_steps == (measured ? 150 : 0));
}

BOOST_DATA_TEST_CASE(what_is_not_finite_is_reported_as_in_nodal_values,
                     data::make({Basis::automatic, Basis::nodal}), basis) {
    // The source overflows in step 71 of 100, t = 1.42: exp(500 t) passes 1.8e308 at t = 1.4195.
    const ProblemData problem =
        forced_problem({{[](double t) { return std::exp(500.0 * t); },
                         [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return x * (1.0 - x); }}});
    const RunResult result =
        run({Beam{.alpha = 0.1, .zeta = 0.1}, Mesh::uniform(10), {.basis = basis}, 2.0, 100, {}},
            problem);
    BOOST_TEST((result.status == RunStatus::failed));
    BOOST_TEST(result.reason == "the temperature is not finite in step 71 of 100, t = 1.42: a "
                                "formula of the problem has no finite value in that step");
}

BOOST_DATA_TEST_CASE(a_temperature_that_is_not_finite_ends_the_block_in_which_contact_begins,
                     data::make(TimeScheme::names()) *
                         data::make({1.0, std::numeric_limits<double>::infinity()}),
                     time, heat) {
    // Without coupling nothing but the temperature itself tells. The shear load moves the tip past
    // a stop within the first block, so that the responses are looked for there.
    const ProblemData problem =
        forced_problem({{[](double) { return -3.0; }, {}},
                        {[heat](double) { return heat; },
                         [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return x * (1.0 - x); }}});
    const Beam beam{.alpha = 0.0, .zeta = 0.02, .stops = {-0.02, 0.1}};
    const Scheme scheme{.time = TimeScheme::named(time)};
    SineForm form(beam, problem, Mesh::uniform(10), scheme, 0.5, 20, {}, {true, true, false});
    BOOST_TEST((form.march({}) == RunStatus::ok) == std::isfinite(heat));
    if (std::isfinite(heat))
        BOOST_TEST(form.counters().contact_steps > 0);
}

BOOST_AUTO_TEST_SUITE_END()

// Sharp functions: what the rule of six points does not integrate on an element is integrated on
// its cells, and what these do not resolve is said.

#include "core/space/resolution.hpp"

#include "core/norms/quadrature_uncertainty.hpp"
#include "core/run.hpp"
#include "core/space/linear_elements.hpp"
#include "core/space/profile.hpp"
#include "core/space/quadrature.hpp"
#include "mms/manufactured_problem.hpp"
#include "mms/solution.hpp"
#include "tests/marching.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace tvbeam;
using Eigen::ArrayXd;
using Eigen::Index;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(resolutions)

namespace {

struct Named {
    std::string name;
    SpaceFunction function;
};

std::ostream& operator<<(std::ostream& stream, const Named& named) {
    return stream << named.name;
}

/// exp(−((x − centre)/width)²)
SpaceFunction spike(double centre, double width) {
    return [=](const ArrayXd& x) -> ArrayXd { return (-((x - centre) / width).square()).exp(); };
}

const std::vector<Named> sharp_functions{
    {"tanh(60 (x - 1/2))", [](const ArrayXd& x) -> ArrayXd { return (60.0 * (x - 0.5)).tanh(); }},
    {"a spike of width 1e-4 by itself", spike(0.337, 1e-4)},
    {"a spike of width 1e-4 on a wave",
     [](const ArrayXd& x) -> ArrayXd {
         return (std::numbers::pi * x).sin() + spike(0.337, 1e-4)(x);
     }},
    {"sqrt(x)", [](const ArrayXd& x) -> ArrayXd { return x.sqrt(); }},
    {"(1 - x)^(3/4)", [](const ArrayXd& x) -> ArrayXd { return (1.0 - x).pow(0.75); }},
    {"a kink", [](const ArrayXd& x) -> ArrayXd { return (x - 0.3).abs(); }},
    {"a fast wave", [](const ArrayXd& x) -> ArrayXd { return (400.0 * x).sin(); }},
};

const std::vector<MeshFamily> families{
    {}, {.grading = 1.5, .nodes = {}}, {.grading = 1.0, .nodes = {0.0, 0.25, 1.0}}};

/// A resolution that takes no part in the search: the sixtieth part of 1/8 and less everywhere.
Resolution fine_everywhere(Index parts) {
    std::vector<Interval> intervals;
    for (Index i = 0; i < parts; ++i)
        intervals.push_back({static_cast<double>(i) / static_cast<double>(parts),
                             1.0 / static_cast<double>(parts)});
    return Resolution(intervals);
}

/// The resolution of one profile.
Resolution resolution_of(const SpaceFunction& profile) {
    ProblemData data;
    data.profiles = {profile};
    data.heat_source.terms = {{0, 0}};
    return resolve(data, {&data.heat_source}, 1.0);
}

/// ∫_left^right g dx by sixty points on each of many parts, which crowd towards both ends of [0,
/// 1], where roots are, and towards the kink.
double by_sixty_points(const SpaceFunction& g, double left, double right) {
    static const GaussRule rule = GaussRule::of(60);
    std::vector<double> cuts{left, right};
    for (int k = 0; k <= 2000; ++k)
        cuts.push_back(k / 2000.0);
    for (int k = 11; k < 50; ++k)
        for (const double singular : {0.0, 0.3, 1.0})
            for (const double side : {-1.0, 1.0})
                cuts.push_back(singular + side * std::ldexp(1.0, -k));
    cuts.push_back(0.3);
    std::sort(cuts.begin(), cuts.end());
    double sum = 0.0;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if (cuts[i - 1] < left || cuts[i] > right || cuts[i] == cuts[i - 1])
            continue;
        const double h = cuts[i] - cuts[i - 1];
        sum += h * (rule.weights * g(cuts[i - 1] + h * rule.points)).sum();
    }
    return sum;
}

} // namespace

BOOST_DATA_TEST_CASE(loads_and_squares_of_a_sharp_function_are_those_of_sixty_points,
                     data::make(sharp_functions) * data::make({1, 2, 8}) *
                         data::xrange(families.size()),
                     sharp, s, family) {
    const Index elements = family == 2 ? 2 * s : s;
    const SpaceFunction& phi = sharp.function;
    const Mesh mesh = resolution_of(phi).on(families[family].with(elements));
    const double norm = std::sqrt(
        by_sixty_points([&](const ArrayXd& x) -> ArrayXd { return phi(x).square(); }, 0.0, 1.0));

    Eigen::VectorXd loads = Eigen::VectorXd::Zero(elements + 1);
    double interpolation = 0.0;
    const ArrayXd nodal = phi(mesh.nodes);
    for (Index j = 0; j < elements; ++j) {
        const double left = mesh.nodes(j);
        const double h = mesh.nodes(j + 1) - left;
        for (Index side = 0; side < 2; ++side)
            loads(j + side) += by_sixty_points(
                [&](const ArrayXd& x) -> ArrayXd {
                    const ArrayXd xi = (x - left) / h;
                    return phi(x) * (side == 0 ? ArrayXd(1.0 - xi) : xi);
                },
                left, mesh.nodes(j + 1));
        interpolation += by_sixty_points(
            [&](const ArrayXd& x) -> ArrayXd {
                const ArrayXd xi = (x - left) / h;
                return (phi(x) - (1.0 - xi) * nodal(j) - xi * nodal(j + 1)).square();
            },
            left, mesh.nodes(j + 1));
    }
    // Rounding of the abscissae moves a spike of width d by ε/d of itself.
    BOOST_TEST((hat_loads(mesh, phi) - loads).cwiseAbs().maxCoeff() <= 1e-11 * norm);
    const ErrorProfiles errors = error_profiles(mesh, {phi});
    BOOST_TEST(std::abs(errors.interpolation(0, 0) - interpolation) <= 1e-11 * norm * norm);
    BOOST_TEST((errors.defect_load.col(0) +
                hat_loads(mesh,
                          [&] {
                              DiscontinuousLinear p(2, elements);
                              p << nodal.head(elements).transpose(),
                                  nodal.tail(elements).transpose();
                              return p;
                          }()) -
                loads)
                   .cwiseAbs()
                   .maxCoeff() <= 1e-11 * norm);
    // ‖φ − Πφ‖² = ‖φ‖² − (Πφ, φ), as the projection is orthogonal.
    const DiscontinuousLinear p = project(mesh, phi);
    BOOST_TEST(std::abs(errors.projection(0, 0) - (norm * norm - inner_product(mesh, p, p))) <=
               1e-11 * norm * norm);
}

// Differences pass relative to ‖φ‖ and ‖φ‖², and a factor that is a power of two rounds nothing.
BOOST_DATA_TEST_CASE(intervals_do_not_depend_on_the_unit_of_a_function,
                     data::make(sharp_functions) * data::make({0x1p-20, 0x1p20}), sharp, unit) {
    const auto ends = [](const Resolution& resolution) {
        std::vector<double> left;
        for (const Interval& interval : resolution.intervals())
            left.push_back(interval.left);
        return left;
    };
    const SpaceFunction scaled = [&, factor = unit](const ArrayXd& x) -> ArrayXd {
        return factor * sharp.function(x);
    };
    BOOST_TEST(ends(resolution_of(scaled)) == ends(resolution_of(sharp.function)),
               boost::test_tools::per_element());
}

BOOST_DATA_TEST_CASE(no_interval_is_more_than_twice_as_long_as_its_neighbour,
                     data::make(sharp_functions), sharp) {
    const Resolution found = resolution_of(sharp.function);
    const std::vector<Interval>& intervals = found.intervals();
    double greatest = 1.0;
    for (std::size_t i = 1; i < intervals.size(); ++i) {
        const double ratio = intervals[i].length / intervals[i - 1].length;
        greatest = std::max({greatest, ratio, 1.0 / ratio});
    }
    BOOST_TEST(greatest <= 2.0);
}

BOOST_AUTO_TEST_CASE(a_spike_is_found_wherever_it_stands) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0.1, 0.9);
    for (const double width : {1e-2, 1e-3, 1e-4, 5e-5})
        for (int k = 0; k < 50; ++k) {
            const SpaceFunction alone = spike(place(random), width);
            const SpaceFunction on_a_wave = [&](const ArrayXd& x) -> ArrayXd {
                return alone(x) + (std::numbers::pi * x).sin();
            };
            const double integral = std::sqrt(std::numbers::pi) * width; // of [−∞, ∞]
            const Mesh mesh = Mesh::uniform(3);
            BOOST_TEST(std::abs(hat_loads(resolution_of(alone).on(mesh), alone).sum() / integral -
                                1.0) <= 1e-9);
            BOOST_TEST(std::abs(hat_loads(resolution_of(on_a_wave).on(mesh), on_a_wave).sum() -
                                integral - 2.0 / std::numbers::pi) <= 1e-9 * integral + 1e-14);
        }
}

// erf((x - c)/d) shows wherever one looks; its second derivative is 0 but for 5e-5 of the beam. A
// hat has the load of that at c of -2 times its slope there.
BOOST_AUTO_TEST_CASE(a_source_is_found_where_its_solution_has_a_layer) {
    static constexpr double d = 1e-6;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(0.4, 0.6);
    for (int k = 0; k < 20; ++k) {
        const double c = place(random);
        const SpaceFunction layer = [c](const ArrayXd& x) -> ArrayXd {
            return x.unaryExpr([c](double at) { return std::erf((at - c) / d); });
        };
        const SpaceFunction source = [c](const ArrayXd& x) -> ArrayXd {
            const ArrayXd y = (x - c) / d;
            return -4.0 / std::sqrt(std::numbers::pi) / (d * d) * y * (-y.square()).exp();
        };
        ProblemData data;
        data.profiles = {source, layer};
        data.heat_source.terms = {{0, 0}};
        data.theta_initial.terms = {{0, 1}};
        const Mesh mesh = resolve(data, {&data.heat_source, &data.theta_initial}, 1.0)
                              .on(Mesh::uniform(3)); // c lies in the second element
        const Eigen::VectorXd loads = hat_loads(mesh, source);
        // Abscissae are rounded by up to ε/4, a part of 6e-11 of the layer, of which 2e6 is added
        // up in either sign.
        constexpr double rounding = 2e-4;
        BOOST_TEST(std::abs(loads(1) - 6.0) <= rounding);
        BOOST_TEST(std::abs(loads(2) + 6.0) <= rounding);
    }
}

BOOST_AUTO_TEST_CASE(what_is_smooth_on_the_elements_needs_no_cells) {
    const std::vector<SpaceFunction> smooth{
        [](const ArrayXd& x) -> ArrayXd { return (std::numbers::pi * x).sin(); },
        [](const ArrayXd& x) -> ArrayXd { return x.cube() / 6.0 - x.square() / 2.0; },
        [](const ArrayXd& x) -> ArrayXd { return (-x).exp(); }};
    for (const auto& phi : smooth)
        for (const Index s : {4, 10, 160})
            BOOST_TEST(!resolution_of(phi).on(Mesh::uniform(s)).cells);
}

BOOST_AUTO_TEST_CASE(cells_make_up_their_elements) {
    for (const auto& family : families) {
        const Mesh mesh = resolution_of(sharp_functions[1].function).on(family.with(6));
        BOOST_REQUIRE(mesh.cells);
        const Cells& cells = *mesh.cells;
        for (Index j = 0; j < 6; ++j) {
            const CellRange range = cells_of(mesh, j, 1);
            BOOST_TEST(cells.left(range.first) == 0.0);
            BOOST_TEST(cells.share.segment(range.first, range.count).sum() == 1.0);
            BOOST_TEST(cells.mesh.nodes(range.first) == mesh.nodes(j));
        }
        // A function that is linear on the elements has loads without an error.
        const SpaceFunction line = [](const ArrayXd& x) -> ArrayXd { return 2.0 - 3.0 * x; };
        BOOST_TEST((hat_loads(mesh, line) - hat_loads(family.with(6), line)).norm() <= 1e-15);
    }
}

namespace {

const Beam beam{.alpha = 0.3, .zeta = 0.1};

/// A sharp solution as text; front: where tanh changes sign.
ProblemData sharp_problem(const std::string& front) {
    return manufactured_problem(
        {parse_solution("name = \"sharp\"\n"
                        "theta = \"x*(1 - x)*(1 + t)*tanh(60*(x - " +
                            front +
                            "))\"\n"
                            "u = \"x^2*(3 - x)*sin(t)/100 + x^2*t*tanh(60*(x - " +
                            front + "))/1000\"\n",
                        "sharp"),
         beam, 1.0});
}

std::vector<Norm> all_norms() {
    std::vector<Norm> norms;
    for (const auto& name : Norm::names())
        norms.push_back(*Norm::named(name));
    return norms;
}

} // namespace

// [0, 1/2], [1/2, 3/4], [3/4, 1]: the element [1/3, 2/3] meets the first, which is long enough for
// it, and the second, which is not; [2/3, 1] meets the others. Each is halved.
BOOST_AUTO_TEST_CASE(no_cell_is_longer_than_any_interval_that_it_meets) {
    const Resolution resolution({{0.0, 0.5}, {0.5, 0.25}, {0.75, 0.25}});
    const Mesh cut = resolution.on(Mesh::uniform(3));
    BOOST_REQUIRE(cut.cells);
    BOOST_TEST(cut.cells->first == (std::vector<Index>{0, 1, 3, 5}),
               boost::test_tools::per_element());
    BOOST_TEST(!resolution.on(Mesh::uniform(4)).cells);
}

BOOST_DATA_TEST_CASE(runs_agree_with_a_quadrature_that_is_fine_everywhere,
                     data::make({"1/2", "1/2 - t/10"}) * data::make(all_runs), front, scheme) {
    if (short_tests && front == std::string("1/2"))
        return;
    ProblemData found = sharp_problem(front);
    ProblemData fine = found;
    fine.resolution = std::make_shared<const Resolution>(fine_everywhere(1024));
    ProblemData six_points = found;
    six_points.resolution = std::make_shared<const Resolution>();
    found.resolution = std::make_shared<const Resolution>(
        resolution_of(found, {Algorithm::direct, Algorithm::fixed_point}, all_norms(), 1.0));
    for (std::size_t family = 0; family < families.size(); ++family)
        for (const Index s : {2, 8}) {
            const RunRequest request{.beam = beam,
                                     .mesh = families[family].with(s),
                                     .scheme = scheme,
                                     .final_time = 1.0,
                                     .steps = 10,
                                     // Those of the sine basis first, then all.
                                     .norms =
                                         s == 2 ? all_norms()
                                                : std::vector<Norm>{*Norm::named("theta_L2L2"),
                                                                    *Norm::named("u_LinfH2semi")}};
            const RunResult here = run(request, found);
            const RunResult there = run(request, fine);
            BOOST_REQUIRE_EQUAL(here.reason, "");
            BOOST_REQUIRE_EQUAL(there.reason, "");
            BOOST_TEST(here.uncertainties.empty());
            double wrong = 0.0;
            const RunResult plain = run(request, six_points);
            for (std::size_t k = 0; k < here.errors.size(); ++k) {
                if (there.errors[k] == 0.0)
                    continue;
                BOOST_TEST(std::abs(here.errors[k] / there.errors[k] - 1.0) <= 1e-9,
                           request.norms[k].name << " s = " << s << " family " << family << ": "
                                                 << here.errors[k] << " " << there.errors[k]);
                wrong = std::max(wrong, std::abs(plain.errors[k] / there.errors[k] - 1.0));
            }
            // Six points an element are not enough here, or the test says nothing.
            BOOST_TEST(wrong > 1e-2);
        }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_resolved_is_said_until_the_mesh_resolves_it) {
    // The pointed waves sin(10⁶ x) need more intervals than there may be.
    const SpaceFunction wave = [](const ArrayXd& x) -> ArrayXd { return (1e6 * x).sin(); };
    const Resolution found = resolution_of(wave);
    BOOST_TEST(!found.is_certain());
    BOOST_TEST(found.uncertainty(found.on(Mesh::uniform(8))) > 1e-2);
    BOOST_TEST(found.uncertainty(found.on(Mesh::uniform(2000000))) < 1e-10);

    // A spike that runs along the beam: no few intervals resolve all places where it is.
    ProblemData problem = manufactured_problem(
        {parse_solution(
             "name = \"spike\"\nu = \"0\"\n"
             "theta = \"x*(1 - x)*exp(-((x - 0.2 - t/2)/w)^2)\"\n[parameters]\nw = 3e-5\n",
             "spike"),
         beam, 1.0});
    const RunResult result =
        run({.beam = beam,
             .mesh = Mesh::uniform(8),
             .scheme = {},
             .final_time = 1.0,
             .steps = 10,
             .norms = {*Norm::named("theta_L2L2"), *Norm::named("theta_L2L2_sq")}},
            problem);
    BOOST_REQUIRE_EQUAL(result.reason, "");
    BOOST_REQUIRE(result.uncertainties.size() == 2);
    BOOST_TEST(result.uncertainties[0] > 0.01);
    // That of a square is said of the norm itself.
    BOOST_TEST(result.uncertainties[1] == result.uncertainties[0],
               boost::test_tools::tolerance(1e-12));
}

// sin πt sin 10⁶x: the load is greatest half way, of the norm 1/√2, and nothing at the end.
BOOST_AUTO_TEST_CASE(what_is_uncertain_of_a_load_is_measured_where_it_is_greatest) {
    const SpaceFunction wave = [](const ArrayXd& x) -> ArrayXd { return (1e6 * x).sin(); };
    ProblemData problem;
    problem.profiles = {wave};
    problem.amplitudes = [](const ArrayXd& t) -> Eigen::ArrayXXd {
        return (std::numbers::pi * t).sin().transpose();
    };
    problem.amplitude_count = 1;
    problem.heat_source.terms = {{0, 0}};
    problem.exact.emplace();
    const Resolution found = resolution_of(wave);
    const Mesh mesh = found.on(Mesh::uniform(8));
    const auto parts = quadrature_uncertainties(problem, {&problem.heat_source}, found, mesh,
                                                {*Norm::named("theta_L2L2")}, {1.0}, 1.0);
    BOOST_REQUIRE(parts.size() == 1);
    BOOST_TEST(parts[0] == found.uncertainty(mesh) * std::sqrt(0.5),
               boost::test_tools::tolerance(0.05));
}

// θ = sin 10⁶x at all times: ‖θ‖ over a time of 4 is √(4/2), and with an error of 1 and no load
// uncertain are δ‖θ‖ of what moves the solution and the lesser of √δ‖θ‖ and δ‖θ‖²/2 of the
// integral.
BOOST_AUTO_TEST_CASE(what_is_uncertain_of_a_norm_in_time_is_measured_over_all_of_it) {
    const SpaceFunction wave = [](const ArrayXd& x) -> ArrayXd { return (1e6 * x).sin(); };
    ProblemData problem;
    problem.profiles = {wave};
    problem.amplitudes = [](const ArrayXd& t) -> Eigen::ArrayXXd {
        return Eigen::ArrayXXd::Ones(1, t.size());
    };
    problem.amplitude_count = 1;
    problem.exact.emplace();
    problem.exact->theta.terms = {{0, 0}};
    const Resolution found = resolution_of(wave);
    const Mesh mesh = found.on(Mesh::uniform(8));
    const auto parts = quadrature_uncertainties(problem, {}, found, mesh,
                                                {*Norm::named("theta_L2L2")}, {1.0}, 4.0);
    BOOST_REQUIRE(parts.size() == 1);
    const double delta = found.uncertainty(mesh);
    BOOST_TEST(parts[0] == delta * std::sqrt(2.0) + std::min(std::sqrt(2.0 * delta), delta),
               boost::test_tools::tolerance(0.05));
}

// μ is what the moment form integrates, G what the Hermite form does; f and q are looked at for
// both.
BOOST_AUTO_TEST_CASE(a_run_resolves_the_loads_of_its_own_algorithm) {
    const auto has_cells = [](Field ProblemData::*load, Algorithm algorithm) {
        ProblemData problem;
        problem.profiles = {spike(0.337, 1e-3)};
        (problem.*load).terms = {{0, 0}};
        return resolution_of(problem, {algorithm}, {}, 1.0).on(Mesh::uniform(8)).cells != nullptr;
    };
    for (const Algorithm algorithm : {Algorithm::direct, Algorithm::fixed_point}) {
        const bool direct = algorithm == Algorithm::direct;
        BOOST_TEST(has_cells(&ProblemData::moment_load, algorithm) == direct);
        BOOST_TEST(has_cells(&ProblemData::couple_load, algorithm) == !direct);
        BOOST_TEST(has_cells(&ProblemData::body_force, algorithm));
        BOOST_TEST(has_cells(&ProblemData::heat_source, algorithm));
    }
}

BOOST_AUTO_TEST_SUITE_END()

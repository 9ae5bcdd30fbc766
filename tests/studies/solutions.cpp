// Every shipped solution, by every time scheme, on uniform meshes and on graded ones: order 2 in h,
// and in dt the order that the scheme claims. Where a kink, a switch or the spaces leave another
// order, it stands below with its reason.

#include "mms/forecast/expected_orders.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/study.hpp"
#include "tests/marching.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(shipped_solutions)

namespace {

/// All but the one whose rates jump within a run, which takes orders from schemes that look back:
/// its orders are those forecast (forecasts.cpp).
std::vector<std::string> solutions() {
    std::vector<std::string> names;
    for (const auto& file : shipped_files(Shipped::solution))
        if (file.name != "jumping-front")
            names.push_back(file.name);
    return names;
}

std::vector<std::string> schemes() {
    // One scheme of two stages exercises all the code; the orders are those of any build.
    return short_tests ? std::vector<std::string>{"sdirk2"} : TimeScheme::names();
}

bool is_of(const Scene& scene, const std::string& solution) {
    const auto* own = std::get_if<Solution>(&scene.problem);
    return own != nullptr && own->name == solution && scene.scheme.algorithm == Algorithm::direct &&
           scene.get<LadderBlock>() != nullptr && !scene.defect;
}

/// The shipped scenes that have expectations, read once.
const std::vector<Scene>& expecting_scenes() {
    static const std::vector<Scene> scenes = [] {
        std::vector<Scene> read;
        for (const auto& file : shipped_files(Shipped::scene)) {
            Scene scene = read_scene(file.name, {}, {.expectations = true});
            if (!scene.expectations.empty())
                read.push_back(std::move(scene));
        }
        return read;
    }();
    return scenes;
}

/// The scene that studies a solution: that of its name, or else the first that names it. On uniform
/// meshes and against the exact solution.
Scene scene_of(const std::string& solution) {
    std::vector<Scene> scenes;
    for (const Scene& scene : expecting_scenes())
        if (is_of(scene, solution))
            scenes.push_back(scene);
    BOOST_REQUIRE_MESSAGE(!scenes.empty(), "no scene checks " << solution);
    const auto own = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const Scene& scene) { return scene.name == solution; });
    Scene scene = own == scenes.end() ? scenes.front() : *own;
    scene.mesh = {};
    scene.reference.reset();
    return scene;
}

const std::vector<std::string> norms{"theta_L2L2", "u_LinfH2semi"};

/// The order of each of the norms between two runs.
std::vector<double> orders(Scene scene, const Rung& coarse, const Rung& fine) {
    LadderBlock ladder{.final_time = scene.get<LadderBlock>()->final_time,
                       .rungs = {coarse, fine},
                       .norms = {},
                       .printed = {}};
    for (const auto& name : norms)
        ladder.norms.push_back(measure_of(*Norm::named(name)));
    scene.blocks.set(ladder);
    scene.blocks.remove<OrdersBlock>();
    scene.blocks.remove<EvolutionBlock>();
    const StudyResult result = run_study(scene);
    std::vector<double> found;
    for (std::size_t k = 0; k < norms.size(); ++k) {
        const auto& rungs = result.get<LadderResult>()->rungs;
        BOOST_REQUIRE_MESSAGE(rungs[0].status == RungStatus::ok &&
                                  rungs[1].status == RungStatus::ok,
                              rungs[0].reason << rungs[1].reason);
        found.push_back(std::log2(rungs[0].errors[k] / rungs[1].errors[k]));
    }
    return found;
}

Rung rung(const Scene& scene, std::int64_t elements, std::int64_t steps) {
    return {elements, steps, scene.get<LadderBlock>()->final_time / static_cast<double>(steps)};
}

/// What is refined.
enum class Refined { mesh, step, step_on_graded_mesh };

std::ostream& operator<<(std::ostream& stream, Refined what) {
    return stream << (what == Refined::mesh ? "h" : "dt");
}

struct Exceptional {
    std::string solution;
    std::string scheme;
    Refined refined; ///< step: on graded meshes too
    std::string norm;
    double least;
    double greatest;
    std::string reason;
};

const std::string across = "BDF2 looks back across the jump of u_xxt at the impact";
const std::string instant =
    "on a mesh the contact begins or ends at an instant of its own, as the tip has a space error; "
    "there u_xxt of what is computed jumps, and a scheme finds it to one step";

const std::vector<Exceptional> exceptions = {
    {"impact", "bdf2", Refined::step, "theta_L2L2", 0.95, 1.05, across},
    {"impact", "bdf2", Refined::step, "u_LinfH2semi", 0.95, 1.05, across},
    {"impact", "sdirk2", Refined::step, "theta_L2L2", 1.5, 2.05, instant},
    {"pressed-on-g1", "bdf2", Refined::step, "u_LinfH2semi", 1.5, 2.05, instant},
    {"released-from-g2", "sdirk2", Refined::step, "theta_L2L2", 1.5, 2.05, instant},
    {"touch-without-force", "bdf2", Refined::step, "u_LinfH2semi", 1.5, 2.05, instant},
    {"touch-without-force", "sdirk2", Refined::step_on_graded_mesh, "u_LinfH2semi", 1.5, 2.5,
     instant},
};

void check_orders(const std::vector<double>& found, double expected, const std::string& solution,
                  const std::string& scheme, Refined refined) {
    for (std::size_t k = 0; k < norms.size(); ++k) {
        const auto exception =
            std::find_if(exceptions.begin(), exceptions.end(), [&](const Exceptional& e) {
                return e.solution == solution && e.scheme == scheme && e.norm == norms[k] &&
                       (e.refined == refined ||
                        (e.refined == Refined::step && refined == Refined::step_on_graded_mesh));
            });
        const bool known = exception != exceptions.end();
        const double least = known ? exception->least : expected - 0.05;
        const double greatest = known ? exception->greatest : expected + 0.05;
        BOOST_TEST_MESSAGE(solution << ", " << scheme << ": " << norms[k] << ", order in "
                                    << refined << ": " << found[k]);
        BOOST_TEST((found[k] >= least && found[k] <= greatest),
                   norms[k] << " has the order " << found[k] << " in " << refined << "; expected "
                            << least << " to " << greatest
                            << (known ? ": " + exception->reason : ""));
    }
}

} // namespace

// Against the exact solution. dt ~ h^(2/q), so that a time error of the order q falls like h², too.
BOOST_DATA_TEST_CASE(space_error_has_order_two,
                     data::make(solutions()) * data::make(schemes()) * data::make({1.0, 2.0}),
                     solution, scheme, grading) {
    Scene scene = scene_of(solution);
    scene.mesh.grading = grading;
    scene.scheme.time = TimeScheme::named(scheme);
    const auto at = [&](std::int64_t s) {
        return rung(scene, s, scene.scheme.time.order == 1 ? s * s : 8 * s);
    };
    const std::int64_t coarse = scene.mesh.is_uniform() ? 32 : 24;
    check_orders(orders(scene, at(coarse), at(2 * coarse)), 2.0, solution, scheme, Refined::mesh);
}

/// A mesh for orders in time. The tip that is computed goes into yielding stops, and u_xxt of it
/// has kinks there, at instants and with sizes that differ from the exact ones, which have none, by
/// the error of space: a finer mesh keeps them out of sight.
std::int64_t elements_in_time(const std::string& solution, std::int64_t usual, std::int64_t fine) {
    return solution == "penalised-stops" ? fine : usual;
}

// On one mesh, against a run with much smaller steps: the space error is in both and drops out. An
// order q seen against the step dt/r is too high by (2^q − 1) r^(−q)/ln 2: 0.01 for q = 1 and
// r = 128, 0.004 for q = 2 and r = 32.
BOOST_DATA_TEST_CASE(time_error_has_the_order_of_the_scheme,
                     data::make(solutions()) * data::make(schemes()), solution, scheme) {
    Scene scene = scene_of(solution);
    scene.scheme.time = TimeScheme::named(scheme);
    const int order = scene.scheme.time.order;
    constexpr std::int64_t coarse = 256;
    const std::int64_t finest = coarse * (order == 1 ? 128 : 32);
    const std::int64_t elements = elements_in_time(solution, 32, 512);
    scene.reference = ReferenceBlock{.elements = elements, .dt = rung(scene, elements, finest).dt};
    check_orders(orders(scene, rung(scene, elements, coarse), rung(scene, elements, 2 * coarse)),
                 order, solution, scheme, Refined::step);
}

/// Θ and U_xx at so many equal distances in time, on a mesh of the scene.
struct History {
    std::vector<Eigen::VectorXd> theta;
    std::vector<DiscontinuousLinear> w;
};

History history(const Scene& scene, const ProblemData& problem, const Mesh& mesh, int samples,
                int steps) {
    const double dt = scene.get<LadderBlock>()->final_time / steps;
    const auto solver = make_solver(scene.beam, problem, mesh, scene.scheme, dt, Needs{});
    History result;
    int n = 0;
    march(*solver, problem, scene.scheme.time, dt, steps, [&](double) {
        if (++n % (steps / samples) != 0)
            return;
        result.theta.emplace_back(solver->temperature());
        result.w.push_back(solver->curvature());
    });
    return result;
}

/// theta_L2L2, but for a factor, and u_LinfH2semi of the difference of two histories.
std::vector<double> distances(const Mesh& mesh, const History& a, const History& b) {
    double theta = 0.0;
    double w = 0.0;
    for (std::size_t k = 0; k < a.theta.size(); ++k) {
        theta += squared_norm(mesh, a.theta[k] - b.theta[k]);
        w = std::max(w, distance(mesh, a.w[k], b.w[k]));
    }
    return {std::sqrt(theta), w};
}

/// The short form leaves the others to the orders on uniform meshes, which run the same code.
std::vector<std::string> solutions_on_graded_meshes() {
    return short_tests ? std::vector<std::string>{"impact", "moving-front"} : solutions();
}

// The same on a graded mesh. An order q seen against the step dt/r is too high by
// (2^q − 1) r^(−q)/ln 2: 0.02 for q = 1 and r = 64, 0.004 for q = 2 and r = 32.
BOOST_DATA_TEST_CASE(time_error_on_a_graded_mesh_has_the_order_of_the_scheme,
                     data::make(solutions_on_graded_meshes()), solution) {
    Scene scene = scene_of(solution);
    const Mesh mesh = MeshFamily{1.5, {}}.with(elements_in_time(solution, 32, 128));
    const ProblemData problem = problem_of(scene, scene.get<LadderBlock>()->final_time);
    for (const auto& scheme : schemes()) {
        scene.scheme.time = TimeScheme::named(scheme);
        const int order = scene.scheme.time.order;
        const int coarse = order == 1 ? 128 : 256;
        const auto run = [&](int steps) { return history(scene, problem, mesh, coarse, steps); };
        const History finest = run(coarse * (order == 1 ? 64 : 32));
        const auto first = distances(mesh, run(coarse), finest);
        const auto second = distances(mesh, run(2 * coarse), finest);
        std::vector<double> found;
        for (std::size_t k = 0; k < norms.size(); ++k)
            found.push_back(std::log2(first[k] / second[k]));
        check_orders(found, order, solution, scheme, Refined::step_on_graded_mesh);
    }
}

// Where the spaces hold a solution, a mesh twice as fine takes away next to nothing: only the time
// error has a part that falls with h. Elsewhere steps of a scheme of order 2 are small enough for
// the space error to show.
BOOST_DATA_TEST_CASE(where_no_order_in_h_is_forecast_no_mesh_matters, data::make(solutions()),
                     solution) {
    Scene scene = scene_of(solution);
    scene.scheme.time = TimeScheme::named("sdirk2");
    const auto expected = expected_orders(
        {std::get<Solution>(scene.problem), scene.beam, scene.get<LadderBlock>()->final_time});
    const auto found = orders(scene, rung(scene, 16, 512), rung(scene, 32, 512));
    for (std::size_t k = 0; k < norms.size(); ++k) {
        const auto forecast =
            std::find_if(expected.orders.begin(), expected.orders.end(),
                         [&](const ExpectedOrder& order) { return order.norm == norms[k]; });
        BOOST_REQUIRE(forecast != expected.orders.end());
        if (forecast->in_h.has_error())
            BOOST_TEST(found[k] > 1.5, norms[k] << ": " << found[k]);
        else
            BOOST_TEST(std::abs(found[k]) < 0.05, norms[k] << ": " << found[k]);
    }
}

BOOST_AUTO_TEST_SUITE_END()

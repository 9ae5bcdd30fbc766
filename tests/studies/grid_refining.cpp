// `until` of a grid: meshes and steps are added until both orders are known. Made-up solvers, whose
// orders are known, say how often that is true, and what it costs.

#include "studies/grid/grid_refining.hpp"
#include "studies/grid/grid_lines.hpp"
#include "studies/scene/scene.hpp"
#include "tests/studies/draw.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(grid_refining)

namespace {

constexpr std::int64_t most = 64; ///< runs

Scene scene_of(const std::string& orders, const Reading& reading = {}) {
    const TemporaryDirectory directory;
    return read_scene(directory.write("scene.toml",
                                      "[solver]\ncommand = [\"true\"]\ntimeout = 10\n"
                                      "errors = { L2 = 'L2 = (\\S+)' }\n"
                                      "values = { drag = 'drag = (\\S+)' }\n"
                                      "[orders]\nfinal_time = 1\n" +
                                          orders),
                      {}, reading);
}

OrdersBlock block_of(const std::string& orders) {
    return *scene_of(orders).get<OrdersBlock>();
}

/// A solver whose error is a formula of h and Δt, and the grid that is asked of it:
///
///     T = h^p (1 + c h^k),  S = b Δt^q (1 + d Δt^l),  e² = T² + 2ρTS + S², with scatter.
struct MadeUp {
    double p = 0, q = 0, b = 0, rho = 0;
    double c = 0, d = 0;       ///< of the next terms
    double k = 1, l = 1;       ///< their powers
    double scatter = 0;        ///< of ln e
    double start = 0;          ///< mesh width from which on the order is p, if it starts slowly
    double cost = 1;           ///< of a step: the elements to this power
    double wanted = 0.05;
    std::uint64_t seed = 0;
    std::vector<std::int64_t> meshes = {};
    std::vector<std::int64_t> steps = {};

    [[nodiscard]] double error(const Rung& run) const {
        const double h = run.h();
        double t = std::pow(h, p) * (1 + c * std::pow(h, k));
        if (start > 0)
            t /= std::pow(1 + std::pow(h / start, 3), p / 3);
        const double s = b * std::pow(run.dt, q) * (1 + d * std::pow(run.dt, l));
        Draw noise(seed * 1000003 + static_cast<std::uint64_t>(run.elements * 7919 + run.steps));
        return std::sqrt(t * t + 2 * rho * t * s + s * s) * std::exp(scatter * noise.normal());
    }
    [[nodiscard]] double seconds(const Rung& run) const {
        return 1e-6 * std::pow(static_cast<double>(run.elements), cost) *
               static_cast<double>(run.steps);
    }
    [[nodiscard]] RungResult run(const Rung& rung) const {
        return {.rung = rung, .seconds = seconds(rung), .errors = {error(rung)}};
    }
};

/// All sorts: powers alone; next terms; scatter; both; one term that hides the other; terms that
/// cancel; a slow start.
MadeUp made_up(std::uint64_t seed) {
    Draw draw(7919 * seed + 29);
    constexpr std::array in_h{1.0, 1.5, 2.0, 2.0, 3.0, 4.0};
    constexpr std::array in_dt{1.0, 1.0, 2.0, 2.0, 3.0};
    constexpr std::array halves{0.1, 0.05, 0.05, 0.03};
    MadeUp solver{.p = in_h.at(draw.below(in_h.size())),
                  .q = in_dt.at(draw.below(in_dt.size())),
                  .rho = draw.between(-0.3, 0.9),
                  .cost = static_cast<double>(1 + draw.below(3)),
                  .wanted = halves.at(draw.below(halves.size())),
                  .seed = seed};
    const double ratio = draw.below(4) == 0 ? 1.5 : 2.0;
    const auto coarsest = static_cast<double>(4 + draw.below(7));
    const auto longest = static_cast<double>(4 + draw.below(9));
    for (std::uint64_t level = 0, count = 2 + draw.below(3); level < count; ++level)
        solver.meshes.push_back(std::llround(coarsest * std::pow(ratio, level)));
    for (std::uint64_t level = 0, count = 2 + draw.below(3); level < count; ++level)
        solver.steps.push_back(std::llround(longest * std::pow(ratio, level)));
    const std::uint64_t kind = seed % 8;
    const double apart = kind == 4 ? draw.between(1.0, 2.0) : draw.between(-0.7, 0.7);
    const double balance = std::pow(10.0, draw.below(2) == 0 ? apart : -apart);
    solver.b = balance * std::pow(coarsest, -solver.p) * std::pow(longest, solver.q);
    if (kind == 1 || kind == 3 || kind == 5 || kind == 6) {
        solver.c = draw.between(-1.0, 2.0);
        solver.d = draw.between(-1.0, 2.0);
        solver.k = static_cast<double>(1 + draw.below(2));
        solver.l = static_cast<double>(1 + draw.below(2));
    }
    if (kind == 2 || kind == 3)
        solver.scatter = std::pow(10.0, draw.between(-3.5, -2.0));
    if (kind == 5)
        solver.rho = draw.between(-0.95, -0.4);
    if (kind == 7)
        solver.start = std::pow(2.0, draw.between(-1.5, 0.0)) / coarsest;
    return solver;
}

OrdersBlock block_of(const MadeUp& solver) {
    std::string elements;
    for (const auto s : solver.meshes)
        elements += std::to_string(s) + ",";
    std::ostringstream dt;
    dt.precision(17);
    for (const auto n : solver.steps)
        dt << 1.0 / static_cast<double>(n) << ",";
    return block_of("norms = [\"L2\"]\nelements = [" + elements + "]\ndt = [" + dt.str() +
                    "]\nuntil = { order = " + std::to_string(solver.wanted) +
                    ", seconds = 1e9, runs = " + std::to_string(most) + " }\n");
}

double cost_of(const std::vector<RungResult>& runs) {
    return seconds_of(runs);
}

bool holds(const OrderInterval& order, double truth) {
    return order.low <= truth && truth <= order.high;
}

/// The cost of the cheapest grid of at least four meshes and four steps, and of the named ones,
/// whose intervals are as narrow as wanted and hold the orders; NaN where there are none such.
/// Only what costs less than `least` is tried.
double cheapest(const MadeUp& solver, const OrdersBlock& block, double least) {
    GridLines all = lines_of(block.grid);
    const GridLines named = all;
    while (all.meshes.size() * 4 < most)
        all.meshes.push_back(*block.next_mesh(all.meshes));
    while (all.steps.size() * 4 < most)
        all.steps.push_back(*block.next_step(all.steps));
    struct Grid {
        double cost;
        std::vector<RungResult> runs;
    };
    std::vector<Grid> grids;
    for (auto m = std::max(named.meshes.size(), std::size_t{4}); m <= all.meshes.size(); ++m)
        for (auto n = std::max(named.steps.size(), std::size_t{4}); n <= all.steps.size(); ++n) {
            if (m * n > static_cast<std::size_t>(most))
                continue;
            Grid grid{0.0, {}};
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t i = 0; i < m; ++i)
                    grid.runs.push_back(solver.run(all.run(i, j)));
            grid.cost = cost_of(grid.runs);
            if (grid.cost <= least)
                grids.push_back(std::move(grid));
        }
    std::sort(grids.begin(), grids.end(),
              [](const Grid& a, const Grid& b) { return a.cost < b.cost; });
    for (const auto& grid : grids) {
        const TwoTermFit fit = analyse_grid(grid.runs, block.norms).norms[0].fit;
        if (fit.p.determined && fit.q.determined && fit.p.half_width() <= solver.wanted &&
            fit.q.half_width() <= solver.wanted && holds(fit.p, solver.p) &&
            holds(fit.q, solver.q))
            return grid.cost;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// What became of a set of solvers.
struct Score {
    int known = 0;
    int held_p = 0; ///< of those known: the interval holds the order
    int held_q = 0;
    int not_known = 0;
    double mean = 0; ///< cost over that of the cheapest grid, geometric
    double dearest = 0;
    int cheapest = 0; ///< so often it was that
};

Score score(std::uint64_t first, std::uint64_t end) {
    Score score;
    int compared = 0;
    for (auto seed = first; seed < end; ++seed) {
        const MadeUp solver = made_up(seed);
        const OrdersBlock block = block_of(solver);
        const OrdersResult grid = run_orders(
            block, {}, {.run = [&](const RunTask& task) { return solver.run(task.rung); }});
        const TwoTermFit& fit = grid.norms[0].fit;
        const double cost = cost_of(grid.runs);
        const bool known = grid.refined->end == RefiningEnd::known;
        const GridLines lines = [&] {
            std::vector<Rung> rungs;
            for (const auto& run : grid.runs)
                rungs.push_back(run.rung);
            return lines_of(rungs);
        }();
        const double best = known ? cheapest(solver, block, cost) : cost;
        BOOST_TEST_MESSAGE("seed " << seed << " kind " << seed % 8 << " p " << solver.p << " q " << solver.q << " ± "
                                   << solver.wanted << " cost s^" << solver.cost << ": " << name_of(grid.refined->end) << " "
                                   << solver.meshes.size() << "x" << solver.steps.size() << " -> "
                                   << lines.meshes.size() << "x" << lines.steps.size() << " p " << fit.p.value << " ± "
                                   << fit.p.half_width() << (holds(fit.p, solver.p) ? "" : " MISS") << " q "
                                   << fit.q.value << " ± " << fit.q.half_width() << (holds(fit.q, solver.q) ? "" : " MISS") << " cost ratio "
                                   << cost / best << (fit.p.determined ? "" : " " + fit.p.status)<< (fit.q.determined ? "" : " " + fit.q.status));
        if (!known) {
            ++score.not_known;
            continue;
        }
        ++score.known;
        score.held_p += holds(fit.p, solver.p) ? 1 : 0;
        score.held_q += holds(fit.q, solver.q) ? 1 : 0;
        if (std::isnan(best))
            continue;
        const double ratio = cost / best;
        ++compared;
        score.mean += std::log(ratio);
        score.dearest = std::max(score.dearest, ratio);
        score.cheapest += ratio < 1.0 + 1e-9 ? 1 : 0;
    }
    score.mean = std::exp(score.mean / compared);
    return score;
}

std::ostream& operator<<(std::ostream& stream, const Score& score) {
    return stream << "known " << score.known << ", of these p held " << score.held_p << ", q held "
                  << score.held_q << "; not known " << score.not_known
                  << "; cost over the cheapest grid of >= 4 x 4: mean " << score.mean << ", most "
                  << score.dearest << ", the cheapest " << score.cheapest << " times";
}

} // namespace

BOOST_AUTO_TEST_CASE(tune) {
    const char* first = std::getenv("FIRST");
    const char* end = std::getenv("END");
    BOOST_TEST_MESSAGE(score(std::stoul(first), std::stoul(end)));
    BOOST_TEST(true);
}

BOOST_AUTO_TEST_SUITE_END()

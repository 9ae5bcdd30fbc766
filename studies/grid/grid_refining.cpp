#include "studies/grid/grid_refining.hpp"

#include "studies/grid/next_line.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

std::vector<Rung> rungs_of(const std::vector<RungResult>& runs) {
    std::vector<Rung> rungs;
    rungs.reserve(runs.size());
    for (const auto& run : runs)
        rungs.push_back(run.rung);
    return rungs;
}

/// What a grid shows, and what it shows without one of its lines; each is found once.
class ShownByGrid {
public:
    ShownByGrid(const std::vector<RungResult>& runs, const std::vector<Measure>& measures)
        : runs_(runs), measures_(measures) {}

    const OrdersResult& all() { return without(0, 0.0); }
    const OrdersResult& without_mesh(std::int64_t elements) { return without(elements, 0.0); }
    const OrdersResult& without_step(double dt) { return without(0, dt); }

private:
    const OrdersResult& without(std::int64_t elements, double dt) {
        const auto [at, is_new] = found_.try_emplace({elements, dt});
        if (is_new) {
            std::vector<RungResult> others;
            std::ranges::copy_if(runs_, std::back_inserter(others), [&](const RungResult& run) {
                return run.rung.elements != elements && run.rung.dt != dt;
            });
            at->second = analyse_grid(others, measures_);
        }
        return at->second;
    }

    const std::vector<RungResult>& runs_;
    const std::vector<Measure>& measures_;
    std::map<std::pair<std::int64_t, double>, OrdersResult> found_; ///< 0: no such line
};

/// Something that is to be known; where it stands among the measures, and among the norms or
/// values.
struct Wanted {
    enum class What { p, q, limit } what;
    std::size_t measure;
    std::size_t place;
    std::string name;
};

std::vector<Wanted> wanted_of(const OrdersBlock& block) {
    std::vector<Wanted> all;
    std::size_t norms = 0;
    std::size_t values = 0;
    for (std::size_t k = 0; k < block.norms.size(); ++k) {
        const Measure& measure = block.norms[k];
        const std::size_t place = measure.is_value ? values++ : norms++;
        if (measure.is_value && block.until->limit)
            all.push_back({Wanted::What::limit, k, place, "limit of " + measure.root()});
        if (!measure.is_value && block.until->order) {
            all.push_back({Wanted::What::p, k, place, "p of " + measure.root()});
            all.push_back({Wanted::What::q, k, place, "q of " + measure.root()});
        }
    }
    return all;
}

template <typename Lines>
bool has_few(const Lines& lines) {
    return lines.size() < least_known_levels;
}

bool is_known(const OrdersBlock& block, const Wanted& wanted, const std::vector<RungResult>& runs,
              ShownByGrid& grid) {
    const Measure& measure = block.norms[wanted.measure];
    std::set<std::int64_t> meshes; // with a run that shows something of it
    std::set<double> steps;
    for (const auto& run : runs)
        if (shows(run, measure, wanted.measure)) {
            meshes.insert(run.rung.elements);
            steps.insert(run.rung.dt);
        }
    if (has_few(meshes) || has_few(steps) ||
        (!measure.is_value && vanishes_at_the_finest(runs, wanted.measure)))
        return false;
    const auto known = [&](const auto& interval, double half, const OrdersResult& before) {
        return is_known(half, interval(grid.all()), interval(before));
    };
    const OrdersResult& coarser_mesh = grid.without_mesh(*meshes.rbegin());
    const OrdersResult& coarser_step = grid.without_step(*steps.begin());
    if (wanted.what == Wanted::What::limit) {
        const auto limit = [&](const OrdersResult& of) { return of.values[wanted.place].limit; };
        return known(limit, *block.until->limit, coarser_mesh) &&
               known(limit, *block.until->limit, coarser_step);
    }
    const bool in_h = wanted.what == Wanted::What::p;
    const auto order = [&](const OrdersResult& of) {
        const TwoTermFit& fit = of.norms[wanted.place].fit;
        return in_h ? fit.p : fit.q;
    };
    return known(order, *block.until->order, in_h ? coarser_mesh : coarser_step);
}

/// What is not known, and what the grid shows of it; nothing where no grid of its size is enough.
struct Open {
    std::vector<Wanted> wanted;
    std::optional<OrdersResult> shown;
};

Open open_of(const OrdersBlock& block, const std::vector<RungResult>& runs) {
    Open open{wanted_of(block), std::nullopt};
    const GridLines lines = lines_of(rungs_of(runs));
    if (has_few(lines.meshes) || has_few(lines.steps))
        return open;
    ShownByGrid grid(runs, block.norms);
    std::erase_if(open.wanted, [&](const Wanted& one) { return is_known(block, one, runs, grid); });
    open.shown = grid.all();
    return open;
}

std::vector<std::string> names_of(const std::vector<Wanted>& wanted) {
    std::vector<std::string> names;
    names.reserve(wanted.size());
    for (const auto& one : wanted)
        names.push_back(one.name);
    return names;
}

/// A line that may be added.
struct Addition {
    GridLines lines; ///< with it
    std::vector<Rung> runs;
    double cost = 0.0;
    double seconds = 0.0;
    double gain = 0.0;
};

/// Refines one grid.
class GridRefining {
public:
    GridRefining(const OrdersBlock& block, const Series& named, std::vector<RungResult>& runs)
        : block_(block), series_(named), runs_(runs), lines_(lines_of(block.grid)) {
        for (const Rung& run : addable_runs(block))
            series_.rungs.push_back(run);
        for (std::size_t i = 0; i < series_.rungs.size(); ++i)
            index_[{series_.rungs[i].elements, series_.rungs[i].dt}] = i;
    }

    Refined until_known(const RunCall& run, const Execution& execution) {
        while (true) {
            if (std::any_of(runs_.begin(), runs_.end(),
                            [](const RungResult& one) { return one.status != RungStatus::ok; }))
                return {RefiningEnd::run_ended, names_of(wanted_of(block_))};
            const Open open = open_of(block_, runs_);
            if (open.wanted.empty())
                return {RefiningEnd::known};
            auto additions = additions_of(open);
            RefiningEnd end = RefiningEnd::finest;
            keep(additions, end, RefiningEnd::runs, [&](const Addition& one) {
                return block_.until->adds && one.lines.runs() <= most_runs(block_);
            });
            keep(additions, end, RefiningEnd::seconds, [&](const Addition& one) {
                return !block_.until->seconds ||
                       seconds_of(runs_) + one.seconds <= *block_.until->seconds;
            });
            if (additions.empty())
                return {end, names_of(open.wanted)};
            add(*std::max_element(additions.begin(), additions.end(),
                                  [](const auto& a, const auto& b) { return a.gain < b.gain; }),
                run, execution);
        }
    }

private:
    /// Leaves out what does not fit; where that is the last, `end` is why.
    template <typename Fits>
    static void keep(std::vector<Addition>& additions, RefiningEnd& end, RefiningEnd why,
                     const Fits& fits) {
        if (std::erase_if(additions, [&](const Addition& one) { return !fits(one); }) > 0)
            end = why;
    }

    [[nodiscard]] std::vector<Addition> additions_of(const Open& open) const {
        const ForecastSeconds forecast(lines_, runs_);
        const auto finer_mesh = with_mesh(block_, lines_);
        const auto finer_step = with_step(block_, lines_);
        const bool few_meshes = has_few(lines_.meshes);
        const bool few_steps = has_few(lines_.steps);
        std::vector<Addition> additions;
        const auto add = [&](const GridLines& lines, std::vector<Rung> runs) {
            Addition one{.lines = lines, .runs = std::move(runs)};
            for (const Rung& run : one.runs) {
                one.seconds += forecast(run);
                one.cost += work_of(series_.method, run);
            }
            if (block_.until->seconds && one.seconds > 0.0)
                one.cost = one.seconds;
            additions.push_back(std::move(one));
        };
        // Until nothing is known anyway all that counts is what both have to come to.
        if (finer_mesh && (few_meshes || !few_steps))
            add(*finer_mesh, finer_mesh->last_mesh());
        if (finer_step && (few_steps || !few_meshes))
            add(*finer_step, finer_step->last_step());
        if (!open.shown || additions.size() < 2) {
            for (auto& one : additions)
                one.gain = 1.0 / one.cost;
            return additions;
        }
        const auto intervals = expected(open, *finer_mesh, *finer_step);
        additions[0].gain = gain_of_mesh(intervals, additions[0].cost);
        additions[1].gain = gain_of_step(intervals, additions[1].cost);
        return additions;
    }

    [[nodiscard]] std::vector<OpenInterval> expected(const Open& open, const GridLines& finer_mesh,
                                                     const GridLines& finer_step) const {
        std::vector<OpenInterval> intervals;
        for (const Wanted& one : open.wanted)
            intervals.push_back(
                one.what == Wanted::What::limit
                    ? open_limit(open.shown->values[one.place], *block_.until->limit, lines_,
                                 finer_mesh, finer_step)
                    : open_order(open.shown->norms[one.place].fit, one.what == Wanted::What::p,
                                 *block_.until->order, lines_, finer_mesh, finer_step));
        return intervals;
    }

    void add(const Addition& addition, const RunCall& run, const Execution& execution) {
        std::vector<std::size_t> indices;
        for (const Rung& one : addition.runs) {
            indices.push_back(index_.at({one.elements, one.dt}));
            execution.expect(work_of(series_.method, one));
        }
        for (auto& result : run_series(series_, indices, run, execution))
            runs_.push_back(std::move(result));
        lines_ = addition.lines;
        std::sort(runs_.begin(), runs_.end(), [](const RungResult& a, const RungResult& b) {
            return std::pair(-a.rung.dt, a.rung.elements) < std::pair(-b.rung.dt, b.rung.elements);
        });
    }

    const OrdersBlock& block_;
    Series series_; ///< named, and all that may be added
    std::vector<RungResult>& runs_;
    GridLines lines_;
    std::map<std::pair<std::int64_t, double>, std::size_t> index_; ///< by elements and dt
};

} // namespace

std::vector<std::string> not_known(const OrdersBlock& block, const std::vector<RungResult>& runs) {
    return names_of(open_of(block, runs).wanted);
}

Refined refine(const OrdersBlock& block, const Series& named, std::vector<RungResult>& runs,
               const RunCall& run, const Execution& execution) {
    return GridRefining(block, named, runs).until_known(run, execution);
}

} // namespace tvbeam

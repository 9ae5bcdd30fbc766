#include "studies/orders/ladder_levels.hpp"

#include "studies/orders/order_engine.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

/// Whether two records are one piece of information.
bool are_one_level(const Refinement& from, const Refinement& to) {
    const auto same = [](double a, double b) { return (std::isnan(a) && std::isnan(b)) || a == b; };
    if (same(from.h, to.h) && same(from.dt, to.dt))
        return true;
    const auto ratio = refinement_ratio(from, to);
    return ratio && std::abs(std::log(*ratio)) <= std::log(OrderTuning{}.one_level);
}

/// Their mean, exactly where all are the same.
void take_mean(std::span<const Refinement> ladder, Level& level) {
    for (double Refinement::*figure : {&Refinement::h, &Refinement::dt, &Refinement::error}) {
        double sum = 0;
        bool differ = false;
        for (const auto i : level.rows) {
            sum += std::log(ladder[i].*figure);
            differ = differ || ladder[i].*figure != level.first.*figure;
        }
        if (differ)
            level.mean.*figure = std::exp(sum / static_cast<double>(level.rows.size()));
    }
}

/// What is refined from one level to the next.
enum class Step { in_h, in_dt, in_both, back };

Step step_between(const Refinement& from, const Refinement& to) {
    const auto stays = [](double a, double b) {
        return (std::isnan(a) && std::isnan(b)) || a == b;
    };
    if (!refinement_ratio(from, to))
        return Step::back;
    return stays(from.dt, to.dt) ? Step::in_h : stays(from.h, to.h) ? Step::in_dt : Step::in_both;
}

} // namespace

std::vector<Level> levels_of(std::span<const Refinement> ladder, std::span<const double> sigma) {
    std::vector<Level> levels;
    for (std::size_t i = 0; i < ladder.size(); ++i) {
        if (!is_positive(ladder[i].error) || !ladder[i].is_resolved())
            continue;
        if (levels.empty() || !are_one_level(levels.back().first, ladder[i]))
            levels.push_back({{}, ladder[i], ladder[i]});
        levels.back().rows.push_back(i);
    }
    for (auto& level : levels) {
        take_mean(ladder, level);
        if (sigma.empty())
            continue;
        double square = 0;
        for (const auto i : level.rows)
            square += sigma[i] / ladder[i].error * (sigma[i] / ladder[i].error);
        level.deviation = std::sqrt(square) / static_cast<double>(level.rows.size());
    }
    return levels;
}

double slack_between(const Level& from, const Level& to) {
    constexpr double of_95 = 1.96;
    const auto ratio = refinement_ratio(from.mean, to.mean);
    return ratio ? of_95 * std::hypot(from.deviation, to.deviation) / std::abs(std::log(*ratio))
                 : 0.0;
}

Orders orders_of(const std::vector<Level>& levels) {
    std::vector<Refinement> means;
    means.reserve(levels.size());
    for (const auto& level : levels)
        means.push_back(level.mean);
    Orders orders{observed_orders(means), std::vector<double>(levels.size(), 0.0)};
    for (std::size_t i = 1; i < levels.size(); ++i)
        orders.slack[i] = slack_between(levels[i - 1], levels[i]);
    return orders;
}

std::vector<std::pair<std::size_t, std::size_t>> sweeps_of(const std::vector<Level>& levels) {
    if (levels.empty())
        return {};
    std::vector<Step> steps; // into the level, the first has none
    for (std::size_t i = 1; i < levels.size(); ++i)
        steps.push_back(step_between(levels[i - 1].mean, levels[i].mean));
    const auto has = [&](Step step) { return std::ranges::find(steps, step) != steps.end(); };
    std::vector<std::pair<std::size_t, std::size_t>> sweeps{{0, 0}};
    const bool in_turns = has(Step::in_h) && has(Step::in_dt);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        const Step step = steps[i - 1];
        const bool goes_on = i < 2 || step == steps[i - 2] || sweeps.back().first == i - 1;
        if (in_turns && step == Step::back)
            sweeps.emplace_back(i, i);
        else if (in_turns && !goes_on)
            sweeps.emplace_back(i - 1, i);
        else
            sweeps.back().second = i;
    }
    return sweeps;
}

} // namespace tvbeam

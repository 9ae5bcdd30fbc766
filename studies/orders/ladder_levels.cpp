#include "studies/orders/ladder_levels.hpp"

#include "studies/orders/order_engine.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

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

/// Levels alike in one width, at two or more of the other, from coarse to fine.
std::vector<std::vector<std::size_t>>
sharing(const std::vector<Level>& levels, double Refinement::*same, double Refinement::*refined) {
    std::map<double, std::vector<std::size_t>, std::greater<>> groups;
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (!std::isnan(levels[i].mean.*same) && !std::isnan(levels[i].mean.*refined))
            groups[levels[i].mean.*same].push_back(i);
    std::vector<std::vector<std::size_t>> sweeps;
    for (auto& [width, group] : groups) {
        std::ranges::stable_sort(group, std::greater<>(),
                                 [&](std::size_t i) { return levels[i].mean.*refined; });
        if (levels[group.front()].mean.*refined != levels[group.back()].mean.*refined)
            sweeps.push_back(std::move(group));
    }
    return sweeps;
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

std::vector<std::vector<std::size_t>> sweeps_of(const std::vector<Level>& levels) {
    std::vector<std::size_t> all(levels.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    auto sweeps = sharing(levels, &Refinement::h, &Refinement::dt);
    const auto in_h = sharing(levels, &Refinement::dt, &Refinement::h);
    if (sweeps.empty() || in_h.empty())
        return {all};
    sweeps.insert(sweeps.end(), in_h.begin(), in_h.end());
    for (const std::size_t i : all)
        if (std::ranges::none_of(sweeps, [&](const auto& sweep) {
                return std::ranges::find(sweep, i) != sweep.end();
            }))
            sweeps.push_back({i});
    return sweeps;
}

} // namespace tvbeam

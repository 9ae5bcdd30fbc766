#include "studies/order_remarks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tvbeam {

namespace {

std::string two_decimals(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f", value);
    return text.data();
}

std::string rung_name(const Refinement& rung) {
    return "s = " + std::to_string(std::llround(1.0 / rung.h));
}

} // namespace

std::vector<std::string> order_remarks(const Norm& norm, std::span<const Refinement> ladder,
                                       std::span<const std::optional<double>> orders) {
    struct Observed {
        std::size_t rung;
        double order;
    };
    std::vector<Observed> known;
    for (std::size_t i = 0; i < orders.size(); ++i)
        if (orders[i])
            known.push_back({i, *orders[i]});
    if (known.size() < 2)
        return {};

    const double steady = norm.squared ? 0.3 : 0.15;
    const double first = known.front().order;
    const auto leaves = std::find_if(known.begin(), known.end(), [&](const Observed& at) {
        return std::abs(at.order - first) > steady;
    });
    const auto [lowest, highest] =
        std::minmax_element(known.begin(), leaves,
                            [](const Observed& a, const Observed& b) { return a.order < b.order; });
    std::string text = norm.name + ": order " + two_decimals(lowest->order);
    if (highest->order - lowest->order >= 0.005)
        text += " to " + two_decimals(highest->order);
    text += " up to " + rung_name(ladder[(leaves - 1)->rung]);
    if (norm.squared)
        text += " (a square: order " + two_decimals(first / 2.0) + " of the norm itself)";
    if (leaves == known.end())
        return {text + ", steady over the ladder."};

    const auto peak =
        std::max_element(leaves, known.end(),
                         [](const Observed& a, const Observed& b) { return a.order < b.order; });
    if (peak->order > first + steady) {
        text += "; then it rises, to " + two_decimals(peak->order) + " at " +
                rung_name(ladder[peak->rung]) +
                ": more than any single error term has, so two terms of opposite sign cancel there";
        if (known.back().rung != peak->rung)
            text += ", and " + two_decimals(known.back().order) + " at " +
                    rung_name(ladder[known.back().rung]);
        return {text + "."};
    }
    text += "; then it falls, to " + two_decimals(known.back().order) + " at " +
            rung_name(ladder[known.back().rung]);
    if (known.back().order <= 0.0)
        return {text + ": the error no longer shrinks."};
    return {text + ": an error term of lower order, hidden at first, has taken over."};
}

} // namespace tvbeam

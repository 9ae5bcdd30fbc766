#include "studies/order_remarks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace tvbeam {

namespace {

std::string format(const char* pattern, double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), pattern, value);
    return text.data();
}

std::string order_text(double value) {
    return format("%.2f", value);
}

std::string rung_name(double h) {
    return "s = " + format("%.0f", 1.0 / h);
}

struct Observed {
    std::size_t rung;
    double order; ///< of the norm itself
};

std::string of_square(const Norm& norm, double order) {
    return norm.squared ? " (the square of order " + order_text(order) + ")" : "";
}

/// The orders speak for themselves.
std::string from_pairs(const Norm& norm, std::span<const Refinement> roots,
                       const std::vector<Observed>& known) {
    const double steady = 0.15;
    const double power = norm.squared ? 2.0 : 1.0;
    const auto less = [](const Observed& a, const Observed& b) { return a.order < b.order; };
    const double first = known.front().order;
    const auto leaves = std::find_if(known.begin(), known.end(), [&](const Observed& at) {
        return std::abs(at.order - first) > steady;
    });
    const auto [lowest, highest] = std::minmax_element(known.begin(), leaves, less);
    std::string text = norm.name + ": order " + order_text(power * lowest->order);
    if (highest->order - lowest->order >= 0.005)
        text += " to " + order_text(power * highest->order);
    text += of_square(norm, first) + " up to " + rung_name(roots[(leaves - 1)->rung].h);
    if (leaves == known.end())
        return text + ", steady over the ladder.";
    const auto& last = known.back();
    const auto peak = std::max_element(leaves, known.end(), less);
    if (peak->order > first + steady) {
        text += "; then it rises, to " + order_text(power * peak->order) + " at " +
                rung_name(roots[peak->rung].h) +
                ", more than the terms of the error have: two of them cancel there";
        if (last.rung != peak->rung)
            text += "; " + order_text(power * last.order) + " at " + rung_name(roots[last.rung].h);
        return text + ".";
    }
    text += "; then it falls, to " + order_text(power * last.order) + " at " +
            rung_name(roots[last.rung].h);
    return text + (last.order <= 0.0 ? ": the error no longer shrinks."
                                     : ": a term of lower order, hidden at first, has taken over.");
}

/// The model says why.
std::string from_model(const Norm& norm, std::span<const Refinement> roots,
                       const TwoTermModel& model) {
    const double power = norm.squared ? 2.0 : 1.0;
    const LadderForecast view = forecast(model, roots);
    const ForecastRow& finest = view.rows.back();
    // A term that hardly shrinks was not seen by the fit, whatever it calls its order.
    if (model.a == 0.0 || model.b == 0.0 || view.asymptotic_order < 0.25)
        return {};
    const bool space_first = view.spatial_order > view.asymptotic_order;
    const char* hidden = space_first ? "time" : "space";
    const char* seen = space_first ? "space" : "time";
    const double seen_order = space_first ? view.spatial_order : view.temporal_order;
    const double part =
        space_first ? finest.temporal / finest.spatial : finest.spatial / finest.temporal;
    std::string text = norm.name + ": ";
    if (part < 1.0)
        text += "the order " + order_text(power * seen_order) + of_square(norm, seen_order) +
                " is that of the " + seen + " error alone; the " + hidden + " error, of order " +
                order_text(power * view.asymptotic_order) + " along this ladder, is " +
                format("%.2g", part) + " times as large at " + rung_name(finest.h) + " and hidden";
    else
        text += "the " + std::string(seen) + " error, of order " + order_text(power * seen_order) +
                of_square(norm, seen_order) + ", rules the coarse rungs; at " +
                rung_name(finest.h) + " the " + hidden + " error, of order " +
                order_text(power * view.asymptotic_order) + ", is " + format("%.2g", part) +
                " times as large";
    text += ".";
    if (view.cancellation)
        text += " The two have opposite signs and cancel in part about " +
                rung_name(view.cancellation->h) + ".";
    if (view.asymptotic_from)
        text += " The order that remains, " + order_text(power * view.asymptotic_order) +
                ", shows " + (view.asymptotic_from->row < roots.size() ? "from " : "only from ") +
                rung_name(view.asymptotic_from->h) + " on.";
    return text;
}

} // namespace

std::vector<std::string> order_remarks(const Norm& norm, std::span<const Refinement> roots,
                                       const TwoTermModel* model) {
    const auto orders = observed_orders(roots);
    std::vector<Observed> known;
    for (std::size_t i = 0; i < orders.size(); ++i)
        if (orders[i])
            known.push_back({i, *orders[i]});
    if (known.size() < 2)
        return {};
    std::vector<std::string> remarks{from_pairs(norm, roots, known)};
    if (model != nullptr)
        if (const std::string why = from_model(norm, roots, *model); !why.empty())
            remarks.push_back(why);
    return remarks;
}

} // namespace tvbeam

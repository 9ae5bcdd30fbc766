#include "studies/orders/observed_order.hpp"

#include <cmath>

namespace tvbeam {

namespace {

bool is_width(double value) {
    return std::isfinite(value) && value > 0;
}

/// An absent width is NaN in both records; then it does not change.
bool changes(double from, double to) {
    return !(std::isnan(from) && std::isnan(to)) && from != to;
}

} // namespace

std::optional<double> refinement_ratio(const Refinement& from, const Refinement& to) {
    const bool in_h = changes(from.h, to.h);
    const bool in_dt = changes(from.dt, to.dt);
    if (!in_h && !in_dt)
        return std::nullopt;
    if ((in_h && !(is_width(from.h) && is_width(to.h))) ||
        (in_dt && !(is_width(from.dt) && is_width(to.dt))))
        return std::nullopt;
    // One finer, the other coarser: neither record refines the other.
    if (in_h && in_dt && (from.h > to.h) != (from.dt > to.dt))
        return std::nullopt;
    return in_h ? from.h / to.h : from.dt / to.dt;
}

std::vector<std::optional<double>> observed_orders(std::span<const Refinement> ladder) {
    std::vector<std::optional<double>> orders(ladder.size());
    for (std::size_t i = 1; i < ladder.size(); ++i) {
        const double before = ladder[i - 1].error;
        const double after = ladder[i].error;
        const auto ratio = refinement_ratio(ladder[i - 1], ladder[i]);
        if (ratio && is_width(before) && is_width(after))
            // A difference of logarithms: the quotient of the errors may overflow.
            orders[i] = (std::log(before) - std::log(after)) / std::log(*ratio);
    }
    return orders;
}

} // namespace tvbeam

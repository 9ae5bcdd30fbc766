#include "studies/orders/ladder_order.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tvbeam {

namespace {

/// Whether h stays, so that Δt is what is refined.
bool stays_in_h(std::span<const Refinement> sorted) {
    return std::isnan(sorted.front().h) || sorted.front().h == sorted.back().h;
}

/// Whether each h goes with one Δt, which does not grow as h falls.
bool is_one_path(std::span<const Refinement> sorted) {
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].dt > sorted[i - 1].dt ||
            (sorted[i].h == sorted[i - 1].h && sorted[i].dt < sorted[i - 1].dt))
            return false;
    return true;
}

} // namespace

LadderOrder order_along(std::span<const Refinement> ladder, std::span<const double> sigma,
                        bool rounded) {
    LadderOrder result;
    if (ladder.empty())
        return result;
    result.is_in_dt = stays_in_h(ladder) && !std::isnan(ladder.front().dt);
    if (!result.is_in_dt && !is_one_path(ladder)) {
        result.in_turns = true;
        result.order.status = "h and dt are refined in turns";
        return result;
    }
    // Orders do not know the scale of the errors; squares of theirs must be in range.
    double greatest = 0;
    for (const auto& record : ladder)
        if (record.is_resolved())
            greatest = std::max(greatest, record.error);
    const int exponent = is_positive(greatest) ? std::ilogb(greatest) : 0;
    std::vector<ErrorRow> rows;
    for (std::size_t i = 0; i < ladder.size(); ++i) {
        const auto& record = ladder[i];
        if (!record.is_resolved())
            continue;
        rows.push_back(
            {{result.is_in_dt ? record.dt : record.h}, std::ldexp(record.error, -exponent)});
        if (!sigma.empty())
            rows.back().sigma = sigma[i] / record.error;
        rows.back().rounded = rounded;
    }
    if (rows.empty()) {
        result.order.status = "no error is resolved";
        return result;
    }
    const OrderEnsemble ensemble(rows);
    result.order = ensemble.orders().front();
    result.has_logarithm = result.order.determined && ensemble.has_logarithm();
    return result;
}

} // namespace tvbeam

#include "studies/orders/two_term_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tvbeam {

namespace {

/// Along a ladder two terms whose orders differ by less than this stay side by side.
constexpr double same_order = 0.05;

ForecastRow row_at(const TwoTermModel& model, double h, double dt) {
    ForecastRow row{.h = h, .dt = dt};
    row.spatial = model.spatial(h);
    row.temporal = model.temporal(dt);
    row.error = model.error(h, dt);
    const double larger = std::max(row.spatial, row.temporal);
    if (row.error < cancellation_depth * larger)
        row.dominant = Dominant::cancellation;
    else
        row.dominant = row.spatial >= row.temporal ? Dominant::space : Dominant::time;
    return row;
}

std::optional<double> order_between(const ForecastRow& from, const ForecastRow& to) {
    const Refinement pair[] = {{.h = from.h, .dt = from.dt, .error = from.error},
                               {.h = to.h, .dt = to.dt, .error = to.error}};
    return observed_orders(pair)[1];
}

/// The rows of the ladder and those it is carried on by.
std::vector<ForecastRow> carried_on(const TwoTermModel& model, std::vector<ForecastRow> rows) {
    const auto& last = rows.back();
    const auto& before = rows[rows.size() - 2];
    const double in_h = last.h / before.h;
    const double in_dt = last.dt / before.dt;
    for (std::size_t k = 0; k < LadderForecast::furthest_row; ++k) {
        auto next = row_at(model, rows.back().h * in_h, rows.back().dt * in_dt);
        if (!(next.h > 0 && next.dt > 0 && next.error > 0))
            break;
        next.order = order_between(rows.back(), next);
        rows.push_back(next);
    }
    return rows;
}

LadderForecast::Place place_of(const std::vector<ForecastRow>& rows, std::size_t row) {
    return {.row = row, .h = rows[row].h, .dt = rows[row].dt};
}

/// The order into the first row is that from a level before it.
std::optional<LadderForecast::Place> onset(const TwoTermModel& model,
                                           const std::vector<ForecastRow>& rows, double order,
                                           double tolerance) {
    const auto agrees = [&](const std::optional<double>& other) {
        return other && std::abs(*other - order) <= tolerance * std::abs(order);
    };
    std::size_t from = rows.size();
    while (from > 1 && agrees(rows[from - 1].order))
        --from;
    const auto before =
        row_at(model, rows[0].h * (rows[0].h / rows[1].h), rows[0].dt * (rows[0].dt / rows[1].dt));
    if (from == 1 && agrees(order_between(before, rows[0])))
        from = 0;
    if (from == rows.size())
        return std::nullopt;
    return place_of(rows, from);
}

/// Between two rows either term is a power of the ladder's own parameter, so ln(spatial / temporal)
/// is linear there and its zero is known.
std::optional<LadderForecast::Place> crossing(const std::vector<ForecastRow>& rows) {
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
        const double here = std::log(rows[i].spatial / rows[i].temporal);
        const double next = std::log(rows[i + 1].spatial / rows[i + 1].temporal);
        if (!std::isfinite(here) || !std::isfinite(next) || here == next || here * next > 0)
            continue;
        const double part = here / (here - next);
        return LadderForecast::Place{.row = i,
                                     .h = rows[i].h * std::pow(rows[i + 1].h / rows[i].h, part),
                                     .dt =
                                         rows[i].dt * std::pow(rows[i + 1].dt / rows[i].dt, part)};
    }
    return std::nullopt;
}

void require_widths(std::span<const Refinement> ladder) {
    for (const auto& record : ladder)
        if (!(record.h > 0 && record.dt > 0 && std::isfinite(record.h * record.dt)))
            throw std::invalid_argument("the two-term model needs a positive h and a positive dt");
}

} // namespace

double TwoTermModel::spatial(double h) const {
    return a > 0 ? a * std::pow(h, p) : 0.0;
}

double TwoTermModel::temporal(double dt) const {
    return b > 0 ? b * std::pow(dt, q) : 0.0;
}

double TwoTermModel::error(double h, double dt) const {
    const double in_space = spatial(h);
    const double in_time = temporal(dt);
    // (A ∓ B)² ± 2(1 ± ρ)AB: near ρ = ±1 no digit of the difference is lost.
    const double sign = rho < 0 ? -1.0 : 1.0;
    const double sum = in_space + sign * in_time;
    const double cross = 2 * sign * (std::abs(rho) - 1) * in_space * in_time;
    return std::sqrt(std::max(0.0, sum * sum + cross));
}

double error_against(const Refinement& reference, const TwoTermModel& model, double h, double dt) {
    // At h = Δt = 1 the model is its two sizes.
    TwoTermModel parts = model;
    parts.a = model.spatial(h) - (std::isnan(reference.h) ? 0.0 : model.spatial(reference.h));
    parts.b = model.temporal(dt) - (std::isnan(reference.dt) ? 0.0 : model.temporal(reference.dt));
    return parts.error(1, 1);
}

LadderForecast forecast(const TwoTermModel& model, std::span<const Refinement> ladder,
                        double tolerance) {
    require_widths(ladder);
    LadderForecast result;
    for (const auto& record : ladder) {
        auto row = row_at(model, record.h, record.dt);
        if (!result.rows.empty())
            row.order = order_between(result.rows.back(), row);
        result.rows.push_back(row);
    }
    if (ladder.size() < 2)
        return result;
    const auto& before = ladder[ladder.size() - 2];
    const auto& last = ladder.back();
    const auto ratio = refinement_ratio(before, last);
    if (!ratio)
        return result;

    const bool in_space = model.a > 0;
    const bool in_time = model.b > 0;
    result.spatial_order =
        in_space ? model.p * std::log(before.h / last.h) / std::log(*ratio) : 0.0;
    result.temporal_order =
        in_time ? model.q * std::log(before.dt / last.dt) / std::log(*ratio) : 0.0;
    const double apart = result.spatial_order - result.temporal_order;
    if (!in_time || (in_space && apart < 0))
        result.asymptotic_dominant = Dominant::space;
    else
        result.asymptotic_dominant = Dominant::time;
    result.asymptotic_order = result.asymptotic_dominant == Dominant::space ? result.spatial_order
                                                                            : result.temporal_order;
    if (in_space && in_time && std::abs(apart) < same_order)
        result.asymptotic_dominant = Dominant::both;

    const auto rows = carried_on(model, result.rows);
    result.asymptotic_from = onset(model, rows, result.asymptotic_order, tolerance);
    // By so little nothing is seen to cancel, and a fit has no other sign for zero.
    constexpr double least_opposed = 0.05;
    if (model.rho < -least_opposed)
        result.cancellation = crossing(rows);
    return result;
}

} // namespace tvbeam

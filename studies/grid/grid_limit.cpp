#include "studies/grid/grid_limit.hpp"

#include "studies/orders/limit_engine.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// A value by its widths; none where its run failed.
class ValueGrid {
public:
    ValueGrid(const std::vector<RungResult>& runs, std::size_t k) {
        const auto units = units_of(runs, k, true);
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const auto& run = runs[i];
            h_.insert(run.rung.h());
            dt_.insert(run.rung.dt);
            if (!run.errors.empty())
                values_[{run.rung.h(), run.rung.dt}] = {run.errors[k],
                                                        units.empty() ? 0.0 : units[i]};
        }
    }

    [[nodiscard]] const std::set<double>& h() const { return h_; } ///< from fine to coarse
    [[nodiscard]] const std::set<double>& dt() const { return dt_; }

    [[nodiscard]] double at(double h, double dt) const {
        const auto found = values_.find({h, dt});
        return found != values_.end() ? found->second.value
                                      : std::numeric_limits<double>::quiet_NaN();
    }

    [[nodiscard]] double unit_at(double h, double dt) const {
        const auto found = values_.find({h, dt});
        return found != values_.end() ? found->second.unit : 0.0;
    }

    /// v(h,Δt) − v(h_f,Δt) − v(h,Δt_f) + v(h_f,Δt_f), with the finest widths: what both do
    /// together.
    [[nodiscard]] double together(double h, double dt) const {
        const double finest_h = *h_.begin();
        const double finest_dt = *dt_.begin();
        return at(h, dt) - at(finest_h, dt) - at(h, finest_dt) + at(finest_h, finest_dt);
    }

    /// Along one width where the other is finest, from coarse to fine.
    [[nodiscard]] LimitEstimate along_h() const {
        return along(h_, [this](double h) { return std::pair(h, *dt_.begin()); });
    }
    [[nodiscard]] LimitEstimate along_dt() const {
        return along(dt_, [this](double dt) { return std::pair(*h_.begin(), dt); });
    }

private:
    struct PrintedValue {
        double value = std::numeric_limits<double>::quiet_NaN();
        double unit = 0; ///< of its last digit
    };
    using Widths = std::pair<double, double>;

    [[nodiscard]] LimitEstimate along(const std::set<double>& widths,
                                      const std::function<Widths(double)>& both) const {
        std::vector<ValueRow> rows;
        rows.reserve(widths.size());
        const std::vector<double> falling(widths.rbegin(), widths.rend());
        for (const double width : falling) {
            const auto found = values_.find(both(width));
            const PrintedValue here = found != values_.end() ? found->second : PrintedValue{};
            rows.push_back({.h = width, .value = here.value, .unit = here.unit});
        }
        return estimate_limit(rows);
    }

    std::set<double> h_;
    std::set<double> dt_;
    std::map<Widths, PrintedValue> values_;
};

/// The width next to the finest.
double next_to_finest(const std::set<double>& widths) {
    return *std::next(widths.begin());
}

/// r^p − 1, of a width over the finest.
double growth(const std::set<double>& widths, double width, double order) {
    return std::pow(width / *widths.begin(), order) - 1.0;
}

/// What both widths do together at the finest run, by its size.
double mixed_part(const ValueGrid& grid, double p, double q) {
    const double h = next_to_finest(grid.h());
    const double dt = next_to_finest(grid.dt());
    return std::abs(grid.together(h, dt) / (growth(grid.h(), h, p) * growth(grid.dt(), dt, q)));
}

/// The runs, coarse in both widths, of whose values no limit is made, and in which both widths do
/// more together than ten times what each does alone and what the run next to the finest lets
/// expect of terms up to order 4.
std::vector<Rung> out_of_line(const ValueGrid& grid, const std::vector<RungResult>& runs) {
    constexpr double far = 10.0;
    constexpr double highest_order = 4.0;
    constexpr double rounding = 1e-12;
    const double finest_h = *grid.h().begin();
    const double finest_dt = *grid.dt().begin();
    const double finest = grid.at(finest_h, finest_dt);
    double unit = 0.0;
    for (const auto& run : runs)
        unit = std::max(unit, grid.unit_at(run.rung.h(), run.rung.dt));
    // Of four printed values, each half a unit off, at most.
    const double of_four = 2.0 * unit;
    const double nearest = mixed_part(grid, highest_order, highest_order) +
                           of_four / (growth(grid.h(), next_to_finest(grid.h()), highest_order) *
                                      growth(grid.dt(), next_to_finest(grid.dt()), highest_order));
    std::vector<Rung> found;
    for (const auto& run : runs) {
        const double h = run.rung.h();
        const double dt = run.rung.dt;
        const double expected =
            std::abs(grid.at(h, finest_dt) - finest) + std::abs(grid.at(finest_h, dt) - finest) +
            nearest * growth(grid.h(), h, highest_order) * growth(grid.dt(), dt, highest_order) +
            rounding * std::abs(finest) + of_four;
        if (std::abs(grid.together(h, dt)) > far * expected)
            found.push_back(run.rung);
    }
    return found;
}

} // namespace

GridLimit limit_of(const std::string& name, const std::vector<RungResult>& runs, std::size_t k) {
    const ValueGrid grid(runs, k);
    const LimitEstimate in_h = grid.along_h();
    const LimitEstimate in_dt = grid.along_dt();
    GridLimit result{.value = name, .limit = {}, .p = in_h.order, .q = in_dt.order};
    const auto half = [](const OrderInterval& of) {
        return of.determined ? of.half_width() : std::numeric_limits<double>::infinity();
    };
    result.half_in_h = half(in_h.limit);
    result.half_in_dt = half(in_dt.limit);
    const double finest = grid.at(*grid.h().begin(), *grid.dt().begin());
    if (!std::isfinite(finest)) {
        for (OrderInterval* of : {&result.limit, &result.p, &result.q})
            *of = {.status = "the finest run has no value"};
    } else if (!in_h.limit.determined)
        result.limit.status = "in h: " + in_h.limit.status;
    else if (!in_dt.limit.determined)
        result.limit.status = "in dt: " + in_dt.limit.status;
    if (!result.limit.status.empty())
        return result;
    // Orders that are not known are taken as one.
    const auto order = [](const OrderInterval& of) { return of.determined ? of.value : 1.0; };
    const double mixed = mixed_part(grid, order(in_h.order), order(in_dt.order));
    if (!std::isfinite(mixed)) {
        result.limit.status =
            "the run next to the finest in both widths has no value: what both do "
            "together is not known";
        return result;
    }
    result.out_of_line = out_of_line(grid, runs);
    const double whole = result.half_in_h + result.half_in_dt + mixed;
    const double value = in_h.limit.value + in_dt.limit.value - finest;
    result.limit = {
        .value = value, .low = value - whole, .high = value + whole, .determined = true};
    result.uncertainty = std::abs(value - finest) + whole;
    return result;
}

} // namespace tvbeam

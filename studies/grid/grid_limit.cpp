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

/// r^p − 1, of the two finest widths.
double growth(const std::set<double>& widths, double order) {
    return std::pow(*std::next(widths.begin()) / *widths.begin(), order) - 1.0;
}

/// What both widths do together at the finest run, by its size.
double mixed_part(const ValueGrid& grid, double p, double q) {
    const double h = *grid.h().begin(), coarser_h = *std::next(grid.h().begin());
    const double dt = *grid.dt().begin(), coarser_dt = *std::next(grid.dt().begin());
    const double difference = grid.at(h, dt) - grid.at(coarser_h, dt) - grid.at(h, coarser_dt) +
                              grid.at(coarser_h, coarser_dt);
    return std::abs(difference / (growth(grid.h(), p) * growth(grid.dt(), q)));
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
    if (!std::isfinite(finest))
        result.limit.status = "the finest run has no value";
    else if (!in_h.limit.determined)
        result.limit.status = "in h: " + in_h.limit.status;
    else if (!in_dt.limit.determined)
        result.limit.status = "in dt: " + in_dt.limit.status;
    if (!result.limit.status.empty())
        return result;
    // Orders that are not known are taken as one; a cell that failed says nothing of m.
    const auto order = [](const OrderInterval& of) { return of.determined ? of.value : 1.0; };
    const double mixed = mixed_part(grid, order(in_h.order), order(in_dt.order));
    const double whole =
        result.half_in_h + result.half_in_dt + (std::isfinite(mixed) ? mixed : 0.0);
    const double value = in_h.limit.value + in_dt.limit.value - finest;
    result.limit = {
        .value = value, .low = value - whole, .high = value + whole, .determined = true};
    result.uncertainty = std::abs(value - finest) + whole;
    return result;
}

} // namespace tvbeam

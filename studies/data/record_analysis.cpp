#include "studies/data/record_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <utility>

namespace tvbeam {

namespace {

/// A grid has nearly all pairs of its widths. A staircase, h and Δt refined in turn, repeats its
/// widths too, but has about two records a width.
constexpr double least_coverage = 0.7;

bool is_grid(const std::vector<Refinement>& records) {
    std::set<double> h;
    std::set<double> dt;
    std::set<std::pair<double, double>> pairs;
    for (const auto& record : records) {
        if (std::isnan(record.h) || std::isnan(record.dt))
            return false;
        h.insert(record.h);
        dt.insert(record.dt);
        pairs.emplace(record.h, record.dt);
    }
    return h.size() >= 3 && dt.size() >= 3 &&
           static_cast<double>(pairs.size()) >=
               least_coverage * static_cast<double>(h.size() * dt.size());
}

/// Coarse to fine by h, then by Δt; a width that is absent is the same in all records.
void sort_by_width(std::vector<Refinement>& records) {
    const auto key = [](const Refinement& record) {
        const auto width = [](double value) {
            return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
        };
        return std::pair(width(record.h), width(record.dt));
    };
    std::stable_sort(
        records.begin(), records.end(),
        [&](const Refinement& left, const Refinement& right) { return key(left) > key(right); });
}

std::optional<PowerLawFit> power_law_of(std::span<const Refinement> records,
                                        const LadderVerdict& verdict) {
    const auto& window = verdict.window;
    if (!window)
        return fit_power_law(records);
    const auto inside = records.subspan(window->first, window->last - window->first + 1);
    std::vector<Refinement> with_floor(inside.begin(), inside.end());
    for (std::size_t i = window->last + 1; i < records.size(); ++i)
        if (verdict.rows[i].verdict == Verdict::floor)
            with_floor.push_back(records[i]);
    // Without a row on it a floor would be read out of the bend that a next term makes.
    if (with_floor.size() > inside.size())
        if (auto fit = fit_power_law(with_floor, {.with_floor = true}); fit && fit->floor > 0)
            return fit;
    return fit_power_law(inside);
}

std::string why_no_power_law(const std::vector<Refinement>& records) {
    std::set<std::pair<double, double>> widths;
    std::size_t errors = 0;
    for (const auto& record : records) {
        if (!std::isfinite(record.error) || record.error <= 0)
            continue;
        ++errors;
        widths.emplace(std::isnan(record.h) ? 0.0 : record.h,
                       std::isnan(record.dt) ? 0.0 : record.dt);
    }
    if (errors == 0)
        return "no row has a positive error";
    if (errors == 1)
        return "one row alone has a positive error";
    if (widths.size() < 2)
        return "all rows with a positive error have the same width";
    return "the search for a power law came to no end";
}

} // namespace

RecordAnalysis analyse(std::vector<Refinement> records) {
    RecordAnalysis analysis;
    if (is_grid(records)) {
        analysis.two_term = fit_two_term(records);
    } else {
        sort_by_width(records);
        analysis.orders = observed_orders(records);
        analysis.verdict = judge(records);
        analysis.power_law = power_law_of(records, *analysis.verdict);
        if (!analysis.power_law)
            analysis.no_power_law = why_no_power_law(records);
    }
    analysis.records = std::move(records);
    return analysis;
}

ValueAnalysis analyse_values(std::vector<GridValue> grids) {
    std::stable_sort(grids.begin(), grids.end(),
                     [](const auto& left, const auto& right) { return left.h > right.h; });
    ValueAnalysis analysis;
    std::vector<GridValue> levels;
    for (const auto& grid : grids)
        if (std::isfinite(grid.value) && (levels.empty() || grid.h < levels.back().h))
            levels.push_back(grid);
    if (levels.size() < 3) {
        analysis.no_extrapolation = "an observed order needs values at three different widths";
    } else {
        const auto fine = levels.end() - 1;
        analysis.finest = richardson(*(fine - 2), *(fine - 1), *fine);
        if (!analysis.finest)
            analysis.no_extrapolation =
                "on the three finest grids the values oscillate or stand still";
    }
    analysis.limit = fit_limit(grids);
    analysis.grids = std::move(grids);
    return analysis;
}

RecordAnalysis analyse(RecordFile file) {
    if (file.values.empty())
        return analyse(std::move(file.records));
    RecordAnalysis analysis;
    analysis.values = analyse_values(std::move(file.values));
    return analysis;
}

} // namespace tvbeam

#include "studies/data/record_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tvbeam {

namespace {

/// A grid has nearly all pairs of its widths. A staircase, h and Δt refined in turn, repeats its
/// widths too, but has about two records a width.
constexpr double least_coverage = 0.7;

template <class Value>
std::size_t different(std::vector<Value> values) {
    std::sort(values.begin(), values.end());
    return static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
}

bool is_grid(const std::vector<Refinement>& records) {
    std::vector<double> h;
    std::vector<double> dt;
    std::vector<std::pair<double, double>> pairs;
    for (const auto& record : records) {
        if (std::isnan(record.h) || std::isnan(record.dt))
            return false;
        h.push_back(record.h);
        dt.push_back(record.dt);
        pairs.emplace_back(record.h, record.dt);
    }
    const std::size_t in_h = different(h);
    const std::size_t in_dt = different(dt);
    return in_h >= 3 && in_dt >= 3 &&
           static_cast<double>(different(pairs)) >=
               least_coverage * static_cast<double>(in_h) * static_cast<double>(in_dt);
}

/// Coarse to fine by h, then by Δt; a width that is absent is the same in all records.
std::vector<std::size_t> coarse_to_fine(const std::vector<Refinement>& records) {
    const auto key = [&records](std::size_t i) {
        const auto width = [](double value) {
            return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
        };
        return std::pair(width(records[i].h), width(records[i].dt));
    };
    std::vector<std::size_t> order(records.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t left, std::size_t right) { return key(left) > key(right); });
    return order;
}

} // namespace

RecordAnalysis analyse(std::vector<Refinement> records, const std::vector<double>& sigma,
                       bool rounded) {
    RecordAnalysis analysis;
    if (is_grid(records)) {
        analysis.two_term = fit_two_term(records, {}, sigma);
        analysis.records = std::move(records);
        return analysis;
    }
    std::vector<double> sorted;
    for (const std::size_t i : coarse_to_fine(records)) {
        analysis.records.push_back(records[i]);
        if (!sigma.empty())
            sorted.push_back(sigma[i]);
    }
    analysis.along = order_along(analysis.records, sorted, rounded);
    analysis.verdict = judge(analysis.records, {.order = &analysis.along.order, .sigma = sorted});
    analysis.orders = analysis.verdict->orders;
    return analysis;
}

} // namespace tvbeam

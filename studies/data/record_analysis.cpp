#include "studies/data/record_analysis.hpp"

#include <fmt/format.h>

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

/// Whether h stays, so that Δt is what is refined.
bool stays_in_h(const std::vector<Refinement>& sorted) {
    return std::isnan(sorted.front().h) || sorted.front().h == sorted.back().h;
}

/// Whether each h goes with one Δt, which does not grow as h falls.
bool is_one_path(const std::vector<Refinement>& sorted) {
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].dt > sorted[i - 1].dt ||
            (sorted[i].h == sorted[i - 1].h && sorted[i].dt < sorted[i - 1].dt))
            return false;
    return true;
}

/// The words of rows claim no more than the interval of the order does.
void temper(LadderVerdict& verdict, const OrderInterval& order) {
    constexpr double slack = 0.1; // of the order: that within which verdicts take orders for one
    if (!verdict.window)
        return;
    const double window = verdict.window->order;
    const double off = slack * order.value;
    if (order.determined && window >= order.low - off && window <= order.high + off)
        return;
    const std::string reason =
        order.determined
            ? fmt::format("order {:.2f} here; in the end {:.2f} ± {:.2f}", window, order.value,
                          order.half_width())
            : fmt::format("order {:.2f} here, and that of the end is not determined: {}", window,
                          order.status);
    for (auto& row : verdict.rows)
        if (row.verdict == Verdict::asymptotic)
            row = {Verdict::pre_asymptotic, reason};
}

} // namespace

RecordAnalysis analyse(std::vector<Refinement> records, const std::vector<double>& sigma) {
    RecordAnalysis analysis;
    if (is_grid(records)) {
        analysis.two_term = fit_two_term(records, {}, sigma);
        analysis.records = std::move(records);
        return analysis;
    }
    const auto order = coarse_to_fine(records);
    std::vector<ErrorRow> rows;
    for (const std::size_t i : order)
        analysis.records.push_back(records[i]);
    analysis.verdict = judge(analysis.records);
    analysis.orders = analysis.verdict->orders;
    if (records.empty())
        return analysis;
    analysis.is_in_dt = stays_in_h(analysis.records) && !std::isnan(analysis.records.front().dt);
    if (!analysis.is_in_dt && !is_one_path(analysis.records)) {
        analysis.in_turns = true;
        analysis.order.status = "h and dt are refined in turns; three of each in all pairs would "
                                "show both orders";
        return analysis;
    }
    // Orders do not know the scale of the errors; squares of theirs must be in range.
    double greatest = 0;
    for (const auto& record : analysis.records)
        if (record.is_resolved())
            greatest = std::max(greatest, record.error);
    const int exponent = is_positive(greatest) ? std::ilogb(greatest) : 0;
    for (const std::size_t i : order) {
        const auto& record = records[i];
        if (!record.is_resolved())
            continue;
        rows.push_back(
            {{analysis.is_in_dt ? record.dt : record.h}, std::ldexp(record.error, -exponent)});
        if (!sigma.empty())
            rows.back().sigma = sigma[i] / record.error;
    }
    const OrderEnsemble ensemble(rows);
    analysis.order = ensemble.orders().front();
    temper(*analysis.verdict, analysis.order);
    analysis.has_logarithm = analysis.order.determined && ensemble.has_logarithm();
    return analysis;
}

} // namespace tvbeam

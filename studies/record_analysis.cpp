#include "studies/record_analysis.hpp"

#include <cmath>
#include <set>

namespace tvbeam {

namespace {

/// A grid repeats its widths: fewer different ones than records, in both directions.
bool is_grid(const std::vector<Refinement>& records) {
    std::set<double> h;
    std::set<double> dt;
    for (const auto& record : records) {
        if (std::isnan(record.h) || std::isnan(record.dt))
            return false;
        h.insert(record.h);
        dt.insert(record.dt);
    }
    return h.size() >= 3 && dt.size() >= 3 && h.size() < records.size() &&
           dt.size() < records.size();
}

} // namespace

RecordAnalysis analyse(std::vector<Refinement> records) {
    RecordAnalysis analysis;
    if (is_grid(records)) {
        analysis.two_term = fit_two_term(records);
    } else {
        analysis.orders = observed_orders(records);
        analysis.verdict = judge(records);
        std::span<const Refinement> fitted(records);
        if (const auto& window = analysis.verdict->window)
            fitted = fitted.subspan(window->first, window->last - window->first + 1);
        analysis.power_law = fit_power_law(fitted);
    }
    analysis.records = std::move(records);
    return analysis;
}

} // namespace tvbeam

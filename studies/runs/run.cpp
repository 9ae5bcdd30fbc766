#include "studies/runs/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tvbeam {

double Rung::h() const {
    return has_mesh() ? 1.0 / static_cast<double>(elements)
                      : std::numeric_limits<double>::quiet_NaN();
}

double Rung::step() const {
    return has_steps() ? dt : std::numeric_limits<double>::quiet_NaN();
}

std::string Rung::name(const std::function<std::string(double)>& text) const {
    std::string name = has_mesh() ? "s = " + std::to_string(elements) : "";
    if (has_steps())
        name += (has_mesh() ? ", dt = " : "dt = ") + text(dt);
    return name;
}

std::string Measure::root() const {
    constexpr std::string_view suffix = "_sq";
    return squared && name.ends_with(suffix) ? name.substr(0, name.size() - suffix.size()) : name;
}

std::string Measure::of_orders() const {
    return root() + (squared && root() == name ? "^(1/2)" : "");
}

double work_of(const Method& method, const Rung& rung) {
    return static_cast<double>(std::max<std::int64_t>(rung.elements, 1)) *
           static_cast<double>(std::max<std::int64_t>(rung.steps, 1)) * method.cost;
}

std::string name_of(RungStatus status) {
    switch (status) {
    case RungStatus::ok:
        return "ok";
    case RungStatus::failed:
        return "failed";
    default:
        return "interrupted";
    }
}

std::int64_t RungResult::count(std::string_view name) const {
    const auto found = std::find_if(counters.begin(), counters.end(),
                                    [&](const Count& count) { return count.name == name; });
    return found == counters.end() ? 0 : found->value;
}

std::string RungResult::trouble(const std::function<std::string(double)>& text) const {
    return rung.name(text) + (status != RungStatus::interrupted ? " failed: " + reason
                              : reason == not_made              ? " was not run"
                                                                : " was interrupted");
}

bool finest_failed(const std::vector<RungResult>& runs) {
    const auto is_as_fine = [](const Rung& rung, const Rung& as) {
        return rung.elements >= as.elements && rung.dt <= as.dt;
    };
    return std::ranges::any_of(runs, [&](const RungResult& failed) {
        return failed.status == RungStatus::failed &&
               std::ranges::none_of(runs, [&](const RungResult& other) {
                   return other.status == RungStatus::ok && is_as_fine(other.rung, failed.rung);
               });
    });
}

double longest_time(const std::vector<Series>& all) {
    double longest = 0.0;
    for (const auto& series : all)
        longest = std::max(longest, series.final_time);
    return longest;
}

bool shows(const RungResult& run, const Measure& measure, std::size_t k) {
    return !run.errors.empty() &&
           (measure.is_value ? std::isfinite(run.errors[k]) : is_positive(run.errors[k]));
}

std::vector<double> units_of(const std::vector<RungResult>& rungs, std::size_t k, bool is_value) {
    std::vector<double> figures;
    std::vector<PrintedDigits> digits;
    for (const auto& rung : rungs) {
        if (!rung.errors.empty() && rung.printed.empty())
            return {};
        figures.push_back(rung.errors.empty() ? std::numeric_limits<double>::quiet_NaN()
                                              : rung.errors[k]);
        digits.push_back(rung.errors.empty() ? PrintedDigits{} : rung.printed[k]);
    }
    return is_value ? printed_units(figures, digits) : printed_units_of_errors(figures, digits);
}

std::vector<Refinement> records_of(const std::vector<RungResult>& rungs, std::size_t k) {
    std::vector<Refinement> records;
    records.reserve(rungs.size());
    for (const auto& rung : rungs)
        records.push_back(
            {.h = rung.rung.h(),
             .dt = rung.rung.step(),
             .error =
                 rung.errors.empty() ? std::numeric_limits<double>::quiet_NaN() : rung.errors[k],
             .seconds = rung.seconds,
             .uncertainty = rung.uncertainties.empty() ? 0.0 : rung.uncertainties[k]});
    return records;
}

std::vector<Refinement> root_records_of(const std::vector<RungResult>& rungs, std::size_t k,
                                        const Measure& measure) {
    auto records = records_of(rungs, k);
    if (measure.squared)
        for (auto& record : records)
            record.error = std::sqrt(record.error);
    return records;
}

} // namespace tvbeam

#include "reports/command_line/analysis_report.hpp"

#include "reports/document/orders_section.hpp"
#include "reports/document/text_table.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tvbeam {

namespace {

std::string width_text(double width) {
    return std::isnan(width) ? "" : shortest(width);
}

std::string error_text(double error) {
    return std::isfinite(error) ? scientific(error, 4) : "failed";
}

std::string ladder_text(const RecordAnalysis& analysis) {
    Table::Column h{"h", {}};
    Table::Column dt{"dt", {}};
    Table::Column error{"error", {}};
    Table::Column order{"order", {}};
    Table::Column verdict{"verdict", {}};
    std::string reasons;
    for (std::size_t i = 0; i < analysis.records.size(); ++i) {
        const Refinement& record = analysis.records[i];
        h.cells.push_back(width_text(record.h));
        dt.cells.push_back(width_text(record.dt));
        error.cells.push_back(error_text(record.error));
        order.cells.push_back(fixed(analysis.orders[i], 3));
        verdict.cells.emplace_back(name_of(analysis.verdict->rows[i].verdict));
        reasons += wrapped(fmt::format("row {}: {}", i + 1, analysis.verdict->rows[i].reason));
    }
    std::string text =
        text_table({"", {"", {h, dt, error}}, {{"", {order, verdict}}}}) + "\n" + reasons + "\n";
    const auto& window = analysis.verdict->window;
    if (const auto& fit = analysis.power_law) {
        const std::string rows =
            window ? fmt::format("rows {} to {}", window->first + 1, window->last + 1)
                   : std::string("all rows, none of which is shown to be asymptotic");
        const std::string floor =
            fit->floor > 0 ? " + " + scientific(fit->floor, 1) + " (floor)" : std::string();
        text += wrapped(fmt::format("fit over {}{}: error = {} w^{}{}, order {}", rows,
                                    fit->floor > 0 ? " and those on the floor" : "",
                                    scientific(fit->c, 3), fixed(fit->p, 3), floor,
                                    std::isfinite(fit->p_uncertainty())
                                        ? fixed(fit->p, 3) + " ± " + fixed(fit->p_uncertainty(), 3)
                                        : "without an uncertainty: two rows"));
    } else {
        text += wrapped("no fit: " + analysis.no_power_law);
    }
    return text;
}

std::string grid_text(const RecordAnalysis& analysis) {
    const TwoTermFit& fit = *analysis.two_term;
    if (!fit.holds())
        return wrapped("no two-term model: " + fit.failure);
    std::string text =
        wrapped(fmt::format("a grid of {} runs: e^2 = a^2 h^2p + 2 rho a b h^p dt^q + b^2 dt^2q",
                            analysis.records.size())) +
        "\n" + text_table(fit_table({{"error", &fit}}, analysis.records.size()));
    std::string notes;
    for (const auto& rejected : fit.rejected) {
        const Refinement& record = analysis.records[rejected.record];
        notes += wrapped(fmt::format("not fitted: h = {}, dt = {}: {}", shortest(record.h),
                                     shortest(record.dt), rejected.reason));
    }
    return notes.empty() ? text : text + "\n" + notes;
}

std::string value_text(const ValueAnalysis& analysis) {
    Table::Column h{"width", {}};
    Table::Column value{"value", {}};
    for (const auto& grid : analysis.grids) {
        h.cells.push_back(shortest(grid.h));
        value.cells.push_back(std::isfinite(grid.value) ? shortest(grid.value) : "failed");
    }
    std::string text = text_table({"", {"", {h}}, {{"", {value}}}}) + "\n";
    if (const auto& finest = analysis.finest; !finest)
        text += wrapped("no extrapolation: " + analysis.no_extrapolation);
    else if (finest->order > 0)
        text += wrapped(fmt::format("the three finest grids: observed order {}, Richardson's limit "
                                    "{:.8g}, GCI {} about the finest value",
                                    fixed(finest->order, 3), finest->limit,
                                    scientific(finest->gci, 2)));
    else
        text +=
            wrapped(fmt::format("the three finest grids: observed order {}, the values run apart",
                                fixed(finest->order, 3)));
    if (const auto& fit = analysis.limit) {
        // As for an order of errors: one that scatters by more than itself is no order.
        const double uncertainty = fit->order_uncertainty();
        text += wrapped(fmt::format("fit over all grids: limit {:.8g}, finest value ± {}, order {}",
                                    fit->limit, scientific(fit->uncertainty, 2),
                                    uncertainty <= TwoTermFit::widest_uncertainty
                                        ? fixed(fit->order, 3) + " ± " + fixed(uncertainty, 3)
                                        : std::string("not determined")));
    }
    return text;
}

} // namespace

std::string analysis_report(const RecordAnalysis& analysis) {
    if (analysis.values)
        return value_text(*analysis.values);
    return analysis.two_term ? grid_text(analysis) : ladder_text(analysis);
}

} // namespace tvbeam

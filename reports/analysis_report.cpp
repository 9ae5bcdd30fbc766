#include "reports/analysis_report.hpp"

#include "reports/number_text.hpp"
#include "reports/orders_text.hpp"
#include "reports/text_table.hpp"

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
    TextTable::Column h{"h", {}};
    TextTable::Column dt{"dt", {}};
    TextTable::Column error{"error", {}};
    TextTable::Column order{"order", {}};
    TextTable::Column verdict{"verdict", {}};
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
        TextTable({"", {h, dt, error}}, {{"", {order, verdict}}}).text() + "\n" + reasons + "\n";
    const auto& window = analysis.verdict->window;
    if (const auto& fit = analysis.power_law) {
        const std::string rows =
            window ? fmt::format("rows {} to {}", window->first + 1, window->last + 1)
                   : std::string("all rows, none of which is shown to be asymptotic");
        text += wrapped(fmt::format("fit over {}: error = {} w^{}, order {}", rows,
                                    scientific(fit->c, 3), fixed(fit->p, 3),
                                    std::isfinite(fit->p_uncertainty())
                                        ? fixed(fit->p, 3) + " ± " + fixed(fit->p_uncertainty(), 3)
                                        : "without an uncertainty: two rows"));
    } else {
        text += "no fit: fewer than two usable rows\n";
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
        "\n" + fit_table({{"error", &fit}}, analysis.records.size());
    std::string notes;
    for (const auto& rejected : fit.rejected) {
        const Refinement& record = analysis.records[rejected.record];
        notes += wrapped(fmt::format("not fitted: h = {}, dt = {}: {}", shortest(record.h),
                                     shortest(record.dt), rejected.reason));
    }
    return notes.empty() ? text : text + "\n" + notes;
}

} // namespace

std::string analysis_report(const RecordAnalysis& analysis) {
    return analysis.two_term ? grid_text(analysis) : ladder_text(analysis);
}

} // namespace tvbeam

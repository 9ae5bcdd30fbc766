#include "reports/orders_text.hpp"

#include "reports/number_text.hpp"
#include "reports/text_table.hpp"

#include <fmt/format.h>

namespace tvbeam {

namespace {

std::string order_text(double size, double order, bool determined, double uncertainty) {
    if (size == 0)
        return "not seen";
    return determined ? fixed(order, 3) + " ± " + fixed(uncertainty, 3) : "not determined";
}

const char* cause(Rejection why) {
    switch (why) {
    case Rejection::failed:
        return "no error";
    case Rejection::exact:
        return "the error is zero";
    case Rejection::rounding_floor:
        return "at the rounding floor";
    case Rejection::pre_asymptotic:
        return "too coarse for the model";
    case Rejection::outlier:
        break;
    }
    return "out of line with their neighbours";
}

/// The runs that a fit leaves out, a sentence a cause.
std::string rejections(const std::string& norm, const TwoTermFit& fit,
                       const std::vector<RungResult>& runs) {
    std::string text;
    for (const Rejection why : {Rejection::failed, Rejection::exact, Rejection::rounding_floor,
                                Rejection::pre_asymptotic, Rejection::outlier}) {
        std::string named;
        for (const auto& rejected : fit.rejected)
            if (rejected.why == why) {
                const Rung& rung = runs[rejected.record].rung;
                named += fmt::format("{}({}, {})", named.empty() ? "" : ", ", rung.elements,
                                     shortest(rung.dt));
            }
        if (!named.empty())
            text +=
                wrapped(fmt::format("{}: not fitted, {}: (s, dt) = {}", norm, cause(why), named));
    }
    return text;
}

} // namespace

std::string fit_table(const std::vector<std::pair<std::string, const TwoTermFit*>>& fits,
                      std::size_t records) {
    TextTable::Column name{"norm", {}};
    TextTable::Column p{"p", {}};
    TextTable::Column q{"q", {}};
    TextTable::Column a{"a", {}};
    TextTable::Column b{"b", {}};
    TextTable::Column rho{"rho", {}};
    TextTable::Column rms{"rms", {}};
    TextTable::Column used{"used", {}};
    for (const auto& [norm, fit] : fits) {
        name.cells.push_back(norm);
        const TwoTermModel& model = fit->model;
        const bool in_space = fit->p_determined();
        const bool in_time = fit->q_determined();
        p.cells.push_back(order_text(model.a, model.p, in_space, fit->p_uncertainty()));
        q.cells.push_back(order_text(model.b, model.q, in_time, fit->q_uncertainty()));
        // A size is one of h^p: without p it has no unit, and ρ is between two terms.
        a.cells.push_back(in_space ? scientific(model.a, 3) : "");
        b.cells.push_back(in_time ? scientific(model.b, 3) : "");
        rho.cells.push_back(in_space && in_time ? fixed(model.rho, 2) : "");
        rms.cells.push_back(scientific(fit->rms, 1));
        used.cells.push_back(fmt::format("{}/{}", fit->used.size(), records));
    }
    return TextTable({"", {name}}, {{"", {p, q, a, b, rho, rms, used}}}).text();
}

std::string orders_text(const OrdersResult& orders) {
    std::vector<std::pair<std::string, const TwoTermFit*>> fits;
    std::string notes;
    for (const auto& [norm, fit] : orders.norms) {
        if (fit.holds()) {
            fits.emplace_back(norm, &fit);
            notes += rejections(norm, fit, orders.runs);
        } else {
            notes += wrapped(norm + ": no model: " + fit.failure);
        }
    }
    std::string text =
        wrapped(fmt::format("Orders from {} runs: e^2 = a^2 h^2p + 2 rho a b h^p dt^q + b^2 dt^2q "
                            "(±: 95 %)",
                            orders.runs.size()));
    if (!fits.empty())
        text += "\n" + fit_table(fits, orders.runs.size());
    if (orders.corollary)
        text +=
            "\n" +
            wrapped(fmt::format(
                "Corollary 2.2: its left side is C (h^2 + dt^2) with C from {} to {} over "
                "the grid, {} at its finest run.",
                scientific(orders.corollary->least, 2), scientific(orders.corollary->greatest, 2),
                scientific(orders.corollary->finest, 2)));
    for (const auto& run : orders.runs)
        if (run.status != RunStatus::ok)
            notes += wrapped(fmt::format("s = {}, dt = {} failed: {}", run.rung.elements,
                                         shortest(run.rung.dt), run.reason));
    return notes.empty() ? text : text + "\n" + notes;
}

} // namespace tvbeam

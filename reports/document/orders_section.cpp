#include "reports/document/orders_section.hpp"

#include "reports/document/ending_text.hpp"
#include "studies/orders/error_rows.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace tvbeam {

namespace {

std::string order_text(const OrderInterval& order) {
    return order.determined ? fixed(order.value, 3) + " ± " + fixed(order.half_width(), 3)
                            : "not determined";
}

/// "0.17(3)" for 0.168 ± 0.025, "1.7(3)e-5": the last digit is known to ± what stands in brackets,
/// rounded up. Nothing where the interval, rounded so, reaches to twice the size or to none.
std::string size_text(double size, double uncertainty) {
    if (!(uncertainty < 1))
        return "";
    const double half = size * uncertainty;
    double digit = std::floor(std::log10(half));
    double times = std::ceil(half / std::pow(10.0, digit));
    if (times >= 10) {
        times = 1;
        ++digit;
    }
    const double leading = std::floor(std::log10(size));
    if (times >= std::round(size / std::pow(10.0, digit)))
        return "";
    if (leading >= -4 && leading <= 4 && digit <= 0)
        return fmt::format("{:.{}f}({:.0f})", size, static_cast<int>(-digit), times);
    return fmt::format("{:.{}f}({:.0f})e{:.0f}", size / std::pow(10.0, leading),
                       static_cast<int>(leading - digit), times, leading);
}

/// So many that the interval shows two of its own.
int digits_of(const OrderInterval& limit) {
    constexpr double most = 17.0;
    const double size = std::abs(limit.value) / limit.half_width();
    return size > 1.0 ? static_cast<int>(std::min(std::ceil(std::log10(size)) + 2.0, most)) : 2;
}

/// "(s, dt) = (4, 0.1), (8, 0.1)".
std::string names_of(const std::vector<Rung>& rungs) {
    std::string names;
    for (const auto& rung : rungs)
        names +=
            fmt::format("{}({}, {})", names.empty() ? "" : ", ", rung.elements, shortest(rung.dt));
    return "(s, dt) = " + names;
}

/// The runs that a fit leaves out, a sentence a cause.
std::vector<Block> rejections(const std::string& norm, const TwoTermFit& fit,
                              const std::vector<RungResult>& runs) {
    std::vector<Block> sentences;
    for (const Rejection why : {Rejection::failed, Rejection::unresolved, Rejection::exact,
                                Rejection::pre_asymptotic, Rejection::outlier}) {
        std::vector<Rung> named;
        for (const auto& rejected : fit.rejected)
            if (rejected.why == why)
                named.push_back(runs[rejected.record].rung);
        if (!named.empty())
            sentences.emplace_back(Paragraph{
                fmt::format("{}: not fitted, {}: {}", norm, words_for(why), names_of(named))});
    }
    return sentences;
}

/// What the fit's row of the table says, as a sentence.
Finding finding(const std::string& norm, const TwoTermFit& fit) {
    const auto order = [](const OrderInterval& of) {
        return of.determined ? "of order " + order_text(of)
                             : "of an order that is not determined: " + of.status;
    };
    return {fmt::format("{}: the error in space is {}; the error in time is {}{}.", norm,
                        order(fit.p), order(fit.q), fit.misfit.empty() ? "" : "; " + fit.misfit),
            2, !fit.predicts()};
}

/// "6 meshes with 5 steps, 30 runs".
std::string size_text(const std::vector<RungResult>& runs) {
    std::set<std::int64_t> meshes;
    for (const auto& run : runs)
        meshes.insert(run.rung.elements);
    return fmt::format("{} meshes with {} steps, {} runs", meshes.size(),
                       runs.size() / meshes.size(), runs.size());
}

/// A value in both widths.
Finding finding(const GridLimit& of) {
    const std::string orders =
        "; order in h " + order_text(of.p) + "; order in dt " + order_text(of.q) + ".";
    if (!of.limit.determined)
        return {of.value + ": no limit: " + of.limit.status + orders, 2, true};
    const int digits = digits_of(of.limit);
    return {fmt::format("{}: limit {:.{}g} ± {} (95 %) in h and dt; the finest value ± {}",
                        of.value, of.limit.value, digits, scientific(of.limit.half_width(), 2),
                        scientific(of.uncertainty, 2)) +
                orders,
            2};
}

/// Which of the runs limits come from.
std::string basis_of_limits(const std::vector<RungResult>& runs) {
    std::set<double> h;
    std::set<double> dt;
    for (const auto& run : runs) {
        h.insert(run.rung.h());
        dt.insert(run.rung.dt);
    }
    const auto from = std::ranges::count_if(runs, [&](const RungResult& run) {
        const bool is_finest = run.rung.h() == *h.begin() || run.rung.dt == *dt.begin();
        const bool is_next =
            run.rung.h() == *std::next(h.begin()) && run.rung.dt == *std::next(dt.begin());
        return run.status == RungStatus::ok && (is_finest || is_next);
    });
    return fmt::format("Limits are from {} of the {} runs: those finest in h or in dt, and the one "
                       "next to the finest in both.",
                       from, runs.size());
}

/// On what they are measured against, and why they are no more.
std::vector<std::string> sentences_on_runs(const OrdersResult& orders, const OrdersBlock& block) {
    std::vector<std::string> sentences;
    if (!orders.reference_remark.empty())
        sentences.push_back(orders.reference_remark);
    if (orders.refined)
        sentences.push_back(ending_text(*orders.refined, *block.until, size_text(orders.runs)));
    return sentences;
}

/// After a blank line, where there are any.
void add_limits(std::vector<Block>& blocks, const OrdersResult& orders) {
    if (orders.values.empty())
        return;
    blocks.emplace_back(BlankLine{});
    if (std::ranges::any_of(orders.values, [](const GridLimit& of) { return of.limit.determined; }))
        blocks.emplace_back(Paragraph{basis_of_limits(orders.runs)});
    for (const auto& value : orders.values) {
        blocks.emplace_back(finding(value));
        if (!value.out_of_line.empty())
            blocks.emplace_back(Finding{value.value +
                                            ": out of line with the runs that the limit is from: " +
                                            names_of(value.out_of_line),
                                        2, true});
    }
}

} // namespace

Table fit_table(const std::vector<std::pair<std::string, const TwoTermFit*>>& fits,
                std::size_t records) {
    Table::Column name{"norm", {}};
    Table::Column p{"p", {}};
    Table::Column q{"q", {}};
    Table::Column a{"a", {}};
    Table::Column b{"b", {}};
    Table::Column rho{"rho", {}};
    Table::Column rms{"rms", {}};
    Table::Column used{"used", {}};
    for (const auto& [norm, fit] : fits) {
        name.cells.push_back(norm);
        const TwoTermModel& model = fit->model;
        p.cells.push_back(order_text(fit->p));
        q.cells.push_back(order_text(fit->q));
        // ρ is between two terms: its sign is as open as their sizes.
        a.cells.push_back(fit->a_known() ? size_text(model.a, fit->a_uncertainty) : "");
        b.cells.push_back(fit->b_known() ? size_text(model.b, fit->b_uncertainty) : "");
        rho.cells.push_back(fit->is_known() ? fixed(model.rho, 2) : "");
        rms.cells.push_back(scientific(fit->rms, 1));
        used.cells.push_back(fmt::format("{}/{}", fit->used.size(), records));
    }
    return {fmt::format("Orders p in h and q in dt and sizes a and b of the two terms (±, and "
                        "the last digit in brackets: 95 %), "
                        "cosine rho of the angle between them, relative scatter rms, and how many "
                        "of the {} runs were used.",
                        records),
            {"", {name}},
            {{"", {p, q, a, b, rho, rms, used}}}};
}

Section orders_section(const OrdersResult& orders, const OrdersBlock& block) {
    std::vector<std::pair<std::string, const TwoTermFit*>> fits;
    std::vector<Block> findings;
    std::vector<Block> notes;
    for (std::size_t k = 0; k < orders.norms.size(); ++k) {
        const auto& fit = orders.norms[k].fit;
        const std::string norm = block.norms[k].of_orders();
        if (fit.holds()) {
            fits.emplace_back(norm, &fit);
            findings.emplace_back(finding(norm, fit));
            if (vanishes_at_the_finest(orders.runs, k))
                findings.emplace_back(Finding{
                    norm + ": " + finest_is_zero + "; what is said is of the runs before it.", 2});
            const auto more = rejections(norm, fit, orders.runs);
            notes.insert(notes.end(), more.begin(), more.end());
        } else {
            notes.emplace_back(Finding{norm + ": no model: " + fit.failure});
        }
    }
    for (const auto& run : orders.runs)
        if (run.status != RungStatus::ok)
            notes.emplace_back(Paragraph{run.trouble(shortest)});
    const std::string from = fmt::format("rom {} runs", orders.runs.size());
    Section section{
        "Orders in h and dt",
        {Paragraph{orders.norms.empty() ? "F" + from + ":"
                                        : "Orders f" + from +
                                              ": e^2 = a^2 h^2p + 2 rho a b h^p dt^q + b^2 dt^2q "
                                              "(±: 95 %)"}}};
    auto& blocks = section.blocks;
    if (!fits.empty()) {
        blocks.emplace_back(BlankLine{});
        blocks.emplace_back(fit_table(fits, orders.runs.size()));
        blocks.insert(blocks.end(), findings.begin(), findings.end());
    }
    add_limits(blocks, orders);
    if (const auto& constant = orders.corollary) {
        blocks.emplace_back(BlankLine{});
        blocks.emplace_back(Finding{
            fmt::format("{}: its left side is C (h^2 + dt^2) with C from {} to {} over the "
                        "grid, {} at its finest run.",
                        constant->theorem, scientific(constant->least, 2),
                        scientific(constant->greatest, 2), scientific(constant->finest, 2))});
    }
    for (const auto& sentence : sentences_on_runs(orders, block)) {
        blocks.emplace_back(BlankLine{});
        blocks.emplace_back(Finding{sentence});
    }
    if (!notes.empty()) {
        blocks.emplace_back(BlankLine{});
        blocks.insert(blocks.end(), notes.begin(), notes.end());
    }
    return section;
}

} // namespace tvbeam

#include "core/norms/norms.hpp"
#include "mms/forecast/error_constants.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/grid/grid.hpp"
#include "studies/grid/grid_lines.hpp"
#include "studies/orders/known_orders.hpp"
#include "studies/orders/least_squares.hpp"
#include "studies/study.hpp"
#include "studies/table_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// A parameter of the fit, and the orders that it means nothing without.
struct FitMetric {
    const char* key;
    const char* words;
    double TwoTermModel::*value;
    bool in_h;
    bool in_dt;
    bool is_of_leading_terms;
};

constexpr FitMetric fit_metrics[] = {
    {"p", "p, the order in h", &TwoTermModel::p, true, false, false},
    {"q", "q, the order in dt", &TwoTermModel::q, false, true, false},
    {"a", "a, the constant of h^p", &TwoTermModel::a, true, false, true},
    {"b", "b, the constant of dt^q", &TwoTermModel::b, false, true, true},
    {"rho", "rho", &TwoTermModel::rho, true, true, true}};

/// Why no gate on an order or a size holds, whatever the fit says; mostly empty.
std::string refusal(const OrdersResult& result, std::size_t k) {
    if (finest_failed(result.runs))
        return finest_run_failed;
    return vanishes_at_the_finest(result.runs, k) ? finest_is_zero : "";
}

/// A parameter of an order that the grid does not determine meets no band.
Metric metric_of(const FitMetric& metric, const OrdersResult& result, std::size_t k) {
    const NormOrders& orders = result.norms[k];
    const TwoTermFit& fit = orders.fit;
    std::string absence = refusal(result, k);
    if (absence.empty())
        absence = fit.failure;
    if (fit.holds())
        for (const auto& [wanted, order] :
             {std::pair(metric.in_h, &fit.p), std::pair(metric.in_dt, &fit.q)})
            if (wanted && !order->determined && absence.empty())
                absence = "not determined: " + order->status;
    if (absence.empty() && metric.is_of_leading_terms)
        absence = fit.misfit;
    // Of a size that hangs on its order the fit's own is held, as the regression that it may be; ρ,
    // which then may have either sign, is not.
    if (absence.empty() && metric.value == &TwoTermModel::rho && !fit.is_known())
        absence = "not known: the sizes of the two terms are open by a factor of two or more";
    return {"orders." + orders.norm + ": " + metric.words,
            absence.empty() ? std::optional(fit.model.*metric.value) : std::nullopt, absence};
}

CheckedExpectation judged(const JudgeInterval& judge, bool in_h, const OrdersResult& result,
                          std::size_t k) {
    const NormOrders& orders = result.norms[k];
    OrderInterval order = in_h ? orders.fit.p : orders.fit.q;
    if (!orders.fit.holds())
        order = {.status = orders.fit.failure};
    if (const std::string why = refusal(result, k); !why.empty())
        order = {.status = why};
    return judge("orders." + orders.norm + (in_h ? ": p" : ": q"), order);
}

/// The runs that a fit leaves out, and why: "s = 4, dt = 0.1: too coarse for the model: …".
std::vector<std::string> rejected(const OrdersResult& result, std::size_t k) {
    std::vector<std::string> words;
    for (const auto& one : result.norms[k].fit.rejected)
        words.push_back(result.runs[one.record].rung.name(metric_text) + ": " + one.reason);
    return words;
}

/// Of a size that the grid determines: the half-width of its 95 % interval, as a share of it.
constexpr double largest_share_of_a_known_size = 0.1;

/// Why a size that is not the forecast one is not the grid's: only what its runs show is held
/// against a method. other: the term in the other width, null where there is none.
std::string not_shown(const std::vector<Refinement>& runs, double Refinement::*width,
                      const LeadingTerm& term, double size, const LeadingTerm* other,
                      double other_size, const OrderInterval& order) {
    if (!(order.determined && order.low <= term.order && term.order <= order.high))
        return order.determined ? fmt::format(", and the order is {:.2f} ± {:.2f}", order.value,
                                              order.half_width())
                                : ", and the order is not determined";
    if (term.over_time.empty())
        return {};
    double least_seen = 1.0;
    std::set<double> levels; // at which the term is by far the larger one
    for (const auto& run : runs) {
        if (!(run.error > 0.0))
            continue;
        least_seen = std::min(least_seen, term.seen_by(run.dt));
        const double other_width = width == &Refinement::h ? run.dt : run.h;
        const double beside =
            other == nullptr ? 0.0 : other_size * std::pow(other_width, other->order);
        if (3.0 * beside <= size * std::pow(run.*width, term.order))
            levels.insert(run.*width);
    }
    constexpr double nearly_all = 0.99;
    if (least_seen < nearly_all)
        return fmt::format(", and the maximum over time stands between the levels of the longest "
                           "steps, which see {:.2g} of it",
                           least_seen);
    return levels.size() < 3 ? ", and the other term hides where its maximum stands"
                             : std::string();
}

/// Sizes that the grid gives to terms of the forecast orders, over the forecast ones.
std::vector<Metric> forecast_metrics(std::size_t k, double within, const StudyResult& result) {
    const OrdersBlock& block = *result.scene.get<OrdersBlock>();
    const Measure& measure = block.norms[k];
    const auto metric = [&](const std::string& size, std::optional<double> value,
                            const std::string& absence) {
        return Metric{"orders." + measure.root() + ": " + size + " over its forecast", value,
                      absence};
    };
    const ErrorConstants forecast = forecast_constants(result.scene, block.final_time);
    const NormConstants* norm = forecast.of(measure.root());
    if (norm == nullptr || !norm->unknown.empty())
        return {metric("a, b", std::nullopt,
                       "no forecast: " + (norm != nullptr            ? norm->unknown
                                          : forecast.unknown.empty() ? "the beam has no stops"
                                                                     : forecast.unknown))};
    const auto order = [](const auto& term) {
        return term ? std::optional(term->order) : std::nullopt;
    };
    const auto known = Norm::named(measure.root());
    const auto runs = root_records_of(result.get<OrdersResult>()->runs, k, measure);
    const auto sizes = fit_known_orders(runs, order(norm->in_h), order(norm->in_dt),
                                        known && known->has_maximum());
    std::vector<Metric> metrics;
    const TwoTermFit& free = result.get<OrdersResult>()->norms[k].fit;
    const auto add = [&](const std::string& size, double Refinement::*width,
                         const std::optional<LeadingTerm>& term,
                         const std::optional<FittedSize>& fitted,
                         const std::optional<LeadingTerm>& other,
                         const std::optional<FittedSize>& its_size, const OrderInterval& order) {
        if (!term)
            return;
        const double share = fitted ? fitted->uncertainty / fitted->value : infinity;
        // A wide band asks for no less: a term that the others hide is not found.
        bool known = share <= std::min(within, largest_share_of_a_known_size);
        std::string reason;
        if (known && std::abs(fitted->value / term->constant - 1.0) > within) {
            reason = free.holds()
                         ? not_shown(runs, width, *term, fitted->value, other ? &*other : nullptr,
                                     its_size ? its_size->value : 0.0, order)
                         : ", and the runs have no model";
            known = reason.empty();
        }
        const std::string found =
            fitted ? fmt::format("{:.3g} ± {:.3g} of ", fitted->value / term->constant,
                                 fitted->uncertainty / term->constant)
                   : "";
        metrics.push_back(
            metric(size, known ? std::optional(fitted->value / term->constant) : std::nullopt,
                   sizes.failure.empty()
                       ? fmt::format("the grid does not determine it: {}a forecast of {:.3g}{}",
                                     found, term->constant, reason)
                       : sizes.failure));
    };
    add("a", &Refinement::h, norm->in_h, sizes.a, norm->in_dt, sizes.b, free.p);
    add("b", &Refinement::dt, norm->in_dt, sizes.b, norm->in_h, sizes.a, free.q);
    if (metrics.empty())
        metrics.push_back(metric("a, b", std::nullopt, "no error is forecast"));
    return metrics;
}

/// constant, the greatest of the theorem's over the grid, least_constant and finest_constant.
void expect_constants(TableReader& table, const std::string& norm,
                      std::vector<Expectation>& expectations) {
    struct Row {
        const char* key;
        const char* words;
        double TheoremConstants::*which;
    };
    for (const Row& row : {Row{"constant", "greatest", &TheoremConstants::greatest},
                           Row{"least_constant", "least", &TheoremConstants::least},
                           Row{"finest_constant", "finest", &TheoremConstants::finest}})
        expect_band(table, row.key, expectations, [norm, row](const StudyResult& result) {
            const auto& constants = result.get<OrdersResult>()->corollary;
            const std::string what = "orders." + norm + ": " + row.words + " constant C";
            const auto found = constants ? std::optional((*constants).*row.which) : std::nullopt;
            return std::vector{Metric{what, found, "no run of the grid has an error"}};
        });
}

/// limit, p and q of a value with their intervals, and the uncertainty of the finest.
void expect_limit(TableReader& table, const OrdersBlock& block, std::size_t k,
                  std::vector<Expectation>& expectations) {
    const std::string name = "orders." + block.norms[k].name + ": ";
    const auto errors = static_cast<std::size_t>(
        std::count_if(block.norms.begin(), block.norms.end(),
                      [](const Measure& measure) { return !measure.is_value; }));
    const auto limit = [place = k - errors](const StudyResult& result) -> const GridLimit& {
        return result.get<OrdersResult>()->values.at(place);
    };
    for (const auto& [key, interval] :
         {std::pair("limit", &GridLimit::limit), {"p", &GridLimit::p}, {"q", &GridLimit::q}}) {
        const auto found =
            [limit, interval = interval](const StudyResult& result) -> const OrderInterval& {
            return limit(result).*interval;
        };
        const std::string what = name + key;
        expect_band(table, key, expectations, [what, found](const StudyResult& result) {
            const OrderInterval& of = found(result);
            return std::vector{Metric{what, of.determined ? std::optional(of.value) : std::nullopt,
                                      "not determined: " + of.status}};
        });
        expect_interval(table, key, [&](const JudgeInterval& judge) {
            expectations.push_back([what, found, judge](const StudyResult& result) {
                return std::vector{judge(what, found(result))};
            });
        });
    }
    expect_words(table, "left_out", expectations, [limit](const StudyResult& result) {
        std::vector<std::string> words;
        for (const auto& rung : limit(result).out_of_line)
            words.push_back(rung.name(metric_text) + ": out of line");
        return words;
    });
    expect_band(table, "uncertainty", expectations, [name, limit](const StudyResult& result) {
        const GridLimit& of = limit(result);
        return std::vector{Metric{
            name + "uncertainty of the finest value",
            of.limit.determined ? std::optional(of.uncertainty) : std::nullopt, of.limit.status}};
    });
}

} // namespace

/// The block [orders].
struct OrdersStudy final : KindOf<OrdersBlock, OrdersResult> {
    std::string name() const override { return "orders"; }
    bool measures() const override { return true; }

    std::any read(TableReader& table, const SolverKeys& keys) const override {
        return read_orders(table, keys);
    }
    std::vector<Series> series(const std::any& block, const Method& own) const override {
        return {series_of(block_in(block), own)};
    }
    using StudyKind::until;
    Until* until(std::any& block) const override { return until_in(block); }
    std::vector<Rung> addable(const std::any& block) const override {
        return block_in(block).until ? addable_runs(block_in(block)) : std::vector<Rung>();
    }
    std::vector<Rung>
    dearest_addition(const std::any& block,
                     const std::function<double(const Rung&)>& cost) const override {
        return block_in(block).until ? tvbeam::dearest_addition(block_in(block), cost)
                                     : std::vector<Rung>();
    }
    std::size_t most_at_a_time(const std::any& block) const override {
        return longest_line(block_in(block));
    }
    std::any run(const std::any& block, const StudyContext& context) const override {
        return run_orders(block_in(block), context.method, context.solver, context.execution);
    }
    Runs runs(const std::any& record) const override { return {&record_in(record).runs}; }

    void expect(TableReader& table, const std::any& block,
                std::vector<Expectation>& expectations) const override {
        require_free_names(table, block_in(block).norms);
        if (block_in(block).until)
            expect_refined(table, name(), expectations, [](const StudyResult& result) {
                return *result.get<OrdersResult>()->refined;
            });
        const auto read = [&](TableReader& norm, std::size_t k) {
            if (block_in(block).norms[k].is_value) {
                expect_limit(norm, block_in(block), k, expectations);
                return;
            }
            for (const auto& metric : fit_metrics) {
                expect_band(
                    norm, metric.key, expectations, [&metric, k](const StudyResult& result) {
                        return std::vector{metric_of(metric, *result.get<OrdersResult>(), k)};
                    });
            }
            for (const bool in_h : {true, false})
                expect_interval(norm, in_h ? "p" : "q", [&](const JudgeInterval& judge) {
                    expectations.push_back([k, in_h, judge](const StudyResult& result) {
                        return std::vector{judged(judge, in_h, *result.get<OrdersResult>(), k)};
                    });
                });
            expect_words(norm, "left_out", expectations, [k](const StudyResult& result) {
                return rejected(*result.get<OrdersResult>(), k);
            });
            if (const auto within = norm.number("forecast")) {
                if (!(*within > 0.0 && *within <= widest_part))
                    throw norm.error("forecast", " must be > 0 and at most 0.5: by what part a and "
                                                 "b may differ from their forecasts");
                expectations.push_back(in_band(1.0 - *within, 1.0 + *within, norm.place("forecast"),
                                               [k, within = *within](const StudyResult& result) {
                                                   return forecast_metrics(k, within, result);
                                               }));
            }
            const Measure& measure = block_in(block).norms[k];
            if (!measure.theorem.empty())
                expect_constants(norm, measure.name, expectations);
        };
        for_each_measure(table, block_in(block).norms, expectations, read);
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, OrdersStudy>();

} // namespace tvbeam

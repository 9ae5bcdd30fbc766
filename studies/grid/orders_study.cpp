#include "mms/text/toml_reader.hpp"
#include "studies/grid/grid.hpp"
#include "studies/study.hpp"
#include "studies/table_row.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

/// A parameter of the fit, and the orders that it means nothing without.
struct FitMetric {
    const char* key;
    const char* words;
    double TwoTermModel::*value;
    bool in_h;
    bool in_dt;
};

constexpr FitMetric fit_metrics[] = {
    {"p", "p, the order in h", &TwoTermModel::p, true, false},
    {"q", "q, the order in dt", &TwoTermModel::q, false, true},
    {"a", "a, the constant of h^p", &TwoTermModel::a, true, false},
    {"b", "b, the constant of dt^q", &TwoTermModel::b, false, true},
    {"rho", "rho", &TwoTermModel::rho, true, true}};

/// A parameter of an order that the grid does not determine meets no band.
Metric metric_of(const FitMetric& metric, const NormOrders& orders) {
    const TwoTermFit& fit = orders.fit;
    std::string absence = fit.failure;
    if (fit.holds())
        for (const auto& [wanted, order] :
             {std::pair(metric.in_h, &fit.p), std::pair(metric.in_dt, &fit.q)})
            if (wanted && !order->determined && absence.empty())
                absence = "not determined: " + order->status;
    return {"orders." + orders.norm + ": " + metric.words,
            absence.empty() ? std::optional(fit.model.*metric.value) : std::nullopt, absence};
}

std::vector<Metric> constant_metrics(const std::string& norm, const StudyResult& result) {
    const auto& constants = result.get<OrdersResult>()->corollary;
    return {{"orders." + norm + ": greatest constant C",
             constants ? std::optional(constants->greatest) : std::nullopt,
             "no run of the grid has an error"}};
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
    std::any run(const std::any& block, const StudyContext& context) const override {
        return run_orders(block_in(block), context.method, context.solver, context.execution);
    }
    Runs runs(const std::any& record) const override { return {&record_in(record).runs}; }

    void expect(TableReader& table, const std::any& block,
                std::vector<Expectation>& expectations) const override {
        for_each_measure(table, block_in(block).norms, [&](TableReader& norm, std::size_t k) {
            for (const auto& metric : fit_metrics) {
                expect_band(
                    norm, metric.key, expectations, [&metric, k](const StudyResult& result) {
                        return std::vector{metric_of(metric, result.get<OrdersResult>()->norms[k])};
                    });
            }
            const Measure& measure = block_in(block).norms[k];
            if (!measure.theorem.empty())
                expect_band(norm, "constant", expectations,
                            [name = measure.name](const StudyResult& result) {
                                return constant_metrics(name, result);
                            });
        });
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, OrdersStudy>();

} // namespace tvbeam

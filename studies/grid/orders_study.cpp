#include "mms/text/toml_reader.hpp"
#include "studies/grid/grid.hpp"
#include "studies/study.hpp"
#include "studies/table_row.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

/// A parameter of the fit, and how well the fit must know it to be held to a band.
struct FitMetric {
    const char* key;
    const char* words;
    double TwoTermModel::*value;
    bool (TwoTermFit::*determined)() const = nullptr;
    double (TwoTermFit::*uncertainty)() const = nullptr;
};

constexpr FitMetric fit_metrics[] = {{"p", "p, the order in h", &TwoTermModel::p,
                                      &TwoTermFit::p_determined, &TwoTermFit::p_uncertainty},
                                     {"q", "q, the order in dt", &TwoTermModel::q,
                                      &TwoTermFit::q_determined, &TwoTermFit::q_uncertainty},
                                     {"a", "a, the constant of h^p", &TwoTermModel::a},
                                     {"b", "b, the constant of dt^q", &TwoTermModel::b},
                                     {"rho", "rho", &TwoTermModel::rho}};

/// width: of the band. An order that the grid does not determine, or less well than its band is
/// wide, says nothing about the band.
Metric metric_of(const FitMetric& metric, const NormOrders& orders, double width) {
    const TwoTermFit& fit = orders.fit;
    const double value = fit.model.*metric.value;
    const bool known =
        fit.holds() && (metric.determined == nullptr ||
                        ((fit.*metric.determined)() && (fit.*metric.uncertainty)() <= width));
    return {"orders." + orders.norm + ": " + metric.words,
            known ? std::optional(value) : std::nullopt,
            fit.holds() ? metric_text(value) + ", not determined well enough for this band"
                        : fit.failure};
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
                const auto band = norm.band(metric.key);
                if (!band)
                    continue;
                const double width = band->highest - band->lowest;
                expect_band(norm, metric.key, expectations,
                            [&metric, k, width](const StudyResult& result) {
                                return std::vector{
                                    metric_of(metric, result.get<OrdersResult>()->norms[k], width)};
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

// Scores the engine on errors by laws that are known: how many orders of h, and of dt, it calls
// determined, and how many of those intervals miss. Usage: made_up_scores SEED TABLES. Of h^p T +
// b dt^q, added with a correlation that is -1 in one of four, T one of the kinds below; without dt
// on sequences. Scatter of errors is stated, and of grids once more not.

#include "studies/orders/order_engine.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <vector>

using namespace tvbeam;

namespace {

struct Kind {
    const char* name;
    double least, greatest; ///< of c
    /// d: of a further term, of h or of dt.
    std::function<double(double h, double c, double d)> factor;
    bool has_next_in_dt = false;
    bool has_size = true; ///< no factor that grows without bound as h → 0
};

const std::vector<Kind> kinds{
    {"h^p", 0, 0, [](double, double, double) { return 1.0; }},
    {"h^p (1 + c h)", -1.5, 2, [](double h, double c, double) { return 1 + c * h; }},
    {"h^p (1 + c h^0.5)", 0.1, 1.5,
     [](double h, double c, double) { return 1 + c * std::sqrt(h); }},
    {"h^p (1 + c ln 1/h)", 0.1, 1.5, [](double h, double c, double) { return 1 - c * std::log(h); },
     false, false},
    {"... and dt^q (1 + d dt)", 0.1, 1.5,
     [](double h, double c, double) { return 1 - c * std::log(h); }, true, false},
    {"h^p (1 + c h) and dt^q (1 + d dt)", -1.5, 2,
     [](double h, double c, double) { return 1 + c * h; }, true},
    {"h^p (1 + c h^0.5 + d h)", 0.1, 1.5,
     [](double h, double c, double d) { return 1 + c * std::sqrt(h) + d * h; }},
    {"h^p (1 + c ln 1/h + d h)", 0.1, 1.5,
     [](double h, double c, double d) { return 1 - c * std::log(h) + d * h; }, false, false}};

class Drawn {
public:
    explicit Drawn(unsigned seed) : generator_(seed) {}

    double number(double low, double high) {
        return std::uniform_real_distribution(low, high)(generator_);
    }
    /// One of two a whole number, up to `greatest`.
    double order(double greatest) {
        return number(0, 1) < 0.5 ? std::floor(number(1, greatest + 1)) : number(0.8, greatest);
    }
    ErrorRow row(std::vector<double> widths, double error, double scatter, bool is_stated) {
        ErrorRow row{std::move(widths), std::abs(error)};
        if (scatter > 0) {
            row.error *= 1 + scatter * std::normal_distribution<double>()(generator_);
            if (is_stated)
                row.sigma = scatter;
        }
        return row;
    }

private:
    std::mt19937 generator_;
};

struct Score {
    int missed = 0;
    int determined = 0;

    void add(const OrderInterval& order, double truth) {
        if (!order.determined)
            return;
        ++determined;
        missed += truth < order.low || truth > order.high ? 1 : 0;
    }
    Score& operator+=(const Score& other) {
        missed += other.missed;
        determined += other.determined;
        return *this;
    }
};

using Scores = std::array<Score, 4>; // orders in h and dt, sizes of their terms

/// steps: of dt; 0 for a sequence.
Scores scores_of(const Kind& kind, int meshes, int steps, double scatter, bool is_stated,
                 int tables, Drawn& drawn) {
    Scores scores;
    for (int table = 0; table < tables; ++table) {
        const double p = drawn.order(3);
        const double q = drawn.order(2);
        const double c = drawn.number(kind.least, kind.greatest);
        const double d = drawn.number(-0.7, 1.5);
        const double rho = drawn.number(0, 1) < 0.25 ? -1 : drawn.number(-0.9, 1);
        const double coarsest = drawn.number(0.1, 0.4);
        const double ratio = steps == 0 ? drawn.number(1.5, 2.5) : 2;
        const auto in_space = [&](double h) { return std::pow(h, p) * kind.factor(h, c, d); };
        // Of the errors, from ten times one to hardly seen.
        const double size = std::pow(10, drawn.number(-4, 1)) *
                            in_space(coarsest * std::pow(ratio, -0.5 * (meshes - 1)));
        std::vector<ErrorRow> rows;
        for (int i = 0; i < meshes; ++i) {
            const double h = coarsest * std::pow(ratio, -i);
            const double in_h = in_space(h);
            if (steps == 0)
                rows.push_back(drawn.row({h}, in_h, scatter, is_stated));
            for (int j = 0; j < steps; ++j) {
                const double dt = 0.2 * std::exp2(-j);
                const double in_dt =
                    size * std::pow(dt / 0.2, q) * (kind.has_next_in_dt ? 1 + d * dt : 1);
                rows.push_back(drawn.row(
                    {h, dt}, std::sqrt(in_h * in_h + 2 * rho * in_h * in_dt + in_dt * in_dt),
                    scatter, is_stated));
            }
        }
        const OrderEnsemble ensemble(rows);
        const auto orders = ensemble.orders();
        scores[0].add(orders[0], p);
        if (orders[0].determined && kind.has_size)
            scores[2].add(ensemble.size(0, orders[0]), 1);
        if (steps > 0)
            scores[1].add(orders[1], q);
        if (steps > 0 && orders[1].determined)
            scores[3].add(ensemble.size(1, orders[1]), size / std::pow(0.2, q));
    }
    return scores;
}

} // namespace

int main(int arguments, char** words) {
    if (arguments != 3) {
        std::fputs("usage: made_up_scores SEED TABLES\n", stderr);
        return 2;
    }
    Drawn drawn(static_cast<unsigned>(std::atoi(words[1])));
    const int tables = std::atoi(words[2]);
    std::vector<Scores> sums(kinds.size());
    const auto print_all = [&](const std::vector<Scores>& all, bool has_dt) {
        for (const auto& scores : all)
            for (const std::size_t width : {0, 1}) {
                if (width == 1 && !has_dt)
                    continue;
                const Score& size = scores[width + 2];
                std::printf("%s%3d %3d", width == 0 ? " | " : " , ", scores[width].missed,
                            scores[width].determined);
                std::printf(" (%d %d)", size.missed, size.determined);
            }
        std::puts("");
        std::fflush(stdout);
    };
    const auto print = [&](int meshes, int steps, double scatter, bool is_stated) {
        std::printf("%d x %d, %.1f %%%s", meshes, steps, 100 * scatter,
                    is_stated ? "" : " not stated");
        std::vector<Scores> row;
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            const bool is_asked = steps > 0 || !kinds[k].has_next_in_dt;
            row.push_back(
                is_asked ? scores_of(kinds[k], meshes, steps, scatter, is_stated, tables, drawn)
                         : Scores());
            for (const std::size_t width : {0, 1, 2, 3})
                sums[k][width] += row.back()[width];
        }
        print_all(row, steps > 0);
    };
    const auto print_sums = [&](bool has_dt) {
        std::printf("all");
        print_all(sums, has_dt);
        sums.assign(kinds.size(), {});
    };
    std::printf("missed and determined, in h and, on grids, in dt, of %d: levels of h and dt, "
                "scatter",
                tables);
    for (const auto& kind : kinds)
        std::printf(" | %s", kind.name);
    std::puts("");
    for (const auto& [scatter, is_stated] :
         {std::pair{0.0, true}, {1e-3, true}, {1e-3, false}, {1e-2, false}}) {
        for (const auto& [meshes, steps] : {std::pair{3, 3}, {3, 4}, {4, 3}, {4, 4}, {5, 5}})
            print(meshes, steps, scatter, is_stated);
        print_sums(true);
    }
    for (const double scatter : {0.0, 3e-3, 1e-2}) {
        for (const int levels : {3, 4, 5, 6, 8})
            print(levels, 0, scatter, true);
        print_sums(false);
    }
}

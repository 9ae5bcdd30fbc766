// Scores the engine on errors by laws that are known: how many orders of h it calls determined, and
// how many of those intervals miss. Usage: made_up_scores SEED TABLES. Of h^p T + b dt^q, added
// with a correlation, T one of the kinds below; without dt on sequences.

#include "studies/orders/order_engine.hpp"

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
    std::function<double(double h, double c)> factor;
    bool has_next_in_dt = false;
};

const std::vector<Kind> kinds{
    {"h^p", 0, 0, [](double, double) { return 1.0; }},
    {"h^p (1 + c h)", -1.5, 2, [](double h, double c) { return 1 + c * h; }},
    {"h^p (1 + c h^0.5)", 0.1, 1.5, [](double h, double c) { return 1 + c * std::sqrt(h); }},
    {"h^p (1 + c ln 1/h)", 0.1, 1.5, [](double h, double c) { return 1 - c * std::log(h); }},
    {"... and dt^q (1 + d dt)", 0.1, 1.5, [](double h, double c) { return 1 - c * std::log(h); },
     true}};

class Drawn {
public:
    explicit Drawn(unsigned seed) : generator_(seed) {}

    double number(double low, double high) {
        return std::uniform_real_distribution(low, high)(generator_);
    }
    ErrorRow row(std::vector<double> widths, double error, double scatter) {
        ErrorRow row{std::move(widths), std::abs(error)};
        if (scatter > 0) {
            row.error *= 1 + scatter * std::normal_distribution<double>()(generator_);
            row.sigma = scatter;
        }
        return row;
    }

private:
    std::mt19937 generator_;
};

struct Score {
    int determined = 0;
    int missed = 0;

    void add(const OrderInterval& order, double truth) {
        if (!order.determined)
            return;
        ++determined;
        missed += std::abs(order.value - truth) > order.half_width() ? 1 : 0;
    }
};

/// steps: of dt; 0 for a sequence.
Score score_of(const Kind& kind, int meshes, int steps, double scatter, int tables, Drawn& drawn) {
    Score score;
    for (int table = 0; table < tables; ++table) {
        const double p = std::floor(drawn.number(1, 4));
        const double q = std::floor(drawn.number(1, 3));
        const double c = drawn.number(kind.least, kind.greatest);
        const double d = kind.has_next_in_dt ? drawn.number(-1.5, 2) : 0;
        const double b = std::pow(10, drawn.number(-3, 0));
        const double rho = drawn.number(-0.9, 1);
        const double coarsest = drawn.number(0.1, 0.4);
        const double ratio = steps == 0 ? drawn.number(1.5, 2.5) : 2;
        std::vector<ErrorRow> rows;
        for (int i = 0; i < meshes; ++i) {
            const double h = coarsest * std::pow(ratio, -i);
            const double in_h = std::pow(h, p) * kind.factor(h, c);
            if (steps == 0)
                rows.push_back(drawn.row({h}, in_h, scatter));
            for (int j = 0; j < steps; ++j) {
                const double dt = 0.2 * std::exp2(-j);
                const double in_dt = b * std::pow(dt, q) * (1 + d * dt);
                rows.push_back(drawn.row(
                    {h, dt}, std::sqrt(in_h * in_h + 2 * rho * in_h * in_dt + in_dt * in_dt),
                    scatter));
            }
        }
        score.add(estimate_orders(rows).front(), p);
    }
    return score;
}

} // namespace

int main(int arguments, char** words) {
    if (arguments != 3) {
        std::fputs("usage: made_up_scores SEED TABLES\n", stderr);
        return 2;
    }
    Drawn drawn(static_cast<unsigned>(std::atoi(words[1])));
    const int tables = std::atoi(words[2]);
    const auto print = [&](int meshes, int steps, double scatter) {
        std::printf("%d x %d, %.1f %%", meshes, steps, 100 * scatter);
        for (const auto& kind : kinds) {
            const bool is_asked = steps > 0 || !kind.has_next_in_dt;
            const Score score =
                is_asked ? score_of(kind, meshes, steps, scatter, tables, drawn) : Score();
            std::printf(" | %3d %3d", score.missed, score.determined);
        }
        std::puts("");
        std::fflush(stdout);
    };
    std::printf("missed and determined, of %d: levels of h and dt, scatter", tables);
    for (const auto& kind : kinds)
        std::printf(" | %s", kind.name);
    std::puts("");
    for (const double scatter : {0.0, 1e-3})
        for (const auto& [meshes, steps] : {std::pair{3, 3}, {3, 4}, {4, 3}, {4, 4}, {5, 5}})
            print(meshes, steps, scatter);
    for (const double scatter : {0.0, 3e-3, 1e-2})
        for (const int levels : {3, 4, 5, 6, 8})
            print(levels, 0, scatter);
}

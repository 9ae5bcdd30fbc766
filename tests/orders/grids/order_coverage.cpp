// Scores the engine on grids whose asymptotic orders are known: how many orders it calls
// determined, how many of those intervals hold the order, and how wide they are. Usage:
// order_coverage [--list] GRIDS.txt…, as make_grids.py writes them. Exit 1 where fewer than 95 %
// hold.

#include "studies/orders/observed_order.hpp"
#include "studies/orders/order_engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>

using namespace tvbeam;

namespace {

constexpr int rows_of_a_grid = 25;

struct Answer {
    double value = 0;
    double half = 0;
    bool determined = false;
};

struct Score {
    int asked = 0;
    int determined = 0;
    int known = 0; ///< determined, and the long sequence has an order
    int held = 0;
    std::vector<double> widths;

    double share_held() const { return known == 0 ? 1.0 : static_cast<double>(held) / known; }
    void add(const Answer& answer, const std::string& truth) {
        ++asked;
        if (!answer.determined)
            return;
        ++determined;
        widths.push_back(2 * answer.half);
        if (truth == "-")
            return;
        ++known;
        held += std::abs(answer.value - std::stod(truth)) <= answer.half ? 1 : 0;
    }
};

double median_of(std::vector<double> values) {
    if (values.empty())
        return 0;
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

struct Case {
    std::string solution, family, scheme, mass, norm, order[2];
    std::vector<Refinement> rows;
};

std::istream& operator>>(std::istream& in, Case& one) {
    std::string word;
    in >> word >> one.solution >> one.family >> one.scheme >> one.mass >> one.norm >>
        one.order[0] >> one.order[1];
    one.rows.clear();
    for (int i = 0; in && i < rows_of_a_grid; ++i) {
        std::string h, dt, error; // operator>> for double does not read nan
        in >> h >> dt >> error;
        one.rows.push_back({.h = std::stod(h), .dt = std::stod(dt), .error = std::stod(error)});
    }
    return in;
}

std::array<Answer, 2> by_engine(const Case& one, bool list) {
    std::vector<ErrorRow> rows;
    for (const auto& row : one.rows)
        rows.push_back({{row.h, row.dt}, row.error});
    const auto orders = estimate_orders(rows);
    std::array<Answer, 2> answers;
    for (std::size_t v = 0; v < 2; ++v) {
        answers[v] = {orders[v].value, orders[v].half_width(), orders[v].determined};
        if (list)
            std::printf("%c %s %s %s %s: truth %s, %.3f in %.3f … %.3f %s\n", "pq"[v],
                        one.solution.c_str(), one.scheme.c_str(), one.mass.c_str(),
                        one.norm.c_str(), one.order[v].c_str(), orders[v].value, orders[v].low,
                        orders[v].high, orders[v].status.c_str());
    }
    return answers;
}

void print(const std::map<std::string, Score>& scores) {
    std::printf("%-18s %6s | %10s %6s %6s\n", "", "asked", "determined", "held", "width");
    for (const auto& [key, score] : scores)
        std::printf("%-18s %6d | %8.1f %% %4.1f %% %6.3f\n", key.c_str(), score.asked,
                    100.0 * score.determined / score.asked, 100 * score.share_held(),
                    median_of(score.widths));
}

} // namespace

int main(int arguments, char** argument) {
    const bool list = arguments > 1 && std::string(argument[1]) == "--list";
    std::map<std::string, Score> scores;
    for (int k = list ? 2 : 1; k < arguments; ++k) {
        std::ifstream file(argument[k]);
        for (Case one; file >> one;) {
            const auto answers = by_engine(one, list);
            for (std::size_t v = 0; v < 2; ++v) {
                const std::string order(1, "pq"[v]);
                for (const auto& key :
                     {std::string("all"), order, order + " " + one.scheme, order + " " + one.mass,
                      order + " " + one.norm, order + " " + one.family})
                    scores[key].add(answers[v], one.order[v]);
            }
        }
    }
    print(scores);
    constexpr double promised = 0.95;
    return scores.contains("all") && scores.at("all").share_held() >= promised ? 0 : 1;
}

// Scores the limits of sequences whose limits are known, as make_limits.py writes them, beside
// those of the methods that have names: held, median full width over the error of the finest value,
// part answered. Usage: limit_scores SEQUENCES.txt…; exit 1 where the engine holds fewer than 95 %,
// or 90 % of a group.

#include "studies/orders/limit_engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using namespace tvbeam;

namespace {

/// Below this the finest value is its limit, but for rounding.
constexpr double least_error = 1e-12;
constexpr std::array methods{"engine", "GCI", "Celik et al.", "Eça and Hoekstra"};

struct Score {
    int asked = 0;
    int held = 0;
    std::vector<double> widths;

    void add(bool answers, double distance, double half, double error) {
        ++asked;
        if (!answers)
            return;
        held += std::abs(distance) <= half ? 1 : 0;
        widths.push_back(2 * half / error);
    }
    double share() const {
        return widths.empty() ? 1.0
                              : static_cast<double>(held) / static_cast<double>(widths.size());
    }
    double median() {
        if (widths.empty())
            return 0;
        const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
        std::nth_element(widths.begin(), middle, widths.end());
        return *middle;
    }
};

using Scores = std::map<std::string, std::array<Score, methods.size()>>;

void score(const std::vector<ValueRow>& rows, double truth, std::istream& groups, Scores& scores) {
    const double finest = rows.back().value;
    const double error = std::abs(finest - truth);
    if (error < least_error)
        return;
    const auto estimate = estimate_limit(rows);
    const auto& limit = estimate.limit;
    for (std::string group; groups >> group;) {
        auto& of = scores[group];
        of[0].add(limit.determined, limit.value - truth, limit.half_width(), error);
        const std::array named{&estimate.gci, &estimate.celik, &estimate.eca_hoekstra};
        for (std::size_t m = 0; m < named.size(); ++m)
            of[m + 1].add(named[m]->has_value(), finest - truth,
                          named[m]->has_value() ? (*named[m])->uncertainty : 0, error);
    }
}

} // namespace

int main(int arguments, char** argument) {
    Scores scores;
    for (int k = 1; k < arguments; ++k) {
        std::ifstream file(argument[k]);
        for (std::string line; std::getline(file, line);) {
            std::istringstream head(line);
            std::string word;
            std::size_t levels = 0;
            double truth = 0;
            head >> word >> levels >> truth;
            std::vector<ValueRow> rows(levels);
            for (auto& row : rows)
                file >> row.h >> row.value;
            std::getline(file, line);
            if (!rows.empty())
                score(rows, truth, head, scores);
        }
    }
    bool promised = !scores.empty();
    for (auto& [group, of] : scores) {
        std::printf("| %s (%d) |", group.c_str(), of[0].asked);
        for (auto& one : of)
            std::printf(" %.1f %%, %.2f (%.0f %%) |", 100 * one.share(), one.median(),
                        100.0 * static_cast<double>(one.widths.size()) / one.asked);
        std::printf("\n");
        promised = promised && of[0].share() >= (group == "all" ? 0.95 : 0.9);
    }
    return promised ? 0 : 1;
}

#include "core/time/time_scheme.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tvbeam {

namespace {

/// The schemes by row. SDIRK2: Alexander (1977), SIAM J. Numer. Anal. 14, L-stable with
/// γ = 1 − 1/√2; from Δt y_t(Y_1) = (Y_1 − y)/γ follows y* = y + (1 − γ)/γ (Y_1 − y). BDF2 starts
/// with one step of it, because an Euler step costs the order.
const std::vector<TimeScheme>& rows() {
    static const double gamma = 1.0 - std::sqrt(0.5);
    static const std::vector<TimeScheme> all{
        {"euler", 1, {{1.0, 1.0, {}}}, 0, ""},
        {"bdf2", 2, {{1.5, 1.0, {1.0 / 3.0}}}, 1, "sdirk2"},
        {"sdirk2",
         2,
         {{1.0 / gamma, gamma, {}}, {1.0 / gamma, 1.0, {(1.0 - gamma) / gamma}}},
         0,
         ""},
    };
    return all;
}

} // namespace

const TimeScheme& TimeScheme::at_step(std::int64_t n) const {
    return n <= history ? named(starter) : *this;
}

int TimeScheme::increments() const {
    const auto earlier_stages = [](const TimeScheme& scheme) {
        return static_cast<int>(scheme.stages.size()) - 1;
    };
    const int running = history + earlier_stages(*this);
    return history == 0 ? running : std::max(running, history - 1 + earlier_stages(named(starter)));
}

int TimeScheme::first_stage_increment(const TimeScheme& scheme) const {
    // While the starter runs, the history is at least one increment short.
    return &scheme == this ? history : history - 1;
}

const TimeScheme& TimeScheme::named(const std::string& name) {
    const auto found = std::find_if(rows().begin(), rows().end(),
                                    [&](const TimeScheme& scheme) { return scheme.name == name; });
    if (found == rows().end())
        throw std::out_of_range("no time scheme is called " + name);
    return *found;
}

std::vector<std::string> TimeScheme::names() {
    std::vector<std::string> all;
    for (const auto& scheme : rows())
        all.push_back(scheme.name);
    return all;
}

} // namespace tvbeam

#include "studies/stress/stress_tally.hpp"

#include "core/worse.hpp"
#include "studies/text/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

constexpr Outcome all_outcomes[] = {Outcome::certified, Outcome::refused, Outcome::stopped,
                                    Outcome::failed};

/// The regime of a number by its size: a name that also sorts.
std::string by_size(double value, double small, double large) {
    if (value == 0.0)
        return "= 0";
    if (value < small)
        return "< " + shortest(small);
    return value <= large ? shortest(small) + " to " + shortest(large) : "> " + shortest(large);
}

std::string stops_regime(const Stops& stops) {
    if (!stops.exist())
        return "none";
    const bool both = std::isfinite(stops.lower) && std::isfinite(stops.upper);
    const double gap = std::min(-stops.lower, stops.upper);
    return std::string(both ? "both" : "one") + (gap < 1e-6 ? ", < 1e-6" : ", >= 1e-6");
}

/// Of cases that nothing is allowed for: the others' figures are of another size.
template <double StressChecks::*check>
std::optional<double> plain(const StressCase& one) {
    return one.checks && one.checks->allowance == 0.0 ? std::optional((*one.checks).*check)
                                                      : std::nullopt;
}

std::optional<double> part_of_allowed(const StressCase& one) {
    return one.checks && one.checks->allowance > 0.0
               ? std::optional(one.checks->closeness(one.parameters.stops.exist()))
               : std::nullopt;
}

template <double StressChecks::*check>
std::optional<double> of_contact(const StressCase& one) {
    return one.checks && one.parameters.stops.exist() ? std::optional((*one.checks).*check)
                                                      : std::nullopt;
}

template <std::optional<double> StressChecks::*check>
std::optional<double> where_made(const StressCase& one) {
    return one.checks ? (*one.checks).*check : std::nullopt;
}

std::optional<double> path_part(const StressCase& one) {
    return one.checks ? one.checks->path_part() : std::nullopt;
}

} // namespace

std::string name_of(InitialData initial) {
    switch (initial) {
    case InitialData::zero:
        return "zero";
    case InitialData::smooth:
        return "smooth";
    case InitialData::rough:
        return "rough";
    default:
        return "random";
    }
}

std::vector<std::string> regimes_of(const StressParameters& p) {
    return {"alpha " + by_size(p.alpha, 1e-2, 10.0),
            "zeta " + by_size(p.zeta, 1e-3, 1e3),
            "dt " + by_size(p.dt, 1e-4, 1.0),
            "s " + (p.elements <= 3      ? "1 to 3"
                    : p.elements <= 1000 ? "4 to 1000"
                                         : std::string("> 1000")),
            "stops " + stops_regime(p.stops),
            p.theta_A == 0.0 ? "theta_A = 0" : "theta_A not 0",
            "load " + by_size(p.load, 1e-9, 1e9),
            "start " + name_of(p.initial),
            "mass " + name_of(p.thermal_mass),
            "time " + p.time,
            "algorithm " + name_of(p.algorithm)};
}

const std::vector<NamedCheck>& stress_checks() {
    static const std::vector<NamedCheck> checks{
        {"energy", "energy law", plain<&StressChecks::energy>},
        {"heat_residual", "heat residual", plain<&StressChecks::heat_residual>},
        {"beam_residual", "beam residual", plain<&StressChecks::beam_residual>},
        {"penetration", "penetration", of_contact<&StressChecks::penetration>},
        {"wrong_sign", "wrong sign", of_contact<&StressChecks::wrong_sign>},
        {"complementarity", "min-residual", of_contact<&StressChecks::complementarity>},
        {"initial_state", "initial state", plain<&StressChecks::initial>},
        {"fixed_point", "fixed point, of its limits", part_of_allowed},
        {"path", "path, of its limit", path_part},
        {"error", "error/predicted", where_made<&StressChecks::error>},
        {"order_defect", "", where_made<&StressChecks::order_defect>}};
    return checks;
}

void StressTally::add(const StressCase& one) {
    ++outcomes_[one.outcome];
    for (std::size_t k = 0; k < checks_.size(); ++k)
        if (const auto value = stress_checks()[k].of(one)) {
            Range& range = checks_[k];
            const bool first = range.count++ == 0;
            range.least = first ? *value : -worse(-range.least, -*value);
            range.greatest = first ? *value : worse(range.greatest, *value);
        }
}

std::size_t StressTally::count(Outcome outcome) const {
    const auto found = outcomes_.find(outcome);
    return found == outcomes_.end() ? 0 : found->second;
}

std::optional<double> StressTally::greatest(const std::string& check) const {
    std::optional<double> found;
    for (std::size_t k = 0; k < checks_.size(); ++k)
        if (stress_checks()[k].name == check && checks_[k].count > 0)
            found = checks_[k].greatest;
    return found;
}

std::map<std::string, double> StressTally::figures() const {
    std::map<std::string, double> figures;
    for (const Outcome outcome : all_outcomes)
        figures[name_of(outcome)] = static_cast<double>(count(outcome));
    for (std::size_t k = 0; k < checks_.size(); ++k) {
        const auto& [count, least, greatest] = checks_[k];
        const std::string& name = stress_checks()[k].name;
        figures[name + ".count"] = static_cast<double>(count);
        if (count == 0)
            continue;
        figures[name + ".least"] = least;
        figures[name + ".greatest"] = greatest;
    }
    return figures;
}

void StressTallies::add(const StressCase& one) {
    const auto regimes = regimes_of(one.parameters);
    for (std::size_t k = 0; k < regimes.size(); ++k)
        regimes_[{k, regimes[k]}].add(one);
    all_.add(one);
}

std::map<std::string, double> StressTallies::figures() const {
    auto figures = all_.figures();
    for (const auto& [key, tally] : regimes_)
        for (const Outcome outcome : all_outcomes)
            figures[key.second + "." + name_of(outcome)] =
                static_cast<double>(tally.count(outcome));
    return figures;
}

} // namespace tvbeam

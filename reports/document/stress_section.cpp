#include "reports/document/stress_section.hpp"

#include "reports/document/text_table.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace tvbeam {

namespace {

/// The regime of a number by its size: a name that also sorts.
std::string by_size(double value, double small, double large) {
    if (value == 0.0)
        return "= 0";
    if (value < small)
        return "< " + shortest(small);
    return value <= large ? shortest(small) + " to " + shortest(large) : "> " + shortest(large);
}

double gap_of(const Stops& stops) {
    return std::min(-stops.lower, stops.upper);
}

std::string stops_regime(const Stops& stops) {
    if (!stops.exist())
        return "none";
    const bool both = std::isfinite(stops.lower) && std::isfinite(stops.upper);
    return std::string(both ? "both" : "one") + (gap_of(stops) < 1e-6 ? ", < 1e-6" : ", >= 1e-6");
}

/// The regimes that a case belongs to, one a line of the table.
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

struct Tally {
    std::map<Outcome, int> outcomes;
    // The worst of each check; none: never made.
    std::optional<double> energy;
    std::optional<double> residual;
    std::optional<double> contact;
    std::optional<double> path; // over its limit
};

/// A NaN is worse than any number.
bool is_worse(double value, double worst) {
    return value > worst || std::isnan(value);
}

void raise(std::optional<double>& worst, double value) {
    if (!worst || is_worse(value, *worst))
        worst = value;
}

/// The cases by regime, in the order of the table's lines.
class Tallies {
public:
    void add(const StressCase& one) {
        const auto regimes = regimes_of(one.parameters);
        for (std::size_t k = 0; k < regimes.size(); ++k)
            add(one, tallies_[{k, regimes[k]}]);
        add(one, tallies_[{regimes.size(), "all"}]);
    }
    [[nodiscard]] const auto& all() const { return tallies_; }

private:
    static void add(const StressCase& one, Tally& tally) {
        ++tally.outcomes[one.outcome];
        if (!one.checks)
            return;
        raise(tally.energy, one.checks->energy);
        raise(tally.residual, std::max(one.checks->heat_residual, one.checks->beam_residual));
        if (one.parameters.stops.exist())
            raise(tally.contact, std::max({one.checks->penetration, one.checks->wrong_sign,
                                           one.checks->complementarity}));
        if (const auto part = one.checks->path_part())
            raise(tally.path, *part);
    }

    std::map<std::pair<std::size_t, std::string>, Tally> tallies_;
};

Table regime_table(const Tallies& tallies) {
    Table::Group key{"", {{"regime", {}}}};
    Table::Group outcomes{"cases",
                          {{"certified", {}}, {"refused", {}}, {"stopped", {}}, {"failed", {}}}};
    Table::Group worst{"worst", {{"energy", {}}, {"resid.", {}}, {"contact", {}}, {"path", {}}}};
    for (const auto& [regime, tally] : tallies.all()) {
        key.columns[0].cells.push_back(regime.second);
        const auto count = [&outcomes = tally.outcomes](Outcome outcome) {
            const auto found = outcomes.find(outcome);
            return std::to_string(found == outcomes.end() ? 0 : found->second);
        };
        outcomes.columns[0].cells.push_back(count(Outcome::certified));
        outcomes.columns[1].cells.push_back(count(Outcome::refused));
        outcomes.columns[2].cells.push_back(count(Outcome::stopped));
        outcomes.columns[3].cells.push_back(count(Outcome::failed));
        worst.columns[0].cells.push_back(scientific(tally.energy, 0));
        worst.columns[1].cells.push_back(fixed(tally.residual, 1));
        worst.columns[2].cells.push_back(scientific(tally.contact, 0));
        worst.columns[3].cells.push_back(fixed(tally.path, 2));
    }
    return {
        "Outcomes of the cases by regime, and the worst of each check.", key, {outcomes, worst}};
}

/// The case in words: only what tells it apart.
std::string text_of(const StressParameters& p) {
    std::string text = fmt::format("alpha {}, zeta {}, dt {}, s {}, {} steps, load {}, {} start",
                                   shortest(p.alpha), shortest(p.zeta), shortest(p.dt), p.elements,
                                   p.steps, shortest(p.load), name_of(p.initial));
    if (p.stops.exist())
        text += fmt::format(", stops [{}, {}]", p.stops.lower, p.stops.upper);
    if (p.theta_A != 0.0)
        text += ", theta_A " + shortest(p.theta_A);
    text += ", " + p.time + ", " + name_of(p.thermal_mass) + " mass";
    if (p.algorithm == Algorithm::fixed_point)
        text += ", fixed-point";
    return text;
}

std::string cases_text(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " case" : " cases");
}

/// The worst case of each check, by name.
class WorstCases {
public:
    void add(const StressCase& one) {
        for (auto& check : checks_)
            if (const auto figure = check.figure(one)) {
                ++check.count;
                if (!check.worst || is_worse(*figure, check.greatest)) {
                    check.worst = one.parameters;
                    check.greatest = *figure;
                }
            }
    }
    [[nodiscard]] std::vector<Block> blocks() const {
        std::vector<Block> items{BlankLine{}, Paragraph{"Worst cases:"}};
        for (const auto& check : checks_)
            if (check.worst)
                items.emplace_back(
                    Item{fmt::format("{}: {} ({}): {}", check.name, scientific(check.greatest, 1),
                                     cases_text(check.count), text_of(*check.worst)),
                         6});
        return items;
    }

private:
    using Figure = std::function<std::optional<double>(const StressCase&)>;
    struct Check {
        std::string name;
        Figure figure;
        std::size_t count = 0; ///< of the cases that have it
        std::optional<StressParameters> worst = {};
        double greatest = 0.0;
    };
    static Figure of(double StressChecks::*check) {
        return [check](const StressCase& one) {
            return one.checks ? std::optional((*one.checks).*check) : std::nullopt;
        };
    }
    static Figure of_contact(double StressChecks::*check) {
        return [check](const StressCase& one) {
            return one.checks && one.parameters.stops.exist() ? std::optional((*one.checks).*check)
                                                              : std::nullopt;
        };
    }

    std::vector<Check> checks_{
        {"energy law", of(&StressChecks::energy)},
        {"heat residual", of(&StressChecks::heat_residual)},
        {"beam residual", of(&StressChecks::beam_residual)},
        {"penetration", of_contact(&StressChecks::penetration)},
        {"wrong sign", of_contact(&StressChecks::wrong_sign)},
        {"min-residual", of_contact(&StressChecks::complementarity)},
        {"path, of its limit",
         [](const StressCase& one) { return one.checks ? one.checks->path_part() : std::nullopt; }},
        {"error/predicted",
         [](const StressCase& one) { return one.checks ? one.checks->error : std::nullopt; }}};
};

/// The text of a reason without its numbers, to count those alike.
std::string kind_of(const std::string& reason) {
    std::string kind;
    for (const char c : reason) {
        const bool digit = (c >= '0' && c <= '9') || c == '.';
        if (!digit)
            kind += c;
        else if (!kind.ends_with('#'))
            kind += '#';
    }
    return kind;
}

/// The reasons of cases that are not certified, those alike together.
class Reasons {
public:
    void add(const StressCase& one) {
        if (one.outcome == Outcome::certified)
            return;
        auto& [count, example] = kinds_[one.outcome][kind_of(one.reason)];
        if (count++ == 0)
            example = text_of(one.parameters) + ": " + one.reason;
    }
    [[nodiscard]] std::vector<Block> blocks(Outcome outcome) const {
        const auto kinds = kinds_.find(outcome);
        if (kinds == kinds_.end())
            return {};
        std::vector<Block> items{BlankLine{}, Paragraph{tvbeam::name_of(outcome) + ":"}};
        for (const auto& [kind, found] : kinds->second)
            items.emplace_back(Item{cases_text(found.first) + ", e.g. " + found.second});
        return items;
    }

private:
    /// How many, and the first of them.
    std::map<Outcome, std::map<std::string, std::pair<std::size_t, std::string>>> kinds_;
};

Section case_section(const StressCases& cases) {
    Tallies tallies;
    WorstCases worst;
    Reasons reasons;
    cases.visit([&](const StressCase& one) {
        tallies.add(one);
        worst.add(one);
        reasons.add(one);
    });
    Section section{
        "Stress",
        {regime_table(tallies),
         Paragraph{"energy: energy law, of its terms (limit 1e-12); resid.: of both equations, "
                   "in units of round-off (64); contact: penetration, wrong sign or "
                   "min-residual, of the tip's scale (1e-13); path: sine basis against nodal "
                   "values, of their limit (1); blank: no case has it"},
         Finding{fmt::format("Of {} {} certified, {} refused, {} stopped, {} failed.",
                             cases_text(cases.size()), cases.count(Outcome::certified),
                             cases.count(Outcome::refused), cases.count(Outcome::stopped),
                             cases.count(Outcome::failed)),
                 2, false}}};
    const auto add = [&section](const std::vector<Block>& more) {
        section.blocks.insert(section.blocks.end(), more.begin(), more.end());
    };
    add(worst.blocks());
    for (const Outcome outcome : {Outcome::refused, Outcome::stopped, Outcome::failed})
        add(reasons.blocks(outcome));
    return section;
}

/// A ratio measured/predicted as per mille of deviation would be hidden by its round figures; the
/// map shows the prediction in tenths and marks what is not within a tenth of it.
Section contraction_section(const ContractionMap& map, const ContractionBlock& block) {
    const std::string legend = fmt::format(
        "Contraction of the fixed point, {}, {} mass, zeta = {}, s = {}: across, alpha from {} to "
        "{}; down, dt from {} to {}. A digit: tenths of the measured contraction; ^: 1 or more, "
        "refused; .: too small to be measured; !: the measured one is not within 10 % of the "
        "predicted",
        block.time, name_of(block.thermal_mass), shortest(block.zeta), block.elements,
        shortest(block.alpha.front()), scientific(block.alpha.back(), 1),
        shortest(block.dt.front()), scientific(block.dt.back(), 1));
    std::string text;
    for (Eigen::Index i = 0; i < map.predicted.rows(); ++i) {
        text += fmt::format("{:>9} ", scientific(block.dt[static_cast<std::size_t>(i)], 1));
        for (Eigen::Index j = 0; j < map.predicted.cols(); ++j) {
            const double ratio = map.measured(i, j) / map.predicted(i, j);
            text += ' ';
            if (map.predicted(i, j) < ContractionMap::least_measurable)
                text += '.';
            else if (!(std::abs(ratio - 1.0) <= 0.1))
                text += '!';
            else if (map.predicted(i, j) >= 1.0)
                text += '^';
            else
                text += static_cast<char>('0' + static_cast<int>(map.measured(i, j) * 10.0));
        }
        text += '\n';
    }
    return {"Contraction of the fixed point",
            {Paragraph{legend}, Preformatted{text},
             Finding{fmt::format("measured/predicted: {:.6f} to {:.6f}; {} of {} refused",
                                 map.least_ratio(), map.greatest_ratio(), map.refused(),
                                 map.predicted.size())}}};
}

Section round_off_section(const RoundOffTable& table) {
    Table::Group key{"", {{"s", {}}}};
    Table::Group moment{"moment form", {{"nodal", {}}, {"sine", {}}}};
    Table::Group hermite{"Hermite form", {{"floor", {}}, {"predicted", {}}, {"ratio", {}}}};
    Table::Group error{"", {{"discretisation", {}}}};
    for (const auto& row : table.rows) {
        key.columns[0].cells.push_back(std::to_string(row.elements));
        moment.columns[0].cells.push_back(scientific(row.moment.value, 1));
        moment.columns[1].cells.push_back(scientific(row.sine, 1));
        hermite.columns[0].cells.push_back(scientific(row.hermite.value, 1));
        hermite.columns[1].cells.push_back(scientific(row.hermite_predicted, 1));
        hermite.columns[2].cells.push_back(
            row.hermite.value ? fixed(*row.hermite.value / row.hermite_predicted, 2) : "");
        error.columns[0].cells.push_back(scientific(row.discretisation_error, 1));
    }
    Section section{"Floor of round-off",
                    {Paragraph{"Floor of round-off, relative, on the coupled mode sin(pi x):"},
                     Table{"Floor of round-off, relative, on the coupled mode sin(pi x).",
                           key,
                           {moment, hermite, error}}}};
    for (const auto& row : table.rows)
        for (const auto& [form, floor] :
             {std::pair{"moment", &row.moment}, std::pair{"Hermite", &row.hermite}})
            if (!floor->reason.empty())
                section.blocks.emplace_back(Finding{fmt::format(
                    "s = {}: the {} form stopped: {}", row.elements, form, floor->reason)});
    for (const auto& row : table.rows)
        if (!row.remark.empty()) {
            section.blocks.emplace_back(
                Finding{fmt::format("from s = {} on: {}", row.elements, row.remark)});
            break;
        }
    return section;
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

std::vector<Section> stress_sections(const StressResult& result) {
    std::vector<Section> sections;
    if (!result.cases.empty())
        sections.push_back(case_section(result.cases));
    if (result.contraction)
        sections.push_back(contraction_section(*result.contraction, result.contraction->block));
    if (result.roundoff)
        sections.push_back(round_off_section(*result.roundoff));
    return sections;
}

} // namespace tvbeam

#include "reports/document/stress_section.hpp"

#include "core/worse.hpp"
#include "reports/document/text_table.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace tvbeam {

namespace {

/// The greatest of checks that a column of the table shows together.
std::optional<double> worst_of(const StressTally& tally, const std::vector<std::string>& checks) {
    std::optional<double> worst;
    for (const auto& check : checks)
        if (const auto value = tally.greatest(check))
            worst = worst ? worse(*worst, *value) : *value;
    return worst;
}

Table regime_table(const StressTallies& tallies) {
    Table::Group key{"", {{"regime", {}}}};
    Table::Group outcomes{"cases",
                          {{"certified", {}}, {"refused", {}}, {"stopped", {}}, {"failed", {}}}};
    Table::Group worst{"worst", {{"energy", {}}, {"resid.", {}}, {"contact", {}}, {"path", {}}}};
    const auto add = [&](const std::string& regime, const StressTally& tally) {
        key.columns[0].cells.push_back(regime);
        const auto count = [&tally](Outcome outcome) {
            return std::to_string(tally.count(outcome));
        };
        outcomes.columns[0].cells.push_back(count(Outcome::certified));
        outcomes.columns[1].cells.push_back(count(Outcome::refused));
        outcomes.columns[2].cells.push_back(count(Outcome::stopped));
        outcomes.columns[3].cells.push_back(count(Outcome::failed));
        worst.columns[0].cells.push_back(scientific(worst_of(tally, {"energy"}), 0));
        worst.columns[1].cells.push_back(
            fixed(worst_of(tally, {"heat_residual", "beam_residual"}), 1));
        worst.columns[2].cells.push_back(
            scientific(worst_of(tally, {"penetration", "wrong_sign", "complementarity"}), 0));
        worst.columns[3].cells.push_back(fixed(worst_of(tally, {"path"}), 2));
    };
    for (const auto& [regime, tally] : tallies.regimes())
        add(regime.second, tally);
    add("all", tallies.all());
    return {
        "Outcomes of the cases by regime, and the worst of each check.", key, {outcomes, worst}};
}

/// A NaN is worse than any number.
bool is_worse(double value, double worst) {
    return value > worst || std::isnan(value);
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
        for (std::size_t k = 0; k < worst_.size(); ++k)
            if (const auto value = stress_checks()[k].of(one)) {
                Worst& worst = worst_[k];
                if (worst.count++ == 0 || is_worse(*value, worst.greatest))
                    worst = {worst.count, one.parameters, *value};
            }
    }
    [[nodiscard]] std::vector<Block> blocks() const {
        std::vector<Block> items{BlankLine{}, Paragraph{"Worst cases:"}};
        for (std::size_t k = 0; k < worst_.size(); ++k)
            if (const auto& [count, parameters, greatest] = worst_[k];
                count > 0 && !stress_checks()[k].words.empty())
                items.emplace_back(Item{fmt::format("{}: {} ({}): {}", stress_checks()[k].words,
                                                    scientific(greatest, 1), cases_text(count),
                                                    text_of(parameters)),
                                        6});
        return items;
    }

private:
    struct Worst {
        std::size_t count = 0; ///< of the cases that have it
        StressParameters parameters;
        double greatest = 0.0;
    };
    std::vector<Worst> worst_ = std::vector<Worst>(stress_checks().size());
};

/// The reasons of cases that are not certified, those alike together.
class Reasons {
public:
    void add(const StressCase& one) {
        if (one.outcome == Outcome::certified)
            return;
        auto& [count, example] = kinds_[one.outcome][without_numbers(one.reason)];
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
    WorstCases worst;
    Reasons reasons;
    cases.visit([&](const StressCase& one) {
        worst.add(one);
        reasons.add(one);
    });
    Section section{
        "Stress",
        {regime_table(cases.tallies()),
         Paragraph{"energy: energy law, of its terms (limit 1e-12); resid.: of both equations, "
                   "in units of round-off (64); contact: penetration, wrong sign or "
                   "min-residual, of the tip's scale (1e-13); path: sine basis against nodal "
                   "values, of their limit (1); blank: no case has it" +
                   std::string(cases.tallies().all().greatest("fixed_point")
                                   ? "; of fixed points, whose limits allow for the round-off of "
                                     "the Hermite form, see the worst cases"
                                   : "")},
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
        "{}refused; .: too small to be measured; !: the measured one is not within 10 % of the "
        "predicted",
        block.time, name_of(block.thermal_mass), shortest(block.zeta), block.elements,
        shortest(block.alpha.front()), shortest(block.alpha.back()), shortest(block.dt.front()),
        shortest(block.dt.back()),
        (map.greatest > map.predicted).any() ? "or that of the first step, " : "");
    std::string text;
    for (Eigen::Index i = 0; i < map.predicted.rows(); ++i) {
        text += fmt::format("{:>9} ", scientific(block.dt[static_cast<std::size_t>(i)], 1));
        for (Eigen::Index j = 0; j < map.predicted.cols(); ++j) {
            const double ratio = map.measured(i, j) / map.predicted(i, j);
            text += ' ';
            if (map.predicted(i, j) < ContractionMap::least_measurable)
                text += '.';
            else if (map.greatest(i, j) >= 1.0)
                text += '^';
            else if (!(std::abs(ratio - 1.0) <= 0.1))
                text += '!';
            else // 0.9999999 may be 1.0000001 as measured
                text += static_cast<char>('0' +
                                          std::min(9, static_cast<int>(map.measured(i, j) * 10.0)));
        }
        text += '\n';
    }
    return {"Contraction of the fixed point",
            {Paragraph{legend}, Preformatted{text},
             Finding{fmt::format(
                 "measured/predicted: {}; {} of {} refused",
                 std::isnan(map.least_ratio())
                     ? "all too small to be measured"
                     : fmt::format("{:.6f} to {:.6f}", map.least_ratio(), map.greatest_ratio()),
                 map.refused(), map.predicted.size())}}};
}

/// "from s = 1000 on: …", of the numbers of elements that are in the table, whatever their order;
/// where one that is greater has no remark, those that have.
std::string where_remarked(const RoundOffTable& table) {
    std::map<std::int64_t, std::string> remarks;
    for (const auto& row : table.rows)
        remarks[row.elements] = row.remark;
    std::string last;
    std::vector<std::string> where;
    bool up_to_the_finest = false;
    for (const auto& [elements, remark] : remarks) {
        up_to_the_finest = !remark.empty() && (where.empty() || up_to_the_finest);
        if (remark.empty())
            continue;
        where.push_back(std::to_string(elements));
        last = remark;
    }
    if (where.empty())
        return {};
    return up_to_the_finest ? fmt::format("from s = {} on: {}", where.front(), last)
                            : fmt::format("s = {}: {}", fmt::join(where, ", "), last);
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
    if (const std::string where = where_remarked(table); !where.empty())
        section.blocks.emplace_back(Finding{where});
    return section;
}

} // namespace

std::vector<Section> stress_sections(const StressResult& result) {
    std::vector<Section> sections;
    if (!result.cases.empty())
        sections.push_back(case_section(result.cases));
    if (result.contraction)
        sections.push_back(contraction_section(*result.contraction, result.contraction->block));
    if (result.roundoff)
        sections.push_back(round_off_section(*result.roundoff));
    if (!result.reached.empty()) {
        Section section{"What is not there", {}};
        for (const auto& [study, there, all] : result.reached)
            section.blocks.emplace_back(Finding{
                study == "stress"
                    ? fmt::format("{} of {} cases were reached; what is said is of these", there,
                                  all)
                    : fmt::format("{}: {} of {} rows were reached; it is shown when all are there",
                                  study, there, all)});
        sections.push_back(std::move(section));
    }
    return sections;
}

} // namespace tvbeam

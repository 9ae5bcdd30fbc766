#include "studies/gates/derived_expectation.hpp"

#include "core/time/time_scheme.hpp"
#include "mms/admissible/consistency.hpp"
#include "mms/coverage.hpp"
#include "mms/derived_formulas.hpp"
#include "mms/forecast/error_constants.hpp"
#include "mms/forecast/expected_orders.hpp"
#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/scene/scene.hpp"
#include "studies/text/number_text.hpp"

#include <boost/algorithm/string/join.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

const Solution& solution_of(const TableReader& table, const Scene& scene) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (scene.solver || !scene.poses_problem() || solution == nullptr || solution->phases.empty())
        throw table.error("", " expects something of what is derived from a solution, and the "
                              "scene runs none");
    return *solution;
}

/// What is left of an equation in space or in time.
struct LeftOver {
    std::string name; ///< "heat in space"
    double size = 0.0;
    std::optional<double> order; ///< the last one
    bool is_known = true;        ///< Residual::heat_is_known

    [[nodiscard]] bool is_none() const { return is_known && size == 0.0; }

    /// "one of order 2.01"
    [[nodiscard]] std::string words() const {
        return !is_known     ? "none where it was looked at, which the formulas do not say of all"
               : size == 0.0 ? "no residual"
               : order       ? "one of order " + metric_text(*order)
                             : "one of " + metric_text(size);
    }
};

std::vector<LeftOver> left_over(const Residual& residual, const std::string& where) {
    return {{"heat in " + where, residual.heat, residual.heat_order, residual.heat_is_known},
            {"beam in " + where, residual.beam, residual.beam_order, residual.beam_is_known}};
}

/// What is derived of the solution of a scene, each part when it is first asked for.
class DerivedParts {
public:
    DerivedParts(const Solution& solution, const Scene& scene)
        : solution_(solution), scene_(scene) {}

    const std::vector<TermUse>& terms() {
        if (!terms_)
            terms_ = coverage(admissible());
        return *terms_;
    }

    const ExpectedOrders& orders() {
        if (!orders_)
            orders_ = expected_orders(admissible());
        return *orders_;
    }

    /// With the scene's mass matrix, on uniform meshes.
    const ErrorConstants& sizes(const std::string& time) {
        auto known = sizes_.find(time);
        if (known == sizes_.end())
            known = sizes_
                        .emplace(time, scene_.mesh.is_uniform()
                                           ? error_constants(orders(), admissible(),
                                                             {{time, scene_.scheme.thermal_mass}})
                                                 .front()
                                           : ErrorConstants{"the meshes are not uniform", {}})
                        .first;
        return known->second;
    }

    double distance_of_formulas() {
        for (const auto& [symbol, interval, interval_latex, formula, latex] :
             derived_formulas(solution_, scene_.beam.stops.epsilon > 0.0))
            formulas_ += fmt::format("{} for {} = {}\n{} for {}\n", symbol, interval, formula,
                                     latex, interval_latex);
        return tvbeam::distance_of_formulas(solution_, scene_.beam, scene_.longest_time());
    }

    /// At the last two of the refinements that are shown.
    Residual last_in_space() {
        return space_residuals(admissible(), ThermalMass::consistent,
                               {shown_elements.end() - 2, shown_elements.end()})
            .back();
    }
    Residual last_in_time(const std::string& time) {
        if (!in_time_)
            in_time_.emplace(admissible(), std::vector(shown_steps.end() - 2, shown_steps.end()));
        return in_time_->of(time).back();
    }

    /// All of what was asked for, line by line.
    [[nodiscard]] std::string examined() {
        std::string text = formulas_;
        for (const auto& term : terms_.value_or(std::vector<TermUse>()))
            text += term.term + ": " +
                    (term.is_exercised() ? metric_text(term.largest) : term.why_not) + "\n";
        if (orders_)
            for (const auto& row : orders_->orders)
                text += fmt::format("{}: {}; {}; {}; {}\n", row.norm, words_of(row.in_h),
                                    words_of(row.euler), words_of(row.bdf2), words_of(row.sdirk2));
        const auto size = [](const std::optional<LeadingTerm>& term) {
            return term ? metric_text(term->constant) : std::string("-");
        };
        for (const auto& [time, sizes] : sizes_)
            for (const auto& row : sizes.norms)
                text += fmt::format("{} with {}: {}, {}\n", row.norm, time, size(row.in_h),
                                    size(row.in_dt));
        for (const auto& time : in_time_ ? TimeScheme::names() : std::vector<std::string>())
            for (const LeftOver& left : left_over(last_in_time(time), "time"))
                text += fmt::format("{} with {}: {}\n", left.name, time,
                                    left.order ? metric_text(*left.order) : "none");
        return text;
    }

private:
    const AdmissibleSolution& admissible() {
        if (!admissible_)
            admissible_.emplace(solution_, scene_.beam, scene_.longest_time());
        return *admissible_;
    }

    const Solution& solution_;
    const Scene& scene_;
    std::optional<AdmissibleSolution> admissible_;
    std::string formulas_;
    std::optional<std::vector<TermUse>> terms_;
    std::optional<ExpectedOrders> orders_;
    std::optional<TimeResiduals> in_time_;
    std::map<std::string, ErrorConstants> sizes_; ///< by time scheme
};

/// Those in space, and in time with that scheme.
std::vector<LeftOver> all_left_over(DerivedParts& parts, const std::string& time) {
    auto all = left_over(parts.last_in_space(), "space");
    const auto in_time = left_over(parts.last_in_time(time), "time");
    all.insert(all.end(), in_time.begin(), in_time.end());
    return all;
}

/// One table of [expect.derive], what it says and where that goes.
struct DerivedTable {
    TableReader& table;
    DerivedParts& parts;
    std::vector<Expectation>& expectations;

    /// A table within it.
    template <typename Read>
    void within(const std::string& key, const Read& read) const {
        if (auto inner = table.table(key)) {
            const std::size_t before = expectations.size();
            read(DerivedTable{*inner, parts, expectations});
            finish_expecting(*inner, before, expectations);
        }
    }

    void add(CheckedExpectation checked) const {
        expectations.push_back([checked = std::move(checked)](const StudyResult& /*result*/) {
            return std::vector{checked};
        });
    }
};

void expect_terms(const DerivedTable& of, const std::string& key, bool exercised,
                  const std::vector<TermUse>& terms) {
    const auto wanted = of.table.texts(key);
    if (!wanted)
        return;
    if (wanted->empty())
        throw of.table.error(key, " is empty, and expects nothing; name a term");
    std::vector<std::string> names;
    names.reserve(terms.size());
    for (const auto& term : terms)
        names.push_back(term.term);
    for (std::size_t i = 0; i < wanted->size(); ++i) {
        const std::string& name = (*wanted)[i];
        const auto use = std::ranges::find(terms, name, &TermUse::term);
        if (use == terms.end())
            throw of.table.error(key,
                                 " holds '" + name + "', which is no term" +
                                     did_you_mean(name, names) + "; they are " +
                                     boost::algorithm::join(names, ", "),
                                 i);
        of.add({.what = what_of(of.table, key) + ": " + name,
                .expected = exercised ? "exercised" : "untested",
                .found = use->is_exercised() ? "exercised, up to " + metric_text(use->largest)
                                             : "untested: " + use->why_not,
                .place = of.table.place(key, i),
                .holds = use->is_exercised() == exercised});
    }
}

void expect_formulas(const DerivedTable& of, const std::string& key) {
    const auto within = of.table.number(key);
    if (!within)
        return;
    if (!(*within > 0.0 && *within <= widest_part))
        throw of.table.error(key, " is " + message_text(*within) +
                                      "; it must be > 0 and at most 0.5: a part of the greatest "
                                      "value");
    of.add(held({what_of(of.table, key), of.parts.distance_of_formulas(), ""}, 0.0, *within,
                of.table.place(key)));
}

/// largest = { TERM = [lowest, highest] }: how large the terms become.
void expect_largest(const DerivedTable& of, const std::vector<TermUse>& terms) {
    of.within("largest", [&](const DerivedTable& inner) {
        for (const auto& name : inner.table.unread()) {
            const auto use = std::ranges::find(terms, name, &TermUse::term);
            if (use == terms.end())
                throw InputError(inner.table.place_of_key(name),
                                 inner.table.full(name) + ": there is no such term");
            const auto band = inner.table.band(name);
            inner.add(held({what_of(inner.table, name), use->largest, ""}, band->lowest,
                           band->highest, inner.table.place(name)));
        }
    });
}

CheckedExpectation no_residual(const std::string& what, const LeftOver& left, const Place& place) {
    return {.what = what,
            .expected = "no residual",
            .found = left.words(),
            .place = place,
            .holds = left.is_none()};
}

/// exact: those that have none with any scheme; the band is of the others.
template <typename Last>
void expect_residual(const DerivedTable& of, const std::string& key, const std::string& where,
                     const std::vector<std::string>& exact, const Last& last) {
    const auto band = of.table.band(key);
    if (!band)
        return;
    for (const LeftOver& left : left_over(last(), where)) {
        const std::string what = what_of(of.table, key);
        if (std::ranges::find(exact, left.name) == exact.end())
            of.add(held({fmt::format("{}: last order of {}", what, left.name), left.order,
                         left.is_none() ? "none: the residual is zero" : "none: " + left.words()},
                        band->lowest, band->highest, of.table.place(key)));
        else
            of.add(no_residual(fmt::format("{}: {}", what, left.name), left, of.table.place(key)));
    }
}

/// residual = { "heat in space" = [lowest, highest] }: those of the last refinement that is shown,
/// in time with the scene's own scheme.
void expect_residual_sizes(const DerivedTable& of, const std::string& time) {
    of.within("residual", [&](const DerivedTable& inner) {
        for (const LeftOver& left : all_left_over(of.parts, time))
            if (const auto band = inner.table.band(left.name))
                inner.add(
                    held({what_of(inner.table, left.name),
                          left.is_known ? std::optional(left.size) : std::nullopt, left.words()},
                         band->lowest, band->highest, inner.table.place(left.name)));
    });
}

/// Reads the residuals that are zero; those in time with the scene's own scheme.
std::vector<std::string> expect_exact(const DerivedTable& of, const std::string& key,
                                      const std::string& time) {
    const auto wanted = of.table.texts(key);
    if (!wanted)
        return {};
    const auto all = all_left_over(of.parts, time);
    for (std::size_t i = 0; i < wanted->size(); ++i) {
        const auto found = std::ranges::find(all, (*wanted)[i], &LeftOver::name);
        if (found == all.end())
            throw of.table.error(key,
                                 " holds '" + (*wanted)[i] +
                                     "'; it must be heat or beam, in space or in time: \"beam in "
                                     "time\"",
                                 i);
        of.add(no_residual(what_of(of.table, key) + ": " + found->name, *found,
                           of.table.place(key, i)));
    }
    return *wanted;
}

void expect_order(const DerivedTable& of, const std::string& key, const Forecast& order) {
    if (const auto wanted = of.table.word(key)) {
        const auto forecast = forecast_of(*wanted);
        if (!forecast)
            throw of.table.error(key, " is '" + *wanted +
                                          "'; it must be an order, as 2 or \"1 to 2\", \"-\" "
                                          "without an error, or \"not known\"");
        const std::string expected = words_of(*forecast);
        const std::string found = words_of(order);
        of.add({what_of(of.table, key), expected, found, of.table.place(key), found == expected});
    }
}

void expect_size(const DerivedTable& of, const std::string& key, const std::string& norm,
                 const std::string& time, std::optional<LeadingTerm> NormConstants::*term) {
    const auto band = of.table.band(key);
    if (!band)
        return;
    const ErrorConstants& sizes = of.parts.sizes(time);
    const NormConstants* row = sizes.of(norm);
    const auto& size = row == nullptr ? std::optional<LeadingTerm>() : row->*term;
    const std::string unknown = row == nullptr ? sizes.unknown : row->unknown;
    of.add(held({what_of(of.table, key), size ? std::optional(size->constant) : std::nullopt,
                 unknown.empty() ? "no error of that kind" : "not known: " + unknown},
                band->lowest, band->highest, of.table.place(key)));
}

void expect_norm(const DerivedTable& of, const ExpectedOrder& order) {
    expect_order(of, "h", order.in_h);
    expect_order(of, "euler", order.euler);
    expect_order(of, "bdf2", order.bdf2);
    expect_order(of, "sdirk2", order.sdirk2);
    expect_size(of, "a", order.norm, "euler", &NormConstants::in_h);
    of.within("b", [&](const DerivedTable& inner) {
        for (const auto& time : TimeScheme::names())
            expect_size(inner, time, order.norm, time, &NormConstants::in_dt);
    });
}

void expect_norms(const DerivedTable& of) {
    const auto unread = of.table.unread();
    const auto is_table = [&](const std::string& key) { return of.table.is_table(key); };
    if (std::ranges::none_of(unread, is_table))
        return;
    std::vector<std::string> norms;
    for (const auto& order : of.parts.orders().orders) {
        norms.push_back(order.norm);
        of.within(order.norm, [&](const DerivedTable& inner) { expect_norm(inner, order); });
    }
    for (const auto& name : of.table.unread())
        if (is_table(name))
            throw InputError(of.table.place_of_key(name),
                             of.table.full(name) +
                                 " expects something of a norm of which nothing "
                                 "is derived" +
                                 did_you_mean(name, norms) + "; the norms are " +
                                 boost::algorithm::join(norms, ", "));
}

} // namespace

void expect_derived(TableReader& table, const Scene& scene,
                    std::vector<Expectation>& expectations) {
    DerivedParts parts(solution_of(table, scene), scene);
    const DerivedTable whole{table, parts, expectations};
    const std::size_t before = expectations.size();
    const std::vector<TermUse> terms =
        table.has("exercises") || table.has("untested") || table.has("largest")
            ? parts.terms()
            : std::vector<TermUse>();
    expect_terms(whole, "exercises", true, terms);
    expect_terms(whole, "untested", false, terms);
    expect_largest(whole, terms);
    expect_sentences(
        table, "reasons", expectations,
        [reasons = table.has("reasons") ? parts.orders().reasons : std::vector<std::string>()](
            const StudyResult& /*result*/) { return reasons; });
    expect_formulas(whole, "formulas_within");
    const auto exact = expect_exact(whole, "exact", scene.scheme.time.name);
    expect_residual(whole, "space_residual", "space", exact, [&] { return parts.last_in_space(); });
    whole.within("time_residual", [&](const DerivedTable& inner) {
        for (const auto& time : TimeScheme::names())
            expect_residual(inner, time, "time", exact, [&] { return parts.last_in_time(time); });
    });
    expect_residual_sizes(whole, scene.scheme.time.name);
    expect_norms(whole);
    if (expectations.size() > before)
        expectations[before] = [first = expectations[before],
                                examined = parts.examined()](const StudyResult& result) {
            auto checked = first(result);
            checked.front().examined = examined;
            return checked;
        };
}

} // namespace tvbeam

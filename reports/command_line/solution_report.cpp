#include "reports/command_line/solution_report.hpp"

#include "core/norms/norms.hpp"
#include "core/time/time_scheme.hpp"
#include "mms/admissible/consistency.hpp"
#include "mms/coverage.hpp"
#include "mms/derivation.hpp"
#include "mms/forecast/error_constants.hpp"
#include "mms/forecast/expected_orders.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/number_text.hpp"
#include "reports/document/text_table.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

std::string beam_text(const SolutionSetting& setting) {
    const Beam& beam = setting.beam;
    std::string text =
        fmt::format("alpha = {}, zeta = {}", shortest(beam.alpha), shortest(beam.zeta));
    if (beam.theta_A != 0.0)
        text += ", theta_A = " + shortest(beam.theta_A);
    text += beam.stops.exist() ? fmt::format(", stops [{}, {}]", shortest(beam.stops.lower),
                                             shortest(beam.stops.upper))
                               : ", no stops";
    if (beam.stops.epsilon > 0.0)
        text += ", penalised with epsilon = " + shortest(beam.stops.epsilon);
    return fmt::format("On {} ({}), up to t = {}:", setting.origin, text,
                       shortest(setting.final_time));
}

std::string coverage_text(const std::vector<TermUse>& terms) {
    Table::Column equation{"", {}};
    Table::Column term{"exercised", {}};
    Table::Column size{"seen up to", {}};
    std::string untested;
    for (const TermUse& use : terms) {
        if (use.is_exercised()) {
            equation.cells.push_back(use.equation);
            term.cells.push_back(use.term);
            size.cells.push_back(scientific(use.largest, 1));
        } else {
            untested += wrapped(fmt::format("- {} {}: {}", use.equation, use.term, use.why_not));
        }
    }
    return text_table({"", {"", {equation, term, size}}, {}}) +
           (untested.empty() ? "\nUntested: nothing.\n" : "\nUntested:\n" + untested);
}

/// Columns of the residuals of both equations and their orders; "?" of one that may be missed.
class ResidualColumns {
public:
    void add(const Residual& row) {
        add_size(heat_, row.heat, row.heat_is_known);
        heat_order_.cells.push_back(fixed(row.heat_order, 2));
        add_size(beam_, row.beam, row.beam_is_known);
        beam_order_.cells.push_back(fixed(row.beam_order, 2));
    }
    [[nodiscard]] std::vector<Table::Column> columns() const {
        return {heat_, heat_order_, beam_, beam_order_};
    }
    [[nodiscard]] bool misses_some() const { return misses_some_; }
    [[nodiscard]] bool overflows() const { return overflows_; }

private:
    void add_size(Table::Column& column, double size, bool is_known) {
        misses_some_ = misses_some_ || !is_known;
        overflows_ = overflows_ || std::isinf(size);
        column.cells.push_back(is_known ? scientific(size, 1) : "?");
    }

    Table::Column heat_{"heat", {}}, heat_order_{"ord.", {}};
    Table::Column beam_{"beam", {}}, beam_order_{"ord.", {}};
    bool misses_some_ = false;
    bool overflows_ = false;
};

/// What the signs among them mean.
std::string signs_text(bool misses_some, bool overflows) {
    return (misses_some ? wrapped("?: none where it was looked at, but its formula is not seen to "
                                  "vanish: something narrow in x or t may be missed.")
                        : "") +
           (overflows ? wrapped("inf: beyond the range of doubles.") : "");
}

std::string space_table(const AdmissibleSolution& solution) {
    Table::Column s{"s", {}};
    ResidualColumns residuals;
    for (const Residual& row : space_residuals(solution, ThermalMass::consistent,
                                               {shown_elements.begin(), shown_elements.end()})) {
        s.cells.push_back(std::to_string(row.count));
        residuals.add(row);
    }
    return text_table({"", {"", {s}}, {{"", residuals.columns()}}}) +
           signs_text(residuals.misses_some(), residuals.overflows());
}

/// What the ends of phases do to the residuals in time; empty without any before the final time.
std::string phase_ends_text(const AdmissibleSolution& solution) {
    std::string ends;
    for (const PhaseExpressions& phase : solution.derived().phases)
        if (phase.end_value < solution.final_time())
            ends += (ends.empty() ? "t = " : ", ") + number_text(phase.end_value);
    return ends.empty() ? ""
                        : "\n" + wrapped("Phases end at " + ends +
                                         ": residuals of steps that hold such a time, or look back "
                                         "across it, may be larger and of lower order.");
}

std::string time_table(const AdmissibleSolution& solution) {
    const std::vector<std::int64_t> steps(shown_steps.begin(), shown_steps.end());
    Table::Column dt{"dt", {}};
    for (const std::int64_t count : steps)
        dt.cells.push_back(shortest(solution.final_time() / static_cast<double>(count)));
    const TimeResiduals residuals(solution, steps);
    std::vector<Table::Group> groups;
    bool misses_some = false;
    bool overflows = false;
    for (const auto& name : TimeScheme::names()) {
        ResidualColumns columns;
        for (const Residual& row : residuals.of(name))
            columns.add(row);
        misses_some = misses_some || columns.misses_some();
        overflows = overflows || columns.overflows();
        groups.push_back({name, columns.columns()});
    }
    return text_table({"", {"", {dt}}, groups}) + signs_text(misses_some, overflows) +
           phase_ends_text(solution);
}

std::string orders_table(const ExpectedOrders& expected) {
    Table::Column norm{"norm", {}};
    Table::Column in_h{"in h", {}};
    Table::Column euler{"in dt: euler", {}};
    Table::Column bdf2{"bdf2", {}};
    Table::Column sdirk2{"sdirk2", {}};
    for (const ExpectedOrder& row : expected.orders) {
        norm.cells.push_back(row.norm);
        in_h.cells.push_back(words_of(row.in_h));
        euler.cells.push_back(words_of(row.euler));
        bdf2.cells.push_back(words_of(row.bdf2));
        sdirk2.cells.push_back(words_of(row.sdirk2));
    }
    std::string text = text_table({"", {"", {norm}}, {{"", {in_h, euler, bdf2, sdirk2}}}});
    if (!expected.reasons.empty())
        text += "\n";
    for (const auto& reason : expected.reasons)
        text += wrapped(reason);
    return text;
}

/// A column of the table of sizes: of a method, in one of the widths.
struct SizeColumn {
    std::string heading; ///< the first of a width has its letter before a colon
    std::size_t method;  ///< its index among those that are asked
    std::optional<LeadingTerm> NormConstants::*size;

    [[nodiscard]] std::string method_name() const {
        const std::size_t label = heading.find(": ");
        return heading.substr(label == std::string::npos ? 0 : label + 2);
    }
};

/// The two mass matrices in h, by Euler's scheme, and every scheme in Δt.
std::vector<SizeColumn> size_columns(std::vector<ForecastMethod>& methods) {
    methods = {{"euler", ThermalMass::lumped}};
    std::vector<SizeColumn> columns{{"a: consistent", 1, &NormConstants::in_h},
                                    {"lumped", 0, &NormConstants::in_h}};
    for (const auto& time : TimeScheme::names()) {
        columns.push_back(
            {(methods.size() == 1 ? "b: " : "") + time, methods.size(), &NormConstants::in_dt});
        methods.push_back({time, ThermalMass::consistent});
    }
    return columns;
}

/// Which columns are not there, and why; one sentence where that is so of all, by one reason.
std::string unknown_columns(const std::vector<SizeColumn>& columns,
                            const std::vector<ErrorConstants>& sizes) {
    const std::string& first = sizes.front().unknown;
    if (!first.empty() &&
        std::ranges::all_of(sizes, [&](const auto& one) { return one.unknown == first; }))
        return wrapped("not known: " + first);
    std::string text;
    for (const SizeColumn& column : columns)
        if (const std::string& why = sizes[column.method].unknown; !why.empty())
            text += wrapped(column.method_name() + ": not known: " + why);
    return text;
}

/// Why a column that is there has no size in some norm.
std::string unknown_norms(const std::vector<SizeColumn>& columns,
                          const std::vector<ErrorConstants>& sizes) {
    std::map<std::string, std::vector<std::string>> norms_by_reason;
    for (const SizeColumn& column : columns)
        for (const NormConstants& row : sizes[column.method].norms)
            if (auto& norms = norms_by_reason[row.unknown];
                std::ranges::find(norms, row.norm) == norms.end())
                norms.push_back(row.norm);
    norms_by_reason.erase("");
    std::string text;
    for (const auto& [reason, norms] : norms_by_reason)
        text += wrapped(fmt::format("?: not known of {}: {}", fmt::join(norms, ", "), reason));
    return text;
}

/// The norm that orders and sizes are of.
std::string root_of(const std::string& norm) {
    const auto known = Norm::named(norm);
    return norm + (known && known->squared ? "^(1/2)" : "");
}

/// Where an order shows on meshes alone that are finer than any that is likely.
std::string hidden_orders(const ErrorConstants& sizes) {
    constexpr double coarse = 0.1;
    std::string text;
    std::vector<std::string> of_coupling;
    double least = coarse;
    for (const NormConstants& row : sizes.norms) {
        if (!row.in_h || !(row.shows_below > 0.0 && row.shows_below < coarse))
            continue;
        if (row.hidden_by_coupling) {
            of_coupling.push_back(root_of(row.norm));
            least = std::min(least, row.shows_below);
        } else {
            text += wrapped(fmt::format(
                "{}: the order {:g} in h comes through alpha and shows for h far below {:.2g} "
                "alone; with longer elements the beam's own error, of a higher order, is larger.",
                row.norm, row.in_h->order, row.shows_below));
        }
    }
    if (!of_coupling.empty())
        text += wrapped(fmt::format(
            "{}: the order 2 in h shows for h far below {:.2g} alone; with longer elements what "
            "alpha makes of theta within them, of order 2.5 to 3, is larger.",
            fmt::join(of_coupling, ", "), least));
    return text;
}

/// a of each heat mass matrix, b of each time scheme.
std::string sizes_table(const AdmissibleSolution& solution, const ExpectedOrders& expected) {
    std::vector<ForecastMethod> methods;
    const std::vector<SizeColumn> shown = size_columns(methods);
    const auto sizes = error_constants(expected, solution, methods);
    const ErrorConstants& usual = sizes[1]; // Euler's scheme with the consistent mass matrix
    if (!usual.unknown.empty())
        return unknown_columns(shown, sizes);
    Table::Column norm{"norm", {}};
    for (const NormConstants& row : usual.norms) {
        norm.cells.push_back(root_of(row.norm));
    }
    std::vector<Table::Column> columns;
    for (const SizeColumn& column : shown) {
        if (!sizes[column.method].unknown.empty())
            continue;
        columns.push_back({column.heading, {}});
        for (const NormConstants& row : sizes[column.method].norms) {
            const auto& size = row.*column.size;
            columns.back().cells.push_back(size                  ? scientific(size->constant, 3)
                                           : row.unknown.empty() ? "-"
                                                                 : "?");
        }
    }
    return text_table({"", {"", {norm}}, {{"", columns}}}) + unknown_norms(shown, sizes) +
           hidden_orders(usual) + unknown_columns(shown, sizes);
}

} // namespace

std::string solution_report(const SolutionSetting& setting) {
    std::string text = "\n" + wrapped(beam_text(setting));
    try {
        const AdmissibleSolution solution(setting.solution, setting.beam, setting.final_time);
        text += "\n" + coverage_text(coverage(solution));
        text += "\n" +
                wrapped("The exact solution in the discrete equations: the residual in space, and "
                        "in time with space exact.") +
                "\n" + space_table(solution) + "\n" + time_table(solution);
        const ExpectedOrders expected = expected_orders(solution);
        text += "\n" +
                wrapped("Orders to expect on uniform meshes, where the solution is smooth in x and "
                        "t but at the ends of its phases (-: no error of that kind):") +
                "\n" + orders_table(expected);
        text += "\nSizes a of h^p and b of dt^q to expect on uniform meshes, by modified "
                "equations:\n\n" +
                sizes_table(solution, expected);
    } catch (const InputError& error) {
        text += wrapped(std::string("not admissible: ") + error.what());
    }
    return text;
}

} // namespace tvbeam

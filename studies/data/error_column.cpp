#include "studies/data/error_column.hpp"

#include "studies/data/printed_digits.hpp"
#include "studies/data/refined_widths.hpp"

#include <boost/algorithm/string/join.hpp>
#include <fmt/format.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace tvbeam {

namespace {

/// The rows of a grid by what the fit says of them.
std::vector<RowVerdict> verdicts_of(const TwoTermFit& fit, std::size_t rows) {
    const bool both = fit.predicts();
    const bool one = fit.holds() && fit.misfit.empty() && fit.ensemble->without_idle_widths();
    std::vector<RowVerdict> verdicts(rows,
                                     {both || one ? Verdict::asymptotic : Verdict::pre_asymptotic,
                                      both           ? "in the window where both orders stand"
                                      : one          ? "in the window where the order stands"
                                      : !fit.holds() ? fit.failure
                                      : !fit.misfit.empty() ? fit.misfit
                                                            : "an order is not determined"});
    for (const auto& [row, why, reason] : fit.rejected)
        verdicts[row] = {verdict_of(why), reason};
    return verdicts;
}

/// By how much an error may be another, to 95 % of its stated deviation, or, where there is none,
/// by the digits printed.
double uncertainty_of(const DataColumn& errors, const std::vector<double>& stated, std::size_t r) {
    constexpr double of_95 = 1.96;
    return !stated.empty() ? of_95 * stated[r] : errors.units.empty() ? 0.0 : errors.units[r] / 2;
}

/// The next coarser row of other widths that has an error, or, of the coarsest, the next finer.
std::optional<std::size_t> neighbour_of(const DataAnalysis& data, const std::vector<double>& errors,
                                        std::size_t row) {
    const auto is_other = [&](std::size_t r) {
        return is_positive(errors[r]) &&
               std::ranges::any_of(data.widths, [&](const DataColumn& width) {
                   return width.numbers[r] != width.numbers[row];
               });
    };
    for (std::size_t r = row; r-- > 0;)
        if (is_other(r))
            return r;
    for (std::size_t r = row + 1; r < errors.size(); ++r)
        if (is_other(r))
            return r;
    return std::nullopt;
}

/// Whether an error of zero may be one that its uncertainty hides: signed errors go through zero
/// where finer rows have errors again; at the finest it is the least that the next coarser row
/// leaves there, by the order 8, or by the orders of the rows before as far as they may rise.
bool hides_an_error(const DataAnalysis& data, const std::vector<double>& errors, std::size_t zero,
                    double unknown) {
    const auto is_as_fine = [&](std::size_t fine, std::size_t coarse) {
        return std::ranges::all_of(data.widths, [&](const DataColumn& width) {
            return width.numbers[fine] <= width.numbers[coarse];
        });
    };
    const auto next_coarser = [&](std::size_t row) -> std::optional<std::size_t> {
        for (std::size_t r = row; r-- > 0;)
            if (is_positive(errors[r]) && is_as_fine(row, r))
                return r;
        return std::nullopt;
    };
    const auto log_ratio = [&](std::size_t coarse, std::size_t fine) { // of the most refined width
        double ratio = 0;
        for (const DataColumn& width : data.widths)
            ratio = std::max(ratio, std::log(width.numbers[coarse] / width.numbers[fine]));
        return ratio;
    };
    for (std::size_t r = 0; r < errors.size(); ++r)
        if (is_positive(errors[r]) && is_as_fine(r, zero))
            return true;
    auto fine = next_coarser(zero);
    if (!fine)
        return true;
    const double at_hand = errors[*fine];
    const double ratio = log_ratio(*fine, zero);
    std::vector<double> orders; // fine to coarse
    for (auto coarse = next_coarser(*fine);
         coarse && log_ratio(*coarse, *fine) > 0 && orders.size() < 2;
         fine = coarse, coarse = next_coarser(*fine))
        orders.push_back(std::log(errors[*coarse] / errors[*fine]) / log_ratio(*coarse, *fine));
    constexpr double great = 8;
    const double last = orders.empty() ? 0.0 : orders[0];
    const double rises = orders.size() < 2 || !(orders[1] > 0) ? 2.0 : last / orders[1];
    const double order = std::max(great, last * std::max(2.0, rises));
    return at_hand * std::exp(-order * ratio) <= unknown;
}

/// What a verdict says of an order of two rows may be what is not known of their errors: of a floor
/// in 0.002 and 0.001 nobody can tell. A row that is asymptotic has the order of others, and on a
/// grid each is judged by all.
void leave_open(const DataAnalysis& data, const DataColumn& errors,
                const std::vector<double>& stated, ColumnAnalysis& column) {
    // An order on halved widths is then uncertain by 0.2.
    constexpr double of_no_order = 0.1;
    constexpr std::array events{Verdict::floor, Verdict::cancellation, Verdict::outlier,
                                Verdict::diverging};
    const auto& error = errors.numbers;
    const auto unknown = [&](std::size_t r) { return uncertainty_of(errors, stated, r); };
    for (std::size_t r = 0; r < column.verdicts.size(); ++r) {
        RowVerdict& row = column.verdicts[r];
        if (row.verdict == Verdict::exact && unknown(r) > 0 &&
            hides_an_error(data, error, r, unknown(r)))
            row = {Verdict::unresolved,
                   stated.empty() ? "zero to the digits printed" : "zero within its deviation"};
        if (std::ranges::find(events, row.verdict) == events.end())
            continue;
        double part = unknown(r) / error[r];
        const auto other =
            column.two_term ? std::optional<std::size_t>() : neighbour_of(data, error, r);
        if (other) {
            part = std::max(part, unknown(*other) / error[*other]);
            const auto [coarse, fine] = std::minmax(*other, r);
            if (row.verdict == Verdict::diverging &&
                error[fine] - unknown(fine) >= error[coarse] + unknown(coarse))
                continue; // it grows for certain
        }
        if (part > of_no_order)
            row = {Verdict::unresolved,
                   fmt::format("it, or the row beside it, is uncertain by {:.0f} %",
                               100 * std::min(part, 1.0))};
    }
}

/// Errors of one or two widths.
void analyse_records(const DataAnalysis& data, const std::vector<std::size_t>& used,
                     const std::vector<double>& sigma, bool rounded, ColumnAnalysis& column) {
    std::vector<Refinement> records(data.rows());
    for (std::size_t i = 0; i < records.size(); ++i) {
        records[i].h = data.widths[used.front()].numbers[i];
        if (used.size() > 1)
            records[i].dt = data.widths[used.back()].numbers[i];
        records[i].error = column.numbers[i];
    }
    auto found = analyse(std::move(records), sigma, rounded);
    if (found.two_term) {
        column.by_width[used.front()] = found.two_term->p;
        column.by_width[used.back()] = found.two_term->q;
        if (!found.two_term->holds())
            for (const auto i : used)
                column.by_width[i].status = found.two_term->failure;
        column.verdicts = verdicts_of(*found.two_term, data.rows());
        column.of_model = {used.front(), used.back()};
        column.two_term = std::move(found.two_term);
        return;
    }
    column.orders = std::move(found.orders);
    column.verdicts = std::move(found.verdict->rows);
    column.by_width[used.front()] = found.along.order;
    if (found.along.in_turns) {
        const DataColumn& first = data.widths[used.front()];
        const DataColumn& last = data.widths[used.back()];
        for (const auto i : used)
            column.by_width[i].status =
                (std::ranges::is_sorted(last.numbers)
                     ? last.name + " grows with a finer " + first.name
                     : first.name + " and " + last.name + " are refined in turns") +
                "; three of each in all pairs would show both orders";
    } else if (used.size() > 1)
        column.by_width[used.back()].status =
            path_words(data.widths[used.back()], data.widths[used.front()], column.numbers);
    if (found.along.has_logarithm)
        column.findings.push_back(fmt::format("{}: a factor ln {} stands beside the power",
                                              column.name, data.widths[used.front()].name));
}

/// The first and the end of each run of rows of one point of all widths.
std::vector<std::pair<std::size_t, std::size_t>> points_of(const DataAnalysis& data) {
    std::vector<std::pair<std::size_t, std::size_t>> points;
    for (std::size_t r = 0; r < data.rows(); ++r)
        if (r > 0 && std::ranges::all_of(data.widths, [&](const DataColumn& width) {
                return width.numbers[r] == width.numbers[r - 1];
            }))
            points.back().second = r + 1;
        else
            points.emplace_back(r, r + 1);
    return points;
}

/// The slope of ln error on ln width: an order as far as rounding needs one.
double rough_order(const std::vector<double>& widths, const std::vector<double>& errors) {
    std::vector<double> x, y;
    for (std::size_t r = 0; r < widths.size(); ++r)
        if (is_positive(errors[r])) {
            x.push_back(std::log(widths[r]));
            y.push_back(std::log(errors[r]));
        }
    if (!varies(x))
        return 0;
    double intercept = 0, slope = 0;
    double c00 = 0, c01 = 0, c11 = 0, squares = 0; // of a covariance that is not asked for
    gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &c00, &c01, &c11,
                   &squares);
    constexpr double greatest = 8;
    return std::clamp(std::abs(slope), 0.0, greatest);
}

/// The units of the last digits printed, as they are seen in the errors: those of a width change an
/// error of order p by p times what they are of the width. None where all is exact.
std::vector<double> units_seen(const DataAnalysis& data, const DataColumn& errors) {
    auto units = errors.units;
    for (const auto& width : data.widths) {
        if (width.units.empty())
            continue;
        units.resize(data.rows());
        const double order = rough_order(width.numbers, errors.numbers);
        for (std::size_t r = 0; r < units.size(); ++r)
            units[r] =
                std::hypot(units[r], order * errors.numbers[r] * width.units[r] / width.numbers[r]);
    }
    return units;
}

/// Of errors that were rounded, or whose widths were; none where rows of one point scatter by more
/// than that. Those that do not are rounded alike: their mean is known no better than each.
std::vector<double> rounding(const DataAnalysis& data, const DataColumn& errors) {
    double ratio = std::numeric_limits<double>::infinity();
    for (const auto& width : data.widths)
        ratio = std::min(ratio, level_ratio(width.numbers));
    const auto units = units_seen(data, errors);
    auto sigma = deviations_of_rounding(errors.numbers, units, ratio, are_a_grid(data.widths));
    if (sigma.empty())
        return {};
    for (const auto& [first, end] : points_of(data)) {
        double least = std::numeric_limits<double>::infinity();
        double greatest = 0;
        double unit = 0;
        double count = 0;
        for (std::size_t r = first; r < end; ++r)
            if (is_positive(errors.numbers[r])) {
                least = std::min(least, errors.numbers[r]);
                greatest = std::max(greatest, errors.numbers[r]);
                unit = std::max(unit, units[r]);
                ++count;
            }
        constexpr double of_one_unit = 1.01;
        if (count > 1 && greatest - least > of_one_unit * unit)
            return {};
        for (std::size_t r = first; r < end; ++r)
            sigma[r] *= std::sqrt(count);
    }
    return sigma;
}

/// What is known to the digits printed: "its errors are", "h is", "its errors and h are".
std::string known_to_digits(const DataAnalysis& data, const DataColumn& errors) {
    std::vector<std::string> words;
    if (!errors.units.empty())
        words.emplace_back("its errors");
    for (const auto& width : data.widths)
        if (!width.units.empty())
            words.push_back(width.name);
    return boost::algorithm::join(words, " and ") +
           (words.size() == 1 && errors.units.empty() ? " is" : " are");
}

} // namespace

ColumnAnalysis analyse_errors(const DataAnalysis& data, const DataColumn& errors,
                              const std::vector<double>& stated) {
    const auto sigma = stated.empty() ? rounding(data, errors) : stated;
    ColumnAnalysis column;
    column.name = errors.name;
    column.numbers = errors.numbers;
    column.missing = errors.missing;
    column.by_width.resize(data.widths.size());
    auto used = refined(data.widths);
    for (std::size_t i = 0; i < data.widths.size(); ++i)
        if (std::find(used.begin(), used.end(), i) == used.end())
            column.by_width[i].status = "it is the same in all rows";
    if (used.empty())
        used = {0};
    const auto refined_widths = used;
    put_the_refined_first(data.widths, used);
    // Of two alone the ladder of both is analysed; of four that are refined by themselves, no
    // orders are found.
    constexpr std::size_t most_widths = 3;
    for (std::size_t i = 0; i < used.size(); ++i)
        for (std::size_t j = used.size(); used.size() > 2 && --j > i;)
            if (change_together(data.widths[used[i]], data.widths[used[j]])) {
                column.by_width[used[j]].status =
                    together_with(data.widths[used[i]], data.widths[used[j]]);
                used.erase(used.begin() + static_cast<std::ptrdiff_t>(j));
            }
    if (used.size() <= 2) {
        analyse_records(data, used, sigma, stated.empty(), column);
        for (std::size_t r = 0; r < column.verdicts.size(); ++r)
            if (!column.missing.empty() && column.missing[r])
                column.verdicts[r].reason = "no error is given";
        leave_open(data, errors, stated, column);
    } else if (used.size() > most_widths) {
        for (const auto i : used)
            column.by_width[i].status = "of more than three widths at a time no orders are found";
    } else {
        std::vector<ErrorRow> rows(data.rows());
        for (std::size_t r = 0; r < rows.size(); ++r) {
            for (const auto i : used)
                rows[r].widths.push_back(data.widths[i].numbers[r]);
            rows[r].error = column.numbers[r];
            if (!sigma.empty())
                rows[r].sigma = sigma[r] / rows[r].error;
        }
        const auto orders = estimate_orders(rows);
        for (std::size_t k = 0; k < used.size(); ++k)
            column.by_width[used[k]] = orders[k];
    }
    std::string words;
    for (const auto i : refined_widths)
        words += (words.empty() ? "" : "; ") + order_words(data.widths[i].name, column.by_width[i]);
    column.findings.insert(column.findings.begin(), column.name + ": " + words);
    if (stated.empty() && !sigma.empty())
        column.findings.push_back(
            fmt::format("{}: {} known to the digits printed, as the intervals count", column.name,
                        known_to_digits(data, errors)));
    return column;
}

} // namespace tvbeam

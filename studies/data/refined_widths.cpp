#include "studies/data/refined_widths.hpp"

#include "studies/text/number_text.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// ln of the greatest width over the least.
double log_range(const DataColumn& width) {
    const auto [least, greatest] = std::ranges::minmax(width.numbers);
    return std::log(greatest / least);
}

/// Of a width that changes with a twentieth of the order of another, or with less, as steps do that
/// something else limits, nobody would say that it is refined.
constexpr double of_nothing = 0.05;

bool hardly_changes(const DataColumn& width, const DataColumn& beside) {
    return log_range(width) <= of_nothing * log_range(beside);
}

std::vector<std::size_t> rows_with_numbers(const std::vector<double>& numbers) {
    std::vector<std::size_t> rows;
    for (std::size_t r = 0; r < numbers.size(); ++r)
        if (std::isfinite(numbers[r]))
            rows.push_back(r);
    return rows;
}

bool hardly_changes(const DataColumn& width, const DataColumn& along, std::size_t coarse,
                    std::size_t fine) {
    return std::abs(std::log(width.numbers[coarse] / width.numbers[fine])) <=
           of_nothing * std::abs(std::log(along.numbers[coarse] / along.numbers[fine]));
}

} // namespace

bool varies(const std::vector<double>& numbers) {
    return std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) !=
           numbers.end();
}

std::vector<std::size_t> refined(const std::vector<DataColumn>& widths) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < widths.size(); ++i)
        if (varies(widths[i].numbers))
            result.push_back(i);
    return result;
}

bool change_together(const DataColumn& first, const DataColumn& second) {
    std::set<double> of_first, of_second;
    std::set<std::pair<double, double>> of_both;
    for (std::size_t r = 0; r < first.numbers.size(); ++r) {
        of_first.insert(first.numbers[r]);
        of_second.insert(second.numbers[r]);
        of_both.emplace(first.numbers[r], second.numbers[r]);
    }
    if (of_both.size() != std::max(of_first.size(), of_second.size()))
        return false;
    if (hardly_changes(first, second) || hardly_changes(second, first))
        return true;
    std::vector<double> one, other;
    for (const auto& [own, its] : of_both) {
        one.push_back(own);
        other.push_back(its);
    }
    std::vector<double> work(2 * one.size());
    constexpr double all_but_a_few = 0.75; // of the ranks' correlation
    return std::abs(gsl_stats_spearman(one.data(), 1, other.data(), 1, one.size(), work.data())) >=
           all_but_a_few;
}

bool are_a_grid(const std::vector<DataColumn>& widths) {
    const auto used = refined(widths);
    for (std::size_t i = 0; i < used.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!change_together(widths[used[i]], widths[used[j]]))
                return true;
    return false;
}

std::string together_with(const DataColumn& other, const DataColumn& width) {
    const auto extremes = [&](bool least) {
        const auto& of = other.numbers;
        const auto at = least ? std::ranges::min_element(of) : std::ranges::max_element(of);
        return width.numbers[static_cast<std::size_t>(at - of.begin())];
    };
    if (hardly_changes(width, other))
        return "it hardly changes with " + other.name;
    return (extremes(true) <= extremes(false) ? "it is refined with " : "it grows with a finer ") +
           other.name;
}

void put_the_refined_first(const std::vector<DataColumn>& widths, std::vector<std::size_t>& used) {
    // Steps that a stability limit couples to h fall like h² or h⁴, those that hide the time error
    // of elements of order p like h^(p+1): what falls faster than h⁶ is refined for itself.
    constexpr double beyond_coupling = 6.5;
    for (std::size_t k = 1; k < used.size(); ++k)
        if (beyond_coupling * log_range(widths[used.front()]) <= log_range(widths[used[k]]) &&
            change_together(widths[used.front()], widths[used[k]]))
            std::swap(used.front(), used[k]);
}

std::size_t leading_width(const std::vector<DataColumn>& widths) {
    auto used = refined(widths);
    put_the_refined_first(widths, used);
    return used.empty() ? 0 : used.front();
}

std::vector<double> of_rows_with_numbers(const std::vector<double>& widths,
                                         const std::vector<double>& numbers) {
    std::vector<double> result;
    for (std::size_t r = 0; r < numbers.size(); ++r)
        if (std::isfinite(numbers[r]))
            result.push_back(widths[r]);
    return result;
}

bool is_held(const DataColumn& width, const DataColumn& along, const std::vector<double>& numbers) {
    const auto rows = rows_with_numbers(numbers);
    return !rows.empty() && hardly_changes(width, along, rows.front(), rows.back());
}

std::optional<double> standing_still(const DataColumn& width, const DataColumn& along,
                                     const std::vector<double>& numbers) {
    const auto rows = rows_with_numbers(numbers);
    if (rows.empty() || is_held(width, along, numbers))
        return std::nullopt;
    const auto before = std::find_if(rows.rbegin(), rows.rend(), [&](std::size_t r) {
        return along.numbers[r] != along.numbers[rows.back()];
    });
    return before != rows.rend() && hardly_changes(width, along, *before, rows.back())
               ? std::optional(width.numbers[rows.back()])
               : std::nullopt;
}

std::string path_words(const DataColumn& width, const DataColumn& along,
                       const std::vector<double>& numbers) {
    if (!varies(of_rows_with_numbers(width.numbers, numbers)))
        return "it is the same in all rows";
    if (is_held(width, along, numbers))
        return "it is hardly refined with " + along.name;
    const auto still = standing_still(width, along, numbers);
    return still ? fmt::format("it stands still at {:.4g} where the finest rows refine {}", *still,
                               along.name)
                 : "it is refined with " + along.name;
}

bool is_one_path(const std::vector<DataColumn>& widths, std::size_t along) {
    const auto& own = widths[along].numbers;
    for (const auto& width : widths)
        for (std::size_t r = 1; r < own.size(); ++r)
            if (width.numbers[r] > width.numbers[r - 1] ||
                (own[r] == own[r - 1] && width.numbers[r] != width.numbers[r - 1]))
                return false;
    return true;
}

std::string order_words(const std::string& width, const OrderInterval& order) {
    return order.determined ? fmt::format("order in {} {} ± {}", width, fixed(order.value, 3),
                                          fixed(order.half_width(), 3))
                            : fmt::format("order in {} not determined: {}", width, order.status);
}

} // namespace tvbeam

#include "studies/orders/ladder_order.hpp"
#include "studies/orders/verdict.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(verdicts)

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<Refinement> halving(const std::vector<double>& errors) {
    std::vector<Refinement> ladder;
    double h = 1.0;
    for (const double error : errors) {
        ladder.push_back({.h = h, .error = error});
        h /= 2;
    }
    return ladder;
}

/// Errors whose pairwise orders, under halving, are these.
std::vector<Refinement> with_orders(const std::vector<double>& orders) {
    std::vector<double> errors{1.0};
    for (const double order : orders)
        errors.push_back(errors.back() * std::exp2(-order));
    return halving(errors);
}

/// One letter a row, so that a ladder's verdicts read as a word.
std::string word(const LadderVerdict& judged) {
    std::string letters;
    for (const auto& row : judged.rows) {
        BOOST_TEST(!row.reason.empty());
        switch (row.verdict) {
        case Verdict::asymptotic:
            letters += 'A';
            break;
        case Verdict::pre_asymptotic:
            letters += 'p';
            break;
        case Verdict::cancellation:
            letters += 'c';
            break;
        case Verdict::floor:
            letters += 'f';
            break;
        case Verdict::diverging:
            letters += 'd';
            break;
        case Verdict::outlier:
            letters += 'o';
            break;
        case Verdict::unresolved:
            letters += 'u';
            break;
        case Verdict::exact:
            letters += '0';
            break;
        case Verdict::failed:
            letters += 'x';
            break;
        }
    }
    return letters;
}

std::string word(const std::vector<Refinement>& ladder, const VerdictOptions& options = {}) {
    return word(judge(ladder, options));
}

} // namespace

BOOST_AUTO_TEST_CASE(order_one_on_a_ladder_of_ratio_ten_is_asymptotic) {
    std::vector<Refinement> ladder;
    for (const double h : {1.0, 0.1, 0.01, 0.001})
        ladder.push_back({.h = h, .error = 3 * h});
    const auto judged = judge(ladder);
    BOOST_TEST(word(judged) == "AAAA");
    BOOST_TEST(judged.window->order == 1.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(order_minus_one_is_diverging) {
    const auto judged = judge(with_orders({-1, -1, -1}));
    BOOST_TEST(word(judged) == "dddd");
    BOOST_TEST(!judged.window.has_value());
}

// Up and down by a factor of two: half of the rows look like order one, and none is asymptotic.
BOOST_AUTO_TEST_CASE(an_oscillating_ladder_is_nowhere_asymptotic) {
    BOOST_TEST(word(with_orders({1, -1, 1, -1, 1})) == "ppdpdp");
    BOOST_TEST(word(with_orders({-1, 1, -1, 1})) == "ddpdp");
}

// 2.05, 1.82 and 2.00 are all within a tenth of their mean 1.96; but 2.05 and 1.82, side by side,
// are not within a tenth of each other.
BOOST_AUTO_TEST_CASE(orders_of_a_window_agree_with_their_neighbours_and_not_only_with_the_mean) {
    BOOST_TEST(word(with_orders({2.05, 1.82, 2.00})) == "pAAA");
    BOOST_TEST(word(with_orders({2.05, 1.95, 2.00})) == "AAAA");
}

// One odd order at the end may be chance; two that agree neither with the window nor with each
// other are what the window's order would have to be.
BOOST_AUTO_TEST_CASE(finer_orders_that_agree_with_nothing_refute_a_window) {
    BOOST_TEST(word(with_orders({2, 2, 2, 1.2})) == "AAAAp");
    BOOST_TEST(word(with_orders({2, 2, 2, 1.2, 1.6})) == "pppppp");
}

// Thrown back by a factor of eight, the error hardly falls from there on: it grows in one row only.
BOOST_AUTO_TEST_CASE(an_error_diverges_where_it_grows_and_not_where_it_stays_large) {
    BOOST_TEST(word(with_orders({2, 2, 2, -3, 0.3})) == "AAAAdf");
}

// h + h^1.5: orders from 1.23 down to 1.11 agree with each other, and go to 1.
BOOST_AUTO_TEST_CASE(orders_that_agree_on_their_way_to_another_one_are_not_asymptotic) {
    std::vector<Refinement> ladder;
    for (int k = 0; k < 5; ++k)
        ladder.push_back({.h = std::exp2(-k), .error = std::exp2(-k) + std::exp2(-1.5 * k)});
    const OrderInterval order = order_along(ladder).order;
    BOOST_REQUIRE(order.determined);
    const auto verdict = judge(ladder, {.order = &order});
    // The last order is near 1, and that alone.
    BOOST_TEST(word(verdict) == "ppppp");
    BOOST_TEST(verdict.rows[4].reason.starts_with("order 1.11; that of the end is 1.00 ± "));
    BOOST_TEST(!verdict.window.has_value());
    // Where two are, the others are told what they go to.
    ladder.push_back({.h = std::exp2(-5), .error = std::exp2(-5) + std::exp2(-7.5)});
    const OrderInterval longer = order_along(ladder).order;
    const auto cut = judge(ladder, {.order = &longer});
    BOOST_TEST(cut.window.has_value() == (std::abs(longer.value - 1.115) <= 0.1));
    // Of what is not determined nothing is asymptotic.
    const OrderInterval open{.value = 1.1, .status = "it rises over finer windows, to 1.1"};
    const auto none = judge(ladder, {.order = &open});
    BOOST_TEST(word(none) == "pppppp");
    BOOST_TEST(none.rows[1].reason == "order 1.23 here, and that of the end is not determined: it "
                                      "rises over finer windows, to 1.1");
    // Who expects an order has it taken for that of the end.
    BOOST_TEST(word(judge(ladder, {.expected_order = 1.15, .order = &open})) != "pppppp");
}

// What is left out leaves the others their deviations.
BOOST_AUTO_TEST_CASE(a_row_that_is_not_resolved_does_not_move_the_deviations_of_others) {
    const std::vector<double> errors{1.0, 0.26, 0.06, 0.0157, 0.0039};
    const std::vector<double> sigma{0.5, 0.01, 1e-3, 1e-4, 1e-5};
    std::vector<Refinement> ladder;
    for (std::size_t k = 0; k < errors.size(); ++k)
        ladder.push_back({.h = std::exp2(-static_cast<double>(k)), .error = errors[k]});
    ladder.front().uncertainty = 1.0;
    BOOST_REQUIRE(!ladder.front().is_resolved());
    const OrderInterval all = order_along(ladder, sigma).order;
    const OrderInterval rest =
        order_along(std::span(ladder).subspan(1), std::span(sigma).subspan(1)).order;
    BOOST_REQUIRE(rest.determined);
    BOOST_TEST(all.low == rest.low);
    BOOST_TEST(all.high == rest.high);
}

BOOST_AUTO_TEST_CASE(each_row_of_the_window_shows_the_order_that_all_levels_determine) {
    const OrderInterval order{.value = 2.0, .low = 1.95, .high = 2.05, .determined = true};
    // 1.79 agrees with the orders beside it and with their mean, and not with 2.00.
    const auto ladder = with_orders({2.0, 1.9, 1.79, 1.9, 2.0});
    BOOST_TEST(word(ladder) == "AAAAAA");
    const auto judged = judge(ladder, {.order = &order});
    BOOST_TEST(word(judged) == "pppAAA");
    BOOST_TEST(judged.rows[2].reason == "coarser than the rows that show order 1.95");
    // 2.15 and 1.85 do not agree with each other; both may be 2.00.
    BOOST_TEST(word(with_orders({2.15, 1.85, 2.15, 1.85})) == "ppppp");
    BOOST_TEST(word(with_orders({2.15, 1.85, 2.15, 1.85}), {.order = &order}) == "AAAAA");
    // None is.
    const auto none = judge(with_orders({1.5, 1.6, 1.5}), {.order = &order});
    BOOST_TEST(word(none) == "pppp");
    BOOST_TEST(none.rows[3].reason == "order 1.50; that of the end is 2.00 ± 0.05");
}

// Of errors that deviate by 5 % the order on halved widths does by 1.96 · 0.05 √2/ln 2 = 0.2.
BOOST_AUTO_TEST_CASE(what_deviations_account_for_is_no_other_order_no_dip_and_no_outlier) {
    const auto with_deviations = [](const std::vector<double>& orders, double part,
                                    VerdictOptions options = {}) {
        const auto ladder = with_orders(orders);
        std::vector<double> sigma;
        for (const auto& record : ladder)
            sigma.push_back(part * record.error);
        options.sigma = sigma;
        return word(ladder, options);
    };
    const OrderInterval order{.value = 2.0, .low = 1.95, .high = 2.05, .determined = true};
    for (const auto* all : {static_cast<const OrderInterval*>(nullptr), &order}) {
        BOOST_TEST(with_deviations({2.1, 1.7, 2.2, 1.75, 2.0}, 0.05, {.order = all}) == "AAAAAA");
        BOOST_TEST(with_deviations({2.1, 1.7, 2.2, 1.75, 2.0}, 0.01, {.order = all}) != "AAAAAA");
    }
    BOOST_TEST(with_deviations({2.0, 1.5, 2.0}, 0.05, {.order = &order}) == "pppp");
    BOOST_TEST(with_deviations({2.0, 2.0, 2.0, 2.45, 1.55, 2.0, 2.0}, 0.001) == "AAAAoAAA");
    BOOST_TEST(with_deviations({2.0, 2.0, 2.0, 2.45, 1.55, 2.0, 2.0}, 0.1) == "AAAAAAAA");
    BOOST_TEST(with_deviations({2.0, 2.0, 2.0, 2.3, 1.7}, 0.001) == "AAAAcc");
    BOOST_TEST(with_deviations({2.0, 2.0, 2.0, 2.3, 1.7}, 0.06) == "AAAAAA");
    BOOST_TEST(with_deviations({2.0, 2.1}, 0.05, {.expected_order = 2.3}) == "AAA");
}

// h² + Δt, both positive: nothing cancels, whatever the orders of the other sweep are.
BOOST_AUTO_TEST_CASE(each_sweep_of_widths_that_are_refined_in_turns_is_judged_by_itself) {
    const auto ladder = [](const std::vector<std::pair<double, double>>& widths) {
        std::vector<Refinement> rows;
        for (const auto& [h, dt] : widths)
            rows.push_back({.h = h, .dt = dt, .error = h * h + dt});
        return rows;
    };
    const auto floor =
        ladder({{0.1, 1e-3}, {0.05, 1e-3}, {0.025, 1e-3}, {0.0125, 1e-3}, {0.00625, 1e-3}});
    const auto time = ladder({{1e-3, 0.1}, {1e-3, 0.05}, {1e-3, 0.025}, {1e-3, 0.0125}});
    auto both = floor;
    both.insert(both.end(), time.begin(), time.end());
    const auto judged = judge(both);
    BOOST_TEST(word(judged) == word(floor) + word(time));
    BOOST_TEST(word(time) == "AAAA");
    BOOST_TEST(!judged.window.has_value());
    // A level of two sweeps is judged in that of its h.
    const auto turned = ladder(
        {{0.1, 0.1}, {0.05, 0.1}, {0.025, 0.1}, {0.025, 0.05}, {0.025, 0.025}, {0.025, 0.0125}});
    const auto second = ladder({{0.025, 0.1}, {0.025, 0.05}, {0.025, 0.025}, {0.025, 0.0125}});
    BOOST_TEST(word(turned).substr(2) == word(second));
    // However the rows are sorted: two sweeps that share a level, and one at an h in between.
    const auto star = judge(ladder({{0.1, 1e-5},
                                    {0.05, 1e-5},
                                    {0.025, 0.1},
                                    {0.025, 0.05},
                                    {0.025, 0.025},
                                    {0.025, 0.0125},
                                    {0.025, 1e-5}}));
    BOOST_TEST(word(star).substr(0, 6) == "AAAAAA");
    BOOST_TEST(star.orders[1].value() == std::log2((0.01 + 1e-5) / (0.0025 + 1e-5)),
               boost::test_tools::tolerance(1e-9));
    const auto between = judge(ladder(
        {{0.1, 1e-3}, {0.05, 1e-3}, {0.02, 0.1}, {0.02, 0.05}, {0.02, 0.025}, {0.0125, 1e-3}}));
    BOOST_TEST(between.orders[5].value() ==
                   std::log((0.05 * 0.05 + 1e-3) / (0.0125 * 0.0125 + 1e-3)) / std::log(4.0),
               boost::test_tools::tolerance(1e-9));
    BOOST_TEST(!between.orders[2].has_value());
    // Both at once in some steps are one ladder.
    BOOST_TEST(word(ladder({{0.1, 0.1}, {0.05, 0.1}, {0.025, 0.05}, {0.0125, 0.025}})) == "pAAA");
}

BOOST_AUTO_TEST_CASE(equal_errors_stand_on_a_floor) {
    BOOST_TEST(word(halving({0.1, 0.1, 0.1, 0.1})) == "ffff");
    // Nearly equal is no slow convergence either: orders of a thousandth agree with each other.
    BOOST_TEST(word(with_orders({0.001, 0.001, 0.001})) == "ffff");
}

BOOST_AUTO_TEST_CASE(a_zero_error_is_exact_and_the_rest_is_judged_without_it) {
    BOOST_TEST(word(halving({1.0, 0.5, 0.25, 0.0})) == "AAA0");
    BOOST_TEST(word(halving({0.0, 0.0})) == "00");
}

BOOST_AUTO_TEST_CASE(a_row_whose_error_is_uncertain_is_unresolved_and_confirms_no_other) {
    auto ladder = with_orders({2, 2, 2});
    for (auto& record : ladder)
        record.uncertainty = 0.01; // one per cent moves an order by little
    BOOST_TEST(word(ladder) == "AAAA");
    ladder[0].uncertainty = 0.011;
    BOOST_TEST(word(ladder) == "uAAA");
    ladder[1].uncertainty = 5.0;
    BOOST_TEST(word(ladder) == "uupp");
    for (auto& record : ladder)
        record.uncertainty = 1.0;
    BOOST_TEST(word(ladder) == "uuuu");
}

BOOST_AUTO_TEST_CASE(a_failed_run_is_named_and_the_rest_is_judged_without_it) {
    BOOST_TEST(word(halving({1.0, not_a_number, 0.25, 0.125})) == "AxAA");
    BOOST_TEST(word(halving({not_a_number})) == "x");
    BOOST_TEST(word(halving({1.0, -0.5, std::numeric_limits<double>::infinity()})) == "pxx");
}

BOOST_AUTO_TEST_CASE(one_row_shows_nothing) {
    const OrderInterval order{.value = 2.0, .low = 1.9, .high = 2.1, .determined = true};
    BOOST_TEST(word(halving({0.1}), {.order = &order}) == "p");
    BOOST_TEST(word(halving({1.0})) == "p");
    BOOST_TEST(word(halving({})).empty());
}

// Two rows have one order, and any two errors have one: nothing confirms it but an expectation.
BOOST_AUTO_TEST_CASE(two_rows_are_asymptotic_only_where_the_expected_order_is_met) {
    const auto ladder = with_orders({2});
    BOOST_TEST(word(ladder) == "pp");
    BOOST_TEST(word(ladder, {.expected_order = 2.0}) == "AA");
    BOOST_TEST(word(ladder, {.expected_order = 1.0}) == "pp");
    BOOST_TEST(word(with_orders({-2}), {.expected_order = 2.0}) == "dd");
}

// A scheme of order two that converges with order one everywhere meets no expectation of two.
BOOST_AUTO_TEST_CASE(a_wrong_order_is_not_asymptotic_where_another_is_expected) {
    BOOST_TEST(word(with_orders({1, 1, 1}), {.expected_order = 2.0}) == "pppp");
}

// h² + 1e-12 from h = 1e-3 on by tens: 1e-6, 1e-8, 1e-10, 2e-12, 1.01e-12, 1.0001e-12.
BOOST_AUTO_TEST_CASE(a_floor_at_1e_12_is_told_from_convergence) {
    std::vector<Refinement> ladder;
    for (const double h : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9})
        ladder.push_back({.h = h, .error = h * h + 1e-12});
    const auto judged = judge(ladder);
    // Row 3, order log10(1.01e-10 / 2e-12) = 1.70, departs from 2.00 and leads into the floor.
    BOOST_TEST(word(judged) == "AAAffff");
    BOOST_TEST(judged.window->order == 2.0, boost::test_tools::tolerance(0.01));
}

// 2 h² + 0.003 goes to 0.003: no two orders agree, and each is below the one before.
BOOST_AUTO_TEST_CASE(an_error_that_levels_off_is_on_its_way_to_a_floor) {
    std::vector<Refinement> ladder;
    for (double h = 0.25; ladder.size() < 5; h /= 2)
        ladder.push_back({.h = h, .error = 2 * h * h + 0.003});
    BOOST_TEST(word(ladder) == "ppppp");
    const LadderOrder along = order_along(ladder);
    BOOST_TEST(along.order.levels_off);
    const auto judged = judge(ladder, {.order = &along.order});
    BOOST_TEST(word(judged) == "ppfff");
    BOOST_TEST(judged.rows.back().reason == "a floor begins to show, order 0.51 after 1.13");
}

// Rounding scatters: errors within a factor of three of the least are no divergence, and two of
// them that happen to fall regularly are no order.
BOOST_AUTO_TEST_CASE(a_floor_that_scatters_is_a_floor) {
    BOOST_TEST(word(with_orders({2, 2, 2, 0.3, -0.6, 0.4, -0.2})) == "AAAAffff");
    BOOST_TEST(word(with_orders({2, 2, 2, 0.1, 0.2, 0.21})) == "AAAAfff");
}

BOOST_AUTO_TEST_CASE(growth_after_convergence_is_diverging) {
    BOOST_TEST(word(with_orders({2, 2, 2, -2, -4})) == "AAAAdd");
}

// The finest rows decide: what a kink leaves behind it is pre-asymptotic.
BOOST_AUTO_TEST_CASE(past_a_kink_the_finer_order_counts) {
    const auto judged = judge(with_orders({2, 2, 2, 1, 1}));
    BOOST_TEST(word(judged) == "pppAAA");
    BOOST_TEST(judged.window->order == 1.0, boost::test_tools::tolerance(1e-12));
    // A kink in the last row alone is not confirmed, and not hidden.
    BOOST_TEST(word(with_orders({2, 2, 2, 1})) == "AAAAp");
}

// h² + 0.01 h: the order runs from 1.99 down towards 1, which is the true one, and passes every
// value between. Neighbours that agree to a tenth on the way are no window while finer rows go on
// falling, wherever the ladder ends on that way.
BOOST_AUTO_TEST_CASE(a_drifting_order_is_not_asymptotic) {
    const auto drifting = [](int rows) {
        std::vector<Refinement> ladder;
        for (int i = 0; i < rows; ++i) {
            const double h = std::exp2(-i);
            ladder.push_back({.h = h, .error = h * h + 0.01 * h});
        }
        return ladder;
    };
    BOOST_TEST(word(drifting(10)) == "pppppppppp");
    BOOST_TEST(!judge(drifting(10)).window.has_value());
    BOOST_TEST(word(drifting(9)) == "ppppppppp");
    // Far enough down it shows the order that it has.
    const auto resolved = judge(drifting(16));
    BOOST_REQUIRE(resolved.window.has_value());
    BOOST_TEST(resolved.window->last == 15u);
    BOOST_TEST(resolved.window->order == 1.0, boost::test_tools::tolerance(0.05));
}

// Errors about a sign change: 1/4 of the row before, then almost nothing, then back on a line.
BOOST_AUTO_TEST_CASE(a_dip_is_a_cancellation) {
    BOOST_TEST(word(with_orders({2, 2, 12, -9})) == "AAAcc");
    BOOST_TEST(word(with_orders({2, 12, -9, 1, 1})) == "ppcAAA");
}

// e = |A − B| with A = h², B = h/16 on h = 1, 1/2 …: A = B at h = 1/16, the fourth halving. With ρ
// = −0.9 e² = (A − B)² + 0.2 AB. The larger term loses a tenth where e < 0.9 max(A, B).
BOOST_AUTO_TEST_CASE(with_a_model_the_cancellation_is_known_before_it_shows) {
    const TwoTermModel model{.a = 1, .p = 2, .b = 1.0 / 16, .q = 1, .rho = -0.9};
    std::vector<Refinement> ladder;
    for (int halvings = 0; halvings < 14; ++halvings) {
        const double h = std::exp2(-halvings);
        ladder.push_back({.h = h, .dt = h, .error = model.error(h, h)});
    }
    std::string expected;
    for (const auto& record : ladder) {
        const double larger = std::max(record.h * record.h, record.h / 16);
        expected += record.error < 0.9 * larger ? 'c' : record.h > 1.0 / 16 ? 'p' : 'A';
    }
    BOOST_TEST(expected == "pcccccccAAAAAA");
    BOOST_TEST(word(ladder, {.model = &model}) == expected);
}

// A row that the model does not describe is judged by its neighbours.
BOOST_AUTO_TEST_CASE(a_model_of_something_else_decides_nothing) {
    const TwoTermModel other{.a = 5, .p = 2, .b = 1, .q = 1, .rho = 0};
    std::vector<Refinement> ladder;
    for (const double h : {0.1, 0.05, 0.025, 0.0125})
        ladder.push_back({.h = h, .dt = h, .error = h * h * h});
    BOOST_TEST(word(ladder, {.model = &other}) == word(ladder));
    BOOST_TEST(word(ladder) == "AAAA");
}

// h² with every row doubled is h²: the rows of one width are one level.
BOOST_AUTO_TEST_CASE(duplicates_change_no_verdict_and_no_order) {
    std::vector<Refinement> ladder;
    for (const double h : {0.4, 0.2, 0.1, 0.05})
        for (const double factor : {1.0, 2.0})
            ladder.push_back({.h = h, .error = factor * h * h});
    const auto judged = judge(ladder);
    BOOST_TEST(word(judged) == "AAAAAAAA");
    for (std::size_t i = 0; i < ladder.size(); ++i) {
        BOOST_TEST(judged.orders[i].has_value() == (i % 2 == 0 && i > 0));
        if (judged.orders[i])
            BOOST_TEST(*judged.orders[i] == 2.0, boost::test_tools::tolerance(1e-12));
    }
}

// Runs of one width scatter by 20 % about h², the first up and down in turns: their geometric mean
// is on the line, and no one of them would show it.
BOOST_AUTO_TEST_CASE(a_level_is_judged_by_the_mean_of_its_rows) {
    std::vector<Refinement> all;
    std::vector<Refinement> first;
    double factor = 1.2;
    for (const double h : {0.4, 0.2, 0.1, 0.05}) {
        first.push_back({.h = h, .error = factor * h * h});
        all.push_back(first.back());
        all.push_back({.h = h, .error = h * h / factor});
        factor = 1 / factor;
    }
    BOOST_TEST(word(all) == "AAAAAAAA");
    BOOST_TEST(word(first) == "pppp");
}

// Widths that differ by two per cent, errors by scatter: no order of such a pair says anything.
BOOST_AUTO_TEST_CASE(rows_too_close_in_h_are_one_level) {
    std::vector<Refinement> ladder;
    for (const double h : {0.4, 0.2, 0.1, 0.05}) {
        ladder.push_back({.h = h, .error = h * h});
        ladder.push_back({.h = 0.98 * h, .error = 1.01 * h * h});
    }
    BOOST_TEST(word(ladder) == "AAAAAAAA");
    BOOST_TEST(word({{.h = 0.1, .error = 1.0}, {.h = 0.099, .error = 3.0}}) == "pp");
    BOOST_TEST(judge({{{.h = 0.1, .error = 1.0}, {.h = 0.1, .error = 3.0}}}).rows[0].reason ==
               "one level alone shows no order");
}

// One error of 3 times its line, or a third: the rows on both sides agree without it.
BOOST_AUTO_TEST_CASE(a_row_off_the_line_of_its_neighbours_is_an_outlier) {
    for (const double factor : {3.0, 1.0 / 3}) {
        auto ladder = with_orders({2, 2, 2, 2, 2, 2});
        ladder[3].error *= factor;
        const auto judged = judge(ladder);
        BOOST_TEST(word(judged) == "AAAoAAA");
        BOOST_TEST(judged.window->order == 2.0, boost::test_tools::tolerance(1e-12));
    }
}

BOOST_AUTO_TEST_CASE(infinite_errors_are_failed_runs) {
    const double infinite = std::numeric_limits<double>::infinity();
    const auto judged = judge(halving({infinite, 1.0, 0.25, 0.0625, infinite}));
    BOOST_TEST(word(judged) == "xAAAx");
    BOOST_TEST(judged.rows[0].reason == "the error is infinite");
}

BOOST_AUTO_TEST_CASE(every_verdict_has_its_name) {
    BOOST_TEST(name_of(Verdict::outlier) == "outlier");
    BOOST_TEST(name_of(Verdict::asymptotic) == "asymptotic");
    BOOST_TEST(name_of(Verdict::pre_asymptotic) == "pre-asymptotic");
    BOOST_TEST(name_of(Verdict::cancellation) == "cancellation");
    BOOST_TEST(name_of(Verdict::floor) == "floor");
    BOOST_TEST(name_of(Verdict::diverging) == "diverging");
    BOOST_TEST(name_of(Verdict::unresolved) == "unresolved");
    BOOST_TEST(name_of(Verdict::exact) == "exact");
    BOOST_TEST(name_of(Verdict::failed) == "failed");
}

BOOST_AUTO_TEST_SUITE_END()

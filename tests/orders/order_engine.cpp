// The engine for orders in any number of widths: what it calls determined holds the order, and what
// the rows cannot show it says in words. Grids of the solver itself are in tests/orders/grids.

#include "studies/orders/order_engine.hpp"

#include "tests/sweep.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(order_engine)

namespace {

std::vector<ErrorRow> sequence(int levels, const std::function<double(double)>& error) {
    std::vector<ErrorRow> rows;
    for (int k = 0; k < levels; ++k) {
        const double h = 0.2 * std::exp2(-k);
        rows.push_back({{h}, error(h)});
    }
    return rows;
}

std::vector<ErrorRow> grid(const std::function<double(double, double)>& error) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05, 0.025, 0.0125})
        for (const double dt : {0.1, 0.05, 0.025, 0.0125, 0.00625})
            rows.push_back({{h, dt}, error(h, dt)});
    return rows;
}

bool holds(const OrderInterval& order, double truth) {
    return order.low <= truth && truth <= order.high;
}

/// A row whose error scatters by a part of it.
ErrorRow scattered(std::vector<double> widths, double error, double sigma,
                   std::mt19937& generator) {
    if (!(sigma > 0))
        return {std::move(widths), error};
    std::normal_distribution<double> normal;
    return {std::move(widths), error * (1 + sigma * normal(generator)), sigma};
}

/// Draws from an interval.
auto uniform_from(std::mt19937& generator) {
    return [&generator](double low, double high) {
        return std::uniform_real_distribution(low, high)(generator);
    };
}

/// How many orders are determined, and how many of these missed.
struct Count {
    int determined = 0;
    int missed = 0;

    void add(const OrderInterval& order, double truth) {
        determined += order.determined ? 1 : 0;
        missed += order.determined && !holds(order, truth) ? 1 : 0;
    }
    /// Of intervals that hold the order in 95 %, to two standard deviations.
    bool is_chance() const {
        const double expected = 0.05 * determined;
        return missed <= expected + 2 * std::sqrt(0.95 * expected);
    }
};

/// Of errors h^p f(h, c) + b dt^q, added with a correlation and scattered, in 30 tables.
Count orders_beside_another_width(int meshes, int steps, double sigma,
                                  const std::function<double(double h, double c)>& factor) {
    std::mt19937 generator(20261128);
    const auto uniform = uniform_from(generator);
    Count count;
    for (int table = 0; table < 30; ++table) {
        const double p = 1 + table % 3;
        const double q = 1 + table % 2;
        const double size = uniform(0.1, 1.5);
        const double b = std::pow(10, uniform(-3, 0));
        const double rho = uniform(-0.9, 1);
        const double h_0 = uniform(0.1, 0.4);
        std::vector<ErrorRow> rows;
        for (int i = 0; i < meshes; ++i)
            for (int j = 0; j < steps; ++j) {
                const double h = h_0 * std::exp2(-i);
                const double dt = 0.2 * std::exp2(-j);
                const double in_h = std::pow(h, p) * factor(h, size);
                const double in_dt = b * std::pow(dt, q);
                const double error =
                    std::sqrt(in_h * in_h + 2 * rho * in_h * in_dt + in_dt * in_dt);
                rows.push_back(scattered({h, dt}, error, sigma, generator));
            }
        count.add(estimate_orders(rows)[0], p);
    }
    return count;
}

} // namespace

BOOST_DATA_TEST_CASE(a_pure_power_is_known_to_the_narrowest_interval,
                     data::make({0.5, 1.0, 1.7, 2.0, 4.0, 7.0}) * data::make({3, 5, 9}), p,
                     levels) {
    const auto order =
        estimate_orders(sequence(levels, [p = p](double h) { return 3 * std::pow(h, p); })).front();
    BOOST_TEST(order.determined);
    BOOST_TEST(std::abs(order.value - p) < 1e-4);
    BOOST_TEST(order.half_width() < 1.1 * OrderTuning{}.narrowest);
}

// However many levels, and however small either term becomes.
BOOST_DATA_TEST_CASE(more_exact_levels_of_a_grid_make_no_wider_intervals,
                     data::make({1, 2, 4}) * data::make({1, 2}) * data::make({0.1, 1.0, 10.0}), p,
                     q, size) {
    for (const int levels : {5, 7}) {
        std::vector<ErrorRow> rows;
        for (int i = 0; i < levels; ++i)
            for (int j = 0; j < levels; ++j) {
                const double h = 0.2 * std::exp2(-i);
                const double dt = 0.1 * std::exp2(-j);
                rows.push_back({{h, dt}, std::pow(h, p) + size * std::pow(dt, q)});
            }
        const auto orders = estimate_orders(rows);
        for (const auto& [order, truth] : {std::pair(orders[0], p), std::pair(orders[1], q)}) {
            BOOST_TEST(holds(order, truth));
            BOOST_TEST(order.half_width() < 2 * OrderTuning{}.narrowest);
        }
    }
}

// A term is a small part of most errors: what follows all rows closely says nothing of it.
BOOST_DATA_TEST_CASE(an_order_that_the_other_term_hides_in_most_rows_is_held_or_not_determined,
                     data::make({0.2, 0.4}), gap) {
    std::vector<ErrorRow> rows;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            const double h = std::exp2(-i);
            const double dt = std::pow(1.5, -j);
            rows.push_back({{h, dt}, h * h * (1 + 1.6 * std::pow(h, gap)) + 240 * dt * dt});
        }
    const OrderInterval order = estimate_orders(rows).front();
    BOOST_TEST((!order.determined || holds(order, 2.0)), order.value);
}

// h^p + r h², p from 1.6 to 1.9: both terms are of one size where h is finest, and the pairwise
// orders hardly move on their way to p.
BOOST_AUTO_TEST_CASE(an_order_beside_a_close_one_is_held_or_not_determined) {
    std::mt19937 generator(20261129);
    const auto uniform = uniform_from(generator);
    for (const auto& [levels, ratio] : {std::pair{4, 2.0}, {5, 2.0}, {7, 2.0}, {6, 1.4}}) {
        Count count;
        for (int table = 0; table < (short_tests ? 6 : 60); ++table) {
            const double p = uniform(1.6, 1.9);
            const double finest = std::pow(ratio, 1 - levels);
            const double r = std::exp(uniform(-1.2, 1.2)) * std::pow(finest, p - 2);
            std::vector<ErrorRow> rows;
            for (int k = 0; k < levels; ++k) {
                const double h = std::pow(ratio, -k);
                rows.push_back({{h}, std::pow(h, p) + r * h * h});
            }
            count.add(estimate_orders(rows).front(), p);
        }
        BOOST_TEST(count.is_chance(),
                   levels << " levels: " << count.missed << " of " << count.determined);
    }
}

// h² + 20 h³ and h + 13 h² on four levels: the next term is larger than the leading one where h is
// coarsest, and a model has it.
BOOST_AUTO_TEST_CASE(an_order_beside_a_large_next_term_stays_determined) {
    for (const auto& [p, c] : {std::pair{2.0, 20.0}, {1.0, 13.0}}) {
        std::vector<ErrorRow> rows;
        for (const double h : {0.1, 0.05, 0.025, 0.0125})
            rows.push_back({{h}, std::pow(h, p) * (1 + c * h)});
        const auto order = estimate_orders(rows).front();
        BOOST_TEST(order.determined, order.status);
        BOOST_TEST(holds(order, p));
        BOOST_TEST(order.half_width() < 0.2);
    }
}

// First order in both widths, of an error that saturates: x/(1 + x) and 1 − exp(−x) of
// x = c (h + b dt) have products of the widths, which no next term of one has.
BOOST_AUTO_TEST_CASE(orders_of_errors_that_saturate_are_held_on_grids) {
    std::mt19937 generator(20261130);
    const auto uniform = uniform_from(generator);
    using Law = double (*)(double);
    for (const Law law :
         {Law([](double x) { return x / (1 + x); }), Law([](double x) { return 1 - std::exp(-x); }),
          Law([](double x) { return std::sqrt(1 + 2 * x) - 1; })}) {
        Count count;
        for (int table = 0; table < (short_tests ? 1 : 20); ++table) {
            const double c = std::exp(uniform(-2, 0.5));
            const double b = std::exp(uniform(-1, 1));
            std::vector<ErrorRow> rows;
            for (int i = 0; i < 5; ++i)
                for (int j = 0; j < 5; ++j)
                    rows.push_back({{std::exp2(-i), std::exp2(-j)},
                                    law(c * (std::exp2(-i) + b * std::exp2(-j)))});
            for (const auto& order : estimate_orders(rows))
                count.add(order, 1);
        }
        BOOST_TEST(count.is_chance(), count.missed << " of " << count.determined);
    }
}

// Pairwise orders 0.911, 0.957, 0.979, which halve their distance to one: extrapolation gives 1.
BOOST_AUTO_TEST_CASE(a_sequence_that_still_moves_holds_what_extrapolation_gives) {
    const auto order =
        estimate_orders(sequence(4, [](double h) { return h * (1 + 0.7 * h); })).front();
    BOOST_TEST(order.determined);
    BOOST_TEST(holds(order, 1.0));
}

// Orders 1.46, 1.57, 1.68 rise without slowing down: nothing says where they stop.
BOOST_AUTO_TEST_CASE(
    an_order_that_rises_without_slowing_down_is_not_determined_or_holds_what_follows) {
    std::vector<ErrorRow> rows{{{0.1}, 1.0}};
    for (const double order : {1.46, 1.57, 1.68})
        rows.push_back({{rows.back().widths[0] / 2}, rows.back().error * std::exp2(-order)});
    const auto order = estimate_orders(rows).front();
    BOOST_TEST(!order.determined);
    BOOST_TEST(order.status == "it rises over finer windows, to 1.68");
}

// Of the three finest levels alone a logarithm of the other sign has the same three errors, and an
// order that is too low: with it 10 to 15 % of these were missed.
BOOST_DATA_TEST_CASE(of_four_levels_a_logarithm_has_the_sign_that_all_of_them_show,
                     data::make({1.0, 2.0, 3.0}) * data::make({0.1, 0.3, 1.0}) *
                         data::make({1.5, 2.0, 3.0}),
                     p, size, ratio) {
    std::vector<ErrorRow> rows;
    for (int i = 0; i < 4; ++i) {
        const double h = 0.3 * std::pow(ratio, -i);
        rows.push_back({{h}, std::pow(h, p) * (1 - size * std::log(h))});
    }
    const auto order = estimate_orders(rows).front();
    BOOST_TEST((order.determined && holds(order, p)),
               order.value << " in " << order.low << " ... " << order.high);
}

// Where dt has three levels no window leaves one out, and what changes with a next term of dt is
// the drift: not what changes without the logarithm of h, of which two thirds were missed. Of three
// meshes a next term follows the errors as closely: 3 of 20 were missed. So it is where they
// scatter: 15 of 27 were.
BOOST_DATA_TEST_CASE(an_order_with_a_logarithm_is_found_beside_another_width,
                     data::make({3, 4}) * data::make({3, 4, 5}) * data::make({0.0, 0.001}), meshes,
                     steps, sigma) {
    if (short_tests && (steps != 3 || sigma == 0.0))
        return;
    const auto count = orders_beside_another_width(
        meshes, steps, sigma, [](double h, double c) { return 1 - c * std::log(h); });
    BOOST_TEST(count.determined >= (meshes == 3 ? 6 : 15));
    BOOST_TEST(count.is_chance(), count.missed << " of " << count.determined);
}

// Leading terms, and whole orders on, follow such errors as closely.
BOOST_DATA_TEST_CASE(an_order_with_half_an_order_on_is_found_beside_another_width,
                     data::make({4, 5}) * data::make({4, 5}), meshes, steps) {
    if (short_tests && (meshes != 4 || steps != 4))
        return;
    const auto count = orders_beside_another_width(
        meshes, steps, 0.001, [](double h, double c) { return 1 + c * std::sqrt(h); });
    BOOST_TEST(count.determined >= 20);
    BOOST_TEST(count.is_chance(), count.missed << " of " << count.determined);
}

// Leading and next terms follow such errors as closely, with other orders: up to 19 of 28 were
// missed.
BOOST_DATA_TEST_CASE(scatter_does_not_hide_a_logarithm,
                     data::make({4, 5, 6, 8}) * data::make({1e-4, 3e-3, 1e-2}), levels, sigma) {
    std::mt19937 generator(20261129);
    const auto uniform = uniform_from(generator);
    constexpr int tables = 60;
    Count count;
    for (int table = 0; table < tables; ++table) {
        const double p = 1 + table % 3;
        const double size = uniform(0.1, 1.5);
        const double h_0 = uniform(0.1, 0.4);
        const double ratio = uniform(1.5, 2.5);
        std::vector<ErrorRow> rows;
        for (int i = 0; i < levels; ++i) {
            const double h = h_0 * std::pow(ratio, -i);
            const double error = std::pow(h, p) * (1 - size * std::log(h));
            rows.push_back(scattered({h}, error, sigma, generator));
        }
        count.add(estimate_orders(rows)[0], p);
    }
    BOOST_TEST(count.determined >= 0.4 * tables);
    BOOST_TEST(count.is_chance(), count.missed << " of " << count.determined);
}

// Errors scatter by as much as nobody says, as on meshes of a generator, and both terms have a next
// one, up to half of the leading one on the coarsest level: of 2 % a sixth of the intervals missed.
BOOST_DATA_TEST_CASE(scatter_that_nobody_states_is_in_the_intervals,
                     data::make({4, 5}) * data::make({3e-3, 2e-2}), levels, sigma) {
    if (short_tests && levels != 4)
        return;
    std::mt19937 generator(20261130);
    const auto uniform = uniform_from(generator);
    const int tables = short_tests ? 15 : 60;
    Count count;
    for (int table = 0; table < tables; ++table) {
        const double p = 1 + table % 3;
        const double q = 1 + table % 2;
        const double ratio = uniform(1.4, 2.2);
        const double size = std::pow(10, uniform(-0.5, 0.5));
        const double c = uniform(-0.5, 0.5);
        const double d = uniform(-0.5, 0.5);
        std::vector<ErrorRow> rows;
        for (int i = 0; i < levels; ++i)
            for (int j = 0; j < levels; ++j) {
                const double h = std::pow(ratio, -i);
                const double dt = std::pow(ratio, -j);
                const double in_h = std::pow(h, p) * (1 + c * h);
                const double in_dt = size * std::pow(dt, q) * (1 + d * dt);
                rows.push_back(scattered({h, dt}, in_h + in_dt, sigma, generator));
                rows.back().sigma = std::numeric_limits<double>::quiet_NaN();
            }
        const auto orders = estimate_orders(rows);
        count.add(orders[0], p);
        count.add(orders[1], q);
    }
    BOOST_TEST(count.determined >= 0.2 * 2 * tables);
    BOOST_TEST(count.is_chance(), count.missed << " of " << count.determined);
}

// On close levels residuals are small by chance where they are few, and hide a next term: a seventh
// of these intervals missed.
BOOST_DATA_TEST_CASE(scatter_of_close_levels_that_nobody_states_is_in_the_intervals,
                     data::make({4, 5, 6}) * data::make({1e-3, 1e-2}), levels, sigma) {
    std::mt19937 generator(20261128);
    const auto uniform = uniform_from(generator);
    constexpr int tables = 150;
    Count count;
    for (int table = 0; table < tables; ++table) {
        const double p = 1 + table % 3;
        const double coarsest = uniform(0.1, 0.4);
        const double c = uniform(-1, 2);
        std::vector<ErrorRow> rows;
        for (int i = 0; i < levels; ++i) {
            const double h = coarsest * std::pow(1.25, -i);
            rows.push_back(scattered({h}, std::pow(h, p) * (1 + c * h), sigma, generator));
            rows.back().sigma = std::numeric_limits<double>::quiet_NaN();
        }
        count.add(estimate_orders(rows).front(), p);
    }
    BOOST_TEST(count.determined >= 0.05 * tables);
    BOOST_TEST(count.is_chance(), count.missed << " of " << count.determined);
}

// √h/10 beside h: at the coarsest level a fifth of the error, at the finest of nine a factor
// of 3.5. 1/|ln h| goes to the order 0 more slowly than any power.
BOOST_DATA_TEST_CASE(an_order_that_falls_slowly_is_not_taken_for_one_that_stands,
                     data::make({4, 5, 6, 7, 8, 9, 12}), levels) {
    const auto half_power =
        estimate_orders(sequence(levels, [](double h) { return h + 0.1 * std::sqrt(h); })).front();
    BOOST_TEST((!half_power.determined || holds(half_power, 0.5)));
    const auto none =
        estimate_orders(sequence(levels, [](double h) { return -1 / std::log(h); })).front();
    BOOST_TEST(!none.determined);
}

// Of ln e = ln C + p ln h with independent scatter σ of every ln e, p has the standard deviation
// σ / sqrt(Σ (ln h − mean)²). Rows that happen to lie on a line know no better.
BOOST_DATA_TEST_CASE(an_interval_is_no_narrower_than_what_known_scatter_makes_of_it,
                     data::make({3, 5, 8}) * data::make({0.01, 0.05}), levels, sigma) {
    double squares = 0;
    for (int k = 0; k < levels; ++k)
        squares += std::pow((k - (levels - 1) / 2.0) * std::log(2.0), 2);
    const double least = 1.96 * sigma / std::sqrt(squares);
    auto stated = sequence(levels, [](double h) { return h * h; });
    std::vector<ErrorRow> replicates;
    for (auto& row : stated) {
        // Two of them, whose mean has the deviation σ as well.
        for (const double off : {-sigma, sigma})
            replicates.push_back({row.widths, row.error * std::exp(off)});
        row.sigma = sigma;
    }
    for (const auto& rows : {stated, replicates}) {
        const auto order = estimate_orders(rows).front();
        BOOST_TEST(order.half_width() >= least);
        BOOST_TEST(holds(order, 2.0));
    }
}

// With three levels a next term cannot be told from scatter: what is known is at best the
// difference of the two finest rows, with the deviation σ √2/ln 2.
BOOST_DATA_TEST_CASE(of_three_levels_an_interval_is_no_narrower_than_that_of_the_two_finest_rows,
                     data::make({0.01, 0.05}), sigma) {
    auto rows = sequence(3, [](double h) { return h * h; });
    for (auto& row : rows)
        row.sigma = sigma;
    BOOST_TEST(estimate_orders(rows).front().half_width() >=
               1.96 * sigma * std::sqrt(2.0) / std::log(2.0));
}

BOOST_DATA_TEST_CASE(both_orders_of_a_grid_are_held_with_next_terms_and_correlation,
                     data::make({-0.9, 0.0, 0.5, 1.0}) * data::make({-0.5, 0.0, 1.0}), rho, next) {
    const auto orders = estimate_orders(grid([rho = rho, next = next](double h, double dt) {
        const double space = h * h * (1 + next * h);
        const double time = 0.3 * dt * (1 + next * dt);
        return std::sqrt(space * space + 2 * rho * space * time + time * time);
    }));
    BOOST_TEST(orders[0].determined);
    BOOST_TEST(orders[1].determined);
    BOOST_TEST(holds(orders[0], 2.0));
    BOOST_TEST(holds(orders[1], 1.0));
}

// What a term of a grid may have beside its power: a next term half an order on, a logarithm, or a
// floor that no width removes; with either sign of the other term.
BOOST_DATA_TEST_CASE(the_orders_of_a_grid_hold_beside_half_orders_logarithms_and_floors,
                     data::make({1, 2, 3}) * data::make({1, 2}) * data::make({-1.0, 1.0}), p, q,
                     sign) {
    const double a = 2;
    const double b = a * std::pow(0.05, p - q); // as large in the middle
    const auto in_time = [&](double dt) { return sign * b * std::pow(dt, q); };
    const std::vector<std::pair<std::string, std::function<double(double, double)>>> laws{
        {"half an order on",
         [&](double h, double dt) {
             return std::abs(a * std::pow(h, p) * (1 + 3 * std::sqrt(h)) + in_time(dt));
         }},
        {"logarithm",
         [&](double h, double dt) {
             return std::abs(a * std::pow(h, p) * -std::log(h) + in_time(dt));
         }},
        {"floor", [&](double h, double dt) {
             const double floor = a * std::pow(0.0125, p);
             return a * std::pow(h, p) + std::abs(in_time(dt)) + floor;
         }}};
    for (const auto& [name, law] : laws) {
        const auto orders = estimate_orders(grid(law));
        for (const auto& [order, truth] : {std::pair(orders[0], p), std::pair(orders[1], q)})
            if (order.determined) {
                BOOST_TEST_CONTEXT(name << ": " << order.low << " to " << order.high)
                BOOST_TEST((order.low <= truth && order.high >= truth));
            }
        BOOST_TEST((orders[0].determined || orders[1].determined), name);
    }
}

// A logarithm or a next term half an order on in one width, and a next term in the other: four to
// six levels of either, any sizes and correlation.
BOOST_AUTO_TEST_CASE(the_orders_of_grids_hold_where_both_widths_have_next_terms) {
    std::mt19937_64 generator(5);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(generator);
    };
    const auto one_of = [&](const std::vector<double>& values) {
        return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(generator)];
    };
    int asked = 0;
    int determined = 0;
    int missed = 0;
    for (const bool has_logarithm : {false, true})
        for (const double next : {0.0, 1.0, 2.0}) // power of the next term in dt; 0: none
            for (int k = 0; k < (short_tests ? 2 : 8); ++k) {
                const double p = one_of({1, 1.5, 2, 3, 4});
                const double q = one_of({1, 2, 3});
                const double c = has_logarithm ? between(0.05, 0.5) : between(-0.5, 0.5);
                const double d = next == 0 ? 0.0 : between(-0.5, 0.5);
                const double rho = between(-0.9, 0.9);
                const double ratio = one_of({1.5, 2});
                const double h_0 = between(0.05, 0.25);
                const double dt_0 = between(0.05, 0.25);
                const double b = std::exp(between(-2, 2)) * std::pow(h_0, p) / std::pow(dt_0, q);
                const auto levels_of_h = static_cast<int>(one_of({4, 5, 6}));
                const auto levels_of_dt = static_cast<int>(one_of({4, 5, 6}));
                std::vector<ErrorRow> rows;
                for (int i = 0; i < levels_of_h; ++i)
                    for (int j = 0; j < levels_of_dt; ++j) {
                        const double h = h_0 * std::pow(ratio, -i);
                        const double dt = dt_0 * std::pow(ratio, -j);
                        const double space =
                            std::pow(h, p) *
                            (1 + c * (has_logarithm ? -std::log(h) : std::sqrt(h)));
                        const double time = b * std::pow(dt, q) * (1 + d * std::pow(dt, next));
                        rows.push_back(
                            {{h, dt},
                             std::sqrt(space * space + time * time + 2 * rho * space * time)});
                    }
                const auto orders = estimate_orders(rows);
                for (const auto& [order, truth] :
                     {std::pair(orders[0], p), std::pair(orders[1], q)}) {
                    ++asked;
                    determined += order.determined ? 1 : 0;
                    missed += order.determined && !holds(order, truth) ? 1 : 0;
                }
            }
    BOOST_TEST(determined >= 0.9 * asked);
    BOOST_TEST(missed <= 0.05 * determined, missed << " of " << determined);
}

// From the leading terms alone the search took what is left of dt for a constant, or for an order
// below zero, and h^0.5 for h.
BOOST_DATA_TEST_CASE(half_an_order_on_is_seen_beside_a_far_smaller_term_of_opposite_sign,
                     data::make({1.0, 1.7, 2.0, 3.0}) * data::make({1.0, 2.0}) *
                         data::make({0.4, 0.8, 1.3}) * data::make({2e-4, 5e-4, 1e-3, 1e-2, 0.1}),
                     p, q, next, part) {
    if (short_tests && next != (q > 1 ? 0.4 : 1.3))
        return;
    const auto law = [p = p, next = next](double h) {
        return std::pow(h, p) * (1 + next * std::sqrt(h));
    };
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05, 0.025})
        for (const double dt : {0.2, 0.1, 0.05})
            rows.push_back({{h, dt}, law(h) - part * law(0.025) * std::pow(dt / 0.2, q)});
    const auto order = estimate_orders(rows)[0];
    BOOST_TEST(order.determined, order.status);
    BOOST_TEST(holds(order, p), order.value << " ± " << order.half_width());
}

// Three terms of which two have the other's sign, on three levels each: from between the bounds of
// their correlations the search ended in a false valley, and one order was not determined, or known
// to ± 0.5 alone.
BOOST_AUTO_TEST_CASE(of_three_terms_that_cancel_in_part_all_orders_are_found) {
    struct Law {
        double order;
        double sizes[3];
    };
    for (const Law& law : {Law{2, {0.87, -0.76, -0.2}}, Law{1, {6.327, 0.261, -2.146}}}) {
        std::vector<ErrorRow> rows;
        for (const double h : {0.2, 0.1, 0.05})
            for (const double dt : {0.1, 0.05, 0.025})
                for (const double dz : {0.15, 0.075, 0.0375})
                    rows.push_back({{h, dt, dz},
                                    std::abs(law.sizes[0] * std::pow(h, law.order) +
                                             law.sizes[1] * std::pow(dt, law.order) +
                                             law.sizes[2] * std::pow(dz, law.order))});
        for (const auto& order : estimate_orders(rows)) {
            BOOST_TEST(order.determined, order.status);
            BOOST_TEST(holds(order, law.order));
            BOOST_TEST(order.half_width() < 0.05);
        }
    }
}

// h + f on four levels: another order follows them as well with another correlation of h and f. Of
// these 0.839 ± 0.024 and 0.582 ± 0.010 were said.
BOOST_AUTO_TEST_CASE(beside_a_constant_four_levels_leave_an_order_of_one_open_or_hold_it) {
    struct Law {
        double coarsest, constant;
        int steps;
    };
    for (const Law& law : {Law{0.12353898160213704, 0.1612392563458109, 4},
                           Law{0.2141214615324106, 1.4668035969602838, 3}}) {
        std::vector<ErrorRow> rows;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < law.steps; ++j) {
                const double h = law.coarsest * std::exp2(-i);
                rows.push_back({{h, 0.1 * std::exp2(-j)}, h + law.constant});
            }
        const auto order = estimate_orders(rows)[0];
        BOOST_TEST((!order.determined || holds(order, 1.0)),
                   order.value << " ± " << order.half_width());
    }
}

// exp(−1/(a h)) has no order; that of what stands beside it is in its interval, of 95 %.
BOOST_AUTO_TEST_CASE(what_falls_faster_than_any_power_has_no_order) {
    int determined = 0;
    int missed = 0;
    for (const double a : {4.0, 5.0, 7.0, 7.2, 7.4, 10.0, 14.0})
        for (const double b : {0.1, 0.05, 0.02, 0.01, 1e-4, 1e-6})
            for (const int levels : {4, 5, 6}) {
                if (short_tests && levels != 5)
                    continue;
                std::vector<ErrorRow> rows;
                for (int i = 0; i < levels; ++i)
                    for (const double dt : {0.1, 0.05, 0.025, 0.0125}) {
                        const double h = 0.1 * std::exp2(-i);
                        rows.push_back({{h, dt}, std::exp(-1 / (a * h)) + b * dt});
                    }
                const auto orders = estimate_orders(rows);
                BOOST_TEST(!orders[0].determined, a << ", " << b << ": " << orders[0].value
                                                    << " in " << orders[0].low << " ... "
                                                    << orders[0].high);
                determined += orders[1].determined ? 1 : 0;
                missed += orders[1].determined && !holds(orders[1], 1.0) ? 1 : 0;
            }
    BOOST_TEST(determined > 0);
    BOOST_TEST(missed <= 0.05 * determined, missed << " of " << determined);
}

// Of one of these the order of dt was 0.685 ± 0.305 on one build, and 0.712 ± 0.363 on another: the
// closest model stands 18 % off the rows.
BOOST_AUTO_TEST_CASE(where_no_model_follows_the_rows_no_order_is_determined) {
    std::vector<ErrorRow> rows;
    for (int i = 0; i < 5; ++i)
        for (const double dt : {0.1, 0.05, 0.025, 0.0125})
            rows.push_back(
                {{0.1 * std::exp2(-i), dt}, std::exp(-1 / (1.4 * std::exp2(-i))) + 0.02 * dt});
    OrderTuning tuning;
    BOOST_TEST(!estimate_orders(rows, {}, tuning)[1].determined);
    // Where less is asked of models it is.
    tuning.followed = 1;
    BOOST_TEST(estimate_orders(rows, {}, tuning)[1].determined);
}

BOOST_DATA_TEST_CASE(no_exponential_has_an_order_on_grids_drawn_at_random,
                     data::make({2.0, 1.5, 3.0}) * data::make({true, false}), ratio,
                     has_three_levels) {
    std::mt19937 random(29);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    int given_one = 0;
    for (int k = 0; k < 100; ++k) {
        const double a = between(2, 15);
        const double b = std::pow(10, between(-6, -0.5));
        const double h_0 = between(0.05, 0.25);
        const int q = std::uniform_int_distribution<>(1, 2)(random);
        const int levels = has_three_levels ? 3 : std::uniform_int_distribution<>(4, 6)(random);
        std::vector<ErrorRow> rows;
        for (int i = 0; i < levels; ++i)
            for (int j = 0; j < 4; ++j) {
                const double h = h_0 * std::pow(ratio, -i);
                const double dt = 0.1 * std::pow(ratio, -j);
                rows.push_back({{h, dt}, std::exp(-1 / (a * h)) + b * std::pow(dt, q)});
            }
        if (is_swept(static_cast<std::size_t>(k), 4))
            given_one += estimate_orders(rows)[0].determined ? 1 : 0;
    }
    BOOST_TEST(given_one <= 1);
}

BOOST_DATA_TEST_CASE(no_exponential_has_an_order_beside_two_other_widths,
                     data::make({6.0, 9.5, 13.0}), a) {
    std::vector<ErrorRow> rows;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k) {
                const double h = 0.15 * std::exp2(-i);
                const double dt = 0.1 * std::exp2(-j);
                const double dz = 0.2 * std::exp2(-k);
                rows.push_back({{h, dz, dt}, std::exp(-1 / (a * h)) + 1e-3 * dt * dt + 1e-2 * dz});
            }
    const auto orders = estimate_orders(rows);
    BOOST_TEST(!orders[0].determined,
               orders[0].value << " in " << orders[0].low << " ... " << orders[0].high);
    BOOST_TEST((!orders[1].determined || holds(orders[1], 1.0)));
}

// Terms of opposite sign make local orders rise, too.
BOOST_AUTO_TEST_CASE(an_order_that_cancels_in_part_stays_determined) {
    const auto orders_of = [](double coarsest, const auto& error) {
        std::vector<ErrorRow> rows;
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j) {
                const double h = coarsest * std::exp2(-i);
                const double dt = 0.2 * std::exp2(-j);
                rows.push_back({{h, dt}, std::abs(error(h, dt))});
            }
        return estimate_orders(rows);
    };
    const auto second =
        orders_of(0.48, [](double h, double dt) { return h * h * (1 - 2 * h * h) - 0.2 * dt; });
    BOOST_TEST(second[0].determined);
    BOOST_TEST(holds(second[0], 2.0));
    const auto fourth = orders_of(
        0.32, [](double h, double dt) { return std::pow(h, 4) * (1 - 2 * h) - 2e-4 * dt; });
    BOOST_TEST(fourth[0].determined);
    BOOST_TEST(holds(fourth[0], 4.0));
    const auto sixth =
        orders_of(0.3, [](double h, double dt) { return std::pow(h / 0.3, 6) + 1.1 * dt; });
    BOOST_TEST(sixth[0].determined);
    BOOST_TEST(holds(sixth[0], 6.0));
}

BOOST_DATA_TEST_CASE(a_steep_power_has_its_order_where_three_levels_show_it,
                     data::make({6.0, 8.0, 10.0}) * data::make({1e-8, 1e-12}), p, b) {
    const auto order = [&, p = p, b = b](double coarsest) {
        std::vector<ErrorRow> rows;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                const double h = coarsest * std::exp2(-i);
                rows.push_back({{h, 0.1 * std::exp2(-j)}, std::pow(h, p) + b * std::exp2(-j)});
            }
        return estimate_orders(rows)[0];
    };
    // h^p = 100 b at the third level, and at the second.
    const double seen = std::pow(100 * b, 1 / p);
    BOOST_TEST(order(4 * seen).determined);
    BOOST_TEST(holds(order(4 * seen), p));
    const auto seen_twice = order(2 * seen);
    BOOST_TEST((!seen_twice.determined || holds(seen_twice, p)));
}

BOOST_AUTO_TEST_CASE(a_product_of_both_widths_does_not_pass_for_an_order) {
    const auto orders =
        estimate_orders(grid([](double h, double dt) { return h * h + 0.3 * dt + h * h * dt; }));
    BOOST_TEST((!orders[0].determined || holds(orders[0], 2.0)));
    BOOST_TEST((!orders[1].determined || holds(orders[1], 1.0)));
}

// h^p + c Δt^q/h^s: along lines of one h the errors step with order q, which models with a
// correlation between two terms do not have: 0.658 ± 0.099, 1.323 ± 0.138 and 1.618 ± 0.090.
BOOST_AUTO_TEST_CASE(a_term_that_grows_as_the_other_width_falls_has_no_wrong_order) {
    for (const auto& [p, q, c] :
         {std::tuple{1.0, 1.0, 0.0149}, {1.0, 2.0, 0.25}, {2.0, 2.0, 0.0175}}) {
        std::vector<ErrorRow> rows;
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k) {
                const double h = 0.2 / std::exp2(i);
                const double dt = 0.1 / std::exp2(k);
                rows.push_back({{h, dt}, std::pow(h, p) + c * std::pow(dt, q) / std::sqrt(h)});
            }
        const auto orders = estimate_orders(rows);
        BOOST_TEST((!orders[1].determined || holds(orders[1], q)), "order " << orders[1].value);
        if (!orders[0].determined)
            BOOST_TEST(orders[0].status == orders[1].status);
    }
}

// e² = A² + A B + B², A = 10 h and B = 5 Δt on close levels: steps along lines have an order
// between p and 2p, and models follow to rounding.
BOOST_AUTO_TEST_CASE(steps_of_two_terms_with_a_correlation_speak_against_none) {
    std::vector<ErrorRow> rows;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) {
            const double h = 0.1 / std::pow(1.26, i);
            const double dt = 0.1 / std::pow(1.26, k);
            const double a = 10 * h;
            const double b = 5 * dt;
            rows.push_back({{h, dt}, std::sqrt(a * a + a * b + b * b)});
        }
    for (const auto& order : estimate_orders(rows)) {
        BOOST_TEST(order.determined, order.status);
        BOOST_TEST(holds(order, 1.0));
    }
}

// Next to where |h^p − c h^q| cancels models have orders, of which a quarter was wrong.
BOOST_AUTO_TEST_CASE(errors_that_cancel_near_the_finest_have_no_wrong_order) {
    const auto order = [](double p, double q, double zero, double coarsest, int levels) {
        std::vector<ErrorRow> rows;
        for (int k = 0; k < levels; ++k) {
            const double h = coarsest / std::exp2(k);
            rows.push_back(
                {{h}, std::abs(std::pow(h, p) - std::pow(zero, p - q) * std::pow(h, q))});
        }
        return estimate_orders(rows).front();
    };
    BOOST_TEST(!order(1, 2, 1 / 30.45, 1, 6).determined);
    std::mt19937_64 random(31);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    int determined = 0;
    int missed = 0;
    for (int k = 0; k < (short_tests ? 100 : 600); ++k) {
        const double p = k % 3 == 0 ? 0.5 : k % 3 == 1 ? 1.0 : 2.0;
        const double q = p + (k % 2 == 0 ? 0.5 : 1.0);
        const int levels = 4 + k % 4;
        const double coarsest = std::exp(between(-3.0, 0.0));
        const auto found =
            order(p, q, coarsest * std::exp2(between(-1.0 - levels, 0.0)), coarsest, levels);
        determined += found.determined ? 1 : 0;
        missed += found.determined && (found.low > p || found.high < p) ? 1 : 0;
    }
    BOOST_TEST(determined >= (short_tests ? 10 : 60));
    BOOST_TEST(missed <= 0.05 * determined, missed << " of " << determined);
}

// What lies behind a term of another order shows in how the order from level to level moves: ever
// more. Models of both widths followed the levels, and 80 of 180 orders were wrong.
BOOST_AUTO_TEST_CASE(a_next_term_that_coarse_levels_are_made_of_passes_for_no_order_on_a_grid) {
    struct Law {
        double p, c, q, b;
        int levels;
    };
    const auto orders = [](const Law& law, bool exchanged) {
        std::vector<ErrorRow> rows;
        for (int i = 0; i < law.levels; ++i)
            for (int j = 0; j < 4; ++j) {
                const double h = 0.1 * std::exp2(-i);
                const double dt = 0.04 * std::exp2(-j);
                const double error = std::pow(h, law.p) + law.c * std::pow(h, law.q) + law.b * dt;
                rows.push_back({exchanged ? std::vector{dt, h} : std::vector{h, dt}, error});
            }
        auto found = estimate_orders(rows);
        return exchanged ? found[1] : found[0];
    };
    for (const bool exchanged : {false, true}) {
        for (const Law& law : {Law{4, 1e-4, 2, 0, 5}, Law{2, 3e-3, 1, 1e-9, 5},
                               Law{2, 3e-3, 1, 0, 7}, Law{3, 3e-3, 2, 1e-7, 5}}) {
            const auto order = orders(law, exchanged);
            BOOST_TEST(!order.determined, "h^" << law.p << " + " << law.c << " h^" << law.q << ": "
                                               << order.low << " to " << order.high);
            BOOST_TEST(!order.status.empty());
        }
        // One that the coarsest error is a third of takes nothing away.
        for (const double c : {-5.0, 5.0}) {
            const auto order = orders({2, c, 3, 1e-4, 5}, exchanged);
            BOOST_TEST(order.determined);
            BOOST_TEST(holds(order, 2.0));
        }
    }
}

// Of the beam on meshes that do not resolve what it bends like: order 2 in the end.
BOOST_AUTO_TEST_CASE(a_sequence_whose_orders_turn_at_the_finest_has_none) {
    const double errors[] = {0.44224652848854856, 0.08876740168018997, 0.06079637051440408,
                             0.036934884495953064};
    std::vector<ErrorRow> rows;
    for (std::size_t k = 0; k < std::size(errors); ++k)
        rows.push_back({{0.2 * std::exp2(-static_cast<double>(k))}, errors[k]});
    const auto order = estimate_orders(rows).front();
    BOOST_TEST(!order.determined, order.low << " to " << order.high);
}

// The finest levels of all widths together have no row.
BOOST_AUTO_TEST_CASE(a_grid_without_its_finest_corner_has_orders_or_says_why_not) {
    for (const int levels : {4, 5, 6}) {
        std::vector<ErrorRow> rows;
        for (int i = 0; i < levels; ++i)
            for (int k = 0; k < levels; ++k)
                if (i < levels / 2 || k < levels / 2) {
                    const double h = std::exp2(-i), dt = std::exp2(-k);
                    rows.push_back({{h, dt}, 0.3 * h * h + 0.2 * dt});
                }
        const auto orders = estimate_orders(rows);
        for (const std::size_t k : {0U, 1U})
            BOOST_TEST((orders[k].determined ? orders[k].low <= 2.0 - static_cast<double>(k) &&
                                                   orders[k].high >= 2.0 - static_cast<double>(k)
                                             : !orders[k].status.empty()));
    }
    // Of three widths each refined by itself.
    for (const int levels : {3, 4, 5}) {
        std::vector<ErrorRow> rows{{{1.0, 1.0, 1.0}, 0.9}};
        for (const std::size_t width : {0U, 1U, 2U})
            for (int k = 1; k < levels; ++k) {
                std::vector<double> widths(3, 1.0);
                widths[width] = std::exp2(-k);
                rows.push_back(
                    {widths, 0.3 * widths[0] * widths[0] + 0.4 * widths[1] + 0.2 * widths[2]});
            }
        const auto orders = estimate_orders(rows);
        for (const auto& order : orders) {
            BOOST_TEST(!order.determined);
            BOOST_TEST(order.status.find("refine each two of them apart") != std::string::npos,
                       order.status);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_hidden_term_has_no_order) {
    const auto orders = estimate_orders(
        grid([](double h, double dt) { return h * h * (1 + 0.3 * h) + 1e-7 * dt; }));
    BOOST_TEST(orders[0].determined);
    BOOST_TEST(holds(orders[0], 2.0));
    BOOST_TEST(!orders[1].determined);
    BOOST_TEST(!orders[1].status.empty());
}

BOOST_AUTO_TEST_CASE(an_order_that_cancels_in_part_stays_determined_beside_what_is_hardly_seen) {
    std::vector<ErrorRow> rows;
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k) {
                const double h = 0.4 * std::exp2(-i);
                const double dt = 0.1 * std::exp2(-j);
                const double dz = 0.1 * std::exp2(-k);
                rows.push_back({{h, dz, dt}, std::abs(h * h - 0.2 * dz + 1e-4 * dt)});
            }
    std::mt19937_64 bits(1); // of the last bit half the searches once ended in a false valley
    std::uniform_real_distribution<double> part(-1e-14, 1e-14);
    for (int copy = 0; copy < 4; ++copy) {
        for (auto& row : rows)
            row.error *= 1 + part(bits);
        const auto orders = estimate_orders(rows);
        BOOST_TEST((orders[0].determined && holds(orders[0], 2.0)), orders[0].status);
        BOOST_TEST((orders[1].determined && holds(orders[1], 1.0)), orders[1].status);
        BOOST_TEST((orders[2].determined && holds(orders[2], 1.0)), orders[2].status);
    }
}

// Of four levels an order, a size, a constant and their correlation follow any four numbers: of
// h^3 and h^4 above a constant, 21 of 40 orders were wrong.
BOOST_DATA_TEST_CASE(four_levels_above_a_constant_show_no_wrong_order,
                     data::make({1.0, 2.0, 3.0, 4.0}) * data::make({1e-4, 1e-3, 5e-3}) *
                         data::make({0.1, 0.2, 0.4}),
                     p, constant, h_0) {
    std::vector<ErrorRow> rows;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            const double h = h_0 * std::exp2(-i);
            rows.push_back({{h, 0.1 * std::exp2(-j)}, std::pow(h, p) + constant});
        }
    const auto order = estimate_orders(rows)[0];
    BOOST_TEST((!order.determined || holds(order, p)),
               order.value << " in " << order.low << " ... " << order.high);
}

BOOST_DATA_TEST_CASE(an_order_less_a_constant_stays_determined, data::make({2.0, 3.0}), p) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05, 0.025, 0.0125})
        for (const double dt : {0.1, 0.05, 0.025, 0.0125})
            rows.push_back({{h, dt}, std::abs(std::pow(h, p) - std::pow(0.0123, p))});
    const auto order = estimate_orders(rows)[0];
    BOOST_TEST((order.determined && holds(order, p)), order.status);
}

BOOST_AUTO_TEST_CASE(an_order_of_little_is_no_constant) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05})
        for (const double dt : {0.1, 0.05, 0.025, 0.0125})
            rows.push_back({{h, dt}, h * h + 0.1 * std::pow(dt, 0.15)});
    const auto orders = estimate_orders(rows);
    BOOST_TEST((orders[0].determined && holds(orders[0], 2.0)), orders[0].status);
    BOOST_TEST((orders[1].determined && holds(orders[1], 0.15)), orders[1].status);
}

// What three levels of one width do not tell is of no concern to another of four.
BOOST_AUTO_TEST_CASE(a_width_of_three_levels_takes_no_order_from_another) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05})
        for (const double dt : {0.1, 0.05, 0.025, 0.0125})
            for (const double dz : {0.1, 0.05, 0.025, 0.0125})
                rows.push_back({{h, dz, dt}, h * h + 0.1 * dz + 1e-3});
    const auto orders = estimate_orders(rows);
    BOOST_TEST((orders[1].determined && holds(orders[1], 1.0)), orders[1].status);
    BOOST_TEST((!orders[0].determined || holds(orders[0], 2.0)));
}

// A constant in its place would follow the next term of h as well.
BOOST_DATA_TEST_CASE(a_width_that_no_error_changes_with_takes_nothing_from_the_others,
                     data::make({1.0, 2.0}) * data::make({-3.0, -1.0, 1.0}), p, next) {
    const auto law = [p = p, next = next](double h) { return std::pow(h, p) * (1 + next * h); };
    std::vector<ErrorRow> rows;
    for (const double h : {0.125, 0.0625, 0.03125, 0.015625})
        for (const double dt : {0.1, 0.05, 0.025})
            rows.push_back({{h, dt}, law(h) * (1 + 1e-6 * dt)});
    const auto orders = estimate_orders(rows);
    BOOST_TEST((orders[0].determined && holds(orders[0], p)), orders[0].status);
    BOOST_TEST((!orders[1].determined &&
                orders[1].status == "it changes no error by more than 0.0001 of it"));
    std::vector<ErrorRow> one_step;
    for (std::size_t r = 0; r < rows.size(); r += 3)
        one_step.push_back({{rows[r].widths[0]}, rows[r].error});
    const auto alone = estimate_orders(one_step)[0];
    BOOST_TEST(orders[0].value == alone.value, boost::test_tools::tolerance(1e-5));
    BOOST_TEST(orders[0].half_width() == alone.half_width(), boost::test_tools::tolerance(0.05));
}

// Errors of dt alone, in two digits: they know of h no more than their last one, √12 σ and a
// little.
BOOST_AUTO_TEST_CASE(an_idle_width_is_known_to_the_digits_of_the_errors) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.4, 0.2, 0.1})
        for (const double dt : {0.4, 0.2, 0.1, 0.05})
            rows.push_back({{h, dt}, dt, 0.02});
    BOOST_TEST(estimate_orders(rows)[0].status == "it changes no error by more than 0.07 of it");
}

BOOST_AUTO_TEST_CASE(a_width_is_idle_only_where_the_others_are_finest) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05, 0.025})
        for (const double dt : {0.1, 0.05, 0.025})
            rows.push_back({{h, dt}, h * h + 1e-5 * dt});
    BOOST_TEST(estimate_orders(rows)[1].status != "it changes no error by more than 0.0001 of it");
    // Nor where one step alone is seen with coarser meshes, and may be most of the error there.
    std::vector<ErrorRow> along;
    for (const double h : {0.2, 0.1, 0.05})
        along.push_back({{h, h}, h * h + 1e-5 * h});
    for (const double dt : {0.05, 0.025, 0.0125})
        along.push_back({{0.025, dt}, 0.025 * 0.025 + 1e-7 * dt});
    BOOST_TEST(estimate_orders(along)[1].status != "it changes no error by more than 0.0001 of it");
    // Nor where no two steps are seen with the finest mesh.
    std::erase_if(rows,
                  [](const ErrorRow& row) { return row.widths[0] < 0.1 && row.widths[1] < 0.1; });
    BOOST_TEST(estimate_orders(rows)[1].status != "it changes no error by more than 0.0001 of it");
}

BOOST_AUTO_TEST_CASE(two_widths_have_their_orders_beside_an_idle_third) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05})
        for (const double dz : {0.1, 0.05, 0.025})
            for (const double dt : {0.1, 0.05, 0.025, 0.0125})
                rows.push_back({{h, dz, dt}, h * h + 0.1 * dz});
    const auto orders = estimate_orders(rows);
    BOOST_TEST((orders[0].determined && holds(orders[0], 2.0)), orders[0].status);
    BOOST_TEST((orders[1].determined && holds(orders[1], 1.0)), orders[1].status);
    BOOST_TEST(orders[2].status == "it changes no error by more than 0.0001 of it");
}

BOOST_AUTO_TEST_CASE(three_widths_have_three_orders) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05, 0.025})
        for (const double dt : {0.1, 0.05, 0.025, 0.0125})
            for (const double tolerance : {1e-2, 1e-3, 1e-4})
                rows.push_back({{h, dt, tolerance}, h * h + 0.3 * dt + 2 * std::sqrt(tolerance)});
    const auto orders = estimate_orders(rows);
    BOOST_REQUIRE(orders.size() == 3);
    BOOST_TEST(holds(orders[0], 2.0));
    BOOST_TEST(holds(orders[1], 1.0));
    BOOST_TEST(holds(orders[2], 0.5));
}

BOOST_AUTO_TEST_CASE(one_row_ten_times_out_of_line_moves_no_order) {
    auto rows = grid([](double h, double dt) { return h * h + 0.3 * dt; });
    for (const std::size_t out : {std::size_t{0}, std::size_t{12}, rows.size() - 1}) {
        auto spoilt = rows;
        spoilt[out].error *= 10;
        const auto orders = estimate_orders(spoilt);
        BOOST_TEST((!orders[0].determined || holds(orders[0], 2.0)));
        BOOST_TEST((!orders[1].determined || holds(orders[1], 1.0)));
    }
}

BOOST_AUTO_TEST_CASE(rows_of_nearly_one_width_are_one_piece_of_information) {
    std::vector<ErrorRow> close{{{0.1}, 1.0}, {{0.098}, 0.99}, {{0.096}, 0.91}, {{0.095}, 0.90}};
    const auto order = estimate_orders(close).front();
    BOOST_TEST(!order.determined);
    BOOST_TEST(order.status == "all rows have the same width, or nearly");
    close.push_back({{0.05}, 0.2});
    BOOST_TEST(estimate_orders(close).front().status.find("three widths") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(every_row_doubled_changes_nothing) {
    const auto once = sequence(4, [](double h) { return h * h * (1 + h); });
    auto twice = once;
    twice.insert(twice.end(), once.begin(), once.end());
    const auto of_once = estimate_orders(once).front();
    const auto of_twice = estimate_orders(twice).front();
    BOOST_TEST(std::abs(of_once.low - of_twice.low) < 1e-9);
    BOOST_TEST(std::abs(of_once.high - of_twice.high) < 1e-9);
}

BOOST_AUTO_TEST_CASE(the_order_of_rows_and_the_units_change_nothing) {
    const auto rows =
        grid([](double h, double dt) { return std::hypot(h * h * (1 + h), 0.3 * dt * (1 + dt)); });
    auto other = rows;
    std::reverse(other.begin(), other.end());
    for (auto& row : other) {
        row.widths[0] *= 1000;
        row.error *= 1e-6;
    }
    const auto here = estimate_orders(rows);
    const auto there = estimate_orders(other);
    for (std::size_t i = 0; i < 2; ++i)
        BOOST_TEST(std::abs(here[i].value - there[i].value) < 1e-3 * here[i].half_width() + 1e-6);
}

// What is measured is then h² − h_ref²: without the reference's share the order would rise without
// end.
BOOST_AUTO_TEST_CASE(the_error_of_a_reference_is_part_of_the_model) {
    const double finest = 0.2 / 64;
    const auto rows = sequence(5, [finest](double h) { return h * h - finest * finest; });
    const auto order = estimate_orders(rows, {finest}).front();
    BOOST_TEST(order.determined);
    BOOST_TEST(holds(order, 2.0));
    BOOST_TEST(order.half_width() < 2 * OrderTuning{}.narrowest);
}

// Errors of interpolation oscillate in every element: the reference's, four times finer, stands at
// right angles to what is measured, of first order e² − e_ref². Taken off as it is, 9 of 30 such
// orders were missed.
BOOST_DATA_TEST_CASE(orders_hold_however_the_error_of_a_reference_is_part_of_what_is_measured,
                     data::make({1.0, 2.0}) * data::make({1.0, 2.0}) * data::make({false, true}) *
                         data::make({-0.5, 0.0, 0.8}),
                     p, q, is_orthogonal, rho) {
    const auto in_space = [&](double h) { return std::pow(h, p) * (1 + 0.3 * h); };
    const auto in_time = [&](double dt) { return 0.5 * std::pow(dt, q) * (1 + 0.2 * dt); };
    const double finest = 0.2 / 64;
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05, 0.025, 0.0125})
        for (const double dt : {0.2, 0.1, 0.05, 0.025, 0.0125}) {
            const double space =
                is_orthogonal ? std::sqrt(std::pow(in_space(h), 2) - std::pow(in_space(finest), 2))
                              : in_space(h) - in_space(finest);
            const double time = in_time(dt) - in_time(finest);
            rows.push_back(
                {{h, dt}, std::sqrt(space * space + 2 * rho * space * time + time * time)});
        }
    const auto orders = estimate_orders(rows, {finest, finest});
    for (const auto& [order, truth] : {std::pair(orders[0], p), std::pair(orders[1], q)}) {
        BOOST_TEST(order.determined, order.status);
        BOOST_TEST(holds(order, truth), order.value << " ± " << order.half_width());
        BOOST_TEST(order.half_width() < 0.15);
    }
    // Of what is measured, so that a term is no more than all of it.
    if (rho == 0.0 && !is_orthogonal)
        BOOST_TEST(std::max(orders[0].share, orders[1].share) <= 1.05);
}

// Three levels of each width: models agree by chance, and 18 of 31 orders were missed where the
// steadier way to take the reference off counted alone.
BOOST_DATA_TEST_CASE(on_three_levels_an_order_against_a_reference_is_held_or_not_determined,
                     data::make({false, true}), is_orthogonal) {
    Count count;
    for (const double c : {-0.7, -0.3, 0.1, 0.5, 0.9})
        for (const double rho : {-0.4, 0.0, 0.4}) {
            const auto in_space = [&](double h) { return h * (1 + c * h); };
            const auto in_time = [](double dt) { return 0.5 * dt * (1 - 0.2 * dt); };
            std::vector<ErrorRow> rows;
            for (const double h : {0.2, 0.1, 0.05})
                for (const double dt : {0.2, 0.1, 0.05}) {
                    const double there = in_space(0.05 / 8);
                    const double space = is_orthogonal
                                             ? std::sqrt(std::pow(in_space(h), 2) - there * there)
                                             : in_space(h) - there;
                    const double time = in_time(dt) - in_time(0.05 / 4);
                    rows.push_back(
                        {{h, dt}, std::sqrt(space * space + 2 * rho * space * time + time * time)});
                }
            for (const auto& order : estimate_orders(rows, {0.05 / 8, 0.05 / 4}))
                count.add(order, 1.0);
        }
    BOOST_TEST(count.missed <= 0.05 * count.determined, count.missed << " of " << count.determined);
}

// The inner product of the terms, of order 4 in h, is all that the errors show of h³: its order was
// determined as 4.0 ± 0.3, twice.
BOOST_DATA_TEST_CASE(an_order_that_one_inner_product_alone_shows_against_a_reference_is_hidden,
                     data::make({0.3, 0.6, 1.0}), part) {
    const auto in_time = [](double dt) { return 0.2 * dt * (1 - 0.3 * dt); };
    const double finest = 1.0 / 256;
    std::vector<ErrorRow> rows;
    for (const double h : {1.0 / 4, 1.0 / 8, 1.0 / 16, 1.0 / 32, 1.0 / 64})
        for (const double dt : {0.05, 0.025, 0.0125, 0.00625, 0.003125}) {
            const double time = in_time(dt) - in_time(0.00078125);
            const double space = 1.1e-3 * part * (std::pow(h, 3) - std::pow(finest, 3));
            const double product = -3.6e-4 * part * (std::pow(h, 4) - std::pow(finest, 4));
            rows.push_back({{h, dt}, std::sqrt(space * space + 2 * product * time + time * time)});
        }
    const auto orders = estimate_orders(rows, {finest, 0.00078125});
    BOOST_TEST(!orders[0].determined, orders[0].value << " ± " << orders[0].half_width());
    BOOST_TEST((orders[1].determined && holds(orders[1], 1.0)));
}

BOOST_DATA_TEST_CASE(a_great_order_is_determined_against_a_reference,
                     data::make({4.0, 9.0, 11.0, 12.0}), p) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.5, 0.4, 0.3, 0.25, 0.2})
        for (const double dt : {0.1, 0.05, 0.025, 0.0125})
            rows.push_back(
                {{h, dt},
                 std::hypot(50 * (std::pow(h, p) - std::pow(0.1, p)), 1e-4 * (dt - 0.001))});
    const auto order = estimate_orders(rows, {0.1, 0.001})[0];
    BOOST_TEST((order.determined && holds(order, p)), order.status);
}

BOOST_AUTO_TEST_CASE(a_forecast_holds_what_finer_runs_give) {
    const auto error = [](double h, double dt) {
        const double space = h * h * (1 + 0.5 * h * h);
        const double time = 0.3 * dt * (1 + 0.2 * dt);
        return std::sqrt(space * space - 1.8 * space * time + time * time);
    };
    const OrderEnsemble ensemble(grid(error));
    for (const auto& [h, dt] : {std::pair{0.00625, 0.003125}, {0.003, 0.001}, {0.0125, 0.0001}}) {
        const auto forecast = ensemble.forecast({h, dt});
        BOOST_TEST(forecast.determined);
        BOOST_TEST(holds(forecast, error(h, dt)), "at h = " << h << ", dt = " << dt);
        BOOST_TEST(forecast.high < 1.5 * forecast.low);
    }
}

// h² |ln h|: its order stands still beside the logarithm, and no other model's does. A next term is
// no logarithm.
BOOST_AUTO_TEST_CASE(a_logarithm_is_known_from_a_next_term) {
    const OrderEnsemble with(sequence(7, [](double h) { return -h * h * std::log(h); }));
    BOOST_TEST(with.has_logarithm());
    BOOST_TEST(holds(with.orders().front(), 2.0));
    BOOST_TEST(
        !OrderEnsemble(sequence(7, [](double h) { return h * h * (1 + h); })).has_logarithm());
    BOOST_TEST(!OrderEnsemble(sequence(7, [](double h) { return h * h; })).has_logarithm());
    BOOST_TEST(!OrderEnsemble(sequence(7, [](double h) {
                    return h * h * (1 + 3 * std::pow(h, 0.3));
                })).has_logarithm());
}

// Scatter lets the order of one model stand still by chance, the more easily the fewer the levels.
BOOST_AUTO_TEST_CASE(scatter_is_no_logarithm) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-0.05, 0.05);
    int found = 0;
    for (int i = 0; i < 100; ++i)
        for (const int levels : {5, 6, 7})
            found += OrderEnsemble(sequence(levels, [&](double h) {
                         return h * h * (1 + off(random));
                     })).has_logarithm();
    BOOST_TEST(found <= 3);
}

// ln e of two rows a width, off by δ and −4δ with the deviations σ and 2σ: weighted with 4 to 1, as
// 1/σ² does it, their mean is on the line.
BOOST_AUTO_TEST_CASE(rows_of_one_width_weigh_as_their_deviations_say) {
    std::vector<ErrorRow> rows;
    double off = 0.02;
    for (const auto& row : sequence(6, [](double h) { return h * h; })) {
        rows.push_back({row.widths, row.error * std::exp(off), 0.02});
        rows.push_back({row.widths, row.error * std::exp(-4 * off), 0.04});
        off = -off;
    }
    BOOST_TEST(std::abs(estimate_orders(rows).front().value - 2) < 1e-6);
}

BOOST_AUTO_TEST_CASE(what_does_not_converge_is_said_to_grow_or_to_stand_still) {
    const auto status = [](int levels, const std::function<double(double)>& error) {
        return estimate_orders(sequence(levels, error)).front().status;
    };
    BOOST_TEST(status(5, [](double h) { return 1 / h; }) ==
               "the error grows under refinement, order -1.00");
    for (int levels = 3; levels <= 6; ++levels)
        BOOST_TEST(status(levels, [](double) { return 0.1; }) == "the error stands still");
    // Its last error is 30 % below the one before.
    BOOST_TEST(status(5, [](double h) { return 2 * h * h + 0.0019; }) == "the error levels off");
}

// 90 000 rows on a grid of 300 by 300 widths: averaged over cells of a lattice, they show the
// orders.
BOOST_AUTO_TEST_CASE(very_many_rows_have_the_orders_of_few) {
    std::vector<ErrorRow> rows;
    for (int i = 0; i < 300; ++i)
        for (int k = 0; k < 300; ++k) {
            const double h = 0.2 * std::exp(-0.01 * i);
            const double dt = 0.1 * std::exp(-0.01 * k);
            rows.push_back({{h, dt}, h * h + 0.3 * dt});
        }
    const auto orders = estimate_orders(rows);
    BOOST_TEST(orders[0].determined);
    BOOST_TEST(orders[1].determined);
    BOOST_TEST(holds(orders[0], 2.0));
    BOOST_TEST(holds(orders[1], 1.0));
}

BOOST_AUTO_TEST_CASE(without_a_positive_error_the_status_says_so) {
    BOOST_TEST(
        estimate_orders(std::vector<ErrorRow>{{{0.1}, 0.0}, {{0.05}, NAN}, {{0.025}, INFINITY}})
            .front()
            .status == "no row has a positive error");
}

// Of order 2 with a scatter of 3 or 10 % that is stated. Without it, one in five was said to rise
// or to fall; the interval holds 2 as often as 95 % can be told from 60 tables.
BOOST_AUTO_TEST_CASE(what_stated_scatter_makes_of_an_order_is_no_motion) {
    std::mt19937 random(7);
    std::normal_distribution<double> off(0.0, 1.0);
    int moves = 0;
    int missed = 0;
    int determined = 0;
    for (int table = 0; table < 60; ++table) {
        const double sigma = table % 2 == 0 ? 0.03 : 0.1;
        const int levels = 4 + table % 3;
        std::vector<ErrorRow> rows;
        rows.reserve(static_cast<std::size_t>(levels));
        for (int k = 0; k < levels; ++k)
            rows.push_back(
                {{std::exp2(-k)}, std::exp2(-2 * k) * std::exp(sigma * off(random)), sigma});
        const auto order = estimate_orders(rows).front();
        moves += order.status.starts_with("rising") || order.status.starts_with("falling") ? 1 : 0;
        determined += order.determined ? 1 : 0;
        missed += order.determined && std::abs(order.value - 2) > order.half_width() ? 1 : 0;
    }
    BOOST_TEST(moves <= 4);
    BOOST_TEST(determined >= 35);
    BOOST_TEST(missed <= 2);
    // A motion that is more than the scatter is told.
    constexpr int levels_of_bent = 5;
    std::vector<ErrorRow> bent;
    bent.reserve(levels_of_bent);
    for (int k = 0; k < levels_of_bent; ++k)
        bent.push_back({{std::exp2(-k)}, std::exp2(-2 * k - 0.3 * k * k), 0.02});
    BOOST_TEST(estimate_orders(bent).front().status.starts_with("it rises"));
}

// h^p + b h^q with 1 % of scatter, which may hide the drift of the order: where that was taken for
// none, 16 % of the intervals missed. Twice the standard error of 95 % in as many is allowed.
BOOST_AUTO_TEST_CASE(drift_that_stated_scatter_may_hide_is_in_the_interval) {
    std::mt19937 random(19);
    std::normal_distribution<double> off(0.0, 1.0);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    constexpr double sigma = 0.01;
    int missed = 0;
    int determined = 0;
    for (int table = 0; table < 300; ++table) {
        const double p = table % 3 == 0 ? 1.0 : table % 3 == 1 ? 2.0 : 0.5 + 3.5 * uniform(random);
        const double q = p + std::exp2(table % 4 / 2 - 1); // nearer by ½ or 1
        const double b = (table % 2 == 0 ? 1 : -1) * (0.1 + 0.9 * uniform(random));
        const double coarsest = 0.2 + 0.6 * uniform(random);
        std::vector<ErrorRow> rows;
        for (const double width : {1.0, 0.7, 0.45, 0.31, 0.2, 0.14}) {
            const double h = coarsest * width;
            rows.push_back({{h},
                            (std::pow(h, p) + b * std::pow(h, q)) * std::exp(sigma * off(random)),
                            sigma});
            if (rows.size() == static_cast<std::size_t>(3 + table % 4))
                break;
        }
        const auto order = estimate_orders(rows).front();
        determined += order.determined ? 1 : 0;
        missed += order.determined && std::abs(order.value - p) > order.half_width() ? 1 : 0;
    }
    BOOST_TEST(determined >= 150);
    BOOST_TEST(missed <= 0.05 * determined + 2 * std::sqrt(0.05 * 0.95 * determined));
    BOOST_TEST_MESSAGE(missed << " of " << determined);
}

// Laws x^p (1 + c x) + b y^q (1 + d y) with |c|, |d| ≤ 0.4, printed with six digits, of which a
// grid has three levels in one width or in both. Before this was looked at, of those determined 40
// to 75 % missed; of four levels hardly any do.
BOOST_AUTO_TEST_CASE(of_three_levels_in_a_width_of_a_grid_the_interval_holds_as_of_more) {
    std::mt19937 generator(20261125);
    const auto uniform = uniform_from(generator);
    int determined = 0;
    int missed = 0;
    for (int table = 0; table < 120; ++table) {
        const double p = 1 + table % 3;
        const double q = 1 + table % 2;
        const double c = uniform(-0.4, 0.4);
        const double d = uniform(-0.4, 0.4);
        const double b = std::pow(10, uniform(-1, 1));
        const std::pair<int, int> sizes[] = {{3, 3}, {5, 3}, {3, 5}, {4, 3}};
        const auto [meshes, steps] = sizes[table % 4];
        std::vector<ErrorRow> rows;
        for (int i = 0; i < meshes; ++i)
            for (int j = 0; j < steps; ++j) {
                const double x = std::exp2(-i);
                const double y = std::exp2(-j);
                rows.push_back(
                    {{x, y}, std::pow(x, p) * (1 + c * x) + b * std::pow(y, q) * (1 + d * y)});
            }
        const auto orders = estimate_orders(rows);
        for (const auto& [order, truth] : {std::pair{orders[0], p}, {orders[1], q}}) {
            determined += order.determined ? 1 : 0;
            missed += order.determined && !holds(order, truth) ? 1 : 0;
        }
    }
    BOOST_TEST(determined >= 60);
    BOOST_TEST(20 * missed <= 2 * determined);
}

// Three levels in one width, and a term of the other that is hardly seen: a constant in its place
// bends the error as a next term does, and 36 % of the orders determined were wrong.
BOOST_DATA_TEST_CASE(of_three_levels_a_constant_does_not_pass_for_a_next_term,
                     data::make({2.0, 1.5}), ratio) {
    std::mt19937 generator(20261127);
    const auto uniform = uniform_from(generator);
    constexpr int tables = 80;
    int determined = 0;
    int missed = 0;
    for (int table = 0; table < tables; ++table) {
        const double p = 1 + table % 3;
        const double q = 1 + table % 2;
        const double c = uniform(-2, 2);
        const double b = std::pow(10, uniform(-6, -0.5));
        const double h_0 = uniform(0.05, 0.25);
        std::vector<ErrorRow> rows;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 4; ++j) {
                const double h = h_0 * std::pow(ratio, -i);
                const double dt = 0.1 * std::pow(ratio, -j);
                rows.push_back({{h, dt}, std::pow(h, p) * (1 + c * h) + b * std::pow(dt, q)});
            }
        const auto order = estimate_orders(rows)[0];
        determined += order.determined ? 1 : 0;
        missed += order.determined && !holds(order, p) ? 1 : 0;
    }
    BOOST_TEST(determined >= 0.4 * tables);
    BOOST_TEST(missed <= 0.05 * determined, missed << " of " << determined);
}

// Powers alone, on three levels each: nothing moves, and both orders are known.
BOOST_AUTO_TEST_CASE(of_three_levels_in_each_width_powers_alone_are_known) {
    std::vector<ErrorRow> rows;
    for (const double h : {0.2, 0.1, 0.05})
        for (const double dt : {0.1, 0.05, 0.025})
            rows.push_back({{h, dt}, h * h + 0.3 * dt});
    const auto orders = estimate_orders(rows);
    BOOST_TEST(orders[0].determined);
    BOOST_TEST(orders[1].determined);
    BOOST_TEST(orders[0].half_width() < 0.05);
    BOOST_TEST(orders[1].half_width() < 0.05);
}

namespace {

/// As it is printed to so many digits, with what that leaves unknown of it.
ErrorRow printed(double width, double error, int digits) {
    const double unit = std::pow(10.0, std::floor(std::log10(error)) + 1 - digits);
    const double value = unit * std::round(error / unit);
    return {{width}, value, unit / value / std::sqrt(12.0), true};
}

/// h^p + b h^q, the next term so large a part of the leading one on the finest of halved widths.
std::vector<ErrorRow> printed_law(double p, double q, double part, std::size_t levels,
                                  double coarsest, int digits) {
    const double finest = coarsest * std::exp2(1 - static_cast<double>(levels));
    const double b = part / std::pow(finest, q - p);
    std::vector<ErrorRow> rows;
    for (std::size_t k = 0; k < levels; ++k) {
        const double h = coarsest * std::exp2(-static_cast<double>(k));
        rows.push_back(printed(h, std::pow(h, p) + b * std::pow(h, q), digits));
    }
    return rows;
}

} // namespace

// Of the first nine laws' 672 that are determined 360 missed when the digits alone hid that an
// order moves: 51 of those in three digits with a next term half an order on, 174 with one a third
// or a quarter of an order on.
BOOST_AUTO_TEST_CASE(digits_that_hide_how_an_order_moves_leave_open_what_it_goes_to) {
    struct Law {
        double p, q;
        int digits;
        double determined; // part of all
    };
    constexpr Law laws[] = {{1, 1.5, 2, 0.5},
                            {2, 2.5, 2, 0.5},
                            {1, 2, 2, 0},
                            {2, 3, 2, 0},
                            {1, 1.5, 3, 0.5},
                            {2, 2.5, 3, 0.5},
                            {2.0 / 3, 1, 3, 0.5},
                            {0.75, 1, 3, 0.5},
                            {5.0 / 3, 2, 3, 0.5},
                            // Between the next terms that are looked at.
                            {1, 1.3, 3, 0.5},
                            {2, 2.37, 3, 0.3},
                            {1, 1.43, 3, 0.3},
                            {1.5, 2.1, 3, 0}};
    int all_determined = 0;
    int missed = 0;
    for (const auto& [p, q, digits, part] : laws) {
        int asked = 0;
        int determined = 0;
        for (const std::size_t levels : {4U, 5U, 6U, 8U})
            for (int k = 0; k < 30; k += short_tests ? 3 : 1) {
                const auto rows = printed_law(p, q, 0.1 + 0.03 * k, levels, 1.0 / (16 + k), digits);
                const auto order = estimate_orders(rows).front();
                ++asked;
                determined += order.determined ? 1 : 0;
                missed += order.determined && !(order.low <= p && p <= order.high) ? 1 : 0;
            }
        BOOST_TEST_CONTEXT("h^" << p << " beside h^" << q << " in " << digits
                                << " digits: " << determined << " of " << asked)
        BOOST_TEST(determined >= part * asked);
        all_determined += determined;
    }
    BOOST_TEST_MESSAGE(missed << " of " << all_determined);
    BOOST_TEST(missed <= 0.05 * all_determined);
}

BOOST_AUTO_TEST_CASE(a_power_alone_is_determined_in_few_digits) {
    for (const int digits : {2, 3})
        for (const double p : {1.0, 1.5, 2.0, 3.0})
            for (const std::size_t levels : {4U, 5U, 6U}) {
                int determined = 0;
                double half = 0;
                constexpr int tables = 20;
                for (int k = 0; k < tables; ++k) {
                    const auto order =
                        estimate_orders(printed_law(p, p + 1, 0, levels, 1.0 / (16 + k), digits))
                            .front();
                    determined += order.determined ? 1 : 0;
                    half += order.determined ? order.half_width() : 0.0;
                    BOOST_TEST((!order.determined || (order.low <= p && p <= order.high)));
                }
                BOOST_TEST(determined >= (digits > 2   ? tables
                                          : levels > 4 ? 0.85 * tables
                                                       : 0.7 * tables));
                BOOST_TEST(half <= (digits > 2 ? 0.15 : 0.4) * determined);
            }
}

// The order of h² + 0.03 h, which three digits show to fall at each step: that it was said to be
// 1.78 ± 0.47 beside them, and not determined with four, was the digits' doing.
BOOST_AUTO_TEST_CASE(an_order_that_moves_beyond_its_digits_is_not_determined) {
    const std::vector<double> errors{1.00e-1, 2.54e-2, 6.56e-3, 1.74e-3, 4.86e-4, 1.47e-4, 4.95e-5};
    std::vector<ErrorRow> rows;
    for (std::size_t k = 0; k < errors.size(); ++k)
        rows.push_back(printed(std::exp2(-4 - static_cast<double>(k)), errors[k], 3));
    const auto order = estimate_orders(rows).front();
    BOOST_TEST(!order.determined);
    BOOST_TEST(order.status == "it falls over finer windows, to 1.57");
}

BOOST_AUTO_TEST_SUITE_END()

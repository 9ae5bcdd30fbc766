// The limit of a sequence of values: published examples of the named methods, and what the one
// answer owes its users.

#include "studies/orders/limit_engine.hpp"
#include "tests/this_build.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(limit_engine)

namespace {

std::vector<ValueRow> sequence(int levels, const std::function<double(double)>& value) {
    std::vector<ValueRow> rows;
    rows.reserve(static_cast<std::size_t>(levels));
    for (int k = 0; k < levels; ++k)
        rows.push_back({std::exp2(-k), value(std::exp2(-k))});
    return rows;
}

bool holds(const OrderInterval& interval, double truth) {
    return interval.low <= truth && truth <= interval.high;
}

} // namespace

// NASA Glenn, "Examining spatial (grid) convergence": order 1.786, limit 0.97130, GCI 0.1031 % of
// the finest value.
BOOST_AUTO_TEST_CASE(the_grid_convergence_index_is_that_of_the_tutorial) {
    const auto limit =
        estimate_limit(std::vector<ValueRow>{{4, 0.96178}, {2, 0.96854}, {1, 0.97050}});
    BOOST_REQUIRE(limit.gci.has_value());
    BOOST_TEST(std::abs(limit.gci->order - 1.786170) < 5e-7);
    BOOST_TEST(std::abs(limit.gci->limit - 0.97130) < 5e-6);
    BOOST_TEST(std::abs(limit.gci->uncertainty / 0.97050 - 0.00103083) < 5e-8);
    BOOST_TEST(holds(limit.limit, 0.97130));
}

// Where a method has no figures, it says why: of values that oscillate, one that takes signs.
BOOST_AUTO_TEST_CASE(a_method_without_figures_says_why) {
    const std::vector<ValueRow> oscillating{{8, 1.0}, {4, 1.2}, {2, 1.1}, {1, 1.3}};
    const auto silence = [&](std::size_t first, const auto& method) {
        return method(std::span(oscillating).subspan(first)).silence;
    };
    BOOST_TEST(silence(0, gci_of) == "the three finest values oscillate, stand still or run apart");
    BOOST_TEST(silence(0, celik_of) == "the steps between the three finest values grow");
    BOOST_TEST(silence(0, eca_hoekstra_of) == "");
    BOOST_TEST(silence(1, eca_hoekstra_of) == "it takes four levels");
    BOOST_TEST(silence(2, gci_of) == "it takes three levels");
    BOOST_TEST(silence(2, celik_of) == "it takes three levels");
    BOOST_TEST(celik_of(std::vector<ValueRow>{{4, 2}, {2, 1}, {1, 1}}).silence ==
               "two of the three finest values are the same");
    BOOST_TEST(gci_of(std::vector<ValueRow>{{4, 3}, {2, 2}, {1, 1}}).silence ==
               "the steps between the three finest values are all but the same");
    const auto same =
        estimate_limit(std::vector<ValueRow>{{4, 1.5, 0.1}, {2, 1.5, 0.1}, {1, 1.5, 0.1}});
    BOOST_TEST(same.limit.determined);
    BOOST_TEST(same.gci.silence == "the values stand still");
}

// h^7 on three grids: the order of no common method, so that the index takes the factor of two
// grids and the order 4. f_2 − f_1 = 127/128² of the coarse error.
BOOST_AUTO_TEST_CASE(an_order_that_no_method_has_is_given_the_factor_of_two_grids) {
    const auto gci = gci_of(sequence(3, [](double h) { return 1 + std::pow(h, 7); }));
    BOOST_REQUIRE(gci.has_value());
    BOOST_TEST(std::abs(gci->order - 7) < 1e-6);
    const double step = std::exp2(-7) - std::exp2(-14);
    BOOST_TEST(std::abs(gci->uncertainty / (3 * step / 15) - 1) < 1e-9);
}

// The limit of f = f_0 + C h² with known scatter σ has at least the standard deviation that linear
// least squares gives it where the order is known: here 1 + h² with h² = 4^-k, in closed form.
// Values that happen to lie on the curve know no better.
BOOST_AUTO_TEST_CASE(a_limit_is_no_better_known_than_its_values_scatter) {
    constexpr double sigma = 0.01;
    const auto exact = [](double h) { return 1 + h * h; };
    auto stated = sequence(6, exact);
    double n = 0, sum = 0, squares = 0;
    std::vector<ValueRow> replicates;
    for (auto& row : stated) {
        const double x = row.h * row.h;
        n += 1, sum += x, squares += x * x;
        for (const double off : {-sigma, sigma})
            replicates.push_back({row.h, row.value + off});
        row.sigma = sigma;
    }
    const double least = 1.96 * sigma * std::sqrt(squares / (n * squares - sum * sum));
    BOOST_TEST(estimate_limit(sequence(6, exact)).limit.half_width() < least);
    for (const auto& rows : {stated, replicates}) {
        const auto found = estimate_limit(rows);
        BOOST_TEST(found.limit.determined);
        BOOST_TEST(holds(found.limit, 1.0));
        BOOST_TEST(found.limit.half_width() >= least);
    }
}

// The mean of n values of the deviation σ has σ/√n.
BOOST_AUTO_TEST_CASE(values_of_a_width_with_stated_deviations_are_their_mean) {
    constexpr int n = 4;
    const auto once = sequence(5, [](double h) { return 7 + h * h; });
    std::vector<ValueRow> means;
    std::vector<ValueRow> rows;
    for (auto row : once) {
        row.sigma = 0.01;
        rows.insert(rows.end(), n, row);
        row.sigma /= std::sqrt(n);
        means.push_back(row);
    }
    const auto of_rows = estimate_limit(rows).limit;
    const auto of_means = estimate_limit(means).limit;
    BOOST_TEST(of_rows.low == of_means.low, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(of_rows.high == of_means.high, boost::test_tools::tolerance(1e-9));
}

// The steps 0.001 and 0.002 grow, so that no limit is in sight; where each value is only known to
// 0.01, a difference of two has the deviation 0.014, of which neither step is three times.
BOOST_AUTO_TEST_CASE(values_that_differ_by_less_than_their_scatter_take_no_steps) {
    std::vector<ValueRow> rows{{4, 1.000}, {2, 1.001}, {1, 1.003}};
    BOOST_TEST(estimate_limit(rows).limit.status == "the steps between the values do not shrink");
    for (auto& row : rows)
        row.sigma = 0.01;
    BOOST_TEST(estimate_limit(rows).limit.status != "the steps between the values do not shrink");
}

// Celik et al. (2008), Table 1: orders 1.53, 0.75 and, oscillating, 1.51; cells of a plane, so that
// h is N^-1/2.
BOOST_AUTO_TEST_CASE(the_orders_of_celik_are_those_of_his_table) {
    const auto order = [](const std::vector<double>& cells, const std::vector<double>& values) {
        std::vector<ValueRow> rows;
        for (std::size_t i = 0; i < 3; ++i)
            rows.push_back({1 / std::sqrt(cells[i]), values[i]});
        return celik_of(rows)->order;
    };
    BOOST_TEST(std::abs(order({4500, 8000, 18000}, {5.863, 5.972, 6.063}) - 1.53) < 0.005);
    BOOST_TEST(std::abs(order({980, 4500, 18000}, {10.6050, 10.7250, 10.7880}) - 0.75) < 0.005);
    BOOST_TEST(std::abs(order({980, 4500, 18000}, {6.0909, 5.9624, 6.0042}) - 1.51) < 0.005);
}

// f = 1 + h^p on widths whose ratios differ, 3 and then 2: the limit is f_1 − (f_2 − f_1)/(2^p −
// 1), with the ratio of the pair that it is extrapolated from, and the order is p.
BOOST_AUTO_TEST_CASE(celik_extrapolates_with_the_ratio_of_the_fine_pair) {
    for (const double p : {0.75, 1.0, 2.0}) {
        std::vector<ValueRow> rows;
        for (const double h : {6.0, 2.0, 1.0})
            rows.push_back({h, 1 + 0.01 * std::pow(h, p)});
        const auto found = celik_of(rows);
        BOOST_REQUIRE(found.has_value());
        BOOST_TEST(std::abs(found->order - p) < 1e-6);
        BOOST_TEST(std::abs(found->limit - 1.0) < 1e-8);
    }
}

// Tables on which the iteration goes round in circles: what was reported solved no equation. The
// three values determine f0 + C h^p, of orders 1.12994 and 0.946; oscillating, 4.504.
BOOST_AUTO_TEST_CASE(an_order_of_celik_solves_his_equation_or_is_none) {
    const auto order = [](const std::vector<double>& widths, const std::vector<double>& values) {
        std::vector<ValueRow> rows;
        for (std::size_t i = 0; i < 3; ++i)
            rows.push_back({widths[i], values[i]});
        const auto found = celik_of(rows);
        return found ? std::optional(found->order) : std::nullopt;
    };
    BOOST_TEST(std::abs(order({9, 3, 2}, {1.11311, 1.03941, 1.0284}).value() - 1.12994) < 1e-4);
    BOOST_TEST(std::abs(order({9, 3, 2}, {1.1192, 1.02299, 1.00622}).value() - 0.946) < 1e-3);
    BOOST_TEST(std::abs(order({9, 3, 2}, {1.0545, 1.04106, 1.04117}).value() - 4.504) < 1e-3);
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> step(0.1, 10);
    std::uniform_real_distribution<double> ratio(1.2, 3);
    int known = 0;
    for (int table = 0; table < 300; ++table) {
        const double r21 = ratio(generator);
        const double r32 = ratio(generator);
        const double e21 = step(generator) * (table % 4 == 0 ? -1 : 1);
        const double e32 = step(generator);
        const auto p = order({r21 * r32, r21, 1}, {e21 + e32, e21, 0});
        if (!p)
            continue;
        ++known;
        const double sign = e21 < 0 ? -1 : 1;
        const double rest = std::log(e32 / std::abs(e21)) +
                            std::log((std::pow(r21, *p) - sign) / (std::pow(r32, *p) - sign));
        BOOST_TEST(std::abs(rest / std::log(r21) - *p) < 1e-7 * std::max(1.0, *p));
    }
    BOOST_TEST(known > 150); // the others grow
}

// 1.3, 1.2, 1.1 go on by the same steps: of the order zero, which extrapolates nowhere.
BOOST_AUTO_TEST_CASE(of_equal_steps_celik_has_no_limit) {
    BOOST_TEST(!celik_of(std::vector<ValueRow>{{0.4, 1.3}, {0.2, 1.2}, {0.1, 1.1}}).has_value());
    BOOST_TEST(!celik_of(std::vector<ValueRow>{{0.4, 0.7}, {0.2, 0.8}, {0.1, 0.9}}).has_value());
}

// Steps of one unit each, five of them: together no rounding. Two may be those of 1.26, 1.18, 1.14.
BOOST_AUTO_TEST_CASE(values_that_go_on_by_units_have_no_limit) {
    const auto limit_of = [](int levels) {
        std::vector<ValueRow> rows;
        for (int k = 0; k < levels; ++k)
            rows.push_back({std::exp2(-k), 1.0 + k, std::numeric_limits<double>::quiet_NaN(), 1.0});
        return estimate_limit(rows).limit;
    };
    BOOST_TEST(limit_of(6).status == "the steps between the values do not shrink");
    BOOST_TEST(limit_of(3).status != "the steps between the values do not shrink");
}

// Steps of h^p − D h^q grow from their zero while h falls by 2 (p = 1, q = 2) or 4 (1/2, 1), and by
// one ratio more at most.
BOOST_AUTO_TEST_CASE(values_whose_steps_grow_further_than_two_powers_can_run_apart) {
    const auto limit_of = [](const std::vector<double>& values, double ratio) {
        std::vector<ValueRow> rows;
        for (std::size_t k = 0; k < values.size(); ++k)
            rows.push_back({std::pow(ratio, -static_cast<double>(k)), values[k]});
        return estimate_limit(rows).limit;
    };
    const std::vector<double> apart{3.0, 2.9, 2.95, 3.02, 3.12, 3.26, 3.47};
    BOOST_TEST(limit_of(apart, 2.0).status == "the values run apart");
    for (const auto& [p, q] : {std::pair{1.0, 2.0}, {0.5, 1.0}, {1.0, 3.0}})
        for (const double ratio : {1.5, 2.0, 3.0, 4.0, 10.0})
            for (double turn = 0.95; turn > 0.05; turn *= short_tests ? 0.5 : 0.93) {
                std::vector<double> values;
                for (int k = 0; k < 8; ++k) {
                    const double h = std::pow(ratio, -k);
                    values.push_back(1.0 + std::pow(h, p) -
                                     p / q * std::pow(turn, p - q) * std::pow(h, q));
                    // Those that go one way from the first on may.
                    if (k < 3 || (values[1] - values[0]) * (values[3] - values[2]) > 0)
                        continue;
                    BOOST_TEST(limit_of(values, ratio).status != "the values run apart",
                               p << ' ' << q << ' ' << ratio << ' ' << turn << ' ' << k);
                }
            }
}

BOOST_AUTO_TEST_CASE(widths_that_hardly_differ_have_no_limit) {
    // 0.1 and 0.0999 are one width.
    BOOST_TEST(
        !estimate_limit(std::vector<ValueRow>{{0.1, 1.01}, {0.0999, 1.00998}, {0.05, 1.0025}})
             .limit.determined);
    for (const auto& [ratio, levels] : {std::pair{1.01, 8}, {1.03, 4}, {1.05, 3}}) {
        std::vector<ValueRow> rows;
        for (int k = 0; k < levels; ++k) {
            const double h = std::pow(ratio, -k);
            rows.push_back({h, 1.0 + h * h * (1.0 - 0.4 * h)});
        }
        BOOST_TEST(estimate_limit(rows).limit.status ==
                   "a limit needs values at three widths, each 5 % or more from the next, and 12 % "
                   "in all");
    }
}

// Of h² on widths 1.1 apart: the steps between four of them are at two widths an eighth apart, and
// those between six at three.
BOOST_AUTO_TEST_CASE(without_an_order_of_values_it_is_said_what_values_need) {
    std::vector<ValueRow> rows;
    for (int k = 0; k < 6; ++k) {
        const double h = 0.1 * std::pow(1.1, -k);
        rows.push_back({h, 1.0 + h * h});
        const auto found = estimate_limit(rows);
        BOOST_TEST(found.order.determined == (k == 5));
        if (k == 3 || k == 4)
            BOOST_TEST(found.order.status ==
                       "an order of values needs steps from one to the next at "
                       "three widths that differ by an eighth or more");
    }
}

// Replicates that scatter by 30 units: 100, 102 and 105 apart are no motion, whatever a unit is.
BOOST_AUTO_TEST_CASE(values_of_much_scatter_are_not_said_to_run_apart_by_their_digits) {
    std::vector<ValueRow> rows;
    for (const auto& [h, mean] : {std::pair{1.0, 100.0}, {0.5, 102.0}, {0.25, 105.0}})
        for (const double off : {-30.0, 30.0, 0.0})
            rows.push_back({h, mean + off, std::numeric_limits<double>::quiet_NaN(), 1.0});
    BOOST_TEST(estimate_limit(rows).limit.status != "the values run apart");
}

// f = 7 + 10 h + r with r = −6, 15, −12, 3 on h = 8, 4, 2, 1. With the weights 1/h, r is orthogonal
// to 1, h and h ln h, so that the fit has the limit 7 and the order 1. Of n = 4 values and 3
// parameters the deviation is σ² = n Σ w r² / (n − 3) = 4 · 141.75 / 1.875 = 302.4 with weights of
// sum one; the equal weights' is larger. It is less than (81 − 15) / (n − 1) = 22, the mean step of
// the data, so that the fit is a good one and U = 1.25 · |10 h_1| + σ + |r_1|.
BOOST_AUTO_TEST_CASE(the_uncertainty_of_eca_and_hoekstra_is_theirs) {
    const auto found = eca_hoekstra_of(std::vector<ValueRow>{{8, 81}, {4, 62}, {2, 15}, {1, 20}});
    BOOST_REQUIRE(found.has_value());
    BOOST_TEST(found->model == "f0 + C h^p");
    BOOST_TEST(std::abs(found->order - 1) < 1e-5);
    BOOST_TEST(std::abs(found->limit - 7) < 1e-3);
    BOOST_TEST(std::abs(found->uncertainty - (12.5 + std::sqrt(302.4) + 3)) < 1e-3);
}

// A factor 1e-160 on all values is one on limits and uncertainties, though no double holds the
// squares of such values.
BOOST_AUTO_TEST_CASE(no_method_depends_on_the_scale_of_the_values) {
    const auto value = [](double h) { return 1 + 2 * std::pow(h, 1.5); };
    const auto large = estimate_limit(sequence(5, value));
    const auto small = estimate_limit(sequence(5, [&](double h) { return 1e-160 * value(h); }));
    for (const auto method :
         {&LimitEstimate::gci, &LimitEstimate::celik, &LimitEstimate::eca_hoekstra}) {
        BOOST_REQUIRE((large.*method).has_value());
        BOOST_REQUIRE((small.*method).has_value());
        BOOST_TEST(std::abs((small.*method)->order - (large.*method)->order) < 1e-5);
        BOOST_TEST(std::abs(1e160 * (small.*method)->limit - (large.*method)->limit) < 1e-6);
        BOOST_TEST(std::abs(1e160 * (small.*method)->uncertainty - (large.*method)->uncertainty) <
                   1e-6);
    }
}

// A 95 % interval may miss one case of twenty, and of these the most extreme: p = ½, and a next
// term as large as the first.
BOOST_AUTO_TEST_CASE(the_limit_of_a_power_with_a_next_term_is_held) {
    int cases = 0;
    int held = 0;
    for (const double p : {0.5, 1.0, 2.0, 3.5, 6.0})
        for (const double next : {-0.5, 0.0, 1.0})
            for (const int levels : {4, 6, 10}) {
                const auto value = [&](double h) { return 7 - std::pow(h, p) * (1 + next * h); };
                const auto limit = estimate_limit(sequence(levels, value));
                // On four levels √h + h√h is one whose order falls, to who knows what.
                BOOST_TEST((limit.limit.determined || (p == 0.5 && next == 1.0 && levels == 4)));
                if (!limit.limit.determined)
                    continue;
                const double finest = value(std::exp2(1 - levels));
                ++cases;
                // The finest value's own interval has to hold it as well.
                held +=
                    holds(limit.limit, 7.0) && std::abs(finest - 7.0) <= limit.uncertainty ? 1 : 0;
            }
    BOOST_TEST(held >= cases - cases / 20);
}

// f_0 + C h + D h² may pass through four levels of h³ + b h⁴ and turn behind the finest: by chance
// it stayed where it was as the window moved, and the limit was 1.0025 ± 0.0011 of values that fall
// to 1.00054 and go to 1.
BOOST_AUTO_TEST_CASE(a_model_that_turns_behind_the_finest_level_does_not_hide_the_others) {
    for (const auto& [p, q] : {std::pair{3, 4}, {4, 5}, {4, 6}})
        for (double b = -0.9; b < -0.2; b += short_tests ? 0.003 : 0.001) {
            std::vector<ValueRow> rows;
            for (const double h : {1.0, 0.5, 0.25, 0.125})
                rows.push_back({h, 1 + 0.3 * (std::pow(h, p) + b * std::pow(h, q))});
            const auto limit = estimate_limit(rows).limit;
            BOOST_TEST_CONTEXT("h^" << p << " + " << b << " h^" << q)
            BOOST_TEST((limit.determined && holds(limit, 1)));
        }
}

// Of 1/ln(1/h) no power of h has the limit, and of the windows' orders each is less than the last.
BOOST_AUTO_TEST_CASE(values_whose_order_falls_below_a_half_have_no_limit) {
    const auto slow = [](double factor, int power) {
        return [=](double h) { return 1 + std::pow(std::log(factor / h), -power); };
    };
    for (const int levels : {8, 12})
        for (const auto& value : {std::function<double(double)>(slow(4.0, 1)), {slow(8.0, 2)}}) {
            const auto limit = estimate_limit(sequence(levels, value));
            BOOST_TEST(!limit.limit.determined, levels);
            BOOST_TEST(std::isinf(limit.uncertainty));
            BOOST_TEST(limit.limit.status.starts_with("the order of the steps falls"),
                       limit.limit.status);
        }
    // h² + √h/100 ends in a half: it has fallen from 2, and is below the first on its way there.
    const auto limit = estimate_limit(
        sequence(8, [](double h) { return 1 + h * h / 16 + 0.01 * std::sqrt(h / 4); }));
    BOOST_TEST(!limit.limit.determined);
    BOOST_TEST(limit.order.falls.value_or(std::pair(0.0, 0.0)).second > 0.5);
    // Those of powers of a half and more, with next terms, fall no further.
    int held = 0;
    int cases = 0;
    for (const double p : {0.5, 2.0 / 3.0, 0.8, 1.0})
        for (const double beyond : {0.5, 1.0, 2.0})
            for (const double next : {0.1, 0.5, 1.0, 2.0})
                for (const int levels : {5, 8}) {
                    const auto limit = estimate_limit(sequence(levels, [=](double h) {
                        return 1 + std::pow(h / 4, p) * (1 + next * std::pow(h / 4, beyond));
                    }));
                    BOOST_TEST(limit.limit.determined, p << ' ' << beyond << ' ' << next);
                    held += holds(limit.limit, 1.0) ? 1 : 0;
                    ++cases;
                }
    BOOST_TEST(held >= cases - cases / 20);
}

// f = 7 + (−1)^k h²: the limit lies between the values, and the order is that of their distance.
BOOST_AUTO_TEST_CASE(values_that_go_to_and_fro_have_a_limit_between_them) {
    auto rows = sequence(6, [](double h) { return h * h; });
    for (std::size_t k = 0; k < rows.size(); ++k)
        rows[k].value = 7 + (k % 2 == 0 ? rows[k].value : -rows[k].value);
    const auto limit = estimate_limit(rows);
    BOOST_TEST(holds(limit.limit, 7.0));
    BOOST_TEST(limit.limit.high - limit.limit.low <
               4 * std::abs(rows.back().value - rows[rows.size() - 2].value));
}

// Replicates of one width are one level of their mean.
// Differences of f0 + C h^p + D h^(p+1) between any two widths are C H^p + D H^(p+1) of one width
// H. Taken for those of the coarser of the two, they gave 2.149 ± 0.097.
BOOST_AUTO_TEST_CASE(the_order_of_values_is_held_whatever_the_ratios_of_the_widths) {
    const auto values_of = [](const std::vector<double>& widths, double order, double next) {
        std::vector<ValueRow> rows;
        for (const double h : widths)
            rows.push_back({h, 1 + std::pow(h, order) * (1 + next * h)});
        return rows;
    };
    const auto found =
        estimate_limit(values_of({1, 1. / 4, 1. / 10, 1. / 11, 1. / 13, 1. / 19}, 2, 1.3)).order;
    BOOST_TEST(found.determined);
    BOOST_TEST(std::abs(found.value - 2) < 0.02);
    // Ratios of 1.05 to 4 by turns; of twelve sequences each.
    for (const double order : {1.0, 1.5, 2.0, 3.0, 4.0}) {
        int determined = 0;
        for (int shift = 0; shift < 12; ++shift) {
            std::vector<double> widths{1};
            for (int k = 0; k < 5; ++k)
                widths.push_back(widths.back() / (1.05 + 0.59 * ((7 * k + 5 * shift) % 6)));
            const auto one = estimate_limit(values_of(widths, order, 0.1 * shift)).order;
            if (!one.determined)
                continue;
            ++determined;
            BOOST_TEST(holds(one, order),
                       order << ", " << shift << ": " << one.value << " ± " << one.half_width());
        }
        BOOST_TEST(determined >= 8, order << ": " << determined);
    }
}

// 3 + h^p + b h^q turns back where p + b q h^(q − p) = 0; next to that, differences shrink steeply.
// With them, intervals of order 3.40, 3.94, 4.19 and 4.58 missed.
BOOST_AUTO_TEST_CASE(the_order_of_values_that_turn_back_is_that_behind_the_turn) {
    struct Law {
        double p, q, b, coarsest;
        std::vector<double> widths;
    };
    const std::vector<double> halved = {1, 0.5, 0.25, 0.125, 0.0625, 0.03125};
    const std::vector<double> uneven = {1, 0.7, 0.45, 0.31, 0.2, 0.14};
    for (const auto& [p, q, b, coarsest, widths] :
         {Law{4.0, 5.0, -3.424, 0.716, halved}, Law{4.721, 5.221, -2.53, 0.387, halved},
          Law{3.591, 5.591, -2.743, 0.825, uneven},
          Law{4.908, 6.908, -2.188, 0.824, {1, 0.5, 0.25, 0.125, 0.0625}}}) {
        std::vector<ValueRow> rows;
        for (const double width : widths) {
            const double h = coarsest * width;
            rows.push_back({h, 3 + std::pow(h, p) + b * std::pow(h, q)});
        }
        const auto order = estimate_limit(rows).order;
        BOOST_TEST((!order.determined || holds(order, p)), p << ": " << order.value);
    }
}

BOOST_AUTO_TEST_CASE(replicates_are_one_level) {
    const auto once = sequence(5, [](double h) { return 7 + h * h; });
    auto twice = once;
    for (auto row : once) {
        row.value += 1e-3;
        twice.push_back(row);
        row.value -= 2e-3;
        twice.push_back(row);
    }
    // Of other weights: what is known of the scatter counts.
    BOOST_TEST(std::abs(estimate_limit(once).limit.value - estimate_limit(twice).limit.value) <
               1e-6);
}

// Steps that grow up to the finest, and equal steps (ln h): there is no limit. Five levels, along
// which the halved h falls by 8 up to the last step, are where two powers still may grow.
BOOST_AUTO_TEST_CASE(values_that_run_apart_have_no_limit_and_the_status_says_so) {
    for (const auto& value : std::vector<std::function<double(double)>>{
             [](double h) { return 1 / h; }, [](double h) { return std::log(h); },
             [](double h) { return 3 - std::pow(h, -0.3); }}) {
        for (const int levels : {5, 6}) {
            const auto limit = estimate_limit(sequence(levels, value));
            BOOST_TEST(!limit.limit.determined);
            BOOST_TEST(limit.limit.status == (levels == 6
                                                  ? "the values run apart"
                                                  : "the steps between the values do not shrink"));
            BOOST_TEST(!limit.gci.has_value());
        }
    }
    // To and fro by ever more, as noise may be: no limit is seen, and no more is said.
    const auto turning =
        estimate_limit(std::vector<ValueRow>{{8, 1.0}, {4, 1.001}, {2, 0.9985}, {1, 1.0022}});
    BOOST_TEST(!turning.limit.determined);
    BOOST_TEST(turning.limit.status == "the steps between the values do not shrink");
}

// 3 + h − 4 h² has the limit 3; its steps grow while h falls from 1/8 to 1/16.
BOOST_AUTO_TEST_CASE(values_that_still_may_have_a_limit_are_not_said_to_run_apart) {
    for (const double ratio : {1.1, 1.2, 1.3, 1.4}) {
        std::vector<ValueRow> rows;
        for (double h = 0.125; h > 1.0 / 16.1; h /= ratio)
            rows.push_back({h, 3 + h - 4 * h * h});
        BOOST_TEST(estimate_limit(rows).limit.status ==
                   "the steps between the values do not shrink");
    }
}

// f = f₀ + C hᵖ is what the grid convergence index inverts: order and limit come back at any two
// ratios, equal or not, and the index is 1.25 times the distance to the limit, up to order 4.
BOOST_AUTO_TEST_CASE(a_pure_power_is_extrapolated_exactly) {
    for (const double p : {0.5, 1.0, 2.0, 3.7, 7.0})
        for (const double ratio : {1.3, 2.0, 10.0}) {
            const auto row = [p](double h) { return ValueRow{h, -2 + 5 * std::pow(h, p)}; };
            const auto found = gci_of(std::vector<ValueRow>{row(0.2), row(0.1), row(0.1 / ratio)});
            BOOST_REQUIRE(found.has_value());
            // Values near 2 carry 4e-16, on a smallest difference of 5 · 0.1⁷ = 5e-7.
            BOOST_TEST(std::abs(found->order - p) < 1e-8);
            BOOST_TEST(std::abs(found->limit + 2) < 1e-11);
            if (p < 4)
                BOOST_TEST(std::abs(found->uncertainty - 1.25 * 5 * std::pow(0.1 / ratio, p)) <
                           1e-11);
        }
}

// Half of the orders of values that turn between the last levels had intervals that missed.
BOOST_AUTO_TEST_CASE(values_that_turn_near_the_finest_have_no_order) {
    const auto estimate = [](double p, double q, double factor, double coarsest, int levels) {
        std::vector<ValueRow> rows;
        for (int k = 0; k < levels; ++k) {
            const double h = coarsest / std::exp2(k);
            rows.push_back({h, 1.0 + std::pow(h, p) - factor * std::pow(h, q)});
        }
        return estimate_limit(rows);
    };
    for (const auto& [p, q, factor, coarsest, levels] : {std::tuple{2, 4, 74, 0.5, 6},
                                                         {2, 4, 17, 0.5, 5},
                                                         {1, 2, 16, 0.5, 6},
                                                         {1, 2, 20, 0.5, 6}}) {
        const auto found = estimate(p, q, factor, coarsest, levels);
        BOOST_TEST(!found.order.determined);
        BOOST_TEST(found.order.status.find("turn back at the width") != std::string::npos,
                   found.order.status);
        BOOST_TEST(found.limit.determined);
        BOOST_TEST((found.limit.low <= 1.0 && found.limit.high >= 1.0));
    }
    // Of any that turn.
    std::mt19937_64 random(29);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    int determined = 0;
    int missed = 0;
    for (int k = 0; k < (short_tests ? 60 : 600); ++k) {
        const double p = k % 3 == 0 ? 1.0 : k % 3 == 1 ? 1.5 : 2.0;
        const double q = p + (k % 2 == 0 ? 1.0 : 2.0);
        const int levels = 5 + k % 4;
        const double coarsest = std::exp(between(-3.0, 0.0));
        const double turn = coarsest * std::exp2(between(1.0 - levels, 0.0));
        const auto found = estimate(p, q, p / q * std::pow(turn, p - q), coarsest, levels).order;
        determined += found.determined ? 1 : 0;
        missed += found.determined && (found.low > p || found.high < p) ? 1 : 0;
    }
    BOOST_TEST(determined >= (short_tests ? 10 : 100));
    BOOST_TEST(missed <= 0.05 * determined, missed << " of " << determined);
}

// The procedure takes the absolute value of a logarithm.
BOOST_AUTO_TEST_CASE(steps_that_grow_have_no_order_of_celik) {
    for (const double last : {0.0, 57.0, 1.0 - 0.002})
        for (const double ratio : {2.0, 1.5}) {
            std::vector<ValueRow> rows;
            for (const double value : {1.04, 1.01, 1.0025, 1.000625, last})
                rows.push_back({std::pow(ratio, -static_cast<double>(rows.size())), value});
            BOOST_TEST(!celik_of(rows).has_value());
        }
}

BOOST_AUTO_TEST_CASE(of_values_that_are_all_the_same_nobody_knows_whether_anything_was_refined) {
    for (const double value : {1.234567890123456, 0.0, -3.0}) {
        const auto found =
            estimate_limit(std::vector<ValueRow>{{0.1, value}, {0.05, value}, {0.025, value}});
        BOOST_TEST(!found.limit.determined);
        BOOST_TEST(found.limit.status.find("nothing is refined") != std::string::npos);
    }
}

BOOST_AUTO_TEST_CASE(values_that_stand_still_or_oscillate_have_no_index) {
    BOOST_TEST(!gci_of(std::vector<ValueRow>{{1.0, 1.0}, {0.5, 2.0}, {0.25, 1.5}}));
    BOOST_TEST(!gci_of(std::vector<ValueRow>{{1.0, 1.0}, {0.5, 2.0}, {0.25, 2.0}}));
}

// Very many widths are averaged over cells, and show the same limit.
BOOST_AUTO_TEST_CASE(a_thousand_widths_have_the_limit_of_few) {
    std::vector<ValueRow> rows;
    for (int k = 0; k < 1000; ++k) {
        const double h = std::exp(-0.005 * k);
        rows.push_back({h, 7 + h * h});
    }
    const auto limit = estimate_limit(rows);
    BOOST_TEST(limit.limit.determined);
    BOOST_TEST(holds(limit.limit, 7.0));
    BOOST_TEST(limit.limit.high - limit.limit.low < 1e-4);
}

// f = f_0 + C h^p (1 + h / 2), rounded to units from 1e-3 to 1e-6: steps from none to many of them.
// 98 % hold the limit and the order, and none knows the limit to less than half a unit.
BOOST_AUTO_TEST_CASE(values_of_few_digits_have_intervals_that_hold_their_limit_and_order) {
    struct Held {
        int asked = 0;
        int missed = 0;
        void add(const OrderInterval& interval, double truth) {
            asked += interval.determined ? 1 : 0;
            missed += interval.determined && !holds(interval, truth) ? 1 : 0;
        }
    } limits, orders;
    const int step = short_tests ? 4 : 1;
    for (const double p : {1.0, 2.0})
        for (const double unit : {1e-3, 1e-4, 1e-5, 1e-6})
            for (int levels = 3; levels <= 7; ++levels)
                for (int k = 0; k < 10; k += step) {
                    const double limit = 2 + 0.012345 * k; // whose last digits differ
                    const double size = 0.002 * std::pow(1.7, k);
                    auto rows = sequence(levels, [&](double h) {
                        const double value = limit + size * std::pow(h, p) * (1 + h / 2);
                        return unit * std::round(value / unit);
                    });
                    for (auto& row : rows)
                        row.unit = unit;
                    const auto found = estimate_limit(rows);
                    limits.add(found.limit, limit);
                    orders.add(found.order, p);
                    BOOST_TEST(!(found.limit.half_width() < 0.499 * unit));
                }
    BOOST_TEST(limits.asked >= (short_tests ? 114 : 380)); // of 120, or 400
    BOOST_TEST(orders.asked >= (short_tests ? 30 : 110));
    BOOST_TEST(limits.missed <= 0.02 * limits.asked);
    BOOST_TEST(orders.missed <= 0.02 * orders.asked);
}

BOOST_AUTO_TEST_CASE(digits_beyond_the_steps_between_values_change_nothing) {
    auto rows = sequence(6, [](double h) { return 3 + 0.1 * h * h + 0.03 * h * h * h; });
    const auto exact = estimate_limit(rows);
    for (auto& row : rows)
        row.unit = 1e-10;
    const auto printed = estimate_limit(rows);
    BOOST_TEST(!printed.finest_step.has_value());
    BOOST_TEST(printed.limit.low == exact.limit.low);
    BOOST_TEST(printed.limit.high == exact.limit.high);
    BOOST_TEST(printed.order.low == exact.order.low);
    BOOST_TEST(printed.order.high == exact.order.high);
}

// Of first order over a ratio of 4, what is left is a third of what a unit hides.
BOOST_AUTO_TEST_CASE(
    values_that_are_the_same_in_all_digits_are_known_to_less_than_one_of_the_last) {
    std::vector<ValueRow> rows;
    for (const double h : {0.1, 0.05, 0.025})
        rows.push_back({.h = h, .value = 3.142, .unit = 1e-3});
    const auto found = estimate_limit(rows);
    BOOST_TEST(found.limit.determined);
    BOOST_TEST(found.limit.half_width() == 1e-3 * (0.5 + 1.0 / 3),
               boost::test_tools::tolerance(1e-9));
    BOOST_TEST(found.uncertainty == found.limit.half_width(), boost::test_tools::tolerance(1e-9));
}

// 1 + h², of a solver that refines no further than h = 1/4; a maximum over nodes that stays at one
// of them, as a place that moves in steps of h. What converges by powers, or doubles its digits,
// comes to stand still by itself.
BOOST_AUTO_TEST_CASE(values_that_stop_far_from_where_their_steps_go_have_no_limit) {
    const auto limit_of = [](const std::vector<double>& values) {
        std::vector<ValueRow> rows;
        for (const double value : values)
            rows.push_back({std::exp2(-static_cast<double>(rows.size())), value});
        return estimate_limit(rows).limit;
    };
    for (const auto& values :
         std::vector<std::vector<double>>{{2.0, 1.25, 1.0625, 1.0625, 1.0625},
                                          {0.75, 0.8125, 0.78125, 0.78125, 0.78125},
                                          {1.5, 1.0, 1.0, 1.0}}) {
        const auto limit = limit_of(values);
        BOOST_TEST(!limit.determined);
        BOOST_TEST(limit.status.find("finest values are the same") != std::string::npos,
                   limit.status);
    }
    // Of few digits values come to stand still, too, and those that scatter are not the same.
    const auto printed = [](const std::vector<double>& values, double unit, double sigma) {
        std::vector<ValueRow> rows;
        for (const double value : values)
            rows.push_back({std::exp2(-static_cast<double>(rows.size())), value, sigma, unit});
        return estimate_limit(rows).limit;
    };
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    BOOST_TEST(holds(printed({2.520, 2.501, 2.500, 2.500}, 1e-3, none), 2.5));
    BOOST_TEST(holds(printed({0.927, 0.907, 0.907, 0.907, 0.907}, 1e-3, none), 0.907));
    BOOST_TEST(holds(
        printed({-2.373, -1.9326, -1.9288, -1.9313, -1.9299, -1.9303, -1.9284}, 0, 0.0026), -1.93));
    // The next step would be 0.032, three units and more.
    BOOST_TEST(!printed({3.0, 2.2, 2.04, 2.04, 2.04}, 1e-2, none).determined);
    std::vector<double> by_powers, by_doubling;
    for (int k = 0; k < 8; ++k) {
        by_powers.push_back(1 + std::pow(10.0, -3 * k));
        by_doubling.push_back(2 + std::exp(-3 * std::exp2(k)));
    }
    BOOST_TEST(holds(limit_of(by_powers), 1.0));
    BOOST_TEST(holds(limit_of(by_doubling), 2.0));
}

// Powers of h alone would put the limit of what goes like 1/ln h, or its square, far from where it
// is; beside higher orders nothing is to be seen of logarithms.
BOOST_AUTO_TEST_CASE(where_the_order_is_low_the_interval_holds_logarithms_too) {
    const auto limit_of = [](const auto& error, int levels, double ratio) {
        std::vector<ValueRow> rows;
        double h = 0.125;
        for (int k = 0; k < levels; ++k, h /= ratio)
            rows.push_back({.h = h, .value = 1 + error(h)});
        return estimate_limit(rows).limit;
    };
    int determined = 0;
    for (const double factor : {1.0, -0.1, 0.3})
        for (int levels = 5; levels < 10; ++levels)
            for (const double ratio : {1.5, 2.0})
                for (const int power : {1, 2}) {
                    const auto limit = limit_of(
                        [&](double h) { return factor * std::pow(std::log(1 / h), -power); },
                        levels, ratio);
                    determined += limit.determined ? 1 : 0;
                    BOOST_TEST((!limit.determined || holds(limit, 1.0)),
                               factor << "/ln^" << power << ", " << levels << " levels");
                }
    BOOST_TEST(determined >= 20);
    const auto known = limit_of([](double h) { return h * std::sqrt(h); }, 6, 2.0);
    BOOST_TEST(holds(known, 1.0));
    BOOST_TEST(known.half_width() < 1e-3 * std::pow(0.125 / 32, 1.5) + 0.02 * 0.125 / 32);
}

BOOST_AUTO_TEST_CASE(two_widths_have_no_limit_and_the_status_says_so) {
    const auto limit =
        estimate_limit(std::vector<ValueRow>{{0.1, 1.0}, {0.1, 1.1}, {0.05, 1.2}, {0.025, NAN}});
    BOOST_TEST(!limit.limit.determined);
    BOOST_TEST(limit.limit.status == "a limit needs values at three different widths");
}

// One deviation is 18 decades below the others.
BOOST_AUTO_TEST_CASE(what_overflows_has_no_limit_and_the_status_says_so) {
    std::vector<ValueRow> rows;
    for (const double h : {1.0, 0.5, 0.25, 0.125})
        rows.push_back({.h = h, .value = 1 + h * h, .sigma = h == 0.25 ? 1e-21 : 1e-3});
    const auto found = estimate_limit(rows);
    BOOST_TEST((!found.limit.determined || std::isfinite(found.limit.half_width())));
    BOOST_TEST((found.limit.determined || !found.limit.status.empty()));
}

BOOST_AUTO_TEST_SUITE_END()

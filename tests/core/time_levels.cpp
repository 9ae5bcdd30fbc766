// The time levels: the doubles that they are, and the ends of phases among them.

#include "core/time/time_levels.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(time_levels)

namespace {

/// Every scheme's levels of a run, and the times of its solves.
template <typename Visit>
void for_all_schemes(const ProblemData& data, double final_time, std::int64_t steps,
                     const Visit& visit) {
    for (const auto& name : TimeScheme::names())
        visit(TimeLevels(data, TimeScheme::named(name), final_time, steps));
}

} // namespace

// T = k/10^q and t_n = j/10^q, as both are written: IEEE division of whole numbers gives the double
// nearest to the decimal, as reading it does. Of the tenths up to 3, T * n / N misses a quarter.
BOOST_AUTO_TEST_CASE(a_level_that_is_a_decimal_is_the_double_of_that_decimal) {
    const ProblemData no_phases;
    int coincidences = 0;
    int missed_by_products = 0;
    const auto compare = [&](int k, int N, double unit) {
        const double final_time = k / unit;
        const TimeLevels levels(no_phases, TimeScheme::named("euler"), final_time, N);
        for (int n = 1; n <= N; ++n) {
            if ((k * n) % N != 0)
                continue;
            const int units = k * n / N;
            const double decimal = units / unit;
            ++coincidences;
            missed_by_products += final_time * n / N != decimal;
            if (levels.time(n) != decimal)
                BOOST_ERROR("level " << n << " of " << N << " up to " << final_time);
        }
    };
    for (int k = 1; k <= 30; ++k)
        for (int N = 1; N <= 200; ++N)
            compare(k, N, 10.0);
    BOOST_TEST(missed_by_products > coincidences / 6);
    for (int k = 7; k <= 3000; k += 13)
        for (int N = 1; N <= 100; ++N)
            compare(k, N, 1000.0);
}

// Ends that are no decimals, with a final time that was rounded after it was multiplied; and ends
// at the times of stages, t_{n-1} + γΔt.
BOOST_AUTO_TEST_CASE(a_time_that_is_the_end_of_a_phase_to_round_off_is_that_end) {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> any(0.1, 10.0);
    std::uniform_int_distribution<int> steps(2, 1000);
    int missed_by_products = 0;
    for (int draw = 0; draw < 3000; ++draw) {
        const double end = any(generator);
        const int N = steps(generator);
        const int n = std::uniform_int_distribution<int>(1, N)(generator);
        const double final_time = end / n * N;
        missed_by_products += final_time * n / N != end;
        ProblemData data;
        data.phase_ends = {end / 3.0, end, 7.0 * end};
        for_all_schemes(data, final_time, N, [&](TimeLevels levels) {
            BOOST_TEST(levels.time(n) == end);
            BOOST_TEST(levels.meet(end));
            BOOST_TEST(*(levels.at(n).times.end() - 1) == end);
        });
        const double gamma = 1.0 - std::sqrt(0.5);
        data.phase_ends = {(n - 1 + gamma) * (final_time / N)};
        TimeLevels stages(data, TimeScheme::named("sdirk2"), final_time, N);
        BOOST_TEST(stages.at(n).times(0) == data.phase_ends[0]);
        BOOST_TEST(!stages.meet(data.phase_ends[0]));
    }
    BOOST_TEST(missed_by_products > 100);
}

// Nor is any time moved that is farther away than its round-off.
BOOST_AUTO_TEST_CASE(an_end_between_the_levels_moves_none) {
    const ProblemData no_phases;
    for (const double away : {-1e-3, -1e-12, 1e-12, 1e-3}) {
        ProblemData data;
        data.phase_ends = {0.3 + away};
        for (const int N : {4, 40, 400}) {
            const TimeLevels with(data, TimeScheme::named("euler"), 0.4, N);
            const TimeLevels without(no_phases, TimeScheme::named("euler"), 0.4, N);
            BOOST_TEST(with.meet(data.phase_ends[0]) == (N == 400 && std::abs(away) == 1e-3));
            for (int n = 0; n <= N; ++n)
                BOOST_TEST(std::abs(with.time(n) - without.time(n)) < 1e-16);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()

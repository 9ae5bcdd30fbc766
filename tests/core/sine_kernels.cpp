// The kernel of the sine basis is compiled for several vector units: each of them, one by one.

#include "core/sine/kernel.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(sine_kernels_one_by_one)

namespace {

constexpr std::int64_t groups = 3;
constexpr std::int64_t stride = groups * packs_in_group;
constexpr std::int64_t columns = 3;
constexpr std::int64_t steps = 7;

using Packs = std::vector<Pack>;

/// Numbers of size 1 and either sign, others for every seed.
Packs some_packs(std::int64_t count, double seed) {
    Packs packs(static_cast<std::size_t>(count));
    double argument = seed;
    for (Pack& pack : packs)
        for (double& lane : pack.lanes)
            lane = std::sin(argument += 1.7);
    return packs;
}

std::vector<double> some_numbers(std::int64_t count, double seed) {
    std::vector<double> numbers(static_cast<std::size_t>(count));
    for (double& number : numbers)
        number = std::sin(seed += 2.3);
    return numbers;
}

/// All that one kernel writes.
struct Written {
    Packs after, tip, temperature_square, curvature_square, moments, sum;
};

/// A block of a scheme with so many increments, of which `history` are of earlier steps: Euler has
/// none, BDF2 one of history, SDIRK2 one of its stages.
Written written_by(const SineKernel& kernel, std::int64_t increments, std::int64_t history,
                   bool coupled) {
    const std::int64_t fields = (coupled ? 2 : 1) * (1 + increments);
    const std::int64_t stages = 1 + increments - history;
    const std::int64_t solves = steps * stages;
    const std::vector<double> increment_weights = some_numbers(stages * increments, 0.1);
    const std::vector<double> loads = some_numbers(solves * columns, 0.2);
    const std::vector<double> weights = some_numbers(steps * columns, 0.3);
    const std::vector<std::int64_t> active{columns, 2, 0};
    const Packs before = some_packs(fields * stride, 1.0);
    const Packs table = some_packs(columns * stride, 2.0);
    const Packs stiffness = some_packs(stride, 3.0);
    // Of size 1/4: the state stays of its size through the steps.
    Packs inverse = some_packs(stride, 4.0);
    for (Pack& pack : inverse)
        for (double& lane : pack.lanes)
            lane /= 4.0;
    Written result{Packs(before.size()),
                   Packs(static_cast<std::size_t>(solves)),
                   Packs(static_cast<std::size_t>(steps)),
                   Packs(static_cast<std::size_t>(steps)),
                   Packs(static_cast<std::size_t>(steps)),
                   Packs(1)};
    SineSquare of_temperature;
    of_temperature.table = table.data();
    of_temperature.active_columns = active.data();
    of_temperature.weights = weights.data();
    of_temperature.weight_stride = steps;
    SineSquare of_curvature = of_temperature;
    of_temperature.squares = result.temperature_square.data();
    of_curvature.squares = result.curvature_square.data();
    of_curvature.factors = stiffness.data();
    of_curvature.arm = inverse.data();
    of_curvature.moments = result.moments.data();
    SineBlock block;
    block.groups = groups;
    block.stride = stride;
    block.steps = steps;
    block.stages = stages;
    block.columns = columns;
    block.increments = increments;
    block.history = history;
    block.increment_weights = increment_weights.data();
    block.coupled = coupled;
    block.alpha = 0.4;
    block.kappa = 0.3;
    block.exchange = 0.5;
    block.stiffness = stiffness.data();
    block.inverse = inverse.data();
    block.table = table.data();
    block.active_columns = active.data();
    block.loads = loads.data();
    block.before = before.data();
    block.after = result.after.data();
    block.tip = coupled ? result.tip.data() : nullptr;
    block.of_temperature = {&of_temperature, 1};
    if (coupled)
        block.of_curvature = {&of_curvature, 1};
    block.load_stride = solves;
    block.sum = result.sum.data();
    kernel.march(block);
    return result;
}

/// The largest difference, over the largest number.
double difference(const Packs& a, const Packs& b) {
    double largest = 0.0;
    double apart = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::int64_t lane = 0; lane < Pack::size; ++lane) {
            largest = std::max(largest, std::abs(b[i].lanes[lane]));
            apart = std::max(apart, std::abs(a[i].lanes[lane] - b[i].lanes[lane]));
        }
    return largest > 0.0 ? apart / largest : apart;
}

} // namespace

BOOST_AUTO_TEST_CASE(the_widest_kernel_of_the_processor_is_chosen) {
    BOOST_TEST(sine_kernels().back().runs_here);
    for (const SineKernel& kernel : sine_kernels()) {
        if (&kernel == &chosen_sine_kernel())
            break;
        BOOST_TEST(!kernel.runs_here, kernel.name);
    }
    BOOST_TEST(chosen_sine_kernel().runs_here);
}

// They differ where products and sums are fused: in each of some thirty operations a solve by half
// an ulp of numbers of size 1, over at most 21 solves.
BOOST_DATA_TEST_CASE(every_kernel_gives_the_same_results,
                     data::make({0, 1, 1, 2}) ^ data::make({0, 1, 0, 1}), increments, history) {
    const SineKernel& plain = sine_kernels().back();
    const double tolerance = 30.0 * 21.0 * std::numeric_limits<double>::epsilon();
    for (const bool coupled : {false, true}) {
        const Written expected = written_by(plain, increments, history, coupled);
        for (const SineKernel& kernel : sine_kernels()) {
            if (!kernel.runs_here) {
                BOOST_TEST_MESSAGE("skipped: this processor is no " << kernel.name);
                continue;
            }
            const Written found = written_by(kernel, increments, history, coupled);
            for (const auto part : {&Written::after, &Written::tip, &Written::temperature_square,
                                    &Written::curvature_square, &Written::moments, &Written::sum})
                BOOST_TEST(difference(found.*part, expected.*part) <= tolerance, kernel.name);
        }
        BOOST_TEST(difference(expected.after, Packs(expected.after.size())) > 0.0);
    }
}

BOOST_AUTO_TEST_SUITE_END()

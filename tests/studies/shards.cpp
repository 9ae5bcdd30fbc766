// How work is dealt to shards, and how the cases of a study are kept where they are many.

#include "studies/runs/parallel.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/shards/shard.hpp"
#include "studies/stress/scratch.hpp"
#include "studies/stress/stress.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(shards)

namespace {

/// Groups of parts with these works.
std::vector<WorkGroup> groups_of(const std::vector<std::vector<double>>& works) {
    std::vector<WorkGroup> groups;
    for (const auto& work : works)
        groups.push_back({"parts",
                          std::nullopt,
                          {"parts", work.size(), [work](std::size_t i) { return work[i]; },
                           [](std::size_t /*i*/) { return std::any(); }}});
    return groups;
}

std::vector<double> loads(const std::vector<WorkGroup>& groups, std::uint32_t shards) {
    std::vector<double> load(shards, 0.0);
    const auto owners = dealt(groups, shards);
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::size_t i = 0; i < groups[g].count(); ++i)
            load.at(owners[g][i] - 1) += groups[g].work(i);
    return load;
}

StressCase a_case(int n) {
    StressCase one;
    one.parameters = {.alpha = 0.1 * n,
                      .zeta = 0.2 * n,
                      .dt = 0.3 * n,
                      .elements = n + 2,
                      .steps = n + 3,
                      .stops = {-0.5, std::numeric_limits<double>::infinity()},
                      .theta_A = 0.4 * n,
                      .load = 0.5 * n,
                      .initial = n % 2 == 0 ? InitialData::zero : InitialData::random,
                      .seed = static_cast<unsigned>(n + 4),
                      .time = n % 2 == 0 ? "euler" : "bdf2",
                      .thermal_mass = n % 2 == 0 ? ThermalMass::lumped : ThermalMass::consistent,
                      .algorithm = n % 2 == 0 ? Algorithm::direct : Algorithm::fixed_point};
    one.seconds = 0.6 * n;
    one.outcome = n % 3 == 0 ? Outcome::refused : Outcome::certified;
    if (one.outcome == Outcome::refused) {
        one.reason = "for the reason " + std::to_string(n);
        return one;
    }
    one.checks.emplace();
    one.checks->energy = 1.0 / (3.0 + n);
    one.checks->heat_residual = n % 5 == 1 ? std::nan("") : 2.0;
    one.checks->beam_residual = 0.7 * n;
    one.checks->penetration = 0.8 * n;
    one.checks->wrong_sign = 0.9 * n;
    one.checks->complementarity = 1.1 * n;
    one.checks->path_limit = 1.2 * n;
    if (n % 2 == 0) {
        one.checks->path = 0.25 * n;
        one.checks->error_skipped = "no error";
    } else {
        one.checks->path_skipped = "none";
        one.checks->error = 1.3 * n;
        one.checks->order_defect = 1.4 * n;
    }
    return one;
}

} // namespace

// Graham (1969): longest first is at most a third above the best that there is, which is at least
// the mean and the longest.
BOOST_DATA_TEST_CASE(all_work_is_dealt_once_and_the_heaviest_shard_is_near_the_mean,
                     data::make({1U, 2U, 7U, 64U}), shards) {
    std::mt19937 random(7);
    std::lognormal_distribution<double> work(10.0, 2.0);
    std::vector<std::vector<double>> works(3);
    for (auto& group : works)
        for (int i = 0; i < 400; ++i)
            group.push_back(work(random));
    const auto groups = groups_of(works);
    const auto load = loads(groups, shards);
    double all = 0.0;
    double longest = 0.0;
    for (const auto& group : groups)
        for (std::size_t i = 0; i < group.count(); ++i) {
            all += group.work(i);
            longest = std::max(longest, group.work(i));
        }
    double sum = 0.0;
    for (const double one : load)
        sum += one;
    BOOST_TEST(sum == all, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(*std::max_element(load.begin(), load.end()) <=
               4.0 / 3.0 * std::max(longest, all / shards));
}

// 6 against six of 1; the other way round one shard would have 3 and the other 3 + 6.
BOOST_AUTO_TEST_CASE(the_longest_is_dealt_first) {
    const auto load = loads(groups_of({{1e9, 1e9, 1e9, 6e9, 1e9, 1e9, 1e9}}), 2);
    BOOST_TEST(load[0] == load[1], boost::test_tools::tolerance(1e-3));
}

// A list of ten values in a product, dealt in turn to ten shards, would give each shard one of
// them.
BOOST_AUTO_TEST_CASE(cases_that_take_as_long_are_mixed) {
    const auto owners = dealt(groups_of({std::vector<double>(1000, 1.0)}), 10);
    std::set<std::size_t> residues;
    for (std::size_t i = 0; i < 1000; ++i)
        if (owners[0][i] == 1)
            residues.insert(i % 10);
    BOOST_TEST(residues.size() == 10U);
    BOOST_TEST(std::count(owners[0].begin(), owners[0].end(), 1U) == 100);
}

BOOST_AUTO_TEST_CASE(every_run_of_every_shipped_scene_is_dealt_or_the_scene_says_why_not) {
    int refused = 0;
    for (const auto& file : shipped_files(Shipped::scene)) {
        const Scene scene = read_scene(file.name);
        try {
            require_dealable(scene);
        } catch (const InputError& error) {
            ++refused;
            BOOST_TEST(std::string(error.what()).find("run it as a whole") != std::string::npos);
            continue;
        }
        std::size_t runs = 0;
        for (const auto& [kind, block] : scene.blocks.entries())
            if (kind->measures())
                for (const auto& series : kind->series(block, scene.method()))
                    runs += series.rungs.size();
        if (const auto* stress = scene.get<StressBlock>())
            for (const auto& parts : parts_of(*stress))
                runs += parts.count;
        std::size_t dealt_runs = 0;
        for (const auto& group : dealt(work_groups(scene), 3))
            dealt_runs += static_cast<std::size_t>(
                std::count_if(group.begin(), group.end(),
                              [](std::uint32_t shard) { return shard >= 1 && shard <= 3; }));
        BOOST_TEST(dealt_runs == runs, file.name);
    }
    BOOST_TEST(refused > 0); // a work-precision study, and what is refined
}

BOOST_AUTO_TEST_CASE(cases_come_back_in_order_whatever_the_order_they_come_in) {
    constexpr int count = 200;
    std::vector<int> order(count);
    for (int n = 0; n < count; ++n)
        order[static_cast<std::size_t>(n)] = n;
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    StressCases cases;
    for (const int n : order)
        if (n != 17) // left out
            cases.set(static_cast<std::size_t>(n), a_case(n));
    BOOST_TEST(cases.size() == 199U);
    BOOST_TEST(cases.count(Outcome::refused) == 67U);
    int n = 0;
    cases.visit([&](const StressCase& found) {
        n += n == 17 ? 1 : 0;
        const StressCase made = a_case(n++);
        BOOST_TEST(found.parameters.alpha == made.parameters.alpha);
        BOOST_TEST(found.parameters.zeta == made.parameters.zeta);
        BOOST_TEST(found.parameters.dt == made.parameters.dt);
        BOOST_TEST(found.parameters.theta_A == made.parameters.theta_A);
        BOOST_TEST(found.parameters.load == made.parameters.load);
        BOOST_TEST(found.parameters.elements == made.parameters.elements);
        BOOST_TEST(found.parameters.steps == made.parameters.steps);
        BOOST_TEST(int(found.parameters.initial == made.parameters.initial));
        BOOST_TEST(found.parameters.seed == made.parameters.seed);
        BOOST_TEST(found.parameters.time == made.parameters.time);
        BOOST_TEST(int(found.parameters.thermal_mass == made.parameters.thermal_mass));
        BOOST_TEST(int(found.parameters.algorithm == made.parameters.algorithm));
        BOOST_TEST(found.seconds == made.seconds);
        BOOST_TEST(found.parameters.stops.lower == made.parameters.stops.lower);
        BOOST_TEST(found.parameters.stops.upper == made.parameters.stops.upper);
        BOOST_TEST(int(found.outcome == made.outcome));
        BOOST_TEST(found.reason == made.reason);
        BOOST_REQUIRE(found.checks.has_value() == made.checks.has_value());
        if (!made.checks)
            return;
        BOOST_TEST(found.checks->energy == made.checks->energy);
        BOOST_TEST(std::isnan(found.checks->heat_residual) ==
                   std::isnan(made.checks->heat_residual));
        for (const auto check :
             {&StressChecks::beam_residual, &StressChecks::penetration, &StressChecks::wrong_sign,
              &StressChecks::complementarity, &StressChecks::path_limit})
            BOOST_TEST(((*found.checks).*check == (*made.checks).*check));
        BOOST_TEST(int(found.checks->path == made.checks->path));
        BOOST_TEST(found.checks->path_skipped == made.checks->path_skipped);
        BOOST_TEST(int(found.checks->error == made.checks->error));
        BOOST_TEST(found.checks->error_skipped == made.checks->error_skipped);
        BOOST_TEST(int(found.checks->order_defect == made.checks->order_defect));
    });
    BOOST_TEST(n == count);
}

BOOST_AUTO_TEST_CASE(bytes_are_the_same_in_memory_and_in_a_file) {
    Scratch scratch;
    const std::string low = "in memory first";
    const std::string high = "and then in a file";
    scratch.write(5, low.data(), low.size());
    const auto read = [&](std::size_t offset, std::size_t size) {
        std::string text(size, '?');
        scratch.read(offset, text.data(), size);
        return text;
    };
    BOOST_TEST(read(5, low.size()) == low);
    scratch.write(Scratch::most_in_memory + 7, high.data(), high.size());
    BOOST_TEST(read(5, low.size()) == low);
    BOOST_TEST(read(Scratch::most_in_memory + 7, high.size()) == high);
    BOOST_TEST(read(Scratch::most_in_memory, 7) == std::string(7, '\0'));
    BOOST_TEST(scratch.size() == Scratch::most_in_memory + 7 + high.size());
}

BOOST_AUTO_TEST_CASE(a_full_disk_or_a_directory_that_is_none_is_said) {
    const auto written = [](const char* directory) -> std::string {
        setenv("TMPDIR", directory, 1);
        Scratch scratch;
        try {
            scratch.write(Scratch::most_in_memory, "x", 1);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    const char* set = std::getenv("TMPDIR");
    const std::string before = set == nullptr ? "" : set;
    BOOST_TEST(written("/dev/null").empty()); // no directory: /tmp
    const std::string none = written("/proc");
    BOOST_TEST(none.starts_with("cannot make a temporary file in '/proc' for the results of many"),
               none);
    if (set == nullptr)
        unsetenv("TMPDIR");
    else
        setenv("TMPDIR", before.c_str(), 1);
}

BOOST_AUTO_TEST_SUITE_END()

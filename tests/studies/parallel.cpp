// Runs side by side: the same results in the same places, whatever the number of jobs.

#include "studies/runs/parallel.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/study.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(runs_side_by_side)

namespace {

void require_same(const std::vector<Rung>& rungs, const std::vector<RungResult>& first,
                  const std::vector<RungResult>& second) {
    BOOST_REQUIRE(first.size() == rungs.size());
    BOOST_REQUIRE(second.size() == rungs.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        BOOST_TEST(first[i].rung.elements == rungs[i].elements);
        BOOST_TEST(second[i].rung.elements == rungs[i].elements);
        BOOST_TEST(first[i].rung.dt == rungs[i].dt);
        BOOST_TEST(second[i].rung.dt == rungs[i].dt);
        BOOST_TEST((first[i].status == second[i].status));
        BOOST_TEST(first[i].reason == second[i].reason);
        BOOST_TEST(first[i].count("heat_solves") == second[i].count("heat_solves"));
        BOOST_TEST(first[i].errors == second[i].errors); // bit by bit
    }
}

struct Study {
    std::string scene;
    std::vector<std::string> overrides;
    bool fails;
};

std::ostream& operator<<(std::ostream& stream, const Study& study) {
    return stream << study.scene;
}

/// A ladder, a grid with an algorithm that iterates, errors against a reference run, sources that
/// do not separate, and rungs of which some fail: at α = 5 the fixed point contracts for Δt = 1e-3
/// (factor 25e-3/0.1), not for Δt = 1 (factor 25/1.1/10.9).
const std::vector<Study> studies{
    {"table1",
     {"ladder.elements=[10, 20, 40]", "ladder.dt=\"0.1/s\"", "ladder.printed={}",
      "orders.elements=[5, 10, 20]", "orders.dt=[0.02, 0.01, 0.005]"},
     false},
    {"figure1-ladder", {}, false},
    {"moving-front", {"ladder.elements=[5, 10, 20]", "ladder.dt=\"0.1/s\""}, false},
    {"table1-fixed-point",
     {"beam.alpha=5", "ladder.elements=[4, 4, 8, 8]", "ladder.dt=[1, 1, 1e-3, 1e-3]",
      "ladder.printed={}"},
     true},
};

} // namespace

BOOST_DATA_TEST_CASE(results_do_not_depend_on_the_number_of_jobs, data::make(studies), study) {
    const Scene scene = read_scene(study.scene, study.overrides);
    const StudyResult alone = run_study(scene);
    BOOST_TEST(alone.failed() == study.fails);
    for (const int jobs : {2, 5}) {
        const StudyResult shared = run_study(scene, {.jobs = jobs});
        if (alone.get<LadderResult>())
            require_same(scene.get<LadderBlock>()->rungs, alone.get<LadderResult>()->rungs,
                         shared.get<LadderResult>()->rungs);
        if (alone.get<OrdersResult>())
            require_same(scene.get<OrdersBlock>()->grid, alone.get<OrdersResult>()->runs,
                         shared.get<OrdersResult>()->runs);
    }
}

BOOST_AUTO_TEST_CASE(the_longest_piece_is_begun_first_but_by_one_job) {
    const std::vector<double> costs{3.0, 1.0, 4.0, 1.0, 5.0};
    const std::vector<std::size_t> expected{4, 2, 0, 1, 3};
    BOOST_TEST(longest_first(costs) == expected);
    std::vector<std::size_t> begun;
    for_each_longest_first(costs, 1, [&](std::size_t i) { begun.push_back(i); });
    BOOST_TEST(begun == (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

BOOST_DATA_TEST_CASE(every_piece_is_done_once, data::make({1, 2, 5, 1000}), jobs) {
    std::vector<std::atomic<int>> times(100'000);
    for_each_longest_first(std::vector<double>(times.size(), 1.0), jobs,
                           [&](std::size_t i) { ++times[i]; });
    BOOST_TEST(std::all_of(times.begin(), times.end(), [](int count) { return count == 1; }));
    for_each_longest_first({}, jobs, [](std::size_t) { BOOST_TEST(false); });
}

BOOST_AUTO_TEST_CASE(one_job_makes_no_thread_and_several_do) {
    const auto threads_of = [](int jobs) {
        std::set<std::thread::id> threads;
        std::mutex lock;
        std::atomic<int> present = 0;
        for_each_longest_first({1.0, 1.0}, jobs, [&](std::size_t) {
            {
                const std::lock_guard guard(lock);
                threads.insert(std::this_thread::get_id());
            }
            // Two jobs wait for each other: neither can do both pieces. A thread too many has time
            // to take one.
            ++present;
            while (present < jobs)
                std::this_thread::yield();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        });
        return threads;
    };
    BOOST_TEST((threads_of(1) == std::set{std::this_thread::get_id()}));
    BOOST_TEST(threads_of(2).size() == 2u);
}

BOOST_DATA_TEST_CASE(the_exception_of_the_longest_piece_that_throws_reaches_the_caller,
                     data::make({2, 5}), jobs) {
    for (int attempt = 0; attempt < 20; ++attempt)
        try {
            for_each_longest_first({1.0, 2.0, 3.0, 4.0}, jobs, [](std::size_t i) {
                if (i <= 2)
                    throw std::runtime_error(std::to_string(i));
            });
            BOOST_TEST(false, "nothing was thrown");
        } catch (const std::runtime_error& error) {
            BOOST_TEST(error.what() == std::string("2"));
        }
}

BOOST_AUTO_TEST_CASE(nothing_is_begun_after_an_exception) {
    std::vector<std::size_t> begun;
    const auto work = [&](std::size_t i) {
        begun.push_back(i);
        throw std::runtime_error("");
    };
    BOOST_CHECK_THROW(for_each_longest_first({1.0, 2.0, 3.0}, 1, work), std::runtime_error);
    BOOST_TEST(begun == std::vector<std::size_t>{0});
}

BOOST_AUTO_TEST_SUITE_END()

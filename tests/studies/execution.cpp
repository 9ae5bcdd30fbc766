// How runs are carried out: progress, interruption, and results kept from an earlier attempt.

#include "studies/evolution/evolution.hpp"
#include "studies/stress/stress.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <map>
#include <mutex>
#include <utility>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(execution)

namespace {

/// Counts work, and asks for the end when so much of it is done.
class Meter final : public Progress {
public:
    explicit Meter(double enough = 1e300) : enough_(enough) {}
    void expect(double work) override {
        const std::scoped_lock lock(mutex_);
        expected += work;
    }
    bool advance(double work) override {
        const std::scoped_lock lock(mutex_);
        done += work;
        return done < enough_;
    }
    double expected = 0.0;
    double done = 0.0;

private:
    std::mutex mutex_;
    double enough_;
};

/// Keeps results in memory.
class Shelf final : public FinishedRuns {
public:
    std::optional<RungResult> find(const Series& series, std::size_t index) override {
        const std::scoped_lock lock(mutex_);
        const auto at = runs.find({series.study, index});
        return at == runs.end() ? std::nullopt : std::optional(at->second);
    }
    void add(const Series& series, std::size_t index, const RungResult& result) override {
        const std::scoped_lock lock(mutex_);
        runs[{series.study, index}] = result;
        ++added;
    }
    std::any find_part(const std::string& study, std::size_t index) override {
        const std::scoped_lock lock(mutex_);
        const auto at = parts.find({study, index});
        return at == parts.end() ? std::any() : at->second;
    }
    void add_part(const std::string& study, std::size_t index, const std::any& result) override {
        const std::scoped_lock lock(mutex_);
        std::any& kept = parts[{study, index}] = result;
        std::any_cast<StressCase&>(kept).parameters = {};
        ++added;
    }
    std::map<std::pair<std::string, std::size_t>, RungResult> runs;
    std::map<std::pair<std::string, std::size_t>, std::any> parts;
    int added = 0;

private:
    std::mutex mutex_;
};

const std::vector<std::string> small{"ladder.elements=[4, 8, 16, 32]", "ladder.printed={}",
                                     "ladder.dt=[4e-3, 2e-3, 1e-3, 5e-4]",
                                     "orders.elements=[4, 6, 8]", "orders.dt=[0.02, 0.01, 0.005]"};

std::vector<std::vector<double>> errors_of(const StudyResult& result) {
    std::vector<std::vector<double>> errors;
    for (const auto& study : result.runs())
        for (const auto& run : *study.results)
            errors.push_back(run.errors);
    return errors;
}

const std::string sweep = "[stress.sweep.a]\nalpha = [0.0, 1.0, 10.0]\nelements = [2, 8]\n"
                          "dt = [1e-3]\nsteps = 20\nsampling = \"product\"\n";

} // namespace

// Both bases of the direct algorithm, and the fixed point.
BOOST_DATA_TEST_CASE(work_that_is_done_is_work_that_was_expected,
                     data::make({"scheme.basis=nodal", "scheme.basis=automatic",
                                 "scheme.algorithm=fixed-point"}),
                     scheme) {
    auto overrides = small;
    overrides.emplace_back(scheme);
    Meter meter;
    run_study(read_scene("table1", overrides), {.progress = &meter});
    BOOST_TEST(meter.expected > 0.0);
    BOOST_TEST(meter.done <= meter.expected);
    // Told every 64 steps: the last ones of a run may be missing.
    BOOST_TEST(meter.done > 0.8 * meter.expected);
}

BOOST_DATA_TEST_CASE(an_interrupted_study_keeps_what_finished_and_says_what_did_not,
                     data::make({1, 4}), jobs) {
    const Scene scene = read_scene("table1", small);
    Meter whole;
    const StudyResult undisturbed = run_study(scene, {.progress = &whole});
    Meter half(0.5 * whole.done);
    Shelf shelf;
    const StudyResult cut = run_study(scene, {.jobs = jobs, .progress = &half, .finished = &shelf});
    BOOST_TEST(cut.interrupted());
    BOOST_TEST(cut.failed());
    std::size_t finished = 0;
    for (const auto& study : cut.runs())
        for (const auto& run : *study.results) {
            if (run.status == RungStatus::ok) {
                ++finished;
                continue;
            }
            BOOST_TEST(int(run.status == RungStatus::interrupted));
            BOOST_TEST(run.errors.empty());
        }
    BOOST_TEST(finished == shelf.runs.size());
    BOOST_TEST(finished > 0U);
    BOOST_TEST(finished < errors_of(undisturbed).size());

    // Going on from there runs the others, and gives the same to the last bit.
    const StudyResult resumed = run_study(scene, {.jobs = jobs, .finished = &shelf});
    BOOST_TEST(!resumed.interrupted());
    BOOST_TEST(int(errors_of(resumed) == errors_of(undisturbed)));
    BOOST_TEST(static_cast<std::size_t>(shelf.added) == errors_of(undisturbed).size());
}

BOOST_DATA_TEST_CASE(a_stress_study_goes_on_where_it_was_interrupted, data::make({1, 3}), jobs) {
    const TemporaryDirectory directory;
    const Scene scene = read_scene(directory.write("scene.toml", sweep));
    const StressResult undisturbed = *run_study(scene).get<StressResult>();
    BOOST_REQUIRE(undisturbed.cases.size() == 6U);
    Meter meter(100.0); // of 6 cases of 40 or 160
    Shelf shelf;
    const StudyResult cut =
        run_study(scene, {.jobs = jobs, .progress = &meter, .finished = &shelf});
    BOOST_TEST(cut.interrupted());
    BOOST_TEST(cut.get<StressResult>()->cases.size() == shelf.parts.size());
    BOOST_TEST(shelf.parts.size() < 6U);
    const StudyResult again = run_study(scene, {.jobs = jobs, .finished = &shelf});
    const StressResult& resumed = *again.get<StressResult>();
    BOOST_REQUIRE(resumed.cases.size() == 6U);
    BOOST_TEST(shelf.added == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        BOOST_TEST(resumed.cases.at(i).parameters.alpha ==
                   undisturbed.cases.at(i).parameters.alpha);
        BOOST_TEST(resumed.cases.at(i).parameters.elements ==
                   undisturbed.cases.at(i).parameters.elements);
        BOOST_TEST(int(resumed.cases.at(i).outcome == undisturbed.cases.at(i).outcome));
        BOOST_TEST(resumed.cases.at(i).checks->energy == undisturbed.cases.at(i).checks->energy);
    }
}

BOOST_AUTO_TEST_CASE(an_evolution_that_is_interrupted_keeps_its_history) {
    Meter meter(100.0 * 1000.0);
    const StudyResult cut = run_study(read_scene("figure1"), {.progress = &meter});
    BOOST_TEST(cut.interrupted());
    BOOST_TEST(cut.get<EvolutionResult>()->t.size() > 900U);
    BOOST_TEST(cut.get<EvolutionResult>()->t.size() < 1100U);
}

// At once, and, in timed runs, when all errors have been measured.
BOOST_DATA_TEST_CASE(timed_runs_end_when_asked_to, data::make({1000.0, 0.5}), enough) {
    const Scene scene = read_scene(
        "table1-work-precision",
        {"work_precision.runs=50", "work_precision.scheme.0.elements=[4, 8]",
         "work_precision.scheme.1.elements=[4, 8]", "work_precision.scheme.2.elements=[4, 8]",
         "work_precision.scheme.3.elements=[4, 8]"});
    Meter whole;
    const StudyResult undisturbed = run_study(scene, {.progress = &whole});
    BOOST_TEST(!undisturbed.interrupted());
    Meter meter(enough < 1.0 ? enough * whole.done : enough);
    const StudyResult cut = run_study(scene, {.progress = &meter});
    BOOST_TEST(cut.interrupted());
    BOOST_TEST(cut.failed());
    BOOST_TEST(meter.done < 0.6 * whole.done);
}

BOOST_AUTO_TEST_SUITE_END()

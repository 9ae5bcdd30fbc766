// Results that an earlier attempt has left: those that it wrote come back bit for bit, others are
// refused with what is wrong with them.

#include "reports/files/finished_work.hpp"
#include "reports/files/kept_result.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include <sys/resource.h>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(kept_results)

namespace {

using Json = nlohmann::ordered_json;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

const Rung rung{.elements = 10, .steps = 30, .dt = 1.0 / 30.0};

const std::vector<Measure> two_norms{{.name = "theta_L2L2"}, {.name = "u_LinfH2"}};

RungResult run() {
    RungResult result{.rung = rung, .seconds = 0.1};
    result.counters = {{"steps", 30}, {"sine_steps", 30}, {"heat_solves", 60}};
    result.errors = {1.0 / 3.0, std::numeric_limits<double>::denorm_min()};
    return result;
}

StressCase judged() {
    StressCase result;
    result.checks.emplace();
    result.checks->energy = 1.0 / 3.0;
    result.checks->heat_residual = std::numeric_limits<double>::infinity();
    result.checks->path = 0.1;
    return result;
}

struct Wrong {
    std::string key;
    Json value;
    std::string reason;
};

/// Each by itself, put into what is right.
template <typename Read>
void refused(const Json& right, const std::vector<Wrong>& all, const Read& read) {
    for (const auto& [key, value, reason] : all) {
        Json wrong = right;
        wrong[Json::json_pointer(key)] = value;
        BOOST_CHECK_EXCEPTION(read(wrong), std::invalid_argument,
                              [&](const std::invalid_argument& error) {
                                  BOOST_TEST(error.what() == reason);
                                  return true;
                              });
    }
}

} // namespace

BOOST_AUTO_TEST_CASE(a_run_comes_back_bit_for_bit) {
    const RungResult before = run();
    const RungResult after = kept_run(Json::parse(kept(before).dump()), rung, two_norms);
    BOOST_TEST(after.errors == before.errors, boost::test_tools::per_element());
    BOOST_TEST(after.seconds == before.seconds);
    BOOST_TEST(after.rung.dt == before.rung.dt);
    BOOST_TEST(after.count("sine_steps") == 30);
    // A value may be negative, and how finely a program printed it comes back, too.
    RungResult value{.rung = rung};
    value.errors = {-0.31};
    value.printed = {{.significant = 2, .last_place = -2}};
    const RungResult kept_value =
        kept_run(Json::parse(kept(value).dump()), rung, {{.name = "lift", .is_value = true}});
    BOOST_TEST(kept_value.errors == value.errors, boost::test_tools::per_element());
    BOOST_TEST(kept_value.printed.at(0).significant == 2);
    BOOST_TEST(kept_value.printed.at(0).last_place == -2);
    BOOST_TEST(!kept_value.has_kink);
    value.has_kink = true;
    BOOST_TEST(kept_run(Json::parse(kept(value).dump()), rung, {{.name = "lift", .is_value = true}})
                   .has_kink);
    RungResult failed = run();
    failed.status = RungStatus::failed;
    failed.reason = "not finite";
    failed.errors.clear();
    const RungResult again = kept_run(Json::parse(kept(failed).dump()), rung, two_norms);
    BOOST_TEST((again.status == RungStatus::failed));
    BOOST_TEST(again.reason == "not finite");
}

BOOST_AUTO_TEST_CASE(a_run_that_the_scene_does_not_give_is_refused) {
    const std::string other_run = "elements, steps and dt are not those of the scene";
    const std::string no_counter = "a counter is not a number of things";
    const std::string too_many = "counters are of more steps than the run has";
    const std::string not_one_a_norm = "errors are not one a norm of a run that did not fail";
    refused(kept(run()),
            {{"/elements", 11, other_run},
             {"/steps", 31, other_run},
             {"/dt", 0.1, other_run},
             {"/dt", "one", "dt is not a number"},
             {"/elements", 1e300, "elements is not a number of things"},
             {"/failed", 1, "failed is neither true nor false"},
             {"/failed", true, "reason does not belong to failed"},
             {"/reason", "it failed", "reason does not belong to failed"},
             {"/reason", 5, "reason is not a text"},
             {"/seconds", -1.0, "seconds are not a time"},
             {"/seconds", "inf", "seconds are not a time"},
             {"/counters", Json::array(), "counters have no names"},
             {"/counters/heat_solves", 1e300, no_counter},
             {"/counters/heat_solves", -1, no_counter},
             {"/counters/heat_solves", std::numeric_limits<std::uint64_t>::max(), no_counter},
             {"/counters/steps", 31, too_many},
             {"/counters/sine_steps", 31, too_many},
             {"/errors", Json::array(), not_one_a_norm},
             {"/errors", {1.0, 2.0, 3.0}, not_one_a_norm},
             {"/errors", 1.0, not_one_a_norm},
             {"/errors/0", "nan", "an error is not a norm"},
             {"/errors/0", -1.0, "an error is not a norm"},
             {"/errors/0", nullptr, "an error is not a number"}},
            [](const Json& json) { return kept_run(json, rung, two_norms); });
    BOOST_CHECK_THROW(kept_run(Json::array(), rung, two_norms), std::invalid_argument);
    BOOST_CHECK_THROW(kept_run(Json(), rung, two_norms), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_case_comes_back_bit_for_bit) {
    const StressCase after = kept_case(Json::parse(kept(judged()).dump()));
    BOOST_TEST(after.checks->energy == 1.0 / 3.0);
    StressCase other = judged();
    other.checks->path = {};
    other.checks->path_skipped = "no path";
    other.checks->error_skipped = "no error";
    other.checks->order_defect = 0.1;
    const StressCase again = kept_case(Json::parse(kept(other).dump()));
    BOOST_TEST(!again.checks->path.has_value());
    BOOST_TEST(again.checks->path_skipped == "no path");
    BOOST_TEST(again.checks->error_skipped == "no error");
    BOOST_TEST((again.checks->order_defect == 0.1));
    BOOST_TEST(std::isinf(after.checks->heat_residual));
    BOOST_TEST((after.checks->path == 0.1));
    BOOST_TEST(!after.checks->error.has_value());
    StressCase stopped;
    stopped.outcome = Outcome::stopped;
    stopped.reason = "not finite";
    BOOST_TEST((kept_case(Json::parse(kept(stopped).dump())).outcome == Outcome::stopped));
}

BOOST_AUTO_TEST_CASE(a_case_that_is_none_is_refused) {
    refused(kept(judged()),
            {{"/outcome", "wonderful", "outcome is none"},
             {"/outcome", 7, "outcome is not a text"},
             {"/outcome", "failed", "reason does not belong to the outcome"},
             {"/reason", "because", "reason does not belong to the outcome"},
             {"/checks", {1.0, 2.0}, "checks are not as many as there are"},
             {"/checks/2", "large", "a check is not a number"},
             {"/path", "short", "path is not a number"},
             {"/error_skipped", 1, "error_skipped is not a text"}},
            kept_case);
    Json without = kept(judged());
    without.erase("checks");
    BOOST_CHECK_THROW(kept_case(without), std::invalid_argument);
}

// A file of lines that is at its limit of size is as one on a full disk.
BOOST_AUTO_TEST_CASE(results_that_cannot_be_kept_do_not_end_the_study) {
    const TemporaryDirectory directory;
    const Scene scene = read_scene("table1");
    const Series ladder = scene.series().front();
    FinishedWork kept(scene, {});
    kept.keep_in(directory.path() / "unfinished.jsonl");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{.rlim_cur = 10, .rlim_max = before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    kept.add(ladder, 0, run());
    kept.write();
    setrlimit(RLIMIT_FSIZE, &before);
    kept.add(ladder, 1, run());
    std::signal(SIGXFSZ, handler);
    BOOST_TEST(has(kept.failure(), "cannot write"), kept.failure());
    BOOST_TEST(!kept.holds_runs());
    // Of what is left of the line nothing is read.
    BOOST_TEST(directory.read("unfinished.jsonl").size() <= 10U);
    FinishedWork again(scene, {});
    BOOST_TEST(again.read(directory.path() / "unfinished.jsonl").count == 1U);
    BOOST_TEST(again.found() == 0U);
}

// An attempt that was cut short behind its last run leaves nothing to add, and nothing to stay.
BOOST_AUTO_TEST_CASE(the_file_goes_with_the_end_of_a_study_that_made_no_run_of_its_own) {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "unfinished.jsonl";
    const Scene scene = read_scene("table1");
    {
        FinishedWork kept(scene, {});
        kept.keep_in(file);
        const Series ladder = scene.series().front();
        RungResult first = run();
        first.rung = ladder.rungs.front();
        kept.add(ladder, 0, first);
        kept.write();
    }
    FinishedWork again(scene, {});
    again.read(file);
    BOOST_TEST(again.found() == 1U);
    again.keep_in(file);
    again.remove();
    BOOST_TEST(!std::filesystem::exists(file));
}

BOOST_AUTO_TEST_SUITE_END()

// The study [work_precision]: its block, its runs, and what is made of them.

#include "studies/work_precision/work_precision.hpp"
#include "mms/text/input_error.hpp"
#include "studies/gates/check.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include <cmath>
#include <limits>
#include <ostream>
#include <set>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(work_precision)

namespace {

const std::string good = R"(solution = "copetti-fernandez-2011"
[beam]
alpha = 0.017
zeta  = 0.1
stops = [-0.02, 0.1]
[scheme]
thermal_mass = "lumped"
[work_precision]
final_time = 2.0
norms      = ["theta_L2L2_sq", "u_LinfH2semi"]
runs       = 3
[work_precision.targets]
theta_L2L2_sq = [5e-4]
[[work_precision.scheme]]
elements = [4, 8, 16]
dt       = "0.1/s"
[[work_precision.scheme]]
name     = "BDF2"
time     = "bdf2"
elements = [4, 8]
dt       = [0.1, 0.05]
)";

/// A block that is wrong in one place: `from` replaced by `to`, and what the message must then say.
struct Wrong {
    std::string from;
    std::string to;
    std::string place; ///< line:column; empty: no column is asked for
    std::string message;
};

std::ostream& operator<<(std::ostream& stream, const Wrong& wrong) {
    return stream << wrong.to;
}

const std::vector<Wrong> wrong_blocks{
    {"final_time = 2.0\n", "", "8:1", "work_precision.final_time is missing"},
    {"norms      = [\"theta_L2L2_sq\", \"u_LinfH2semi\"]", "norms = []", "10:9",
     "work_precision.norms is missing or empty"},
    {"u_LinfH2semi\"", "u_LinfH2sem\"", "10:32", "did you mean 'u_LinfH2semi'?"},
    {"runs       = 3", "runs       = 0", "11:14",
     "work_precision.runs is 0; it must be 1 to 10000"},
    {"runs       = 3", "runs       = 2.5", "11:14",
     "work_precision.runs is a number; it must be an integer"},
    {"runs       = 3", "run        = 3", "11:1", "did you mean 'runs'?"},
    {"[5e-4]", "[5e-4, 0]", "13:24",
     "work_precision.targets.theta_L2L2_sq holds 0; an error to reach is > 0"},
    {"theta_L2L2_sq = [5e-4]", "theta_L3L2_sq = [5e-4]", "13:1", "did you mean 'theta_L2L2_sq'?"},
    {"name     = \"BDF2\"", "name     = \"\"", "18:12",
     "work_precision.scheme.1.name has 0 characters; it must have 1 to 28"},
    {"name     = \"BDF2\"", "name     = \"a name of twenty-nine letters\"", "18:12",
     "has 29 characters"},
    {"name     = \"BDF2\"", "name     = \"a\\nb\"", "18:12", "must be one line of text"},
    {"name     = \"BDF2\"", "name     = \"euler, direct, lumped\"", "18:12",
     "two schemes are called 'euler, direct, lumped'; give work_precision.scheme.1.name another"},
    {"time     = \"bdf2\"", "time     = \"bdf3\"", "19:12",
     "work_precision.scheme.1.time is 'bdf3'; it must be one of 'euler', 'bdf2', 'sdirk2'"},
    {"time     = \"bdf2\"", "tim      = \"bdf2\"", "19:1",
     "unknown key 'work_precision.scheme.1.tim'; did you mean 'time'?"},
    {"time     = \"bdf2\"", "tolerance = 1e-7", "19:13",
     "work_precision.scheme.1.tolerance belongs to algorithm = \"fixed-point\""},
    {"dt       = [0.1, 0.05]", "dt       = [0.1]", "21:12",
     "work_precision.scheme.1.dt has 1 values, work_precision.scheme.1.elements has 2"},
    {"dt       = [0.1, 0.05]", "dt       = [0.1, 0.03]", "21:18",
     "work_precision.scheme.1.dt is 0.03; it must divide final_time = 2 into a whole number"},
    {"dt       = [0.1, 0.05]", "dt       = [0.05, 0.1]", "21:19", "coarser than the one before it"},
    {"elements = [4, 8]\n", "", "17:", "work_precision.scheme.1.elements is missing"},
    {good.substr(good.find("[[")), "", "8:1",
     "work_precision.scheme is missing; add a block [[work_precision.scheme]]"},
    {good.substr(good.find("[[")), "[work_precision.scheme]\nelements = [4]\ndt = [0.1]\n", "14:1",
     "work_precision.scheme is a table; it must be an array of tables, each headed "
     "[[work_precision.scheme]]"},
    {"[work_precision]", "[reference]\nelements = 64\ndt = 0.01\n[work_precision]", "",
     "work_precision measures errors against an exact solution"},
    {"solution = \"copetti-fernandez-2011\"", "[data]\ntheta0 = \"sin(pi*x)\"", "",
     "work_precision measures errors against an exact solution"},
};

std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const TemporaryDirectory directory;
    try {
        read_scene(directory.write("s.toml", text), overrides, {.expectations = true});
    } catch (const InputError& error) {
        std::string message = error.what();
        const auto at = message.find("s.toml");
        return at == std::string::npos ? message : message.substr(at);
    }
    return "accepted";
}

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const TemporaryDirectory directory;
    return read_scene(directory.write("s.toml", text), overrides, {.expectations = true});
}

WorkPrecisionResult timed(const Scene& scene, double one_run_above = 1e9) {
    const ProblemData problem = problem_of(scene, scene.longest_time());
    return run_work_precision(*scene.get<WorkPrecisionBlock>(),
                              beam_runs(scene, problem, problem, Defects()), {}, one_run_above);
}

/// A scheme with made-up errors, in times 1 s, 2 s, 4 s, ….
SchemeRuns made_up(const std::vector<double>& errors, double factor) {
    SchemeRuns scheme;
    double seconds = factor;
    for (const double error : errors) {
        RungResult run;
        run.status = std::isnan(error) ? RungStatus::failed : RungStatus::ok;
        if (!std::isnan(error))
            run.errors = {error, error};
        scheme.runs.push_back(run);
        scheme.timings.push_back(std::isnan(error) ? std::nullopt
                                                   : std::optional(timing_of({seconds, seconds})));
        seconds *= 2.0;
    }
    return scheme;
}

constexpr double failed = std::numeric_limits<double>::quiet_NaN();

/// As many schemes as ladders of errors.
WorkPrecisionBlock block_for(const std::vector<SchemeRuns>& schemes) {
    WorkPrecisionBlock block;
    block.norms = {measure_of(*Norm::named("theta_L2L2")), measure_of(*Norm::named("u_L2H2"))};
    for (std::size_t k = 0; k < schemes.size(); ++k)
        block.schemes.push_back({"scheme " + std::to_string(k),
                                 {},
                                 std::vector<Rung>(schemes[k].runs.size(), {10, 20, 0.1})});
    return block;
}

const ReachedError& at(const NormCosts& costs, double error) {
    return *std::find_if(costs.errors.begin(), costs.errors.end(),
                         [&](const ReachedError& one) { return one.error == error; });
}

} // namespace

BOOST_AUTO_TEST_CASE(the_block_is_read_as_written) {
    const WorkPrecisionBlock block = *scene_of(good).get<WorkPrecisionBlock>();
    BOOST_TEST(block.final_time == 2.0);
    BOOST_TEST(block.norms.size() == 2u);
    BOOST_TEST(block.runs == 3);
    BOOST_TEST(block.targets.at("theta_L2L2_sq") == std::vector<double>{5e-4});
    BOOST_REQUIRE(block.schemes.size() == 2u);
    // What is absent is as in [scheme], and the name says what the scheme is.
    BOOST_TEST(block.schemes[0].name == "euler, direct, lumped");
    BOOST_TEST((scheme_of(block.schemes[0].method).thermal_mass == ThermalMass::lumped));
    BOOST_TEST(block.schemes[0].rungs[2].elements == 16);
    BOOST_TEST(block.schemes[0].rungs[2].steps == 320);
    BOOST_TEST(block.schemes[1].name == "BDF2");
    BOOST_TEST(scheme_of(block.schemes[1].method).time.name == "bdf2");
    BOOST_TEST((scheme_of(block.schemes[1].method).thermal_mass == ThermalMass::lumped));
    BOOST_TEST(block.schemes[1].rungs[1].steps == 40);
}

BOOST_AUTO_TEST_CASE(twenty_runs_unless_the_scene_says_otherwise) {
    std::string text = good;
    text.erase(text.find("runs       = 3\n"), 15);
    BOOST_TEST(scene_of(text).get<WorkPrecisionBlock>()->runs == 20);
}

BOOST_DATA_TEST_CASE(a_wrong_block_is_told_at_its_place, data::make(wrong_blocks), wrong) {
    std::string text = good;
    const auto at = text.find(wrong.from);
    BOOST_REQUIRE(at != std::string::npos);
    text.replace(at, wrong.from.size(), wrong.to);
    const std::string message = message_of(text);
    BOOST_TEST(message.starts_with("s.toml:" + wrong.place), message);
    BOOST_TEST(message.find(wrong.message) != std::string::npos,
               message << " must say " << wrong.message);
    BOOST_TEST(message.find('\n') == std::string::npos, "one line: " << message);
}

BOOST_AUTO_TEST_CASE(overrides_reach_the_block_and_each_scheme_by_its_number) {
    const Scene scene =
        scene_of(good, {"work_precision.runs=5", "work_precision.scheme.1.elements=[5]",
                        "work_precision.scheme.1.dt=\"0.5/s\"",
                        "work_precision.scheme.0.algorithm=fixed-point"});
    BOOST_TEST(scene.get<WorkPrecisionBlock>()->runs == 5);
    BOOST_TEST(scene.get<WorkPrecisionBlock>()->schemes[1].rungs[0].elements == 5);
    BOOST_TEST(scene.get<WorkPrecisionBlock>()->schemes[1].rungs[0].steps == 20);
    BOOST_TEST(scene.get<WorkPrecisionBlock>()->schemes[0].name == "euler, fixed-point, lumped");
    BOOST_TEST(scene_of(good, {"work_precision.scheme=[{elements=[7], dt=[1]}]"})
                   .get<WorkPrecisionBlock>()
                   ->schemes.size() == 1u);
    const auto says = [](const std::string& override_text, const std::string& part) {
        const std::string message = message_of(good, {override_text});
        BOOST_TEST(message.starts_with("--set " + override_text + ": "), message);
        BOOST_TEST(message.find(part) != std::string::npos, message << " must say " << part);
    };
    says("work_precision.scheme.2.dt=1", "an array of 2 tables; name one by its number, 0 to 1");
    says("work_precision.scheme.dt=1", "not 'dt'");
    says("work_precision.scheme.-1.dt=1", "not '-1'");
    says("work_precision.scheme.0=1", "name the key behind it");
    says("work_precision.scheme.1.dt=[3, 0.05]", "work_precision.scheme.1.dt is 3");
}

BOOST_AUTO_TEST_CASE(the_short_form_replaces_the_list_of_schemes) {
    const TemporaryDirectory directory;
    const std::string file = directory.write(
        "s.toml", good + "[[short.work_precision.scheme]]\nelements = [4]\ndt = [0.1]\n");
    BOOST_TEST(read_scene(file).get<WorkPrecisionBlock>()->schemes.size() == 2u);
    const Scene scene = read_scene(file, {}, {.short_form = true});
    BOOST_TEST(scene.get<WorkPrecisionBlock>()->schemes.size() == 1u);
    BOOST_TEST(scene.get<WorkPrecisionBlock>()->runs == 3);
}

BOOST_AUTO_TEST_CASE(errors_are_those_of_a_ladder_and_counters_those_of_a_run_without_norms) {
    const Scene scene =
        scene_of(good + "[ladder]\nfinal_time = 2.0\nelements = [4, 8, 16]\ndt = \"0.1/s\"\n"
                        "norms = [\"theta_L2L2_sq\", \"u_LinfH2semi\"]\n");
    const StudyResult result = run_study(scene);
    const SchemeRuns& euler = result.get<WorkPrecisionResult>()->schemes[0];
    for (std::size_t i = 0; i < 3; ++i) {
        BOOST_TEST(euler.runs[i].errors == result.get<LadderResult>()->rungs[i].errors);
        BOOST_TEST(euler.runs[i].count("steps") ==
                   result.get<LadderResult>()->rungs[i].count("steps"));
        BOOST_TEST(euler.runs[i].count("norm_evaluations") == 0);
        BOOST_REQUIRE(euler.timings[i]);
        BOOST_TEST(euler.timings[i]->runs == 3);
        BOOST_TEST(euler.timings[i]->min > 0.0);
        BOOST_TEST(euler.timings[i]->min <= euler.timings[i]->q1);
        BOOST_TEST(euler.timings[i]->q1 <= euler.timings[i]->median);
        BOOST_TEST(euler.timings[i]->median <= euler.timings[i]->q3);
    }
    BOOST_TEST(node_steps(euler.runs[2].rung) == 16 * 320);
}

BOOST_AUTO_TEST_CASE(a_run_longer_than_the_limit_is_timed_once) {
    const Scene scene = scene_of(good);
    for (const auto& [limit, runs] : {std::pair{0.0, 1}, {1e9, 3}})
        for (const auto& scheme : timed(scene, limit).schemes)
            for (const auto& timing : scheme.timings)
                BOOST_TEST(timing->runs == runs);
}

// 5 runs of 0.1 s fill half a second, 13 of 0.04 s; 20 of 1 ms do not. The last is in the last
// round, so that what slows the machine down meanwhile slows all.
BOOST_AUTO_TEST_CASE(long_runs_are_timed_less_often_and_over_the_same_time) {
    const Scene scene = scene_of(good, {"work_precision.runs=20"});
    std::vector<std::pair<std::string, std::int64_t>> calls;
    const auto seconds = [](const RunTask& task) {
        return task.rung.elements == 16 ? 0.1 : task.rung.elements == 8 ? 0.04 : 1e-3;
    };
    const auto result = run_work_precision(
        *scene.get<WorkPrecisionBlock>(), StudiedSolver{.run = [&](const RunTask& task) {
            calls.emplace_back(task.method.words, task.rung.elements);
            RungResult made;
            made.rung = task.rung;
            made.errors.assign(task.measures.size(), 0.5);
            made.seconds = seconds(task);
            return made;
        }});
    for (const auto& scheme : result.schemes)
        for (std::size_t i = 0; i < scheme.runs.size(); ++i)
            BOOST_TEST(scheme.timings[i]->runs == (std::vector<int>{20, 13, 5}[i]));
    const std::vector<std::pair<std::string, std::int64_t>> last(calls.end() - 5, calls.end());
    BOOST_TEST((std::set(last.begin(), last.end()).size()) == 5U); // 3 levels and 2
}

/// Two schemes of a program that says how long it took, beside one of 3e-03 s, and what follows for
/// their times.
struct OwnClock {
    std::string a, b;       ///< the seconds that it prints
    double lowest, highest; ///< of the slower over the faster
    bool told_apart;
};

std::ostream& operator<<(std::ostream& stream, const OwnClock& clock) {
    return stream << clock.a << " and " << clock.b;
}

constexpr double beyond = std::numeric_limits<double>::infinity();

const std::vector<OwnClock> own_clocks{
    {"1e-01", "2e-01", 0.1 / 0.2, beyond, false},     // 0.149 s and 0.151 s, in one digit
    {"0.01", "0.0134", 0.0133 / 0.02, beyond, false}, // 0.0149 s, by another clock
    {"0.0134", "0.04", 0.03 / 0.0135, 0.05 / 0.0133, true},
    {"0.10", "0.20", 0.19 / 0.11, 0.21 / 0.09, true},              // no clock of tenths
    {"0.10000000000000001", "0.15", 0.14 / 0.1, 0.16 / 0.1, true}, // to all digits of a double
    {"1.00e-01", "3e-01", 0.2 / 0.101, 0.4 / 0.099, true}};

BOOST_DATA_TEST_CASE(a_time_is_known_to_the_last_digit_that_its_program_prints,
                     data::make(own_clocks), clock) {
    const auto scheme = [](const std::string& seconds) {
        return "[[work_precision.scheme]]\nname = '" + seconds +
               "'\nelements = [4]\nparameters = { t = '" + seconds + "' }\n";
    };
    const Scene scene =
        scene_of("[solver]\ncommand = ['sh', '-c', 'echo e = 1; echo s = {t}']\n"
                 "errors = { e = 'e = (.*)' }\nseconds = 's = (.*)'\nparameters = { t = '0' }\n"
                 "[work_precision]\nnorms = ['e']\nruns = 3\n" +
                 scheme(clock.a) + scheme(clock.b) + scheme("3e-03"));
    const StudyResult result = run_study(scene);
    const auto& costs = result.get<WorkPrecisionResult>()->norms[0];
    const Comparison& times = at(costs, 1.0).comparisons.at(0).times;
    BOOST_TEST(times.lowest == clock.lowest, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(times.highest == clock.highest, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(times.distinguishable == clock.told_apart);
}

// Three rows are measured and warm up, which is all that a long run does; the seventh run is the
// first one timed.
BOOST_AUTO_TEST_CASE(what_an_interruption_left_untimed_has_no_time_by_its_warm_up) {
    const Scene scene =
        scene_of(good, {"work_precision.scheme=[{elements=[4, 8, 16], dt=\"0.1/s\"}]"});
    for (const int made : {7, 6}) {
        int runs = 0;
        const auto result = run_work_precision(
            *scene.get<WorkPrecisionBlock>(), StudiedSolver{.run = [&](const RunTask& task) {
                RungResult run{.rung = task.rung, .seconds = task.rung.elements == 16 ? 9.0 : 0.1};
                run.status = runs++ < made ? RungStatus::ok : RungStatus::interrupted;
                run.errors.assign(task.measures.size(), 0.5);
                return run;
            }});
        const SchemeRuns& scheme = result.schemes[0];
        BOOST_TEST(result.interrupted);
        BOOST_TEST(scheme.timings[0].has_value() == (made == 7));
        BOOST_TEST(!scheme.timings[1]);
        BOOST_TEST((scheme.runs[1].status == RungStatus::ok)); // its error stands
        BOOST_REQUIRE(scheme.timings[2]);
        BOOST_TEST(scheme.timings[2]->median == 9.0);
    }
}

// A program prints its errors also where it is timed: one that has none then has failed, and errors
// that change are named; a change of a part in a million may be that of sums in another order.
BOOST_AUTO_TEST_CASE(what_a_program_prints_when_it_is_timed_is_read) {
    const Scene scene =
        scene_of(good, {"work_precision.scheme=[{elements=[4, 8, 16], dt=\"0.1/s\"}]"});
    const auto found = [&](double change, bool fails) {
        std::map<std::int64_t, int> runs;
        return run_work_precision(
            *scene.get<WorkPrecisionBlock>(),
            StudiedSolver{.run =
                              [&](const RunTask& task) {
                                  RungResult run{.rung = task.rung, .seconds = 0.1};
                                  const int made = runs[task.rung.elements]++;
                                  const bool other = made == 3 && task.rung.elements == 8;
                                  run.errors.assign(task.measures.size(),
                                                    0.5 * (other ? 1.0 + change : 1.0));
                                  if (other && fails)
                                      run.status = RungStatus::failed;
                                  return run;
                              },
                          .measures_for_nothing = true});
    };
    BOOST_TEST(found(0.0, false).norms[0].remarks.empty());
    BOOST_TEST(found(1e-9, false).norms[0].remarks.empty());
    const auto changed = found(0.25, false);
    BOOST_REQUIRE(changed.norms[0].remarks.size() == 1U);
    BOOST_TEST(changed.norms[0].remarks[0].find("s = 8") != std::string::npos);
    BOOST_TEST(changed.norms[0].remarks[0].find("by a part of 0.2;") != std::string::npos);
    BOOST_TEST(changed.schemes[0].timings[1].has_value());
    const auto failed = found(0.0, true);
    BOOST_TEST((failed.schemes[0].runs[1].status == RungStatus::failed));
    BOOST_TEST(!failed.schemes[0].timings[1]);
}

BOOST_AUTO_TEST_CASE(a_run_that_failed_stays_with_its_reason_and_without_a_time) {
    // At α = 9 the fixed point contracts for Δt = 1e-3 (factor 81e-3/0.1), not for Δt = 1 (factor
    // 81/1.1/10.9, half of which is left where a stop holds the tip).
    const Scene scene = scene_of(
        good, {"beam.alpha=9", "work_precision.scheme.0.algorithm=fixed-point",
               "work_precision.scheme.0.elements=[4, 4]", "work_precision.scheme.0.dt=[1, 1e-3]"});
    const StudyResult result = run_study(scene);
    const SchemeRuns& scheme = result.get<WorkPrecisionResult>()->schemes[0];
    BOOST_TEST((scheme.runs[0].status == RungStatus::failed));
    BOOST_TEST(scheme.runs[0].reason.find("would not contract") != std::string::npos);
    BOOST_TEST(!scheme.timings[0]);
    BOOST_TEST((scheme.runs[1].status == RungStatus::ok));
    BOOST_TEST(scheme.timings[1].has_value());
    BOOST_TEST(result.failed());
}

BOOST_AUTO_TEST_CASE(a_scene_with_timed_runs_alone_leaves_out_neither_heat_nor_bending) {
    const StudyResult result =
        run_study(scene_of(good, {"beam.alpha=0", "work_precision.norms=[\"theta_L2L2\"]"}));
    for (const auto& part : result.left_out)
        BOOST_TEST(!part.starts_with("deflection"), part);
    BOOST_TEST(!result.get<LadderResult>());
    BOOST_TEST(!result.get<OrdersResult>());
}

BOOST_AUTO_TEST_CASE(errors_to_reach_are_powers_of_ten_and_the_targets_from_large_to_small) {
    const std::vector<SchemeRuns> schemes{made_up({1e-3, 1e-11}, 1.0)};
    WorkPrecisionBlock block = block_for(schemes);
    block.targets["theta_L2L2"] = {3e-4, 1e-5};
    const auto norms = costs_of(block, schemes);
    std::vector<double> errors;
    std::vector<double> targets;
    for (const auto& reached : norms[0].errors) {
        errors.push_back(reached.error);
        if (reached.target)
            targets.push_back(reached.error);
    }
    // 1e-9 is the last one in any case; 1e-11 is the smallest error measured.
    const std::vector<double> expected{1e-2, 1e-3, 3e-4, 1e-4,  1e-5, 1e-6,
                                       1e-7, 1e-8, 1e-9, 1e-10, 1e-11};
    BOOST_TEST(errors == expected, boost::test_tools::per_element());
    BOOST_TEST(targets == (std::vector<double>{3e-4, 1e-5}), boost::test_tools::per_element());
    BOOST_TEST(norms[1].errors.size() == 10u);
    BOOST_TEST(
        costs_of(block_for({made_up({1e-3}, 1.0)}), {made_up({1e-3}, 1.0)})[0].errors.size() == 8u);
}

// Powers of ten above 1e-2 where every scheme has an error above them: of errors of 3e4 and 20,
// and of 500 and 2, at 100 the second is reached by the first scheme in 2 s and the other in 4 s.
BOOST_AUTO_TEST_CASE(large_errors_are_compared_at_large_powers_of_ten) {
    const std::vector<SchemeRuns> schemes{made_up({3e4, 20}, 1.0), made_up({500, 2}, 2.0)};
    const auto errors = costs_of(block_for(schemes), schemes)[0].errors;
    BOOST_TEST(errors.front().error == 100);
    BOOST_REQUIRE(errors.front().comparisons.size() == 1U);
    BOOST_TEST(errors.front().comparisons[0].faster == 0U);
    BOOST_TEST(errors[1].error == 10);
    BOOST_TEST(errors[1].comparisons.empty());
    const std::vector<SchemeRuns> diverging{made_up({1e200, 1e300}, 1.0)};
    BOOST_TEST(costs_of(block_for(diverging), diverging)[0].errors.front().error == 1e12);
}

BOOST_AUTO_TEST_CASE(every_two_schemes_that_reach_an_error_are_compared_there) {
    const std::vector<SchemeRuns> schemes{made_up({1e-1, 1e-3, 1e-5}, 4.0),
                                          made_up({1e-1, 1e-3, 1e-5}, 1.0),
                                          made_up({1e-1, failed, 1e-3}, 2.0)};
    const auto norms = costs_of(block_for(schemes), schemes);
    const ReachedError& all = at(norms[0], 1e-3);
    BOOST_REQUIRE(all.comparisons.size() == 3u);
    BOOST_TEST(all.comparisons[0].faster == 1u);
    BOOST_TEST(all.comparisons[0].slower == 0u);
    BOOST_TEST(all.comparisons[0].times.ratio == 4.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(all.comparisons[0].times.distinguishable);
    // The third takes 8 s to 1e-3, as the first does.
    BOOST_TEST(!all.comparisons[1].times.distinguishable);
    // Across the failed row it reaches nothing.
    BOOST_TEST(at(norms[0], 1e-2).comparisons.size() == 1u);
    BOOST_TEST(at(norms[0], 1e-6).comparisons.empty());
}

BOOST_AUTO_TEST_CASE(an_error_that_rises_along_its_ladder_is_remarked) {
    const std::vector<SchemeRuns> schemes{made_up({1e-1, 1e-5, 1e-3}, 1.0)};
    const auto norms = costs_of(block_for(schemes), schemes);
    BOOST_REQUIRE(norms[0].remarks.size() == 1u);
    BOOST_TEST(norms[0].remarks[0].starts_with("scheme 0: theta_L2L2 rises from s = 10, dt = 0.1"));
    const std::vector<SchemeRuns> across{made_up({1e-3, failed, 1e-2}, 1.0)};
    BOOST_TEST(costs_of(block_for(across), across)[0].remarks.size() == 1u);
    const std::vector<SchemeRuns> falling{made_up({1e-1, 1e-2, failed, 1e-3}, 1.0)};
    BOOST_TEST(costs_of(block_for(falling), falling)[0].remarks.empty());
}

BOOST_AUTO_TEST_CASE(what_a_clock_that_stands_still_has_timed_is_compared_with_nothing) {
    std::vector<SchemeRuns> schemes{made_up({1e-1, 1e-3, 1e-5}, 1.0), made_up({1e-1, 1e-5}, 2.0),
                                    made_up({1e-1, 1e-5}, 2.0)};
    schemes[0].timings[0] = timing_of({0.0, 0.0, 0.0});
    schemes[2].timings[0] = timing_of({1.0, 0.0, 1.0, 0.0, 1.0});
    const auto norms = costs_of(block_for(schemes), schemes);
    BOOST_TEST(!at(norms[0], 1e-2).times[0].has_value());
    BOOST_TEST(!at(norms[0], 1e-2).times[2].has_value());
    BOOST_TEST(std::isfinite(at(norms[0], 1e-4).comparisons.at(0).times.ratio));
    BOOST_REQUIRE(norms[0].remarks.size() == 2u);
    BOOST_TEST(norms[0].remarks[0].starts_with("scheme 0: the clock shows 0 s at s = 10"));
    BOOST_TEST(
        norms[0].remarks[1].starts_with("scheme 2: the clock shows 0 s in 2 of 5 runs at s = 10"));
}

BOOST_AUTO_TEST_CASE(a_busy_machine_is_remarked) {
    BOOST_TEST(busy_remark(9.5, 10.0).empty());
    BOOST_TEST(busy_remark(1.3, 10.0).find("had 13 % of a core") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_program_that_waits_makes_no_machine_busy) {
    const Scene scene =
        scene_of("[solver]\ncommand = ['sh', '-c', 'sleep 0.1; echo e = 1']\n"
                 "errors = { e = 'e = (.*)' }\n[work_precision]\nnorms = ['e']\nruns = 1\n"
                 "[[work_precision.scheme]]\nelements = [4]\n");
    BOOST_TEST(run_study(scene).get<WorkPrecisionResult>()->busy_remark.empty());
}

BOOST_AUTO_TEST_CASE(errors_and_orders_of_a_scheme_are_expected_by_its_name) {
    const Scene scene = scene_of(good);
    const double error = timed(scene).schemes[1].runs[1].errors[0];
    const auto violations = [](const std::string& expect) {
        const auto all = check(run_study(scene_of(good + expect)));
        std::size_t count = 0;
        for (const auto& one : all)
            count += one.holds ? 0 : 1;
        return std::pair{all.size(), count};
    };
    std::ostringstream right;
    right.precision(17);
    right << "[expect.work_precision.BDF2.theta_L2L2_sq]\nerrors = [1, " << error
          << "]\norders = [3, 5]\n";
    // Two errors, of which the first is far from 1, and one order.
    BOOST_TEST((violations(right.str()) == std::pair<std::size_t, std::size_t>{3, 1}));
    BOOST_TEST((violations("[expect.work_precision.BDF2.theta_L2L2_sq]\norders = [1, 3]\n") ==
                std::pair<std::size_t, std::size_t>{1, 1}));
    const auto all =
        check(run_study(scene_of(good + "[expect.work_precision.BDF2.u_LinfH2semi]\norders = [5, "
                                        "6]\n")));
    BOOST_TEST(all[0].what ==
               "work_precision.BDF2.u_LinfH2semi: observed order at s = 8, dt = 0.05");
    const auto says = [](const std::string& expect, const std::string& part) {
        const std::string message = message_of(good + expect);
        BOOST_TEST(message.find(part) != std::string::npos, message << " must say " << part);
    };
    says("[expect.work_precision.BDF3.theta_L2L2_sq]\norders = [1, 2]\n", "did you mean 'BDF2'?");
    says("[expect.work_precision.BDF2.theta_L2]\norders = [1, 2]\n",
         "expect.work_precision.BDF2.theta_L2 expects something of what the study does not");
    says("[expect.work_precision.BDF2.theta_L2L2_sq]\nerrors = [1, 2, 3]\n",
         "has 3 values for 2 rungs");
    says("[expect.work_precision.BDF2.theta_L2L2_sq]\nseconds = [1, 2]\n", "unknown key");
    says("[expect.ladder.theta_L2L2_sq]\norders = [1, 2]\n", "it has no block [ladder] with norms");
}

// A scene has at most 1e7 elements and 1e12 steps, 1e19 < 2^64 = 1.8e19; a program's runs may be
// more.
BOOST_AUTO_TEST_CASE(the_size_of_a_run_does_not_wrap_around) {
    BOOST_TEST(node_steps({10, 2000, 1e-3}) == 20000u);
    BOOST_TEST(node_steps({10'000'000, 1'000'000'000'000, 1e-12}) == 10'000'000'000'000'000'000u);
    BOOST_TEST(node_steps({10'000'000, 4'000'000'000'000, 1e-12}) ==
               std::numeric_limits<std::uint64_t>::max());
}

BOOST_AUTO_TEST_SUITE_END()

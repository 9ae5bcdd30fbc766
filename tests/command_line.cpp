// The program as its users call it: exit codes, one message, nothing half written.

#include "tests/called_program.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

using namespace tvbeam;

namespace {

const std::string small = "run table1 --set 'ladder.elements=[4,8]' --set ladder.dt=0.1 --set "
                          "'ladder.dt=[0.1,0.05]' --set 'ladder.printed={}'";

} // namespace

BOOST_AUTO_TEST_SUITE(command_line)

BOOST_AUTO_TEST_CASE(a_run_prints_its_table_and_exits_with_zero) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small);
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(called.errors.empty(), called.errors);
    BOOST_TEST(has(called.output, "theta_L2L2_sq"));
    BOOST_TEST(has(called.output, "ord."));
    std::istringstream lines(called.output);
    for (std::string line; std::getline(lines, line);)
        BOOST_TEST(line.size() <= 82u, line); // 80 columns; é and other letters take two bytes
}

BOOST_AUTO_TEST_CASE(json_has_the_keys_of_its_schema_and_reads_back_exactly) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + " --json -");
    BOOST_TEST(called.exit == 0);
    const auto json = nlohmann::json::parse(called.output);
    BOOST_TEST(json.at("schema") == "tvbeam-result/1");
    BOOST_TEST(json.at("scene").at("beam").at("alpha") == 0.017);
    BOOST_TEST(json.at("left_out").is_array());
    BOOST_TEST(json.at("provenance").contains("version"));
    const auto& rungs = json.at("ladder").at("rungs");
    BOOST_REQUIRE(rungs.size() == 2u);
    BOOST_TEST(rungs[0].at("elements") == 4);
    BOOST_TEST(rungs[1].at("steps") == 40);
    BOOST_TEST(rungs[1].at("status") == "ok");
    BOOST_TEST(rungs[0].at("orders").at("theta_L2L2_sq").is_null());
    const double e0 = rungs[0].at("errors").at("theta_L2L2_sq");
    const double e1 = rungs[1].at("errors").at("theta_L2L2_sq");
    BOOST_TEST(rungs[1].at("orders").at("theta_L2L2_sq").get<double>() ==
                   std::log(e0 / e1) / std::log(2.0),
               boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(csv_and_json_hold_the_same_doubles) {
    const TemporaryDirectory directory;
    const std::string csv = (directory.path() / "t.csv").string();
    const std::string json_file = (directory.path() / "t.json").string();
    BOOST_TEST(call(directory, small + " --csv " + csv + " --json " + json_file).exit == 0);
    const auto json = nlohmann::json::parse(directory.read("t.json"));
    std::istringstream lines(directory.read("t.csv"));
    std::string line;
    std::getline(lines, line);
    BOOST_TEST(
        line ==
        "elements,h,dt,steps,status,theta_L2L2_sq,theta_L2L2_sq_order,theta_L2L2_sq_predicted,"
        "u_LinfH2semi_sq,u_LinfH2semi_sq_order,u_LinfH2semi_sq_predicted,seconds,reason");
    for (const auto& rung : json.at("ladder").at("rungs")) {
        BOOST_REQUIRE(std::getline(lines, line));
        std::istringstream fields(line);
        std::string field;
        for (int i = 0; i < 6; ++i)
            std::getline(fields, field, ',');
        BOOST_TEST(std::stod(field) == rung.at("errors").at("theta_L2L2_sq").get<double>());
    }
    BOOST_TEST(directory.count() == 2u); // no temporary file is left
}

BOOST_AUTO_TEST_CASE(two_reports_in_one_file_are_refused) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "r").string();
    BOOST_TEST(call(directory, small + " --json " + file + " --csv " + file).exit == 2);
    BOOST_TEST(directory.count() == 0u);
}

BOOST_AUTO_TEST_CASE(a_grid_without_a_ladder_has_a_csv_of_its_own) {
    const TemporaryDirectory directory;
    const std::string csv = (directory.path() / "grid.csv").string();
    const std::string grid =
        "run table1-orders --set 'orders.elements=[4,8,16]' --set 'orders.dt=[0.1,0.05,0.025]' ";
    BOOST_TEST(call(directory, grid + "--csv " + csv).exit == 0);
    BOOST_TEST(
        has(call(directory, "analyse " + csv + " --error theta_L2L2").output, "a grid of 9 runs"));
}

BOOST_AUTO_TEST_CASE(bad_input_exits_with_two_says_one_line_and_writes_nothing) {
    const TemporaryDirectory directory;
    const std::string out = (directory.path() / "out.json").string();
    for (const std::string arguments :
         {"run no-such-scene", "run table1 --set beam.zeta=-1", "run table1 --set beam.zata=1",
          "run table1 --set 'ladder.elements=[]'", "run table1 --set beam.alpha=1e400",
          "run table1 --set solution=missing", "derive no-such-solution"}) {
        const Called called =
            call(directory, arguments + (arguments.starts_with("run") ? " --json " + out : ""));
        BOOST_TEST(called.exit == 2, arguments);
        BOOST_TEST(called.output.empty());
        BOOST_TEST(called.errors.starts_with("tvbeam: "), called.errors);
        BOOST_TEST(std::count(called.errors.begin(), called.errors.end(), '\n') == 1,
                   called.errors);
        BOOST_TEST(directory.count() == 0u, arguments);
    }
}

BOOST_AUTO_TEST_CASE(wrong_usage_exits_with_two) {
    const TemporaryDirectory directory;
    for (const std::string arguments : {"", "frobnicate", "run", "run table1 --no-such-option",
                                        "run table1 table1", "run table1 --json - --csv -"}) {
        const Called called = call(directory, arguments);
        BOOST_TEST(called.exit == 2, arguments);
        BOOST_TEST(!called.errors.empty());
    }
    BOOST_TEST(call(directory, "runn table1").errors ==
               "tvbeam: 'runn': is not a command; did you mean 'run'?; tvbeam --help lists them\n");
}

BOOST_AUTO_TEST_CASE(a_number_of_jobs_that_is_not_one_is_refused) {
    const TemporaryDirectory directory;
    for (const std::string command : {"run", "check"})
        for (const std::string number : {"0", "-1", "two", "1.5", "99999999999999999999", "''"}) {
            const Called called = call(directory, command + " table1 --jobs " + number);
            BOOST_TEST(called.exit == 2, number);
            BOOST_TEST(called.output.empty());
            BOOST_TEST(has(called.errors, "--jobs"), called.errors);
        }
}

BOOST_AUTO_TEST_CASE(jobs_change_nothing_but_the_seconds) {
    const TemporaryDirectory directory;
    const auto without_seconds = [&](const std::string& jobs) {
        auto json =
            nlohmann::json::parse(call(directory, small + " --json - --jobs " + jobs).output);
        for (auto& rung : json.at("ladder").at("rungs"))
            rung.erase("seconds");
        for (auto& run : json.at("orders").at("runs"))
            run.erase("seconds");
        json.at("provenance").erase("date");
        return json;
    };
    BOOST_TEST(without_seconds("1") == without_seconds("3"));
}

BOOST_AUTO_TEST_CASE(help_exits_with_zero_and_shows_an_example) {
    const TemporaryDirectory directory;
    for (const std::string command : {"run", "check", "analyse", "derive", "list"}) {
        const Called called = call(directory, command + " --help");
        BOOST_TEST(called.exit == 0);
        BOOST_TEST(has(called.output, "Example: tvbeam " + command));
    }
    BOOST_TEST(call(directory, "--version").exit == 0);
}

BOOST_AUTO_TEST_CASE(a_failed_run_exits_with_three_and_keeps_what_was_finished) {
    // The fixed point contracts by α²Δt/((Δt + ζ)(1 + π²Δt)): 0.5²·0.01/0.11/1.1 at the first step,
    // but for Δt = 1 and α = 5 it is 25/1.1/10.9 > 1.
    const TemporaryDirectory directory;
    const Called called = call(
        directory,
        "run table1 --set scheme.algorithm=fixed-point --set beam.alpha=5 --set "
        "'ladder.elements=[4,4]' --set 'ladder.dt=[1,1e-4]' --set 'ladder.printed={}' --json -");
    BOOST_TEST(called.exit == 3);
    const auto json = nlohmann::json::parse(called.output);
    const auto& rungs = json.at("ladder").at("rungs");
    BOOST_TEST(rungs[1].at("status") == "ok");
    BOOST_TEST(rungs[1].at("errors").at("theta_L2L2_sq").is_number());
    BOOST_TEST(rungs[0].at("status") == "failed");
    BOOST_TEST(rungs[0].at("errors").at("theta_L2L2_sq").is_null());
    BOOST_TEST(has(rungs[0].at("reason"), "predicted; use the direct algorithm"));
    BOOST_TEST(has(called.errors, "a run failed"));
}

BOOST_AUTO_TEST_CASE(an_overflow_is_said_and_not_printed_as_a_number) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + " --set beam.alpha=1e200");
    BOOST_TEST(called.exit != 0);
    BOOST_TEST(!has(called.output, " nan"));
    BOOST_TEST(has(called.output + called.errors, "finite"));
}

BOOST_AUTO_TEST_CASE(a_place_that_cannot_be_written_is_said_before_anything_runs) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + " --json /no/such/directory/r.json");
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(called.output.empty());
    BOOST_TEST(has(called.errors, "cannot write '/no/such/directory/r.json'"));
}

BOOST_AUTO_TEST_CASE(a_device_is_written_to_and_not_replaced) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + " --csv /dev/full");
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(has(called.errors, "cannot write '/dev/full'"));
    BOOST_TEST(std::filesystem::is_character_file("/dev/full"));
}

BOOST_AUTO_TEST_CASE(standard_output_that_cannot_be_written_is_said) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + " >/dev/full");
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(has(called.errors, "cannot write to standard output"));
}

BOOST_AUTO_TEST_CASE(what_a_stress_study_did_not_measure_is_blank_or_said) {
    const TemporaryDirectory directory;
    const Called stopped = call(directory, "run roundoff --set stress.roundoff.alpha=100 --set "
                                           "'stress.roundoff.elements=[10]'");
    BOOST_TEST(has(stopped.output, "s = 10: the Hermite form stopped: the fixed-point iteration"),
               stopped.output);

    // A prime number of elements has no fast transform, hence no sine basis to compare with.
    directory.write("scene.toml", "[stress.sweep.a]\nelements = [127]\nsteps = 2\n");
    const Called few = call(directory, "run " + directory.path().string() + "/scene.toml");
    // Without stops there is no contact either: the row ends with the residual.
    const auto row = few.output.find("  all         1       0       0      0");
    BOOST_REQUIRE(row != std::string::npos);
    std::istringstream line(few.output.substr(row, few.output.find('\n', row) - row));
    const std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
    BOOST_TEST(words.size() == 7U); // all, four outcomes, energy, residual
    BOOST_TEST(!has(few.output, "penetration:"));
}

BOOST_AUTO_TEST_CASE(check_passes_shipped_scenes_and_writes_junit) {
    const TemporaryDirectory directory;
    const std::string xml = (directory.path() / "j.xml").string();
    const Called called =
        call(directory, "check --short free-oscillation heated-end --junit " + xml);
    BOOST_TEST(called.exit == 0, called.output);
    BOOST_TEST(has(called.output, "ok    free-oscillation"));
    const std::string text = directory.read("j.xml");
    BOOST_TEST(has(text, "<testsuite name=\"heated-end\""));
    BOOST_TEST(!has(text, "<failure"));
}

BOOST_AUTO_TEST_CASE(check_fails_with_one_and_a_line_for_each_violation) {
    const TemporaryDirectory directory;
    const std::string xml = (directory.path() / "j.xml").string();
    const Called called =
        call(directory,
             "check heated-end --set 'expect.ladder.theta_L2H1.orders=[1.9,2.1]' --junit " + xml);
    BOOST_TEST(called.exit == 1);
    BOOST_TEST(has(called.output, "FAIL  heated-end"));
    BOOST_TEST(std::count(called.output.begin(), called.output.end(), '\n') == 1 + 3,
               called.output);
    BOOST_TEST(has(called.output, "expected 1.9 to 2.1, found 0.98"));
    BOOST_TEST(has(directory.read("j.xml"), "<failure message=\"expected 1.9 to 2.1"));
}

BOOST_AUTO_TEST_CASE(check_of_a_run_that_fails_exits_with_three) {
    const TemporaryDirectory directory;
    const Called called = call(directory, "check heated-end --set beam.alpha=1e200");
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(has(called.output, "a run failed"));
}

BOOST_AUTO_TEST_CASE(check_of_a_scene_without_expectations_is_refused) {
    const TemporaryDirectory directory;
    const std::string scene =
        directory.write("s.toml", "solution = 'free-oscillation'\n[beam]\nalpha = 0\nzeta = 0\n"
                                  "[ladder]\nfinal_time = 1\nelements = [4]\ndt = [0.1]\n");
    const Called called = call(directory, "check " + scene);
    BOOST_TEST(called.exit == 2);
    BOOST_TEST(has(called.errors, "nothing to check"));
}

BOOST_AUTO_TEST_CASE(a_baseline_is_compared_with_the_new_run_and_never_read_in_its_place) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "base.json").string();
    BOOST_TEST(call(directory, "check free-oscillation --record " + file).exit == 0);
    BOOST_TEST(call(directory, "check free-oscillation --baseline " + file).exit == 0);
    // The recorded errors are right, the new run's are not: it is the new run that is judged.
    const Called changed =
        call(directory,
             "check free-oscillation --set beam.zeta=0.0501 --set expect={} --baseline " + file);
    BOOST_TEST(changed.exit == 1);
    BOOST_TEST(has(changed.output, "baseline: ladder.theta_L2L2: error at s = 5"));
    // A run that the baseline has and the new result has not is missed.
    const Called fewer =
        call(directory, "check free-oscillation --set 'ladder.elements=[5, 10]' --set expect={} "
                        "--baseline " +
                            file);
    BOOST_TEST(fewer.exit == 1);
    BOOST_TEST(has(fewer.output, "this run is not made any more"));
    BOOST_TEST(call(directory, "check heated-end --set expect={} --baseline " + file).exit == 1);
    BOOST_TEST(
        call(directory, "check heated-end --baseline " + directory.write("no.json", "{}")).exit ==
        2);
}

BOOST_AUTO_TEST_CASE(analyse_reads_any_solver_s_errors) {
    const TemporaryDirectory directory;
    const std::string rising =
        directory.write("r.csv", "h,error\n0.1,1e-3\n0.05,2e-3\n0.025,4e-3\n");
    const Called called = call(directory, "analyse " + rising);
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(has(called.output, "-1.000"));
    BOOST_TEST(has(called.output, "diverging"));
    // The program's own CSV is such a file.
    const std::string csv = (directory.path() / "t.csv").string();
    BOOST_TEST(call(directory, small + " --csv " + csv).exit == 0);
    BOOST_TEST(has(call(directory, "analyse " + csv + " --error theta_L2L2_sq").output, "order"));
    BOOST_TEST(call(directory, "analyse " + directory.write("bad.csv", "a,b\n1,2\n")).exit == 2);
}

BOOST_AUTO_TEST_CASE(the_examples_of_the_readme_run_as_they_stand) {
    // Its first three TOML blocks are the solution, the scene and the expectations.
    std::ostringstream readme;
    readme << std::ifstream(TVBEAM_README).rdbuf();
    const std::string text = readme.str();
    std::vector<std::string> blocks;
    const std::string fence = "```toml\n";
    for (auto at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
        at += fence.size();
        blocks.push_back(text.substr(at, text.find("```", at) - at));
    }
    BOOST_REQUIRE(blocks.size() >= 3u);
    const TemporaryDirectory directory;
    directory.write("mine.toml", blocks[0]);
    const std::string scene = directory.write("my-scene.toml", blocks[1] + blocks[2]);
    for (const std::string form : {"", " --short"}) {
        const Called called = call(directory, "check " + scene + form);
        BOOST_TEST(called.exit == 0, called.output + called.errors);
    }
}

BOOST_AUTO_TEST_CASE(a_baseline_keeps_figures_and_refuses_what_it_would_lose) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "base.json").string();
    const std::string shorter = "check figure1 --set expect={} --set evolution.final_time=2 ";
    BOOST_TEST(call(directory, shorter + "--record " + file).exit == 0);
    BOOST_TEST(has(directory.read("base.json"), "evolution.u@1.greatest"));
    BOOST_TEST(call(directory, shorter + "--baseline " + file).exit == 0);
    const Called changed = call(directory, shorter + "--set scheme.time=bdf2 --baseline " + file);
    BOOST_TEST(changed.exit == 1);
    BOOST_TEST(has(changed.output, "baseline: evolution.theta@0.5.least"), changed.output);
    // Two scenes of one name would be one record.
    const Called twice =
        call(directory, "check free-oscillation free-oscillation --short --record " + file);
    BOOST_TEST(twice.exit == 2);
    BOOST_TEST(has(twice.errors, "is the second scene that is called free-oscillation"));
    BOOST_TEST(has(directory.read("base.json"), "figure1")); // as it was
}

BOOST_AUTO_TEST_CASE(a_work_precision_study_has_json_csv_and_a_baseline_of_its_errors) {
    const TemporaryDirectory directory;
    const std::string scene =
        " table1-work-precision --set work_precision.runs=2 --set "
        "work_precision.scheme.0.elements=[4,8] "
        "--set work_precision.scheme.1.elements=[4,8] --set work_precision.scheme.2.elements=[4,8] "
        "--set work_precision.scheme.3.elements=[4,8] --set expect={} ";
    const auto json = nlohmann::json::parse(call(directory, "run" + scene + "--json -").output);
    const auto& schemes = json.at("work_precision").at("schemes");
    BOOST_REQUIRE(schemes.size() == 4u);
    BOOST_TEST(schemes[2].at("name") == "BDF2");
    const auto& row = schemes[2].at("rows").at(1);
    BOOST_TEST(row.at("elements") == 8);
    BOOST_TEST(row.at("dt") == 0.25);
    BOOST_TEST(row.at("status") == "ok");
    BOOST_TEST(row.at("errors").at("theta_L2L2_sq").get<double>() > 0.0);
    for (const std::string key : {"min", "median", "q1", "q3"})
        BOOST_TEST(row.at("seconds").at(key).get<double>() > 0.0);
    BOOST_TEST(row.at("seconds").at("runs") == 2);
    BOOST_TEST(row.at("counters").at("steps") == 8);
    BOOST_TEST(row.at("counters").at("node_steps") == 64);
    BOOST_TEST(row.at("counters").contains("heat_solves"));
    BOOST_TEST(row.at("counters").contains("fixed_point_iterations"));
    const auto& reached = json.at("work_precision").at("time_to_reach").at("theta_L2L2_sq");
    BOOST_TEST(reached.size() == 9u); // 1e-2 … 1e-9 and the target
    BOOST_TEST(reached[0].at("seconds").at("BDF2").is_object());
    BOOST_TEST(reached[7].at("seconds").at("BDF2").is_null());
    BOOST_TEST(reached[0].at("comparisons")[0].at("ratio").get<double>() >= 1.0);

    std::istringstream csv(call(directory, "run" + scene + "--csv -").output);
    std::string line;
    std::getline(csv, line);
    BOOST_TEST(line == "scheme,elements,h,dt,steps,status,theta_L2L2_sq,u_LinfH2semi_sq,"
                       "seconds_min,seconds_q1,seconds_median,seconds_q3,runs,node_steps,"
                       "heat_solves,fixed_point_iterations,reason");
    std::getline(csv, line);
    BOOST_TEST(line.starts_with("\"Euler, fixed point\",4,0.25,0.0025,800,ok,"), line);

    const Called printed = call(directory, "run" + scene);
    BOOST_TEST(has(printed.output, "Seconds to reach an error"));
    BOOST_TEST(
        !has(printed.output, "direct algorithm, implicit Euler, lumped heat mass matrix\n\nWork"));

    const std::string file = (directory.path() / "base.json").string();
    BOOST_TEST(call(directory, "check" + scene + "--record " + file).exit == 0);
    const std::string recorded = directory.read("base.json");
    BOOST_TEST(has(recorded, "work_precision.BDF2.theta_L2L2_sq: error at s = 8, dt = 0.25"));
    BOOST_TEST(!has(recorded, "seconds"));
    BOOST_TEST(call(directory, "check" + scene + "--baseline " + file).exit == 0);
    const Called failing =
        call(directory, "check" + scene + "--set beam.alpha=1e200 --baseline " + file);
    BOOST_TEST(failing.exit == 3);
    BOOST_TEST(has(failing.output, "a run failed: "));
}

BOOST_AUTO_TEST_CASE(derive_prints_formulas_for_a_scene_and_a_solution) {
    const TemporaryDirectory directory;
    const Called scene = call(directory, "derive table1");
    const Called solution = call(directory, "derive copetti-fernandez-2011");
    BOOST_TEST(scene.exit == 0);
    BOOST_TEST(scene.output == solution.output);
    for (const std::string symbol : {"f for", "G for", "m for", "theta0 for", "u0 for"})
        BOOST_TEST(has(solution.output, symbol));
    const Called latex = call(directory, "derive copetti-fernandez-2011 --latex");
    BOOST_TEST(has(latex.output, "\\begin{align*}"));
    BOOST_TEST(has(latex.output, "\\sin"));
    BOOST_TEST(has(latex.output, "&& 0 \\le t \\le \\sqrt{2} \\\\"));
    BOOST_TEST(!has(latex.output, "\\text{"));
}

BOOST_AUTO_TEST_CASE(derive_answers_for_every_shipped_name) {
    const TemporaryDirectory directory;
    std::istringstream names(call(directory, "list --names").output);
    int count = 0;
    for (std::string name; std::getline(names, name); ++count) {
        const Called called = call(directory, "derive " + name);
        const bool none = has(called.errors, "to derive from");
        BOOST_TEST(called.exit == (none ? 2 : 0), name << ": " << called.errors);
        BOOST_TEST(!has(called.output, "not admissible"), name << ": " << called.output);
    }
    BOOST_TEST(count > 30);
    BOOST_TEST(
        has(call(directory, "derive stress-beam").errors, "[stress] poses problems of its own"));
}

BOOST_AUTO_TEST_CASE(a_solution_is_looked_at_on_the_beam_of_the_scene_beside_it_that_runs_it) {
    const TemporaryDirectory directory;
    const std::string solution =
        directory.write("mine.toml", "theta = \"t*sin(pi*x)\"\nu = \"x^2*t/100\"\n");
    const auto scene = [](const std::string& runs) {
        return "solution = \"./" + runs + "\"\n[beam]\nalpha = 0.3\nzeta = 0.7\n[ladder]\n" +
               "final_time = 1\nelements = [4]\ndt = [0.1]\n";
    };
    directory.write("mine-scene.toml", scene("other.toml"));
    directory.write("other.toml", "theta = \"sin(pi*x)\"\nu = \"x^2/100\"\n");
    directory.write("torn.toml", "[beam");
    BOOST_TEST(has(call(directory, "derive " + solution).output, "as no scene names another"));
    directory.write("my-scene.toml", scene("mine.toml"));
    BOOST_TEST(has(call(directory, "derive " + solution).output, "the beam of the scene my-scene"));
    const Called run = call(directory, "run " + solution);
    BOOST_TEST(run.exit == 2);
    BOOST_TEST(has(run.errors, "is a solution, not a scene"), run.errors);
}

BOOST_AUTO_TEST_CASE(derive_says_what_a_solution_tests_and_what_to_expect) {
    const TemporaryDirectory directory;
    const Called called = call(directory, "derive cubic-deflection");
    BOOST_TEST(called.exit == 0);
    for (const std::string part :
         {"On the beam of the scene cubic-deflection", "(1)            a heat source f",
          "- (8) a force at the stop g2: the tip never reaches g2", "u_LinfH2semi    -",
          "theta is linear in x: the linear elements hold it exactly"})
        BOOST_TEST(has(called.output, part), part << " in " << called.output);
    std::istringstream lines(called.output);
    for (std::string line; std::getline(lines, line);)
        BOOST_TEST(line.size() <= 82u, line);
    // A file has the scene beside it, or else the paper's beam; and there it can be inadmissible.
    const std::string file = directory.write("mine.toml", "theta = 'x*(1 - x)'\nu = 'x^2*t'\n");
    const Called alone = call(directory, "derive " + file);
    BOOST_TEST(alone.exit == 0);
    BOOST_TEST(has(alone.output, "the paper's beam"));
    BOOST_TEST(has(alone.output, "not admissible: "));
    BOOST_TEST(has(alone.output, "(6): u(1,t)"));
    directory.write("mine-scene.toml", "solution = './mine.toml'\n[beam]\nalpha = 0\nzeta = 0\n"
                                       "[ladder]\nfinal_time = 1\nelements = [4]\ndt = [1]\n");
    const Called beside = call(directory, "derive " + file);
    BOOST_TEST(has(beside.output, "the beam of the scene mine-scene"));
    BOOST_TEST(has(beside.output, "- (1) alpha*u_xxt: alpha = 0"));
}

BOOST_AUTO_TEST_CASE(new_writes_a_solution_and_a_scene_that_run_as_they_stand) {
    const TemporaryDirectory directory;
    const std::string there = "cd " + directory.path().string() + " && ";
    const auto in_directory = [&](const std::string& arguments) {
        return call(directory, arguments, there);
    };
    const Called made = in_directory("new warm_beam-2");
    BOOST_TEST(made.exit == 0, made.errors);
    BOOST_TEST(directory.count() == 2u);
    for (const std::string arguments :
         {"run warm_beam-2-scene.toml", "check warm_beam-2-scene.toml", "derive warm_beam-2.toml",
          "run warm_beam-2-scene.toml --set scheme.time=bdf2 --set ladder.dt=0.1/s"}) {
        const Called called = in_directory(arguments);
        BOOST_TEST(called.exit == 0, called.output + called.errors);
    }
    BOOST_TEST(has(in_directory("derive warm_beam-2.toml").output,
                   "the beam of the scene warm_beam-2-scene"));

    // What is there is not touched, and where one file is in the way the other does not appear.
    const std::string before = directory.read("warm_beam-2.toml");
    const Called again = in_directory("new warm_beam-2");
    BOOST_TEST(again.exit == 2);
    BOOST_TEST(has(again.errors, "'warm_beam-2.toml' is there already"));
    directory.write("other-scene.toml", "mine");
    BOOST_TEST(in_directory("new other").exit == 2);
    BOOST_TEST(directory.read("other-scene.toml") == "mine");
    BOOST_TEST(directory.count() == 3u);
    BOOST_TEST(directory.read("warm_beam-2.toml") == before);
}

BOOST_AUTO_TEST_CASE(new_refuses_what_is_no_name) {
    const TemporaryDirectory directory;
    const std::string there = "cd " + directory.path().string() + " && ";
    for (const std::string name : {"''", "a/b", "../a", ".hidden", "'two words'", "mine.toml",
                                   "'a\"b'", "\xC3\xA4", "-- -x"}) {
        const Called called = call(directory, "new " + name, there);
        BOOST_TEST(called.exit == 2, name);
        BOOST_TEST(std::count(called.errors.begin(), called.errors.end(), '\n') == 1,
                   called.errors);
    }
    BOOST_TEST(call(directory, "new " + std::string(65, 'a'), there).exit == 2);
    BOOST_TEST(directory.count() == 0u);
}

// Its phases, which are comments, are a solution, too.
BOOST_AUTO_TEST_CASE(the_phases_that_new_shows_are_admissible) {
    const TemporaryDirectory directory;
    const std::string there = "cd " + directory.path().string() + " && ";
    BOOST_TEST(call(directory, "new mine", there).exit == 0);
    std::istringstream lines(directory.read("mine.toml"));
    std::string text;
    bool in_phases = false;
    for (std::string line; std::getline(lines, line);) {
        in_phases = in_phases || line == "# [[phase]]";
        if (in_phases)
            text += line.substr(2) + "\n";
        else if (!line.starts_with("u "))
            text += line + "\n";
    }
    directory.write("mine.toml", text);
    const Called called =
        call(directory,
             "run mine-scene.toml --set ladder.final_time=2 --set 'ladder.elements=[8,16]'", there);
    BOOST_TEST(called.exit == 0, called.errors);
    BOOST_TEST(in_phases);
}

BOOST_AUTO_TEST_CASE(list_names_what_is_shipped) {
    const TemporaryDirectory directory;
    const Called called = call(directory, "list");
    BOOST_TEST(called.exit == 0);
    for (const std::string name : {"table1:", "table1-consistent:", "table1-fixed-point:",
                                   "table1-extended:", "copetti-fernandez-2011:"})
        BOOST_TEST(has(called.output, name), name);
}

BOOST_AUTO_TEST_SUITE_END()

// `tvbeam check` as CI calls it: exit codes, reports and baselines.

#include "tests/command_line/called_program.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(command_line)

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

BOOST_AUTO_TEST_CASE(the_result_of_a_checked_scene_says_what_it_violates) {
    const TemporaryDirectory directory;
    const Called called = call(
        directory, "check heated-end --json - --set 'expect.ladder.theta_L2H1.orders=[1.9,2.1]'");
    BOOST_TEST(called.exit == 1);
    const auto result = nlohmann::json::parse(called.output);
    std::size_t outside = 0;
    for (const auto& level : result["ladder"]["rungs"])
        if (const auto& order = level["orders"]["theta_L2H1"]; !order.is_null())
            outside += order.get<double>() < 1.9 || order.get<double>() > 2.1 ? 1 : 0;
    BOOST_TEST_REQUIRE(outside > 0);
    const auto& check = result["check"];
    BOOST_TEST(!check["passed"].get<bool>());
    BOOST_TEST(check["violations"].size() == outside, check);
    BOOST_TEST(check["expectations"].get<std::size_t>() > outside);
    BOOST_TEST(has(check["violations"][0]["what"].get<std::string>(), "theta_L2H1"));
    BOOST_TEST(check["violations"][0]["expected"] == "1.9 to 2.1");

    const Called passed = call(directory, "check heated-end --json -");
    BOOST_TEST(passed.exit == 0);
    BOOST_TEST(nlohmann::json::parse(passed.output)["check"]["passed"].get<bool>());
    const Called failed = call(directory, "check heated-end --json - --set beam.alpha=1e200");
    BOOST_TEST(failed.exit == 3);
    const auto why = nlohmann::json::parse(failed.output)["check"];
    BOOST_TEST(!why["passed"].get<bool>());
    BOOST_TEST(why["error"].is_string());

    for (const auto* words : {"heated-end free-oscillation --json -",
                              "heated-end --json - --junit -", "heated-end --json - --record -"})
        BOOST_TEST(call(directory, "check " + std::string(words)).exit == 2, words);
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
    BOOST_TEST(has(fewer.output, ", found nothing of the kind"));
    BOOST_TEST(call(directory, "check heated-end --set expect={} --baseline " + file).exit == 1);
    BOOST_TEST(
        call(directory, "check heated-end --baseline " + directory.write("no.json", "{}")).exit ==
        2);
}

// Of those that `until` adds nobody is exempt.
BOOST_AUTO_TEST_CASE(expectations_of_every_level_count_those_that_are_added) {
    const TemporaryDirectory directory;
    const auto checked = [&](const std::string& expected) {
        return call(directory, "check " + directory.write("u.toml", R"([solver]
command = ["awk", "BEGIN { print \"L2 =\", {h} * {h} }"]
errors = { L2 = 'L2 = (\S+)' }
[ladder]
elements = [2, 4, 8]
norms = ["L2"]
until = { order = 0.05, levels = 4 }
[expect.ladder.L2]
)" + expected));
    };
    const std::string three = "[0.25, 0.0625, 0.015625";
    BOOST_TEST(checked("errors = " + three + ", 0.00390625]").exit == 0);
    BOOST_TEST(checked("errors = " + three + ", 0.004]").exit == 1);
    BOOST_TEST(has(checked("errors = " + three + "]").output,
                   "ladder.L2.errors: expected 3 rungs, found 4 rungs"));
    BOOST_TEST(has(checked("errors = " + three + ", 0.00390625, 0.001]").output,
                   "expected 5 rungs, found 4 rungs"));
    BOOST_TEST(has(checked("errors = [0.25, 0.0625]").errors, "2 values for 3 rungs, or more"));
    const std::string word = "'asymptotic'";
    const std::string words = word + ", " + word + ", " + word;
    BOOST_TEST(checked("verdicts = [" + words + ", " + word + "]").exit == 0);
    BOOST_TEST(checked("verdicts = [" + words + "]").exit == 1);
}

// As of levels that a solver knows by {level}.
BOOST_AUTO_TEST_CASE(a_baseline_keeps_levels_that_are_repeated) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "base.json").string();
    const std::string scene = directory.write("p.toml", R"([solver]
command = ["awk", "BEGIN { print \"L2 =\", exp(-{level}) * ({level} == {at} ? 2 : 1) }"]
errors = { L2 = 'L2 = (\S+)' }
parameters = { at = 9 }
[ladder]
elements = [8, 8, 8]
norms = ["L2"]
)");
    BOOST_TEST(call(directory, "check " + scene + " --record " + file).exit == 0);
    BOOST_TEST(call(directory, "check " + scene + " --baseline " + file).exit == 0);
    for (const std::string level : {"0", "1", "2"})
        BOOST_TEST(
            call(directory, fmt::format("check {} --set solver.parameters.at={} --baseline {}",
                                        scene, level, file))
                    .exit == 1,
            level);
}

// Rounding of another processor is no change; an error that was, or is, more than rounding is one.
BOOST_AUTO_TEST_CASE(errors_that_are_rounding_are_those_of_any_processor) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "base.json").string();
    BOOST_TEST(call(directory, "check nothing-heated --record " + file).exit == 0);
    const auto recorded = nlohmann::json::parse(directory.read("base.json"));
    for (const std::string study : {"ladder.", "orders."})
        BOOST_TEST(
            std::ranges::any_of(recorded.at("scenes").at("nothing-heated").items(),
                                [&](const auto& one) { return one.key().starts_with(study); }));
    const auto exit_with = [&](double factor) {
        auto changed = recorded;
        for (auto& [what, error] : changed.at("scenes").at("nothing-heated").items())
            error = factor * error.get<double>();
        return call(directory, "check nothing-heated --baseline " +
                                   directory.write("changed.json", changed.dump()))
            .exit;
    };
    BOOST_TEST(exit_with(0.3) == 0);
    BOOST_TEST(exit_with(1.5) == 0);
    BOOST_TEST(exit_with(1e3) == 1);
    // A scheme that is exact no more.
    const Called inexact = call(
        directory,
        "check nothing-heated --set defect.heat_source=1e-9 --set expect={} --baseline " + file);
    BOOST_TEST(inexact.exit == 1, inexact.output);
}

// Of a norm of about 1e-17 the square is 1e-34, and what rounding may be of it that of the norm,
// about 1e-14, squared.
BOOST_AUTO_TEST_CASE(squares_that_are_rounding_are_less_than_the_square_of_rounding) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "base.json").string();
    const std::string squared =
        R"(check nothing-heated --set "ladder.norms=['theta_L2L2_sq']" --set expect={} )";
    BOOST_TEST(call(directory, squared + "--record " + file).exit == 0);
    const auto recorded = nlohmann::json::parse(directory.read("base.json"));
    const auto exit_with = [&](double error) {
        auto changed = recorded;
        int squares = 0;
        for (auto& [what, figure] : changed.at("scenes").at("nothing-heated").items())
            if (what.starts_with("ladder.theta_L2L2_sq: error")) {
                figure = error;
                ++squares;
            }
        BOOST_TEST(squares == 3);
        return call(directory,
                    squared + "--baseline " + directory.write("changed.json", changed.dump()))
            .exit;
    };
    BOOST_TEST(exit_with(1e-33) == 0);
    BOOST_TEST(exit_with(1e-20) == 1);
}

BOOST_AUTO_TEST_CASE(a_tolerance_that_holds_anything_or_nothing_is_refused) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "base.json").string();
    BOOST_TEST(call(directory, "check sheared --record " + file).exit == 0);
    for (const std::string tolerance : {"nan", "inf", "-1", "0", "0.6", "1e300", "x"}) {
        const Called called = call(
            directory, fmt::format("check sheared --tolerance={} --baseline {}", tolerance, file));
        BOOST_TEST(called.exit == 2, tolerance);
        BOOST_TEST(has(called.errors, "--tolerance: " + tolerance + " is no part > 0 and at most"),
                   called.errors);
    }
    BOOST_TEST(call(directory, "check sheared --tolerance 0.5 --baseline " + file).exit == 0);
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

// A record is the same from another folder, whose name stands in formulas, too; and a number below
// normal doubles is one.
BOOST_AUTO_TEST_CASE(a_whole_record_knows_folders_and_small_numbers) {
    const TemporaryDirectory directory;
    const std::string scene = "solution = './s.toml'\n[beam]\nalpha = 0.5\nzeta = 0.1\n"
                              "[ladder]\nfinal_time = 1\nelements = [4]\ndt = [0.25]\n"
                              "norms = ['theta_L2L2']\n[evolution]\nelements = 4\ndt = 0.25\n"
                              "final_time = 1\nprobes = ['u@1']\n"
                              "[[expect.equations]]\ntext = \"\"\"\n[unknowns]\n"
                              "u = 'exp(x/(x + 1))*t'\n[equations]\nf = 'diff(u, t)'\n\"\"\"\n"
                              "says = ['exp(x/(x + 1))']\n";
    const std::string solution = "name = 's'\ntheta = 'sin(pi*x)*t'\nu = '1e-309*x^2*(1 + t)'\n";
    for (const char* folder : {"x", "other"}) {
        std::filesystem::create_directory(directory.path() / folder);
        directory.write(std::string(folder) + "/mine.toml", scene);
        directory.write(std::string(folder) + "/s.toml", solution);
    }
    const std::string file = (directory.path() / "base.json").string();
    const Called recorded = call(directory, "check " + (directory.path() / "x/mine.toml").string() +
                                                " --whole --record " + file);
    BOOST_TEST(recorded.exit == 0, recorded.output + recorded.errors);
    BOOST_TEST(has(directory.read("base.json"), "x/(x"));
    const Called again =
        call(directory,
             "check " + (directory.path() / "other/mine.toml").string() + " --baseline " + file);
    BOOST_TEST(again.exit == 0, again.output + again.errors);
}

// The last would silently be the one that counts.
BOOST_AUTO_TEST_CASE(a_baseline_that_has_a_name_twice_is_refused) {
    const TemporaryDirectory directory;
    const auto refusal = [&](const std::string& scenes) {
        const Called called =
            call(directory, "check sheared --short --baseline " +
                                directory.write("b.json", "{\"schema\": \"tvbeam-baseline/1\", "
                                                          "\"scenes\": {" +
                                                              scenes + "}}"));
        BOOST_TEST(called.exit == 2, called.output);
        return called.errors;
    };
    const std::string scene = refusal(R"("sheared": {"a": 1}, "other": {}, "sheared": {"a": 2})");
    BOOST_TEST(has(scene, "b.json: has 'sheared' more than once; which is meant?"), scene);
    const std::string figure = refusal(R"("other": {"b": 1}, "sheared": {"a": 1, "b": 2, "a": 1})");
    BOOST_TEST(has(figure, "b.json: has 'a' more than once; which is meant?"), figure);
}

// What was checked is in the file that a server reads, whatever standard output goes to.
BOOST_AUTO_TEST_CASE(junit_does_not_depend_on_standard_output) {
    const TemporaryDirectory directory;
    const Called called =
        call(directory, "check sheared free-decay --short --junit " +
                            (directory.path() / "j.xml").string() + " > /dev/full");
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(has(called.errors, "cannot write to standard output"), called.errors);
    for (const std::string scene : {"sheared", "free-decay"})
        BOOST_TEST(has(directory.read("j.xml"), "testsuite name=\"" + scene + "\""));
    BOOST_TEST(has(directory.read("j.xml"), "<error message=\"cannot write to standard output"));
}

// As the call ends with 3, so does what a server reads.
BOOST_AUTO_TEST_CASE(what_could_not_be_written_is_an_error_in_junit) {
    const TemporaryDirectory directory;
    const std::string junit = " --json /dev/full --junit " + (directory.path() / "j.xml").string();
    for (const std::string& command :
         {std::string("check sheared --short"),
          "analyse " + directory.write("e.csv", "h,error\n0.4,0.16\n0.2,0.04\n0.1,0.01\n")}) {
        BOOST_TEST(call(directory, command + junit).exit == 3);
        const std::string xml = directory.read("j.xml");
        BOOST_TEST(has(xml, "<error message=\"cannot write &apos;/dev/full&apos;"), xml);
        BOOST_TEST(has(xml, "errors=\"1\""), xml);
    }
}

// A server shows the file of --junit whatever the call ended with.
BOOST_AUTO_TEST_CASE(no_report_of_an_earlier_call_is_left_green_by_one_that_is_refused) {
    const TemporaryDirectory directory;
    const std::string in = directory.path().string() + "/";
    const std::string rows = "h,error\n0.4,0.16\n0.2,0.04\n0.1,0.01\n";
    const std::string analyse = "analyse " + in + "e.csv --junit " + in + "j.xml";
    const auto refused_after_green = [&](const std::string& words, const std::string& message) {
        directory.write("e.csv", rows);
        BOOST_TEST(call(directory, analyse + " --expect 'error.orders = [1.9, 2.1]'").exit == 0);
        BOOST_TEST(has(directory.read("j.xml"), "errors=\"0\""));
        directory.write("e.csv", rows + "0.05,\"<&\n");
        const Called called = call(directory, words);
        BOOST_TEST(called.exit == 2, words);
        const std::string xml = directory.read("j.xml");
        BOOST_TEST(has(xml, "tests=\"1\" failures=\"0\" errors=\"1\""), xml);
        BOOST_TEST(has(xml, "<error message=\"" + message), xml);
        return called;
    };
    refused_after_green(analyse, in + "e.csv:5:6: a quote is not closed\"/>");
    refused_after_green(analyse + " --exprct 1", "&apos;--exprct&apos; is not an option");
    const std::string scene = in + "<&.toml";
    std::ofstream(scene) << "solution = 'sheared'\n[beam]\nzata = 1\n";
    refused_after_green("check '" + scene + "' --junit " + in + "j.xml",
                        in + "&lt;&amp;.toml:3:1: unknown key");

    // Other results stay as they are, which is said.
    directory.write("a.json", "{}");
    directory.write("a.csv", "h\n");
    std::filesystem::create_directory(in + "empty");
    const Called said = refused_after_green(analyse + " --json " + in + "a.json --csv " + in +
                                                "a.csv --out " + in + "empty",
                                            in + "e.csv:5:6");
    for (const std::string name : {"a.json", "a.csv"})
        BOOST_TEST(has(said.errors, "'" + in + name + "' is left as it was before this call"),
                   said.errors);
    BOOST_TEST(!has(said.errors, "empty"), said.errors);
    BOOST_TEST(directory.read("a.json") == "{}");
}

// It may be what was to be read, by a scene that could not be.
BOOST_AUTO_TEST_CASE(a_refusal_takes_the_place_of_no_file_but_a_report) {
    const TemporaryDirectory directory;
    const std::string table = directory.write("e.csv", "h,error\n0.4,0.16\n0.2,x\n");
    const auto after = [&](const std::string& file) {
        BOOST_TEST(call(directory, "analyse " + table + " --junit " + file).exit == 2);
        return directory.read(std::filesystem::path(file).filename().string());
    };
    BOOST_TEST(after(table) == "h,error\n0.4,0.16\n0.2,x\n");
    for (const std::string text : {"theta = '0'\n", "<?xml version=\"1.0\"?>\n<svg/>\n"})
        BOOST_TEST(after(directory.write("mine", text)) == text);
    for (const std::string& file :
         {directory.write("empty.xml", ""), (directory.path() / "new.xml").string()})
        BOOST_TEST(has(after(file), "<error message="));
    const Called written = call(directory, "analyse " + table + " --junit -");
    BOOST_TEST(has(written.output, "<error message="), written.output);
    for (const auto& [place, same] : {std::pair{"-", "-"}, {"both", "both"}, {"both", "./both"}})
        BOOST_TEST(call(directory,
                        std::string("analyse ") + table + " --junit " + place + " --json " + same,
                        "cd " + directory.path().string() + " && ")
                       .output.empty());
    BOOST_TEST(!std::filesystem::exists(directory.path() / "both"));
    const Called nowhere = call(directory, "analyse " + table + " --junit " +
                                               (directory.path() / "no/j.xml").string());
    BOOST_TEST(nowhere.exit == 2);
    BOOST_TEST(has(nowhere.errors, "'x' in column error is not a number"), nowhere.errors);
    BOOST_TEST(has(nowhere.errors, "cannot write"), nowhere.errors);
}

// Records go by the names of files: one of another folder is told from the same file, and from one
// that was moved with its record or is no longer there.
BOOST_AUTO_TEST_CASE(a_record_takes_the_place_of_no_other_file_s_of_its_name) {
    const TemporaryDirectory directory;
    const std::string in = directory.path().string() + "/";
    const std::string text = call(directory, "list sheared").output;
    const std::string rows = "h,error\n0.4,0.16\n0.2,0.04\n0.1,0.01\n";
    for (const std::string folder : {"a", "b"}) {
        std::filesystem::create_directory(in + folder);
        directory.write(folder + "/sheared.toml", text);
        directory.write(folder + "/e.csv", rows);
    }
    const auto recorded = [&](const std::string& folder, const std::string& words) {
        return call(directory, words, "cd " + in + folder + " && ");
    };
    for (const std::string words : {"check sheared.toml --short --record ../base.json",
                                    "analyse e.csv --record ../base.json"}) {
        BOOST_TEST(recorded("a", words).exit == 0);
        BOOST_TEST(recorded("a", words).exit == 0);
        const std::string before = directory.read("base.json");
        const Called refused = recorded("b", words);
        BOOST_TEST(refused.exit == 2, words);
        BOOST_TEST(has(refused.errors, "would take the place of " + in + "a/"), refused.errors);
        BOOST_TEST(directory.read("base.json") == before);
    }
    const Called shipped = call(directory, "check sheared --short --record " + in + "base.json");
    BOOST_TEST(shipped.exit == 2);
    BOOST_TEST(has(shipped.errors, "rename one, or record in another file"), shipped.errors);
    std::filesystem::create_directory(in + "moved");
    std::filesystem::copy(in + "a", in + "moved/a");
    std::filesystem::copy(in + "base.json", in + "moved/base.json");
    const std::string check = "check sheared.toml --short --record ../base.json";
    BOOST_TEST(recorded("moved/a", check).exit == 0);
    std::filesystem::remove_all(in + "a");
    BOOST_TEST(recorded("b", check).exit == 0);
    // A record of before files stood in it.
    auto json = nlohmann::json::parse(directory.read("base.json"));
    json.erase("files");
    directory.write("base.json", json.dump());
    BOOST_TEST(
        recorded("b", "check sheared.toml --short --baseline ../base.json --record ../base.json")
            .exit == 0);
    json["files"] = {{"sheared", 1}};
    directory.write("base.json", json.dump());
    BOOST_TEST(has(recorded("b", check).errors, "base.json: is not a baseline"));
}

// Beside its figures a whole record keeps what a result says, and what its expectations look at.
BOOST_AUTO_TEST_CASE(a_whole_record_holds_words_and_counters) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "base.json").string();
    const std::string checked = "check sheared refused-keys --short ";
    BOOST_TEST(call(directory, checked + "--whole").exit == 2); // without --record
    BOOST_TEST(call(directory, checked + "--whole --record " + file).exit == 0);
    const auto said = nlohmann::json::parse(directory.read("base.json"))
                          .at("scenes")
                          .at("refused-keys")
                          .at("said");
    BOOST_TEST(has(said.at("examined").at("refused.0.says.0").get<std::string>(),
                   "it must divide final_time = 2"));
    BOOST_TEST(!has(said.dump(), "\"seconds\""));
    const Called again = call(directory, checked + "--baseline " + file);
    BOOST_TEST(again.exit == 0, again.output);

    // A record of figures alone would take its place.
    const Called less = call(directory, checked + "--record " + file);
    BOOST_TEST(less.exit == 2);
    BOOST_TEST(has(less.errors, file + ": has all that the result of 'sheared' says"), less.errors);
    BOOST_TEST(has(less.errors, "add --whole"), less.errors);
    BOOST_TEST(less.output.empty(), less.output); // nothing has run
    BOOST_TEST(call(directory, checked + "--baseline " + file).exit == 0);

    // Other words, with the same numbers.
    std::string changed = directory.read("base.json");
    const std::string words = "it must divide final_time = 2";
    changed.replace(changed.find(words), words.size(), "it must split final_time = 2");
    const Called failed =
        call(directory, checked + "--baseline " + directory.write("changed.json", changed));
    BOOST_TEST(failed.exit == 1);
    BOOST_TEST(has(failed.output, "baseline: examined.refused.0.says.0: expected"), failed.output);
    BOOST_TEST(has(failed.output, "ok    sheared"), failed.output);

    // A record that is none.
    const Called none = call(
        directory, checked + "--baseline " +
                       directory.write("none.json", "{\"schema\": \"tvbeam-baseline/1\", "
                                                    "\"scenes\": {\"sheared\": {\"said\": 1}}}"));
    BOOST_TEST(none.exit == 2);
    BOOST_TEST(has(none.errors, "is not a baseline"), none.errors);
}

BOOST_AUTO_TEST_SUITE_END()

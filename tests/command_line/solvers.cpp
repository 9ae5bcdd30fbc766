// Programs under study, as the whole program meets them: what they write, and what changes while
// they run.

#include "tests/command_line/called_program.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>
#include <string>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(solvers_under_study)

namespace {

/// A scene beside a script, s.sh, of this text, which gets the number of elements.
std::string scene_with(const TemporaryDirectory& directory, const std::string& script) {
    directory.write("s.sh", script);
    return directory.write("s.toml", "[solver]\ncommand = [\"sh\", \"s.sh\", \"{elements}\"]\n"
                                     "files = [\"s.sh\"]\nerrors = { L2 = 'L2 = (\\S+)' }\n"
                                     "[ladder]\nelements = [4, 8, 16]\nnorms = [\"L2\"]\n");
}

const std::string second_order = "awk -v n=\"$1\" 'BEGIN { printf \"L2 = %.15e\\n\", 0.3/n^2 }'\n";

std::string in(const TemporaryDirectory& directory, const std::string& name) {
    return (directory.path() / name).string();
}

} // namespace

// The second run changes the script beside the scene.
BOOST_AUTO_TEST_CASE(runs_of_a_program_that_changes_meanwhile_are_not_mixed) {
    const TemporaryDirectory directory;
    const std::string file = in(directory, "s.sh");
    const std::string run =
        "run " +
        scene_with(directory, "[ $1 != 8 ] || echo 'echo L2 = 7' >" + file + "\n" + second_order) +
        " --quiet --out " + in(directory, "out");
    const Called changed = call(directory, run);
    BOOST_TEST(changed.exit == 3);
    const auto rungs = [&] {
        return nlohmann::json::parse(directory.read("out/result.json")).at("ladder").at("rungs");
    };
    BOOST_TEST(rungs().at(1).at("status") == "ok");
    BOOST_TEST(rungs().at(2).at("reason").get<std::string>().starts_with(
                   "s.sh was changed during the study"),
               rungs().at(2).dump());
    // Nothing was kept as the new program's.
    const Called again = call(directory, run);
    BOOST_TEST(again.exit == 0, again.errors);
    BOOST_TEST(!has(again.errors, "finished runs"), again.errors);
    BOOST_TEST(rungs().at(0).at("errors").at("L2") == 7.0);
}

// A program that is called where it is, and made anew while it runs.
BOOST_AUTO_TEST_CASE(a_run_is_kept_as_one_of_the_program_that_made_it) {
    const TemporaryDirectory directory;
    std::string text =
        directory.read(scene_with(directory, "").substr(directory.path().string().size() + 1));
    text.replace(text.find("\"sh\", \"s.sh\""), 12, "\"./solve\"");
    text.replace(text.find("[\"s.sh\"]"), 8, "[]");
    const std::string program =
        directory.write("solve", "#!/bin/sh\n[ $1 != 16 ] || touch -d 2001-01-01 " +
                                     in(directory, "solve") + "\n" + second_order);
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const std::string run =
        "run " + directory.write("own.toml", text) + " --out " + in(directory, "out");
    BOOST_TEST(call(directory, run).exit == 0);
    const Called again = call(directory, run);
    BOOST_TEST(!has(again.output, "found again"), again.output);
}

// Latin-1, and a line that is cut within a character.
BOOST_AUTO_TEST_CASE(what_a_program_writes_in_another_encoding_is_text_in_every_report) {
    for (const auto& [words, shown] :
         {std::pair<std::string, std::string>{"Speicher ersch\\366pft", "Speicher ersch\\xF6pft"},
          {std::string(199, 'x') + "\\303\\251 und so fort", std::string(199, 'x') + " ..."}}) {
        const TemporaryDirectory directory;
        const std::string scene = scene_with(directory, "[ $1 != 16 ] || { printf '" + words +
                                                            "\\n' >&2; exit 3; }\n" + second_order);
        const std::string baseline = in(directory, "b.json");
        for (const std::string gate : {"--whole --record ", "--baseline "}) {
            const Called called = call(directory, "check " + scene + " " + gate + baseline);
            BOOST_TEST(called.exit == 3, called.errors);
            BOOST_TEST(called.errors == "tvbeam: a run failed; the report says which and why\n");
        }
        BOOST_TEST(has(nlohmann::json::parse(directory.read("b.json")).dump(),
                       nlohmann::json(shown).dump().substr(1, shown.size())));
        // In one run as in parts.
        call(directory, "run " + scene + " --quiet --out " + in(directory, "one"));
        call(directory, "run " + scene + " --quiet --shard 1/1 --out " + in(directory, "parts"));
        call(directory, "merge --quiet " + in(directory, "parts"));
        for (const std::string file : {"one/ladder.csv", "parts/ladder.csv"})
            BOOST_TEST(has(directory.read(file), "standard error it wrote: " + shown),
                       directory.read(file));
    }
}

// A study is interrupted by one of another scene that records in the same file.
BOOST_AUTO_TEST_CASE(records_that_are_made_side_by_side_are_all_kept) {
    const TemporaryDirectory directory;
    const std::string record = " --record " + in(directory, "b.json");
    const std::string scene = scene_with(directory, "[ $1 != 8 ] || " + std::string(tvbeam_binary) +
                                                        " check sheared --short --quiet" + record +
                                                        " >&2\n" + second_order);
    for (int times = 0; times < 2; ++times) { // in a new file, and in one that is there
        const Called called = call(directory, "check " + scene + record);
        BOOST_TEST(called.exit == 0, called.output + called.errors);
        const auto scenes = nlohmann::json::parse(directory.read("b.json")).at("scenes");
        BOOST_TEST(scenes.contains("s"));
        BOOST_TEST(scenes.contains("sheared"));
        directory.write("b.json", R"({"schema": "tvbeam-baseline/1", "scenes": {}})");
    }
}

// Else the next file that is opened takes the place of what was closed.
BOOST_AUTO_TEST_CASE(streams_that_are_closed_are_nobody_s) {
    const TemporaryDirectory directory;
    const std::string scene = scene_with(directory, second_order);
    const auto without = [](const std::string& streams) {
        return "sh -c 'exec \"$0\" \"$@\" " + streams + "' ";
    };
    for (const std::string streams : {"2>&-", "0<&- 2>&-"}) {
        const Called called = call(directory, "run " + scene, without(streams));
        BOOST_TEST(called.exit == 0);
        BOOST_TEST(has(called.output, "L2: order 2.00"), called.output);
    }
    const Called nowhere = call(directory, "run " + scene, without(">&-"));
    BOOST_TEST(nowhere.exit == 3);
    BOOST_TEST(has(nowhere.errors, "cannot write to standard output"), nowhere.errors);
    call(directory, "run table1 --out " + in(directory, "x") + " --shard 1/2", without("2>&-"));
    std::istringstream lines(directory.read("x/shard-1-of-2.jsonl"));
    for (std::string line; std::getline(lines, line);)
        BOOST_TEST(has(line, "{"), line);
}

BOOST_AUTO_TEST_SUITE_END()

// Long work: what is cut short is kept, and goes on; what accompanies it keeps to itself.

#include "reports/files/line_file.hpp"
#include "tests/command_line/called_program.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <initializer_list>
#include <sstream>
#include <utility>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(long_work)

namespace {

/// A ladder of the paper's problem in a file of the directory; how it is run.
std::string ladder(const TemporaryDirectory& directory, const std::string& elements) {
    const std::string file =
        directory.write("ladder.toml", "solution = \"copetti-fernandez-2011\"\n[beam]\n"
                                       "alpha = 0.017\nzeta = 0.1\nstops = [-0.02, 0.1]\n"
                                       "[scheme]\nbasis = \"nodal\"\n"
                                       "[ladder]\nfinal_time = 2.0\nelements = [" +
                                           elements +
                                           "]\ndt = \"0.1/s\"\n"
                                           "norms = [\"theta_L2L2_sq\"]\n");
    return "run " + file;
}

/// The last rung takes far longer than a second, those before it no time.
const std::string many = "10, 20, 40, 20480";
const std::string few = "4, 8";

const std::string unfinished = "out/unfinished.jsonl";

/// Its lines, each of them whole.
std::vector<nlohmann::ordered_json> kept_lines(const TemporaryDirectory& directory) {
    std::istringstream text(directory.read(unfinished));
    std::vector<nlohmann::ordered_json> lines;
    for (std::string line; std::getline(text, line);)
        lines.push_back(nlohmann::ordered_json::parse(line));
    for (auto& line : lines)
        line.erase("crc"); // so that it can be sealed again
    return lines;
}

} // namespace

// Ctrl-C is SIGINT; a polite kill is SIGTERM; SIGHUP comes when the terminal goes.
BOOST_DATA_TEST_CASE(a_run_that_is_asked_to_end_keeps_what_it_finished,
                     data::make({"INT", "TERM", "HUP"}), signal) {
    const TemporaryDirectory directory;
    const std::string out = (directory.path() / "out").string();
    const Called cut = call(directory, ladder(directory, many) + " --out " + out,
                            std::string("timeout -s ") + signal + (short_tests ? " 3 " : " 1 "));
    BOOST_TEST(cut.exit == 124); // timeout's: it had to send the signal
    BOOST_TEST(has(cut.errors, "interrupted; the result holds what was finished; --resume"),
               cut.errors);
    BOOST_TEST(has(cut.output, "interrupted"), cut.output);
    const auto json = nlohmann::json::parse(directory.read("out/result.json"));
    const auto& rungs = json.at("ladder").at("rungs");
    BOOST_TEST(rungs.at(2).at("status") == "ok");
    BOOST_TEST(rungs.at(3).at("status") == "interrupted");
    BOOST_TEST(rungs.at(3).at("errors").at("theta_L2L2_sq").is_null());
    const auto kept = kept_lines(directory);
    BOOST_REQUIRE(kept.size() == 4U); // what they are of, and three runs
    for (const auto& line : kept)
        if (line.value("index", 0) == 2)
            BOOST_TEST(line.at("result").at("errors").at(0) ==
                       rungs.at(2).at("errors").at("theta_L2L2_sq"));
}

// 400 000 elements and 8 million steps: nine hours.
BOOST_AUTO_TEST_CASE(what_takes_very_long_is_refused_unless_it_is_wanted) {
    const TemporaryDirectory directory;
    const std::string run = ladder(directory, "400000");
    for (const std::string& command : {run, "check" + run.substr(3)}) {
        const Called refused = call(directory, command);
        BOOST_TEST(refused.exit == 2);
        BOOST_TEST(has(refused.errors, "asks for 3.2e+12 element steps in 1 runs, about 9 h on "
                                       "one core and 161 MB; beyond 6 h or 4000 MB it runs only "
                                       "with --yes-really-long, or long = true"),
                   refused.errors);
    }
    for (const std::string wanted : {" --yes-really-long", " --set long=true"}) {
        const Called begun = call(directory, run + wanted, "timeout -s INT 1 ");
        BOOST_TEST(begun.exit == 124);
        BOOST_TEST(has(begun.errors, "ladder asks for 3.2e+12 element steps"), begun.errors);
        BOOST_TEST(!has(begun.errors, "beyond"), begun.errors);
    }
}

BOOST_AUTO_TEST_CASE(an_attempt_that_was_cut_short_is_neither_lost_nor_mixed_with_another) {
    const TemporaryDirectory directory;
    const std::string out = " --out " + (directory.path() / "out").string();
    call(directory, ladder(directory, many) + out, "timeout -s INT 1 ");
    const std::string kept = directory.read(unfinished);
    const auto refused = [&](const std::string& arguments, const std::string& message) {
        const std::string before = directory.read(unfinished);
        const Called called = call(directory, arguments);
        BOOST_TEST(called.exit == 2);
        BOOST_TEST(has(called.errors, message), called.errors << " lacks " << message);
        BOOST_TEST(called.output.empty());
        BOOST_TEST(directory.read(unfinished) == before);
    };
    refused(ladder(directory, many) + out, "go on with it by --resume, or remove the file");
    refused(ladder(directory, few) + out + " --resume", "of another scene (ladder/elements)");
    // Of other bits: a word of the first line is another.
    const auto lines = kept_lines(directory);
    for (const auto& [key, difference] :
         {std::pair{"/of/build/flags", "another build of tvbeam (flags)"},
          {"/of/build/commit", "another build of tvbeam (commit)"},
          {"/of/build/binaries/tvbeam", "another build of tvbeam (binaries/tvbeam)"},
          {"/of/processor/kernel", "another kind of processor (kernel)"}}) {
        auto first = lines.at(0);
        const nlohmann::ordered_json::json_pointer pointer(key);
        BOOST_REQUIRE(first.contains(pointer));
        BOOST_TEST(first[pointer] != "unknown");
        first[pointer] = "another";
        directory.write(unfinished, sealed(first.dump()) + kept.substr(kept.find('\n')));
        refused(ladder(directory, many) + out + " --resume", difference);
    }
    // Not what was written: one by one in the second line, and a line that ends within.
    auto entry = lines.at(1);
    for (const auto& [key, value] :
         std::initializer_list<std::pair<std::string, nlohmann::json>>{{"/study", "another"},
                                                                       {"/index", 4},
                                                                       {"/result/elements", 11},
                                                                       {"/result", nullptr}}) {
        auto wrong = entry;
        wrong[nlohmann::ordered_json::json_pointer(key)] = value;
        directory.write(unfinished,
                        sealed(lines.at(0).dump()) + "\n" + sealed(wrong.dump()) + "\n");
        refused(ladder(directory, many) + out + " --resume", "is not what tvbeam wrote: line 2");
    }
    for (const std::string& wrong :
         {std::string("{\"study\": "), std::string(200000, '['),
          sealed("{\"schema\":\"tvbeam-work/0\"}"), sealed("{\"study\":\"ladder\"}")}) {
        directory.write(unfinished, wrong + "\n");
        refused(ladder(directory, many) + out + " --resume", "is not what tvbeam wrote: line 1");
    }
    // What no result depends on may change.
    directory.write(unfinished, kept);
    const Called renamed =
        call(directory, ladder(directory, many) + out + " --resume --set title=\"other\"",
             "timeout -s INT 1 ");
    BOOST_TEST(has(renamed.errors, "goes on with 3 finished runs\n"), renamed.errors);
}

BOOST_AUTO_TEST_CASE(a_line_that_was_being_written_is_dropped_with_a_sentence) {
    const TemporaryDirectory directory;
    const std::string out = " --out " + (directory.path() / "out").string();
    const std::string run = ladder(directory, many) + out;
    call(directory, run, "timeout -s INT 1 ");
    const std::string kept = directory.read(unfinished);
    directory.write(unfinished, kept.substr(0, kept.size() - 10));
    const Called resumed = call(directory, run + " --resume", "timeout -s INT 1 ");
    BOOST_TEST(
        has(resumed.errors, "goes on with 2 finished runs; line 4 is not whole and is left out"),
        resumed.errors);
    // What is left of it stays, as a line of its own.
    BOOST_TEST(has(directory.read(unfinished), kept.substr(0, kept.size() - 10) + "\n{\"crc"));
    // Nothing but a part of the first line.
    directory.write(unfinished, kept.substr(0, 10));
    const Called anew = call(directory, run + " --resume", "timeout -s INT 1 ");
    BOOST_TEST(has(anew.errors, "goes on with 0 finished runs; line 1 is not"), anew.errors);
    const Called again = call(directory, run + " --resume", "timeout -s INT 1 ");
    BOOST_TEST(has(again.errors, "goes on with 3 finished runs; line 1 is not"), again.errors);
}

BOOST_AUTO_TEST_CASE(a_run_that_ends_leaves_nothing_unfinished) {
    const TemporaryDirectory directory;
    const std::string out = " --out " + (directory.path() / "out").string();
    BOOST_TEST(call(directory, ladder(directory, few) + out + " --resume").exit == 0);
    BOOST_TEST(!std::filesystem::exists(directory.path() / "out" / "unfinished.jsonl"));
    const Called without = call(directory, ladder(directory, few) + " --resume");
    BOOST_TEST(without.exit == 2);
    BOOST_TEST(has(without.errors, "--out"), without.errors);
}

BOOST_AUTO_TEST_CASE(an_evolution_that_was_interrupted_is_not_taken_for_one_that_ended) {
    const TemporaryDirectory directory;
    const std::string out = " --quiet --out " + (directory.path() / "out").string();
    const std::string steps = " --set evolution.final_time=100000 --set evolution.elements=320"
                              " --set evolution.every=1000"; // minutes, anywhere
    call(directory, "run figure1" + steps + out, "timeout -s INT 2 ");
    const auto json = nlohmann::json::parse(directory.read("out/result.json"));
    BOOST_REQUIRE(json.at("interrupted") == true);
    const std::string again =
        "run figure1 --set evolution.final_time=1 --set evolution.period=0.5 --resume --out " +
        (directory.path() / "out").string();
    const Called resumed = call(directory, again);
    BOOST_TEST(has(resumed.errors, "nothing was kept to go on with: "), resumed.errors);
    BOOST_TEST(has(resumed.errors, "of a run that was interrupted; it is made again"),
               resumed.errors);
    const Called ended = call(directory, again);
    BOOST_TEST(has(ended.errors, "of a run that ended; it is made again"), ended.errors);
}

// Two writers in one directory would tear each other's results.
BOOST_AUTO_TEST_CASE(a_directory_that_another_run_writes_to_is_refused) {
    const TemporaryDirectory directory;
    const std::string out = " --quiet --out " + (directory.path() / "out").string();
    const Called second = call(directory, ladder(directory, many) + out,
                               "timeout -s INT 2 " + tvbeam_binary + " " + ladder(directory, many) +
                                   out + " 2>/dev/null & sleep 0.7; ");
    BOOST_TEST(second.exit == 2);
    BOOST_TEST(has(second.errors, "another tvbeam is writing there"), second.errors);
    call(directory, "--version", "sleep 2; "); // until the first has ended
    const auto json = nlohmann::json::parse(directory.read("out/result.json"));
    BOOST_TEST(json.at("interrupted") == true);
}

// A closed pipe: the files are written all the same.
BOOST_AUTO_TEST_CASE(results_in_files_do_not_depend_on_standard_output) {
    const TemporaryDirectory directory;
    const Called called = call(directory, ladder(directory, few) + " --out " +
                                              (directory.path() / "out").string() + " >/dev/full");
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(has(called.errors, "cannot write to standard output"), called.errors);
    BOOST_TEST(std::filesystem::exists(directory.path() / "out" / "report.html"));
    BOOST_TEST(!std::filesystem::exists(directory.path() / "out" / "unfinished.jsonl"));
}

BOOST_AUTO_TEST_CASE(a_check_that_is_interrupted_reports_the_scenes_before) {
    const TemporaryDirectory directory;
    const auto file = [&](const char* name) { return (directory.path() / name).string(); };
    // Once the first scene is through; what runs in the background would ignore SIGINT.
    const Called cut =
        call(directory,
             "check table1 stress-beam --junit " + file("junit.xml") + " >" + file("shown") +
                 " 2>" + file("said") + " & tvbeam=$!; while kill -0 $tvbeam && ! grep -q table1 " +
                 file("shown") + "; do sleep 0.1; done; kill -INT $tvbeam; wait $tvbeam",
             "env --default-signal=INT ");
    BOOST_TEST(cut.exit == 3);
    const std::string said = directory.read("said");
    BOOST_TEST(has(said, "interrupted in stress-beam"), said);
    BOOST_TEST(!has(directory.read("shown"), "FAIL"), directory.read("shown"));
    const std::string junit = directory.read("junit.xml");
    BOOST_TEST(has(junit, "testsuite name=\"table1\""), junit);
    BOOST_TEST(has(junit, "it was interrupted"), junit);
}

BOOST_AUTO_TEST_CASE(names_that_are_empty_are_refused) {
    const TemporaryDirectory directory;
    for (const std::string option : {"--out ''", "--csv ''", "--json ''", "--out -"}) {
        const Called called = call(directory, ladder(directory, few) + " " + option);
        BOOST_TEST(called.exit == 2, option);
        BOOST_TEST(called.output.empty(), option);
    }
}

BOOST_AUTO_TEST_CASE(quiet_is_silent) {
    const TemporaryDirectory directory;
    const Called run = call(directory, ladder(directory, few) + " --quiet");
    BOOST_TEST(run.exit == 0);
    BOOST_TEST(run.output.empty());
    BOOST_TEST(run.errors.empty());
    const Called check = call(directory, "check figure1 --quiet");
    BOOST_TEST(check.exit == 0);
    BOOST_TEST(check.output.empty());
}

// `script` gives the program a terminal.
BOOST_AUTO_TEST_CASE(progress_and_colour_are_for_terminals) {
    const TemporaryDirectory directory;
    const auto on_a_terminal = [&](const std::string& arguments, const std::string& first) {
        return call(directory, "--version >/dev/null; " + first + "script -qec '" + tvbeam_binary +
                                   " " + arguments + "' /dev/null")
            .output;
    };
    const std::string plain = call(directory, "check figure1").output;
    BOOST_TEST(!has(plain, "\033["));
    BOOST_TEST(has(on_a_terminal("check figure1", ""), "\033["));
    BOOST_TEST(!has(on_a_terminal("check figure1", "NO_COLOR=1 "), "\033["));
    const std::string cut =
        "timeout -s INT 2.2 " + tvbeam_binary + " " + ladder(directory, many) + " --json /dev/null";
    const std::string shown =
        call(directory, "--version >/dev/null; script -qec \"" + cut + "\" /dev/null").output;
    BOOST_TEST(has(shown, " % done"), shown);
    const std::string quiet =
        call(directory, "--version >/dev/null; script -qec \"" + cut + " --quiet\" /dev/null")
            .output;
    BOOST_TEST(!has(quiet, " % done"), quiet);
}

BOOST_AUTO_TEST_CASE(completion_knows_every_command_and_option_and_the_shipped_names) {
    const TemporaryDirectory directory;
    const std::string script = (directory.path() / "completion").string();
    BOOST_REQUIRE(call(directory, "completion > " + script).exit == 0);
    // As bash asks: the words of the line so far, and which one is being typed.
    const auto completed = [&](const std::string& words, int current) {
        return call(directory, "--version >/dev/null; tvbeam() { " + tvbeam_binary +
                                   " \"$@\"; }; bash -c 'export PATH=" +
                                   std::filesystem::path(tvbeam_binary).parent_path().string() +
                                   ":$PATH; source " + script + "; COMP_WORDS=(" + words +
                                   "); COMP_CWORD=" + std::to_string(current) +
                                   "; _tvbeam; echo ${COMPREPLY[@]}'")
            .output;
    };
    BOOST_TEST(has(completed("tvbeam ana", 1), "analyse"));
    BOOST_TEST(completed("tvbeam run --re", 2) == "--resume\n");
    BOOST_TEST(has(completed("tvbeam run figure", 2), "figure1"));
    BOOST_TEST(has(completed("tvbeam derive impa", 2), "impact"));
    const std::string help = call(directory, "--help").output;
    for (const std::string command : {"run", "check", "analyse", "derive", "new", "list"})
        BOOST_TEST(has(call(directory, command + " --help").output, "Example: "), command);
}

BOOST_AUTO_TEST_SUITE_END()

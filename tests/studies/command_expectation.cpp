// [[expect.commands]]: how a command ends and what it says, in a directory that all commands of the
// scene share. A shell stands in for tvbeam: run = ["-c", …].

#include "mms/text/input_error.hpp"
#include "studies/gates/check.hpp"
#include "studies/study.hpp"
#include "studies/text/column_sizes.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cstdlib>
#include <ostream>
#include <string>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(command_expectations)

namespace {

const std::string scene = "solution = 'free-oscillation'\n[beam]\nalpha = 0.3\nzeta = 0.05\n"
                          "stops = [-0.1, 0.1]\n[ladder]\nfinal_time = 1.0\nelements = [5]\n"
                          "dt = [0.1]\nnorms = ['theta_L2L2']\n";

std::vector<CheckedExpectation> checked(const std::string& lines,
                                        const std::string& program = "/bin/sh") {
    const TemporaryDirectory directory;
    const auto file = directory.write("s.toml", scene + lines);
    return check(run_study(read_scene(file, {}, {.expectations = true, .program = program})));
}

/// Of each expectation what was found, where it does not hold.
std::vector<std::string> violations(const std::string& lines) {
    std::vector<std::string> found;
    for (const auto& one : checked(lines))
        if (!one.holds)
            found.push_back(one.what + ": expected " + one.expected + ", found " + one.found);
    return found;
}

std::string command(const std::string& words, const std::string& rest = "") {
    return "[[expect.commands]]\nrun = ['-c', '" + words + "']\n" + rest + "\n";
}

struct Claim {
    std::string lines;
    std::vector<std::string> violations;
};

std::ostream& operator<<(std::ostream& stream, const Claim& claim) {
    return stream << claim.lines;
}

const std::vector<Claim> claims{
    {command("echo one two", "says = ['one', 'two']"), {}},
    {command("echo one two", "says = ['three', 'one']"),
     {"commands.0.says: expected \"three\", found one two\n"}},
    // What is said of an error stands on the other stream.
    {command("echo wrong >&2; exit 2", "exit = 2\nsays = ['wrong']"), {}},
    {command("echo said; exit 2"), {"commands.0: expected exit 0, found exit 2: said\n"}},
    {command("echo said", "exit = 2"), {"commands.0: expected exit 2, found exit 0: said\n"}},
    {command("kill -9 $$"), {"commands.0: expected exit 0, found killed by signal 9 (Killed): "}},
    // One directory, in which what went before still stands; that of another scene is another.
    {command("echo kept > a") + command("cat a", "says = ['kept']"), {}},
    {command("ls; cat b/c", "says = ['deep']\n[expect.commands.files]\n'b/c' = 'deep'"), {}},
    {command("cat a", "exit = 1"), {}},
    // Wherever a line breaks.
    {command("echo one; echo two", "says = ['one two']"), {}},
    {command("echo one; head -c 300000 /dev/zero | tr \\\\0 \\\\n; echo two", "says = ['one two']"),
     {}},
    // What cannot be written is said of the command.
    {command("true", "[expect.commands.files]\na = ''\n'a/b' = ''"),
     {"commands.0: expected exit 0, found nothing run: cannot write a/b: "}},
};

} // namespace

BOOST_DATA_TEST_CASE(each_is_held_against_how_it_ends_and_what_it_says, data::make(claims), claim) {
    BOOST_TEST(violations(claim.lines) == claim.violations, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_is_examined_has_no_seconds_and_lists_the_files) {
    const auto all = checked(command("printf \"  s error  sec\\n 10  1e-3 5e-4\\n 20  2e-4 0.1\\n"
                                     "\\nok, 0.3 s\\n\" | tee a.csv; echo > b.svg"));
    BOOST_REQUIRE(all.size() == 1);
    BOOST_TEST(all.front().examined == "exit 0\n  s error  sec\n 10  1e-3\n 20  2e-4\n\nok\n"
                                       "a.csv: 5 lines," +
                                           column_sizes("10 1e-3\n20 2e-4\n") + "\nb.svg");
}

BOOST_AUTO_TEST_CASE(without_a_program_and_within_a_command_nothing_is_run_and_nothing_holds) {
    const std::string lines = command("echo > /dev/null");
    BOOST_TEST(checked(lines).front().holds);
    const auto none = checked(lines, "");
    BOOST_REQUIRE(none.size() == 1);
    BOOST_TEST(!none.front().holds);
    BOOST_TEST(none.front().found.starts_with("nothing: no program is known to run"));
    // As a command finds it.
    BOOST_TEST(violations(command("test \"$TVBEAM_WITHIN_A_COMMAND\" = 1")).empty());
    setenv("TVBEAM_WITHIN_A_COMMAND", "1", 1);
    const auto within = checked(lines);
    unsetenv("TVBEAM_WITHIN_A_COMMAND");
    BOOST_REQUIRE(within.size() == 1);
    BOOST_TEST(!within.front().holds);
    BOOST_TEST(within.front().found.starts_with("nothing: a command of another scene"));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_asked_for_is_refused_at_its_place) {
    const auto refused = [](const std::string& lines, const std::string& message) {
        BOOST_CHECK_EXCEPTION(checked(lines), InputError, [&](const InputError& error) {
            BOOST_TEST(std::string(error.what()).find(message) != std::string::npos, error.what());
            return true;
        });
    };
    refused("[[expect.commands]]\n", "s.toml:11:1: expect.commands.0.run must be the words");
    refused("[[expect.commands]]\nrun = []\n", "expect.commands.0.run must be the words");
    refused(command("echo", "says = ['.']"), "s.toml:13:9: expect.commands.0.says must hold words");
    refused(command("echo", "[expect.commands.files]\n'../a' = ''"),
            "'../a', which is no file within");
    refused(command("echo", "[expect.commands.files]\n'/a' = ''"), "'/a', which is no file within");
    refused(command("echo", "[expect.commands.files]\n'a/' = ''"), "'a/', which is no file within");
    refused(command("echo", "exit = 256"), "a code from 0 to 255");
    refused(command("echo", "end = 2"), "unknown key 'expect.commands.0.end'");
}

BOOST_AUTO_TEST_SUITE_END()

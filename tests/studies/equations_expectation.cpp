// [[expect.equations]]: what is derived of a system of equations, held against what a scene says of
// it.

#include "mms/text/input_error.hpp"
#include "studies/gates/check.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(equations_expectations)

namespace {

const std::string scene = "solution = 'free-oscillation'\n[beam]\nalpha = 0.3\nzeta = 0.05\n"
                          "stops = [-0.1, 0.1]\n[ladder]\nfinal_time = 1.0\nelements = [5]\n"
                          "dt = [0.1]\nnorms = ['theta_L2L2']\n[[expect.equations]]\n";

// u_xx = 0: of the two terms one is not tested.
const std::string rod = "text = \"[unknowns]\\nu = 'x*t'\\n[equations]\\n"
                        "f = 'diff(u, t) - diff(u, x, 2)'\"\n";
const std::string pole = "text = \"[unknowns]\\nu = '1/x'\\n[equations]\\nf = 'diff(u, x)'\"\n";

std::vector<CheckedExpectation> checked(const std::string& lines) {
    const TemporaryDirectory directory;
    directory.write("negative.toml", "[unknowns]\nu = '1/x'\n[equations]\nf = 'u'\n");
    directory.write("rod.toml", "[unknowns]\nu = 'x^2'\n[equations]\nf = 'diff(u, x, 2)'\n");
    const auto file = directory.write("s.toml", scene + lines);
    return check(run_study(read_scene(file, {}, {.expectations = true})));
}

bool all_hold(const std::string& lines) {
    const auto all = checked(lines);
    return !all.empty() &&
           std::all_of(all.begin(), all.end(), [](const auto& one) { return one.holds; });
}

std::string refusal(const std::string& lines) {
    try {
        checked(lines);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

BOOST_AUTO_TEST_CASE(what_is_derived_is_held_against_what_a_scene_says) {
    BOOST_TEST(all_hold(rod + "says = ['= x', 'diff(u, t)']"));
    BOOST_TEST(all_hold("file = './rod.toml'\nsays = ['= 2']"));
    BOOST_TEST(all_hold("file = 'heat-2d'\nsays = ['flux']"));
    BOOST_TEST(all_hold(rod + "language = 'fortran'\nsays = ['real(dp) function f']"));
    BOOST_TEST(!all_hold(rod + "says = ['real(dp) function f']"));
    const auto wrong = checked(rod + "says = ['= x', '= y']");
    BOOST_REQUIRE(wrong.size() == 2U);
    BOOST_TEST(wrong[0].holds);
    BOOST_TEST(!wrong[1].holds);
    BOOST_TEST(wrong[1].what == "equations.0.says.1");
    BOOST_TEST(wrong[1].place.line == 13);
}

BOOST_AUTO_TEST_CASE(all_remarks_are_named_and_no_others) {
    BOOST_TEST(all_hold(rod + "remarks = ['u_xx is zero everywhere']"));
    BOOST_TEST(!all_hold(rod + "remarks = ['u_tt is zero everywhere']"));
    BOOST_TEST(!all_hold(rod + "remarks = []"));
    BOOST_TEST(all_hold("file = './rod.toml'\nremarks = []"));
}

BOOST_AUTO_TEST_CASE(a_refusal_is_held_against_its_message) {
    BOOST_TEST(all_hold(pole + "refused = [':2:6: u has no value', 'x = 0']"));
    // The name of the file is none of the message.
    BOOST_TEST(!all_hold(pole + "refused = ['text']"));
    BOOST_TEST(!all_hold("file = './negative.toml'\nrefused = ['negative']"));
    BOOST_TEST(!all_hold(pole + "refused = ['a pole']"));
    BOOST_TEST(!all_hold(rod + "refused = ['pole']"));
    // What is refused says nothing else, and what is expected of it does not hold.
    BOOST_TEST(!all_hold(pole + "says = ['pole']"));
    BOOST_TEST(!all_hold(pole + "remarks = []"));
    BOOST_TEST(!all_hold(pole + "remarks = [':2:6: u has no value']"));
    BOOST_TEST(!all_hold(pole + "language = 'c'\nsays = ['double f(double x)']"));
    BOOST_TEST(all_hold(pole + "language = 'c'\nrefused = ['u has no value']"));
}

BOOST_AUTO_TEST_CASE(what_expects_nothing_or_two_things_is_refused) {
    const auto said = [](const std::string& lines, const std::string& words) {
        const std::string message = refusal(lines);
        BOOST_TEST(message.find(words) != std::string::npos, message);
    };
    said(rod, "must expect that it is `refused`");
    said(rod + "says = ['x']\nrefused = ['x']", "must expect that it is `refused`");
    said("says = ['x']", "a file of equations, or the text of one");
    said(rod + "file = 'heat-2d'\nsays = ['x']", "has both `file` and `text`; remove one");
    said(rod + "says = ['= ']", "must hold words of what is said");
    said("file = 'heat2d'\nsays = ['x']", "heat-2d");
    said(rod + "language = 'cobol'\nsays = ['x']", "cobol");
    said(rod + "language = 'c'\nremarks = []", "are of equations, not of their code");
}

BOOST_AUTO_TEST_CASE(how_a_problem_is_prepared_is_held_against_what_a_scene_says) {
    // sin(pi x) is integrated on intervals of its own; what does not separate in this solution
    // becomes products.
    const std::string solution =
        "[[expect.refused]]\nset = ['expect.quadrature.intervals=[0, 1]']\n"
        "says = ['quadrature.intervals: expected 0 to 1, found ']\n"
        "[[expect.refused]]\nset = ['expect.quadrature.finest=[1, 2]']\n"
        "says = ['quadrature.finest: expected 1 to 2, found 0.']\n"
        "[[expect.refused]]\nset = ['expect.separation.rank=[1, 2]']\n"
        "says = ['separation.rank: expected 1 to 2, found 0']\n"
        "[[expect.refused]]\nset = ['expect.separation={}']\n"
        "says = ['expects nothing']\n";
    BOOST_TEST(all_hold(rod + "says = ['= x']\n" + solution));
}

BOOST_AUTO_TEST_CASE(nothing_is_prepared_of_a_problem_that_is_another_program_s) {
    const TemporaryDirectory directory;
    for (const std::string block : {"quadrature.finest = [0, 2]", "separation.rank = [-1, 1]"}) {
        const auto file = directory.write(
            "s.toml", "[solver]\ncommand = ['true']\nerrors = { e = 'e = (\\S+)' }\n[ladder]\n"
                      "elements = [1, 2]\nnorms = ['e']\n[expect]\n" +
                          block + "\n");
        BOOST_CHECK_THROW(read_scene(file, {}, {.expectations = true}), InputError);
    }
}

BOOST_AUTO_TEST_SUITE_END()

// Programs as solvers: what is filled into their commands, how numbers are read of what they write,
// how they are ended, and what knows a run again.

#include "studies/external/external_runs.hpp"
#include "studies/external/figure_source.hpp"
#include "studies/external/keeper.hpp"
#include "studies/external/output.hpp"
#include "studies/external/placeholders.hpp"
#include "studies/external/process.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

using namespace tvbeam;
namespace fs = std::filesystem;

BOOST_AUTO_TEST_SUITE(external)

BOOST_AUTO_TEST_SUITE(placeholders)

namespace {

const Placeholders known{{"elements", "8"}, {"k", "a b"}, {"dt", std::nullopt}};

std::string filled(const std::string& text) {
    return Template{text, {"scene.toml", 3, 5}}.filled(known);
}

std::string refusal(const Template& text) {
    try {
        return "filled in: " + text.filled(known);
    } catch (const InputError& error) {
        return error.what();
    }
}

} // namespace

BOOST_AUTO_TEST_CASE(names_in_braces_are_filled_in_and_other_braces_stay) {
    for (const auto& [text, wanted] : std::vector<std::pair<std::string, std::string>>{
             {"", ""},
             {"-n={elements},{k}", "-n=8,a b"},
             {"{elements}{elements}", "88"},
             {"{{elements}", "{elements}"},            // a brace, and no placeholder
             {"{{elements}}", "{elements}"},           // closed by what closes a brace
             {"{{{elements}}}", "{8}"},                // the one in the other
             {"{{{{1}}, {{2}}}}", "{{1}, {2}}"},       // one in another
             {"if (a) { b(); }}", "if (a) { b(); }}"}, // none was opened as {{
             {"{ k }{8}{-}{", "{ k }{8}{-}{"},         // no names
             {"}{", "}{"}})
        BOOST_TEST(filled(text) == wanted, text);
}

BOOST_AUTO_TEST_CASE(code_gets_numbers_of_its_language_and_other_files_and_the_command_bare_ones) {
    const TemporaryDirectory directory;
    directory.write("s.toml", "[unknowns]\nu = \"sin(pi*x)*sin(pi*y)*exp(k*t)\"\n[parameters]\n"
                              "k = -3\n[equations]\nf = \"diff(u, t) - k*laplace(u) + u^2\"\n");
    const auto texts = [&](const std::string& language, const std::string& file) {
        directory.write(file + ".in", "{parameter.k}|{source.f}");
        const Scene scene = read_scene(directory.write(
            "scene.toml", "[solver]\ncommand = [\"true\", \"{parameter.k}|{source.f}\"]\n"
                          "files = [\"" +
                              file +
                              ".in\"]\nerrors = { L2 = 'L2 = (\\S+)' }\nsolution = "
                              "\"./s.toml\"\nlanguage = \"" +
                              language + "\"\n[ladder]\nelements = [2, 4]\nnorms = [\"L2\"]\n"));
        return std::pair(scene.solver->command[1].text, scene.solver->files[0].contents->text);
    };
    for (const auto& [language, file, number] :
         {std::tuple<std::string, std::string, std::string>{"c", "heat.c", "(-3.0)"},
          {"fortran", "heat.f90", "(-3.0_dp)"},
          {"python", "heat.py", "(-3)"},
          {"c", "input.txt", "-3"},
          {"fortran", "heat.nml", "-3"},
          {"python", "heat.json", "-3"}}) {
        const auto [in_command, in_file] = texts(language, file);
        BOOST_TEST(in_command.starts_with("-3|("), in_command);
        BOOST_TEST(in_file == number + in_command.substr(2), in_file);
    }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_filled_in_is_told_at_its_place) {
    BOOST_TEST(
        refusal({"{element}", {"scene.toml", 3, 5}})
            .starts_with(
                "scene.toml:3:5: there is no placeholder {element}; did you mean 'elements'?"),
        refusal({"{element}", {"scene.toml", 3, 5}}));
    BOOST_TEST(refusal({"{dt}", {"scene.toml", 3, 5}}).find("has nothing to stand for") !=
               std::string::npos);
    // In a file at its line and column.
    BOOST_TEST(refusal({"one\ntwo {elements} {no}\n", {"a.in"}, true}).starts_with("a.in:2:16: "),
               refusal({"one\ntwo {elements} {no}\n", {"a.in"}, true}));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(readings)

namespace {

ReadFigure read(const std::vector<std::string>& lines, const std::string& pattern) {
    const OutputPattern own("L2", pattern, {});
    OutputReading reading(own);
    for (const auto& line : lines)
        reading.take(line);
    return reading.figure();
}

ReadFigure in_file(const std::string& name, const std::string& text) {
    const TemporaryDirectory directory;
    return figure_in(directory.write(name, text), "L2");
}

} // namespace

BOOST_AUTO_TEST_CASE(the_last_line_that_matches_has_the_number) {
    const std::string pattern = "L2 = (\\S+)";
    BOOST_TEST(*read({"L2 = 7", "x L2 = 1.5", "H1 = 2"}, pattern).value == 1.5);
    // Fortran's exponent, a sign, blanks around.
    BOOST_TEST(*read({"L2 = +1.5D-3"}, pattern).value == 1.5e-3);
    BOOST_TEST(*read({"L2 = -2d0 "}, "L2 = (.+)").value == -2.0);
}

BOOST_AUTO_TEST_CASE(what_is_no_one_number_is_a_failure_that_says_why) {
    const std::string pattern = "L2 = (\\S+)";
    for (const auto& [line, words] : std::vector<std::pair<std::string, std::string>>{
             {"H1 = 2", "no L2: nothing on standard output matches"},
             {"L2 = nan", "L2 is nan"},
             {"L2 = inf", "L2 is inf"},
             {"L2 = 1e999", "L2 is 1e999"},
             {"L2 = 1,5", "L2 is '1,5', which is not one number"},
             {"L2 = 1 L2 = 2", "has two of them"}}) {
        const ReadFigure found = read({line}, pattern);
        BOOST_TEST(!found.value, line);
        BOOST_TEST(found.failure.find(words) != std::string::npos, found.failure);
    }
}

// A part of a number is another number.
BOOST_AUTO_TEST_CASE(a_pattern_that_ends_within_a_number_is_a_failure) {
    for (const std::string line :
         {"L2 = 9.76e-04", "L2 = 9.76D+04 m", "L2 = 9.76.", "L2 = 9.76e4"}) {
        const ReadFigure found = read({line}, "L2 = ([0-9]+\\.?[0-9]?)");
        BOOST_TEST(!found.value, line);
        BOOST_TEST(found.failure.find("ends within the number") != std::string::npos,
                   found.failure);
    }
    // What the pattern names behind the group, or counts off.
    BOOST_TEST(*read({"took 2d3h"}, "took ([0-9]+)d").value == 2.0);
    BOOST_TEST(*read({"took 2d3h"}, "took ([0-9]+)[dh]").value == 2.0);
    BOOST_TEST(*read({"0.25000.5"}, "^(.{6})").value == 0.25);
    for (const std::string line :
         {"L2 = 9.7", "L2 = 9.7 e-04", "L2 = 9.7em", "L2 = 9.7, 2", "L2 = 9.7e"})
        BOOST_TEST(*read({line}, "L2 = ([0-9]+\\.?[0-9]?)").value == 9.7, line);
    // A brace that counts nothing, an exponent behind a bare point or without its letter, and what
    // stands before a word further on.
    for (const auto& [line, pattern] : std::vector<std::pair<std::string, std::string>>{
             {"{\"cd\": 5.3125e-04}", R"(\{"cd": (\d+\.\d+))"},
             {"a{2}= 5.3125e-04", R"(a\{2\}= (\d+\.\d+))"},
             {"L2 = [8.e-01]", R"(L2 = \[(\d*\.?\d+))"},
             {"L2 = 0.123-100", R"(L2 = ([\d.]+))"},
             {"L2 = 4.0e-01, 3 steps", R"(L2 = ([\d.]+).*steps)"},
             {"v = 1.234567e-100", R"(v = (-?\d+\.\d{3,}(?:[eE][-+]\d{2})?))"},
             {"v = 1.2345e-05", R"(v = (\d\.\d{4}))"},
             {"v = 1.2345", R"(v = ([0-9.]{4}))"},
             {"dofs = 16641", R"(dofs = (\d{4}))"},
             {"v = 8.00e-03", R"(v = (\d+\.\d+)(?:[eE][-+]?\d+)?)"},
             {"v = 8.00e-03", R"(v = (\d+\.\d+)(?:e|$))"},
             {"v = 8.00e-03", R"(v = (\d+\.\d+)(?=e))"}})
        BOOST_TEST(read({line}, pattern).failure.find("ends within the number") !=
                       std::string::npos,
                   pattern);
    BOOST_TEST(*read({"L2 = 4.0e-01, 3 steps"}, R"(L2 = (\S+),.*steps)").value == 0.4);
    BOOST_TEST(*read({"L2 = [8., 4.]"}, R"(L2 = \[(\d+\.?\d*))").value == 8.0);
    BOOST_TEST(*read({"L2 = 4.0-2"}, R"(L2 = ([\d.]+))").value == 4.0); // a range
    for (const auto& [line, pattern] : std::vector<std::pair<std::string, std::string>>{
             {"dofs = 16,641", R"(dofs = (\d+))"},
             {"drag = -1,234.5 N", R"(drag = (-?\d+))"},
             {"drag = 1'234.5", R"(drag = ([\d.]+))"},
             {"drag = 1_234.5", R"(drag = (\d+))"},
             {"drag = 1\u202f234", R"(drag = (\d+))"}})
        BOOST_TEST(read({line}, pattern).failure.find("print it without separators") !=
                       std::string::npos,
                   pattern);
    // A comma that is a decimal point; beside a point, in a list or brackets it is none.
    for (const auto& [line, pattern] :
         std::vector<std::pair<std::string, std::string>>{{"v = 7,500000", R"(v = ([0-9.]+))"},
                                                          {"v = 1,5e-3", R"(v = ([0-9.]+))"},
                                                          {"v = -3,5000 m", R"(v = (-?\d+))"},
                                                          {"v = 0,25", R"(v = (\d+))"},
                                                          {"v = 0,0012, w = 3", R"(v = (\d+))"},
                                                          {"(in L2: v = 0,25)", R"(v = (\d+))"},
                                                          {"v = 12345,5.", R"(v = (\d+))"}})
        BOOST_TEST(read({line}, pattern).failure.find("with a decimal point") != std::string::npos,
                   line);
    for (const auto& [line, pattern] :
         std::vector<std::pair<std::string, std::string>>{{"v = 7,5,3", R"(v = (\d+))"},
                                                          {"v = 7,5e-1,3", R"(v = (\d+))"},
                                                          {"v = 7,2.5", R"(v = (\d+))"},
                                                          {"v = 7, 5", R"(v = (\d+))"},
                                                          {"v = 7.0,5", R"(v = (\S+),)"},
                                                          {"v = 7.0,5", R"(v = ([\d.]+))"},
                                                          {"v = (7,5)", R"(v = \((\d+))"},
                                                          {"v = [6,7,5]", R"(6,(\d+))"},
                                                          {"v = 7,5", R"(v = (\d+),5)"}})
        BOOST_TEST(read({line}, pattern).value.value_or(0.0) == 7.0, line);
    for (const std::string line :
         {"v = 1.5 x 10^-3", "v = 1.5*10^-3", "v = 1.5 \u00d7 10\u207b\u00b3", "v = 1.5\u00b710^3",
          "v = 1.5 * 10**-3"})
        BOOST_TEST(read({line}, R"(v = ([\d.]+))").failure.find("print its exponent") !=
                       std::string::npos,
                   line);
    // The power that the pattern names, names of files, and what is no number behind 10.
    for (const auto& [line, pattern] : std::vector<std::pair<std::string, std::string>>{
             {"v = 1.5 x 10^-3 m", R"(v = (\S+) x 10\^-3)"},
             {"v = 1.5 * 10**s", R"(v = ([\d.]+))"},
             {"v = 1.5e0 \u00b7 10\u207b\u00b3", "v = (\\S+) \u00b7 10"}})
        BOOST_TEST(read({line}, pattern).value.value_or(0.0) == 1.5, line);
    for (const auto& [line, pattern] : std::vector<std::pair<std::string, std::string>>{
             {"cg_4_001: iters", R"(cg_(\d+))"}, {"iters 4_001.vtu", R"(iters (\d+))"}})
        BOOST_TEST(read({line}, pattern).value.value_or(0.0) == 4.0, line);
    for (const std::string line : {"v = 1.5 x 10 cells", "v = 1.5 * 10", "v = 1.5 10^3 cells"})
        BOOST_TEST(*read({line}, R"(v = ([\d.]+))").value == 1.5, line);
    // Rows, pairs, and a comma that the pattern names.
    for (const auto& [line, pattern] :
         std::vector<std::pair<std::string, std::string>>{{"5,125,0.5", R"(^(\d+))"},
                                                          {"it,5,640", R"(it,(\d+))"},
                                                          {"pair (5,128)", R"(\((\d+))"},
                                                          {"5,125", R"(^(\d+),)"}})
        BOOST_TEST(read({line}, pattern).value.value_or(0.0) == 5.0, pattern);
    // A part of a complex number; and what follows is named in a group, or brackets.
    for (const auto& [line, pattern] : std::vector<std::pair<std::string, std::string>>{
             {"v = 1.5-100.25i", R"(v = (-?\d+\.\d+))"},
             {"v = (1.5+100j)", R"(v = \(?(-?\d+\.\d+))"},
             {"v = 1.5e-3", R"(v = (\d+\.\d+)(?:e-3))"},
             {"version 0.1.5", R"(version 0[.](\d+\.\d))"}})
        BOOST_TEST(read({line}, pattern).value.value_or(0.0) == 1.5, pattern);
}

BOOST_AUTO_TEST_CASE(a_pattern_that_begins_within_a_number_is_a_failure) {
    for (const std::string line : {"L2 = 21.5", "L2 = -1.5", "L2: .5, 1.5e3 -2.5", "L2=-1.5"}) {
        const ReadFigure found = read({line}, "L2.*(\\d\\.\\d)");
        BOOST_TEST(!found.value, line);
        BOOST_TEST(found.failure.find("begins within the number") != std::string::npos,
                   found.failure);
    }
    BOOST_TEST(*read({"L2 = 1.5"}, "L2.*(\\d\\.\\d)").value == 1.5);
    BOOST_TEST(*read({"range 1\u22122.5"}, R"((\d\.\d))").value == 2.5); // a dash
    // What the pattern itself names before the group is meant so.
    BOOST_TEST(*read({"L2 = 1e-05"}, "e-(\\d+)").value == 5.0);
    BOOST_TEST(*read({"took 12:30"}, "[0-9]+:([0-9]+)").value == 30.0);
    BOOST_TEST(*read({"L20.5"}, "L\\d?(\\S+)").value == 0.5);
    BOOST_TEST(*read({"L2-0.5"}, "L2-?(\\S+)").value == 0.5);
    // A minus, a point or digits that a class of anything else took, or nothing did.
    for (const auto& [line, pattern] : std::vector<std::pair<std::string, std::string>>{
             {"drag: -0.75", R"(drag\D*([-+\d.eE]+))"},
             {"drag: \u22120.75", R"(drag\D*([-+\d.eE]+))"}, // a typeset minus
             {"drag: -0.75", R"((\d+\.\d+)$)"},
             {"drag: -.75", R"(drag\W+(\d+))"},
             {"drag=-0.75", R"(drag[ =:-]+(\S+))"},
             {"(-0.75)", R"(\W?(\d\.\d+))"},
             {"drag: 12", R"(drag: (\d)+)"},
             {"drag: -0.75", R"(drag\W{1,5}(\d+\.\d+))"},
             {"drag: 1.5", R"(\d\D(\d))"}})
        BOOST_TEST(read({line}, pattern).failure.find("begins within the number") !=
                       std::string::npos,
                   pattern);
    // What is named, or counted off; a hyphen, a date and a version are no signs.
    for (const auto& [line, pattern] :
         std::vector<std::pair<std::string, std::string>>{{"drag: -0.75", R"(drag: -(\S+))"},
                                                          {"drag: -0.75", R"(drag: [-+]?(\S+))"},
                                                          {"123450.75", R"(^.{5}(\S+))"},
                                                          {"level-0.75", R"(level\D(\S+))"},
                                                          {"of 2026-0.75", R"(\D(\S{4})$)"},
                                                          {"took 12.0.75", R"(took \d+\.(\S+))"},
                                                          {"(x=-0.75)", R"((?:x|y)=-(\d\.\d+))"},
                                                          {"(x=-0.75)", R"((?:x=-)(\d\.\d+))"}})
        BOOST_TEST(read({line}, pattern).value.value_or(0.0) == 0.75, pattern);
    // Dots and dashes that lead to a number.
    for (const std::string line : {"L2 ..... 0.5", "L2.....0.5", "L2 -----0.5", "L2: +0.5"})
        BOOST_TEST(*read({line}, "L2[^0-9]*(\\S+)").value == 0.5, line);
}

BOOST_AUTO_TEST_CASE(a_named_class_is_part_of_its_brackets) {
    BOOST_TEST(*read({"L2 = 1.5"}, "L2[[:space:]:=]+(\\S+)").value == 1.5);
}

BOOST_AUTO_TEST_CASE(the_digits_that_were_printed_are_known) {
    BOOST_TEST(read({"L2 = 1.760"}, "L2 = (\\S+)").printed.last_place == -3);
    BOOST_TEST(in_file("e.csv", "L2\n1.50e-2\n").printed.last_place == -4);
    // As it is written, and not as the shortest text of the same number.
    BOOST_TEST(in_file("e.json", "{\"L2\": 1.760}").printed.last_place == -3);
    BOOST_TEST(in_file("e.json", "{\"L2\": 0.00e+00}").printed.is_zero);
    BOOST_TEST(in_file("e.json", "{\"L2\": 12}").printed.last_place == 0);
    BOOST_TEST(*in_file("e.json", "{\"a\": {\"L2\": 1}, \"L2\": -2.5, \"b\": [3]}").value == -2.5);
}

// What every match holds is looked for first: it must be no more than that.
BOOST_AUTO_TEST_CASE(the_literal_of_a_pattern_passes_over_no_match) {
    for (const auto& [pattern, literal] :
         std::vector<std::pair<std::string, std::string>>{{"L2 = (\\S+)", "L2 = "},
                                                          {"ab?(\\d)", "a"}, // b may be absent
                                                          {"ab*(\\d)", "a"},
                                                          {"ab{0}(\\d)", "a"},
                                                          {"ab+(\\d)", "ab"},
                                                          {"a|b(\\d)", ""}, // either
                                                          {"(\\d)", ""},
                                                          {"^L2 (\\d)", "L2 "},
                                                          {".*long = (\\d)s", "long = "},
                                                          {"(\\d)\\.[abc]+xy", "xy"},
                                                          {"a\\.b(?:cdef)?(\\d)", "a.b"},
                                                          {"[(]ab(\\d)[)]", "ab"},
                                                          {"\\x41bc(\\d)", ""},
                                                          {"(\\d)\\s+abc{2}", "ab"}})
        BOOST_TEST(OutputPattern("x", pattern, {}).literal == literal, pattern);
    BOOST_TEST(*read({"a4"}, "ab?(\\d)").value == 4.0);
    BOOST_TEST(*read({"b4"}, "a|b(\\d)").value == 4.0);
}

// A number at the end of what is read may have gone on.
BOOST_AUTO_TEST_CASE(a_line_that_is_cut_has_no_number) {
    const std::string number = "E = 1.875e-01";
    const auto line = [&](std::size_t length) {
        return std::string(length - number.size(), '.') + number;
    };
    BOOST_TEST(*read({line(5000)}, "E = (\\S+)").value == 0.1875);
    const ReadFigure cut = read({line(OutputLines::longest_line)}, "E = (\\S+)");
    BOOST_TEST(!cut.value);
    BOOST_TEST(cut.failure ==
               "of the last line with L2, or one behind it, only the first MiB is read");
    const std::string long_line(OutputLines::longest_line, '.');
    BOOST_TEST(!read({number, long_line}, "E = (\\S+)").value); // which may have a later number
    BOOST_TEST(*read({long_line, number}, "E = (\\S+)").value == 0.1875);
    std::string wide = "L2";
    std::string row = "1.875e-01";
    for (int i = 0; i < 2000; ++i) {
        wide.insert(0, "probe" + std::to_string(i) + ",");
        row.insert(0, "1.25e-01,");
    }
    BOOST_TEST(*in_file("e.csv", wide + "\n" + row + "\n").value == 0.1875);
}

BOOST_AUTO_TEST_CASE(a_pattern_has_one_group) {
    // The last two are of what the library of regular expressions would overflow at.
    for (const auto* pattern :
         {"L2", "(a)(b)", "(a", "(?:a)", "(a{55555555555555555555})", "(a)\\55555555555555555555"})
        BOOST_CHECK_THROW(OutputPattern("L2", pattern, {}), InputError);
    BOOST_CHECK_NO_THROW(OutputPattern("L2", "(?:a|b) (\\d)", {}));
}

BOOST_AUTO_TEST_CASE(a_file_has_the_number_by_its_name) {
    BOOST_TEST(*in_file("e.json", "{\"H1\": 1, \"L2\": 0.5}").value == 0.5);
    BOOST_TEST(*in_file("e.csv", "step,L2\n1,7\n2,0.5\n\n").value == 0.5);
    BOOST_TEST(*in_file("e.csv", "step;\"L2\"\n2; 0.5 \n").value == 0.5);
    BOOST_TEST(*in_file("e.csv", "step  L2\n2\t0.5").value == 0.5);
    BOOST_TEST(*in_file("e.csv", "\xEF\xBB\xBFL2,step\n0.5,2\n").value == 0.5);
    BOOST_TEST(*in_file("e.json", "\xEF\xBB\xBF{\"L2\": 0.5}").value == 0.5);
    BOOST_TEST(*in_file("e.csv", "# of a run\nstep,L2\n% half\n2,0.5\n# the end\n").value == 0.5);
    BOOST_TEST(*in_file("e.csv", "# of a run\n# step L2\n1 7\n2 0.5\n").value == 0.5);
    for (const auto& [name, text, words] : std::vector<std::array<std::string, 3>>{
             {"e.json", "{\"H1\": 1}", "e.json: it has no L2"},
             {"e.json", "{\"L2\": \"1\"}", "L2 is \"1\", which is not one number"},
             {"e.json", "{\"L2\": [1]}", "L2 is […], which is not one number"},
             {"e.json", "{\"L2\": 1, \"L2\": 1}", "more than once"},
             {"e.json", "{\"L2\": null}", "L2 is null, which is not one number"},
             {"e.json", "[1]", "it is not an object"},
             {"e.json", "{", "it is not JSON"},
             {"e.json", std::string(40, '['), "nested too deep"},
             {"e.csv", "L2\n", "it has no row below its header"},
             {"e.csv", "H1\n1\n", "its header has no L2"},
             {"e.csv", "a,L2\n1\n", "its last row has 1 field and its header 2"},
             {"e.csv", "L2\nnan\n", "L2 is nan"}}) {
        const ReadFigure found = in_file(name, text);
        BOOST_TEST(!found.value, text);
        BOOST_TEST(found.failure.find(words) != std::string::npos, found.failure);
    }
    const TemporaryDirectory directory;
    BOOST_TEST(figure_in(directory.path() / "e.json", "L2").failure ==
               "no L2: it wrote no file e.json");
}

BOOST_AUTO_TEST_CASE(lines_are_told_whole_and_their_last_are_kept) {
    std::vector<std::string> lines;
    OutputLines output([&](const std::string& line) { lines.push_back(line); });
    output.take("on");
    output.take("e\n\ntwo\nth");
    output.take("ree\x01");
    BOOST_TEST(lines == (std::vector<std::string>{"one", "", "two"}));
    output.finish();
    BOOST_TEST(lines.back() == "three\x01");
    BOOST_TEST(output.last_lines(2) == "two | three"); // nothing that a terminal would obey
    BOOST_TEST(output.last_lines(5) == "one | two | three");
    // Wherever the line is cut.
    for (std::size_t before = 0; before < 250; ++before) {
        const std::string text(before, '.');
        OutputLines one([](const std::string&) {});
        OutputLines other([](const std::string&) {});
        one.take(text + " /tmp/a/x /tmp/ax /tmp/a\n");
        other.take(text + " /tmp/longer/x /tmp/ax /tmp/longer\n");
        BOOST_TEST(one.last_lines(1, "/tmp/a") == other.last_lines(1, "/tmp/longer"));
    }
    // Nor what is no UTF-8: Latin-1, and a character that the longest line ends in.
    OutputLines foreign([](const std::string&) {});
    foreign.take("ersch\xF6pft\n" + std::string(199, 'x') + "é and so on");
    BOOST_TEST(foreign.last_lines(2) == "ersch\\xF6pft | " + std::string(199, 'x') + " ...");
    foreign.take(std::string(1000, ' ') + "中");
    for (int i = 0; i < 1500; ++i)
        foreign.take("中"); // of three bytes, of which one is left at the begin of 4096
    BOOST_TEST(foreign.last_lines(1).starts_with("中中"), foreign.last_lines(1));
    // A line without end takes no more memory than this.
    for (int i = 0; i < 100; ++i)
        output.take(std::string(1000, 'x'));
    output.finish();
    BOOST_TEST(lines.back().size() == 100'000U);
    for (int i = 0; i < 1100; ++i)
        output.take(std::string(1000, 'x'));
    output.finish();
    BOOST_TEST(lines.back().size() == OutputLines::longest_line);
    lines.clear();
    output.take("step 1\rstep 2\r\nthree\r");
    output.take("\nfour\r\rsix");
    output.finish();
    BOOST_TEST(lines == (std::vector<std::string>{"step 1", "step 2", "three", "four", "", "six"}));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(process)

namespace {

/// A shell that does this in a directory of its own.
struct Shell {
    explicit Shell(const std::string& script) {
        task.program = "/bin/sh";
        task.arguments = {"-c", script};
        task.directory = keeper.directory();
        task.line = [this](const std::string& line) { lines.push_back(line); };
        task.go_on = [] { return true; };
    }
    ProcessResult run() { return run_process(task, keeper); }

    Keeper keeper;
    ProcessTask task;
    std::vector<std::string> lines;
};

bool is_there(pid_t process) {
    return kill(process, 0) == 0 || errno != ESRCH;
}

/// Whether it is gone within some seconds: the kernel may be busy elsewhere.
bool is_gone(pid_t process) {
    for (int i = 0; i < 500 && is_there(process); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return !is_there(process);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_program_gets_its_directory_arguments_and_environment) {
    Shell shell("pwd; echo \"$0|$1|$OWN|$HOME\"; cat");
    shell.task.arguments.insert(shell.task.arguments.end(), {"a b", "$c"});
    shell.task.environment = {{"OWN", "own"}, {"HOME", "replaced"}};
    const ProcessResult result = shell.run();
    BOOST_TEST(result.failure == "");
    // No shell has seen the words, and there is nothing on standard input.
    BOOST_TEST(shell.lines == (std::vector<std::string>{shell.keeper.directory().string(),
                                                        "a b|$c|own|replaced"}));
}

BOOST_AUTO_TEST_CASE(an_ending_that_is_none_has_its_reason_and_last_lines) {
    Shell fails("echo out; echo first >&2; echo last >&2; exit 3");
    const ProcessResult exited = fails.run();
    BOOST_TEST(exited.failure == "exit 3");
    BOOST_TEST(exited.last_lines == "first | last"); // standard error before standard output
    Shell dies("echo out; kill -SEGV $$");
    const ProcessResult killed = dies.run();
    BOOST_TEST(killed.failure.starts_with("killed by signal 11"), killed.failure);
    BOOST_TEST(killed.last_lines == "out");
    Shell none("");
    none.task.program = none.keeper.directory() / "no-such-program";
    BOOST_TEST(none.run().failure.starts_with("cannot be run: No such file"));
}

/// While it lives, the signal is treated so.
class Treated {
public:
    Treated(int signal, void (*handler)(int))
        : signal_(signal), before_(std::signal(signal, handler)) {}
    ~Treated() { std::signal(signal_, before_); }
    Treated(const Treated&) = delete;
    Treated& operator=(const Treated&) = delete;
    Treated(Treated&&) = delete;
    Treated& operator=(Treated&&) = delete;

private:
    int signal_;
    void (*before_)(int);
};

BOOST_AUTO_TEST_CASE(a_program_begins_with_the_signals_of_any_other) {
    const Treated handled(SIGUSR1, [](int) {});
    const Treated closed_pipes(SIGPIPE, SIG_IGN);
    const Treated hung_up(SIGHUP, SIG_IGN); // as under nohup
    // Bits of hexadecimal numbers: SIGHUP 1, SIGUSR1 2^9, SIGPIPE 2^12.
    Shell shell("sed -n 's/^Sig\\(Blk\\|Ign\\|Cgt\\):\\s*//p' /proc/self/status");
    BOOST_TEST(shell.run().failure == "");
    BOOST_REQUIRE(shell.lines.size() == 3U);
    BOOST_TEST(std::stoull(shell.lines[0], nullptr, 16) == 0U); // blocked
    const auto ignored = std::stoull(shell.lines[1], nullptr, 16);
    BOOST_TEST((ignored & 0x1U) == 0x1U);
    BOOST_TEST((ignored & 0x1200U) == 0U);
    Shell asked("kill -USR1 $$; echo deaf");
    BOOST_TEST(asked.run().failure.starts_with("killed by signal 10"));
    // Here it is as before: no signal is blocked, and the handler is there.
    sigset_t mask;
    pthread_sigmask(SIG_SETMASK, nullptr, &mask);
    BOOST_TEST(sigismember(&mask, SIGUSR1) == 0);
    BOOST_TEST(std::raise(SIGUSR1) == 0);
}

BOOST_AUTO_TEST_CASE(an_ending_that_the_system_does_not_tell_is_a_failure) {
    // The ends of a process's own are not kept for whoever ignores them.
    const Treated deaf(SIGCHLD, SIG_IGN);
    Shell shell("sleep 0.1; exit 3");
    BOOST_TEST(shell.run().failure == "it is not known how it ended");
}

BOOST_AUTO_TEST_CASE(at_the_time_out_the_whole_group_ends_and_not_much_later) {
    // The child would go on for a minute.
    Shell shell("sleep 60 & echo $!; wait");
    shell.task.timeout = 0.15;
    const ProcessResult result = shell.run();
    BOOST_TEST(result.failure == "timed out");
    BOOST_TEST(result.seconds >= 0.15);
    BOOST_TEST(result.seconds < 0.9); // SIGTERM is enough; SIGKILL would come at 1.15 s
    BOOST_REQUIRE(shell.lines.size() == 1U);
    BOOST_TEST(is_gone(std::stoi(shell.lines[0])));
}

BOOST_AUTO_TEST_CASE(who_is_deaf_to_sigterm_is_killed) {
    Shell shell("trap '' TERM; while :; do sleep 0.05; done");
    shell.task.timeout = 0.5; // time to become deaf, on a machine that is busy
    const ProcessResult result = shell.run();
    BOOST_TEST(result.failure == "timed out");
    BOOST_TEST(result.seconds >= 1.5);
    BOOST_TEST(result.seconds < 5.0);
}

BOOST_AUTO_TEST_CASE(a_run_that_is_not_to_go_on_is_interrupted_and_no_failure) {
    Shell shell("sleep 60");
    shell.task.go_on = [] { return false; };
    const ProcessResult result = shell.run();
    BOOST_TEST(result.interrupted);
    BOOST_TEST(result.seconds < 5.0);
}

BOOST_AUTO_TEST_CASE(a_program_that_hears_the_end_of_all_and_says_so_is_interrupted) {
    for (const char* ending : {"exit 4", "kill -TERM $$"}) {
        Shell shell(std::string("echo asked; ") + ending);
        shell.task.go_on = [&] { return shell.lines.empty(); };
        BOOST_TEST(shell.run().interrupted, ending);
    }
}

BOOST_AUTO_TEST_CASE(what_a_program_leaves_behind_ends_with_it) {
    Shell shell("sleep 60 > /dev/null 2>&1 & echo $!");
    BOOST_TEST(shell.run().failure == "");
    BOOST_REQUIRE(shell.lines.size() == 1U);
    BOOST_TEST(is_gone(std::stoi(shell.lines[0])));
}

BOOST_AUTO_TEST_CASE(the_keeper_s_directory_goes_with_it) {
    fs::path directory;
    {
        const Keeper keeper;
        directory = keeper.directory();
        BOOST_TEST(fs::is_directory(directory));
        std::ofstream(directory / "a") << "b";
    }
    BOOST_TEST(!fs::exists(directory));
}

// This process stands in for one that is killed: it lets a child do that.
BOOST_AUTO_TEST_CASE(where_this_process_is_killed_the_keeper_ends_what_it_began) {
    std::array<int, 2> ends{};
    BOOST_REQUIRE(pipe(ends.data()) == 0);
    const pid_t child = fork();
    if (child == 0) {
        const Keeper keeper;
        const pid_t group = fork();
        if (group == 0) {
            setpgid(0, 0);
            keeper.begun(getpid());
            execl("/bin/sleep", "sleep", "60", nullptr);
            _exit(1);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        const std::string words = std::to_string(group) + " " + keeper.directory().string() + "\n";
        [[maybe_unused]] const auto count = write(ends[1], words.data(), words.size());
        raise(SIGKILL);
    }
    close(ends[1]);
    std::array<char, 4096> buffer{};
    const auto count = read(ends[0], buffer.data(), buffer.size());
    close(ends[0]);
    waitpid(child, nullptr, 0);
    BOOST_REQUIRE(count > 0);
    std::istringstream words(std::string(buffer.data(), static_cast<std::size_t>(count)));
    pid_t group = 0;
    std::string directory;
    words >> group >> directory;
    for (int i = 0; i < 500 && fs::exists(directory); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    BOOST_TEST(!fs::exists(directory));
    // Whoever inherits it may not have waited for it yet.
    std::string state;
    for (int i = 0; i < 500; ++i) {
        std::ifstream stat("/proc/" + std::to_string(group) + "/stat");
        std::string number, name;
        if (!(stat >> number >> name >> state) || state == "Z")
            break;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        state = "lives";
    }
    BOOST_TEST(state != "lives");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(identities)

namespace {

/// A scene beside its script, and what its last run is known by.
struct Known {
    Known() { directory.write("solve.sh", "echo L2 = 1\n"); }

    [[nodiscard]] std::string scene(const std::string& more = "",
                                    const std::string& files = "[\"solve.sh\"]") const {
        return directory.write("scene.toml", "[solver]\ncommand = [\"sh\", \"solve.sh\", "
                                             "\"{elements}\"]\nfiles = " +
                                                 files + "\nerrors = { L2 = 'L2 = (\\S+)' }\n" +
                                                 more +
                                                 "[ladder]\nelements = [2, 4]\nnorms = [\"L2\"]\n");
    }
    [[nodiscard]] std::string identity(const std::string& more = "",
                                       const std::string& files = "[\"solve.sh\"]") const {
        const Scene read = read_scene(scene(more, files));
        return RunIdentities(*read.solver).of(read.series().front(), 1);
    }

    TemporaryDirectory directory;
};

} // namespace

BOOST_AUTO_TEST_CASE(a_run_is_known_by_what_its_figures_depend_on) {
    const Known known;
    const std::string first = known.identity();
    BOOST_TEST(known.identity() == first);
    BOOST_TEST(known.identity("timeout = 10\n") == first); // which no figure depends on
    BOOST_TEST(known.identity("environment = { A = \"1\" }\n") != first);
    BOOST_TEST(known.identity("seconds = 't = (\\S+)'\n") != first);
    known.directory.write("data.in", "{elements}\n");
    const std::string with_data = known.identity("", "[\"solve.sh\", \"data.in\"]");
    BOOST_TEST(with_data != first);
    known.directory.write("data.in", "{elements} \n");
    BOOST_TEST(known.identity("", "[\"solve.sh\", \"data.in\"]") != with_data);
    setenv("PYTHONPATH", "/elsewhere", 1);
    const std::string elsewhere = known.identity();
    unsetenv("PYTHONPATH");
    BOOST_TEST(elsewhere != first);
    known.directory.write("solve.sh", "echo L2 = 2\n");
    BOOST_TEST(known.identity() != first);
}

BOOST_AUTO_TEST_CASE(a_run_is_known_by_the_files_that_its_words_name_within_them) {
    const TemporaryDirectory directory;
    std::vector<std::pair<std::string, std::string>> words; // and the file in each
    for (const std::string name : {"config.txt", "a b/c (1), d.txt"}) {
        fs::create_directories((directory.path() / name).parent_path());
        const std::string config = directory.write(name, "3\n");
        for (const std::string& word : {config, "--config=" + config, "-f" + config, "@" + config,
                                        "cat '" + config + "'; true", "a," + config + ":b"})
            words.emplace_back(name, word);
    }
    for (const auto& [name, word] : words) {
        const std::string file = directory.write(
            "scene.toml", "[solver]\ncommand = [\"sh\", \"-c\", \"" + word +
                              "\", \"{elements}\"]\nerrors = { L2 = 'L2 = (\\S+)' }\n"
                              "[ladder]\nelements = [2, 4]\nnorms = [\"L2\"]\n");
        const auto identity = [&] {
            const Scene read = read_scene(file);
            return RunIdentities(*read.solver).of(read.series().front(), 1);
        };
        directory.write(name, "3\n");
        const std::string before = identity();
        BOOST_TEST(identity() == before);
        directory.write(name, "6\n");
        BOOST_TEST(identity() != before, word);
    }
}

BOOST_AUTO_TEST_CASE(a_run_is_known_however_the_way_to_its_scene_is_written) {
    const TemporaryDirectory directory;
    const fs::path& folder = directory.path();
    fs::create_directory(folder / "scenes");
    fs::create_directory_symlink(folder / "scenes", folder / "linked");
    const std::string program = directory.write("scenes/solve.sh", "#!/bin/sh\necho L2 = 1\n");
    fs::permissions(program, fs::perms::owner_all);
    const auto identity = [&](const fs::path& scene) {
        const Scene read = read_scene(scene.string());
        return RunIdentities(*read.solver).of(read.series().front(), 1);
    };
    for (const std::string files : {"[\"solve.sh\"]", "[]"}) {
        const fs::path scene = directory.write(
            "scenes/scene.toml",
            "[solver]\ncommand = [\"./solve.sh\", \"{elements}\"]\nfiles = " + files +
                "\nerrors = { L2 = 'L2 = (\\S+)' }\n[ladder]\nelements = "
                "[2, 4]\nnorms = [\"L2\"]\n");
        const std::string known = identity(scene);
        BOOST_TEST(identity(fs::relative(scene)) == known, files);
        BOOST_TEST(identity(folder / "scenes/../scenes/./scene.toml") == known, files);
        BOOST_TEST(identity(folder / "linked/scene.toml") == known, files);
        directory.write("scenes/solve.sh", "#!/bin/sh\necho L2 = 12\n");
        BOOST_TEST(identity(scene) != known, files);
        directory.write("scenes/solve.sh", "#!/bin/sh\necho L2 = 1\n");
    }
}

BOOST_AUTO_TEST_CASE(a_run_is_known_by_all_of_a_large_file) {
    const Known known;
    std::string large((std::size_t{5} << 20U) / 2, 'x'); // 2.5 MiB
    std::set<std::string> identities;
    for (const std::size_t at : {std::size_t{0}, large.size() / 2, large.size() - 1}) {
        large[at] = 'y';
        known.directory.write("mesh.dat", large);
        identities.insert(known.identity("", "[\"solve.sh\", \"mesh.dat\"]"));
    }
    BOOST_TEST(identities.size() == 3U);
}

BOOST_AUTO_TEST_CASE(a_run_on_another_file_than_the_scene_was_read_with_fails) {
    const Known known;
    const Scene scene = read_scene(known.scene());
    known.directory.write("solve.sh", "echo L2 = 2\n");
    const StudyResult result = run_study(scene);
    for (const auto& rung : result.get<LadderResult>()->rungs) {
        BOOST_TEST((rung.status == RungStatus::failed));
        BOOST_TEST(rung.reason.starts_with("solve.sh was changed during the study"), rung.reason);
    }
    BOOST_TEST(!run_study(read_scene(known.scene())).failed());
}

BOOST_AUTO_TEST_CASE(a_file_beside_the_scene_that_no_run_would_find_is_refused_beforehand) {
    const Known known;
    const auto required = [&](const std::string& files) {
        const Scene scene = read_scene(known.scene("", files));
        require_programs(*scene.solver, scene.series());
    };
    BOOST_CHECK_NO_THROW(required("[\"solve.sh\"]"));
    BOOST_CHECK_EXCEPTION(required("[]"), InputError, [](const InputError& error) {
        const std::string what = error.what();
        return what.find("scene.toml:2:18: 'solve.sh' is a file beside the scene") !=
               std::string::npos;
    });
    // A name that is no file, "4" say, is an argument like any other.
    fs::remove(known.directory.path() / "solve.sh");
    BOOST_CHECK_NO_THROW(required("[]"));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(block)

namespace {

/// What is wrong with a block; the folder of the scene holds a few files.
std::string refusal(const std::string& block, const std::string& command = "\"true\"") {
    const TemporaryDirectory directory;
    fs::create_directory(directory.path() / "a");
    for (const char* name : {"errors.json", "errors.csv.in", "s.sh", "a.in", "a/b", "a/v.json"})
        directory.write(name, "{\"L2\": 1}\n");
    try {
        read_scene(directory.write("s.toml", "[solver]\ncommand = [" + command + "]\n" + block +
                                                 "[ladder]\nelements = [2, 4]\nnorms = ['L2']\n"));
        return "";
    } catch (const InputError& error) {
        const std::string what = error.what();
        return what.substr(what.find("s.toml"));
    }
}

const std::string pattern = "errors = { L2 = 'L2 = (\\S+)' }\n";

} // namespace

// A copy of what an earlier run wrote would pass for what a run wrote that wrote nothing.
BOOST_AUTO_TEST_CASE(a_file_that_the_program_writes_is_none_that_is_copied) {
    for (const auto& [block, wanted] : std::vector<std::pair<std::string, std::string>>{
             {"files = ['s.sh', 'errors.json']\nerrors = 'errors.json'\n",
              "s.toml:4:10: solver.errors is 'errors.json', which the program writes"},
             {"files = ['errors.json']\nerrors = './errors.json'\n", "copies 'errors.json'"},
             {"files = ['errors.csv.in']\nerrors = 'errors.csv'\n", "copies 'errors.csv'"},
             {pattern + "files = ['a/v.json']\nvalues = 'a/v.json'\n",
              "solver.values is 'a/v.json', which the program writes"},
             {"files = ['a.in']\nerrors = 'a/e.json'\n", "copies 'a'"}}) {
        const std::string message = refusal(block);
        BOOST_TEST(message.find(wanted) != std::string::npos, message);
    }
    BOOST_TEST(refusal("files = ['a/v.json']\nerrors = 'errors.json'\n") == "");
}

BOOST_AUTO_TEST_CASE(a_file_that_would_be_the_folder_of_another_is_refused) {
    for (const std::string files : {"['s.sh', 'a.in', 'a/b']", "['s.sh', 'a/b', 'a.in']"}) {
        const std::string message = refusal("files = " + files + "\n" + pattern);
        BOOST_TEST(message.starts_with("s.toml:3:"), message);
        BOOST_TEST(message.find("of which one would be a folder") != std::string::npos, message);
    }
}

// What follows it would be lost: programs get texts up to there.
BOOST_AUTO_TEST_CASE(a_character_of_code_0_is_refused) {
    for (const std::string block :
         {"parameters = { k = \"ab\\u0000cd\" }\n", "environment = { A = \"1\\u00002\" }\n",
          "files = [\"s.sh\\u0000x\"]\n"}) {
        const std::string message = refusal(pattern + block);
        BOOST_TEST(message.find("holds a character of code 0") != std::string::npos, message);
    }
    const std::string name = refusal(pattern + "environment = { \"A\\u0000B\" = \"1\" }\n");
    BOOST_TEST(name.find("is no name of a variable") != std::string::npos, name);
    const std::string word = refusal(pattern, "\"true\", \"a\\u0000b\"");
    BOOST_TEST(word.starts_with("s.toml:2:"), word);
    const std::string file = refusal("errors = \"e\\u0000.json\"\n");
    BOOST_TEST(file.find("holds a character of code 0") != std::string::npos, file);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(names)

namespace {

std::string refusal(const std::string& sources, const std::string& lists,
                    const std::string& study = "[ladder]\nelements = [2, 4]\n") {
    const TemporaryDirectory directory;
    try {
        read_scene(
            directory.write("s.toml", "[solver]\ncommand = [\"true\"]\n" + sources + study + lists),
            {}, {.expectations = true});
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

std::string list_of(const std::string& key, const std::vector<std::string>& names) {
    std::string list;
    for (const auto& name : names)
        list += (list.empty() ? "'" : ", '") + name + "'";
    return key + " = [" + list + "]\n";
}

} // namespace

// The columns of a ladder's and a grid's CSV, besides the numbers: a number by the name of
// one would be a second column of it, wherever the number is read.
BOOST_AUTO_TEST_CASE(a_number_that_would_be_a_second_column_of_its_name_is_refused) {
    std::vector<std::pair<std::string, std::vector<std::string>>> names;
    for (const std::string column :
         {"scheme", "elements", "h", "dt", "steps", "status", "seconds", "reason"})
        names.emplace_back(column, std::vector{column});
    for (const std::string ending :
         {"_order", "_printed", "_predicted", "_predicted_low", "_predicted_high"}) {
        names.emplace_back("L2" + ending, std::vector<std::string>{"L2", "L2" + ending});
        names.emplace_back("L2" + ending, std::vector<std::string>{"L2" + ending, "L2"});
    }
    for (const auto& [column, numbers] : names) {
        std::string patterns;
        for (const auto& name : numbers)
            patterns += (patterns.empty() ? "" : ", ") + name + " = '(\\S+)'";
        const std::string norms = list_of("norms", numbers);
        const std::string what = "tables have a column " + column;
        for (const auto& message :
             {refusal("errors = { " + patterns + " }\n", norms),
              refusal("errors = \"errors.json\"\n", norms),
              refusal("errors = { e = 'e (\\S+)' }\nvalues = \"values.csv\"\n",
                      "norms = ['e']\n" + list_of("values", numbers))})
            BOOST_TEST((message.find("s.toml:") != std::string::npos &&
                        message.find(what) != std::string::npos),
                       column << ": " << message);
    }
    BOOST_TEST(refusal("values = { d = '(\\S+)' }\n", "norms = ['L2']\n")
                   .ends_with("unknown norm 'L2'; [solver] names no errors"));
    // Those of times are in no ladder.
    BOOST_TEST(refusal("errors = { runs = '(\\S+)' }\n", "norms = ['runs']\n") == "");
    // Without the number that it would be said of, the ending is a part of the name.
    BOOST_TEST(refusal("errors = \"errors.json\"\n", "norms = ['L2_order', 'order', 'H1']\n") ==
               "");
}

// Each key of the table in which the number would have its own.
BOOST_AUTO_TEST_CASE(a_number_that_is_called_as_a_key_is_told_so_where_it_would_be_read) {
    const auto told = [](const std::string& message, const std::string& key) {
        BOOST_TEST(message.find(key + " is a key of its own, ") != std::string::npos,
                   key << ": " << message);
    };
    const auto errors = [](const std::string& name) {
        return "errors = { " + name + " = '(\\S+)' }\n";
    };
    const std::string gate = "[1, 3]\n";
    for (const std::string name : {"remarks", "counters", "open", "ended_by"})
        for (const std::string until : {"", "until = { order = 0.1, levels = 4 }\n"})
            told(refusal(errors(name), list_of("norms", {name}) + until + "[expect.ladder." + name +
                                           "]\norder = " + gate),
                 "expect.ladder." + name);
    for (const std::string name : {"open", "ended_by"})
        told(refusal(errors(name),
                     list_of("norms", {name}) + "until = { order = 0.1, runs = 16 }\n" +
                         "[expect.orders." + name + "]\np = " + gate,
                     "[orders]\nelements = [2, 4]\ndt = [0.5, 0.25]\n"),
             "expect.orders." + name);
    const std::string timed = "[work_precision]\n";
    const std::string scheme = "[[work_precision.scheme]]\nelements = [2, 4]\nname = ";
    told(refusal(errors("L2"),
                 list_of("norms", {"L2"}) + scheme +
                     "'sooner'\n[expect.work_precision.sooner.L2]\norders = " + gate,
                 timed),
         "expect.work_precision.sooner");
    told(refusal(errors("counters"),
                 list_of("norms", {"counters"}) + scheme +
                     "'a'\n[expect.work_precision.a.counters]\norders = " + gate,
                 timed),
         "expect.work_precision.a.counters");
    // The other key of that name is read.
    const std::string printed = list_of("norms", {"L2", "source"}) + "[ladder.printed]\n";
    const std::string both = "errors = { L2 = 'a(\\S+)', source = 'b(\\S+)' }\n";
    told(refusal(both, printed + "source = [1, 2]\n"), "ladder.printed.source");
    BOOST_TEST(refusal(both, printed + "L2 = [1, 2]\n") == "");
    BOOST_TEST(refusal(both, printed + "source = 'a table'\nL2 = [1, 2]\n") == "");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE_END()

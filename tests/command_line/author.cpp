// What the author of a solution calls: new, derive and list.

#include "tests/command_line/called_program.hpp"
#include "tests/sweep.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <sstream>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(command_line)

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
    const Called penalised = call(directory, "derive penalised-mixed --latex");
    BOOST_TEST(has(penalised.output, "\n  \\sigma &= "));
}

BOOST_AUTO_TEST_CASE(derive_answers_for_every_shipped_name) {
    const TemporaryDirectory directory;
    std::istringstream names(call(directory, "list --names").output);
    int count = 0;
    for (std::string name; std::getline(names, name); ++count) {
        if (!is_swept(static_cast<std::size_t>(count), 3))
            continue;
        const Called called = call(directory, "derive " + name);
        const bool none = has(called.errors, "to derive from");
        BOOST_TEST(called.exit == (none ? 2 : 0), name << ": " << called.errors);
        BOOST_TEST(!has(called.output, "not admissible"), name << ": " << called.output);
    }
    BOOST_TEST(count > 30);
    BOOST_TEST(
        has(call(directory, "derive stress-beam").errors, "[stress] poses problems of its own"));
}

// Algebra that orders terms by addresses has another order, and another shortest text, in every
// run.
BOOST_AUTO_TEST_CASE(derive_prints_the_same_in_every_run) {
    const TemporaryDirectory directory;
    for (const std::string name : {"mixed-pressed", "penalised-mixed", "pressed-front"}) {
        const std::string first = call(directory, "derive " + name).output;
        BOOST_TEST(has(first, "G for t >= 0"), name);
        for (int run = 0; run < 5; ++run)
            BOOST_TEST(call(directory, "derive " + name).output == first, name);
    }
}

// Each of these was another in one run of two: (x - t)^3 or -(t - x)^3, and so on.
BOOST_AUTO_TEST_CASE(sums_of_either_sign_are_one_formula_and_one_problem_in_every_run) {
    const TemporaryDirectory directory;
    const std::string linear = "theta = \"theta_A*(1 - x) + x*(1 - x)*";
    const std::string small = "\"\nu = \"1e-9*x^2*";
    const std::vector<std::string> solutions = {
        "theta = \"0\"\nu = \"1e-7*x^2*exp(x)^t\"\n",
        "theta = \"0\"\nu = \"1e-3*x^2*((2 + x*t)^t)^3\"\n",
        linear + "x*(x + pi)*(t^2*pi)^3" + small + "(exp(tanh(3)) - (t*x*(x - t))^3)\"\n",
        linear + "x/(1 + x)*sin(4*x)*(pi - t - x)" + small +
            "(cos(x) - t*cos(x))*cos((5 - 2*x)/(2 + x))\"\n",
        linear + "(exp(x)/3 - 1)^3*cos(t)" + small + "(exp(x/(1 + x)) - 1)^2*(1 + t)\"\n",
        linear + "(t/(2 + x) + t)*(x*t*(1 + x) - exp(t*x) - t)" + small +
            "(t*x^2/(2 + x))^3*cos((t/(2 + x))^2)\"\n"};
    for (const std::string& solution : solutions) {
        directory.write("mine.toml", solution);
        directory.write("scene.toml",
                        "solution = \"./mine.toml\"\n[beam]\nalpha = 0.4\nzeta = 0.15\n[ladder]\n"
                        "final_time = 0.1\nelements = [4]\ndt = [0.025]\n");
        std::set<std::string> said;
        for (int run = 0; run < 4; ++run) {
            const std::string formulas =
                call(directory, "derive " + (directory.path() / "mine.toml").string()).output;
            const std::string result =
                call(directory, "run " + (directory.path() / "scene.toml").string() + " --json -")
                    .output;
            std::istringstream lines(result);
            std::string kept;
            for (std::string line; std::getline(lines, line);)
                if (has(line, "doubles_allocated") || has(line, "_L2L2\": ") ||
                    has(line, "H2semi\": "))
                    kept += line;
            BOOST_TEST(has(kept, "doubles_allocated"), result);
            said.insert(formulas + kept);
        }
        BOOST_TEST(said.size() == 1u, solution);
    }
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
    for (const std::string name :
         {"\n  table1 ", "\n  table1-consistent ", "\n  table1-fixed-point ",
          "\n  table1-extended ", "\n  copetti-fernandez-2011 "})
        BOOST_TEST(has(called.output, name), name);
}

// A list that is kept beside the program is printed as it stands, while no file has changed and it
// is the same program's.
BOOST_AUTO_TEST_CASE(the_list_is_that_of_the_files_as_they_are) {
    namespace fs = std::filesystem;
    const TemporaryDirectory directory;
    const fs::path top = directory.path();
    const fs::path sources = fs::path(TVBEAM_SCENES).parent_path().parent_path();
    for (const char* folder : {"studies/scenes", "mms/solutions", "mms/systems"}) {
        fs::create_directories(top / folder);
        fs::copy(sources / folder, top / folder, fs::copy_options::recursive);
    }
    fs::create_directory(top / "bin");
    fs::copy_file(tvbeam_binary, top / "bin/tvbeam");
    const auto listed = [&](const std::string& arguments = "") {
        const std::string program = (top / "bin/tvbeam").string();
        return call(directory, "list > /dev/null; TVBEAM_DATA=" + top.string() + " " + program +
                                   " list " + arguments)
            .output;
    };
    const std::string now = call(directory, "list").output;
    BOOST_TEST(listed() == now);
    const std::string kept = listed("--catalogue");
    BOOST_TEST(kept.ends_with(now));
    directory.write("bin/catalogue", kept + "kept\n");
    BOOST_TEST(listed() == now + "kept\n");
    for (const std::string& foreign : {std::string("0\nkept\n"), std::string(2 << 20, 'x')}) {
        directory.write("bin/catalogue", foreign);
        BOOST_TEST(listed() == now);
    }
    directory.write("bin/catalogue", kept + "kept\n");
    fs::copy_file(top / "mms/solutions/mixed.toml", top / "mms/solutions/zz-mine.toml");
    fs::remove(top / "studies/scenes/table1.toml");
    const std::string changed = listed();
    BOOST_TEST(has(changed, "\n  zz-mine "));
    BOOST_TEST(!has(changed, "\n  table1 "));
    BOOST_TEST(!has(changed, "kept\n"));
}

BOOST_AUTO_TEST_SUITE_END()

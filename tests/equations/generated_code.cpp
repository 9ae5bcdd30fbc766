// Generated code, compiled and run, against the program that it was written from. Three systems in
// the languages whose compilers are installed; TVBEAM_ALL_SYSTEMS=1 takes every shipped one, and
// FreeFEM. Of Julia and MOOSE, which Debian does not have, the text is translated to Python.

#include "mms/equations/code.hpp"
#include "mms/equations/code_lines.hpp"
#include "mms/equations/program.hpp"
#include "mms/equations/system_checks.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include <unistd.h>

namespace data = boost::unit_test::data;
namespace fs = std::filesystem;
using namespace tvbeam;

namespace {

constexpr std::size_t point_count = 1000;

bool all_systems() {
    return std::getenv("TVBEAM_ALL_SYSTEMS") != nullptr;
}

std::vector<std::string> systems() {
    if (!all_systems())
        return {"elasticity", "compressible-navier-stokes"};
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(TVBEAM_SYSTEMS_DIR))
        names.push_back(entry.path().stem().string());
    return names;
}

bool has_program(const std::string& name) {
    return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) == 0;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
    std::string text;
    for (const auto& word : words)
        text += (text.empty() ? "" : between) + word;
    return text;
}

/// What a case consists of: the derived system, the names of its functions in the language, points.
struct Case {
    DerivedSystem derived;
    std::vector<std::string> functions;
    std::vector<DomainPoint> points;

    [[nodiscard]] std::string arguments() const { return joined(derived.system.coordinates, ", "); }
};

Case case_of(const std::string& system) {
    Case result{derive_system(
                    read_equation_system(std::string(TVBEAM_SYSTEMS_DIR) + "/" + system + ".toml")),
                {},
                {}};
    for (const auto& function : result.derived.functions)
        result.functions.push_back(function.name);
    result.points = points_inside(result.derived.system, point_count);
    return result;
}

/// A program that reads points and writes the values of all functions at each.
struct Driver {
    std::string source; ///< name of the file of the code
    std::string name;   ///< of the driver
    std::string text;
    std::string command; ///< builds it, where there is anything to build, and runs it
};

Driver in_c(const Case& one, bool is_cpp) {
    std::string text = "#include <stdio.h>\n#include \"code.h\"\nint main(void) {\n    double " +
                       one.arguments() + ";\n    while (scanf(\"";
    std::string targets;
    for (const auto& name : one.derived.system.coordinates) {
        text += "%lf ";
        targets += ", &" + name;
    }
    text +=
        "\"" + targets + ") == " + std::to_string(one.derived.system.coordinates.size()) + ") {\n";
    std::string scope = one.derived.system.name;
    std::replace(scope.begin(), scope.end(), '-', '_');
    for (const auto& function : one.functions)
        text += "        printf(\"%.17g\\n\", " + (is_cpp ? scope + "::" : "") + function + "(" +
                one.arguments() + "));\n";
    text += "    }\n    return 0;\n}\n";
    const std::string compiler =
        is_cpp ? "c++ -std=c++11 -Wall -Wextra -Werror -O1 driver.cpp -o driver"
               : "cc -std=c99 -Wall -Wextra -Werror -O1 driver.c -lm -o driver";
    return {"code.h", is_cpp ? "driver.cpp" : "driver.c", text, compiler + " && ./driver < points"};
}

Driver in_fortran(const Case& one) {
    std::string name = one.derived.system.name;
    std::replace(name.begin(), name.end(), '-', '_');
    std::string text = "program driver\n  use " + name +
                       "\n  implicit none\n  real(dp) :: " + one.arguments() +
                       "\n  do\n    read (*, *, end=1) " + one.arguments() + "\n";
    for (const auto& function : one.functions)
        text += "    write (*, '(es25.17e3)') " + function + "(" + one.arguments() + ")\n";
    text += "  end do\n1 continue\nend program\n";
    return {"code.f90", "driver.f90", text,
            "gfortran -std=f2008 -Werror -O1 code.f90 driver.f90 -o driver && ./driver < points"};
}

constexpr const char* python_loop = R"(
import sys
for line in sys.stdin:
    point = [float(word) for word in line.split()]
    for name in functions:
        print(repr(float(globals()[name](*point))))
)";

std::string quoted(const std::vector<std::string>& names) {
    return "['" + joined(names, "', '") + "']";
}

Driver in_python(const Case& one) {
    return {"code.py", "driver.py",
            "from code import *\nfunctions = " + quoted(one.functions) + python_loop,
            "PYTHONPATH=. python3 -B driver.py < points"};
}

/// UFL's functions as those of numbers.
Driver in_ufl(const Case& one) {
    return {"code.py", "driver.py",
            "import math, sys, types\nufl = types.ModuleType('ufl')\n"
            "vars(ufl).update(vars(math), ln=math.log)\nsys.modules['ufl'] = ufl\n"
            "from code import *\nfunctions = " +
                quoted(one.functions) + python_loop,
            "PYTHONPATH=. python3 -B driver.py < points"};
}

Driver in_julia(const Case& one) {
    return {"code.jl", "driver.py",
            "import re\nfrom math import *\n"
            "text = open('code.jl').read().replace('^', '**').replace('lambda', 'lambda_')\n"
            "text = re.sub(r'^const ', '', text, flags=re.M)\n"
            "text = re.sub(r'^function (.*)$', r'def \\1:', text, flags=re.M)\n"
            "exec(re.sub(r'^end$', '', text, flags=re.M))\nfunctions = " +
                quoted(one.functions) + python_loop,
            "python3 -B driver.py < points"};
}

Driver in_moose(const Case& one) {
    return {
        "code.i", "driver.py",
        "import re\nfrom math import *\nfunctions = []\n"
        "block = r\"\\[(\\w+)\\]\\s+type = ParsedFunction\\s+expression = '([^']*)'\"\n"
        "block += r\"(?:\\s+symbol_names = '([^']*)'\\s+symbol_values = '([^']*)')?\\s+\\[\\]\"\n"
        "for name, text, names, values in re.findall(block, open('code.i').read()):\n"
        "    lines = ' '.join(text.split()).replace('^', '**').replace(':=', "
        "'=').replace('lambda', 'lambda_')\n"
        "    lines, names = lines.split('; '), names.replace('lambda', 'lambda_')\n"
        "    constants = [f'{n} = {v}' for n, v in zip(names.split(), values.split())]\n"
        "    body = constants + lines[:-1] + ['return ' + lines[-1]]\n"
        "    exec(f'def {name}(" +
            one.arguments() +
            "):\\n    ' + '\\n    '.join(body))\n"
            "    functions.append(name)\n" +
            python_loop,
        "python3 -B driver.py < points"};
}

Driver in_freefem(const Case& one) {
    std::string text = "include \"code.idp\"\ncout.precision(17);\nifstream points(\"points\");\n"
                       "real " +
                       joined(one.derived.system.coordinates, "1, ") + "1;\nfor (int i = 0; i < " +
                       std::to_string(one.points.size()) + "; ++i) {\n    points >> " +
                       joined(one.derived.system.coordinates, "1 >> ") + "1;\n";
    for (auto function : one.functions) {
        function.erase(std::remove(function.begin(), function.end(), '_'), function.end());
        text += "    cout << " + function + "(" + joined(one.derived.system.coordinates, "1, ") +
                "1) << endl;\n";
    }
    return {"code.idp", "driver.edp", text + "}\n", "FreeFem++-nw -nw -v 0 driver.edp"};
}

Driver driver_of(const Case& one, CodeLanguage language) {
    switch (language) {
    case CodeLanguage::c:
        return in_c(one, false);
    case CodeLanguage::cpp:
        return in_c(one, true);
    case CodeLanguage::fortran:
        return in_fortran(one);
    case CodeLanguage::python:
        return in_python(one);
    case CodeLanguage::ufl:
        return in_ufl(one);
    case CodeLanguage::julia:
        return in_julia(one);
    case CodeLanguage::moose:
        return in_moose(one);
    case CodeLanguage::freefem:
        break;
    }
    return in_freefem(one);
}

/// A directory that is gone at the end.
class Folder {
public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "tvbeam-code-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder(Folder&&) = delete;
    Folder& operator=(const Folder&) = delete;
    Folder& operator=(Folder&&) = delete;
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name) << text;
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

std::vector<double> values_of(const Case& one, CodeLanguage language) {
    const Folder folder;
    const Driver driver = driver_of(one, language);
    std::ostringstream points;
    points << std::setprecision(17);
    for (const auto& point : one.points) {
        for (const auto& name : one.derived.system.coordinates)
            points << point.at(name) << ' ';
        points << '\n';
    }
    folder.write("points", points.str());
    folder.write(driver.source, system_code(one.derived, language));
    folder.write(driver.name, driver.text);
    const std::string command =
        "cd '" + folder.path().string() + "' && (" + driver.command + ") > values 2> said";
    if (std::system(command.c_str()) != 0) {
        std::ifstream said(folder.path() / "said");
        BOOST_ERROR(std::string(std::istreambuf_iterator<char>(said), {}));
    }
    std::vector<double> values;
    std::ifstream stream(folder.path() / "values");
    for (double value = 0.0; stream >> value;)
        values.push_back(value);
    return values;
}

const std::map<CodeLanguage, std::string>& tools() {
    using enum CodeLanguage;
    static const std::map<CodeLanguage, std::string> all = {
        {c, "cc"},        {cpp, "c++"},       {fortran, "gfortran"}, {python, "python3"},
        {ufl, "python3"}, {julia, "python3"}, {moose, "python3"},    {freefem, "FreeFem++-nw"}};
    return all;
}

} // namespace

BOOST_AUTO_TEST_SUITE(generated_code)

BOOST_DATA_TEST_CASE(code_computes_what_the_program_does,
                     data::make(systems()) * data::make(code_language_names()), system, name) {
    const CodeLanguage language = *code_language(name);
    const bool on_demand = language == CodeLanguage::freefem && !all_systems();
    if (short_tests || on_demand || !has_program(tools().at(language))) {
        BOOST_TEST_MESSAGE("skipped: " << tools().at(language));
        return;
    }
    const Case one = case_of(system);
    const std::vector<double> values = values_of(one, language);
    BOOST_REQUIRE(values.size() == one.functions.size() * one.points.size());
    for (std::size_t k = 0; k < one.functions.size(); ++k) {
        const Program program = program_of({one.derived.functions[k].formula}, one.derived.fields);
        std::vector<double> expected;
        double square = 0.0;
        for (const auto& point : one.points) {
            std::map<std::string, double> names;
            for (const auto& [word, value] : names_at(one.derived, point))
                names[word] = static_cast<double>(value);
            expected.push_back(program.evaluate(names).front());
            square += expected.back() * expected.back() / double(one.points.size());
        }
        double worst = 0.0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            worst =
                std::max(worst, std::abs(values[i * one.functions.size() + k] - expected[i]) /
                                    std::max(std::abs(expected[i]), std::sqrt(square) + 1e-300));
        BOOST_TEST(worst <= 1e-13, one.functions[k] << ": " << worst);
    }
}

// math.exp raises an error where numpy's is infinite; 1/(1 + inf) is 0 by both.
BOOST_AUTO_TEST_CASE(python_without_numpy_goes_on_beyond_the_range_of_doubles) {
    if (short_tests || !has_program("python3"))
        return;
    const auto derived = derive_system(
        parse_equation_system("[unknowns]\nu = \"1/(1 + exp(1000*(x - t))) + 1/cosh(1000*x) + "
                              "1/(sinh(1000*x) + 2)\"\n[equations]\nf = \"diff(u, t) + u\"\n",
                              "front.toml"));
    const Folder folder;
    folder.write("code.py", system_code(derived, CodeLanguage::python));
    folder.write("driver.py",
                 "import sys\nsys.modules['numpy'] = None\nfrom code import *\n"
                 "names = u_exact.__code__.co_varnames[:2]\n"
                 "at = lambda x, t: u_exact(*[{'x': x, 't': t}[name] for name in names])\n"
                 "assert at(1.0, 0.0) == 0.0\n"
                 "assert abs(at(0.0, 1.0) - 2.5) < 1e-15\n"
                 "from code import sinh\nassert sinh(-1000.0) == -float('inf')\n"
                 "assert at(float('nan'), 0.5) != at(float('nan'), 0.5)\n");
    const std::string command =
        "cd '" + folder.path().string() + "' && PYTHONPATH=. python3 -B driver.py";
    BOOST_TEST(std::system(command.c_str()) == 0);
}

BOOST_AUTO_TEST_CASE(compressible_flow_in_space_takes_less_than_300_lines_of_c) {
    const Case one = case_of("compressible-navier-stokes");
    const std::string code = system_code(one.derived, CodeLanguage::c);
    BOOST_TEST(std::count(code.begin(), code.end(), '\n') < 300);
}

BOOST_AUTO_TEST_CASE(all_sources_at_once_are_those_one_by_one) {
    if (short_tests || !has_program("cc"))
        return;
    const Case one = case_of("maxwell");
    const Folder folder;
    folder.write("code.h", system_code(one.derived, CodeLanguage::c));
    const auto sources = one.derived.of_role(DerivedFunction::Role::source);
    std::string text = "#include \"code.h\"\nint main(void) {\n    double v[" +
                       std::to_string(sources.size()) + "];\n    sources(0.1, 0.2, 0.3, 0.4, v);\n";
    for (std::size_t i = 0; i < sources.size(); ++i)
        text += "    if (fabs(v[" + std::to_string(i) + "] - " + sources[i]->name +
                "(0.1, 0.2, 0.3, 0.4)) > 1e-13)\n        return " + std::to_string(i + 1) + ";\n";
    folder.write("driver.c", text + "    return 0;\n}\n");
    const std::string command = "cd '" + folder.path().string() +
                                "' && cc -Wall -Wextra -Werror driver.c -lm -o driver && ./driver";
    BOOST_TEST(std::system(command.c_str()) == 0);
}

BOOST_AUTO_TEST_CASE(no_line_is_longer_than_a_hundred_characters) {
    const Case one = case_of("compressible-navier-stokes");
    for (const auto& name : code_language_names()) {
        std::istringstream lines(system_code(one.derived, *code_language(name)));
        for (std::string line; std::getline(lines, line);)
            BOOST_TEST(line.size() <= 100U, name << ": " << line);
    }
}

BOOST_AUTO_TEST_CASE(comments_without_blanks_end_and_lose_nothing) {
    for (const std::size_t length : {97U, 98U, 99U, 196U, 400U}) {
        const std::string formula(length, 'x');
        std::istringstream lines(wrapped_comment("f = " + formula + " + 1", "//"));
        std::string together;
        for (std::string line; std::getline(lines, line);) {
            BOOST_TEST(line.size() <= 100U, line);
            BOOST_TEST(line.starts_with("// "));
            line.erase(std::remove_if(line.begin(), line.end(),
                                      [](char c) { return c == ' ' || c == '/'; }),
                       line.end());
            together += line;
        }
        BOOST_TEST(together == "f=" + formula + "+1");
    }
}

BOOST_AUTO_TEST_CASE(comments_without_blanks_part_no_character) {
    for (const std::string character : {"é", "θ", "漢", "😀"})
        for (std::size_t before = 0; before < 4; ++before) {
            std::string text(before, 'x');
            while (text.size() < 400)
                text += character;
            std::istringstream lines(wrapped_comment(text, "//"));
            for (std::string line; std::getline(lines, line);) {
                BOOST_TEST(line.size() <= 100U, line);
                line.erase(0, line.find_first_not_of("/ x"));
                BOOST_TEST(line.size() % character.size() == 0U, line);
                BOOST_TEST(line.starts_with(character), line);
            }
        }
}

// C takes ??/ for a backslash, which joins the next line to the comment.
BOOST_AUTO_TEST_CASE(no_comment_takes_the_next_line_into_it) {
    if (short_tests || !has_program("cc"))
        return;
    const auto derived = derive_system(parse_equation_system(
        "name = \"why\?\?/\"\n[unknowns]\nu = \"sin(x)\"\n[equations]\nf = \"u\"\n", "my.toml"));
    const Folder folder;
    folder.write("code.c", system_code(derived, CodeLanguage::c));
    const std::string command =
        "cd '" + folder.path().string() + "' && cc -std=c99 -Wall -Werror -c code.c";
    BOOST_TEST(std::system(command.c_str()) == 0);
}

BOOST_AUTO_TEST_CASE(reserved_names_are_changed_also_where_they_are_used) {
    const Case one = case_of("elasticity");
    const std::string python = system_code(one.derived, CodeLanguage::python);
    BOOST_TEST(python.find("\nlambda_ = 0.6\n") != std::string::npos);
    BOOST_TEST(python.find("lambda*") == std::string::npos);
    const std::string c = system_code(one.derived, CodeLanguage::c);
    BOOST_TEST(c.find("double lambda = 0.6;") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(no_name_of_a_file_hides_what_generated_python_uses) {
    for (const std::string name : {"float", "abs", "ImportError"}) {
        const auto derived = derive_system(parse_equation_system(
            "[parameters]\n" + name + " = 2\n[unknowns]\nu = \"(exp(300*x) + sinh(300*x))*" + name +
                "\"\n[equations]\nf = \"u\"\n",
            "my.toml"));
        const std::string code = system_code(derived, CodeLanguage::python);
        BOOST_TEST(code.find("\n" + name + "_ = 2.0\n") != std::string::npos, code);
        BOOST_TEST(code.find("\n" + name + " = ") == std::string::npos, code);
        if (short_tests || !has_program("python3"))
            continue;
        const Folder folder;
        folder.write("code.py", code);
        folder.write("driver.py", "import sys\nsys.modules['numpy'] = None\nfrom code import *\n"
                                  "assert u_exact(10.0) == u_exact(20.0)\n");
        const std::string command =
            "cd '" + folder.path().string() + "' && PYTHONPATH=. python3 -B driver.py";
        BOOST_TEST(std::system(command.c_str()) == 0, name);
    }
}

BOOST_AUTO_TEST_CASE(a_negative_parameter_is_negative_in_every_language) {
    const auto derived = derive_system(parse_equation_system(
        "[parameters]\nk = -2.5\n[unknowns]\nu = \"sin(x)\"\n[equations]\nf = \"k*diff(u, x)\"\n",
        "my.toml"));
    const auto function = derived.of_role(DerivedFunction::Role::source).front();
    for (const auto& name : code_language_names()) {
        const CodeLanguage language = *code_language(name);
        for (const std::string& code :
             {system_code(derived, language), inline_code(derived, *function, language)})
            BOOST_TEST(
                (code.find("-2.5") != std::string::npos || code.find("- 2.5") != std::string::npos),
                name << code);
    }
}

// Macros, functions with their endings, and what a compiler predefines.
BOOST_AUTO_TEST_CASE(names_that_headers_take_are_changed_so_that_the_code_compiles) {
    for (const std::string name :
         {"M_PI", "NAN", "INFINITY", "linux", "unix", "typeof", "isnan", "j0f", "gammal", "FP_ZERO",
          "float_t", "M_PIl", "FD_SETSIZE", "WNOHANG", "HUGE_VAL_F32", "htole32"}) {
        const auto derived = derive_system(parse_equation_system(
            "[parameters]\n" + name + " = 2\n[unknowns]\nu = \"sin(x)\"\n[equations]\nf = \"" +
                name + "*diff(u, x)\"\n",
            "my.toml"));
        for (const CodeLanguage language : {CodeLanguage::c, CodeLanguage::cpp}) {
            const bool is_free = language == CodeLanguage::cpp &&
                                 (name == "isnan" || name == "j0f" || name == "gammal");
            BOOST_TEST((system_code(derived, language).find(name + "_ = 2.0;") !=
                        std::string::npos) == !is_free,
                       name);
        }
    }
}

// A module or a namespace is called as the file: as a function of the language, as what is in it,
// or by more letters than the language takes.
BOOST_AUTO_TEST_CASE(files_of_any_name_become_code_that_compiles) {
    if (short_tests)
        return;
    const Folder folder;
    const auto compiles = [&](CodeLanguage language, const std::string& name,
                              const std::string& ending, const std::string& command) {
        if (!has_program(tools().at(language)))
            return;
        const auto derived = derive_system(
            parse_equation_system("[parameters]\nkappa = 2\n[unknowns]\nu = \"sin(x)*t\"\n"
                                  "[equations]\nf = \"kappa*u\"\nf_module = \"diff(u, x)\"\n",
                                  name + ".toml"));
        folder.write("code" + ending, system_code(derived, language));
        const std::string line = "cd '" + folder.path().string() + "' && " + command;
        BOOST_TEST(std::system(line.c_str()) == 0, name << " in " << ending);
    };
    for (const std::string name :
         {"sin",       "Kind",   "f",         "F_module", "kappa",
          "x",         "t",      "dp",        "values",   "div",
          "exit",      "gammaf", "class",     "2d-heat",  "select",
          "sincosf32", "exp10",  "initstate", "size_t",   std::string(80, 'm').c_str()}) {
        compiles(CodeLanguage::fortran, name, ".f90", "gfortran -std=f2008 -fsyntax-only code.f90");
        compiles(CodeLanguage::cpp, name, ".cpp", "c++ -std=c++11 -Werror -fsyntax-only code.cpp");
    }
}

// Compilers of Fortran compute what consists of numbers, and refuse what is beyond the doubles.
BOOST_AUTO_TEST_CASE(fortran_of_numbers_that_overflow_on_the_way_compiles) {
    if (short_tests || !has_program("gfortran"))
        return;
    for (const std::string part :
         {"1/(1 + exp(c))", "exp(-c)", "1/(1 + exp(800))", "exp(-800)", "exp(-300*pi)",
          "1/cosh(600*sqrt(2))", "1/(1 + c*exp(c*pi))", "(-c)^n", "c^(1/3)"}) {
        const auto derived = derive_system(parse_equation_system(
            "[parameters]\nc = 800\nn = 3\n[unknowns]\nu = \"sin(x)*t + x*(" + part +
                ")\"\n[equations]\nf = \"diff(u, t) - c*diff(u, x, 2)\"\ng = \"u\"\n",
            "my.toml"));
        const Folder folder;
        folder.write("code.f90", system_code(derived, CodeLanguage::fortran));
        const std::string command = "cd '" + folder.path().string() +
                                    "' && gfortran -std=f2008 -Wall -Werror -O1 -c code.f90";
        BOOST_TEST(std::system(command.c_str()) == 0, part);
    }
}

BOOST_AUTO_TEST_CASE(what_is_used_once_is_not_named_and_what_is_zero_is_not_added) {
    const auto derived =
        derive_system(parse_equation_system("[unknowns]\nu = \"sin(x)*t\"\n[equations]\nf = "
                                            "\"diff(u, t) + diff(u, x, 2) + diff(u, y)\"\n",
                                            "my.toml"));
    const std::string code = system_code(derived, CodeLanguage::c);
    const auto begin = code.find("double f(");
    BOOST_TEST(code.substr(begin, code.find('}', begin) + 1 - begin) ==
               "double f(double x, double y, double t) {\n"
               "    (void)y;\n"
               "    const double s1 = sin(x);\n"
               "    return s1 - t*s1;\n"
               "}");
}

BOOST_AUTO_TEST_CASE(the_manual_shows_what_is_derived) {
    std::ifstream stream(TVBEAM_MANUAL);
    const std::string manual(std::istreambuf_iterator<char>(stream), {});
    const auto block = [&](const std::string& opening, std::size_t from) {
        const std::size_t begin = manual.find(opening, from) + opening.find('\n') + 1;
        return manual.substr(begin, manual.find("```", begin) - begin);
    };
    const std::size_t section = manual.find("## Equations of your own");
    BOOST_REQUIRE(section != std::string::npos);
    const auto derived =
        derive_system(parse_equation_system(block("```toml\n", section), "rod.toml"));
    BOOST_TEST(system_code(derived, CodeLanguage::c).find(block("```c\n", section)) !=
               std::string::npos);
}

// Wherever the longest line ends: behind * or a blank, within no ** and no //.
BOOST_AUTO_TEST_CASE(long_lines_of_code_part_no_operator) {
    for (const std::string power : {"**1.5*", "//3*", "*2.0*", "/y*"})
        for (std::size_t first = 1; first <= 12; ++first) {
            std::string text = "    r = " + std::string(first, 'a');
            while (text.size() < 240)
                text += power + "bcd";
            std::istringstream lines(wrapped_code(text, 8, " \\"));
            std::string whole, line;
            while (std::getline(lines, line)) {
                BOOST_TEST(line.size() <= 100U);
                const bool goes_on = line.ends_with(" \\");
                line.resize(line.size() - (goes_on ? 2 : 0));
                const char last = line.back();
                const std::string indent(8, ' ');
                if (!whole.empty())
                    line.erase(0, line.find_first_not_of(' '));
                BOOST_TEST(!(!whole.empty() && (line.front() == '*' || line.front() == '/')), line);
                BOOST_TEST((!goes_on || last == '*' || last == '/' || last == ' '), line);
                whole += line;
            }
            BOOST_TEST(whole == text);
        }
}

BOOST_AUTO_TEST_CASE(long_lines_of_nested_functions_are_broken_at_brackets) {
    std::string formula = "x";
    for (int i = 0; i < 60; ++i)
        formula = "sin(" + formula + ")";
    std::istringstream lines(wrapped_code("    r = " + formula, 8, " &"));
    std::string whole;
    for (std::string line; std::getline(lines, line);) {
        BOOST_TEST(line.size() <= 100U, line);
        line.erase(0, line.find_first_not_of(' '));
        line.resize(line.size() - (line.ends_with(" &") ? 2 : 0));
        whole += line;
    }
    BOOST_TEST(whole == "r = " + formula);
}

BOOST_AUTO_TEST_CASE(brackets_stand_where_the_order_asks_for_them) {
    const auto derived = derive_system(parse_equation_system(
        "[unknowns]\nu = \"t/((1 + x)*(2 + x))\"\n[equations]\nf = \"u\"\n", "my.toml"));
    BOOST_TEST(inline_code(derived, derived.functions.front(), CodeLanguage::c) ==
               "(t/((x + 1.0)*(x + 2.0)))");
}

BOOST_AUTO_TEST_CASE(a_number_for_templates_is_an_operand_of_its_language) {
    BOOST_TEST(inline_number(1.0, CodeLanguage::c) == "1.0");
    BOOST_TEST(inline_number(-3.0, CodeLanguage::python) == "(-3)");
    BOOST_TEST(inline_number(3.0, CodeLanguage::python) == "3"); // as of range(3)
    BOOST_TEST(inline_number(0.5, CodeLanguage::python) == "0.5");
    BOOST_TEST(inline_number(0.1, CodeLanguage::fortran) == "0.1_dp");
    BOOST_TEST(inline_number(-1e-300, CodeLanguage::fortran) == "(-1e-300_dp)");
}

BOOST_AUTO_TEST_CASE(expressions_for_templates_have_the_parameters_in_them) {
    const Case one = case_of("heat-2d");
    const auto& source = one.derived.functions.front();
    BOOST_TEST(inline_code(one.derived, source, CodeLanguage::freefem) ==
               "(2.0*(pi*pi)*sin(pi*y)*cos(t)*sin(pi*x) - sin(pi*y)*sin(t)*sin(pi*x))");
}

BOOST_AUTO_TEST_SUITE_END()

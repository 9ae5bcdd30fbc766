#include "mms/solution.hpp"
#include "mms/expression/number_expression.hpp"
#include "mms/text/nearest_name.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace data = boost::unit_test::data;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_solution)

namespace {

struct Refused {
    std::string document;
    std::string place; ///< after the file's name
    std::string message;
};

std::ostream& operator<<(std::ostream& stream, const Refused& refused) {
    return stream << refused.message;
}

const std::string good = "theta = \"sin(pi*x)\"\nu = \"x^2\"\n";

const std::vector<Refused> refused = {
    {"", "", "theta is missing"},
    {"theta = \"x\"\n", "", "u is missing"},
    {"theta = x\n", ":1:9", "not TOML"},
    {"theta = \"x\"\ntheta = \"t\"\nu = \"x\"\n", ":2:9", "not TOML"},
    {"tehta = \"x\"\nu = \"x\"\n", ":1:1", "unknown key 'tehta'; did you mean 'theta'?"},
    {good + "colour = 3\n", ":3:1", "unknown key 'colour'; known here: name"},
    {good + "until = \"1\"\n", ":3:1", "unknown key 'until'"},
    {good + "name = 3\n", ":3:8", "name is an integer; it must be a string"},
    {good + "name = \"\"\n", ":3:8", "name is empty"},
    {good + "source = [\"x\"]\n", ":3:10", "source is an array"},
    {good + "purpose = true\n", ":3:11", "purpose is a boolean"},
    {"theta = true\nu = \"x\"\n", ":1:9", "theta is a boolean; it must be an expression"},
    {"theta = [1]\nu = \"x\"\n", ":1:9", "theta is an array"},
    {"theta = 1979-05-27\nu = \"x\"\n", ":1:9", "theta is a date or time"},
    {"theta = inf\nu = \"x\"\n", ":1:9", "theta is inf; it must be a finite number"},
    // Places within strings: basic, literal, with escapes, of several lines.
    {"theta = \"\"\nu = \"x\"\n", ":1:10", "the expression is empty"},
    {"theta = \"sin(pi*y)\"\nu = \"x\"\n", ":1:17", "unknown symbol 'y'"},
    {"theta = 'sin(pi*y)'\nu = \"x\"\n", ":1:17", "unknown symbol 'y'"},
    {"  theta  =   \"x + y\"\nu = \"x\"\n", ":1:19", "unknown symbol 'y'"},
    {"theta = \"\\u0078 + y\"\nu = \"x\"\n", ":1:19", "unknown symbol 'y'"},
    {"theta = \"x\\t+ y\"\nu = \"x\"\n", ":1:15", "unknown symbol 'y'"},
    {"theta = \"\\u00e4 + y\"\nu = \"x\"\n", ":1:10", "found '\xC3\xA4'"},
    {"theta = \"\"\"\nx +\n  y\"\"\"\nu = \"x\"\n", ":3:3", "unknown symbol 'y'"},
    {"theta = '''\r\nx +\r\n  y'''\r\nu = \"x\"\r\n", ":3:3", "unknown symbol 'y'"},
    {"theta = \"\"\"x + y\"\"\"\nu = \"x\"\n", ":1:16", "unknown symbol 'y'"},
    {"theta = \"\"\"x + \\\n     y\"\"\"\nu = \"x\"\n", ":2:6", "unknown symbol 'y'"},
    {"# \xC3\xA4\xC3\xB6\xC3\xBC\nname = \"\xC3\xA4\"\ntheta = \"x + y\"\nu = \"x\"\n", ":3:14",
     "'y'"},
    // Phases.
    {good + "phase = 3\n", ":3:9", "each headed [[phase]]"},
    {good + "phase = []\n", ":3:9", "each headed [[phase]]"},
    {good + "[phase]\nuntil = 1\n", ":3:1", "each headed [[phase]]"},
    {"u = \"x\"\n[[phase]]\nuntil = 1\n[[phase]]\ntheta = \"x\"\n", ":2:1", "theta is missing"},
    {good + "[[phase]]\ntheta = \"x\"\n", ":4:1", "theta is given here and at line 1"},
    {good + "[[phase]]\nutnil = 1\n", ":4:1", "did you mean 'until'?"},
    {good + "[[phase]]\n[[phase]]\n", ":3:1", "until is missing"},
    {good + "[[phase]]\nuntil = 1\n", ":4:1",
     "the last phase holds for all later times; remove its until"},
    {good + "[[phase]]\nuntil = 0\n[[phase]]\n", ":4:9", "until is 0; it must be greater than 0"},
    {good + "[[phase]]\nuntil = \"-1\"\n[[phase]]\n", ":4:10", "until is -1; it must be greater"},
    {good + "[[phase]]\nuntil = 1\n[[phase]]\nuntil = \"1\"\n[[phase]]\n", ":6:10",
     "greater than the end of the phase before, 1"},
    {good + "[[phase]]\nuntil = \"1 + t\"\n[[phase]]\n", ":4:14", "unknown symbol 't'"},
    {good + "[[phase]]\nuntil = \"exp(1000)\"\n[[phase]]\n", ":4:10", "not a finite number"},
    {good + "[[phase]]\nuntil = true\n[[phase]]\n", ":4:9", "phase.0.until is a boolean"},
    // Parameters.
    {good + "parameters = 3\n", ":3:14", "parameters is an integer"},
    {good + "[parameters]\nalpha = 1\n", ":4:1", "hides a known name"},
    {good + "[parameters]\ng1 = -1\n", ":4:1", "it is the beam's, and stands in the scene"},
    {"[parameters]\nk = 1\ntheta = \"k*x\"\nu = \"x\"\n", ":3:1",
     "theta stands below [parameters], which makes it a parameter"},
    {good + "[parameters]\nk = 2\nsigma = \"-0.5\"\n", ":5:1",
     "sigma stands below [parameters], which makes it a parameter"},
    {"[parameters]\ntheta = \"x\"\n[[phase]]\nu = \"x^2\"\n", ":2:1",
     "theta stands below [parameters], which makes it a parameter"},
    {good + "theta_A = 1\n", ":3:1", "theta_A is the beam's; it stands in [beam] of the scene"},
    {good + "[parameters]\npi = 1\n", ":4:1", "hides a known name"},
    {good + "[parameters]\nsin = 1\n", ":4:1", "hides a known name"},
    {good + "[parameters]\na-b = 1\n", ":4:1", "is not a name"},
    {good + "[parameters]\n2k = 1\n", ":4:1", "is not a name"},
    {good + "[parameters]\nk = false\n", ":4:5", "parameters.k is a boolean"},
    {good + "[parameters]\nk = nan\n", ":4:5", "parameters.k is nan; it must be a finite number"},
    {good + "[parameters]\nk = \"1 + m\"\n", ":4:10", "unknown symbol 'm'"},
    {good + "[parameters]\nk = \"exp(1000)\"\n", ":4:6", "parameter k"},
    {good + "[parameters]\nk = \"log(0)\"\n", ":4:6", "log"},
    {"theta = \"kk2*x\"\nu = \"x\"\n[parameters]\nk2 = 1\n", ":1:10", "did you mean 'k2'?"},
};

} // namespace

BOOST_DATA_TEST_CASE(what_breaks_a_rule_is_refused_at_its_place, data::make(refused)) {
    BOOST_CHECK_EXCEPTION(parse_solution(sample.document, "my.toml"), InputError,
                          [&](const InputError& error) {
                              const std::string what = error.what();
                              const std::string place = "my.toml" + sample.place + ": ";
                              BOOST_TEST_INFO(what);
                              BOOST_TEST(what.substr(0, place.size()) == place);
                              BOOST_TEST(what.find(sample.message) != std::string::npos);
                              return true;
                          });
}

BOOST_AUTO_TEST_CASE(every_character_of_a_string_has_its_place) {
    const std::string document = "a = \"\\u00e4+\\U0001F600\\n\u00fcx\"\n";
    const std::string value = "\u00e4+\U0001F600\n\u00fcx";
    const SourceText text = SourceText::of_toml_string(value, document, {"my.toml", 1, 5});
    const auto column_of = [&](const std::string& part) {
        return text.at(value.find(part)).column;
    };
    BOOST_TEST(column_of("\u00e4") == 6);
    BOOST_TEST(column_of("+") == 12);
    BOOST_TEST(column_of("\U0001F600") == 13);
    BOOST_TEST(column_of("\n") == 23);
    BOOST_TEST(column_of("\u00fc") == 25);
    BOOST_TEST(column_of("x") == 26);
    BOOST_TEST(text.at(1000).column == 27);
    const SourceText plain("\u00e4x", {"my.toml", 7, 3});
    BOOST_TEST(plain.at(2).column == 4);
    BOOST_TEST(plain.at(3).line == 7);
}

BOOST_AUTO_TEST_CASE(top_holds_for_all_phases) {
    const Solution solution = parse_solution("name = \"n\"\nsource = \"s\"\npurpose = \"p\"\n"
                                             "theta = \"k*x\"\n"
                                             "[parameters]\nk = 2.5\nl = \"sqrt(2)\"\n"
                                             "[[phase]]\nuntil = \"l\"\nu = \"x^2\"\n"
                                             "[[phase]]\nuntil = 3\nu = \"x^3\"\nsigma = \"-t\"\n"
                                             "[[phase]]\nu = 0\nsigma = 0\n",
                                             "my.toml");
    BOOST_TEST(solution.name == "n");
    BOOST_TEST(solution.source == "s");
    BOOST_TEST(solution.purpose == "p");
    BOOST_REQUIRE(solution.parameters.size() == 2U);
    BOOST_TEST(solution.parameters[0].name == "k");
    BOOST_TEST(solution.parameters[0].value.text() == "2.5");
    BOOST_REQUIRE(solution.phases.size() == 3U);
    for (const SolutionPhase& phase : solution.phases)
        BOOST_TEST(phase.theta.text() == "k*x");
    BOOST_TEST(solution.phases[0].until->text() == "l");
    BOOST_TEST(!solution.phases[0].sigma.has_value());
    BOOST_TEST(solution.phases[1].until->text() == "3");
    BOOST_TEST(solution.phases[1].sigma->text() == "-t");
    BOOST_TEST(!solution.phases[2].until.has_value());
    BOOST_TEST(solution.phases[2].u.text() == "0");
}

BOOST_AUTO_TEST_CASE(a_solution_of_one_phase_needs_no_phase) {
    const Solution solution = parse_solution(good, "folder/my-own.toml");
    BOOST_TEST(solution.name == "my-own");
    BOOST_REQUIRE(solution.phases.size() == 1U);
    BOOST_TEST(!solution.phases[0].until.has_value());
}

BOOST_AUTO_TEST_CASE(files_that_cannot_be_read_are_named) {
    const auto names = [](const std::string& text) {
        return [text](const InputError& error) {
            return std::string(error.what()).find(text) != std::string::npos;
        };
    };
    BOOST_CHECK_EXCEPTION(read_solution("no/such.toml"), InputError,
                          names("no/such.toml: cannot be read"));
    BOOST_CHECK_EXCEPTION(read_solution(TVBEAM_SOLUTIONS_DIR), InputError, names("is a directory"));
}

BOOST_AUTO_TEST_CASE(every_shipped_solution_is_called_as_its_file_and_says_what_it_is_for) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(TVBEAM_SOLUTIONS_DIR)) {
        const Solution solution = read_solution(entry.path());
        BOOST_TEST(solution.name == entry.path().stem().string());
        BOOST_TEST(!solution.source.empty());
        BOOST_TEST(!solution.purpose.empty());
        ++count;
    }
    BOOST_TEST(count >= 5);
}

// Any bytes are a solution or an InputError. Fixed seeds.
BOOST_AUTO_TEST_CASE(any_document_is_a_solution_or_an_input_error) {
    std::mt19937 random(99);
    const auto below = [&random](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    int understood = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string document = i % 2 == 0 ? good + "[[phase]]\nuntil = 1\n[[phase]]\nsigma = '0'\n"
                                          : refused[below(refused.size())].document;
        for (std::size_t count = 1 + below(4); count > 0; --count) {
            const std::size_t at = below(document.size() + 1);
            if (below(2) == 0)
                document.insert(at, 1, "\"'[]=.\n\\ue#0x"[below(13)]);
            else
                document.erase(at, 1);
        }
        try {
            parse_solution(document, "my.toml");
            ++understood;
        } catch (const InputError&) {
            // Expected of most.
        }
    }
    BOOST_TEST(understood > 20);
}

BOOST_AUTO_TEST_CASE(nearest_names_are_near) {
    const std::vector<std::string> known = {"alpha", "zeta", "theta_A", "stops", "x", "t"};
    BOOST_TEST(nearest_name("alhpa", known) == "alpha");
    BOOST_TEST(nearest_name("Zeta", known) == "zeta");
    BOOST_TEST(nearest_name("thetaA", known) == "theta_A");
    BOOST_TEST(nearest_name("stop", known) == "stops");
    BOOST_TEST(nearest_name("y", known).empty());
    BOOST_TEST(nearest_name("thetxyz", known).empty());
    BOOST_TEST(nearest_name("frequency", known).empty());
    BOOST_TEST(nearest_name("", known).empty());
    BOOST_TEST(nearest_name(std::string(100000, 'a'), known).empty());
}

BOOST_AUTO_TEST_CASE(number_expressions_have_values_or_places) {
    const auto value = [](const std::string& text, double s) {
        return number_from_expression(SourceText(text, {"scene.toml", 4, 7}), {{"s", s}});
    };
    BOOST_TEST(value("0.01/s", 40.0) == 0.00025);
    BOOST_TEST(value("1/(3*s)", 0.1) == 1.0 / 0.3, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(value("sqrt(2)", 1.0) == std::sqrt(2.0));
    const auto at = [](const std::string& place) {
        return [place](const InputError& error) {
            BOOST_TEST_INFO(error.what());
            BOOST_TEST(std::string(error.what()).substr(0, place.size()) == place);
            return true;
        };
    };
    BOOST_CHECK_EXCEPTION(value("0.01/h", 1.0), InputError, at("scene.toml:4:12: unknown symbol"));
    BOOST_CHECK_EXCEPTION(value("1/s", 0.0), InputError, at("scene.toml:4:7: division by zero"));
    BOOST_CHECK_EXCEPTION(value("exp(s)", 1000.0), InputError, at("scene.toml:4:7: "));
    for (const double s : {std::numeric_limits<double>::infinity(), std::nan("")})
        BOOST_CHECK_EXCEPTION(value("1/s", s), InputError, at("scene.toml:4:7: s is not finite"));
}

BOOST_AUTO_TEST_SUITE_END()

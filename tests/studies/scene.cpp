// Reading scenes: what is right is read, what is wrong is told at its place.

#include "studies/scene/scene.hpp"
#include "mms/text/input_error.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <limits>
#include <ostream>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(scenes)

namespace {

const std::string good = R"(title    = "a test"
solution = "copetti-fernandez-2011"

[beam]
alpha = 0.017
zeta  = 0.1
stops = [-0.02, 0.1]

[scheme]
algorithm    = "direct"
thermal_mass = "lumped"

[ladder]
final_time = 2.0
elements   = [10, 20]
dt         = [1e-3, 5e-4]
norms      = ["theta_L2L2_sq", "u_LinfH2semi"]

[ladder.printed]
source        = "somewhere"
theta_L2L2_sq = [1.0, 2.0]
)";

/// A scene that is wrong in one place: `from` replaced by `to`, and what the message must then say.
struct Wrong {
    std::string from;
    std::string to;
    std::string place; ///< line:column, or empty: the message names the file only
    std::string message;
};

std::ostream& operator<<(std::ostream& stream, const Wrong& wrong) {
    return stream << wrong.to;
}

const std::vector<Wrong> wrong_scenes{
    // Keys
    {"zeta  = 0.1", "zeta  = 0.1\nalhpa = 1", "7:1",
     "unknown key 'beam.alhpa'; did you mean 'alpha'?"},
    {"zeta  = 0.1", "zeta  = 0.1\ncontact = { law = \"penalty\" }",
     "7:", "beam.contact.epsilon is missing; it must be > 0"},
    {"zeta  = 0.1", "zeta  = 0.1\ncontact = { epsilon = 1e-3 }",
     "7:", "beam.contact.epsilon belongs to law = \"penalty\""},
    {"[ladder]", "[mesh]\ngrading = 0\n\n[ladder]", "14:11", "mesh.grading is 0; it must be > 0"},
    {"[ladder]", "[mesh]\nnodes = [0, 0.5, 0.4, 1]\n\n[ladder]", "14:9",
     "mesh.nodes must begin with 0, end with 1 and increase"},
    {"[ladder]", "[mesh]\ngrading = 2\nnodes = [0, 1]\n\n[ladder]", "15:9",
     "the block has both mesh.grading and mesh.nodes; remove one"},
    {"[ladder]", "[mesh]\nnodes = [0, 0.1, 0.2, 1]\n\n[ladder]", "13:1",
     "mesh.nodes has 3 intervals, and a run has 10 elements"},
    {"title ", "titel ", "1:1", "unknown key 'titel'; did you mean 'title'?"},
    {"[ladder.printed]", "[ladder.prnted]",
     "19:", "unknown block [ladder.prnted]; did you mean [ladder.printed]?"},
    {"theta_L2L2_sq = [1.0", "theta_L2L3_sq = [1.0", "21:1",
     "unknown key 'ladder.printed.theta_L2L3_sq'; did you mean 'theta_L2L2_sq'?"},
    // Types
    {"alpha = 0.017", "alpha = \"0.017\"", "5:9", "beam.alpha is a string; it must be a number"},
    {"title    = \"a test\"", "title    = 3", "1:12", "title is an integer; it must be a string"},
    {"elements   = [10, 20]", "elements   = [10, 20.5]", "15:19",
     "ladder.elements holds a number; it must hold integers"},
    {"[beam]", "[[beam]]", "4:", "beam is an array; it must be a table"},
    {"alpha = 0.017", "alpha = nan", "5:9", "beam.alpha is nan; it must be a finite number"},
    {"alpha = 0.017", "alpha = inf", "5:9", "beam.alpha is inf; it must be a finite number"},
    // Rules of the beam
    {"zeta  = 0.1", "zeta  = -0.1", "6:9", "beam.zeta is -0.1; it must be >= 0"},
    {"alpha = 0.017", "alpha = -1", "5:9", "beam.alpha is -1; it must be >= 0"},
    {"zeta  = 0.1\n", "", "", "beam.zeta is missing"},
    {"[-0.02, 0.1]", "[0.1, -0.02]", "7:9",
     "beam.stops is [0.1, -0.02]; g1 must be below g2: are they swapped?"},
    {"[-0.02, 0.1]", "[0.02, 0.1]", "7:10", "g1, the first of beam.stops, is 0.02; it must be < 0"},
    {"[-0.02, 0.1]", "[0, 0.1]", "7:10", "g1, the first of beam.stops, is 0; it must be < 0"},
    {"[-0.02, 0.1]", "[-0.02, -0.01]", "7:17",
     "g2, the second of beam.stops, is -0.01; it must be > 0"},
    {"[-0.02, 0.1]", "[-0.02]", "7:9", "beam.stops has 1 values; it must be [g1, g2]"},
    // The scheme
    {"\"direct\"", "\"driect\"", "10:16",
     "scheme.algorithm is 'driect'; it must be one of 'direct', 'fixed-point'; did you mean "
     "'direct'?"},
    {"\"lumped\"", "\"lumped\"\ntolerance = 1e-7", "12:13",
     "scheme.tolerance belongs to algorithm = \"fixed-point\""},
    {"\"direct\"", "\"fixed-point\"\ntolerance = 0", "11:13",
     "scheme.tolerance is 0; it must be > 0"},
    // The ladder
    {"dt         = [1e-3, 5e-4]", "dt         = [1e-3, 3e-4]", "16:21",
     "ladder.dt is 0.0003; it must divide final_time = 2 into a whole number of steps"},
    {"dt         = [1e-3, 5e-4]", "dt         = [1e-3]", "16:14",
     "ladder.dt has 1 values, ladder.elements has 2"},
    {"dt         = [1e-3, 5e-4]", "dt         = [1e-3, 0]", "16:21",
     "ladder.dt is 0; it must be > 0"},
    {"dt         = [1e-3, 5e-4]", "dt         = [1e-3, 1e-30]", "16:21",
     "at most 1e12 are possible"},
    {"dt         = [1e-3, 5e-4]", "dt         = [3, 5e-4]", "16:15",
     "ladder.dt is 3; it must divide"},
    {"dt         = [1e-3, 5e-4]", "dt         = \"0.01/q\"", "16:20", "unknown symbol 'q'"},
    {"dt         = [1e-3, 5e-4]", "dt         = \"0.01/(s\"", "16:20", "'(' is never closed"},
    {"dt         = [1e-3, 5e-4]\n", "", "", "ladder.dt is missing"},
    {"elements   = [10, 20]", "elements   = []", "15:14",
     "ladder.elements is empty; it must hold a number of elements"},
    {"elements   = [10, 20]", "elements   = [10, 0]", "15:19",
     "ladder.elements holds 0; a mesh has 1 to 10000000 elements"},
    {"elements   = [10, 20]", "elements   = [1000000000000, 20]", "15:15",
     "ladder.elements holds 1000000000000;"},
    {"final_time = 2.0", "final_time = 0", "14:14", "ladder.final_time is 0; it must be > 0"},
    {"\"u_LinfH2semi\"", "\"u_LinfH2sem\"", "17:32",
     "unknown norm 'u_LinfH2sem'; did you mean 'u_LinfH2semi'?"},
    {"\"u_LinfH2semi\"", "\"theta_L2L2_sq\"", "17:32", "names 'theta_L2L2_sq' twice"},
    {"[1.0, 2.0]", "[1.0]", "21:17", "ladder.printed.theta_L2L2_sq has 1 value for 2 levels"},
    {"elements   = [10, 20]", "elements   = [20, 10]", "15:19",
     "ladder.elements: level 2 is coarser"},
    {"dt         = [1e-3, 5e-4]", "dt         = [5e-4, 1e-3]", "16:21",
     "is coarser than the one before it"},
    // The problem
    {"copetti-fernandez-2011", "copetti-fernandez-2012", "2:12",
     "there is no shipped solution 'copetti-fernandez-2012'; did you mean "
     "'copetti-fernandez-2011'?"},
    {"copetti-fernandez-2011", "./missing.toml", "2:12", "there is no solution file"},
    {"solution = \"copetti-fernandez-2011\"\n", "", "", "neither a solution nor a [data] block"},
    {"[beam]", "[data]\ntheta0 = \"0\"\n[beam]", "", "both a solution and a [data] block"},
    // TOML
    {"[scheme]", "[scheme", "9:", "not TOML"},
    {"alpha = 0.017", "alpha = 0.017\nalpha = 1", "6:", "not TOML"},
};

std::string message_of(const std::string& file, const std::vector<std::string>& overrides = {}) {
    try {
        const Scene scene = read_scene(file, overrides);
        if (scene.get<LadderBlock>() && !scene.solver)
            problem_of(scene, scene.get<LadderBlock>()->final_time);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

BOOST_AUTO_TEST_CASE(a_scene_is_read_as_written) {
    const TemporaryDirectory directory;
    const Scene scene = read_scene(directory.write("my.toml", good));
    BOOST_TEST(scene.name == "my");
    BOOST_TEST(scene.title == "a test");
    BOOST_TEST(scene.beam.alpha == 0.017);
    BOOST_TEST(scene.beam.zeta == 0.1);
    BOOST_TEST(scene.beam.theta_A == 0.0);
    BOOST_TEST(scene.beam.stops.lower == -0.02);
    BOOST_TEST(scene.beam.stops.upper == 0.1);
    BOOST_TEST((scene.scheme.algorithm == Algorithm::direct));
    BOOST_TEST((scene.scheme.thermal_mass == ThermalMass::lumped));
    BOOST_REQUIRE(scene.get<LadderBlock>());
    BOOST_REQUIRE(scene.get<LadderBlock>()->rungs.size() == 2);
    BOOST_TEST(scene.get<LadderBlock>()->rungs[1].elements == 20);
    BOOST_TEST(scene.get<LadderBlock>()->rungs[1].steps == 4000);
    BOOST_TEST(scene.get<LadderBlock>()->rungs[1].dt == 5e-4);
    BOOST_TEST(scene.get<LadderBlock>()->norms[1].name == "u_LinfH2semi");
    BOOST_TEST(scene.get<LadderBlock>()->printed->figures.at("theta_L2L2_sq")[1] == 2.0);
}

// U+1D6FC, which UTF-16 writes in two parts.
BOOST_AUTO_TEST_CASE(a_letter_beyond_16_bits_stands_in_the_json_of_a_scene) {
    const TemporaryDirectory directory;
    const auto file = directory.write(
        "s.toml", "title = '\xF0\x9D\x9B\xBC'\nsolution = 'free-oscillation'\n[beam]\nalpha = 0.3\n"
                  "zeta = 0.05\nstops = [-0.1, 0.1]\n[ladder]\nfinal_time = 1.0\nelements = [5]\n"
                  "dt = [0.1]\nnorms = ['theta_L2L2']\n");
    BOOST_TEST(read_scene(file).json().find("\xF0\x9D\x9B\xBC") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_may_be_absent_has_its_default) {
    const TemporaryDirectory directory;
    const Scene scene = read_scene(directory.write("bare.toml", R"toml(solution = "free-oscillation"
[beam]
alpha = 0
zeta = 0
[ladder]
final_time = 1
elements = [3, 7]
dt = "1/(10*s)"
)toml"));
    BOOST_TEST(scene.title == "bare");
    BOOST_TEST(!scene.beam.stops.exist());
    BOOST_TEST((scene.scheme.thermal_mass == ThermalMass::consistent));
    BOOST_TEST(scene.get<LadderBlock>()->rungs[1].steps == 70);
    BOOST_TEST(scene.get<LadderBlock>()->norms.empty());
}

BOOST_AUTO_TEST_CASE(one_sided_stops_are_written_with_infinity) {
    const TemporaryDirectory directory;
    std::string text = good;
    text.replace(text.find("[-0.02, 0.1]"), 12, "[-inf, 0.1]");
    const Scene scene = read_scene(directory.write("one.toml", text));
    BOOST_TEST(scene.beam.stops.lower == -std::numeric_limits<double>::infinity());
    BOOST_TEST(scene.beam.stops.exist());
}

BOOST_DATA_TEST_CASE(a_wrong_scene_is_told_at_its_place, data::make(wrong_scenes), wrong) {
    const TemporaryDirectory directory;
    std::string text = good;
    const auto at = text.find(wrong.from);
    BOOST_REQUIRE(at != std::string::npos);
    text.replace(at, wrong.from.size(), wrong.to);
    const std::string file = directory.write("wrong.toml", text);
    const std::string message = message_of(file);
    const std::string place = file + ":" + (wrong.place.empty() ? "" : wrong.place);
    BOOST_TEST(message.starts_with(place), message << " must start with " << place);
    BOOST_TEST(message.find(wrong.message) != std::string::npos,
               message << " must say " << wrong.message);
    BOOST_TEST(message.find('\n') == std::string::npos, "one line: " << message);
}

BOOST_AUTO_TEST_CASE(a_solution_that_does_not_hold_on_the_beam_names_its_equation) {
    const TemporaryDirectory directory;
    const auto scene_with = [&](const std::string& solution) {
        directory.write("mine.toml", solution);
        std::string text = good;
        text.replace(text.find("copetti-fernandez-2011"), 22, "./mine.toml");
        return directory.write("scene.toml", text);
    };
    const auto says = [&](const std::string& solution, const std::string& part) {
        const std::string message = message_of(scene_with(solution));
        BOOST_TEST(message.find("mine.toml:") != std::string::npos, message);
        BOOST_TEST(message.find(part) != std::string::npos, message << " must say " << part);
    };
    says("theta = 'sin(pi*x)'\nu = 'x/100'", "(5)");
    says("theta = 'sin(pi*x)'\nu = 'x^2'", "(6)");
    says("theta = 'sin(pi*x)'\nu = 'x^2/100'\nsigma = '1'", "(7)");
    says("theta = 'cos(pi*x)'\nu = '0*x'", "(10)");
    says("theta = 'foo(x)'\nu = '0'", "foo");
    says("theta = 'sin(x, 2)'\nu = '0'", "sin");
    says("theta = 'sin(pi*x'\nu = '0'", "mine.toml:1:");
    says("theta = 'exp(exp(1000*t))*sin(pi*x)'\nu = '0'", "mine.toml:1:");
}

BOOST_AUTO_TEST_CASE(overrides_replace_and_add_keys) {
    const TemporaryDirectory directory;
    const std::string file = directory.write("my.toml", good);
    const Scene scene =
        read_scene(file, {"beam.alpha=1e3", "ladder.elements=[5]", "ladder.dt=\"0.01/s\"",
                          "scheme.thermal_mass=consistent", "beam.theta_A=0.5", "beam.alpha=2",
                          "ladder.printed.theta_L2L2_sq=[1]"});
    BOOST_TEST(scene.beam.alpha == 2.0); // the last one counts
    BOOST_TEST(scene.beam.theta_A == 0.5);
    BOOST_TEST(scene.get<LadderBlock>()->rungs.size() == 1);
    BOOST_TEST((scene.scheme.thermal_mass == ThermalMass::consistent));
}

// Published figures stand beside errors of another problem only with a word of it.
BOOST_AUTO_TEST_CASE(published_figures_of_another_problem_are_said_to_be) {
    const TemporaryDirectory directory;
    const std::string file = directory.write("my.toml", good);
    const auto remarks = [&](const std::vector<std::string>& overrides) {
        return run_study(read_scene(file, overrides)).remarks;
    };
    BOOST_TEST(remarks({}).empty());
    BOOST_TEST(remarks({"scheme.time=bdf2", "title=beam"}).empty());
    BOOST_TEST(remarks({"beam.alpha=0.02", "ladder.printed.theta_L2L2_sq=[1, 2]"}).empty());
    for (const std::string own : {"beam.alpha=0.02", "ladder.dt=[0.1, 0.05]"}) {
        const auto said = remarks({"scheme.time=bdf2", own});
        BOOST_REQUIRE(said.size() == 1U);
        BOOST_TEST(said.front() ==
                   "The published figures are of the scene without --set " + own + ".");
    }
}

BOOST_AUTO_TEST_CASE(a_part_of_a_key_in_quotes_may_hold_dots) {
    const TemporaryDirectory directory;
    const std::string file = directory.write(
        "my.toml",
        good + "[evolution]\nfinal_time = 1\nelements = 4\ndt = 0.5\nprobes = ['u@1']\n");
    for (const std::string key : {"expect.evolution.\"u@1.last\"", "expect.evolution.'u@1.last'"})
        BOOST_TEST(
            read_scene(file, {key + "=[0, 1]"}, {.expectations = true}).expectations.size() == 1U);
    BOOST_TEST(message_of(file, {"'beam.zeta'=1"}).find("unknown key 'beam.zeta'") !=
               std::string::npos);
    BOOST_TEST(message_of(file, {"beam.'a = b'=1"}).find("unknown key 'beam.a = b'") !=
               std::string::npos);
    BOOST_TEST(message_of(file, {"beam.'alpha=1"}).find("an override reads key=value") !=
               std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_wrong_override_is_told_with_its_text) {
    const TemporaryDirectory directory;
    const std::string file = directory.write("my.toml", good);
    const auto says = [&](const std::string& override_text, const std::string& part) {
        const std::string message = message_of(file, {override_text});
        BOOST_TEST(message.starts_with("--set " + override_text + ": "), message);
        BOOST_TEST(message.find(part) != std::string::npos, message << " must say " << part);
    };
    says("beam.zeta=-1", "beam.zeta is -1; it must be >= 0");
    says("beam.zeta", "an override reads key=value");
    says("=1", "an override reads key=value");
    says("beam.alpha=-1e400", "is beyond what a double holds");
    says("beam.=1", "ends in a dot");
    says("beam..alpha=1", "the key has an empty part");
    says(".beam=1", "the key has an empty part");
    // A bare word is a text; a number or a list that is not TOML is none.
    says("beam.alpha=99999999999999999999", "is not representable in 64 bits");
    says("beam.alpha=.5", "not TOML");
    says("ladder.elements=[99999999999999999999]", "is not representable in 64 bits");
    says("ladder.elements=[4, 8", "not TOML");
    says("title.x=1", "'title' is a string, not a table");
    says("beam.zata=1", "unknown key 'beam.zata'; did you mean 'zeta'?");
    says("ladder.dt=0.1/q", "q");
}

// Which files there are to be written, the caller knows; who does not say takes any.
BOOST_AUTO_TEST_CASE(a_report_may_name_the_files_that_the_caller_knows_or_any) {
    const TemporaryDirectory directory;
    const std::string file = directory.write("my.toml", good + "\n[report]\nfiles = [\"json\"]\n");
    BOOST_TEST(read_scene(file).report.names("json"));
    BOOST_TEST(read_scene(file, {}, {.report_files = {"csv", "json"}}).report.names("json"));
    BOOST_CHECK_EXCEPTION(read_scene(file, {}, {.report_files = {"csv"}}), InputError,
                          [](const InputError& error) {
                              return std::string(error.what())
                                  .ends_with("report.files names 'json'; known are 'csv'");
                          });
}

BOOST_AUTO_TEST_CASE(a_missing_scene_is_told_with_the_nearest_name) {
    BOOST_TEST(message_of("tabel1").find("did you mean 'table1'?") != std::string::npos);
    BOOST_TEST(message_of("/nowhere/at/all.toml").find("/nowhere/at/all.toml") !=
               std::string::npos);
    BOOST_TEST(message_of("/").find("directory") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(every_shipped_scene_is_read_and_its_problem_is_admissible) {
    BOOST_TEST(shipped_files(Shipped::scene).size() >= 4);
    for (const auto& file : shipped_files(Shipped::scene))
        BOOST_TEST(message_of(file.name) == "accepted");
}

BOOST_AUTO_TEST_SUITE_END()

// What a newcomer does: mistakes, each with its message; keys and completion; sweeps and
// comparisons.

#include "tests/command_line/called_program.hpp"
#include "tests/temporary_directory.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(newcomer)

namespace {

/// A change of the files that `tvbeam new mine` writes, the call that follows, and what it says.
struct Mistake {
    std::string from; ///< a regular expression
    std::string to;
    std::string arguments;
    std::string said;
};

std::ostream& operator<<(std::ostream& stream, const Mistake& mistake) {
    return stream << mistake.to << " " << mistake.arguments;
}

const std::string run = "run mine-scene.toml";
const std::string theta = "\ntheta = \"cos\\(t\\)\\*sin\\(pi\\*x\\)\"";

/// A call from within the directory.
Called call_in(const TemporaryDirectory& directory, const std::string& arguments) {
    return call(directory, arguments, "cd '" + directory.path().string() + "'; ");
}

std::vector<Mistake> mistakes() {
    std::vector<Mistake> all = {
        {"\\[ladder\\]", "[laddder]", run, "unknown block [laddder]; did you mean [ladder]?"},
        {"elements   =", "element =", run,
         "unknown key 'ladder.element'; did you mean 'elements'?"},
        {"", "", run + " --set alpha=1", "did you mean 'beam.alpha'?"},
        {"dt         = \"0.64/s\\^2\"", "dt = 0.01", run, "ladder.dt is one number"},
        {"\\[expect.ladder.theta_L2L2\\]", "[expect.ladder.theta_LinfL2]", "check mine-scene.toml",
         "what the study does not measure"},
        {"\\[expect.ladder.theta_L2L2\\]\norders", "[expect.orders.theta_L2L2]\np",
         "check mine-scene.toml", "it has no block [orders]"},
        {"", "", "run table1 --jsn",
         "'--jsn' is not an option of tvbeam run; did you mean '--json'?"},
        {"", "", "rnu table1", "'rnu' is not a command; did you mean 'run'?"},
        {"", "", "run tabel1", "did you mean 'table1'?"},
        {"", "", "", "a command is missing"},
        {"", "", "run table1 table2", "'table2' is one word too many for tvbeam run"},
        {"", "", "check .", "'.' is a directory; name a scene"},
        {"", "", "check mine.toml", "is a solution, not a scene"},
        {"", "", "check x.csv", "a table of errors is analysed by tvbeam analyse x.csv"},
        {"", "", "check mine-scene.toml --baseline b.json --tolerance -1", "--tolerance: -1 is no"},
        {"", "", "check mine-scene.toml --baseline b.json --tolerance nan",
         "--tolerance: nan is no"},
        {"", "", "compare a.json b.json --tolerance -1", "--tolerance: -1 is no"},
        {"", "", "compare a.json b.json --tolerance nan", "--tolerance: nan is no"},
        {"", "", "keys nonsense", "no key of a scene has to do with 'nonsense'"},
        {"stops = \\[-0.1, 0.1\\]", "stops = [0.1, -0.1]", run, "are they swapped?"},
        // Beyond the stop by less than six digits show.
        {"stops = \\[-0.1, 0.1\\]", "stops = [-0.1, 0.01682941]", run,
         "u(1,t) is 0.01682942 at t = 1; it must be at most g2"},
    };
    // Reads every shipped scene.
    if (!short_tests)
        all.push_back({"", "", "list --features nonsense", "no feature is called 'nonsense'"});
    for (const auto& [formula, said] :
         {std::pair{"\"ln(1 + t)*sin(pi*x)\"", "the natural logarithm is log"},
          {"\"e^(-t)*sin(pi*x)\"", "e^y is written exp(y)"},
          {"\"t²*sin(pi*x)\"", "a square is written ^2"},
          {"\"t*sin(π*x)\"", "it is written pi"},
          {"\"t*sin^2(pi*x)\"", "its power behind them: sin(…)^2"},
          {"\"3,14*t*sin(pi*x)\"", "a decimal number is written with a point"},
          {"\"abs(t - 1)*sin(pi*x)\"", "is given in phases"},
          {"\"max(t, 1)*sin(pi*x)\"", "is given in phases"},
          {"\"heaviside(t - 1)*sin(pi*x)\"", "is given in phases"},
          {"\"2t*sin(pi*x)\"", "a product needs '*'"},
          {"\"t**2*sin(pi*x)\"", "a power is written with '^'"},
          {"cos(t)*sin(pi*x)", "a text or an expression stands in quotes"}})
        all.push_back({theta, std::string("\ntheta = ") + formula, run, said});
    return all;
}

} // namespace

BOOST_DATA_TEST_CASE(a_mistake_has_a_message_that_says_what_to_do, data::make(mistakes())) {
    const TemporaryDirectory directory;
    BOOST_REQUIRE(call_in(directory, "new mine").exit == 0);
    std::ofstream(directory.path() / "x.csv") << "h,error\n0.1,1\n";
    bool changed = sample.from.empty();
    for (const std::string file : {"mine.toml", "mine-scene.toml"}) {
        if (sample.from.empty())
            break;
        const std::string before = directory.read(file);
        const std::string after = std::regex_replace(before, std::regex(sample.from), sample.to);
        changed = changed || after != before;
        std::ofstream(directory.path() / file) << after;
    }
    BOOST_REQUIRE(changed);
    const Called called = call_in(directory, sample.arguments);
    BOOST_TEST(called.exit == 2);
    BOOST_TEST(called.errors.starts_with("tvbeam: "), called.errors);
    BOOST_TEST(std::count(called.errors.begin(), called.errors.end(), '\n') == 1, called.errors);
    BOOST_TEST(called.errors.find(sample.said) != std::string::npos, called.errors);
}

BOOST_AUTO_TEST_CASE(what_says_nothing_is_said) {
    const TemporaryDirectory directory;
    const std::string beam = "solution = './s.toml'\n[beam]\nalpha = 1\nzeta = 1\n[ladder]\n"
                             "final_time = 1\ndt = '1/s'\nnorms = ['theta_L2L2']\n";
    std::ofstream(directory.path() / "s.toml") << "theta = '0'\nu = '0'\n";
    std::ofstream(directory.path() / "zero.toml") << beam << "elements = [4, 8]\n";
    BOOST_TEST(has(call_in(directory, "run zero.toml").output, "Every error is zero"));
    std::ofstream(directory.path() / "twice.toml") << beam << "elements = [4, 4, 8]\n";
    BOOST_TEST(
        has(call_in(directory, "run twice.toml").output, "s = 4, dt = 0.25 stands there twice"));
}

// One that holds another scene keeps it.
BOOST_AUTO_TEST_CASE(a_baseline_is_recorded_into_what_is_there) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "b.json").string();
    const Called first = call(directory, "check sheared --short --record " + file);
    BOOST_TEST(has(first.output, " numbers of sheared in "), first.output);
    BOOST_TEST(call(directory, "check free-decay --short --record " + file).exit == 0);
    const auto scenes = nlohmann::json::parse(directory.read("b.json")).at("scenes");
    BOOST_TEST(scenes.contains("sheared"));
    BOOST_TEST(scenes.contains("free-decay"));
    std::ofstream(directory.path() / "b.json") << "mine\n";
    BOOST_TEST(call(directory, "check sheared --short --record " + file).exit == 2);
    BOOST_TEST(directory.read("b.json") == "mine\n");
}

BOOST_AUTO_TEST_CASE(a_sweep_gives_a_row_a_value) {
    const TemporaryDirectory directory;
    const std::string out = (directory.path() / "out").string();
    const Called called = call(directory, "run sheared --set "
                                          "beam.zeta=0.1,1,10 --out " +
                                              out);
    BOOST_TEST(called.exit == 0, called.errors);
    std::istringstream rows(directory.read("out/sweep.csv"));
    std::vector<std::string> first;
    for (std::string row; std::getline(rows, row);)
        first.push_back(row.substr(0, row.find(',')));
    BOOST_TEST((first == std::vector<std::string>{"beam.zeta", "0.1", "1", "10"}));
    // Each row is what the scene gives with that value.
    const auto one = nlohmann::json::parse(directory.read("out/1/result.json"));
    BOOST_TEST(one.at("scene").at("beam").at("zeta") == 1);
    BOOST_TEST(std::filesystem::exists(directory.path() / "out" / "plots" / "sweep.svg"));
    BOOST_TEST(call(directory, "run sheared --set beam.zeta=1,2 --set beam.alpha=1,2").exit == 2);
}

BOOST_AUTO_TEST_CASE(texts_are_swept_as_texts_and_recorded_so_that_they_can_be_given_again) {
    const TemporaryDirectory directory;
    const std::string run =
        "run " + directory.write("scene.toml",
                                 "[solver]\ncommand = [\"echo\", \"e = 1 {elements} {k}\"]\n"
                                 "parameters = {k = \"a\"}\nerrors = {e = '^e = (\\S+)'}\n"
                                 "[ladder]\nelements = [4, 8]\nnorms = [\"e\"]\n");
    const std::string out = (directory.path() / "out").string();
    const std::string values = R"("1.500","inf","a,b",b)";
    const Called called =
        call(directory, run + " --quiet --set 'solver.parameters.k=" + values + "' --out " + out);
    BOOST_TEST(called.exit == 0, called.errors);
    const auto sweep = nlohmann::json::parse(directory.read("out/result.json"));
    std::vector<std::string> found;
    for (const auto& row : sweep.at("rows"))
        found.push_back(row.at("value"));
    BOOST_TEST((found == std::vector<std::string>{"1.500", "inf", "a,b", "b"}));
    BOOST_TEST(sweep.at("provenance").at("overrides").at(0) == "solver.parameters.k=" + values);
    const auto first = nlohmann::json::parse(directory.read("out/1-of-4/result.json"));
    BOOST_TEST(first.at("scene").at("solver").at("parameters").at("k") == "1.500");
}

// Defects are called as somebody likes: as what a row has of its own, or as a norm of the ladder.
BOOST_AUTO_TEST_CASE(no_name_of_a_defect_takes_the_place_of_another_figure_of_a_sweep) {
    const TemporaryDirectory directory;
    std::string defects;
    for (const std::string name : {"value", "failed", "theta_L2L2"})
        defects += " --set 'sensitivity.defect." + name + ".moment_load=\"zeta*u_xxt\"'";
    const Called called =
        call(directory,
             "run table1-sensitivity --quiet --set ladder.elements=[10,20] --set "
             "'expect.ladder={u_LinfH2semi={orders=[1.95,2.08]}}' --set sensitivity.range=[1e-2,1] "
             "--set sensitivity.defect={}" +
                 defects + " --set beam.zeta=0.1,0.1001 --json -");
    BOOST_TEST(called.exit == 0, called.errors);
    const auto row = nlohmann::json::parse(called.output).at("rows").at(0);
    BOOST_TEST(row.at("value") == 0.1);
    BOOST_TEST(!row.contains("failed"));
    BOOST_TEST(row.at("theta_L2L2").at("error").is_number());
    for (const std::string name : {"value", "failed", "theta_L2L2"})
        BOOST_TEST(row.at("sensitivity").contains(name), name);
}

// Another sweep, or a run, in the same directory: what was written for the values goes, what
// somebody has put there stays.
BOOST_AUTO_TEST_CASE(what_an_earlier_sweep_has_left_goes_and_what_is_not_ours_stays) {
    const TemporaryDirectory directory;
    namespace fs = std::filesystem;
    const fs::path out = directory.path() / "out";
    const std::string run = "run sheared --quiet --out " + out.string();
    BOOST_TEST(call(directory, run + " --set beam.zeta=0.1,1,10").exit == 0);
    directory.write("out/1/mine.txt", "mine");
    fs::copy(out / "10", out / "11", fs::copy_options::recursive);
    BOOST_TEST(call(directory, run + " --set beam.zeta=10,100").exit == 0);
    BOOST_TEST(!fs::exists(out / "0.1"));
    BOOST_TEST((fs::exists(out / "10" / "result.json") && fs::exists(out / "100" / "table.md")));
    BOOST_TEST(directory.read("out/1/mine.txt") == "mine");
    BOOST_TEST(!fs::exists(out / "1" / "result.json"));
    fs::rename(out / "100", directory.path() / "moved"); // and what a link leads to
    fs::create_directory_symlink("../moved", out / "100");
    BOOST_TEST(call(directory, run).exit == 0);
    BOOST_TEST(fs::exists(directory.path() / "moved" / "result.json"));
    for (const std::string gone : {"10", "sweep.csv", "plots/sweep.svg"})
        BOOST_TEST(!fs::exists(out / gone), gone);
    for (const std::string kept : {"11/result.json", "1/mine.txt", "result.json", "ladder.csv"})
        BOOST_TEST(fs::exists(out / kept), kept);
}

// Values that are names of what the sweep writes, or of other directories.
BOOST_AUTO_TEST_CASE(a_row_of_a_sweep_stays_within_the_directory_that_is_named) {
    const TemporaryDirectory directory;
    directory.write("scene.toml", "[solver]\ncommand = [\"echo\", \"e = 1 {elements} {c}\"]\n"
                                  "parameters = {c = 1}\nerrors = {e = '^e = (\\S+)'}\n"
                                  "[ladder]\nelements = [4, 8]\nnorms = [\"e\"]\n");
    std::filesystem::create_directory(directory.path() / "beside");
    directory.write("beside/table.md", "mine");
    const Called called = call(
        directory, "run " + (directory.path() / "scene.toml").string() +
                       " --set solver.parameters.c=..,.,plots,result.json,5-of-6,1 --quiet --out " +
                       (directory.path() / "beside" / "out").string());
    BOOST_TEST(called.exit == 0, called.errors);
    BOOST_TEST(directory.read("beside/table.md") == "mine");
    BOOST_TEST(!std::filesystem::exists(directory.path() / "beside" / "result.json"));
    for (const std::string row : {"1-of-6", "2-of-6", "3-of-6", "4-of-6", "5-of-6", "1"})
        BOOST_TEST(
            std::filesystem::exists(directory.path() / "beside" / "out" / row / "result.json"),
            row);
}

// At α = 1e200 every run fails; the norm that a row has not got was not asked for.
BOOST_AUTO_TEST_CASE(a_row_of_a_sweep_has_nothing_of_what_it_was_not_asked_for) {
    const TemporaryDirectory directory;
    const std::string run =
        "run table1 --set ladder.printed={} --set ladder.elements=[4,8] --set "
        "ladder.dt=[0.1,0.05] --set 'ladder.norms=[\"theta_L2L2\"],[\"u_L2H2\"]' --json " +
        (directory.path() / "sweep.json").string();
    const Called called = call(directory, run);
    BOOST_TEST(called.exit == 0, called.errors);
    BOOST_TEST(!has(called.output, "failed"), called.output);
    const auto rows = nlohmann::json::parse(directory.read("sweep.json")).at("rows");
    BOOST_TEST(rows.at(0).at("theta_L2L2").at("error").is_number());
    BOOST_TEST(!rows.at(0).contains("u_L2H2"));
    BOOST_TEST(!rows.at(1).contains("theta_L2L2"));
    BOOST_TEST(rows.at(1).at("u_L2H2").at("error").is_number());
    BOOST_TEST(has(call(directory, run + " --set beam.alpha=1e200").output, "failed"));
    const auto failed = nlohmann::json::parse(directory.read("sweep.json")).at("rows");
    BOOST_TEST(failed.at(0).at("theta_L2L2").at("error").is_null());
    BOOST_TEST(!failed.at(0).contains("u_L2H2"));
}

// e = 1/s² after k s seconds by the program's own clock: at s = 10 0.01 after 10 k, and 0.02,
// halfway from s = 5 in ln e, after √(5 · 10) k.
BOOST_AUTO_TEST_CASE(a_sweep_of_times_has_those_of_the_finest_row_and_to_the_targets) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("race.toml", R"([solver]
command    = ["awk", 'BEGIN { n = {elements}; print "e = " 1/(n*n); print "s = " {k}*n }']
errors     = { e = 'e = (.*)' }
seconds    = 's = (.*)'
parameters = { k = 1 }
[work_precision]
norms   = ["e"]
runs    = 2
targets = { e = [0.02] }
[[work_precision.scheme]]
name     = 'a,"b'
elements = [5, 10]
)");
    const Called called =
        call(directory, "run " + scene + " --set solver.parameters.k=0.01,0.02 --csv - --json " +
                            (directory.path() / "sweep.json").string());
    BOOST_TEST(called.exit == 0, called.errors);
    BOOST_TEST(called.output.starts_with(
                   "solver.parameters.k,\"work_precision.a,\"\"b e\",\"work_precision.a,\"\"b "
                   "seconds\",\"seconds to e = 0.02 a,\"\"b\"\n0.01,0.01,0.1,0.0707"),
               called.output);
    const auto rows = nlohmann::json::parse(directory.read("sweep.json")).at("rows");
    BOOST_REQUIRE(rows.size() == 2U);
    for (const auto& row : rows) {
        const double k = row.at("value");
        BOOST_TEST(row.at("work_precision.a,\"b").at("e") == 0.01);
        BOOST_TEST(row.at("work_precision.a,\"b").at("seconds") == 10.0 * k);
        BOOST_TEST(row.at("seconds to e = 0.02").at("a,\"b").get<double>() == std::sqrt(50.0) * k,
                   boost::test_tools::tolerance(1e-12));
    }
    const Called shown =
        call(directory, "run " + scene + " --set solver.parameters.k=0.01,0.02 </dev/null");
    BOOST_TEST(has(shown.output, "1.0000e-2"), shown.output);
    BOOST_TEST(has(shown.output, "0.2000"), shown.output);
}

// Errors alone, as in the tables of the ladder and the grid: an order of rounding is none.
BOOST_AUTO_TEST_CASE(a_sweep_has_no_orders_of_rounding) {
    const TemporaryDirectory directory;
    const Called called = call(directory, "run nothing-heated --set beam.zeta=0.2,0.3 --quiet "
                                          "--csv -");
    std::istringstream lines(called.output);
    std::string heads;
    std::getline(lines, heads);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream columns(heads);
        std::istringstream cells(line);
        std::string head;
        for (std::string cell; std::getline(columns, head, ',');) {
            cell.clear();
            std::getline(cells, cell, ',');
            const bool is_order = head.ends_with("ord.") || head.find("(fit)") != std::string::npos;
            BOOST_TEST(cell.empty() == (is_order || head == "failed"), head + ": " + cell);
        }
    }
}

// α = 1e200 is beyond what a step can be solved with; the other row is there all the same.
BOOST_AUTO_TEST_CASE(a_row_of_a_sweep_that_failed_says_why) {
    const TemporaryDirectory directory;
    const std::string json = (directory.path() / "sweep.json").string();
    const Called called =
        call(directory, "run table1 --set ladder.printed={} --set ladder.elements=[4,8] --set "
                        "ladder.dt=[0.1,0.05] --set beam.alpha=0.017,1e200 --json " +
                            json);
    BOOST_TEST(called.exit == 3);
    const auto sweep = nlohmann::json::parse(directory.read("sweep.json"));
    BOOST_REQUIRE(sweep.at("rows").size() == 2U);
    BOOST_TEST(sweep.at("rows")[0].at("value") == 0.017);
    BOOST_TEST(!sweep.at("rows")[0].contains("failed"));
    BOOST_TEST(has(sweep.at("rows")[1].at("failed"), "beyond the range"));
    BOOST_TEST(sweep.at("provenance").contains("commit"));
    BOOST_TEST(sweep.at("interrupted") == false);
    const Called csv =
        call(directory, "run table1 --set ladder.printed={} --set ladder.elements=[4,8] --set "
                        "ladder.dt=[0.1,0.05] --set beam.alpha=0.017,1e200 --quiet --csv -");
    BOOST_TEST(has(csv.output, ",failed\n0.017,"), csv.output);
    BOOST_TEST(has(csv.output, ",\n1e200,"), csv.output);
    BOOST_TEST(has(csv.output, "beyond the range"), csv.output);
    // Words may be quoted as in the file.
    const Called quoted =
        call(directory, "run sheared --quiet --set 'scheme.time=\"euler\",\"bdf2\"'"
                        " --csv -");
    BOOST_TEST(quoted.exit == 0, quoted.errors);
    BOOST_TEST(has(quoted.output, "\nbdf2,"), quoted.output);
}

BOOST_AUTO_TEST_CASE(lists_and_texts_are_swept_too) {
    const TemporaryDirectory directory;
    const std::string out = (directory.path() / "out").string();
    const std::string sheared = "run sheared --quiet --out " + out + " --set ";
    const Called lists = call(directory, sheared + "'beam.stops=[-0.02,0.1],[-1.0, 1.0]' --csv -");
    BOOST_TEST(lists.exit == 0, lists.errors);
    BOOST_TEST(has(lists.output, "\n\"[-0.02,0.1]\","), lists.output);
    const auto second = nlohmann::json::parse(directory.read("out/2-of-2/result.json"));
    BOOST_TEST(second.at("scene").at("beam").at("stops") == nlohmann::json({-1.0, 1.0}));
    // One list is one value.
    const Called one = call(directory, sheared + "'beam.stops=[-1.0,1.0]'");
    BOOST_TEST(one.exit == 0, one.errors);
    BOOST_TEST(nlohmann::json::parse(directory.read("out/result.json")).at("schema") ==
               "tvbeam-result/1");
    const Called check = call(directory, "check sheared --set beam.alpha=1,2");
    BOOST_TEST(check.exit == 2);
    BOOST_TEST(has(check.errors, "beam.alpha: has several values"), check.errors);
}

BOOST_AUTO_TEST_CASE(a_comparison_says_what_differs_and_by_how_much) {
    const TemporaryDirectory directory;
    for (const std::string alpha : {"1", "2"})
        call(directory, "run sheared --quiet --set beam.alpha=" + alpha + " --json " +
                            (directory.path() / (alpha + ".json")).string());
    const std::string files = (directory.path() / "1.json").string() + " ";
    const Called same = call(directory, "compare " + files + files);
    BOOST_TEST(same.exit == 0);
    BOOST_TEST(has(same.output, " 0 differ"), same.output);
    const Called other =
        call(directory, "compare " + files + (directory.path() / "2.json").string());
    BOOST_TEST(other.exit == 1);
    BOOST_TEST(has(other.output, "beam.alpha: 1 against 2, by a part of 0.50"), other.output);
    BOOST_TEST(call(directory, "compare " + files + "/dev/null").exit == 2);
    for (const std::string schema : {"tvbeam-baseline/1", "tvbeam-result/2"}) {
        const Called none =
            call(directory, "compare " + files +
                                directory.write("no.json", R"({"schema": ")" + schema + "\"}"));
        BOOST_TEST(none.exit == 2, schema);
        BOOST_TEST(has(none.errors, "no.json: is not a result of tvbeam"), none.errors);
    }
    // Rows of a sweep are found by their values, in any order.
    const std::string row = R"({"schema":"tvbeam-sweep/1","rows":[{"value":1,"e":)";
    const std::string a = directory.write("a.json", row + "1.0},{\"value\":2,\"e\":5}]}");
    const std::string b = directory.write(
        "b.json",
        R"({"schema":"tvbeam-sweep/1","rows":[{"value":2,"e":5},{"value":1,"e":1.001}]})");
    BOOST_TEST(call(directory, "compare " + a + " " + b + " --tolerance 1e-2").exit == 0);
    const Called apart = call(directory, "compare " + a + " " + b + " --tolerance 1e-4");
    BOOST_TEST(apart.exit == 1);
    BOOST_TEST(has(apart.output, "same in both to a part of 0.0001, 1 differ"), apart.output);
    BOOST_TEST(call(directory, "compare " + a + " " + b + " --tolerance -1").exit == 2);
    // Numbers of a solver that are called as what a result says of itself.
    const auto named = [&](const std::string& name, const std::string& error) {
        return directory.write(error + ".json",
                               R"({"schema":"tvbeam-result/1","provenance":{"date":")" + error +
                                   R"("},"scene":{"solver":{"parameters":{"seconds":)" + error +
                                   R"(}}},"ladder":{"rungs":[{"seconds":)" + error +
                                   R"(,"errors":{")" + name + "\":" + error + "}}]}}");
    };
    for (const std::string name : {"schema", "provenance"}) {
        const Called differs =
            call(directory, "compare " + named(name, "1") + " " + named(name, "1000"));
        BOOST_TEST(differs.exit == 1, name);
        BOOST_TEST(has(differs.output, "ladder.rungs 1.errors." + name), differs.output);
        BOOST_TEST(has(differs.output, "solver.parameters.seconds: 1 against 1000"),
                   differs.output);
        BOOST_TEST(has(differs.output, "1 differ"), differs.output); // and not the seconds
    }
}

// Which of two schemes is sooner, and by how much, is another number in every run.
BOOST_AUTO_TEST_CASE(a_comparison_leaves_out_what_follows_from_run_times) {
    const TemporaryDirectory directory;
    const auto race = [&](const std::string& ratio, const std::string& error) {
        return directory.write(
            ratio + error + ".json",
            R"({"schema":"tvbeam-result/1","work_precision":{"time_to_reach":{"L2":[{"error":)" +
                error + R"(,"seconds":{"A":)" + ratio +
                R"(},"comparisons":[{"faster":"A","ratio":)" + ratio +
                R"(}]}]},"remarks":["The machine was busy: the runs had )" + ratio +
                R"( % of a core.","A: L2 differs from run to run by up to )" + error + R"("]}})");
    };
    BOOST_TEST(call(directory, "compare " + race("2", "0.1") + " " + race("3", "0.1")).exit == 0);
    const Called other = call(directory, "compare " + race("2", "0.1") + " " + race("3", "0.2"));
    BOOST_TEST(other.exit == 1);
    BOOST_TEST(has(other.output, "2 differ"), other.output);
}

// Every shipped scene is one of the schema, and a misspelt key is none.
BOOST_AUTO_TEST_CASE(the_schema_of_scenes_holds_for_those_that_are_shipped) {
    const TemporaryDirectory directory;
    std::ofstream(directory.path() / "schema.json") << call(directory, "keys --as schema").output;
    std::ofstream(directory.path() / "check.py") << R"(import json, sys, tomllib, jsonschema
scheme = json.load(open(sys.argv[1]))
jsonschema.Draft202012Validator.check_schema(scheme)
validator = jsonschema.Draft202012Validator(scheme)
for name in sys.argv[2:]:
    scene = tomllib.load(open(name, 'rb'))
    assert validator.is_valid(scene), (name, [e.message for e in validator.iter_errors(scene)][:1])
    scene['ladder'] = {'elemnts': [4]}
    assert not validator.is_valid(scene), name
)";
    const std::string command = "python3 -W ignore " + (directory.path() / "check.py").string() +
                                " " + (directory.path() / "schema.json").string() +
                                " " TVBEAM_SCENES "/*.toml";
    BOOST_TEST(std::system(command.c_str()) == 0);
}

// bash itself is asked, with names that hold blanks.
BOOST_AUTO_TEST_CASE(bash_completes_names_keys_and_files) {
    const TemporaryDirectory directory;
    std::ofstream(directory.path() / "completion") << call(directory, "completion bash").output;
    std::ofstream(directory.path() / "my scene.toml") << "";
    const auto completed = [&](const std::string& words) {
        std::ofstream(directory.path() / "ask.sh")
            << "tvbeam() { " << tvbeam_binary << " \"$@\"; }\ncompopt() { :; }\ncd '"
            << directory.path().string() << "'\nsource ./completion\nCOMP_WORDS=(" << words
            << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_tvbeam\nprintf '%s\\n' "
               "\"${COMPREPLY[@]}\" > answers\n";
        BOOST_TEST(std::system(("bash " + (directory.path() / "ask.sh").string()).c_str()) == 0);
        return directory.read("answers");
    };
    BOOST_TEST(completed("tvbeam ru") == "run\n");
    BOOST_TEST(has(completed("tvbeam run table1-b"), "table1-bdf2\n"));
    // A solution, which run refuses.
    BOOST_TEST(!has(completed("tvbeam run copetti"), "copetti-fernandez-2011"));
    BOOST_TEST(has(completed("tvbeam derive copetti"), "copetti-fernandez-2011"));
    BOOST_TEST(completed("tvbeam run table1 --set beam.al") == "beam.alpha=\n");
    BOOST_TEST(has(completed("tvbeam check my"), "my scene.toml\n"));
    BOOST_TEST(has(completed("tvbeam check --jun"), "--junit\n"));
}

BOOST_AUTO_TEST_CASE(what_is_listed_can_be_printed) {
    const TemporaryDirectory directory;
    const Called list = call(directory, "list");
    BOOST_TEST(has(list.output, "\nStiff and extreme\n"), list.output);
    BOOST_TEST(call(directory, "list table1").output.starts_with("#"));
    BOOST_TEST(call(directory, "list tabel1").exit == 2);
}

// As they were recorded, by the target `record`: types, defaults and meanings.
BOOST_AUTO_TEST_CASE(what_is_said_of_keys_is_what_was_recorded) {
    const TemporaryDirectory directory;
    std::istringstream said(call(directory, "keys").output);
    std::ifstream recorded(TVBEAM_KEYS);
    int lines = 0;
    std::string now;
    for (std::string before; std::getline(recorded, before); ++lines) {
        BOOST_REQUIRE(std::getline(said, now));
        BOOST_REQUIRE(now == before);
    }
    BOOST_TEST(!std::getline(said, now), now);
    BOOST_TEST(lines > 600);
}

BOOST_AUTO_TEST_SUITE_END()

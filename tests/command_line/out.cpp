// `tvbeam run --out DIR`: which files there are, that they are whole, and that others can read
// them.

#include "tests/command_line/called_program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <utility>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(out_directory)

namespace {

/// A ladder of two rungs and a grid, in some ten milliseconds.
const std::string small = "run table1 --set 'ladder.elements=[4,8]' --set 'ladder.dt=[0.1,0.05]' "
                          "--set 'ladder.printed={}' --set 'orders.elements=[4,8,16]' --set "
                          "'orders.dt=[0.1,0.05,0.025]' ";

/// The list as TOML has it in the shell's single quotes.
std::string files(std::string list) {
    std::replace(list.begin(), list.end(), '\'', '"');
    return "--set 'report.files=[" + list + "]' ";
}

std::string out(const TemporaryDirectory& directory) {
    return "--out " + (directory.path() / "r").string() + " ";
}

/// Every file below the directory r, by its path within it.
std::set<std::string> written(const TemporaryDirectory& directory) {
    std::set<std::string> names;
    const auto root = directory.path() / "r";
    if (std::filesystem::exists(root))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
            if (!entry.is_directory())
                names.insert(std::filesystem::relative(entry.path(), root).string());
    return names;
}

bool installed(const std::string& command) {
    if (std::system((command + " >/dev/null 2>&1").c_str()) == 0)
        return true;
    BOOST_TEST_MESSAGE("skipped: not installed: " << command);
    return false;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

} // namespace

BOOST_AUTO_TEST_CASE(without_a_block_every_kind_of_file_is_written) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + out(directory));
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(called.errors.empty(), called.errors);
    BOOST_TEST(has(called.output, "theta_L2L2_sq")); // the table is printed all the same
    std::set<std::string> expected{"result.json", "ladder.csv", "orders.csv",
                                   "table.md",    "table.tex",  "report.html"};
    for (const std::string name :
         {"convergence", "error_surface_theta_L2L2", "error_surface_u_LinfH2semi"})
        for (const std::string ending : {".gp", ".dat", ".svg", ".png", ".pdf"})
            expected.insert("plots/" + name + ending);
    BOOST_TEST(written(directory) == expected, boost::test_tools::per_element());
    BOOST_TEST(directory.read("r/plots/convergence.png").starts_with("\x89PNG"));
    BOOST_TEST(has(directory.read("r/plots/convergence.svg"), "</svg>"));
}

BOOST_AUTO_TEST_CASE(the_block_says_what_is_written_and_nothing_else_is) {
    const TemporaryDirectory directory;
    BOOST_TEST(call(directory, small + files("'json'") + out(directory)).exit == 0);
    BOOST_TEST(written(directory) == std::set<std::string>{"result.json"});
    // A page has its figures within it; files that are not asked for are left as they are.
    directory.write("r/result.json", "an earlier one");
    BOOST_TEST(call(directory, small + files("'html'") + out(directory)).exit == 0);
    BOOST_TEST(written(directory) == (std::set<std::string>{"result.json", "report.html"}));
    BOOST_TEST(directory.read("r/result.json") == "an earlier one");
    BOOST_TEST(count(directory.read("r/report.html"), "<svg") == 3u);
    // Without --out the block does nothing.
    BOOST_TEST(
        call(directory, small + files("'csv'"), "cd " + directory.path().string() + " && ").exit ==
        0);
    BOOST_TEST(directory.count() == 1u);
}

BOOST_AUTO_TEST_CASE(figures_for_latex_are_written_where_they_are_asked_for_and_without_gnuplot) {
    const TemporaryDirectory directory;
    const Called called =
        call(directory, small + files("'pgfplots'") + out(directory), "PATH=/nowhere ");
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(called.errors.empty(), called.errors);
    BOOST_TEST(
        written(directory) ==
            (std::set<std::string>{"plots/convergence.tex", "plots/error_surface_theta_L2L2.tex",
                                   "plots/error_surface_u_LinfH2semi.tex"}),
        boost::test_tools::per_element());
    // Those of an earlier result go.
    directory.write("r/plots/mine.tex", "\\section{Mine}");
    BOOST_TEST(call(directory, "run fixed-point-limits --set stress.contraction.elements=4 " +
                                   files("'pgfplots'") + out(directory))
                   .exit == 0);
    BOOST_TEST(written(directory) ==
                   (std::set<std::string>{"plots/contraction.tex", "plots/mine.tex"}),
               boost::test_tools::per_element());
    // And also where none are asked for: a paper would go on to show the old ones.
    BOOST_TEST(call(directory, small + files("'json'") + out(directory)).exit == 0);
    BOOST_TEST(written(directory) == (std::set<std::string>{"plots/mine.tex", "result.json"}),
               boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(what_another_scene_has_left_goes_and_what_is_not_ours_stays) {
    const TemporaryDirectory directory;
    BOOST_TEST(call(directory,
                    "run fixed-point-limits --set stress.contraction.elements=4 " + out(directory))
                   .exit == 0);
    BOOST_TEST(written(directory).contains("contraction.csv"));
    BOOST_TEST(written(directory).contains("plots/contraction.svg"));
    directory.write("r/stress.csv", "who,felt\nme,fine\n");
    directory.write("r/plots/mine.gp", "plot x\n");
    directory.write("r/plots/mine.svg", "<svg/>");
    BOOST_TEST(call(directory, small + out(directory)).exit == 0);
    const auto names = written(directory);
    for (const std::string gone :
         {"contraction.csv", "plots/contraction.svg", "plots/contraction.png",
          "plots/contraction.pdf", "plots/contraction.dat"})
        BOOST_TEST(!names.contains(gone), gone);
    for (const std::string kept : {"stress.csv", "plots/mine.gp", "plots/mine.svg", "ladder.csv"})
        BOOST_TEST(names.contains(kept), kept);
}

BOOST_AUTO_TEST_CASE(a_block_that_names_what_is_not_known_is_refused) {
    const TemporaryDirectory directory;
    for (const auto& [block, message] :
         {std::pair<std::string, std::string>{"'markdwn'", "did you mean 'markdown'?"},
          {"'json','json'", "names 'json' twice"},
          {"", "report.files is empty"},
          {"1", "must hold strings"}}) {
        const Called called = call(directory, small + files(block) + out(directory));
        BOOST_TEST(called.exit == 2);
        BOOST_TEST(has(called.errors, message), called.errors);
        BOOST_TEST(directory.count() == 0u);
    }
    const Called called = call(directory, small + "--set report.flies=[] " + out(directory));
    BOOST_TEST(has(called.errors, "did you mean 'files'"), called.errors);
}

BOOST_AUTO_TEST_CASE(bad_input_leaves_no_directory_behind) {
    const TemporaryDirectory directory;
    // Found only when the problem is made: the tip passes the stop.
    const std::string solution =
        directory.write("passes.toml", "theta = 'sin(pi*x)'\nu = 'x^2*t'\n");
    const Called called = call(directory, small + "--set solution=" + solution + " --out " +
                                              (directory.path() / "a/b/c").string());
    BOOST_TEST(called.exit == 2);
    BOOST_TEST(has(called.errors, "(6)"), called.errors);
    BOOST_TEST(directory.count() == 1u);
}

BOOST_AUTO_TEST_CASE(a_directory_that_cannot_be_written_is_said_before_anything_runs) {
    const TemporaryDirectory directory;
    const std::string file = directory.write("file", "mine");
    directory.write("other", "");
    for (const std::string& place : {file, file + "/within", std::string("/proc/tvbeam")}) {
        const Called called = call(directory, small + "--out " + place);
        BOOST_TEST(called.exit == 2, place);
        BOOST_TEST(called.output.empty());
        BOOST_TEST(count(called.errors, "\n") == 1u, called.errors);
        BOOST_TEST(has(called.errors, "'" + place.substr(0, 8)), called.errors);
    }
    BOOST_TEST(directory.read("file") == "mine");
    // A directory where a file is to be.
    std::filesystem::create_directories(directory.path() / "r/table.md");
    const Called called = call(directory, small + out(directory));
    BOOST_TEST(called.exit == 2);
    BOOST_TEST(called.output.empty());
}

BOOST_AUTO_TEST_CASE(a_full_disk_is_one_error_and_earlier_results_stay) {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "r");
    directory.write("r/ladder.csv", "earlier");
    directory.write("r/table.md", "earlier");
    // Files of at most 2 KiB: the CSV, which is written first, is smaller, the table is not.
    const Called called = call(directory, small + files("'csv','markdown'") + out(directory),
                               "trap '' XFSZ; ulimit -f 4; ");
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(count(called.errors, "\n") == 1u, called.errors);
    BOOST_TEST(has(called.errors, "cannot write"), called.errors);
    BOOST_TEST(directory.read("r/ladder.csv") == "earlier");
    BOOST_TEST(directory.read("r/table.md") == "earlier");
    BOOST_TEST(written(directory) ==
               (std::set<std::string>{"ladder.csv", "table.md", "unfinished.jsonl"}));
}

BOOST_AUTO_TEST_CASE(without_gnuplot_scripts_and_data_are_written_and_a_sentence_says_so) {
    const TemporaryDirectory directory;
    const Called called =
        call(directory, small + files("'plots','html'") + out(directory), "PATH=/nowhere ");
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(count(called.errors, "\n") == 1u, called.errors);
    BOOST_TEST(has(called.errors, "gnuplot is not installed"), called.errors);
    const auto names = written(directory);
    BOOST_TEST(names.contains("plots/convergence.gp"));
    BOOST_TEST(names.contains("plots/convergence.dat"));
    BOOST_TEST(!names.contains("plots/convergence.svg"));
    BOOST_TEST(has(directory.read("r/report.html"), "gnuplot is not installed"));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_drawn_has_no_figure) {
    const TemporaryDirectory directory;
    const auto solver = [&](const std::string& name, const std::string& program) {
        return directory.write(name, "[solver]\n"
                                     "command = [\"awk\", \"BEGIN {{ " +
                                         program +
                                         " }}\"]\n"
                                         "errors  = { L2 = 'error (\\S+)' }\n"
                                         "values  = { v = 'value (\\S+)' }\n"
                                         "[ladder]\nelements = [4, 8, 16, 32]\n"
                                         "norms = ['L2']\nvalues = ['v']\n");
    };
    // Next to the greatest double an axis has no room for its ends.
    const std::string great =
        solver("great.toml", R"(print \"value 1.7{elements}e308\"; print \"error 1e-320\")");
    for (const auto& [scene, exit] : {std::pair{great, 0}, {solver("failing.toml", "exit 1"), 3}}) {
        const Called called =
            call(directory, "run " + scene + " " + files("'plots'") + out(directory));
        BOOST_TEST(called.exit == exit, called.errors);
        BOOST_TEST(!has(called.errors, "gnuplot"), called.errors);
        BOOST_TEST(!std::filesystem::exists(directory.path() / "r/plots"));
    }
}

BOOST_AUTO_TEST_CASE(a_script_run_by_hand_draws_the_same_picture) {
    const TemporaryDirectory directory;
    BOOST_TEST(call(directory, small + files("'plots'") + out(directory)).exit == 0);
    const std::string svg = directory.read("r/plots/convergence.svg");
    BOOST_TEST(svg.size() > 1000u);
    std::filesystem::remove(directory.path() / "r/plots/convergence.svg");
    BOOST_TEST(
        std::system(("cd " + (directory.path() / "r/plots").string() + " && gnuplot convergence.gp")
                        .c_str()) == 0);
    BOOST_TEST(directory.read("r/plots/convergence.svg") == svg);
}

BOOST_AUTO_TEST_CASE(csv_reads_back_to_the_doubles_of_the_json) {
    const TemporaryDirectory directory;
    BOOST_TEST(call(directory, small + files("'csv','json'") + out(directory)).exit == 0);
    const auto json = nlohmann::json::parse(directory.read("r/result.json"));
    const auto same = [&](const std::string& file, const nlohmann::json& runs,
                          const std::string& norm) {
        std::istringstream lines(directory.read(file));
        std::string line;
        std::getline(lines, line);
        std::istringstream headings(line);
        std::ptrdiff_t column = 0;
        for (std::string name; std::getline(headings, name, ',') && name != norm;)
            ++column;
        for (const auto& run : runs) {
            BOOST_REQUIRE(std::getline(lines, line));
            std::istringstream fields(line);
            std::string field;
            for (std::ptrdiff_t i = 0; i <= column; ++i)
                std::getline(fields, field, ',');
            BOOST_TEST(std::stod(field) == run.at("errors").at(norm).get<double>());
        }
    };
    same("r/ladder.csv", json.at("ladder").at("rungs"), "u_LinfH2semi_sq");
    same("r/orders.csv", json.at("orders").at("runs"), "theta_L2L2");
}

BOOST_AUTO_TEST_CASE(json_keeps_to_its_schema) {
    if (!installed("python3 -c 'import jsonschema'"))
        return;
    const TemporaryDirectory directory;
    const std::string timed = " --set work_precision.runs=2"
                              " --set work_precision.scheme.0.elements=[4,8]"
                              " --set work_precision.scheme.1.elements=[4,8]"
                              " --set work_precision.scheme.2.elements=[4,8]"
                              " --set work_precision.scheme.3.elements=[4,8]";
    const std::string few = " --set stress.sweep.product.elements=[2] --set "
                            "stress.sweep.product.alpha=[0.5] --set stress.sweep.loads.load=[1]";
    std::string instances;
    for (const auto& [name, arguments] :
         {std::pair<std::string, std::string>{"ladder", small},
          {"failed", "run table1 --set scheme.algorithm=fixed-point --set beam.alpha=5 --set "
                     "'ladder.elements=[4,4]' --set 'ladder.dt=[1,1e-4]' --set ladder.printed={}"},
          {"timed", "run table1-work-precision" + timed},
          {"stress", "run stress-contact" + few},
          {"evolution", "run figure1 --set evolution.every=50"},
          {"checked", "check heated-end --short --set 'expect.ladder.theta_L2H1.orders=[1.9,2.1]'"},
          {"map", "run fixed-point-limits --set stress.contraction.elements=4"},
          {"reference", "run figure1-ladder --set reference.elements=16 --set reference.dt=0.01 "
                        "--set ladder.elements=[2,4] --set ladder.dt=[0.1,0.05]"}}) {
        const std::string file = (directory.path() / (name + ".json")).string();
        const Called called = call(directory, arguments + " --json " + file);
        BOOST_TEST(called.exit == (name == "failed"    ? 3
                                   : name == "checked" ? 1
                                                       : 0),
                   name << called.errors);
        instances += " -i " + file;
    }
    const std::string validate = "python3 -W ignore -m jsonschema " TVBEAM_SCHEMA;
    BOOST_TEST(std::system((validate + instances).c_str()) == 0);
    // And a schema that nothing breaks would be of no use.
    auto json = nlohmann::json::parse(directory.read("ladder.json"));
    json.at("ladder").at("rungs")[0].erase("errors");
    const std::string broken = directory.write("broken.json", json.dump());
    BOOST_TEST(std::system((validate + " -i " + broken + " >/dev/null 2>&1").c_str()) != 0);
}

BOOST_AUTO_TEST_CASE(json_of_an_analysis_keeps_to_its_schema) {
    if (!installed("python3 -c 'import jsonschema'"))
        return;
    const TemporaryDirectory directory;
    std::string instances;
    for (const auto& [name, table, options] : std::vector<std::array<std::string, 3>>{
             {"errors",
              "h,L2,drag\n1,1,3\n0.5,0.25,2.25\n0.25,0.0625,2.0625\n0.125,0.015625,2.015625\n",
              " --error L2 --value drag"},
             {"grid", "h,dt,error\n1,1,2\n1,0.5,1.5\n0.5,1,1.25\n0.5,0.5,0.75\n", ""},
             {"grid_with_a_fit",
              "h,dt,error\n1,1,2\n1,0.5,1.5\n1,0.25,1.25\n0.5,1,1.25\n0.5,0.5,0.75\n"
              "0.5,0.25,0.5\n0.25,1,1.0625\n0.25,0.5,0.5625\n0.25,0.25,0.3125\n",
              ""},
             {"value_grid", "h,dt,drag\n1,1,2\n1,0.5,1.5\n0.5,1,1.25\n0.5,0.5,0.75\n",
              " --value drag"},
             {"few", "h,error\n1,0.5\n", ""},
             {"apart", "h,error,value\n1,1,1\n0.5,2,2\n0.25,inf,nan\n0.125,0,9\n", ""}}) {
        const std::string file = (directory.path() / (name + ".json")).string();
        const Called called = call(directory, "analyse " + directory.write(name + ".csv", table) +
                                                  options + " --json " + file);
        BOOST_TEST(called.exit == 0, name << called.errors);
        instances += " -i " + file;
    }
    const std::string validate = "python3 -W ignore -m jsonschema " TVBEAM_ANALYSIS_SCHEMA;
    BOOST_TEST(std::system((validate + instances).c_str()) == 0);
    auto json = nlohmann::json::parse(directory.read("errors.json"));
    json.at("columns")[0].at("orders").at("h").erase("low");
    const std::string broken = directory.write("broken.json", json.dump());
    BOOST_TEST(std::system((validate + " -i " + broken + " >/dev/null 2>&1").c_str()) != 0);
}

// e = h^2 + 0.3 dt: p = 2, q = 1, a = 1, b = 0.3, rho = 1; one row of 16 is ten times that.
BOOST_AUTO_TEST_CASE(json_of_a_grid_has_the_fit_that_its_text_prints) {
    const TemporaryDirectory directory;
    std::string table = "dx,tau,e\n";
    for (const double h : {0.2, 0.1, 0.05, 0.025})
        for (const double dt : {0.1, 0.05, 0.025, 0.0125})
            table += fmt::format("{},{},{:.12e}\n", h, dt,
                                 (h * h + 0.3 * dt) * (h == 0.05 && dt == 0.05 ? 10.0 : 1.0));
    const Called called = call(directory, "analyse " + directory.write("g.csv", table) +
                                              " --size dx --step tau --error e --json -");
    BOOST_TEST(called.exit == 0, called.errors);
    const auto fit = nlohmann::json::parse(called.output).at("columns")[0].at("fit");
    BOOST_TEST(fit.at("h") == "dx");
    BOOST_TEST(fit.at("dt") == "tau");
    BOOST_TEST(fit.at("status") == "ok");
    for (const auto& [name, size] :
         {std::pair("p", 2.0), {"q", 1.0}, {"a", 1.0}, {"b", 0.3}, {"rho", 1.0}})
        BOOST_TEST(std::abs(fit.at(name).get<double>() - size) < 1e-4, name);
    BOOST_TEST(fit.at("rms").get<double>() < 1e-4);
    BOOST_TEST(fit.at("used") == 15);
    BOOST_TEST(fit.at("rejected").size() == 1U);
    BOOST_TEST(fit.at("rejected")[0].at("dx") == 0.05);
    BOOST_TEST(fit.at("rejected")[0].at("tau") == 0.05);
    BOOST_TEST(fit.at("rejected")[0].at("reason").is_string());
}

BOOST_AUTO_TEST_CASE(the_table_compiles_under_pdflatex_whatever_a_scene_is_called) {
    if (!installed("pdflatex --version"))
        return;
    const TemporaryDirectory directory;
    // Letters and signs that TeX takes for commands, that its fonts have, and that they have not.
    BOOST_TEST(call(directory, small + files("'latex'") + "--set 'title=\"" +
                                   "50 % of a_b & {x} \\\\foo ~ ^2 # $ <b> |é ł ą ∂ → 中 `\"' " +
                                   out(directory))
                   .exit == 0);
    BOOST_TEST(std::system(("cd " + (directory.path() / "r").string() +
                            " && pdflatex -halt-on-error -interaction=nonstopmode table.tex "
                            ">table.said 2>&1")
                               .c_str()) == 0,
               directory.read("r/table.said"));
    BOOST_TEST(!has(directory.read("r/table.said"), "Overfull"));
}

BOOST_AUTO_TEST_CASE(a_page_needs_nothing_and_shows_what_scenes_hold_as_text) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write(
        "s.toml",
        "title = '<script>alert(1)</script> & \"more\"'\nsolution = 'copetti-fernandez-2011'\n"
        "[beam]\nalpha = 0.017\nzeta = 0.1\nstops = [-0.02, 0.1]\n"
        "[work_precision]\nfinal_time = 2.0\nnorms = ['theta_L2L2']\nruns = 1\n"
        "[[work_precision.scheme]]\nname = \"<img src=x> & 'it' `id`\"\nelements = [4, 8]\n"
        "dt = [0.5, 0.25]\n# </pre><script>\n");
    BOOST_TEST(call(directory, "run " + scene + " " + files("'html'") + out(directory)).exit == 0);
    const std::string html = directory.read("r/report.html");
    for (const std::string part :
         {"<script", "<img", "<link", "src=\"", "@import", "url(http", "javascript:"})
        BOOST_TEST(!has(html, part), part);
    BOOST_TEST(has(html, "<h1>&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;more&quot;</h1>"));
    BOOST_TEST(has(html, "&lt;/pre&gt;&lt;script&gt;"));
    // The only addresses are the names of XML's spaces.
    BOOST_TEST(count(html, "http") == count(html, "=\"http://www.w3.org/"));
    for (const std::string tag : {"table", "figure", "section", "svg", "ul", "dl", "pre", "tr"})
        BOOST_TEST(count(html, "<" + tag + ">") + count(html, "<" + tag + " ") ==
                       count(html, "</" + tag + ">"),
                   tag);
    BOOST_TEST(has(html, "prefers-color-scheme: dark"));
    for (const std::string part : {"<dt>commit</dt>", "<dt>flags</dt>", "<dt>processor</dt>"})
        BOOST_TEST(has(html, part), part);
}

BOOST_AUTO_TEST_CASE(the_ids_of_a_page_are_its_own_and_every_reference_has_one) {
    const TemporaryDirectory directory;
    BOOST_TEST(call(directory, small + files("'html'") + out(directory)).exit == 0);
    const std::string html = directory.read("r/report.html");
    const auto between = [&](const std::string& opening, char closing) {
        std::vector<std::string> found;
        for (auto at = html.find(opening); at != std::string::npos; at = html.find(opening, at)) {
            at += opening.size();
            found.push_back(html.substr(at, html.find(closing, at) - at));
        }
        return found;
    };
    auto ids = between(" id=\"", '"');
    const auto more = between(" id='", '\'');
    ids.insert(ids.end(), more.begin(), more.end());
    const std::set<std::string> unique(ids.begin(), ids.end());
    BOOST_TEST(ids.size() > 30u);
    BOOST_TEST(unique.size() == ids.size());
    for (const auto& reference : between("href='#", '\''))
        BOOST_TEST(unique.contains(reference), reference);
    for (const auto& reference : between("url(#", ')'))
        BOOST_TEST(unique.contains(reference), reference);
}

BOOST_AUTO_TEST_SUITE_END()

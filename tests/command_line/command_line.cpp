// The program as its users call it: exit codes, one message, nothing half written.

#include "tests/command_line/called_program.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(command_line)

namespace {

const std::string small = "run table1 --set 'ladder.elements=[4,8]' --set ladder.dt=0.1 --set "
                          "'ladder.dt=[0.1,0.05]' --set 'ladder.printed={}'";

} // namespace

BOOST_AUTO_TEST_CASE(a_run_prints_its_table_and_exits_with_zero) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small);
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(called.errors.empty(), called.errors);
    BOOST_TEST(has(called.output, "theta_L2L2_sq"));
    BOOST_TEST(has(called.output, "ord."));
    std::istringstream lines(called.output);
    for (std::string line; std::getline(lines, line);)
        BOOST_TEST(line.size() <= 82u, line); // 80 columns; é and other letters take two bytes
}

BOOST_AUTO_TEST_CASE(json_has_the_keys_of_its_schema_and_reads_back_exactly) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + " --json -");
    BOOST_TEST(called.exit == 0);
    const auto json = nlohmann::json::parse(called.output);
    BOOST_TEST(json.at("schema") == "tvbeam-result/1");
    BOOST_TEST(json.at("scene").at("beam").at("alpha") == 0.017);
    BOOST_TEST(json.at("left_out").is_array());
    BOOST_TEST(json.at("provenance").contains("version"));
    const auto& rungs = json.at("ladder").at("rungs");
    BOOST_REQUIRE(rungs.size() == 2u);
    BOOST_TEST(rungs[0].at("elements") == 4);
    BOOST_TEST(rungs[1].at("steps") == 40);
    BOOST_TEST(rungs[1].at("status") == "ok");
    BOOST_TEST(rungs[0].at("orders").at("theta_L2L2_sq").is_null());
    const double e0 = rungs[0].at("errors").at("theta_L2L2_sq");
    const double e1 = rungs[1].at("errors").at("theta_L2L2_sq");
    BOOST_TEST(rungs[1].at("orders").at("theta_L2L2_sq").get<double>() ==
                   std::log(e0 / e1) / std::log(2.0),
               boost::test_tools::tolerance(1e-14));
}

// Two, three and four bytes of UTF-8, a character that JSON escapes, and one that only TOML must.
BOOST_AUTO_TEST_CASE(every_letter_of_a_title_reaches_the_json_and_kept_runs) {
    const TemporaryDirectory directory;
    const std::string title = "\u00e9 \u20ac \U0001f642 \" \u2028 \x7f";
    const std::string run = small + R"( --set 'title="é € 🙂 \" \u2028 \u007f"')";
    const auto json = nlohmann::json::parse(call(directory, run + " --json -").output);
    BOOST_TEST(json.at("scene").at("title") == title);
    const std::string out = (directory.path() / "out").string();
    BOOST_TEST(call(directory, run + " --out " + out).exit == 0);
    BOOST_TEST(std::filesystem::exists(out + "/result.json"));
}

// BDF2 looks across the end at t = 1 in every run; one sentence says so for all.
BOOST_AUTO_TEST_CASE(what_the_end_of_a_phase_costs_is_said_once) {
    const TemporaryDirectory directory;
    const std::string run = "run impact --set scheme.time=bdf2 --set 'ladder.elements=[4,8]'";
    const std::string words = "At t = 1, where a phase of the solution ends";
    const std::string text = call(directory, run).output;
    BOOST_TEST(has(text, words), text);
    BOOST_TEST(text.find(words) == text.rfind(words));
    const auto json = nlohmann::json::parse(call(directory, run + " --json -").output);
    BOOST_REQUIRE(json.at("remarks").size() == 1U);
    BOOST_TEST(json.at("remarks")[0].get<std::string>().starts_with(words));
    BOOST_TEST(!has(call(directory, small).output, "where a phase"));
}

BOOST_AUTO_TEST_CASE(csv_and_json_hold_the_same_doubles) {
    const TemporaryDirectory directory;
    const std::string csv = (directory.path() / "t.csv").string();
    const std::string json_file = (directory.path() / "t.json").string();
    BOOST_TEST(call(directory, small + " --csv " + csv + " --json " + json_file).exit == 0);
    const auto json = nlohmann::json::parse(directory.read("t.json"));
    std::istringstream lines(directory.read("t.csv"));
    std::string line;
    std::getline(lines, line);
    BOOST_TEST(
        line ==
        "elements,h,dt,steps,status,theta_L2L2_sq,theta_L2L2_sq_order,theta_L2L2_sq_predicted,"
        "theta_L2L2_sq_predicted_low,theta_L2L2_sq_predicted_high,"
        "u_LinfH2semi_sq,u_LinfH2semi_sq_order,u_LinfH2semi_sq_predicted,"
        "u_LinfH2semi_sq_predicted_low,u_LinfH2semi_sq_predicted_high,seconds,reason");
    for (const auto& rung : json.at("ladder").at("rungs")) {
        BOOST_REQUIRE(std::getline(lines, line));
        std::istringstream fields(line);
        std::string field;
        for (int i = 0; i < 6; ++i)
            std::getline(fields, field, ',');
        BOOST_TEST(std::stod(field) == rung.at("errors").at("theta_L2L2_sq").get<double>());
    }
    BOOST_TEST(directory.count() == 2u); // no temporary file is left
}

BOOST_AUTO_TEST_CASE(a_report_does_not_take_the_place_of_what_is_read) {
    const TemporaryDirectory directory;
    const std::string table = "h,E\n0.1,0.01\n0.05,0.0025\n0.025,0.000625\n";
    const std::string data = directory.write("t.csv", table);
    const std::string expect = directory.write("e.toml", "E.orders = [1, 3]\n");
    const std::string base = (directory.path() / "b.json").string();
    const std::string analyse = "analyse " + data + " --error E ";
    BOOST_TEST(call(directory, analyse + "--record " + base).exit == 0);
    for (const std::string& arguments :
         {analyse + "--json " + data, analyse + "--csv " + (directory.path() / "./t.csv").string(),
          analyse + "--expect " + expect + " --junit " + expect,
          analyse + "--baseline " + base + " --json " + base, analyse + "--record " + data}) {
        const auto refused = call(directory, arguments);
        BOOST_TEST(refused.exit == 2, arguments);
        BOOST_TEST(has(refused.errors, "would take the place of a file that is read"),
                   refused.errors);
    }
    BOOST_TEST(directory.read("t.csv") == table);
    const std::string scene = directory.write("s.toml", call(directory, "list impact").output);
    for (const std::string& arguments :
         {"run " + scene + " --json " + scene, "run " + scene + " --csv " + scene,
          "check " + scene + " --record " + scene})
        BOOST_TEST(call(directory, arguments).exit == 2, arguments);
    BOOST_TEST(directory.read("s.toml") == call(directory, "list impact").output);
    const std::string own = directory.write("mine.toml", "theta = 'x*(1 - x)*t'\nu = '0'\n");
    const std::string posed =
        directory.write("p.toml", "solution = 'mine.toml'\n[beam]\nalpha = 0.3\nzeta = "
                                  "0.1\n[ladder]\nfinal_time = 1\nelements = [2, 4]\ndt = [0.5, "
                                  "0.25]\nnorms = ['theta_L2L2']\n");
    BOOST_TEST(call(directory, "run " + posed + " --json " + own).exit == 2);
    BOOST_TEST(call(directory, "run " + posed + " --json " + base).exit == 0);
    // Pipes and devices lose nothing.
    BOOST_TEST(call(directory, "analyse /dev/stdin --error E --json /dev/stdout < " + data +
                                   " | cat > " + base)
                   .exit == 0);
    BOOST_TEST(has(directory.read("b.json"), "\"columns\""));
    // A baseline may be recorded anew.
    BOOST_TEST(call(directory, analyse + "--record " + base + ".new").exit == 0);
    BOOST_TEST(call(directory, "analyse " + data + " --error E --baseline " + base +
                                   ".new --record " + base + ".new")
                   .exit == 0);
}

BOOST_AUTO_TEST_CASE(two_reports_in_one_file_are_refused) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "r").string();
    BOOST_TEST(call(directory, small + " --json " + file + " --csv " + file).exit == 2);
    BOOST_TEST(directory.count() == 0u);
}

BOOST_AUTO_TEST_CASE(a_grid_without_a_ladder_has_a_csv_of_its_own) {
    const TemporaryDirectory directory;
    const std::string csv = (directory.path() / "grid.csv").string();
    const std::string grid =
        "run table1-orders --set 'orders.elements=[4,8,16]' --set 'orders.dt=[0.1,0.05,0.025]' ";
    BOOST_TEST(call(directory, grid + "--csv " + csv).exit == 0);
    BOOST_TEST(
        has(call(directory, "analyse " + csv + " --error theta_L2L2").output, "a grid of 9 runs"));
}

BOOST_AUTO_TEST_CASE(bad_input_exits_with_two_says_one_line_and_writes_nothing) {
    const TemporaryDirectory directory;
    const std::string out = (directory.path() / "out.json").string();
    for (const std::string arguments :
         {"run no-such-scene", "run table1 --set beam.zeta=-1", "run table1 --set beam.zata=1",
          "run table1 --set 'ladder.elements=[]'", "run table1 --set beam.alpha=1e400",
          "run table1 --set solution=missing", "derive no-such-solution",
          "derive heat-2d --latex --code c"}) {
        const Called called =
            call(directory, arguments + (arguments.starts_with("run") ? " --json " + out : ""));
        BOOST_TEST(called.exit == 2, arguments);
        BOOST_TEST(called.output.empty());
        BOOST_TEST(called.errors.starts_with("tvbeam: "), called.errors);
        BOOST_TEST(std::count(called.errors.begin(), called.errors.end(), '\n') == 1,
                   called.errors);
        BOOST_TEST(directory.count() == 0u, arguments);
    }
}

BOOST_AUTO_TEST_CASE(wrong_usage_exits_with_two) {
    const TemporaryDirectory directory;
    for (const std::string arguments : {"", "frobnicate", "run", "run table1 --no-such-option",
                                        "run table1 table1", "run table1 --json - --csv -"}) {
        const Called called = call(directory, arguments);
        BOOST_TEST(called.exit == 2, arguments);
        BOOST_TEST(!called.errors.empty());
    }
    BOOST_TEST(call(directory, "runn table1").errors ==
               "tvbeam: 'runn' is not a command; did you mean 'run'?; tvbeam --help lists them\n");
}

BOOST_AUTO_TEST_CASE(a_number_of_jobs_that_is_not_one_is_refused) {
    const TemporaryDirectory directory;
    for (const std::string command : {"run", "check"})
        for (const std::string number : {"0", "-1", "two", "1.5", "99999999999999999999", "''"}) {
            const Called called = call(directory, command + " table1 --jobs " + number);
            BOOST_TEST(called.exit == 2, number);
            BOOST_TEST(called.output.empty());
            BOOST_TEST(has(called.errors, "--jobs"), called.errors);
        }
}

BOOST_AUTO_TEST_CASE(jobs_change_nothing_but_the_seconds) {
    const TemporaryDirectory directory;
    const auto without_seconds = [&](const std::string& jobs) {
        auto json =
            nlohmann::json::parse(call(directory, small + " --json - --jobs " + jobs).output);
        for (auto& rung : json.at("ladder").at("rungs"))
            rung.erase("seconds");
        for (auto& run : json.at("orders").at("runs"))
            run.erase("seconds");
        json.at("provenance").erase("date");
        return json;
    };
    BOOST_TEST(without_seconds("1") == without_seconds("3"));
}

BOOST_AUTO_TEST_CASE(help_exits_with_zero_and_shows_an_example) {
    const TemporaryDirectory directory;
    for (const std::string command : {"run", "check", "analyse", "derive", "list"}) {
        const Called called = call(directory, command + " --help");
        BOOST_TEST(called.exit == 0);
        BOOST_TEST(has(called.output, "Example: tvbeam " + command));
    }
    BOOST_TEST(call(directory, "--version").exit == 0);
}

BOOST_AUTO_TEST_CASE(a_failed_run_exits_with_three_and_keeps_what_was_finished) {
    // The fixed point contracts by α²Δt/((Δt + ζ)(1 + π²Δt)): 0.5²·0.01/0.11/1.1 at the first step,
    // but for Δt = 1 and α = 5 it is 25/1.1/10.9 > 1.
    const TemporaryDirectory directory;
    const Called called = call(
        directory,
        "run table1 --set scheme.algorithm=fixed-point --set beam.alpha=5 --set "
        "'ladder.elements=[4,4]' --set 'ladder.dt=[1,1e-4]' --set 'ladder.printed={}' --json -");
    BOOST_TEST(called.exit == 3);
    const auto json = nlohmann::json::parse(called.output);
    const auto& rungs = json.at("ladder").at("rungs");
    BOOST_TEST(rungs[1].at("status") == "ok");
    BOOST_TEST(rungs[1].at("errors").at("theta_L2L2_sq").is_number());
    BOOST_TEST(rungs[0].at("status") == "failed");
    BOOST_TEST(rungs[0].at("errors").at("theta_L2L2_sq").is_null());
    BOOST_TEST(has(rungs[0].at("reason"), "predicted; use the direct algorithm"));
    BOOST_TEST(has(called.errors, "a run failed"));
}

BOOST_AUTO_TEST_CASE(an_overflow_is_said_and_not_printed_as_a_number) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + " --set beam.alpha=1e200");
    BOOST_TEST(called.exit != 0);
    BOOST_TEST(!has(called.output, " nan"));
    BOOST_TEST(has(called.output + called.errors, "finite"));
}

BOOST_AUTO_TEST_CASE(a_place_that_cannot_be_written_is_said_before_anything_runs) {
    const TemporaryDirectory directory;
    for (const std::string option : {"--json", "--csv"}) {
        const Called called = call(directory, small + " " + option + " /no/such/directory/r");
        BOOST_TEST(called.exit == 2);
        BOOST_TEST(called.output.empty());
        BOOST_TEST(has(called.errors, "cannot write '/no/such/directory/r'"));
    }
}

BOOST_AUTO_TEST_CASE(a_device_is_written_to_and_not_replaced) {
    const TemporaryDirectory directory;
    const Called called = call(directory, small + " --csv /dev/full");
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(has(called.errors, "cannot write '/dev/full'"));
    BOOST_TEST(std::filesystem::is_character_file("/dev/full"));
}

BOOST_AUTO_TEST_CASE(standard_output_that_cannot_be_written_is_said) {
    const TemporaryDirectory directory;
    for (const std::string& arguments :
         {small, std::string("--help"), std::string("--version"), std::string("run --help")}) {
        const Called called = call(directory, arguments + " >/dev/full");
        BOOST_TEST(called.exit == 3, arguments);
        BOOST_TEST(has(called.errors, "cannot write to standard output"), arguments);
    }
}

// No name is known where what is shipped is not found, with --code as without.
BOOST_AUTO_TEST_CASE(code_of_an_unknown_name_is_refused_as_its_formulas_are) {
    const TemporaryDirectory directory;
    const std::string elsewhere = "TVBEAM_DATA=" + directory.path().string() + " ";
    const Called plain = call(directory, "derive heat-2d", elsewhere);
    const Called code = call(directory, "derive heat-2d --code c", elsewhere);
    BOOST_TEST(plain.exit == 2);
    BOOST_TEST(has(plain.errors, "what tvbeam ships is not found"), plain.errors);
    BOOST_TEST(code.exit == 2);
    BOOST_TEST(code.errors == plain.errors);
    BOOST_TEST(has(call(directory, "derive table1 --code c").errors,
                   "--code and --out are for files of equations"));
}

BOOST_AUTO_TEST_CASE(what_a_stress_study_did_not_measure_is_blank_or_said) {
    const TemporaryDirectory directory;
    const Called stopped = call(directory, "run roundoff --set stress.roundoff.alpha=100 --set "
                                           "'stress.roundoff.elements=[10]'");
    BOOST_TEST(has(stopped.output, "s = 10: the Hermite form stopped: the fixed-point iteration"),
               stopped.output);

    // A prime number of elements has no fast transform, hence no sine basis to compare with.
    directory.write("scene.toml", "[stress.sweep.a]\nelements = [127]\nsteps = 2\n");
    const Called few = call(directory, "run " + directory.path().string() + "/scene.toml");
    // Without stops there is no contact either: the row ends with the residual.
    const auto row = few.output.find("  all         1       0       0      0");
    BOOST_REQUIRE(row != std::string::npos);
    std::istringstream line(few.output.substr(row, few.output.find('\n', row) - row));
    const std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
    BOOST_TEST(words.size() == 7U); // all, four outcomes, energy, residual
    BOOST_TEST(!has(few.output, "penetration:"));
}

BOOST_AUTO_TEST_CASE(analyse_reads_any_solver_s_errors) {
    const TemporaryDirectory directory;
    const std::string rising =
        directory.write("r.csv", "h,error\n0.1,1e-3\n0.05,2e-3\n0.025,4e-3\n");
    const Called called = call(directory, "analyse " + rising);
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(has(called.output, "-1.000"));
    BOOST_TEST(has(called.output, "diverging"));
    // The program's own CSV is such a file.
    const std::string csv = (directory.path() / "t.csv").string();
    BOOST_TEST(call(directory, small + " --csv " + csv).exit == 0);
    BOOST_TEST(has(call(directory, "analyse " + csv + " --error theta_L2L2_sq").output, "order"));
    BOOST_TEST(call(directory, "analyse " + directory.write("bad.csv", "a,b\n1,2\n")).exit == 2);
}

// e = 100/n² in the plane, h = n^(-1/2): order 4 in h. The same gates as a scene has.
BOOST_AUTO_TEST_CASE(analyse_writes_and_gates_as_a_scene_does) {
    const TemporaryDirectory directory;
    const std::string in = directory.path().string() + "/";
    const std::string table = directory.write(
        "t.dat", "# ndofs L2 drag\n6400 2.44140625D-06 2.00015625\n100 1.0D-02 2.01\n"
                 "1600 3.90625d-5 2.000625\n400 6.25-4 2.0025\n");
    const std::string analyse =
        "analyse " + table + " --size ndofs --dimension 2 --error L2 --value drag ";
    const std::string files = "--json " + in + "a.json --csv " + in + "a.csv --out " + in +
                              "out --junit " + in + "j.xml --record " + in + "b.json ";
    const Called good = call(directory, analyse + files + "--expect 'L2.order = [3.9, 4.1]'",
                             "GITHUB_STEP_SUMMARY=" + in + "summary.md ");
    BOOST_TEST(good.exit == 0);
    for (const std::string& command : {analyse, std::string("check sheared ")}) {
        const Called nowhere =
            call(directory, command, "GITHUB_STEP_SUMMARY=" + in + "no/such.md ");
        BOOST_TEST(nowhere.exit == 2);
        BOOST_TEST(nowhere.output.empty(), nowhere.output);
    }
    BOOST_TEST(has(good.output, "h = ndofs^(-1/2)"));
    BOOST_TEST(has(good.output, "order in h 4.000"));
    const auto text_of = [&](const std::string& name) {
        std::ostringstream text;
        text << std::ifstream(in + name).rdbuf();
        return text.str();
    };
    const auto json = nlohmann::json::parse(text_of("a.json"));
    BOOST_TEST(json["schema"] == "tvbeam-analysis/1");
    BOOST_TEST(json["columns"][0]["orders"]["h"]["low"].get<double>() < 4.0);
    BOOST_TEST(json["columns"][0]["orders"]["h"]["high"].get<double>() > 4.0);
    BOOST_TEST(json["columns"][1]["kind"] == "value");
    BOOST_TEST(json["columns"][1]["limit"]["low"].get<double>() < 2.0);
    BOOST_TEST(json["columns"][1]["limit"]["high"].get<double>() > 2.0);
    BOOST_TEST(has(text_of("a.csv"), "h,L2,L2_order,L2_verdict,drag"));
    BOOST_TEST(has(text_of("j.xml"), "failures=\"0\""));
    BOOST_TEST(has(text_of("out/report.html"), "L2"));
    BOOST_TEST(has(text_of("out/plots/convergence.gp"), "convergence.svg"));
    BOOST_TEST(has(text_of("summary.md"), "| ok |"));

    const std::string gates =
        directory.write("gates.toml", "[L2]\norder.h = [1.9, 2.1]\norders = [3.9, 4.1]\n[drag]\n"
                                      "limit = [1.9, 2.1]\nuncertainty = [0, 1]\n");
    const Called bad = call(directory, analyse + "--expect " + gates);
    BOOST_TEST(bad.exit == 1);
    BOOST_TEST(has(bad.output, "gates.toml:2:"));
    BOOST_TEST(has(bad.output, "L2: order in h: expected 1.9 to 2.1, found 4"));
    BOOST_TEST(call(directory, analyse + "--baseline " + in + "b.json").exit == 0);
    BOOST_TEST(call(directory, "analyse " + table +
                                   " --size ndofs --dimension 2 --error drag --baseline " + in +
                                   "b.json")
                   .exit == 1);
    BOOST_TEST(call(directory, analyse + "--expect 'L1.order = [1, 2]'").exit == 2);

    // A run that was not made is in no record, and every one of what is repeated counts.
    const std::string rows = "h,error\n0.4,0.16\n0.2,0.041\n0.2,0.039\n0.1,NA\n0.05,0.0025\n";
    const std::string repeated = "analyse " + directory.write("repeated.csv", rows);
    BOOST_TEST(call(directory, repeated + " --record " + in + "r.json").exit == 0);
    BOOST_TEST(call(directory, repeated + " --baseline " + in + "r.json").exit == 0);
    directory.write("repeated.csv", std::string(rows).replace(rows.find("0.041"), 5, "0.042"));
    const Called changed = call(directory, repeated + " --baseline " + in + "r.json");
    BOOST_TEST(changed.exit == 1);
    BOOST_TEST(has(changed.output, "error: h = 0.2: expected 0.041"), changed.output);
    directory.write("repeated.csv", std::string(rows).replace(rows.find("NA"), 2, "inf"));
    const Called infinite = call(directory, repeated + " --baseline " + in + "r.json");
    BOOST_TEST(infinite.exit == 1);
    BOOST_TEST(has(infinite.output, "h = 0.1: expected a recorded error, found inf"),
               infinite.output);
    BOOST_TEST(call(directory, "analyse - --size ndofs --error L2 < " + table).exit == 0);
}

// As check does: entries of other names stay, and what is no baseline is refused at the start.
BOOST_AUTO_TEST_CASE(a_table_is_recorded_into_what_is_there) {
    const TemporaryDirectory directory;
    const std::string in = directory.path().string() + "/";
    const std::string analyse =
        "analyse " + directory.write("t.csv", "h,error\n0.4,0.16\n0.2,0.04\n0.1,0.01\n");
    BOOST_TEST(call(directory, "check sheared --short --record " + in + "b.json").exit == 0);
    BOOST_TEST(call(directory, analyse + " --record " + in + "b.json").exit == 0);
    BOOST_TEST(call(directory, analyse + " --baseline " + in + "b.json").exit == 0);
    BOOST_TEST(call(directory, "check sheared --short --baseline " + in + "b.json").exit == 0);
    directory.write("notes.txt", "mine\n");
    const Called refused =
        call(directory, analyse + " --json " + in + "a.json --record " + in + "notes.txt");
    BOOST_TEST(refused.exit == 2);
    BOOST_TEST(has(refused.errors, "notes.txt: is not a baseline"), refused.errors);
    BOOST_TEST(directory.read("notes.txt") == "mine\n");
    BOOST_TEST(!std::filesystem::exists(in + "a.json"));
    // A device holds nothing.
    BOOST_TEST(call(directory, analyse + " --record /dev/null").exit == 0);
}

// Rows of Euler and of BDF2 are not each other's, however the selection is written; of all rows
// together the record is that of the file, as without --where.
BOOST_AUTO_TEST_CASE(rows_that_are_chosen_have_a_record_of_their_own) {
    const TemporaryDirectory directory;
    const std::string in = directory.path().string() + "/";
    const std::string table = directory.write(
        "two.csv", "scheme,k,h,e\nEuler,1,0.4,0.16\nEuler,1,0.2,0.04\nEuler,1,0.1,0.01\n"
                   "BDF2,1,0.4,0.016\nBDF2,1,0.2,0.004\nBDF2,1,0.1,0.001\n");
    const auto exit_of = [&](const std::string& where, const std::string& option) {
        return call(directory,
                    "analyse " + table + " --error e " + where + " " + option + " " + in + "b.json")
            .exit;
    };
    const std::string euler = "--where scheme=Euler";
    const std::string bdf2 = "--where scheme=BDF2";
    for (const std::string& where : {euler, bdf2})
        BOOST_TEST(exit_of(where, "--record") == 0);
    for (const std::string& where : {euler, bdf2, euler + " --where 'k=*'"})
        BOOST_TEST(exit_of(where, "--baseline") == 0, where);
    BOOST_TEST(exit_of(euler + " --where k=1.0", "--record") == 0);
    BOOST_TEST(exit_of("--where 'K = 1' " + euler, "--baseline") == 0);
    const Called missing = call(directory, "analyse " + table + " --error e --where 'scheme=*' " +
                                               "--baseline " + in + "b.json");
    BOOST_TEST(missing.exit == 1);
    BOOST_TEST(has(missing.output, "expected a record of '" + table + "', by this name, found"),
               missing.output);
    BOOST_TEST(exit_of("--where 'scheme=*'", "--record") == 0);
    const auto scenes = nlohmann::json::parse(directory.read("b.json")).at("scenes");
    BOOST_TEST(scenes.size() == 4U);
    BOOST_TEST(scenes.at(table).size() == 6U);
    BOOST_TEST(scenes.at(table + " " + euler).size() == 3U);
}

// By --error, --value, --size and --step others would be lost; more of them, other rows and runs
// that are made now lose nothing.
BOOST_AUTO_TEST_CASE(a_record_of_a_table_loses_no_column) {
    const TemporaryDirectory directory;
    const std::string file = (directory.path() / "b.json").string();
    const std::string rows = "h,dt,L2,H1\n0.4,0.4,0.16,0.4\n0.2,0.1,0.04,0.2\n";
    const auto recorded = [&](const std::string& more, const std::string& columns) {
        return call(directory, "analyse " + directory.write("t.csv", rows + more) + " " + columns +
                                   " --record " + file);
    };
    BOOST_TEST(recorded("0.1,0.025,NA,0.1\n", "--error L2").exit == 0);
    const std::string before = directory.read("b.json");
    const Called other = recorded("0.1,0.025,0.01,0.1\n", "--error H1");
    BOOST_TEST(other.exit == 2);
    BOOST_TEST(has(other.errors, "b.json: has 'L2: h = 0.2 dt = 0.1' of '"), other.errors);
    BOOST_TEST(has(other.errors, "analyse both in one call"), other.errors);
    BOOST_TEST(directory.read("b.json") == before);
    BOOST_TEST(recorded("0.1,0.025,0.01,0.1\n", "--error L2 --size dt").exit == 2);
    BOOST_TEST(recorded("0.2,0.1,0.04,0.2\n0.1,0.025,0.01,0.1\n", "--error L2,H1").exit == 0);
    BOOST_TEST(recorded("0.1,0.025,0.01,0.1\n", "--error H1,L2").exit == 0);
}

// Values that oscillate, which one method takes; and a grid, on which there is no one way of
// refinement.
BOOST_AUTO_TEST_CASE(what_an_analysis_cannot_say_of_a_value_is_null_with_a_status) {
    const TemporaryDirectory directory;
    const auto column = [&](const std::string& rows) {
        const std::string file = directory.write("v.csv", rows);
        return nlohmann::json::parse(
                   call(directory, "analyse " + file + " --value v --json -").output)
            .at("columns")
            .at(0);
    };
    const std::string rows = "h,v\n0.1,1.0\n0.05,1.2\n0.025,1.1\n0.0125,1.3\n";
    const auto along = column(rows);
    BOOST_TEST(!along.contains("status"));
    BOOST_TEST(!along.at("methods").at("eca_hoekstra").contains("status"));
    for (const char* method : {"gci", "celik"}) {
        BOOST_TEST(along.at("methods").at(method).at("limit").is_null());
        BOOST_TEST(!along.at("methods").at(method).at("status").get<std::string>().empty());
    }
    const Called text = call(directory, "analyse " + directory.write("v.csv", rows) + " --value v");
    BOOST_TEST(has(text.output, "beside it, GCI says nothing: the three finest values oscillate"),
               text.output);
    const auto grid = column("h,dt,v\n0.2,0.2,1.3\n0.1,0.2,1.2\n0.2,0.1,1.25\n0.1,0.1,1.15\n");
    const std::string status = grid.at("limit").at("status");
    BOOST_TEST(grid.at("uncertainty").is_null());
    BOOST_TEST(grid.at("status") == status);
    for (const auto& method : grid.at("methods"))
        BOOST_TEST(method.at("status") == status);
}

// What a link points to is replaced, not the link.
BOOST_AUTO_TEST_CASE(a_file_behind_a_link_is_written_and_the_link_stays) {
    const TemporaryDirectory directory;
    const std::filesystem::path file = directory.write("result.json", "before");
    const std::filesystem::path link = directory.path() / "link.json";
    std::filesystem::create_symlink(file, link);
    BOOST_TEST(
        call(directory, "run table1 --set 'ladder.elements=[10]' --set 'ladder.dt=[0.1]' --set "
                        "ladder.printed={} --json " +
                            link.string())
            .exit == 0);
    BOOST_TEST(std::filesystem::is_symlink(link));
    BOOST_TEST(has(directory.read("result.json"), "\"ladder\""));
}

BOOST_AUTO_TEST_CASE(the_examples_of_the_readme_run_as_they_stand) {
    // Its first four TOML blocks are the solution, the scene, a solution in phases for the same
    // scene, and the expectations of the first.
    std::ostringstream readme;
    readme << std::ifstream(TVBEAM_README).rdbuf();
    const std::string text = readme.str();
    std::vector<std::string> blocks;
    const std::string fence = "```toml\n";
    for (auto at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
        at += fence.size();
        blocks.push_back(text.substr(at, text.find("```", at) - at));
    }
    BOOST_REQUIRE(blocks.size() >= 4u);
    const TemporaryDirectory directory;
    directory.write("mine.toml", blocks[2]);
    const Called in_phases = call(directory, "run " + directory.write("in-phases.toml", blocks[1]));
    BOOST_TEST(in_phases.exit == 0, in_phases.errors);
    BOOST_TEST(has(in_phases.output, "theta_L2L2: order 1.99 to 2.00"), in_phases.output);
    // It shows what is said of another k, in lines of its own.
    const auto in_one_line = [](const std::string& lines) {
        std::istringstream words(lines);
        std::string result;
        for (std::string word; words >> word;)
            result += word + " ";
        return result;
    };
    directory.write("mine.toml", blocks[0].substr(0, blocks[0].find("k = ")) + "k = 0.1\n");
    const Called refused = call(directory, "run " + (directory.path() / "in-phases.toml").string());
    BOOST_TEST(refused.exit == 2);
    const auto place = refused.errors.find("mine.toml:");
    BOOST_REQUIRE(place != std::string::npos);
    BOOST_TEST(has(in_one_line(text), in_one_line(refused.errors.substr(place))), refused.errors);
    directory.write("mine.toml", blocks[0]);
    const std::string scene = directory.write("my-scene.toml", blocks[1] + blocks[3]);
    for (const std::string form : {"", " --short"}) {
        const Called called = call(directory, "check " + scene + form);
        BOOST_TEST(called.exit == 0, called.output + called.errors);
    }
}

// Its error is h^-400, which is infinite at s = 10.
BOOST_AUTO_TEST_CASE(a_timed_run_that_fails_has_every_field_of_the_csv) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("failing.toml", R"(
[solver]
command = ["awk", "-v", "h={h}", "-f", "failing.awk"]
files   = ["failing.awk"]
[solver.errors]
e = '^e = (\S+)'
[work_precision]
norms = ["e"]
runs  = 2
[[work_precision.scheme]]
name     = "failing"
elements = [2, 10]
dt       = "1/s"
)");
    directory.write("failing.awk", "BEGIN { printf \"e = %.17g\\n\", h^-400 }\n");
    std::istringstream csv(call(directory, "run " + scene + " --csv -").output);
    std::vector<std::ptrdiff_t> commas;
    std::vector<std::string> lines;
    for (std::string line; std::getline(csv, line); lines.push_back(line))
        commas.push_back(std::ranges::count(line.substr(0, line.find('"')), ','));
    BOOST_REQUIRE(lines.size() == 3U);
    BOOST_TEST(has(lines[2], ",failed,"));
    BOOST_TEST(commas[1] == commas[0], lines[1]);
    BOOST_TEST(commas[2] == commas[0], lines[2]);
}

// The rows of a sweep's JSON have a value, and where a run failed why: numbers by these names would
// stand in their places.
BOOST_AUTO_TEST_CASE(a_number_called_as_a_row_of_a_sweep_calls_its_own_cannot_be_swept) {
    const TemporaryDirectory directory;
    for (const std::string name : {"value", "failed"}) {
        const std::string run = "run " + directory.write("s.toml", R"(
[solver]
command    = ["awk", "BEGIN { print {k}/{elements}^2 }"]
parameters = { k = 1 }
errors     = { )" + name + R"( = '(\S+)' }
[ladder]
elements = [4, 8]
norms    = [")" + name + R"("]
)");
        BOOST_TEST(call(directory, run).exit == 0);
        const Called swept = call(directory, run + " --set solver.parameters.k=1,2 --json -");
        BOOST_TEST(swept.exit == 2);
        BOOST_TEST(has(swept.errors, "--set solver.parameters.k"), swept.errors);
        BOOST_TEST(has(swept.errors, "of a sweep have a " + name + " of their own"), swept.errors);
        BOOST_TEST(swept.output.empty(), swept.output);
    }
}

BOOST_AUTO_TEST_CASE(a_work_precision_study_has_json_csv_and_a_baseline_of_its_errors) {
    const TemporaryDirectory directory;
    const std::string scene =
        " table1-work-precision --set work_precision.runs=2 --set "
        "work_precision.scheme.0.elements=[4,8] "
        "--set work_precision.scheme.1.elements=[4,8] --set work_precision.scheme.2.elements=[4,8] "
        "--set work_precision.scheme.3.elements=[4,8] --set expect={} ";
    const auto json = nlohmann::json::parse(call(directory, "run" + scene + "--json -").output);
    const auto& schemes = json.at("work_precision").at("schemes");
    BOOST_REQUIRE(schemes.size() == 4u);
    BOOST_TEST(schemes[2].at("name") == "BDF2");
    const auto& row = schemes[2].at("rows").at(1);
    BOOST_TEST(row.at("elements") == 8);
    BOOST_TEST(row.at("dt") == 0.25);
    BOOST_TEST(row.at("status") == "ok");
    BOOST_TEST(row.at("errors").at("theta_L2L2_sq").get<double>() > 0.0);
    for (const std::string key : {"min", "median", "q1", "q3"})
        BOOST_TEST(row.at("seconds").at(key).get<double>() > 0.0);
    BOOST_TEST(row.at("seconds").at("runs") == 2);
    BOOST_TEST(row.at("counters").at("steps") == 8);
    BOOST_TEST(row.at("counters").at("node_steps") == 64);
    BOOST_TEST(row.at("counters").contains("heat_solves"));
    BOOST_TEST(row.at("counters").contains("fixed_point_iterations"));
    const auto& reached = json.at("work_precision").at("time_to_reach").at("theta_L2L2_sq");
    BOOST_TEST(reached.size() == 9u); // 1e-2 … 1e-9 and the target
    BOOST_TEST(reached[0].at("seconds").at("BDF2").is_object());
    BOOST_TEST(reached[7].at("seconds").at("BDF2").is_null());
    BOOST_TEST(reached[0].at("comparisons")[0].at("ratio").get<double>() >= 1.0);

    std::istringstream csv(call(directory, "run" + scene + "--csv -").output);
    std::string line;
    std::getline(csv, line);
    BOOST_TEST(line == "scheme,elements,h,dt,steps,status,theta_L2L2_sq,u_LinfH2semi_sq,"
                       "seconds_min,seconds_q1,seconds_median,seconds_q3,runs,node_steps,"
                       "heat_solves,fixed_point_iterations,reason");
    std::getline(csv, line);
    BOOST_TEST(line.starts_with("\"Euler, fixed point\",4,0.25,0.0025,800,ok,"), line);

    const Called printed = call(directory, "run" + scene);
    BOOST_TEST(has(printed.output, "Seconds to reach an error"));
    BOOST_TEST(
        !has(printed.output, "direct algorithm, implicit Euler, lumped heat mass matrix\n\nWork"));

    const std::string file = (directory.path() / "base.json").string();
    BOOST_TEST(call(directory, "check" + scene + "--record " + file).exit == 0);
    const std::string recorded = directory.read("base.json");
    BOOST_TEST(has(recorded, "work_precision.BDF2.theta_L2L2_sq: error at s = 8, dt = 0.25"));
    BOOST_TEST(!has(recorded, "seconds"));
    BOOST_TEST(call(directory, "check" + scene + "--baseline " + file).exit == 0);
    const Called failing =
        call(directory, "check" + scene + "--set beam.alpha=1e200 --baseline " + file);
    BOOST_TEST(failing.exit == 3);
    BOOST_TEST(has(failing.output, "a run failed: "));
}

BOOST_AUTO_TEST_SUITE_END()

// A scene in shards: what a merge writes is what one run writes, whatever happened on the way.

#include "reports/files/line_file.hpp"
#include "tests/command_line/called_program.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(shards)

namespace {

using Json = nlohmann::ordered_json;

const std::string stress = "title = \"many\"\n[report]\nfiles = [\"json\", \"csv\"]\n"
                           "[stress.sweep.a]\nalpha = [0.0, 1.0, 10.0, 1e300]\n"
                           "elements = [2, 8, 16]\ndt = [1e-3, 1e-2]\nsteps = 20\n"
                           "sampling = \"product\"\n"
                           "[stress.contraction]\nalpha = { from = 0.1, to = 10.0, count = 3 }\n"
                           "dt = { from = 1e-3, to = 1.0, count = 4 }\n"
                           "[stress.roundoff]\nelements = [10, 40]\n";

const std::string orders =
    "title = \"orders\"\nsolution = \"cubic-deflection\"\n[report]\nfiles = [\"json\", \"csv\"]\n"
    "[beam]\nalpha = 0.3\nzeta = 0.1\nstops = [-0.02, 0.1]\n"
    "[ladder]\nfinal_time = 1.0\nelements = [4, 8, 16]\ndt = \"0.1/s\"\n"
    "norms = [\"theta_L2L2\", \"u_LinfH2semi\"]\n"
    "[orders]\nfinal_time = 1.0\nelements = [4, 6, 8, 12]\ndt = [0.02, 0.01, 0.005]\n"
    "norms = [\"theta_L2L2\"]\n"
    "[evolution]\nfinal_time = 0.5\nelements = 8\ndt = 0.01\nprobes = [\"u@1\"]\n";

const std::string defective = orders + "[defect]\nheat_source = \"x*(1 - x)/10\"\n";

const std::string solver =
    "title = \"a program\"\n[report]\nfiles = [\"json\", \"csv\"]\n"
    "[solver]\ncommand = [\"awk\", \"BEGIN { print 3/{elements}^2 + {dt} }\"]\n"
    "[solver.errors]\nL2 = '([0-9.e+-]+)'\n"
    "[ladder]\nfinal_time = 1.0\nelements = [10, 20, 40]\ndt = [0.1, 0.05, 0.025]\n"
    "norms = [\"L2\"]\n";

/// Without what differs between any two runs.
Json without_times(Json json) {
    if (json.is_object()) {
        for (const char* key : {"seconds", "provenance", "seconds_per_run", "cost"})
            json.erase(key);
        for (auto& [key, value] : json.items())
            value = without_times(value);
    } else if (json.is_array()) {
        for (auto& value : json)
            value = without_times(value);
    }
    return json;
}

Json result_in(const TemporaryDirectory& directory, const std::string& out) {
    return without_times(Json::parse(directory.read(out + "/result.json")));
}

std::string out(const TemporaryDirectory& directory, const std::string& name) {
    return " --quiet --out " + (directory.path() / name).string();
}

void run_shards(const TemporaryDirectory& directory, const std::string& scene,
                const std::vector<int>& numbers, int of) {
    for (const int number : numbers) {
        const Called shard =
            call(directory, "run " + scene + out(directory, "parts") + " --shard " +
                                std::to_string(number) + "/" + std::to_string(of));
        BOOST_TEST(shard.exit == 0, shard.errors);
        BOOST_TEST(shard.output.empty());
    }
}

Called merge(const TemporaryDirectory& directory, const std::string& options = "") {
    return call(directory, "merge " + (directory.path() / "parts").string() + options);
}

} // namespace

BOOST_DATA_TEST_CASE(a_merge_gives_what_one_run_gives_bit_for_bit,
                     data::make({stress, orders, defective, solver}) * data::make({1, 3, 7}), text,
                     of) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("scene.toml", text);
    const Called whole = call(directory, "run " + scene + out(directory, "whole"));
    BOOST_TEST(whole.exit == 0, whole.errors);
    std::vector<int> numbers;
    for (int number = of; number >= 1; --number)
        numbers.push_back(number);
    run_shards(directory, scene, numbers, of);
    const Called merged = merge(directory);
    BOOST_TEST(merged.exit == 0, merged.errors);
    BOOST_TEST(!merged.output.empty());
    BOOST_TEST(result_in(directory, "parts") == result_in(directory, "whole"));
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_said_and_made_by_the_command_that_is_named) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("scene.toml", stress);
    run_shards(directory, scene, {1, 4}, 4);
    const Called status = merge(directory, " --status");
    BOOST_TEST(status.exit == 3);
    BOOST_TEST(has(status.output, "for I in 2 3; do tvbeam run "), status.output);
    BOOST_TEST(has(status.output, "(of an array of jobs: 2-3)"), status.output);
    // Part of the shards: what is there is written, and it is said.
    const Called part = merge(directory, " --quiet");
    BOOST_TEST(part.exit == 3);
    BOOST_TEST(has(part.errors, "of 4 shards 2 are not whole (2-3)"), part.errors);
    const Json json = result_in(directory, "parts");
    BOOST_TEST(json.at("interrupted") == true);
    const std::size_t there = json.at("stress").at("cases").size();
    BOOST_TEST(there > 0U);
    BOOST_TEST(there < 24U);
    run_shards(directory, scene, {2, 3}, 4);
    BOOST_TEST(merge(directory, " --status").exit == 0);
    BOOST_TEST(merge(directory).exit == 0);
    BOOST_TEST(result_in(directory, "parts").at("stress").at("cases").size() == 24U);
}

BOOST_AUTO_TEST_CASE(a_shard_that_is_started_again_makes_only_what_it_lacks) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("scene.toml", stress);
    run_shards(directory, scene, {1}, 2);
    const std::string file = "parts/shard-1-of-2.jsonl";
    const std::string whole = directory.read(file);
    // Half of the last line, and a line in the middle that two programs have mixed.
    std::string text = whole.substr(0, whole.size() - 20);
    text.insert(text.find('\n', text.find('\n') + 1) + 40, "{\"crc\":\"0123");
    directory.write(file, text);
    const Called again =
        call(directory,
             "run " + scene + " --out " + (directory.path() / "parts").string() + " --shard 1/2");
    BOOST_TEST(again.exit == 0, again.errors);
    BOOST_TEST(has(again.errors, "2 lines, from line 3 on, are not whole and are left out"),
               again.errors);
    const std::string mended = directory.read(file);
    BOOST_TEST(mended.starts_with(text));
    BOOST_TEST(std::count(mended.begin() + static_cast<std::ptrdiff_t>(text.size()), mended.end(),
                          '\n') == 4); // the end of the half line, a head, and two results
    run_shards(directory, scene, {1, 2}, 2);
    BOOST_TEST(directory.read(file) == mended);
    BOOST_TEST(merge(directory, " --quiet").exit == 0);
}

BOOST_AUTO_TEST_CASE(a_run_of_a_program_that_failed_is_made_again) {
    const TemporaryDirectory directory;
    const std::string flag = (directory.path() / "mended").string();
    const std::string scene = directory.write(
        "scene.toml", "title = \"a program\"\n"
                      "[solver]\ncommand = [\"sh\", \"-c\", \"[ {elements} != 20 ] || [ -e " +
                          flag +
                          " ] || exit 7; awk 'BEGIN {{ print 3/{elements}^2 }}'\"]\n"
                          "[solver.errors]\nL2 = '([0-9.e+-]+)'\n"
                          "[ladder]\nfinal_time = 1.0\nelements = [10, 20, 40]\ndt = [0.1, 0.1, "
                          "0.1]\nnorms = [\"L2\"]\n");
    const std::string shard =
        "run " + scene + " --out " + (directory.path() / "parts").string() + " --shard 1/1";
    const Called failing = call(directory, shard);
    BOOST_TEST(failing.exit == 3);
    BOOST_TEST(merge(directory, " --status").exit == 3);
    const std::string status = merge(directory, " --status").output;
    BOOST_TEST(has(status, "all          3          3          0          1"), status);
    BOOST_TEST(has(status, "what failed is made again by\n  tvbeam run "), status);
    std::filesystem::create_directory(flag); // a file's contents are part of the program's state
    const Called mended = call(directory, shard);
    BOOST_TEST(mended.exit == 0, mended.errors);
    BOOST_TEST(has(mended.errors, "goes on with 2 finished runs"), mended.errors);
    BOOST_TEST(merge(directory, " --quiet").exit == 0);
    const Json rungs = result_in(directory, "parts").at("ladder").at("rungs");
    BOOST_TEST(rungs.at(1).at("errors").at("L2").get<double>() == 3.0 / 400.0);
}

BOOST_AUTO_TEST_CASE(a_shard_whose_run_failed_is_no_finished_one_when_it_is_started_again) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write(
        "scene.toml", "title = \"grows beyond doubles\"\nsolution = \"copetti-fernandez-2011\"\n"
                      "[beam]\nalpha = 1e200\nzeta = 0.1\nstops = [-0.02, 0.1]\n"
                      "[ladder]\nfinal_time = 0.5\nelements = [4, 8]\ndt = \"0.1/s\"\n"
                      "norms = [\"theta_L2L2\"]\n");
    const std::string shard = "run " + scene + out(directory, "parts") + " --shard 1/1";
    for (int time = 0; time < 2; ++time) {
        const Called failing = call(directory, shard);
        BOOST_TEST(failing.exit == 3);
        BOOST_TEST(has(failing.errors, "of the runs of shard 1/1 failed"), failing.errors);
    }
    BOOST_TEST(
        has(merge(directory, " --status").output, "what failed is made again by\n  tvbeam run "));
}

// Without viscosity so strong a coupling leaves the energy law: the case fails its certificate.
BOOST_AUTO_TEST_CASE(a_shard_with_a_case_that_failed_says_so) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write(
        "scene.toml", "title = \"too strong\"\n[stress.sweep.a]\nalpha = [1e12]\nzeta = [0.0]\n"
                      "dt = [1e-300]\nelements = [1]\ngap = [1e-3]\nsides = [\"upper\"]\n"
                      "load = [1e150]\ninitial = [\"rough\"]\ntheta_A = [-1e150]\n"
                      "thermal_mass = [\"lumped\"]\n");
    const std::string run = "run " + scene + out(directory, "parts");
    BOOST_TEST(call(directory, run + " --quiet").exit == 3);
    const Called shard = call(directory, run + " --shard 1/1");
    BOOST_TEST(shard.exit == 3);
    BOOST_TEST(has(shard.errors, "of the runs of shard 1/1 failed"), shard.errors);
}

// 1e6 elements in 1e7 steps are a day's work, which is one shard's.
BOOST_AUTO_TEST_CASE(the_shard_that_takes_too_long_is_refused_and_no_other) {
    const TemporaryDirectory directory;
    const std::string scene =
        directory.write("scene.toml", "title = \"heavy\"\nsolution = \"cubic-deflection\"\n"
                                      "[beam]\nalpha = 0.3\nzeta = 0.1\nstops = [-0.02, 0.1]\n"
                                      "[ladder]\nfinal_time = 1.0\nelements = [4, 8, 1000000]\n"
                                      "dt = [0.1, 0.1, 1e-7]\nnorms = [\"theta_L2L2\"]\n");
    run_shards(directory, scene, {2, 3}, 3);
    const Called heavy = call(directory, "run " + scene + out(directory, "parts") + " --shard 1/3");
    BOOST_TEST(heavy.exit == 2);
    BOOST_TEST(has(heavy.errors, "--yes-really-long"), heavy.errors);
    const Called status = merge(directory, " --status");
    BOOST_TEST(has(status.output, "--shard 1/3 --yes-really-long\n"), status.output);
    const Called part = merge(directory, " --quiet");
    BOOST_TEST(part.exit == 3);
    BOOST_TEST(has(part.errors, "of 3 shards 1 is not whole (1)"), part.errors);
    BOOST_TEST(has(call(directory, "shard-script " + scene + " 3 --parallel").output,
                   "--quiet --yes-really-long\n"));
}

BOOST_AUTO_TEST_CASE(a_file_without_a_whole_line_is_a_shard_that_is_to_be_made) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("scene.toml", stress);
    run_shards(directory, scene, {1, 2}, 2);
    const std::string file = "parts/shard-1-of-2.jsonl";
    for (const std::string& text : {std::string(), directory.read(file).substr(0, 100)}) {
        directory.write(file, text);
        const Called status = merge(directory, " --status");
        BOOST_TEST(status.exit == 3);
        BOOST_TEST(has(status.output, "--shard 1/2\n"), status.output << status.errors);
        run_shards(directory, scene, {1}, 2);
        BOOST_TEST(merge(directory, " --quiet").exit == 0);
    }
    // What is no file at all is not waited for.
    std::filesystem::remove(directory.path() / file);
    const Called pipe = call(directory, "merge " + (directory.path() / "parts").string(),
                             "mkfifo " + (directory.path() / file).string() + " && ");
    BOOST_TEST(pipe.exit == 2);
    BOOST_TEST(has(pipe.errors, "shard-1-of-2.jsonl"), pipe.errors);
}

BOOST_AUTO_TEST_CASE(a_result_of_many_cases_has_their_totals_and_keeps_to_the_schema) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write(
        "scene.toml",
        "title = \"many\"\n[report]\nfiles = [\"json\", \"csv\"]\n"
        "[stress.sweep.a]\nalpha = [0.1, 1.0]\nload = [1.0, 2.0]\nelements = [2]\ndt = [1e-3]\n"
        "steps = 1\nsampling = \"sobol\"\npoints = 20001\n");
    BOOST_TEST(call(directory, "run " + scene + out(directory, "whole")).exit == 0);
    const Json result = result_in(directory, "whole").at("stress");
    BOOST_TEST(result.at("certified").get<int>() == 20001);
    BOOST_TEST(result.at("cases").empty());
    BOOST_TEST(has(result.at("cases_left_out").get<std::string>(), "20001 cases"));
    const std::string rows = directory.read("whole/stress.csv");
    BOOST_TEST(std::count(rows.begin(), rows.end(), '\n') == 20002);
    const std::string validate = "python3 -W ignore -m jsonschema " TVBEAM_SCHEMA;
    if (std::system("python3 -c 'import jsonschema' 2>/dev/null") == 0)
        BOOST_TEST(
            std::system(
                (validate + " -i " + (directory.path() / "whole/result.json").string()).c_str()) ==
            0);
}

BOOST_AUTO_TEST_CASE(two_programs_with_one_shard_lose_nothing) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("scene.toml", stress);
    call(directory, "run " + scene + out(directory, "whole"));
    const std::string both = "run " + scene + out(directory, "parts") + " --shard 1/1";
    const Called called = call(directory, both, tvbeam_binary + " " + both + " & wait $!; ");
    BOOST_TEST(called.exit == 0, called.errors);
    BOOST_TEST(merge(directory, " --quiet").exit == 0);
    BOOST_TEST(result_in(directory, "parts") == result_in(directory, "whole"));
}

BOOST_AUTO_TEST_CASE(shards_that_do_not_belong_together_are_refused_with_the_difference) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("scene.toml", stress);
    run_shards(directory, scene, {1, 2}, 2);
    const std::string file = "parts/shard-2-of-2.jsonl";
    const std::string kept = directory.read(file);
    const auto refused = [&](const std::string& message) {
        const Called called = merge(directory);
        BOOST_TEST(called.exit == 2);
        BOOST_TEST(has(called.errors, message), called.errors << " lacks " << message);
        BOOST_TEST(called.output.empty());
    };
    const std::string first_line = kept.substr(0, kept.find('\n'));
    for (const auto& [key, value, message] :
         std::vector<std::tuple<std::string, Json, std::string>>{
             {"/of/build/flags", "-O1", "another build of tvbeam (flags)"},
             {"/of/processor/kernel", "none", "another kind of processor (kernel)"},
             {"/of/scene/stress/sweep/a/steps", 21, "another scene (stress/sweep/a/steps)"},
             {"/schema", "tvbeam-work/0", "its schema is not tvbeam-work/1"}}) {
        Json head = Json::parse(first_line);
        head.erase("crc");
        head[Json::json_pointer(key)] = value;
        directory.write(file, sealed(head.dump()) + kept.substr(kept.find('\n')));
        refused(message);
    }
    for (const char* wrong : {"7\n8\n", "7\n8"}) { // also where the last line may have been cut
        directory.write(file, wrong);
        refused("is not what tvbeam wrote: line 1: it is not whole");
    }
    directory.write(file, kept);
    // The scene's file has changed since; or has gone.
    directory.write("scene.toml", stress + "# the same\n");
    BOOST_TEST(merge(directory, " --quiet").exit == 0);
    directory.write("scene.toml", stress + "[stress.sweep.b]\nalpha = [1.0]\n");
    refused("another scene (stress/sweep/b)");
    std::filesystem::rename(scene, directory.path() / "moved.toml");
    refused("--scene names it where it stands elsewhere");
    directory.write("moved.toml", stress);
    BOOST_TEST(
        merge(directory, " --quiet --scene " + (directory.path() / "moved.toml").string()).exit ==
        0);
    directory.write("parts/shard-1-of-3.jsonl", kept);
    refused("holds parts of 2 and parts of 3 shards");
}

BOOST_AUTO_TEST_CASE(what_is_no_shard_is_refused_before_anything_runs) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("scene.toml", stress);
    const std::string started = "run " + scene + out(directory, "parts");
    for (const auto& [arguments, first, message] : std::vector<std::array<std::string, 3>>{
             {started + " --shard 3/2", "", "has no part of 1 to 2 before the /"},
             {started + " --shard 0/2", "", "has no part of 1 to 2 before the /"},
             {started + " --shard 2", "", "write I/N, such as 3/100"},
             {started + " --shard 1/0", "", "write I/N, such as 3/100"},
             {started + " --shard auto/2", "unset SLURM_ARRAY_TASK_ID; ", "which is not set"},
             {started + " --shard auto/2", "SLURM_ARRAY_TASK_ID=3 ", "which is '3'; it must be 1"},
             {"run " + scene + " --shard 1/2", "", "--out"},
             {started + " --shard 1/2 --json x.json", "", "--json"},
             {started + " --shard 1/2 --set stress.sweep.a.steps=2,3", "", "name one value"},
             {"run table1-work-precision" + out(directory, "parts") + " --shard 1/2", "",
              "times its runs in [work_precision]"},
             {"run figure1" + out(directory, "parts") + " --shard 1/2", "",
              "no runs that could be made apart"}}) {
        const Called called = call(directory, arguments, first);
        BOOST_TEST(called.exit == 2, arguments);
        BOOST_TEST(has(called.errors, message), called.errors << " lacks " << message);
    }
    BOOST_TEST(!std::filesystem::exists(directory.path() / "parts"));
    const Called by_array = call(directory, started + " --shard auto/2", "SLURM_ARRAY_TASK_ID=2 ");
    BOOST_TEST(by_array.exit == 0, by_array.errors);
    BOOST_TEST(std::filesystem::exists(directory.path() / "parts" / "shard-2-of-2.jsonl"));
}

BOOST_AUTO_TEST_CASE(a_script_asks_for_what_is_predicted_and_runs) {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("a scene.toml", stress);
    const std::string script =
        "shard-script '" + scene + "' 3 --out '" + (directory.path() / "parts").string() + "'";
    // No cluster, one that counts no memory, and one that has too little.
    const auto with_nodes_of = [&](const std::string& megabytes) {
        const std::string sinfo = directory.write("sinfo", "#!/bin/sh\n[ -n '" + megabytes +
                                                               "' ] && echo '" + megabytes + "'\n");
        std::filesystem::permissions(sinfo, std::filesystem::perms::owner_all);
        return call(directory, script + " --slurm",
                    "PATH=" + directory.path().string() + ":$PATH ");
    };
    BOOST_TEST(has(with_nodes_of("1").output, "counts no memory"));
    BOOST_TEST(has(with_nodes_of("64000+").output, "#SBATCH --mem="));
    const Called too_small = with_nodes_of("100");
    BOOST_TEST(too_small.exit == 2);
    BOOST_TEST(has(too_small.errors, "no node of this cluster has more than 100 MB"));
    const Called slurm = with_nodes_of("");
    BOOST_TEST(slurm.exit == 0, slurm.errors);
    for (const char* line :
         {"#SBATCH --array=1-3\n", "#SBATCH --mem=", "#SBATCH --time=", "auto/3 --quiet\n"})
        BOOST_TEST(has(slurm.output, line), slurm.output);
    BOOST_TEST(call(directory, script).exit == 2);
    // As the scheduler runs it, one member after another.
    directory.write("job.sh", slurm.output);
    const std::string path = "PATH=" + std::filesystem::path(tvbeam_binary).parent_path().string() +
                             ":$PATH; export PATH; ";
    const Called done = call(directory, "--version",
                             path + "for i in 1 2 3; do SLURM_ARRAY_TASK_ID=$i sh " +
                                 (directory.path() / "job.sh").string() + "; done; ");
    BOOST_TEST(done.errors.empty(), done.errors);
    BOOST_TEST(merge(directory, " --status").exit == 0);
}

// A program takes what its time-out allows, run by run; without one nobody knows. A reference is
// made by every shard, so that more shards do not make it cheaper.
BOOST_AUTO_TEST_CASE(a_script_asks_for_the_heaviest_shard) {
    const TemporaryDirectory directory;
    const auto script = [&](const std::string& text, int shards, const std::string& scheduler) {
        const std::string scene = directory.write("scene.toml", text);
        const Called called = call(directory, "shard-script " + scene + " " +
                                                  std::to_string(shards) + " " + scheduler);
        BOOST_TEST(called.exit == 0, called.errors);
        return called.output;
    };
    BOOST_TEST(has(script(solver, 2, "--slurm"), "How long the program takes is not known"));
    BOOST_TEST(has(script(solver, 2, "--slurm"), "What memory the program takes is not known"));
    BOOST_TEST(!has(script(solver, 2, "--slurm"), "\n#SBATCH --mem="));
    std::string timed = solver;
    timed.insert(timed.find("[solver.errors]"), "timeout = 90\n");
    // Three runs in two shards: two of 90 s, and one minute more.
    BOOST_TEST(has(script(timed, 2, "--slurm"), "#SBATCH --time=4\n"));
    BOOST_TEST(has(script(timed, 3, "--slurm"), "#SBATCH --time=3\n"));
    const std::string parallel = script(timed, 2, "--parallel");
    BOOST_TEST(has(parallel, "# Each job takes up to 4 minutes. What memory the program takes is "
                             "not known;"),
               parallel);
    BOOST_TEST(has(parallel, "seq 2 | parallel -q tvbeam "), parallel);
    const std::string of_beam = script("solution = \"free-decay\"\n[beam]\nalpha = 0.1\nzeta = "
                                       "0.1\n[ladder]\nfinal_time = 1.0\nelements = [4, 8]\n"
                                       "dt = [0.1, 0.05]\nnorms = [\"theta_L2L2\"]\n",
                                       2, "--parallel");
    BOOST_TEST(has(of_beam, " MB and 2 minutes."), of_beam);
    BOOST_TEST(has(of_beam, "seq 2 | parallel -q --memfree 2"), of_beam);
    // 2e5 x 5e4 steps of elements of the reference, 100 s: ten times that and one minute more.
    const std::string reference =
        "title = \"of a reference\"\n[beam]\nalpha = 0.1\nzeta = 0.1\nstops = [-1.0, 1.0]\n"
        "[data]\ntheta0 = \"x*(1 - x)\"\n[ladder]\nfinal_time = 0.1\nelements = [4, 8]\n"
        "dt = [0.01, 0.01]\nnorms = [\"theta_L2L2\"]\n"
        "[reference]\nelements = 200000\ndt = 2e-6\n";
    for (const int shards : {1, 2})
        BOOST_TEST(has(script(reference, shards, "--slurm"), "#SBATCH --time=18\n"),
                   script(reference, shards, "--slurm"));
}

BOOST_AUTO_TEST_CASE(a_scene_that_is_named_from_beside_it_is_found_from_anywhere) {
    const TemporaryDirectory directory;
    directory.write("mine.toml", solver);
    const std::string there = "cd " + directory.path().string() + " && ";
    const Called made = call(directory, "run mine.toml --quiet --shard 1/1 --out parts", there);
    BOOST_TEST(made.exit == 0, made.errors);
    const Called merged =
        call(directory, "merge " + (directory.path() / "parts").string(), "cd / && ");
    BOOST_TEST(merged.exit == 0, merged.errors);
}

BOOST_AUTO_TEST_SUITE_END()

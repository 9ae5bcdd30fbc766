// What happens to files, the terminal and the first Ctrl-C where something goes wrong. That any
// call of the system may fail is tested by tests/faults.

#include "tests/command_line/called_program.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>

#include <unistd.h>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(faults)

namespace {

std::string scene(const std::string& more) {
    return "solution = \"copetti-fernandez-2011\"\n" + more +
           "\n[beam]\nalpha = 0.017\nzeta = 0.1\nstops = [-0.02, 0.1]\n"
           "[ladder]\nfinal_time = 0.5\nelements = [4, 8]\ndt = \"0.1/s\"\n"
           "norms = [\"theta_L2L2_sq\"]\n[report]\nfiles = [\"plots\", \"html\"]\n";
}

/// A name as those of the program's temporary files.
std::string temporary_of(long process) {
    std::array<char, 65> host{};
    gethostname(host.data(), host.size() - 1);
    return std::string(".tvbeam-") + host.data() + "-" + std::to_string(process) + "-0";
}

/// No process has such a number: Linux counts up to 2^22.
constexpr long nobody = 1 << 23;

/// Before the program, which is asked to end after a while, and killed where that is not heard:
/// 137.
std::string asked_to_end(const std::string& signal, const std::string& after) {
    return "timeout -k 10 -s " + signal + " " + after + " ";
}
constexpr int heard = 124;

} // namespace

// gnuplot, whose disk is full, exits with 0.
BOOST_AUTO_TEST_CASE(half_a_picture_is_left_out_with_a_sentence) {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "bin");
    const std::string gnuplot =
        directory.write("bin/gnuplot", "#!/bin/sh\ntrap '' XFSZ\nulimit -f 16\n"
                                       "PATH=${PATH#*:}\nexec gnuplot \"$@\"\n");
    std::filesystem::permissions(gnuplot, std::filesystem::perms::owner_all);
    const std::string run = "run " + directory.write("scene.toml", scene("")) + " --quiet --out " +
                            (directory.path() / "r").string();
    BOOST_TEST(call(directory, run).exit == 0);
    BOOST_TEST(has(directory.read("r/report.html"), "</svg>"));
    const Called called =
        call(directory, run, "PATH=" + (directory.path() / "bin").string() + ":$PATH ");
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(has(called.errors, "gnuplot wrote only a part of convergence.svg"), called.errors);
    BOOST_TEST(has(called.errors, "the pictures are left out"), called.errors);
    const std::string page = directory.read("r/report.html");
    BOOST_TEST(page.ends_with("</html>\n"));
    BOOST_TEST(!has(page, "<svg"));
    BOOST_TEST(!std::filesystem::exists(directory.path() / "r/plots/convergence.svg"));
    BOOST_TEST(!std::filesystem::exists(directory.path() / "r/plots/convergence.png"));
}

BOOST_AUTO_TEST_CASE(what_gnuplot_complains_of_is_said) {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "bin");
    std::filesystem::permissions(
        directory.write("bin/gnuplot", "#!/bin/sh\necho 'no terminal of this kind' >&2\nexit 1\n"),
        std::filesystem::perms::owner_all);
    const Called called = call(directory,
                               "run " + directory.write("scene.toml", scene("")) +
                                   " --quiet --out " + (directory.path() / "r").string(),
                               "PATH=" + (directory.path() / "bin").string() + ":$PATH ");
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(has(called.errors, "gnuplot failed on convergence.gp: no terminal of this kind"),
               called.errors);
}

BOOST_AUTO_TEST_CASE(a_gnuplot_that_is_killed_has_failed) {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "bin");
    std::filesystem::permissions(directory.write("bin/gnuplot", "#!/bin/sh\nkill -9 $$\n"),
                                 std::filesystem::perms::owner_all);
    const Called called = call(directory,
                               "run " + directory.write("scene.toml", scene("")) +
                                   " --quiet --out " + (directory.path() / "r").string(),
                               "PATH=" + (directory.path() / "bin").string() + ":$PATH ");
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(has(called.errors, "gnuplot failed on convergence.gp"), called.errors);
}

// Of a page alone no scripts are written.
BOOST_AUTO_TEST_CASE(scripts_of_pictures_are_named_where_there_are_some) {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "bin");
    std::filesystem::permissions(directory.write("bin/gnuplot", "#!/bin/sh\nexit 1\n"),
                                 std::filesystem::perms::owner_all);
    const std::string run = "run " + directory.write("scene.toml", scene("")) + " --quiet --out " +
                            (directory.path() / "r").string();
    const std::string ending = "PATH=" + (directory.path() / "bin").string() + ":$PATH ";
    const Called page = call(directory, run + " --set \"report.files=['html']\"", ending);
    BOOST_TEST(has(page.errors, "the pictures are left out\n"), page.errors);
    BOOST_TEST(!std::filesystem::exists(directory.path() / "r/plots"));
    const Called both = call(directory, run, ending);
    BOOST_TEST(has(both.errors, "their scripts and data are in '"), both.errors);
    BOOST_TEST(std::filesystem::exists(directory.path() / "r/plots/convergence.gp"));
}

// Its pictures are drawn by the same command, which goes on from the runs that are kept.
BOOST_AUTO_TEST_CASE(a_run_that_is_asked_to_end_while_it_draws_was_interrupted) {
    const TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "bin");
    std::filesystem::permissions(
        directory.write("bin/gnuplot", "#!/bin/sh\nkill -TERM $PPID\nsleep 10\n"),
        std::filesystem::perms::owner_all);
    const std::string run = "run " + directory.write("scene.toml", scene("")) + " --quiet --out " +
                            (directory.path() / "r").string();
    const std::string ending = "PATH=" + (directory.path() / "bin").string() + ":$PATH ";
    const Called called = call(directory, run, ending);
    BOOST_TEST(called.exit == 3);
    BOOST_TEST(has(called.errors, "the pictures are left out"), called.errors);
    BOOST_TEST(has(called.errors, "interrupted; the result holds what was finished; --resume"),
               called.errors);
    const Called resumed = call(directory, run + " --resume");
    BOOST_TEST(resumed.exit == 0, resumed.errors);
    BOOST_TEST(std::filesystem::exists(directory.path() / "r/plots/convergence.svg"));
    BOOST_TEST(!std::filesystem::exists(directory.path() / "r/unfinished.jsonl"));
    // The table of a sweep, and what shards have made.
    BOOST_TEST(call(directory, run + "s --set beam.alpha=0.1,0.2", ending).exit == 3);
    BOOST_TEST(call(directory, run + "m --shard 1/1").exit == 0);
    BOOST_TEST(
        call(directory, "merge --quiet " + (directory.path() / "rm").string(), ending).exit == 3);
}

BOOST_DATA_TEST_CASE(reading_ends_at_the_first_signal, data::make({"INT", "TERM", "HUP"}), signal) {
    const TemporaryDirectory directory;
    const std::string fifo = (directory.path() / "fifo.toml").string();
    for (const std::string& arguments :
         {"run " + fifo, "derive " + fifo, "analyse " + fifo, "check " + fifo}) {
        const Called called =
            call(directory, arguments,
                 "rm -f " + fifo + "; mkfifo " + fifo + "; " + asked_to_end(signal, "0.3"));
        BOOST_TEST(called.exit == heard, arguments << ": " << called.errors);
        BOOST_TEST(called.output.empty());
    }
}

BOOST_AUTO_TEST_CASE(nobody_waits_for_what_a_scene_names) {
    const TemporaryDirectory directory;
    std::string text = scene("");
    text.replace(text.find("copetti-fernandez-2011"), 22, "./fifo.toml");
    const Called called =
        call(directory, "run " + directory.write("scene.toml", text),
             "mkfifo " + (directory.path() / "fifo.toml").string() + "; timeout 60 ");
    BOOST_TEST(called.exit == 2, called.errors);
    BOOST_TEST(has(called.errors, "fifo.toml' is no regular file"), called.errors);
    BOOST_TEST(called.output.empty());
}

// A million elements take far longer to set up than the program has.
BOOST_AUTO_TEST_CASE(a_run_that_is_being_set_up_ends_at_the_first_signal) {
    const TemporaryDirectory directory;
    const std::string out = (directory.path() / "out").string();
    for (const std::string basis : {"nodal", "automatic"}) {
        const Called called =
            call(directory,
                 "run " + directory.write("scene.toml", scene("")) +
                     " --yes-really-long --set 'ladder.elements=[4, 3000000]' --set scheme.basis=" +
                     basis + " --out " + out + basis,
                 asked_to_end("INT", "1.5"));
        BOOST_TEST(called.exit == heard, called.errors);
        BOOST_TEST(has(called.errors, "tvbeam: interrupted"), called.errors);
        BOOST_TEST(has(called.errors, "--resume goes on"), called.errors);
        BOOST_TEST(has(directory.read("out" + basis + "/unfinished.jsonl"), "\"elements\":4"));
    }
}

BOOST_AUTO_TEST_CASE(what_a_killed_run_left_goes_with_the_next) {
    const TemporaryDirectory directory;
    for (const std::string folder : {"out", "out/plots", "tmp"})
        std::filesystem::create_directory(directory.path() / folder);
    const std::string left = temporary_of(nobody);
    const std::string used = temporary_of(getpid());
    for (const std::string& file :
         {"out/" + left, "out/plots/" + left, "out/" + used, "out/.tvbeam-elsewhere-" + left})
        directory.write(file, "half a res");
    std::filesystem::create_directory(directory.path() / "tmp" / left);
    directory.write("tmp/" + left + "/convergence.gp", "");
    const Called called = call(directory,
                               "run " + directory.write("scene.toml", scene("")) +
                                   " --quiet --out " + (directory.path() / "out").string(),
                               "TMPDIR=" + (directory.path() / "tmp").string() + " ");
    BOOST_TEST(called.exit == 0);
    BOOST_TEST(!std::filesystem::exists(directory.path() / "out" / left));
    BOOST_TEST(!std::filesystem::exists(directory.path() / "out/plots" / left));
    BOOST_TEST(std::filesystem::is_empty(directory.path() / "tmp"));
    BOOST_TEST(std::filesystem::exists(directory.path() / "out" / used));
    BOOST_TEST(std::filesystem::exists(directory.path() / ("out/.tvbeam-elsewhere-" + left)));
}

BOOST_AUTO_TEST_CASE(a_file_without_end_is_refused) {
    const TemporaryDirectory directory;
    const std::string file = directory.write("scene.toml", scene(""));
    for (const std::string& arguments :
         {std::string("run /dev/zero"), std::string("derive /dev/zero"),
          std::string("analyse /dev/zero"), std::string("analyse - </dev/zero"),
          "check " + file + " --baseline /dev/zero"}) {
        const Called called = call(directory, arguments);
        BOOST_TEST(called.exit == 2, arguments);
        BOOST_TEST(has(called.errors, "bytes that are read at most"), called.errors);
    }
    const Called is_directory = call(directory, "analyse " + directory.path().string());
    BOOST_TEST(is_directory.exit == 2);
    BOOST_TEST(has(is_directory.errors, "is a directory"), is_directory.errors);
}

BOOST_AUTO_TEST_CASE(a_long_name_is_written_to_or_refused_before_anything_runs) {
    const TemporaryDirectory directory;
    const std::string run = "run " + directory.write("scene.toml", scene("")) + " --json ";
    for (const std::size_t length : {249U, 255U}) {
        const std::string name(length, 'a');
        BOOST_TEST(call(directory, run + (directory.path() / name).string()).exit == 0);
        BOOST_TEST(directory.read(name).ends_with("}\n"));
    }
    const Called called =
        call(directory, run + (directory.path() / std::string(256, 'a')).string());
    BOOST_TEST(called.exit == 2);
    BOOST_TEST(has(called.errors, "File name too long"), called.errors);
    BOOST_TEST(called.output.empty());
}

// ESC, a title by OSC, and C1's CSI, as TOML writes them.
BOOST_AUTO_TEST_CASE(no_text_of_a_scene_or_name_of_a_file_reaches_the_terminal_as_an_order) {
    const TemporaryDirectory directory;
    const std::string title = "title = \"a\\u001b[31mb\\u001b]0;c\\u0007d\\u009b2Je\\u007f\"";
    const std::string name = "\033]0;x\007\302\2332J.toml";
    const std::string file = "\"" + directory.write(name, scene(title)) + "\"";
    const auto orders = [](const std::string& text) {
        return std::count_if(text.begin(), text.end(),
                             [](char c) { return (c >= 0 && c < ' ' && c != '\n') || c == 0x7f; }) +
               (has(text, "\302\233") ? 1 : 0);
    };
    const std::string missing = (directory.path() / "none").string();
    for (const std::string& arguments :
         {"run " + file, "run " + file + " --json -", "run " + file + " --set beam.zeta=-1",
          "check " + file, "derive " + file, "run \"" + missing + name + "\""}) {
        const Called called = call(directory, arguments);
        BOOST_TEST(!(called.output + called.errors).empty(), arguments);
        BOOST_TEST(orders(called.output) == 0, arguments << called.output);
        BOOST_TEST(orders(called.errors) == 0, arguments << called.errors);
    }
    BOOST_TEST(has(call(directory, "run " + file).output, "a\\x1B[31mb\\x1B]0;c\\x07d\\u009B2Je"));
}

BOOST_AUTO_TEST_SUITE_END()

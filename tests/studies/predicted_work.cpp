// What a scene will take is said before it runs, and beyond a bound it does not run unasked.

#include "studies/predicted_work.hpp"
#include "mms/solution.hpp"
#include "mms/text/input_error.hpp"
#include "studies/scene/shipped.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(predicted)

namespace {

const std::string beam = "solution = \"copetti-fernandez-2011\"\n"
                         "[beam]\nalpha = 0.017\nzeta = 0.1\nstops = [-0.02, 0.1]\n";

std::string ladder(const std::string& elements, const std::string& dt) {
    return beam + "[ladder]\nfinal_time = 1.0\nelements = " + elements + "\ndt = " + dt +
           "\nnorms = [\"theta_L2L2\"]\n";
}

Scene scene_of(const std::string& text) {
    const TemporaryDirectory directory;
    return read_scene(directory.write("scene.toml", text));
}

/// count times: of a list what stands for each number, of a file a block.
std::string repeated(int count, const std::function<std::string(int)>& text) {
    std::string all;
    for (int i = 0; i < count; ++i)
        all += text(i);
    return all;
}

std::string list(int count, const std::string& word) {
    return "[" + repeated(count, [&](int) { return word + ","; }) + "]";
}

} // namespace

BOOST_AUTO_TEST_CASE(no_shipped_scene_is_near_the_bounds) {
    for (const auto& file : shipped_files(Shipped::scene)) {
        const PredictedWork predicted = predicted_work(read_scene(file.path.string()));
        BOOST_TEST(predicted.seconds < longest_work / 10, file.name << ": " << predicted.text());
        BOOST_TEST(predicted.bytes < largest_work / 4, file.name << ": " << predicted.text());
    }
}

BOOST_AUTO_TEST_CASE(the_prediction_counts_what_the_scene_asks_for) {
    const PredictedWork two = predicted_work(scene_of(ladder("[10, 20]", "[0.1, 0.01]")));
    BOOST_TEST(two.runs == 2.0);
    BOOST_TEST(two.steps == 10.0 * 10.0 + 20.0 * 100.0);
    BOOST_TEST(two.text() == "2.1e+03 element steps in 2 runs, about 0.00042 s on one core and "
                             "1 MB");
    // A sweep of three couplings, one at a time beside each other; a map of 4 × 5 points.
    BOOST_TEST(predicted_work(scene_of("[stress.sweep.a]\nalpha = [0.1, 1, 10]\n")).runs == 3.0);
    BOOST_TEST(predicted_work(scene_of("[stress.contraction]\n"
                                       "alpha = { from = 1, to = 10, count = 4 }\n"
                                       "dt = { from = 1, to = 10, count = 5 }\n"))
                   .runs == 20.0);
}

// The quotient of these two factors is beyond the doubles; their decades are 600.
BOOST_AUTO_TEST_CASE(a_range_of_any_width_has_its_decades) {
    const Scene scene =
        scene_of(ladder("[8]", "[0.1]") + "[expect.ladder.theta_L2L2]\nerrors = [1]\n"
                                          "[sensitivity]\nrange = [1e-300, 1e300]\n"
                                          "[sensitivity.defect.f]\nheat_source = '1'\n");
    BOOST_TEST(predicted_work(scene).runs == 609.0);
}

BOOST_AUTO_TEST_CASE(what_takes_too_long_runs_only_if_it_says_so) {
    const auto refused = [](const std::string& text) {
        const Scene scene = scene_of(text);
        BOOST_CHECK_EXCEPTION(require_short_enough(scene, predicted_work(scene)), InputError,
                              [](const InputError& error) {
                                  const std::string what = error.what();
                                  return what.find("--yes-really-long, or long = true") !=
                                         std::string::npos;
                              });
    };
    const std::string years = ladder("[1000000]", "[1e-9]");
    refused(years); // time
    refused(ladder(list(900, "10000000"), list(900, "1.0"))
                .append("[evolution]\nfinal_time = 1.0\nelements = 4\ndt = 1.25e-8\n"
                        "probes = [\"u@1\"]\n")); // memory
    const Scene scene = scene_of("long = true\n" + years);
    BOOST_CHECK_NO_THROW(require_short_enough(scene, predicted_work(scene)));
}

namespace {

struct Large {
    std::string what;
    std::string text;
    std::string message;
};

std::ostream& operator<<(std::ostream& stream, const Large& large) {
    return stream << large.what;
}

const std::vector<Large> large_scenes{
    {"orders",
     beam + "[orders]\nfinal_time = 1.0\nelements = " + list(3000, "4") +
         "\ndt = " + list(3000, "0.1") + "\nnorms = [\"theta_L2L2\"]\n",
     "orders.dt has 3000 steps for 3000 meshes; a grid has at most 1000000 runs"},
    {"sweeps",
     repeated(3,
              [](int i) {
                  return "[stress.sweep.s" + std::to_string(i) +
                         "]\nsampling = \"sobol\"\npoints = 900000\nalpha = [1, 2]\n";
              }),
     "more than 2000000 cases, which all sweeps together may have"},
    {"levels", ladder(list(10001, "4"), "\"0.1\""), "at most 10000 are read"},
    {"probes",
     beam + "[evolution]\nfinal_time = 1.0\nelements = 4\ndt = 0.1\nprobes = [" +
         repeated(1001, [](int i) { return "\"u@0." + std::to_string(i + 1) + "\","; }) + "]\n",
     "an evolution has at most 1000"},
    {"a deep key", "a" + repeated(40000, [](int) { return ".a"; }) + " = 1\n",
     "scene.toml:1:64: a key has more than 32 parts"},
    {"a deep header", "x = \"]\"\n[a" + repeated(40000, [](int) { return ". 'a'"; }) + "]\n",
     "scene.toml:2:"},
    {"a deep value", "x = 1 # [[[\na = " + std::string(40000, '['),
     "scene.toml:2:37: values are nested more than 32 deep"},
};

} // namespace

BOOST_DATA_TEST_CASE(what_is_too_large_to_read_is_refused_at_its_place, data::make(large_scenes)) {
    BOOST_CHECK_EXCEPTION(scene_of(sample.text), InputError, [&](const InputError& error) {
        BOOST_TEST(std::string(error.what()).find(sample.message) != std::string::npos,
                   std::string(error.what()).substr(0, 200));
        return true;
    });
}

BOOST_AUTO_TEST_CASE(the_bounds_of_depth_leave_what_is_written_alone) {
    // Dots in strings, comments, numbers and many keys of a line are no depth.
    const std::string dots(60, '.');
    const Scene scene =
        scene_of("title = \"\"\"" + dots + "\"quoted\\\"\" [[[\n" + dots + "\"\"\" # " + dots +
                 "[[\n" + ladder(list(50, "4"), list(50, "0.25")));
    BOOST_TEST(scene.title.size() == 2 * dots.size() + 14);
    BOOST_CHECK_THROW(
        read_scene("table1", {"a" + repeated(40000, [](int) { return ".a"; }) + "=1"}), InputError);
}

BOOST_AUTO_TEST_CASE(a_solution_has_no_more_phases_and_parameters_than_can_be_derived) {
    const auto refused = [](const std::string& text, const std::string& message) {
        BOOST_CHECK_EXCEPTION(parse_solution(text, "my.toml"), InputError,
                              [&](const InputError& error) {
                                  BOOST_TEST(error.what() == message);
                                  return true;
                              });
    };
    const std::string zero = "theta = 0\nu = 0\n";
    refused(
        zero + repeated(1001,
                        [](int i) { return "[[phase]]\nuntil = " + std::to_string(i + 1) + "\n"; }),
        "my.toml:3:1: phase holds 1001 phases; a solution has at most 1000");
    refused(zero + "[parameters]\n" +
                repeated(1001, [](int i) { return "p" + std::to_string(i) + " = \"1\"\n"; }),
            "my.toml:3:1: parameters holds 1001; a solution has at most 1000");
}

// Far into a file, too, a mistake is told at its line and column.
BOOST_AUTO_TEST_CASE(places_far_into_a_file_are_right) {
    const std::string much = repeated(500, [](int i) {
        return "p" + std::to_string(i) + " = \"1\" # é and so on, for two kilobytes or more\n";
    });
    BOOST_CHECK_EXCEPTION(
        parse_solution("theta = 0\nu = 0\n[parameters]\n" + much + "q = { é = 1 }\n", "my.toml"),
        InputError, [](const InputError& error) {
            return std::string(error.what()).starts_with("my.toml:504:");
        });
    BOOST_CHECK_EXCEPTION(
        parse_solution("theta = 0\nu = 0\n[parameters]\n" + much + "z = \"1 + y\"\n", "my.toml"),
        InputError, [](const InputError& error) {
            BOOST_TEST(std::string(error.what()).starts_with("my.toml:504:"), error.what());
            return true;
        });
}

BOOST_AUTO_TEST_SUITE_END()

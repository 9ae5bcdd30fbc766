// [[expect.analyse]]: what a table of anyone's shows, held against what a scene says of it.

#include "mms/text/input_error.hpp"
#include "studies/gates/check.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(analysed_expectations)

namespace {

const std::string scene = "solution = 'free-oscillation'\n[beam]\nalpha = 0.3\nzeta = 0.05\n"
                          "stops = [-0.1, 0.1]\n[ladder]\nfinal_time = 1.0\nelements = [5]\n"
                          "dt = [0.1]\nnorms = ['theta_L2L2']\n[[expect.analyse]]\n";

/// n things that fill a volume, so that h = n^(-1/3), and an error h^2.
std::string cells() {
    std::string text = "cells,e,scatter\n";
    for (const int per_side : {4, 8, 16, 32}) {
        const double h = 1.0 / per_side;
        text += std::to_string(per_side * per_side * per_side) + "," + std::to_string(h * h) + "," +
                std::to_string(0.02 * h * h) + "\n";
    }
    return text;
}

std::vector<CheckedExpectation> checked(const std::string& lines) {
    const TemporaryDirectory directory;
    directory.write("cells.csv", cells());
    const auto file = directory.write("s.toml", scene + lines);
    return check(run_study(read_scene(file, {}, {.expectations = true})));
}

const std::string table = "file = 'cells.csv'\nsize = ['cells']\ndimension = 3\nerror = ['e']\n";

/// The half width of the order's interval that these lines let stand.
bool is_at_most(double half, const std::string& lines) {
    return checked(lines + "holds = 'e.order_half_width = [0, " + std::to_string(half) + "]'")
        .front()
        .holds;
}

} // namespace

BOOST_AUTO_TEST_CASE(orders_of_a_table_are_held_against_what_a_scene_says) {
    const auto right = checked(table + "holds = 'e = { order_holds = 2, order = [1.99, 2.01] }'");
    BOOST_REQUIRE(right.size() == 2U);
    BOOST_TEST(right[0].holds);
    BOOST_TEST(right[1].holds);
    const auto wrong = checked(table + "holds = 'e.order = [2.9, 3.1]'");
    BOOST_REQUIRE(wrong.size() == 1U);
    BOOST_TEST(!wrong[0].holds);
    BOOST_TEST(wrong[0].what == "analyse.0.holds, cells.csv: e: order in h");
    BOOST_TEST(wrong[0].place.line == 16);
    BOOST_TEST(wrong[0].place.file.ends_with("s.toml"));
}

BOOST_AUTO_TEST_CASE(what_the_columns_mean_is_what_the_scene_says) {
    // In the plane h = n^(-1/2): of what is n^(-2/3) the order is 4/3.
    const std::string plane =
        "file = 'cells.csv'\nsize = ['cells']\ndimension = 2\nerror = ['e']\n";
    BOOST_TEST(checked(plane + "holds = 'e.order_holds = 1.3333333'").front().holds);
    // As a value it goes to 0.
    const std::string value =
        "file = 'cells.csv'\nsize = ['cells']\ndimension = 3\nvalue = ['e']\n";
    BOOST_TEST(checked(value + "holds = 'e.limit_holds = 0'").front().holds);
    // A deviation of 2 % widens the interval.
    BOOST_TEST(is_at_most(0.03, table));
    BOOST_TEST(!is_at_most(0.03, table + "sigma = 'scatter'\n"));
    // Cells of another column stand for steps.
    const std::string steps = "file = 'cells.csv'\nsize = ['cells']\ndimension = 3\nstep = 'e'\n"
                              "error = ['scatter']\n";
    BOOST_TEST(checked(steps + "holds = 'scatter.order.e_determined = false'").front().holds);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_analysed_is_refused) {
    const auto said = [](const std::string& lines, const std::string& part) {
        BOOST_CHECK_EXCEPTION(checked(lines), InputError, [&](const InputError& error) {
            BOOST_TEST_INFO(error.what());
            return std::string(error.what()).find(part) != std::string::npos;
        });
    };
    said("holds = 'e.order = [1, 2]'", "expect.analyse.0.file is missing");
    said("file = ''", "expect.analyse.0.file is missing");
    said(table, "expect.analyse.0.holds is missing");
    said(table + "holds = ''", "expect.analyse.0.holds: expects nothing");
    said(table + "holds = 'e.order = [1, '", "expect.analyse.0.holds:1:");
    said(table + "holds = 'f.order = [1, 2]'", "known here: e");
    said(table + "holds = 'e.ordre = [1, 2]'", "did you mean 'order'");
    said("file = 'cells.csv'\ndimension = 0\nholds = 'e.order = [1, 2]'",
         "expect.analyse.0.dimension is 0; it must be > 0");
    said(table + "holds = 'e.order = [1, 2]'\nsizes = ['cells']", "did you mean 'size'");
    std::string many;
    for (int i = 0; i < 200; ++i)
        many += "[[expect.analyse]]\nfile = 'none.csv'\nholds = 'e.order = [1, 2]'\n";
    said("file = 'none.csv'\nholds = 'e.order = [1, 2]'\n" + many,
         "expect.analyse has 201 tables; at most 200 are analysed");
    // What is expected is read before the table is.
    said("file = 'none.csv'\nholds = 'e.order = [1, '", "expect.analyse.0.holds:1:");
    said("file = 'cells.csv'\nsize = ['cells']\nvalue = ['e']\nholds = 'e.orders = [1, 2]'",
         "e.orders is of errors, and e holds values");
}

BOOST_AUTO_TEST_CASE(what_is_no_table_violates_what_is_expected_of_it) {
    const auto found = [](const std::string& lines) {
        const auto all = checked(lines + "\nholds = 'e.order = [1, 2]'");
        BOOST_TEST(all.size() == 1U);
        BOOST_TEST(!all.front().holds);
        return all.front().found;
    };
    const auto has = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    BOOST_TEST(has(found("file = 'none.csv'"), "none.csv: is no regular file, or there is none"));
    BOOST_TEST(has(found("file = '.'"), "is no regular file"));
    BOOST_TEST(has(found("file = 's.toml'"), "s.toml:1:1: "));
    BOOST_TEST(
        has(found("file = 'cells.csv'\nsize = ['cell']\nerror = ['e']"),
            "did you mean 'cells'? among cells, e, scatter; choose one with --size NAME, in a "
            "scene size = [\"NAME\"]"));
    // What was assumed is said where it does not hold.
    const std::string other = checked("file = 'cells.csv'\nsize = ['cells']\nerror = ['e']\n"
                                      "holds = 'e.order = [1, 2]'")
                                  .front()
                                  .found;
    BOOST_TEST(has(other, "dimension 1 was assumed"));
}

BOOST_AUTO_TEST_SUITE_END()

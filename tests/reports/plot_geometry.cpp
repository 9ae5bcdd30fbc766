// Nothing in a picture stands on something else, and nothing beyond its edge: read from the SVG
// that gnuplot draws.

#include "reports/plots/free_space.hpp"
#include "reports/plots/gnuplot.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/readable_legend.hpp"
#include "studies/study.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(plot_geometry)

namespace {

struct Point {
    double x;
    double y;
};

struct Text {
    std::string words;
    double left, top, right, bottom;
};

struct Picture {
    double width = 0.0;
    double height = 0.0;
    std::vector<Text> texts;
    std::vector<Point> markers;
    std::vector<std::vector<Point>> triangles; ///< of reference slopes, drawn in #444444
};

std::size_t letters(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
}

/// Letters are half of their font as wide, on an average, and three quarters as high.
Text text_at(const std::string& words, Point at, double font, const std::string& anchor,
             bool upright) {
    const double length = 0.5 * font * static_cast<double>(letters(words));
    const double before = anchor == "end" ? length : anchor == "middle" ? length / 2.0 : 0.0;
    const double rise = 0.75 * font;
    if (upright)
        return {words, at.x - rise, at.y - length + before, at.x, at.y + before};
    return {words, at.x - before, at.y - rise, at.x - before + length, at.y};
}

Picture picture_of(const std::string& svg) {
    Picture picture;
    std::smatch size;
    BOOST_REQUIRE(std::regex_search(svg, size, std::regex("viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")));
    picture.width = std::stod(size[1]);
    picture.height = std::stod(size[2]);
    const auto each = [&svg](const std::string& pattern, const auto& visit) {
        const std::regex regex(pattern);
        for (std::sregex_iterator found(svg.begin(), svg.end(), regex), end; found != end; ++found)
            visit(*found);
    };
    each("translate\\(([-0-9.]+),([-0-9.]+)\\)( rotate\\(270\\))?\"[^>]*font-size=\"([0-9.]+)\" +"
         "text-anchor=\"([a-z]+)\">\\s*<text[^>]*>(.*?)</text>",
         [&](const std::smatch& found) {
             static const std::regex mark("<[^>]*>");
             const std::string words = std::regex_replace(found[6].str(), mark, "");
             picture.texts.push_back(text_at(words, {std::stod(found[1]), std::stod(found[2])},
                                             std::stod(found[4]), found[5], found[3].matched));
         });
    each("<use xlink:href='#gpPt[0-9]+' transform='translate\\(([0-9.]+),([0-9.]+)\\)",
         [&](const std::smatch& found) {
             picture.markers.push_back({std::stod(found[1]), std::stod(found[2])});
         });
    each("stroke='rgb\\( 68,  68,  68\\)'  d='M([0-9.]+),([0-9.]+) L([0-9.]+),([0-9.]+) "
         "L([0-9.]+),([0-9.]+) L",
         [&](const std::smatch& found) {
             auto& triangle = picture.triangles.emplace_back();
             for (std::size_t i = 1; i < 7; i += 2)
                 triangle.push_back({std::stod(found[i]), std::stod(found[i + 1])});
         });
    return picture;
}

bool overlap(const Text& a, const Text& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// From a point to a line between two others.
double distance(const Point& point, const Point& from, const Point& to) {
    const double along =
        ((point.x - from.x) * (to.x - from.x) + (point.y - from.y) * (to.y - from.y)) /
        (std::pow(to.x - from.x, 2) + std::pow(to.y - from.y, 2));
    const double part = std::clamp(along, 0.0, 1.0);
    return std::hypot(point.x - from.x - part * (to.x - from.x),
                      point.y - from.y - part * (to.y - from.y));
}

void require_clear(const Picture& picture, const std::string& name) {
    for (std::size_t i = 0; i < picture.texts.size(); ++i) {
        const Text& text = picture.texts[i];
        BOOST_TEST((text.left >= 0.0 && text.right <= picture.width && text.top >= 0.0 &&
                    text.bottom <= picture.height),
                   name << ": '" << text.words << "' is cut at the edge");
        for (std::size_t k = 0; k < i; ++k)
            BOOST_TEST(!overlap(text, picture.texts[k]),
                       name << ": '" << text.words << "' on '" << picture.texts[k].words << "'");
    }
    for (const auto& triangle : picture.triangles)
        for (std::size_t side = 0; side < triangle.size(); ++side)
            for (const auto& marker : picture.markers)
                BOOST_TEST(
                    distance(marker, triangle[side], triangle[(side + 1) % triangle.size()]) > 5.0,
                    name << ": a triangle touches a marker");
}

struct Drawn {
    std::string what;
    std::string scene;
    std::vector<std::string> overrides;
    std::size_t triangles; ///< of convergence.svg
};

std::ostream& operator<<(std::ostream& stream, const Drawn& drawn) {
    return stream << drawn.what;
}

const std::vector<Drawn> figures = {
    {"the paper's table", "table1", {}, 1},
    {"nine norms",
     "table1",
     {"ladder.printed={}",
      "ladder.norms=['theta_L2L2', 'theta_LinfL2', 'theta_L2H1', 'u_LinfL2', 'u_LinfH1', "
      "'u_LinfH2', 'u_LinfH2semi', 'u_L2H2', 'sigma_L2']"},
     2},
    {"one level", "table1", {"ladder.printed={}", "ladder.elements=[10]", "ladder.dt=[1e-3]"}, 0},
    {"a long source",
     "table1",
     {"ladder.printed.source='a table in an appendix of a thesis with a title that is too long'"},
     1},
    {"runs that failed",
     "table1",
     {"ladder.printed={}", "scheme.algorithm=fixed-point", "beam.alpha=5",
      "ladder.elements=[4, 4, 8]", "ladder.dt=[1, 1e-3, 5e-4]"},
     0},
    {"a beam over time", "figure1", {"evolution.dt=0.01"}, 0},
    {"cases",
     "stress-contact",
     {"stress.sweep.product.sampling=each", "stress.sweep.loads.sampling=each"},
     0},
};

} // namespace

BOOST_DATA_TEST_CASE(nothing_stands_on_something_else, data::make(figures)) {
    const auto plots = plots_of(run_study(read_scene(sample.scene, sample.overrides)));
    BOOST_REQUIRE(!plots.empty());
    const DrawnPlots drawn = draw(plots);
    BOOST_REQUIRE_MESSAGE(drawn.failure.empty(), drawn.failure);
    for (std::size_t i = 0; i < plots.size(); ++i) {
        const Picture picture = picture_of(drawn.plots[i].svg);
        BOOST_TEST(!picture.texts.empty());
        require_clear(picture, plots[i].name);
        if (plots[i].name == "convergence")
            BOOST_TEST(picture.triangles.size() == sample.triangles);
    }
}

// A legend of every length: below the axes, whole, and of so many series as can be told apart.
BOOST_DATA_TEST_CASE(a_legend_has_room_however_many_series_there_are,
                     data::make({1, 2, 7, 12, 13, 100}), count) {
    Drawing drawing;
    drawing.x = {.title = "mesh width h   (and Δt = 0.01 h with it)", .is_logarithmic = true};
    drawing.y = {.title = "error", .is_logarithmic = true};
    drawing.fix_axes();
    for (int k = 0; k < count; ++k)
        drawing.add_curve(
            {.block = drawing.add_block("h, error", fmt::format("0.1 {0}\n0.01 {0}e-2\n", k + 1))},
            look_of(series_style(static_cast<std::size_t>(k))), fmt::format("L∞ of series {}", k));
    const DrawnPlots drawn = draw({{"series", "", drawing}});
    BOOST_REQUIRE_MESSAGE(drawn.failure.empty(), drawn.failure);
    const Picture picture = picture_of(drawn.plots[0].svg);
    require_clear(picture, "series");
    const auto named =
        std::count_if(picture.texts.begin(), picture.texts.end(), [](const Text& text) {
            return text.words.find("of series") != std::string::npos;
        });
    BOOST_TEST(named == (count > 12 ? 8 : count));
    std::set<std::string> colours;
    const Drawing readable = with_readable_legend(drawing);
    for (const auto& curve : readable.curves())
        colours.insert(curve.look.colour);
    BOOST_TEST(colours.size() == (count > 12 ? static_cast<std::size_t>(count)
                                             : static_cast<std::size_t>(std::min(7, count))));
}

// From every side of what is there: within the frame, on nothing, and with the middle as near as a
// place that is tried every four pixels, five from all that is there, can be.
BOOST_AUTO_TEST_CASE(what_is_put_into_free_space_is_near_and_on_nothing) {
    const PictureBox frame{0.0, 0.0, 200.0, 160.0};
    const PictureBox there{80.0, 60.0, 120.0, 100.0};
    FreeSpace space(frame);
    space.occupy(there);
    constexpr double width = 30.0;
    constexpr double height = 20.0;
    constexpr double apart = 5.0;
    constexpr double step = 4.0;
    const double middle_x = 100.0;
    const double middle_y = 80.0;
    for (const PicturePoint& near : {PicturePoint{there.right, middle_y},
                                     {there.left, middle_y},
                                     {middle_x, there.bottom},
                                     {middle_x, there.top},
                                     {frame.right, middle_y},
                                     {middle_x, frame.bottom}}) {
        const auto box = space.find(width, height, near);
        BOOST_REQUIRE(box.has_value());
        BOOST_TEST((box->right - box->left == width && box->bottom - box->top == height));
        BOOST_TEST((box->left >= frame.left && box->right <= frame.right && box->top >= frame.top &&
                    box->bottom <= frame.bottom));
        const double beside = std::max({there.left - box->right, box->left - there.right,
                                        there.top - box->bottom, box->top - there.bottom});
        BOOST_TEST(beside >= apart);
        const double from_x = std::abs((box->left + box->right) / 2.0 - near.x);
        const double from_y = std::abs((box->top + box->bottom) / 2.0 - near.y);
        const bool at_side = near.y == middle_y;
        const bool at_edge = near.x == frame.right || near.y == frame.bottom;
        const double least = (at_side ? width : height) / 2.0 + apart;
        BOOST_TEST((at_side ? from_x : from_y) <= least + step);
        BOOST_TEST((at_side ? from_y : from_x) <= step);
        BOOST_TEST((at_edge || (at_side ? from_x : from_y) >= least));
    }
    // A line, and what is as large as a marker.
    space.occupy({0.0, 30.0}, {200.0, 30.0});
    space.occupy({30.0, 130.0}, 8.0);
    for (const PicturePoint& near : {PicturePoint{100.0, 30.0}, {30.0, 130.0}}) {
        const auto box = space.find(width, height, near);
        BOOST_REQUIRE(box.has_value());
        BOOST_TEST((box->bottom <= 30.0 - apart || box->top >= 30.0 + apart));
        const double x = std::clamp(30.0, box->left, box->right);
        const double y = std::clamp(130.0, box->top, box->bottom);
        BOOST_TEST(std::hypot(x - 30.0, y - 130.0) >= 8.0 + apart);
    }
    BOOST_TEST(!space.find(200.0, 20.0, {100.0, 80.0}).has_value());
}

// The test sees what it looks for.
BOOST_AUTO_TEST_CASE(what_overlaps_is_seen) {
    const Text tick = text_at("1/40", {100.0, 50.0}, 18.0, "middle", false);
    BOOST_TEST(overlap(tick, text_at("1/80", {125.0, 50.0}, 18.0, "middle", false)));
    BOOST_TEST(!overlap(tick, text_at("1/80", {160.0, 50.0}, 18.0, "middle", false)));
    BOOST_TEST(distance({1.0, 1.0}, {0.0, 0.0}, {2.0, 0.0}) == 1.0);
}

BOOST_AUTO_TEST_SUITE_END()

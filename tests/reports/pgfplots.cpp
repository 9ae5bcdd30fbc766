// What LaTeX draws by pgfplots: the numbers of the result, and files that compile.

#include "reports/plots/pgfplots_text.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(pgfplots)

namespace {

std::vector<Plot> plots_of_scene(const std::string& scene,
                                 const std::vector<std::string>& overrides) {
    auto plots = plots_of(run_study(read_scene(scene, overrides)));
    BOOST_TEST(!plots.empty(), scene);
    return plots;
}

/// What LaTeX takes for commands, in every place where a scene's own words stand.
Drawing with_signs() {
    const std::string signs = "50 % of a_b & {x} \\foo ~ ^2 # $ <b> |é α Δ L∞ 中 `\"' \n]]>";
    Drawing drawing;
    drawing.x = {.title = signs, .is_logarithmic = true};
    drawing.y = {.title = signs, .ticks = {{{1.0, "%"}, {2.0, "1.5e-3"}, {3.0, "", -3}}}};
    drawing.labels = {{signs, 10.0, 2.0}};
    const std::size_t block = drawing.add_block(signs, "1 2 1 3\n10 nan 9 11\n100 3 90 110\n");
    for (int dash = 1; dash <= 5; ++dash)
        for (int point = 2; point <= 15; point += 3)
            drawing.add_curve(
                {.block = block},
                {.kind = CurveLook::Kind::lines_and_points, .point = point, .dash = dash},
                dash == 1 ? std::optional(signs) : std::nullopt);
    drawing.add_curve({.block = block, .third = 3, .fourth = 4},
                      {.kind = CurveLook::Kind::bars, .point = 7});
    drawing.add_curve({.block = block, .third = 4}, {.kind = CurveLook::Kind::band});
    drawing.add_heights({2.5}, signs);
    return drawing;
}

} // namespace

BOOST_AUTO_TEST_CASE(coordinates_are_the_errors_to_the_last_digit) {
    const StudyResult result = run_study(read_scene("table1"));
    const std::string text = pgfplots_text(convergence_plots(result).at(0));
    for (const auto& rung : result.get<LadderResult>()->rungs)
        for (const double error : rung.errors) {
            const std::string point =
                fmt::format("({},{})", 1.0 / static_cast<double>(rung.rung.elements), error);
            BOOST_TEST(text.find(point) != std::string::npos, point);
        }
    // Both norms, the triangle of the slope, the published figures: each has what it is drawn as.
    for (const std::string part :
         {"published in Table 1}", "slope 4.05}", "% the slope 4", "mark=square,", "xmode=log"})
        BOOST_TEST(text.find(part) != std::string::npos, part);
}

// How far it reaches to the right, and to the left; and a power of ten by itself.
BOOST_AUTO_TEST_CASE(a_bar_reaches_from_its_lower_to_its_upper_end) {
    Drawing drawing;
    drawing.x = {.ticks = {{{1.0, "1e-3"}, {2.0, "2e-3"}}}};
    const std::size_t block = drawing.add_block("bars", "4 1 3 6\n");
    drawing.add_curve({.block = block, .third = 3, .fourth = 4},
                      {.kind = CurveLook::Kind::bars, .point = 7, .size = 0.5});
    const std::string text = pgfplots_text({"bars", "", drawing});
    BOOST_TEST(text.find("(4,1) += (2,0) -= (1,0)") != std::string::npos, text);
    BOOST_TEST(text.find("mark size=1.30pt") != std::string::npos, text);
    BOOST_TEST(text.find("$10^{-3}$") != std::string::npos, text);
    BOOST_TEST(text.find("$2\\times10^{-3}$") != std::string::npos, text);
}

BOOST_AUTO_TEST_CASE(a_band_goes_along_one_edge_and_back_along_the_other) {
    Drawing drawing;
    const std::size_t block = drawing.add_block("band", "1 10 20\n2 11 21\n3 12 22\n");
    drawing.add_curve({.block = block, .third = 3}, {.kind = CurveLook::Kind::band});
    std::string text = pgfplots_text({"band", "", drawing});
    std::erase_if(text, [](char sign) { return sign == ' ' || sign == '\n'; });
    BOOST_TEST(text.find("(1,10)(2,11)(3,12)(3,22)(2,21)(1,20)") != std::string::npos, text);
}

// Ticks between 0 and a number would never end.
BOOST_AUTO_TEST_CASE(what_a_logarithmic_axis_cannot_show_takes_no_part_in_its_ticks) {
    const auto text_of = [](const std::string& rows) {
        Drawing drawing;
        drawing.x.is_logarithmic = drawing.y.is_logarithmic = true;
        drawing.add_curve({.block = drawing.add_block("seconds, error", rows)}, {}, "a");
        return pgfplots_text({"zero", "", drawing});
    };
    const std::string text = text_of("0 0\n0.01 1\n1 10\n");
    BOOST_TEST(text.find("xtick={0.01,0.1,1}") != std::string::npos, text);
    BOOST_TEST(text_of("0 0\n").find("tick={") == std::string::npos);
}

// Between 2 and 5 there is no power of ten, nor 2 or 5 times one; LaTeX would write 10^0.48 at
// several.
BOOST_AUTO_TEST_CASE(a_logarithmic_axis_without_a_power_of_ten_has_labels_evenly_apart) {
    Drawing drawing;
    drawing.y.is_logarithmic = true;
    drawing.add_curve({.block = drawing.add_block("h, error", "0.1 2.98\n0.05 3.02\n")}, {}, "a");
    const std::string text = pgfplots_text({"narrow", "", drawing});
    BOOST_TEST(text.find("ytick={2.98,2.99,3,3.01,3.02},") != std::string::npos, text);
    BOOST_TEST(text.find("yticklabels={{2.98},{2.99},{3},{3.01},{3.02}},") != std::string::npos,
               text);
}

// What TeX has no room for is thinned; what stands out is kept.
BOOST_AUTO_TEST_CASE(a_long_line_keeps_its_ends_and_its_extremes) {
    std::string rows;
    for (int i = 0; i < 50'000; ++i)
        rows += fmt::format("{} {}\n", i, i == 31'415 ? 5 : i == 27'182 ? -7 : i % 2);
    Drawing drawing;
    drawing.add_curve({.block = drawing.add_block("t, u", rows)}, {}, "u");
    const std::string text = pgfplots_text({"long", "", drawing});
    for (const std::string kept : {"(0,0)", "(49999,1)", "(31415,5)", "(27182,-7)"})
        BOOST_TEST(text.find(kept) != std::string::npos, kept);
    const auto points = std::count(text.begin(), text.end(), '\n');
    BOOST_TEST(points > 3000);
    BOOST_TEST(points < 4100);
}

BOOST_AUTO_TEST_CASE(every_figure_compiles_under_pdflatex) {
    if (std::system("kpsewhich pgfplots.sty >/dev/null 2>&1") != 0) {
        BOOST_TEST_MESSAGE("skipped: not installed: pgfplots (texlive-pictures)");
        return;
    }
    std::vector<Plot> plots = plots_of_scene("table1", {});
    const auto add = [&plots](std::vector<Plot> more) {
        for (auto& plot : more)
            plots.push_back(std::move(plot));
    };
    std::vector<std::string> few{"work_precision.runs=2"};
    for (int scheme = 0; scheme < 4; ++scheme)
        few.push_back(fmt::format("work_precision.scheme.{}.elements=[4, 8]", scheme));
    add(plots_of_scene("table1-work-precision", few));
    add(plots_of_scene("stress-contact",
                       {"stress.sweep.product.sampling=each", "stress.sweep.loads.sampling=each"}));
    add({plots_of_scene("figure1", {"evolution.dt=0.01"}).at(2)}); // with its stops
    add({{"signs", "", with_signs()}});

    const TemporaryDirectory directory;
    std::string paper = "\\documentclass{article}\n\\usepackage[utf8]{inputenc}\n"
                        "\\usepackage{pgfplots}\n\\pgfplotsset{compat=1.18}\n\\begin{document}\n";
    for (std::size_t i = 0; i < plots.size(); ++i) {
        const std::string name = fmt::format("figure{}", i);
        directory.write(name + ".tex", pgfplots_text(plots[i]));
        paper += "\\noindent\\input{" + name + "}\n\n";
    }
    directory.write("paper.tex", paper + "\\end{document}\n");
    BOOST_TEST(std::system(("cd " + directory.path().string() +
                            " && pdflatex -draftmode -halt-on-error -interaction=nonstopmode "
                            "paper.tex >said 2>&1")
                               .c_str()) == 0,
               directory.read("said"));
    // Wider than its line, by more than a letter.
    static const std::regex overfull("Overfull .hbox .([0-9.]+)pt too wide");
    const std::string said = directory.read("said");
    for (std::sregex_iterator found(said.begin(), said.end(), overfull), end; found != end; ++found)
        BOOST_TEST(std::stod((*found)[1]) < 5.0, found->str());
}

BOOST_AUTO_TEST_SUITE_END()

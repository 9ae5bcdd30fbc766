// What the figures show: the numbers in their data, and what is chosen to be shown.

#include "core/contraction.hpp"
#include "reports/analysis/analysis_reports.hpp"
#include "reports/formats/html_report.hpp"
#include "reports/plots/gnuplot_script.hpp"
#include "reports/plots/pgfplots_text.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "reports/sweep/sweep.hpp"
#include "studies/data/data_analysis.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/stress/stress.hpp"
#include "studies/study.hpp"
#include "studies/text/number_text.hpp"

#include <boost/test/unit_test.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(plots)

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string script_of(const Plot& plot) {
    return gnuplot_script(plot.drawing, plot.name);
}

using Rows = std::vector<std::vector<double>>;

/// The blocks of a figure's data by their headings.
std::map<std::string, Rows> blocks_of(const Plot& plot) {
    std::map<std::string, Rows> blocks;
    std::istringstream lines(gnuplot_data(plot.drawing));
    std::string heading;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("# ")) {
            heading = line.substr(2);
            blocks[heading];
        } else if (!line.empty()) {
            std::istringstream words(line);
            auto& row = blocks[heading].emplace_back();
            for (std::string word; words >> word;)
                row.push_back(std::stod(word));
        }
    }
    return blocks;
}

const Rows& block(const std::map<std::string, Rows>& blocks, const std::string& begin) {
    const auto found = blocks.lower_bound(begin);
    BOOST_REQUIRE(found != blocks.end() && found->first.starts_with(begin));
    return found->second;
}

/// A grid and a ladder of the paper's problem, in some ten milliseconds.
const StudyResult& paper() {
    static const StudyResult result = run_study(read_scene("table1"));
    return result;
}

/// A ladder whose errors are made up: e = error(h).
template <typename Error>
StudyResult made_up(const Error& error) {
    StudyResult result = paper();
    auto& ladder = *result.get<LadderResult>();
    for (std::size_t k = 0; k < ladder.norms.size(); ++k)
        for (auto& rung : ladder.rungs)
            rung.errors[k] = error(1.0 / static_cast<double>(rung.rung.elements), k);
    for (auto& norm : ladder.norms)
        norm.predictions.clear();
    return result;
}

StressCase stress_case(double alpha, double zeta, double dt, Outcome outcome) {
    StressCase one;
    one.parameters.alpha = alpha;
    one.parameters.zeta = zeta;
    one.parameters.dt = dt;
    one.parameters.elements = 10;
    one.parameters.load = 1.0;
    one.outcome = outcome;
    return one;
}

} // namespace

BOOST_AUTO_TEST_CASE(the_points_of_a_convergence_figure_are_the_errors_and_the_printed_figures) {
    const auto plots = convergence_plots(paper());
    BOOST_REQUIRE(plots.size() == 1u);
    const auto blocks = blocks_of(plots[0]);
    const auto& rungs = paper().get<LadderResult>()->rungs;
    const Rows& rows = block(blocks, "theta_L2L2_sq: h, dt, error");
    BOOST_REQUIRE(rows.size() == rungs.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        BOOST_TEST(rows[i][0] == 1.0 / static_cast<double>(rungs[i].rung.elements));
        BOOST_TEST(rows[i][1] == rungs[i].rung.dt);
        BOOST_TEST(rows[i][2] == rungs[i].errors[0]);
        BOOST_TEST(rows[i][3] ==
                   paper().scene.get<LadderBlock>()->printed->figures.at("theta_L2L2_sq").at(i));
    }
    BOOST_TEST(has(script_of(plots[0]), "(and Δt = 0.01 h with it)"), script_of(plots[0]));
    BOOST_TEST(has(script_of(plots[0]), "published in Table 1"));
}

// Steps that follow no power of h: from which to which they go.
BOOST_AUTO_TEST_CASE(the_axis_of_h_says_what_becomes_of_the_step) {
    const auto script = [](const std::vector<double>& steps) {
        StudyResult result = paper();
        auto& rungs = result.get<LadderResult>()->rungs;
        BOOST_REQUIRE(rungs.size() == steps.size());
        for (std::size_t i = 0; i < steps.size(); ++i)
            rungs[i].rung.dt = steps[i];
        return script_of(convergence_plots(result).at(0));
    };
    BOOST_TEST(has(script({0.1, 0.09, 0.08, 0.07, 0.05}), "(and Δt with it, from 0.1 to 0.05)"));
    BOOST_TEST(has(script({0.1, 0.1, 0.1, 0.1, 0.1}), "(Δt = 0.1)"));
    // Meshes by their elements, at their widths; and the one mesh of a ladder in time.
    BOOST_TEST(has(script({0.1, 0.1, 0.1, 0.1, 0.1}), "'1/20' 0.05"));
    StudyResult in_time = paper();
    for (auto& rung : in_time.get<LadderResult>()->rungs)
        rung.rung.elements = 8;
    BOOST_TEST(has(script_of(convergence_plots(in_time).at(0)), "time step Δt   (h = 1/8)"));
}

BOOST_AUTO_TEST_CASE(a_sweep_says_of_which_values_a_caution_is) {
    const Sweep sweep{"ladder.final_time", {"0.1", "0.2"}, {}};
    std::vector<StudyResult> results;
    for (const auto& value : sweep.values) {
        results.push_back(
            run_study(read_scene("table1", {"expect={}", "ladder.elements=[4]", "ladder.dt=[0.05]",
                                            "ladder.printed={}", sweep.key + "=" + value})));
        results.back().remarks = {"Of both."};
    }
    results.back().remarks.emplace_back("Of one.");
    const auto head = reported(sweep, results).document.head;
    BOOST_TEST(std::ranges::count(head, "Of both.") == 1);
    BOOST_TEST(std::ranges::count(head, "ladder.final_time = 0.2: Of one.") == 1);
    BOOST_TEST(std::ranges::count(head, "Of one.") == 0);
}

// Of errors those of the finest level, of a study without errors its figures; values that are far
// apart stand on a logarithmic axis.
BOOST_AUTO_TEST_CASE(a_sweep_s_figure_has_the_last_errors_over_the_values) {
    const auto swept = [](const std::string& scene, const Sweep& sweep) {
        std::vector<StudyResult> results;
        for (const auto& value : sweep.values)
            results.push_back(run_study(read_scene(scene, {"expect={}", sweep.key + "=" + value})));
        return std::pair(reported(sweep, results).plots(), results);
    };
    const auto [plots, results] = swept("bent-later", {"beam.zeta", {"0.25", "0.5"}, {}});
    BOOST_REQUIRE(plots.size() == 1U);
    const Drawing& drawing = plots[0].drawing;
    BOOST_TEST((!drawing.x.is_logarithmic && drawing.y.is_logarithmic));
    const auto& norms = results[0].get<LadderResult>()->norms;
    BOOST_REQUIRE(drawing.blocks().size() == norms.size());
    for (std::size_t k = 0; k < norms.size(); ++k) {
        const auto error = [&, &all = results](std::size_t i) {
            return all[i].get<LadderResult>()->rungs.back().errors[k];
        };
        BOOST_TEST(drawing.blocks()[k].heading == norms[k].norm.words);
        BOOST_TEST(drawing.blocks()[k].rows ==
                   fmt::format("0.25 {}\n0.5 {}\n", error(0), error(1)));
    }
    const auto far = swept("bent-later", {"beam.zeta", {"0.01", "0.5"}, {}}).first;
    BOOST_TEST(far.at(0).drawing.x.is_logarithmic);
    BOOST_TEST(swept("bent-later", {"scheme.time", {"euler", "bdf2"}, {}}).first.empty());
    const auto figures =
        swept("contacts-at-their-limits", {"beam.theta_A", {"0.0", "0.5"}, {}}).first;
    const auto& blocks = figures.at(0).drawing.blocks();
    BOOST_TEST(!figures[0].drawing.y.is_logarithmic);
    BOOST_TEST(std::ranges::any_of(blocks, [](const DataBlock& block) {
        return block.heading == "onset.1" && block.rows.starts_with("0 1.66666666") &&
               has(block.rows, "\n0.5 1.66666666");
    }));
}

// However they are given; TOML writes 0.25 as +0.25 or 0.2_5, too. Between a run that failed and
// its neighbours there is nothing.
BOOST_AUTO_TEST_CASE(a_sweep_s_curves_go_from_the_least_value_on_and_have_gaps) {
    const Sweep sweep{"beam.zeta", {"1.0", "+0.25", "0.2_0", "0.5"}, {}};
    std::vector<StudyResult> results;
    for (const auto& value : sweep.values)
        results.push_back(
            run_study(read_scene("bent-later", {"expect={}", sweep.key + "=" + value})));
    const auto rows_of = [&] {
        std::vector<std::vector<double>> all;
        const auto plots = reported(sweep, results).plots();
        for (const auto& block : plots.at(0).drawing.blocks()) {
            auto& values = all.emplace_back();
            std::istringstream lines(block.rows);
            for (std::string line; std::getline(lines, line);)
                values.push_back(number_in(line));
        }
        return all;
    };
    BOOST_TEST((rows_of().at(0) == std::vector<double>{0.2, 0.25, 0.5, 1.0}));
    results[3].get<LadderResult>()->rungs.back().errors[0] = std::nan("");
    const auto rows = rows_of();
    BOOST_TEST((rows.at(0) == std::vector<double>{0.2, 0.25}));
    BOOST_TEST((rows.at(1) == std::vector<double>{1.0}));
    const auto curves = reported(sweep, results).plots().at(0).drawing.curves();
    BOOST_TEST((curves.at(0).title && !curves.at(1).title));
    BOOST_TEST(curves.at(0).look.colour == curves.at(1).look.colour);
}

// What a value is TOML says: "1.5" is a text and 1.5 a number, +5 is 5 and 1_0 is 10.
BOOST_AUTO_TEST_CASE(values_of_a_sweep_are_what_they_are_by_themselves) {
    const auto swept = [](const std::string& values) { return *sweep_in({"a.k=" + values}); };
    const Sweep texts = swept(R"("1.500","2.500",1.5,"inf",euler,"bdf2","a,b","c\"d",'e"f')");
    BOOST_TEST((texts.values == std::vector<std::string>{"\"1.500\"", "\"2.500\"", "1.5", "\"inf\"",
                                                         "euler", "\"bdf2\"", "\"a,b\"",
                                                         R"("c\"d")", "'e\"f'"}));
    BOOST_TEST(texts.overrides(texts.values[0]).front() == "a.k=\"1.500\"");
    // Without quotes where it is the same without them.
    BOOST_TEST(texts.shown(0) == "\"1.500\"");
    BOOST_TEST(texts.shown(3) == "\"inf\"");
    BOOST_TEST(texts.shown(5) == "bdf2");
    BOOST_TEST(texts.directory(0) == "1-of-9");
    BOOST_TEST(texts.directory(5) == "bdf2");
    for (const std::string twice : {"+5,5", "1_0,10", "0x10,16", "\"a\",a", "1e1,10.0"})
        BOOST_CHECK_THROW(swept(twice), InputError);
    BOOST_TEST(swept("true,\"true\"").values.size() == 2U);
    // What is recorded is the same sweep again.
    const Sweep commas = swept(R"("a,b","c")");
    BOOST_TEST((swept(fmt::format("{},{}", commas.values[0], commas.values[1])).values ==
                std::vector<std::string>{"\"a,b\"", "\"c\""}));
}

// e = h²: a line of the order 2 through the finest error; of two errors no order is known.
BOOST_AUTO_TEST_CASE(the_figure_of_a_table_has_the_order_that_is_determined) {
    const auto blocks = [](const std::vector<double>& widths) {
        DataFile data;
        data.widths = {{"h", widths}};
        data.errors = {{"e", {}}};
        for (const double h : widths)
            data.errors[0].numbers.push_back(h * h);
        return blocks_of(analysis_plots(analyse(data)).at(0));
    };
    const auto three = blocks({0.5, 0.25, 0.125});
    const Rows& line = block(three, "e: its order");
    BOOST_REQUIRE(line.size() == 2U);
    BOOST_TEST((line[0][0] == 0.5 && line[1][0] == 0.125));
    BOOST_TEST(line[0][1] == 0.25, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(line[1][1] == 0.015625);
    BOOST_TEST(blocks({0.5, 0.25}).count("e: its order") == 0U);
}

// Files and ids of a page are called by it: in letters, digits and _, each its own, whatever the
// columns are called; one whose name is so already keeps it.
BOOST_AUTO_TEST_CASE(every_figure_has_a_name_of_its_own) {
    DataFile data;
    data.widths = {{"h", {0.4, 0.2, 0.1}}};
    for (const std::string name : {"C/d", "C_d", "C-d", "C_d_2", "α", "β"})
        data.values.push_back({name, {1.16, 1.04, 1.01}});
    StudyResult result = paper();
    auto& norms = result.scene.get<OrdersBlock>()->norms;
    norms[0].name = "a/b";
    norms[1].name = "a b";
    for (const auto& plots : {analysis_plots(analyse(data)), plots_of(result)}) {
        std::set<std::string> names;
        for (const auto& plot : plots) {
            BOOST_TEST(names.insert(plot.name).second, plot.name);
            BOOST_TEST(
                std::ranges::all_of(
                    plot.name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }),
                plot.name);
        }
    }
    const auto plots = analysis_plots(analyse(data));
    BOOST_REQUIRE(plots.size() == 6U);
    BOOST_TEST((plots[1].name == "value_C_d" && plots[3].name == "value_C_d_2"));
}

namespace {

/// Where the labels of an axis stand, and what they say: '0.5' 0.5, …
std::vector<std::pair<double, std::string>> ticks_of(const std::string& script, char axis) {
    const std::string begin = fmt::format("set {}tics (", axis);
    const auto at = script.find(begin);
    BOOST_REQUIRE_MESSAGE(at != std::string::npos, script);
    const auto from = at + begin.size();
    const std::string list = script.substr(from, script.find(")\n", from) - from);
    static const std::regex tick("'([^']*)' ([^,]+)");
    std::vector<std::pair<double, std::string>> ticks;
    for (std::sregex_iterator found(list.begin(), list.end(), tick), end; found != end; ++found)
        ticks.emplace_back(std::stod((*found)[2]), (*found)[1]);
    return ticks;
}

} // namespace

// Where it shows fewer than two powers of ten: at 2 and 5 times one, or evenly apart; in what
// gnuplot draws and in what LaTeX does.
BOOST_AUTO_TEST_CASE(a_logarithmic_axis_within_a_decade_has_numbers) {
    for (const auto& [least, greatest] : std::vector<std::pair<double, double>>{
             {0.00115, 0.00477}, {0.0135, 0.0303}, {2.98, 3.02}, {0.9, 8.0}, {1.1e-7, 9e-7}}) {
        Drawing drawing;
        // Without a range of its own it ends at the data, not at whole decades.
        const bool has_range = least > 1e-3;
        drawing.y.is_logarithmic = true;
        if (has_range)
            drawing.y.range = {least / 1.01, greatest * 1.01};
        drawing.add_curve(
            {.block = drawing.add_block("h, error", fmt::format("2 {}\n1 {}\n", least, greatest))},
            {}, "a");
        const std::string script = gnuplot_script(drawing, "narrow");
        BOOST_TEST(has(script, "set yrange ["), script);
        const auto ticks = ticks_of(script, 'y');
        BOOST_TEST((ticks.size() >= 2U && ticks.size() <= 8U), least);
        const std::string latex = pgfplots_text({"narrow", "", drawing});
        for (const auto& [place, text] : ticks) {
            BOOST_TEST(number_in(text) == place, text);
            const double room = has_range ? 1.02 : 1.2;
            BOOST_TEST((place > least / room && place < greatest * room), text);
            BOOST_TEST(has(latex, fmt::format("{}", place)), latex);
        }
    }
}

// Wherever the numbers lie and however near each other, a label is the number of its place, in not
// many signs; and what is taken off all numbers, as the title says, is taken off those drawn.
BOOST_AUTO_TEST_CASE(the_labels_of_a_linear_axis_are_the_numbers_of_their_places) {
    for (const auto& [coarse, fine, title] : std::vector<std::tuple<double, double, std::string>>{
             {101325.033, 101325.0005, "p − 101325"},
             {3.22e-6, 3.0034e-6, "p"},
             {-2.00001, -2.00002, "p + 2"},
             {0.95, 1.2, "p"},
             {1.2345e-9, -3.1e-9, "p"},
             {123456.0, 789012.0, "p"},
             {1.0 + 4e-12, 1.0, "p − 1"},
             {1.0 + 4e-16, 1.0, "p"}, // rounding, which is not shown
             {7.5, 7.5, "p"}}) {
        DataFile data;
        data.widths = {{"h", {0.2, 0.1}}};
        data.values = {{"p", {coarse, fine}}};
        const Plot plot = analysis_plots(analyse(data)).at(0);
        const std::string script = script_of(plot);
        BOOST_TEST(has(script, "set ylabel '" + title + "' noenhanced"), script);
        const double off = title == "p" ? 0.0 : std::round(fine);
        const auto ticks = ticks_of(script, 'y');
        BOOST_TEST((ticks.size() >= 2U && ticks.size() <= 8U));
        std::set<double> places;
        for (const auto& [place, text] : ticks) {
            BOOST_TEST(number_in(text) == place, text);
            BOOST_TEST(text.size() <= 8U, text);
            places.insert(place);
        }
        BOOST_TEST(places.size() == ticks.size());
        const double rounding = 1e-6 * (*places.rbegin() - *places.begin());
        BOOST_TEST(*places.begin() <= std::min(coarse, fine) - off + rounding);
        BOOST_TEST(*places.rbegin() >= std::max(coarse, fine) - off - rounding);
        const std::string column = off == 0.0 ? "1:2" : fmt::format("1:(${}-({}))", 2, off);
        BOOST_TEST(has(script, "using " + column + " with linespoints"), script);
        const std::string latex = pgfplots_text(plot);
        BOOST_TEST(has(latex, fmt::format("(0.2,{})", coarse - off)), latex);
        for (const auto& [place, text] : ticks)
            BOOST_TEST(has(latex, fmt::format("{}", place)), latex);
        BOOST_TEST(has(latex, "yticklabels={"), latex);
    }
}

// In three digits, true to half of the last; as 1/n where that is what they are; as they are where
// that is short.
BOOST_AUTO_TEST_CASE(the_labels_of_widths_are_short_and_true) {
    constexpr std::size_t most = 6;
    const auto texts = [](const std::vector<double>& widths) {
        std::string all;
        for (const auto& tick : value_ticks(widths, most))
            all += (all.empty() ? "" : " ") + tick.text;
        return all;
    };
    BOOST_TEST(texts({0.25, 0.125, 0.0625}) == "0.0625 0.125 0.25");
    BOOST_TEST(texts({1.0 / 3.0, 1.0 / 6.0, 1.0 / 12.0, 1.0}) == "1/12 1/6 1/3 1/1");
    std::vector<double> widths;
    for (const double unknowns : {20.0, 72.0, 272.0, 1056.0, 4160.0})
        widths.push_back(1.0 / std::sqrt(unknowns));
    const auto ticks = value_ticks(widths, most);
    BOOST_TEST(ticks.size() == widths.size());
    for (const auto& tick : ticks) {
        BOOST_TEST(tick.text.size() <= 8U, tick.text);
        BOOST_TEST(std::abs(number_in(tick.text) / tick.value - 1.0) <= 0.5e-2, tick.text);
    }
    // Where three digits are alike, as many as are not.
    BOOST_TEST(texts({1.00011111111, 1.00022222222}) == "1.0001 1.0002");
}

// A letter is 0.62 of its font wide; 90 of the 540 pixels are samples and margins.
BOOST_AUTO_TEST_CASE(a_legend_s_letters_are_as_large_as_its_longest_line_allows) {
    const auto font_of = [](std::size_t letters) {
        Drawing drawing;
        const std::string title(letters, 'm');
        drawing.add_curve({.block = drawing.add_block("d", "1 1\n2 2\n")}, {}, title);
        const std::string script = gnuplot_script(drawing, "x");
        const auto at = script.find("set key");
        BOOST_REQUIRE(at != std::string::npos);
        const auto font = script.find("font ',", at);
        BOOST_REQUIRE(font != std::string::npos);
        return std::stoi(script.substr(font + 7));
    };
    for (const std::size_t letters : {50U, 60U, 70U})
        BOOST_TEST(0.62 * font_of(letters) * static_cast<double>(letters) <=
                   Drawing::plot_width - 90.0);
    BOOST_TEST(font_of(10) > font_of(80));
}

BOOST_AUTO_TEST_CASE(the_triangles_of_a_convergence_figure_have_the_whole_orders_that_are_seen) {
    // e = 3 h² and e = 5e-4 h^3.5: the orders are 2, which is whole, and 3.5.
    const auto plots = convergence_plots(made_up(
        [](double h, std::size_t k) { return k == 0 ? 3.0 * h * h : 5e-4 * std::pow(h, 3.5); }));
    BOOST_REQUIRE(plots.size() == 1u);
    BOOST_TEST(has(script_of(plots[0]), "slope 2.00'"), script_of(plots[0]));
    BOOST_TEST(has(script_of(plots[0]), "slope 3.50'"), script_of(plots[0]));
    const auto blocks = blocks_of(plots[0]);
    std::size_t triangles = 0;
    for (const auto& [heading, rows] : blocks)
        triangles += heading.starts_with("the slope ") ? 1 : 0;
    BOOST_TEST(triangles == 1U);
    const Rows& rows = block(blocks, "the slope 2");
    BOOST_REQUIRE(rows.size() == 4U);
    BOOST_TEST(std::log(rows[2][1] / rows[0][1]) / std::log(rows[2][0] / rows[0][0]) == 2.0,
               boost::test_tools::tolerance(1e-4));
}

// What the legend names is drawn: each norm's points, joined.
BOOST_AUTO_TEST_CASE(every_line_of_a_legend_is_drawn_and_differs_from_the_others) {
    std::set<std::tuple<std::string, int, int>> styles;
    for (std::size_t series = 0; series < 100; ++series) {
        const SeriesStyle style = series_style(series);
        styles.insert({style.colour, style.point, style.dash});
    }
    BOOST_TEST(styles.size() == 100U);
    const std::string script = script_of(convergence_plots(paper()).at(0));
    for (std::size_t k = 0; k < 2; ++k)
        BOOST_TEST(has(script, fmt::format("with linespoints lc rgb '{}' dt {} lw 1.6 pt {} ps 0.9",
                                           series_style(k).colour, series_style(k).dash,
                                           series_style(k).point)),
                   script);
}

BOOST_AUTO_TEST_CASE(errors_that_cannot_stand_on_a_logarithmic_axis_are_left_out) {
    BOOST_TEST(convergence_plots(made_up([](double, std::size_t) { return 0.0; })).empty());
    const auto plots =
        convergence_plots(made_up([](double h, std::size_t k) { return k == 0 ? 0.0 : h; }));
    BOOST_REQUIRE(plots.size() == 1u);
    const auto blocks = blocks_of(plots[0]);
    for (const auto& row : block(blocks, "theta_L2L2_sq: h"))
        BOOST_TEST(std::isnan(row[2]));
}

BOOST_AUTO_TEST_CASE(
    the_model_has_its_error_on_a_line_of_equal_error_and_is_balanced_on_the_balance) {
    const auto plots = error_surface_plots(paper());
    BOOST_REQUIRE(plots.size() == 2u);
    for (std::size_t k = 0; k < plots.size(); ++k) {
        const TwoTermModel& model = paper().get<OrdersResult>()->norms[k].fit.model;
        BOOST_TEST(model.rho < 0.0); // the lines bulge: the angle of ρ is not that of −ρ
        std::size_t lines = 0;
        for (const auto& [heading, rows] : blocks_of(plots[k])) {
            if (heading.starts_with("model equal to ")) {
                const double level = std::stod(heading.substr(15));
                // Six digits of h and dt.
                for (const auto& row : rows)
                    BOOST_TEST(model.error(row[0], row[1]) == level,
                               boost::test_tools::tolerance(1e-4));
                ++lines;
            }
            if (heading.starts_with("balance"))
                for (const auto& row : rows)
                    BOOST_TEST(model.spatial(row[0]) == model.temporal(row[1]),
                               boost::test_tools::tolerance(1e-12));
        }
        BOOST_TEST(lines >= 3u);
        const auto runs = blocks_of(plots[k]);
        BOOST_TEST(block(runs, "runs of the fit").size() ==
                   paper().get<OrdersResult>()->norms[k].fit.used.size());
    }
}

BOOST_AUTO_TEST_CASE(where_no_model_holds_the_runs_stand_with_their_errors) {
    StudyResult result = paper();
    result.get<OrdersResult>()->norms[0].fit.failure = "none";
    const Plot plot = error_surface_plots(result).at(0);
    BOOST_TEST(!has(gnuplot_data(plot.drawing), "model"));
    BOOST_TEST(block(blocks_of(plot), "other runs").size() ==
               result.get<OrdersResult>()->runs.size());
}

BOOST_AUTO_TEST_CASE(the_two_parameters_that_decide_the_outcome_are_the_axes) {
    StudyResult result = paper();
    result.records.set(StressResult{});
    // Refused where α > 1 and Δt > 1; ζ has more values, and decides nothing.
    int i = 0;
    for (const double alpha : {1e-2, 1e-1, 1e1, 1e2})
        for (const double dt : {1e-3, 1e-1, 1e1, 1e3})
            for (const double zeta : {0.0, 1e-4, 1e-2, 1e0, 1e2, 1e4, 1e6})
                result.get<StressResult>()->cases.add(
                    stress_case(alpha, zeta * (1 + i++ % 3), dt,
                                alpha > 1.0 && dt > 1.0 ? Outcome::refused : Outcome::certified));
    const Plot plot = stress_plots(result).at(0);
    BOOST_TEST(has(script_of(plot), "set xlabel 'thermal expansion α'"), script_of(plot));
    BOOST_TEST(has(script_of(plot), "set ylabel 'time step Δt'"), script_of(plot));
    BOOST_TEST(has(script_of(plot), "'refused: 28'"), script_of(plot));
    BOOST_TEST(has(script_of(plot), "'certified: 84'"), script_of(plot));
    BOOST_TEST(plot.caption.starts_with("Outcomes of 112 cases over"), plot.caption);
    const auto blocks = blocks_of(plot);
    double cases = 0;
    for (const auto& [heading, rows] : blocks)
        for (const auto& row : rows)
            cases += row[2];
    BOOST_TEST(cases == 112.0);
    for (const auto& row : block(blocks, "refused"))
        BOOST_TEST((row[0] >= 1.0 && row[1] >= 1.0)); // decimal logarithms
}

// As large as each other, to half: none is hardly to be seen.
BOOST_AUTO_TEST_CASE(the_marks_of_all_outcomes_are_of_like_size) {
    StudyResult result = paper();
    result.records.set(StressResult{});
    for (const Outcome outcome :
         {Outcome::certified, Outcome::refused, Outcome::stopped, Outcome::failed})
        for (const double alpha : {1.0, 2.0})
            result.get<StressResult>()->cases.add(stress_case(alpha, 1.0, alpha, outcome));
    const std::string script = script_of(stress_plots(result).at(0));
    std::vector<double> sizes;
    for (auto at = script.find(" ps "); at != std::string::npos; at = script.find(" ps ", at + 1))
        sizes.push_back(std::stod(script.substr(at + 4)));
    BOOST_REQUIRE(sizes.size() >= 4U);
    const auto [least, greatest] = std::minmax_element(sizes.begin(), sizes.end());
    BOOST_TEST(*least > 0.0);
    BOOST_TEST(*greatest <= 2.0 * *least);
}

BOOST_AUTO_TEST_CASE(zero_and_no_stops_have_places_of_their_own_on_a_logarithmic_axis) {
    StudyResult result = paper();
    result.records.set(StressResult{});
    for (const double alpha : {0.0, 1e-2, 1.0})
        for (const double gap : {1e-3, 1.0, std::numeric_limits<double>::infinity()}) {
            StressCase one = stress_case(alpha, 1.0, 1.0, Outcome::certified);
            one.parameters.stops = {-gap, gap};
            result.get<StressResult>()->cases.add(one);
        }
    const Plot plot = stress_plots(result).at(0);
    // A decade below 1e-2, a decade above 1.
    BOOST_TEST(has(script_of(plot), "('0' -3, '10^{-2}' -2"), script_of(plot));
    BOOST_TEST(has(script_of(plot), "'none' 1)"), script_of(plot));
    // Where there is neither, there is no such place.
    result.records.set(StressResult{});
    for (const double alpha : {1e-2, 1.0})
        for (const double dt : {1e-3, 1.0})
            result.get<StressResult>()->cases.add(stress_case(alpha, 1.0, dt, Outcome::certified));
    const std::string without = script_of(stress_plots(result).at(0));
    BOOST_TEST((!has(without, "'0'") && !has(without, "'none'")), without);
}

BOOST_AUTO_TEST_CASE(the_lines_of_a_contraction_map_are_where_it_is_predicted) {
    StudyResult result = paper();
    result.records.set(StressResult{});
    const double zeta = 0.05;
    const ContractionBlock asked{{0.1, 1.0, 10.0}, {1e-3, 0.1},        zeta, 8,
                                 "euler",          ThermalMass::lumped};
    result.get<StressResult>()->contraction =
        contraction_map(asked, {measure_contraction(asked, 0), measure_contraction(asked, 1)});
    const auto blocks = blocks_of(contraction_plots(result).at(0));
    for (const double level : {0.01, 0.1, 1.0}) {
        const Rows& line = block(blocks, "predicted: " + shortest(level) + ":");
        BOOST_TEST(line.size() == 2U);
        for (const auto& row : line)
            BOOST_TEST(contraction({.alpha = row[0], .zeta = zeta}, Mesh::uniform(8),
                                   ThermalMass::lumped, 1.0 / row[1]) == level,
                       boost::test_tools::tolerance(1e-12));
    }
    const Rows& below = block(blocks, "measured, run taken");
    const Rows& above = block(blocks, "measured, refused");
    BOOST_TEST(below.size() + above.size() == 6U);
    for (const auto& row : above)
        BOOST_TEST(row[2] >= 1.0);
}

BOOST_AUTO_TEST_CASE(what_a_round_off_study_did_not_measure_is_not_drawn) {
    StudyResult result = paper();
    result.records.set(StressResult{});
    RoundOffRow coarse;
    coarse.elements = 10;
    coarse.moment.value = 1e-15;
    coarse.hermite.value = 1e-14;
    coarse.hermite_predicted = 1e-13;
    RoundOffRow fine = coarse;
    fine.elements = 100;
    fine.hermite = {std::nullopt, "stopped"};
    result.get<StressResult>()->roundoff = RoundOffTable{{coarse, fine}};
    const auto blocks = blocks_of(round_off_plots(result).at(0));
    BOOST_TEST(block(blocks, "moment form, nodal").size() == 2U);
    BOOST_TEST(block(blocks, "Hermite form:").size() == 1U);
    BOOST_TEST(block(blocks, "Hermite form, predicted").size() == 2U);
    BOOST_TEST(blocks.size() == 3U); // no sine basis, no discretisation error
}

BOOST_AUTO_TEST_CASE(text_of_a_scene_cannot_leave_its_quotes_in_a_script) {
    BOOST_TEST(gnuplot_text("it's `id` \"x\"\nsystem('y')") == "'it''s `id` \"x\" system(''y'')'");
    // Nor the section of an SVG that gnuplot puts it in, nor XML altogether.
    BOOST_TEST(gnuplot_text("a]]>b]]]]>") == "'a]] >b]]]] >'");
    BOOST_TEST(gnuplot_text("\033[2J\xff") == "'\\x1B[2J\\xFF'");
}

BOOST_AUTO_TEST_CASE(the_colours_of_a_scale_go_from_0_to_1) {
    Drawing drawing;
    drawing.scale = "part";
    const std::string script = gnuplot_script(drawing, "p");
    const std::string first = "set palette defined (0 '";
    const std::size_t begin = script.find(first);
    BOOST_REQUIRE_MESSAGE(begin != std::string::npos, script);
    const std::string palette = script.substr(begin, script.find(")\n", begin) - begin);
    BOOST_TEST(palette.substr(palette.rfind(", ")).starts_with(", 1 '"), palette);
}

// From its first sample to its last, whether that is the end of the run or of the last period.
BOOST_AUTO_TEST_CASE(curves_over_time_end_where_their_window_does) {
    const StudyResult result =
        run_study(read_scene("figure1", {"evolution.dt=0.01", "evolution.final_time=4",
                                         "evolution.period=1", "evolution.probes=['u@1']"}));
    const auto plots = evolution_plots(result);
    BOOST_REQUIRE(plots.size() == 2u);
    BOOST_REQUIRE(!result.get<EvolutionResult>()->periods.empty());
    for (const auto& [k, begin] : {std::pair{0u, 0.0}, {1u, 2.0}}) {
        const auto blocks = blocks_of(plots[k]);
        BOOST_REQUIRE(!blocks.empty());
        const Rows& rows = blocks.begin()->second;
        BOOST_TEST(rows.front().front() == begin, boost::test_tools::tolerance(1e-9));
        BOOST_TEST(rows.back().front() == 4.0, boost::test_tools::tolerance(1e-9));
    }
}

BOOST_AUTO_TEST_CASE(series_differ_in_more_than_colour) {
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = i + 1; j < 6; ++j) {
            BOOST_TEST(series_style(i).colour != series_style(j).colour);
            BOOST_TEST(series_style(i).point != series_style(j).point);
        }
}

BOOST_AUTO_TEST_CASE(an_inline_picture_has_ids_of_its_own) {
    const Figure figure{"p", "what \"it\" shows",
                        "<?xml version=\"1.0\"?>\n<svg \n width=\"540\" height=\"400\"\n "
                        "viewBox=\"0 0 540 400\"><title>x</title><path id='a'/>"
                        "<use xlink:href='#a' id=\"b\" fill=\"url(#c)\"/></svg>"};
    BOOST_TEST(inline_svg(figure) ==
               "<svg \n role=\"img\" aria-label=\"what &quot;it&quot; shows\"\n "
               "viewBox=\"0 0 540 400\"><path id='p-a'/>"
               "<use xlink:href='#p-a' id=\"p-b\" fill=\"url(#p-c)\"/></svg>");
}

BOOST_AUTO_TEST_SUITE_END()

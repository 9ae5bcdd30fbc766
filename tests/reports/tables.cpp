// One table, written as text, Markdown, LaTeX and HTML.

#include "core/norms/norms.hpp"
#include "mms/text/visible_text.hpp"
#include "reports/command_line/check_report.hpp"
#include "reports/document/html_text.hpp"
#include "reports/document/json_text.hpp"
#include "reports/document/orders_section.hpp"
#include "reports/document/problem_formulas.hpp"
#include "reports/document/raised_text.hpp"
#include "reports/document/result_document.hpp"
#include "reports/document/text_document.hpp"
#include "reports/document/text_table.hpp"
#include "reports/document/written_number.hpp"
#include "reports/formats/csv_report.hpp"
#include "reports/formats/html_report.hpp"
#include "reports/formats/junit_report.hpp"
#include "reports/formats/latex_report.hpp"
#include "reports/formats/markdown_report.hpp"
#include "reports/studies/run_fields.hpp"
#include "studies/stress/stress.hpp"
#include "studies/study.hpp"
#include "studies/text/number_text.hpp"
#include "tests/comma_locale.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <sstream>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(tables)

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

Table table() {
    return {"Errors.",
            {"", {{"s", {"10", "20"}}}},
            {{"theta_L2L2", {{"error", {"1.25e-3", "7.5e-10"}}, {"ord.", {"", "4.01"}}}},
             {"", {{"note", {"failed", "a | b"}}}}}};
}

Document document() {
    return {
        "Title & <more>",
        {"alpha = 0.1"},
        {{"Ladder", {Paragraph{"At s = 10 the error is 1.25e-3."}, Finding{"found_it"}, table()}}},
        {"contact"},
        {{"theta_L2L2", "temperature"}},
        {{"version", "1"}}};
}

std::string words_of(const std::string& norm) {
    return Norm::named(norm)->words;
}

} // namespace

// As long as a scene may make them: nothing calls itself once a character.
BOOST_AUTO_TEST_CASE(long_texts_are_written) {
    const std::string digits(1'000'000, '1');
    BOOST_TEST(written_number(digits + "." + digits + "e-" + digits)->fraction == digits);
    BOOST_TEST(!written_number(digits + "x"));
    Document document{"^" + digits, {"h^" + digits}, {}, {}, {}, {}};
    document.sections.push_back({"Ladder", {Paragraph{"a^" + digits}}});
    HtmlContents page;
    page.document = document;
    BOOST_TEST(has(html_report(page), "a<sup>" + digits + "</sup>"));
    BOOST_TEST(has(latex_report(document), "a$^{" + digits + "}$"));
    const std::string svg = "<svg \n width=\"600\" height=\"480\" id=\"a\"><title>" + digits +
                            "</title><g id='b' fill='url(#b)'><desc>x</desc></g></svg>";
    BOOST_TEST(inline_svg({"name", "what", svg}) ==
               "<svg \n role=\"img\" aria-label=\"what\" id=\"name-a\"><g id='name-b' "
               "fill='url(#name-b)'></g></svg>");
}

BOOST_AUTO_TEST_CASE(what_stands_behind_a_mark_is_raised) {
    BOOST_TEST(with_raised("h^2 + x^{n} + y^", "^", "<sup>", "</sup>") ==
               "h<sup>2</sup> + x^{n} + y^");
    BOOST_TEST(with_raised("", "^", "<", ">").empty());
}

BOOST_AUTO_TEST_CASE(a_written_number_has_its_parts) {
    const auto number = written_number("-1.25e-3");
    BOOST_REQUIRE(number.has_value());
    BOOST_TEST(number->whole == "-1");
    BOOST_TEST(number->fraction == "25");
    BOOST_TEST(number->exponent == "-3");
    BOOST_TEST(written_number("3.00*")->suffix == "*");
    BOOST_TEST(written_number("160")->fraction.empty());
    for (const std::string text : {"", "failed", "2.0 ± 0.1", "1e", "e-3", "1.e3", "0x1", "16/16"})
        BOOST_TEST(!written_number(text), text);
    // Whatever number_text writes is one.
    for (const double value : {1.0, -0.02, 6.25e-5, 1e22, 123456.0, 3e-320})
        for (const auto& text : {scientific(value, 4), shortest(value), fixed(value, 2)})
            BOOST_TEST(written_number(text).has_value(), text);
}

BOOST_AUTO_TEST_CASE(wrapped_text_keeps_the_blanks_within_a_line) {
    BOOST_TEST(wrapped("  it wrote: L2 =  1\nx", 2, 80) == "it wrote: L2 =  1 x\n");
    BOOST_TEST(wrapped("one  two", 2, 7) == "one\n  two\n");
    BOOST_TEST(wrapped("one  two", 2, 8) == "one  two\n");
}

BOOST_AUTO_TEST_CASE(what_is_rounded_to_zero_has_no_sign) {
    BOOST_TEST(fixed(-0.004, 2) == "0.00");
    BOOST_TEST(fixed(-0.0, 1) == "0.0");
    BOOST_TEST(fixed(-0.006, 2) == "-0.01");
}

BOOST_AUTO_TEST_CASE(the_pieces_of_a_sentence_are_the_sentence) {
    const std::string text = "dt = 6.25e-5, (1e-3) and 2098; at 1.5e-10.";
    std::string joined;
    int numbers = 0;
    for (const auto& piece : pieces_of(text)) {
        joined += piece.text;
        numbers += piece.number ? 1 : 0;
    }
    BOOST_TEST(joined == text);
    BOOST_TEST(numbers == 3); // those with an exponent
}

BOOST_AUTO_TEST_CASE(text_breaks_a_table_that_is_too_wide_and_repeats_its_key) {
    BOOST_TEST(text_table(table(), 80) == "     theta_L2L2\n"
                                          " s   error ord.   note\n"
                                          "10 1.25e-3      failed\n"
                                          "20 7.5e-10 4.01  a | b\n");
    const std::string narrow = text_table(table(), 18);
    BOOST_TEST(has(narrow, "\n\n s   note\n10 failed\n20  a | b\n"), narrow);
    BOOST_TEST(parts_of(table(), 18).size() == 2u);
    BOOST_TEST(parts_of(table(), 80).size() == 1u);
}

BOOST_AUTO_TEST_CASE(latex_sets_points_and_powers_of_ten_below_each_other) {
    const std::string latex = latex_report(document());
    BOOST_TEST(has(latex, "$1$&$.25$&${}\\times10^{-3}$"), latex);
    BOOST_TEST(has(latex, "$7$&$.5$&${}\\times10^{-10}$"), latex);
    // error: three columns, ord.: two, note: text
    BOOST_TEST(has(latex, "\\begin{tabular}{rr@{}l@{}lr@{}ll}"), latex);
    BOOST_TEST(has(latex, "\\multicolumn{5}{c}{theta\\_L2L2}"), latex);
    BOOST_TEST(has(latex, "\\cmidrule(lr){2-6}"), latex);
    BOOST_TEST(has(latex, "the error is $1.25\\times10^{-3}$."), latex);
    for (const std::string rule : {"\\toprule", "\\midrule", "\\bottomrule"})
        BOOST_TEST(has(latex, rule));
    // Every row has as many columns as the table.
    std::istringstream lines(latex);
    bool in_rows = false;
    for (std::string line; std::getline(lines, line);) {
        in_rows = line == "  \\midrule" || (in_rows && line != "  \\bottomrule");
        if (in_rows && line != "  \\midrule")
            BOOST_TEST(std::count(line.begin(), line.end(), '&') == 6, line);
    }
}

// Pages hold 45 rows: 100 rows stand on three, each once.
BOOST_AUTO_TEST_CASE(latex_has_every_row_of_a_table_that_is_longer_than_a_page) {
    Table::Column names{"name", {}};
    for (int i = 0; i < 100; ++i)
        names.cells.push_back("row" + std::to_string(i) + "end");
    Document long_one = document();
    long_one.sections = {{"Rows", {Table{"Rows.", {"", {names}}, {{"", {names}}}}}}};
    const std::string latex = latex_report(long_one);
    for (const auto& name : names.cells) {
        const auto first = latex.find(name);
        BOOST_TEST((first != std::string::npos), name);
        const auto line_end = latex.find('\n', first);
        BOOST_TEST((latex.find(name, line_end) == std::string::npos), name);
    }
}

BOOST_AUTO_TEST_CASE(markdown_has_a_cell_a_column_and_no_markup_of_a_cell) {
    const std::string markdown = markdown_report(document());
    BOOST_TEST(has(markdown, "| s | theta_L2L2 error | theta_L2L2 ord. | note |\n"
                             "| ---: | ---: | ---: | :--- |\n"
                             "| 10 | 1.25e-3 |  | failed |\n"
                             "| 20 | 7.5e-10 | 4.01 | a \\| b |\n"),
               markdown);
    BOOST_TEST(has(markdown, "# Title \\& \\<more\\>\n"), markdown);
    BOOST_TEST(has(markdown, "## What it shows\n\n- found_it\n"), markdown);
    BOOST_TEST(markdown_text("*a* _b_ `c` [d](e) # | ~f~ a_b") ==
               "\\*a\\* \\_b\\_ \\`c\\` \\[d\\](e) \\# \\| \\~f\\~ a_b");
}

BOOST_AUTO_TEST_CASE(html_has_a_table_with_headings_and_aligns_it_by_spaces) {
    const std::string html = html_report({.document = document(),
                                          .failed = false,
                                          .formulas = {},
                                          .figures = {},
                                          .no_figures = "",
                                          .scene_text = ""});
    BOOST_TEST(has(html, "<th class=\"group\" scope=\"colgroup\" colspan=\"2\">theta_L2L2</th>"));
    BOOST_TEST(has(html, "<th scope=\"row\">10</th><td>1.25 × 10<sup>−3\u2007</sup></td>"), html);
    BOOST_TEST(has(html, "<td>7.5 × "
                         "10<sup>−10</sup></td>"),
               html);
    BOOST_TEST(has(html, "<h1>Title &amp; &lt;more&gt;</h1>"));
    BOOST_TEST(has(html, "<figcaption>Errors.</figcaption>"));
    BOOST_TEST(has(html, "<li>found_it</li>"));
}

// https://www.w3.org/TR/xml/#charsets, ISO/IEC 6429 and RFC 3629.
BOOST_AUTO_TEST_CASE(what_a_terminal_would_obey_is_written_out) {
    BOOST_TEST(visible("a\tb\n Δ, é, 中, 😀 \u00A0") == "a\tb\n Δ, é, 中, 😀 \u00A0");
    BOOST_TEST(visible("\033[31m\r\x7f") == "\\x1B[31m\\x0D\\x7F");
    BOOST_TEST(visible("\u0080\u009F") == "\\u0080\\u009F");
    BOOST_TEST(visible("\uFFFE\uFFFF\uFFFD") == "\\uFFFE\\uFFFF\uFFFD");
    // No UTF-8: a lone byte, one that goes on, an overlong /, a surrogate, beyond Unicode, cut
    // short.
    BOOST_TEST(visible("\x9b;") == "\\x9B;");
    BOOST_TEST(visible("\xc0\xaf") == "\\xC0\\xAF");
    BOOST_TEST(visible("\xed\xa0\x80") == "\\xED\\xA0\\x80");
    BOOST_TEST(visible("\xf4\x90\x80\x80") == "\\xF4\\x90\\x80\\x80");
    BOOST_TEST(visible("\xe2\x88") == "\\xE2\\x88");
    // Cut where a character ends, and within what is none.
    for (std::size_t most = 0; most <= 11; ++most)
        BOOST_TEST(
            whole_characters("aé中😀b", most) ==
            std::string("aé中😀b").substr(
                0, std::array<std::size_t, 12>{0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10, 11}.at(most)));
    BOOST_TEST(whole_characters("\xf6\xf6\xf6", 2) == "\xf6\xf6");
}

BOOST_AUTO_TEST_CASE(json_keeps_control_characters_escaped) {
    const nlohmann::ordered_json json{{"title", "\033 \u007f \u0080 \u009f \u00a0 é"}};
    const std::string text = json_text(json);
    BOOST_TEST(text == "{\n  \"title\": \"\\u001b \\u007f \\u0080 \\u009f \u00a0 é\"\n}\n");
    BOOST_TEST(nlohmann::ordered_json::parse(text) == json);
}

BOOST_AUTO_TEST_CASE(no_field_of_csv_is_computed_by_a_spreadsheet) {
    BOOST_TEST(quoted("=HYPERLINK(\"x\",1)") == "\"'=HYPERLINK(\"\"x\"\",1)\"");
    for (const std::string first : {"=", "+", "-", "@", "\t"})
        BOOST_TEST(quoted(first + "1") == "'" + first + "1");
    BOOST_TEST(quoted("a=1") == "a=1");
}

// As analyse reads them: nan is a run that failed, an empty field one that was not made.
BOOST_AUTO_TEST_CASE(of_a_run_that_failed_no_field_is_empty) {
    BOOST_TEST(measure_field({.rung = {}, .errors = {0.25, 0.5}}, 1) == ",0.5");
    BOOST_TEST(measure_field({.rung = {}, .status = RungStatus::failed}, 1) == ",nan");
    BOOST_TEST(measure_field({.rung = {}, .status = RungStatus::interrupted}, 1) == ",");
}

BOOST_AUTO_TEST_CASE(junit_is_xml_whatever_a_scene_is_called) {
    CheckedScene scene{"\033[2J.toml", 0.0, "a \x01 b", {}};
    scene.expectations.push_back({"\u009b", "<1>", "\xff", {}, false});
    const std::string text = junit_report({scene});
    BOOST_TEST(has(text, "\\x1B[2J.toml"), text);
    BOOST_TEST(has(text, "\\u009B"), text);
    BOOST_TEST(has(text, "\\xFF"), text);
    BOOST_TEST(std::none_of(text.begin(), text.end(),
                            [](char c) { return c >= 0 && c < ' ' && c != '\n'; }),
               text);
    // A run that fails is a case beside those of the expectations.
    BOOST_TEST(has(text, "tests=\"2\" failures=\"1\" errors=\"1\""), text);
    scene.error.clear();
    BOOST_TEST(has(junit_report({scene}), "tests=\"1\" failures=\"1\" errors=\"0\""));
    // In Markdown a row, the violations behind the table.
    BOOST_TEST(has(check_markdown({scene, {"good", 0.0, "", {}}}), "| ok | good | 0 | 0 |"));
    scene.name = "bad";
    BOOST_TEST(has(check_markdown({scene}), "| FAIL | bad | 1 | 1 |"));
}

BOOST_AUTO_TEST_CASE(text_is_shown_and_never_taken_for_markup) {
    BOOST_TEST(html_text("<a href=\"x\">'&'\x01</a>") ==
               "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39; &lt;/a&gt;");
    BOOST_TEST(latex_text("50% a_b \\x {y} $ # & ~ ^") ==
               "50\\% a\\_b \\textbackslash{}x \\{y\\} \\$ \\# \\& \\textasciitilde{} "
               "\\textasciicircum{}");
    BOOST_TEST(latex_text("a\x7f") == "a\\textbackslash{}x7F"); // pdflatex stops at it
    BOOST_TEST(latex_text("Fernández ± L∞ 中") == "Fernández $\\pm$ L$^\\infty$ U+4E2D");
    BOOST_TEST(latex_text("\u03BC∇Ω漢😀") ==
               "$\\mu$$\\nabla$$\\Omega$U+6F22U+1F600"); // each its own
    // Greek is known whole: from Α to ω, but for a number that is no letter.
    for (unsigned code = 0x391; code <= 0x3C9; ++code)
        if (const bool is_letter = code != 0x3A2 && (code < 0x3AA || code > 0x3B0); is_letter) {
            const std::string letter{static_cast<char>(0xC0U | code >> 6U),
                                     static_cast<char>(0x80U | (code & 0x3FU))};
            BOOST_TEST(latex_text(letter).find("U+") == std::string::npos, letter);
        }
    BOOST_TEST(latex_text("t → ∞") == "t $\\to$ $\\infty$");
    // A _ within a word is none of Markdown's marks.
    BOOST_TEST(markdown_text("a_b _c d_") == "a_b \\_c d\\_");
}

BOOST_AUTO_TEST_CASE(formulas_are_set_with_raised_exponents_and_greek_letters) {
    BOOST_TEST(html_formula("exp(-t)*sin(pi*x)") ==
               "<i>e</i><sup>−<i>t</i></sup>\u2009sin(<i>π</i>\u2009<i>x</i>)");
    BOOST_TEST(html_formula("g2*x^2") == "<i>g</i><sub>2</sub>\u2009<i>x</i><sup>2</sup>");
    BOOST_TEST(html_formula("x^(-1/2)") == "<i>x</i><sup>−1/2</sup>");
    BOOST_TEST(html_formula("x^sin(t)*u") == "<i>x</i><sup>sin(<i>t</i>)</sup>\u2009<i>u</i>");
    BOOST_TEST(
        html_formula("x^2.5 - t^(a*(b + c))*k") ==
        "<i>x</i><sup>2.5</sup> − <i>t</i><sup><i>a</i>\u2009(<i>b</i> + <i>c</i>)</sup>\u2009"
        "<i>k</i>");
    BOOST_TEST(html_formula("theta_A <= 1") == "<i>θ</i><sub>A</sub> ≤ 1");
    BOOST_TEST(html_formula("a<b&c^") == "<i>a</i>&lt;<i>b</i>&amp;<i>c</i>^");
    const std::string thin = "\u2009";
    std::string letters;
    for (const std::string letter :
         {"α", "β", "γ", "δ", "ζ", "η", "κ", "λ", "μ", "ν", "ρ", "σ", "τ", "φ", "ψ", "ω"})
        letters += (letters.empty() ? "" : thin) + "<i>" + letter + "</i>";
    BOOST_TEST(html_formula("alpha*beta*gamma*delta*zeta*eta*kappa*lambda*mu*nu*rho*sigma*tau*phi*"
                            "psi*omega") == letters);
    // What is called is upright; what is not is slanted.
    BOOST_TEST(html_formula("cosh(k)") == "cosh(<i>k</i>)");
    BOOST_TEST(html_formula("sqrt(x + 1)").starts_with("√("), html_formula("sqrt(x + 1)"));
}

// Both catch the defect at the least factor that is tried.
BOOST_AUTO_TEST_CASE(of_several_that_catch_a_defect_at_the_least_factor_none_is_called_the_first) {
    const TemporaryDirectory directory;
    const StudyResult result = run_study(read_scene(
        directory.write("s.toml", "solution = 'free-oscillation'\n[beam]\nalpha = 0.3\n"
                                  "zeta = 0.05\nstops = [-0.1, 0.1]\n[ladder]\n"
                                  "final_time = 0.5\nelements = [4, 8]\ndt = [0.05, 0.025]\n"
                                  "norms = ['theta_L2L2', 'u_L2H2']\n"
                                  "[expect.ladder.theta_L2L2]\norders = [0.5, 3]\n"
                                  "[expect.ladder.u_L2H2]\norders = [0.5, 3]\n"
                                  "[sensitivity]\nrange = [1e3, 1e4]\n"
                                  "[sensitivity.defect.f]\nheat_source = 'sin(pi*x)'\n"),
        {}, {.expectations = true}));
    std::string found;
    for (const StudyReport* report : reports_of(result))
        if (report->study() == "sensitivity")
            for (const Section& section : report->sections(result))
                for (const Block& block : section.blocks)
                    if (const auto* finding = std::get_if<Finding>(&block))
                        found += finding->text;
    BOOST_TEST(has(found, "or fewer times its size, by ladder.theta_L2L2: observed order; "
                          "ladder.u_L2H2: observed order; 0 of 2"),
               found);
}

// Of two residuals the worse; what a case has not is blank; a remark holds from its first row on.
BOOST_AUTO_TEST_CASE(a_stress_study_has_what_was_measured_of_each_case) {
    StudyResult result = run_study(read_scene("cubic-deflection"));
    result.records.set(StressResult{});
    auto& stress = *result.get<StressResult>();
    StressCase certified;
    certified.outcome = Outcome::certified;
    certified.checks.emplace();
    certified.checks->energy = 2e-13;
    certified.checks->heat_residual = 3.5;
    certified.checks->beam_residual = 1.5;
    certified.checks->error = 0.75;
    certified.checks->order_defect = 0.25;
    StressCase refused;
    refused.outcome = Outcome::refused;
    refused.reason = "no contraction";
    stress.cases.add(certified);
    stress.cases.add(refused);
    RoundOffRow row;
    row.moment.value = 1.234e-15;
    row.sine = 4.321e-16;
    row.hermite_predicted = 1e-13;
    stress.roundoff.emplace();
    for (const std::int64_t elements : {10, 20, 40}) {
        row.elements = elements;
        row.remark = elements > 10 ? "too much" : "";
        stress.roundoff->rows.push_back(row);
    }
    const std::string text = text_document(result_document(result));
    BOOST_TEST(has(text, " 2e-13    3.5\n"), text);
    BOOST_TEST(has(text, "10 1.2e-15 4.3e-16"), text);
    BOOST_TEST(has(text, "from s = 20 on: too much"), text);
    BOOST_TEST(!has(text, "from s = 40 on"), text);
    std::ranges::reverse(stress.roundoff->rows);
    BOOST_TEST(has(text_document(result_document(result)), "from s = 20 on: too much"));
    stress.roundoff->rows.front().remark.clear(); // of s = 40
    BOOST_TEST(has(text_document(result_document(result)), "s = 20: too much"));
    BOOST_TEST(!has(text_document(result_document(result)), "from s = 20 on"));
    stress.reached = {{"stress", 2, 5}, {"stress.contraction", 3, 9}};
    const std::string partial = text_document(result_document(result));
    BOOST_TEST(has(partial, "2 of 5 cases were reached"), partial);
    BOOST_TEST(has(partial, "stress.contraction: 3 of 9 rows were reached"), partial);
    const auto csvs = study_csvs(result);
    const auto csv = std::find_if(csvs.begin(), csvs.end(),
                                  [](const StudyCsv& one) { return one.name == "stress"; });
    BOOST_REQUIRE((csv != csvs.end()));
    const std::string rows = csv->text.whole();
    BOOST_TEST(has(rows, "certified,2e-13,3.5,1.5,0,0,0,0,,0.75,0.25,0,"), rows);
    BOOST_TEST(has(rows, "refused,,,,,,,,,,,0,no contraction\n"), rows);
}

// The texts of a solution phase by phase, its parameters, then what is derived of them, f first; of
// stops that yield their law, where sigma is not given.
BOOST_AUTO_TEST_CASE(the_formulas_of_a_problem_are_its_texts_and_what_is_derived) {
    const TemporaryDirectory directory;
    directory.write("phases.toml", "theta = 'k*sin(pi*x)'\nparameters = {k = '1/2'}\n"
                                   "[[phase]]\nuntil = '1/3'\nu = 'g1*x^2*t/2'\n"
                                   "[[phase]]\nuntil = '1/2'\nu = 'g1*x^2*t'\n"
                                   "[[phase]]\nu = 'g1*x^2*(1 - t)'\nsigma = '0'\n");
    const auto formulas_of = [&](const std::string& problem, const std::string& contact) {
        std::vector<std::string> texts;
        const std::string scene = directory.write(
            "scene.toml", problem + "[beam]\nalpha = 0.3\nzeta = 0.1\nstops = [-0.1, 0.1]\n" +
                              contact +
                              "[ladder]\nfinal_time = 1.0\nelements = [4]\ndt = [0.5]\n"
                              "norms = ['theta_L2L2']\n[reference]\nelements = 8\ndt = 0.25\n");
        for (const Formula& formula : problem_formulas(read_scene(scene)))
            texts.push_back(formula.symbol + " | " + formula.interval + " | " + formula.text);
        return texts;
    };
    const std::vector<std::string> given{"theta | t <= 1/3 | k*sin(pi*x)",
                                         "u | t <= 1/3 | g1*x^2*t/2",
                                         "theta | 1/3 < t <= 1/2 | k*sin(pi*x)",
                                         "u | 1/3 < t <= 1/2 | g1*x^2*t",
                                         "theta | t > 1/2 | k*sin(pi*x)",
                                         "u | t > 1/2 | g1*x^2*(1 - t)",
                                         "sigma | t > 1/2 | 0",
                                         "k |  | 1/2"};
    const auto laws = [](const std::vector<std::string>& texts) {
        return std::count_if(texts.begin(), texts.end(), [](const std::string& text) {
            return text.starts_with("sigma") && text.ends_with("/epsilon");
        });
    };
    for (const std::string contact : {"", "contact = {law = 'penalty', epsilon = 0.01}\n"}) {
        const auto texts = formulas_of("solution = './phases.toml'\n", contact);
        BOOST_REQUIRE(texts.size() > given.size());
        BOOST_TEST(std::vector(texts.begin(), texts.begin() + std::ssize(given)) == given,
                   boost::test_tools::per_element());
        BOOST_TEST(texts[given.size()].starts_with("f | 0 <= t <= 1/3 | "), texts[given.size()]);
        BOOST_TEST(laws(texts) == (contact.empty() ? 0 : 2));
    }
    const std::vector<std::string> data{"theta0 | t = 0 | sin(pi*x)", "u0 | t = 0 | x^2/20",
                                        "f |  | x*t", "q |  | x"};
    BOOST_TEST(formulas_of("[data]\ntheta0 = 'sin(pi*x)'\nu0 = 'x^2/20'\nheat_source = 'x*t'\n"
                           "body_force = 'x'\n",
                           "") == data,
               boost::test_tools::per_element());
}

// 0.343 ± 0.324 rounded would be 0.3 ± 0.4: a size that may be zero.
BOOST_AUTO_TEST_CASE(no_size_is_printed_whose_brackets_reach_past_zero) {
    const auto size = [](double value, double half) {
        TwoTermFit fit;
        fit.model.a = value;
        fit.a_uncertainty = half / value;
        fit.p.determined = true;
        return fit_table({{"theta_L2L2", &fit}}, 1).groups.at(0).columns.at(2).cells.at(0);
    };
    BOOST_TEST(size(0.343, 0.324).empty(), size(0.343, 0.324));
    BOOST_TEST(size(0.343, 0.3).empty(), size(0.343, 0.3));
    BOOST_TEST(size(0.343, 0.19) == "0.3(2)");
    BOOST_TEST(size(0.168, 0.025) == "0.17(3)");
    BOOST_TEST(size(1.68e-5, 0.25e-5) == "1.7(3)e-5");
}

BOOST_AUTO_TEST_CASE(every_norm_has_words_and_no_two_the_same) {
    std::vector<std::string> words;
    for (const auto& name : Norm::names()) {
        words.push_back(words_of(name));
        BOOST_TEST(words.back() != name);
        if (Norm::named(name + "_sq"))
            BOOST_TEST(words_of(name + "_sq") == words.back() + ", squared");
    }
    std::sort(words.begin(), words.end());
    BOOST_TEST((std::adjacent_find(words.begin(), words.end()) == words.end()));
    BOOST_TEST(words_of("u_LinfH2semi_sq") == "deflection in L∞(0,T; H² seminorm), squared");
}

BOOST_AUTO_TEST_CASE(a_decimal_comma_changes_nothing) {
    const HtmlContents contents{.document = document(),
                                .failed = false,
                                .formulas = {{"u", "", "0.5*x^2"}},
                                .figures = {},
                                .no_figures = "",
                                .scene_text = ""};
    const auto all = [&] {
        return text_table(table()) + markdown_report(document()) + latex_report(document()) +
               html_report(contents) + shortest(12345.678) + shortest(1.25e6) +
               significant(1.25e-3, 3) + scientific(0.25, 3) + fixed(1234.5, 2);
    };
    const std::string before = all();
    const CommaLocale locale;
    BOOST_TEST(all() == before);
    BOOST_TEST(significant(0.0, 3) + " " + significant(0.03125, 2) == "0 0.031");
}

// The figures and their legends have the words; a table has the name, and the list of norms both.
BOOST_AUTO_TEST_CASE(findings_begin_with_the_words_of_their_norm) {
    Document page{"T", {}, {}, {}, {{"theta_L2L2", "temperature in L²(0,T; L²)"}}, {}};
    page.sections.push_back(
        {"S", {Finding{"theta_L2L2: order 2.00"}, Finding{"theta_L2L2_sq: other"}}});
    const auto findings = findings_of(page);
    BOOST_REQUIRE(findings.size() == 2U);
    BOOST_TEST(findings[0].text == "temperature in L²(0,T; L²): order 2.00");
    BOOST_TEST(findings[1].text == "theta_L2L2_sq: other");
}

BOOST_AUTO_TEST_CASE(details_are_a_list_within_that_of_the_findings) {
    HtmlContents page;
    page.document.sections.push_back(
        {"S", {Finding{"whole"}, Finding{"part 1", 4}, Finding{"part 2", 4}}});
    BOOST_TEST(has(html_report(page), "<li>whole\n<ul>\n<li>part 1</li>\n<li>part 2</li>\n</ul>\n"
                                      "</li>\n</ul>\n"));
    page.document.sections.back().blocks.emplace_back(Finding{"another"});
    BOOST_TEST(has(html_report(page), "<li>part 2</li>\n</ul>\n</li>\n<li>another</li>\n</ul>\n"));
}

BOOST_AUTO_TEST_CASE(a_page_that_shows_nothing_in_words_has_no_empty_box) {
    HtmlContents page;
    page.document.title = "A sweep";
    BOOST_TEST(!has(html_report(page), "What it shows"));
    page.failed = true;
    BOOST_TEST(has(html_report(page), "What it shows"));
}

BOOST_AUTO_TEST_SUITE_END()

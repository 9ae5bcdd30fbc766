#include "reports/formats/html_report.hpp"

#include "reports/document/html_text.hpp"
#include "reports/document/raised_text.hpp"
#include "reports/document/written_number.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace tvbeam {

namespace {

const char* const style = R"(
:root { color-scheme: light dark; --ink: #1c2126; --quiet: #57606a; --rule: #c9d1d9; --page: #fff;
  --card: #f5f7f9; --accent: #0072b2; --shade: #0005; }
@media (prefers-color-scheme: dark) { :root { --ink: #e3e8ec; --quiet: #9aa7b2; --rule: #3a444d;
  --page: #14181c; --card: #1d2329; --accent: #56b4e9; --shade: #fff5; } }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; max-width: 72rem; padding: 1.5rem 1rem 3rem; background: var(--page);
  color: var(--ink); font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans",
  sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 .5rem; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 .7rem; padding-bottom: .25rem;
  border-bottom: 1px solid var(--rule); }
p { margin: .5rem 0; }
p, li, figcaption, dd { max-width: 48rem; }
.quiet, figcaption { color: var(--quiet); }
.verdict { background: var(--card); border-left: .3rem solid var(--accent); border-radius: .3rem;
  margin: 1.4rem 0; padding: .8rem 1rem; }
.verdict h2 { border: 0; margin: 0 0 .3rem; padding: 0; }
.verdict.failed { border-left-color: #d55e00; }
ul { margin: .4rem 0; padding-left: 1.25rem; }
li { margin: .25rem 0; }
figure { margin: 1.2rem 0; min-width: 0; }
figcaption { font-size: .9rem; margin-bottom: .4rem; }
.figures { display: grid; gap: 1.2rem; align-items: start;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); }
.figures figure { margin: 0; }
.picture { background: #fff; border: 1px solid var(--rule); border-radius: .3rem; padding: .4rem;
  max-width: 46rem; }
.picture svg { display: block; height: auto; width: 100%; }
@media (prefers-color-scheme: dark) { .picture { background: #14181c; }
  .picture svg { filter: invert(.91) hue-rotate(180deg); } }
.figures figcaption { margin: .4rem 0 0; }
/* Where a table goes on beyond the edge, a shadow stands there. */
.scroll { overflow-x: auto; background: linear-gradient(to right, var(--page) 30%, transparent) left / 2.5rem 100%,
  linear-gradient(to left, var(--page) 30%, transparent) right / 2.5rem 100%,
  linear-gradient(to right, var(--shade), transparent) left / .9rem 100%,
  linear-gradient(to left, var(--shade), transparent) right / .9rem 100%;
  background-repeat: no-repeat; background-attachment: local, local, scroll, scroll; }
.scroll:focus-visible { outline: 2px solid var(--accent); }
table { border-collapse: collapse; font-size: .92rem; font-variant-numeric: tabular-nums;
  overflow-wrap: normal; border-top: 2px solid var(--ink); border-bottom: 2px solid var(--ink); }
th, td { padding: .2rem .6rem; text-align: right; white-space: nowrap; }
th { font-weight: 600; }
th.group { border-bottom: 1px solid var(--rule); text-align: center; }
th.text, td.text { text-align: left; }
tbody tr:first-child > * { border-top: 1px solid var(--ink); }
tbody th { font-weight: 400; }
sup, sub { font-size: .72em; line-height: 0; }
.number { white-space: nowrap; }
pre { background: var(--card); border-radius: .3rem; font-size: .85rem; line-height: 1.4; margin: .6rem 0;
  overflow-x: auto; overflow-wrap: normal; padding: .7rem .9rem; }
dl { margin: .5rem 0; }
dt { color: var(--quiet); font-size: .9rem; margin-top: .5rem; }
dd { margin: 0; }
.formula { font-family: "Latin Modern Roman", "STIX Two Text", Georgia, "Times New Roman", serif;
  font-size: 1.08rem; }
dl.formulas dd { padding-left: 1rem; text-indent: -1rem; max-width: 60rem; }
@media (min-width: 48rem) { dl.rows, dl.formulas { display: grid; grid-template-columns: max-content 1fr;
  gap: .2rem 1.2rem; } dl dt { margin: 0; padding-top: .1rem; } body { padding: 2.5rem 2rem 4rem; } }
@media print { body { max-width: none; } .scroll { overflow: visible; } }
)";

/// A number with its power of ten, and behind it, unseen, what a longer one of its column has more.
std::string html_number(const WrittenNumber& number, const NumberColumn& column) {
    std::string whole = number.whole;
    if (whole.starts_with('-'))
        whole.replace(0, 1, "−");
    std::string html = whole + (number.fraction.empty() ? "" : "." + number.fraction);
    std::string missing(column.fraction - std::min(column.fraction, number.fraction.size()), '0');
    if (!missing.empty() && number.fraction.empty())
        missing.insert(0, ".");
    // Spaces as wide as a digit and as a point: what reads the text alone sees no digits there.
    const auto unseen = [](const std::string& text) {
        std::string spaces;
        for (const char c : text)
            spaces += c == '.' ? "\u2008" : "\u2007";
        return spaces;
    };
    // Powers of ten stand below each other already; a gap before them would not be understood.
    html += number.suffix.empty() && column.exponent == 0 ? unseen(missing) : "";
    const std::string power = " × 10<sup>";
    if (!number.exponent.empty()) {
        std::string exponent = number.exponent;
        const std::string more(column.exponent - std::min(column.exponent, exponent.size()), '0');
        if (exponent.starts_with('-'))
            exponent.replace(0, 1, "−");
        html += power + exponent + unseen(more) + "</sup>";
    }
    return html + html_text(number.suffix);
}

/// Words with the ∞ of a space raised, as the ² of another is.
std::string html_words(const std::string& text) {
    return boost::algorithm::replace_all_copy(html_text(text), "L∞", "L<sup>∞</sup>");
}

/// Its numbers with powers of ten, and what stands behind a ^ raised.
std::string html_sentence(const std::string& text) {
    std::string html;
    for (const auto& piece : pieces_of(text))
        html += piece.number
                    ? "<span class=\"number\">" + html_number(*piece.number, {}) + "</span>"
                    : with_raised(html_words(piece.text), "^", "<sup>", "</sup>");
    return html;
}

std::string html_cell(const std::string& text, const NumberColumn& column) {
    const auto number = written_number(text);
    return number ? html_number(*number, column) : html_sentence(text);
}

/// The head: a row with the groups' headings where one has any, and a row with the columns'.
std::string table_head(const Table& table) {
    std::string groups;
    std::string columns;
    bool has_groups = false;
    const auto add = [&](const Table::Group& group) {
        has_groups = has_groups || !group.heading.empty();
        groups += group.heading.empty()
                      ? fmt::format("<td colspan=\"{}\"></td>", group.columns.size())
                      : fmt::format("<th class=\"group\" scope=\"colgroup\" colspan=\"{}\">{}</th>",
                                    group.columns.size(), html_text(group.heading));
        for (const auto& column : group.columns)
            columns += fmt::format("<th scope=\"col\"{}>{}</th>",
                                   number_column(column.cells).is_text ? " class=\"text\"" : "",
                                   html_text(column.heading));
    };
    add(table.key);
    for (const auto& group : table.groups)
        add(group);
    return "<thead>\n" + (has_groups ? "<tr>" + groups + "</tr>\n" : std::string()) + "<tr>" +
           columns + "</tr>\n</thead>\n";
}

std::string html_of(const Table& table) {
    std::vector<std::string> rows(table.rows());
    bool is_key = true;
    const auto add = [&](const Table::Group& group) {
        for (const auto& column : group.columns) {
            const NumberColumn numbers = number_column(column.cells);
            for (std::size_t row = 0; row < rows.size(); ++row)
                rows[row] +=
                    fmt::format("<{0}{1}>{2}</{3}>", is_key ? "th scope=\"row\"" : "td",
                                numbers.is_text ? " class=\"text\"" : "",
                                html_cell(column.cells[row], numbers), is_key ? "th" : "td");
            is_key = false;
        }
    };
    add(table.key);
    for (const auto& group : table.groups)
        add(group);
    std::string html = "<figure>\n";
    if (!table.caption.empty())
        html += "<figcaption>" + html_sentence(table.caption) + "</figcaption>\n";
    html += "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" +
            html_text(table.caption) + "\">\n<table>\n" + table_head(table) + "<tbody>\n";
    for (const auto& row : rows)
        html += "<tr>" + row + "</tr>\n";
    return html + "</tbody>\n</table>\n</div>\n</figure>\n";
}

std::string html_of(const Paragraph& paragraph) {
    return paragraph.introduces ? "" : "<p>" + html_sentence(paragraph.text) + "</p>\n";
}

std::string html_of(const Item& item) {
    return "<li>" + html_sentence(item.text) + "</li>\n";
}

std::string html_of(const Finding& /*unused*/) {
    return {}; // at the head
}

std::string html_of(const Preformatted& text) {
    return "<pre>" + html_text(text.lines) + "</pre>\n";
}

std::string html_of(const BlankLine& /*unused*/) {
    return {};
}

std::string html_heading(const std::string& title) {
    return "<h2>" + html_text(title) + "</h2>\n";
}

std::string html_of(const Section& section) {
    std::string html = "<section>\n" + html_heading(section.title);
    bool in_list = false;
    for (const auto& block : section.blocks) {
        const std::string one = std::visit([](const auto& shown) { return html_of(shown); }, block);
        if (one.empty())
            continue;
        const bool is_item = std::holds_alternative<Item>(block);
        if (is_item != in_list)
            html += is_item ? "<ul>\n" : "</ul>\n";
        in_list = is_item;
        html += one;
    }
    return html + (in_list ? "</ul>\n" : "") + "</section>\n";
}

/// Details are lists within the list.
std::string html_of(const std::vector<Finding>& findings) {
    std::string html = "<ul>\n";
    for (std::size_t i = 0; i < findings.size(); ++i) {
        html += "<li>" + html_sentence(findings[i].text);
        if (i + 1 < findings.size() && findings[i + 1].indent > 2 && findings[i].indent <= 2) {
            html += "\n<ul>\n";
            for (; i + 1 < findings.size() && findings[i + 1].indent > 2; ++i)
                html += "<li>" + html_sentence(findings[i + 1].text) + "</li>\n";
            html += "</ul>\n";
        }
        html += "</li>\n";
    }
    return html + "</ul>\n";
}

std::string rows_of(const std::vector<std::pair<std::string, std::string>>& rows) {
    std::string html = "<dl class=\"rows\">\n";
    for (const auto& [name, value] : rows)
        html += "<dt>" + html_text(name) + "</dt><dd>" + html_words(value) + "</dd>\n";
    return html + "</dl>\n";
}

std::string list_of(const std::vector<std::string>& items) {
    std::string html = "<ul>\n";
    for (const auto& item : items)
        html += "<li>" + html_sentence(item) + "</li>\n";
    return html + "</ul>\n";
}

std::string verdict_of(const HtmlContents& contents) {
    std::string html =
        contents.failed ? "<section class=\"verdict failed\">\n" : "<section class=\"verdict\">\n";
    html += html_heading("What it shows");
    html += contents.interrupted
                ? "<p><strong>The study was interrupted; this is what had finished.</strong></p>\n"
            : contents.failed
                ? "<p><strong>A run failed; the tables say which and why.</strong></p>\n"
            : contents.scene_text.empty() ? "" // a table of data: nothing was run
                                          : "<p>Every run finished.</p>\n";
    const auto findings = findings_of(contents.document);
    if (findings.empty() && !html.ends_with("</p>\n"))
        return "";
    return html + (findings.empty() ? "" : html_of(findings)) + "</section>\n";
}

std::string figures_of(const HtmlContents& contents) {
    std::string html;
    for (const auto& figure : contents.figures)
        if (!figure.svg.empty())
            html += "<figure>\n<div class=\"picture\">\n" + inline_svg(figure) +
                    "</div>\n<figcaption>" + html_sentence(figure.caption) +
                    "</figcaption>\n</figure>\n";
    if (!html.empty())
        html = "<div class=\"figures\">\n" + html + "</div>\n";
    if (!contents.no_figures.empty())
        html += "<p>" + html_text(contents.no_figures) + ".</p>\n";
    return html.empty() ? html : "<section>\n" + html_heading("Figures") + html + "</section>\n";
}

std::string problem_of(const HtmlContents& contents) {
    if (contents.formulas.empty())
        return {};
    std::string html = "<section>\n" + html_heading("The problem") +
                       "<p class=\"formula\"><i>θ</i><sub>t</sub> − <i>θ</i><sub>xx</sub> = "
                       "<i>α</i> <i>u</i><sub>xxt</sub> + <i>f</i><br>\n"
                       "<i>σ</i> = −<i>u</i><sub>xxx</sub> − <i>ζ</i> <i>u</i><sub>xxxt</sub> − "
                       "<i>α</i> <i>θ</i><sub>x</sub> + <i>G</i><br>\n";
    if (std::any_of(contents.formulas.begin(), contents.formulas.end(),
                    [](const Formula& formula) { return formula.symbol == "q"; }))
        html += "<i>σ</i><sub>x</sub> = <i>q</i><br>\n";
    html += "<i>m</i> = <i>u</i><sub>xx</sub>(1,<i>t</i>) + <i>ζ</i> "
            "<i>u</i><sub>xxt</sub>(1,<i>t</i>)</p>\n<dl class=\"formulas\">\n";
    for (const auto& formula : contents.formulas)
        html += "<dt>" + html_formula(formula.symbol) +
                (formula.interval.empty() ? "" : ", " + html_formula(formula.interval)) +
                "</dt><dd class=\"formula\">" + html_formula(formula.text) + "</dd>\n";
    return html + "</dl>\n</section>\n";
}

/// The text with a word behind each of the marks.
std::string with_behind(std::string_view text, std::string_view mark, std::string_view word) {
    std::string result;
    for (auto at = text.find(mark); at != std::string_view::npos; at = text.find(mark)) {
        result.append(text.substr(0, at + mark.size())).append(word);
        text.remove_prefix(at + mark.size());
    }
    return result.append(text);
}

/// Without the elements of this name, which hold text alone.
std::string without_element(std::string_view text, const std::string& name) {
    const std::string begin = "<" + name + ">";
    const std::string end = "</" + name + ">";
    std::string result;
    for (auto at = text.find(begin); at != std::string_view::npos; at = text.find(begin)) {
        result += text.substr(0, at);
        text.remove_prefix(at);
        const auto behind = text.find('<', begin.size());
        const bool whole = behind != std::string_view::npos && text.substr(behind).starts_with(end);
        if (!whole)
            result += begin;
        text.remove_prefix(whole ? behind + end.size() : begin.size());
    }
    return result.append(text);
}

} // namespace

std::string inline_svg(const Figure& figure) {
    std::string svg = figure.svg;
    svg.erase(0, std::min(svg.find("<svg"), svg.size()));
    const std::string prefix = figure.name + "-";
    for (const char* mark : {" id=\"", " id='", "href=\"#", "href='#", "url(#"})
        svg = with_behind(svg, mark, prefix);
    // Its titles would pop up as hints; what a picture shows is said by its label.
    svg = without_element(without_element(svg, "title"), "desc");
    // Its size is the page's matter.
    const auto width = svg.find("width=\"");
    const auto height = svg.find("\" height=\"", width);
    const auto end = height == std::string::npos ? height : svg.find('"', height + 10);
    if (end < svg.find('>'))
        svg.replace(width - 1, end + 2 - width,
                    " role=\"img\" aria-label=\"" + html_text(figure.caption) + "\"");
    return svg;
}

std::string html_report(const HtmlContents& contents) {
    const Document& document = contents.document;
    std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<title>" +
                       html_text(document.title) + "</title>\n<style>" + style +
                       "</style>\n</head>\n<body>\n<main>\n<h1>" + html_text(document.title) +
                       "</h1>\n";
    for (const auto& sentence : document.head)
        html += "<p class=\"quiet\">" + html_sentence(sentence) + "</p>\n";
    html += verdict_of(contents) + figures_of(contents);
    for (const auto& section : document.sections)
        html += html_of(section);
    if (!document.norms.empty())
        html += "<section>\n" + html_heading("Norms of the errors") + rows_of(document.norms) +
                "</section>\n";
    html += problem_of(contents);
    if (!document.left_out.empty())
        html += "<section>\n" + html_heading("Left out, as the scene does not need it") +
                list_of(document.left_out) + "</section>\n";
    html += "<section>\n" + html_heading("Where it comes from") + rows_of(document.provenance) +
            (contents.scene_text.empty()
                 ? ""
                 : "<p>The scene:</p>\n<pre>" + html_text(contents.scene_text) + "</pre>\n") +
            "</section>\n";
    return html + "</main>\n</body>\n</html>\n";
}

} // namespace tvbeam

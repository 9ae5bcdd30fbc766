#include "reports/formats/latex_report.hpp"

#include "mms/text/visible_text.hpp"
#include "reports/document/raised_text.hpp"
#include "reports/document/text_table.hpp"
#include "reports/document/written_number.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/table_row.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tvbeam {

namespace {

/// In characters of text_table: what a line of small letters holds between A4's margins.
constexpr std::size_t line_width = 92;
/// On a page, below a caption.
constexpr std::size_t rows_of_page = 45;

/// The bytes of the character that begins at `at`.
std::size_t length_of_character(const std::string& text, std::size_t at) {
    std::size_t length = 1;
    while (at + length < text.size() &&
           (static_cast<unsigned char>(text[at + length]) & 0xC0U) == 0x80U)
        ++length;
    return length;
}

/// What stands for a character other than itself. Long, since it is a table.
const std::map<std::string, std::string>& commands() {
    static const std::map<std::string, std::string> all{
        {"\\", "\\textbackslash{}"},
        {"{", "\\{"},
        {"}", "\\}"},
        {"$", "\\$"},
        {"&", "\\&"},
        {"#", "\\#"},
        {"%", "\\%"},
        {"_", "\\_"},
        {"^", "\\textasciicircum{}"},
        {"~", "\\textasciitilde{}"},
        {"<", "$<$"},
        {">", "$>$"},
        {"|", "$|$"},
        {"\"", "{\\ttfamily\\char34}"},
        {"`", "\\textasciigrave{}"},
        {"'", "'"},
        {"-", "{-}"},
        {"±", "$\\pm$"},
        {"×", "$\\times$"},
        {"·", "$\\cdot$"},
        {"µ", "$\\mu$"},
        {"²", "$^2$"},
        {"³", "$^3$"},
        {"¹", "$^1$"},
        {"°", "$^\\circ$"},
        {"∞", "$\\infty$"},
        {"≤", "$\\le$"},
        {"≥", "$\\ge$"},
        {"≈", "$\\approx$"},
        {"≠", "$\\ne$"},
        {"−", "$-$"},
        {"→", "$\\to$"},
        {"√", "$\\surd$"},
        {"∂", "$\\partial$"},
        {"∇", "$\\nabla$"},
        {"‖", "$\\|$"},
        {"…", "\\ldots{}"},
        {"–", "--"},
        {"—", "---"},
        {"“", "``"},
        {"”", "''"},
        {"’", "'"},
        {"α", "$\\alpha$"},
        {"β", "$\\beta$"},
        {"γ", "$\\gamma$"},
        {"δ", "$\\delta$"},
        {"ε", "$\\varepsilon$"},
        {"ϵ", "$\\epsilon$"},
        {"ζ", "$\\zeta$"},
        {"η", "$\\eta$"},
        {"θ", "$\\theta$"},
        {"ϑ", "$\\vartheta$"},
        {"ι", "$\\iota$"},
        {"κ", "$\\kappa$"},
        {"λ", "$\\lambda$"},
        {"μ", "$\\mu$"},
        {"ν", "$\\nu$"},
        {"ξ", "$\\xi$"},
        {"ο", "$o$"},
        {"π", "$\\pi$"},
        {"ϖ", "$\\varpi$"},
        {"ρ", "$\\rho$"},
        {"ϱ", "$\\varrho$"},
        {"σ", "$\\sigma$"},
        {"ς", "$\\varsigma$"},
        {"τ", "$\\tau$"},
        {"υ", "$\\upsilon$"},
        {"φ", "$\\varphi$"},
        {"ϕ", "$\\phi$"},
        {"χ", "$\\chi$"},
        {"ψ", "$\\psi$"},
        {"ω", "$\\omega$"},
        {"Γ", "$\\Gamma$"},
        {"Δ", "$\\Delta$"},
        {"∆", "$\\Delta$"},
        {"Θ", "$\\Theta$"},
        {"Λ", "$\\Lambda$"},
        {"Ξ", "$\\Xi$"},
        {"Π", "$\\Pi$"},
        {"Σ", "$\\Sigma$"},
        {"Υ", "$\\Upsilon$"},
        {"Φ", "$\\Phi$"},
        {"Ψ", "$\\Psi$"},
        {"Ω", "$\\Omega$"},
        {"Ω", "$\\Omega$"},
        {"Α", "A"},
        {"Β", "B"},
        {"Ε", "E"},
        {"Ζ", "Z"},
        {"Η", "H"},
        {"Ι", "I"},
        {"Κ", "K"},
        {"Μ", "M"},
        {"Ν", "N"},
        {"Ο", "O"},
        {"Ρ", "P"},
        {"Τ", "T"},
        {"Χ", "X"},
    };
    return all;
}

/// Letters with accents that the default fonts have, from À to ž.
bool is_accented_letter(const std::string& character) {
    if (character.size() != 2 || character < "À" || character > "ž")
        return false;
    static const std::vector<std::string> missing{"Ð", "Þ", "ð", "þ", "÷", "Ą", "ą", "Đ", "đ",
                                                  "Ę", "ę", "Ħ", "ħ", "Į", "į", "ĸ", "Ŀ", "ŀ",
                                                  "ŉ", "Ŋ", "ŋ", "Ŧ", "ŧ", "Ų", "ų", "ſ"};
    return std::find(missing.begin(), missing.end(), character) == missing.end();
}

std::string latex_character(const std::string& character) {
    if (const auto found = commands().find(character); found != commands().end())
        return found->second;
    if (character.size() == 1)
        return static_cast<unsigned char>(character.front()) < ' ' ? " " : character;
    return is_accented_letter(character) ? character : code_text(character);
}

std::string power_of_ten(const WrittenNumber& number) {
    return number.exponent.empty() ? "" : fmt::format("\\times10^{{{}}}", number.exponent);
}

/// The first cell of a row: rules and ends of rows take what begins with [ or * for an option.
std::string first_cell(const std::string& latex) {
    return "  " + std::string(latex.starts_with('[') || latex.starts_with('*') ? "{}" : "") + latex;
}

/// The columns of LaTeX that one column takes: one for what stands before the point, one behind
/// it, one for the power of ten.
struct Layout {
    explicit Layout(const Table::Column& column) : numbers(number_column(column.cells)) {}

    [[nodiscard]] std::size_t width() const {
        return 1 + (numbers.fraction > 0 ? 1U : 0U) + (numbers.exponent > 0 ? 1U : 0U);
    }
    [[nodiscard]] std::string specification() const {
        std::string text = numbers.is_text ? "l" : "r";
        for (std::size_t i = 1; i < width(); ++i)
            text += "@{}l";
        return text;
    }
    [[nodiscard]] std::string spanning(const std::string& text, const char* alignment) const {
        if (width() == 1 && alignment == std::string(numbers.is_text ? "l" : "r"))
            return text;
        return fmt::format("\\multicolumn{{{}}}{{{}}}{{{}}}", width(), alignment, text);
    }
    [[nodiscard]] std::string heading(const std::string& text) const {
        return spanning(latex_text(text), numbers.is_text ? "l" : width() == 1 ? "r" : "c");
    }
    [[nodiscard]] std::string cell(const std::string& text) const {
        const auto number = written_number(text);
        if (!number)
            return text.empty() ? std::string(width() - 1, '&')
                                : spanning(latex_sentence(text), numbers.is_text ? "l" : "r");
        std::string latex = "$" + number->whole + "$";
        if (numbers.fraction > 0)
            latex += number->fraction.empty() ? "&" : "&$." + number->fraction + "$";
        if (numbers.exponent > 0)
            latex += number->exponent.empty() ? "&" : "&${}" + power_of_ten(*number) + "$";
        return latex + latex_text(number->suffix);
    }

    NumberColumn numbers;
};

/// All columns of a table, those of the key first, with their layouts.
struct LaidOut {
    explicit LaidOut(const Table& table) {
        const auto add = [this](const Table::Group& group) {
            for (const auto& column : group.columns) {
                columns.push_back(&column);
                layouts.emplace_back(column);
            }
        };
        add(table.key);
        for (const auto& group : table.groups)
            add(group);
    }
    std::vector<const Table::Column*> columns;
    std::vector<Layout> layouts;
};

/// The headings of the groups with a rule below each; empty where no group has one.
std::string group_headings(const Table& table) {
    std::string headings;
    std::string rules;
    std::size_t first = 1;
    const auto add = [&](const Table::Group& group) {
        std::size_t width = 0;
        for (const auto& column : group.columns)
            width += Layout(column).width();
        headings += first == 1 ? "" : " & ";
        headings += group.heading.empty() ? std::string(width - 1, '&')
                                          : fmt::format("\\multicolumn{{{}}}{{c}}{{{}}}", width,
                                                        latex_text(group.heading));
        if (!group.heading.empty())
            rules += fmt::format(" \\cmidrule(lr){{{}-{}}}", first, first + width - 1);
        first += width;
    };
    add(table.key);
    for (const auto& group : table.groups)
        add(group);
    return rules.empty() ? "" : "  " + headings + " \\\\" + rules + "\n";
}

std::string tabular(const Table& table, std::size_t first_row, std::size_t end_row) {
    const LaidOut out(table);
    std::string specification;
    std::string headings;
    for (std::size_t i = 0; i < out.columns.size(); ++i) {
        specification += out.layouts[i].specification();
        const std::string heading = out.layouts[i].heading(out.columns[i]->heading);
        headings += i == 0 ? first_cell(heading) : " & " + heading;
    }
    std::string text = "\\begin{tabular}{" + specification + "}\n  \\toprule\n" +
                       group_headings(table) + headings + " \\\\\n  \\midrule\n";
    for (std::size_t row = first_row; row < end_row; ++row) {
        for (std::size_t i = 0; i < out.columns.size(); ++i) {
            const std::string cell = out.layouts[i].cell(out.columns[i]->cells[row]);
            text += i == 0 ? first_cell(cell) : " & " + cell;
        }
        text += " \\\\\n";
    }
    return text + "  \\bottomrule\n\\end{tabular}";
}

std::string latex_of(const Table& table) {
    std::string text;
    for (const auto& part : parts_of(table, line_width))
        for (std::size_t row = 0; row < part.rows(); row += rows_of_page) {
            const std::string caption = text.empty() ? latex_sentence(part.caption) : "Continued.";
            text += "\\begin{inplace}\n\\caption{" + caption + "}\n\\fitted{%\n" +
                    tabular(part, row, std::min(row + rows_of_page, part.rows())) +
                    "}\n\\end{inplace}\n\n";
        }
    return text;
}

std::string latex_of(const Paragraph& paragraph) {
    return paragraph.introduces ? "" : latex_sentence(paragraph.text) + "\n\n";
}

std::string latex_of(const Item& item) {
    return "\\point{" + latex_sentence(item.text) + "}\n\n";
}

std::string latex_of(const Finding& /*unused*/) {
    return {}; // at the head
}

std::string latex_of(const Preformatted& text) {
    std::string lines;
    for (std::size_t at = 0; at < text.lines.size();) {
        const std::size_t length = length_of_character(text.lines, at);
        lines += length == 1 ? text.lines[at] : '?';
        at += length;
    }
    return "{\\footnotesize\n\\begin{verbatim}\n" + lines + "\\end{verbatim}\n}\n\n";
}

std::string latex_of(const BlankLine& /*unused*/) {
    return {};
}

std::string latex_of(const Section& section) {
    std::string text = "\\section*{" + latex_text(section.title) + "}\n\n";
    for (const auto& block : section.blocks)
        text += std::visit([](const auto& one) { return latex_of(one); }, block);
    return text;
}

std::string points(const std::vector<std::string>& sentences) {
    std::string text;
    for (const auto& sentence : sentences)
        text += "\\point{" + latex_sentence(sentence) + "}\n\n";
    return text;
}

/// A list without spaces may break behind its commas.
std::string breakable(std::string latex) {
    boost::algorithm::replace_all(latex, ",", ",\\allowbreak{}");
    return latex;
}

/// A table of two columns of text.
std::string pairs(const std::vector<std::pair<std::string, std::string>>& rows) {
    std::string text = "\\noindent\\begin{tabular}{@{}lp{0.75\\linewidth}@{}}\n";
    for (const auto& [name, value] : rows)
        text += first_cell(latex_text(name)) + " & " + breakable(latex_text(value)) + " \\\\\n";
    return text + "\\end{tabular}\n\n";
}

const char* const preamble =
    R"(% Written by tvbeam. For a text of your own, take the tabular environments; they need booktabs.
\documentclass[a4paper]{article}
\usepackage{amsmath,booktabs,graphicx}
\usepackage[margin=2cm]{geometry}
\setlength{\tabcolsep}{4pt}
\newsavebox{\tablebox}
% A table that is wider than the page is made smaller.
\newcommand{\fitted}[1]{\sbox{\tablebox}{#1}\ifdim\wd\tablebox>\linewidth
  \resizebox{\linewidth}{!}{\usebox{\tablebox}}\else\usebox{\tablebox}\fi}
% A table that stands where it is, with a caption above it.
\makeatletter
\newenvironment{inplace}{\par\medskip\noindent\begin{minipage}{\linewidth}\centering\footnotesize
  \def\@captype{table}\abovecaptionskip=0pt \belowcaptionskip=5pt }{\end{minipage}\par\bigskip}
\makeatother
\newcommand{\point}[1]{\par\noindent\hangindent=1.5em\hangafter=1 \makebox[1.5em][l]{--}#1}
\begin{document}
\emergencystretch=3em
)";

} // namespace

std::string latex_text(const std::string& given) {
    const std::string text = visible(given); // pdflatex stops at some control characters
    std::string latex;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = length_of_character(text, at);
        const std::string character = text.substr(at, length);
        // The spaces of the norms: L², L∞.
        latex +=
            character == "∞" && latex.ends_with('L') ? "$^\\infty$" : latex_character(character);
        at += length;
    }
    return latex;
}

std::string latex_sentence(const std::string& text) {
    std::string latex;
    for (const auto& piece : pieces_of(text)) {
        if (const auto& number = piece.number)
            latex += "$" + number->whole +
                     (number->fraction.empty() ? "" : "." + number->fraction) +
                     power_of_ten(*number) + "$";
        else
            latex += with_raised(latex_text(piece.text), "\\textasciicircum{}", "$^{", "}$");
    }
    return latex;
}

std::string latex_report(const Document& document) {
    std::string text = preamble;
    text += "\\section*{" + latex_text(document.title) + "}\n\n";
    for (const auto& sentence : document.head)
        text += "\\noindent " + latex_sentence(sentence) + "\n\n";
    std::vector<std::string> findings;
    for (const auto& finding : findings_of(document))
        findings.push_back(finding.text);
    if (!findings.empty())
        text += "\\subsection*{What it shows}\n\n" + points(findings);
    if (!document.norms.empty())
        text += "\\subsection*{Norms of the errors}\n\n" + pairs(document.norms);
    for (const auto& section : document.sections)
        text += latex_of(section);
    if (!document.left_out.empty())
        text += "\\subsection*{Left out, as the scene does not need it}\n\n" +
                points(document.left_out);
    text += "\\subsection*{Where it comes from}\n\n" + pairs(document.provenance);
    return text + "\\end{document}\n";
}

struct LatexFormat final : ReportFormat {
    std::string name() const override { return "latex"; }
    std::vector<std::string> certain_files() const override { return {"table.tex"}; }
    std::vector<NamedText> write(const ReportContents& contents) const override {
        return {{"table.tex", latex_report(contents.reported.document)}};
    }
};

template std::unique_ptr<const ReportFormat> make_row<ReportFormat, LatexFormat>();

} // namespace tvbeam

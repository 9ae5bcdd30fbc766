#include "reports/document/html_text.hpp"

#include "mms/text/visible_text.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

namespace tvbeam {

namespace {

bool begins_name(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// A name in a formula: functions upright, Greek letters by their names, what is behind a _ or is
/// a digit lowered.
std::string html_name(const std::string& name, bool is_function) {
    static const std::map<std::string, std::string> letters{
        {"pi", "π"},   {"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"}, {"delta", "δ"},
        {"zeta", "ζ"}, {"eta", "η"},   {"theta", "θ"}, {"kappa", "κ"}, {"lambda", "λ"},
        {"mu", "μ"},   {"nu", "ν"},    {"rho", "ρ"},   {"sigma", "σ"}, {"tau", "τ"},
        {"phi", "φ"},  {"psi", "ψ"},   {"omega", "ω"}};
    if (is_function)
        return name == "sqrt" ? "√" : name;
    std::size_t end = name.find('_');
    if (end == std::string::npos) {
        end = name.size();
        while (end > 1 && std::isdigit(static_cast<unsigned char>(name[end - 1])) != 0)
            --end;
    }
    const std::string base = name.substr(0, end);
    const auto letter = letters.find(base);
    std::string html = "<i>" + (letter == letters.end() ? base : letter->second) + "</i>";
    const std::size_t below = end + (end < name.size() && name[end] == '_' ? 1 : 0);
    if (below < name.size())
        html += "<sub>" + name.substr(below) + "</sub>";
    return html;
}

/// The end of what a ^ at `at` − 1 raises: a group in brackets, or a name or number, with the
/// brackets of a call behind it.
std::size_t end_of_exponent(const std::string& formula, std::size_t at) {
    std::size_t end = at;
    while (end < formula.size() && (is_of_name(formula[end]) || formula[end] == '.'))
        ++end;
    if (end < formula.size() && formula[end] == '(') {
        int depth = 0;
        do {
            depth += formula[end] == '(' ? 1 : formula[end] == ')' ? -1 : 0;
            ++end;
        } while (depth > 0 && end < formula.size());
    }
    return end;
}

/// √2 and e with its exponent raised, for sqrt(2) and exp(-t): what is set, and where its bracket
/// ends. None of other functions, and of arguments that need their brackets.
std::optional<std::pair<std::string, std::size_t>>
without_brackets(const std::string& name, const std::string& formula, std::size_t opening) {
    if (name != "sqrt" && name != "exp")
        return std::nullopt;
    const std::size_t end = end_of_exponent(formula, opening);
    const std::string inner = formula.substr(opening + 1, end - opening - 2);
    const bool is_one = std::all_of(inner.begin(), inner.end(), is_of_name);
    constexpr std::size_t longest = 16;
    if (inner.empty() || formula[end - 1] != ')')
        return std::nullopt;
    if (name == "sqrt")
        return is_one ? std::optional(std::pair("√" + html_formula(inner), end)) : std::nullopt;
    if (inner.size() > longest || inner.find_first_of("^(") != std::string::npos)
        return std::nullopt;
    return std::pair("<i>e</i><sup>" + html_formula(inner) + "</sup>", end);
}

} // namespace

std::string html_text(const std::string& text) {
    std::string html;
    // Of the control characters HTML has the line end and the tabulator only.
    std::string spaced = text;
    std::ranges::replace_if(
        spaced, [](unsigned char c) { return c < ' ' && c != '\n' && c != '\t'; }, ' ');
    for (const char c : visible(spaced))
        switch (c) {
        case '&':
            html += "&amp;";
            break;
        case '<':
            html += "&lt;";
            break;
        case '>':
            html += "&gt;";
            break;
        case '"':
            html += "&quot;";
            break;
        case '\'':
            html += "&#39;";
            break;
        default:
            html += c;
        }
    return html;
}

std::string html_formula(const std::string& formula) {
    std::string html;
    for (std::size_t at = 0; at < formula.size();) {
        const char c = formula[at];
        if (begins_name(c)) {
            std::size_t end = at;
            while (end < formula.size() && is_of_name(formula[end]))
                ++end;
            const std::string name = formula.substr(at, end - at);
            const bool is_function = end < formula.size() && formula[end] == '(';
            if (const auto shorter =
                    is_function ? without_brackets(name, formula, end) : std::nullopt) {
                html += shorter->first;
                at = shorter->second;
                continue;
            }
            html += html_name(name, is_function);
            at = end;
        } else if (c == '^') {
            const std::size_t end = end_of_exponent(formula, at + 1);
            std::string exponent = formula.substr(at + 1, end - at - 1);
            if (exponent.size() > 2 && exponent.front() == '(')
                exponent = exponent.substr(1, exponent.size() - 2);
            html += exponent.empty() ? "^" : "<sup>" + html_formula(exponent) + "</sup>";
            at = end;
        } else if ((c == '<' || c == '>') && formula.substr(at + 1, 1) == "=") {
            html += c == '<' ? "≤" : "≥";
            at += 2;
        } else {
            html += c == '*' ? "\u2009" : c == '-' ? "−" : html_text(std::string(1, c));
            ++at;
        }
    }
    return html;
}

} // namespace tvbeam

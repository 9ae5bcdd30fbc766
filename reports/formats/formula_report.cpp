#include "reports/formats/formula_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tvbeam {

namespace {

std::string latex_symbol(const std::string& symbol) {
    if (symbol == "theta0")
        return "\\tilde\\theta_0";
    if (symbol == "sigma")
        return "\\sigma";
    return symbol == "u0" ? "u_0" : symbol;
}

} // namespace

std::string formula_report(const Solution& solution, const std::vector<DerivedFormula>& formulas,
                           bool latex) {
    std::string text;
    if (latex) {
        text = fmt::format("% derived from {}\n\\begin{{align*}}\n", solution.name);
        for (std::size_t i = 0; i < formulas.size(); ++i)
            text += fmt::format("  {} &= {} && {}{}\n", latex_symbol(formulas[i].symbol),
                                formulas[i].latex, formulas[i].interval_latex,
                                i + 1 < formulas.size() ? " \\\\" : "");
        return text + "\\end{align*}\n";
    }
    text = solution.name + "\n";
    if (!solution.source.empty())
        text += solution.source + "\n";
    const bool driven = std::any_of(formulas.begin(), formulas.end(),
                                    [](const auto& formula) { return formula.symbol == "q"; });
    text += "\ntheta_t - theta_xx = alpha*u_xxt + f\n"
            "sigma = -u_xxx - zeta*u_xxxt - alpha*theta_x + G\n";
    text += driven ? "sigma_x = q\n" : "";
    text += "m = u_xx(1,t) + zeta*u_xxt(1,t)\n";
    for (const auto& formula : formulas)
        text +=
            fmt::format("\n{} for {}\n    {}\n", formula.symbol, formula.interval, formula.text);
    return text;
}

} // namespace tvbeam

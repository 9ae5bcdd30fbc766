#include "reports/document/problem_formulas.hpp"

#include "mms/derived_formulas.hpp"

#include <fmt/format.h>

namespace tvbeam {

namespace {

std::vector<Formula> formulas_of(const Solution& solution, const Beam& beam) {
    std::vector<Formula> formulas;
    std::string begin;
    for (const auto& phase : solution.phases) {
        const std::string end = phase.until ? phase.until->text() : "";
        std::string interval;
        if (!begin.empty())
            interval = end.empty() ? "t > " + begin : fmt::format("{} < t <= {}", begin, end);
        else if (!end.empty())
            interval = "t <= " + end;
        formulas.push_back({"theta", interval, phase.theta.text()});
        formulas.push_back({"u", interval, phase.u.text()});
        if (phase.sigma)
            formulas.push_back({"sigma", interval, phase.sigma->text()});
        begin = end;
    }
    for (const auto& parameter : solution.parameters)
        formulas.push_back({parameter.name, "", parameter.value.text()});
    for (const auto& derived : derived_formulas(solution, beam.stops.epsilon > 0.0))
        formulas.push_back({derived.symbol, derived.interval, derived.text});
    return formulas;
}

std::vector<Formula> formulas_of(const GivenData& data, const Beam& /*beam*/) {
    std::vector<Formula> formulas;
    const auto add = [&formulas](const char* symbol, const char* interval,
                                 const std::optional<SourceText>& text) {
        if (text)
            formulas.push_back({symbol, interval, text->text()});
    };
    add("theta0", "t = 0", data.theta0);
    add("u0", "t = 0", data.u0);
    add("f", "", data.heat_source);
    add("q", "", data.body_force);
    return formulas;
}

} // namespace

std::vector<Formula> problem_formulas(const Scene& scene) {
    return std::visit([&](const auto& problem) { return formulas_of(problem, scene.beam); },
                      scene.problem);
}

} // namespace tvbeam

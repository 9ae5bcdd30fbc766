#include "reports/csv_report.hpp"

#include <fmt/format.h>

namespace tvbeam {

namespace {

std::string quoted(const std::string& field) {
    if (field.find_first_of(",\"\n\r") == std::string::npos)
        return field;
    std::string text = "\"";
    for (const char c : field)
        text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

} // namespace

std::string csv_report(const StudyResult& result) {
    if (!result.ladder)
        return {};
    const LadderResult& ladder = *result.ladder;
    const auto& printed = result.scene.ladder->printed;
    const auto has_figures = [&](const std::string& norm) {
        return printed && printed->figures.contains(norm);
    };
    std::string text = "elements,h,dt,steps,status";
    for (const auto& norm : ladder.norms) {
        const std::string& name = norm.norm.name;
        text += "," + name;
        if (has_figures(name))
            text += "," + name + "_printed";
        text += "," + name + "_order";
        if (!norm.predictions.empty())
            text += "," + name + "_predicted";
    }
    text += ",seconds,reason\n";
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i) {
        const RungResult& rung = ladder.rungs[i];
        const bool ok = rung.status == RunStatus::ok;
        text += fmt::format("{},{},{},{},{}", rung.rung.elements,
                            1.0 / static_cast<double>(rung.rung.elements), rung.rung.dt,
                            rung.rung.steps, ok ? "ok" : "failed");
        for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
            text += ok ? fmt::format(",{}", rung.errors[k]) : ",";
            const LadderNorm& norm = ladder.norms[k];
            if (has_figures(norm.norm.name))
                text += fmt::format(",{}", printed->figures.at(norm.norm.name)[i]);
            text += norm.orders[i] ? fmt::format(",{}", *norm.orders[i]) : ",";
            if (!norm.predictions.empty())
                text += norm.predictions[i] ? fmt::format(",{}", *norm.predictions[i]) : ",";
        }
        text += fmt::format(",{},{}\n", rung.seconds, quoted(rung.reason));
    }
    return text;
}

} // namespace tvbeam

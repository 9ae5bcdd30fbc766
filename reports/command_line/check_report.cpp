#include "reports/command_line/check_report.hpp"

#include "mms/text/visible_text.hpp"
#include "reports/files/output_file.hpp"
#include "reports/formats/markdown_report.hpp"

#include <fmt/color.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace tvbeam {

namespace {

std::string place_text(const Place& place) {
    return place.line > 0 ? fmt::format("{}:{}:{}", place.file, place.line, place.column)
                          : place.file;
}

std::string outcome(const char* word, fmt::terminal_color colour, bool coloured) {
    return coloured ? fmt::format(fmt::fg(colour) | fmt::emphasis::bold, "{}", word) : word;
}

} // namespace

std::string check_report(const CheckedScene& scene, bool coloured) {
    if (scene.passed())
        return fmt::format("{}    {}: {} expectations, {:.2f} s\n",
                           outcome("ok", fmt::terminal_color::green, coloured), visible(scene.name),
                           scene.expectations.size(), scene.seconds);
    std::string text = fmt::format("{}  {}\n", outcome("FAIL", fmt::terminal_color::red, coloured),
                                   visible(scene.name));
    if (!scene.error.empty())
        text += fmt::format("      a run failed: {}\n", visible(scene.error));
    for (const auto& checked : scene.expectations)
        if (!checked.holds)
            text += visible(fmt::format("      {}: {}: expected {}, found {}\n",
                                        place_text(checked.place), checked.what, checked.expected,
                                        checked.found));
    return text;
}

std::string check_markdown(const std::vector<CheckedScene>& scenes) {
    std::string table = "| | scene | expectations | violations |\n| --- | :--- | ---: | ---: |\n";
    std::string violations;
    for (const auto& scene : scenes) {
        const auto name = markdown_text(scene.name);
        const auto broken = std::count_if(scene.expectations.begin(), scene.expectations.end(),
                                          [](const auto& one) { return !one.holds; });
        table += fmt::format("| {} | {} | {} | {} |\n", scene.passed() ? "ok" : "FAIL", name,
                             scene.expectations.size(), broken);
        if (!scene.error.empty())
            violations += fmt::format("- {}: a run failed: {}\n", name, markdown_text(scene.error));
        for (const auto& one : scene.expectations)
            if (!one.holds)
                violations +=
                    fmt::format("- {}: {}: {}: expected {}, found {}\n", name,
                                markdown_text(place_text(one.place)), markdown_text(one.what),
                                one.expected, markdown_text(one.found));
    }
    return table + "\n" + (violations.empty() ? "" : violations + "\n");
}

nlohmann::ordered_json check_json(const CheckedScene& scene) {
    nlohmann::ordered_json json{{"passed", scene.passed()},
                                {"expectations", scene.expectations.size()}, // that were looked at
                                {"violations", nlohmann::ordered_json::array()}};
    if (!scene.error.empty())
        json["error"] = scene.error;
    for (const auto& one : scene.expectations)
        if (!one.holds)
            json["violations"].push_back({{"what", one.what},
                                          {"expected", one.expected},
                                          {"found", one.found},
                                          {"place", place_text(one.place)}});
    return json;
}

void add_to_step_summary(const std::string& markdown) {
    const char* file = std::getenv("GITHUB_STEP_SUMMARY");
    if (file == nullptr || *file == '\0')
        return;
    std::ofstream stream(file, std::ios::app);
    if (!(stream << markdown << std::flush))
        throw OutputError(std::string("cannot write to '") + file + "', $GITHUB_STEP_SUMMARY");
}

} // namespace tvbeam

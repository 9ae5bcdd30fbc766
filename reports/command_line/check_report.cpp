#include "reports/command_line/check_report.hpp"

#include <fmt/color.h>
#include <fmt/format.h>

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
                           outcome("ok", fmt::terminal_color::green, coloured), scene.name,
                           scene.expectations.size(), scene.seconds);
    std::string text =
        fmt::format("{}  {}\n", outcome("FAIL", fmt::terminal_color::red, coloured), scene.name);
    if (!scene.error.empty())
        text += fmt::format("      a run failed: {}\n", scene.error);
    for (const auto& checked : scene.expectations)
        if (!checked.holds)
            text += fmt::format("      {}: {}: expected {}, found {}\n", place_text(checked.place),
                                checked.what, checked.expected, checked.found);
    return text;
}

} // namespace tvbeam

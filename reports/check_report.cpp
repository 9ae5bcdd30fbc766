#include "reports/check_report.hpp"

#include <fmt/format.h>

namespace tvbeam {

namespace {

std::string place_text(const Place& place) {
    return place.line > 0 ? fmt::format("{}:{}:{}", place.file, place.line, place.column)
                          : place.file;
}

} // namespace

std::string check_report(const CheckedScene& scene) {
    if (scene.passed())
        return fmt::format("ok    {}: {} expectations, {:.2f} s\n", scene.name,
                           scene.expectations.size(), scene.seconds);
    std::string text = fmt::format("FAIL  {}\n", scene.name);
    if (!scene.error.empty())
        text += fmt::format("      a run failed: {}\n", scene.error);
    for (const auto& checked : scene.expectations)
        if (!checked.holds)
            text += fmt::format("      {}: {}: expected {}, found {}\n", place_text(checked.place),
                                checked.what, checked.expected, checked.found);
    return text;
}

} // namespace tvbeam

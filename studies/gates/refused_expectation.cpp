#include "studies/gates/refused_expectation.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/gates/check.hpp"
#include "studies/predicted_work.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

/// A change of a scene.
struct Variant {
    std::string file;
    std::vector<std::string> overrides;
    std::optional<std::string> solution; ///< in place of the scene's
    Reading reading;
};

/// What it is refused with, or why its first run that fails does, or what of its own expectations
/// is violated first; nothing: none of them.
std::optional<std::string> refusal(const Variant& variant) {
    try {
        Scene scene = read_scene(variant.file, variant.overrides, variant.reading);
        if (variant.solution)
            scene.problem = parse_solution(*variant.solution, "solution");
        require_short_enough(scene, predicted_work(scene));
        const StudyResult result = run_study(scene);
        if (result.failed())
            return result.ending().reason;
        for (const auto& one : check(result))
            if (!one.holds)
                return one.what + ": expected " + one.expected + ", found " + one.found;
        return std::nullopt;
    } catch (const InputError& error) {
        return error.what();
    }
}

Variant read_variant(TableReader& table, const Scene& scene, Reading reading) {
    const auto set = table.texts("set").value_or(std::vector<std::string>());
    auto solution = table.text("solution");
    if (set.empty() && !solution)
        throw table.error("", " changes nothing; give it set = [\"KEY=VALUE\"] or the text of a "
                              "solution");
    // Of its expectations only those that are changed are read.
    std::vector<std::string> overrides = scene.overrides;
    overrides.emplace_back("expect={}");
    overrides.insert(overrides.end(), set.begin(), set.end());
    reading.asked = nullptr;
    reading.expectations = std::ranges::any_of(
        set, [](const std::string& assignment) { return assignment.starts_with("expect."); });
    return {scene.file, std::move(overrides), std::move(solution), std::move(reading)};
}

} // namespace

void expect_refused(TableReader& expect, const Scene& scene, const Reading& reading,
                    std::vector<Expectation>& expectations) {
    for (auto& table : expect.tables("refused")) {
        Variant variant = read_variant(table, scene, reading);
        auto says = table.texts("says").value_or(std::vector<std::string>());
        if (says.empty() || std::ranges::any_of(says, &std::string::empty))
            throw table.error("says", " must hold words of the message that is expected");
        table.finish();
        expectations.push_back([variant = std::move(variant), says = std::move(says),
                                what = table.full("says"),
                                place = table.place("says")](const StudyResult& /*result*/) {
            const auto found = refusal(variant);
            std::vector<CheckedExpectation> checked;
            for (const auto& words : says)
                checked.push_back({.what = what,
                                   .expected = "a message with \"" + words + "\"",
                                   .found = found.value_or("it is not refused"),
                                   .place = place,
                                   .holds = found && found->find(words) != std::string::npos});
            return checked;
        });
    }
}

} // namespace tvbeam

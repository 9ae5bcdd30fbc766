#include "studies/gates/refused_expectation.hpp"

#include "mms/text/toml_reader.hpp"
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

/// What a scene is refused with before anything runs; nothing: it would run.
std::optional<std::string> refusal(const Scene& scene, const std::vector<std::string>& set,
                                   const std::optional<std::string>& solution, Reading reading) {
    // Of its expectations only those that are changed are read.
    std::vector<std::string> overrides = scene.overrides;
    overrides.emplace_back("expect={}");
    overrides.insert(overrides.end(), set.begin(), set.end());
    reading.expectations = std::ranges::any_of(
        set, [](const std::string& assignment) { return assignment.starts_with("expect."); });
    try {
        Scene variant = read_scene(scene.file, overrides, reading);
        if (solution)
            variant.problem = parse_solution(*solution, "solution");
        require_short_enough(variant, predicted_work(variant));
        require_runnable(variant);
        if (variant.poses_problem() && !variant.solver)
            require_runnable(variant, problem_of(variant, variant.longest_time()));
    } catch (const InputError& error) {
        return error.what();
    }
    return std::nullopt;
}

} // namespace

void expect_refused(TableReader& expect, const Scene& scene, const Reading& reading,
                    std::vector<Expectation>& expectations) {
    for (auto& table : expect.tables("refused")) {
        const auto set = table.texts("set").value_or(std::vector<std::string>());
        const auto solution = table.text("solution");
        const auto says = table.texts("says").value_or(std::vector<std::string>());
        if (set.empty() && !solution)
            throw table.error("", " changes nothing; give it set = [\"KEY=VALUE\"] or the text of "
                                  "a solution");
        if (says.empty() || std::ranges::any_of(says, &std::string::empty))
            throw table.error("says", " must hold words of the message that is expected");
        table.finish();
        const auto found = refusal(scene, set, solution, reading);
        for (const auto& words : says) {
            CheckedExpectation checked{.what = table.full("says"),
                                       .expected = "a message with \"" + words + "\"",
                                       .found = found.value_or("it is not refused"),
                                       .place = table.place("says"),
                                       .holds = found && found->find(words) != std::string::npos};
            expectations.push_back([checked = std::move(checked)](const StudyResult& /*result*/) {
                return std::vector{checked};
            });
        }
    }
}

} // namespace tvbeam

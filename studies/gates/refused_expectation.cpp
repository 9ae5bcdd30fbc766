#include "studies/gates/refused_expectation.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/gates/check.hpp"
#include "studies/predicted_work.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

/// A scene that may have to be run is predicted to take no longer, in seconds.
constexpr double longest_run = 10.0;
constexpr std::size_t most_variants = 200;

/// A change of a scene.
struct Variant {
    std::string file;
    std::vector<std::string> overrides;
    Reading reading; ///< with the keys that are changed, or another solution
};

/// What became of it: refused, failed, or an expectation of its own violated; or none of them.
struct VariantOutcome {
    bool refused = false;
    std::string said;
};

VariantOutcome outcome_of(const Variant& variant) {
    try {
        Scene scene = read_scene(variant.file, variant.overrides, variant.reading);
        scene.is_long = false; // whoever runs the scene was not asked about this one
        const PredictedWork predicted = predicted_work(scene);
        require_short_enough(scene, predicted);
        // How long a program of the scene's own takes, nobody knows.
        if (!scene.solver && std::max(predicted.seconds, predicted.at_most) > longest_run)
            return {false, "it is not refused before anything runs, and asks for " +
                               predicted.text() + ": too long to see whether a run fails"};
        const StudyResult result = run_study(scene);
        if (result.failed())
            return {true, result.ending().reason};
        for (const auto& one : check(result))
            if (!one.holds)
                return {true, one.what + ": expected " + one.expected + ", found " + one.found};
        return {false, "it is not refused"};
    } catch (const InputError& error) {
        return {true, error.what()};
    }
}

Variant read_variant(TableReader& table, const Scene& scene, Reading reading) {
    reading.variant = table.texts("set").value_or(std::vector<std::string>());
    reading.asked = nullptr;
    reading.solution = table.text("solution");
    if (reading.variant->empty() && !reading.solution)
        throw table.error("", " changes nothing; give it set = [\"KEY=VALUE\"] or the text of a "
                              "solution");
    if (reading.solution && (scene.solver || !scene.poses_problem()))
        throw table.error("solution", " would stand in place of the scene's, and it has none");
    return {scene.file, scene.overrides, std::move(reading)};
}

/// Words that not every message holds.
bool says_something(const std::string& words) {
    return std::ranges::any_of(words, [](unsigned char letter) { return std::isalnum(letter); });
}

} // namespace

void expect_refused(TableReader& expect, const Scene& scene, const Reading& reading,
                    std::vector<Expectation>& expectations) {
    auto tables = expect.tables("refused");
    if (tables.size() > most_variants)
        throw expect.error("refused", " has " + std::to_string(tables.size()) +
                                          " changes; at most " + std::to_string(most_variants) +
                                          " are tried");
    for (auto& table : tables) {
        Variant variant = read_variant(table, scene, reading);
        auto says = table.texts("says").value_or(std::vector<std::string>());
        if (says.empty() || !std::ranges::all_of(says, says_something))
            throw table.error("says", " must hold words of the message that is expected");
        table.finish();
        expectations.push_back([variant = std::move(variant), says = std::move(says),
                                what = what_of(table, "says"),
                                place = table.place("says")](const StudyResult& /*result*/) {
            const VariantOutcome outcome = outcome_of(variant);
            std::vector<CheckedExpectation> checked;
            for (std::size_t i = 0; i < says.size(); ++i)
                checked.push_back(
                    {.what = what + "." + std::to_string(i),
                     .expected = "a message with \"" + says[i] + "\"",
                     .found = outcome.said,
                     .place = place,
                     .holds = outcome.refused && outcome.said.find(says[i]) != std::string::npos,
                     .examined = i == 0 ? outcome.said : std::string()});
            return checked;
        });
    }
}

} // namespace tvbeam

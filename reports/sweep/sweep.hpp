#pragma once

#include "reports/formats/report_format.hpp"
#include "studies/study.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Of the JSON result of a sweep.
inline constexpr const char* sweep_schema = "tvbeam-sweep/1";

/// A key that a scene is run with several values of: --set beam.alpha=0.1,1,10.
struct Sweep {
    std::string key;
    std::vector<std::string> values; ///< as they were given, texts with their quotes

    /// Value i as it is shown: a text without its quotes where it is one without them, too.
    [[nodiscard]] std::string shown(std::size_t i) const;

    /// The overrides of the scene for a value: others, as they were given, and this one.
    std::vector<std::string> others;
    [[nodiscard]] std::vector<std::string> overrides(const std::string& value) const;
    /// What the directory of value i is called: the value, or "2-of-3" where that is no word.
    [[nodiscard]] std::string directory(std::size_t i) const;
};

/// Letters, digits and . - + _ alone, one or more: what needs no quotes.
bool is_plain_word(const std::string& text);

/// The sweep among overrides: the value is two or more numbers, words without blanks, texts in
/// quotes or lists in brackets, separated by commas. None: there is none. Throws InputError where
/// there are two.
std::optional<Sweep> sweep_in(const std::vector<std::string>& overrides);

/// Throws InputError where a norm of the scene's ladder is called as rows of the sweep's JSON call
/// what is their own.
void require_names_of_rows(const Sweep& sweep, const Scene& scene);

/// What a sweep has written to the directory, by the result.json in it: its table, and in the
/// directories of its values what is of their results; behind the files of each the directories,
/// which may hold more. None where that is the result of no sweep.
std::vector<std::filesystem::path> files_of_sweep(const std::filesystem::path& directory);

/// One table of all: a row a value, with the error of the finest level and its observed order for
/// each norm of a ladder, p and q of each of [orders], of each value its limit and orders, of each
/// scheme of [work_precision] the finest row and the times to its targets, and every figure of
/// other studies, and how many runs failed; and a picture of the errors, or of the figures, over
/// the values. results: one a value, in their order; fewer where it was interrupted.
Reported reported(const Sweep& sweep, const std::vector<StudyResult>& results);

/// The table as CSV.
std::string sweep_csv(const Sweep& sweep, const std::vector<StudyResult>& results);

} // namespace tvbeam

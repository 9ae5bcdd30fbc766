#pragma once

#include "reports/formats/junit_report.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace tvbeam {

/// A checked scene as text: one line when all holds; else one line for each violation: where, what,
/// expected, found.
std::string check_report(const CheckedScene& scene, bool coloured = false);

/// Checked scenes as Markdown: a table, and a list of the violations.
std::string check_markdown(const std::vector<CheckedScene>& scenes);

/// The block "check" of a result as JSON: whether the scene passed, and what it violates.
nlohmann::ordered_json check_json(const CheckedScene& scene);

/// Appends Markdown to the file that $GITHUB_STEP_SUMMARY names; nothing where it is not set.
/// Throws OutputError where it cannot be written; an empty text only asks.
void add_to_step_summary(const std::string& markdown);

} // namespace tvbeam

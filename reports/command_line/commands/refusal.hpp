#pragma once

#include "reports/command_line/commands/destination.hpp"
#include "reports/formats/junit_report.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace tvbeam {

/// Leaves no result of an earlier call unsaid where this one is refused: what --junit names, of any
/// command, holds the message as an <error>, so that a server that shows such files is not green;
/// what --json, --csv and --out name stays, and a line on standard error says so, unless the
/// message is of it. A file that is no JUnit report stays as well: it may be one that was to be
/// read.
void report_refusal(const CLI::App& program, const std::string& message);

/// Writes the others, then the JUnit report where one is wanted: what could not be written, an
/// OutputError, which goes on, is an <error> of the command in it.
void write_with_junit(Destination& junit, const std::string& command,
                      std::vector<CheckedScene> checked, const std::function<void()>& others);

} // namespace tvbeam

#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tvbeam {

/// Leaves no result of an earlier call unsaid where this one is refused: what --junit names, of any
/// command, holds the message as an <error>, so that a server that shows such files is not green;
/// what --json, --csv and --out name stays, and a line on standard error says so, unless the
/// message is of it. A file that is no JUnit report stays as well: it may be one that was to be
/// read.
void report_refusal(const CLI::App& program, const std::string& message);

} // namespace tvbeam

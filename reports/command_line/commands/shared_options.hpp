#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace tvbeam {

// Options that several commands have, each with one meaning.

/// --yes-really-long
void add_really_long(CLI::App& command, bool& really_long);

/// --jobs N
void add_jobs(CLI::App& command, int& jobs);

/// --set KEY=VALUE, again and again.
void add_overrides(CLI::App& command, std::vector<std::string>& overrides,
                   const std::string& description);

/// An option that names a file, or - for standard output.
void add_file(CLI::App& command, const std::string& option, std::string& file,
              const std::string& description);

/// --out DIR
void add_directory(CLI::App& command, std::string& directory, const std::string& description);

/// --baseline FILE and --tolerance PART, of every figure so called.
void add_baseline(CLI::App& command, std::string& file, double& tolerance,
                  const std::string& figure);

} // namespace tvbeam

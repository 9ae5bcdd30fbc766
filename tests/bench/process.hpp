#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tvbeam::bench {

/// Runs a program to its end, its output thrown away. Returns the processor time, in seconds, that
/// it and the system for it took; nothing when it cannot be run or fails.
std::optional<double> run_process(const std::vector<std::string>& command);

} // namespace tvbeam::bench

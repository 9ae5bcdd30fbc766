#pragma once

#include <filesystem>

namespace tvbeam {

/// A path in the directory for what stands there for a moment only; no other call in any program
/// on this machine gives it: .tvbeam-HOST-PROCESS-NUMBER.
std::filesystem::path temporary_path(const std::filesystem::path& directory);

/// Removes the files and directories of such paths whose process is not there any more: it was
/// killed. Those of other machines and of other users stay.
void remove_left_behind(const std::filesystem::path& directory);

} // namespace tvbeam

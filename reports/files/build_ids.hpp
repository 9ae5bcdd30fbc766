#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// What the linker wrote into the running program and into the shared libraries whose numbers go
/// into its results: by name a hash of its contents, "unknown" where there is none. First the
/// program, as "tvbeam".
std::vector<std::pair<std::string, std::string>> build_ids();

} // namespace tvbeam

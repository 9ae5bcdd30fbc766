#pragma once

#include "studies/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tvbeam {

/// Whatever the bits of a scene's results depend on: the scene without its words, the solution's
/// text, the program and its libraries as they were built, and the kernel that the processor gets.
nlohmann::ordered_json run_identity(const Scene& scene);

/// What two of them differ in, as a message says it: "another scene (ladder/elements)", "another
/// build of tvbeam (commit, binaries/tvbeam)". Empty: nothing.
std::string difference_of(const nlohmann::ordered_json& there, const nlohmann::ordered_json& here);

} // namespace tvbeam

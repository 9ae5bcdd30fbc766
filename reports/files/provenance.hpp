#pragma once

#include "studies/scene/scene.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// Where a result comes from. What is not known is "unknown".
struct Provenance {
    std::string version;
    std::string commit; ///< of the sources; ends in -dirty where they were changed after it
    std::string compiler;
    std::string build_type;
    std::string flags;     ///< of the compiler
    std::string processor; ///< as the system names it
    std::string date;      ///< of the report, UTC: 2026-01-31T12:00:00Z
    std::string scene_file;
    std::vector<std::string> overrides; ///< KEY=VALUE each
};

Provenance provenance_of(const Scene& scene);

} // namespace tvbeam

#include "reports/files/provenance.hpp"

#include "tvbeam_commit.hpp"

#include <fmt/chrono.h>

#include <chrono>
#include <fstream>

namespace tvbeam {

namespace {

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            if (const auto colon = line.find(": "); colon != std::string::npos)
                return line.substr(colon + 2);
    return "unknown";
}

/// The same in every report of one run of the program.
const std::string& date() {
    static const std::string now = fmt::format(
        "{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::time_point_cast<std::chrono::seconds>(
                                     std::chrono::system_clock::now())));
    return now;
}

} // namespace

Provenance provenance_of(const Scene& scene) {
    return {TVBEAM_VERSION, TVBEAM_COMMIT, TVBEAM_COMPILER, TVBEAM_BUILD_TYPE, TVBEAM_FLAGS,
            processor(),    date(),        scene.file,      scene.overrides};
}

} // namespace tvbeam

#pragma once

#include "studies/external/output_pattern.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tvbeam {

/// Where numbers are read by their names: on standard output, or in a file in the directory of the
/// run, an object of JSON or the last row of a CSV file with a header.
struct FigureSource {
    std::vector<OutputPattern> patterns = {};
    std::string file = {}; ///< *.json or *.csv; then any name may be in it

    [[nodiscard]] bool is_file() const { return !file.empty(); }
    [[nodiscard]] const OutputPattern* pattern(const std::string& name) const;
};

/// The number of a name in such a file.
ReadFigure figure_in(const std::filesystem::path& file, const std::string& name);

} // namespace tvbeam

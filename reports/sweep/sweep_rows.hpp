#pragma once

#include "studies/study.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A figure of a result: what it is of, and what.
struct SweepCell {
    std::string group;
    std::string heading;
    std::optional<double> value;
    bool is_error = false;
    std::string words = {};   ///< of the norm
    std::string without = {}; ///< what the table shows where there is no value
    bool is_asked = true;     ///< for this value of the key
    int digits = 4;           ///< that the table shows, but of an error
};

/// The cells of all results, matched by what they are; what one was not asked for is empty.
std::vector<std::vector<SweepCell>> rows_of(const std::vector<StudyResult>& results);

} // namespace tvbeam

#pragma once

#include "tests/bench/cases.hpp"
#include "tests/bench/measurements.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam::bench {

/// (a case − another) / count, of the least and of the middle one of the repetitions.
struct Share {
    std::string name;      ///< empty: the number 1
    double count = 1.0;    ///< of steps, or of nodes and steps
    std::string less = {}; ///< taken off, where it is not empty
};

/// What is wanted of a ratio; without either it is for information.
struct Wanted {
    std::optional<double> at_least = {};
    std::optional<double> at_most = {};
};

/// One row of the table.
struct Ratio {
    std::string what;
    Share numerator;
    Share denominator;
    Wanted wanted = {};
    Reading reading = Reading::processor;
};

struct Section {
    std::string title;
    std::vector<Ratio> ratios;
};

std::vector<Section> sections(const Extent& extent);

/// The table; 80 columns.
std::string table(const std::vector<Section>& sections, const Measurements& measurements);

} // namespace tvbeam::bench

/// What a scene can use, and which of the shipped scenes with expectations do.
///
/// A defect shows in `tvbeam check` only where a scene runs the code that it is in, and expects
/// something there. Features come from the code's own lists: the keys that its readers ask for and
/// the words of their choices, the functions of the parser, norms and probes. Factors are what a
/// run consists of; two levels of different factors are a pair. A defect of one level beside
/// another shows in no scene that has only one of them, so every pair that there can be must stand
/// in one.
#pragma once

#include "studies/scene/shipped.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// Something that scenes can use, with the names of those that do.
struct Feature {
    std::string name; ///< e.g. "key beam.theta_A", "function atan", "mesh graded"
    std::vector<std::string> scenes = {};
};

struct FeatureTable {
    std::vector<Feature> features;
    std::vector<Feature> pairs; ///< "mesh graded, march Hermite cubics"
    struct Exception {
        std::string name; ///< of a feature, or of a pair
        std::string reason;
    };
    std::vector<Exception> exceptions; ///< what no scene need use; not among the others
};

/// The features of shipped scenes, of those with [expect] and where it looks. Of each ladder and
/// grid the first level is run, in the short form.
FeatureTable feature_table(const std::vector<ShippedFile>& scenes = shipped_files(Shipped::scene));

} // namespace tvbeam

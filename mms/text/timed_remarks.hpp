#pragma once

#include <string>
#include <vector>

namespace tvbeam {

/// A sentence on a time, of which others may differ in the time and in sizes alone.
struct TimedRemark {
    std::string kind; ///< the same where all else that is said is; empty: it is like no other
    std::string time; ///< as the sentence has it
    std::string text;
    std::vector<double> jumps = {}; ///< by how much what it is of jumps, one each
};

/// The sentences in their order, of each kind four, where there are more than one more; behind
/// these stands at how many other times it is the same, the last of them, and the greatest jumps.
std::vector<std::string> told(const std::vector<TimedRemark>& remarks);

} // namespace tvbeam

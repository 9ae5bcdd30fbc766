#pragma once

#include "reports/files/compared_results.hpp"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace tvbeam {

/// What a result says (said_result.hpp) otherwise than was recorded, beyond what round-off changes
/// with another processor, compiler or basis. Words are the same to the letter, and whole numbers
/// to the digit; other numbers are the same
///
/// - to a part `tolerance`; those of fits, which are found by iteration, and of what is measured in
///   a stress case to 1e-3, and likewise observed orders; scatter to a half, as it is that of few
///   rows;
/// - half widths of intervals to 5 %, ends and middles to 5 % of them: which windows of rows count
///   is decided at thresholds, and round-off at one has moved a half width by 2.6 %; sizes of terms
///   so far that the term itself stays where such an order may go, at widths of 1e-2;
/// - in sentences to 0.1 % and one in their last digit, if that is 1 % of them or beside ±; those
///   behind ± to 5 %; below 1e-13 all;
/// - in rows of tables, whose numbers stand elsewhere too, to a quarter of the greater, and where
/// one
///   is a rounding error, below 1e-12, to a factor 3;
/// - residuals and other figures of round-off to a factor 4, and below their unit all of them;
/// - everywhere below 1e-14.
///
/// Asked to march in another basis than the recorded one, a scene counts other things: counters are
/// not compared then.
std::vector<ResultDifference> held_values(const nlohmann::ordered_json& recorded,
                                          const nlohmann::ordered_json& found, double tolerance);

} // namespace tvbeam

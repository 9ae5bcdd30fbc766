#pragma once

#include "studies/scene/study_keys.hpp"

#include <map>
#include <string>
#include <vector>

namespace tvbeam {

class TableReader;

/// One scheme of the block, on a ladder of its own.
struct TimedScheme {
    std::string name; ///< no other scheme of the block has it
    Method method;
    std::vector<Rung> rungs;
};

/// The block [work_precision]: errors of several schemes against the time of their runs.
struct WorkPrecisionBlock {
    double final_time = 0.0;
    std::vector<Measure> norms; ///< at least one
    int runs = 20;              ///< timed ones of each rung, at most
    /// By norm: errors that the schemes are compared at, besides powers of ten.
    std::map<std::string, std::vector<double>> targets;
    std::vector<TimedScheme> schemes; ///< at least one
};

/// Reads the block:
///
///     final_time, norms       as in [ladder]; at least one norm
///     runs                    default 20
///     [work_precision.targets]
///     NORM                    errors to reach, e.g. those of a table's last row
///     [[work_precision.scheme]]
///     name                    default: the method's, e.g. "bdf2, direct, lumped"
///     algorithm, time, …      as in [scheme]; what is absent is as there
///     elements, dt            as in [ladder]
///
/// Throws InputError where a value is missing or breaks its rule.
WorkPrecisionBlock read_work_precision(TableReader& table, const SolverKeys& keys);

} // namespace tvbeam

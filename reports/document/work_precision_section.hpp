#pragma once

#include "reports/document/document.hpp"
#include "studies/work_precision/work_precision.hpp"

namespace tvbeam {

/// The whole of a [work_precision] study: a table of errors, times and counters for each scheme;
/// for each norm a table of the times to reach an error; and in words which scheme is faster at the
/// targets, or, of a norm without targets, at the smallest power of ten that some two reach.
Section work_precision_section(const WorkPrecisionResult& result, const WorkPrecisionBlock& block);

} // namespace tvbeam

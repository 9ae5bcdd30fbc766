#pragma once

#include "studies/data/data_analysis.hpp"
#include "studies/gates/check.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// A document in TOML, and what messages call it.
struct NamedToml {
    std::string text;
    std::string name;
};

/// Holds an analysis against expectations in TOML, a table a column.
///
///     [L2]
///     order  = [1.9, 2.1]            # in the first width; or order.dt = [0.9, 1.1]: in that one
///     orders = [1.8, 2.2]            # from row to row
///     errors = [1e-2, 2.5e-3]        # one a row, coarse to fine, with within = 1e-3
///     verdicts = ["asymptotic", "asymptotic"]
///     [drag]
///     limit       = [1.19, 1.21]
///     uncertainty = [0, 1e-3]        # of the finest value
///     gci.limit   = [1.19, 1.21]     # also uncertainty, order; celik, eca_hoekstra
///
/// and of the intervals of order (order.dt, …) and limit what expect_interval reads, as
/// order_holds = 2.
///
/// Throws InputError for what is not such an expectation, and for columns that are not there.
std::vector<CheckedExpectation> check(const DataAnalysis& analysis, const NamedToml& expectations);

/// The same with the name of a file, or the text itself, as `--expect` takes it.
std::vector<CheckedExpectation> check(const DataAnalysis& analysis,
                                      const std::string& expectations);

} // namespace tvbeam

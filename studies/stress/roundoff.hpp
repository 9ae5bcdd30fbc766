#pragma once

#include "studies/stress/stress_block.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// The largest error of temperature and curvature at the nodes over a run, relative to their sizes,
/// against the discrete solution in closed form.
struct Floor {
    std::optional<double> value; ///< none: not run, or stopped
    std::string reason;          ///< why it stopped; empty: it did not
};

/// The floor of round-off on one mesh.
struct RoundOffRow {
    std::int64_t elements = 0;
    Floor moment;                      ///< moment form, nodal values
    std::optional<double> sine;        ///< moment form, sine basis; by the norms of a run
    Floor hermite;                     ///< the paper's algorithm
    double hermite_predicted = 0.0;    ///< hermite_floor()
    double discretisation_error = 0.0; ///< of the curvature, relative, against the exact solution
    std::string remark;                ///< of the Hermite form; empty: none
};

/// The coupled mode sin πx, without load or stops: Θ and w stay multiples of it, which obey the
/// scheme's own recurrence with the eigenvalue of the mesh.
struct RoundOffTable {
    std::vector<RoundOffRow> rows;

    // Not a number where a run stopped: what was not measured meets no expectation.
    [[nodiscard]] double greatest_moment_floor() const;
    [[nodiscard]] double least_hermite_ratio() const;    ///< measured/predicted
    [[nodiscard]] double greatest_hermite_ratio() const; ///< measured/predicted
    [[nodiscard]] double greatest_discretisation_error() const;
    /// The rows in which the Hermite form's predicted round-off exceeds the discretisation error.
    [[nodiscard]] std::size_t remarks() const;
};

/// The row of block.elements[row].
RoundOffRow measure_round_off(const RoundOffBlock& block, std::size_t row);

} // namespace tvbeam

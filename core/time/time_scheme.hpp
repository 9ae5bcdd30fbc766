#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tvbeam {

/// One solve of a step of length Δt from t_{n−1}: the time derivative at t_{n−1} + fraction·Δt is
/// approximated by
///
///     y_t ≈ c (y − y*),     c = leading/Δt,     y* = y^{n−1} + Σ_j weights_j e_j
///
/// with the increments e_j: first those of the steps before, y^{n−1} − y^{n−2}, y^{n−2} − y^{n−3},
/// …, TimeScheme::history of them; then those of the stages before in this step, Y_1 − y^{n−1},
/// Y_2 − y^{n−1}, ….
struct Stage {
    double leading;
    double fraction; ///< where the sources are taken
    std::vector<double> weights;
};

/// A time discretisation, as data: its stages are solved one after the other, each with contact
/// exact, and the last one is the new state (fraction 1).
struct TimeScheme {
    std::string name;
    int order = 1; ///< in Δt
    std::vector<Stage> stages;
    int history = 0;     ///< earlier increments that the stages read
    std::string starter; ///< name of the one-step scheme of the first `history` steps

    /// The scheme of step n = 1, 2, …: the starter's as long as there is too little history.
    [[nodiscard]] const TimeScheme& at_step(std::int64_t n) const;

    /// Increments to keep between two solves of a run.
    [[nodiscard]] int increments() const;

    /// Where those of the stages of `scheme`, which is this one or its starter, begin among them.
    [[nodiscard]] int first_stage_increment(const TimeScheme& scheme) const;

    /// Throws std::out_of_range for a name that names() does not have.
    static const TimeScheme& named(const std::string& name);
    static std::vector<std::string> names();
};

} // namespace tvbeam

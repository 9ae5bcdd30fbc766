#pragma once

#include "core/problem.hpp"
#include "studies/runs/execution.hpp"
#include "studies/scene/scene.hpp"

#include <optional>
#include <string>

namespace tvbeam {

/// A computed solution in place of an exact one.
///
/// A run of the scene's own scheme, on a mesh and with steps that every rung's divide into, is made
/// once for all studies, by the direct algorithm also where theirs is iterated. Errors are then
/// measured against it by the same norms, element by element of the reference, so that its kinks
/// are integrated exactly. What they show is the difference of two errors; how the error of the
/// reference is accounted for:
///
/// - the two-term fit takes it into its model (the reference of fit_two_term), so that a, b, p, q
///   are those of the error itself. It takes the reference's error for a small copy of the coarse
///   one, as the part that is smooth in x is, and for one at right angles to what is measured, as
///   the part that oscillates in every element; the orders hold what either says
///   (order_engine.hpp);
/// - predictions and verdicts of a ladder do the same;
/// - observed orders of pairs do not. Near the reference they come out too high, and a remark of
///   the ladder says so;
/// - an extrapolated reference has an error of higher order, which is neglected. It is of that
///   order only where the solution is smooth in x and t: not across a change of contact,
///   nor from initial data that are not in balance.
///
/// How the reference of a study came out.
struct ReferenceResult {
    std::string failure;            ///< why it failed; empty when it did not
    double seconds = 0.0;           ///< wall clock of its runs
    std::vector<Rung> runs = {};    ///< made for it; up to the one that failed
    std::vector<double> times = {}; ///< at which it is known
};

/// How much of its coarser runs is taken off an extrapolated reference:
/// y + (y − y_2h) in_h + (y − y_2Δt) in_dt.
struct Extrapolation {
    double in_h = 0.0;
    double in_dt = 0.0;

    /// The sum of the sizes of the three weights, by which rounding grows.
    [[nodiscard]] double weights() const { return 1.0 + 2.0 * (in_h + in_dt); }
};

/// That of the scene's reference; of one that is not extrapolated 0.
Extrapolation extrapolation_of(const Scene& scene);

/// Reads [expect.reference]: elements and dt, one a run; times = [the first, the last]; a band for
/// levels, how many times there are.
void expect_reference(TableReader& table, std::vector<Expectation>& expectations);

/// Runs the reference of a scene up to the longest final time of the studies that are measured
/// against it, and sets it in place of data.exact: Θ̃, U and their derivatives by evaluation, the
/// contact stress as one more amplitude. It is known at the levels of their rungs; elsewhere it
/// throws std::domain_error, by which a run fails. After a reference that failed, every run that is
/// measured against it fails with the same reason.
ReferenceResult measure_against_reference(const Scene& scene, ProblemData& data,
                                          const Execution& execution = {});

} // namespace tvbeam

#pragma once

#include "studies/runs/run.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

class TableReader;

/// The block [reference]: errors are measured against a run of the scene's own scheme that is finer
/// than every run of its studies.
struct ReferenceBlock {
    std::int64_t elements = 0; ///< a multiple of the elements of every rung
    double dt = 0.0;           ///< divides the dt of every rung into whole steps
    /// The reference is extrapolated, with the order 2 in h and that of the time scheme in Δt, from
    /// the three runs with (h, Δt), (2h, Δt) and (h, 2Δt).
    bool richardson = false;

    /// How many steps of the reference make one of the rung.
    [[nodiscard]] std::int64_t steps_in(const Rung& rung) const;

    /// Whether the rung is the reference itself, which has no error against it. Never of an
    /// extrapolated one: its rungs have twice its dt or more.
    [[nodiscard]] bool is(const Rung& rung) const;

    /// Whether the orders of the rung are lost in the reference's own error: its h or Δt, where the
    /// rungs refine it, is within a factor of two of the reference's, and nothing is extrapolated.
    [[nodiscard]] bool is_close_to(const Rung& rung, const std::vector<RungResult>& rungs) const;

    /// Its h and dt, if its own error counts: not of an extrapolated one.
    [[nodiscard]] std::optional<Refinement> widths() const;
};

/// The steps of the reference after which some rung of the series measures its error, in order; the
/// time levels that are kept.
std::vector<std::int64_t> kept_levels(const ReferenceBlock& reference,
                                      const std::vector<Series>& measured);

/// roughness: why the solution is not smooth; empty: it may be. A sentence about the rungs too
/// close to the reference for their orders to mean anything, or else about the part of the finest
/// error that the reference has as well; empty where that is small. Of an extrapolated one about a
/// contact that begins or ends, or a jump.
std::string reference_remark(const ReferenceBlock& reference, const std::vector<RungResult>& rungs,
                             const std::vector<Measure>& measures, const std::string& roughness);

/// Of a grid, whose fit takes the reference's own error into account: about an extrapolated one the
/// same; of another the runs that show little as they are so close to it. Empty: nothing of both.
std::string grid_reference_remark(const ReferenceBlock& reference,
                                  const std::vector<RungResult>& runs,
                                  const std::string& roughness);

/// Reads the block. measured: what will be measured against the reference. Throws InputError where
/// the reference does not fit a rung, is coarser than one, or would fill more than 1 GiB.
ReferenceBlock read_reference(TableReader& table, const std::vector<Series>& measured);

} // namespace tvbeam

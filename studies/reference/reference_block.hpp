#pragma once

#include <cstdint>
#include <vector>

namespace tvbeam {

struct LadderBlock;
struct OrdersBlock;
struct Rung;
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

    /// Whether the orders of the rung are lost in the reference's own error: its h or Δt is within
    /// a factor of two of the reference's, and nothing is extrapolated.
    [[nodiscard]] bool is_close_to(const Rung& rung) const;
};

/// The steps of the reference after which some rung of the studies measures its error, in order;
/// the time levels that are kept. ladder, orders: the scene's studies, or null.
std::vector<std::int64_t> kept_levels(const ReferenceBlock& reference, const LadderBlock* ladder,
                                      const OrdersBlock* orders);

/// Reads the block. Throws InputError where the reference does not fit a rung, is coarser than one,
/// or would fill more than 1 GiB.
ReferenceBlock read_reference(TableReader table, const LadderBlock* ladder,
                              const OrdersBlock* orders);

} // namespace tvbeam

#pragma once

#include <cstdint>
#include <span>

namespace tvbeam {

/// Eight modes side by side: what a wide vector unit holds.
struct alignas(64) Pack {
    static constexpr std::int64_t size = 8;
    double lanes[size];
};

/// Packs that are marched together through all the steps of a block; every array of modes is padded
/// with zeros to a multiple of it.
inline constexpr std::int64_t packs_in_group = 4;

/// After every step of a block, of the modes z, which are θ or a,
///
///     Σ_k η_k (z_k + Σ_j w_j T_jk)²     and, where there is an arm,     Σ_k X_k (z_k + Σ_j w_j
///     T_jk)
///
/// added to eight lanes a step. Arrays are laid out as those of SineBlock.
struct SineSquare {
    const Pack* factors = nullptr; ///< η_k; null: 1
    const Pack* table = nullptr;
    const std::int64_t* active_columns = nullptr; ///< of each group: those behind are zero there
    std::int64_t first_column = 0;                ///< those before have the weight zero
    const double* weights = nullptr;              ///< w_j; shape: steps × columns
    std::int64_t weight_stride = 0;               ///< from one column of the weights to the next
    Pack* squares = nullptr;
    const Pack* arm = nullptr; ///< X_k; may be null
    Pack* moments = nullptr;
};

/// One block of steps of the heat equation and of the nodal part a of the curvature in the sine
/// basis, in which every mode goes its own way; see MomentForm for the equations:
///
///     D = (−K θ* − αcκ (a* + αθ*) + Σ_j load_j T_j) / (cM + K + α²cκ),
///     θ = θ* + D,     a = a* − κ (a* + αθ* + αD)
///
/// with the history θ*, a* of Stage. Modes wait in registers while time runs, so that a step costs
/// no memory traffic and no recurrence over the mesh. Matrices are stored by columns. A null
/// pointer leaves its part out.
struct SineBlock {
    // Sizes.
    std::int64_t groups = 0;
    std::int64_t stride = 0; ///< packs from one array of modes to the next
    std::int64_t steps = 0;
    std::int64_t stages = 1;
    std::int64_t columns = 0; ///< j of T_j

    // The scheme: weights of the increments, `increments` of them a stage.
    std::int64_t increments = 0; ///< ≤ most_increments
    std::int64_t history = 0;
    const double* increment_weights = nullptr; ///< shape: stages × increments

    // The equations.
    bool coupled = false; ///< a is there
    double alpha = 0.0;
    double kappa = 0.0;
    double exchange = 0.0;                        ///< αcκ
    const Pack* stiffness = nullptr;              ///< K
    const Pack* inverse = nullptr;                ///< 1/(cM + K + α²cκ)
    const Pack* table = nullptr;                  ///< T_0, T_1, …
    const std::int64_t* active_columns = nullptr; ///< of each group: those behind are zero there
    const double* loads = nullptr;                ///< load_j; shape: solves × columns

    // θ, a, then the increments of θ and a in turn; without coupling no a.
    const Pack* before = nullptr;
    Pack* after = nullptr; ///< may be null where only the sums are wanted

    // Sums over the modes, added to eight lanes a solve or step.
    Pack* tip = nullptr;                        ///< Σ a T_0, each solve
    std::span<const SineSquare> of_temperature; ///< z = θ
    std::span<const SineSquare> of_curvature;   ///< z = a
    std::int64_t load_stride = 0;               ///< from one column of the loads to the next
    Pack* sum = nullptr;                        ///< Σ θ of the last step: finite if every θ is
};

/// The most increments that march() knows.
inline constexpr std::int64_t most_increments = 2;

/// The same arithmetic for another vector unit. Where a unit fuses a product and a sum, the last
/// bits of the results differ.
struct SineKernel {
    const char* name; ///< of the processors that it is for, as compilers call them
    bool runs_here;   ///< whether this processor is one of them
    void (*march)(const SineBlock& block);
};

/// All of them, the widest first; the last is for every processor.
std::span<const SineKernel> sine_kernels();

/// The first that runs here.
const SineKernel& chosen_sine_kernel();

/// Runs the block with it.
void march(const SineBlock& block);

} // namespace tvbeam

#pragma once

#include "core/problem.hpp"
#include "core/sine/basis.hpp"
#include "core/sine/kernel.hpp"
#include "core/space/mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace tvbeam {

/// Arrays of modes, padded with zeros to whole groups of packs. Between them stands an odd number
/// of groups: the same group of up to sixteen arrays then has places of its own in the cache, which
/// a power of two would not give it.
class ModeArrays {
public:
    ModeArrays() = default;
    ModeArrays(Eigen::Index modes, Eigen::Index arrays);

    using Array = Eigen::Map<Eigen::ArrayXd>;
    Array operator[](Eigen::Index array); ///< all modes of one array, the padding included

    [[nodiscard]] const Pack* data() const { return packs_.data(); }
    Pack* data() { return packs_.data(); }
    [[nodiscard]] Eigen::Index stride() const { return stride_; } ///< in packs
    [[nodiscard]] Eigen::Index groups() const { return groups_; }
    [[nodiscard]] std::int64_t size() const; ///< doubles

private:
    Eigen::Index groups_ = 0;
    Eigen::Index stride_ = 0;
    std::vector<Pack> packs_;
};

/// The profiles φ_r of a problem and the moment arm 1 − x, seen in the sine basis. With
///
///     φ_r = φ_r(0) (1 − x) + φ_r(1) x + φ_r°,     φ_r° zero at both ends,
///
/// all of them, and what errors are made of, are sums of a few functions g_j: g_0 = 1 − x, then x
/// if some φ_r(1) is not zero, then the φ_r° that are not zero. What P_0, the L² projection on
/// S_0^h, leaves of a function is orthogonal to every mode, so squared norms add up: ‖v‖² = Σ_k (v,
/// φ̂_k)² + ‖v − P_0v‖².
///
/// Of many φ_r° the g_j are orthogonal combinations, such that as few as can be reach the high
/// modes: of a smooth φ° the products (φ°, φ̂_k) fall like k⁻³ where its second derivative is not
/// zero at both ends, like k⁻⁵ where its fourth is not, and so on, so that all combinations but a
/// few have fallen to round-off after a hundred modes or so.
struct SineProfiles {
    /// What is read of them.
    struct Wanted {
        bool modes = true;
        bool norms = true;
        bool functions = false; ///< the g_j themselves, which are the φ_r° then
    };

    Eigen::MatrixXd
        expansion; ///< the profiles, then the moment arm, in the g_j; shape: J × (R + 1)
    std::vector<SpaceFunction>
        functions;                    ///< the g_j; they refer to the profiles; empty: not wanted
    Eigen::Index linear = 1;          ///< how many of the g_j are 1 − x and x
    ModeArrays table;                 ///< T_jk = (g_j, φ̂_k)
    std::vector<std::int64_t> active; ///< of each group: the g_j behind are zero there
    Eigen::VectorXd tip_moments; ///< (φ_r, 1 − x), then that of the moment arm; shape: R + 1
    Eigen::MatrixXd remainder; ///< (g_i − P_0g_i, g_j − P_0g_j); shape: J × J; empty: no norms
    Eigen::MatrixXd modes_gram; ///< Σ_k T_ik T_jk; shape and emptiness as above
    Eigen::MatrixXd
        projection; ///< (g_i − Πg_i, g_j − Πg_j), Π on P1disc; shape and emptiness as above
    /// Whether some φ_r is so much greater at a node than its loads on both sides make it on
    /// average that the digits of what is added there and taken away again would be seen: beside a
    /// layer at a node, as of θ = √(x + d) with a small d, whose second derivative is a source.
    bool peaks_at_node = false;

    /// used: the profiles that matter; the others keep zeros. Without modes the table stays empty.
    SineProfiles(const Mesh& mesh, const SineBasis& basis,
                 const std::vector<SpaceFunction>& profiles, const std::vector<bool>& used,
                 const Wanted& wanted);

    [[nodiscard]] Eigen::Index columns() const { return expansion.rows(); }
};

} // namespace tvbeam

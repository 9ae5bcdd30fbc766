#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tvbeam {

/// The spatial quantities that error norms are made of: the square of the L² norm of the error in
/// each, at one time.
enum class Quantity : std::size_t { theta, theta_x, u, u_x, u_xx, stress };
inline constexpr std::size_t quantity_count = 6;

/// A set of quantities whose squares are added in space.
using QuantitySet = std::array<bool, quantity_count>;

/// A norm over the time levels t_1 … t_N: Δt Σ_n s_n, or max_n s_n, of the sum s_n of the squares
/// in its set.
struct TimeNorm {
    enum class Kind { L2, Linf };
    Kind kind;
    QuantitySet quantities;
};

/// An error norm of the studies, by name: theta_L2L2, theta_LinfL2, theta_L2H1, u_LinfL2, u_LinfH1,
/// u_LinfH2, u_LinfH2semi, u_L2H2, sigma_L2; `_sq` behind a name is its square. First letters: the
/// norm in time; second: in space, where H1 and H2 are the full norms and H2semi is ‖·_xx‖.
/// `corollary` is the left side of Corollary 2.2 with the full H² norm, a square already.
struct Norm {
    std::string name;
    std::string words;           ///< e.g. "temperature in L²(0,T; L²), squared"
    std::vector<TimeNorm> parts; ///< squares, added
    bool squared = false;        ///< the sum itself rather than its root
    std::string theorem = {};    ///< by which it is at most C (h² + Δt²); empty: none

    /// The quantities that any part needs.
    [[nodiscard]] QuantitySet quantities() const;
    /// Whether a part is a maximum over time.
    [[nodiscard]] bool has_maximum() const;

    static std::optional<Norm> named(std::string_view name);
    static std::vector<std::string> names(); ///< all of them, without the `_sq` forms
};

} // namespace tvbeam

#include "core/norms/norms.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

constexpr std::string_view square_suffix = "_sq";

using enum TimeNorm::Kind;
//                                θ      θ_x    u      u_x    u_xx   σ
constexpr QuantitySet temperature{true, false, false, false, false, false};
constexpr QuantitySet temperature_H1{true, true, false, false, false, false};
constexpr QuantitySet deflection{false, false, true, false, false, false};
constexpr QuantitySet deflection_H1{false, false, true, true, false, false};
constexpr QuantitySet deflection_H2{false, false, true, true, true, false};
constexpr QuantitySet curvature{false, false, false, false, true, false};
constexpr QuantitySet stress{false, false, false, false, false, true};

const std::vector<Norm>& roots() {
    static const std::vector<Norm> all{
        {"theta_L2L2", "temperature in L²(0,T; L²)", {{L2, temperature}}},
        {"theta_LinfL2", "temperature in L∞(0,T; L²)", {{Linf, temperature}}},
        {"theta_L2H1", "temperature in L²(0,T; H¹)", {{L2, temperature_H1}}},
        {"u_LinfL2", "deflection in L∞(0,T; L²)", {{Linf, deflection}}},
        {"u_LinfH1", "deflection in L∞(0,T; H¹)", {{Linf, deflection_H1}}},
        {"u_LinfH2", "deflection in L∞(0,T; H²)", {{Linf, deflection_H2}}},
        {"u_LinfH2semi", "deflection in L∞(0,T; H² seminorm)", {{Linf, curvature}}},
        {"u_L2H2", "deflection in L²(0,T; H²)", {{L2, deflection_H2}}},
        {"sigma_L2", "contact stress in L²(0,T)", {{L2, stress}}},
        {"corollary",
         "left side of Corollary 2.2",
         {{Linf, deflection_H2}, {L2, temperature}, {L2, deflection_H2}},
         true,
         "Corollary 2.2"},
    };
    return all;
}

} // namespace

bool Norm::has_maximum() const {
    return std::any_of(parts.begin(), parts.end(),
                       [](const TimeNorm& part) { return part.kind == TimeNorm::Kind::Linf; });
}

QuantitySet Norm::quantities() const {
    QuantitySet set{};
    for (const auto& part : parts)
        for (std::size_t q = 0; q < quantity_count; ++q)
            set[q] = set[q] || part.quantities[q];
    return set;
}

std::optional<Norm> Norm::named(std::string_view name) {
    const bool squared = name.ends_with(square_suffix);
    const std::string_view root =
        squared ? name.substr(0, name.size() - square_suffix.size()) : name;
    const auto found = std::find_if(roots().begin(), roots().end(),
                                    [&](const Norm& norm) { return norm.name == root; });
    // corollary_sq would be the square of a square, which nothing is measured in.
    if (found == roots().end() || (squared && found->squared))
        return std::nullopt;
    Norm norm = *found;
    norm.name = name;
    norm.words += squared ? ", squared" : "";
    norm.squared = squared || found->squared;
    return norm;
}

std::vector<std::string> Norm::names() {
    std::vector<std::string> all;
    for (const auto& norm : roots())
        all.push_back(norm.name);
    return all;
}

} // namespace tvbeam

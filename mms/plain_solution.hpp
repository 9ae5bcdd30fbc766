#pragma once

#include "core/problem.hpp"
#include "mms/derivation.hpp"
#include "mms/expression/agreement.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// The values of pi and of the beam's symbols.
std::map<std::string, BoundedJet<long double>> plain_constants(const Beam& beam);

/// What is computed from the text of a solution: its parts, their derivatives, and what (1)–(3),
/// (9) make of them, as DerivedPhase defines them.
enum class Computed : std::uint8_t {
    theta,
    theta_x,
    theta_t,
    theta_xx,
    u,
    u_x,
    u_xx,
    u_xxx,
    u_xxt,
    u_xxxt,
    sigma,
    body_force,
    contact_stress,
    heat_source,
    couple_load,
    end_moment,
    moment_load,
    count
};

/// What a solution's text says, evaluated as it is written in long double with derivatives by
/// Taylor coefficients, at a few points of each phase: both ends of the beam and quasi-random
/// points, at the ends of the phase and quasi-random times. Derived formulas and tapes are held
/// against it.
class PlainSolution {
public:
    /// `solution` gives the places of messages; both stay.
    PlainSolution(const Solution& solution, const DerivedSolution& derived, const Beam& beam,
                  double final_time);

    /// Throws InputError, with the expression and the point, where the values computed for a
    /// quantity of a phase are not those of the text: (first_disagreement).
    ///
    /// @param computed of all samples of the phase, in their order
    /// @param only_x   if given, only samples at this end of the beam count
    void require(std::size_t phase, Computed quantity, const std::string& what,
                 const ComputedValues& computed, std::optional<double> only_x = {}) const;

    /// The samples of a phase: x and t of each.
    [[nodiscard]] const Eigen::ArrayXd& x(std::size_t phase) const { return samples_[phase].x; }
    [[nodiscard]] const Eigen::ArrayXd& t(std::size_t phase) const { return samples_[phase].t; }

    /// Phases that begin at the final time or later have no samples.
    [[nodiscard]] std::size_t phase_count() const { return samples_.size(); }

private:
    using Number = Bounded<long double>;
    using Names = std::map<std::string, BoundedJet<long double>>;
    using Values = std::array<Number, static_cast<std::size_t>(Computed::count)>;

    struct Samples {
        Eigen::ArrayXd x, t;
        std::vector<Values> values;
    };

    /// All but what needs the tip. names: the constants; x and t are set.
    [[nodiscard]] Values at(const PhaseExpressions& phase, Names& names, double x, double t) const;
    [[nodiscard]] Samples sampled(const PhaseExpressions& phase, bool first,
                                  double final_time) const;

    const Solution* solution_;
    Number alpha_, zeta_;
    Stops stops_;
    Names constants_;
    std::vector<Samples> samples_;
};

} // namespace tvbeam

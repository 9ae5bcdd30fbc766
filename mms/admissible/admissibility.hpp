#pragma once

#include "core/problem.hpp"
#include "mms/solution.hpp"

#include <memory>
#include <string>

namespace tvbeam {

struct DerivedSolution;
class PlainSolution;

/// What remains to be said of a solution that is admissible.
struct Admissible {
    double law_distance; ///< ContactRules::law_distance
    bool tip_is_sampled; ///< ContactRules::tip_is_sampled
};

/// A solution on a beam with what is derived from it, which obeys on [0, final_time] what (5)–(10)
/// ask of it whatever the sources f, G and the end moment m are:
///
///     (5)       u(0,t) = u_x(0,t) = 0
///     (6)       g1 ≤ u(1,t) ≤ g2
///     (7)(8)    σ̃(1,t) = 0 where g1 < u(1,t) < g2 (always, without stops); ≥ 0 at g1, ≤ 0 at g2
///     (10)      θ̃(0,t) = θ_A, θ̃(1,t) = 0
///
/// with penalised stops, in place of (6)–(8), either their law (contact_rules.hpp) or, as the
/// solution of rigid stops that they approach, (6)–(8) as they stand;
///
/// further that θ̃, u and u_xx do not jump between phases, nor θ̃, θ̃_x, u and u_x in x and θ̃ and u_xx
/// in t within one, where what is derived by formulas would lack a delta function (jumps.hpp); and
/// that θ̃, u, σ̃ and what is derived from
/// them are finite on a grid of [0,1] × [0, final_time]. An equality holds if it does symbolically,
/// or else at every sampled time to 1e-12 of the largest value of θ̃ (or u, or σ̃) on the grid;
/// inequalities are sampled, with the same tolerance. (6) is proven for all times of a text's
/// solution on rigid stops, or said not to be (greatest_value.hpp).
class AdmissibleSolution {
public:
    /// `solution` gives the places of messages; it stays. Throws InputError at the expression at
    /// fault; it names the equation, the time, the value and a repair; where a derived formula is
    /// not what the text says; as derive_on does; and unless final_time is positive and finite.
    AdmissibleSolution(const Solution& solution, const Beam& beam, double final_time);

    AdmissibleSolution(const AdmissibleSolution&) = delete;
    AdmissibleSolution& operator=(const AdmissibleSolution&) = delete;
    ~AdmissibleSolution();

    [[nodiscard]] const Solution& solution() const { return solution_; }
    [[nodiscard]] const Beam& beam() const { return beam_; }
    [[nodiscard]] double final_time() const { return final_time_; }
    [[nodiscard]] const DerivedSolution& derived() const { return *derived_; }
    [[nodiscard]] const PlainSolution& plain() const { return *plain_; }
    [[nodiscard]] const Admissible& remarks() const { return remarks_; }

    /// Where the solution's first expression stands, for a message that no single one is the cause
    /// of.
    [[nodiscard]] const SourceText& place() const { return solution_.phases.front().u; }

private:
    const Solution& solution_;
    Beam beam_;
    double final_time_;
    std::unique_ptr<const DerivedSolution> derived_;
    std::unique_ptr<const PlainSolution> plain_;
    Admissible remarks_;
};

/// The same for a problem with an exact solution that no text describes; all of it is sampled, and
/// jumps are looked for between the times of a grid. Errors begin with `name` in place of a file.
Admissible require_admissible(const ProblemData& problem, const std::string& name, const Beam& beam,
                              double final_time);

/// final_time. Throws InputError unless it is positive and finite.
double require_final_time(double final_time);

} // namespace tvbeam

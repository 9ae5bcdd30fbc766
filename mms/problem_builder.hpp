#pragma once

#include "core/problem.hpp"

#include <ginac/ginac.h>

#include <optional>
#include <vector>

namespace tvbeam {

/// An interval of time in which a function has one formula.
struct TimePhase {
    double begin;
    double end; ///< infinite in the last phase
};

/// Turns symbolic functions of x and t, one formula a phase, into the profiles, amplitudes and
/// fields of a ProblemData. Equal profiles and equal amplitudes of all fields become one.
class ProblemBuilder {
public:
    /// The phases follow each other from 0 on; a time that ends one phase and begins the next
    /// belongs to the former.
    ProblemBuilder(std::vector<TimePhase> phases, double final_time);

    /// A function of x and t. A product whose profile or amplitude overflows by itself where the
    /// whole does not, as in exp(1000*(x-t)), goes to the rest. Throws AlgebraError if a constant
    /// is beyond the range of a double.
    Field field(const std::vector<GiNaC::ex>& formulas);

    /// A function of t. None: it is zero.
    std::optional<Eigen::Index> amplitude(const std::vector<GiNaC::ex>& formulas);

    /// A profile that is no symbolic expression, with its amplitude: a term for a field.
    Field::Term term(const GiNaC::ex& amplitude, SpaceFunction profile);

    /// Puts the profiles and amplitudes into the problem; the last call.
    void finish(ProblemData& problem) const;

private:
    /// A profile is symbolic, or else only a function.
    struct Profile {
        GiNaC::ex formula;
        SpaceFunction function;
    };

    Eigen::Index profile_index(const GiNaC::ex& formula);
    Eigen::Index amplitude_index(const std::vector<GiNaC::ex>& formulas);
    [[nodiscard]] bool is_finite(const GiNaC::ex& amplitude, const TimePhase& phase) const;

    std::vector<TimePhase> phases_;
    double final_time_;
    std::vector<Profile> profiles_;
    std::vector<std::vector<GiNaC::ex>> amplitudes_; ///< for each amplitude one formula a phase
};

} // namespace tvbeam

#include "mms/problem_builder.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/canonical.hpp"
#include "mms/expression/magnitude.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/sample_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

/// Finds the phase of a time.
class PhaseTimes {
public:
    explicit PhaseTimes(const std::vector<TimePhase>& phases) {
        for (const TimePhase& phase : phases)
            ends_.push_back(phase.end);
    }

    [[nodiscard]] std::size_t phase_at(double t) const {
        std::size_t phase = 0;
        while (phase + 1 < ends_.size() && t > ends_[phase])
            ++phase;
        return phase;
    }

private:
    std::vector<double> ends_;
};

/// The greatest derivative in x, for x in [0, 1], that a polynomial in x and t can have by its
/// coefficients; infinite where it is none.
double most_speed(const ex& argument, double final_time) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const ModelSymbols& symbols = model_symbols();
    if (!argument.is_polynomial(GiNaC::lst{symbols.x, symbols.t}))
        return unknown;
    const ex polynomial = expanded(argument);
    double speed = 0.0;
    for (int i = 1; i <= polynomial.degree(symbols.x); ++i) {
        const ex in_time = polynomial.coeff(symbols.x, i);
        for (int j = 0; j <= in_time.degree(symbols.t); ++j) {
            const ex coefficient = in_time.coeff(symbols.t, j).evalf();
            if (!GiNaC::is_a<GiNaC::numeric>(coefficient))
                return unknown;
            speed += i * std::pow(final_time, j) *
                     std::abs(GiNaC::ex_to<GiNaC::numeric>(coefficient).to_double());
        }
    }
    return speed;
}

/// Whether a function can have no features much narrower than 1/100 in x: sums and products of
/// polynomials and of sines, cosines, exponentials and tanh whose arguments change slowly. A power
/// narrows them by its root.
bool is_gentle(const ex& formula, double final_time) {
    constexpr int most_factors = 20;
    constexpr double fastest = 40.0;
    using GiNaC::cos_SERIAL, GiNaC::exp_SERIAL, GiNaC::sin_SERIAL, GiNaC::tanh_SERIAL;
    const ModelSymbols& symbols = model_symbols();
    const auto gentle = [&](const ex& part) { return is_gentle(part, final_time); };
    if (GiNaC::is_a<GiNaC::symbol>(
            formula)) // another stands for a function that nothing is known of
        return formula.is_equal(symbols.x) || formula.is_equal(symbols.t);
    if (!formula.has(symbols.x))
        return true;
    if (GiNaC::is_a<GiNaC::power>(formula))
        return formula.op(1).info(GiNaC::info_flags::nonnegint) && formula.op(1) <= most_factors &&
               gentle(formula.op(0));
    if (GiNaC::is_a<GiNaC::add>(formula) ||
        (GiNaC::is_a<GiNaC::mul>(formula) && formula.nops() <= most_factors))
        return std::all_of(formula.begin(), formula.end(), gentle);
    const bool entire = is_ex_the_function(formula, sin) || is_ex_the_function(formula, cos) ||
                        is_ex_the_function(formula, exp);
    // The poles of tanh are π/2 away from the real axis.
    const bool with_poles = is_ex_the_function(formula, tanh);
    return (entire || with_poles) &&
           most_speed(formula.op(0), final_time) <= (entire ? fastest : fastest / 4.0);
}

SpaceFunction compiled_profile(const ex& formula) {
    return [tape = compile_tape({formula})](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
        return tape.evaluate(x, Eigen::ArrayXd::Zero(1)).reshaped();
    };
}

/// The greatest size at sampled points; infinite if a value is not finite.
double sampled_size(const SpaceFunction& profile) {
    const Eigen::ArrayXd values = profile(sample_points(0.0, 1.0));
    return values.isFinite().all() ? values.abs().maxCoeff()
                                   : std::numeric_limits<double>::infinity();
}

/// Empty: zero.
SpaceTimeFunction compiled_rest(const ex& formula) {
    if (formula.is_zero())
        return {};
    return [tape = compile_tape({formula})](const Eigen::ArrayXd& x, double t) -> Eigen::ArrayXd {
        return tape.evaluate(x, Eigen::ArrayXd::Constant(1, t)).reshaped();
    };
}

/// For each phase all functions in one tape, from one formula a phase for each of them.
std::vector<Tape> tapes_of(const std::vector<std::vector<ex>>& functions) {
    std::vector<Tape> tapes;
    for (std::size_t phase = 0; phase < functions.front().size(); ++phase) {
        std::vector<ex> formulas;
        for (const std::vector<ex>& function : functions)
            formulas.push_back(function[phase]);
        tapes.push_back(compile_tape(formulas));
    }
    return tapes;
}

/// The values of a tape a phase, at points whose times mostly come in order: a phase is one piece,
/// or a few. x has as many points as t, or is one for all of them.
Eigen::ArrayXXd evaluated(const std::vector<Tape>& tapes, const PhaseTimes& times,
                          const Eigen::ArrayXd& x, const Eigen::ArrayXd& t) {
    if (tapes.size() == 1)
        return tapes.front().evaluate(x, t);
    Eigen::ArrayXXd values(tapes.front().output_count(), t.size());
    for (Eigen::Index begin = 0, end = 0; begin < t.size(); begin = end) {
        const std::size_t phase = times.phase_at(t(begin));
        while (end < t.size() && times.phase_at(t(end)) == phase)
            ++end;
        const Eigen::Index count = end - begin;
        values.middleCols(begin, count) = tapes[phase].evaluate(
            x.size() == 1 ? x : Eigen::ArrayXd(x.segment(begin, count)), t.segment(begin, count));
    }
    return values;
}

Amplitudes compiled_amplitudes(std::vector<Tape> tapes, const std::vector<TimePhase>& phases) {
    return [tapes = std::move(tapes), times = PhaseTimes(phases)](const Eigen::ArrayXd& t) {
        return evaluated(tapes, times, Eigen::ArrayXd::Zero(1), t);
    };
}

/// Not together where that would be computed in long double: one function may not need it.
FunctionFamily compiled_family(std::vector<Tape> tapes, const std::vector<TimePhase>& phases) {
    return [tapes = std::move(tapes), times = PhaseTimes(phases)](
               const std::vector<Eigen::Index>& members) -> JointFunctions {
        std::vector<Tape> chosen;
        for (const Tape& tape : tapes) {
            if (tape.is_wide())
                return {};
            chosen.push_back(tape.only(members));
        }
        return
            [chosen = std::move(chosen), times](const Eigen::ArrayXd& x, const Eigen::ArrayXd& t) {
                return evaluated(chosen, times, x, t);
            };
    };
}

bool all_zero(const std::vector<ex>& formulas) {
    return std::all_of(formulas.begin(), formulas.end(),
                       [](const ex& formula) { return formula.is_zero(); });
}

bool all_equal(const std::vector<ex>& a, const std::vector<ex>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const ex& left, const ex& right) { return left.is_equal(right); });
}

/// Below 2 to this power, doubles that are not normal keep too few digits of a part, or none.
constexpr int fewest_bits = -900;

/// Whether all values are below 2^fewest_bits, in so many places that only a spike of less than
/// 1e-4 hides between them.
bool is_tiny(const SpaceFunction& profile) {
    constexpr Eigen::Index places = 8192;
    const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(places, 0.5 / places, 1.0 - 0.5 / places);
    return (profile(x).abs() < std::ldexp(1.0, fewest_bits)).all();
}

/// The size of a binary logarithm of values that need no scaling.
constexpr int moderate = 100;

/// Changes nothing where the binary logarithm of the largest value is at most `enough` in size.
void divide_by_size(ScaledProfile& profile, double largest, int enough) {
    // A peak between the points may be as much higher, and its square is still finite.
    constexpr int highest_peak = 400;
    if (largest == 0.0 || std::abs(std::ilogb(largest)) <= enough)
        return;
    const int exponent = std::max(std::ilogb(largest), -highest_peak);
    profile.size *= GiNaC::pow(numeric(2), numeric(exponent));
    profile.function =
        [function = std::move(profile.function), factor = std::ldexp(1.0, -exponent)](
            const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return function(x) * factor; };
}

} // namespace

ScaledProfile scaled_profile(const ex& profile) {
    // No number that is written in a formula is larger: sinh(2^25) has 5e7 digits of its own.
    constexpr double most_bits = 1e6;
    const double bits = magnitude(*canonical(profile)).whole;
    ScaledProfile tiny;
    // First as it is; then over about its size, because a number in it may be out of range, or all
    // of it too small for normal doubles.
    for (const bool as_it_is : {true, false}) {
        ScaledProfile scaled;
        if (!as_it_is) {
            if (!(std::abs(bits) <= most_bits))
                break;
            scaled.size = GiNaC::pow(numeric(2), numeric(static_cast<long>(bits)));
        }
        try {
            scaled.function = compiled_profile(profile / scaled.size);
        } catch (const AlgebraError&) {
            continue;
        }
        const double largest = sampled_size(scaled.function);
        if (!std::isfinite(largest))
            continue;
        if (as_it_is && bits < fewest_bits && is_tiny(scaled.function)) {
            tiny = std::move(scaled);
            continue;
        }
        // A tiny profile's size is its own, not about what the formula suggests, so that a moderate
        // amplitude times it is a normal double wherever the product is one.
        divide_by_size(scaled, largest, tiny.function ? 0 : moderate);
        return scaled;
    }
    return tiny;
}

ProblemBuilder::ProblemBuilder(std::vector<TimePhase> phases, double final_time)
    : phases_(std::move(phases)), final_time_(final_time) {}

bool ProblemBuilder::is_finite(const ex& amplitude, const TimePhase& phase) const {
    const double end = std::min(phase.end, final_time_);
    if (phase.begin >= end)
        return true;
    const Eigen::ArrayXd times = sample_points(phase.begin, end);
    return compile_tape({amplitude}).evaluate(Eigen::ArrayXd::Zero(1), times).isFinite().all();
}

Separation ProblemBuilder::finite_separation(const ex& formula, const TimePhase& phase) {
    Separation parts = separated(formula);
    const auto usable = [&](const SeparatedProduct& product) {
        const ScaledProfile& scaled = known_profile(product.profile).scaled;
        return scaled.function && is_finite(product.amplitude * scaled.size, phase);
    };
    if (std::all_of(parts.products.begin(), parts.products.end(), usable))
        return parts;
    return {{}, formula};
}

Field ProblemBuilder::field(const std::vector<ex>& formulas) {
    std::vector<ex> rests;
    bool gentle = true;
    std::vector<std::pair<Eigen::Index, std::vector<ex>>> terms; // profile, amplitude by phase
    for (std::size_t phase = 0; phase < phases_.size(); ++phase) {
        const Separation parts = finite_separation(formulas[phase], phases_[phase]);
        rests.push_back(parts.rest);
        gentle = gentle && is_gentle(parts.rest, final_time_);
        for (const SeparatedProduct& product : parts.products) {
            Profile& profile = known_profile(product.profile);
            const Eigen::Index index = index_of(profile);
            auto term = std::find_if(terms.begin(), terms.end(),
                                     [&](const auto& one) { return one.first == index; });
            if (term == terms.end())
                term = terms.insert(term, {index, std::vector<ex>(phases_.size(), 0)});
            term->second[phase] = product.amplitude * profile.scaled.size;
        }
    }
    Field result;
    for (const auto& [profile, amplitude] : terms)
        result.terms.push_back({amplitude_index(amplitude), profile});
    result.rest = rest(rests);
    result.gentle = result.rest && gentle;
    return result;
}

std::optional<Eigen::Index> ProblemBuilder::amplitude(const std::vector<ex>& formulas) {
    if (all_zero(formulas))
        return std::nullopt;
    return amplitude_index(formulas);
}

Field::Term ProblemBuilder::term(const std::vector<ex>& amplitude, SpaceFunction profile) {
    // No expression equals this one, so that the profile is shared with none.
    Profile& added = profiles_.emplace_back(Profile{GiNaC::symbol(), {std::move(profile)}});
    return {amplitude_index(amplitude), index_of(added)};
}

SpaceTimeFunction ProblemBuilder::rest(const std::vector<ex>& formulas) {
    if (all_zero(formulas))
        return {};
    std::vector<SpaceTimeFunction> functions;
    for (const ex& formula : formulas)
        functions.push_back(compiled_rest(formula));
    rests_.push_back(formulas);
    return FamilyMember{in_phases(std::move(functions)), family_,
                        static_cast<Eigen::Index>(rests_.size()) - 1};
}

SpaceTimeFunction ProblemBuilder::in_phases(std::vector<SpaceTimeFunction> functions) const {
    if (std::none_of(functions.begin(), functions.end(), [](const auto& one) { return !!one; }))
        return {};
    return [functions = std::move(functions),
            times = PhaseTimes(phases_)](const Eigen::ArrayXd& x, double t) -> Eigen::ArrayXd {
        const SpaceTimeFunction& function = functions[times.phase_at(t)];
        return function ? function(x, t) : Eigen::ArrayXd::Zero(x.size());
    };
}

ProblemBuilder::Profile& ProblemBuilder::known_profile(const ex& formula) {
    const auto same = std::find_if(profiles_.begin(), profiles_.end(), [&](const Profile& profile) {
        return profile.formula.is_equal(formula);
    });
    return same != profiles_.end()
               ? *same
               : profiles_.emplace_back(Profile{formula, scaled_profile(formula)});
}

Eigen::Index ProblemBuilder::index_of(Profile& profile) {
    if (!profile.index)
        profile.index = profile_count_++;
    return *profile.index;
}

Eigen::Index ProblemBuilder::amplitude_index(const std::vector<ex>& formulas) {
    const auto same =
        std::find_if(amplitudes_.begin(), amplitudes_.end(),
                     [&](const std::vector<ex>& known) { return all_equal(known, formulas); });
    const Eigen::Index index = same - amplitudes_.begin();
    if (same == amplitudes_.end())
        amplitudes_.push_back(formulas);
    return index;
}

void ProblemBuilder::finish(ProblemData& problem) const {
    problem.profiles.resize(static_cast<std::size_t>(profile_count_));
    problem.gentle_profiles.resize(problem.profiles.size());
    for (const Profile& profile : profiles_) {
        if (!profile.index)
            continue;
        const auto index = static_cast<std::size_t>(*profile.index);
        problem.profiles[index] = profile.scaled.function;
        problem.gentle_profiles[index] = is_gentle(profile.formula, final_time_);
    }
    problem.amplitude_count = static_cast<Eigen::Index>(amplitudes_.size());
    if (!amplitudes_.empty())
        problem.amplitudes = compiled_amplitudes(tapes_of(amplitudes_), phases_);
    if (rests_.size() > 1)
        *family_ = compiled_family(tapes_of(rests_), phases_);
}

} // namespace tvbeam

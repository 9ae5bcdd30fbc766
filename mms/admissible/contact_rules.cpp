#include "mms/admissible/contact_rules.hpp"

#include "core/contact/contact.hpp"
#include "mms/admissible/repair.hpp"
#include "mms/admissible/sampled_rules.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {

/// What counts as zero of the tip: of its own size and that of the stops, beside what rounding
/// leaves of a beam that is larger.
double tip_tolerance(const Stops& stops, const std::vector<ContactPhase>& phases, double u_scale) {
    constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();
    double size = 0.0;
    for (const double stop : {stops.lower, stops.upper})
        if (std::isfinite(stop))
            size = std::max(size, std::abs(stop));
    for (const ContactPhase& phase : phases)
        size = std::max(size, phase.ends(phase.times).row(0).abs().maxCoeff());
    return std::min(relative_tolerance * u_scale,
                    std::max(relative_tolerance * size, roundings * u_scale));
}

Enclosure negated(const Enclosure& e) {
    return {{-e.value.upper, -e.value.lower}, {-e.slope.upper, -e.slope.lower}};
}

/// The places of sizes, the greatest first: of all that break a rule it is the one to be said.
std::vector<Index> by_size(const ArrayXd& sizes) {
    std::vector<Index> order(static_cast<std::size_t>(sizes.size()));
    std::iota(order.begin(), order.end(), 0);
    // One that is not a number is greater than all.
    const ArrayXd known = sizes.isNaN().select(std::numeric_limits<double>::infinity(), sizes);
    std::ranges::stable_sort(order, std::greater{}, [&](Index k) { return known(k); });
    return order;
}

/// Of a stress with the wrong sign at t, from its sign_change.
std::string repair_of_sign(const ContactPhase& phase, double t, std::optional<double> change) {
    if (change)
        return "it changes its sign at t = " + number_text_beside(*change, t) +
               (*change > t ? "; begin the contact there" : "; end the phase there");
    return "change its sign" + (phase.sigma_formula.empty()
                                    ? std::string()
                                    : ", sigma = \"-(" + phase.sigma_formula + ")\"");
}

} // namespace

ContactRules::ContactRules(const Beam& beam, std::vector<ContactPhase> phases, double u_scale,
                           double sigma_scale)
    : stops_(beam.stops), phases_(std::move(phases)),
      tip_tolerance_(tip_tolerance(stops_, phases_, u_scale)),
      stress_tolerance_(relative_tolerance * sigma_scale),
      law_tolerance_(relative_tolerance * (u_scale + stops_.epsilon * sigma_scale)) {
    if (stops_.epsilon == 0.0)
        return;
    double beyond = 0.0; // by how much the tip passes a stop
    for (const ContactPhase& phase : phases_) {
        const Eigen::ArrayXXd values = phase.ends(phase.times);
        for (Index k = 0; k < phase.times.size(); ++k) {
            law_distance_ = std::max(law_distance_, law_distance(values(0, k), values(1, k)));
            beyond = std::max({beyond, values(0, k) - stops_.upper, stops_.lower - values(0, k)});
        }
    }
    // Where ε is so small that rounding hides the law, a tip that stays at the stop tells them
    // apart: one that obeys the law passes it by ε|σ̃|, and misses the law by less than that.
    rigid_ = law_distance_ > std::max(2.0 * beyond, stops_.epsilon * stress_tolerance_) &&
             is_of_rigid_stops();
}

/// In lengths: by how much the tip is off the place that the stress gives it, and the stop that
/// yields to it. What a run makes of it does not grow as ε falls.
double ContactRules::law_distance(double tip, double stress) const {
    return stops_.epsilon * std::abs(stress - contact_stress(stops_, tip, 0.0));
}

bool ContactRules::is_of_rigid_stops() const {
    try {
        for (std::size_t i = 0; i < phases_.size(); ++i)
            require_rigid(i);
    } catch (const InputError&) {
        return false;
    }
    return true;
}

bool ContactRules::at_lower(double tip) const {
    return tip <= stops_.lower + tip_tolerance_;
}

bool ContactRules::at_upper(double tip) const {
    return tip >= stops_.upper - tip_tolerance_;
}

void ContactRules::require(std::size_t index) {
    if (!rigid_) {
        require_law(phases_[index]);
        return;
    }
    require_rigid(index);
    require_sign(phases_[index]);
    if (!stays_between_stops(phases_[index]))
        tip_is_sampled_ = true;
}

/// The tip's greatest value, or with `below` that of −u(1,t), if it is above the limit.
GreatestValue ContactRules::farthest(const ContactPhase& phase, bool below, double limit) const {
    const EnclosedFunction tip = [&](double begin, double end) -> Enclosure {
        const Enclosure values = phase.tip(begin, end);
        return below ? negated(values) : values;
    };
    return greatest_value(tip, phase.times(0), phase.times(phase.times.size() - 1), limit,
                          tip_tolerance_, phase.most_parts);
}

/// Throws where the tip is found to pass a stop between the sampled times; false: it is not, and
/// not proven to stay either.
bool ContactRules::stays_between_stops(const ContactPhase& phase) const {
    bool proven = true;
    for (const bool below : {true, false}) {
        const double limit = (below ? -stops_.lower : stops_.upper) + tip_tolerance_;
        if (std::isinf(limit))
            continue;
        if (!phase.tip)
            return false;
        const GreatestValue found = farthest(phase, below, limit);
        if (found.value > limit)
            require_between_stops(phase, found.t, below ? -found.value : found.value);
        proven = proven && found.proven;
    }
    return proven;
}

/// Throws where a tip that is on one stop all the time is found to be pulled by it between the
/// sampled times: its stress passes zero there, as a peak beside two of them does.
void ContactRules::require_sign(const ContactPhase& phase) const {
    if (!phase.sigma || !phase.stress || !stops_.exist())
        return;
    const ArrayXd tips = phase.ends(phase.times).row(0);
    const auto all = [&](bool (ContactRules::*on_stop)(double) const) {
        return std::ranges::all_of(tips, [&](double tip) { return (this->*on_stop)(tip); });
    };
    const bool upper = all(&ContactRules::at_upper);
    if (upper == all(&ContactRules::at_lower))
        return;
    const EnclosedFunction pull = [&](double begin, double end) {
        const Enclosure stress = phase.stress(begin, end);
        return upper ? stress : negated(stress);
    };
    const GreatestValue found =
        greatest_value(pull, phase.times(0), phase.times(phase.times.size() - 1), stress_tolerance_,
                       stress_tolerance_, phase.most_parts);
    if (found.value > stress_tolerance_)
        require_stress(phase, found.t, phase.ends(ArrayXd::Constant(1, found.t))(0, 0),
                       upper ? found.value : -found.value);
}

/// Whether a stress at a stop is what rounding of u(1,t) makes of −(u(1,t) − g2)/ε, as long as that
/// is little beside the greatest stress.
bool ContactRules::is_rounding_of_law(double tip, double stress) const {
    const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * std::abs(tip);
    constexpr double little = 1e-3;
    const double off = std::min(std::abs(tip - stops_.upper), std::abs(tip - stops_.lower));
    return off <= rounding &&
           std::abs(stress) <=
               std::min(rounding / stops_.epsilon, little * stress_tolerance_ / relative_tolerance);
}

void ContactRules::require_law(const ContactPhase& phase) const {
    const Eigen::ArrayXXd values = phase.ends(phase.times);
    ArrayXd distances(phase.times.size());
    for (Index k = 0; k < phase.times.size(); ++k)
        distances(k) = law_distance(values(0, k), values(1, k));
    for (const Index k : by_size(distances)) {
        const double tip = values(0, k);
        const double stress = values(1, k);
        if (distances(k) <= law_tolerance_)
            break;
        const bool above = tip > stops_.upper;
        const bool below = tip < stops_.lower;
        const double law = contact_stress(stops_, tip, 0.0);
        throw InputError(phase.sigma.value_or(phase.u),
                         "(7)(8) of penalised stops: sigma(1,t) is " +
                             number_text_beside(stress, law) +
                             " at t = " + number_text(phase.times(k)) + ", where u(1,t) is " +
                             number_text(tip) + "; it must be " +
                             (above   ? "-(u(1,t) - g2)/epsilon = "
                              : below ? "(g1 - u(1,t))/epsilon = "
                                      : "0 between the stops, ") +
                             number_text_beside(law, stress) +
                             ": leave sigma out, and it is what the law makes of u(1,t)");
    }
    // However small ε is, the law has no force away from a stop, and none that pulls.
    if (phase.sigma)
        for (const Index k : by_size(values.row(1).abs()))
            if (!is_rounding_of_law(values(0, k), values(1, k)))
                require_stress(phase, phase.times(k), values(0, k), values(1, k));
}

void ContactRules::require_rigid(std::size_t index) const {
    const ContactPhase& phase = phases_[index];
    const Eigen::ArrayXXd values = phase.ends(phase.times);
    for (Index k = 0; k < phase.times.size(); ++k)
        require_between_stops(phase, phase.times(k), values(0, k));
    if (phase.sigma)
        for (const Index k : by_size(values.row(1).abs()))
            require_stress(phase, phase.times(k), values(0, k), values(1, k));
}

void ContactRules::require_between_stops(const ContactPhase& phase, double t, double tip) const {
    const bool below = tip < stops_.lower - tip_tolerance_;
    const bool above = tip > stops_.upper + tip_tolerance_;
    if (!below && !above)
        return;
    const double stop = below ? stops_.lower : stops_.upper;
    throw InputError(phase.u, "(6): u(1,t) is " + number_text_beside(tip, stop) +
                                  " at t = " + number_text(t) + "; it must be at " +
                                  (below ? "least g1 = " : "most g2 = ") + exact_text(stop) + "; " +
                                  repair_of_tip(below));
}

/// What brings the tip back between the stops: measured where it is farthest out.
std::string ContactRules::repair_of_tip(bool below) const {
    double least = 0.0;
    double greatest = 0.0;
    double least_at = 0.0;
    double greatest_at = 0.0;
    bool pressed = false;
    for (const ContactPhase& phase : phases_) {
        const Eigen::ArrayXXd values = phase.ends(phase.times);
        pressed = pressed || values.row(1).abs().maxCoeff() > stress_tolerance_;
        for (Index k = 0; k < phase.times.size(); ++k) {
            if (values(0, k) < least) {
                least = values(0, k);
                least_at = phase.times(k);
            }
            if (values(0, k) > greatest) {
                greatest = values(0, k);
                greatest_at = phase.times(k);
            }
        }
    }
    // What is greater between the sampled times by more than rounding.
    bool proven = true;
    for (const ContactPhase& phase : phases_) {
        if (!phase.tip) {
            proven = false;
            continue;
        }
        const GreatestValue lowest = farthest(phase, true, tip_tolerance_ - least);
        const GreatestValue highest = farthest(phase, false, tip_tolerance_ + greatest);
        if (-lowest.value < least - tip_tolerance_) {
            least = -lowest.value;
            least_at = lowest.t;
        }
        if (highest.value > greatest + tip_tolerance_) {
            greatest = highest.value;
            greatest_at = highest.t;
        }
        proven = proven && lowest.proven && highest.proven;
    }
    const double stop = below ? stops_.lower : stops_.upper;
    const double extreme = below ? least : greatest;
    const std::string name = below ? "g1" : "g2";
    const std::string text = std::string("it is ") + (below ? "least, " : "greatest, ") +
                             number_text_beside(extreme, stop) +
                             ", at t = " + number_text(below ? least_at : greatest_at) +
                             (proven ? ": " : " as far as was seen: ");
    // A solution that presses on a stop would come off it if all of u were made smaller.
    if (pressed)
        return text + "change u(1,t) by " + number_text(rounded_out(stop - extreme)) +
               " there; (3*x^2 - x^3)/2 is a deflection that is 1 at the tip";
    const double factor = std::min({1.0, least < 0.0 ? stops_.lower / least : 1.0,
                                    greatest > 0.0 ? stops_.upper / greatest : 1.0});
    const bool moves_with_stop =
        std::ranges::any_of(phases_, below ? &ContactPhase::u_names_g1 : &ContactPhase::u_names_g2);
    return text + "multiply u by " + number_text(rounded_in(factor)) +
           (moves_with_stop ? ""
                            : ", or move " + name + " to " + number_text(rounded_out(extreme)));
}

void ContactRules::require_stress(const ContactPhase& phase, double t, double tip,
                                  double stress) const {
    if (std::abs(stress) <= stress_tolerance_)
        return;
    const auto fail = [&](const std::string& equation, const std::string& rule, double other) {
        throw InputError(*phase.sigma, equation + ": sigma(1,t) is " + number_text(stress) +
                                           " at t = " + number_text_beside(t, other) +
                                           ", where u(1,t) is " + number_text(tip) +
                                           "; it must be " + rule);
    };
    const auto fail_by_sign = [&](const std::string& rule) {
        const auto change = sign_change(phase, t);
        fail("(8)", rule + repair_of_sign(phase, t, change), change.value_or(t));
    };
    if (!stops_.exist())
        fail("(7)", "0, as the beam has no stops; leave sigma out or give the beam stops", t);
    if (!at_lower(tip) && !at_upper(tip))
        fail("(7)", "0 strictly between the stops: " + repair_of_free_stress(tip), t);
    if (at_lower(tip) && !at_upper(tip) && stress < 0.0)
        fail_by_sign("at least 0 at the stop g1: ");
    if (at_upper(tip) && !at_lower(tip) && stress > 0.0)
        fail_by_sign("at most 0 at the stop g2: ");
}

/// A stress while the tip is free.
std::string ContactRules::repair_of_free_stress(double tip) const {
    const double to_upper = stops_.upper - tip;
    const double to_lower = tip - stops_.lower;
    const bool upper = to_upper <= to_lower;
    return std::string("set sigma to 0 in this phase, or bring the tip to ") +
           (upper ? "g2, " : "g1, ") + number_text(upper ? to_upper : to_lower) + " away";
}

/// Where a stress that has the wrong sign at t changes it; none: it has it all the time.
std::optional<double> ContactRules::sign_change(const ContactPhase& phase, double t) const {
    const auto is_positive = [&](double time) {
        return phase.ends(ArrayXd::Constant(1, time))(1, 0) > 0.0;
    };
    const bool positive = is_positive(t);
    const ArrayXd& times = phase.times;
    const ArrayXd stress = phase.ends(times).row(1);
    const bool all =
        positive ? stress.minCoeff() >= -stress_tolerance_ : stress.maxCoeff() <= stress_tolerance_;
    if (all)
        return std::nullopt;
    const auto has_sign = [&](double time) { return is_positive(time) == positive; };
    // The last time before t with the other sign; where there is none, the first after it.
    double other = t;
    for (Index k = 0; k < times.size() && (times(k) < t || !(other < t)); ++k)
        if (std::abs(stress(k)) > stress_tolerance_ && (stress(k) > 0.0) != positive) {
            other = times(k);
            if (other > t)
                break;
        }
    return switch_time(has_sign, std::min(t, other), std::max(t, other));
}

} // namespace tvbeam

#include "mms/forecast/order_reasons.hpp"

#include "mms/contact_history.hpp"
#include "mms/local_power.hpp"
#include "mms/text/number_text.hpp"
#include "mms/text/timed_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tvbeam {

namespace {

std::string power_text(const std::string& base, std::optional<double> power) {
    if (!power)
        return fmt::format("flatter than {}^{}", base, highest_power);
    return *power == 0 ? std::string("with a jump")
                       : "like " + base + (*power == 1 ? "" : fmt::format("^{:.3g}", *power));
}

/// How penalised stops that the tip passes answer.
void add_penalised_reasons(const ExpectedOrders& known, const Beam& beam,
                           std::vector<std::string>& text) {
    if (!known.tip_has_time_error)
        return;
    // A step answers to a force with the compliance Δt/(3ζ), beside which ε must be large.
    text.push_back("The penalised stops answer to u(1,t) at once, and sigma has its order, for "
                   "steps below 3*zeta*epsilon = " +
                   number_text(3.0 * beam.zeta * beam.stops.epsilon) +
                   "; with greater ones sigma_L2 behaves as at rigid stops" +
                   (known.tip_is_linear
                        ? "."
                        : ", but for SDIRK2: where the tip moves within a stop other than "
                          "linearly in t its order is 1, and rises to 2 only below." +
                              std::string(known.starts_in_stops
                                              ? " The first step of BDF2 is one of SDIRK2, and "
                                                "its error remains: of order 1 in maxima over "
                                                "time, 1.5 in sigma_L2 and other norms of L2 "
                                                "in time, and in smaller steps it falls like dt^3."
                                              : "")));
    if (known.enters_stiff_stops)
        text.emplace_back("The tip comes to a penalised stop from outside: in steps in which that "
                          "behaves as a rigid one, sigma_L2 has half an order less than u.");
    if (known.jump_in_stiff_stops)
        text.push_back("at t = " + number_text(*known.jump_in_stiff_stops) +
                       " u_xxt jumps while the tip is on a penalised stop: in steps in which that "
                       "behaves as a rigid one, sigma is wrong by a part of the jump for one step, "
                       "and u by epsilon times as much: orders from 0.5 in L2 over time, from 0 in "
                       "maxima.");
}

void add_contact_reasons(const ExpectedOrders& known, const Beam& beam,
                         std::vector<std::string>& text) {
    if (known.law_distance > 0.0) {
        text.push_back("The solution is one of rigid stops. Penalised ones with epsilon = " +
                       number_text(beam.stops.epsilon) + " would let its tip pass by up to " +
                       number_text(known.law_distance) + ": " + stalling_errors(beam) +
                       " do not fall to zero, and how they come to a halt is not known.");
        return;
    }
    const auto ends_contact = [&](const Switch& change) {
        return known.contact.pressed_until == change.t &&
               (change.theta_t_jump > 0.0 || change.u_xxt_jump > 0.0);
    };
    if (known.contact.touch)
        text.push_back((known.contact.rests_until
                            ? "from t = " + number_text(*known.contact.touch) + " to " +
                                  number_text(*known.contact.rests_until)
                            : "at t = " + number_text(*known.contact.touch)) +
                       " the tip is on a stop without a force. What is computed may press there, "
                       "or stay clear of it: the order of sigma_L2 is not known.");
    else if (known.contact.within)
        text.push_back("about t = " + number_text(*known.contact.within, 3) +
                       " a contact begins or ends within a phase: the order of sigma_L2 is not "
                       "known. Where a phase begins there, it is.");
    else if (beam.stops.exist() && !known.is_in_stops && !known.contact.pressed_until)
        text.emplace_back("The tip never reaches a stop: sigma is zero, and so is its error once "
                          "the error of u(1,t) is less than the distance.");
    else if (std::ranges::any_of(known.switches, ends_contact))
        text.push_back("at t = " + number_text(*known.contact.pressed_until) +
                       " the last contact ends, and rates jump: where the error of that keeps the "
                       "tip on the stop, sigma_L2 has it, too, and where not, nothing of it.");
    if (beam.zeta == 0.0)
        return;
    if (known.is_in_stops)
        add_penalised_reasons(known, beam, text);
    for (const ContactOnset& onset : known.contact.onsets)
        text.push_back(
            "at t = " + number_text(onset.t) + " a contact begins: the tip comes up " +
            power_text("s", onset.approach) + ", s the time to it, and the force begins " +
            power_text("s", onset.force) +
            ". A run is there too early or too late by its error of u(1,t), and sigma_L2 "
            "loses a part of the order to that: half an order where one step makes it good; where "
            "it takes several, orders scatter from row to row.");
}

/// Of what is quadratic in t, of stages that miss the ends, and of those that lag.
void add_first_step_reasons(const ExpectedOrders& known, const Beam& beam,
                            std::vector<std::string>& text) {
    const bool coupled = beam.alpha != 0.0;
    if (known.theta_is_quadratic || known.u_is_quadratic) {
        const std::string what = coupled ? "theta and u_xx are of degree 2 at most in t"
                                 : !known.u_is_quadratic     ? "theta is quadratic in t"
                                 : !known.theta_is_quadratic ? "u_xx is quadratic in t"
                                                             : "theta and u_xx are quadratic in t";
        const std::string where = known.is_quadratic()       ? ""
                                  : known.theta_is_quadratic ? " in theta"
                                                             : " in u";
        text.push_back(what + ": BDF2 has no error" + where +
                       " but that of its first step, which SDIRK2 makes: order " +
                       (known.first_step_lags    ? "3 in small steps."
                        : known.stages_miss_ends ? "2.25 to 3."
                                                 : "3."));
    }
    if (known.stages_miss_ends)
        text.push_back(std::string(beam.zeta == 0.0 ? "zeta = 0" : "zeta is below T/100") +
                       ", and u_xxtt is not zero at an end of the beam, where the temperature is "
                       "fixed: stages of SDIRK2 leave a layer there, and theta_x has its order "
                       "1.75 to 2 in dt" +
                       (beam.zeta == 0.0 ? "." : ", 2 in steps far below zeta alone."));
    if (known.stages_lag)
        text.push_back("zeta is below T/100: in steps longer than that the stages of SDIRK2, of "
                       "order 1, leave zeta*dt*u_xxtt in u" +
                       std::string(coupled
                                       ? ", and by the coupling in theta, which has 1 in dt, or "
                                         "what theta brings to it, and 2 in steps far below "
                                         "zeta alone."
                                       : ", which has 1 in dt, and 2 in steps far below zeta "
                                         "alone.") +
                       (known.first_step_lags
                            ? " So does the first step of BDF2, which SDIRK2 makes: 1 in maxima "
                              "over time, 1.5 in L2 over time, and in small steps it falls like "
                              "dt^3."
                            : ""));
}

/// What has a rate in the heat equation.
std::string heat_rate(const Beam& beam) {
    return beam.alpha != 0.0 && beam.zeta == 0.0 ? "theta_t - alpha u_xxt" : "theta_t";
}

/// Of which field a sentence about dt is, where they are not coupled.
std::string in_field(const Beam& beam, bool of_theta) {
    return beam.alpha != 0.0 ? "" : of_theta ? " in theta" : " in u";
}

constexpr const char* within_a_phase =
    " That is within a phase: formulas may have no value there, and runs fail of which it is a "
    "time level; where a phase ends there, none does.";

void add_switch_reasons(const ExpectedOrders& known, const Beam& beam,
                        std::vector<std::string>& text) {
    std::vector<TimedRemark> remarks;
    const auto add = [&](const Switch& change, const std::string& jumps, bool of_theta,
                         const std::vector<double>& sizes) {
        const std::string where = in_field(beam, of_theta);
        if (change.where == Switch::Where::at_a_place) { // a front jumps at other times, too
            const std::string time = number_text(change.t, 3);
            remarks.push_back(
                {"", time,
                 "about t = " + time + " " + jumps +
                     " at a place within a phase: BDF2 and SDIRK2 have an order of 1 to 2 in dt" +
                     where + "."});
            return;
        }
        const bool within = change.where == Switch::Where::within_phase;
        const bool is_linear =
            of_theta ? known.theta_is_linear_in_pieces : known.u_is_linear_in_pieces;
        const std::string time = number_text(change.t);
        remarks.push_back(
            {fmt::format("{} {} {}", of_theta, sizes.size(), within), time,
             "at t = " + time + " " + jumps + ": BDF2 has the order 1 in dt" + where +
                 ", and more only where the time is the middle of a step; " +
                 (!is_linear
                      ? "SDIRK2 has 1 unless the time is a time level, where it has 2"
                      : "Euler and SDIRK2 have it, too, unless the time is a time level, where "
                        "they are exact: " +
                            std::string(beam.alpha != 0.0 ? "all is"
                                        : of_theta        ? "theta is"
                                                          : "u_xx is") +
                            " linear in t on both sides") +
                 ". Norms with a maximum over time show it late." + (within ? within_a_phase : ""),
             sizes});
    };
    for (const Switch& change : known.switches) {
        const std::string heat =
            heat_rate(beam) + " jumps by up to " + number_text(change.theta_t_jump, 2);
        const std::string bending = "u_xxt jumps by up to " + number_text(change.u_xxt_jump, 2);
        const bool has_heat = change.theta_t_jump > 0.0;
        const bool has_bending = change.u_xxt_jump > 0.0;
        if (has_heat && has_bending && beam.alpha != 0.0)
            add(change, fmt::format("{} and {}", heat, bending), true,
                {change.theta_t_jump, change.u_xxt_jump});
        else {
            if (has_heat)
                add(change, heat, true, {change.theta_t_jump});
            if (has_bending)
                add(change, bending, false, {change.u_xxt_jump});
        }
    }
    std::ranges::copy(told(remarks), std::back_inserter(text));
}

void add_cusp_reasons(const ExpectedOrders& known, const Beam& beam,
                      std::vector<std::string>& text) {
    std::vector<TimedRemark> remarks;
    for (const Cusp& cusp : known.cusps)
        for (const bool of_theta : {true, false})
            if (const double power = of_theta ? cusp.theta_t_power : cusp.u_xxt_power;
                !std::isinf(power)) {
                const std::string time = number_text(cusp.t);
                const std::string slope = fmt::format(
                    "{} has an infinite slope, like s^{}, s the time to it: BDF2 and SDIRK2 "
                    "have the order {} in dt{}. Norms with a maximum over time may show it "
                    "late.{}",
                    of_theta ? heat_rate(beam) : "u_xxt", local_power_text(power),
                    local_power_text(1.0 + power), in_field(beam, of_theta),
                    cusp.is_within_phase ? within_a_phase : "");
                remarks.push_back({fmt::format("{} {} {}", of_theta, local_power_text(power),
                                               cusp.is_within_phase),
                                   time, fmt::format("at t = {} {}", time, slope)});
            }
    std::ranges::copy(told(remarks), std::back_inserter(text));
}

} // namespace

std::vector<std::string> order_reasons(const ExpectedOrders& known, const Beam& beam) {
    const bool coupled = beam.alpha != 0.0;
    std::vector<std::string> text;
    if (known.theta_is_exact)
        text.emplace_back("theta is linear in x: the linear elements hold it exactly, and no order "
                          "in h is visible in any norm of theta.");
    if (known.u_is_exact)
        text.push_back("u is cubic in x: the cubics hold it exactly; " +
                       std::string(coupled && !known.theta_is_exact
                                       ? "what order in h is visible in u comes from theta, "
                                         "through alpha."
                                       : "no order in h is visible in any norm of u."));
    if (known.kink)
        text.push_back(words_of(*known.kink) +
                       ": where that is within an element, not between two, errors of u fall more "
                       "slowly in h." +
                       (known.kink->of == Kink::Of::u_xx ||
                                (known.kink->of == Kink::Of::u_xxt && beam.zeta != 0.0)
                            ? " The formula of G lacks a delta function there, which the moments "
                              "that runs take have."
                            : ""));
    if (known.rough_end && known.rough_end->power == RoughEnd::highest_power)
        text.push_back(words_of(*known.rough_end) +
                       ", s the distance: u_xxxx is just not square-integrable, and errors of u "
                       "have a factor sqrt(ln(1/h)): the order in h of u_xx goes to 2 from below, "
                       "slowly, and late where the rest of u is large.");
    else if (known.rough_end)
        text.push_back(fmt::format(
            "{}, s the distance: u_xxxx is not square-integrable, and the order in h of u_xx goes "
            "to {:.3g}, late where the rest of u is large.",
            words_of(*known.rough_end), 1.5 + known.rough_end->power));
    if (!coupled)
        text.emplace_back("alpha = 0: heat and bending do not see each other's errors, and u has "
                          "higher orders in the weaker norms.");
    if (!known.theta_has_time_error)
        text.push_back(coupled ? std::string(beam.zeta == 0.0 ? "theta - alpha u_xx is"
                                                              : "theta and u_xx are") +
                                     " linear in t: no scheme has a time error, and no order in "
                                     "dt is visible."
                               : "theta is linear in t, and alpha = 0: no scheme has a time "
                                 "error in theta, and no order in dt is visible there.");
    if (!coupled && !known.u_has_time_error)
        text.emplace_back(beam.zeta == 0.0 ? "alpha = zeta = 0: the beam has no memory, and u no "
                                             "time error."
                                           : "u_xx is linear in t, and alpha = 0: no scheme has a "
                                             "time error in u, and no order in dt is visible "
                                             "there.");
    add_first_step_reasons(known, beam, text);
    add_switch_reasons(known, beam, text);
    add_cusp_reasons(known, beam, text);
    add_contact_reasons(known, beam, text);
    return text;
}

} // namespace tvbeam

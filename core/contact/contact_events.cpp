#include "core/contact/contact_events.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

using Kind = ContactEvent::Kind;
using Stop = ContactEvent::Stop;

std::string name_of(Kind kind) {
    return kind == Kind::onset ? "onset" : "release";
}

std::string name_of(Stop stop) {
    return stop == Stop::lower ? "g1" : "g2";
}

void ContactEvents::Levels::push(double time, double reading) {
    t = {time, t[0]};
    value = {reading, value[0]};
    count = std::min(count + 1, 2);
}

std::optional<double> ContactEvents::Levels::reaches(double target, double lowest,
                                                     double highest) const {
    if (count < 2)
        return std::nullopt;
    const double slope = (value[0] - value[1]) / (t[0] - t[1]);
    const double at = t[0] + (target - value[0]) / slope;
    // A motion that turns around between the levels gives a time before them, or none.
    return at >= lowest && at <= highest ? std::optional(at) : std::nullopt;
}

ContactEvents::ContactEvents(const Stops& stops, double tip, double round_off)
    : stops_(stops), round_off_(round_off), tip_before_(tip) {
    beyond_ = beyond(tip);
    // A start on a stop is one, whichever side of it the state's round-off puts the tip.
    const double stop = tip > stops.upper ? stops.upper : stops.lower;
    if (beyond_ <= round_off * std::abs(stop))
        beyond_ = 0.0;
    if (stops.epsilon > 0.0 && beyond_ > 0.0) { // a stop that yields pushes from the start
        events_.push_back(
            {Kind::onset, tip > stops.upper ? Stop::upper : Stop::lower, 0.0, beyond_});
        pressed_.push(0.0, (tip > stops.upper ? -beyond_ : beyond_) / stops.epsilon);
    } else {
        free_.push(0.0, tip);
    }
}

double ContactEvents::beyond(double tip) const {
    return std::max({0.0, tip - stops_.upper, stops_.lower - tip});
}

bool ContactEvents::starts_on(Stop stop) const {
    if (free_.count != 1 || free_.t[0] != 0.0)
        return false;
    const double gap =
        stop == Stop::lower ? stops_.lower - free_.value[0] : free_.value[0] - stops_.upper;
    const double scale = std::abs(stop == Stop::lower ? stops_.lower : stops_.upper);
    return gap >= -round_off_ * scale;
}

void ContactEvents::add(double t, double tip, double stress) {
    const double passed = beyond(tip);
    beyond_ = std::max(beyond_, passed);
    const bool pressed = pressed_.count > 0;
    const bool presses = stress != 0.0;
    const bool changes_sides = pressed && presses && stress * pressed_.value[0] < 0.0;
    if (pressed && (!presses || changes_sides)) {
        const Stop stop = pressed_.value[0] > 0.0 ? Stop::lower : Stop::upper;
        double at = pressed_.reaches(0.0, before_, t).value_or(passes(stop, t, tip));
        if (changes_sides) // one stop is left before the other is met
            if (const double met = passes(stop == Stop::lower ? Stop::upper : Stop::lower, t, tip);
                at > met)
                at = std::min(met, passes(stop, t, tip));
        events_.push_back({Kind::release, stop, at, events_[onset_].beyond});
        pressed_ = {};
        free_ = {};
    }
    if (presses) {
        if (pressed_.count == 0)
            begin_contact(t, tip, stress > 0.0 ? Stop::lower : Stop::upper);
        events_[onset_].beyond = std::max(events_[onset_].beyond, passed);
        pressed_.push(t, stress);
    } else {
        free_.push(t, tip);
    }
    before_ = t;
    tip_before_ = tip;
}

double ContactEvents::passes(Stop stop, double t, double tip) const {
    if (!(stops_.epsilon > 0.0))
        return t;
    const double gap = stop == Stop::lower ? stops_.lower : stops_.upper;
    const double at = before_ + (gap - tip_before_) / (tip - tip_before_) * (t - before_);
    return at >= before_ && at <= t ? at : t;
}

void ContactEvents::begin_contact(double t, double tip, Stop stop) {
    const double gap = stop == Stop::lower ? stops_.lower : stops_.upper;
    onset_ = events_.size();
    if (starts_on(stop))
        events_.push_back({Kind::onset, stop, 0.0, beyond_});
    else
        events_.push_back({Kind::onset, stop,
                           free_.reaches(gap, before_, t).value_or(passes(stop, t, tip)), 0.0});
}

} // namespace tvbeam

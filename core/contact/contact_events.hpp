#pragma once

#include "core/problem.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// The tip meets a stop, or leaves it.
struct ContactEvent {
    enum class Kind { onset, release };
    enum class Stop { lower, upper }; ///< g1, g2
    Kind kind = Kind::onset;
    Stop stop = Stop::lower;
    double t = 0.0; ///< within the step in which the regime changed, its end included
    /// By how far the tip passes the stop at most in the contact that begins or ends here; of one
    /// that lasts to the end of the run, up to there. Unit: length.
    double beyond = 0.0;
};

std::string name_of(ContactEvent::Kind kind); ///< "onset", "release"
std::string name_of(ContactEvent::Stop stop); ///< "g1", "g2"

/// Finds the changes between free tip and contact along a run, and when they happened within their
/// step:
///
/// - an onset, where the line through the tip at the two last free levels reaches the stop;
/// - a release, where the line through the contact stress of the two last levels in contact reaches
///   zero;
///
/// each where it lies within its step. Both are exact to the order two in Δt for a smooth motion
/// that is itself exact. Where there are no two such levels, or their line leaves the step, a
/// penalised stop, which the tip passes, is met where the line through the tips at both ends of the
/// step meets it, and of a rigid one the end of the step stands for the event; so it is where the
/// tip goes from one stop to the other within a step and would leave the one after it met the
/// other. A tip that starts on a stop and is held there by the first step has its onset at t = 0,
/// as has one that starts within a penalised stop.
class ContactEvents {
public:
    /// At the state of t = 0. round_off: of the tip there, relative; one as near to a stop starts
    /// on it, and so does one beyond it.
    ContactEvents(const Stops& stops, double tip, double round_off = 1e-12);

    /// The level after those before; stress: λ, which says on which stop the tip is (8).
    void add(double t, double tip, double stress);

    [[nodiscard]] const std::vector<ContactEvent>& events() const { return events_; }

    /// By how far the tip has passed a stop at most; 0 when it never has. Of rigid stops this is an
    /// error, round-off; of penalised ones it is what they yield, ε|λ|. Unit: length.
    [[nodiscard]] double beyond_stops() const { return beyond_; }

private:
    using Stop = ContactEvent::Stop;

    /// The two last levels of a regime, the later one first.
    struct Levels {
        int count = 0;
        std::array<double, 2> t{};
        std::array<double, 2> value{};
        void push(double time, double reading);
        /// Where their line takes the value, if that is within [lowest, highest].
        [[nodiscard]] std::optional<double> reaches(double target, double lowest,
                                                    double highest) const;
    };

    /// By how far a tip is beyond a stop, 0 between them.
    [[nodiscard]] double beyond(double tip) const;
    /// Whether the tip is on the stop, or in it, at t = 0 and no level came before this one.
    [[nodiscard]] bool starts_on(Stop stop) const;
    /// Where in the step that ends at t, with this tip, a penalised stop is passed; t of a rigid
    /// one.
    [[nodiscard]] double passes(Stop stop, double t, double tip) const;
    /// Notes an onset in that step.
    void begin_contact(double t, double tip, Stop stop);

    Stops stops_;
    double round_off_;
    Levels free_;           // tips of the free levels since the last contact
    Levels pressed_;        // stresses since the last onset
    double before_ = 0.0;   // t of the level before
    double tip_before_;     // … and its tip
    std::size_t onset_ = 0; // index of the last onset's event
    std::vector<ContactEvent> events_;
    double beyond_ = 0.0;
};

} // namespace tvbeam

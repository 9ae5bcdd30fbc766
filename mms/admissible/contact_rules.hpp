#pragma once

#include "core/problem.hpp"
#include "mms/admissible/greatest_value.hpp"
#include "mms/text/input_error.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What contact sees of one phase of an exact solution.
struct ContactPhase {
    Eigen::ArrayXd times; ///< that it is sampled at
    /// Two rows, u(1,t) and σ̃(1,t); one column a time.
    std::function<Eigen::ArrayXXd(const Eigen::ArrayXd& times)> ends;
    EnclosedFunction tip;        ///< u(1,t); none: nothing is known of it between two times
    EnclosedFunction stress;     ///< σ̃(1,t), likewise
    std::int64_t most_parts = 0; ///< into which greatest_value may take it apart
    Place u;
    bool u_names_g1 = false; ///< moving the stop moves what is wrong with it
    bool u_names_g2 = false;
    std::optional<Place> sigma; ///< none: σ̃ is not given, and zero
    std::string sigma_formula;  ///< for the repair of its sign; may be empty
};

/// The rules of the stops on an exact solution:
///
///     (6)       g1 ≤ u(1,t) ≤ g2
///     (7)(8)    σ̃(1,t) = 0 where g1 < u(1,t) < g2 (always, without stops); ≥ 0 at g1, ≤ 0 at g2
///
/// They are looked at at sampled times; (6) at all times, where its phase has an enclosure, and
/// (8), where the tip is on one stop all the while. Where the stops are penalised, either their law
/// at all times, u(1,t) free,
///
///     ε σ̃(1,t) = −((u(1,t) − g2)⁺ − (g1 − u(1,t))⁺)
///
/// and (7)(8), of which it is seen more where ε σ̃ is lost beside u; or the rules above at all
/// times: a solution of rigid stops, which penalised ones approach.
class ContactRules {
public:
    /// The scales are the largest |u| and |σ̃|; what is relative_tolerance of σ̃, or of the tip and
    /// the stops, counts as zero.
    ContactRules(const Beam& beam, std::vector<ContactPhase> phases, double u_scale,
                 double sigma_scale);

    /// Throws InputError where the phase of this index breaks a rule; it names the equation, the
    /// time, the value and a repair.
    void require(std::size_t index);

    /// Of all phases required: whether (6) is seen at sampled times only, and not proven.
    [[nodiscard]] bool tip_is_sampled() const { return tip_is_sampled_; }

    /// Of a solution of rigid stops on penalised ones: the greatest |ε σ̃ + (u − g2)⁺ − (g1 − u)⁺|
    /// at x = 1, by which it misses their law; else 0. Unit: length.
    [[nodiscard]] double law_distance() const { return rigid_ ? law_distance_ : 0.0; }

private:
    [[nodiscard]] double law_distance(double tip, double stress) const;
    [[nodiscard]] bool is_of_rigid_stops() const;
    void require_rigid(std::size_t index) const;
    [[nodiscard]] GreatestValue farthest(const ContactPhase& phase, bool below, double limit) const;
    [[nodiscard]] bool stays_between_stops(const ContactPhase& phase) const;
    void require_sign(const ContactPhase& phase) const;
    void require_law(const ContactPhase& phase) const;
    [[nodiscard]] bool is_rounding_of_law(double tip, double stress) const;
    [[nodiscard]] bool at_lower(double tip) const;
    [[nodiscard]] bool at_upper(double tip) const;
    void require_between_stops(const ContactPhase& phase, double t, double tip) const;
    void require_stress(const ContactPhase& phase, double t, double tip, double stress) const;
    [[nodiscard]] std::string repair_of_tip(bool below) const;
    [[nodiscard]] std::string repair_of_free_stress(double tip) const;
    [[nodiscard]] std::optional<double> sign_change(const ContactPhase& phase, double t) const;

    Stops stops_;
    std::vector<ContactPhase> phases_;
    double tip_tolerance_;
    double stress_tolerance_;
    double law_tolerance_;
    double law_distance_ = 0.0; // the greatest over all sampled times; rigid stops: not looked at
    bool rigid_ = true;         // the rules of rigid stops hold, or are to
    bool tip_is_sampled_ = false;
};

} // namespace tvbeam

/// Orders of an error in any number of widths, with intervals that hold the asymptotic order.
///
/// No single model or choice of rows is trusted. Many models (term_model.hpp: the leading terms
/// alone; with next terms x or x² in one width or in all; with √x, a logarithm or a constant in one
/// width, and in the others none or √x, x or x²; all of them saturated; for one width also a floor;
/// and each width alone on the rows where the others are finest) are fitted to many windows of rows
/// (without the coarsest levels of each width, one after another). One whose next terms are of two
/// kinds counts where none of the others has smaller residuals; none has a logarithm in two widths.
/// A fit is believed as far as it stays the same when its window changes by one level, and as its
/// standard error allows:
///
///     u_m² = max(t_{dof} s_m / 1.96, σ_m)² + (greatest change to a neighbouring window)²,
///     p = Σ w_m p_m / Σ w_m,      half² = Σ w_m ((p_m − p)² + u_m²) / Σ w_m,
///     w_m = 1 / (u_m² (1 + (u_m / 10)²)),
///
/// with the standard errors s_m from the residuals and σ_m from a known scatter of the rows: a
/// stated one, or that of rows at equal widths (replicates). Of a grid it is wider where residuals
/// look like scatter that nobody stated. So the
/// interval knows scatter, the drift of the order along its width (the neighbours), and what
/// extrapolation gives (the models with next terms, where they are steadier than those without).
/// Against a reference its own error is taken off, and whether that is smooth or oscillates in
/// every element is not known (TermRows::in_squares): all of this is done for either, and the
/// numbers are put together with weights 1/half², without those that drift far more; of three
/// levels with equal ones. Where all of
/// that is wide the order is not determined, nor where it still moves (order_motion.hpp), is steep
/// and seen at two levels alone, or stands beside a constant that its few levels do not tell from
/// it, or where exact errors, of a grid those at the finest of all other widths, have one that
/// turns or moves ever more from level to level (LevelErrors), nor where the steps of the errors
/// along lines of a grid have one order and models of terms of one width each have another, as of
/// h + dt/√h; the status says why. Where scatter,
/// or a width of three levels, leaves open whether there is a logarithm or a next term half an
/// order on, the interval reaches its order; and that which the orders of a sequence's levels go
/// to, where they slow down less than by half an order, and those that the digits leave open which
/// its errors are printed to (left_open.hpp). In a width of three levels models with next
/// terms do not count whose term in another width stands still. There is none where no model of all
/// rows follows them. A width that changes no error by more than OrderTuning::idle of it is left
/// out where the rest determines all orders. Constants: OrderTuning. Ideas of others: model
/// averaging by stability and the spread over models as uncertainty (Rider et al. 2016; Eça and
/// Hoekstra 2014), many models times many windows (StREEQ, Sandia).
#pragma once

#include "studies/orders/error_rows.hpp"
#include "studies/orders/order_members.hpp"
#include "studies/orders/order_motion.hpp"
#include "studies/orders/order_tuning.hpp"
#include "studies/orders/term_model.hpp"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

struct OrderInterval {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = -std::numeric_limits<double>::infinity(); ///< 95 %
    double high = std::numeric_limits<double>::infinity();
    bool determined = false;
    double share = 0; ///< the greatest part of a row's error that the term is
    /// Why it is not determined, as "it rises over finer windows, to 1.68"; empty where it
    /// is.
    std::string status = {};
    /// Those of the coarsest window and of the finest, where it falls from each to the next.
    std::optional<std::pair<double, double>> falls = {};
    /// Whether the errors of a sequence go to a constant that is not zero, so that the order of its
    /// end is 0.
    bool levels_off = false;

    double half_width() const { return (high - low) / 2; }
};

/// All fits to the rows of one norm.
class OrderEnsemble {
public:
    /// A number that a member leads to; none where it does not.
    using Functional = std::function<std::optional<FittedNumber>(const EnsembleMember&)>;

    /// Rows that are not positive and finite are passed over; rows of equal widths are averaged,
    /// and their differences, where there are any, are the scatter of all.
    /// reference: the widths of a run that stands in for the exact solution, NaN where it is exact.
    explicit OrderEnsemble(std::span<const ErrorRow> rows,
                           const std::vector<double>& reference = {},
                           const OrderTuning& tuning = {});

    /// Of the rows without the widths that change no error by more than OrderTuning::idle, where it
    /// determines all orders: orders() are then its. In such a width's place a constant would
    /// follow what is the others' next term. Null where all count.
    const OrderEnsemble* without_idle_widths() const { return moving_.get(); }
    /// Where a width stands among those that count; none where it is left out.
    std::optional<Eigen::Index> place_among_moving(Eigen::Index width) const;
    /// Why there are no orders at all; empty where there are.
    const std::string& failure() const { return failure_; }
    const std::vector<EnsembleMember>& members() const { return members_; }
    std::vector<OrderInterval> orders() const;
    /// The error at other widths, with what the members say of it and of each other; against the
    /// exact solution, or against the reference.
    OrderInterval forecast(const std::vector<double>& widths, bool against_reference = false) const;
    /// The size a of a width's leading term a x^p as x → 0, from members without a logarithm there:
    /// its interval is that of their sizes, and as much wider as the order's interval leaves open
    /// where the term is carried on from the finest level.
    OrderInterval size(Eigen::Index width, const OrderInterval& order) const;
    /// The leading terms in the window whose orders are steadiest, of such the largest; null where
    /// there is none.
    const EnsembleMember* steadiest() const;
    /// Of one width: a factor ln x makes the order stand still, and nothing else does.
    bool has_logarithm() const;
    /// Whether a row is in a member's window.
    bool holds(const EnsembleMember& member, const std::vector<double>& widths) const;
    const OrderTuning& tuning() const { return tuning_; }

private:
    OrderEnsemble(TermRows rows, const OrderTuning& tuning, bool may_scatter = true);
    struct Mixture {
        double value = 0;
        double half = 0;
    };
    using Numbers = std::map<std::pair<int, std::vector<int>>, FittedNumber>;
    std::optional<double> change_of(const Numbers& numbers, int family,
                                    const std::vector<int>& place) const;
    int model_beside(int family, Eigen::Index width) const;
    Numbers numbers_of(const Functional& number) const;
    int place_of(Eigen::Index width, double log_width) const;
    std::optional<Mixture> mix(const Functional& number) const;
    std::optional<Mixture> mix_of_members(const Functional& number) const;
    std::optional<Mixture> together(std::vector<Mixture> all) const;
    bool is_settled(Eigen::Index width, const OrderInterval& order) const;
    /// Of a positive number, given its logarithms.
    OrderInterval mix_logarithms(const Functional& logarithm) const;
    bool residuals_scatter() const;
    double unstated_scatter() const;
    OrderMotion motion_of(Eigen::Index width) const;
    double greatest_share(Eigen::Index width) const;
    bool is_followed() const;
    bool is_ambiguous(Eigen::Index width) const;
    bool has_constant_beside(const EnsembleMember& member, Eigen::Index width, double share) const;
    bool is_of_the_others(const EnsembleMember& member) const;
    bool leans_on_a_constant(const EnsembleMember& member, Eigen::Index width) const;
    bool is_seen_as_a_power(Eigen::Index width, const OrderInterval& order) const;
    bool stands_still() const;
    bool is_near_zero(const OrderInterval& order) const;
    std::string status_of(Eigen::Index width, const OrderInterval& order) const;
    double sequence_factor() const;
    double grid_factor() const;
    bool has_width_of_few_levels() const;
    double distance_to_slow_terms(Eigen::Index width, double order) const;
    double distance_to_close_terms(Eigen::Index width, double order) const;
    std::optional<double> drifts_away(Eigen::Index width) const;
    std::optional<LevelErrors> levels_alone(Eigen::Index width) const;
    std::string motion_between_levels(Eigen::Index width, const OrderInterval& order) const;
    std::optional<FittedNumber> order_of_steps(Eigen::Index width) const;
    std::string steps_contradict(const std::vector<OrderInterval>& orders) const;

    OrderTuning tuning_;
    TermRows rows_;
    std::vector<std::vector<double>> levels_; ///< ln of each width's levels, coarse to fine
    bool scatters_ = false;                   ///< by what is known of the rows, or residuals
    std::vector<double> stretch_;             ///< of a change along each width
    std::vector<EnsembleMember> members_;
    std::string failure_;
    std::vector<Eigen::Index> moving_widths_;
    std::shared_ptr<const OrderEnsemble> moving_;
    std::shared_ptr<const OrderEnsemble> scattered_; ///< the same, with its unstated scatter
    /// Against a reference, with squares subtracted in one width or another.
    std::vector<std::shared_ptr<const OrderEnsemble>> in_squares_;
};

/// The orders of the error in each width; the failure in every status where there are none.
std::vector<OrderInterval> estimate_orders(std::span<const ErrorRow> rows,
                                           const std::vector<double>& reference = {},
                                           const OrderTuning& tuning = {});

} // namespace tvbeam

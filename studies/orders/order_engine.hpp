/// Orders of an error in any number of widths, with intervals that hold the asymptotic order.
///
/// No single model or choice of rows is trusted. Many models (term_model.hpp: the leading terms
/// alone; with next terms x or x² in one width or in all; with √x, a logarithm or a constant in one
/// width, and in the others none or √x, x or x²; for one width also a floor; and each width alone
/// on the rows where the others are finest) are fitted to many windows of rows (without the
/// coarsest levels of each width, one after another). One whose next terms are of two kinds counts
/// where none of the others has smaller residuals; none has a logarithm in two widths. A fit is
/// believed as far as it stays the same when its window changes by one level, and as its standard
/// error allows:
///
///     u_m² = max(t_{dof} s_m / 1.96, σ_m)² + (greatest change to a neighbouring window)²,
///     p = Σ p_m / u_m² / Σ 1 / u_m²,      half² = mean of (p_m − p)² + u_m², with the same
///     weights.
///
/// with the standard errors s_m from the residuals and σ_m from a known scatter of the rows: a
/// stated one, or that of rows at equal widths (replicates). So the interval knows scatter, the
/// drift of the order along its width (the neighbours), and what extrapolation gives (the models
/// with next terms, where they are steadier than those without). Where all of that is wide the
/// order is not determined, nor where it still moves (order_motion.hpp) or is steep and seen at two
/// levels alone; the status says why. Constants: OrderTuning. Ideas of
/// others: model averaging by stability and the spread over models as uncertainty (Rider et al.
/// 2016; Eça and Hoekstra 2014), many models times many windows (StREEQ, Sandia).
#pragma once

#include "studies/orders/error_rows.hpp"
#include "studies/orders/order_members.hpp"
#include "studies/orders/order_motion.hpp"
#include "studies/orders/term_model.hpp"

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// The constants of the engine. Set on one half of the grids that tests/orders/grids makes, and
/// scored on the other, but for `grid`: see the README there.
struct OrderTuning {
    /// Half of an interval wider than this says nothing: the order is not determined. Half of the
    /// distance between orders of methods.
    double widest = 0.5;
    /// A term that is a smaller part of the error in every row is hidden: next terms of the others
    /// are as large, and its order would be theirs.
    double least_share = 0.15;
    /// Added to half the interval: what no change of window or model shows. An order that changes
    /// by less from window to window stands still.
    double narrowest = 0.01;
    /// Half of a grid's interval over the spread. 1.2 of 1, 1.1, 1.2, 1.3 and 1.5, after a look at
    /// all three older sets of grids; 1.4 of 1.2, 1.4 and 1.6 when half orders, logarithms and
    /// constants came in, for the shipped solutions, of which 94.9 % held with 1.2: a choice that
    /// is not free of those. The two fresh sets had no say in it.
    double grid = 1.4;
    /// … and this much wider under known scatter, which more models follow. Of 1, 1.25, 1.5 and 2
    /// on tables of grids in two digits, those of tests/studies/records.cpp among them.
    double scattered = 1.5;
    /// … and this much wider where some width has three levels alone: no window leaves one out, and
    /// all that is seen of its drift is what models with a next term change.
    double three_levels = 2.5;
    /// Half of a sequence's interval over the spread: its windows are few and share their finest
    /// rows.
    double sequence = 3.0;
    /// … and this much wider, over the square of the levels less two, where these are few.
    double few_levels = 4.0;
    /// Drift that known scatter may hide, over the standard error of a window's order. On made-up
    /// tables of 3 to 6 levels with a next term half an order or one nearer and 0.1 to 3 % of
    /// scatter, which it was not tuned on, 105 of 1782 intervals miss (5.9 %), 146 of 1856 without
    /// it. More would leave more undetermined that is a power alone.
    double hidden_drift = 0.35;
    /// Added to u_m in the weights: models do not agree better than by chance.
    double agreement = 0.002;
    /// Widths within this factor are one level: an order read between them is noise. Scatter of 1 %
    /// makes an order between them uncertain by 0.12.
    double one_level = 1.12;
    /// More rows than this are averaged over cells of a lattice in ln of the widths: only time
    /// depends on it.
    std::size_t most_rows = 400;
};

struct OrderInterval {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = -std::numeric_limits<double>::infinity(); ///< 95 %
    double high = std::numeric_limits<double>::infinity();
    bool determined = false;
    double share = 0; ///< the greatest part of a row's error that the term is
    /// Why it is not determined, as "it rises over finer windows, to 1.68"; empty where it
    /// is.
    std::string status = {};

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
    explicit OrderEnsemble(std::span<const ErrorRow> rows, std::vector<double> reference = {},
                           const OrderTuning& tuning = {});

    /// Why there are no orders at all; empty where there are.
    const std::string& failure() const { return failure_; }
    const std::vector<EnsembleMember>& members() const { return members_; }
    std::vector<OrderInterval> orders() const;
    /// The error at other widths, with what the members say of it and of each other; against the
    /// exact solution, or against the reference.
    OrderInterval forecast(const std::vector<double>& widths, bool against_reference = false) const;
    /// The leading terms in the window whose orders are steadiest, of such the largest; null where
    /// there is none.
    const EnsembleMember* steadiest() const;
    /// Of one width: a factor ln x makes the order stand still, and nothing else does.
    bool has_logarithm() const;
    /// Whether a row is in a member's window.
    bool holds(const EnsembleMember& member, const std::vector<double>& widths) const;
    const OrderTuning& tuning() const { return tuning_; }

private:
    struct Mixture {
        double value = 0;
        double half = 0;
    };
    using Numbers = std::map<std::pair<int, std::vector<int>>, FittedNumber>;
    std::optional<double> change_of(const Numbers& numbers, int family,
                                    const std::vector<int>& place) const;
    Numbers numbers_of(const Functional& number) const;
    int place_of(Eigen::Index width, double log_width) const;
    std::optional<Mixture> mix(const Functional& number) const;
    OrderMotion motion_of(Eigen::Index width) const;
    double greatest_share(Eigen::Index width) const;
    bool is_seen_as_a_power(Eigen::Index width, const OrderInterval& order) const;
    std::string status_of(Eigen::Index width, const OrderInterval& order) const;
    double sequence_factor() const;
    double grid_factor() const;

    OrderTuning tuning_;
    TermRows rows_;
    std::vector<std::vector<double>> levels_; ///< ln of each width's levels, coarse to fine
    std::vector<double> stretch_;             ///< of a change along each width
    std::vector<EnsembleMember> members_;
    std::string failure_;
};

/// The orders of the error in each width; the failure in every status where there are none.
std::vector<OrderInterval> estimate_orders(std::span<const ErrorRow> rows,
                                           std::vector<double> reference = {},
                                           const OrderTuning& tuning = {});

} // namespace tvbeam

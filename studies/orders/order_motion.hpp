/// How an order moves: over windows that leave out ever more of the coarse levels, and from level
/// to level. One that is still moving is not known, however well models agree on it.
#pragma once

#include "studies/orders/order_members.hpp"
#include "studies/orders/order_tuning.hpp"
#include "studies/orders/term_model.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// The errors of one width alone, from coarse to fine, each exact.
struct LevelErrors {
    std::vector<double> log_widths, log_errors;
    std::vector<double> parts_of_others; ///< of each error, which terms of other widths are

    /// (ln h, p) in the middle of each two levels, without these parts.
    [[nodiscard]] std::vector<std::pair<double, double>> orders() const;
    /// The order between the two finest as it is seen, with these parts.
    [[nodiscard]] double last_seen() const;
    /// By how much the order changes over ln 2 of the width, from each such middle to the next:
    /// what is seen with these parts as well as without them, the less of both.
    [[nodiscard]] std::vector<double> changes() const;
    /// What the changes may owe to these parts.
    [[nodiscard]] double noise() const;
    /// Whether the order turned at the last level but one: nothing is seen of where it goes.
    [[nodiscard]] bool turn() const;
    /// Whether it moves one way, and by more and more, and leaves the interval in three more
    /// levels: a term of another order shows behind the one that is fitted. Of a leading term with
    /// a next one it moves less and less.
    [[nodiscard]] bool leave(double low, double high) const;
};

/// Of one width.
class OrderMotion {
public:
    /// levels: of each width, coarse to fine.
    OrderMotion(const TermRows& rows, const std::vector<std::vector<double>>& levels,
                std::span<const EnsembleMember> members, Eigen::Index width,
                const OrderTuning& tuning);

    /// Whether it moves on to where no window shows it; order: what all models say of it.
    [[nodiscard]] bool goes_on(double order) const {
        return runs_away() || leaps(order) || greatest_of_a_rise().has_value();
    }
    /// Of a grid against the exact solution: the last of its local orders where the other widths
    /// are finest and change next to nothing, where they rise from level to level to more than
    /// `high`. What says less has a constant of the opposite sign, which four levels do not show
    /// and a method does not have; none where terms of usual orders follow all rows to rounding.
    [[nodiscard]] std::optional<double> rises_past(double high) const;
    /// Of a sequence: whether one model's order stands still over its windows, all but one, while
    /// that of the leading term alone moves: then that model says what it moves to.
    [[nodiscard]] bool is_explained() const;
    /// Of exact errors without a reference: those of a sequence; those of a grid where the other
    /// widths are finest; none where much of an error is of their terms, as the next coarser step
    /// of each shows it, there are fewer than four, or leading terms follow all rows far more
    /// closely than the order changes.
    [[nodiscard]] std::optional<LevelErrors> levels_alone() const;
    /// As "it rises over finer windows, to 1.68"; empty where it moves to and fro, or not at all.
    [[nodiscard]] std::string words() const;
    /// The orders of the coarsest window and of the finest, where it falls from each to the next.
    [[nodiscard]] std::optional<std::pair<double, double>> falls() const;

private:
    [[nodiscard]] double step_over_windows() const;
    [[nodiscard]] bool may_be_a_step() const;
    [[nodiscard]] bool runs_away() const;
    [[nodiscard]] bool leaps(double order) const;
    [[nodiscard]] std::vector<Eigen::Index> finest_rows() const;
    [[nodiscard]] std::vector<double>
    local_orders(const std::vector<Eigen::Index>& rows,
                 const std::function<double(Eigen::Index)>& log_error) const;
    [[nodiscard]] std::optional<Eigen::Index> coarser_by_a_level(Eigen::Index row,
                                                                 Eigen::Index other) const;
    [[nodiscard]] std::optional<double> part_of_others(Eigen::Index row,
                                                       const std::vector<double>& orders) const;
    [[nodiscard]] std::vector<double> orders_of_all() const;
    [[nodiscard]] bool others_change_nothing(const std::vector<Eigen::Index>& rows) const;
    [[nodiscard]] bool terms_follow(double within, bool of_usual_orders) const;
    [[nodiscard]] bool has_usual_terms(const EnsembleMember& member) const;
    [[nodiscard]] std::optional<double> greatest_of_a_rise() const;

    const TermRows& rows_;
    const std::vector<std::vector<double>>& levels_;
    std::span<const EnsembleMember> members_;
    Eigen::Index width_;
    const OrderTuning& tuning_;
    std::vector<FittedNumber> windows_; ///< the order in each, and its standard error
};

} // namespace tvbeam

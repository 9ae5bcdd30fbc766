/// What each row of a ladder of refinements shows, in a word and a short sentence.
///
/// The rows run from coarse to fine. Rows whose widths differ by less than an eighth are one level,
/// of their mean error: an order read between them is noise. Where some levels share h and some Δt,
/// each sweep is judged by itself, and there is no window. Without a model the
/// judgement rests on the orders between levels alone: a level far off the line of its neighbours
/// is an outlier, and passed over; the asymptotic window is the finest run of rows whose orders are
/// positive and agree with each other and are not refuted by finer rows: past the window there is
/// nothing, a floor, a dip or a divergence, or one last row whose other order nothing confirms and
/// towards which the window does not drift. One order is never enough for that, so a ladder of two
/// rows is not asymptotic, unless the expected order is given and met. Where the order that all
/// levels determine is given, the window has the rows that show it, whether or not each agrees with
/// its neighbour; where it is given as not determined, there is none. With a two-term model of the
/// same norm, rows that the model describes are judged by it: it knows the order that the ladder
/// will show in the end, and a cancellation from an order.
#pragma once

#include "studies/orders/observed_order.hpp"
#include "studies/orders/order_engine.hpp"
#include "studies/orders/two_term_model.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tvbeam {

enum class Verdict {
    asymptotic,     ///< shows the order that the finer rows confirm
    pre_asymptotic, ///< not shown to be asymptotic: too coarse, or no other row confirms it
    cancellation,   ///< two error terms take each other away
    floor,          ///< the error stands still: rounding, or a term that is not refined
    diverging,      ///< the error grows under refinement
    outlier,        ///< out of line with rows on both sides, which agree without it
    unresolved, ///< the error itself is uncertain (Refinement::uncertainty); confirms no other row
    exact,      ///< the error is zero
    failed      ///< no error, or none that is a number
};

/// "asymptotic", "pre-asymptotic", "cancellation", "floor", "diverging", "outlier", "unresolved",
/// "exact", "failed"
const char* name_of(Verdict verdict);

struct RowVerdict {
    Verdict verdict = Verdict::failed;
    std::string reason; ///< a short sentence, without a full stop
};

/// The constants of the verdicts, chosen so that the shipped ladders and the made-up ones of
/// tests/orders/verdicts.cpp get the verdicts that a reader gives them; none is fitted.
struct VerdictTuning {
    /// An order below this is none: the error stands still. A twentieth of first order.
    double standstill = 0.05;
    /// Past the window, an order below this part of the window's is taken for a floor's.
    double floor_part = 0.5;
    /// Rounding scatters about its floor by less than this factor; an error that grows by more
    /// diverges.
    double floor_scatter = 3.0;
    /// A run of tiny orders after a longer run of so much larger ones is a floor whose scatter
    /// looks regular.
    double much_larger = 4.0;
    /// A row is described by the model where the two differ by less than this part of the error.
    double model_tolerance = 0.2;
    /// The orders of the window already run towards that of the finest row, by this part of the
    /// step that is left: a drift, and no kink that one row shows.
    double drift_part = 0.1;
};

struct VerdictOptions {
    /// Of the same quantity: of a squared norm it is twice the norm's.
    std::optional<double> expected_order = std::nullopt;
    /// Two orders agree where they differ by no more than this part of the greater.
    double tolerance = 0.1;
    /// Model of this norm (not its square), from a fit to these or other records.
    const TwoTermModel* model = nullptr;
    /// That along the ladder (ladder_order.hpp), which rows that are asymptotic have, to the
    /// tolerance or half the half width of its interval. None: not known.
    const OrderInterval* order = nullptr;
    /// Standard deviations of the errors, one a record: orders that agree within 95 % of what these
    /// make of them agree, and no dip is smaller. Empty: not known.
    std::span<const double> sigma = {};
};

struct LadderVerdict {
    std::vector<RowVerdict> rows; ///< one for each record
    /// Between levels: in the first record of each, against the level before of its sweep that has
    /// an error.
    std::vector<std::optional<double>> orders;
    /// The first and last record of the asymptotic window, and the order of the errors between
    /// them; none where no window is found. These come from the pairwise orders, also where there
    /// is a model.
    struct Window {
        std::size_t first = 0;
        std::size_t last = 0;
        double order = 0;
    };
    std::optional<Window> window;
};

LadderVerdict judge(std::span<const Refinement> ladder, const VerdictOptions& options = {});

} // namespace tvbeam

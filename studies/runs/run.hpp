#pragma once

#include "studies/data/printed_digits.hpp"
#include "studies/orders/observed_order.hpp"

#include <algorithm>
#include <any>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tvbeam {

/// One level of a refinement: s elements, h = 1/s, and N steps of length dt. On a mesh that is not
/// uniform h is the mean length, to which those of a family of meshes are in proportion.
struct Rung {
    std::int64_t elements = 0; ///< 0: the solver has no mesh
    std::int64_t steps = 0;    ///< 0: not known, as there is no final time
    double dt = 0.0; ///< as the scene gives it; steps · dt = final_time to rounding. 0: steady

    [[nodiscard]] bool has_mesh() const { return elements > 0; }
    [[nodiscard]] bool has_steps() const { return dt > 0.0; }
    [[nodiscard]] double h() const;    ///< NaN without a mesh
    [[nodiscard]] double step() const; ///< dt; NaN without steps
    /// What is there: "s = 10, dt = 1e-3", with dt as `text` writes it.
    [[nodiscard]] std::string name(const std::function<std::string(double)>& text) const;
};

/// What a run measures: the norm of an error, or its square; or a value whose limit is not known.
struct Measure {
    std::string name;         ///< e.g. "theta_L2L2_sq"
    bool squared = false;     ///< a square, which has twice the order
    std::string words = {};   ///< for display, e.g. "temperature in L²(0,T; L²), squared"
    std::string theorem = {}; ///< by which it is at most C (h² + Δt²); empty: none
    bool is_value = false;    ///< not of an error

    /// The name of the norm itself, without `_sq`.
    [[nodiscard]] std::string root() const;
    /// What orders along a study are of, the norm itself: root(), and "^(1/2)" behind the name of
    /// what is a square without saying so, as `corollary`.
    [[nodiscard]] std::string of_orders() const;
    /// The error, of a figure that may be its square.
    [[nodiscard]] double root_of(double figure) const {
        return squared ? std::sqrt(figure) : figure;
    }
};

/// One way of solving the problem, as its solver names and describes it.
struct Method {
    std::any scheme;        ///< what the solver knows it by: of the beam a Scheme
    std::string name;       ///< e.g. "bdf2, direct, lumped"
    std::string words;      ///< e.g. "direct algorithm, BDF2, lumped heat mass matrix"
    double cost = 1.0;      ///< of an element and a step, in those of the solver's cheapest method
    std::string iterations; ///< the counter of its iterations; empty: it does not iterate
};

/// What a run of the method costs, about: elements times steps times cost; of what is not there, or
/// not known, once.
double work_of(const Method& method, const Rung& rung);

/// How a run ended.
enum class RungStatus { ok, failed, interrupted };

std::string name_of(RungStatus status); ///< "ok", "failed", "interrupted"

/// The reason of one that nobody has begun: it is as one that was interrupted.
inline constexpr const char* not_made = "it was not made yet";

/// What a run did, so many times.
struct Count {
    std::string name; ///< e.g. "heat_solves"
    std::int64_t value = 0;
};

/// What one run of a study gave.
struct RungResult {
    Rung rung;
    RungStatus status = RungStatus::ok;
    std::string reason = {}; ///< why it failed; empty when ok
    double seconds = 0.0;    ///< wall clock, measuring included
    std::vector<Count> counters = {};
    std::vector<double> errors = {}; ///< or values, one a measure; empty when failed
    /// The part of each error that its solver knows to be uncertain, e.g. by its quadrature; empty:
    /// none of any.
    std::vector<double> uncertainties = {};
    /// Its solver met a kink of the solution in time, as where a contact begins or ends.
    bool has_kink = false;
    /// How finely each was printed, where a program wrote them; empty: they are the doubles found.
    std::vector<PrintedDigits> printed = {};
    PrintedDigits printed_seconds = {}; ///< none where they are not by a clock of the program's own
    /// The wall clock, where seconds are by a clock of the program's own.
    std::optional<double> wall_clock = {};

    /// What a budget of time counts: a clock of the program's own where it shows more.
    [[nodiscard]] double seconds_taken() const {
        return std::max(wall_clock.value_or(seconds), seconds);
    }

    /// A counter by its name; 0 where the solver has none of it.
    [[nodiscard]] std::int64_t count(std::string_view name) const;
    /// Of one that is not ok: "s = 8, dt = 1e-3 failed: why", numbers as `text` writes them.
    [[nodiscard]] std::string trouble(const std::function<std::string(double)>& text) const;
};

/// Whether a run failed that none is as fine as in h and dt: of an order or a limit beside it no
/// gate holds.
bool finest_failed(const std::vector<RungResult>& runs);
inline constexpr const char* finest_run_failed = "the finest run failed";

/// One run that a study wants.
struct RunTask {
    std::size_t level; ///< of the rung in its series, from 0
    const Rung& rung;
    double final_time; ///< 0: none
    const Method& method;
    const std::vector<Measure>& measures; ///< empty: nothing is measured
    /// Told at the start, and then every few steps, how many more have been made; false: the run
    /// ends.
    std::function<bool(std::int64_t steps)> advance;
};

/// A run is a call. It is made by the beam (beam_runs.hpp), or by any other solver; several threads
/// may call at a time. A run that fails says so in its result and does not throw.
using RunCall = std::function<RungResult(const RunTask&)>;

/// Runs of one method that belong together: a ladder, or a grid.
struct Series {
    std::string study;       ///< by which its runs are kept, e.g. "ladder", "work_precision.BDF2"
    double final_time = 0.0; ///< 0: none, of a solver that does not ask for it
    Method method;
    std::vector<Measure> measures;
    std::vector<Rung> rungs;
    bool may_grow = false; ///< by levels that `until` adds
};

/// To which the longest of the series runs; 0 without any.
double longest_time(const std::vector<Series>& all);

/// Whether a run shows something of measure k: an error that has a logarithm, or a value.
bool shows(const RungResult& run, const Measure& measure, std::size_t k);

/// The unit of the last digit printed of measure k in each run (printed_digits.hpp).
std::vector<double> units_of(const std::vector<RungResult>& rungs, std::size_t k, bool is_value);

/// The runs as records for an order analysis of measure k; a failed run has a NaN error.
std::vector<Refinement> records_of(const std::vector<RungResult>& rungs, std::size_t k);

/// The same with the root of every error: what the two-term model wants of a square.
std::vector<Refinement> root_records_of(const std::vector<RungResult>& rungs, std::size_t k,
                                        const Measure& measure);

} // namespace tvbeam

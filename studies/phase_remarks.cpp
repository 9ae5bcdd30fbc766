#include "studies/phase_remarks.hpp"

#include "core/space/quadrature.hpp"
#include "core/time/time_levels.hpp"
#include "mms/forecast/expected_orders.hpp"
#include "mms/local_power.hpp"
#include "mms/rough_times.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/error_text.hpp"
#include "mms/text/timed_remarks.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/evolution/evolution_block.hpp"
#include "studies/runs/beam_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;

namespace {

constexpr double tolerance = 1e-9; ///< of a jump, relative to what jumps, in all the time before
constexpr Eigen::Index looks = 9;  ///< at that time
constexpr std::size_t most_listed = 5;

/// A time at which rates may jump, or have an infinite slope.
struct Break {
    double t;
    bool is_phase_end;        ///< or within a phase
    double phase_length = {}; ///< of that one

    [[nodiscard]] std::string text() const {
        return "At t = " + message_text(t) +
               (is_phase_end ? ", where a phase of the solution ends, "
                             : ", within a phase of the solution, ");
    }
};

using Decreasing = std::set<double, std::greater<>>;

/// How far what is differenced in the two equations jumps.
struct RateJump {
    double heat = 0.0;    ///< greatest over x
    double bending = 0.0; ///< greatest over x
    bool tip = false;     ///< in the velocity of the tip, too: ∫ (1 − x) u_xxt dx
};

/// Whether a stop is touched between two times: without, the contact stress has no error.
bool touches(const ProblemData& data, double begin, double end) {
    if (!data.exact || !data.exact->stress)
        return false;
    constexpr Eigen::Index samples = 1001;
    const ArrayXd times = sample_points(begin, end, samples);
    return (data.amplitudes(times).row(*data.exact->stress) != 0.0).any();
}

/// σ̃(1,t) (1 − x) − μ, which jumps as ζ u_xxt does.
ArrayXd bending_rate(const ProblemData& data, const ArrayXd& x, double t) {
    const ArrayXd load = values(data, data.moment_load, x, t);
    if (!data.exact || !data.exact->stress)
        return -load;
    const double stress = data.amplitudes(ArrayXd::Constant(1, t))(*data.exact->stress, 0);
    return stress * (1.0 - x) - load;
}

/// The greatest size at times up to t: within a phase it may have no value at some of them.
template <typename Function>
double greatest_until(double t, const Function& of) {
    double size = 0;
    for (const double s : sample_points(0.0, t, looks))
        if (const double found = of(s).abs().maxCoeff(); std::isfinite(found) && found > size)
            size = found;
    return size;
}

RateJump rate_jump(const ProblemData& data, const Break& at) {
    const GaussRule rule = GaussRule::of(48);
    const ArrayXd& x = rule.points;
    const double after = std::nextafter(at.t, std::numeric_limits<double>::infinity());
    const auto noticed = [](const ArrayXd& difference, double size) -> ArrayXd {
        return difference.abs().maxCoeff() > tolerance * size ? difference
                                                              : ArrayXd::Zero(difference.size());
    };
    const auto jump = [&](const auto& of) -> ArrayXd {
        // What vanishes leaves rounding.
        const double size = std::max(greatest_until(at.t, of), greatest_until(after, of));
        if (at.is_phase_end)
            return noticed(of(after) - of(at.t), size);
        const auto row = [&](double t) -> Eigen::ArrayXXd { return of(t).transpose(); };
        return noticed(jump_across(row, at.t, at.t).row(0).transpose(), size);
    };
    const ArrayXd heat = jump([&](double t) { return values(data, data.heat_source, x, t); });
    const ArrayXd bending = jump([&](double t) { return bending_rate(data, x, t); });
    const double most = bending.abs().maxCoeff();
    const double tip = (rule.weights * (1.0 - x) * bending).sum();
    return {heat.abs().maxCoeff(), most, std::abs(tip) > tolerance * most};
}

/// The least β < 1 such that rates go to their values within a phase like s^β, s the time to t.
double cusp_power(const ProblemData& data, double t, double phase_length) {
    const ArrayXd x = sample_points(0.0, 1.0);
    double least = std::numeric_limits<double>::infinity();
    const auto see = [&](const auto& of) {
        const double size = greatest_until(t, of);
        for (const double direction : {-1.0, 1.0})
            least =
                std::min(least, power_below_one(
                                    [&](double s) -> ArrayXd {
                                        return of(t + direction * s) - of(t + 2.0 * direction * s);
                                    },
                                    t, phase_length, size));
    };
    see([&](double s) -> ArrayXd { return values(data, data.heat_source, x, s); });
    see([&](double s) { return bending_rate(data, x, s); });
    return least;
}

/// The steps of the runs in which such a time costs something.
struct Costly {
    Decreasing inside;             ///< it lies within a step
    Decreasing in_middle;          ///< in the middle of one of BDF2, whose leading errors cancel
    Decreasing behind;             ///< it is a level, which a later step reads across
    std::set<std::string> schemes; ///< of all runs
};

/// Whether a level of a run is there: a time within a phase is known to what its search allows.
bool meets(const TimeLevels& levels, const Rung& rung, const Break& at) {
    constexpr double searched = 1e-7;
    if (levels.meet(at.t) || at.is_phase_end)
        return levels.meet(at.t);
    const auto nearest = std::clamp<std::int64_t>(std::llround(at.t / rung.dt), 0, rung.steps);
    return std::abs(levels.time(nearest) - at.t) <= searched * at.t;
}

bool is_middle(double steps) {
    constexpr double searched = 1e-6; // of a step
    return std::abs(steps - std::floor(steps) - 0.5) <= searched;
}

Costly costly_steps(const Scene& scene, const ProblemData& data, const Break& at) {
    Costly costly;
    for (const auto& series : scene.series())
        for (const Rung& rung : series.rungs) {
            const TimeScheme& time = scheme_of(series.method).time;
            const TimeLevels levels(data, time, series.final_time, rung.steps);
            costly.schemes.insert(time.name);
            if (!(at.t < levels.time(rung.steps)))
                continue;
            if (!meets(levels, rung, at)) {
                costly.inside.insert(rung.dt);
                if (time.history > 0 && is_middle(at.t / levels.dt()))
                    costly.in_middle.insert(rung.dt);
            } else if (time.history > 0 && at.is_phase_end) // within one the run fails
                costly.behind.insert(rung.dt);
        }
    return costly;
}

std::vector<Break> breaks_of(const Scene& scene, const ProblemData& data) {
    std::vector<Break> breaks;
    for (const double end : data.phase_ends)
        breaks.push_back({.t = end, .is_phase_end = true});
    if (const auto* solution = std::get_if<Solution>(&scene.problem);
        solution != nullptr && !solution->phases.empty()) {
        const double final_time = scene.longest_time();
        for (const PhaseExpressions& phase : expressions_on(*solution, scene.beam).phases)
            if (phase.begin_value < final_time)
                for (const double t : rough_times(phase, final_time))
                    breaks.push_back(
                        {t, false, std::min(phase.end_value, final_time) - phase.begin_value});
    }
    std::ranges::sort(breaks, {}, &Break::t);
    return breaks;
}

std::string list_of(const std::vector<std::string>& parts) {
    std::string list;
    for (std::size_t i = 0; i < parts.size(); ++i)
        list += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + parts[i];
    return list;
}

std::string steps_text(const Decreasing& steps) {
    std::string text = "dt = ";
    std::size_t listed = 0;
    for (const double dt : steps) {
        if (listed == most_listed)
            return text + " and less";
        text += (listed++ == 0 ? "" : ", ") + message_text(dt);
    }
    return text;
}

/// What theory says of the scene; nothing: its solution is no text, or theory has no word for it.
std::optional<ExpectedOrders> theory_of(const Scene& scene) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (solution == nullptr || solution->phases.empty())
        return std::nullopt;
    try {
        return expected_orders({*solution, scene.beam, scene.longest_time()});
    } catch (const InputError&) {
        return std::nullopt; // as of a derivative that is too large
    }
}

/// What an order in dt is to be said of.
struct Losses {
    const RateJump& jump;
    bool touches_stop;  ///< in the step that holds the end, or later
    bool presses_later; ///< behind the end
};

/// By any of these schemes; of a square the square's.
Forecast order_of(const std::optional<ExpectedOrders>& theory, const Norm& norm,
                  const std::set<std::string>& schemes) {
    if (!theory)
        return {.kind = Forecast::Kind::unknown};
    Forecast result;
    for (const ExpectedOrder& row : theory->orders)
        for (const std::string& scheme : schemes)
            if (row.norm == norm.name)
                result = either(result, row.in_dt(scheme));
            else if (row.norm + "_sq" == norm.name)
                result = either(result, doubled(row.in_dt(scheme)));
    return result;
}

/// The orders in dt that are left, by norm; of a square the square's. Empty where nothing is read
/// that the jump touches.
std::string orders_text(const Scene& scene, const std::optional<ExpectedOrders>& theory,
                        const std::set<std::string>& schemes, const Losses& losses) {
    const RateJump& jump = losses.jump;
    const bool coupled = scene.beam.alpha != 0.0;
    const bool heat = jump.heat > 0.0 || coupled;
    const bool bending = jump.bending > 0.0 || coupled;
    std::map<std::pair<double, std::string>, std::vector<std::string>, std::greater<>> norms;
    for (const Norm& norm : norms_of(scene.measures())) {
        const QuantitySet set = norm.quantities();
        const auto has = [&](Quantity q) { return set[static_cast<std::size_t>(q)]; };
        const bool of_heat = heat && (has(Quantity::theta) || has(Quantity::theta_x));
        const bool of_stress =
            losses.touches_stop && has(Quantity::stress) && (jump.tip || coupled);
        const bool of_bending =
            bending && (has(Quantity::u) || has(Quantity::u_x) || has(Quantity::u_xx));
        Forecast order = order_of(theory, norm, schemes);
        if (of_stress ? !order.has_error() : !of_heat && !of_bending)
            continue;
        const double own = norm.squared ? 2.0 : 1.0;
        if (!of_stress && (!theory || order.is_known()))
            order = {Forecast::Kind::between, order.is_known() ? std::min(order.least, own) : own,
                     own};
        auto& names = norms[{order.greatest, order.is_known() ? words_of(order) : ""}];
        const std::string name = norm.name + (of_stress && !losses.presses_later
                                                  ? " (where the error keeps the tip on its stop)"
                                                  : "");
        if (std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    }
    std::vector<std::string> parts;
    parts.reserve(norms.size());
    for (const auto& [order, names] : norms)
        parts.push_back(
            (order.second.empty()
                 ? std::string(parts.empty() ? "an order" : "one") + " that is not known"
                 : (parts.empty() ? "the order " : "") + order.second) +
            " in " + list_of(names));
    return parts.empty() && scene.get<EvolutionBlock>() != nullptr ? "the order 1" : list_of(parts);
}

/// orders: those by these schemes.
template <typename Orders>
TimedRemark remark(const Scene& scene, const RateJump& jump, const Orders& orders,
                   const Costly& costly, const Break& at) {
    // The greatest over x is that of the points that were looked at.
    std::vector<std::string> jumps;
    std::vector<double> sizes;
    const auto add = [&](const char* rate, double size) {
        if (size > 0.0) {
            jumps.push_back(fmt::format("{} by about {:.2g}", rate, size));
            sizes.push_back(size);
        }
    };
    add(scene.beam.alpha != 0.0 ? "theta_t - alpha u_xxt" : "theta_t", jump.heat);
    add("zeta u_xxt", jump.bending);
    std::string costs;
    if (const std::string every = orders(costly.schemes); !costly.inside.empty())
        costs += " In a run of which no time level is there (" + steps_text(costly.inside) +
                 ") every time scheme has " + every +
                 (costly.in_middle.empty() ? ""
                                           : ", but BDF2 more, where it is the middle of a step (" +
                                                 steps_text(costly.in_middle) + ")") +
                 ", and an error that changes with the place in the step.";
    if (!costly.behind.empty())
        costs += " Where it is a level (" + steps_text(costly.behind) +
                 "), BDF2 still looks back across it and has " + orders({"bdf2"}) + ".";
    return {fmt::format("{} {} {} {}", at.is_phase_end, jump.heat > 0.0, jump.bending > 0.0, costs),
            message_text(at.t), at.text() + "rates jump: " + list_of(jumps) + "." + costs, sizes};
}

TimedRemark cusp_remark(double power, const Costly& costly, const Break& at) {
    const std::string slope =
        fmt::format("a rate has an infinite slope, like s^{}, s the time to it: errors that it "
                    "enters have a part of the order {} in dt, which changes with its place in "
                    "the step.",
                    local_power_text(power), local_power_text(1.0 + power));
    return {fmt::format("{} {}", local_power_text(power), steps_text(costly.inside)),
            message_text(at.t), at.text() + slope};
}

} // namespace

std::vector<std::string> phase_remarks(const Scene& scene, const ProblemData& data) {
    std::vector<TimedRemark> remarks;
    std::optional<ExpectedOrders> theory;
    for (const Break& at : breaks_of(scene, data)) {
        const Costly costly = costly_steps(scene, data, at);
        if (costly.inside.empty() && costly.behind.empty())
            continue;
        const RateJump jump = rate_jump(data, at);
        if (jump.heat == 0.0 && jump.bending == 0.0) {
            if (const double power =
                    at.is_phase_end ? 1.0 : cusp_power(data, at.t, at.phase_length);
                power < 1.0)
                remarks.push_back(cusp_remark(power, costly, at));
            continue;
        }
        // What the step that holds the end does to the stress shows in it, or behind it.
        const double step = costly.inside.empty() ? 0.0 : *costly.inside.begin();
        const double final_time = longest_time(scene.series());
        const double after = std::nextafter(at.t, std::numeric_limits<double>::infinity());
        const Losses losses{jump, touches(data, std::max(at.t - step, 0.0), final_time),
                            touches(data, after, final_time)};
        if (!theory)
            theory = theory_of(scene);
        const auto orders = [&](const std::set<std::string>& schemes) {
            return orders_text(scene, theory, schemes, losses);
        };
        if (!orders(costly.schemes).empty())
            remarks.push_back(remark(scene, jump, orders, costly, at));
    }
    return told(remarks);
}

} // namespace tvbeam

#include "studies/reference/reference_block.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/scene/study_keys.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tvbeam {

namespace {

/// The cubics of an extrapolated reference go through four nodes, also of the mesh with 2h.
constexpr std::int64_t fewest_for_richardson = 6;
constexpr double most_bytes = 1024.0 * 1024.0 * 1024.0;

std::int64_t read_elements(TableReader& table, bool richardson,
                           const std::vector<Series>& measured) {
    const auto given = table.integer("elements");
    if (!given)
        throw table.error("elements",
                          " is missing; give a multiple of every number of elements in the "
                          "studies");
    const std::int64_t elements = *given;
    const auto refuse = [&](const std::string& why) {
        throw table.error("elements", " is " + std::to_string(elements) + why);
    };
    if (elements < 1 || elements > most_elements)
        refuse("; a mesh has 1 to " + std::to_string(most_elements) + " elements");
    for (const auto& series : measured)
        for (const auto& rung : series.rungs) {
            const std::string held =
                std::to_string(rung.elements) + " of " + series.study + ".elements";
            if (elements < rung.elements)
                refuse(", coarser than the " + held + "; a reference is at least as fine");
            if (elements % rung.elements != 0)
                refuse("; it must be a multiple of the " + held);
        }
    if (richardson && (elements % 2 != 0 || elements < fewest_for_richardson))
        refuse("; richardson = true needs an even number, 6 or more, for its run with half of "
               "them");
    return elements;
}

/// Whether it is a whole number of steps of that length.
bool divides(double unit, double dt) {
    const double ratio = dt / unit;
    return std::abs(ratio - std::round(ratio)) <= 1e-9 * ratio;
}

/// The greatest step up to `most` that divides every dt, where one of a few parts of the finest
/// does.
std::optional<double> greatest_divisor(const std::vector<Series>& measured, double most) {
    std::vector<double> steps;
    for (const auto& series : measured)
        for (const auto& rung : series.rungs)
            steps.push_back(rung.dt);
    const double finest = std::ranges::min(steps);
    const double fewest = std::ceil(finest / most);
    constexpr int few = 100;
    for (int parts = 1; parts <= few; ++parts)
        if (parts >= fewest &&
            std::ranges::all_of(steps, [&](double dt) { return divides(finest / parts, dt); }))
            return finest / parts;
    return std::nullopt;
}

double read_reference_dt(TableReader& table, bool richardson, const std::vector<Series>& measured) {
    const auto given = table.number("dt");
    if (!given)
        throw table.error("dt", " is missing; give a step that divides every dt of the studies");
    const double dt = *given;
    const auto refuse = [&](const std::string& why) {
        throw table.error("dt", " is " + message_text(dt) + why);
    };
    if (!(dt > 0.0))
        refuse("; it must be > 0");
    const double unit = richardson ? 2.0 * dt : dt;
    const std::string must =
        richardson ? "; with richardson = true its double, the step of one of the runs, must "
                   : "; it must ";
    for (const auto& series : measured)
        for (const auto& rung : series.rungs) {
            const std::string held = message_text(rung.dt) + " of " + series.study + ".dt";
            const double ratio = rung.dt / unit;
            const double steps = rung.dt / dt * static_cast<double>(rung.steps);
            if (ratio < 1.0 - 1e-9 && richardson)
                refuse(fmt::format("{}be no larger than the {}", must, held));
            if (ratio < 1.0 - 1e-9)
                refuse(", coarser than the " + held + "; a reference is at least as fine");
            if (!(steps <= most_steps))
                refuse(", which makes " + message_text(steps) +
                       " steps; at most 1e12 are possible");
            if (!divides(unit, rung.dt)) {
                const auto better = greatest_divisor(measured, unit);
                refuse(fmt::format(
                    "{}divide the {} into a whole number of steps, not {}{}", must, held,
                    message_text(ratio),
                    better ? "; one that does is " + message_text(*better * dt / unit) : ""));
            }
        }
    return dt;
}

/// Whether no run refines a width: what every one lacks is in no order.
bool same_in_all(auto width, const std::vector<RungResult>& rungs) {
    return rungs.size() > 1 && std::ranges::all_of(rungs, [&](const RungResult& other) {
               return other.rung.*width == rungs.front().rung.*width;
           });
}

/// Within a factor of two of the reference's width, in a study that refines it.
bool is_close_in_h(const ReferenceBlock& reference, const Rung& rung,
                   const std::vector<RungResult>& rungs) {
    return 2 * rung.elements >= reference.elements && !same_in_all(&Rung::elements, rungs);
}

bool is_close_in_dt(const ReferenceBlock& reference, const Rung& rung,
                    const std::vector<RungResult>& rungs) {
    return reference.steps_in(rung) <= 2 && !same_in_all(&Rung::dt, rungs);
}

/// Temperature and curvature on every element at every kept level.
void require_memory(const TableReader& table, const ReferenceBlock& reference,
                    const std::vector<Series>& measured) {
    const auto refuse = [&](double levels) {
        const double bytes =
            3.0 * sizeof(double) * static_cast<double>(reference.elements) * levels;
        if (bytes > most_bytes)
            throw InputError(table.place("elements"),
                             "the reference would keep " + message_text(levels) +
                                 " time levels of " + std::to_string(reference.elements) +
                                 " elements, " +
                                 message_text(std::ceil(bytes / most_bytes * 10.0) / 10.0) +
                                 " GiB; at most 1 GiB is kept: take fewer elements, or fewer "
                                 "steps in the studies");
    };
    // First the study with most steps alone: the levels of all are listed only if they are few.
    for (const auto& series : measured)
        for (const auto& rung : series.rungs)
            refuse(static_cast<double>(rung.steps));
    refuse(static_cast<double>(kept_levels(reference, measured).size()));
}

} // namespace

std::int64_t ReferenceBlock::steps_in(const Rung& rung) const {
    return std::llround(rung.dt / dt);
}

bool ReferenceBlock::is(const Rung& rung) const {
    return rung.elements == elements && steps_in(rung) == 1;
}

bool ReferenceBlock::is_close_to(const Rung& rung, const std::vector<RungResult>& rungs) const {
    return !richardson && (is_close_in_h(*this, rung, rungs) || is_close_in_dt(*this, rung, rungs));
}

std::optional<Refinement> ReferenceBlock::widths() const {
    if (richardson)
        return std::nullopt;
    return Refinement{.h = 1.0 / static_cast<double>(elements), .dt = dt};
}

std::vector<std::int64_t> kept_levels(const ReferenceBlock& reference,
                                      const std::vector<Series>& measured) {
    std::vector<std::int64_t> levels;
    std::vector<std::pair<std::int64_t, std::int64_t>> listed; // runs of one grid share their steps
    for (const auto& series : measured)
        for (const auto& rung : series.rungs) {
            const std::pair every{reference.steps_in(rung), rung.steps};
            if (std::find(listed.begin(), listed.end(), every) != listed.end())
                continue;
            listed.push_back(every);
            for (std::int64_t n = 1; n <= every.second; ++n)
                levels.push_back(n * every.first);
        }
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    return levels;
}

namespace {

/// What the finest level does not show of its error: the part that the reference has as well.
std::string missing_remark(const ReferenceBlock& reference, const Rung& finest, bool has_squares,
                           bool is_smooth) {
    const double in_h =
        static_cast<double>(finest.elements) / static_cast<double>(reference.elements);
    const double in_dt = 1.0 / static_cast<double>(reference.steps_in(finest));
    constexpr double seen = 0.02; // less than this changes no order by more than 0.015
    if (reference.richardson)
        return {};
    if (std::max(in_h, in_dt) <= seen)
        return {};
    const auto part = [](const char* width, double ratio, const auto& missing) {
        if (ratio >= 1.0)
            return fmt::format("all of the part in {}", width);
        return fmt::format("{:.2g} % of a first-order part in {} and {:.2g} % of a second-order "
                           "one",
                           100.0 * missing(ratio), width, 100.0 * missing(ratio * ratio));
    };
    const auto parts = [&](const auto& missing) {
        std::string text = in_h > seen ? part("h", in_h, missing) : "";
        if (in_dt > seen)
            text += (text.empty() ? "" : ", ") + part("dt", in_dt, missing);
        return text;
    };
    const auto of_error = [](double ratio) { return ratio; };
    const auto of_square = [](double ratio) { return ratio * (2.0 - ratio); }; // 1 − (1 − r)²
    return fmt::format("The reference has an error of its own, so that errors of a smooth solution "
                       "are measured too small, most at s = {} (dt = {:g}): by up to {}{}. {}",
                       finest.elements, finest.dt, parts(of_error),
                       has_squares ? "; their squares by up to " + parts(of_square) : "",
                       is_smooth
                           ? "richardson = true extrapolates that away, if the solution is smooth."
                           : "A finer one has less.");
}

/// That an extrapolated reference is of a solution that is not smooth; or empty.
std::string extrapolation_remark(const ReferenceBlock& reference, bool changes_contact,
                                 const std::string& roughness) {
    if (!reference.richardson || (!changes_contact && roughness.empty()))
        return {};
    return fmt::format("The reference is extrapolated as that of a smooth solution, and {}: "
                       "what error of its own that leaves is not known, and one that stands "
                       "still may be the reference's.",
                       changes_contact ? "a contact begins or ends" : roughness);
}

} // namespace

std::string reference_remark(const ReferenceBlock& reference, const std::vector<RungResult>& rungs,
                             const std::vector<Measure>& measures, const std::string& roughness) {
    std::string named;
    std::size_t close = 0;
    for (const auto& run : rungs)
        if (reference.is_close_to(run.rung, rungs))
            named += fmt::format("{}s = {} (dt = {:g})", close++ > 0 ? ", " : "", run.rung.elements,
                                 run.rung.dt);
    const bool changes = std::ranges::any_of(rungs, &RungResult::has_kink);
    if (auto remark = extrapolation_remark(reference, changes, roughness); !remark.empty())
        return remark;
    if (close == 0)
        return rungs.empty() ? ""
                             : missing_remark(reference, rungs.back().rung,
                                              std::ranges::any_of(measures, &Measure::squared),
                                              !changes && roughness.empty());
    return (close == 1 ? "The level " : "The levels ") + named +
           (close == 1 ? " has an h or dt" : " have an h or dt") +
           " within a factor of two of the reference's: what is measured there lacks much of the "
           "error, and orders that it enters come out too high.";
}

std::string grid_reference_remark(const ReferenceBlock& reference,
                                  const std::vector<RungResult>& runs,
                                  const std::string& roughness) {
    if (reference.richardson)
        return extrapolation_remark(reference, std::ranges::any_of(runs, &RungResult::has_kink),
                                    roughness);
    std::vector<std::string> close; // meshes and steps, each once
    const auto add = [&](const std::string& width) {
        if (std::ranges::find(close, width) == close.end())
            close.push_back(width);
    };
    for (const auto& run : runs)
        if (is_close_in_h(reference, run.rung, runs))
            add(fmt::format("s = {}", run.rung.elements));
    for (const auto& run : runs)
        if (is_close_in_dt(reference, run.rung, runs))
            add(fmt::format("dt = {:g}", run.rung.dt));
    const bool is_one =
        std::ranges::any_of(runs, [&](const RungResult& run) { return reference.is(run.rung); });
    std::string remark;
    if (!close.empty())
        remark = fmt::format("The runs with {} have an h or dt within a factor of two of the "
                             "reference's: the fit takes the reference's own error into account "
                             "there, and rests on it.",
                             fmt::join(close, ", "));
    if (is_one)
        remark += " One of them is the reference itself, and its error 0 shows nothing.";
    return remark;
}

ReferenceBlock read_reference(TableReader& table, const std::vector<Series>& measured) {
    ReferenceBlock reference;
    reference.richardson = table.flag("richardson").value_or(false);
    reference.elements = read_elements(table, reference.richardson, measured);
    reference.dt = read_reference_dt(table, reference.richardson, measured);
    table.finish();
    require_memory(table, reference, measured);
    return reference;
}

} // namespace tvbeam

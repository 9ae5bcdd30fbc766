#include "studies/stress/stress.hpp"

#include <any>
#include <utility>

namespace tvbeam {

namespace {

/// What is iterated in a point of a map, in steps, and what two formulations and one in long double
/// take of a step, measured.
constexpr double steps_a_point = 100.0;
constexpr double steps_a_round_off_step = 6.0;

} // namespace

std::map<std::string, double> StressResult::figures() const {
    std::map<std::string, double> figures;
    if (!cases.empty()) {
        figures = cases.tallies().figures();
        figures["cases"] = static_cast<double>(cases.size());
    }
    if (contraction) {
        figures["contraction_least"] = contraction->least_ratio();
        figures["contraction_greatest"] = contraction->greatest_ratio();
        figures["contraction_refused"] = static_cast<double>(contraction->refused());
    }
    if (roundoff) {
        figures["moment_floor"] = roundoff->greatest_moment_floor();
        figures["hermite_least"] = roundoff->least_hermite_ratio();
        figures["hermite_greatest"] = roundoff->greatest_hermite_ratio();
        figures["discretisation_greatest"] = roundoff->greatest_discretisation_error();
        figures["hermite_exceeds"] = static_cast<double>(roundoff->remarks());
    }
    return figures;
}

namespace {

/// A case is run in nodal values, recorded and judged, by more than one path: measured, the steps
/// of so many runs.
constexpr double steps_a_judged_step = 40.0;

double work_of(const StressParameters& parameters) {
    return steps_a_judged_step * static_cast<double>(parameters.elements) *
           static_cast<double>(parameters.steps);
}

Parts case_parts(const StressBlock& block) {
    return {"stress", block.cases(), [&block](std::size_t i) { return work_of(block.case_at(i)); },
            [&block](std::size_t i) -> std::any { return judge(block.case_at(i)); },
            [](const std::any& judged) {
                return std::any_cast<const StressCase&>(judged).outcome == Outcome::failed;
            }};
}

Parts contraction_parts(const ContractionBlock& block) {
    return {"stress.contraction", block.dt.size(),
            [&block](std::size_t /*row*/) {
                return steps_a_point * static_cast<double>(block.alpha.size()) *
                       static_cast<double>(block.elements);
            },
            [&block](std::size_t row) -> std::any { return measure_contraction(block, row); }};
}

Parts round_off_parts(const RoundOffBlock& block) {
    return {"stress.roundoff", block.elements.size(),
            [&block](std::size_t row) {
                return steps_a_round_off_step * static_cast<double>(block.steps) *
                       static_cast<double>(block.elements[row]);
            },
            [&block](std::size_t row) -> std::any { return measure_round_off(block, row); }};
}

void note_reached(StressResult& result, const Parts& parts, std::size_t there) {
    if (there == parts.count)
        return;
    result.interrupted = true;
    result.reached.push_back({parts.study, there, parts.count});
}

/// All results of the parts, in their order; none where one is missing.
template <typename Row>
std::optional<std::vector<Row>> rows_of(const Parts& parts, const Execution& execution,
                                        StressResult& result) {
    std::vector<Row> rows(parts.count);
    std::size_t there = 0;
    run_parts(parts, execution, [&](std::size_t i, std::any row) {
        rows[i] = std::any_cast<Row>(std::move(row));
        ++there;
    });
    note_reached(result, parts, there);
    return there == parts.count ? std::optional(std::move(rows)) : std::nullopt;
}

} // namespace

std::vector<Parts> parts_of(const StressBlock& block) {
    std::vector<Parts> all{case_parts(block)};
    if (block.contraction)
        all.push_back(contraction_parts(*block.contraction));
    if (block.roundoff)
        all.push_back(round_off_parts(*block.roundoff));
    return all;
}

StressResult run_stress(const StressBlock& block, const Execution& execution) {
    StressResult result;
    run_parts(case_parts(block), execution, [&](std::size_t i, std::any judged) {
        auto& one = *std::any_cast<StressCase>(&judged);
        one.parameters = block.case_at(i); // results are kept without
        result.cases.set(i, one);
    });
    note_reached(result, case_parts(block), result.cases.size());
    if (block.contraction)
        if (const auto rows =
                rows_of<ContractionRow>(contraction_parts(*block.contraction), execution, result))
            result.contraction = contraction_map(*block.contraction, *rows);
    if (block.roundoff)
        if (auto rows = rows_of<RoundOffRow>(round_off_parts(*block.roundoff), execution, result))
            result.roundoff = RoundOffTable{*std::move(rows)};
    return result;
}

} // namespace tvbeam

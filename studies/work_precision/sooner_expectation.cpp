#include "studies/work_precision/sooner_expectation.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/work_precision/work_precision.hpp"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace tvbeam {

namespace {

/// Which two schemes, and at what error of which norm; places in the block.
struct Pairing {
    std::size_t norm, faster, slower;
    double error;
};

/// The place of the name that the key holds.
std::size_t place_of(TableReader& table, const std::string& key,
                     const std::vector<std::string>& names) {
    const auto name = table.text(key);
    if (!name)
        throw table.error(key,
                          " is missing; give it one of " + boost::algorithm::join(names, ", "));
    const auto found = std::ranges::find(names, *name);
    if (found == names.end())
        throw table.error(key, " is '" + *name + "'; it must be one of " +
                                   boost::algorithm::join(names, ", "));
    return static_cast<std::size_t>(found - names.begin());
}

/// The times of the two, as they were compared; none: one of them does not reach the error.
std::optional<Comparison> compared(const Pairing& pair, const WorkPrecisionBlock& block,
                                   const WorkPrecisionResult& result) {
    const auto costs = costs_of(block, result.schemes);
    const auto& errors = costs[pair.norm].errors;
    const auto off = [&](const ReachedError& one) { return std::abs(one.error - pair.error); };
    const auto nearest = std::ranges::min_element(errors, {}, off);
    if (nearest == errors.end() || !(off(*nearest) <= same_error * pair.error))
        return std::nullopt;
    for (const auto& one : nearest->comparisons) {
        if (one.faster == pair.faster && one.slower == pair.slower)
            return one.times;
        if (one.faster == pair.slower && one.slower == pair.faster) {
            Comparison turned = one.times;
            turned.ratio = 1.0 / one.times.ratio;
            return turned;
        }
    }
    return std::nullopt;
}

} // namespace

void expect_sooner(TableReader& table, const WorkPrecisionBlock& block,
                   const std::function<const WorkPrecisionResult&(const StudyResult&)>& record,
                   std::vector<Expectation>& expectations) {
    std::vector<std::string> norms;
    for (const auto& norm : block.norms)
        norms.push_back(norm.name);
    std::vector<std::string> schemes;
    for (const auto& scheme : block.schemes)
        schemes.push_back(scheme.name);
    for (auto& one : table.tables("sooner")) {
        const std::size_t before = expectations.size();
        const auto error = one.number("error");
        if (!error || !(*error > 0.0))
            throw one.error("error", " must be a number > 0: the error that both reach");
        const Pairing pair{place_of(one, "norm", norms), place_of(one, "faster", schemes),
                           place_of(one, "slower", schemes), *error};
        if (pair.faster == pair.slower)
            throw one.error("slower", " is the scheme that faster names; it must be another");
        const std::string what = "work_precision: " + schemes[pair.faster] + " sooner than " +
                                 schemes[pair.slower] + " at " + norms[pair.norm] + " = " +
                                 metric_text(*error);
        const std::string absence =
            "not compared: an error that a scheme does not reach, or "
            "neither a power of ten nor a target, or a clock that shows 0 s";
        if (const auto band = one.band("ratio"))
            expectations.push_back(in_band(
                band->lowest, band->highest, one.place("ratio"),
                [pair, block, record, what, absence](const StudyResult& result) {
                    const auto times = compared(pair, block, record(result));
                    return std::vector{Metric{what + ", ratio of times",
                                              times ? std::optional(times->ratio) : std::nullopt,
                                              absence}};
                }));
        if (const auto wanted = one.flag("distinguishable"))
            expectations.push_back([pair, block, record, what, absence, wanted,
                                    place =
                                        one.place("distinguishable")](const StudyResult& result) {
                const auto times = compared(pair, block, record(result));
                const auto words = [](bool yes) {
                    return yes ? "distinguishable" : "not distinguishable";
                };
                const bool is_other = times && times->ratio < 1.0 && times->distinguishable;
                const bool is_sooner = times && times->distinguishable && !is_other;
                return std::vector{CheckedExpectation{.what = what,
                                                      .expected = words(*wanted),
                                                      .found = !times ? absence
                                                               : is_other
                                                                   ? "not sooner: the other one is"
                                                                   : words(is_sooner),
                                                      .place = place,
                                                      .holds = times && is_sooner == *wanted}};
            });
        finish_expecting(one, before, expectations);
    }
}

} // namespace tvbeam

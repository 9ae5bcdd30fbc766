#include "studies/stress/stress_cases.hpp"

#include "studies/stress/scratch.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

namespace tvbeam {

namespace {

/// Where a text stands among the texts.
struct TextPlace {
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
};

/// A case without its texts.
struct CaseRecord {
    bool is_there = false;
    bool has_checks = false;
    bool has_path = false;
    bool has_error = false;
    bool has_order_defect = false;
    Outcome outcome = Outcome::certified;
    InitialData initial = InitialData::zero;
    ThermalMass thermal_mass = ThermalMass::consistent;
    Algorithm algorithm = Algorithm::direct;
    unsigned seed = 1;
    std::array<double, 6> real{}; ///< alpha, zeta, dt, theta_A, load, seconds
    std::int64_t elements = 0;
    std::int64_t steps = 0;
    Stops stops;
    std::array<double, 9> checks{};
    std::array<double, 3> optional_checks{}; ///< path, error, order_defect
    TextPlace time;
    TextPlace reason;
    TextPlace path_skipped;
    TextPlace error_skipped;
};
static_assert(std::is_trivially_copyable_v<CaseRecord>);

constexpr double StressChecks::*plain_checks[] = {
    &StressChecks::energy,      &StressChecks::heat_residual, &StressChecks::beam_residual,
    &StressChecks::penetration, &StressChecks::wrong_sign,    &StressChecks::complementarity,
    &StressChecks::initial,     &StressChecks::allowance,     &StressChecks::path_limit};

} // namespace

struct StressCases::Kept {
    Scratch records;
    Scratch texts;
    std::map<std::string, TextPlace, std::less<>> places; ///< of the first few texts, which recur
    StressTallies tallies;
    std::size_t size = 0;
    std::optional<std::pair<std::size_t, std::string>> failure; ///< index and reason of the first

    TextPlace place_of(const std::string& text) {
        if (text.empty())
            return {};
        if (const auto known = places.find(text); known != places.end())
            return known->second;
        const TextPlace place{texts.size(), text.size()};
        texts.write(place.offset, text.data(), text.size());
        constexpr std::size_t most_places = 1000;
        if (places.size() < most_places)
            places.emplace(text, place);
        return place;
    }
    [[nodiscard]] std::string text_at(const TextPlace& place) const {
        std::string text(place.size, '\0');
        if (place.size > 0)
            texts.read(place.offset, text.data(), text.size());
        return text;
    }
    [[nodiscard]] CaseRecord record_at(std::size_t index) const {
        CaseRecord record;
        records.read(index * sizeof(record), &record, sizeof(record));
        return record;
    }
    void add_checks(const StressChecks& checks, CaseRecord& record) {
        record.has_checks = true;
        for (std::size_t k = 0; k < std::size(plain_checks); ++k)
            record.checks[k] = checks.*plain_checks[k];
        record.has_path = checks.path.has_value();
        record.has_error = checks.error.has_value();
        record.has_order_defect = checks.order_defect.has_value();
        record.optional_checks = {checks.path.value_or(0.0), checks.error.value_or(0.0),
                                  checks.order_defect.value_or(0.0)};
        record.path_skipped = place_of(checks.path_skipped);
        record.error_skipped = place_of(checks.error_skipped);
    }
    [[nodiscard]] StressChecks checks_of(const CaseRecord& record) const {
        StressChecks checks;
        for (std::size_t k = 0; k < std::size(plain_checks); ++k)
            checks.*plain_checks[k] = record.checks[k];
        const auto optional = [&](bool there, std::size_t k) {
            return there ? std::optional(record.optional_checks[k]) : std::nullopt;
        };
        checks.path = optional(record.has_path, 0);
        checks.error = optional(record.has_error, 1);
        checks.order_defect = optional(record.has_order_defect, 2);
        checks.path_skipped = text_at(record.path_skipped);
        checks.error_skipped = text_at(record.error_skipped);
        return checks;
    }
    [[nodiscard]] StressCase case_of(const CaseRecord& record) const {
        StressCase one;
        auto& p = one.parameters;
        p.alpha = record.real[0];
        p.zeta = record.real[1];
        p.dt = record.real[2];
        p.theta_A = record.real[3];
        p.load = record.real[4];
        one.seconds = record.real[5];
        p.elements = record.elements;
        p.steps = record.steps;
        p.stops = record.stops;
        p.initial = record.initial;
        p.seed = record.seed;
        p.time = text_at(record.time);
        p.thermal_mass = record.thermal_mass;
        p.algorithm = record.algorithm;
        one.outcome = record.outcome;
        one.reason = text_at(record.reason);
        if (record.has_checks)
            one.checks = checks_of(record);
        return one;
    }
};

StressCases::StressCases() : kept_(std::make_shared<Kept>()) {}

void StressCases::set(std::size_t index, const StressCase& one) {
    const StressParameters& p = one.parameters;
    CaseRecord record{.is_there = true,
                      .outcome = one.outcome,
                      .initial = p.initial,
                      .thermal_mass = p.thermal_mass,
                      .algorithm = p.algorithm,
                      .seed = p.seed,
                      .real = {p.alpha, p.zeta, p.dt, p.theta_A, p.load, one.seconds},
                      .elements = p.elements,
                      .steps = p.steps,
                      .stops = p.stops,
                      .time = kept_->place_of(p.time),
                      .reason = kept_->place_of(one.reason),
                      .path_skipped = {},
                      .error_skipped = {}};
    if (one.checks)
        kept_->add_checks(*one.checks, record);
    kept_->records.write(index * sizeof(record), &record, sizeof(record));
    kept_->tallies.add(one);
    ++kept_->size;
    if (one.outcome == Outcome::failed && (!kept_->failure || index < kept_->failure->first))
        kept_->failure = {index, one.reason};
}

std::size_t StressCases::size() const {
    return kept_->size;
}

const StressTallies& StressCases::tallies() const {
    return kept_->tallies;
}

std::string StressCases::first_failure() const {
    return kept_->failure ? kept_->failure->second : "";
}

std::size_t StressCases::slots() const {
    return kept_->records.size() / sizeof(CaseRecord);
}

StressCase StressCases::at(std::size_t index) const {
    return kept_->case_of(kept_->record_at(index));
}

void StressCases::visit(const std::function<void(const StressCase&)>& visitor) const {
    for (std::size_t i = 0; i < slots(); ++i)
        if (const CaseRecord record = kept_->record_at(i); record.is_there)
            visitor(kept_->case_of(record));
}

} // namespace tvbeam

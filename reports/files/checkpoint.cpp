#include "reports/files/checkpoint.hpp"

#include "mms/text/input_error.hpp"
#include "reports/files/kept_result.hpp"
#include "reports/files/output_file.hpp"
#include "reports/files/run_identity.hpp"
#include "studies/ladder/ladder_block.hpp"
#include "studies/stress/stress_block.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* schema = "tvbeam-unfinished/2";
constexpr const char* advice = "; remove the file to begin anew";

/// More levels than `until` can add before they are too fine.
constexpr std::size_t most_levels = 200;

/// The runs that the scene may ask for, by Series::study.
std::map<std::string, Series> asked_runs(const Scene& scene) {
    std::map<std::string, Series> asked;
    for (auto& series : scene.series())
        asked.emplace(series.study, series);
    if (const auto* ladder = scene.get<LadderBlock>(); ladder != nullptr && ladder->until) {
        auto& rungs = asked.at("ladder").rungs;
        for (auto next = ladder->next(rungs); next && rungs.size() < most_levels;
             next = ladder->next(rungs))
            rungs.push_back(*next);
    }
    return asked;
}

std::size_t asked_cases(const Scene& scene) {
    std::size_t count = 0;
    if (const auto* stress = scene.get<StressBlock>())
        for (const auto& sweep : stress->sweeps)
            count += sweep.cases.size();
    return count;
}

/// Deeper than anything that is written here.
constexpr int deepest = 32;

Json parsed(const std::string& line) {
    return Json::parse(line, [](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
        if (depth > deepest)
            throw std::invalid_argument("it is nested too deep");
        return true;
    });
}

} // namespace

Checkpoint::Checkpoint(const std::filesystem::path& directory, const Scene& scene, bool resume)
    : file_(directory / "unfinished.jsonl"),
      identity_(Json{{"schema", schema}, {"of", run_identity(scene)}}.dump()) {
    const OutputFile writable(file_.path());
    if (!std::filesystem::exists(file_.path()))
        return;
    if (!resume)
        throw InputError({file_.path().string()},
                         "holds results of an attempt that was cut short; go on with it by "
                         "--resume, or remove the file");
    read(scene);
}

void Checkpoint::read(const Scene& scene) {
    const Place place{file_.path().string()};
    const auto asked = asked_runs(scene);
    const std::size_t cases = asked_cases(scene);
    torn_ = file_.read([&](std::size_t number, const std::string& line) {
        try {
            const Json json = parsed(line);
            if (number > 1) {
                read_entry(asked, cases, json);
                return;
            }
            begun_ = true;
            if (!json.is_object() || json.value("schema", Json()) != schema ||
                !json.contains("of") || !json["of"].is_object())
                throw std::invalid_argument(std::string("its schema is not ") + schema);
            if (const auto difference = difference_of(json["of"], parsed(identity_)["of"]);
                !difference.empty())
                throw InputError(place, "holds results of " + difference +
                                            ", and the two do not fit together" + advice);
        } catch (const nlohmann::json::exception& error) {
            throw InputError(place, fmt::format("is not what tvbeam wrote: line {}: {}{}", number,
                                                error.what(), advice));
        } catch (const std::invalid_argument& error) {
            throw InputError(place, fmt::format("is not what tvbeam wrote: line {}: {}{}", number,
                                                error.what(), advice));
        }
    });
    holds_runs_ = found() > 0;
}

void Checkpoint::read_entry(const Asked& asked, std::size_t cases, const Json& entry) {
    if (!entry.is_object() || !entry.contains("study") || !entry["study"].is_string() ||
        !entry.contains("index") || !entry["index"].is_number_unsigned() ||
        !entry.contains("result"))
        throw std::invalid_argument("it has no study, index and result");
    const std::string study = entry["study"];
    const std::size_t index = entry["index"];
    const auto require_asked = [&](std::size_t count) {
        if (index >= count)
            throw std::invalid_argument(fmt::format("the scene has no run {} of {}", index, study));
    };
    if (study == "stress") {
        require_asked(cases);
        cases_.emplace(index, kept_case(entry["result"]));
        return;
    }
    const auto runs = asked.find(study);
    require_asked(runs == asked.end() ? 0 : runs->second.rungs.size());
    runs_.emplace(std::pair(study, index), kept_run(entry["result"], runs->second.rungs[index],
                                                    runs->second.measures.size()));
}

void Checkpoint::add_entry(const std::string& study, std::size_t index, const Json& result) {
    const std::scoped_lock lock(mutex_);
    if (!failure_.empty())
        return;
    try {
        if (!begun_)
            file_.append(identity_);
        begun_ = true;
        file_.append(Json{{"study", study}, {"index", index}, {"result", result}}.dump(
            -1, ' ', false, Json::error_handler_t::replace));
        holds_runs_ = true;
    } catch (const OutputError& error) {
        failure_ = error.what();
    }
}

std::optional<RungResult> Checkpoint::find(const Series& series, std::size_t index) {
    const auto kept = runs_.find({series.study, index});
    return kept == runs_.end() ? std::nullopt : std::optional(kept->second);
}

void Checkpoint::add(const Series& series, std::size_t index, const RungResult& result) {
    add_entry(series.study, index, kept(result));
}

std::optional<StressCase> Checkpoint::find_case(std::size_t index) {
    const auto kept = cases_.find(index);
    return kept == cases_.end() ? std::nullopt : std::optional(kept->second);
}

void Checkpoint::add_case(std::size_t index, const StressCase& result) {
    add_entry("stress", index, kept(result));
}

void Checkpoint::write() {
    try {
        file_.flush();
    } catch (const OutputError& error) {
        failure_ = error.what();
    }
}

void Checkpoint::remove() {
    file_.remove();
    holds_runs_ = false;
}

} // namespace tvbeam

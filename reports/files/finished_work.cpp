#include "reports/files/finished_work.hpp"

#include "mms/text/input_error.hpp"
#include "reports/files/kept_result.hpp"
#include "reports/files/output_file.hpp"
#include "reports/files/run_identity.hpp"
#include "studies/stress/stress_block.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* work_schema = "tvbeam-work/1";
constexpr const char* removal = "; remove the file to make its runs anew";

/// Deeper than anything that is written here.
constexpr int deepest_work = 32;

Json parsed(std::string_view line) {
    return Json::parse(line, [](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
        if (depth > deepest_work)
            throw std::invalid_argument("it is nested too deep");
        return true;
    });
}

Json json_of(const WorkOrigin& origin) {
    Json json{{"scene", origin.scene}, {"set", origin.overrides}};
    if (origin.shard)
        json["shard"] = {origin.shard->number, origin.shard->of};
    return json;
}

WorkOrigin origin_of(const Json& json) {
    WorkOrigin origin{.scene = json.at("scene").get<std::string>(),
                      .overrides = json.at("set").get<std::vector<std::string>>(),
                      .shard = {}};
    if (json.contains("shard"))
        origin.shard = Shard{json["shard"].at(0).get<std::uint32_t>(),
                             json["shard"].at(1).get<std::uint32_t>()};
    return origin;
}

void require_head(const Json& head) {
    if (!head.is_object() || head.value("schema", Json()) != work_schema || !head.contains("of") ||
        !head["of"].is_object() || !head.contains("origin"))
        throw std::invalid_argument(std::string("its schema is not ") + work_schema);
}

/// Calls with the place of what is wrong in what it throws.
template <typename Call>
void placed(const std::filesystem::path& file, std::size_t number, const Call& call) {
    const auto refuse = [&](const char* reason) {
        throw InputError({file.string()}, fmt::format("is not what tvbeam wrote: line {}: {}{}",
                                                      number, reason, removal));
    };
    try {
        call();
    } catch (const nlohmann::json::exception& error) {
        refuse(error.what());
    } catch (const std::invalid_argument& error) {
        refuse(error.what());
    }
}

bool has_failed(const std::any& result) {
    const auto* run = std::any_cast<RungResult>(&result);
    const auto* judged = std::any_cast<StressCase>(&result);
    return (run != nullptr && run->status == RungStatus::failed) ||
           (judged != nullptr && judged->outcome == Outcome::failed);
}

} // namespace

FinishedWork::FinishedWork(const Scene& scene, const WorkOrigin& origin)
    : scene_(scene), groups_(work_groups(scene)), head_{{"schema", work_schema},
                                                        {"of", run_identity(scene)},
                                                        {"origin", json_of(origin)}} {
    for (const auto& group : groups_) {
        group_of_.emplace(group.study, group_of_.size());
        places_.emplace_back(group.count());
    }
}

TornLines FinishedWork::read(const std::filesystem::path& file) {
    const LineFile& lines = files_.emplace_back(file);
    bool has_head = false;
    const TornLines torn = lines.read([&](const KeptLine& line) {
        placed(file, line.number, [&] {
            const Json json = parsed(line.text);
            if (json.contains("schema")) { // two programs may have begun the file at a time
                read_head(json, {file.string()});
                has_head = true;
            } else if (!has_head) {
                throw std::invalid_argument("nothing before it says what it is of");
            } else {
                read_entry(json, line);
            }
        });
    });
    if (!has_head && torn.has_an_end)
        placed(file, torn.first, [] { throw std::invalid_argument("it is not whole"); });
    return torn;
}

void FinishedWork::read_head(const Json& head, const Place& place) const {
    require_head(head);
    if (const auto difference = difference_of(head["of"], head_["of"]); !difference.empty())
        throw InputError(place, "holds results of " + difference +
                                    ", and the two do not fit together" + removal);
    const Json& there = head["origin"];
    const Json& here = head_["origin"];
    if (there.contains("shard") && here.contains("shard") && there["shard"] != here["shard"])
        throw InputError(place, "holds another shard than its name says" + std::string(removal));
}

bool FinishedWork::is_made_again(const Where& where) const {
    return where.failed && kept_;
}

std::any FinishedWork::result_of(std::size_t group, std::size_t index, const Json& json) const {
    const WorkGroup& asked = groups_[group];
    if (asked.series)
        return kept_run(json, asked.series->rungs[index], asked.series->measures);
    if (asked.study == "stress")
        return kept_case(json);
    const auto* stress = scene_.get<StressBlock>();
    if (asked.study == "stress.contraction")
        return kept_contraction(json, stress->contraction->alpha.size());
    return kept_round_off(json, stress->roundoff->elements[index]);
}

void FinishedWork::read_entry(const Json& entry, const KeptLine& line) {
    if (!entry.is_object() || !entry.contains("study") || !entry["study"].is_string() ||
        !entry.contains("index") || !entry["index"].is_number_unsigned() ||
        !entry.contains("result"))
        throw std::invalid_argument("it has no study, index and result");
    const std::string study = entry["study"];
    const std::size_t index = entry["index"];
    const auto group = group_of_.find(study);
    if (group == group_of_.end() || index >= places_[group->second].size())
        throw std::invalid_argument(fmt::format("the scene has no run {} of {}", index, study));
    const std::any result = result_of(group->second, index, entry["result"]);
    Where& where = places_[group->second][index];
    if (where.file > 0 && !where.failed) // made by two programs: the first one's
        return;
    const bool counted = where.file > 0 && !is_made_again(where);
    where = {.offset = line.offset,
             .size = static_cast<std::uint32_t>(line.text.size()),
             .file = static_cast<std::uint32_t>(files_.size()) & 0x7fffffffU,
             .failed = has_failed(result)};
    found_ += !counted && !is_made_again(where) ? 1 : 0;
    holds_runs_ = true;
}

void FinishedWork::keep_in(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::exists(file, error)) {
        if (!std::filesystem::is_regular_file(file, error))
            throw InputError({file.string()}, "is no file of results; remove it");
        if (access(file.c_str(), W_OK) != 0)
            throw OutputError("cannot write '" + file.string() +
                              "': " + std::generic_category().message(errno));
    }
    const OutputFile writable(file);
    kept_.emplace(file);
}

std::any FinishedWork::find(const std::string& study, std::size_t index) const {
    const auto group = group_of_.find(study);
    if (group == group_of_.end() || index >= places_[group->second].size())
        return {};
    const Where& where = places_[group->second][index];
    if (where.file == 0 || is_made_again(where))
        return {};
    return result_of(group->second, index,
                     parsed(files_[where.file - 1].line_at(where.offset, where.size))["result"]);
}

std::optional<RungResult> FinishedWork::find(const Series& series, std::size_t index) {
    const std::any kept = find(series.study, index);
    return kept.has_value() ? std::optional(std::any_cast<RungResult>(kept)) : std::nullopt;
}

std::any FinishedWork::find_part(const std::string& study, std::size_t index) {
    return find(study, index);
}

void FinishedWork::add_entry(const std::string& study, std::size_t index, const Json& result) {
    const std::scoped_lock lock(mutex_);
    if (!kept_ || !failure_.empty())
        return;
    const auto line = [](const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    try {
        if (!begun_)
            kept_->append(line(head_));
        begun_ = true;
        kept_->append(line({{"study", study}, {"index", index}, {"result", result}}));
        holds_runs_ = true;
    } catch (const OutputError& error) {
        failure_ = error.what();
    }
}

void FinishedWork::add(const Series& series, std::size_t index, const RungResult& result) {
    add_entry(series.study, index, kept(result));
}

void FinishedWork::add_part(const std::string& study, std::size_t index, const std::any& result) {
    if (const auto* judged = std::any_cast<StressCase>(&result))
        add_entry(study, index, kept(*judged));
    else if (const auto* contraction = std::any_cast<ContractionRow>(&result))
        add_entry(study, index, kept(*contraction));
    else if (const auto* round_off = std::any_cast<RoundOffRow>(&result))
        add_entry(study, index, kept(*round_off));
    else
        throw std::logic_error("results of '" + study + "' cannot be kept");
}

void FinishedWork::write() {
    if (!kept_)
        return;
    try {
        kept_->flush();
    } catch (const OutputError& error) {
        failure_ = error.what();
    }
}

void FinishedWork::remove() {
    if (kept_)
        kept_->remove();
    holds_runs_ = false;
}

std::optional<WorkOrigin> work_origin_of(const std::filesystem::path& file) {
    struct Found {};
    WorkOrigin origin;
    try {
        LineFile(file).read([&](const KeptLine& line) {
            placed(file, line.number, [&] {
                const Json head = parsed(line.text);
                require_head(head);
                origin = origin_of(head["origin"]);
            });
            throw Found();
        });
    } catch (const Found&) {
        return origin;
    }
    return std::nullopt;
}

} // namespace tvbeam

#include "reports/files/solver_runs.hpp"

#include "mms/text/input_error.hpp"
#include "reports/files/kept_result.hpp"
#include "reports/files/output_file.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* runs_schema = "tvbeam-solver-runs/1";

constexpr const char* end_of_remark = ", and not made.";

} // namespace

SolverRuns::SolverRuns(const std::filesystem::path& directory, const Scene& scene)
    : scene_(scene), identities_(*scene.solver), file_(directory / "solver-runs.jsonl") {
    const OutputFile writable(file_.path());
    if (std::filesystem::exists(file_.path()))
        torn_ = file_.read([this](const KeptLine& line) { read_line(line); });
}

void SolverRuns::read_line(const KeptLine& line) {
    try {
        const Json json = Json::parse(line.text);
        if (json.at("schema") != runs_schema)
            throw std::invalid_argument(std::string("its schema is not ") + runs_schema);
        Run& run = runs_[json.at("of").get<std::string>()];
        run.seconds = json.at("seconds").get<double>();
        if (json.contains("wall_clock"))
            run.wall_clock = json["wall_clock"].get<double>();
        for (const auto& [name, figure] : json.at("figures").items())
            run.figures[name].value = figure.get<double>();
        if (json.contains("printed"))
            for (const auto& [name, digits] : json["printed"].items())
                run.figures[name].printed = kept_digits(digits);
    } catch (const std::exception& error) {
        throw InputError({file_.path().string(), static_cast<int>(line.number), 1},
                         fmt::format("is not what tvbeam wrote: {}; remove the file to make its "
                                     "runs anew",
                                     error.what()));
    }
}

std::optional<RungResult> SolverRuns::find(const Series& series, std::size_t index) {
    const std::string identity = identities_.of(series, index);
    const std::scoped_lock lock(mutex_);
    asked_.insert(identity);
    auto result = kept(series, index, identity);
    used_ += result && !runs_[identity].is_new ? 1 : 0;
    return result;
}

std::optional<RungResult> SolverRuns::kept(const Series& series, std::size_t index,
                                           const std::string& identity) const {
    const auto found = runs_.find(identity);
    if (found == runs_.end())
        return std::nullopt;
    RungResult result;
    result.rung = series.rungs[index];
    result.seconds = found->second.seconds;
    result.wall_clock = found->second.wall_clock;
    for (const auto& measure : series.measures) {
        const auto figure = found->second.figures.find(measure.name);
        if (figure == found->second.figures.end())
            return std::nullopt;
        const auto& [value, printed] = figure->second;
        result.errors.push_back(value);
        // A line of an earlier version has no digits: as few as the number needs, then.
        result.printed.push_back(printed.value_or(printed_digits(shortest(value))));
    }
    return result;
}

void SolverRuns::add(const Series& series, std::size_t index, const RungResult& result) {
    if (result.status != RungStatus::ok)
        return;
    const std::string identity = identities_.of(series, index);
    Json figures = Json::object();
    Json printed = Json::object();
    for (std::size_t k = 0; k < series.measures.size(); ++k) {
        figures[series.measures[k].name] = result.errors[k];
        if (!result.printed.empty())
            printed[series.measures[k].name] = tvbeam::kept(result.printed[k]);
    }
    const std::scoped_lock lock(mutex_);
    // A program that was made anew during its run is not what the run is of.
    if (!asked_.contains(identity))
        return;
    Run& run = runs_[identity];
    run.seconds = result.seconds;
    run.wall_clock = result.wall_clock;
    run.is_new = true;
    for (std::size_t k = 0; k < series.measures.size(); ++k)
        run.figures[series.measures[k].name] = {
            result.errors[k],
            result.printed.empty() ? std::nullopt : std::optional(result.printed[k])};
    if (!failure_.empty())
        return;
    Json line{{"schema", runs_schema},        {"of", identity},
              {"study", series.study},        {"elements", result.rung.elements},
              {"dt", result.rung.dt},         {"method", series.method.name},
              {"seconds", result.seconds},    {"figures", std::move(figures)},
              {"printed", std::move(printed)}};
    if (result.wall_clock)
        line["wall_clock"] = *result.wall_clock;
    try {
        file_.append(line.dump(-1, ' ', false, Json::error_handler_t::replace));
    } catch (const OutputError& error) {
        failure_ = error.what();
    }
}

std::any SolverRuns::find_part(const std::string& /*study*/, std::size_t /*index*/) {
    return {};
}

void SolverRuns::add_part(const std::string& /*study*/, std::size_t /*index*/,
                          const std::any& /*result*/) {}

std::size_t SolverRuns::found() {
    const std::scoped_lock lock(mutex_);
    std::size_t count = 0;
    if (!runs_.empty())
        for (const auto& series : scene_.series())
            for (std::size_t i = 0; i < series.rungs.size(); ++i)
                count += kept(series, i, identities_.of(series, i)) ? 1 : 0;
    return count;
}

std::string SolverRuns::remark() const {
    const std::scoped_lock lock(mutex_);
    return used_ == 0
               ? ""
               : fmt::format("{} run{} found again in {}{}", used_, used_ == 1 ? " was" : "s were",
                             file_.path().string(), end_of_remark);
}

bool SolverRuns::is_remark(const std::string& text) {
    return text.ends_with(end_of_remark);
}

void SolverRuns::write() {
    try {
        file_.flush();
    } catch (const OutputError& error) {
        failure_ = error.what();
    }
}

} // namespace tvbeam

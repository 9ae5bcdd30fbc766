#include "mms/text/input_error.hpp"
#include "reports/formats/report_format.hpp"
#include "reports/studies/run_fields.hpp"
#include "reports/sweep/sweep.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <optional>
#include <utility>

namespace tvbeam {

namespace {

/// The overrides that the result in a directory was made with; none where it has another schema.
std::vector<std::string> overrides_in(const std::filesystem::path& directory,
                                      const std::string& schema) {
    std::ifstream stream(directory / "result.json");
    try {
        const auto json = nlohmann::json::parse(stream);
        if (json.at("schema") == schema)
            return json.at("provenance").at("overrides").get<std::vector<std::string>>();
    } catch (const nlohmann::json::exception&) { // no result
    }
    return {};
}

/// Of the result in a directory: those that are in every one, and those that say whose they are.
std::vector<std::filesystem::path> files_of_result(const std::filesystem::path& directory) {
    std::vector<std::filesystem::path> files;
    for (const auto& format : report_formats()) {
        for (const auto& name : format->certain_files())
            if (!name.starts_with("plots/"))
                files.emplace_back(name);
        for (auto& file : format->earlier_files(directory))
            files.push_back(std::move(file));
    }
    files.emplace_back("plots");
    return files;
}

} // namespace

std::vector<std::filesystem::path> files_of_sweep(const std::filesystem::path& directory) {
    std::optional<Sweep> sweep;
    try {
        sweep = sweep_in(overrides_in(directory, sweep_schema));
    } catch (const InputError&) { // none of ours
    }
    if (!sweep)
        return {};
    std::vector<std::filesystem::path> files;
    if (first_line(directory / "sweep.csv").starts_with(tvbeam::quoted(sweep->key)))
        files.emplace_back("sweep.csv");
    for (std::size_t i = 0; i < sweep->values.size(); ++i) {
        const std::filesystem::path name = sweep->directory(i);
        if (std::filesystem::is_symlink(directory / name) ||
            overrides_in(directory / name, "tvbeam-result/1") != sweep->overrides(sweep->values[i]))
            continue;
        for (const auto& file : files_of_result(directory / name))
            files.push_back(name / file);
        files.push_back(name);
    }
    return files;
}

} // namespace tvbeam

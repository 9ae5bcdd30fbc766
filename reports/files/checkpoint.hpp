#pragma once

#include "studies/runs/execution.hpp"
#include "studies/scene/scene.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <mutex>

namespace tvbeam {

/// The results of a long study's single runs as they finish, in the file unfinished.json of a
/// directory, for an attempt that goes on where this one is cut short. Doubles come back as they
/// were, to the last bit. The file is replaced as a whole, at most twice a second.
class Checkpoint final : public FinishedRuns {
public:
    /// resume: with the results of an earlier attempt, if there is one. Throws InputError where
    /// there is one and it is not wanted; where the file cannot be read, or is of another scene or
    /// another build of the program, whose results would not be the same. Throws OutputError where
    /// nothing can be written.
    Checkpoint(const std::filesystem::path& directory, const Scene& scene, bool resume);

    std::optional<RungResult> find(const std::string& study, std::size_t index) override;
    void add(const std::string& study, std::size_t index, const RungResult& result) override;
    std::optional<StressCase> find_case(std::size_t index) override;
    void add_case(std::size_t index, const StressCase& result) override;

    /// Whether something is kept now.
    [[nodiscard]] bool holds_runs() const { return content_.contains("runs"); }

    [[nodiscard]] std::size_t found() const { return found_; } ///< results of the earlier attempt

    void write();  ///< what is not yet on the disk; throws OutputError
    void remove(); ///< the file: the study has come to its end

private:
    using Json = nlohmann::ordered_json;
    void read(const Json& identity);
    std::optional<Json> find_entry(const std::string& study, std::size_t index);
    void add_entry(const std::string& study, std::size_t index, Json entry);

    std::filesystem::path file_;
    std::mutex mutex_;
    Json content_;
    bool changed_ = false;
    std::size_t found_ = 0;
    std::chrono::steady_clock::time_point written_;
};

} // namespace tvbeam

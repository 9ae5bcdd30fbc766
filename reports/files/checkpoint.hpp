#pragma once

#include "reports/files/line_file.hpp"
#include "studies/runs/execution.hpp"
#include "studies/runs/run.hpp"
#include "studies/scene/scene.hpp"
#include "studies/stress/stress_case.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace tvbeam {

/// The results of a long study's single runs as they finish, in the file unfinished.jsonl of a
/// directory, for an attempt that goes on where this one is cut short. A line of JSON each, after a
/// first one that says what they are of (run_identity). Doubles come back as they were, to the last
/// bit.
class Checkpoint final : public FinishedRuns {
public:
    /// resume: with the results of an earlier attempt, if there is one. Throws InputError where
    /// there is one and it is not wanted; where the file cannot be read, is of another scene, build
    /// or kind of processor, whose results would not be the same, or holds what no run of the scene
    /// gives. Throws OutputError where nothing can be written.
    Checkpoint(const std::filesystem::path& directory, const Scene& scene, bool resume);

    std::optional<RungResult> find(const Series& series, std::size_t index) override;
    void add(const Series& series, std::size_t index, const RungResult& result) override;
    std::optional<StressCase> find_case(std::size_t index) override;
    void add_case(std::size_t index, const StressCase& result) override;

    /// Whether something is kept now.
    [[nodiscard]] bool holds_runs() const {
        const std::scoped_lock lock(mutex_);
        return holds_runs_;
    }

    /// Results of the earlier attempt.
    [[nodiscard]] std::size_t found() const { return cases_.size() + runs_.size(); }

    /// Whether the last line of the earlier attempt was cut short, and is left out.
    [[nodiscard]] bool was_torn() const { return torn_; }

    /// Brings to the disk what is not yet there.
    void write();

    /// Why results could not be kept, all of them or the later ones; empty: they are. A study goes
    /// on without, and its results are written.
    [[nodiscard]] const std::string& failure() const { return failure_; }

    /// The file: the study has come to its end. Throws OutputError.
    void remove();

private:
    using Asked = std::map<std::string, Series>;
    void read(const Scene& scene);
    void read_entry(const Asked& asked, std::size_t cases, const nlohmann::ordered_json& entry);
    void add_entry(const std::string& study, std::size_t index,
                   const nlohmann::ordered_json& result);

    LineFile file_;
    mutable std::mutex mutex_;
    std::string identity_; // the first line
    bool begun_ = false;   // it is in the file
    bool holds_runs_ = false;
    bool torn_ = false;
    std::string failure_;
    std::map<std::pair<std::string, std::size_t>, RungResult> runs_; // of the earlier attempt
    std::map<std::size_t, StressCase> cases_;                        // likewise
};

} // namespace tvbeam

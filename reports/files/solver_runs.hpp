#pragma once

#include "reports/files/line_file.hpp"
#include "studies/external/external_runs.hpp"
#include "studies/runs/execution.hpp"
#include "studies/scene/scene.hpp"

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>

namespace tvbeam {

/// What the runs of an external solver gave that have ended well, in the file solver-runs.jsonl of
/// a directory, a line of JSON each. They are found again by what they depend on (RunIdentities),
/// whichever scene or study asks for them: a ladder that gets one more level makes one run. Those
/// that failed are made again.
class SolverRuns final : public FinishedRuns {
public:
    /// Reads the file if it is there. Throws InputError where it is none that tvbeam wrote;
    /// OutputError where nothing can be written. The scene must outlive this.
    SolverRuns(const std::filesystem::path& directory, const Scene& scene);

    std::optional<RungResult> find(const Series& series, std::size_t index) override;
    void add(const Series& series, std::size_t index, const RungResult& result) override;
    std::any find_part(const std::string& study, std::size_t index) override;
    void add_part(const std::string& study, std::size_t index, const std::any& result) override;

    /// How many of the scene's runs are there.
    [[nodiscard]] std::size_t found();
    /// "3 runs were found again in FILE, and not made", of those that were asked for so far and
    /// that an earlier command has made; empty: none were.
    [[nodiscard]] std::string remark() const;
    static bool is_remark(const std::string& text); ///< that one, of any run
    [[nodiscard]] bool holds_runs() const {
        const std::scoped_lock lock(mutex_);
        return !runs_.empty();
    }
    [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }
    /// What of the file is not whole.
    [[nodiscard]] const TornLines& torn() const { return torn_; }

    void write(); ///< what is not yet on the disk

    /// Why results could not be kept, all of them or the later ones; empty: they are.
    [[nodiscard]] const std::string& failure() const { return failure_; }

private:
    struct Figure {
        double value = 0.0;
        std::optional<PrintedDigits> printed;
    };
    struct Run {
        std::optional<double> wall_clock;
        double seconds = 0.0;
        std::map<std::string, Figure> figures; ///< errors and values by name
        bool is_new = false;                   ///< made by this command
    };
    void read_line(const KeptLine& line);
    std::optional<RungResult> kept(const Series& series, std::size_t index,
                                   const std::string& identity) const;

    const Scene& scene_;
    RunIdentities identities_;
    LineFile file_;
    mutable std::mutex mutex_;
    TornLines torn_;
    std::string failure_;
    std::map<std::string, Run> runs_; ///< by identity
    std::set<std::string> asked_;     ///< for which runs, by identity
    std::size_t used_ = 0;            ///< runs that were found
};

} // namespace tvbeam

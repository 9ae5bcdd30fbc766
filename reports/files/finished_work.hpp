#pragma once

#include "reports/files/line_file.hpp"
#include "studies/runs/execution.hpp"
#include "studies/scene/scene.hpp"
#include "studies/shards/shard.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// By which words a scene is read, and the part of its work that is done; for a merge, which reads
/// it again.
struct WorkOrigin {
    std::string scene; ///< a shipped one, or the absolute path of a file
    std::vector<std::string> overrides;
    std::optional<Shard> shard; ///< none: all of it
};

/// The results of a scene's single runs as they finish, in a file of lines, for an attempt that
/// goes on where this one is cut short and for a merge of shards: after a first line, which says
/// what they are of (run_identity), a line of JSON each. Doubles come back as they were, to the
/// last bit. In memory is only where a result stands.
class FinishedWork final : public FinishedRuns {
public:
    /// The scene must outlive it.
    FinishedWork(const Scene& scene, const WorkOrigin& origin);

    /// Takes up the results of a file. Throws InputError where it cannot be read, is of another
    /// scene, build or kind of processor, whose results would not be the same, or holds what no run
    /// of the scene gives. Returns what of it is not whole.
    TornLines read(const std::filesystem::path& file);

    /// Results from here on are appended to the file, and runs that failed are made again: what
    /// they lacked, memory or a program, may be there now. Throws OutputError where nothing can be
    /// written, InputError where it is no regular file.
    void keep_in(const std::filesystem::path& file);

    std::optional<RungResult> find(const Series& series, std::size_t index) override;
    void add(const Series& series, std::size_t index, const RungResult& result) override;
    std::any find_part(const std::string& study, std::size_t index) override;
    void add_part(const std::string& study, std::size_t index, const std::any& result) override;

    /// Whether something is kept now.
    [[nodiscard]] bool holds_runs() const {
        const std::scoped_lock lock(mutex_);
        return holds_runs_;
    }
    /// Results that were read.
    [[nodiscard]] std::size_t found() const { return found_; }
    [[nodiscard]] bool has(std::size_t group, std::size_t index) const {
        return places_[group][index].file > 0;
    }
    /// Whether what was read is of a run that failed, or of a case that failed a check.
    [[nodiscard]] bool failed(std::size_t group, std::size_t index) const {
        return places_[group][index].failed;
    }
    /// What the scene asks for; has() counts in it.
    [[nodiscard]] const std::vector<WorkGroup>& groups() const { return groups_; }

    /// Brings to the disk what is not yet there.
    void write();

    /// Why results could not be kept, all of them or the later ones; empty: they are. A study goes
    /// on without, and its results are written.
    [[nodiscard]] const std::string& failure() const { return failure_; }

    /// Whether results can be kept still.
    [[nodiscard]] bool keeps() const {
        const std::scoped_lock lock(mutex_);
        return failure_.empty();
    }

    /// The file of keep_in: the study has come to its end. Throws OutputError.
    void remove();

private:
    /// Where a result stands.
    struct Where {
        std::int64_t offset = 0;
        std::uint32_t size = 0;
        std::uint32_t file : 31 = 0; ///< from 1; 0: nowhere
        bool failed : 1 = false;
    };
    /// What the file of keep_in is to have anew.
    [[nodiscard]] bool is_made_again(const Where& where) const;
    void read_head(const nlohmann::ordered_json& head, const Place& place) const;
    void read_entry(const nlohmann::ordered_json& entry, const KeptLine& line);
    [[nodiscard]] std::any result_of(std::size_t group, std::size_t index,
                                     const nlohmann::ordered_json& json) const;
    [[nodiscard]] std::any find(const std::string& study, std::size_t index) const;
    void add_entry(const std::string& study, std::size_t index,
                   const nlohmann::ordered_json& result);

    const Scene& scene_;
    std::vector<WorkGroup> groups_;
    std::map<std::string, std::size_t> group_of_; ///< by study
    std::vector<std::vector<Where>> places_;      ///< by group and index
    std::deque<LineFile> files_;                  ///< that were read
    std::size_t found_ = 0;

    nlohmann::ordered_json head_; ///< the first line
    std::optional<LineFile> kept_;
    mutable std::mutex mutex_;
    bool begun_ = false; ///< the head is in the file
    bool holds_runs_ = false;
    std::string failure_;
};

/// What the first whole line of a file says, before the scene is at hand; none where there is no
/// whole line. Throws InputError where it says nothing of the kind.
std::optional<WorkOrigin> work_origin_of(const std::filesystem::path& file);

} // namespace tvbeam

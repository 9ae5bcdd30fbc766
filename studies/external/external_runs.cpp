#include "studies/external/external_runs.hpp"

#include "mms/text/visible_text.hpp"
#include "studies/external/digest.hpp"
#include "studies/external/output.hpp"
#include "studies/external/process.hpp"
#include "studies/text/number_text.hpp"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <new>
#include <set>
#include <stdexcept>
#include <utility>

#include <unistd.h>

namespace tvbeam {

namespace {

namespace fs = std::filesystem;

Placeholders placeholders_of(const Rung& rung, std::size_t level, double final_time,
                             const Parameters& parameters) {
    const auto known = [](bool is, const std::string& text) {
        return is ? std::optional(text) : std::nullopt;
    };
    Placeholders values{{"elements", known(rung.has_mesh(), std::to_string(rung.elements))},
                        {"h", known(rung.has_mesh(), shortest(rung.h()))},
                        {"dt", known(rung.has_steps(), shortest(rung.dt))},
                        {"steps", known(rung.steps > 0, std::to_string(rung.steps))},
                        {"final_time", known(final_time > 0.0, shortest(final_time))},
                        {"level", std::to_string(level)}};
    for (const auto& [name, value] : parameters)
        values[name] = value;
    return values;
}

bool is_program(const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0;
}

/// A program without a folder, where the shell would look for it.
std::optional<fs::path> found_in_path(const SolverBlock& solver, const std::string& name) {
    const auto own = solver.environment.find("PATH");
    const char* inherited = std::getenv("PATH");
    std::string path = own != solver.environment.end() ? own->second
                       : inherited != nullptr          ? inherited
                                                       : "/usr/bin:/bin";
    path += ':';
    for (std::size_t at = 0, end = 0; (end = path.find(':', at)) != std::string::npos; at = end + 1)
        if (fs::path file = fs::path(path.substr(at, end - at)) / name;
            file.is_absolute() && is_program(file))
            return file;
    return std::nullopt;
}

/// One of the files of a run's directory, by its path in there.
const SolverFile* file_called(const SolverBlock& solver, const std::string& name) {
    const auto found =
        std::find_if(solver.files.begin(), solver.files.end(), [&](const SolverFile& file) {
            return file.name == fs::path(name).lexically_normal().string();
        });
    return found == solver.files.end() ? nullptr : &*found;
}

/// The one of the block's files that is called as the program: by a name with a / in it.
const SolverFile* own_program(const SolverBlock& solver, const std::string& name) {
    return name.find('/') == std::string::npos ? nullptr : file_called(solver, name);
}

/// The program that a run calls: with a / in its name, one of the block's files or a path relative
/// to the scene, otherwise what PATH has. Throws InputError where there is none.
fs::path program_of(const SolverBlock& solver, const std::string& name) {
    const Place& place = solver.command.front().place;
    if (name.find('/') == std::string::npos) {
        if (auto found = found_in_path(solver, name))
            return *found;
        throw InputError(place, "there is no program '" + name +
                                    "' in PATH; install it, or give its path" +
                                    (file_called(solver, name) != nullptr
                                         ? ": ./" + name + " is the one of solver.files"
                                         : ""));
    }
    const SolverFile* own = own_program(solver, name);
    fs::path file = own != nullptr ? own->source : fs::absolute(solver.folder / name);
    if (is_program(file))
        return file;
    std::error_code error;
    throw InputError(place, fs::exists(file, error)
                                ? "'" + file.string() +
                                      "' cannot be run; chmod +x makes it executable, or name its "
                                      "interpreter first"
                                : "there is no program '" + file.string() + "'");
}

/// An argument that is a file beside the scene would not be found from the directory of a run, and
/// what it holds would not be known to be another.
void require_at_hand(const SolverBlock& solver, const Place& place, const std::string& word) {
    std::error_code error;
    const fs::path path(word);
    if (word.empty() || path.is_absolute() || file_called(solver, word) != nullptr ||
        word == solver.errors.file || word == solver.values.file ||
        !fs::is_regular_file(solver.folder / path, error))
        return;
    throw InputError(place, "'" + word +
                                "' is a file beside the scene, and runs have directories of "
                                "their own; add it to solver.files, or give its absolute path");
}

/// What a run consists of before it begins.
struct Prepared {
    std::string name; ///< the program, as the command has it
    fs::path program;
    std::vector<std::string> arguments;
};

Prepared prepared(const SolverBlock& solver, const Placeholders& values) {
    const std::string name = solver.command.front().filled(values);
    Prepared run{name, program_of(solver, name), {}};
    for (std::size_t i = 1; i < solver.command.size(); ++i)
        run.arguments.push_back(solver.command[i].filled(values));
    return run;
}

void fill(const SolverBlock& solver, const Placeholders& values, const fs::path& directory) {
    fs::create_directory(directory);
    for (const auto& file : solver.files) {
        const fs::path target = directory / file.name;
        fs::create_directories(target.parent_path());
        if (!file.contents) {
            fs::copy_file(file.source, target);
            // The copy, as its source may change while it is made.
            if (digest(target) != file.digest)
                throw std::runtime_error(file.name + " was changed during the study, whose runs "
                                                     "would be of two programs; begin it again");
            continue;
        }
        std::ofstream stream(target, std::ios::binary);
        stream << file.contents->filled(values);
        if (!stream.flush())
            throw fs::filesystem_error("cannot write", target,
                                       std::error_code(errno, std::generic_category()));
        stream.close();
        fs::permissions(target, fs::status(file.source).permissions());
    }
}

/// A directory that is gone at the end.
class RunDirectory {
public:
    explicit RunDirectory(fs::path path) : path_(std::move(path)) {}
    ~RunDirectory() {
        // What was killed a moment ago may still be in there, or there is no memory for a moment.
        for (int attempt = 0; attempt < 10; ++attempt)
            try {
                std::error_code error;
                fs::remove_all(path_, error);
                if (!error)
                    return;
            } catch (const std::bad_alloc&) {
                continue;
            }
    }
    RunDirectory(const RunDirectory&) = delete;
    RunDirectory& operator=(const RunDirectory&) = delete;
    RunDirectory(RunDirectory&&) = delete;
    RunDirectory& operator=(RunDirectory&&) = delete;
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

class ExternalSolver {
public:
    ExternalSolver(const SolverBlock& solver, const Keeper& keeper)
        : solver_(solver), keeper_(keeper) {}

    RungResult run(const RunTask& task) {
        RungResult result;
        result.rung = task.rung;
        if (!task.advance(0)) {
            result.status = RungStatus::interrupted;
            result.reason = "interrupted";
            return result;
        }
        try {
            run(task, result);
        } catch (const std::exception& error) { // no room for a directory, say
            result.status = RungStatus::failed;
            result.reason = error.what();
        }
        if (result.status != RungStatus::ok) {
            result.errors.clear();
            result.printed.clear();
            // What the program wrote is text of any kind, and a reason goes into every report.
            result.reason = visible(result.reason);
        }
        task.advance(std::max<std::int64_t>(task.rung.steps, 1));
        return result;
    }

private:
    void run(const RunTask& task, RungResult& result) {
        const auto values =
            placeholders_of(task.rung, task.level, task.final_time, parameters_of(task.method));
        Prepared run = prepared(solver_, values);
        const RunDirectory directory(keeper_.directory() / std::to_string(next_++));
        fill(solver_, values, directory.path());
        if (const auto* own = own_program(solver_, run.name))
            run.program = directory.path() / own->name;
        std::vector<OutputReading> readings;
        for (const auto& measure : task.measures)
            if (const auto* pattern = solver_.source_of(measure).pattern(measure.name))
                readings.emplace_back(*pattern);
        std::optional<OutputReading> clock;
        if (solver_.seconds)
            clock.emplace(*solver_.seconds);
        const ProcessResult process = run_process({.program = run.program,
                                                   .arguments = run.arguments,
                                                   .directory = directory.path(),
                                                   .environment = solver_.environment,
                                                   .timeout = solver_.timeout,
                                                   .line =
                                                       [&](const std::string& line) {
                                                           for (auto& reading : readings)
                                                               reading.take(line);
                                                           if (clock)
                                                               clock->take(line);
                                                       },
                                                   .go_on = [&] { return task.advance(0); }},
                                                  keeper_);
        result.seconds = process.seconds;
        std::string failure = process.failure;
        if (process.interrupted) {
            result.status = RungStatus::interrupted;
            result.reason = "interrupted";
            return;
        }
        if (failure == "timed out")
            failure += " after " + shortest(*solver_.timeout) + " s";
        if (failure.empty())
            failure = figures(task, readings, directory.path(), result);
        if (failure.empty() && clock)
            failure = take_time(clock->figure(), result);
        if (!failure.empty())
            set_failed(result, failure, process, directory.path());
    }

    /// By the program's own clock; why not, where it says no time.
    static std::string take_time(const ReadFigure& seconds, RungResult& result) {
        result.wall_clock = result.seconds;
        result.seconds = seconds.value.value_or(result.seconds);
        result.printed_seconds = seconds.printed;
        if (!seconds.failure.empty())
            return seconds.failure;
        return result.seconds >= 0.0 ? "" : "seconds is " + shortest(result.seconds);
    }

    static void set_failed(RungResult& result, const std::string& failure,
                           const ProcessResult& process, const fs::path& directory) {
        result.status = RungStatus::failed;
        result.reason = failure + (process.last_lines.empty() ? "; it wrote nothing"
                                   : process.are_of_errors
                                       ? "; on standard error it wrote: " + process.last_lines
                                       : "; it wrote: " + process.last_lines);
        // The next run is made in another directory, and fails for the same reason.
        result.reason = without_directory(std::move(result.reason), directory);
    }

    /// Reads what is measured; why not, where it is not all there.
    std::string figures(const RunTask& task, const std::vector<OutputReading>& readings,
                        const fs::path& directory, RungResult& result) const {
        auto reading = readings.begin();
        for (const auto& measure : task.measures) {
            const FigureSource& source = solver_.source_of(measure);
            const ReadFigure figure = source.is_file()
                                          ? figure_in(directory / source.file, measure.name)
                                          : (reading++)->figure();
            if (!figure.value)
                return figure.failure;
            if (!measure.is_value && *figure.value < 0.0)
                return measure.name + " is " + shortest(*figure.value) +
                       "; a norm of an error is not below 0";
            result.errors.push_back(*figure.value);
            result.printed.push_back(figure.printed);
        }
        return {};
    }

    const SolverBlock& solver_;
    const Keeper& keeper_;
    std::atomic<std::size_t> next_ = 0; ///< directory
};

/// Variables of this process that say which code a program runs.
std::map<std::string, std::string> inherited(const SolverBlock& solver) {
    std::map<std::string, std::string> variables;
    for (const char* name : {"LD_LIBRARY_PATH", "LD_PRELOAD", "PYTHONHOME", "PYTHONPATH"})
        if (const char* value = std::getenv(name);
            value != nullptr && !solver.environment.contains(name))
            variables[name] = value;
    return variables;
}

nlohmann::json reading_of(const FigureSource& source) {
    nlohmann::json json = source.file;
    if (!source.is_file())
        json = nlohmann::json::object();
    for (const auto& pattern : source.patterns)
        json[pattern.name] = pattern.text;
    return json;
}

} // namespace

void require_placeholders(const SolverBlock& solver, const std::vector<Series>& all) {
    for (const auto& series : all) {
        // What is there in one run of a series is there in all.
        const auto values = placeholders_of(series.rungs.front(), 0, series.final_time,
                                            parameters_of(series.method));
        for (const auto& word : solver.command)
            static_cast<void>(word.filled(values));
        for (const auto& file : solver.files)
            if (file.contents)
                static_cast<void>(file.contents->filled(values));
    }
}

void require_programs(const SolverBlock& solver, const std::vector<Series>& all) {
    std::set<std::pair<std::size_t, std::string>> words; // with their places in the command
    for (const auto& series : all)
        for (std::size_t level = 0; level < series.rungs.size(); ++level) {
            const auto values = placeholders_of(series.rungs[level], level, series.final_time,
                                                parameters_of(series.method));
            for (std::size_t i = 0; i < solver.command.size(); ++i)
                words.emplace(i, solver.command[i].filled(values));
        }
    for (const auto& [i, word] : words)
        if (i == 0)
            program_of(solver, word);
        else
            require_at_hand(solver, solver.command[i].place, word);
}

std::string remark_on_untold_widths(const SolverBlock& solver, const std::vector<Series>& all) {
    for (const auto& series : all) {
        std::map<std::vector<std::string>, Rung> told;
        for (std::size_t level = 0; level < series.rungs.size(); ++level) {
            const Rung& rung = series.rungs[level];
            const auto values =
                placeholders_of(rung, level, series.final_time, parameters_of(series.method));
            std::vector<std::string> texts;
            for (const auto& word : solver.command)
                texts.push_back(word.filled(values));
            for (const auto& file : solver.files)
                if (file.contents)
                    texts.push_back(file.contents->filled(values));
            const auto [known, is_new] = told.emplace(std::move(texts), rung);
            const Rung& other = known->second;
            const bool in_h = other.elements != rung.elements;
            const bool in_dt = other.dt != rung.dt;
            if (is_new || (!in_h && !in_dt))
                continue;
            return fmt::format(
                "In the runs with {} and with {} the program is told the same, by its command and "
                "its files: they cannot show an order in {}.",
                other.name(shortest), rung.name(shortest),
                in_h && in_dt ? "h or dt"
                : in_h        ? "h"
                              : "dt");
        }
    }
    return {};
}

StudiedSolver external_runs(const SolverBlock& solver, const Keeper& keeper) {
    const auto external = std::make_shared<ExternalSolver>(solver, keeper);
    return {.run = [external](const RunTask& task) { return external->run(task); },
            .measures_for_nothing = true};
}

namespace {

/// The files that a word names by absolute paths: itself, or those within it, as in
/// --config=/path/a.txt. What ends a path may also stand in it, as a blank: all that are there
/// count.
std::set<std::string> files_named_in(const std::string& word) {
    std::set<std::string> files;
    constexpr const char* ends = " \t\n\r\"'`=,:;()<>|&";
    const auto end_from = [&](std::size_t at) {
        return std::min(word.find_first_of(ends, at), word.size());
    };
    for (std::size_t at = 0; at < word.size(); at = end_from(at) + 1) {
        // Also behind an option's letter, as in -f/path/a.awk, or @/path/a.txt.
        const std::size_t root = word.find('/', at);
        const bool is_root = root == at || (root < at + 3 && (word[at] == '-' || word[at] == '@'));
        if (!is_root || root > end_from(at))
            continue;
        constexpr int most_parts = 16; // a script's text would be a path from each to its end
        std::size_t end = end_from(root);
        for (int part = 0; part < most_parts; ++part, end = end_from(end + 1)) {
            std::error_code error;
            if (fs::is_regular_file(word.substr(root, end - root), error))
                files.insert(word.substr(root, end - root));
            if (end == word.size())
                break;
        }
    }
    return files;
}

/// What a program is known by. One of the block's files is copied, and its contents are known; any
/// other is what stands in its place, however the way to the scene was written.
nlohmann::json identity_of(const SolverBlock& solver, const std::string& name,
                           const fs::path& program) {
    if (const auto* own = own_program(solver, name))
        return own->name;
    std::error_code error;
    // Not the program's own links: what it does may depend on the name that it is called by.
    return {(fs::canonical(program.parent_path(), error) / program.filename()).string(),
            fs::file_size(program, error),
            fs::last_write_time(program, error).time_since_epoch().count()};
}

} // namespace

std::string RunIdentities::of(const Series& series, std::size_t level) const {
    const auto values = placeholders_of(series.rungs.at(level), level, series.final_time,
                                        parameters_of(series.method));
    const Prepared run = prepared(solver_, values);
    nlohmann::json json{{"program", identity_of(solver_, run.name, run.program)},
                        {"arguments", run.arguments},
                        {"environment", solver_.environment},
                        {"inherited", inherited(solver_)},
                        {"errors", reading_of(solver_.errors)},
                        {"values", reading_of(solver_.values)},
                        {"seconds", solver_.seconds ? solver_.seconds->text : ""},
                        {"files", nlohmann::json::object()}};
    // Scripts and inputs that are called where they are, as by `sh /path/solve.sh`.
    for (const auto& argument : run.arguments)
        for (const auto& file : files_named_in(argument))
            json["called"][file] = digest(fs::path(file));
    for (const auto& file : solver_.files)
        json["files"][file.name] =
            file.contents ? digest(file.contents->filled(values)) : file.digest;
    return digest(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

} // namespace tvbeam

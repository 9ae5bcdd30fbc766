#include "studies/scene/shipped.hpp"

#include "mms/text/input_error.hpp"
#include "mms/text/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace tvbeam {

namespace {

/// Where all kinds may be, the first that is there counts.
std::vector<std::filesystem::path> data_directories() {
    if (const char* named = std::getenv("TVBEAM_DATA"); named != nullptr && *named != '\0')
        return {named};
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    std::vector<std::filesystem::path> directories;
    if (!error)
        directories.push_back(program.parent_path().parent_path() / "share/tvbeam");
    // A program of the build reads its sources; an installed one, or a user's, never does.
    if (!error && program.string().starts_with(TVBEAM_BINARY_DIR "/"))
        directories.emplace_back(TVBEAM_SOURCE_DIR);
    for (const char* installed : {TVBEAM_INSTALLED_DATA, TVBEAM_PACKAGED_DATA})
        directories.emplace_back(installed);
    return directories;
}

std::filesystem::path directory(Shipped kind) {
    const std::filesystem::path inside = kind == Shipped::scene      ? "studies/scenes"
                                         : kind == Shipped::solution ? "mms/solutions"
                                                                     : "mms/systems";
    std::error_code error;
    for (const auto& candidate : data_directories())
        if (std::filesystem::is_directory(candidate / inside, error))
            return candidate / inside;
    return {};
}

std::string word_of(Shipped kind) {
    return kind == Shipped::scene      ? "scene"
           : kind == Shipped::solution ? "solution"
                                       : "file of equations";
}

/// Who names a directory, or a table of records, is told what takes it.
void require_no_other_file(const std::string& name, const std::string& word, const Place& place) {
    std::error_code error;
    if (std::filesystem::is_directory(name, error))
        throw InputError(place, "'" + name + "' is a directory; name a " + word +
                                    ": a shipped one, or a file that ends in .toml");
    if (std::filesystem::is_regular_file(name, error))
        throw InputError(place, "'" + name + "' is not a " + word +
                                    ", whose file ends in .toml; a table of errors is analysed by "
                                    "tvbeam analyse " +
                                    name);
}

} // namespace

std::vector<ShippedFile> shipped_files(Shipped kind) {
    std::vector<ShippedFile> files;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(directory(kind), error))
        if (entry.path().extension() == ".toml")
            files.push_back({entry.path().stem().string(), entry.path()});
    std::sort(files.begin(), files.end(),
              [](const ShippedFile& a, const ShippedFile& b) { return a.name < b.name; });
    return files;
}

std::filesystem::path find_file(Shipped kind, const std::string& name,
                                const std::filesystem::path& beside, const Place& place) {
    const std::string word = word_of(kind);
    if (name.find('/') != std::string::npos || name.ends_with(".toml")) {
        auto path = beside / name;
        if (std::error_code error; !std::filesystem::exists(path, error))
            throw InputError(place, "there is no " + word +
                                        (kind == Shipped::equations ? " '" : " file '") +
                                        path.string() + "'");
        require_no_other_file(path.extension() == ".toml" ? "" : path.string(), word, place);
        // Nobody waits for what a file names that somebody else may have written.
        if (std::error_code error; place.line > 0 && !std::filesystem::is_regular_file(path, error))
            throw InputError(place, "'" + path.string() + "' is no regular file");
        return path;
    }
    const auto shipped = directory(kind);
    if (std::error_code error; !shipped.empty() && !name.empty()) {
        auto path = shipped / (name + ".toml");
        if (std::filesystem::exists(path, error))
            return path;
    }
    std::vector<std::string> names;
    for (const auto& file : shipped_files(kind))
        names.push_back(file.name);
    if (names.empty())
        throw InputError(place, "there is no shipped " + word + " '" + name +
                                    "': what tvbeam ships is not found; TVBEAM_DATA names the "
                                    "directory that it was installed to, …/share/tvbeam");
    require_no_other_file(name, word, place);
    for (const Shipped other : {Shipped::scene, Shipped::solution, Shipped::equations})
        for (const auto& file : shipped_files(other))
            if (other != kind && file.name == name)
                throw InputError(place, fmt::format("'{}' is a shipped {}, not a {}; `tvbeam list` "
                                                    "shows those",
                                                    name, word_of(other), word));
    throw InputError(
        place, "there is no shipped " + word + " '" + name + "'" + did_you_mean(name, names) +
                   "; `tvbeam list` shows them, and a file is named with its ending: " + name +
                   ".toml");
}

} // namespace tvbeam

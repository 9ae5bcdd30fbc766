#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace tvbeam {

/// A file for a newcomer to start from.
struct StarterFile {
    std::string name; ///< in the current directory
    std::string text;
};

/// The two files of `tvbeam new NAME`, commented: the solution NAME.toml and the scene
/// NAME-scene.toml, which runs it as it stands and checks it against its orders. Throws InputError
/// for a name that is not of letters, digits, - and _, or is longer than 64 characters.
std::array<StarterFile, 2> starter_files(const std::string& name);

/// The two files of `tvbeam new --solver NAME`: the program NAME.py and the scene NAME.toml, which
/// runs it and checks its orders. They are the shipped heat-solver. Throws InputError as above, and
/// where what is shipped is not found.
std::array<StarterFile, 2> solver_starter_files(const std::string& name);

/// Writes both files into the directory, or none. Throws InputError, having written nothing, where
/// one of them is there already; OutputError where they cannot be written.
void write_starter_files(const std::array<StarterFile, 2>& files,
                         const std::filesystem::path& directory);

} // namespace tvbeam

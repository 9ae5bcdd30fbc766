#pragma once

#include "mms/text/input_error.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tvbeam {

/// What comes with the toolkit: scenes, solutions, and files of equations. They are looked for in
/// the directory that the environment variable TVBEAM_DATA names, and nowhere else then; or beside
/// the running program
/// (../share/tvbeam), in the sources if it is one of their own build, and where tvbeam is
/// installed.
enum class Shipped { scene, solution, equations };

struct ShippedFile {
    std::string name; ///< the file's name without .toml
    std::filesystem::path path;
};

/// All shipped files of a kind, by name.
std::vector<ShippedFile> shipped_files(Shipped kind);

/// The file that a name on the command line or in a scene means: with a '/' or the ending .toml a
/// path, relative to `beside`; otherwise a shipped name. Throws InputError at `place`, naming
/// the nearest shipped name, when there is no such file.
std::filesystem::path find_file(Shipped kind, const std::string& name,
                                const std::filesystem::path& beside = {}, const Place& place = {});

} // namespace tvbeam

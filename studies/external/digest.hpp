#pragma once

#include <filesystem>
#include <string>

namespace tvbeam {

/// What a text is known again by (SHA-1, as a UUID).
std::string digest(const std::string& text);

/// The same of what a file holds, however large; of one that cannot be read, that of nothing.
std::string digest(const std::filesystem::path& file);

} // namespace tvbeam

#pragma once

#include <cstddef>
#include <string>

namespace tvbeam {

/// The bytes of a file, or of standard input where it is called "-". Throws InputError where it is
/// a directory, where it cannot be read or not to its end, and where it has more than `most` bytes,
/// as a device that has no end does.
std::string file_text(const std::string& file, std::size_t most);

} // namespace tvbeam

#pragma once

#include <cerrno>
#include <filesystem>
#include <string_view>

namespace tvbeam {

/// What a call of the system gives, which is made again as long as a signal cuts it short.
template <typename Call>
auto uncut(const Call& call) {
    auto result = call();
    while (result < 0 && errno == EINTR)
        result = call();
    return result;
}

// These return false, and say why in errno, where they fail.

bool write_whole(int descriptor, std::string_view text);

/// A directory's entries to the disk, so that a crash of the machine does not undo a change of
/// name. True also where the file system does not know that.
bool sync_directory(const std::filesystem::path& directory);

} // namespace tvbeam

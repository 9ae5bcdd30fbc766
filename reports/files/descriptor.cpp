#include "reports/files/descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace tvbeam {

bool write_whole(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = uncut([&] { return write(descriptor, text.data(), text.size()); });
        if (count < 0)
            return false;
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

bool sync_directory(const std::filesystem::path& directory) {
    const int descriptor =
        uncut([&] { return open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    if (descriptor < 0)
        return errno == EACCES; // a directory may be written to and not be read
    const bool synced = uncut([&] { return fsync(descriptor); }) == 0 || errno == EINVAL ||
                        errno == ENOTSUP || errno == EROFS;
    const int error = errno;
    close(descriptor);
    errno = error;
    return synced;
}

} // namespace tvbeam

#include "reports/files/file_lock.hpp"

#include "reports/files/descriptor.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <system_error>
#include <utility>

namespace tvbeam {

FileLock::FileLock(std::filesystem::path file)
    : file_(std::move(file)), made_(access(file_.c_str(), F_OK) != 0) {
    do { // whoever had it may have put another file in its place
        if (descriptor_ >= 0)
            close(descriptor_);
        descriptor_ =
            uncut([&] { return open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666); });
        if (descriptor_ < 0)
            return;
        // Another kind than that of flock(1), which may have called this program.
        struct flock whole {};
        whole.l_type = F_WRLCK;
        whole.l_whence = SEEK_SET;
        uncut([&] { return fcntl(descriptor_, F_OFD_SETLKW, &whole); });
    } while (!is_named());
}

FileLock::~FileLock() {
    if (descriptor_ < 0)
        return;
    std::error_code error;
    if (made_ && is_named() && std::filesystem::is_empty(file_, error))
        unlink(file_.c_str());
    close(descriptor_);
}

bool FileLock::is_named() const {
    struct stat own {};
    struct stat named {};
    return fstat(descriptor_, &own) == 0 && stat(file_.c_str(), &named) == 0 &&
           own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

} // namespace tvbeam

#include "mms/text/file_text.hpp"

#include "mms/text/input_error.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tvbeam {

namespace {

/// An open file, closed with its object.
class Descriptor {
public:
    explicit Descriptor(const std::string& file) {
        do
            number_ = file == "-" ? STDIN_FILENO : open(file.c_str(), O_RDONLY | O_CLOEXEC);
        while (number_ < 0 && errno == EINTR);
    }
    ~Descriptor() {
        if (number_ > STDIN_FILENO)
            close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&&) = delete;
    Descriptor& operator=(Descriptor&&) = delete;

    [[nodiscard]] int number() const { return number_; }

private:
    int number_ = -1;
};

std::string reason() {
    return std::generic_category().message(errno);
}

} // namespace

std::string file_text(const std::string& file, std::size_t most) {
    const Descriptor descriptor(file);
    if (descriptor.number() < 0)
        throw InputError({file},
                         "cannot be read; check the path and its permissions (" + reason() + ")");
    struct stat status = {};
    if (fstat(descriptor.number(), &status) == 0 && S_ISDIR(status.st_mode))
        throw InputError({file}, "is a directory; give the file in it");
    std::string text;
    std::array<char, 1 << 16> buffer{};
    for (;;) {
        const ssize_t count = read(descriptor.number(), buffer.data(), buffer.size());
        if (count == 0)
            return text;
        if (count < 0 && errno != EINTR)
            throw InputError({file}, "cannot be read to its end (" + reason() + ")");
        if (count > 0)
            text.append(buffer.data(), static_cast<std::size_t>(count));
        if (text.size() > most)
            throw InputError({file}, S_ISREG(status.st_mode)
                                         ? "has " + std::to_string(status.st_size) +
                                               " bytes; at most are read " + std::to_string(most)
                                         : "gives more than the " + std::to_string(most) +
                                               " bytes that are read at most; name a file");
    }
}

} // namespace tvbeam

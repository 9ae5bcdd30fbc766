#include "studies/stress/scratch.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace tvbeam {

namespace {

/// TMPDIR, or /tmp where that is no directory.
std::filesystem::path directory() {
    std::error_code error;
    auto path = std::filesystem::temp_directory_path(error);
    return error ? std::filesystem::path("/tmp") : path;
}

[[noreturn]] void fail(const std::string& what) {
    const std::string reason = std::generic_category().message(errno);
    throw std::runtime_error("cannot " + what + " a temporary file in '" + directory().string() +
                             "' for the results of many cases: " + reason);
}

int unnamed_file() {
    std::string name = (directory() / "tvbeam-scratch-XXXXXX").string();
    const int descriptor = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0)
        fail("make");
    unlink(name.c_str());
    return descriptor;
}

/// All of it, in as many calls as it takes. What is behind the end counts as zero.
template <typename Call, typename Byte>
void transfer(const Call& call, int descriptor, std::size_t offset, Byte* bytes, std::size_t count,
              const char* what) {
    while (count > 0) {
        const ssize_t done = call(descriptor, bytes, count, static_cast<off_t>(offset));
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0)
            fail(what);
        if (done == 0)
            return;
        const auto moved = static_cast<std::size_t>(done);
        bytes += moved;
        offset += moved;
        count -= moved;
    }
}

} // namespace

Scratch::~Scratch() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

void Scratch::move_to_file() {
    descriptor_ = unnamed_file();
    transfer(&pwrite, descriptor_, 0, memory_.data(), memory_.size(), "write");
    memory_ = {};
}

void Scratch::write(std::size_t offset, const void* bytes, std::size_t count) {
    const std::size_t end = offset + count;
    if (descriptor_ < 0 && end > most_in_memory)
        move_to_file();
    size_ = std::max(size_, end);
    if (descriptor_ >= 0) {
        transfer(&pwrite, descriptor_, offset, static_cast<const char*>(bytes), count, "write");
        return;
    }
    if (memory_.size() < end)
        memory_.resize(end);
    std::memcpy(memory_.data() + offset, bytes, count);
}

void Scratch::read(std::size_t offset, void* bytes, std::size_t count) const {
    auto* into = static_cast<char*>(bytes);
    std::fill_n(into, count, '\0');
    if (descriptor_ >= 0)
        transfer(&pread, descriptor_, offset, into, count, "read");
    else if (offset < memory_.size())
        std::memcpy(into, memory_.data() + offset, std::min(count, memory_.size() - offset));
}

} // namespace tvbeam

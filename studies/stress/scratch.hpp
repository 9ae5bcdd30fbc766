#pragma once

#include <cstddef>
#include <vector>

namespace tvbeam {

/// Bytes that may become more than fit into memory: beyond `most_in_memory` they stand in a file of
/// the directory for temporary ones, which has no name and goes with the program. Zero where
/// nothing was written. For one thread at a time.
class Scratch {
public:
    Scratch() = default;
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    Scratch(Scratch&&) = delete;
    Scratch& operator=(Scratch&&) = delete;

    static constexpr std::size_t most_in_memory = std::size_t{1} << 24;

    [[nodiscard]] std::size_t size() const { return size_; }

    /// Throws std::runtime_error, with the reason, where the file cannot be made, is full or cannot
    /// be read.
    void write(std::size_t offset, const void* bytes, std::size_t count);
    void read(std::size_t offset, void* bytes, std::size_t count) const;

private:
    void move_to_file();

    std::vector<char> memory_;
    int descriptor_ = -1;
    std::size_t size_ = 0;
};

} // namespace tvbeam

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tvbeam::fuzz {

// Each takes bytes from anywhere, and says whether it took them. A refusal (InputError) is an
// answer; any other exception, a crash, and a broken promise are not, and end the program.

/// A solution on one of several beams, as the first byte says: parsed, derived, checked.
bool solution(std::span<const std::uint8_t> data);

/// Equations of one's own, derived, checked, and written in the language that the first byte says.
bool equations(std::span<const std::uint8_t> data);

/// A scene, read with its expectations, and what is predicted of it.
bool scene(std::span<const std::uint8_t> data);

/// A table of errors; the first byte says how its columns are chosen. Short ones are analysed.
bool table(std::span<const std::uint8_t> data);

/// A baseline, or, behind a first line that fits, the lines of a checkpoint: whatever is kept of
/// them has the lengths that the scene asks for.
bool kept(std::span<const std::uint8_t> data);

/// An expression that the bytes choose from the grammar, evaluated as it is chosen in 60 digits: a
/// tape is that, or the comparison with the text alarms.
bool grammar(std::span<const std::uint8_t> data);

inline std::string_view text_of(std::span<const std::uint8_t> data) {
    return {reinterpret_cast<const char*>(data.data()), data.size()};
}

/// The first byte, which is taken away from the rest.
inline std::uint8_t taken(std::span<const std::uint8_t>& data) {
    if (data.empty())
        return 0;
    const std::uint8_t first = data.front();
    data = data.subspan(1);
    return first;
}

/// Ends the program unless it holds.
void require(bool holds, const std::string& what);

} // namespace tvbeam::fuzz

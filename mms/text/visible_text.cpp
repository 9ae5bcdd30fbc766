#include "mms/text/visible_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tvbeam {

namespace {

struct Character {
    std::size_t length = 0; // in bytes; 0: the text does not begin with a character of UTF-8
    std::uint32_t code = 0;
};

Character first_of(std::string_view text) {
    const auto byte = [&](std::size_t i) -> std::uint32_t {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80U)
        return {1, lead};
    const std::size_t length = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
    // The least code that needs so many bytes; the rest of the lead.
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80U, 0x800U, 0x10000U};
    std::uint32_t code = lead & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U)
            return {};
        code = code << 6U | (byte(i) & 0x3FU);
    }
    const bool surrogate = code >= 0xD800U && code < 0xE000U;
    const bool is_one = lead >= 0xC0U && lead < 0xF8U && code >= least.at(length) && !surrogate &&
                        code <= 0x10FFFFU;
    return is_one ? Character{length, code} : Character{};
}

/// No characters of XML, and those that terminals obey: C0, DEL, C1.
bool is_obeyed(std::uint32_t code) {
    return (code < 0x20U && code != '\n' && code != '\t') || (code >= 0x7FU && code < 0xA0U) ||
           code == 0xFFFEU || code == 0xFFFFU;
}

} // namespace

std::string visible(const std::string& text) {
    std::string shown;
    shown.reserve(text.size());
    for (std::string_view rest = text; !rest.empty();) {
        const auto [length, code] = first_of(rest);
        if (length == 0 || (length == 1 && is_obeyed(code)))
            shown += fmt::format("\\x{:02X}", static_cast<unsigned char>(rest.front()));
        else if (is_obeyed(code))
            shown += fmt::format("\\u{:04X}", code);
        else
            shown += rest.substr(0, length);
        rest.remove_prefix(length == 0 ? 1 : length);
    }
    return shown;
}

std::string_view whole_characters(std::string_view text, std::size_t most) {
    if (text.size() <= most)
        return text;
    constexpr std::size_t longest = 4; // bytes of a character
    for (std::size_t begin = most - std::min(most, longest - 1); begin < most; ++begin)
        if (begin + first_of(text.substr(begin)).length > most)
            return text.substr(0, begin);
    return text.substr(0, most);
}

std::string code_text(const std::string& character) {
    return fmt::format("U+{:04X}", first_of(character).code);
}

} // namespace tvbeam

#include "reports/document/raised_text.hpp"

#include <algorithm>

namespace tvbeam {

std::string with_raised(std::string_view text, std::string_view mark, std::string_view before,
                        std::string_view behind) {
    constexpr std::string_view raised =
        "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    std::string result;
    for (auto at = text.find(mark); at != std::string_view::npos; at = text.find(mark)) {
        result += text.substr(0, at);
        text.remove_prefix(at + mark.size());
        const std::string_view word =
            text.substr(0, std::min(text.find_first_not_of(raised), text.size()));
        if (word.empty())
            result += mark;
        else
            result.append(before).append(word).append(behind);
        text.remove_prefix(word.size());
    }
    return result.append(text);
}

} // namespace tvbeam

#include "studies/external/placeholders.hpp"

#include "mms/text/characters.hpp"
#include "mms/text/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace tvbeam {

namespace {

bool is_name(std::string_view text) {
    return !text.empty() && !is_digit(text.front()) &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

} // namespace

Place place_in(const Template& whole, std::size_t offset) {
    if (!whole.is_file)
        return whole.place;
    std::size_t written = offset;
    for (const auto& [begin, written_begin] : whole.pieces)
        if (begin <= offset)
            written = written_begin + (offset - begin);
    const auto before =
        std::string_view(whole.pieces.empty() ? whole.text : whole.written).substr(0, written);
    const auto line_start = before.rfind('\n');
    return {whole.place.file, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
            static_cast<int>(line_start == std::string_view::npos ? written
                                                                  : written - line_start - 1) +
                1};
}

std::string Template::filled(const Placeholders& values) const {
    std::string result;
    std::size_t open = 0; // {{ that no }} has closed
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t brace = text.find_first_of("{}", at);
        result.append(text, at, brace - at);
        if (brace == std::string::npos)
            break;
        if (text[brace] == '}') {
            const bool closes = open > 0 && text.compare(brace, 2, "}}") == 0;
            open -= closes ? 1 : 0;
            result += '}';
            at = brace + (closes ? 2 : 1);
            continue;
        }
        if (text.compare(brace, 2, "{{") == 0) {
            result += '{';
            ++open;
            at = brace + 2;
            continue;
        }
        const std::size_t end = text.find('}', brace);
        const std::string name =
            end == std::string::npos ? "" : text.substr(brace + 1, end - brace - 1);
        if (!is_name(name)) {
            result += '{';
            at = brace + 1;
            continue;
        }
        const auto found = values.find(name);
        if (found == values.end()) {
            std::vector<std::string> names;
            std::string list;
            for (const auto& [known, value] : values) {
                names.push_back(known);
                list += (list.empty() ? "" : ", ") + known;
            }
            throw InputError(
                place_in(*this, brace),
                fmt::format("there is no placeholder {{{}}}{}; known: {}; a parameter is given in "
                            "[solver.parameters], and {{{{ and }}}} are braces",
                            name, did_you_mean(name, names), list));
        }
        if (!found->second)
            throw InputError(place_in(*this, brace),
                             fmt::format("{{{0}}} has nothing to stand for: a study gives no {0}; "
                                         "give it, or remove the placeholder",
                                         name));
        result += *found->second;
        at = end + 1;
    }
    return result;
}

} // namespace tvbeam

#include "reports/sweep/sweep.hpp"

#include "mms/text/input_error.hpp"
#include "mms/text/toml_document.hpp"
#include "studies/ladder/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// A word that no file of the sweep itself has, and no name of another directory: of those with a
/// dot numbers alone, and none as those of values that are not words.
bool is_directory_name(const std::string& text) {
    double number = 0.0;
    const char* const end = text.data() + text.size();
    return is_plain_word(text) && text != "plots" && text.front() != '.' &&
           text.find("-of-") == std::string::npos &&
           (text.find('.') == std::string::npos ||
            std::from_chars(text.data() + (text.front() == '+' ? 1 : 0), end, number).ptr == end);
}

bool is_between(const std::string& text, char first, char last) {
    return text.size() > 1 && text.front() == first && text.back() == last;
}

/// Where a value that begins at `begin` ends: at a comma outside quotes and brackets, or the end.
std::size_t end_of_value(const std::string& text, std::size_t begin) {
    int depth = 0;
    char quote = 0;
    for (std::size_t i = begin; i < text.size(); ++i) {
        const char c = text[i];
        if (quote == '"' && c == '\\')
            ++i;
        else if (quote != 0)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '[' || c == ']')
            depth += c == '[' ? 1 : -1;
        else if (c == ',' && depth == 0)
            return i;
    }
    return text.size();
}

/// Parts between commas; empty where they are no words, texts in quotes and lists in brackets.
std::vector<std::string> values_in(const std::string& text) {
    std::vector<std::string> values;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = end_of_value(text, begin);
        const std::string part = text.substr(begin, end - begin);
        if (!is_plain_word(part) && !is_between(part, '[', ']') && !is_between(part, '"', '"') &&
            !is_between(part, '\'', '\''))
            return {};
        values.push_back(part);
        begin = end + 1;
    }
    return values;
}

} // namespace

bool is_plain_word(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '.' || c == '-' || c == '+' || c == '_';
    });
}

std::vector<std::string> Sweep::overrides(const std::string& value) const {
    auto all = others;
    all.push_back(key + "=" + value);
    return all;
}

std::string Sweep::shown(std::size_t i) const {
    const auto text = override_text(values[i]);
    return text && !text->empty() && override_text(*text) == text ? *text : values[i];
}

std::string Sweep::directory(std::size_t i) const {
    return is_directory_name(shown(i)) ? shown(i) : fmt::format("{}-of-{}", i + 1, values.size());
}

std::optional<Sweep> sweep_in(const std::vector<std::string>& overrides) {
    std::optional<Sweep> sweep;
    std::vector<std::string> others;
    for (const auto& assignment : overrides) {
        const auto equals = std::min(assignment.find('='), assignment.size());
        const auto given = equals < assignment.size() ? values_in(assignment.substr(equals + 1))
                                                      : std::vector<std::string>();
        const std::string key = assignment.substr(0, equals);
        if (given.size() < 2 || key == "title") {
            others.push_back(assignment);
            continue;
        }
        if (sweep)
            throw InputError({"--set " + assignment},
                             "one key is swept at a time, and " + sweep->key + " is already");
        std::set<std::string> values;
        for (const auto& word : given) {
            const auto value = override_number(word);
            const auto text = override_text(word);
            if (!values.insert(value  ? fmt::format("{}", *value)
                               : text ? '"' + *text
                                      : word)
                     .second)
                throw InputError({"--set " + assignment},
                                 word + " is there twice; name each value once");
        }
        sweep = Sweep{key, given, {}};
    }
    for (const auto& other : others)
        if (sweep && other.substr(0, other.find('=')) == sweep->key)
            throw InputError({"--set " + other},
                             sweep->key + " is swept, and cannot have one value as well");
    if (sweep)
        sweep->others = std::move(others);
    return sweep;
}

void require_names_of_rows(const Sweep& sweep, const Scene& scene) {
    const auto* ladder = scene.get<LadderBlock>();
    if (ladder == nullptr)
        return;
    for (const auto& norm : ladder->norms)
        for (const char* key : {"value", "failed"})
            if (norm.name == key)
                throw InputError({"--set " + sweep.key},
                                 "the rows of a sweep have a " + norm.name +
                                     " of their own; give the number of the solver another name");
}

} // namespace tvbeam

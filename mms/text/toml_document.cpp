#include "mms/text/toml_document.hpp"

#include "mms/text/file_text.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

constexpr std::size_t largest_file = 1 << 20; // bytes

/// Parts of a dotted key, and brackets within each other. Whoever writes a scene needs five; the
/// parser and all that walks a table call themselves once a level, and a stack holds some 10 000.
constexpr int deepest = 32;

/// Throws InputError where keys or values are nested deeper than that: reads the text as far as
/// strings, comments, brackets and dots go.
class DepthCheck {
public:
    DepthCheck(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    void run() {
        while (at_ < text_.size())
            switch (text_[at_]) {
            case '#':
                at_ = std::min(text_.find('\n', at_), text_.size());
                break;
            case '"':
            case '\'':
                skip_string();
                break;
            default:
                visit(text_[at_++]);
            }
    }

private:
    void visit(char c) {
        switch (c) {
        case '.':
            if (++dots_ >= deepest)
                refuse("a key has more than " + std::to_string(deepest) + " parts");
            break;
        case '[':
        case '{':
            dots_ = 0;
            if (++open_ > deepest)
                refuse("values are nested more than " + std::to_string(deepest) + " deep");
            break;
        case ']':
        case '}':
            open_ = std::max(open_ - 1, 0);
            dots_ = 0;
            break;
        case '=':
        case ',':
        case '\n':
            dots_ = 0;
            break;
        default:
            break;
        }
    }

    /// One that is not closed ends with its line, or with the text; the parser refuses it there.
    void skip_string() {
        const std::string_view quote = text_.substr(at_, 1);
        const std::string triple(3, quote.front());
        const bool many_lines = text_.substr(at_).starts_with(triple);
        const std::string_view end = many_lines ? std::string_view(triple) : quote;
        at_ += end.size();
        while (at_ < text_.size() && !text_.substr(at_).starts_with(end)) {
            if (!many_lines && text_[at_] == '\n')
                return;
            at_ += quote == "\"" && text_[at_] == '\\' ? 2 : 1;
        }
        at_ = std::min(at_ + end.size(), text_.size());
    }

    [[noreturn]] void refuse(const std::string& what) const {
        const std::string_view before = text_.substr(0, at_ - 1);
        const auto line = std::count(before.begin(), before.end(), '\n');
        const auto begin = before.rfind('\n') + 1; // 0 on the first line
        throw InputError({file_, static_cast<int>(line) + 1, static_cast<int>(at_ - begin)},
                         what + "; no scene and no solution has so many");
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0;
    int dots_ = 0;
    int open_ = 0;
};

/// Of what the parser says where a value begins as none can: mostly a formula without quotes.
std::string advice_on(const std::string& description) {
    for (const char* what : {"value type", "parsing boolean", "parsing floating-point", "integer"})
        if (description.find(what) != std::string::npos)
            return "; a text or an expression stands in quotes: key = \"…\"";
    return {};
}

std::string reason_of(const toml::parse_error& error) {
    std::string description(error.description()); // may show an end of line
    boost::algorithm::replace_all(description, "\n", "\\n");
    return "not TOML: " + description + advice_on(description);
}

toml::table parse(const std::string& text, const std::string& file) {
    DepthCheck(text, file).run();
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        const auto& begin = error.source().begin;
        throw InputError({file, static_cast<int>(begin.line), static_cast<int>(begin.column)},
                         reason_of(error));
    }
}

} // namespace

std::string type_name(const toml::node& node) {
    switch (node.type()) {
    case toml::node_type::string:
        return "a string";
    case toml::node_type::integer:
        return "an integer";
    case toml::node_type::floating_point:
        return "a number";
    case toml::node_type::boolean:
        return "a boolean";
    case toml::node_type::array:
        return "an array";
    case toml::node_type::table:
        return "a table";
    default:
        return "a date or time";
    }
}

TomlDocument read_toml(const std::string& file) {
    return parse_toml(toml_text(file), file);
}

std::string toml_text(const std::string& file) {
    return file_text(file, largest_file);
}

TomlDocument parse_toml(std::string text, const std::string& file) {
    toml::table table = parse(text, file);
    TomlDocument document{.file = file, .text = std::move(text), .table = std::move(table)};
    document.lines = LineIndex(document.text);
    return document;
}

namespace {

/// Where the '=' behind the key stands; npos: there is none.
std::size_t end_of_key(const std::string& assignment) {
    char quote = '\0';
    for (std::size_t i = 0; i < assignment.size(); ++i)
        if (assignment[i] == quote)
            quote = '\0';
        else if (quote == '\0' && (assignment[i] == '"' || assignment[i] == '\''))
            quote = assignment[i];
        else if (quote == '\0' && assignment[i] == '=')
            return i;
    return std::string::npos;
}

/// The parts of a key a."b.c".d, of which those in quotes may hold dots; as they stand, without
/// escapes.
std::vector<std::string> parts_of(const std::string& key) {
    std::vector<std::string> parts(1);
    char quote = '\0';
    for (const char letter : key)
        if (letter == quote || (quote == '\0' && (letter == '"' || letter == '\'')))
            quote = quote == '\0' ? letter : '\0';
        else if (letter == '.' && quote == '\0')
            parts.emplace_back();
        else
            parts.back() += letter;
    return parts;
}

/// The table of that number in an array.
toml::node& element_of(toml::array& array, const std::string& key, const std::string& number,
                       const Place& place) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
    if (error != std::errc() || end != number.data() + number.size() || index >= array.size())
        throw InputError(place, "'" + key + "' is an array of " + std::to_string(array.size()) +
                                    " tables; name one by its number, 0 to " +
                                    std::to_string(array.size() - 1) + ", not '" + number + "'");
    return *array.get(index);
}

/// The value of an override, as `value`. What is not TOML is a bare word, as fixed-point, but for
/// what begins as a list or can only be a number.
toml::table value_table(const std::string& value, const Place& place) {
    try {
        return toml::parse("value = " + value, place.file);
    } catch (const toml::parse_error& error) {
        const std::string word = boost::algorithm::trim_copy(value);
        const char* const end = word.data() + word.size();
        double number = 0;
        const auto read = std::from_chars(word.data(), end, number);
        if (read.ptr == end && read.ec == std::errc::result_out_of_range)
            throw InputError(place, "is beyond what a double holds");
        if ((read.ptr == end && read.ec == std::errc()) || word.starts_with('['))
            throw InputError(place, reason_of(error));
        return parse("value = '" + value + "'", place.file);
    }
}

std::optional<toml::table> value_unless_refused(const std::string& value) {
    try {
        return value_table(value, {"--set"});
    } catch (const InputError&) {
        return std::nullopt;
    }
}

} // namespace

void override_key(TomlDocument& document, const std::string& assignment) {
    const Place place{"--set " + assignment};
    const auto equals = end_of_key(assignment);
    if (equals == std::string::npos || equals == 0)
        throw InputError(place, "an override reads key=value, e.g. --set beam.alpha=1e3");
    std::vector<std::string> parts =
        parts_of(boost::algorithm::trim_copy(assignment.substr(0, equals)));
    if (parts.size() > static_cast<std::size_t>(deepest))
        throw InputError({"--set"}, "the key has more than " + std::to_string(deepest) + " parts");
    if (std::find(parts.begin(), parts.end() - 1, "") != parts.end() - 1)
        throw InputError(place, "the key has an empty part; name the block before each dot, as in "
                                "beam.alpha");

    toml::table parsed = value_table(assignment.substr(equals + 1), place);
    if (parsed.size() != 1) // `1\nother = 2` would set more than was named
        throw InputError(place, "an override sets one key to one value");

    toml::table* table = &document.table;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        const std::string& key = parts[i];
        toml::node* node = table->get(key);
        if (node == nullptr) { // parsed, so that it has a place
            toml::table made = toml::parse("value = {}", place.file);
            node = &table->insert_or_assign(key, std::move(*made.get("value"))).first->second;
        }
        if (toml::array* array = node->as_array(); array != nullptr && array->is_array_of_tables())
            node = &element_of(*array, key, parts[++i], place);
        table = node->as_table();
        if (table == nullptr)
            throw InputError(place, "'" + key + "' is " + type_name(*node) + ", not a table");
        if (i + 1 == parts.size())
            parts.emplace_back(); // it ends in the number of a table
    }
    if (parts.back().empty())
        throw InputError(
            place, "the key ends in a dot or in the number of a table; name the key behind it");
    table->insert_or_assign(parts.back(), std::move(*parsed.get("value")));
}

namespace {

void merge(toml::table& into, toml::table& from) {
    for (auto&& [key, node] : from) {
        toml::table* inner = node.as_table();
        toml::table* target = into[key].as_table();
        if (inner != nullptr && target != nullptr)
            merge(*target, *inner);
        else
            into.insert_or_assign(key, std::move(node));
    }
}

} // namespace

void merge_block(TomlDocument& document, std::string_view key) {
    toml::node* node = document.table.get(key);
    if (node == nullptr || !node->is_table())
        return;
    toml::table block = std::move(*node->as_table());
    document.table.erase(key);
    merge(document.table, block);
}

std::optional<double> override_number(const std::string& value) {
    const auto table = value_unless_refused(value);
    const bool is_number = table && (*table)["value"].is_number();
    const auto number = is_number ? (*table)["value"].value<double>() : std::nullopt;
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::string> override_text(const std::string& value) {
    const auto table = value_unless_refused(value);
    return table ? (*table)["value"].value_exact<std::string>() : std::nullopt;
}

} // namespace tvbeam

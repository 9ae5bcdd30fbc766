#include "mms/text/toml_reader.hpp"

#include "mms/text/file_text.hpp"
#include "mms/text/nearest_name.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace tvbeam {

namespace {

constexpr std::size_t largest_file = 1 << 20; // bytes

Place place_of(const toml::node& node) {
    const toml::source_region& region = node.source();
    Place place;
    if (region.path)
        place.file = *region.path;
    // An override stands on the command line, which has no lines.
    if (!place.file.starts_with("--set ")) {
        place.line = static_cast<int>(region.begin.line);
        place.column = static_cast<int>(region.begin.column);
    }
    return place;
}

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

/// How a single value is written as an array of it: ", [0.01]".
std::string in_brackets(const toml::node& node) {
    std::ostringstream text;
    if (node.is_number())
        node.visit([&](const auto& value) {
            if constexpr (toml::is_number<decltype(value)>)
                text << ", [" << number_text(static_cast<double>(value.get()), 12) << "]";
        });
    else if (node.is_string())
        text << ", [\"" << node.as_string()->get() << "\"]";
    return text.str();
}

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

TableReader::TableReader(const TomlDocument& document, const toml::table& table, std::string path,
                         const KeyTable::Node* keys)
    : document_(&document), table_(&table), path_(std::move(path)), keys_(keys) {}

std::string TableReader::full(std::string_view key) const {
    if (path_.empty() || key.empty())
        return path_ + std::string(key);
    return path_ + "." + std::string(key);
}

namespace {

/// Whether a key of the one type may be asked for as the other: a choice of words, for one, is read
/// as texts where each is looked up.
bool may_be_read_as(KeyType type, KeyType asked) {
    switch (type) {
    case KeyType::words:
        return asked == KeyType::words || asked == KeyType::texts;
    case KeyType::steps:
        return asked == KeyType::numbers || asked == KeyType::expression;
    case KeyType::patterns:
        return asked == KeyType::table || asked == KeyType::text;
    default:
        return type == asked;
    }
}

} // namespace

const toml::node* TableReader::find(std::string_view key, KeyType type) {
    if (std::ranges::find(known_, key) == known_.end())
        known_.emplace_back(key);
    const toml::node* node = table_->get(key);
    const KeyTable::Node* entry = keys_ != nullptr ? keys_->find(key) : nullptr;
    const bool differs =
        keys_ != nullptr && entry != nullptr && !may_be_read_as(entry->entry->type, type);
    if (differs && node != nullptr && type == KeyType::table) // by a name that the user gave
        throw own_key(key);
    if (differs && node == nullptr && type == KeyType::table && keys_->has_chosen_names())
        return nullptr; // a name that the user gave, of which nothing is said
    if (differs || (keys_ != nullptr && entry == nullptr))
        throw std::logic_error("the table of keys does not say that " + full(key) + " may be " +
                               words_of(type));
    if (document_->asked != nullptr) {
        AskedKey& asked = (*document_->asked)[full(key)];
        asked.given |= node != nullptr;
        asked.entry = entry != nullptr ? entry->entry->path : full(key);
    }
    return node;
}

InputError TableReader::own_key(std::string_view key) const {
    return error(key, std::string(" is a key of its own, ") +
                          words_of(keys_->find(key)->entry->type) +
                          "; nothing can be called so here");
}

bool TableReader::owns(std::string_view key) const {
    return keys_ != nullptr && keys_->is_fixed(key);
}

void TableReader::require_free(std::string_view name) const {
    if (has(name) && owns(name))
        throw own_key(name);
}

void TableReader::require_choices(std::string_view key,
                                  const std::vector<std::string>& choices) const {
    if (keys_ != nullptr && keys_->find(key)->entry->words != choices)
        throw std::logic_error("the table of keys has other choices for " + full(key));
}

Place TableReader::place(std::string_view key) const {
    const toml::node* node = table_->get(key);
    Place place = place_of(node != nullptr ? *node : *table_);
    if (place.file
            .empty()) // values and tables that came from an override carry no region of a file
        place.file = document_->file;
    return place;
}

Place TableReader::place() const {
    return place("");
}

Place TableReader::place_of_key(std::string_view key) const {
    const auto entry = table_->find(key);
    Place place = place_of(entry->second);
    if (const auto& region = entry->first.source(); region.begin.line > 0 && place.line > 0) {
        place.line = static_cast<int>(region.begin.line);
        place.column = static_cast<int>(region.begin.column);
    }
    return place;
}

Place TableReader::place(std::string_view key, std::size_t element) const {
    const toml::node* node = table_->get(key);
    if (const toml::array* array = node != nullptr ? node->as_array() : nullptr;
        array != nullptr && element < array->size())
        return place_of(*array->get(element));
    return place(key);
}

InputError TableReader::error(std::string_view key, const std::string& text) const {
    return {place(key), full(key) + text};
}

InputError TableReader::error(std::string_view key, const std::string& text,
                              std::size_t element) const {
    return {place(key, element), full(key) + text};
}

InputError TableReader::wrong_type(std::string_view key, const toml::node& node,
                                   const std::string& wanted) const {
    return {place(key), full(key) + " is " + type_name(node) + "; it must be " + wanted};
}

double TableReader::checked_number(std::string_view key, const toml::node& node,
                                   Infinity infinity) const {
    const auto value = node.value<double>();
    if (!value || !(node.is_floating_point() || node.is_integer()))
        throw wrong_type(key, node, "a number");
    if (std::isnan(*value) || (std::isinf(*value) && infinity == Infinity::refused))
        throw InputError(place_of(node),
                         full(key) + " is " + number_text(*value) + "; it must be a " +
                             (infinity == Infinity::refused ? "finite number" : "number"));
    return *value;
}

template <typename Value>
std::optional<Value> TableReader::value(std::string_view key, KeyType type,
                                        const std::string& wanted) {
    const toml::node* node = find(key, type);
    if (node == nullptr)
        return std::nullopt;
    if (!node->is<Value>())
        throw wrong_type(key, *node, wanted);
    return node->value<Value>();
}

template <typename Value>
std::optional<std::vector<Value>> TableReader::values(std::string_view key, KeyType type,
                                                      const std::string& wanted) {
    const toml::node* node = find(key, type);
    if (node == nullptr)
        return std::nullopt;
    const toml::array* array = node->as_array();
    if (array == nullptr)
        throw wrong_type(key, *node,
                         "an array of " + wanted + (node->is<Value>() ? in_brackets(*node) : ""));
    std::vector<Value> values;
    for (const auto& element : *array) {
        if (!element.is<Value>())
            throw InputError(place_of(element), full(key) + " holds " + type_name(element) +
                                                    "; it must hold " + wanted);
        values.push_back(*element.value<Value>());
    }
    return values;
}

std::optional<std::int64_t> TableReader::integer(std::string_view key) {
    return value<std::int64_t>(key, KeyType::integer, "an integer");
}

std::optional<bool> TableReader::flag(std::string_view key) {
    return value<bool>(key, KeyType::flag, "true or false");
}

std::optional<std::string> TableReader::text(std::string_view key) {
    return value<std::string>(key, KeyType::text, "a string");
}

std::optional<std::vector<std::int64_t>> TableReader::integers(std::string_view key) {
    return values<std::int64_t>(key, KeyType::integers, "integers");
}

std::optional<std::vector<std::string>> TableReader::texts(std::string_view key) {
    return values<std::string>(key, KeyType::texts, "strings");
}

std::optional<double> TableReader::number(std::string_view key, Infinity infinity) {
    const toml::node* node = find(key, KeyType::number);
    return node == nullptr ? std::nullopt : std::optional(checked_number(key, *node, infinity));
}

std::optional<std::string> TableReader::word(std::string_view key) {
    const toml::node* node = find(key, KeyType::word);
    if (node == nullptr)
        return std::nullopt;
    if (node->is_integer())
        return fmt::format("{}", node->as_integer()->get());
    if (node->is_floating_point())
        return fmt::format("{}", checked_number(key, *node, Infinity::refused));
    if (node->is_boolean())
        return node->as_boolean()->get() ? "true" : "false";
    if (!node->is_string())
        throw wrong_type(key, *node, "a string, a number, true or false");
    return node->as_string()->get();
}

bool TableReader::is_table(std::string_view key) const {
    const toml::node* node = table_->get(key);
    return node != nullptr && node->is_table();
}

bool TableReader::is_array_of_tables(std::string_view key) const {
    const toml::node* node = table_->get(key);
    return node != nullptr && node->is_array_of_tables();
}

bool TableReader::is_number(std::string_view key) const {
    const toml::node* node = table_->get(key);
    return node != nullptr && node->is_number();
}

bool TableReader::is_string(std::string_view key) const {
    const toml::node* node = table_->get(key);
    return node != nullptr && node->is_string();
}

SourceText TableReader::expression_in(std::string_view key, const toml::node& node) const {
    const Place opening = place_of(node);
    if (node.is_integer())
        return SourceText(fmt::format("{}", node.as_integer()->get()), opening);
    if (node.is_floating_point())
        return SourceText(fmt::format("{}", checked_number(key, node, Infinity::refused)), opening);
    if (!node.is_string())
        throw wrong_type(key, node, "an expression in quotes, or a number");
    const std::string& value = node.as_string()->get();
    if (opening.line == 0) // an override
        return SourceText(value, opening);
    return SourceText::of_toml_string(value, document_->text, opening, document_->lines);
}

std::optional<SourceText> TableReader::expression(std::string_view key) {
    const toml::node* node = find(key, KeyType::expression);
    return node == nullptr ? std::nullopt : std::optional(expression_in(key, *node));
}

std::optional<std::vector<SourceText>> TableReader::expressions(std::string_view key) {
    const toml::node* node = find(key, KeyType::expression);
    if (node == nullptr)
        return std::nullopt;
    const toml::array* array = node->as_array();
    if (array == nullptr)
        return std::vector{expression_in(key, *node)};
    std::vector<SourceText> result;
    for (const auto& element : *array)
        result.push_back(expression_in(key, element));
    return result;
}

std::optional<std::vector<double>> TableReader::numbers(std::string_view key, Infinity infinity) {
    const toml::node* node = find(key, KeyType::numbers);
    if (node == nullptr)
        return std::nullopt;
    const toml::array* array = node->as_array();
    if (array == nullptr)
        throw wrong_type(key, *node,
                         "an array of numbers" + (node->is_number() ? in_brackets(*node) : ""));
    std::vector<double> values;
    for (const auto& element : *array)
        values.push_back(checked_number(key, element, infinity));
    return values;
}

TableReader::Band TableReader::checked_band(std::string_view key, const toml::node& node,
                                            const std::string& why) const {
    if (const toml::table* inner = node.as_table(); inner != nullptr && !inner->empty())
        throw InputError(place_of(node),
                         fmt::format("{} must be a band [lowest, highest]; if a name with a dot in "
                                     "it is meant, it stands in quotes: \"{}.{}\"",
                                     full(key), key, inner->begin()->first.str()));
    const toml::array* pair = node.as_array();
    if (pair == nullptr || pair->size() != 2)
        throw InputError(place_of(node), full(key) + " must be a band [lowest, highest]" + why);
    const Band band{checked_number(key, *pair->get(0), Infinity::refused),
                    checked_number(key, *pair->get(1), Infinity::refused)};
    if (!(band.lowest < band.highest))
        throw InputError(place_of(node),
                         full(key) + " is a band whose lowest value is not below its highest");
    return band;
}

std::optional<TableReader::Band> TableReader::band(std::string_view key, const std::string& why) {
    const toml::node* node = find(key, KeyType::band);
    return node == nullptr ? std::nullopt : std::optional(checked_band(key, *node, why));
}

std::optional<std::vector<TableReader::Band>> TableReader::bands(std::string_view key) {
    const toml::node* node = find(key, KeyType::bands);
    if (node == nullptr)
        return std::nullopt;
    const toml::array* array = node->as_array();
    if (array == nullptr || array->empty() || !array->get(0)->is_array())
        return std::vector<Band>{checked_band(key, *node, of_a_gate)};
    std::vector<Band> bands;
    for (const auto& element : *array)
        bands.push_back(checked_band(key, element, of_a_gate));
    return bands;
}

std::optional<std::size_t> TableReader::choice(std::string_view key,
                                               const std::vector<std::string>& choices) {
    const auto value = this->value<std::string>(key, KeyType::choice, "a string");
    require_choices(key, choices);
    if (document_->asked != nullptr)
        (*document_->asked)[full(key)].chosen = value.value_or("");
    if (!value)
        return std::nullopt;
    const auto found = std::find(choices.begin(), choices.end(), *value);
    if (found != choices.end())
        return static_cast<std::size_t>(found - choices.begin());
    throw InputError(place(key),
                     fmt::format("{} is '{}'; it must be one of '{}'{}", full(key), *value,
                                 fmt::join(choices, "', '"), did_you_mean(*value, choices)));
}

std::optional<TableReader> TableReader::table(std::string_view key) {
    const toml::node* node = find(key, KeyType::table);
    if (node == nullptr)
        return std::nullopt;
    const toml::table* inner = node->as_table();
    if (inner == nullptr)
        throw wrong_type(key, *node, "a table");
    return TableReader(*document_, *inner, full(key),
                       keys_ != nullptr ? keys_->find(key) : nullptr);
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
    const toml::node* node = find(key, KeyType::tables);
    std::vector<TableReader> tables;
    if (node == nullptr)
        return tables;
    const toml::array* array = node->as_array();
    if (array == nullptr || !array->is_array_of_tables())
        throw wrong_type(key, *node, "an array of tables, each headed [[" + full(key) + "]]");
    for (const auto& element : *array)
        tables.push_back(TableReader(*document_, *element.as_table(),
                                     full(key) + "." + std::to_string(tables.size()),
                                     keys_ != nullptr ? keys_->find(key) : nullptr));
    return tables;
}

std::vector<std::string> TableReader::unread() const {
    std::vector<std::string> keys;
    const std::set<std::string_view> known(known_.begin(), known_.end());
    for (const auto& [key, node] : *table_)
        if (!known.contains(key.str()))
            keys.emplace_back(key.str());
    return keys;
}

void TableReader::finish() const {
    for (const auto& key : unread()) {
        const std::string hint = did_you_mean(key, known_);
        if (owns(key))
            throw InputError(place_of_key(key), full(key) + " does not apply here; it is for: " +
                                                    keys_->find(key)->entry->meaning + hint);
        throw InputError(
            place_of_key(key),
            "unknown key '" + full(key) + "'" +
                (hint.empty() ? fmt::format("; known here: {}", fmt::join(known_, ", ")) : hint));
    }
}

} // namespace tvbeam

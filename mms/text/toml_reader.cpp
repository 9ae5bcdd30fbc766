#include "mms/text/toml_reader.hpp"

#include "mms/text/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace tvbeam {

namespace {

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

} // namespace

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
    auto known = known_;
    known.insert(known.end(), offered_.begin(), offered_.end());
    for (const auto& key : unread()) {
        const std::string hint = did_you_mean(key, known);
        if (owns(key))
            throw InputError(place_of_key(key), full(key) + " does not apply here; it is for: " +
                                                    keys_->find(key)->entry->meaning + hint);
        throw InputError(
            place_of_key(key),
            "unknown key '" + full(key) + "'" +
                (hint.empty() ? fmt::format("; known here: {}", fmt::join(known, ", ")) : hint));
    }
}

} // namespace tvbeam

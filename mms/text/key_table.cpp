#include "mms/text/key_table.hpp"

#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tvbeam {

namespace {

bool is_placeholder(std::string_view word) {
    return std::all_of(word.begin(), word.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

/// "a.b.c": "a.b" and "c"; of "a": "" and "a".
std::pair<std::string, std::string> parent_and_name(const std::string& path) {
    const auto dot = path.rfind('.');
    return dot == std::string::npos ? std::pair(std::string(), path)
                                    : std::pair(path.substr(0, dot), path.substr(dot + 1));
}

/// A table as its header names it, a key in quotes.
std::string shown(const std::string& path, bool is_table) {
    return is_table ? "[" + path + "]" : "'" + path + "'";
}

/// Keys of other tables that are called so, or nearly so: the first whose path can be written as it
/// stands.
std::string elsewhere(const std::string& name, const KeyTable& keys) {
    std::vector<std::string> names;
    for (const auto& entry : keys.entries())
        if (entry.is_plain())
            names.push_back(parent_and_name(entry.path).second);
    const auto exact = std::find(names.begin(), names.end(), name);
    const std::string meant = exact != names.end() ? name : nearest_name(name, names);
    for (const auto& entry : keys.entries())
        if (entry.is_plain() && parent_and_name(entry.path).second == meant && !meant.empty())
            return "; did you mean " + shown(entry.path, entry.is_table()) + "?";
    return {};
}

InputError unknown_key(const TableReader& table, const std::string& key, const KeyTable::Node& node,
                       const KeyTable& keys) {
    const bool is_block = table.is_table(key);
    const auto known = node.names();
    std::string hint;
    if (const std::string near = nearest_name(key, known); !near.empty()) {
        const KeyEntry& entry = *node.find(near)->entry;
        hint = "; did you mean " +
               (is_block && entry.is_table() ? "[" + table.full(near) + "]" : "'" + near + "'") +
               "?";
    } else {
        hint = elsewhere(key, keys);
    }
    if (hint.empty())
        hint = fmt::format("; known here: {}", fmt::join(known, ", "));
    return {table.place_of_key(key), (is_block ? "unknown block " : "unknown key ") +
                                         shown(table.full(key), is_block) + hint};
}

void require_known(TableReader table, const KeyTable::Node& node, const KeyTable& keys) {
    for (const auto& key : table.unread()) {
        const KeyTable::Node* inner = node.find(key);
        if (inner == nullptr)
            throw unknown_key(table, key, node, keys);
        // Where a table should be and is none, its reader says so.
        if (inner->entry->type == KeyType::table && table.is_table(key))
            require_known(*table.table(key), *inner, keys);
        if (inner->entry->type == KeyType::tables && table.is_array_of_tables(key))
            for (const auto& element : table.tables(key))
                require_known(element, *inner, keys);
    }
}

} // namespace

const char* words_of(KeyType type) {
    switch (type) {
    case KeyType::table:
        return "a table";
    case KeyType::tables:
        return "an array of tables";
    case KeyType::text:
        return "a text";
    case KeyType::word:
        return "a text, a number, true or false";
    case KeyType::expression:
        return "an expression in quotes, or a number";
    case KeyType::number:
        return "a number";
    case KeyType::integer:
        return "an integer";
    case KeyType::flag:
        return "true or false";
    case KeyType::choice:
        return "one of";
    case KeyType::numbers:
        return "a list of numbers";
    case KeyType::integers:
        return "a list of integers";
    case KeyType::texts:
        return "a list of texts";
    case KeyType::words:
        return "a list of some of";
    case KeyType::band:
        return "two numbers, [lowest, highest]";
    case KeyType::bands:
        return "[lowest, highest], or a list of such pairs";
    case KeyType::steps:
        return "a list of numbers, or one expression in s";
    default:
        return "a table of regular expressions by name, or a file";
    }
}

bool KeyEntry::is_plain() const {
    for (std::size_t begin = 0; begin < path.size();) {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        if (is_placeholder(std::string_view(path).substr(begin, end - begin)))
            return false;
        begin = end + 1;
    }
    return true;
}

const KeyTable::Node* KeyTable::Node::find(std::string_view key) const {
    if (like != nullptr) {
        const Node* same = like->find(key);
        return same != this ? same : nullptr;
    }
    const auto found = inner.find(key);
    return found != inner.end() ? &found->second : any.get();
}

bool KeyTable::Node::is_fixed(std::string_view key) const {
    const Node* found = find(key);
    return found != nullptr && found != (like != nullptr ? like : this)->any.get();
}

std::vector<std::string> KeyTable::Node::names() const {
    std::vector<std::string> names;
    for (const auto& [name, node] : (like != nullptr ? like : this)->inner)
        if (&node != this)
            names.push_back(name);
    return names;
}

KeyTable::Node& KeyTable::node_of(const std::string& path) {
    if (path.empty())
        return root_;
    const auto [parent, name] = parent_and_name(path);
    Node& above = node_of(parent);
    if (is_placeholder(name) && above.any)
        return *above.any;
    const auto found = above.inner.find(name);
    if (found == above.inner.end())
        throw std::logic_error("the table of keys has no " + path);
    return found->second;
}

KeyTable::KeyTable(std::vector<KeyEntry> entries) : entries_(std::move(entries)) {
    for (const auto& entry : entries_) {
        const auto [parent, name] = parent_and_name(entry.path);
        Node& above = node_of(parent);
        if (is_placeholder(name))
            above.any = std::make_unique<Node>(Node{.entry = &entry});
        else
            above.inner[name].entry = &entry;
    }
    for (const auto& entry : entries_)
        if (!entry.like.empty())
            node_of(entry.path).like = &node_of(entry.like == "." ? "" : entry.like);
}

void require_known_keys(const TomlDocument& document, const KeyTable& keys) {
    require_known(TableReader(document, document.table, ""), keys.root(), keys);
}

} // namespace tvbeam

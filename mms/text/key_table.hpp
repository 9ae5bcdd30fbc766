#pragma once

#include "mms/text/input_error.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tvbeam {

/// What a key may be.
enum class KeyType {
    table,
    tables, ///< an array of tables, each headed [[…]]
    text,
    word,       ///< a text, a number, true or false
    expression, ///< in quotes, or a number
    number,
    integer,
    flag,
    choice, ///< one of KeyEntry::words
    numbers,
    integers,
    texts,
    words,   ///< a list of some of KeyEntry::words
    band,    ///< [lowest, highest]
    bands,   ///< one band, or a list of them
    steps,   ///< a list of numbers, or one expression in s
    patterns ///< a table of regular expressions by name, or a file
};

/// In words: "a list of numbers".
const char* words_of(KeyType type);

/// A key that documents may have, or a table of keys.
struct KeyEntry {
    /// From the top, e.g. "beam.alpha". A word in capitals stands for what a document calls as it
    /// likes: "stress.sweep.NAME.alpha". Those in an array of tables stand behind the array.
    std::string path;
    KeyType type;
    std::string otherwise; ///< what it is where it is absent; empty: nothing
    std::string meaning;
    std::vector<std::string> words = {}; ///< of a choice, in their order
    std::string like = {};               ///< of a table: the path of one with the same keys

    /// `otherwise` begins so where it must not be absent.
    static constexpr const char* required = "required";

    [[nodiscard]] bool is_table() const {
        return type == KeyType::table || type == KeyType::tables;
    }
    /// Whether its path holds no word in capitals, so that it can be written as it stands.
    [[nodiscard]] bool is_plain() const;
};

/// All keys of a kind of document, each once, in the order in which people are told of them. What
/// reads such a document reads it through the table: keys that are not in it are refused, and
/// nothing else is asked for.
class KeyTable {
public:
    struct Node {
        const KeyEntry* entry = nullptr; ///< null: the document itself
        std::map<std::string, Node, std::less<>> inner = {};
        std::unique_ptr<Node> any = nullptr; ///< for names that the document chooses
        const Node* like = nullptr;

        /// What a key in it is; null: there is none of that name. A table with the keys of one that
        /// holds it is not in itself.
        [[nodiscard]] const Node* find(std::string_view key) const;
        /// Whether the document may choose names for tables in it.
        [[nodiscard]] bool has_chosen_names() const {
            return (like != nullptr ? like : this)->any != nullptr;
        }
        /// Whether it is a name that the document does not choose.
        [[nodiscard]] bool is_fixed(std::string_view key) const;
        /// The names that are fixed.
        [[nodiscard]] std::vector<std::string> names() const;
    };

    /// Throws std::logic_error where an entry stands below none, or `like` names none.
    explicit KeyTable(std::vector<KeyEntry> entries);
    ~KeyTable() = default;
    KeyTable(const KeyTable&) = delete; // its nodes point into it
    KeyTable& operator=(const KeyTable&) = delete;
    KeyTable(KeyTable&&) = delete;
    KeyTable& operator=(KeyTable&&) = delete;

    [[nodiscard]] const std::vector<KeyEntry>& entries() const { return entries_; }
    [[nodiscard]] const Node& root() const { return root_; }

private:
    Node& node_of(const std::string& path);

    std::vector<KeyEntry> entries_;
    Node root_;
};

struct TomlDocument;

/// Refuses a document with a key that is not in the table: throws InputError at the first, with
/// the key that may have been meant, here or in another table.
void require_known_keys(const TomlDocument& document, const KeyTable& keys);

} // namespace tvbeam

#pragma once

#include "mms/text/asked_keys.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/key_table.hpp"
#include "mms/text/number_text.hpp"
#include "mms/text/source_text.hpp"
#include "mms/text/toml_document.hpp"

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tvbeam {

/// A number that was given, as messages print it: 12 significant digits.
inline std::string message_text(double value) {
    return number_text(value, 12);
}

/// One table of a document, read key by key: every reader notes the key as known, and finish()
/// refuses the others. All readers throw InputError at the value when it has the wrong type or
/// breaks the rule they are given; and std::logic_error where the table of keys, if there is one,
/// has no such key of that type.
class TableReader {
public:
    TableReader(const TomlDocument& document, const toml::table& table, std::string path,
                const KeyTable::Node* keys = nullptr);

    /// A finite number, or also ±inf.
    enum class Infinity { refused, allowed };

    std::optional<double> number(std::string_view key, Infinity infinity = Infinity::refused);
    std::optional<std::int64_t> integer(std::string_view key);
    std::optional<bool> flag(std::string_view key);
    std::optional<std::string> text(std::string_view key);
    /// A text, or a number, true or false as it is written shortest.
    std::optional<std::string> word(std::string_view key);
    /// An expression: a string, or a number as it is.
    std::optional<SourceText> expression(std::string_view key);
    /// One expression, or an array of them.
    std::optional<std::vector<SourceText>> expressions(std::string_view key);
    std::optional<std::vector<double>> numbers(std::string_view key,
                                               Infinity infinity = Infinity::refused);
    std::optional<std::vector<std::int64_t>> integers(std::string_view key);
    std::optional<std::vector<std::string>> texts(std::string_view key);
    /// A two-sided band [lo, hi] with lo < hi, both finite.
    struct Band {
        double lowest;
        double highest;
    };
    static constexpr const char* of_a_gate = ": a gate has two sides";
    /// why: what a message says of the two numbers.
    std::optional<Band> band(std::string_view key, const std::string& why = of_a_gate);
    /// One band, or an array of bands.
    std::optional<std::vector<Band>> bands(std::string_view key);
    /// One of the choices, as its index.
    std::optional<std::size_t> choice(std::string_view key,
                                      const std::vector<std::string>& choices);
    /// A table within this one.
    std::optional<TableReader> table(std::string_view key);
    /// An array of tables, whose paths end in their number: a.b.0, a.b.1, …; empty when the key is
    /// missing.
    std::vector<TableReader> tables(std::string_view key);

    /// Names a key that would be read, in the messages of finish() alone: that of a table within
    /// which is not there, as order.h.
    void offer(std::string key) { offered_.push_back(std::move(key)); }

    /// The keys of the table that no reader has asked for yet, in their order.
    [[nodiscard]] std::vector<std::string> unread() const;

    [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }
    [[nodiscard]] bool is_string(std::string_view key) const;
    [[nodiscard]] bool is_number(std::string_view key) const;
    [[nodiscard]] bool is_table(std::string_view key) const;
    [[nodiscard]] bool is_array_of_tables(std::string_view key) const;

    /// Whether the table of keys has a key of that name here, so that nothing can be called so.
    [[nodiscard]] bool owns(std::string_view key) const;
    /// Refuses what the document calls so, where the table of keys has such a key.
    void require_free(std::string_view name) const;

    /// Where a key's value stands, or its element; the table itself when the key is missing.
    [[nodiscard]] Place place(std::string_view key) const;
    [[nodiscard]] Place place(std::string_view key, std::size_t element) const;
    [[nodiscard]] Place place() const; ///< of the table
    /// Where a key that is there stands itself.
    [[nodiscard]] Place place_of_key(std::string_view key) const;

    /// The key with the path of its table: beam.zeta; of the empty key the path.
    [[nodiscard]] std::string full(std::string_view key) const;

    /// What is wrong with a key's value, or its element: "full(key)text", at its place.
    [[nodiscard]] InputError error(std::string_view key, const std::string& text) const;
    [[nodiscard]] InputError error(std::string_view key, const std::string& text,
                                   std::size_t element) const;

    /// Refuses keys that no reader asked for: of those in the table of keys it says what they are
    /// for, of others the nearest that a reader asked for.
    void finish() const;

private:
    const toml::node* find(std::string_view key, KeyType type);
    template <typename Value>
    std::optional<Value> value(std::string_view key, KeyType type, const std::string& wanted);
    template <typename Value>
    std::optional<std::vector<Value>> values(std::string_view key, KeyType type,
                                             const std::string& wanted);
    void require_choices(std::string_view key, const std::vector<std::string>& choices) const;
    [[nodiscard]] InputError wrong_type(std::string_view key, const toml::node& node,
                                        const std::string& wanted) const;
    SourceText expression_in(std::string_view key, const toml::node& node) const;
    Band checked_band(std::string_view key, const toml::node& node, const std::string& why) const;
    [[nodiscard]] InputError own_key(std::string_view key) const;
    double checked_number(std::string_view key, const toml::node& node, Infinity infinity) const;

    const TomlDocument* document_;
    const toml::table* table_;
    std::string path_;
    const KeyTable::Node* keys_;
    std::vector<std::string> known_;
    std::vector<std::string> offered_; ///< named in messages, and refused where they stand there
};

} // namespace tvbeam

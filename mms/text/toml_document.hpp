#pragma once

#include "mms/text/asked_keys.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/source_text.hpp"

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

namespace tvbeam {

/// A TOML document with the text it was read from, which places in strings need.
struct TomlDocument {
    std::string file;
    std::string text;
    toml::table table;
    LineIndex lines = {};
    AskedKeys* asked = nullptr; ///< where its readers note it; null: nowhere
};

/// Reads a file, its text alone, or a text that is said to be one. Throws InputError when it is
/// missing, too large or not TOML.
TomlDocument read_toml(const std::string& file);
std::string toml_text(const std::string& file);
TomlDocument parse_toml(std::string text, const std::string& file);

/// Replaces or adds the key `a.b.c` of the document; `assignment` is "a.b.c=value" with a TOML
/// value, or a text that is taken as a string when it is not one. A part in quotes may hold dots.
/// Where a.b is an array of tables, the key behind it is the number of one, from 0. Throws
/// InputError when it has no '=' or no key, or when a.b is not a table.
void override_key(TomlDocument& document, const std::string& assignment);

/// The finite number, or the text in quotes or as a bare word, that override_key makes of a value;
/// none where it is something else, or refused.
std::optional<double> override_number(const std::string& value);
std::optional<std::string> override_text(const std::string& value);

/// Takes the table at `key` away and puts its values in place of those of the same path.
void merge_block(TomlDocument& document, std::string_view key);

/// "a string", "a table", …
std::string type_name(const toml::node& node);

} // namespace tvbeam

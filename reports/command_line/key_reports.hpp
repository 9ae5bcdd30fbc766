#pragma once

#include "mms/text/key_table.hpp"

#include <string>

namespace tvbeam {

// A table of keys in the forms that people and editors read.

/// For a terminal: the keys whose path or meaning holds the word, whatever its case. Empty: none.
std::string keys_text(const KeyTable& keys, const std::string& word);

/// The paths that can be written as they stand, one a line: what --set takes.
std::string keys_names(const KeyTable& keys);

/// The manual page tvbeam-scene(5), for man (groff's macros, man(7)).
std::string keys_manual(const KeyTable& keys);

/// A JSON schema (draft 2020-12), by which editors complete and check scenes.
std::string keys_schema(const KeyTable& keys);

} // namespace tvbeam

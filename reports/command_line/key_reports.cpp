#include "reports/command_line/key_reports.hpp"

#include "reports/document/json_text.hpp"
#include "reports/document/text_table.hpp"

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

/// "one of 'euler', 'bdf2'", "a number".
std::string type_of(const KeyEntry& entry) {
    std::string text = words_of(entry.type);
    for (std::size_t i = 0; i < entry.words.size(); ++i)
        text += fmt::format("{} \"{}\"", i == 0 ? "" : ",", entry.words[i]);
    return text;
}

/// "a number, required", "a number; absent: 0".
std::string type_and_default(const KeyEntry& entry) {
    const bool needed = entry.otherwise.starts_with(KeyEntry::required);
    return type_of(entry) + (entry.otherwise.empty() ? ""
                             : needed                ? ", " + entry.otherwise
                                                     : "; absent: " + entry.otherwise);
}

/// As a scene writes it: a header for tables.
std::string written(const KeyEntry& entry) {
    return entry.type == KeyType::table    ? "[" + entry.path + "]"
           : entry.type == KeyType::tables ? "[[" + entry.path + "]]"
                                           : entry.path;
}

bool holds(const KeyEntry& entry, const std::string& word) {
    const auto lower = [](const std::string& text) {
        return boost::algorithm::to_lower_copy(text);
    };
    return lower(entry.path).find(lower(word)) != std::string::npos ||
           lower(entry.meaning).find(lower(word)) != std::string::npos;
}

/// Text that groff does not obey.
std::string roff(std::string text) {
    boost::algorithm::replace_all(text, "\\", "\\e");
    boost::algorithm::replace_all(text, "-", "\\-");
    if (text.starts_with('.') || text.starts_with('\''))
        text.insert(0, "\\&");
    return text;
}

Json list_of(const Json& items) {
    return {{"type", "array"}, {"items", items}};
}

Json band_schema() {
    Json band = list_of({{"type", "number"}});
    band["minItems"] = 2;
    band["maxItems"] = 2;
    return band;
}

/// What a value may be; tables aside.
Json value_schema(const KeyEntry& entry) {
    switch (entry.type) {
    case KeyType::text:
        return {{"type", "string"}};
    case KeyType::word:
        return {{"type", {"string", "number", "boolean"}}};
    case KeyType::expression:
        return {{"type", {"string", "number"}}};
    case KeyType::number:
        return {{"type", "number"}};
    case KeyType::integer:
        return {{"type", "integer"}};
    case KeyType::flag:
        return {{"type", "boolean"}};
    case KeyType::choice:
        return {{"enum", entry.words}};
    case KeyType::numbers:
        return list_of({{"type", "number"}});
    case KeyType::integers:
        return list_of({{"type", "integer"}});
    case KeyType::texts:
        return list_of({{"type", "string"}});
    case KeyType::words:
        return list_of({{"enum", entry.words}});
    case KeyType::band:
        return band_schema();
    case KeyType::bands:
        return {{"anyOf", {band_schema(), list_of(band_schema())}}};
    case KeyType::steps:
        return {{"anyOf", {list_of({{"type", "number"}}), Json{{"type", "string"}}}}};
    default:
        return {{"type", {"string", "object"}}, {"additionalProperties", {{"type", "string"}}}};
    }
}

Json node_schema(const KeyTable::Node& node, bool whole);

/// Of a table: its keys, and nothing else. whole: those that are required must be there; a table of
/// [short] replaces some.
Json table_schema(const KeyTable::Node& node, bool whole) {
    const KeyTable::Node& keys = node.like != nullptr ? *node.like : node;
    Json schema{{"type", "object"}};
    Json needed = Json::array();
    for (const auto& [name, inner] : keys.inner) {
        if (&inner == &node)
            continue; // it is not in itself
        schema["properties"][name] = node_schema(inner, whole && inner.entry->path != "short");
        if (inner.entry->otherwise == KeyEntry::required)
            needed.push_back(name);
    }
    if (whole && !needed.empty())
        schema["required"] = needed;
    schema["additionalProperties"] = keys.any ? node_schema(*keys.any, whole) : Json(false);
    return schema;
}

Json node_schema(const KeyTable::Node& node, bool whole) {
    const KeyEntry& entry = *node.entry;
    Json schema = entry.type == KeyType::table    ? table_schema(node, whole)
                  : entry.type == KeyType::tables ? list_of(table_schema(node, whole))
                                                  : value_schema(entry);
    schema["description"] =
        entry.meaning + (entry.otherwise.empty() ? "" : " (" + entry.otherwise + ")");
    return schema;
}

} // namespace

std::string keys_text(const KeyTable& keys, const std::string& word) {
    std::string text;
    for (const auto& entry : keys.entries())
        if (holds(entry, word))
            text += wrapped(written(entry) + ": " + type_and_default(entry), 8) + "    " +
                    wrapped(entry.meaning, 4, 76);
    return text;
}

std::string keys_names(const KeyTable& keys) {
    std::string text;
    for (const auto& entry : keys.entries())
        if (!entry.is_table() && entry.is_plain())
            text += entry.path + "\n";
    return text;
}

std::string keys_manual(const KeyTable& keys) {
    std::string text =
        R"(.TH TVBEAM\-SCENE 5 "" tvbeam "File formats"
.SH NAME
tvbeam\-scene \- what a scene of tvbeam may hold
.SH DESCRIPTION
A scene is a file in TOML that says what is run: a beam and its exact solution, or a program of your
own, and a block for each study. A study runs if its block is there, and nothing else does.
.PP
In the names of keys NORM, NAME and FIGURE stand for names that the scene gives. A key that is not
listed here is refused. Any of them can be set on the command line: \-\-set beam.alpha=0.5
.SH KEYS
)";
    for (const auto& entry : keys.entries())
        text += ".TP\n.B " + roff(written(entry)) + "\n" + roff(type_and_default(entry)) +
                "\n.br\n" + roff(entry.meaning) + "\n";
    return text + R"(.SH EXAMPLES
.nf
title    = "Two meshes"
solution = "copetti\-fernandez\-2011"

[beam]
alpha = 0.017
zeta  = 0.1
stops = [\-0.02, 0.1]

[ladder]
final_time = 2.0
elements   = [10, 20]
dt         = "0.01/s"
norms      = ["theta_L2L2"]
.fi
.PP
tvbeam list prints the scenes that come with the program, tvbeam list NAME one of them.
.SH SEE ALSO
.BR tvbeam (1),
.BR tvbeam\-run (1),
.BR tvbeam\-check (1)
)";
}

std::string keys_schema(const KeyTable& keys) {
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "A scene of tvbeam"}};
    schema.update(table_schema(keys.root(), true));
    return json_text(schema);
}

} // namespace tvbeam

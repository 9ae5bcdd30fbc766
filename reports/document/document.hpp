#pragma once

#include "reports/document/table.hpp"

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tvbeam {

/// A sentence or a few. indent: of its second and later lines, as for the next two.
struct Paragraph {
    std::string text;
    std::size_t indent = 2;
    bool introduces = false; ///< the caption of the table below says it where captions are shown
};

/// One point of a list.
struct Item {
    std::string text;
    std::size_t indent = 4;
};

/// What a study shows, in words. A terminal prints it where it stands; other formats gather the
/// findings at their head.
struct Finding {
    std::string text;
    std::size_t indent = 2;  ///< more than 2: a detail of the finding before
    bool on_terminal = true; ///< false where the table beside it says the same
};

/// Lines that are shown as they are, in letters of one width.
struct Preformatted {
    std::string lines;
};

/// A blank line of a terminal's text; other formats have spaces of their own.
struct BlankLine {};

using Block = std::variant<Paragraph, Item, Finding, Table, Preformatted, BlankLine>;

/// What one study has to say.
struct Section {
    std::string title; ///< terminals omit it
    std::vector<Block> blocks;
    std::vector<std::string> head = {}; ///< sentences for the head of the document
};

/// A result in words and tables, whatever it is written as.
struct Document {
    std::string title;
    std::vector<std::string> head; ///< what was run, a sentence each
    std::vector<Section> sections; ///< one a study
    std::vector<std::string> left_out;
    /// Terminals omit these: norms by name, in words; where the result comes from.
    std::vector<std::pair<std::string, std::string>> norms;
    std::vector<std::pair<std::string, std::string>> provenance;
};

/// The findings of all sections, in their order; a norm that one begins with in words, as in the
/// figures.
std::vector<Finding> findings_of(const Document& document);

} // namespace tvbeam

#pragma once

#include "mms/text/input_error.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What {NAME} stands for; none: nothing in this study, which says so.
using Placeholders = std::map<std::string, std::optional<std::string>>;

/// A text with placeholders, and where it stands: a word of a command, or a whole file.
///
/// {NAME} is a placeholder where NAME is letters, digits and _, no digit first; {{ is a brace, and
/// so is the }} that closes one; any other brace is itself, so that most sources of programs can be
/// templates as they are.
struct Template {
    std::string text;
    Place place;
    bool is_file = false; ///< places count lines; in a word all is at `place`

    /// Of a text in which something was filled in: as it was written, and where each piece of that
    /// begins in `text`, and in it.
    struct Piece {
        std::size_t begin, written_begin;
    };
    std::string written = {};
    std::vector<Piece> pieces = {};

    /// The text with all placeholders filled in. Throws InputError for a name that is not there, or
    /// has nothing to stand for.
    [[nodiscard]] std::string filled(const Placeholders& values) const;
};

/// Where a character of a template stands: in a file, in what was written there.
Place place_in(const Template& whole, std::size_t offset);

} // namespace tvbeam

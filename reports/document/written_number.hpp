#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A number as number_text.hpp writes it, in its parts: "-1.25e-3" is "-1", "25", "-3"; behind it
/// may stand a mark, as in "3.00*".
struct WrittenNumber {
    std::string whole;    ///< with its sign
    std::string fraction; ///< the digits behind the point; empty: none
    std::string exponent; ///< of ten, with its sign; empty: none
    std::string suffix;   ///< "*"; empty: none
};

/// None where the text is not just a number.
std::optional<WrittenNumber> written_number(const std::string& text);

/// A piece of a sentence: a number with an exponent, or other text.
struct TextPiece {
    std::string text;
    std::optional<WrittenNumber> number;
};

/// The text in pieces, which put together are the text.
std::vector<TextPiece> pieces_of(const std::string& text);

/// What the cells of a column need to stand with their points, and their exponents, below each
/// other.
struct NumberColumn {
    bool is_text = true;      ///< no cell begins with a number
    std::size_t fraction = 0; ///< the most digits behind the point
    std::size_t exponent = 0; ///< the most characters of an exponent
};

NumberColumn number_column(const std::vector<std::string>& cells);

} // namespace tvbeam

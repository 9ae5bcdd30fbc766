#pragma once

#include "mms/text/input_error.hpp"
#include "studies/external/read_figure.hpp"

#include <optional>
#include <regex>
#include <string>

namespace tvbeam {

/// A regular expression (ECMAScript, without back references) with one group, for lines of standard
/// output.
struct OutputPattern {
    std::string name; ///< of the number
    std::string text;
    std::regex regex;
    std::string literal; ///< that every match holds; may be empty

    /// Throws InputError where the text is none.
    OutputPattern(std::string name, std::string text, const Place& place);
};

/// Finds the number of a pattern in a stream of lines: the group of the last line that matches.
class OutputReading {
public:
    explicit OutputReading(const OutputPattern& pattern) : pattern_(&pattern) {}
    void take(const std::string& line);
    [[nodiscard]] ReadFigure figure() const;

private:
    const OutputPattern* pattern_;
    std::optional<std::string> found_;
    bool twice_ = false; ///< the last line that matches does so twice
    bool was_cut_ =
        false;            ///< the last line that matches, or a later one: OutputLines::longest_line
    std::string goes_on_; ///< the whole number, where the pattern takes only a part; or empty
    std::string thousands_;     ///< what follows it so; or empty
    std::string power_of_ten_;  ///< likewise, as a factor
    std::string begins_before_; ///< likewise, where it leaves its first part out
};

} // namespace tvbeam

/// How numbers are read of what a program wrote.
#pragma once

#include "mms/text/input_error.hpp"
#include "studies/data/printed_digits.hpp"

#include <filesystem>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace tvbeam {

/// A number that was read, or why there is none.
struct ReadFigure {
    std::optional<double> value; ///< finite
    std::string failure;         ///< e.g. "L2 is nan"
    PrintedDigits printed = {};
};

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

/// Where numbers are read by their names: on standard output, or in a file in the directory of the
/// run, an object of JSON or the last row of a CSV file with a header.
struct FigureSource {
    std::vector<OutputPattern> patterns = {};
    std::string file = {}; ///< *.json or *.csv; then any name may be in it

    [[nodiscard]] bool is_file() const { return !file.empty(); }
    [[nodiscard]] const OutputPattern* pattern(const std::string& name) const;
};

/// The number of a name in such a file.
ReadFigure figure_in(const std::filesystem::path& file, const std::string& name);

} // namespace tvbeam

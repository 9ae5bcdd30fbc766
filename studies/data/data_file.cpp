#include "studies/data/data_file.hpp"

#include "mms/text/characters.hpp"
#include "mms/text/file_text.hpp"
#include "mms/text/input_error.hpp"
#include "studies/data/data_columns.hpp"
#include "studies/data/field_number.hpp"
#include "studies/data/printed_digits.hpp"
#include "studies/data/row_factors.hpp"
#include "studies/orders/observed_order.hpp"
#include "studies/text/number_text.hpp"

#include <boost/algorithm/string/replace.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>

namespace tvbeam {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(blanks);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A field and where it stands in its line, from 1.
struct TextField {
    std::string_view text;
    int column = 1;
    bool quoted = false;
};

/// A whole file and the line that is read.
class Lines {
public:
    Lines(const std::string& file, std::string_view text) : file_(file), rest_(text) {}

    /// The next line; false at the end.
    bool next() {
        if (rest_.empty())
            return false;
        const auto end = std::min(rest_.find('\n'), rest_.size());
        line_ = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++number_;
        if (line_.find('\0') != std::string_view::npos)
            throw InputError(place(1), "is no text");
        return true;
    }
    std::string_view line() const { return line_; }
    Place place(int column = 0) const { return {file_, number_, column}; }

private:
    const std::string& file_;
    std::string_view rest_;
    std::string_view line_;
    int number_ = 0;
};

/// Whether a line is one of a table of Markdown's, with a bar at both ends.
bool is_between_bars(std::string_view line) {
    return line.size() > 1 && line.front() == '|' && line.back() == '|';
}

/// Whether it is that below the names: |---|:--:|.
bool is_rule(std::string_view line) {
    return is_between_bars(line) && line.find_first_not_of("|-: \t") == std::string_view::npos &&
           line.find('-') != std::string_view::npos;
}

/// A line without what stands in quotes, those that begin a field.
std::string without_quoted(std::string_view line) {
    std::string bare;
    bool is_quoted = false;
    char before = ' ';
    for (const char c : line) {
        const bool may_begin = std::string_view(" \t;,|\"").find(before) != std::string_view::npos;
        if (c == '"' && (is_quoted || may_begin))
            is_quoted = !is_quoted;
        else if (!is_quoted)
            bare += c;
        before = c;
    }
    return bare;
}

/// The separator that a line of names has; a blank stands for any run of blanks.
char separator_of(std::string_view names) {
    const std::string bare = without_quoted(names);
    for (const char separator : {'\t', ';', ','})
        if (bare.find(separator) != std::string::npos)
            return separator;
    return is_between_bars(names) ? '|' : ' ';
}

/// The fields of a line; in quotes, those of RFC 4180.
void split(const Lines& lines, std::string_view line, char separator,
           std::vector<TextField>& fields) {
    fields.clear();
    if (separator == '|' && is_between_bars(trimmed(line)))
        line = trimmed(line).substr(1, trimmed(line).size() - 2);
    const auto column = [&](std::size_t at) {
        return static_cast<int>(line.data() - lines.line().data()) + static_cast<int>(at) + 1;
    };
    std::size_t at = 0;
    while (true) {
        if (separator == ' ')
            at = std::min(line.find_first_not_of(blanks, at), line.size());
        if (separator == ' ' && at == line.size())
            return;
        std::size_t begin = std::min(line.find_first_not_of(" \r", at), line.size());
        std::size_t end = 0;
        if (begin < line.size() && line[begin] == '"') {
            end = line.find('"', ++begin);
            while (end != std::string_view::npos && end + 1 < line.size() && line[end + 1] == '"')
                end = line.find('"', end + 2);
            if (end == std::string_view::npos)
                throw InputError(lines.place(column(begin - 1)), "a quote is not closed");
            fields.push_back({line.substr(begin, end - begin), column(begin), true});
            at = end + 1;
            if (separator != ' ')
                at = std::min(line.find_first_not_of(" \r", at), line.size());
            const bool is_behind =
                at < line.size() &&
                (separator == ' ' ? blanks.find(line[at]) == std::string_view::npos
                                  : line[at] != separator);
            if (is_behind)
                throw InputError(lines.place(column(at)), "something stands behind a closed quote");
        } else {
            end = separator == ' ' ? line.find_first_of(blanks, at) : line.find(separator, at);
            end = std::min(end, line.size());
            fields.push_back({trimmed(line.substr(at, end - at)), column(std::min(begin, end))});
            at = end;
        }
        if (at >= line.size())
            return;
        ++at;
    }
}

bool is_missing(std::string_view text) {
    constexpr std::array<std::string_view, 7> words{"", "NA", "N/A", "-", "--", "null", "None"};
    return std::find(words.begin(), words.end(), text) != words.end();
}

/// The number in a field; NaN for one that is missing.
double checked_number(const Lines& lines, const TextField& field, char separator,
                      const std::string& name) {
    if (is_missing(field.text))
        return nan;
    const auto value = number_of(field.text, separator);
    if (!value)
        throw InputError(lines.place(field.column), "'" + std::string(field.text.substr(0, 40)) +
                                                        "' in column " + name + " is not a number");
    const bool names_infinity = field.text.find_first_of("nN") != std::string_view::npos;
    if (std::isinf(*value) && !names_infinity)
        throw InputError(lines.place(field.column), "'" + std::string(field.text.substr(0, 40)) +
                                                        "' in column " + name +
                                                        " is too large for a double");
    const std::string_view mantissa = field.text.substr(0, field.text.find_first_of("eEdDqQ"));
    if (*value == 0 && mantissa.find_first_of("123456789") != std::string_view::npos)
        throw InputError(lines.place(field.column), "'" + std::string(field.text.substr(0, 40)) +
                                                        "' in column " + name +
                                                        " is too small for a double");
    return *value;
}

/// Bytes; a record of ten figures has some two hundred.
constexpr std::size_t largest_table = 8 << 20;

std::string text_of(const std::string& file) {
    std::string text = file_text(file, largest_table);
    if (text.starts_with(byte_order_mark))
        text.erase(0, byte_order_mark.size());
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        throw InputError({file}, "is UTF-16; save it as UTF-8");
    return text;
}

/// Stops at the line of names: the first that is not a comment, or the comment above a line of
/// numbers.
struct Head {
    std::vector<std::string> names;
    Place place;
    char separator = ',';
    bool numbers_follow = false; ///< the line that is read is the first of the numbers
};

/// A quote in quotes is doubled.
std::vector<std::string> names_in(const std::vector<TextField>& fields) {
    std::vector<std::string> names;
    names.reserve(fields.size());
    for (const auto& field : fields) {
        names.emplace_back(field.text);
        if (field.quoted)
            boost::algorithm::replace_all(names.back(), "\"\"", "\"");
    }
    return names;
}

Head head_of(Lines& lines) {
    std::optional<std::pair<std::string_view, Place>> comment;
    std::vector<TextField> fields;
    while (lines.next()) {
        const auto line = trimmed(lines.line());
        if (line.empty())
            continue;
        if (line.starts_with('#') || line.starts_with('%')) {
            comment = {trimmed(line.substr(1)), lines.place(1)};
            continue;
        }
        Head head{{}, lines.place(1), separator_of(line)};
        // Fields at the ends may be empty, and tabs separate them.
        split(lines, head.separator == ' ' ? line : lines.line(), head.separator, fields);
        head.numbers_follow =
            std::all_of(fields.begin(), fields.end(), [&](const TextField& field) {
                return is_missing(field.text) || number_of(field.text, head.separator);
            });
        if (!head.numbers_follow) {
            head.names = names_in(fields);
            return head;
        }
        if (!comment)
            throw InputError(lines.place(1), "names no columns; the first line must, e.g. "
                                             "h,dt,error");
        head.place = comment->second;
        std::vector<TextField> named;
        Lines above(head.place.file, comment->first);
        above.next();
        split(above, above.line(), separator_of(comment->first), named);
        head.names = names_in(named);
        if (head.names.size() != fields.size())
            throw InputError(lines.place(1), "has " + std::to_string(fields.size()) +
                                                 " numbers; the comment above it names " +
                                                 std::to_string(head.names.size()) + " columns");
        return head;
    }
    throw InputError(lines.place(), "names no columns; a line above the numbers must, e.g. "
                                    "h,dt,error");
}

/// The fields of a line; false: it is empty, a comment, or the rule below the names.
bool split_record(const Lines& lines, const Head& head, std::vector<TextField>& fields) {
    const auto line = trimmed(lines.line());
    if (line.empty() || line.starts_with('#') || line.starts_with('%') ||
        (head.separator == '|' && is_rule(line)))
        return false;
    split(lines, head.separator == ' ' ? line : lines.line(), head.separator, fields);
    return true;
}

/// The columns in which no record has anything.
std::set<std::size_t> blank_columns(Lines lines, const Head& head) {
    std::set<std::size_t> blank;
    for (std::size_t i = 0; i < head.names.size(); ++i)
        blank.insert(i);
    std::vector<TextField> fields;
    for (bool more = head.numbers_follow || lines.next(); more && !blank.empty();
         more = lines.next())
        if (split_record(lines, head, fields))
            std::erase_if(blank, [&](std::size_t i) {
                return i >= fields.size() || !fields[i].text.empty();
            });
    return blank;
}

/// The first number with a decimal point and the first with a decimal comma: a file that has both
/// has a comma for thousands, and nobody can tell where.
class DecimalMark {
public:
    void look_at(const Lines& lines, const TextField& field, const std::string& name) {
        const bool has_comma = field.text.find(',') != std::string_view::npos;
        if (!has_comma && field.text.find('.') == std::string_view::npos)
            return;
        std::string& own = has_comma ? comma_ : point_;
        const std::string& other = has_comma ? point_ : comma_;
        if (own.empty())
            own = field.text;
        if (!other.empty())
            throw InputError(lines.place(field.column),
                             "'" + std::string(field.text) + "' in column " + name +
                                 " has a decimal " + (has_comma ? "comma" : "point") + ", and '" +
                                 other + "' before it a " + (has_comma ? "point" : "comma") +
                                 "; write all numbers alike, without separators of thousands");
    }

private:
    std::string point_;
    std::string comma_;
};

/// As of a number with a separator of thousands: 1.089, 1,089 or 1.089.000.
bool has_three_decimals(std::string_view text) {
    const auto mark = text.find_last_of(".,");
    constexpr std::size_t three = 3;
    return mark != std::string_view::npos && text.size() - mark - 1 == three &&
           text.find_first_of("eEdD", mark) == std::string_view::npos;
}

/// 289 and 1.089 of one count are 289 and 1089, by one who writes thousands so.
void require_no_thousands(const Lines& lines, const TextField& field, const std::string& name,
                          ColumnUse& use) {
    if (!use.is_width || use.power >= 0)
        return;
    if (has_three_decimals(field.text)) {
        if (!use.with_mark)
            use.with_mark = std::pair(lines.place(field.column), std::string(field.text));
    } else {
        use.has_plain = use.has_plain || field.text.find_first_of(".,") == std::string_view::npos;
    }
    if (use.has_plain && use.with_mark)
        throw InputError(use.with_mark->first,
                         "'" + use.with_mark->second + "' in column " + name +
                             " stands beside numbers without a mark: write thousands without a "
                             "separator, and means with more decimals, or fewer");
}

void read_record(const Lines& lines, const std::vector<TextField>& fields, const Head& head,
                 DecimalMark& mark, std::vector<ColumnUse>& uses) {
    bool found = false; // an error or a value; deviations come behind them
    for (auto& use : uses) {
        const TextField& field = fields[use.column];
        const std::string& name = head.names[use.column];
        const double number = checked_number(lines, field, head.separator, name);
        if (head.separator == ';')
            mark.look_at(lines, field, name);
        if (use.is_width && (!(number > 0) || !std::isfinite(number)))
            throw InputError(lines.place(field.column), "'" + std::string(field.text) +
                                                            "' in column " + name +
                                                            " must be a positive number");
        if (use.is_width && use.power < 0 && number < 1)
            throw InputError(lines.place(field.column),
                             "'" + std::string(field.text) + "' in column " + name +
                                 " counts nothing; it must be 1 or more; where it is a width, "
                                 "call the column h");
        if (name == "elements" && use.power < 0 && std::floor(number) != number)
            throw InputError(lines.place(field.column),
                             "'" + std::string(field.text) + "' in column " + name +
                                 " is no number of elements, which is whole; write thousands "
                                 "without a separator");
        require_no_thousands(lines, field, name, use);
        const double width = use.power == 1    ? number
                             : use.power == -1 ? 1 / number
                                               : std::pow(number, use.power);
        if (use.is_width && !is_positive(width))
            throw InputError(lines.place(field.column),
                             "'" + std::string(field.text) + "' in column " + name +
                                 " leaves no width: to the power " + shortest(use.power) +
                                 " it is too small for a double");
        auto& target = use.plain != nullptr ? *use.plain : use.target->numbers;
        target.push_back(width);
        if (use.plain == nullptr)
            use.target->missing.push_back(is_missing(field.text));
        use.printed.push_back(printed_digits(field.text));
        found = found || (use.is_figure() && std::isfinite(number));
        if (use.plain != nullptr && found && !(number > 0 && std::isfinite(number)))
            throw InputError(lines.place(field.column),
                             "'" + std::string(field.text) + "' in column " + name +
                                 " is no deviation; a row that has a number needs one > 0");
    }
}

/// What is known of figures goes by the squares of their deviations, and of errors by those of the
/// deviations over themselves.
void require_squares_of(const DataFile& data) {
    constexpr double least = 1e-100, greatest = 1e100;
    for (std::size_t i = 0; i < data.sigma.size(); ++i) {
        const double size = data.errors.empty() ? 1.0 : data.errors.front().numbers[i];
        const double deviation = data.sigma[i] / size;
        if (is_positive(size) && is_positive(data.sigma[i]) &&
            !(deviation >= least && deviation <= greatest))
            throw InputError({data.name},
                             "has a deviation of " + shortest(data.sigma[i]) + " in record " +
                                 std::to_string(i + 1) +
                                 (data.errors.empty()
                                      ? "; it must be from 1e-100 to 1e100"
                                      : "; it must be 1e-100 to 1e100 times the error"));
    }
}

/// Widths that differ by rounding are one, which nothing refines: 0.01 and 0.1*0.1. So are all of a
/// column that differ by so little that it refines nothing beside another that is different in each
/// row, as the mean steps of a solver that chooses them; this is said.
void unite_alike(DataColumn& column, DataFile& data) {
    constexpr double rounding = 1e-9;
    constexpr double little = 0.05;
    auto& widths = column.numbers;
    std::vector<double> sorted = widths;
    std::ranges::sort(sorted);
    const double range = sorted.back() / sorted.front() - 1.0;
    const auto is_another_a_row = [&](const DataColumn& other) {
        return &other != &column &&
               std::set(other.numbers.begin(), other.numbers.end()).size() == other.numbers.size();
    };
    if (range > rounding && range <= little && std::ranges::any_of(data.widths, is_another_a_row)) {
        const double one = sorted[sorted.size() / 2];
        data.remarks.push_back(fmt::format("{} changes by {:.1f} % and was taken for one width, {}",
                                           column.name, std::ceil(1e3 * range) / 10,
                                           shortest(one)));
        std::ranges::fill(widths, one);
        return;
    }
    for (double& width : widths)
        width = *std::ranges::lower_bound(sorted, width * (1.0 - rounding));
}

bool is_error(const DataFile& data, const ColumnUse& use) {
    return std::ranges::any_of(data.errors,
                               [&](const DataColumn& column) { return &column == use.target; });
}

} // namespace

DataFile read_data(const std::string& file, const DataChoice& choice) {
    DataFile data;
    data.name = file == "-" ? "standard input" : file;
    const std::string text = text_of(file);
    if (text.find_first_not_of(" \t\r\n") == std::string::npos)
        throw InputError({data.name},
                         "is empty; its first line must name the columns, e.g. h,dt,error");
    Lines lines(data.name, text);
    if (const char first = text[text.find_first_not_of(" \t\r\n")]; first == '{' || first == '[')
        throw InputError({data.name}, "is JSON; a table is asked for, whose first line names the "
                                      "columns, e.g. h,dt,error, and each other is a record");
    const Head head = head_of(lines);
    ColumnNames names{head.names, head.place};
    if (names.find("dt"))
        names.blank = blank_columns(lines, head);
    std::vector<ColumnUse> uses = choose_columns(names, choice, data);
    auto conditions = conditions_of(names, choice.where);
    auto unread = unread_columns(names, uses, conditions);
    DecimalMark mark;
    std::vector<TextField> fields;
    for (bool more = head.numbers_follow || lines.next(); more; more = lines.next()) {
        if (!split_record(lines, head, fields))
            continue;
        if (fields.size() != head.names.size())
            throw InputError(lines.place(1), "has " + std::to_string(fields.size()) +
                                                 (fields.size() == 1 ? " field" : " fields") +
                                                 "; the columns are " +
                                                 std::to_string(head.names.size()));
        // All of them: each remembers what it has seen.
        const bool is_chosen =
            std::ranges::count_if(conditions, [&](RowCondition& condition) {
                return condition.holds_for(fields[condition.column].text, head.separator);
            }) == std::ssize(conditions);
        if (!is_chosen)
            continue;
        read_record(lines, fields, head, mark, uses);
        for (auto& column : unread) {
            const auto text = fields[column.column].text;
            column.texts.push_back(is_missing(text) ? std::string_view() : text);
            column.numbers.push_back(number_of(text, head.separator));
        }
    }
    require_records(data, head.place, conditions);
    data.chosen = chosen_by(conditions, head.separator);
    for (const auto& use : uses)
        if (use.is_width && use.power == 1)
            use.target->units = printed_units_of_widths(use.target->numbers, use.printed);
    require_sizes_that_are_known(names, uses, data);
    for (auto& width : data.widths)
        unite_alike(width, data);
    require_one_series(data, head.place, unread);
    require_squares_of(data);
    for (const auto& use : uses)
        if (use.is_figure())
            use.target->units = is_error(data, use)
                                    ? printed_units_of_errors(use.target->numbers, use.printed)
                                    : printed_units(use.target->numbers, use.printed);
    return data;
}

} // namespace tvbeam

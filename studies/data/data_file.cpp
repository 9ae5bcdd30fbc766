#include "studies/data/data_file.hpp"

#include "mms/text/file_text.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/nearest_name.hpp"
#include "studies/data/printed_digits.hpp"
#include "studies/orders/observed_order.hpp"
#include "studies/text/number_text.hpp"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <system_error>
#include <tuple>

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

/// The separator that a line of names has; a blank stands for any run of blanks.
char separator_of(std::string_view names) {
    for (const char separator : {'\t', ';', ','})
        if (names.find(separator) != std::string_view::npos)
            return separator;
    return ' ';
}

/// The fields of a line; in quotes, those of RFC 4180.
void split(const Lines& lines, std::string_view line, char separator,
           std::vector<TextField>& fields) {
    fields.clear();
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

/// Reads all of a text as a number: also with a plus, a decimal comma where the separator leaves
/// it, or a Fortran exponent. None where it is not one.
std::optional<double> number_of(std::string_view text, char separator) {
    if (text.starts_with('+') && text.size() > 1 && text[1] != '-' && text[1] != '+')
        text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size())
        return value;
    constexpr std::size_t longest = 64;
    if (text.empty() || text.size() > longest ||
        text.find_first_not_of("0123456789+-.,eEdDqQ") != std::string_view::npos)
        return std::nullopt;
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool after_digit =
            i > 0 && std::string_view("0123456789.").find(text[i - 1]) != std::string_view::npos;
        if (c == ',' && separator == ';')
            plain += '.';
        else if (std::string_view("dDqQE").find(c) != std::string_view::npos)
            plain += 'e';
        else if ((c == '+' || c == '-') && after_digit)
            plain += std::string("e") + c; // 1.5-103
        else
            plain += c;
    }
    if (const auto plus = plain.find("e+"); plus != std::string::npos)
        plain.erase(plus + 1, 1);
    long double wide = 0;
    const auto [wide_end, wide_error] =
        std::from_chars(plain.data(), plain.data() + plain.size(), wide);
    if (wide_end != plain.data() + plain.size() || wide_error == std::errc::invalid_argument)
        return std::nullopt;
    if (wide_error == std::errc::result_out_of_range)
        return plain.find("e-") != std::string::npos ? 0.0 : std::numeric_limits<double>::max() * 2;
    return static_cast<double>(wide);
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

struct Names {
    std::vector<std::string> all;
    Place place;

    /// As it is written, or else in other cases of letters.
    std::optional<std::size_t> find(const std::string& name) const {
        for (const bool exactly : {true, false}) {
            const auto is_it = [&](const std::string& one) {
                return exactly ? one == name : boost::algorithm::iequals(one, name);
            };
            const auto at = std::find_if(all.begin(), all.end(), is_it);
            if (at == all.end())
                continue;
            if (std::find_if(at + 1, all.end(), is_it) != all.end())
                throw InputError(place, "names the column " + name + " twice; which is meant?");
            return static_cast<std::size_t>(at - all.begin());
        }
        return std::nullopt;
    }
    std::size_t need(const std::string& name, const std::string& option) const {
        if (const auto found = find(name))
            return *found;
        throw InputError(place, "no column '" + name + "'" + did_you_mean(name, all) + " among " +
                                    boost::algorithm::join(all, ", ") + "; choose one with " +
                                    option + " NAME, in a scene " + option.substr(2) +
                                    " = [\"NAME\"]");
    }
};

/// How a column is read.
struct Use {
    std::size_t column = 0;
    bool is_width = false;
    double power = 1; ///< the width is the number to this power
    DataColumn* target = nullptr;
    std::vector<double>* plain = nullptr;
    std::vector<PrintedDigits> printed = {}; ///< of an error or a value, one a record

    bool is_figure() const { return !is_width && plain == nullptr; }
};

bool is_among(std::initializer_list<const char*> names, const std::string& name) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* one) { return boost::algorithm::iequals(one, name); });
}

/// Names that counts of things go by; h = n^(-1/d) of them.
bool is_count(const std::string& name) {
    return is_among({"elements", "cells", "ndofs", "ndof", "dofs", "dof", "n", "nx", "nodes",
                     "nelem", "ncell", "ncells", "unknowns", "points", "size"},
                    name);
}

/// Names of widths, which no dimension turns into others.
bool is_width(const std::string& name) {
    return is_among({"h", "hx", "hy", "hz", "hmax", "hmin", "h_max", "h_min", "dx", "dy", "dz",
                     "width", "spacing"},
                    name);
}

/// Names of numbers of time steps; Δt = 1/n of them.
bool is_step_count(const std::string& name) {
    return is_among({"steps", "nsteps", "n_steps", "timesteps", "nt"}, name);
}

/// The widths that a choice names, or those that need no name.
void choose_widths(const Names& names, const DataChoice& choice, DataFile& data,
                   std::vector<Use>& uses) {
    std::vector<std::string> sizes = choice.sizes;
    if (sizes.empty())
        for (const char* name : {"h", "elements"})
            if (sizes.empty() && names.find(name))
                sizes.emplace_back(name);
    for (const auto& size : sizes) {
        Use use{names.need(size, "--size"), true};
        if (choice.dimension && is_width(size))
            throw InputError(names.place, "column " + size +
                                              " is a width already; --dimension is for numbers of "
                                              "cells or unknowns");
        const bool counts = choice.dimension || is_count(size);
        if (counts) {
            const double dimension = choice.dimension.value_or(1.0);
            use.power = -1.0 / dimension;
            data.remarks.push_back(
                "h = " +
                (dimension == 1.0 ? "1/" + size : size + "^(-1/" + shortest(dimension) + ")") +
                (choice.dimension || size == "elements"
                     ? ""
                     : ": dimension 1 was assumed; --dimension D says another"));
        }
        data.widths.push_back({counts ? (sizes.size() == 1 ? "h" : "h_" + size) : size, {}});
        uses.push_back(use);
    }
    const auto step =
        choice.step ? std::optional(names.need(*choice.step, "--step")) : names.find("dt");
    if (step && std::none_of(uses.begin(), uses.end(),
                             [&](const Use& use) { return use.column == *step; })) {
        const std::string name = choice.step.value_or("dt");
        const bool counts = is_step_count(name);
        if (counts)
            data.remarks.push_back("dt = 1/" + name + ": the time 1 was assumed");
        data.widths.push_back({counts ? "dt" : name, {}});
        uses.push_back({*step, true, counts ? -1.0 : 1.0});
    }
    if (uses.empty())
        throw InputError(names.place, "no column h, elements or dt among " +
                                          boost::algorithm::join(names.all, ", ") +
                                          "; say what was refined with --size NAME or --step NAME");
    for (std::size_t i = 0; i < uses.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (data.widths[i].name == data.widths[k].name)
                throw InputError(names.place, "two widths would be called " + data.widths[i].name +
                                                  ": those of the columns " +
                                                  names.all[uses[k].column] + " and " +
                                                  names.all[uses[i].column] +
                                                  "; give one of them another name");
    for (std::size_t i = 0; i < uses.size(); ++i)
        uses[i].target = &data.widths[i];
}

void choose_figures(const Names& names, const DataChoice& choice, DataFile& data,
                    std::vector<Use>& uses) {
    std::vector<std::string> errors = choice.errors;
    std::vector<std::string> values = choice.values;
    if (errors.empty() && values.empty()) {
        if (names.find("error"))
            errors.emplace_back("error");
        else if (names.find("value"))
            values.emplace_back("value");
        else
            names.need("error", "--error");
    }
    for (const auto& [chosen, columns, option] :
         {std::tuple(&errors, &data.errors, "--error"), {&values, &data.values, "--value"}}) {
        for (const auto& name : *chosen) {
            uses.push_back({names.need(name, option)});
            columns->push_back({name, {}});
        }
        const auto first = uses.size() - chosen->size();
        for (std::size_t i = 0; i < chosen->size(); ++i)
            uses[first + i].target = &(*columns)[i];
    }
    if (choice.sigma) {
        if (errors.size() + values.size() > 1)
            throw InputError(names.place, "--sigma is of one column; analyse the columns one by "
                                          "one, each with its own");
        uses.push_back({names.need(*choice.sigma, "--sigma")});
        uses.back().plain = &data.sigma;
    }
}

/// A figure is no width, no other figure and no deviation of itself.
void require_one_meaning_each(const Names& names, const std::vector<Use>& uses) {
    for (std::size_t i = 0; i < uses.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (uses[i].column == uses[k].column)
                throw InputError(names.place, "column " + names.all[uses[i].column] +
                                                  " is asked for twice: a column is a width, an "
                                                  "error, a value or a deviation, once");
}

/// Whether an error is less where the number is the greatest than where it is the least, of the
/// rows that have one.
bool falls_with(const DataColumn& errors, const std::vector<double>& numbers) {
    std::optional<std::size_t> coarsest;
    std::optional<std::size_t> finest;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!std::isfinite(errors.numbers[i]))
            continue;
        coarsest = !coarsest || numbers[i] < numbers[*coarsest] ? i : *coarsest;
        finest = !finest || numbers[i] > numbers[*finest] ? i : *finest;
    }
    return coarsest && numbers[*coarsest] < numbers[*finest] &&
           errors.numbers[*finest] < errors.numbers[*coarsest];
}

/// Sizes by a name that is not known count something where all are whole and from 2 on, and errors
/// fall as they grow. Of values nobody can tell: they stay what they were taken for, which is said.
void take_whole_sizes_for_counts(const DataChoice& choice, DataFile& data) {
    const auto named = [&](const std::string& name) {
        return std::ranges::find_if(data.widths, [&](const auto& one) { return one.name == name; });
    };
    for (const auto& size : choice.sizes) {
        const auto width = named(size);
        if (width == data.widths.end() || is_width(size) ||
            !std::ranges::all_of(width->numbers, [](double number) {
                return number >= 2.0 && std::floor(number) == number;
            }))
            continue;
        if (data.errors.empty())
            data.remarks.push_back(size + " was taken for a width; --dimension D says that it "
                                          "counts what fills a domain");
        if (std::ranges::none_of(data.errors, [&](const DataColumn& errors) {
                return falls_with(errors, width->numbers);
            }))
            continue;
        for (double& number : width->numbers)
            number = 1.0 / number;
        const std::string name = choice.sizes.size() == 1 ? "h" : "h_" + size;
        if (named(name) == data.widths.end())
            width->name = name;
        data.remarks.push_back(width->name + " = 1/" + size +
                               ", as its numbers are whole: dimension 1 was assumed; --dimension D "
                               "says another, a name as h or dx that they are widths");
    }
}

/// Bytes; a record of ten figures has some two hundred.
constexpr std::size_t largest_table = 8 << 20;

std::string text_of(const std::string& file) {
    std::string text = file_text(file, largest_table);
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
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
        if (line.find('\0') != std::string_view::npos)
            throw InputError(lines.place(1), "is no text");
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

void read_record(const Lines& lines, const std::vector<TextField>& fields, const Head& head,
                 std::vector<Use>& uses) {
    bool found = false; // an error or a value; deviations come behind them
    for (auto& use : uses) {
        const TextField& field = fields[use.column];
        const std::string& name = head.names[use.column];
        const double number = checked_number(lines, field, head.separator, name);
        if (use.is_width && (!(number > 0) || !std::isfinite(number)))
            throw InputError(lines.place(field.column), "'" + std::string(field.text) +
                                                            "' in column " + name +
                                                            " must be a positive number");
        if (use.is_width && use.power < 0 && number < 1)
            throw InputError(lines.place(field.column),
                             "'" + std::string(field.text) + "' in column " + name +
                                 " counts nothing; it must be 1 or more");
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
        if (use.is_figure())
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

} // namespace

DataFile read_data(const std::string& file, const DataChoice& choice) {
    DataFile data;
    data.name = file == "-" ? "standard input" : file;
    const std::string text = text_of(file);
    if (text.find_first_not_of(" \t\r\n") == std::string::npos)
        throw InputError({data.name},
                         "is empty; its first line must name the columns, e.g. h,dt,error");
    Lines lines(data.name, text);
    const Head head = head_of(lines);
    const Names names{head.names, head.place};
    std::vector<Use> uses;
    choose_widths(names, choice, data, uses);
    choose_figures(names, choice, data, uses);
    require_one_meaning_each(names, uses);
    std::vector<TextField> fields;
    for (bool more = head.numbers_follow || lines.next(); more; more = lines.next()) {
        const auto line = trimmed(lines.line());
        if (line.empty() || line.starts_with('#') || line.starts_with('%'))
            continue;
        split(lines, head.separator == ' ' ? line : lines.line(), head.separator, fields);
        if (fields.size() != head.names.size())
            throw InputError(lines.place(1), "has " + std::to_string(fields.size()) +
                                                 (fields.size() == 1 ? " field" : " fields") +
                                                 "; the columns are " +
                                                 std::to_string(head.names.size()));
        read_record(lines, fields, head, uses);
    }
    if (data.widths.front().numbers.empty())
        throw InputError({data.name}, "has no records below its line of names");
    take_whole_sizes_for_counts(choice, data);
    require_squares_of(data);
    for (const auto& use : uses)
        if (use.is_figure())
            use.target->units = printed_units(use.target->numbers, use.printed);
    return data;
}

} // namespace tvbeam

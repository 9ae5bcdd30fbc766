#include "studies/external/output_pattern.hpp"

#include "studies/external/output.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

namespace tvbeam {

namespace {

/// The end of a class [...] or of a group (...) that begins there, past its last character.
std::size_t end_of_part(const std::string& pattern, std::size_t at) {
    int depth = 0;
    bool in_class = false;
    for (; at < pattern.size(); ++at) {
        const char letter = pattern[at];
        if (letter == '\\')
            ++at;
        else if (in_class && letter == '[' && at + 1 < pattern.size() &&
                 std::string_view(":.=").find(pattern[at + 1]) != std::string_view::npos) {
            // As [:space:], whose bracket ends no class.
            const std::size_t end = pattern.find(std::string{pattern[at + 1], ']'}, at + 2);
            if (end == std::string::npos)
                return pattern.size();
            at = end + 1;
        } else if (in_class)
            in_class = letter != ']';
        else if (letter == '[')
            in_class = true;
        else if (letter == '(')
            ++depth;
        else if (letter == ')')
            --depth;
        if (depth == 0 && !in_class)
            return at + 1;
    }
    return pattern.size();
}

/// What every match holds: the longest row of characters that stand for themselves, outside of
/// groups. Most lines have not got it, and to look for it takes a thousandth of a search.
std::string literal_within(const std::string& pattern) {
    if (pattern.find('|') != std::string::npos)
        return {};
    std::string longest;
    std::string row;
    const auto end_row = [&] {
        if (row.size() > longest.size())
            longest = row;
        row.clear();
    };
    for (std::size_t at = 0; at < pattern.size();) {
        const char letter = pattern[at];
        if (letter == '[' || letter == '(') {
            end_row();
            at = end_of_part(pattern, at);
            continue;
        }
        const bool has_more = at + 1 < pattern.size();
        const bool is_escaped = letter == '\\' && has_more &&
                                std::ispunct(static_cast<unsigned char>(pattern[at + 1])) != 0;
        if (is_escaped)
            row += pattern[++at];
        else if (std::string_view("*?{").find(letter) != std::string_view::npos) {
            if (!row.empty())
                row.pop_back(); // it may be absent
            end_row();
            if (letter == '{')
                at = std::min(pattern.find('}', at), pattern.size());
        } else if (letter == '\\') {
            end_row();
            ++at;
            if (has_more && std::string_view("xucXUC").find(pattern[at]) != std::string_view::npos)
                return longest; // digits or a letter belong to it
        } else if (std::string_view("^$.+)]}").find(letter) != std::string_view::npos)
            end_row();
        else
            row += letter;
        ++at;
    }
    end_row();
    return longest;
}

/// What a pattern names on either side of its group: the row of characters that stand for
/// themselves, and of digits, next to it.
struct NamedBeside {
    std::string before;
    std::string behind;
    bool is_counted_off = false; ///< as .{11} before the group
    bool counts_itself = false;  ///< as (.{11})
};

/// Whether an atom of a pattern names what it takes: a character that stands for itself, also in
/// brackets, a digit, a sign.
bool names_what_it_takes(const std::string& atom) {
    static const std::set<std::string> classes{"\\d", "[0-9]", "[[:digit:]]", "[-+]", "[+-]"};
    if (atom.size() == 1)
        return std::string_view(".^$|()").find(atom) == std::string_view::npos;
    const bool is_escaped = atom.size() == 2 && atom[0] == '\\' &&
                            std::ispunct(static_cast<unsigned char>(atom[1])) != 0;
    const bool is_class_of_one = atom.size() == 3 && atom[0] == '[' && atom[1] != '^';
    return is_escaped || is_class_of_one || classes.contains(atom);
}

/// The end of *, +, ? or {…}, with the ? that may follow.
std::size_t end_of_repetition(const std::string& pattern, std::size_t at) {
    if (at < pattern.size() && std::string_view("*+?").find(pattern[at]) != std::string_view::npos)
        ++at;
    else if (at < pattern.size() && pattern[at] == '{')
        at = std::min(pattern.find('}', at), pattern.size() - 1) + 1;
    else
        return at;
    return at < pattern.size() && pattern[at] == '?' ? at + 1 : at;
}

/// What is counted off is one atom so many times, as (.{11}); blanks are among what it takes, or it
/// would be a part of a number as well.
bool counts_off(const std::string& group) {
    static const std::regex counted(R"(^\((?:\.|\[[^\]]* [^\]]*\])\{\d+\}\)$)");
    return std::regex_match(group, counted);
}

/// Whether a group (?:…) that begins there is there in every match, as it is written.
bool is_certain(const std::string& pattern, std::size_t begin) {
    const std::size_t end = end_of_part(pattern, begin);
    return pattern.substr(begin, end - begin).find('|') == std::string::npos &&
           end_of_repetition(pattern, end) == end;
}

NamedBeside named_beside_the_group(const std::string& pattern) {
    static const std::regex so_many(R"(^\{\d+\})");
    NamedBeside named;
    bool is_behind = false;
    bool has_choice = false;
    for (std::size_t at = 0; at < pattern.size();) {
        const std::size_t begin = at;
        const bool is_group = pattern[at] == '(' && pattern.substr(at + 1, 1) != "?";
        at = pattern[at] == '\\'                 ? std::min(at + 2, pattern.size())
             : pattern[at] == '[' || is_group    ? end_of_part(pattern, at)
             : pattern.compare(at, 2, "(?") == 0 ? std::min(at + 3, pattern.size())
                                                 : at + 1;
        const std::string atom = pattern.substr(begin, at - begin);
        const std::size_t repetition = at;
        at = end_of_repetition(pattern, at);
        if (is_group) {
            named.counts_itself = counts_off(atom);
            is_behind = true;
            continue;
        }
        if (atom == ")" && has_choice)
            named.before.clear(); // which of them it took is not known
        has_choice = atom == "|" || (has_choice && atom != ")");
        // What stands in a group counts, but behind the number not what may be absent.
        if (atom == ")" || (atom == "(?:" && (!is_behind || is_certain(pattern, begin))))
            continue;
        // Behind the group also one of a few, as [dh]; before it [-=] may take a minus unmeant.
        const bool is_one_of_few =
            is_behind && atom.starts_with('[') && !atom.starts_with("[^") && at == repetition;
        const bool may_be_absent =
            std::string_view("?*{").find(pattern.substr(repetition, 1)) != std::string_view::npos &&
            at > repetition;
        if (is_behind && may_be_absent)
            break;
        if (is_one_of_few || names_what_it_takes(atom))
            (is_behind ? named.behind : named.before) += pattern.substr(begin, at - begin);
        else if (is_behind)
            break;
        else {
            named.before.clear();
            named.is_counted_off = std::regex_search(pattern.substr(repetition), so_many);
        }
    }
    return named;
}

/// Whether a part of a pattern takes a character or more at the end, or the begin, of the text.
bool takes_some(const std::string& part, const std::string& text, bool at_end) {
    std::smatch match;
    const std::regex own(at_end ? "(?:" + part + ")$" : "^(?:" + part + ")",
                         std::regex_constants::ECMAScript | std::regex_constants::__polynomial);
    return !part.empty() && std::regex_search(text, match, own) && match.length() > 0;
}

constexpr std::size_t longest_number = 40;

/// What stands behind the group's number and belongs to it, digits or an exponent, and is not
/// named by the pattern; or empty.
std::string rest_behind(const std::string& pattern, const std::string& number,
                        const std::string& behind) {
    static const std::regex rest(R"(^(\d|\.\d|\.?[eEdD][+-]?\d))");
    static const std::regex exponent_of_three(
        R"(^[+-]\d{3}(?![\d.ijIJ]))"); // Fortran's, as 0.12-100
    const bool ends_as_one =
        !number.empty() &&
        (std::isdigit(static_cast<unsigned char>(number.back())) != 0 || number.back() == '.');
    const bool goes_on =
        ends_as_one &&
        (std::regex_search(behind, rest) ||
         (number.find('.') != std::string::npos && std::regex_search(behind, exponent_of_three)));
    const NamedBeside named = goes_on ? named_beside_the_group(pattern) : NamedBeside();
    // What is counted off, as (.{11}), is meant so.
    if (!goes_on || named.counts_itself || takes_some(named.behind, behind, false))
        return {};
    return behind.substr(0, behind.find_first_of(" \t\r"));
}

/// A factor of a power of ten behind the group's number, " x 10^-3"; or empty.
std::string power_of_ten_behind(const std::string& pattern, const std::string& number,
                                const std::string& behind) {
    static const std::regex power("^ ?(x|X|\\*|\u00d7|\u00b7|\u22c5) ?10 ?((\\^|\\*\\*) "
                                  "?[-+({]?\\d|\u207b|\u00b9|\u00b2|\u00b3|\u2074|"
                                  "\u2075|\u2076|\u2077|\u2078|\u2079)[^ \t]*");
    std::smatch match;
    const bool ends_as_one =
        !number.empty() && std::isdigit(static_cast<unsigned char>(number.back())) != 0;
    if (!ends_as_one || !std::regex_search(behind, match, power) ||
        takes_some(named_beside_the_group(pattern).behind, behind, false))
        return {};
    return match.str();
}

/// What follows the group's number as thousands do, ",234.5" behind 1, or as decimals behind a
/// comma, ",5e-3", outside of a list or brackets, and is not named by the pattern; or empty.
std::string thousands_behind(const std::string& pattern, const std::string& number,
                             const std::string& before, const std::string& behind) {
    static const std::regex begins(R"(^[-+]?[1-9]\d{0,2}$)");
    static const std::regex thousands("^((,|'|_|\u2019|\u00a0|\u2009|\u202f)\\d{3})+(\\.\\d+)?(?!["
                                      "\\d,\\])}A-Za-z_]|\\.[A-Za-z])");
    static const std::regex whole(R"(^[-+]?\d+$)");
    static const std::regex decimals(R"(^,\d+([eEdD][-+]?\d+)?(?!\d|,\d|\.\d|[eEdD][-+]?\d))");
    std::smatch match;
    const bool is_in_list =
        !before.empty() && std::string_view(",;([{").find(before.back()) != std::string_view::npos;
    const bool is_in_name =
        !before.empty() &&
        (before.back() == '_' || std::isalpha(static_cast<unsigned char>(before.back())) != 0);
    const bool follows =
        (std::regex_match(number, begins) && std::regex_search(behind, match, thousands)) ||
        (std::regex_match(number, whole) && std::regex_search(behind, match, decimals));
    if (is_in_list || is_in_name || !follows ||
        takes_some(named_beside_the_group(pattern).behind, behind, false))
        return {};
    return match.str();
}

/// What stands before the group's number and belongs to it, digits, a point or a minus, and is not
/// named by the pattern; or empty.
std::string begin_before(const std::string& pattern, const std::string& number,
                         const std::string& before) {
    static const std::regex one(R"(^[-+]?(\d+\.?\d*|\.\d+)([eEdD][-+]?\d+)?$)");
    if (!std::regex_match(number, one))
        return {};
    // A hyphen or a dot behind a letter, or behind another, leads to a number.
    const auto begins_behind = [&](std::size_t size) {
        const char last = size == before.size() ? ' ' : before[before.size() - size - 1];
        return std::isalnum(static_cast<unsigned char>(last)) == 0 &&
               std::string_view("-._)]").find(last) == std::string_view::npos;
    };
    constexpr std::string_view minus_sign = "\u2212";
    std::string belongs;
    if (before.ends_with(minus_sign) && begins_behind(minus_sign.size()))
        belongs = minus_sign;
    for (std::size_t size = 1; size <= std::min(before.size(), longest_number); ++size) {
        const std::string front = before.substr(before.size() - size);
        const bool counts =
            front.find_first_of("0123456789") != std::string::npos ||
            (begins_behind(size) && (front == "-" || front == "." || front == "-."));
        if (counts && std::regex_match(front + number, one))
            belongs = front;
    }
    if (belongs.empty())
        return {};
    const NamedBeside named = named_beside_the_group(pattern);
    const std::size_t tail =
        before.size() - std::min(before.size(), pattern.size() + longest_number);
    return named.is_counted_off || takes_some(named.before, before.substr(tail), true)
               ? std::string()
               : belongs;
}

/// A count of that many digits, as of {4} or \1, is beyond what the library reads it into.
bool has_long_number(const std::string& pattern) {
    constexpr int most_digits = 9;
    int digits = 0;
    return std::ranges::any_of(pattern, [&](unsigned char letter) {
        digits = std::isdigit(letter) != 0 ? digits + 1 : 0;
        return digits > most_digits;
    });
}

} // namespace

OutputPattern::OutputPattern(std::string its_name, std::string its_text, const Place& place)
    : name(std::move(its_name)), text(std::move(its_text)), literal(literal_within(text)) {
    if (has_long_number(text))
        throw InputError(place, "'" + text +
                                    "' has a number of more than 9 digits; write the "
                                    "digits that vary as \\d+");
    try {
        // Its time is no more than that of the line times that of the pattern, and it needs no
        // stack for a long line.
        regex =
            std::regex(text, std::regex_constants::ECMAScript | std::regex_constants::__polynomial);
    } catch (const std::regex_error& error) {
        throw InputError(place, "'" + text + "' is no regular expression: " + error.what());
    }
    if (regex.mark_count() != 1)
        throw InputError(place, "'" + text + "' has " + std::to_string(regex.mark_count()) +
                                    " groups; it must have one, the number: 'L2 error = (\\S+)'; "
                                    "a group that is none is written (?:…)");
}

void OutputReading::take(const std::string& line) {
    const bool is_cut = line.size() == OutputLines::longest_line;
    was_cut_ = was_cut_ || is_cut; // and may have the number further on
    if (line.find(pattern_->literal) == std::string::npos)
        return;
    std::sregex_iterator match(line.begin(), line.end(), pattern_->regex);
    if (match == std::sregex_iterator())
        return;
    found_ = (*match)[1].str();
    const std::string behind = (*match)[1].second == line.end()
                                   ? std::string()
                                   : std::string((*match)[1].second, line.end());
    const std::string rest = rest_behind(pattern_->text, *found_, behind);
    goes_on_ = rest.empty() ? rest : *found_ + rest;
    const std::string before(line.begin(), (*match)[1].first);
    thousands_ = thousands_behind(pattern_->text, *found_, before, behind);
    power_of_ten_ = power_of_ten_behind(pattern_->text, *found_, behind);
    const std::string begin = begin_before(pattern_->text, *found_, before);
    begins_before_ = begin.empty() ? begin : begin + *found_;
    was_cut_ = is_cut;
    twice_ = ++match != std::sregex_iterator();
}

ReadFigure OutputReading::figure() const {
    const std::string of = "nothing on standard output matches '" + pattern_->text + "'";
    const std::string cut = "only the first MiB is read";
    if (!found_)
        return {{}, "no " + pattern_->name + ": " + of + (was_cut_ ? "; " + cut : "")};
    if (was_cut_)
        return {{}, "of the last line with " + pattern_->name + ", or one behind it, " + cut};
    if (twice_)
        return {{}, "the last line with " + pattern_->name + " has two of them"};
    if (!goes_on_.empty())
        return {{},
                "of " + goes_on_ + ", " + pattern_->name + " would be " + *found_ + ": '" +
                    pattern_->text + "' ends within the number; (\\S+) takes it whole"};
    if (!power_of_ten_.empty())
        return {{},
                "'" + power_of_ten_ + "' follows " + pattern_->name + " = " + *found_ +
                    ": print its exponent as in 1.5e-3"};
    if (!thousands_.empty())
        return {{},
                "'" + thousands_ + "' follows " + pattern_->name + " = " + *found_ +
                    ": print it without separators" +
                    (thousands_.starts_with(',') ? " and with a decimal point" : "") +
                    ", or, where another number begins there, put what parts them behind the "
                    "group"};
    if (!begins_before_.empty())
        return {{},
                "of " + begins_before_ + ", " + pattern_->name + " would be " + *found_ + ": '" +
                    pattern_->text +
                    "' begins within the number; a space or an = before the group keeps it whole"};
    return figure_of(pattern_->name, *found_);
}

} // namespace tvbeam

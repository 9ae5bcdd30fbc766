#include "studies/data/csv_records.hpp"

#include "mms/text/error_text.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/nearest_name.hpp"

#include <boost/algorithm/string/trim.hpp>
#include <boost/tokenizer.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <string_view>
#include <system_error>

namespace tvbeam {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The fields of a line; quotes are those of RFC 4180, in which "" stands for ".
std::vector<std::string> fields_of(const std::string& line, const Place& place) {
    using Separator = boost::escaped_list_separator<char>;
    try {
        // Without an escape character "" closes and opens again, which leaves the fields of numbers
        // as they are.
        const boost::tokenizer<Separator> tokens(line, Separator("", ",", "\""));
        std::vector<std::string> fields(tokens.begin(), tokens.end());
        for (auto& field : fields)
            boost::algorithm::trim(field);
        return fields;
    } catch (const boost::escaped_list_error& error) {
        throw InputError(place, std::string("not CSV: ") + error.what());
    }
}

struct Columns {
    std::optional<std::size_t> h;
    std::optional<std::size_t> elements;
    std::optional<std::size_t> dt;
    std::optional<std::size_t> seconds;
    std::size_t error = 0; ///< or the value's
    bool has_errors = true;
    std::size_t count = 0;
};

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const auto& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

Columns columns_of(const std::vector<std::string>& names,
                   const std::optional<std::string>& error_column, const Place& place) {
    const auto find = [&](const std::string& name) -> std::optional<std::size_t> {
        const auto at = std::find(names.begin(), names.end(), name);
        if (at == names.end())
            return std::nullopt;
        if (std::find(at + 1, names.end(), name) != names.end())
            throw InputError(place, "names the column " + name + " twice; which is meant?");
        return static_cast<std::size_t>(at - names.begin());
    };
    if (names.size() == 1 && names[0].find_first_of(";\t") != std::string::npos)
        throw InputError(place, "'" + names[0] + "' is one field; fields are separated by commas");
    Columns columns{find("h"), find("elements"), find("dt"), find("seconds"), 0,
                    true,      names.size()};
    if (!columns.h && !columns.elements && !columns.dt)
        throw InputError(place, "no column h, elements or dt among " + listed(names) +
                                    "; name what was refined in the first line");
    const std::string wanted = error_column.value_or("error");
    auto error = find(wanted);
    if (!error && !error_column) {
        error = find("value");
        columns.has_errors = !error;
    }
    if (!error)
        throw InputError(place, "no column '" + wanted + "'" + did_you_mean(wanted, names) +
                                    " among " + listed(names) +
                                    "; choose the error's with --error NAME");
    columns.error = *error;
    return columns;
}

/// The number in a field; NaN for an empty one.
double number(const std::string& field, const Place& place, const std::string& name) {
    if (field.empty())
        return std::numeric_limits<double>::quiet_NaN();
    // from_chars takes a minus alone.
    const bool plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
    const char* const last = field.data() + field.size();
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data() + (plus ? 1 : 0), last, value);
    if (error == std::errc::result_out_of_range && end == last) {
        // from_chars does not say at which end of the range; long double reaches far beyond both.
        long double wide = 0.0L;
        const auto beyond = std::from_chars(field.data() + (plus ? 1 : 0), last, wide).ec;
        if (beyond == std::errc() ? std::abs(wide) < 1.0L
                                  : field.find_first_of("eE") + 1 == field.find('-', 1))
            return 0.0;
        throw InputError(place, "'" + field + "' in column " + name + " is too large for a double");
    }
    if (error != std::errc() || end != last)
        throw InputError(place, "'" + field + "' in column " + name + " is not a number");
    return value;
}

/// The values over the width that was refined: h, or dt where h stays.
std::vector<GridValue> values_of(const std::vector<Refinement>& records,
                                 const std::vector<double>& values, const std::string& file) {
    const bool in_dt = std::all_of(records.begin(), records.end(), [&](const Refinement& record) {
        return std::isnan(record.h) || (record.h == records[0].h && !std::isnan(record.dt));
    });
    std::vector<GridValue> result;
    std::map<double, double> other; // the width that goes with it
    for (std::size_t i = 0; i < records.size(); ++i) {
        const auto& [h, dt, error, seconds, uncertainty] = records[i];
        const double width = in_dt ? dt : h;
        result.push_back({width, values[i]});
        if (!other.emplace(width, in_dt || std::isnan(dt) ? 0.0 : dt).second)
            throw InputError({file}, "has two values at " + std::string(in_dt ? "dt" : "h") +
                                         " = " + number_text(width) +
                                         "; a limit is found from one value a width");
    }
    if (!std::is_sorted(other.begin(), other.end(),
                        [](const auto& a, const auto& b) { return a.second < b.second; }))
        throw InputError({file},
                         "refines h and makes dt coarser; a limit is found along one way of "
                         "refinement");
    return result;
}

} // namespace

RecordFile read_records(const std::string& file, const std::optional<std::string>& error_column) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
        throw InputError({file}, "cannot be read; check the path and its permissions");
    int number_of_line = 0;
    std::string line;
    const auto next_line = [&] {
        while (std::getline(stream, line)) {
            if (++number_of_line == 1 && line.starts_with(byte_order_mark))
                line.erase(0, byte_order_mark.size());
            if (!line.starts_with('#') && !boost::algorithm::trim_copy(line).empty())
                return true;
        }
        return false;
    };
    if (!next_line())
        throw InputError({file},
                         "is empty; its first line must name the columns, e.g. h,dt,error,seconds");
    const std::vector<std::string> names = fields_of(line, {file, number_of_line});
    const Columns columns = columns_of(names, error_column, {file, number_of_line});

    RecordFile result;
    std::vector<double> values;
    while (next_line()) {
        const Place place{file, number_of_line};
        const auto fields = fields_of(line, place);
        if (fields.size() != columns.count)
            throw InputError(place, "has " + std::to_string(fields.size()) +
                                        " fields; the first line names " +
                                        std::to_string(columns.count));
        const auto value = [&](std::size_t column) {
            return number(fields[column], place, names[column]);
        };
        const auto width = [&](std::size_t column) {
            const double w = value(column);
            if (!(w > 0.0) || !std::isfinite(w))
                throw InputError(place, "'" + fields[column] + "' in column " + names[column] +
                                            " must be a positive number");
            return w;
        };
        Refinement record;
        if (columns.h)
            record.h = width(*columns.h);
        else if (columns.elements)
            record.h = 1.0 / width(*columns.elements);
        if (columns.dt)
            record.dt = width(*columns.dt);
        if (columns.seconds)
            record.seconds = value(*columns.seconds);
        if (columns.has_errors)
            record.error = value(columns.error);
        else
            values.push_back(value(columns.error));
        result.records.push_back(record);
    }
    if (result.records.empty())
        throw InputError({file}, "has no records below its first line");
    if (!columns.has_errors)
        result.values = values_of(result.records, values, file);
    return result;
}

} // namespace tvbeam

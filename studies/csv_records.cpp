#include "studies/csv_records.hpp"

#include "mms/input_error.hpp"
#include "mms/nearest_name.hpp"

#include <boost/algorithm/string/trim.hpp>
#include <boost/tokenizer.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace tvbeam {

namespace {

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
    std::size_t error = 0;
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
        return at == names.end() ? std::nullopt
                                 : std::optional(static_cast<std::size_t>(at - names.begin()));
    };
    Columns columns{find("h"), find("elements"), find("dt"), find("seconds"), 0, names.size()};
    if (!columns.h && !columns.elements && !columns.dt)
        throw InputError(place, "no column h, elements or dt among " + listed(names) +
                                    "; name what was refined in the first line");
    const std::string wanted = error_column.value_or("error");
    const auto error = find(wanted);
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
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size())
        throw InputError(place, "'" + field + "' in column " + name + " is not a number");
    return value;
}

} // namespace

std::vector<Refinement> read_records(const std::string& file,
                                     const std::optional<std::string>& error_column) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
        throw InputError({file}, "cannot be read; check the path and its permissions");
    std::string line;
    if (!std::getline(stream, line))
        throw InputError({file},
                         "is empty; its first line must name the columns, e.g. h,dt,error,seconds");
    const std::vector<std::string> names = fields_of(line, {file, 1});
    const Columns columns = columns_of(names, error_column, {file, 1});

    std::vector<Refinement> records;
    for (int number_of_line = 2; std::getline(stream, line); ++number_of_line) {
        if (boost::algorithm::trim_copy(line).empty())
            continue;
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
        record.error = value(columns.error);
        records.push_back(record);
    }
    if (records.empty())
        throw InputError({file}, "has no records below its first line");
    return records;
}

} // namespace tvbeam

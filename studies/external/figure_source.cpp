#include "studies/external/figure_source.hpp"

#include "mms/text/characters.hpp"
#include "mms/text/visible_text.hpp"
#include "studies/external/output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <utility>

namespace tvbeam {

namespace {

constexpr std::size_t largest_json = std::size_t{16} << 20U;
constexpr int deepest_json = 32;

/// Finds the number of a name in the outermost object, as it is written.
class FigureSearch : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit FigureSearch(std::string name) : name_(std::move(name)) {}

    bool null() override { return seen("null"); }
    bool boolean(bool value) override { return seen(value ? "true" : "false"); }
    bool number_integer(number_integer_t value) override { return number(std::to_string(value)); }
    bool number_unsigned(number_unsigned_t value) override { return number(std::to_string(value)); }
    bool number_float(number_float_t /*value*/, const string_t& text) override {
        return number(text);
    }
    bool string(string_t& value) override { return seen("\"" + value + "\""); }
    bool binary(binary_t& /*value*/) override { return seen("binary"); }
    bool key(string_t& value) override {
        is_wanted_ = depth_ == 1 && value == name_;
        times_ += is_wanted_ ? 1 : 0;
        return true;
    }
    bool start_object(std::size_t /*count*/) override {
        is_object_ = is_object_ || depth_ == 0;
        return deeper("{…}");
    }
    bool start_array(std::size_t /*count*/) override { return deeper("[…]"); }
    bool end_object() override { return --depth_ >= 0; }
    bool end_array() override { return --depth_ >= 0; }
    bool parse_error(std::size_t /*at*/, const std::string& /*token*/,
                     const nlohmann::json::exception& error) override {
        constexpr int number_overflow = 406;
        failure_ = (error.id == number_overflow ? "it holds a number beyond the range of doubles: "
                                                : "it is not JSON: ") +
                   std::string(error.what());
        return false;
    }

    [[nodiscard]] ReadFigure figure() const {
        if (!failure_.empty())
            return {{}, failure_};
        if (!is_object_)
            return {{}, "it is not an object, as {\"" + name_ + "\": 1.2e-3}"};
        if (times_ == 0)
            return {{}, "it has no " + name_};
        if (times_ > 1)
            return {{}, "it has " + name_ + " more than once; which is meant?"};
        constexpr std::size_t longest_shown = 40;
        return is_number_ ? figure_of(name_, text_)
                          : ReadFigure{{},
                                       fmt::format("{} is {}", name_,
                                                   whole_characters(text_, longest_shown)) +
                                           ", which is not one number"};
    }

private:
    bool seen(const std::string& text) {
        if (is_wanted_) {
            text_ = text;
            is_number_ = false;
        }
        is_wanted_ = false;
        return true;
    }
    bool number(const std::string& text) {
        const bool wanted = is_wanted_;
        seen(text);
        is_number_ = is_number_ || wanted;
        return true;
    }
    bool deeper(const std::string& text) {
        seen(text);
        if (depth_++ > deepest_json)
            failure_ = "it is not JSON: it is nested too deep";
        return failure_.empty();
    }

    std::string name_;
    std::string text_; ///< of the value
    std::string failure_;
    int depth_ = 0;
    int times_ = 0; ///< that the name stands there
    bool is_object_ = false;
    bool is_wanted_ = false; ///< the value that comes next
    bool is_number_ = false;
};

ReadFigure figure_in_json(const std::filesystem::path& file, const std::string& name) {
    std::ifstream stream(file);
    FigureSearch search(name);
    nlohmann::json::sax_parse(stream, &search);
    return search.figure();
}

std::vector<std::string> fields_of(const std::string& line, char separator) {
    std::vector<std::string> fields(1);
    for (const char c : line)
        if (c == separator || (separator == ' ' && c == '\t'))
            fields.emplace_back();
        else
            fields.back() += c;
    for (auto& field : fields) {
        field = without_blanks(field);
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
            field = field.substr(1, field.size() - 2);
    }
    if (separator == ' ')
        std::erase(fields, "");
    return fields;
}

/// Lines of # or % are comments; the last before the first row is the header where numbers follow.
ReadFigure figure_in_csv(const std::filesystem::path& file, const std::string& name) {
    std::string header;
    std::string last;
    std::string comment;
    OutputLines lines([&](const std::string& line) {
        const std::string text = without_blanks(line);
        if (text.empty())
            return;
        const bool is_comment = text.front() == '#' || text.front() == '%';
        if (is_comment)
            comment = header.empty() ? text.substr(1) : comment;
        else if (header.empty() && !comment.empty() &&
                 std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos)
            header = std::exchange(comment, {});
        if (!is_comment)
            (header.empty() ? header : last) = line;
    });
    std::ifstream stream(file, std::ios::binary);
    std::array<char, 65536> buffer{};
    for (bool begins = true; stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0;
         begins = false) {
        std::string_view chunk(buffer.data(), static_cast<std::size_t>(stream.gcount()));
        if (begins && chunk.starts_with(byte_order_mark))
            chunk.remove_prefix(byte_order_mark.size());
        lines.take(chunk);
    }
    lines.finish();
    if (last.empty())
        return {{}, "it has no row below its header"};
    if (std::max(header.size(), last.size()) == OutputLines::longest_line)
        return {{}, "it has lines of more than 1 MiB"};
    const char separator = header.find(',') != std::string::npos   ? ','
                           : header.find(';') != std::string::npos ? ';'
                                                                   : ' ';
    const auto names = fields_of(header, separator);
    const auto row = fields_of(last, separator);
    const auto column = std::find(names.begin(), names.end(), name);
    if (column == names.end())
        return {{}, "its header has no " + name};
    if (std::count(names.begin(), names.end(), name) > 1)
        return {{}, "its header names " + name + " more than once; which is meant?"};
    if (row.size() != names.size())
        return {{},
                "its last row has " + std::to_string(row.size()) +
                    (row.size() == 1 ? " field" : " fields") + " and its header " +
                    std::to_string(names.size())};
    return figure_of(name, row[static_cast<std::size_t>(column - names.begin())]);
}

} // namespace

const OutputPattern* FigureSource::pattern(const std::string& name) const {
    const auto found =
        std::find_if(patterns.begin(), patterns.end(),
                     [&](const OutputPattern& pattern) { return pattern.name == name; });
    return found == patterns.end() ? nullptr : &*found;
}

ReadFigure figure_in(const std::filesystem::path& file, const std::string& name) {
    const std::string shown = file.filename().string();
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        return {{}, "no " + name + ": it wrote no file " + shown};
    if (file.extension() == ".json" && std::filesystem::file_size(file, error) > largest_json)
        return {{}, shown + " has more than 16 MiB"};
    ReadFigure figure =
        file.extension() == ".json" ? figure_in_json(file, name) : figure_in_csv(file, name);
    if (!figure.failure.empty())
        figure.failure.insert(0, shown + ": ");
    return figure;
}

} // namespace tvbeam

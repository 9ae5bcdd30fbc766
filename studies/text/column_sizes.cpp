#include "studies/text/column_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

/// How large a number is, by decades; of those that rounding makes, next to nothing.
double size_of(double number) {
    constexpr double of_rounding = 1e-6;
    return (number < 0.0 ? 0.7 : 1.0) * std::log1p(std::abs(number) / of_rounding);
}

/// From 1 to 2, of no two alike: none stands for another.
double weight_of(std::size_t place) {
    constexpr double golden_ratio = 0.6180339887498949;
    const double part = golden_ratio * static_cast<double>(place);
    return 1.0 + part - std::floor(part);
}

/// A mean by these weights.
class WeightedMean {
public:
    void add(double value) {
        const double weight = weight_of(count_++);
        sum_ += weight * value;
        weights_ += weight;
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] double value() const { return sum_ / weights_; }

private:
    std::size_t count_ = 0;
    double sum_ = 0.0, weights_ = 0.0;
};

std::string_view without_blanks(std::string_view field) {
    constexpr std::string_view blanks = " \t\r";
    const auto first = std::min(field.find_first_not_of(blanks), field.size());
    return field.substr(first, field.find_last_not_of(blanks) + 1 - first);
}

class ColumnSizes {
public:
    void add(std::string_view line) {
        const char between = line.find(',') == std::string_view::npos ? ' ' : ',';
        bool has_numbers = false;
        std::size_t column = 0;
        for (std::size_t at = 0; at <= line.size();) {
            const std::size_t end = std::min(line.find(between, at), line.size());
            const std::string_view field = without_blanks(line.substr(at, end - at));
            at = end + 1;
            if (field.empty() && between == ' ')
                continue;
            const std::size_t place = column++;
            double number = 0.0;
            const char* const last = field.data() + field.size();
            const auto ended = std::from_chars(field.data(), last, number);
            if (field == "seconds" || field == "sec")
                left_out_.insert(place);
            else if (field.find("seconds") != std::string_view::npos)
                has_times_ = true;
            if (ended.ec != std::errc() || ended.ptr != last || !std::isfinite(number))
                continue;
            has_numbers = true;
            columns_.resize(std::max(columns_.size(), column));
            columns_[place].of_block.add(size_of(number));
        }
        if (!has_numbers)
            end_block();
    }

    [[nodiscard]] std::string text() {
        end_block();
        std::string text;
        for (std::size_t k = 0; k < columns_.size() && !has_times_; ++k)
            if (!left_out_.contains(k) && columns_[k].of_all.count() > 0)
                text += fmt::format(" {:.3f}", 1.0 + columns_[k].of_all.value());
        return text;
    }

private:
    struct Column {
        WeightedMean of_block, of_all;
    };

    void end_block() {
        for (auto& [of_block, of_all] : columns_)
            if (of_block.count() > 0)
                of_all.add(std::exchange(of_block, {}).value());
    }

    std::vector<Column> columns_;
    std::set<std::size_t> left_out_;
    bool has_times_ = false;
};

} // namespace

std::string column_sizes(std::string_view text) {
    ColumnSizes sizes;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        sizes.add(text.substr(at, end - at));
        at = end + 1;
    }
    return sizes.text();
}

} // namespace tvbeam

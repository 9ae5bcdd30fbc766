#include "reports/plots/plot_style.hpp"

#include "mms/text/visible_text.hpp"
#include "studies/text/number_text.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace tvbeam {

namespace {

std::vector<double> sorted(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

std::vector<std::string> fractions(const std::vector<double>& values) {
    std::vector<std::string> texts;
    texts.reserve(values.size());
    for (const double value : values)
        texts.push_back(fmt::format("1/{}", std::llround(1.0 / value)));
    return texts;
}

bool is_fraction(double value) {
    const double of = std::round(1.0 / value);
    return of >= 1.0 && of < 1e6 && std::abs(of * value - 1.0) < 1e-12;
}

/// Of ascending ones: as they are, where all are short; as fractions; or else in three digits, or
/// as many as tell them apart.
std::vector<std::string> short_texts(const std::vector<double>& values) {
    constexpr std::size_t longest = 8;
    auto whole = alike(values);
    if (std::ranges::all_of(whole, [](const auto& text) { return text.size() <= longest; }))
        return whole;
    if (std::ranges::all_of(values, is_fraction))
        return fractions(values);
    for (int decimals = 2;; ++decimals) {
        std::vector<double> rounded;
        rounded.reserve(values.size());
        for (const double value : values)
            rounded.push_back(number_in(fmt::format("{:.{}e}", value, decimals)));
        constexpr int most = 16;
        if (decimals == most || std::ranges::adjacent_find(rounded) == rounded.end())
            return alike(rounded);
    }
}

std::vector<Tick> labelled(std::vector<double> values, std::size_t most,
                           std::vector<std::string> (*texts_of)(const std::vector<double>&)) {
    std::vector<Tick> ticks;
    for (const double value : sorted(std::move(values)))
        ticks.push_back({value, ""});
    ticks = thinned(ticks, most);
    std::vector<double> places;
    places.reserve(ticks.size());
    for (const auto& tick : ticks)
        places.push_back(tick.value);
    const auto texts = texts_of(places);
    for (std::size_t i = 0; i < ticks.size(); ++i)
        ticks[i].text = texts[i];
    return ticks;
}

} // namespace

SeriesStyle series_style(std::size_t series) {
    static const std::array<const char*, 7> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                    "#E69F00", "#56B4E9", "#000000"};
    // Filled ones, then the same open.
    static const std::array<int, 13> points{7, 5, 9, 11, 13, 15, 3, 4, 6, 8, 10, 12, 14};
    static const std::array<int, 5> dashes{1, 2, 4, 5, 3};
    // 7, 13 and 5 have no common factor: the first 455 differ.
    return {colours.at(series % colours.size()), points.at(series % points.size()),
            dashes.at(series % dashes.size())};
}

std::string gnuplot_text(const std::string& text) {
    std::string quoted = "'";
    for (const char c : visible(text)) {
        // In an SVG, gnuplot puts the text in a section that ends at the first "]]>".
        if (c == '>' && quoted.ends_with("]]"))
            quoted += ' ';
        quoted += c == '\'' ? std::string("''") : std::string(1, c == '\n' || c == '\t' ? ' ' : c);
    }
    return quoted + "'";
}

std::string gnuplot_title(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (std::string_view("\\{}^_@&~").find(c) != std::string_view::npos)
            escaped += '\\';
        escaped += c;
    }
    return gnuplot_text(boost::algorithm::replace_all_copy(escaped, "L∞", "L^{∞}"));
}

std::vector<Tick> thinned(const std::vector<Tick>& ticks, std::size_t most) {
    if (ticks.empty())
        return {};
    const double span = std::log(ticks.back().value / ticks.front().value);
    const double apart = span / (static_cast<double>(most) - 0.5) * (1.0 - 1e-9);
    std::vector<Tick> left{ticks.front()};
    for (const auto& tick : ticks)
        if (std::log(tick.value / left.back().value) >= apart && tick.value > left.back().value)
            left.push_back(tick);
    return left;
}

std::vector<Tick> width_ticks(std::vector<double> widths, std::size_t most) {
    return labelled(std::move(widths), most, fractions);
}

std::vector<Tick> value_ticks(std::vector<double> values, std::size_t most) {
    return labelled(std::move(values), most, short_texts);
}

bool is_drawable(double number, bool on_logarithmic_axis) {
    constexpr double greatest = 1e300;
    return std::abs(number) <= greatest && (!on_logarithmic_axis || number >= 1.0 / greatest);
}

std::pair<double, double> range_of(const std::vector<double>& values, double room) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    return {*least / room, *greatest * room};
}

std::vector<std::string> shades() {
    return {"#7AD151", "#22A884", "#2A788E", "#414487", "#440154"};
}

} // namespace tvbeam

#include "reports/plots/readable_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

constexpr std::size_t most_series = 12;
constexpr std::size_t named_series = 8;

bool is_series(const CurveLook& look) {
    using Kind = CurveLook::Kind;
    return look.kind == Kind::points || look.kind == Kind::lines_and_points ||
           look.kind == Kind::bars;
}

bool alike(const CurveLook& a, const CurveLook& b) {
    return a.colour == b.colour && a.point == b.point && a.dash == b.dash;
}

/// From 0 to 1 along the shades.
std::string shade_at(double part) {
    const auto all = shades();
    const double place = part * static_cast<double>(all.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(place), all.size() - 2);
    std::string colour = "#";
    for (const std::size_t at : {1U, 3U, 5U}) {
        const int low = std::stoi(all[before].substr(at, 2), nullptr, 16);
        const int high = std::stoi(all[before + 1].substr(at, 2), nullptr, 16);
        colour +=
            fmt::format("{:02X}", static_cast<int>(std::lround(
                                      low + (place - static_cast<double>(before)) * (high - low))));
    }
    return colour;
}

} // namespace

Drawing with_readable_legend(const Drawing& drawing) {
    std::vector<CurveLook> series;
    for (const auto& curve : drawing.curves())
        if (curve.title && is_series(curve.look))
            series.push_back(curve.look);
    if (series.size() <= most_series)
        return drawing;
    const auto last = series.size() - 1;
    const auto is_named = [last](std::size_t k) {
        // Evenly, the first and the last among them.
        const auto place = [last](std::size_t i) { return i * last / (named_series - 1); };
        for (std::size_t i = 0; i < named_series; ++i)
            if (place(i) == k)
                return true;
        return false;
    };
    Drawing readable = drawing;
    for (auto& curve : readable.curves()) {
        const auto found = std::find_if(series.begin(), series.end(), [&](const CurveLook& look) {
            return alike(look, curve.look);
        });
        if (found == series.end()) // with the lines that are fitted to a series
            continue;
        const auto k = static_cast<std::size_t>(found - series.begin());
        curve.look.colour = shade_at(static_cast<double>(k) / static_cast<double>(last));
        curve.look.point = 7;
        curve.look.size = 0.4;
        curve.look.dash = 1;
        curve.look.width = 1.0;
        if (curve.title && !is_named(k))
            curve.title.reset();
        else if (curve.title && k == last)
            *curve.title +=
                fmt::format(" (and {} more between these)", series.size() - named_series);
    }
    return readable;
}

} // namespace tvbeam

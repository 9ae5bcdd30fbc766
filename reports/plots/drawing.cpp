#include "reports/plots/drawing.hpp"

#include <cmath>

namespace tvbeam {

CurveLook look_of(const SeriesStyle& style, CurveLook::Kind kind) {
    return {.kind = kind, .colour = style.colour, .point = style.point, .dash = style.dash};
}

std::size_t Drawing::add_block(const std::string& heading, const std::string& rows) {
    blocks_.push_back({heading, rows});
    return blocks_.size() - 1;
}

void Drawing::add_curve(const CurveData& data, const CurveLook& look,
                        const std::optional<std::string>& title) {
    curves_.push_back({data, look, title});
}

void Drawing::add_heights(const std::vector<double>& heights, const std::string& title) {
    bool titled = false;
    for (const double height : heights) {
        if (!std::isfinite(height))
            continue;
        add_curve({.height = height}, {.colour = "#555555", .dash = 3, .width = 1.2},
                  titled ? std::nullopt : std::optional(title));
        titled = true;
    }
}

PictureBox Drawing::fix_axes() {
    axes_are_fixed_ = true;
    return frame;
}

} // namespace tvbeam

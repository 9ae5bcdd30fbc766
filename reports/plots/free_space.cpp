#include "reports/plots/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tvbeam {

namespace {

/// In pixels: how far what is put in stays from what is there, and how finely places are tried.
constexpr double apart = 5.0;
constexpr double step = 4.0;

} // namespace

void FreeSpace::occupy(const PicturePoint& place, double radius) {
    discs_.push_back({place, radius});
}

void FreeSpace::occupy(const PicturePoint& from, const PicturePoint& to) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / step)));
    for (int i = 0; i <= pieces; ++i)
        occupy({from.x + (to.x - from.x) * i / pieces, from.y + (to.y - from.y) * i / pieces}, 1.0);
}

bool FreeSpace::is_free(const PictureBox& box) const {
    const bool over_disc = std::any_of(discs_.begin(), discs_.end(), [&](const Disc& disc) {
        const double x = std::clamp(disc.middle.x, box.left, box.right);
        const double y = std::clamp(disc.middle.y, box.top, box.bottom);
        return std::hypot(disc.middle.x - x, disc.middle.y - y) < disc.radius + apart;
    });
    return !over_disc && std::none_of(boxes_.begin(), boxes_.end(), [&](const PictureBox& other) {
        return box.left < other.right + apart && other.left < box.right + apart &&
               box.top < other.bottom + apart && other.top < box.bottom + apart;
    });
}

std::optional<PictureBox> FreeSpace::find(double width, double height,
                                          const PicturePoint& near) const {
    std::optional<PictureBox> best;
    double least = std::numeric_limits<double>::infinity();
    const int columns = static_cast<int>((frame_.right - frame_.left - width - apart) / step);
    const int rows = static_cast<int>((frame_.bottom - frame_.top - height - apart) / step);
    for (int column = 0; column <= columns; ++column)
        for (int row = 0; row <= rows; ++row) {
            const double left = frame_.left + apart + step * column;
            const double top = frame_.top + step * row;
            const double distance =
                std::hypot(left + width / 2.0 - near.x, top + height / 2.0 - near.y);
            const PictureBox box{left, top, left + width, top + height};
            if (distance < least && is_free(box)) {
                least = distance;
                best = box;
            }
        }
    return best;
}

} // namespace tvbeam

#pragma once

#include <optional>
#include <vector>

namespace tvbeam {

/// A place in a picture, in its pixels: x to the right, y down.
struct PicturePoint {
    double x = 0.0;
    double y = 0.0;
};

struct PictureBox {
    double left = 0.0;
    double top = 0.0;
    double right = 0.0;
    double bottom = 0.0;
};

/// What of a picture is free: triangles and labels are put where nothing else is.
class FreeSpace {
public:
    explicit FreeSpace(const PictureBox& frame) : frame_(frame) {}

    /// A marker, as large as a disc of that radius; a line between two places.
    void occupy(const PicturePoint& place, double radius);
    void occupy(const PicturePoint& from, const PicturePoint& to);
    void occupy(const PictureBox& box) { boxes_.push_back(box); }

    /// The free box of a size whose middle is nearest to a place; none where there is none.
    [[nodiscard]] std::optional<PictureBox> find(double width, double height,
                                                 const PicturePoint& near) const;

private:
    struct Disc {
        PicturePoint middle;
        double radius;
    };

    [[nodiscard]] bool is_free(const PictureBox& box) const;

    PictureBox frame_;
    std::vector<Disc> discs_;
    std::vector<PictureBox> boxes_;
};

} // namespace tvbeam

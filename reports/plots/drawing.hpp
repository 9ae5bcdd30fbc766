#pragma once

#include "reports/plots/free_space.hpp"
#include "reports/plots/plot.hpp"

#include <cstddef>
#include <string>

namespace tvbeam {

/// A figure as it is put together: blocks of data, and the curves drawn over them, in order.
class Drawing {
public:
    /// Rows of columns below a heading. Returns what a curve reads them by: "data index N".
    std::string add_block(const std::string& heading, const std::string& rows);

    /// A curve as gnuplot's plot takes it, e.g. "data index 0 using 1:2 with lines"; without a
    /// line in the legend, or with one. A title is taken as it stands, whatever it holds.
    void add_curve(const std::string& curve);
    void add_curve(const std::string& curve, const std::string& title);

    /// Keeps the axes where they stand, whatever their ticks take: there, in pixels.
    PictureBox fix_axes();

    [[nodiscard]] bool is_empty() const { return curves_.empty(); }

    /// The figure. settings: the lines of its script before `plot`. The legend stands below the
    /// axes, where it covers nothing, and the picture is made higher by as much.
    [[nodiscard]] Plot plot(const std::string& name, const std::string& caption,
                            const std::string& settings) const;

private:
    std::string data_;
    std::size_t blocks_ = 0;
    std::string curves_;
    bool axes_are_fixed_ = false;
    std::size_t legend_ = 0;        ///< its lines
    std::size_t longest_title_ = 0; ///< of them, in characters
};

} // namespace tvbeam

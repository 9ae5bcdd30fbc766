#include "reports/plots/drawing.hpp"
#include "reports/plots/free_space.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace tvbeam {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool all_equal(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [&](double value) {
        return std::abs(value - values.front()) <= 1e-6 * std::abs(values.front());
    });
}

/// The widths of a ladder, and which of them is refined.
struct LadderWidths {
    explicit LadderWidths(const LadderResult& ladder) {
        for (const auto& rung : ladder.rungs) {
            h.push_back(rung.rung.h());
            dt.push_back(rung.rung.step());
        }
        has_mesh = !std::isnan(h.front());
        has_steps = !std::isnan(dt.front());
        in_time = !has_mesh || (has_steps && all_equal(h) && !all_equal(dt));
    }

    [[nodiscard]] const std::vector<double>& abscissa() const { return in_time ? dt : h; }

    /// Says what becomes of the other width.
    [[nodiscard]] std::string axis_title() const {
        if (!has_mesh)
            return "time step Δt";
        if (!has_steps)
            return "mesh width h";
        if (in_time)
            return fmt::format("time step Δt   (h = 1/{})", std::llround(1.0 / h.front()));
        const std::string title = "mesh width h   (";
        if (all_equal(dt))
            return title + "Δt = " + shortest(dt.front()) + ")";
        for (const auto& [power, name] : {std::pair{1, "h"}, {2, "h²"}}) {
            std::vector<double> ratios;
            for (std::size_t i = 0; i < h.size(); ++i)
                ratios.push_back(dt[i] / std::pow(h[i], power));
            if (all_equal(ratios))
                return fmt::format("{}and Δt = {:.4g} {} with it)", title, ratios.front(), name);
        }
        return fmt::format("{}and Δt with it, from {} to {})", title, shortest(dt.front()),
                           shortest(dt.back()));
    }

    std::vector<double> h;
    std::vector<double> dt;
    bool has_mesh = true;
    bool has_steps = true;
    bool in_time = false;
};

/// That can be drawn.
std::optional<double> positive_error(const RungResult& rung, std::size_t k) {
    return !rung.errors.empty() && is_drawable(rung.errors[k], true) ? std::optional(rung.errors[k])
                                                                     : std::nullopt;
}

/// The order of the rows of a ladder that agree; none where none do: what is not determined is not
/// said.
std::optional<double> order_of(const LadderResult& ladder, std::size_t k) {
    const auto rows = judge(records_of(ladder.rungs, k)).window;
    return rows ? std::optional(rows->order) : std::nullopt;
}

/// The axes of the figure: a rectangle in its picture, and the powers of ten that it shows.
struct LogAxes {
    PictureBox frame;
    double left, right, low, high; ///< decimal logarithms

    [[nodiscard]] double decade_x() const { return (frame.right - frame.left) / (right - left); }
    [[nodiscard]] double decade_y() const { return (frame.bottom - frame.top) / (high - low); }
    [[nodiscard]] PicturePoint at(double width, double error) const {
        return {frame.left + (std::log10(width) - left) * decade_x(),
                frame.bottom - (std::log10(error) - low) * decade_y()};
    }
    [[nodiscard]] double width_at(double x) const {
        return std::pow(10.0, left + (x - frame.left) / decade_x());
    }
    [[nodiscard]] double error_at(double y) const {
        return std::pow(10.0, low + (frame.bottom - y) / decade_y());
    }
};

/// Of a label of that many characters, in pixels.
constexpr double label_height = 18.0;
constexpr double label_width(std::size_t characters) {
    constexpr double character = 12.5;
    return character * static_cast<double>(characters);
}

const CurveLook predicted_look{.dash = 3, .width = 1.2};

CurveLook printed_look(double size) {
    return {.kind = CurveLook::Kind::points, .point = 4, .size = size, .width = 1.3};
}

class ConvergencePlot {
public:
    ConvergencePlot(const LadderResult& ladder, const LadderBlock& block)
        : ladder_(ladder), block_(block), widths_(ladder) {}

    /// None where no error can stand on a logarithmic axis.
    std::vector<Plot> plots() {
        for (std::size_t k = 0; k < ladder_.norms.size(); ++k)
            for (const auto& rung : ladder_.rungs)
                if (const auto error = positive_error(rung, k))
                    errors_.push_back(*error);
        if (errors_.empty())
            return {};
        const auto [least, greatest] = std::minmax_element(errors_.begin(), errors_.end());
        for (std::size_t k = 0; k < ladder_.norms.size(); ++k)
            add_norm(k);
        add_legend_of_marks();
        const auto slopes = reference_slopes();
        // Where there is no room for a slope, the axis of errors is made longer below.
        constexpr int longest = 8;
        for (int more = 0; more <= longest; ++more) {
            const LogAxes axes = axes_with(*least, *greatest, more);
            if (place(slopes, axes) || more == longest) {
                set_axes(axes);
                return {{"convergence", caption(slopes), drawing_}};
            }
        }
        return {};
    }

private:
    [[nodiscard]] const std::vector<double>* printed(std::size_t k) const {
        if (!block_.printed)
            return nullptr;
        const auto found = block_.printed->figures.find(ladder_.norms[k].norm.name);
        return found == block_.printed->figures.end() ? nullptr : &found->second;
    }

    void add_norm(std::size_t k) {
        const LadderNorm& norm = ladder_.norms[k];
        add_points(k, norm);
        std::string name = norm.norm.words;
        // The axis says it.
        if (const std::string square = ", squared"; squares() && name.ends_with(square))
            name.resize(name.size() - square.size());
        if (const auto order = order_of(ladder_, k))
            name += ": slope " + fixed(*order, 2);
        drawing_.add_curve({}, look_of(series_style(k)), name);
    }

    /// Every norm's, where all are squares.
    [[nodiscard]] bool squares() const {
        return std::all_of(ladder_.norms.begin(), ladder_.norms.end(),
                           [](const auto& norm) { return norm.norm.squared; });
    }

    void add_points(std::size_t k, const LadderNorm& norm) {
        const auto* figures = printed(k);
        std::string rows;
        for (std::size_t i = 0; i < ladder_.rungs.size(); ++i)
            rows += fmt::format("{} {} {} {} {}\n", widths_.h[i], widths_.dt[i],
                                positive_error(ladder_.rungs[i], k).value_or(nan),
                                figures != nullptr ? (*figures)[i] : nan,
                                norm.predictions.empty() ? nan : norm.predictions[i].value);
        const std::size_t block =
            drawing_.add_block(norm.norm.name + ": h, dt, error, printed, predicted", rows);
        const int x = widths_.in_time ? 2 : 1;
        if (norm.predictions.size() > 1) { // one point makes no line
            drawing_.add_curve({.block = block, .x = x, .y = 5}, predicted_look);
            predicted_ = true;
        }
        drawing_.add_curve({.block = block, .x = x, .y = 3}, look_of(series_style(k)));
        if (figures != nullptr) {
            drawing_.add_curve({.block = block, .x = x, .y = 4}, printed_look(1.9));
            has_printed_ = true;
        }
    }

    /// Whole orders that some norm shows twice in a row, or at its only pair of levels, as near as
    /// 0.2 (of a square: 0.4); the most frequent three.
    [[nodiscard]] std::vector<int> reference_slopes() const {
        std::map<int, int> seen;
        for (std::size_t k = 0; k < ladder_.norms.size(); ++k) {
            const double near = ladder_.norms[k].norm.squared ? 0.4 : 0.2;
            const auto orders = observed_orders(records_of(ladder_.rungs, k));
            int before = 0;
            for (std::size_t i = 1; i < orders.size(); ++i) {
                const double order = orders[i].value_or(0.0);
                const int whole = static_cast<int>(std::lround(std::clamp(order, 0.0, 99.0)));
                const bool holds = whole > 0 && std::abs(order - whole) <= near;
                if (holds && (whole == before || orders.size() == 2))
                    ++seen[whole];
                before = holds ? whole : 0;
            }
        }
        std::vector<std::pair<int, int>> all(seen.begin(), seen.end());
        std::sort(all.begin(), all.end(),
                  [](const auto& a, const auto& b) { return a.second > b.second; });
        constexpr std::size_t most = 3;
        std::vector<int> slopes;
        for (std::size_t i = 0; i < std::min(most, all.size()); ++i)
            slopes.push_back(all[i].first);
        std::sort(slopes.begin(), slopes.end());
        return slopes;
    }

    /// more: tenths of the decades that the errors span, added below.
    [[nodiscard]] LogAxes axes_with(double least, double greatest, int more) const {
        const auto [narrowest, widest] =
            std::minmax_element(widths_.abscissa().begin(), widths_.abscissa().end());
        const double span = std::max(1.0, std::log10(greatest / least));
        return {frame_, std::log10(*narrowest / 1.5), std::log10(*widest * 1.5),
                std::log10(least) - span * (0.08 + 0.1 * more), std::log10(greatest) + span * 0.08};
    }

    /// What stands on the axes.
    [[nodiscard]] FreeSpace space_of(const LogAxes& axes) const {
        FreeSpace space(axes.frame);
        for (std::size_t k = 0; k < ladder_.norms.size(); ++k) {
            const auto& predicted = ladder_.norms[k].predictions;
            const auto* figures = printed(k);
            std::optional<PicturePoint> before;
            std::optional<PicturePoint> predicted_before;
            for (std::size_t i = 0; i < ladder_.rungs.size(); ++i) {
                const double width = widths_.abscissa()[i];
                constexpr double marker = 7.0;
                constexpr double square = 11.0;
                std::optional<PicturePoint> here;
                if (const auto error = positive_error(ladder_.rungs[i], k)) {
                    here = axes.at(width, *error);
                    space.occupy(*here, marker);
                    if (before)
                        space.occupy(*before, *here);
                }
                before = here ? here : before;
                if (figures != nullptr && (*figures)[i] > 0.0)
                    space.occupy(axes.at(width, (*figures)[i]), square);
                if (predicted.empty() || !(predicted[i].value > 0.0))
                    continue;
                const PicturePoint there = axes.at(width, predicted[i].value);
                if (predicted_before)
                    space.occupy(*predicted_before, there);
                predicted_before = there;
            }
        }
        return space;
    }

    /// Puts a triangle for each slope where nothing else is; false where some do not fit.
    bool place(const std::vector<int>& slopes, const LogAxes& axes) {
        drawing_.labels.clear();
        triangles_.clear();
        FreeSpace space = space_of(axes);
        const PicturePoint middle{(axes.frame.left + axes.frame.right) / 2.0,
                                  (axes.frame.top + axes.frame.bottom) / 2.0};
        for (const int slope : slopes) {
            constexpr double usual = 56.0;
            constexpr double highest = 80.0;
            const double rise = slope * axes.decade_y() / axes.decade_x();
            const double width = std::min(usual, highest / rise);
            const std::string text = std::to_string(slope);
            const double beside = label_width(text.size());
            const auto box = space.find(
                width + beside, std::max(width * rise, label_height) + label_height, middle);
            if (!box)
                return false;
            space.occupy(*box);
            add_triangle(text, *box, width, width * rise, axes);
        }
        for (const auto& [name, rows] : triangles_)
            drawing_.add_curve({.block = drawing_.add_block(name, rows)},
                               {.colour = "#444444", .width = 1.0});
        return true;
    }

    /// In the upper left corner of its box: its labels stand to the right and below.
    void add_triangle(const std::string& slope, const PictureBox& box, double width, double height,
                      const LogAxes& axes) {
        const double left = axes.width_at(box.left);
        const double right = axes.width_at(box.left + width);
        const double bottom = box.bottom - label_height;
        const double low = axes.error_at(bottom);
        const double high = axes.error_at(bottom - height);
        triangles_.emplace_back(
            "the slope " + slope,
            fmt::format("{0} {2}\n{1} {2}\n{1} {3}\n{0} {2}\n", left, right, low, high));
        const auto label = [&](const std::string& text, double x, double y) {
            drawing_.labels.push_back({text, axes.width_at(x), axes.error_at(y)});
        };
        label(slope, (box.left + width + box.right) / 2.0 + 2.0, bottom - height / 2.0);
        label("1", box.left + width / 2.0, bottom + label_height / 2.0);
    }

    void set_axes(const LogAxes& axes) {
        constexpr std::size_t most_ticks = 6;
        constexpr double many_decades = 5.0;
        drawing_.x = {.title = widths_.axis_title(),
                      .is_logarithmic = true,
                      .range = {{std::pow(10.0, axes.left), std::pow(10.0, axes.right)}},
                      .ticks = widths_.in_time ? value_ticks(widths_.dt, most_ticks)
                                               : width_ticks(widths_.h, most_ticks)};
        drawing_.y = {.title = squares() ? "squared error" : "error",
                      .is_logarithmic = true,
                      .range = {{std::pow(10.0, axes.low), std::pow(10.0, axes.high)}},
                      .are_minor_ticks_left_out = axes.high - axes.low > many_decades};
    }

    void add_legend_of_marks() {
        if (has_printed_)
            drawing_.add_curve({}, printed_look(1.5), "published in " + block_.printed->source);
        if (predicted_)
            drawing_.add_curve({}, predicted_look, "predicted by the fits of [orders]");
    }

    [[nodiscard]] std::string caption(const std::vector<int>& slopes) const {
        return fmt::format(
            "Errors{} along the ladder, on logarithmic axes{}{}{}.",
            block_.final_time > 0.0 ? " up to T = " + shortest(block_.final_time) : "",
            slopes.empty() ? ""
                           : fmt::format("; triangles: the slope{} {}",
                                         slopes.size() == 1 ? "" : "s", fmt::join(slopes, ", ")),
            has_printed_ ? "; open squares: published in " + block_.printed->source : "",
            predicted_ ? "; dotted: predicted by the fits of [orders]" : "");
    }

    const LadderResult& ladder_;
    const LadderBlock& block_;
    LadderWidths widths_;
    std::vector<double> errors_;
    Drawing drawing_;
    PictureBox frame_ = drawing_.fix_axes();
    std::vector<std::pair<std::string, std::string>> triangles_; ///< names and rows
    bool has_printed_ = false;
    bool predicted_ = false;
};

} // namespace

std::vector<Plot> convergence_plots(const StudyResult& result) {
    const auto* ladder = result.get<LadderResult>();
    if (ladder == nullptr || ladder->norms.empty())
        return {};
    LadderResult errors = *ladder;
    std::erase_if(errors.norms, [](const LadderNorm& norm) { return norm.norm.is_value; });
    return ConvergencePlot(errors, *result.scene.get<LadderBlock>()).plots();
}

} // namespace tvbeam

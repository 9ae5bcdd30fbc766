#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

std::optional<double> positive_error(const RungResult& rung, std::size_t k) {
    return !rung.errors.empty() && rung.errors[k] > 0.0 && std::isfinite(rung.errors[k])
               ? std::optional(rung.errors[k])
               : std::nullopt;
}

/// The straight line through the rows of a ladder whose orders agree.
struct FittedLine {
    double order = 0.0;
    double from = 0.0; ///< widths that it is drawn over
    double to = 0.0;
    double error_in_the_middle = 0.0;

    [[nodiscard]] double middle() const { return std::sqrt(from * to); }
    [[nodiscard]] double error(double width) const {
        return error_in_the_middle * std::pow(width / middle(), order);
    }
};

/// None where no orders agree: what is not determined is not drawn.
std::optional<FittedLine> line_of(const LadderResult& ladder, std::size_t k,
                                  const std::vector<double>& abscissa) {
    const auto records = records_of(ladder.rungs, k);
    const auto rows = judge(records).window;
    if (!rows)
        return std::nullopt;
    const auto [least, greatest] = std::minmax(abscissa[rows->first], abscissa[rows->last]);
    FittedLine line{rows->order, least, greatest};
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = rows->first; i <= rows->last; ++i)
        if (is_positive(records[i].error)) {
            sum += std::log(records[i].error) - rows->order * std::log(abscissa[i] / line.middle());
            ++count;
        }
    line.error_in_the_middle = std::exp(sum / count);
    return line;
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
        extent_ = errors_;
        apart_ = std::pow(*greatest / *least, 0.05) * 1.2;
        for (std::size_t k = 0; k < ladder_.norms.size(); ++k)
            lines_.push_back(line_of(ladder_, k, widths_.abscissa()));
        for (std::size_t k = 0; k < ladder_.norms.size(); ++k)
            add_norm(k);
        add_legend_of_marks();
        const bool squares = std::all_of(ladder_.norms.begin(), ladder_.norms.end(),
                                         [](const auto& norm) { return norm.norm.squared; });
        const auto ticks = widths_.in_time ? value_ticks(widths_.dt) : width_ticks(widths_.h);
        const std::string settings = fmt::format(
            "set logscale xy\n{}{}set xtics {}\nset format y '10^{{%L}}'\n"
            "set xlabel {} noenhanced\nset ylabel '{}'\n{}",
            range_text("x", widths_.abscissa(), 1.5), range_text("y", extent_, 2.0 * apart_),
            ticks_text(ticks, 6), gnuplot_text(widths_.axis_title()),
            squares ? "squared error" : "error", labels_);
        return {drawing_.plot("convergence", caption(), settings)};
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
        if (lines_[k])
            add_line(k, *lines_[k]);
        const SeriesStyle style = series_style(k);
        std::string name = norm.norm.words;
        if (lines_[k])
            name += ": slope " + fixed(lines_[k]->order, 2);
        drawing_.add_curve(fmt::format("NaN with linespoints lc rgb '{}' pt {} ps 0.9 dt {} lw 1.6",
                                       style.colour, style.point, style.dash),
                           name);
    }

    void add_points(std::size_t k, const LadderNorm& norm) {
        const auto* figures = printed(k);
        std::string rows;
        for (std::size_t i = 0; i < ladder_.rungs.size(); ++i)
            rows += fmt::format("{} {} {} {} {}\n", widths_.h[i], widths_.dt[i],
                                positive_error(ladder_.rungs[i], k).value_or(nan),
                                figures != nullptr ? (*figures)[i] : nan,
                                norm.predictions.empty() ? nan : norm.predictions[i].value);
        const std::string block =
            drawing_.add_block(norm.norm.name + ": h, dt, error, printed, predicted", rows);
        const SeriesStyle style = series_style(k);
        const int x = widths_.in_time ? 2 : 1;
        if (!norm.predictions.empty()) {
            drawing_.add_curve(
                fmt::format("{} using {}:5 with lines lc rgb '#000000' dt 3 lw 1.2", block, x));
            predicted_ = true;
        }
        drawing_.add_curve(fmt::format("{} using {}:3 with points lc rgb '{}' pt {} ps 0.9", block,
                                       x, style.colour, style.point));
        if (figures != nullptr) {
            drawing_.add_curve(fmt::format(
                "{} using {}:4 with points lc rgb '#000000' pt 4 ps 1.9 lw 1.3", block, x));
            has_printed_ = true;
        }
    }

    void add_line(std::size_t k, const FittedLine& line) {
        const SeriesStyle style = series_style(k);
        std::string rows;
        for (const double width : {line.from, line.to})
            rows += fmt::format("{} {}\n", width, line.error(width));
        const std::string block =
            drawing_.add_block(ladder_.norms[k].norm.name + ": the fitted line", rows);
        drawing_.add_curve(fmt::format("{} using 1:2 with lines lc rgb '{}' dt {} lw 1.6", block,
                                       style.colour, style.dash));
        add_triangle(k, line);
    }

    /// The topmost line has its triangle above it, the others below, each further to the right.
    void add_triangle(std::size_t k, const FittedLine& line) {
        const auto drawn = std::count_if(lines_.begin(), lines_.end(),
                                         [](const auto& one) { return one.has_value(); });
        const bool above = drawn > 1 && k == topmost();
        const double part =
            ladder_.norms.size() > 2
                ? 0.2 + 0.6 * static_cast<double>(k) / static_cast<double>(ladder_.norms.size() - 1)
                : 0.5;
        const double middle = line.from * std::pow(line.to / line.from, part);
        const auto [least, greatest] =
            std::minmax_element(widths_.abscissa().begin(), widths_.abscissa().end());
        const double half = std::pow(*greatest / *least, 0.08);
        const double left = middle / half;
        const double right = middle * half;
        const double apart = above ? apart_ : 1.0 / apart_;
        const double low = line.error(left) * apart;
        const double high = line.error(right) * apart;
        const std::string block =
            drawing_.add_block(ladder_.norms[k].norm.name + ": the triangle of its slope",
                               fmt::format("{0} {2}\n{4} {5}\n{1} {3}\n{0} {2}\n", left, right, low,
                                           high, above ? left : right, above ? high : low));
        drawing_.add_curve(block + " using 1:2 with lines lc rgb '#444444' lt 1 lw 1");
        // The 1 beside the triangle wants room, too.
        extent_.push_back(above ? high * apart_ : low / apart_);
        labels_ += fmt::format("set label '{}' at {},{} {} front font ',16'\n",
                               fixed(line.order, 2), above ? left : right, std::sqrt(low * high),
                               above ? "right offset -0.5,0" : "left offset 0.5,0");
        labels_ += fmt::format("set label '1' at {},{} center offset 0,{} front font ',16'\n",
                               middle, above ? high : low, above ? 0.6 : -0.7);
    }

    /// The norm with the largest errors.
    [[nodiscard]] std::size_t topmost() const {
        std::size_t top = 0;
        for (std::size_t k = 1; k < lines_.size(); ++k)
            if (lines_[k] && (!lines_[top] || lines_[k]->error(lines_[k]->middle()) >
                                                  lines_[top]->error(lines_[k]->middle())))
                top = k;
        return top;
    }

    void add_legend_of_marks() {
        if (has_printed_)
            drawing_.add_curve("NaN with points lc rgb '#000000' pt 4 ps 1.5 lw 1.3",
                               "published in " + block_.printed->source);
        if (predicted_)
            drawing_.add_curve("NaN with lines lc rgb '#000000' dt 3 lw 1.2",
                               "predicted by the fits of [orders]");
    }

    [[nodiscard]] std::string caption() const {
        return fmt::format(
            "Errors{} along the ladder, on logarithmic axes, with fitted lines and "
            "their slopes{}{}.",
            block_.final_time > 0.0 ? " up to T = " + shortest(block_.final_time) : "",
            has_printed_ ? "; open squares: published in " + block_.printed->source : "",
            predicted_ ? "; dotted: predicted by the fits of [orders]" : "");
    }

    const LadderResult& ladder_;
    const LadderBlock& block_;
    LadderWidths widths_;
    std::vector<double> errors_;
    std::vector<double> extent_; ///< what the axis of errors shows
    std::vector<std::optional<FittedLine>> lines_;
    double apart_ = 1.0; ///< how far, as a factor, a triangle lies from its line
    Drawing drawing_;
    std::string labels_;
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

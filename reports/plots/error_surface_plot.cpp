#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/grid/grid.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tvbeam {

namespace {

/// A point of the plane of h and Δt.
struct Widths {
    double h = 0.0;
    double dt = 0.0;
};

/// The rectangle of the plane that a figure shows.
struct Box {
    explicit Box(const std::vector<RungResult>& runs) {
        for (const auto& run : runs) {
            h.push_back(1.0 / static_cast<double>(run.rung.elements));
            dt.push_back(run.rung.dt);
        }
        const auto [least_h, greatest_h] = std::minmax_element(h.begin(), h.end());
        const auto [least_dt, greatest_dt] = std::minmax_element(dt.begin(), dt.end());
        least = {*least_h / room, *least_dt / room};
        greatest = {*greatest_h * room, *greatest_dt * room};
    }

    [[nodiscard]] Widths clamped(const Widths& at) const {
        return {std::clamp(at.h, least.h, greatest.h), std::clamp(at.dt, least.dt, greatest.dt)};
    }

    [[nodiscard]] bool holds(const Widths& at) const {
        return at.h >= least.h && at.h <= greatest.h && at.dt >= least.dt && at.dt <= greatest.dt;
    }

    static constexpr double room = 1.35;
    std::vector<double> h;
    std::vector<double> dt;
    Widths least;
    Widths greatest;
};

/// The line in the plane along which the model is `error`, from small h with the largest Δt to
/// large h with the smallest. With A = a h^p and B = b Δt^q it is the ellipse
/// A² + 2ρAB + B² = e², of which the part with A, B > 0 is gone along by the angle φ:
/// A = e sin φ / sin ω, B = e sin(ω − φ) / sin ω with cos ω = ρ (A, B and e are the sides of a
/// triangle with the angles φ, ω − φ and π − ω).
std::vector<Widths> line_of_equal_error(const TwoTermModel& model, double error) {
    constexpr int points = 160;
    // At ρ = ±1 the ellipse is a pair of lines.
    const double omega = std::acos(std::clamp(model.rho, -1.0 + 1e-9, 1.0 - 1e-9));
    std::vector<Widths> line;
    for (int i = 1; i < points; ++i) {
        // Denser towards the ends, where one of the two widths goes to zero.
        const double part = 0.5 * (1.0 + std::tanh(8.0 * (2.0 * i / points - 1.0)));
        const double phi = omega * part;
        const double spatial = error * std::sin(phi) / std::sin(omega);
        const double temporal = error * std::sin(omega - phi) / std::sin(omega);
        line.push_back({std::pow(spatial / model.a, 1.0 / model.p),
                        std::pow(temporal / model.b, 1.0 / model.q)});
    }
    return line;
}

/// Errors that lines are drawn at: 1, 2 and 5 times powers of ten within a decade or two, 1 and 3
/// within four, powers of ten beyond.
std::vector<double> levels_between(double least, double greatest) {
    const double decades = std::log10(greatest / least);
    std::vector<double> mantissas{1.0};
    if (decades < 2.0)
        mantissas = {1.0, 2.0, 5.0};
    else if (decades < 4.0)
        mantissas = {1.0, 3.0};
    std::vector<double> levels;
    for (int power = static_cast<int>(std::floor(std::log10(least))); power < 300; ++power)
        for (const double mantissa : mantissas) {
            const double level = number_in(fmt::format("{}e{}", mantissa, power));
            if (level >= greatest)
                return levels;
            if (level > least)
                levels.push_back(level);
        }
    return levels;
}

/// From light blue (0) to a blue that black letters can still be read on (1).
std::string shade(double part) {
    const std::array<double, 3> light{247, 251, 255};
    const std::array<double, 3> dark{107, 164, 211};
    std::string colour = "#";
    for (std::size_t i = 0; i < 3; ++i)
        colour += fmt::format("{:02x}", static_cast<int>(std::lround(
                                            light.at(i) + part * (dark.at(i) - light.at(i)))));
    return colour;
}

CurveLook run_look(const char* colour, int point, double size) {
    return {.kind = CurveLook::Kind::points,
            .colour = colour,
            .point = point,
            .size = size,
            .width = 1.5};
}

/// One figure, put together block by block.
class SurfacePlot {
public:
    SurfacePlot(const OrdersResult& orders, const OrdersBlock& block, std::size_t k)
        : orders_(orders), fit_(orders.norms[k].fit), norm_(block.norms[k]), k_(k),
          box_(orders.runs) {}

    Plot plot() {
        const bool modelled = fit_.predicts();
        if (modelled)
            add_model();
        add_runs(modelled);
        constexpr std::size_t most_ticks = 6;
        drawing_.x = {.title = "mesh width h",
                      .is_logarithmic = true,
                      .range = {{box_.least.h, box_.greatest.h}},
                      .ticks = width_ticks(box_.h, most_ticks)};
        drawing_.y = {.title = "time step Δt",
                      .is_logarithmic = true,
                      .range = {{box_.least.dt, box_.greatest.dt}},
                      .ticks = value_ticks(box_.dt, most_ticks)};
        drawing_.is_framed = true;
        return {"error_surface_" + norm_.name, caption(modelled), drawing_};
    }

private:
    /// Bands between the lines, the darker the larger the error; the lines; the balance.
    void add_model() {
        const TwoTermModel& model = fit_.model;
        double least = model.error(box_.greatest.h, box_.greatest.dt);
        double greatest = least;
        for (int i = 0; i <= 40; ++i)
            for (int j = 0; j <= 40; ++j) {
                const double error =
                    model.error(between(box_.least.h, box_.greatest.h, i / 40.0),
                                between(box_.least.dt, box_.greatest.dt, j / 40.0));
                least = std::min(least, error);
                greatest = std::max(greatest, error);
            }
        const auto levels = levels_between(least, greatest);
        drawing_.backdrop = shade(1.0);
        for (std::size_t i = levels.size(); i-- > 0;)
            add_band(levels[i], static_cast<double>(i) / static_cast<double>(levels.size()));
        for (const double level : levels)
            add_line(level);
        add_balance();
    }

    static double between(double low, double high, double part) {
        return low * std::pow(high / low, part);
    }

    /// All points whose error is below the level, up to the corner of the smallest widths.
    void add_band(double level, double part) {
        std::string rows;
        for (const Widths& at : line_of_equal_error(fit_.model, level)) {
            const Widths within = box_.clamped(at);
            rows += fmt::format("{:.6g} {:.6g}\n", within.h, within.dt);
        }
        rows += fmt::format("{} {}\n", box_.least.h, box_.least.dt);
        drawing_.add_curve(
            {.block = drawing_.add_block(fmt::format("model below {}: h, dt", level), rows)},
            {.kind = CurveLook::Kind::region, .colour = shade(part)});
    }

    /// How far a point lies from what its label would cover: the edges of the figure, runs, the
    /// balance line. In parts of the figure's size; negative outside.
    [[nodiscard]] double clearance(const Widths& at) const {
        const double width = std::log(box_.greatest.h / box_.least.h);
        const double height = std::log(box_.greatest.dt / box_.least.dt);
        double clear = std::min({std::log(at.h / box_.least.h) / width,
                                 std::log(box_.greatest.h / at.h) / width,
                                 std::log(at.dt / box_.least.dt) / height,
                                 std::log(box_.greatest.dt / at.dt) / height});
        for (std::size_t i = 0; i < box_.h.size(); ++i)
            // A label is wider than high.
            clear = std::min(clear, std::hypot(std::log(at.h / box_.h[i]) / width,
                                               2.0 * std::log(at.dt / box_.dt[i]) / height));
        const TwoTermModel& model = fit_.model;
        const double balance = std::pow(model.spatial(at.h) / model.b, 1.0 / model.q);
        return std::min(clear, std::abs(std::log(at.dt / balance)) / height);
    }

    void add_line(double level) {
        std::string rows;
        Widths labelled;
        double best = 0.0;
        bool is_seen = false;
        for (const Widths& at : line_of_equal_error(fit_.model, level)) {
            const double clear = clearance(at);
            // A point or two outside, where gnuplot cuts the line off.
            if (!(clear > -1.0))
                continue;
            is_seen = is_seen || box_.holds(at);
            rows += fmt::format("{:.6g} {:.6g}\n", at.h, at.dt);
            if (clear > best) {
                best = clear;
                labelled = at;
            }
        }
        if (!is_seen)
            return;
        drawing_.add_curve(
            {.block = drawing_.add_block(fmt::format("model equal to {}: h, dt", level), rows)},
            {.colour = "#08519c", .width = 1.0});
        constexpr double room = 0.03;
        if (best > room)
            drawing_.labels.push_back({.text = scientific(level, 0),
                                       .x = labelled.h,
                                       .y = labelled.dt,
                                       .font = 15,
                                       .is_on_white = true});
    }

    void add_balance() {
        const TwoTermModel& model = fit_.model;
        std::string rows;
        for (const double h : {box_.least.h, box_.greatest.h})
            rows += fmt::format("{} {}\n", h, std::pow(model.spatial(h) / model.b, 1.0 / model.q));
        drawing_.add_curve({.block = drawing_.add_block("balance a h^p = b dt^q: h, dt", rows)},
                           {.colour = "#D55E00", .dash = 2, .width = 2.2},
                           "balance of space error and time error");
    }

    /// Runs whose error is measured, used by the fit and not.
    void add_runs(bool modelled) {
        std::string used;
        std::string other;
        for (std::size_t i = 0; i < orders_.runs.size(); ++i) {
            const auto& errors = orders_.runs[i].errors;
            const bool is_used =
                std::find(fit_.used.begin(), fit_.used.end(), i) != fit_.used.end();
            (modelled && is_used ? used : other) +=
                fmt::format("{} {} {}\n", box_.h[i], box_.dt[i],
                            errors.empty() ? "NaN" : fmt::format("{}", errors[k_]));
        }
        if (!used.empty()) {
            const std::size_t block = drawing_.add_block("runs of the fit: h, dt, error", used);
            drawing_.add_curve({.block = block}, run_look("#ffffff", 7, 1.0));
            drawing_.add_curve({.block = block}, run_look("#000000", 6, 1.0),
                               "runs that the model is fitted to");
        }
        if (!other.empty()) {
            drawing_.add_curve({.block = drawing_.add_block("other runs: h, dt, error", other)},
                               run_look("#000000", 2, 0.9),
                               modelled ? "runs left out of the fit" : "runs");
            if (!modelled)
                add_errors_as_labels();
        }
    }

    /// Where there is no model, the figures themselves.
    void add_errors_as_labels() {
        for (std::size_t i = 0; i < orders_.runs.size(); ++i) {
            const auto& errors = orders_.runs[i].errors;
            drawing_.labels.push_back(
                {.text = errors.empty() ? "failed" : scientific(errors[k_], 1),
                 .x = box_.h[i],
                 .y = box_.dt[i],
                 .font = 13,
                 .is_above = true});
        }
    }

    [[nodiscard]] std::string caption(bool modelled) const {
        // The model is one of the norm itself.
        std::string of = norm_.words;
        if (const std::string square = ", squared"; of.ends_with(square))
            of.resize(of.size() - square.size());
        else if (norm_.squared)
            of = "root of the " + of;
        const std::string what = "Error over the plane of h and Δt: " + of + ". ";
        return what +
               (modelled
                    ? "Lines of equal error of the fitted model, in bands that are darker the "
                      "larger the error; dashed: where its two terms are equal, the space error "
                      "dominates to the right, the time error above; circles: the runs."
                    : "No model of two terms is determined by the runs; their errors stand at "
                      "the crosses.");
    }

    const OrdersResult& orders_;
    const TwoTermFit& fit_;
    const Measure& norm_;
    std::size_t k_;
    Box box_;
    Drawing drawing_;
};

} // namespace

std::vector<Plot> error_surface_plots(const StudyResult& result) {
    std::vector<Plot> plots;
    if (const auto* orders = result.get<OrdersResult>())
        for (std::size_t k = 0; k < orders->norms.size(); ++k)
            plots.push_back(SurfacePlot(*orders, *result.scene.get<OrdersBlock>(), k).plot());
    return plots;
}

} // namespace tvbeam

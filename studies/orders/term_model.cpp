#include "studies/orders/term_model.hpp"

#include "studies/orders/term_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tvbeam {

namespace {

/// x^k or ln x, by which a next term exceeds its leading one; of no use where there is none.
double next_power(const Layout& layout, Eigen::Index i, double log_x) {
    if (layout.next(i) < 0 || layout.power(i) == TermShape::constant)
        return 0;
    return layout.power(i) == TermShape::logarithm ? log_x : std::exp(layout.power(i) * log_x);
}

Term term_with(const Layout& layout, const Eigen::VectorXd& theta, Eigen::Index i, double log_x,
               double next) {
    const double plain = std::exp(theta[2 * i] + theta[2 * i + 1] * log_x);
    const Eigen::Index k = layout.next(i);
    if (k < 0)
        return {plain, plain * log_x, 0};
    if (layout.power(i) == TermShape::constant) {
        const double size = std::exp(theta[2 * i]);
        return {plain + size * theta[k], plain * log_x, size};
    }
    const double value = plain * (1 + theta[k] * next);
    return {value, value * log_x, plain * next};
}

/// The model at one θ.
class ModelAt {
public:
    ModelAt(const Layout& layout, const Eigen::VectorXd& theta,
            const Eigen::VectorXd& log_reference, Eigen::Index in_squares)
        : layout_(layout), theta_(theta), in_squares_(in_squares),
          floor_(layout.floor() < 0 ? 0.0 : std::exp(2 * theta[layout.floor()])) {
        const Eigen::Index d = layout.widths();
        Eigen::Index pair = 0;
        for (Eigen::Index i = 0; i < d; ++i)
            for (Eigen::Index j = i + 1; j < d; ++j, ++pair)
                rho_[pair] = theta[layout.pair(i, j)];
        for (Eigen::Index i = 0; i < d && log_reference.size() > 0; ++i)
            if (!std::isnan(log_reference[i]))
                reference_[i] = term_at(layout, theta, i, log_reference[i]);
    }

    /// T_i at a width whose next power this is, less that of the reference.
    Term term(Eigen::Index i, double log_x, double next) const {
        return measured(term_with(layout_, theta_, i, log_x, next), reference_[i],
                        i == in_squares_);
    }

    /// ln e at one row, whose widths' terms stand at these places; NaN where the model has no
    /// error. Its derivative by θ_k goes to gradient[k · stride] where that is not null.
    double log_error(const Term terms[], const std::size_t places[], double* gradient,
                     Eigen::Index stride) const {
        const Eigen::Index d = layout_.widths();
        double value[most_widths];
        double pull[most_widths]; // Σ_j ρ_ij T_j, half the derivative of e² by T_i
        for (Eigen::Index i = 0; i < d; ++i) {
            value[i] = terms[places[i]].value;
            if (!(value[i] > 0))
                return std::numeric_limits<double>::quiet_NaN();
            pull[i] = value[i];
        }
        Eigen::Index pair = 0;
        for (Eigen::Index i = 0; i < d; ++i)
            for (Eigen::Index j = i + 1; j < d; ++j, ++pair) {
                pull[i] += rho_[pair] * value[j];
                pull[j] += rho_[pair] * value[i];
            }
        double square = floor_;
        for (Eigen::Index i = 0; i < d; ++i)
            square += value[i] * pull[i];
        if (gradient != nullptr) {
            for (Eigen::Index i = 0; i < d; ++i) {
                const double by_term = pull[i] / square;
                gradient[2 * i * stride] = by_term * value[i];
                gradient[(2 * i + 1) * stride] = by_term * terms[places[i]].by_order;
                if (layout_.next(i) >= 0)
                    gradient[layout_.next(i) * stride] = by_term * terms[places[i]].by_next;
                for (Eigen::Index j = i + 1; j < d; ++j)
                    gradient[layout_.pair(i, j) * stride] = value[i] * value[j] / square;
            }
            if (layout_.floor() >= 0)
                gradient[layout_.floor() * stride] = floor_ / square;
        }
        if (!(square > 0))
            return std::numeric_limits<double>::quiet_NaN();
        return std::log(square) / 2 - log_saturation(std::sqrt(square), gradient, stride);
    }

    static constexpr Eigen::Index most_widths = 8;

private:
    /// ln (1 + s e); what the gradient holds is that of ln e, and becomes that of the whole.
    double log_saturation(double error, double* gradient, Eigen::Index stride) const {
        const Eigen::Index k = layout_.saturation();
        if (k < 0)
            return 0;
        const double factor = 1 + theta_[k] * error;
        if (gradient != nullptr) {
            for (Eigen::Index i = 0; i < k; ++i)
                gradient[i * stride] /= factor;
            gradient[k * stride] = -error / factor;
        }
        return std::log(factor); // NaN where the model has no error
    }

    static constexpr Eigen::Index most_pairs = most_widths * (most_widths - 1) / 2;

    const Layout& layout_;
    const Eigen::VectorXd& theta_;
    Eigen::Index in_squares_;
    double floor_; ///< its square
    double rho_[most_pairs];
    Term reference_[most_widths]; ///< 0 where the comparison is exact
};

} // namespace

Term term_at(const Layout& layout, const Eigen::VectorXd& theta, Eigen::Index i, double log_x) {
    return term_with(layout, theta, i, log_x, next_power(layout, i, log_x));
}

Term measured(const Term& term, const Term& reference, bool in_squares) {
    if (!in_squares || reference.value == 0)
        return {term.value - reference.value, term.by_order - reference.by_order,
                term.by_next - reference.by_next};
    const double value = std::sqrt(term.value * term.value - reference.value * reference.value);
    const double own = term.value / value;
    const double its = reference.value / value;
    return {value, own * term.by_order - its * reference.by_order,
            own * term.by_next - its * reference.by_next};
}

double reference_of(const Eigen::VectorXd& log_reference, Eigen::Index i) {
    return log_reference.size() == 0 ? std::numeric_limits<double>::quiet_NaN() : log_reference[i];
}

ModelFunction model_of(const Layout& layout, const TermRows& rows) {
    // Many rows of a grid have one width in common, and with it a term.
    struct Level {
        Eigen::Index width;
        double log_x, next;
    };
    std::vector<Level> levels;
    std::vector<std::size_t> places; // of a row's widths, row by row
    for (Eigen::Index r = 0; r < rows.size(); ++r)
        for (Eigen::Index i = 0; i < rows.widths(); ++i) {
            const double log_x = rows.log_widths(r, i);
            const auto found = std::ranges::find_if(levels, [&](const Level& level) {
                return level.width == i && level.log_x == log_x;
            });
            places.push_back(static_cast<std::size_t>(found - levels.begin()));
            if (found == levels.end())
                levels.push_back({i, log_x, next_power(layout, i, log_x)});
        }
    return [&layout, &rows, levels, places, terms = std::vector<Term>(levels.size())](
               const Eigen::VectorXd& theta, Eigen::VectorXd& values,
               Eigen::MatrixXd* jacobian) mutable {
        const ModelAt model(layout, theta, rows.log_reference, rows.in_squares);
        for (std::size_t l = 0; l < levels.size(); ++l)
            terms[l] = model.term(levels[l].width, levels[l].log_x, levels[l].next);
        const std::size_t* place = places.data();
        for (Eigen::Index r = 0; r < rows.size(); ++r, place += rows.widths())
            values[r] =
                model.log_error(terms.data(), place,
                                jacobian == nullptr ? nullptr : &(*jacobian)(r, 0), rows.size());
    };
}

TermRows TermRows::subset(const std::vector<Eigen::Index>& chosen) const {
    return {log_widths(chosen, Eigen::all),
            log_errors(chosen),
            weights(chosen),
            scatter,
            rounded,
            log_reference,
            in_squares};
}

TermRows TermRows::along(Eigen::Index width) const {
    TermRows result{log_widths.col(width), log_errors, weights, scatter, rounded};
    if (log_reference.size() > 0)
        result.log_reference = log_reference.segment(width, 1);
    result.in_squares = width == in_squares ? 0 : -1;
    return result;
}

int TermShape::parameters() const {
    return static_cast<int>(Layout(*this, static_cast<Eigen::Index>(next.size())).size());
}

double TermFit::student() const {
    const double own = dof > 0 ? scale * student_over_normal(dof) : 0.0;
    const double greater = std::max(own, scatter);
    return greater > 0 ? greater / std::max(scale, scatter) : student_over_normal(dof);
}

FittedNumber TermFit::order(Eigen::Index width) const {
    return {theta[2 * width + 1], std::sqrt(covariance(2 * width + 1, 2 * width + 1))};
}

FittedNumber TermFit::log_size(Eigen::Index width) const {
    const Eigen::Index at = 2 * width; // of ln a, in units of the centre, and then p
    const Eigen::Vector2d gradient(1, -log_centre[width]);
    return {log_unit + gradient.dot(theta.segment<2>(at)),
            std::sqrt(gradient.dot(covariance.block<2, 2>(at, at) * gradient))};
}

FittedNumber TermFit::correlation(Eigen::Index first, Eigen::Index second) const {
    const auto at = Layout(shape, log_centre.size()).pair(first, second);
    return {theta[at], std::sqrt(covariance(at, at))};
}

FittedNumber TermFit::next(Eigen::Index width) const {
    const auto at = Layout(shape, log_centre.size()).next(width);
    return at < 0 ? FittedNumber() : FittedNumber{theta[at], std::sqrt(covariance(at, at))};
}

double TermFit::next_part(Eigen::Index width, double log_width) const {
    const double power = shape.next[static_cast<std::size_t>(width)];
    if (power == TermShape::none || power == TermShape::constant)
        return 0;
    const double log_x = log_width - log_centre[width];
    return next(width).value * (power == TermShape::logarithm ? log_x : std::exp(power * log_x));
}

double TermFit::term(Eigen::Index width, double log_width) const {
    const Layout layout(shape, log_centre.size());
    return std::exp(log_unit) * term_at(layout, theta, width, log_width - log_centre[width]).value;
}

double TermFit::measured_term(Eigen::Index width, double log_width) const {
    const double there = reference_of(log_reference, width);
    const double of_reference = std::isnan(there) ? 0.0 : term(width, there);
    return measured({term(width, log_width)}, {of_reference}, width == in_squares).value;
}

FittedNumber TermFit::log_error(const Eigen::VectorXd& log_widths, bool against_reference) const {
    const Layout layout(shape, log_centre.size());
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(layout.size());
    const Eigen::VectorXd reference = against_reference && log_reference.size() > 0
                                          ? Eigen::VectorXd(log_reference - log_centre)
                                          : Eigen::VectorXd();
    const ModelAt model(layout, theta, reference, in_squares);
    Term terms[ModelAt::most_widths];
    std::size_t places[ModelAt::most_widths];
    for (std::size_t i = 0; i < ModelAt::most_widths; ++i)
        places[i] = i;
    for (Eigen::Index i = 0; i < layout.widths(); ++i) {
        const double log_x = log_widths[i] - log_centre[i];
        terms[i] = model.term(i, log_x, next_power(layout, i, log_x));
    }
    const double value = model.log_error(terms, places, gradient.data(), 1);
    return {log_unit + value, root.size() > 0 ? (root.transpose() * gradient).norm()
                                              : std::sqrt(gradient.dot(covariance * gradient))};
}

} // namespace tvbeam

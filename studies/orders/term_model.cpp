#include "studies/orders/term_model.hpp"

#include "studies/orders/term_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tvbeam {

namespace {

Term term_of(const Layout& layout, const Eigen::VectorXd& theta, Eigen::Index i, double log_x,
             double log_reference) {
    const Term here = term_at(layout, theta, i, log_x);
    if (std::isnan(log_reference))
        return here;
    const Term there = term_at(layout, theta, i, log_reference);
    return {here.value - there.value, here.by_order - there.by_order, here.by_next - there.by_next};
}

/// The model at one θ.
class ModelAt {
public:
    ModelAt(const Layout& layout, const Eigen::VectorXd& theta) : layout_(layout), theta_(theta) {
        const Eigen::Index first = 2 * layout.widths();
        const Eigen::Index pairs = layout.pair(layout.widths() - 1, layout.widths()) - first;
        rho_ = theta.segment(first, pairs).array().sin();
        by_angle_ = theta.segment(first, pairs).array().cos();
    }

    /// ln e at one row; NaN where the model has no error. Its derivative by θ_k goes to
    /// gradient[k · stride] where that is not null.
    double log_error(const Eigen::Ref<const Eigen::VectorXd, 0, Eigen::InnerStride<>>& log_widths,
                     const Eigen::VectorXd& log_reference, double* gradient,
                     Eigen::Index stride) const {
        const Eigen::Index d = layout_.widths();
        Term terms[most_widths];
        double pull[most_widths]; // Σ_j ρ_ij T_j, half the derivative of e² by T_i
        for (Eigen::Index i = 0; i < d; ++i) {
            terms[i] = term_of(layout_, theta_, i, log_widths[i], reference_of(log_reference, i));
            if (!(terms[i].value > 0))
                return std::numeric_limits<double>::quiet_NaN();
            pull[i] = terms[i].value;
        }
        Eigen::Index pair = 0;
        for (Eigen::Index i = 0; i < d; ++i)
            for (Eigen::Index j = i + 1; j < d; ++j, ++pair) {
                pull[i] += rho_[pair] * terms[j].value;
                pull[j] += rho_[pair] * terms[i].value;
            }
        const double floor = layout_.floor() < 0 ? 0.0 : std::exp(2 * theta_[layout_.floor()]);
        double square = floor;
        for (Eigen::Index i = 0; i < d; ++i)
            square += terms[i].value * pull[i];
        if (gradient != nullptr) {
            pair = 0;
            for (Eigen::Index i = 0; i < d; ++i) {
                const double by_term = pull[i] / square;
                gradient[2 * i * stride] = by_term * terms[i].value;
                gradient[(2 * i + 1) * stride] = by_term * terms[i].by_order;
                if (layout_.next(i) >= 0)
                    gradient[layout_.next(i) * stride] = by_term * terms[i].by_next;
                for (Eigen::Index j = i + 1; j < d; ++j, ++pair)
                    gradient[layout_.pair(i, j) * stride] =
                        by_angle_[pair] * terms[i].value * terms[j].value / square;
            }
            if (layout_.floor() >= 0)
                gradient[layout_.floor() * stride] = floor / square;
        }
        return square > 0 ? std::log(square) / 2 : std::numeric_limits<double>::quiet_NaN();
    }

private:
    static constexpr Eigen::Index most_widths = 8;
    static constexpr int most_pairs = most_widths * (most_widths - 1) / 2;
    using Pairs = Eigen::Array<double, Eigen::Dynamic, 1, 0, most_pairs, 1>;

    const Layout& layout_;
    const Eigen::VectorXd& theta_;
    Pairs rho_;
    Pairs by_angle_; ///< ∂ρ/∂φ
};

} // namespace

Term term_at(const Layout& layout, const Eigen::VectorXd& theta, Eigen::Index i, double log_x) {
    const double plain = std::exp(theta[2 * i] + theta[2 * i + 1] * log_x);
    const Eigen::Index k = layout.next(i);
    if (k < 0)
        return {plain, plain * log_x, 0};
    if (layout.power(i) == TermShape::constant) {
        const double size = std::exp(theta[2 * i]);
        return {plain + size * theta[k], plain * log_x, size};
    }
    const double next =
        layout.power(i) == TermShape::logarithm ? log_x : std::exp(layout.power(i) * log_x);
    const double value = plain * (1 + theta[k] * next);
    return {value, value * log_x, plain * next};
}

double reference_of(const Eigen::VectorXd& log_reference, Eigen::Index i) {
    return log_reference.size() == 0 ? std::numeric_limits<double>::quiet_NaN() : log_reference[i];
}

ModelFunction model_of(const Layout& layout, const TermRows& rows) {
    return [&layout, &rows](const Eigen::VectorXd& theta, Eigen::VectorXd& values,
                            Eigen::MatrixXd* jacobian) {
        const ModelAt model(layout, theta);
        for (Eigen::Index r = 0; r < rows.size(); ++r)
            values[r] =
                model.log_error(rows.log_widths.row(r).transpose(), rows.log_reference,
                                jacobian == nullptr ? nullptr : &(*jacobian)(r, 0), rows.size());
    };
}

TermRows TermRows::subset(const std::vector<Eigen::Index>& chosen) const {
    return {log_widths(chosen, Eigen::all), log_errors(chosen), weights(chosen), scatter,
            log_reference};
}

TermRows TermRows::along(Eigen::Index width) const {
    TermRows result{log_widths.col(width), log_errors, weights, scatter};
    if (log_reference.size() > 0)
        result.log_reference = log_reference.segment(width, 1);
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

FittedNumber TermFit::correlation(Eigen::Index first, Eigen::Index second) const {
    const auto at = Layout(shape, log_centre.size()).pair(first, second);
    return {std::sin(theta[at]), std::abs(std::cos(theta[at])) * std::sqrt(covariance(at, at))};
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

FittedNumber TermFit::log_error(const Eigen::VectorXd& log_widths, bool against_reference) const {
    const Layout layout(shape, log_centre.size());
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(layout.size());
    const Eigen::VectorXd reference = against_reference && log_reference.size() > 0
                                          ? Eigen::VectorXd(log_reference - log_centre)
                                          : Eigen::VectorXd();
    const double value =
        ModelAt(layout, theta).log_error(log_widths - log_centre, reference, gradient.data(), 1);
    return {log_unit + value, root.size() > 0 ? (root.transpose() * gradient).norm()
                                              : std::sqrt(gradient.dot(covariance * gradient))};
}

} // namespace tvbeam

#include "studies/orders/term_model.hpp"

#include <boost/math/tools/minima.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace tvbeam {

namespace {

/// Cauchy's function with this is 95 % efficient under normal scatter.
constexpr double cauchy = 2.385;
/// The median of |z| over the standard deviation of a normal z.
constexpr double median_of_normal = 0.6745;
constexpr int reweightings = 4;
/// Most starts end in the same place.
constexpr std::size_t most_starts = 3;
constexpr std::size_t most_moved = 8; ///< starts of a model with a next term
constexpr double most_rho = 0.99;     ///< of a start

/// Where the parameters stand in θ.
class Layout {
public:
    Layout(const TermShape& shape, Eigen::Index widths)
        : shape_(shape), widths_(widths), size_(2 * widths + widths * (widths - 1) / 2) {
        for (const double power : shape.next)
            next_.push_back(power == TermShape::none ? -1 : size_++);
        if (shape.floor)
            floor_ = size_++;
    }
    Eigen::Index widths() const { return widths_; }
    Eigen::Index pair(Eigen::Index i, Eigen::Index j) const {
        return 2 * widths_ + i * (2 * widths_ - i - 1) / 2 + (j - i - 1);
    }
    Eigen::Index next(Eigen::Index i) const { return next_[static_cast<std::size_t>(i)]; }
    double power(Eigen::Index i) const { return shape_.next[static_cast<std::size_t>(i)]; }
    Eigen::Index floor() const { return floor_; }
    Eigen::Index size() const { return size_; }

private:
    const TermShape& shape_;
    Eigen::Index widths_;
    Eigen::Index size_;
    std::vector<Eigen::Index> next_;
    Eigen::Index floor_ = -1;
};

/// T_i at one row, and its derivatives by p_i and c_i; that by ln a_i is T_i itself.
struct Term {
    double value = 0;
    double by_order = 0;
    double by_next = 0;
};

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

Term term_of(const Layout& layout, const Eigen::VectorXd& theta, Eigen::Index i, double log_x,
             double log_reference) {
    const Term here = term_at(layout, theta, i, log_x);
    if (std::isnan(log_reference))
        return here;
    const Term there = term_at(layout, theta, i, log_reference);
    return {here.value - there.value, here.by_order - there.by_order, here.by_next - there.by_next};
}

double reference_of(const Eigen::VectorXd& log_reference, Eigen::Index i) {
    return log_reference.size() == 0 ? std::numeric_limits<double>::quiet_NaN() : log_reference[i];
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

struct Start {
    Eigen::VectorXd theta;
    double left = infinity; ///< how far off it is: the sum of squares of e²_model / e² − 1
};

/// x^p, and what stands beside it: x^p times the next term's factor, or one beside a constant.
struct Factors {
    double leading = 0;
    double next = 0;
};

Factors factors_at(const Layout& layout, Eigen::Index i, double order, double log_x) {
    const double leading = std::exp(order * log_x);
    if (layout.next(i) < 0)
        return {leading, 0};
    const double power = layout.power(i);
    if (power == TermShape::constant)
        return {leading, 1};
    return {leading, leading * (power == TermShape::logarithm ? log_x : std::exp(power * log_x))};
}

/// For given orders the squares are linear in a_i a_j ρ_ij, and where widths have next terms in
/// these times c_i, and in a_i² c_i², if each counts as a number of its own.
std::optional<Start> start_at(const Layout& layout, const TermRows& rows,
                              const Eigen::VectorXd& orders) {
    const Eigen::Index d = layout.widths();
    Eigen::MatrixXd powers(rows.size(), d);
    Eigen::MatrixXd nexts(rows.size(), d);
    for (Eigen::Index i = 0; i < d; ++i) {
        const double reference = reference_of(rows.log_reference, i);
        for (Eigen::Index r = 0; r < rows.size(); ++r) {
            const Factors here = factors_at(layout, i, orders[i], rows.log_widths(r, i));
            const Factors there =
                std::isnan(reference) ? Factors() : factors_at(layout, i, orders[i], reference);
            const double error = std::exp(rows.log_errors[r]);
            powers(r, i) = (here.leading - there.leading) / error;
            nexts(r, i) = (here.next - there.next) / error;
        }
    }
    std::vector<Eigen::Index> longer; // the widths with next terms
    for (Eigen::Index i = 0; i < d; ++i)
        if (layout.next(i) >= 0)
            longer.push_back(i);
    const auto own = static_cast<Eigen::Index>(longer.size());
    const Eigen::Index pairs = d * (d - 1) / 2;
    Eigen::MatrixXd design(rows.size(), d + pairs + own * (d + 1));
    design.leftCols(d) = powers.cwiseAbs2();
    Eigen::Index column = d;
    for (Eigen::Index i = 0; i < d; ++i)
        for (Eigen::Index j = i + 1; j < d; ++j)
            design.col(column++) = powers.col(i).cwiseProduct(powers.col(j));
    for (const Eigen::Index i : longer) {
        for (Eigen::Index j = 0; j < d; ++j)
            design.col(column++) = nexts.col(i).cwiseProduct(powers.col(j));
        design.col(column++) = nexts.col(i).cwiseAbs2();
    }
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rows.size());
    const Eigen::VectorXd x = design.colPivHouseholderQr().solve(ones);
    if (!x.allFinite())
        return std::nullopt;
    Start start{Eigen::VectorXd::Zero(layout.size()), (design * x - ones).squaredNorm()};
    const double least = std::max(1e-12 * x.head(d).cwiseAbs().maxCoeff(), 1e-300);
    for (Eigen::Index i = 0; i < d; ++i) {
        start.theta[2 * i] = std::log(std::max(x[i], least)) / 2;
        start.theta[2 * i + 1] = orders[i];
        if (x[i] <= 0)
            start.left += 1; // no size has such a square: better starts come first
    }
    column = d;
    for (Eigen::Index i = 0; i < d; ++i)
        for (Eigen::Index j = i + 1; j < d; ++j) {
            const double rho = x[column++] / 2 / std::exp(start.theta[2 * i] + start.theta[2 * j]);
            start.theta[layout.pair(i, j)] = std::asin(std::clamp(rho, -most_rho, most_rho));
        }
    for (const Eigen::Index i : longer) {
        start.theta[layout.next(i)] = x[column + i] / 2 / std::exp(2 * start.theta[2 * i]);
        column += d + 1;
    }
    return start;
}

/// To the best order of one width between its neighbours in the net: beside a next term a far
/// smaller one is seen there alone.
void move_order(const Layout& layout, const TermRows& rows, Eigen::Index i, Start& start) {
    constexpr double step = 0.5;
    constexpr int bits = 20;
    Eigen::VectorXd orders(layout.widths());
    for (Eigen::Index k = 0; k < layout.widths(); ++k)
        orders[k] = start.theta[2 * k + 1];
    const auto left_at = [&](double order) {
        orders[i] = order;
        return start_at(layout, rows, orders).value_or(Start()).left;
    };
    const auto [order, left] = boost::math::tools::brent_find_minima(
        left_at, std::max(orders[i] - step, step / 2), orders[i] + step, bits);
    if (!(left < start.left))
        return;
    orders[i] = order;
    if (auto other = start_at(layout, rows, orders))
        start = std::move(*other);
}

/// The best few of a net of orders, and the best with one that stands still where that is better
/// than all of those.
std::vector<Eigen::VectorXd> starts_of(const Layout& layout, const TermRows& rows) {
    const Eigen::Index d = layout.widths();
    bool has_next_term = false;
    for (Eigen::Index i = 0; i < d; ++i)
        has_next_term = has_next_term || layout.next(i) >= 0;
    const std::vector<double> net{0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0};
    std::vector<Start> moving;
    std::optional<Start> standing;
    std::vector<std::size_t> at(static_cast<std::size_t>(d), 0);
    for (std::size_t i = 0; i < at.size();) {
        Eigen::VectorXd orders(d);
        for (Eigen::Index k = 0; k < d; ++k)
            orders[k] = net[at[static_cast<std::size_t>(k)]];
        const auto still = std::ranges::count(at, std::size_t{0});
        if (still < (has_next_term ? 1 : std::min(d, Eigen::Index{2})))
            if (auto start = start_at(layout, rows, orders)) {
                if (still == 0)
                    moving.push_back(std::move(*start));
                else if (!standing || start->left < standing->left)
                    standing = std::move(start);
            }
        for (i = 0; i < at.size() && ++at[i] == net.size(); ++i)
            at[i] = 0;
    }
    const auto sort = [&] {
        std::stable_sort(moving.begin(), moving.end(),
                         [](const Start& l, const Start& r) { return l.left < r.left; });
    };
    sort();
    for (Eigen::Index i = 0; i < d; ++i)
        if (layout.next(i) >= 0) {
            for (auto& start : std::span(moving).first(std::min(most_moved, moving.size())))
                move_order(layout, rows, i, start);
            sort();
        }
    std::vector<Eigen::VectorXd> starts;
    for (std::size_t k = 0; k < std::min(most_starts, moving.size()); ++k)
        starts.push_back(moving[k].theta);
    if (standing && (moving.empty() || standing->left < moving.front().left))
        starts.push_back(std::move(standing->theta));
    return starts;
}

/// θ of the leading terms with next terms of size zero, and a floor far below.
Eigen::VectorXd lengthened(const Layout& layout, const TermRows& rows,
                           const Eigen::VectorXd& leading) {
    Eigen::VectorXd theta = Eigen::VectorXd::Zero(layout.size());
    theta.head(leading.size()) = leading;
    if (layout.floor() >= 0)
        theta[layout.floor()] = rows.log_errors.minCoeff() - 1;
    return theta;
}

/// The same from a shorter model.
Eigen::VectorXd lengthened(const Layout& layout, const TermRows& rows, const TermFit& simpler) {
    const Eigen::Index shared = layout.pair(layout.widths() - 1, layout.widths());
    Eigen::VectorXd leading = simpler.theta.head(shared);
    // Off the bounds of ρ, where nothing moves it.
    for (Eigen::Index k = 2 * layout.widths(); k < shared; ++k)
        leading[k] = std::asin(std::clamp(std::sin(leading[k]), -most_rho, most_rho));
    return lengthened(layout, rows, leading);
}

/// Where a term has a logarithm, each start with one of size zero, for errors that have none, and
/// of either sign with the same slope in the middle: at zero its derivative and that by the order
/// are one.
std::vector<Eigen::VectorXd> with_logarithms(const Layout& layout,
                                             std::vector<Eigen::VectorXd> starts) {
    constexpr double part = 0.25; // T stays positive over three halvings to either side
    for (Eigen::Index i = 0; i < layout.widths(); ++i) {
        if (layout.next(i) < 0 || layout.power(i) != TermShape::logarithm)
            continue;
        std::vector<Eigen::VectorXd> of_either_sign;
        for (const auto& start : starts)
            for (const double c : {0.0, -part, part}) {
                of_either_sign.push_back(start);
                of_either_sign.back()[layout.next(i)] = c;
                of_either_sign.back()[2 * i + 1] -= c;
            }
        starts = std::move(of_either_sign);
    }
    return starts;
}

/// θ of a fit to other rows, in the units of these: the same curve.
Eigen::VectorXd in_units(const Layout& layout, const TermFit& fit, const Eigen::VectorXd& centre,
                         double log_unit) {
    Eigen::VectorXd theta = fit.theta;
    if (layout.floor() >= 0)
        theta[layout.floor()] += fit.log_unit - log_unit;
    for (Eigen::Index i = 0; i < layout.widths(); ++i) {
        const double shift = centre[i] - fit.log_centre[i];
        theta[2 * i] += fit.log_unit - log_unit + theta[2 * i + 1] * shift;
        const Eigen::Index k = layout.next(i);
        if (k < 0)
            continue;
        if (layout.power(i) != TermShape::logarithm) {
            theta[k] *= std::exp(layout.power(i) == TermShape::constant ? -theta[2 * i + 1] * shift
                                                                        : layout.power(i) * shift);
            continue;
        }
        // 1 + c ln(x/x₀) = (1 + c ln(x₁/x₀)) (1 + c₁ ln(x/x₁))
        const double part = 1 + theta[k] * shift;
        theta[2 * i] += std::log(part); // NaN where the term has its zero there: no start then
        theta[k] /= part;
    }
    return theta;
}

double median_of(Eigen::VectorXd values) {
    std::sort(values.begin(), values.end());
    const auto n = values.size();
    return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// Cauchy's weights again and again, from the least squares on.
LeastSquares reweighted(const ModelFunction& model, const TermRows& rows, LeastSquares fit) {
    if (fit.dof < 1)
        return fit;
    // The median of the residuals is too small by what the parameters take up.
    const double freedom =
        std::sqrt(static_cast<double>(rows.size()) / static_cast<double>(fit.dof));
    for (int k = 0; k < reweightings; ++k) {
        const Eigen::ArrayXd distance =
            fit.residuals.cwiseAbs().cwiseProduct(rows.weights.cwiseSqrt());
        const double scatter =
            std::max(median_of(distance) / median_of_normal * freedom, least_scatter);
        const Eigen::VectorXd weights =
            rows.weights.array() / (1 + (distance / (cauchy * scatter)).square());
        const std::vector<Eigen::VectorXd> from{fit.theta};
        auto next = least_squares(model, rows.log_errors, weights, from, rows.scatter);
        if (!next)
            break;
        constexpr double close = 1e-5;
        const bool stands = (next->theta - fit.theta).lpNorm<Eigen::Infinity>() < close;
        fit = std::move(*next);
        if (stands)
            break;
    }
    return fit;
}

/// Whether one width has a next term, half an order on, and no other has one.
bool is_half_an_order_on(const TermShape& shape) {
    return std::ranges::count(shape.next, 0.5) == 1 &&
           std::ranges::count(shape.next, TermShape::none) + 1 == std::ssize(shape.next);
}

/// The model with all of θ held but for `free`.
ModelFunction held(const ModelFunction& model, const Eigen::VectorXd& theta,
                   const std::vector<Eigen::Index>& free) {
    return [&model, theta, free](const Eigen::VectorXd& some, Eigen::VectorXd& values,
                                 Eigen::MatrixXd* jacobian) {
        Eigen::VectorXd all = theta;
        all(free) = some;
        Eigen::MatrixXd by_all = Eigen::MatrixXd::Zero(values.size(), theta.size());
        model(all, values, jacobian == nullptr ? nullptr : &by_all);
        if (jacobian != nullptr)
            *jacobian = by_all(Eigen::all, free);
    };
}

bool is_rho(const Layout& layout, Eigen::Index k) {
    return k >= 2 * layout.widths() && k < layout.pair(layout.widths() - 1, layout.widths());
}

/// Close to ρ = ±1 sin φ has hardly a derivative, and the search creeps. So from each start with
/// all ρ at their bounds, which is the sum of the terms with signs of their own: to where the best
/// of that ends, if that is far better.
void search_sums_with_signs(const ModelFunction& model, const Layout& layout, const TermRows& rows,
                            std::span<const Eigen::VectorXd> starts, LeastSquares& fit) {
    constexpr Eigen::Index most = 3; // widths: four choices of signs
    const Eigen::Index d = layout.widths();
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < layout.size(); ++k)
        if (!is_rho(layout, k))
            free.push_back(k);
    std::vector<Eigen::VectorXd> there;
    for (unsigned minus = 0; d <= most && minus < 1U << (d - 1); ++minus) {
        const auto is_minus = [&](Eigen::Index i) { return i > 0 && (minus >> (i - 1) & 1U) != 0; };
        Eigen::VectorXd theta = starts.front();
        for (Eigen::Index i = 0; i < d; ++i)
            for (Eigen::Index j = i + 1; j < d; ++j)
                theta[layout.pair(i, j)] =
                    (is_minus(i) == is_minus(j) ? 1 : -1) * std::numbers::pi / 2;
        std::vector<Eigen::VectorXd> from;
        for (const auto& start : starts)
            from.emplace_back(start(free));
        const auto rest = least_squares(held(model, theta, free), rows.log_errors, rows.weights,
                                        from, rows.scatter);
        if (rest && rest->chi2 < fit.chi2) {
            theta(free) = rest->theta;
            there.push_back(theta);
        }
    }
    constexpr double far_better = 10; // of the scale; what is hardly better has stranger orders
    if (auto better = least_squares(model, rows.log_errors, rows.weights, there, rows.scatter);
        better && far_better * better->scale() < fit.scale())
        fit = std::move(*better);
}

/// At ρ = ±1 sin φ has no derivative, and nothing an interval; nor where ρ and the size of a term
/// so small that its square is not seen are one number: the others have theirs with ρ held. Of the
/// leading terms alone, whose sizes are told, that stays open.
LeastSquares with_rho_held(const ModelFunction& model, const Layout& layout, const TermRows& rows,
                           LeastSquares fit) {
    constexpr double at_the_bound = 1e-3; // 1 − |ρ| < 5e-7
    const bool has_next_terms = layout.size() > layout.pair(layout.widths() - 1, layout.widths());
    const bool is_one_number = fit.root.size() == 0 && has_next_terms;
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < layout.size(); ++k)
        if (!is_rho(layout, k) ||
            (!is_one_number && std::abs(std::cos(fit.theta[k])) >= at_the_bound))
            free.push_back(k);
    if (static_cast<Eigen::Index>(free.size()) == layout.size())
        return fit;
    const ModelFunction rest_of_it = held(model, fit.theta, free);
    const std::vector<Eigen::VectorXd> start{fit.theta(free)};
    auto rest = least_squares(rest_of_it, rows.log_errors, rows.weights, start, rows.scatter);
    if (!rest)
        return fit;
    rest = reweighted(rest_of_it, rows, std::move(*rest));
    if (is_one_number && rest->root.size() == 0)
        return fit;
    LeastSquares whole = fit;
    whole.theta(free) = rest->theta;
    whole.covariance.setZero();
    if (is_one_number)
        for (Eigen::Index k = 0; k < layout.size(); ++k)
            if (is_rho(layout, k))
                whole.covariance(k, k) = infinity;
    whole.covariance(free, free) = rest->covariance;
    whole.root.resize(0, 0);
    if (rest->root.size() > 0) {
        whole.root.setZero(layout.size(), rest->root.cols());
        whole.root(free, Eigen::all) = rest->root;
    }
    whole.residuals = rest->residuals;
    whole.chi2 = rest->chi2;
    whole.dof = rest->dof;
    return whole;
}

} // namespace

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

TermSearch::TermSearch(TermRows given)
    : rows_(std::move(given)), log_reference_(rows_.log_reference),
      log_centre_(rows_.log_widths.colwise().mean()),
      // So that squares of errors, and theirs, are numbers, however small or large the errors.
      log_unit_(std::round(rows_.log_errors.mean())) {
    rows_.log_widths.rowwise() -= log_centre_.transpose();
    rows_.log_errors.array() -= log_unit_;
    if (rows_.log_reference.size() > 0)
        rows_.log_reference -= log_centre_;
}

const std::vector<Eigen::VectorXd>& TermSearch::starts() {
    if (starts_.empty()) {
        const TermShape leading{
            std::vector<double>(static_cast<std::size_t>(rows_.widths()), TermShape::none)};
        starts_ = starts_of(Layout(leading, rows_.widths()), rows_);
    }
    return starts_;
}

std::optional<TermFit> TermSearch::fit(const TermShape& shape, const TermFit* simpler,
                                       const TermFit* beside) {
    const TermRows& rows = rows_;
    const Layout layout(shape, rows.widths());
    if (rows.size() < layout.size())
        return std::nullopt;
    const ModelFunction model = model_of(layout, rows);
    const bool has_logarithm = std::ranges::count(shape.next, TermShape::logarithm) > 0;
    std::vector<Eigen::VectorXd> starts;
    if (simpler != nullptr)
        starts.push_back(lengthened(layout, rows, *simpler));
    // From the leading terms alone a logarithm's search often ends in a false valley …
    if (simpler == nullptr || (has_logarithm && beside == nullptr))
        for (const auto& leading : this->starts())
            starts.push_back(lengthened(layout, rows, leading));
    starts = with_logarithms(layout, std::move(starts));
    // … and that of a next term half an order on, beside a term that is far smaller. Others would
    // have a constant in the place of a leading term.
    if (rows.widths() > 1 && beside == nullptr && is_half_an_order_on(shape))
        for (auto& start : starts_of(layout, rows))
            starts.push_back(std::move(start));
    auto best = least_squares(model, rows.log_errors, rows.weights, starts, rows.scatter);
    // Where the search may have ended in a false valley; where two fit to rounding, as rows of few
    // levels allow; and of two logarithms of either sign, which bend the error alike: then that of
    // other rows.
    constexpr double worse = 2;
    if (beside != nullptr && (!best || has_logarithm || best->scale() > worse * beside->scale ||
                              best->scale() <= least_scatter)) {
        const std::vector<Eigen::VectorXd> start{in_units(layout, *beside, log_centre_, log_unit_)};
        auto same = start[0].allFinite()
                        ? least_squares(model, rows.log_errors, rows.weights, start, rows.scatter)
                        : std::nullopt;
        if (same &&
            (!best || same->scale() <=
                          std::max((has_logarithm ? worse : 1.0) * best->scale(), least_scatter)))
            best = std::move(same);
    }
    if (!best)
        return std::nullopt;
    if (simpler == nullptr && beside == nullptr && rows.widths() > 1)
        search_sums_with_signs(model, layout, rows, starts, *best);
    // At a bound of ρ its angle may have gone round many times: a step is small beside it then.
    for (Eigen::Index k = 2 * layout.widths();
         k < layout.pair(layout.widths() - 1, layout.widths()); ++k)
        best->theta[k] = std::remainder(best->theta[k], 2 * std::numbers::pi);
    *best = reweighted(model, rows, std::move(*best));
    // A longer model that fits far worse than the one within it has ended in a false valley.
    constexpr double far_worse = 2;
    if (simpler == nullptr || best->scale() <= far_worse * simpler->scale)
        *best = with_rho_held(model, layout, rows, std::move(*best));
    return TermFit{.shape = shape,
                   .theta = best->theta,
                   .covariance = best->covariance,
                   .root = best->root,
                   .log_centre = log_centre_,
                   .log_unit = log_unit_,
                   .log_reference = log_reference_,
                   .residuals = best->residuals,
                   .scale = best->scale(),
                   .scatter = rows.scatter,
                   .dof = best->dof};
}

} // namespace tvbeam

#include "studies/orders/two_term_regression.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// Orders between which every start of practical interest lies near one of the net; the negative
/// ones let a divergence be fitted as what it is.
constexpr std::array net{-1.0, 0.5, 1.0, 2.0, 4.0};
constexpr std::size_t starts_followed = 3;
/// |ρ| of a start: at ±1 the derivative of sin φ is zero and the search would stay there.
constexpr double steepest_start = 0.98;

enum Theta { log_a, order_p, log_b, order_q, phi, next_h, next_dt };

/// One term and its derivatives by the order and by the factor of the next term.
struct Term {
    double value = 0;
    double by_order = 0;
    double by_next = 0;
};

/// A factor 1 + c e^{kx}.
struct Next {
    double factor = 0;
    double power = 1;
};

Term power_at(double order, const Next& next, double x) {
    const double power = std::exp(order * x);
    const double further = power * std::exp(next.power * x);
    const double sum = power + next.factor * further;
    return {sum, sum * x, further};
}

/// At every level, less what the reference has of it.
std::vector<Term> terms_at(const Eigen::VectorXd& levels, const std::optional<double>& reference,
                           double log_size, double order, const Next& next) {
    const Term less = reference ? power_at(order, next, *reference) : Term{};
    const double size = std::exp(log_size);
    std::vector<Term> terms;
    terms.reserve(static_cast<std::size_t>(levels.size()));
    for (const double x : levels) {
        const Term term = power_at(order, next, x);
        terms.push_back({size * (term.value - less.value), size * (term.by_order - less.by_order),
                         size * (term.by_next - less.by_next)});
    }
    return terms;
}

/// A term of size one, over the error, at every point.
Eigen::ArrayXd unit_term(const TwoTermPoints& points, const LogWidths& widths,
                         const std::optional<double>& reference, double order) {
    const auto terms = terms_at(widths.levels, reference, 0, order, {});
    Eigen::ArrayXd values = (-points.log_error).array().exp();
    for (Eigen::Index i = 0; i < values.size(); ++i)
        values[i] *= terms[static_cast<std::size_t>(widths.level_of[i])].value;
    return values;
}

/// The least-squares solution of a² A² + 2ρab AB + b² B² = e², every row over e², as a start.
/// in_space, in_time: A/e and B/e, for the orders p and q.
Eigen::VectorXd start_for(const Eigen::ArrayXd& root_weights, double p,
                          const Eigen::ArrayXd& in_space, double q, const Eigen::ArrayXd& in_time) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> rows(root_weights.size(), 3);
    rows.col(0) = root_weights * in_space * in_space;
    rows.col(1) = root_weights * in_space * in_time;
    rows.col(2) = root_weights * in_time * in_time;
    Eigen::Matrix3d normal = rows.transpose().lazyProduct(rows);
    Eigen::Vector3d right = rows.transpose().lazyProduct(root_weights.matrix());
    // Columns of one length: the two terms may be many powers of ten apart.
    Eigen::Vector3d lengths = normal.diagonal().cwiseSqrt();
    lengths = (lengths.array() > 0).select(lengths, 1.0);
    normal.array() /= (lengths * lengths.transpose()).array();
    right.array() /= lengths.array();
    // Where A is a power of B, as on a ladder, columns may be one: their sizes are then shared.
    normal.diagonal().array() += 1e-12;
    const Eigen::Vector3d solution = normal.llt().solve(right);
    // A square that comes out negative: the term is small, not absent.
    constexpr double least = 1e-4;
    const double size = std::max(solution.cwiseAbs().maxCoeff(), 1e-300);
    const double a2 = std::max(solution[0], least * size) / lengths[0];
    const double b2 = std::max(solution[2], least * size) / lengths[2];
    const double rho = solution[1] / lengths[1] / (2 * std::sqrt(a2 * b2));
    Eigen::VectorXd theta(two_term_parameters);
    theta << 0.5 * std::log(a2), p, 0.5 * std::log(b2), q,
        std::asin(std::clamp(rho, -steepest_start, steepest_start));
    return theta;
}

double rho_of(const TwoTermPoints& points, const Eigen::VectorXd& theta) {
    return points.fixed_rho ? *points.fixed_rho : std::sin(theta[phi]);
}

Eigen::Index parameters_of(const TwoTermPoints& points) {
    if (points.fixed_rho)
        return two_term_parameters - 1;
    return two_term_parameters + (points.next_terms ? next_term_parameters : 0);
}

double cost(const TwoTermPoints& points, const Eigen::VectorXd& theta) {
    Eigen::VectorXd values(points.size());
    two_term_values(points, theta, values, nullptr);
    const double sum = points.weights.dot((points.log_error - values).cwiseAbs2());
    return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

std::vector<Eigen::VectorXd> starts_for(const TwoTermPoints& points) {
    std::vector<std::pair<double, Eigen::VectorXd>> starts;
    const Eigen::ArrayXd root_weights = points.weights.cwiseSqrt();
    std::array<Eigen::ArrayXd, net.size()> in_time;
    for (std::size_t k = 0; k < net.size(); ++k)
        in_time[k] = unit_term(points, points.log_dt, points.reference_log_dt, net[k]);
    for (const double p : net) {
        const auto in_space = unit_term(points, points.log_h, points.reference_log_h, p);
        for (std::size_t k = 0; k < net.size(); ++k) {
            auto theta = start_for(root_weights, p, in_space, net[k], in_time[k]);
            const double sum =
                theta.allFinite() ? cost(points, theta) : std::numeric_limits<double>::infinity();
            if (std::isfinite(sum))
                starts.emplace_back(sum, std::move(theta));
        }
    }
    std::sort(starts.begin(), starts.end(),
              [](const auto& left, const auto& right) { return left.first < right.first; });
    starts.resize(std::min(starts.size(), starts_followed));
    std::vector<Eigen::VectorXd> thetas;
    thetas.reserve(starts.size());
    for (auto& start : starts)
        thetas.push_back(std::move(start.second));
    return thetas;
}

} // namespace

LogWidths LogWidths::of(const Eigen::VectorXd& log_widths) {
    const std::set<double> distinct(log_widths.begin(), log_widths.end());
    LogWidths widths{Eigen::VectorXd(static_cast<Eigen::Index>(distinct.size())),
                     Eigen::VectorX<Eigen::Index>(log_widths.size())};
    std::copy(distinct.begin(), distinct.end(), widths.levels.begin());
    for (Eigen::Index i = 0; i < log_widths.size(); ++i)
        widths.level_of[i] =
            std::lower_bound(widths.levels.begin(), widths.levels.end(), log_widths[i]) -
            widths.levels.begin();
    return widths;
}

TwoTermPoints TwoTermPoints::subset(const std::vector<Eigen::Index>& chosen) const {
    TwoTermPoints part = *this;
    part.log_h.level_of = log_h.level_of(chosen);
    part.log_dt.level_of = log_dt.level_of(chosen);
    part.log_error = log_error(chosen);
    part.weights = weights(chosen);
    return part;
}

void two_term_values(const TwoTermPoints& points, const Eigen::VectorXd& theta,
                     Eigen::VectorXd& values, Eigen::MatrixXd* jacobian) {
    const double rho = rho_of(points, theta);
    const double sign = rho < 0 ? -1.0 : 1.0;
    Next c;
    Next d;
    if (points.next_terms) {
        c = {theta[next_h], points.next_terms->in_h};
        d = {theta[next_dt], points.next_terms->in_dt};
    }
    const auto in_h =
        terms_at(points.log_h.levels, points.reference_log_h, theta[log_a], theta[order_p], c);
    const auto in_dt =
        terms_at(points.log_dt.levels, points.reference_log_dt, theta[log_b], theta[order_q], d);
    const double rho_by_phi = points.fixed_rho ? 0.0 : std::cos(theta[phi]);
    for (Eigen::Index i = 0; i < points.size(); ++i) {
        const Term& in_space = in_h[static_cast<std::size_t>(points.log_h.level_of[i])];
        const Term& in_time = in_dt[static_cast<std::size_t>(points.log_dt.level_of[i])];
        // As TwoTermModel::error: no digit of a difference is lost near ρ = ±1.
        const double sum = in_space.value + sign * in_time.value;
        const double square =
            sum * sum + 2 * sign * (std::abs(rho) - 1) * in_space.value * in_time.value;
        const bool admissible = in_space.value >= 0 && in_time.value >= 0 && square > 0;
        values[i] = admissible ? 0.5 * std::log(square) : std::nan("");
        if (jacobian == nullptr)
            continue;
        const double by_space = (in_space.value + rho * in_time.value) / square;
        const double by_time = (in_time.value + rho * in_space.value) / square;
        (*jacobian)(i, log_a) = by_space * in_space.value;
        (*jacobian)(i, order_p) = by_space * in_space.by_order;
        (*jacobian)(i, log_b) = by_time * in_time.value;
        (*jacobian)(i, order_q) = by_time * in_time.by_order;
        if (!points.fixed_rho)
            (*jacobian)(i, phi) = in_space.value * in_time.value / square * rho_by_phi;
        if (points.next_terms) {
            (*jacobian)(i, next_h) = by_space * in_space.by_next;
            (*jacobian)(i, next_dt) = by_time * in_time.by_next;
        }
    }
}

std::optional<LeastSquares> two_term_regression(const TwoTermPoints& points,
                                                const std::optional<Eigen::VectorXd>& warm_start) {
    auto starts = warm_start ? std::vector{*warm_start} : starts_for(points);
    for (auto& start : starts) {
        // ρ goes where it is held, and the next terms start from nothing.
        const Eigen::VectorXd given = start;
        start = Eigen::VectorXd::Zero(parameters_of(points));
        const auto common = std::min(given.size(), start.size());
        start.head(common) = given.head(common);
    }
    const ModelFunction model = [&points](const Eigen::VectorXd& theta, Eigen::VectorXd& values,
                                          Eigen::MatrixXd* jacobian) {
        two_term_values(points, theta, values, jacobian);
    };
    return least_squares(model, points.log_error, points.weights, starts);
}

TwoTermModel two_term_model(const TwoTermPoints& points, const Eigen::VectorXd& theta) {
    return {.a = std::exp(theta[log_a] - theta[order_p] * points.log_h_centre),
            .p = theta[order_p],
            .b = std::exp(theta[log_b] - theta[order_q] * points.log_dt_centre),
            .q = theta[order_q],
            .rho = rho_of(points, theta)};
}

Eigen::MatrixXd two_term_covariance(const TwoTermPoints& points, const LeastSquares& fit) {
    constexpr auto infinity = std::numeric_limits<double>::infinity();
    if (!fit.covariance.allFinite())
        return Eigen::VectorXd::Constant(two_term_parameters, infinity).asDiagonal();
    Eigen::MatrixXd back = Eigen::MatrixXd::Identity(two_term_parameters, two_term_parameters);
    back(log_a, order_p) = -points.log_h_centre;
    back(log_b, order_q) = -points.log_dt_centre;
    Eigen::MatrixXd by_theta = Eigen::MatrixXd::Zero(two_term_parameters, two_term_parameters);
    by_theta.topLeftCorner(fit.theta.size(), fit.theta.size()) = fit.covariance;
    back(phi, phi) = points.fixed_rho ? 0.0 : std::cos(fit.theta[phi]);
    return back * by_theta * back.transpose();
}

} // namespace tvbeam

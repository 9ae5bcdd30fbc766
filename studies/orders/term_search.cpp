#include "studies/orders/term_search.hpp"

#include "studies/orders/term_layout.hpp"
#include "studies/orders/term_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tvbeam {

namespace {

/// Cauchy's function with this is 95 % efficient under normal scatter.
constexpr double cauchy = 2.385;
/// The median of |z| over the standard deviation of a normal z.
constexpr double median_of_normal = 0.6745;
constexpr int reweightings = 4;

double median_of(Eigen::VectorXd values) {
    std::sort(values.begin(), values.end());
    const auto n = values.size();
    return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// Cauchy's weights again and again, from the least squares on.
LeastSquares reweighted(const ModelFunction& model, const TermRows& rows, LeastSquares fit,
                        const std::vector<Eigen::Index>& rhos) {
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
        auto next = least_squares(model, rows.log_errors, weights, from, rows.scatter, rhos);
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

/// Three terms may cancel in part with either sign of each, and from a start between the bounds of
/// ρ the search often ends in a false valley. So from each start with all ρ at their bounds, which
/// is the sum of the terms with signs of their own: to where the best of that ends, if that is far
/// better.
void search_sums_with_signs(const ModelFunction& model, const Layout& layout, const TermRows& rows,
                            const std::vector<Eigen::VectorXd>& starts, LeastSquares& fit) {
    constexpr Eigen::Index three = 3; // of two none is lost; of more there are too many signs
    if (layout.widths() != three || fit.scale() <= least_scatter)
        return;
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < layout.size(); ++k)
        if (!layout.is_rho(k))
            free.push_back(k);
    std::vector<Eigen::VectorXd> there;
    for (const auto& signs : {std::array{1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {1, -1, -1}}) {
        Eigen::VectorXd theta = starts.front();
        for (Eigen::Index i = 0; i < three; ++i)
            for (Eigen::Index j = i + 1; j < three; ++j)
                theta[layout.pair(i, j)] =
                    signs[static_cast<std::size_t>(i)] * signs[static_cast<std::size_t>(j)];
        std::vector<Eigen::VectorXd> from;
        from.reserve(starts.size());
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
    if (auto better =
            least_squares(model, rows.log_errors, rows.weights, there, rows.scatter, layout.rhos());
        better && far_better * better->scale() < fit.scale())
        fit = std::move(*better);
}

/// At a bound ρ cannot move with the others, and where it and the size of a term so small that its
/// square is not seen are one number, nothing has an interval: the others have theirs with ρ held.
/// Of the leading terms alone, whose sizes are told, that stays open.
LeastSquares with_rho_held(const ModelFunction& model, const Layout& layout, const TermRows& rows,
                           LeastSquares fit) {
    constexpr double at_the_bound = 1 - 5e-7; // and nearer
    const bool has_next_terms = layout.size() > layout.pair(layout.widths() - 1, layout.widths());
    const bool is_one_number = fit.root.size() == 0 && has_next_terms;
    std::vector<Eigen::Index> free;
    std::vector<Eigen::Index> free_rhos; // their places among these
    for (Eigen::Index k = 0; k < layout.size(); ++k)
        if (!layout.is_rho(k) || (!is_one_number && std::abs(fit.theta[k]) <= at_the_bound)) {
            if (layout.is_rho(k))
                free_rhos.push_back(std::ssize(free));
            free.push_back(k);
        }
    if (static_cast<Eigen::Index>(free.size()) == layout.size())
        return fit;
    const ModelFunction rest_of_it = held(model, fit.theta, free);
    const std::vector<Eigen::VectorXd> start{fit.theta(free)};
    auto rest =
        least_squares(rest_of_it, rows.log_errors, rows.weights, start, rows.scatter, free_rhos);
    if (!rest)
        return fit;
    rest = reweighted(rest_of_it, rows, std::move(*rest), free_rhos);
    if (is_one_number && rest->root.size() == 0)
        return fit;
    LeastSquares whole = fit;
    whole.theta(free) = rest->theta;
    whole.covariance.setZero();
    if (is_one_number)
        for (Eigen::Index k = 0; k < layout.size(); ++k)
            if (layout.is_rho(k))
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
    const auto rhos = layout.rhos();
    auto best = least_squares(model, rows.log_errors, rows.weights, starts, rows.scatter, rhos);
    // Where the search may have ended in a false valley; where two fit to rounding, as rows of few
    // levels allow; and of two logarithms of either sign, which bend the error alike: then that of
    // other rows.
    constexpr double worse = 2;
    if (beside != nullptr && (!best || has_logarithm || best->scale() > worse * beside->scale ||
                              best->scale() <= least_scatter)) {
        const std::vector<Eigen::VectorXd> start{in_units(layout, *beside, log_centre_, log_unit_)};
        auto same = start[0].allFinite() ? least_squares(model, rows.log_errors, rows.weights,
                                                         start, rows.scatter, rhos)
                                         : std::nullopt;
        if (same &&
            (!best || same->scale() <=
                          std::max((has_logarithm ? worse : 1.0) * best->scale(), least_scatter)))
            best = std::move(same);
    }
    if (!best)
        return std::nullopt;
    if (simpler == nullptr && beside == nullptr)
        search_sums_with_signs(model, layout, rows, starts, *best);
    *best = reweighted(model, rows, std::move(*best), rhos);
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
                   .in_squares = rows.in_squares,
                   .residuals = best->residuals,
                   .scale = best->scale(),
                   .scatter = rows.scatter,
                   .dof = best->dof};
}

} // namespace tvbeam

#include "studies/orders/two_term_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tvbeam {

namespace {

constexpr std::size_t fewest_records = 7;
/// A row is out of line where it is further off than this many times the scatter, and than what no
/// model shows (OrderTuning::narrowest).
constexpr double out_of_line = 6;
/// Residuals that are more alike in neighbouring rows than this, and larger than that, are none of
/// scatter. Of grids of 16 with scatter, none of 300 has both, and all of 200 whose error is a
/// product of its terms, or has three times the root of that product beside them.
constexpr double most_alike = 0.3;
constexpr double least_misfit = 0.05;

/// Why a record has no logarithm that a fit may use; none where it has.
std::optional<RejectedRecord> unusable(const Refinement& record, std::size_t i) {
    if (!is_positive(record.h) || !is_positive(record.dt))
        return RejectedRecord{i, Rejection::failed, "no error: h or dt is missing or not positive"};
    if (record.error == 0)
        return RejectedRecord{i, Rejection::exact, "the error is zero and has no logarithm"};
    if (!is_positive(record.error))
        return RejectedRecord{i, Rejection::failed, "no error: it is not a positive number"};
    if (!record.is_resolved())
        return RejectedRecord{
            i, Rejection::unresolved,
            fmt::format("the error is uncertain by {:.1e} of itself", record.uncertainty)};
    return std::nullopt;
}

/// The term of one width as size · x^order with the engine's order; nothing where it is hidden.
void set_term(const TermFit& fit, Eigen::Index width, const OrderInterval& order, double least,
              double& size, double& power) {
    if (order.share < least) {
        size = 0;
        power = std::numeric_limits<double>::quiet_NaN();
        return;
    }
    power = order.value;
    size = std::exp(fit.log_unit + fit.theta[2 * width] - power * fit.log_centre[width]);
}

/// Which of the usable records the steadiest fit rests on, and why the others are left out.
void sort_records(std::span<const Refinement> records, const std::vector<std::size_t>& usable,
                  const EnsembleMember& steadiest, TwoTermFit& fit) {
    const double limit = std::max(out_of_line * fit.rms, fit.ensemble->tuning().narrowest);
    for (const auto i : usable) {
        const Eigen::Vector2d at(std::log(records[i].h), std::log(records[i].dt));
        const double off = std::log(records[i].error) - steadiest.fit.log_error(at, true).value;
        if (!fit.ensemble->holds(steadiest, {records[i].h, records[i].dt}))
            fit.rejected.push_back(
                {i, Rejection::pre_asymptotic,
                 std::abs(off) < fit.ensemble->tuning().narrowest
                     ? std::string("coarser than the window of the fit; the error is the model's "
                                   "within 1 %")
                     : fmt::format("too coarse for the model: the error is {:.3g} times the "
                                   "model's",
                                   std::exp(off))});
        else if (!(std::abs(off) <= limit))
            fit.rejected.push_back(
                {i, Rejection::outlier,
                 fmt::format(
                     "out of line with its neighbours: the error is {:.3g} times the model's",
                     std::exp(off))});
        else
            fit.used.push_back(i);
    }
    std::sort(fit.rejected.begin(), fit.rejected.end(),
              [](const auto& left, const auto& right) { return left.record < right.record; });
}

/// The mean product of residuals of rows that are neighbours along one width, over their mean
/// square: about −0.2 for scatter, as the fit takes up what is smooth; 1 where they go one way. And
/// the root of that mean square.
struct Misfit {
    double alike = 0;
    double rms = 0;
};

Misfit misfit_of(std::span<const Refinement> records, const std::vector<std::size_t>& usable,
                 const EnsembleMember& member, const OrderEnsemble& ensemble) {
    struct Residual {
        double h, dt, off;
    };
    std::vector<Residual> rows;
    for (const auto i : usable)
        if (ensemble.holds(member, {records[i].h, records[i].dt})) {
            const Eigen::Vector2d at(std::log(records[i].h), std::log(records[i].dt));
            rows.push_back({records[i].h, records[i].dt,
                            std::log(records[i].error) - member.fit.log_error(at, true).value});
        }
    // The fit is robust: what is out of its line says nothing of the rest, unless it is much of it.
    const double limit = std::max(out_of_line * member.fit.scale, ensemble.tuning().narrowest);
    const auto is_out = [&](const Residual& row) { return !(std::abs(row.off) <= limit); };
    if (5 * std::ranges::count_if(rows, is_out) <= std::ssize(rows))
        std::erase_if(rows, is_out);
    double squares = 0;
    for (const auto& row : rows)
        squares += row.off * row.off;
    double products = 0;
    int pairs = 0;
    // The next finer row of one width with the same other.
    const auto add_next = [&](const Residual& row, double Residual::*same,
                              double Residual::*finer) {
        const Residual* next = nullptr;
        for (const auto& other : rows)
            if (other.*same == row.*same && other.*finer < row.*finer &&
                (next == nullptr || other.*finer > next->*finer))
                next = &other;
        if (next != nullptr) {
            products += row.off * next->off;
            ++pairs;
        }
    };
    for (const auto& row : rows) {
        add_next(row, &Residual::h, &Residual::dt);
        add_next(row, &Residual::dt, &Residual::h);
    }
    if (pairs == 0 || !(squares > 0))
        return {};
    const double mean = squares / static_cast<double>(rows.size());
    return {products / pairs / mean, std::sqrt(mean)};
}

} // namespace

const char* words_for(Rejection why) {
    switch (why) {
    case Rejection::failed:
        return "no error";
    case Rejection::unresolved:
        return "quadrature does not resolve what is integrated";
    case Rejection::exact:
        return "the error is zero, or rounding where terms cancel";
    case Rejection::pre_asymptotic:
        return "coarser than the window of the fit";
    case Rejection::outlier:
        break;
    }
    return "out of line with their neighbours";
}

Verdict verdict_of(Rejection why) {
    switch (why) {
    case Rejection::failed:
        return Verdict::failed;
    case Rejection::unresolved:
        return Verdict::unresolved;
    case Rejection::exact:
        return Verdict::exact;
    case Rejection::pre_asymptotic:
        return Verdict::pre_asymptotic;
    case Rejection::outlier:
        break;
    }
    return Verdict::outlier;
}

TwoTermFit fit_two_term(std::span<const Refinement> records,
                        const std::optional<Refinement>& reference,
                        const std::vector<double>& sigma) {
    TwoTermFit fit;
    std::vector<std::size_t> usable;
    std::vector<ErrorRow> rows;
    std::vector<ErrorRow> given;
    for (const auto& record : records)
        given.push_back({{record.h, record.dt}, record.error});
    const auto is_cancelled = cancelled_rows(given);
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (reference && (reference->h > records[i].h || reference->dt > records[i].dt ||
                          reference->h <= 0 || reference->dt <= 0))
            throw std::invalid_argument("the reference must be as fine as every record");
        if (auto why = unusable(records[i], i)) {
            fit.rejected.push_back(std::move(*why));
            continue;
        }
        if (is_cancelled[i]) {
            fit.rejected.push_back(
                {i, Rejection::exact, "the terms cancel there, and rounding is left of the error"});
            continue;
        }
        usable.push_back(i);
        rows.push_back(given[i]);
        if (!sigma.empty())
            rows.back().sigma = sigma[i] / records[i].error;
    }
    fit.ensemble.emplace(rows, reference ? std::vector{reference->h, reference->dt}
                                         : std::vector<double>{});
    const auto* steadiest = fit.ensemble->steadiest();
    const bool are_too_few = usable.size() < fewest_records || !fit.ensemble->failure().empty();
    if (are_too_few || steadiest == nullptr) {
        fit.failure = are_too_few
                          ? "the two-term model needs seven finite, positive errors in three h and "
                            "three dt, each an eighth or more apart"
                          : "no two terms of positive orders follow the errors";
        return fit;
    }
    double known = 0; // the mean square of the stated deviations
    for (const auto& row : rows)
        if (std::isfinite(row.sigma))
            known += row.sigma * row.sigma / static_cast<double>(usable.size());
    if (const Misfit misfit = misfit_of(records, usable, *steadiest, *fit.ensemble);
        misfit.alike > most_alike && misfit.rms > std::max(least_misfit, 2 * std::sqrt(known))) {
        fit.misfit =
            fmt::format("the sum of two terms does not fit: it is off by a factor of {:.2f}, "
                        "alike in neighbouring rows",
                        std::exp(misfit.rms));
        if (std::ranges::none_of(fit.ensemble->members(), [&](const EnsembleMember& member) {
                return member.along < 0 && member.place == steadiest->place &&
                       member.fit.scale < least_misfit;
            })) {
            fit.failure = fit.misfit;
            return fit;
        }
    }
    const auto orders = fit.ensemble->orders();
    fit.p = orders[0];
    fit.q = orders[1];
    const auto* sizes = steadiest;
    if (const auto* moving = fit.ensemble->without_idle_widths())
        sizes = moving->steadiest();
    const double least = fit.ensemble->tuning().least_share;
    const auto set = [&](Eigen::Index width, const OrderInterval& order, double& size,
                         double& power, double& error, double& uncertainty) {
        power = std::numeric_limits<double>::quiet_NaN();
        const auto place = fit.ensemble->place_among_moving(width);
        if (sizes == nullptr || !place)
            return;
        set_term(sizes->fit, *place, order, least, size, power);
        error = sizes->fit.order(*place).error;
        const auto* moving = fit.ensemble->without_idle_widths();
        const auto of = (moving == nullptr ? *fit.ensemble : *moving).size(*place, order);
        uncertainty = std::max(of.high / size, size / of.low) - 1;
        if (!std::isfinite(uncertainty))
            uncertainty = std::numeric_limits<double>::infinity();
    };
    set(0, fit.p, fit.model.a, fit.model.p, fit.p_se, fit.a_uncertainty);
    set(1, fit.q, fit.model.b, fit.model.q, fit.q_se, fit.b_uncertainty);
    const auto rho = steadiest->fit.correlation(0, 1);
    fit.model.rho = fit.model.a > 0 && fit.model.b > 0 ? rho.value : 0;
    fit.rho_se = rho.error;
    fit.rms = steadiest->fit.scale;
    sort_records(records, usable, *steadiest, fit);
    return fit;
}

} // namespace tvbeam

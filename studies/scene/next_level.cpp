#include "studies/scene/next_level.hpp"

#include "mms/expression/number_expression.hpp"
#include "studies/scene/study_keys.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// Without what the last digits of a power add to it: 2, where it is 1.9999999999999998.
double rounded(double ratio) {
    constexpr double digits = 1e9;
    return std::round(ratio * digits) / digits;
}

/// How levels are added.
class RefinedLevels {
public:
    RefinedLevels(const std::vector<Rung>& named, double final_time,
                  std::optional<SourceText> formula)
        : last_named_(named.back()), count_(named.size()), final_time_(final_time),
          formula_(std::move(formula)) {
        const Rung& first = named.front();
        const double root = 1.0 / static_cast<double>(distinct(named) - 1);
        const double elements = first.has_mesh() ? static_cast<double>(last_named_.elements) /
                                                       static_cast<double>(first.elements)
                                                 : 1.0;
        const double steps = first.has_steps() ? first.dt / last_named_.dt : 1.0;
        // Both by the same power, so that the path through h and dt stays the same.
        const double refined = elements > 1.0 ? elements : steps;
        const double power = std::max(root, std::log(least_ratio_of_levels) / std::log(refined));
        elements_ = rounded(std::pow(elements, power));
        steps_ = rounded(std::pow(steps, power));
    }

    std::optional<Rung> operator()(const std::vector<Rung>& levels) const {
        const auto added = static_cast<double>(levels.size() + 1 - count_);
        Rung next;
        if (last_named_.has_mesh()) {
            const double elements =
                static_cast<double>(last_named_.elements) * std::pow(elements_, added);
            if (!(elements <= static_cast<double>(most_elements)))
                return std::nullopt;
            next.elements = std::llround(elements);
        }
        return last_named_.has_steps() ? with_steps(next, added) : next;
    }

private:
    /// Without those that a ladder has twice.
    static std::size_t distinct(const std::vector<Rung>& named) {
        std::set<std::pair<std::int64_t, double>> widths;
        for (const Rung& rung : named)
            widths.emplace(rung.elements, rung.has_steps() ? rung.dt : 0.0);
        return widths.size();
    }

    [[nodiscard]] std::optional<Rung> with_steps(Rung next, double added) const {
        next.dt = formula_ ? number_from_expression(*formula_,
                                                    {{"s", static_cast<double>(next.elements)}})
                           : last_named_.dt / std::pow(steps_, added);
        if (!(next.dt > 0.0) || final_time_ / next.dt > most_steps)
            return std::nullopt;
        if (final_time_ > 0.0) {
            next.steps = std::max<std::int64_t>(1, std::llround(final_time_ / next.dt));
            const double whole = final_time_ / static_cast<double>(next.steps);
            if (std::abs(whole - next.dt) > 1e-9 * next.dt)
                next.dt = whole;
        }
        return next;
    }

    Rung last_named_;
    std::size_t count_;
    double final_time_;
    std::optional<SourceText> formula_;
    double elements_ = 1.0; ///< by which a level has more
    double steps_ = 1.0;
};

} // namespace

NextLevel next_level(const std::vector<Rung>& named, double final_time,
                     std::optional<SourceText> formula) {
    return RefinedLevels(named, final_time, std::move(formula));
}

} // namespace tvbeam

#include "studies/gates/check.hpp"

#include "mms/text/nearest_name.hpp"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tvbeam {

namespace {

using Figure = Expectation::Figure;

std::string text_of(double value) {
    std::ostringstream text;
    text.precision(6);
    text << value;
    return text.str();
}

CheckedExpectation held(const Expectation& expectation, const std::string& what,
                        std::optional<double> figure, const std::string& absence) {
    CheckedExpectation checked;
    checked.what = what;
    checked.expected = text_of(expectation.lowest) + " to " + text_of(expectation.highest);
    checked.place = expectation.place;
    checked.found = figure ? text_of(*figure) : absence;
    // A figure that is not a number lies in no band.
    checked.holds = figure && *figure >= expectation.lowest && *figure <= expectation.highest;
    return checked;
}

std::string rung_text(const RungResult& rung) {
    return "s = " + std::to_string(rung.rung.elements) + ", dt = " + text_of(rung.rung.dt);
}

std::string absence_of(const RungResult& rung, const std::string& otherwise) {
    return rung.reason.empty() ? otherwise : "no error: " + rung.reason;
}

/// The ratio of two norms from that of their squares, if squares they are: the model is one of the
/// norm itself.
double of_norm(const Norm& norm, double ratio) {
    return norm.squared ? std::sqrt(ratio) : ratio;
}

/// Rungs finer in h or dt than every run of the grid: there a prediction is one.
bool beyond(const Rung& rung, const std::vector<RungResult>& grid) {
    return std::all_of(grid.begin(), grid.end(), [&](const RungResult& run) {
        return rung.elements > run.rung.elements || rung.dt < run.rung.dt;
    });
}

class Checker {
public:
    explicit Checker(const StudyResult& result) : result_(result), studies_(result.runs()) {}

    void add(const Expectation& expectation) {
        switch (expectation.figure) {
        case Figure::error:
            add_figure(expectation, expectation.rung, "error",
                       error(expectation, expectation.rung));
            break;
        case Figure::order:
            add_orders(expectation);
            break;
        case Figure::ratio:
            add_ratio(expectation);
            break;
        case Figure::predicted:
            add_predicted(expectation);
            break;
        case Figure::constant:
            add_constant(expectation);
            break;
        case Figure::named:
            add_named(expectation);
            break;
        default:
            add_fit(expectation);
        }
    }

    [[nodiscard]] std::vector<CheckedExpectation> take() { return std::move(checked_); }

private:
    /// The runs that an expectation is about.
    [[nodiscard]] const MeasuredRuns& measured(const Expectation& expectation) const {
        return *std::find_if(studies_.begin(), studies_.end(), [&](const MeasuredRuns& study) {
            return study.study == expectation.study;
        });
    }

    /// The index of its norm among theirs.
    [[nodiscard]] std::size_t norm_index(const Expectation& expectation) const {
        const auto& norms = *measured(expectation).norms;
        return static_cast<std::size_t>(
            std::find_if(norms.begin(), norms.end(),
                         [&](const Norm& norm) { return norm.name == expectation.norm; }) -
            norms.begin());
    }

    [[nodiscard]] std::optional<double> error(const Expectation& expectation,
                                              std::size_t row) const {
        const auto& errors = (*measured(expectation).runs)[row].errors;
        return errors.empty() ? std::nullopt : std::optional(errors[norm_index(expectation)]);
    }

    void add_figure(const Expectation& expectation, std::size_t row, const std::string& name,
                    std::optional<double> figure, const std::string& otherwise = "undefined") {
        const RungResult& run = (*measured(expectation).runs)[row];
        checked_.push_back(
            held(expectation,
                 expectation.study + "." + expectation.norm + ": " + name + " at " + rung_text(run),
                 figure, absence_of(run, otherwise)));
    }

    void add_orders(const Expectation& expectation) {
        const auto orders =
            observed_orders(records_of(*measured(expectation).runs, norm_index(expectation)));
        for (std::size_t row = 1; row < orders.size(); ++row)
            add_figure(expectation, row, "observed order", orders[row]);
        if (orders.size() < 2)
            add_figure(expectation, 0, "observed order", std::nullopt,
                       "nothing: a ladder of one rung has no order");
    }

    void add_ratio(const Expectation& expectation) {
        const std::size_t row = expectation.rung;
        const double printed = result_.scene.ladder->printed->figures.at(expectation.norm)[row];
        const auto value = error(expectation, row);
        add_figure(expectation, row, "ratio to the printed figure",
                   value ? std::optional(*value / printed) : std::nullopt);
    }

    void add_predicted(const Expectation& expectation) {
        const LadderNorm& norm = result_.ladder->norms[norm_index(expectation)];
        bool some = false;
        for (std::size_t row = 0; row < norm.predictions.size(); ++row)
            if (beyond(result_.ladder->rungs[row].rung, result_.orders->runs)) {
                const auto value = error(expectation, row);
                add_figure(expectation, row, "ratio to the two-term model's prediction",
                           value
                               ? std::optional(of_norm(norm.norm, *value / *norm.predictions[row]))
                               : std::nullopt);
                some = true;
            }
        if (!some)
            checked_.push_back(held(
                expectation, "ladder." + expectation.norm + ": prediction", std::nullopt,
                norm.predictions.empty() ? "no two-term model: [orders] is missing, has another "
                                           "final_time, or its fit failed"
                                         : "no rung is finer than the grid of [orders]"));
    }

    void add_fit(const Expectation& expectation) {
        const auto& norms = result_.orders->norms;
        const auto at = std::find_if(norms.begin(), norms.end(), [&](const NormOrders& orders) {
            return orders.norm == expectation.norm;
        });
        const TwoTermModel& model = at->fit.model;
        const auto [name, figure] = [&]() -> std::pair<std::string, double> {
            switch (expectation.figure) {
            case Figure::p:
                return {"p, the order in h", model.p};
            case Figure::q:
                return {"q, the order in dt", model.q};
            case Figure::a:
                return {"a, the constant of h^p", model.a};
            case Figure::b:
                return {"b, the constant of dt^q", model.b};
            default:
                return {"rho", model.rho};
            }
        }();
        // An order that the grid does not determine, or less well than its band is wide, says
        // nothing about the band.
        const TwoTermFit& fit = at->fit;
        const double width = expectation.highest - expectation.lowest;
        const bool known = fit.holds() &&
                           (expectation.figure != Figure::p ||
                            (fit.p_determined() && fit.p_uncertainty() <= width)) &&
                           (expectation.figure != Figure::q ||
                            (fit.q_determined() && fit.q_uncertainty() <= width));
        checked_.push_back(held(expectation, "orders." + expectation.norm + ": " + name,
                                known ? std::optional(figure) : std::nullopt,
                                fit.holds()
                                    ? text_of(figure) + ", not determined well enough for this band"
                                    : fit.failure));
    }

    void add_constant(const Expectation& expectation) {
        const auto& corollary = result_.orders->corollary;
        checked_.push_back(held(expectation, "orders.corollary: greatest constant C",
                                corollary ? std::optional(corollary->greatest) : std::nullopt,
                                "no run of the grid has an error"));
    }

    void add_named(const Expectation& expectation) {
        const auto figures = expectation.study == "stress" ? result_.stress->figures()
                                                           : result_.evolution->figures();
        std::vector<std::string> names;
        names.reserve(figures.size());
        for (const auto& [name, figure] : figures)
            names.push_back(name);
        const auto found = figures.find(expectation.norm);
        checked_.push_back(
            held(expectation, expectation.study + "." + expectation.norm,
                 found == figures.end() ? std::nullopt : std::optional(found->second),
                 "no figure of this name" + did_you_mean(expectation.norm, names) +
                     "; the study has " + boost::algorithm::join(names, ", ")));
    }

    const StudyResult& result_;
    std::vector<MeasuredRuns> studies_;
    std::vector<CheckedExpectation> checked_;
};

} // namespace

std::vector<CheckedExpectation> check(const StudyResult& result) {
    Checker checker(result);
    for (const auto& expectation : result.scene.expectations)
        checker.add(expectation);
    return checker.take();
}

} // namespace tvbeam

#include "core/problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvbeam {

bool Stops::exist() const {
    return std::isfinite(lower) || std::isfinite(upper);
}

bool Field::uses(Eigen::Index profile) const {
    return std::any_of(terms.begin(), terms.end(),
                       [&](const Term& term) { return term.profile == profile; });
}

Field sum(const Field& a, const Field& b) {
    Field result = a;
    result.terms.insert(result.terms.end(), b.terms.begin(), b.terms.end());
    result.gentle = (!a.rest || a.gentle) && (!b.rest || b.gentle) && (a.rest || b.rest);
    if (!a.rest)
        result.rest = b.rest;
    else if (b.rest)
        result.rest = [a = a.rest, b = b.rest](const Eigen::ArrayXd& x,
                                               double t) -> Eigen::ArrayXd {
            return a(x, t) + b(x, t);
        };
    return result;
}

namespace {

/// A field of `added` as one of the sum of both problems.
Field moved(const ProblemData& problem, Field field, double factor) {
    for (auto& term : field.terms) {
        term.amplitude += problem.amplitude_count;
        term.profile += static_cast<Eigen::Index>(problem.profiles.size());
    }
    if (field.rest)
        field.rest = [factor, rest = std::move(field.rest)](const Eigen::ArrayXd& x,
                                                            double t) -> Eigen::ArrayXd {
            return factor * rest(x, t);
        };
    return field;
}

/// Those of both, and behind them the sum of their end moments.
Amplitudes amplitudes_of_sum(const ProblemData& problem, const ProblemData& added, double factor) {
    const auto part = [](const ProblemData& of) {
        return [amplitudes = of.amplitudes, count = of.amplitude_count,
                moment = of.end_moment](const Eigen::ArrayXd& t) {
            Eigen::ArrayXXd values = Eigen::ArrayXXd::Zero(count + 1, t.size());
            if (count > 0)
                values.topRows(count) = amplitudes(t);
            if (moment)
                values.row(count) = values.row(*moment);
            return values;
        };
    };
    return [first = part(problem), second = part(added), factor](const Eigen::ArrayXd& t) {
        const Eigen::ArrayXXd a = first(t);
        const Eigen::ArrayXXd b = factor * second(t);
        Eigen::ArrayXXd values(a.rows() + b.rows() - 1, t.size());
        values << a.topRows(a.rows() - 1), b.topRows(b.rows() - 1),
            a.bottomRows(1) + b.bottomRows(1);
        return values;
    };
}

} // namespace

ProblemData sum(const ProblemData& problem, const ProblemData& added, double factor) {
    ProblemData result = problem;
    result.resolution = nullptr;
    result.profiles.insert(result.profiles.end(), added.profiles.begin(), added.profiles.end());
    const auto gentle = [](const ProblemData& of) {
        std::vector<bool> all = of.gentle_profiles;
        all.resize(of.profiles.size(), false);
        return all;
    };
    result.gentle_profiles = gentle(problem);
    const auto others = gentle(added);
    result.gentle_profiles.insert(result.gentle_profiles.end(), others.begin(), others.end());
    for (const auto field :
         {&ProblemData::theta_initial, &ProblemData::curvature_initial, &ProblemData::heat_source,
          &ProblemData::moment_load, &ProblemData::couple_load, &ProblemData::body_force})
        result.*field = sum(problem.*field, moved(problem, added.*field, factor));
    result.amplitudes = amplitudes_of_sum(problem, added, factor);
    result.amplitude_count = problem.amplitude_count + added.amplitude_count + 1;
    if (problem.end_moment || added.end_moment)
        result.end_moment = result.amplitude_count - 1;
    return result;
}

Eigen::ArrayXd values(const ProblemData& data, const Field& field, const Eigen::ArrayXd& x,
                      double t) {
    Eigen::ArrayXd result = Eigen::ArrayXd::Zero(x.size());
    if (!field.terms.empty()) {
        const Eigen::ArrayXXd amplitudes = data.amplitudes(Eigen::ArrayXd::Constant(1, t));
        for (const auto& term : field.terms)
            result += amplitudes(term.amplitude, 0) *
                      data.profiles[static_cast<std::size_t>(term.profile)](x);
    }
    if (field.rest)
        result += field.rest(x, t);
    return result;
}

} // namespace tvbeam

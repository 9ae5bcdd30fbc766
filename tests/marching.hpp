#pragma once

#include "core/run.hpp"
#include "core/space/linear_elements.hpp"
#include "core/time/time_levels.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tvbeam {

/// Every way of solving a step: tests of general properties run over all of them.
inline const std::vector<Scheme> all_schemes = [] {
    std::vector<Scheme> all;
    for (const auto& time : TimeScheme::names())
        for (const auto mass : {ThermalMass::consistent, ThermalMass::lumped}) {
            all.push_back({Algorithm::direct, mass, 0.0, TimeScheme::named(time)});
            all.push_back({Algorithm::fixed_point, mass, 1e-13, TimeScheme::named(time)});
        }
    return all;
}();

/// The same for run(), which has two ways of marching the direct algorithm.
inline const std::vector<Scheme> all_runs = [] {
    std::vector<Scheme> all = all_schemes;
    for (const auto& scheme : all_schemes)
        if (scheme.algorithm == Algorithm::direct) {
            all.push_back(scheme);
            all.back().basis = Basis::nodal;
        }
    return all;
}();

/// Those of one time scheme.
inline std::vector<Scheme> schemes_of(const std::string& time) {
    std::vector<Scheme> some;
    std::copy_if(all_schemes.begin(), all_schemes.end(), std::back_inserter(some),
                 [&](const Scheme& scheme) { return scheme.time.name == time; });
    return some;
}

inline std::ostream& operator<<(std::ostream& stream, ThermalMass mass) {
    return stream << name_of(mass);
}

inline std::ostream& operator<<(std::ostream& stream, Basis basis) {
    return stream << (basis == Basis::nodal ? "nodal values" : "automatic basis");
}

/// The name of a scheme in the log of a failing data test.
inline std::ostream& operator<<(std::ostream& stream, const Scheme& scheme) {
    return stream << name_of(scheme.algorithm) << ", " << scheme.time.name << ", "
                  << scheme.thermal_mass << ", " << scheme.basis;
}

/// A load with amplitude A(t): the heat source f = A(t) φ(x), or the shear load G = A(t), for which
/// Ĝ = A(t)(1 − x).
struct Load {
    std::function<double(double)> amplitude;
    SpaceFunction heat_profile; ///< φ; empty: a shear load
};

/// A problem that starts at rest and is driven by loads.
inline ProblemData forced_problem(const std::vector<Load>& loads) {
    ProblemData data;
    data.amplitude_count = static_cast<Eigen::Index>(loads.size());
    data.amplitudes = [loads](const Eigen::ArrayXd& t) {
        Eigen::ArrayXXd values(static_cast<Eigen::Index>(loads.size()), t.size());
        for (std::size_t k = 0; k < loads.size(); ++k)
            for (Eigen::Index i = 0; i < t.size(); ++i)
                values(static_cast<Eigen::Index>(k), i) = loads[k].amplitude(t(i));
        return values;
    };
    for (std::size_t k = 0; k < loads.size(); ++k) {
        const auto amplitude = static_cast<Eigen::Index>(k);
        const auto add = [&](Field& field, const SpaceFunction& profile) {
            field.terms.push_back({amplitude, static_cast<Eigen::Index>(data.profiles.size())});
            data.profiles.push_back(profile);
        };
        if (loads[k].heat_profile) {
            add(data.heat_source, loads[k].heat_profile);
        } else {
            add(data.moment_load,
                [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 1.0 - x; });
            add(data.couple_load,
                [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 0.0 * x + 1.0; });
        }
    }
    return data;
}

/// The same field without its separation: sources and errors are then evaluated pointwise.
inline Field unseparated(const Field& field, const ProblemData& problem) {
    Field result;
    result.rest = [=](const Eigen::ArrayXd& x, double t) { return values(problem, field, x, t); };
    return result;
}

/// ‖w_1 − w_2‖ of two piecewise linear curvatures.
inline double distance(const Mesh& mesh, const DiscontinuousLinear& a,
                       const DiscontinuousLinear& b) {
    const DiscontinuousLinear d = a - b;
    return std::sqrt(
        (mesh.lengths.transpose() * (d.row(0).square() + d.row(0) * d.row(1) + d.row(1).square()))
            .sum() /
        3.0);
}

/// Steps a solver of the time scheme given and visits every time level; fails the program's test by
/// an exception when a step fails.
inline void march(Solver& solver, const ProblemData& data, const TimeScheme& scheme, double dt,
                  int steps, const std::function<void(double t)>& visit) {
    TimeLevels levels(data, scheme, dt * steps, steps);
    for (int n = 1; n <= steps; ++n) {
        const std::string reason = solver.step(levels.at(n));
        if (!reason.empty())
            throw std::runtime_error(reason);
        visit(levels.time(n));
    }
}

} // namespace tvbeam

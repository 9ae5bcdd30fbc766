#include "studies/stress/stress_problem.hpp"

#include "core/space/resolution.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace tvbeam {

namespace {

enum Profile : Eigen::Index { parabola, arm, one, bending };
enum Amplitude : Eigen::Index { heating, shear, moment, minus_moment, initial_bending };
constexpr Eigen::Index amplitude_count = 5;

/// The piecewise linear function with a value at the left and the right end of every element.
SpaceFunction piecewise_linear(const Eigen::Array2Xd& ends) {
    return [ends](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
        const auto s = static_cast<double>(ends.cols());
        return x.unaryExpr([&](double at) {
            const double element = std::min(std::floor(at * s), s - 1.0);
            const double xi = at * s - element;
            const auto j = static_cast<Eigen::Index>(element);
            return (1.0 - xi) * ends(0, j) + xi * ends(1, j);
        });
    };
}

/// The one with these values at the nodes.
SpaceFunction hats(const Eigen::ArrayXd& nodal) {
    return [nodal](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
        const auto s = static_cast<double>(nodal.size() - 1);
        return x.unaryExpr([&](double at) {
            const double element = std::min(std::floor(at * s), s - 1.0);
            const double xi = at * s - element;
            const auto j = static_cast<Eigen::Index>(element);
            return (1.0 - xi) * nodal(j) + xi * nodal(j + 1);
        });
    };
}

/// +1, −1, +1, … at the nodes, without the ends; and from side to side of every element.
SpaceFunction sawtooth(Eigen::Index elements, bool continuous) {
    return [elements, continuous](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
        const auto s = static_cast<double>(elements);
        return x.unaryExpr([&](double at) {
            const double element = std::min(std::floor(at * s), s - 1.0);
            const double xi = at * s - element;
            if (!continuous)
                return 1.0 - 2.0 * xi;
            const auto value = [s](double node) {
                return node == 0.0 || node == s ? 0.0
                                                : 1.0 - 2.0 * (node - 2.0 * std::floor(node / 2.0));
            };
            return (1.0 - xi) * value(element) + xi * value(element + 1.0);
        });
    };
}

/// phi(x) + θ_A (1 − x) at every time.
SpaceTimeFunction over_steady(const SpaceFunction& phi, double theta_A) {
    return [phi, theta_A](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return phi(x) + theta_A * (1.0 - x);
    };
}

void set_random(ProblemData& data, const Mesh& mesh, unsigned seed, double theta_A) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Eigen::Index s = mesh.elements();
    Eigen::ArrayXd theta = Eigen::ArrayXd::Zero(s + 1);
    Eigen::Array2Xd w(2, s);
    for (Eigen::Index j = 0; j < s; ++j) {
        if (j + 1 < s)
            theta(j + 1) = uniform(random);
        w(0, j) = uniform(random);
        w(1, j) = uniform(random);
    }
    data.theta_initial.rest = over_steady(hats(theta), theta_A);
    data.curvature_initial.rest = over_steady(piecewise_linear(w), 0.0);
}

void set_initial(ProblemData& data, const StressParameters& parameters, const Mesh& mesh) {
    if (parameters.initial == InitialData::zero) {
        if (parameters.theta_A != 0.0)
            data.theta_initial.rest =
                over_steady([](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 0.0 * x; },
                            parameters.theta_A);
        return;
    }
    if (parameters.initial == InitialData::random) {
        set_random(data, mesh, parameters.seed, parameters.theta_A);
        return;
    }
    const bool smooth = parameters.initial == InitialData::smooth;
    const auto mode = [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
        return (std::numbers::pi * x).sin();
    };
    const SpaceFunction theta = smooth ? SpaceFunction(mode) : sawtooth(mesh.elements(), true);
    data.theta_initial.rest = over_steady(theta, parameters.theta_A);
    data.profiles[bending] = smooth ? SpaceFunction(mode) : sawtooth(mesh.elements(), false);
    data.curvature_initial.terms = {{initial_bending, bending}};
}

} // namespace

ProblemData stress_problem(const StressParameters& parameters, const Mesh& mesh) {
    ProblemData data;
    const auto constant = [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 0.0 * x + 1.0; };
    data.profiles = {[](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 4.0 * x * (1.0 - x); },
                     [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 1.0 - x; }, constant,
                     constant};
    data.amplitude_count = amplitude_count;
    const double load = parameters.load;
    const double frequency =
        2.0 * std::numbers::pi / (parameters.dt * static_cast<double>(parameters.steps));
    data.amplitudes = [load, frequency](const Eigen::ArrayXd& t) {
        Eigen::ArrayXXd values(amplitude_count, t.size());
        const Eigen::ArrayXd phase = frequency * t;
        values.row(heating) = load * phase.cos().transpose();
        values.row(shear) = -3.0 * load * (phase + 1.0).cos().transpose();
        values.row(moment) = load * phase.sin().transpose();
        values.row(minus_moment) = -values.row(moment);
        values.row(initial_bending).setConstant(-1.0);
        return values;
    };
    if (load != 0.0) {
        data.heat_source.terms = {{heating, parabola}};
        data.moment_load.terms = {{shear, arm}, {minus_moment, one}};
        data.couple_load.terms = {{shear, one}};
        data.end_moment = moment;
    }
    set_initial(data, parameters, mesh);
    data.exact = ExactSolution{};
    // One wave, and what is polynomial on every element: the rule integrates it as it stands.
    data.resolution = std::make_shared<const Resolution>();
    return data;
}

} // namespace tvbeam

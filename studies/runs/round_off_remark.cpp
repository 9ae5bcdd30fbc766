#include "studies/runs/round_off_remark.hpp"

#include "core/round_off.hpp"
#include "core/space/linear_elements.hpp"
#include "studies/runs/beam_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

/// The factor within which the prediction is taken to hold.
constexpr double within = 10.0;

/// The greatest ‖u_xx‖ over some times.
double curvature_size(const ProblemData& data, double final_time) {
    const Mesh mesh = Mesh::uniform(16);
    constexpr int times = 16;
    double greatest = 0.0;
    for (int n = 0; n <= times; ++n) {
        const Eigen::VectorXd nodal =
            values(data, data.exact->u_xx, mesh.nodes, final_time * n / times).matrix();
        greatest = std::max(greatest, std::sqrt(squared_norm(mesh, nodal)));
    }
    return greatest;
}

} // namespace

std::string round_off_remark(const Beam& beam, const ProblemData& data, const Series& series,
                             const std::vector<RungResult>& rungs, std::size_t k) {
    const Measure& measure = series.measures[k];
    if (scheme_of(series.method).algorithm != Algorithm::fixed_point || !data.exact ||
        measure.root() != "u_LinfH2semi")
        return {};
    const double size = curvature_size(data, series.final_time);
    for (const auto& rung : rungs) {
        if (rung.errors.empty())
            continue;
        const double error = measure.squared ? std::sqrt(rung.errors[k]) : rung.errors[k];
        const double floor =
            size * hermite_floor(rung.rung.elements, beam.zeta, rung.rung.dt, rung.rung.steps);
        if (within * floor <= error / 2.0)
            continue;
        return fmt::format(
            "{}: from s = {} on, the round-off of the Hermite form, which grows like h^-4, may "
            "exceed the discretisation error: {:.2g}, within a factor of {:.2g}, is predicted of "
            "an error of {:.2g}; algorithm = \"direct\" does not suffer it",
            measure.name, rung.rung.elements, floor, within, error);
    }
    return {};
}

} // namespace tvbeam

#include "studies/stress/contraction_map.hpp"

#include "core/contraction.hpp"
#include "core/hermite_form.hpp"
#include "core/time/time_levels.hpp"

#include <limits>
#include <numbers>

namespace tvbeam {

namespace {

/// The scheme of all steps but the first ones, as a scheme that starts by itself.
TimeScheme without_history(TimeScheme scheme) {
    for (Stage& stage : scheme.stages)
        stage.weights.erase(stage.weights.begin(), stage.weights.begin() + scheme.history);
    scheme.history = 0;
    return scheme;
}

/// Of the last stage of the first step; also where the iteration diverges.
double measured_contraction(const Beam& beam, const Mesh& mesh, const Scheme& scheme, double dt) {
    ProblemData data;
    data.theta_initial.rest = [](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return (std::numbers::pi * x).sin();
    };
    HermiteForm form(beam, data, mesh, scheme, dt);
    TimeLevels levels(data, scheme.time, dt, 1);
    const std::string reason = form.step(levels.at(1)); // may say that it diverges
    const auto& changes = form.temperature_changes();
    return changes.size() < 3 ? std::numeric_limits<double>::quiet_NaN() : changes[2] / changes[1];
}

/// The ratios that can be measured; a NaN elsewhere, which the extremes of PropagateNumbers pass.
Eigen::ArrayXXd ratios_of(const ContractionMap& map) {
    return (map.predicted >= ContractionMap::least_measurable)
        .select(map.measured / map.predicted, std::numeric_limits<double>::quiet_NaN());
}

} // namespace

double ContractionMap::least_ratio() const {
    return ratios_of(*this).minCoeff<Eigen::PropagateNumbers>();
}

double ContractionMap::greatest_ratio() const {
    return ratios_of(*this).maxCoeff<Eigen::PropagateNumbers>();
}

ContractionRow measure_contraction(const ContractionBlock& block, std::size_t row) {
    const Mesh mesh = Mesh::uniform(block.elements);
    const double dt = block.dt[row];
    ContractionRow ratios;
    for (const double alpha : block.alpha) {
        const Beam beam{.alpha = alpha, .zeta = block.zeta};
        Scheme scheme;
        scheme.algorithm = Algorithm::fixed_point;
        scheme.thermal_mass = block.thermal_mass;
        scheme.time = TimeScheme::named(block.time);
        ratios.greatest.push_back(greatest_contraction(beam, mesh, scheme, dt));
        scheme.time = without_history(scheme.time);
        // Two changes are compared; they are not to be lost in round-off.
        scheme.tolerance = std::numeric_limits<double>::min();
        const double c = scheme.time.stages.back().leading / dt;
        ratios.predicted.push_back(contraction(beam, mesh, block.thermal_mass, c));
        ratios.measured.push_back(measured_contraction(beam, mesh, scheme, dt));
    }
    return ratios;
}

ContractionMap contraction_map(const ContractionBlock& block,
                               const std::vector<ContractionRow>& rows) {
    const auto height = static_cast<Eigen::Index>(rows.size());
    const auto width = static_cast<Eigen::Index>(block.alpha.size());
    ContractionMap map{block, Eigen::ArrayXXd(height, width), Eigen::ArrayXXd(height, width),
                       Eigen::ArrayXXd(height, width)};
    for (Eigen::Index i = 0; i < height; ++i) {
        const ContractionRow& row = rows[static_cast<std::size_t>(i)];
        map.predicted.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.predicted.data(), width);
        map.measured.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.measured.data(), width);
        map.greatest.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.greatest.data(), width);
    }
    return map;
}

} // namespace tvbeam

#include "core/probe.hpp"

#include "core/space/deflection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tvbeam {

namespace {

bool reads_energy(const std::vector<Probe>& probes) {
    return std::any_of(probes.begin(), probes.end(), [](const Probe& probe) {
        return probe.quantity == Probe::Quantity::energy;
    });
}

} // namespace

Needs needs_of(const std::vector<Probe>& probes) {
    Needs needs{false, false, false};
    for (const Probe& probe : probes) {
        const bool energy = probe.quantity == Probe::Quantity::energy;
        needs.temperature |= energy || probe.quantity == Probe::Quantity::temperature;
        needs.deflection |= probe.quantity != Probe::Quantity::temperature;
        needs.curvature |=
            energy || (probe.quantity == Probe::Quantity::deflection && probe.x < 1.0);
    }
    return needs;
}

ProbeReader::ProbeReader(const Beam& beam, Mesh mesh, ThermalMass mass, std::vector<Probe> probes)
    : theta_A_(beam.theta_A), mesh_(std::move(mesh)), probes_(std::move(probes)),
      needs_(needs_of(probes_)) {
    if (reads_energy(probes_))
        mass_ = thermal_mass_matrix(mesh_, mass);
}

ProbeReader::Position ProbeReader::locate(double x) const {
    const auto* first = mesh_.nodes.data();
    const auto* end = first + mesh_.nodes.size();
    const Eigen::Index element = std::clamp<Eigen::Index>(
        std::upper_bound(first, end, x) - first - 1, 0, mesh_.elements() - 1);
    // Of nodes, not of the nominal length: at the right node it is 1 to the last digit.
    const double left = mesh_.nodes(element);
    return {element, (x - left) / (mesh_.nodes(element + 1) - left)};
}

Eigen::VectorXd ProbeReader::read(const Solver& solver, double t) const {
    DiscontinuousLinear w;
    Deflection nodal;
    if (needs_.curvature) {
        w = solver.curvature();
        nodal = deflection(mesh_, w);
    }
    const auto temperature_at = [&](double x) {
        const auto [j, part] = locate(x);
        const auto theta = solver.temperature();
        return theta(j) * (1.0 - part) + theta(j + 1) * part + theta_A_ * (1.0 - x);
    };
    // Within an element w = w_l + (w_r − w_l) y/h is integrated twice from its left end.
    const auto deflection_at = [&](double x) {
        const auto [j, part] = locate(x);
        const double y = part * mesh_.lengths(j);
        return nodal.value(j) +
               y * (nodal.slope(j) + y * (w(0, j) / 2.0 + (w(1, j) - w(0, j)) * part / 6.0));
    };
    const auto energy = [&] {
        const Eigen::VectorXd theta = solver.temperature().segment(1, mesh_.elements() - 1);
        const double value = (theta.dot(mass_ * theta) + inner_product(mesh_, w, w)) / 2.0;
        if (!std::isfinite(value))
            throw std::domain_error(fmt::format("the energy is beyond the range of floating point "
                                                "at t = {:g}: squares of the state are",
                                                t));
        return value;
    };
    Eigen::VectorXd values(static_cast<Eigen::Index>(probes_.size()));
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        const Probe& probe = probes_[static_cast<std::size_t>(k)];
        switch (probe.quantity) {
        case Probe::Quantity::temperature:
            values(k) = temperature_at(probe.x);
            break;
        case Probe::Quantity::deflection:
            values(k) = probe.x < 1.0 ? deflection_at(probe.x) : solver.tip_displacement();
            break;
        case Probe::Quantity::stress:
            values(k) =
                t > 0.0 ? solver.contact_stress() : std::numeric_limits<double>::quiet_NaN();
            break;
        case Probe::Quantity::energy:
            values(k) = energy();
            break;
        }
    }
    return values;
}

} // namespace tvbeam

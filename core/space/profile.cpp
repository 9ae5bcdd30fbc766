#include "core/space/profile.hpp"

#include "core/space/cells.hpp"
#include "core/space/linear_elements.hpp"
#include "core/space/quadrature.hpp"

#include <utility>

namespace tvbeam {

LoadProfile load_profile(const Mesh& mesh, const SpaceFunction& phi) {
    LoadProfile profile;
    profile.hat_load = hat_loads(mesh, phi);
    // 1 − x is the piecewise linear function with nodal values 1 − x_i, so its moment is a sum of
    // hat loads.
    profile.tip_moment = profile.hat_load.dot((1.0 - mesh.nodes).matrix());
    return profile;
}

ErrorProfiles error_profiles(const Mesh& mesh, const std::vector<SpaceFunction>& profiles) {
    const auto count = static_cast<Eigen::Index>(profiles.size());
    const Eigen::Index s = mesh.elements();
    const GaussRule& rule = element_rule();
    const Eigen::VectorXd left = (1.0 - rule.points).matrix();
    const Eigen::VectorXd right = rule.points.matrix();

    ErrorProfiles result{Eigen::MatrixXd(s + 1, count), Eigen::MatrixXd::Zero(s + 1, count),
                         Eigen::MatrixXd::Zero(count, count), Eigen::MatrixXd::Zero(count, count)};
    for (Eigen::Index r = 0; r < count; ++r)
        result.nodal.col(r) = profiles[static_cast<std::size_t>(r)](mesh.nodes).matrix();

    for_each_block(mesh, [&](Eigen::Index first, Eigen::Index n) {
        const Eigen::ArrayXXd points = element_points(mesh, first, n);
        const CellRange cells = cells_of(mesh, first, n);
        const auto lengths = integration_mesh(mesh).lengths.segment(cells.first, cells.count);
        const Eigen::ArrayXXd weights =
            (rule.weights.matrix() * lengths.matrix().transpose()).array();
        // A function with these values at the ends of every element, linear between, at the points.
        const auto linear = [&](const Eigen::Array2Xd& ends) -> Eigen::ArrayXXd {
            const Eigen::Array2Xd at_ends = at_cell_ends(mesh, first, ends);
            return (left * at_ends.row(0).matrix() + right * at_ends.row(1).matrix()).array();
        };
        // Defects of every profile at every point of the block, one column a profile.
        Eigen::MatrixXd interpolation(points.size(), count);
        Eigen::MatrixXd projection(points.size(), count);
        for (Eigen::Index r = 0; r < count; ++r) {
            const auto nodal = result.nodal.col(r).array();
            Eigen::Array2Xd ends(2, n);
            ends << nodal.segment(first, n).transpose(), nodal.segment(first + 1, n).transpose();
            const Eigen::ArrayXXd defect =
                at_points(profiles[static_cast<std::size_t>(r)], points) - linear(ends);
            const Eigen::MatrixXd weighted = (defect * weights).matrix();
            Eigen::Array2Xd moments(2, cells.count);
            moments << (left.transpose() * weighted).array(),
                (right.transpose() * weighted).array();
            moments = of_elements(mesh, first, n, std::move(moments));
            const Eigen::ArrayXd to_left = moments.row(0).transpose();
            const Eigen::ArrayXd to_right = moments.row(1).transpose();
            result.defect_load.col(r).segment(first, n) += to_left.matrix();
            result.defect_load.col(r).segment(first + 1, n) += to_right.matrix();
            // φ − Πφ = (φ − I_hφ) − Π(φ − I_hφ), with the inverse element mass matrix 2/h [2 −1; −1
            // 2].
            const Eigen::ArrayXd h = mesh.lengths.segment(first, n);
            const Eigen::ArrayXd at_left = 2.0 * (2.0 * to_left.array() - to_right.array()) / h;
            const Eigen::ArrayXd at_right = 2.0 * (2.0 * to_right.array() - to_left.array()) / h;
            ends << at_left.transpose(), at_right.transpose();
            const Eigen::ArrayXXd orthogonal = defect - linear(ends);
            interpolation.col(r) = defect.reshaped().matrix();
            projection.col(r) = orthogonal.reshaped().matrix();
        }
        const Eigen::VectorXd w = weights.reshaped().matrix();
        result.interpolation += interpolation.transpose() * w.asDiagonal() * interpolation;
        result.projection += projection.transpose() * w.asDiagonal() * projection;
    });
    return result;
}

} // namespace tvbeam

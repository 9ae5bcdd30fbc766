#include "core/space/profile.hpp"

#include "core/space/linear_elements.hpp"
#include "core/space/quadrature.hpp"

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
        const Eigen::ArrayXXd weights =
            (rule.weights.matrix() * mesh.lengths.segment(first, n).matrix().transpose()).array();
        // Defects of every profile at every point of the block, one column a profile.
        Eigen::MatrixXd interpolation(points.size(), count);
        Eigen::MatrixXd projection(points.size(), count);
        for (Eigen::Index r = 0; r < count; ++r) {
            const auto nodal = result.nodal.col(r);
            const Eigen::ArrayXXd defect =
                at_points(profiles[static_cast<std::size_t>(r)], points) -
                (left * nodal.segment(first, n).transpose() +
                 right * nodal.segment(first + 1, n).transpose())
                    .array();
            const Eigen::ArrayXXd weighted = defect * weights;
            const Eigen::VectorXd to_left = weighted.matrix().transpose() * left;
            const Eigen::VectorXd to_right = weighted.matrix().transpose() * right;
            result.defect_load.col(r).segment(first, n) += to_left;
            result.defect_load.col(r).segment(first + 1, n) += to_right;
            // φ − Πφ = (φ − I_hφ) − Π(φ − I_hφ), with the inverse element mass matrix 2/h [2 −1; −1
            // 2].
            const Eigen::ArrayXd h = mesh.lengths.segment(first, n);
            const Eigen::ArrayXd at_left = 2.0 * (2.0 * to_left.array() - to_right.array()) / h;
            const Eigen::ArrayXd at_right = 2.0 * (2.0 * to_right.array() - to_left.array()) / h;
            const Eigen::ArrayXXd orthogonal = defect - (left * at_left.matrix().transpose() +
                                                         right * at_right.matrix().transpose())
                                                            .array();
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

#include "core/space/quadrature.hpp"

#include "core/gsl_errors.hpp"
#include "core/space/cells.hpp"

#include <gsl/gsl_integration.h>

#include <memory>
#include <new>
#include <stdexcept>

namespace tvbeam {

GaussRule GaussRule::of(Eigen::Index points) {
    if (points < 1)
        throw std::domain_error("a Gauss rule has at least one point");
    using Table = std::unique_ptr<gsl_integration_glfixed_table,
                                  decltype(&gsl_integration_glfixed_table_free)>;
    const Table table(gsl_integration_glfixed_table_alloc(static_cast<std::size_t>(points)),
                      &gsl_integration_glfixed_table_free);
    if (!table)
        throw std::bad_alloc();
    GaussRule rule{Eigen::ArrayXd(points), Eigen::ArrayXd(points)};
    for (Eigen::Index q = 0; q < points; ++q)
        gsl_integration_glfixed_point(0.0, 1.0, static_cast<std::size_t>(q), &rule.points(q),
                                      &rule.weights(q), table.get());
    return rule;
}

const GaussRule& element_rule() {
    static const GaussRule rule = GaussRule::of(element_rule_size);
    return rule;
}

Eigen::ArrayXXd element_points(const Mesh& mesh, Eigen::Index first, Eigen::Index count) {
    const GaussRule& rule = element_rule();
    if (mesh.cells) {
        const CellRange cells = cells_of(mesh, first, count);
        return element_points(mesh.cells->mesh, cells.first, cells.count);
    }
    Eigen::ArrayXXd points(rule.points.size(), count);
    for (Eigen::Index j = 0; j < count; ++j)
        points.col(j) = mesh.nodes(first + j) + mesh.lengths(first + j) * rule.points;
    return points;
}

Eigen::ArrayXXd at_points(const SpaceFunction& phi, const Eigen::ArrayXXd& points) {
    const Eigen::ArrayXd values = phi(points.reshaped());
    return values.reshaped(points.rows(), points.cols());
}

} // namespace tvbeam

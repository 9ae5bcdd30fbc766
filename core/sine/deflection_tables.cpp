#include "core/sine/deflection_tables.hpp"

#include "core/space/cells.hpp"
#include "core/space/point_values.hpp"
#include "core/space/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tvbeam {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

/// Of the products with the modes, over the greatest, what is taken for round-off.
constexpr double noise = 32.0 * std::numeric_limits<double>::epsilon();
/// Cells of an element on which functions are integrated twice: where the rule integrates a
/// function to round-off, its polynomials on whole elements are off by up to 1e-5.
constexpr Index parts = 4;

/// T_k from (y, ω_k), without round-off behind the last that matters.
ArrayXd coefficients(ArrayXd products, const ArrayXd& factors) {
    if (products.size() == 0)
        return products;
    const double bound = noise * products.abs().maxCoeff();
    Index extent = products.size();
    while (extent > 0 && !(std::abs(products(extent - 1)) > bound))
        --extent;
    products.tail(products.size() - extent).setZero();
    return products / factors;
}

/// Fills all but the remainder.
void lay_out(SineTable& table, const std::vector<ArrayXd>& columns, const ArrayXd& factors) {
    const Index modes = factors.size();
    table.factors = ModeArrays(modes, 1);
    table.factors[0].head(modes) = factors;
    table.table = ModeArrays(modes, static_cast<Index>(columns.size()));
    table.active.assign(static_cast<std::size_t>(table.table.groups()), 0);
    constexpr Index group = packs_in_group * Pack::size;
    for (std::size_t j = 0; j < columns.size(); ++j) {
        table.table[static_cast<Index>(j)].head(modes) = columns[j];
        for (Index k = 0; k < modes; ++k)
            if (columns[j](k) != 0.0)
                table.active[static_cast<std::size_t>(k / group)] =
                    static_cast<std::int64_t>(j) + 1;
    }
}

/// (r_i, r_j) of functions as columns.
MatrixXd gram(const MatrixXd& functions, const PointValues& weights) {
    return functions.transpose() * weights.reshaped().matrix().asDiagonal() * functions;
}

/// Σ_k η_k T_ik T_jk.
MatrixXd modes_gram(const std::vector<ArrayXd>& columns, const ArrayXd& factors) {
    const auto count = static_cast<Index>(columns.size());
    return MatrixXd::NullaryExpr(count, count, [&](Index i, Index j) {
        return (factors * columns[static_cast<std::size_t>(i)] *
                columns[static_cast<std::size_t>(j)])
            .sum();
    });
}

} // namespace

SlopeOfTemperature::SlopeOfTemperature(const ProblemData& data, const Mesh& mesh,
                                       const SineBasis& basis) {
    for (Index r = 0; r < static_cast<Index>(data.profiles.size()); ++r)
        if (data.exact->theta_x.uses(r))
            profiles.push_back(r);
    const auto count = static_cast<Index>(profiles.size());
    const ArrayXd rule = element_rule().weights;
    const PointValues points = element_points(mesh, 0, mesh.elements());
    MatrixXd rest(points.size(), count);
    std::vector<ArrayXd> columns;
    means.resize(count);
    for (Index j = 0; j < count; ++j) {
        const auto r = static_cast<std::size_t>(profiles[static_cast<std::size_t>(j)]);
        const PointValues values = at_points(data.profiles[r], points);
        const Eigen::RowVectorXd each = rule.matrix().transpose() * values.matrix();
        means(j) = each.mean();
        rest.col(j) = (values.rowwise() - each.array()).reshaped().matrix();
        // (y, φ̂_k') of what is constant on every element: sums by parts.
        Eigen::VectorXd jumps = Eigen::VectorXd::Zero(mesh.elements() + 1);
        jumps.segment(1, mesh.elements() - 1) =
            (each.head(mesh.elements() - 1) - each.tail(mesh.elements() - 1)).transpose();
        columns.push_back(coefficients(basis.of_load(jumps), basis.stiffness()));
    }
    lay_out(*this, columns, basis.stiffness());
    remainder = gram(rest, point_weights(mesh));
}

DeflectionTables::DeflectionTables(const SineProfiles& profiles, const Mesh& mesh,
                                   const SineBasis& basis, bool coupled) {
    const Mesh cells = with_equal_cells(mesh, parts);
    const PointValues points = element_points(cells, 0, cells.elements());
    const Index count = profiles.columns();
    outside = count - profiles.linear;
    const Index all = count + outside;
    const ArrayXd slopes = basis.slope_squares();
    const ArrayXd values = basis.value_squares();
    const ArrayXd ones = ArrayXd::Ones(basis.size());
    MatrixXd slope_rest(points.size(), all);
    MatrixXd value_rest(points.size(), all);
    std::vector<ArrayXd> slope_columns;
    std::vector<ArrayXd> value_columns;
    tip_moments = Eigen::VectorXd::Zero(count);
    for (Index j = 0; j < all; ++j) {
        const Index of = j < count ? j : j - outside;
        PointValues g = at_points(profiles.functions[static_cast<std::size_t>(of)], points);
        if (j >= count)
            g = without_projection(cells, g);
        if (j < count)
            tip_moments(j) = antiderivatives(cells, g).tip;
        // What is left of g is integrated, rather than what is left of its integrals.
        const auto left = [&](const ArrayXd& column) {
            return antiderivatives(cells, g - piecewise_linear(cells, basis.nodal(column)));
        };
        // First the modes of g itself: those of its integrals fall by two or four powers of k
        // faster and would end in round-off before the modes of the solution do, which they are to
        // cancel.
        const ArrayXd of_g = coefficients(basis.of_load(hat_loads(cells, g)), ones);
        const PointValues rest = left(of_g).second;
        // By parts: (y', H_k') = −(y, φ̂_k), and (y, H_k) = (Y, φ̂_k) with Y'' = y.
        slope_columns.push_back(of_g +
                                coefficients(-basis.of_load(hat_loads(cells, rest)), slopes));
        value_columns.push_back(
            of_g +
            coefficients(basis.of_load(hat_loads(cells, antiderivatives(cells, rest).second)),
                         values));
        slope_rest.col(j) = left(slope_columns.back()).first.reshaped().matrix();
        value_rest.col(j) = left(value_columns.back()).second.reshaped().matrix();
    }
    lay_out(slope, slope_columns, slopes);
    lay_out(value, value_columns, values);
    const PointValues weights = point_weights(cells);
    slope.remainder = gram(slope_rest, weights);
    value.remainder = gram(value_rest, weights);
    const ArrayXd arm_products =
        basis.of_load(hat_loads(cells, PointValues((points.cube() - points) / 6.0)));
    arm = ModeArrays(basis.size(), 1);
    arm[0].head(basis.size()) = arm_products;
    arm_rest = value_rest.transpose() * (weights * points).reshaped().matrix();
    if (coupled)
        return;
    slope.remainder += modes_gram(slope_columns, slopes);
    value.remainder += modes_gram(value_columns, values);
    for (Index j = 0; j < all; ++j)
        arm_rest(j) += (value_columns[static_cast<std::size_t>(j)] * arm_products).sum();
}

} // namespace tvbeam

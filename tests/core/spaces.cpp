// Quadrature, matrices and projections of the finite-element spaces.

#include "core/space/deflection.hpp"
#include "core/space/linear_elements.hpp"
#include "core/space/mesh.hpp"
#include "core/space/quadrature.hpp"
#include "core/space/tail_moment.hpp"
#include "core/space/tridiagonal.hpp"

#include <Eigen/Dense>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

#include <stdexcept>
#include <vector>

using namespace tvbeam;
using Eigen::ArrayXd;

BOOST_AUTO_TEST_SUITE(spaces)

namespace {

constexpr Elimination both_eliminations[] = {Elimination::from_the_left,
                                             Elimination::from_both_ends};

Eigen::MatrixXd dense(const Tridiagonal& matrix) {
    const Eigen::Index n = matrix.diagonal.size();
    Eigen::MatrixXd full = matrix.diagonal.asDiagonal();
    for (Eigen::Index i = 0; i + 1 < n; ++i)
        full(i, i + 1) = full(i + 1, i) = matrix.coupling(i);
    return full;
}

/// A mesh whose elements all differ, so that a swapped index shows.
Mesh uneven_mesh(Eigen::Index elements) {
    Mesh mesh = Mesh::uniform(elements);
    for (Eigen::Index i = 1; i < elements; ++i)
        mesh.nodes(i) = std::pow(mesh.nodes(i), 1.3);
    mesh.lengths = mesh.nodes.tail(elements) - mesh.nodes.head(elements);
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_CASE(element_rule_is_exact_to_degree_eleven_and_no_further) {
    const GaussRule& rule = element_rule();
    for (int degree = 0; degree <= 12; ++degree) {
        const double exact = 1.0 / (degree + 1); // ∫_0^1 ξ^degree dξ
        const double error = std::abs((rule.weights * rule.points.pow(degree)).sum() - exact);
        if (degree <= 11)
            BOOST_TEST(error <= 4e-16);
        else
            BOOST_TEST(error > 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(mesh_refuses_no_elements) {
    BOOST_CHECK_THROW(Mesh::uniform(0), std::invalid_argument);
    BOOST_TEST(Mesh::uniform(1).elements() == 1);
}

BOOST_AUTO_TEST_CASE(a_family_has_no_mesh_with_elements_of_no_length) {
    const MeshFamily graded{.grading = 400.0, .nodes = {}}; // (1/10)^400 is 0 in doubles
    BOOST_CHECK_THROW(graded.with(10), std::invalid_argument);
    BOOST_TEST((graded.with(2).lengths > 0.0).all());
    const MeshFamily in_no_order{.nodes = {0.0, 0.7, 0.3, 1.0}};
    BOOST_CHECK_THROW(in_no_order.with(6), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(mass_and_stiffness_give_the_integrals_of_hat_functions) {
    // For v = x(1 − x) interpolated and its hats: vᵀMv = ‖I_hv‖² and vᵀKv = ‖(I_hv)'‖², integrated
    // element by element.
    const Mesh mesh = uneven_mesh(7);
    const ArrayXd v = mesh.nodes * (1.0 - mesh.nodes);
    const Eigen::VectorXd inner = v.segment(1, 6).matrix();
    double square = 0.0;
    double slope_square = 0.0;
    for (Eigen::Index j = 0; j < 7; ++j) {
        const double h = mesh.lengths(j);
        square += h / 3.0 * (v(j) * v(j) + v(j) * v(j + 1) + v(j + 1) * v(j + 1));
        slope_square += (v(j + 1) - v(j)) * (v(j + 1) - v(j)) / h;
    }
    BOOST_TEST(inner.dot(thermal_mass_matrix(mesh, ThermalMass::consistent) * inner) == square,
               boost::test_tools::tolerance(1e-14));
    BOOST_TEST(inner.dot(stiffness_matrix(mesh) * inner) == slope_square,
               boost::test_tools::tolerance(1e-14));
    BOOST_TEST(squared_norm(mesh, v.matrix()) == square, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(lumped_mass_is_the_row_sum_over_all_hats) {
    // The hats of all nodes sum to 1, so the row sum of (χ_i, χ_j) over all j is (χ_i, 1).
    const Mesh mesh = uneven_mesh(6);
    const Eigen::VectorXd ones =
        hat_loads(mesh, [](const ArrayXd& x) -> ArrayXd { return 0.0 * x + 1.0; });
    const Tridiagonal lumped = thermal_mass_matrix(mesh, ThermalMass::lumped);
    BOOST_TEST((lumped.diagonal - ones.segment(1, 5)).norm() <= 1e-15);
    BOOST_TEST(lumped.coupling.norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(elimination_solves_what_a_dense_solver_solves) {
    for (const Eigen::Index s : {2, 3, 4, 5, 6, 50, 51}) { // from one row on, odd and even
        const Mesh mesh = uneven_mesh(s);
        const Tridiagonal matrix =
            thermal_mass_matrix(mesh, ThermalMass::consistent) * 3.0 + stiffness_matrix(mesh);
        const Eigen::VectorXd load = ArrayXd::LinSpaced(s - 1, 1.0, 2.0).sin().matrix();
        const Eigen::VectorXd reference = dense(matrix).ldlt().solve(load);
        for (const auto elimination : both_eliminations) {
            Eigen::VectorXd x = load;
            TridiagonalFactor(matrix, elimination).solve_in_place(x);
            BOOST_TEST((x - reference).norm() <= 1e-13 * reference.norm());
        }
    }
}

BOOST_AUTO_TEST_CASE(elimination_refuses_a_matrix_that_is_not_positive_definite) {
    for (const auto elimination : both_eliminations) {
        BOOST_CHECK_THROW(
            TridiagonalFactor({Eigen::Vector2d(1.0, 1.0), Eigen::VectorXd::Constant(1, 2.0),
                               Eigen::Vector2d(3.0, 3.0)},
                              elimination),
            std::domain_error);
        BOOST_CHECK_THROW(TridiagonalFactor({Eigen::Vector2d(1.0, NAN), Eigen::VectorXd::Zero(1),
                                             Eigen::Vector2d(1.0, NAN)},
                                            elimination),
                          std::domain_error);
    }
}

BOOST_AUTO_TEST_CASE(elimination_is_accurate_whatever_the_condition) {
    // K x = (1, χ) has the nodal values x (1 − x)/2 of −x'' = 1, on any mesh; cond(K) = 4/π² s².
    // Row sums and couplings carry every digit of the matrix, so that round-off adds up over the
    // rows, ε a row at most, and is not multiplied by the condition: that would be ε s².
    const Eigen::Index s = 1'000'000;
    const Mesh mesh = Mesh::uniform(s);
    const ArrayXd nodes = mesh.nodes.segment(1, s - 1);
    const ArrayXd exact = nodes * (1.0 - nodes) / 2.0;
    const double bound = std::numeric_limits<double>::epsilon() * static_cast<double>(s);
    for (const auto elimination : both_eliminations) {
        Eigen::VectorXd x = Eigen::VectorXd::Constant(s - 1, mesh.lengths(0));
        TridiagonalFactor(stiffness_matrix(mesh), elimination).solve_in_place(x);
        BOOST_TEST(((x.array() - exact) / exact).abs().maxCoeff() <= bound);
    }
}

BOOST_AUTO_TEST_CASE(projection_leaves_an_error_orthogonal_to_discontinuous_linears) {
    const Mesh mesh = uneven_mesh(5);
    const SpaceFunction g = [](const ArrayXd& x) -> ArrayXd { return x.exp() * (3.0 * x).sin(); };
    const DiscontinuousLinear p = project(mesh, g);
    // Equal moments against every hat function and against 1 − x, which is in P1disc as well.
    BOOST_TEST((hat_loads(mesh, p) - hat_loads(mesh, g)).norm() <= 1e-15);
    const double moment = hat_loads(mesh, g).dot((1.0 - mesh.nodes).matrix());
    BOOST_TEST(tip_moment(mesh, p) == moment, boost::test_tools::tolerance(1e-14));
    // A linear function is its own projection.
    const DiscontinuousLinear line =
        project(mesh, [](const ArrayXd& x) -> ArrayXd { return 2.0 - 5.0 * x; });
    BOOST_TEST((line.row(0).transpose() - (2.0 - 5.0 * mesh.nodes.head(5))).abs().maxCoeff() <=
               1e-14);
    BOOST_TEST((line.row(1).transpose() - (2.0 - 5.0 * mesh.nodes.tail(5))).abs().maxCoeff() <=
               1e-14);
}

BOOST_AUTO_TEST_CASE(deflection_integrates_the_curvature_of_a_cubic_exactly) {
    // U = x³ − 2x²: U_x = 3x² − 4x, U_xx = 6x − 4, clamped at 0.
    const Mesh mesh = uneven_mesh(9);
    const DiscontinuousLinear w =
        project(mesh, [](const ArrayXd& x) -> ArrayXd { return 6.0 * x - 4.0; });
    const Deflection nodal = deflection(mesh, w);
    const ArrayXd x = mesh.nodes;
    BOOST_TEST((nodal.value.array() - (x.cube() - 2.0 * x.square())).abs().maxCoeff() <= 1e-14);
    BOOST_TEST((nodal.slope.array() - (3.0 * x.square() - 4.0 * x)).abs().maxCoeff() <= 1e-14);
    // The tip is the moment of the curvature about it.
    BOOST_TEST(tip_moment(mesh, w) == -1.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(curvature_of_nodal_values_inverts_deflection) {
    const Mesh mesh = uneven_mesh(9);
    const DiscontinuousLinear w = DiscontinuousLinear::Random(2, 9);
    BOOST_TEST((curvature(mesh, deflection(mesh, w)) - w).abs().maxCoeff() <= 1e-12);
}

// ∫_y^1 (x − y) x dx = 1/3 − y/2 + y³/6, wherever [0, 1] is cut: the rule is exact.
BOOST_AUTO_TEST_CASE(the_moment_of_a_tail_does_not_depend_on_the_intervals) {
    const ArrayXd y = ArrayXd::LinSpaced(9, 0.0, 1.0);
    const ArrayXd expected = 1.0 / 3.0 - y / 2.0 + y.cube() / 6.0;
    for (const std::vector<Interval>& intervals :
         {std::vector<Interval>{{0.0, 1.0}}, {{0.0, 0.5}, {0.5, 0.25}, {0.75, 0.25}}}) {
        const ArrayXd moment = tail_moment(
            intervals, [](const ArrayXd& x) { return x; }, y);
        BOOST_TEST((moment - expected).abs().maxCoeff() <= 1e-15);
    }
}

BOOST_AUTO_TEST_CASE(a_family_of_meshes_is_graded_or_keeps_its_nodes) {
    const Mesh graded = MeshFamily{.grading = 2.0, .nodes = {}}.with(4);
    const Mesh kept = MeshFamily{.grading = 1.0, .nodes = {0.0, 0.3, 1.0}}.with(4);
    const std::vector<double> squares{0.0, 0.0625, 0.25, 0.5625, 1.0};
    const std::vector<double> halves{0.0, 0.15, 0.3, 0.65, 1.0};
    for (Eigen::Index j = 0; j <= 4; ++j) {
        BOOST_TEST(graded.nodes(j) == squares[static_cast<std::size_t>(j)]);
        BOOST_TEST(kept.nodes(j) == halves[static_cast<std::size_t>(j)],
                   boost::test_tools::tolerance(1e-15));
    }
    for (const Mesh& mesh : {graded, kept})
        BOOST_TEST(mesh.lengths.sum() == 1.0, boost::test_tools::tolerance(1e-15));
    BOOST_CHECK_THROW((void)(MeshFamily{.grading = 1.0, .nodes = {0.0, 0.3, 1.0}}.with(5)),
                      std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_rule_that_there_is_not_is_an_exception) {
    BOOST_CHECK_THROW(GaussRule::of(0), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()

// The sums over columns are compiled for several vector units: each of them, one by one.

#include "core/dense_kernels.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(dense_kernels_one_by_one)

namespace {

/// Numbers of size 1 and either sign, others for every seed.
Eigen::MatrixXd some_numbers(Eigen::Index rows, Eigen::Index columns, double seed) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [seed](Eigen::Index i, Eigen::Index j) {
        return std::sin(seed + 1.7 * static_cast<double>(i) + 2.9 * static_cast<double>(j));
    });
}

/// As above, with a zero in most places, whole rows among them.
Eigen::MatrixXd mostly_zero(Eigen::Index rows, Eigen::Index columns, double seed) {
    Eigen::MatrixXd numbers = some_numbers(rows, columns, seed);
    for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < columns; ++j)
            if (i % 3 == 0 || (i + j) % 2 == 0)
                numbers(i, j) = 0.0;
    return numbers;
}

template <typename Check>
void for_each_kernel_here(const Check& check) {
    for (const DenseKernel& kernel : dense_kernels()) {
        if (!kernel.runs_here) {
            BOOST_TEST_MESSAGE("skipped: this processor is no " << kernel.name);
            continue;
        }
        BOOST_TEST_CONTEXT("kernel " << kernel.name)
        check(kernel);
    }
}

constexpr double ulp = std::numeric_limits<double>::epsilon();

// Whole registers of every width, several of them, and what is left.
const auto row_counts = data::make({1, 7, 8, 64, 101});

} // namespace

BOOST_AUTO_TEST_CASE(the_widest_kernel_of_the_processor_is_chosen) {
    BOOST_TEST(dense_kernels().back().runs_here);
    for (const DenseKernel& kernel : dense_kernels()) {
        if (&kernel == &chosen_dense_kernel())
            break;
        BOOST_TEST(!kernel.runs_here, kernel.name);
    }
    BOOST_TEST(chosen_dense_kernel().runs_here);
}

// Rows behind the first ones stay as they are; 300 terms are more than are gathered at once, five
// columns more than are summed together. A sum of n terms of size 1 rounds n times.
BOOST_DATA_TEST_CASE(every_kernel_adds_the_product, row_counts* data::make({3, 300}), rows, inner) {
    const Eigen::MatrixXd in = some_numbers(rows + 3, inner, 0.1);
    for (const Eigen::MatrixXd& matrix :
         {some_numbers(inner, 5, 0.2), mostly_zero(inner, 5, 0.3)}) {
        const Eigen::MatrixXd before = some_numbers(rows + 2, 5, 0.4);
        Eigen::MatrixXd expected = before;
        expected.topRows(rows) += in.topRows(rows) * matrix;
        for_each_kernel_here([&](const DenseKernel& kernel) {
            Eigen::MatrixXd out = before;
            kernel.add_product({out.data(), out.outerStride(), in.data(), in.outerStride(),
                                matrix.data(), matrix.outerStride(), rows, inner, 5});
            BOOST_TEST((out - expected).cwiseAbs().maxCoeff() <= 2.0 * inner * inner * ulp);
            BOOST_TEST((out.bottomRows(2) == before.bottomRows(2)));
        });
    }
}

BOOST_DATA_TEST_CASE(every_kernel_adds_the_forms, row_counts* data::make({1, 6, 150}), rows,
                     columns) {
    const Eigen::MatrixXd series = some_numbers(rows + 3, columns, 0.5);
    for (const Eigen::MatrixXd& half :
         {some_numbers(columns, columns, 0.6), mostly_zero(columns, columns, 0.7)}) {
        const Eigen::MatrixXd gram = half + half.transpose();
        const Eigen::VectorXd before = some_numbers(rows + 2, 1, 0.8);
        Eigen::VectorXd expected = before;
        for (Eigen::Index row = 0; row < rows; ++row)
            expected(row) += series.row(row).dot(gram * series.row(row).transpose());
        for_each_kernel_here([&](const DenseKernel& kernel) {
            Eigen::VectorXd out = before;
            kernel.add_forms({out.data(), series.data(), series.outerStride(), gram.data(),
                              gram.outerStride(), rows, columns});
            BOOST_TEST((out - expected).cwiseAbs().maxCoeff() <=
                       4.0 * columns * columns * columns * ulp);
            BOOST_TEST((out.tail(2) == before.tail(2)));
        });
    }
}

// Five columns are more than are summed together.
BOOST_DATA_TEST_CASE(every_kernel_adds_the_inner_products, row_counts, rows) {
    const Eigen::MatrixXd in = some_numbers(rows + 3, 5, 1.2);
    const Eigen::VectorXd v = some_numbers(rows + 3, 1, 1.3);
    const Eigen::VectorXd before = some_numbers(5, 1, 1.4);
    const Eigen::VectorXd expected = before + in.topRows(rows).transpose() * v.head(rows);
    for_each_kernel_here([&](const DenseKernel& kernel) {
        Eigen::VectorXd out = before;
        kernel.add_inner_products({out.data(), in.data(), in.outerStride(), v.data(), rows, 5});
        BOOST_TEST((out - expected).cwiseAbs().maxCoeff() <= 2.0 * rows * ulp + 2.0 * ulp);
    });
}

// T_k(cos φ) = cos kφ. Clenshaw's recurrence is as good as k² ulp at the ends, k inside.
BOOST_DATA_TEST_CASE(every_kernel_sums_chebyshev_polynomials, row_counts* data::make({1, 2, 3, 40}),
                     points, count) {
    const Eigen::VectorXd coefficients = some_numbers(count, 1, 0.9);
    const Eigen::ArrayXd angles =
        Eigen::ArrayXd::LinSpaced(points, 0.2, std::numbers::pi - 0.2) * (1.0 - 1e-9);
    const Eigen::ArrayXd y = angles.cos();
    Eigen::ArrayXd expected = Eigen::ArrayXd::Zero(points);
    for (Eigen::Index k = 0; k < count; ++k)
        expected += coefficients(k) * (static_cast<double>(k) * angles).cos();
    for_each_kernel_here([&](const DenseKernel& kernel) {
        Eigen::ArrayXd out(points);
        kernel.chebyshev_sum({out.data(), y.data(), points, coefficients.data(), count});
        BOOST_TEST((out - expected).abs().maxCoeff() <= 10.0 * count * count * ulp);
    });
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_counts_where_it_is_read) {
    Eigen::MatrixXd in = some_numbers(9, 3, 1.0);
    in(2, 1) = std::numeric_limits<double>::quiet_NaN();
    Eigen::MatrixXd matrix = some_numbers(3, 6, 1.1);
    matrix.row(1).setZero();
    for_each_kernel_here([&](const DenseKernel& kernel) {
        Eigen::MatrixXd out = Eigen::MatrixXd::Zero(9, 6);
        kernel.add_product({out.data(), 9, in.data(), 9, matrix.data(), 3, 9, 3, 6});
        BOOST_TEST(out.allFinite());
        const Eigen::MatrixXd gram = Eigen::MatrixXd::Ones(3, 3);
        Eigen::VectorXd forms = Eigen::VectorXd::Zero(9);
        kernel.add_forms({forms.data(), in.data(), 9, gram.data(), 3, 9, 3});
        for (Eigen::Index row = 0; row < 9; ++row)
            BOOST_TEST(std::isfinite(forms(row)) == (row != 2));
    });
}

BOOST_AUTO_TEST_SUITE_END()

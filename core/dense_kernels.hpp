#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>

namespace tvbeam {

/// Sums over columns, which a step in the sine basis needs beside its modes, compiled for a vector
/// unit. Matrices are stored by columns, a stride apart. Where a unit fuses a product and a sum,
/// the last bits of the results differ; a value depends on its own row alone, and of what is not
/// finite on the columns beside it, of which four are summed together.
struct DenseKernel {
    using Index = std::int64_t;

    const char* name; ///< of the processors that it is for, as compilers call them
    bool runs_here;   ///< whether this processor is one of them

    /// out += in · matrix. Rows of the matrix that are zero cost nothing. Shapes: rows × columns,
    /// rows × inner, inner × columns.
    struct Product {
        double* out;
        Index out_stride;
        const double* in;
        Index in_stride;
        const double* matrix;
        Index matrix_stride;
        Index rows;
        Index inner;
        Index columns;
    };
    void (*add_product)(const Product& product);

    /// out += vᵀ G v for every row v; G symmetric. Shapes: rows, rows × columns, columns × columns.
    struct Forms {
        double* out;
        const double* rows_of;
        Index stride;
        const double* gram;
        Index gram_stride;
        Index rows;
        Index columns;
    };
    void (*add_forms)(const Forms& forms);

    /// out_j += Σ_i in_ij v_i for every column j. Shapes: columns, rows × columns, rows.
    struct InnerProducts {
        double* out;
        const double* in;
        Index stride;
        const double* with;
        Index rows;
        Index columns;
    };
    void (*add_inner_products)(const InnerProducts& products);

    /// Σ_k c_k T_k(y) at every point, by Clenshaw's recurrence; at least one coefficient.
    struct ChebyshevSum {
        double* out;
        const double* y;
        Index points;
        const double* coefficients;
        Index count;
    };
    void (*chebyshev_sum)(const ChebyshevSum& sum);
};

/// All of them, the widest first; the last is for every processor.
std::span<const DenseKernel> dense_kernels();

/// The first that runs here.
const DenseKernel& chosen_dense_kernel();

/// out += in · matrix in the first `rows` rows of both.
void add_product(Eigen::Ref<Eigen::MatrixXd> out, const Eigen::Ref<const Eigen::MatrixXd>& in,
                 const Eigen::Ref<const Eigen::MatrixXd>& matrix, Eigen::Index rows);

/// out += vᵀ G v for each of the first rows v of the series; G symmetric.
void add_forms(Eigen::VectorXd& out, const Eigen::MatrixXd& series, const Eigen::MatrixXd& gram,
               Eigen::Index rows);

/// out_j += (column j of in, v).
void add_inner_products(Eigen::VectorXd& out, const Eigen::MatrixXd& in, const Eigen::VectorXd& v);

} // namespace tvbeam

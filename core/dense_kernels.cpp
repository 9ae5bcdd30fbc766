#include "core/dense_kernels.hpp"

#include <algorithm>
#include <cstdint>

namespace tvbeam {

namespace {

/// Rows that lie together in a column, in a register of so many bytes; columns begin anywhere.
template <std::int64_t bytes>
struct RowRegister;
template <>
struct RowRegister<64> {
    using Lanes [[gnu::vector_size(64), gnu::aligned(8), gnu::may_alias]] = double;
};
template <>
struct RowRegister<32> {
    using Lanes [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;
};
template <>
struct RowRegister<16> {
    using Lanes [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
};
template <>
struct RowRegister<8> {
    using Lanes = double;
};

/// So many registers of rows. Where nothing is optimised they wait on the stack, aligned.
template <std::int64_t bytes, std::int64_t registers>
struct alignas(bytes) Rows {
    using Lanes = typename RowRegister<bytes>::Lanes;
    static constexpr std::int64_t in_register = bytes / static_cast<std::int64_t>(sizeof(double));
    static constexpr std::int64_t count = in_register * registers;
    Lanes values[registers] = {};

    Rows() = default;
    [[gnu::always_inline]] explicit Rows(const double* from) {
        for (std::int64_t v = 0; v < registers; ++v)
            values[v] = *reinterpret_cast<const Lanes*>(from + v * in_register);
    }
    [[gnu::always_inline]] void store(double* to) const {
        for (std::int64_t v = 0; v < registers; ++v)
            *reinterpret_cast<Lanes*>(to + v * in_register) = values[v];
    }
    [[gnu::always_inline]] Rows& operator+=(const Rows& other) {
        for (std::int64_t v = 0; v < registers; ++v)
            values[v] += other.values[v];
        return *this;
    }
    [[gnu::always_inline]] Rows& operator-=(const Rows& other) {
        for (std::int64_t v = 0; v < registers; ++v)
            values[v] -= other.values[v];
        return *this;
    }
    [[gnu::always_inline]] Rows& operator+=(double number) {
        for (std::int64_t v = 0; v < registers; ++v)
            values[v] += number;
        return *this;
    }
    [[gnu::always_inline]] friend Rows operator*(double factor, const Rows& rows) {
        Rows result = rows;
        for (std::int64_t v = 0; v < registers; ++v)
            result.values[v] *= factor;
        return result;
    }
    [[gnu::always_inline]] friend Rows operator*(const Rows& left, const Rows& right) {
        Rows result = left;
        for (std::int64_t v = 0; v < registers; ++v)
            result.values[v] *= right.values[v];
        return result;
    }
};

/// What is not zero is gathered before the rows are passed over, so many terms at once.
constexpr std::int64_t most_terms = 128;

/// Calls of() for each piece of the rows: several registers as long as they last, then one, then a
/// row.
template <std::int64_t bytes, std::int64_t registers, typename Piece>
[[gnu::always_inline]] inline void in_pieces(std::int64_t rows, const Piece& of) {
    using Several = Rows<bytes, registers>;
    using One = Rows<bytes, 1>;
    using Single = Rows<8, 1>;
    std::int64_t row = 0;
    for (; row + Several::count <= rows; row += Several::count)
        of(Several{}, row);
    for (; row + One::count <= rows; row += One::count)
        of(One{}, row);
    for (; row < rows; ++row)
        of(Single{}, row);
}

/// So many columns from the j-th at once: what is read of `in` serves them all.
template <std::int64_t bytes, std::int64_t together>
[[gnu::always_inline]] inline void add_columns(const DenseKernel::Product& p, std::int64_t j) {
    const double* const matrix = p.matrix + j * p.matrix_stride;
    std::int64_t used[most_terms];
    double factors[most_terms][together];
    for (std::int64_t i = 0; i < p.inner;) {
        std::int64_t count = 0;
        for (; i < p.inner && count < most_terms; ++i) {
            bool any = false;
            for (std::int64_t c = 0; c < together; ++c) {
                factors[count][c] = matrix[c * p.matrix_stride + i];
                any = any || factors[count][c] != 0.0;
            }
            used[count] = i;
            count += any ? 1 : 0;
        }
        in_pieces<bytes, 2>(
            p.rows, [&](auto piece, std::int64_t row) __attribute__((always_inline)) {
                using Piece = decltype(piece);
                Piece sums[together];
                for (std::int64_t c = 0; c < together; ++c)
                    sums[c] = Piece(p.out + (j + c) * p.out_stride + row);
                for (std::int64_t k = 0; k < count; ++k) {
                    const Piece in(p.in + used[k] * p.in_stride + row);
                    for (std::int64_t c = 0; c < together; ++c)
                        sums[c] += factors[k][c] * in;
                }
                for (std::int64_t c = 0; c < together; ++c)
                    sums[c].store(p.out + (j + c) * p.out_stride + row);
            });
    }
}

template <std::int64_t bytes>
[[gnu::always_inline]] inline void product_with(const DenseKernel::Product& p) {
    constexpr std::int64_t together = 4;
    std::int64_t j = 0;
    for (; j + together <= p.columns; j += together)
        add_columns<bytes, together>(p, j);
    for (; j < p.columns; ++j)
        add_columns<bytes, 1>(p, j);
}

template <std::int64_t bytes>
[[gnu::always_inline]] inline void forms_with(const DenseKernel::Forms& f) {
    std::int64_t used[most_terms];
    double factors[most_terms];
    for (std::int64_t j = 0; j < f.columns; ++j)
        for (std::int64_t i = 0; i <= j;) {
            std::int64_t count = 0;
            for (; i <= j && count < most_terms; ++i) {
                used[count] = i;
                factors[count] = (i == j ? 1.0 : 2.0) * f.gram[j * f.gram_stride + i];
                count += factors[count] != 0.0 ? 1 : 0;
            }
            if (count == 0)
                continue;
            in_pieces<bytes, 4>(
                f.rows, [&](auto sum, std::int64_t row) __attribute__((always_inline)) {
                    using Piece = decltype(sum);
                    for (std::int64_t k = 0; k < count; ++k)
                        sum += factors[k] * Piece(f.rows_of + used[k] * f.stride + row);
                    Piece out(f.out + row);
                    out += sum * Piece(f.rows_of + j * f.stride + row);
                    out.store(f.out + row);
                });
        }
}

/// So many columns from the j-th at once: what is read of v serves them all.
template <std::int64_t bytes, std::int64_t together>
[[gnu::always_inline]] inline void add_inner_products_of(const DenseKernel::InnerProducts& p,
                                                         std::int64_t j) {
    using Piece = Rows<bytes, 1>;
    const double* const in = p.in + j * p.stride;
    Piece sums[together];
    std::int64_t row = 0;
    for (; row + Piece::count <= p.rows; row += Piece::count) {
        const Piece v(p.with + row);
        for (std::int64_t c = 0; c < together; ++c)
            sums[c] += v * Piece(in + c * p.stride + row);
    }
    for (std::int64_t c = 0; c < together; ++c) {
        double lanes[Piece::count];
        sums[c].store(lanes);
        double sum = 0.0;
        for (const double lane : lanes)
            sum += lane;
        for (std::int64_t i = row; i < p.rows; ++i)
            sum += p.with[i] * in[c * p.stride + i];
        p.out[j + c] += sum;
    }
}

template <std::int64_t bytes>
[[gnu::always_inline]] inline void inner_products_with(const DenseKernel::InnerProducts& p) {
    constexpr std::int64_t together = 4;
    std::int64_t j = 0;
    for (; j + together <= p.columns; j += together)
        add_inner_products_of<bytes, together>(p, j);
    for (; j < p.columns; ++j)
        add_inner_products_of<bytes, 1>(p, j);
}

template <std::int64_t bytes>
[[gnu::always_inline]] inline void chebyshev_with(const DenseKernel::ChebyshevSum& c) {
    in_pieces<bytes, 4>(
        c.points, [&](auto b1, std::int64_t row) __attribute__((always_inline)) {
            using Piece = decltype(b1);
            const Piece y(c.y + row);
            const Piece twice = 2.0 * y;
            Piece b2;
            for (std::int64_t k = c.count - 1; k > 0; --k) {
                Piece next = twice * b1;
                next -= b2;
                next += c.coefficients[k];
                b2 = b1;
                b1 = next;
            }
            Piece sum = y * b1;
            sum -= b2;
            sum += c.coefficients[0];
            sum.store(c.out + row);
        });
}

// What is inlined is compiled for the units that the function is for. clang 14 cannot ask for
// levels.
#if defined(__x86_64__) && !defined(__clang__)
#define TVBEAM_V4 [[gnu::target("arch=x86-64-v4")]]
#define TVBEAM_V3 [[gnu::target("arch=x86-64-v3")]]
TVBEAM_V4 void product_v4(const DenseKernel::Product& p) {
    product_with<64>(p);
}
TVBEAM_V4 void forms_v4(const DenseKernel::Forms& f) {
    forms_with<64>(f);
}
TVBEAM_V4 void inner_products_v4(const DenseKernel::InnerProducts& p) {
    inner_products_with<64>(p);
}
TVBEAM_V4 void chebyshev_v4(const DenseKernel::ChebyshevSum& c) {
    chebyshev_with<64>(c);
}
TVBEAM_V3 void product_v3(const DenseKernel::Product& p) {
    product_with<32>(p);
}
TVBEAM_V3 void forms_v3(const DenseKernel::Forms& f) {
    forms_with<32>(f);
}
TVBEAM_V3 void inner_products_v3(const DenseKernel::InnerProducts& p) {
    inner_products_with<32>(p);
}
TVBEAM_V3 void chebyshev_v3(const DenseKernel::ChebyshevSum& c) {
    chebyshev_with<32>(c);
}
#endif
void product_anywhere(const DenseKernel::Product& p) {
    product_with<16>(p);
}
void forms_anywhere(const DenseKernel::Forms& f) {
    forms_with<16>(f);
}
void inner_products_anywhere(const DenseKernel::InnerProducts& p) {
    inner_products_with<16>(p);
}
void chebyshev_anywhere(const DenseKernel::ChebyshevSum& c) {
    chebyshev_with<16>(c);
}

} // namespace

std::span<const DenseKernel> dense_kernels() {
    static const DenseKernel kernels[] = {
#if defined(__x86_64__) && !defined(__clang__)
        {"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0, &product_v4, &forms_v4,
         &inner_products_v4, &chebyshev_v4},
        {"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0, &product_v3, &forms_v3,
         &inner_products_v3, &chebyshev_v3},
#endif
        {"any", true, &product_anywhere, &forms_anywhere, &inner_products_anywhere,
         &chebyshev_anywhere},
    };
    return kernels;
}

const DenseKernel& chosen_dense_kernel() {
    static const DenseKernel& chosen =
        *std::find_if(dense_kernels().begin(), dense_kernels().end(),
                      [](const DenseKernel& kernel) { return kernel.runs_here; });
    return chosen;
}

void add_product(Eigen::Ref<Eigen::MatrixXd> out, const Eigen::Ref<const Eigen::MatrixXd>& in,
                 const Eigen::Ref<const Eigen::MatrixXd>& matrix, Eigen::Index rows) {
    eigen_assert(rows <= out.rows() && rows <= in.rows() && in.cols() == matrix.rows() &&
                 matrix.cols() == out.cols());
    chosen_dense_kernel().add_product({out.data(), out.outerStride(), in.data(), in.outerStride(),
                                       matrix.data(), matrix.outerStride(), rows, matrix.rows(),
                                       matrix.cols()});
}

void add_forms(Eigen::VectorXd& out, const Eigen::MatrixXd& series, const Eigen::MatrixXd& gram,
               Eigen::Index rows) {
    eigen_assert(rows <= out.size() && rows <= series.rows() && series.cols() == gram.cols() &&
                 gram.rows() == gram.cols());
    chosen_dense_kernel().add_forms({out.data(), series.data(), series.outerStride(), gram.data(),
                                     gram.outerStride(), rows, gram.cols()});
}

void add_inner_products(Eigen::VectorXd& out, const Eigen::MatrixXd& in, const Eigen::VectorXd& v) {
    eigen_assert(v.size() == in.rows() && out.size() == in.cols());
    chosen_dense_kernel().add_inner_products(
        {out.data(), in.data(), in.outerStride(), v.data(), in.rows(), in.cols()});
}

} // namespace tvbeam

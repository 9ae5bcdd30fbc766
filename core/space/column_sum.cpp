#include "core/space/column_sum.hpp"

namespace tvbeam {

namespace {

struct ColumnSum {
    double* y;
    Eigen::Index rows;
    const double* columns;
    Eigen::Index count;
    const double* factors;
};

// Vector registers, whose values need not be aligned in memory.
using TwoDoubles [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
using FourDoubles [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;
using EightDoubles [[gnu::vector_size(64), gnu::aligned(8), gnu::may_alias]] = double;

/// Some rows after the other in registers, through all columns.
template <typename Lanes>
[[gnu::always_inline]] inline void add_by(const ColumnSum& sum) {
    constexpr Eigen::Index registers = 4;
    constexpr auto lanes = static_cast<Eigen::Index>(sizeof(Lanes) / sizeof(double));
    Eigen::Index i = 0;
    for (; i + registers * lanes <= sum.rows; i += registers * lanes) {
        auto* y = reinterpret_cast<Lanes*>(sum.y + i);
        Lanes sums[registers];
        for (Eigen::Index p = 0; p < registers; ++p)
            sums[p] = y[p];
        for (Eigen::Index r = 0; r < sum.count; ++r) {
            const auto* column = reinterpret_cast<const Lanes*>(sum.columns + r * sum.rows + i);
            for (Eigen::Index p = 0; p < registers; ++p)
                sums[p] += sum.factors[r] * column[p];
        }
        for (Eigen::Index p = 0; p < registers; ++p)
            y[p] = sums[p];
    }
    for (; i < sum.rows; ++i)
        for (Eigen::Index r = 0; r < sum.count; ++r)
            sum.y[i] += sum.factors[r] * sum.columns[r * sum.rows + i];
}

// As the kernels of the sine basis, compiled for several processors.
#if defined(__x86_64__) && !defined(__clang__)
[[gnu::target("arch=x86-64-v4")]] void add_by_eight(const ColumnSum& sum) {
    add_by<EightDoubles>(sum);
}
[[gnu::target("arch=x86-64-v3")]] void add_by_four(const ColumnSum& sum) {
    add_by<FourDoubles>(sum);
}
#endif
void add_by_two(const ColumnSum& sum) {
    add_by<TwoDoubles>(sum);
}

auto chosen() {
#if defined(__x86_64__) && !defined(__clang__)
    if (__builtin_cpu_supports("x86-64-v4") != 0)
        return &add_by_eight;
    if (__builtin_cpu_supports("x86-64-v3") != 0)
        return &add_by_four;
#endif
    return &add_by_two;
}

} // namespace

void add_columns(Eigen::Ref<Eigen::VectorXd> y, const Eigen::MatrixXd& columns,
                 const Eigen::VectorXd& factors) {
    static const auto add = chosen();
    add({y.data(), columns.rows(), columns.data(), factors.size(), factors.data()});
}

} // namespace tvbeam

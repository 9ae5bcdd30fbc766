#pragma once

#include "core/sine/kernel.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace tvbeam {

/// Sums of the kernel, eight lanes each.
using PackSums = std::vector<Pack>;

/// The sum of the lanes.
inline double total(const Pack& pack) {
    return Eigen::Map<const Eigen::Matrix<double, Pack::size, 1>>(pack.lanes).sum();
}

/// The sum of the lanes of each of the first ones.
inline void find_totals(Eigen::VectorXd& sums, const PackSums& packs, Eigen::Index count) {
    sums.resize(count);
    for (Eigen::Index i = 0; i < count; ++i)
        sums(i) = total(packs[static_cast<std::size_t>(i)]);
}

inline Pack* cleared(PackSums& packs, Eigen::Index count) {
    std::fill_n(packs.begin(), count, Pack{});
    return packs.data();
}

} // namespace tvbeam

#pragma once

#include "core/sine/kernel.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace tvbeam {

/// Sums of the kernel, eight lanes each.
using PackSums = std::vector<Pack>;

/// The sum of the lanes of each of the first ones.
inline Eigen::VectorXd totals(const PackSums& packs, Eigen::Index count) {
    return Eigen::Map<const Eigen::Matrix<double, Pack::size, Eigen::Dynamic>>(packs.data()->lanes,
                                                                               Pack::size, count)
        .colwise()
        .sum()
        .transpose();
}

inline Pack* cleared(PackSums& packs, Eigen::Index count) {
    std::fill_n(packs.begin(), count, Pack{});
    return packs.data();
}

} // namespace tvbeam

#pragma once

#include <cmath>
#include <vector>

/// The least-squares slope of ln y over ln x.
inline double slope(const std::vector<double>& x, const std::vector<double>& y) {
    double mean_x = 0, mean_y = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += std::log(x[i]) / static_cast<double>(x.size());
        mean_y += std::log(y[i]) / static_cast<double>(x.size());
    }
    double product = 0, square = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        product += (std::log(x[i]) - mean_x) * (std::log(y[i]) - mean_y);
        square += (std::log(x[i]) - mean_x) * (std::log(x[i]) - mean_x);
    }
    return product / square;
}

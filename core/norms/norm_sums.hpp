#pragma once

#include "core/norms/norms.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace tvbeam {

constexpr std::size_t index(Quantity quantity) {
    return static_cast<std::size_t>(quantity);
}

/// The squared error of each Quantity at one time.
using Squares = std::array<double, quantity_count>;

/// Squares of which none is measured yet: NaN, so that a norm of one that nobody measures says so.
inline Squares unmeasured() {
    Squares squares;
    squares.fill(std::numeric_limits<double>::quiet_NaN());
    return squares;
}

bool all_finite(const std::vector<double>& errors);

/// The quantities that some norms need between them.
QuantitySet quantities_of(const std::vector<Norm>& norms);

/// Norms in time, from the squares of the errors in space.
class NormSums {
public:
    explicit NormSums(std::vector<Norm> norms);

    /// Adds a time level of weight dt.
    void add(double dt, const Squares& squares);

    /// The norms so far, in the order in which they were asked for; NaN or infinite when an error
    /// is.
    [[nodiscard]] std::vector<double> values() const;

    [[nodiscard]] const QuantitySet& needed() const { return needed_; }

    /// Spatial norms added so far.
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

private:
    /// One time norm of one of the norms.
    struct Sum {
        bool greatest; // rather than the weighted sum
        std::vector<std::size_t> quantities;
        double value;
    };
    std::vector<Norm> norms_;
    QuantitySet needed_;
    std::vector<Sum> sums_; // the parts of all norms in turn
    std::int64_t evaluations_ = 0;
};

} // namespace tvbeam

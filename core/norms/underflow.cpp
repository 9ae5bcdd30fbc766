#include "core/norms/underflow.hpp"

#include "core/norms/norm_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

using Eigen::ArrayXd;

/// The greatest value of what a norm measures, of the exact solution.
double greatest_of(const ExactSolution& exact, const ProblemData& data, const Norm& norm,
                   double final_time) {
    const int times = exact.elements == 0 ? 17 : 1; // what is computed is known at the end
    static const ArrayXd x = ArrayXd::LinSpaced(64, 0.5 / 64, 1 - 0.5 / 64);
    const QuantitySet measured = norm.quantities();
    const auto fields = exact.fields();
    double greatest = 0.0;
    for (int n = 1; n <= times; ++n) {
        const double t = final_time * n / times;
        for (std::size_t q = 0; q < fields.size(); ++q)
            if (measured[q])
                greatest = std::max(greatest, values(data, *fields[q], x, t).abs().maxCoeff());
        if (measured[index(Quantity::stress)] && exact.stress)
            greatest = std::max(
                greatest, std::abs(data.amplitudes(ArrayXd::Constant(1, t))(*exact.stress, 0)));
    }
    return greatest;
}

} // namespace

std::string underflow(const ProblemData& data, const std::vector<Norm>& norms,
                      const std::vector<double>& errors, double final_time) {
    for (std::size_t k = 0; k < norms.size(); ++k) {
        const double square = norms[k].squared ? errors[k] : errors[k] * errors[k];
        double size = std::sqrt(square);
        if (square >= least_square)
            continue;
        if (errors[k] == 0.0) {
            size = greatest_of(*data.exact, data, norms[k], final_time);
            if (size == 0.0 || size * size >= least_square)
                continue;
        }
        return fmt::format("{} is not known: {} about {:.1e}, and squares of that are below what a "
                           "double holds; multiply the solution, or the data, stops and sources by "
                           "a number",
                           norms[k].name, errors[k] > 0.0 ? "it is" : "what it measures is", size);
    }
    return {};
}

} // namespace tvbeam

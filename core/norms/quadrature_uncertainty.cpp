#include "core/norms/quadrature_uncertainty.hpp"

#include "core/norms/norm_sums.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

/// Of what the solution is uncertain by less than this, nothing is said: it is round-off.
constexpr double negligible = 1e-13;

constexpr int times = 17;

/// ‖field‖² at a time.
double square_of(const ProblemData& data, const Field& field, double t) {
    constexpr Eigen::Index places = 8192;
    static const Eigen::ArrayXd x =
        Eigen::ArrayXd::LinSpaced(places, 0.5 / places, 1.0 - 0.5 / places);
    return values(data, field, x, t).square().mean();
}

/// The norms of the exact solution itself.
std::vector<double> sizes(const ProblemData& data, const std::vector<Norm>& norms,
                          double final_time) {
    const ExactSolution& exact = *data.exact;
    const int count = exact.elements == 0 ? times : 1;
    const auto fields = exact.fields();
    NormSums sums(norms);
    for (int n = 1; n <= count; ++n) {
        const double t = final_time * n / count;
        Squares squares{};
        for (std::size_t q = 0; q < fields.size(); ++q)
            if (sums.needed()[q])
                squares[q] = square_of(data, *fields[q], t);
        if (exact.stress)
            squares[index(Quantity::stress)] =
                std::pow(data.amplitudes(Eigen::ArrayXd::Constant(1, t))(*exact.stress, 0), 2);
        sums.add(final_time / count, squares);
    }
    return sums.values();
}

/// Σ ‖load‖ where it is greatest in time.
double size_of(const ProblemData& data, const std::vector<const Field*>& loads, double final_time) {
    double greatest = 0.0;
    for (int n = 1; n <= times; ++n) {
        double sum = 0.0;
        for (const Field* load : loads)
            sum += std::sqrt(square_of(data, *load, final_time * n / times));
        greatest = std::max(greatest, sum);
    }
    return greatest;
}

} // namespace

std::vector<double> quadrature_uncertainties(const ProblemData& data,
                                             const std::vector<const Field*>& loads,
                                             const Resolution& resolution, const Mesh& mesh,
                                             const std::vector<Norm>& norms,
                                             const std::vector<double>& errors, double final_time) {
    const double delta = resolution.uncertainty(mesh);
    if (delta <= negligible)
        return {};
    std::vector<double> parts = sizes(data, norms, final_time);
    const double load = size_of(data, loads, final_time);
    for (std::size_t k = 0; k < norms.size(); ++k) {
        const double size = norms[k].squared ? std::sqrt(parts[k]) : parts[k];
        const double error = norms[k].squared ? std::sqrt(errors[k]) : errors[k];
        const double of_norm =
            std::min(std::sqrt(delta) * size, delta * size * size / (2.0 * error));
        parts[k] = error > 0.0 ? (delta * (size + load) + of_norm) / error : 1.0;
    }
    return parts;
}

} // namespace tvbeam

#include "core/sine_basis.hpp"

#include <gsl/gsl_fft_real.h>

#include <memory>
#include <new>
#include <numbers>

namespace tvbeam {

namespace {

using Wavetable = std::unique_ptr<gsl_fft_real_wavetable, decltype(&gsl_fft_real_wavetable_free)>;
using Workspace = std::unique_ptr<gsl_fft_real_workspace, decltype(&gsl_fft_real_workspace_free)>;

/// π/2 k/s, k = 1 … s − 1.
Eigen::ArrayXd half_angles(Eigen::Index elements) {
    return Eigen::ArrayXd::LinSpaced(elements - 1, 1.0, static_cast<double>(elements - 1)) *
           (0.5 * std::numbers::pi / static_cast<double>(elements));
}

} // namespace

bool SineBasis::suits(Eigen::Index elements) {
    // Larger factors cost the transform their square, and digits.
    for (const Eigen::Index prime : {2, 3, 5, 7, 11, 13})
        while (elements % prime == 0 && elements > 1)
            elements /= prime;
    return elements == 1;
}

SineBasis::SineBasis(Eigen::Index elements) : elements_(elements) {
    const auto s = static_cast<double>(elements);
    const Eigen::ArrayXd sine_square = half_angles(elements).sin().square();
    mass_ = (3.0 - 2.0 * sine_square) / (3.0 * s); // h (2 + cos)/3
    scale_ = (2.0 / (s * mass_)).sqrt();
    stiffness_ = 4.0 * s * sine_square / mass_; // 2 (1 − cos)/h, over m_k
}

Eigen::ArrayXd SineBasis::lumped_mass() const {
    return 1.0 / (static_cast<double>(elements_) * mass_);
}

Eigen::ArrayXd SineBasis::of_load(const Eigen::VectorXd& hat_load) const {
    return scale_ * sine_sums(hat_load);
}

Eigen::ArrayXd SineBasis::of_nodal(const Eigen::VectorXd& nodal) const {
    return mass_ * scale_ * sine_sums(nodal);
}

Eigen::ArrayXd SineBasis::left_hat() const {
    // (1 − x, χ_i) = h (1 − x_i), and Σ_i (1 − x_i) sin(kπx_i) = cot(kπ/2s)/2.
    return scale_ / (2.0 * static_cast<double>(elements_) * half_angles(elements_).tan());
}

Eigen::ArrayXd SineBasis::right_hat() const {
    Eigen::ArrayXd mirrored = left_hat();
    for (Eigen::Index k = 1; k < size(); k += 2)
        mirrored(k) = -mirrored(k);
    return mirrored;
}

Eigen::ArrayXd SineBasis::sine_sums(const Eigen::VectorXd& v) const {
    const Eigen::Index s = elements_;
    if (s < 2)
        return Eigen::ArrayXd(0);
    // The odd extension to 2s points has the transform −2i Σ_i sin(kπx_i) v_i.
    const auto points = static_cast<std::size_t>(2 * s);
    Eigen::VectorXd odd = Eigen::VectorXd::Zero(2 * s);
    odd.segment(1, s - 1) = v.segment(1, s - 1);
    odd.tail(s - 1) = -v.segment(1, s - 1).reverse();
    const Wavetable wavetable(gsl_fft_real_wavetable_alloc(points), &gsl_fft_real_wavetable_free);
    const Workspace workspace(gsl_fft_real_workspace_alloc(points), &gsl_fft_real_workspace_free);
    if (!wavetable || !workspace)
        throw std::bad_alloc();
    gsl_fft_real_transform(odd.data(), 1, points, wavetable.get(), workspace.get());
    // Half-complex order: re_0, re_1, im_1, re_2, im_2, ….
    Eigen::ArrayXd sums(s - 1);
    for (Eigen::Index k = 1; k < s; ++k)
        sums(k - 1) = -0.5 * odd(2 * k);
    return sums;
}

} // namespace tvbeam

#include "core/sine/basis.hpp"

#include "core/gsl_errors.hpp"

#include <gsl/gsl_fft_real.h>

#include <cmath>
#include <memory>
#include <new>
#include <numbers>

namespace tvbeam {

namespace {

using Wavetable = std::unique_ptr<gsl_fft_real_wavetable, decltype(&gsl_fft_real_wavetable_free)>;
using Workspace = std::unique_ptr<gsl_fft_real_workspace, decltype(&gsl_fft_real_workspace_free)>;

/// sin(kπ/2s), k = 1 … s − 1; in reverse order they are the cosines.
Eigen::ArrayXd half_angle_sines(Eigen::Index elements) {
    return (Eigen::ArrayXd::LinSpaced(elements - 1, 1.0, static_cast<double>(elements - 1)) *
            (0.5 * std::numbers::pi / static_cast<double>(elements)))
        .sin();
}

} // namespace

/// v ↦ Σ_i sin(kπx_i) v_i over the inner nodes, k = 1 … s − 1, with tables made once.
class SineBasis::Transform {
public:
    /// s ≥ 2.
    explicit Transform(Eigen::Index elements)
        : elements_(elements), points_(static_cast<std::size_t>(2 * elements)),
          wavetable_(gsl_fft_real_wavetable_alloc(points_), &gsl_fft_real_wavetable_free),
          workspace_(gsl_fft_real_workspace_alloc(points_), &gsl_fft_real_workspace_free) {
        if (!wavetable_ || !workspace_)
            throw std::bad_alloc();
    }

    /// Not in two threads at once: they would share the workspace.
    [[nodiscard]] Eigen::ArrayXd sums(const Eigen::VectorXd& v) const {
        // The odd extension to 2s points has the transform −2i Σ_i sin(kπx_i) v_i.
        const Eigen::Index s = elements_;
        Eigen::VectorXd odd(2 * s);
        odd(0) = 0.0;
        odd.segment(1, s - 1) = v.segment(1, s - 1);
        odd(s) = 0.0;
        odd.tail(s - 1) = -v.segment(1, s - 1).reverse();
        gsl_fft_real_transform(odd.data(), 1, points_, wavetable_.get(), workspace_.get());
        // Half-complex order: re_0, re_1, im_1, re_2, im_2, ….
        Eigen::ArrayXd sums(s - 1);
        for (Eigen::Index k = 1; k < s; ++k)
            sums(k - 1) = -0.5 * odd(2 * k);
        return sums;
    }

private:
    Eigen::Index elements_;
    std::size_t points_;
    Wavetable wavetable_;
    Workspace workspace_;
};

bool SineBasis::suits(Eigen::Index elements) {
    // Larger factors cost the transform their square, and digits.
    for (const Eigen::Index prime : {2, 3, 5, 7, 11, 13})
        while (elements % prime == 0 && elements > 1)
            elements /= prime;
    return elements == 1;
}

SineBasis::SineBasis(Eigen::Index elements)
    : elements_(elements), sines_(half_angle_sines(elements)) {
    if (elements > 1)
        transform_ = std::make_shared<const Transform>(elements);
    const auto s = static_cast<double>(elements);
    const Eigen::ArrayXd sine_square = sines_.square();
    mass_ = (3.0 - 2.0 * sine_square) / (3.0 * s); // h (2 + cos)/3
    scale_ = (2.0 / (s * mass_)).sqrt();
    stiffness_ = 4.0 * s * sine_square / mass_; // 2 (1 − cos)/h, over m_k
}

Eigen::ArrayXd SineBasis::lumped_mass() const {
    return 1.0 / (static_cast<double>(elements_) * mass_);
}

Eigen::ArrayXd SineBasis::of_load(const Eigen::VectorXd& hat_load) const {
    return size() == 0 ? Eigen::ArrayXd() : Eigen::ArrayXd(scale_ * transform_->sums(hat_load));
}

Eigen::ArrayXd SineBasis::of_nodal(const Eigen::VectorXd& nodal) const {
    return size() == 0 ? Eigen::ArrayXd()
                       : Eigen::ArrayXd(mass_ * scale_ * transform_->sums(nodal));
}

Eigen::VectorXd SineBasis::nodal(const Eigen::ArrayXd& coefficients) const {
    Eigen::VectorXd nodal = Eigen::VectorXd::Zero(elements_ + 1);
    if (size() > 0) {
        nodal.segment(1, size()) = (scale_ * coefficients).matrix();
        nodal.segment(1, size()) = transform_->sums(nodal).matrix(); // its own inverse but for s/2
    }
    return nodal;
}

// H_k is −φ̂_k/K_k at the nodes. On an element with φ̂_k = l (1 − ξ) + r ξ it lies by h² (l β(1 − ξ)
// + r β(ξ)), β = (ξ − ξ³)/6, below the line between them; over all elements Σ (l² + r²) = ν²s and
// Σ l r = ν²s cos(kπh)/2, and cos(kπh) = 1 − 2 sin²(kπh/2).
Eigen::ArrayXd SineBasis::slope_squares() const {
    const Eigen::ArrayXd cosines = 1.0 - 2.0 * sines_.square();
    const double h = 1.0 / static_cast<double>(elements_);
    return 1.0 / stiffness_ +
           h * h * scale_.square() * (1.0 / 45.0 + 7.0 / 360.0 * cosines); // |β'|² = 1/45, …
}

Eigen::ArrayXd SineBasis::value_squares() const {
    const Eigen::ArrayXd cosines = 1.0 - 2.0 * sines_.square();
    const Eigen::ArrayXd nu = scale_.square() / std::pow(static_cast<double>(elements_), 2);
    const double h2 = 1.0 / std::pow(static_cast<double>(elements_), 2);
    return 1.0 / stiffness_.square() +
           2.0 * nu / stiffness_ * (1.0 / 45.0 + 7.0 / 360.0 * cosines) +
           h2 * nu * (2.0 / 945.0 + 31.0 / 15120.0 * cosines);
}

Eigen::ArrayXd SineBasis::left_hat() const {
    // (1 − x, χ_i) = h (1 − x_i), and Σ_i (1 − x_i) sin(kπx_i) = cot(kπ/2s)/2.
    return scale_ * sines_.reverse() / (2.0 * static_cast<double>(elements_) * sines_);
}

Eigen::ArrayXd SineBasis::right_hat() const {
    Eigen::ArrayXd mirrored = left_hat();
    for (Eigen::Index k = 1; k < size(); k += 2)
        mirrored(k) = -mirrored(k);
    return mirrored;
}

} // namespace tvbeam

/// The parameters of the model of term_model.hpp, and the model as a function of them: for its
/// fits.
#pragma once

#include "studies/orders/least_squares.hpp"
#include "studies/orders/term_model.hpp"

#include <Eigen/Core>

#include <numeric>
#include <vector>

namespace tvbeam {

/// Where the parameters stand in θ.
class Layout {
public:
    Layout(const TermShape& shape, Eigen::Index widths)
        : shape_(shape), widths_(widths), size_(2 * widths + widths * (widths - 1) / 2) {
        for (const double power : shape.next)
            next_.push_back(power == TermShape::none ? -1 : size_++);
        if (shape.floor)
            floor_ = size_++;
        if (shape.saturates)
            saturation_ = size_++;
    }
    Eigen::Index widths() const { return widths_; }
    Eigen::Index pair(Eigen::Index i, Eigen::Index j) const {
        return 2 * widths_ + i * (2 * widths_ - i - 1) / 2 + (j - i - 1);
    }
    bool is_rho(Eigen::Index k) const { return k >= 2 * widths_ && k < pair(widths_ - 1, widths_); }
    /// The places of all ρ.
    std::vector<Eigen::Index> rhos() const {
        std::vector<Eigen::Index> places(static_cast<std::size_t>(widths_ * (widths_ - 1) / 2));
        std::iota(places.begin(), places.end(), 2 * widths_);
        return places;
    }
    Eigen::Index next(Eigen::Index i) const { return next_[static_cast<std::size_t>(i)]; }
    double power(Eigen::Index i) const { return shape_.next[static_cast<std::size_t>(i)]; }
    Eigen::Index floor() const { return floor_; }
    Eigen::Index saturation() const { return saturation_; }
    Eigen::Index size() const { return size_; }

private:
    const TermShape& shape_;
    Eigen::Index widths_;
    Eigen::Index size_;
    std::vector<Eigen::Index> next_;
    Eigen::Index floor_ = -1;
    Eigen::Index saturation_ = -1;
};

/// T_i at one row, and its derivatives by p_i and c_i; that by ln a_i is T_i itself.
struct Term {
    double value = 0;
    double by_order = 0;
    double by_next = 0;
};

Term term_at(const Layout& layout, const Eigen::VectorXd& theta, Eigen::Index i, double log_x);

/// What a comparison with a reference shows of a term, given its value there, too.
Term measured(const Term& term, const Term& reference, bool in_squares);

/// ln of a reference's width; NaN where the comparison is exact.
double reference_of(const Eigen::VectorXd& log_reference, Eigen::Index i);

/// ln e of the rows as a function of θ; NaN where the model has no error. It refers to both.
ModelFunction model_of(const Layout& layout, const TermRows& rows);

} // namespace tvbeam

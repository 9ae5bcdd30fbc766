#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// A symmetric tridiagonal matrix of order n.
struct Tridiagonal {
    Eigen::VectorXd diagonal; ///< shape: n
    Eigen::VectorXd coupling; ///< entry (i, i+1) = (i+1, i); shape: n − 1
    /// Sums of the rows, shape: n. Kept beside the diagonal, because diagonal and couplings of a
    /// stiffness matrix cancel: what is left of them by subtraction is wrong by ε/h² of the mass.
    Eigen::VectorXd row_sums;

    friend Tridiagonal operator+(Tridiagonal a, const Tridiagonal& b); // in place, where it can be
    friend Tridiagonal operator*(Tridiagonal a, double factor);
    Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;
};

/// Where the elimination of a tridiagonal matrix ends: in its last row, as in the paper's
/// algorithm, or in the middle, which it reaches from both ends, so that a solve has two
/// recurrences that do not wait for each other.
enum class Elimination { from_the_left, from_both_ends };

/// A symmetric positive definite tridiagonal matrix, eliminated without pivoting towards a row m.
/// The pivots follow from row sums and couplings without a subtraction where no coupling is
/// positive (Alfa, Xue and Ye 2002), so that the solution is accurate whatever the condition.
class TridiagonalFactor {
public:
    TridiagonalFactor() = default;

    /// Throws std::domain_error when a pivot is not positive and finite.
    explicit TridiagonalFactor(const Tridiagonal& matrix,
                               Elimination elimination = Elimination::from_the_left);

    /// x ← A⁻¹ x.
    void solve_in_place(Eigen::Ref<Eigen::VectorXd> x) const;

    [[nodiscard]] Eigen::Index order() const { return inverse_pivots_.size(); }

private:
    Eigen::Index last_ = 0;       // m
    Eigen::VectorXd multipliers_; // A(i, i−1) / d_{i−1} up to i = m, A(i, i−1) / d_i behind it
    Eigen::VectorXd inverse_pivots_; // 1 / d_i
};

} // namespace tvbeam

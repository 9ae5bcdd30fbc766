#pragma once

#include <ginac/ginac.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tvbeam {

/// A scalar, a vector or a matrix of expressions.
struct Tensor {
    enum class Rank { scalar, vector, matrix };
    Rank rank = Rank::scalar;
    std::size_t rows = 1;
    std::size_t columns = 1;
    GiNaC::exvector entries; ///< row by row

    static Tensor scalar(const GiNaC::ex& value) { return {Rank::scalar, 1, 1, {value}}; }
    static Tensor vector(GiNaC::exvector values);
    static Tensor matrix(std::size_t rows, std::size_t columns);

    [[nodiscard]] const GiNaC::ex& at(std::size_t i, std::size_t j) const {
        return entries[i * columns + j];
    }
    [[nodiscard]] GiNaC::ex& at(std::size_t i, std::size_t j) { return entries[i * columns + j]; }
    [[nodiscard]] bool is_scalar() const { return rank == Rank::scalar; }
    [[nodiscard]] bool is_square() const { return rank == Rank::matrix && rows == columns; }
};

/// "a scalar", "a vector of 3", "a matrix of 2 by 3".
std::string shape_text(const Tensor& tensor);

// All of these throw AlgebraError, where the shapes do not fit, say, or an entry has more than
// 20 000 nodes.

Tensor tensor_sum(const Tensor& a, const Tensor& b);
Tensor tensor_difference(const Tensor& a, const Tensor& b);
/// One of them a scalar; of two others it is dot, inner or outer.
Tensor tensor_product(const Tensor& a, const Tensor& b);
Tensor tensor_quotient(const Tensor& a, const Tensor& b); ///< b: a scalar
Tensor tensor_power(const Tensor& a, const Tensor& b);    ///< of scalars

Tensor dot(const Tensor& a, const Tensor& b);
Tensor inner(const Tensor& a, const Tensor& b);
Tensor outer(const Tensor& a, const Tensor& b);
Tensor transpose(const Tensor& a);
Tensor sym(const Tensor& a);
Tensor trace(const Tensor& a);
Tensor identity(std::size_t size);

/// Rows of a matrix from vectors, a vector from scalars.
Tensor tensor_list(const std::vector<Tensor>& entries);

/// Throws AlgebraError where an expression has more than 20 000 nodes.
void require_moderate(const GiNaC::ex& expression);

} // namespace tvbeam

#include "mms/equations/tensor.hpp"

#include "mms/expression/algebra.hpp"

#include <algorithm>

namespace tvbeam {

using GiNaC::ex;

namespace {

constexpr std::size_t most_nodes = 20'000;
constexpr std::size_t longest_list = 9;

std::size_t nodes_of(const ex& expression, std::size_t count) {
    ++count;
    for (const ex& operand : expression) {
        if (count > most_nodes)
            break;
        count = nodes_of(operand, count);
    }
    return count;
}

template <typename Operation>
Tensor entrywise(const Tensor& a, const Operation& operation) {
    Tensor result = a;
    for (ex& entry : result.entries) {
        entry = operation(entry);
        require_moderate(entry);
    }
    return result;
}

void require_same_shape(const Tensor& a, const Tensor& b, const std::string& what) {
    if (a.rank != b.rank || a.rows != b.rows || a.columns != b.columns)
        throw AlgebraError("the " + what + " of " + shape_text(a) + " and " + shape_text(b) +
                           " has no meaning; both must have one shape");
}

void require_square(const Tensor& a, const std::string& function) {
    if (!a.is_square())
        throw AlgebraError(function + " is for square matrices; this is " + shape_text(a));
}

ex summed_products(const Tensor& a, std::size_t row, const Tensor& b, std::size_t column) {
    ex sum = 0;
    for (std::size_t k = 0; k < b.rows; ++k)
        sum = checked_sum(sum, checked_product(a.at(row, k), b.at(k, column)));
    require_moderate(sum);
    return sum;
}

} // namespace

void require_moderate(const ex& expression) {
    if (nodes_of(expression, 0) > most_nodes)
        throw AlgebraError("what comes of it has more than " + std::to_string(most_nodes) +
                           " nodes; write it with fewer factors or simpler functions");
}

Tensor Tensor::vector(GiNaC::exvector values) {
    const std::size_t size = values.size();
    return {Rank::vector, size, 1, std::move(values)};
}

Tensor Tensor::matrix(std::size_t rows, std::size_t columns) {
    return {Rank::matrix, rows, columns, GiNaC::exvector(rows * columns, ex(0))};
}

std::string shape_text(const Tensor& tensor) {
    if (tensor.is_scalar())
        return "a scalar";
    if (tensor.rank == Tensor::Rank::vector)
        return "a vector of " + std::to_string(tensor.rows);
    return "a matrix of " + std::to_string(tensor.rows) + " by " + std::to_string(tensor.columns);
}

Tensor tensor_sum(const Tensor& a, const Tensor& b) {
    require_same_shape(a, b, "sum");
    auto other = b.entries.begin();
    return entrywise(a, [&](const ex& entry) { return checked_sum(entry, *other++); });
}

Tensor tensor_difference(const Tensor& a, const Tensor& b) {
    require_same_shape(a, b, "difference");
    auto other = b.entries.begin();
    return entrywise(a, [&](const ex& entry) { return checked_difference(entry, *other++); });
}

Tensor tensor_product(const Tensor& a, const Tensor& b) {
    if (!a.is_scalar() && !b.is_scalar())
        throw AlgebraError("a product of " + shape_text(a) + " and " + shape_text(b) +
                           " can mean several things; write dot(a, b), inner(a, b) or outer(a, b)");
    const Tensor& scalar = a.is_scalar() ? a : b;
    return entrywise(a.is_scalar() ? b : a, [&](const ex& entry) {
        return checked_product(scalar.entries.front(), entry);
    });
}

Tensor tensor_quotient(const Tensor& a, const Tensor& b) {
    if (!b.is_scalar())
        throw AlgebraError("division by " + shape_text(b) + "; only a scalar divides");
    return entrywise(a,
                     [&](const ex& entry) { return checked_quotient(entry, b.entries.front()); });
}

Tensor tensor_power(const Tensor& a, const Tensor& b) {
    if (!a.is_scalar() || !b.is_scalar())
        throw AlgebraError("a power is of scalars; here of " + shape_text(a) + " and " +
                           shape_text(b) + "; the square of a vector is dot(v, v)");
    return entrywise(a, [&](const ex& entry) { return checked_power(entry, b.entries.front()); });
}

Tensor dot(const Tensor& a, const Tensor& b) {
    if (a.is_scalar() || b.is_scalar())
        throw AlgebraError("dot is for vectors and matrices; here it has " + shape_text(a) +
                           " and " + shape_text(b) + ", for which '*' is written");
    const Tensor left = a.rank == Tensor::Rank::vector ? transpose(a) : a;
    if (left.columns != b.rows)
        throw AlgebraError("dot of " + shape_text(a) + " and " + shape_text(b) +
                           " has no meaning; the last size of the one must be the first of the "
                           "other");
    Tensor result = Tensor::matrix(left.rows, b.columns);
    for (std::size_t i = 0; i < result.rows; ++i)
        for (std::size_t j = 0; j < result.columns; ++j)
            result.at(i, j) = summed_products(left, i, b, j);
    if (a.rank == Tensor::Rank::vector && b.rank == Tensor::Rank::vector)
        return Tensor::scalar(result.entries.front());
    return a.rank == Tensor::Rank::vector || b.rank == Tensor::Rank::vector
               ? Tensor::vector(result.entries)
               : result;
}

Tensor inner(const Tensor& a, const Tensor& b) {
    require_same_shape(a, b, "inner product");
    ex sum = 0;
    for (std::size_t i = 0; i < a.entries.size(); ++i)
        sum = checked_sum(sum, checked_product(a.entries[i], b.entries[i]));
    require_moderate(sum);
    return Tensor::scalar(sum);
}

Tensor outer(const Tensor& a, const Tensor& b) {
    if (a.rank != Tensor::Rank::vector || b.rank != Tensor::Rank::vector)
        throw AlgebraError("outer is for two vectors; here it has " + shape_text(a) + " and " +
                           shape_text(b));
    Tensor result = Tensor::matrix(a.rows, b.rows);
    for (std::size_t i = 0; i < a.rows; ++i)
        for (std::size_t j = 0; j < b.rows; ++j) {
            result.at(i, j) = checked_product(a.entries[i], b.entries[j]);
            require_moderate(result.at(i, j));
        }
    return result;
}

Tensor transpose(const Tensor& a) {
    Tensor result = Tensor::matrix(a.columns, a.rows);
    for (std::size_t i = 0; i < a.rows; ++i)
        for (std::size_t j = 0; j < a.columns; ++j)
            result.at(j, i) = a.at(i, j);
    return result;
}

Tensor sym(const Tensor& a) {
    require_square(a, "sym");
    return tensor_product(Tensor::scalar(GiNaC::numeric(1, 2)), tensor_sum(a, transpose(a)));
}

Tensor trace(const Tensor& a) {
    require_square(a, "trace");
    return inner(a, identity(a.rows));
}

Tensor identity(std::size_t size) {
    Tensor result = Tensor::matrix(size, size);
    for (std::size_t i = 0; i < size; ++i)
        result.at(i, i) = 1;
    return result;
}

Tensor tensor_list(const std::vector<Tensor>& entries) {
    const Tensor& first = entries.front();
    if (entries.size() > longest_list)
        throw AlgebraError("a list has at most " + std::to_string(longest_list) +
                           " entries; this one has " + std::to_string(entries.size()));
    if (first.rank == Tensor::Rank::matrix)
        throw AlgebraError("a list is of scalars, or of vectors, the rows of a matrix");
    GiNaC::exvector values;
    for (const Tensor& entry : entries) {
        if (entry.rank != first.rank || entry.rows != first.rows)
            throw AlgebraError("a list holds " + shape_text(first) + " and " + shape_text(entry) +
                               "; its entries must have one shape");
        values.insert(values.end(), entry.entries.begin(), entry.entries.end());
    }
    if (first.is_scalar())
        return Tensor::vector(values);
    return {Tensor::Rank::matrix, entries.size(), first.rows, values};
}

} // namespace tvbeam

#include "mms/equations/equation_language.hpp"

#include "mms/equations/equation_names.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/grammar.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

namespace tvbeam {

using GiNaC::ex;

namespace {

constexpr int most_derivatives = 8;

class EquationLanguage {
public:
    using Value = Tensor;
    static constexpr bool has_lists = true;

    EquationLanguage(const TensorTable& names, Fields& fields, int dimension,
                     const GiNaC::exmap& parameters)
        : names_(names), fields_(fields), dimension_(static_cast<std::size_t>(dimension)),
          parameters_(parameters) {}

    static Tensor sum(const Tensor& a, const Tensor& b) { return tensor_sum(a, b); }
    static Tensor difference(const Tensor& a, const Tensor& b) { return tensor_difference(a, b); }
    static Tensor product(const Tensor& a, const Tensor& b) { return tensor_product(a, b); }
    static Tensor quotient(const Tensor& a, const Tensor& b) { return tensor_quotient(a, b); }
    [[nodiscard]] Tensor power(const Tensor& a, const Tensor& b) const {
        if (a.is_scalar() && b.is_scalar() && is_zero_with_parameters(a) &&
            is_zero_with_parameters(b))
            throw AlgebraError("0^0 has no value: with the parameters as they are, base and "
                               "exponent are 0");
        return tensor_power(a, b);
    }
    static Tensor negated(const Tensor& a) { return tensor_product(Tensor::scalar(-1), a); }
    static Tensor list(const std::vector<Tensor>& entries) { return tensor_list(entries); }
    static Tensor number(const std::string& /*written*/, const ex& value) {
        return Tensor::scalar(value);
    }

    std::optional<Tensor> name(const std::string& word) const {
        if (word == "pi")
            return Tensor::scalar(GiNaC::Pi);
        if (word == "identity")
            return identity(dimension_);
        const auto found = names_.find(word);
        return found == names_.end() ? component(word) : std::optional(found->second);
    }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> result = {"pi", "identity"};
        for (const auto& [name, value] : names_) {
            result.push_back(name);
            if (value.rank == Tensor::Rank::vector && value.rows > 1)
                for (const auto& part : component_names(name, value.rows))
                    result.push_back(part);
        }
        return result;
    }

    static const std::vector<std::string>& functions() {
        static const std::vector<std::string> all = [] {
            std::vector<std::string> names = function_names();
            names.insert(names.end(), operator_names().begin(), operator_names().end());
            return names;
        }();
        return all;
    }
    static bool takes_one(const std::string& function) {
        return function != "diff" && function != "dot" && function != "inner" &&
               function != "outer";
    }

    Tensor call(const std::string& function, const std::vector<Tensor>& arguments) {
        using Unary = Tensor (EquationLanguage::*)(const Tensor&);
        static const std::map<std::string, Unary> operators = {
            {"grad", &EquationLanguage::grad},
            {"div", &EquationLanguage::div},
            {"curl", &EquationLanguage::curl},
            {"laplace", &EquationLanguage::laplace}};
        static const std::map<std::string, Tensor (*)(const Tensor&)> algebra = {
            {"sym", sym}, {"trace", trace}, {"transpose", transposed}};
        static const std::map<std::string, Tensor (*)(const Tensor&, const Tensor&)> products = {
            {"dot", dot}, {"inner", inner}, {"outer", outer}};
        if (function == "diff")
            return diff(arguments);
        if (const auto found = operators.find(function); found != operators.end())
            return (this->*found->second)(arguments.front());
        if (const auto found = algebra.find(function); found != algebra.end())
            return found->second(arguments.front());
        if (const auto found = products.find(function); found != products.end()) {
            if (arguments.size() != 2)
                throw AlgebraError(function + " takes two arguments, " +
                                   std::to_string(arguments.size()) + " given");
            return found->second(arguments[0], arguments[1]);
        }
        if (!arguments.front().is_scalar())
            throw AlgebraError(function + " is of a scalar; this is " +
                               shape_text(arguments.front()));
        return Tensor::scalar(checked_function(function, arguments.front().entries.front()));
    }

private:
    [[nodiscard]] bool is_zero_with_parameters(const Tensor& scalar) const {
        const auto number = number_with(scalar.entries.front(), parameters_);
        return number && number->is_zero();
    }

    /// v2 of a vector v.
    [[nodiscard]] std::optional<Tensor> component(const std::string& word) const {
        const auto vector = names_.find(word.substr(0, word.size() - 1));
        if (vector == names_.end() || vector->second.rank != Tensor::Rank::vector)
            return std::nullopt;
        const auto names = component_names(vector->first, vector->second.rows);
        const auto found = std::find(names.begin(), names.end(), word);
        if (found == names.end())
            return std::nullopt;
        return Tensor::scalar(
            vector->second.entries[static_cast<std::size_t>(found - names.begin())]);
    }

    static Tensor transposed(const Tensor& a) {
        if (a.rank != Tensor::Rank::matrix)
            throw AlgebraError("transpose is for matrices; this is " + shape_text(a));
        return transpose(a);
    }

    Tensor derivative(const Tensor& a, std::size_t coordinate) {
        Tensor result = a;
        for (ex& entry : result.entries)
            entry = fields_.derivative(entry, coordinate);
        return result;
    }

    static std::optional<std::size_t> coordinate_of(const Tensor& a) {
        for (std::size_t i = 0; i < coordinate_count; ++i)
            if (a.is_scalar() && a.entries.front().is_equal(coordinate(i)))
                return i;
        return std::nullopt;
    }

    /// diff(e, x), diff(e, x, 2), diff(e, x, 2, t), …
    Tensor diff(const std::vector<Tensor>& arguments) {
        if (arguments.size() < 2)
            throw AlgebraError("diff needs what it differentiates by: diff(u, x), diff(u, x, 2)");
        Tensor result = arguments.front();
        for (std::size_t i = 1; i < arguments.size(); ++i) {
            const auto coordinate = coordinate_of(arguments[i]);
            if (!coordinate)
                throw AlgebraError("argument " + std::to_string(i + 1) +
                                   " of diff is no coordinate; it differentiates by x, y, z or t, "
                                   "each followed by a number of times or not: diff(u, x, 2, t)");
            for (int times = count_at(arguments, i); times > 0; --times)
                result = derivative(result, *coordinate);
        }
        return result;
    }

    /// The number behind a coordinate, which is passed over; 1 where there is none.
    static int count_at(const std::vector<Tensor>& arguments, std::size_t& i) {
        if (i + 1 == arguments.size() || !arguments[i + 1].is_scalar() ||
            !GiNaC::is_a<GiNaC::numeric>(arguments[i + 1].entries.front()))
            return 1;
        const auto& count = GiNaC::ex_to<GiNaC::numeric>(arguments[++i].entries.front());
        if (!count.is_pos_integer() || count > most_derivatives)
            throw AlgebraError("argument " + std::to_string(i + 1) +
                               " of diff is how many times; it must be 1 to " +
                               std::to_string(most_derivatives));
        return count.to_int();
    }

    Tensor grad(const Tensor& a) {
        if (a.rank == Tensor::Rank::matrix)
            throw AlgebraError("grad is of a scalar or a vector; this is " + shape_text(a));
        Tensor result = Tensor::matrix(a.rows, dimension_);
        for (std::size_t i = 0; i < a.rows; ++i)
            for (std::size_t j = 0; j < dimension_; ++j)
                result.at(i, j) = fields_.derivative(a.entries[i], j);
        return a.is_scalar() ? Tensor::vector(result.entries) : result;
    }

    Tensor div(const Tensor& a) {
        const std::size_t size = a.rank == Tensor::Rank::matrix ? a.columns : a.rows;
        if (a.is_scalar() ? dimension_ != 1 : size != dimension_)
            throw AlgebraError("div of " + shape_text(a) + " has no meaning in " +
                               std::to_string(dimension_) +
                               " dimensions; it needs a component for each coordinate (the key "
                               "dimension says how many there are)");
        const std::size_t rows = a.rank == Tensor::Rank::matrix ? a.rows : 1;
        GiNaC::exvector result(rows, ex(0));
        for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t j = 0; j < dimension_; ++j)
                result[i] =
                    checked_sum(result[i], fields_.derivative(a.entries[i * dimension_ + j], j));
        return a.rank == Tensor::Rank::matrix ? Tensor::vector(result)
                                              : Tensor::scalar(result.front());
    }

    Tensor laplace(const Tensor& a) {
        Tensor result = tensor_product(Tensor::scalar(0), a);
        for (std::size_t j = 0; j < dimension_; ++j)
            result = tensor_sum(result, derivative(derivative(a, j), j));
        return result;
    }

    Tensor curl(const Tensor& a) {
        const auto d = [&](std::size_t component, std::size_t by) {
            return fields_.derivative(a.entries[component], by);
        };
        if (dimension_ == 2 && a.is_scalar())
            return Tensor::vector({d(0, 1), -d(0, 0)});
        if (dimension_ == 2 && a.rank == Tensor::Rank::vector && a.rows == 2)
            return Tensor::scalar(checked_difference(d(1, 0), d(0, 1)));
        if (dimension_ != 3 || a.rank != Tensor::Rank::vector || a.rows != 3)
            throw AlgebraError("curl of " + shape_text(a) + " has no meaning in " +
                               std::to_string(dimension_) +
                               " dimensions; it is of a vector of 3 in space, and of a vector of 2 "
                               "or a scalar in the plane");
        return Tensor::vector({checked_difference(d(2, 1), d(1, 2)),
                               checked_difference(d(0, 2), d(2, 0)),
                               checked_difference(d(1, 0), d(0, 1))});
    }

    const TensorTable& names_;
    Fields& fields_;
    std::size_t dimension_;
    const GiNaC::exmap& parameters_;
};

} // namespace

Tensor parse_tensor(const SourceText& source, const TensorTable& names, Fields& fields,
                    int dimension, const GiNaC::exmap& parameters) {
    EquationLanguage language(names, fields, dimension, parameters);
    return Grammar<EquationLanguage>(source, language).whole();
}

} // namespace tvbeam

#pragma once

#include "mms/equations/fields.hpp"

#include <ginac/ginac.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// Expressions as one list of operations, in which what is common stands once: what is evaluated,
/// examined, and written as code. Made by program_of.
class Program {
public:
    enum class Operation : std::uint8_t {
        number,
        name,
        add,
        subtract,
        multiply,
        divide,
        power,
        negate,
        square_root,
        function,
    };

    struct Step {
        Operation operation = Operation::number;
        int left = -1; ///< steps before this one; −1: none
        int right = -1;
        double numerator = 0.0; ///< of a number, ≥ 0
        double denominator = 1.0;
        std::string text = {};  ///< of a name; of a function
        std::string field = {}; ///< the field whose value this is: u_x; empty: of none
    };

    [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
    [[nodiscard]] const std::vector<int>& outputs() const { return outputs_; }
    [[nodiscard]] bool uses(const std::string& name) const;
    /// Gives names others.
    void rename(const std::function<std::string(const std::string&)>& other);

    /// The values of all steps with these of the names, pi among them. Real: a floating-point type,
    /// or one that has its operations.
    template <typename Real>
    [[nodiscard]] std::vector<Real> values(const std::map<std::string, Real>& names) const;

    /// Those of the expressions.
    template <typename Real>
    [[nodiscard]] std::vector<Real> evaluate(const std::map<std::string, Real>& names) const {
        const std::vector<Real> all = values(names);
        std::vector<Real> result;
        for (const int output : outputs_)
            result.push_back(all[static_cast<std::size_t>(output)]);
        return result;
    }

private:
    friend class ProgramBuilder;
    std::vector<Step> steps_;
    std::vector<int> outputs_;
};

/// The program of expressions in names and fields, these with their exact values put in. Throws
/// AlgebraError where a number in it is out of the range of doubles.
Program program_of(const std::vector<GiNaC::ex>& expressions, const Fields& fields);

/// a^b; of types without pow as exp(b log a).
template <typename Real>
Real raised(const Real& a, const Real& b) {
    using std::pow;
    if constexpr (requires { pow(a, b); })
        return pow(a, b);
    else
        return exp(b * log(a));
}

template <typename Real>
Real function_of(const std::string& name, const Real& a) {
    using std::acos, std::asin, std::atan, std::cos, std::cosh, std::exp, std::log, std::sin,
        std::sinh, std::tan, std::tanh;
    if (name == "sin")
        return sin(a);
    if (name == "cos")
        return cos(a);
    if (name == "tan")
        return tan(a);
    if (name == "asin")
        return asin(a);
    if (name == "acos")
        return acos(a);
    if (name == "atan")
        return atan(a);
    if (name == "sinh")
        return sinh(a);
    if (name == "cosh")
        return cosh(a);
    if (name == "tanh")
        return tanh(a);
    if (name == "exp")
        return exp(a);
    return log(a);
}

template <typename Real>
std::vector<Real> Program::values(const std::map<std::string, Real>& names) const {
    using std::sqrt;
    std::vector<Real> result;
    result.reserve(steps_.size());
    const auto at = [&](int step) -> const Real& { return result[static_cast<std::size_t>(step)]; };
    const auto value = [&](const Step& step) -> Real {
        switch (step.operation) {
        case Operation::number:
            return Real(step.numerator) / Real(step.denominator);
        case Operation::name:
            return names.at(step.text);
        case Operation::add:
            return at(step.left) + at(step.right);
        case Operation::subtract:
            return at(step.left) - at(step.right);
        case Operation::multiply:
            return at(step.left) * at(step.right);
        case Operation::divide:
            return at(step.left) / at(step.right);
        case Operation::power:
            return raised(at(step.left), at(step.right));
        case Operation::negate:
            return -at(step.left);
        case Operation::square_root:
            return sqrt(at(step.left));
        case Operation::function:
            break;
        }
        return function_of(step.text, at(step.left));
    };
    for (const Step& step : steps_)
        result.push_back(value(step));
    return result;
}

} // namespace tvbeam

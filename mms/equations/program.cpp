#include "mms/equations/program.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/balanced.hpp"
#include "mms/expression/canonical.hpp"
#include "mms/expression/numeric_value.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::numeric;
using Kind = CanonicalNode::Kind;

namespace {

constexpr int longest_repeated_product = 100;
constexpr int bits_of_a_double = 53;

} // namespace

/// Each operation is made once for the same operands, so that equal parts become one step.
class ProgramBuilder {
public:
    explicit ProgramBuilder(const Fields& fields) : fields_(fields) {}

    Program program(const std::vector<ex>& expressions) {
        std::vector<int> outputs;
        outputs.reserve(expressions.size());
        for (const ex& expression : expressions)
            outputs.push_back(value_of(*canonical(balanced(without_constants(expression)))));
        return only_needed(outputs);
    }

private:
    using Operation = Program::Operation;
    using Step = Program::Step;

    /// Fields that are numbers put in, so that nothing is added that is 0.
    [[nodiscard]] ex without_constants(const ex& expression) const {
        GiNaC::exmap values;
        for (const EquationField* field : fields_.occurring_in(expression))
            if (GiNaC::is_a<numeric>(field->exact))
                values[field->symbol] = field->exact;
        return values.empty() ? expression : substituted(expression, values);
    }

    int value_of(const CanonicalNode& node) {
        const auto known = by_key_.find(node.key);
        if (known != by_key_.end()) {
            if (node.kind != Kind::Name)
                steps_[static_cast<std::size_t>(known->second)].field.clear();
            return known->second;
        }
        const int value = new_value_of(node);
        by_key_.emplace(node.key, value);
        return value;
    }

    int new_value_of(const CanonicalNode& node) {
        switch (node.kind) {
        case Kind::Number:
            return number(node.coefficient);
        case Kind::Name:
            return named(node.name);
        case Kind::Sum:
            return sum(node);
        case Kind::Product:
            return product(node);
        case Kind::Power:
            return power(*node.operands[0], *node.operands[1]);
        case Kind::Function:
            break;
        }
        return step(Operation::function, value_of(*node.operands[0]), -1, node.name);
    }

    int step(Operation operation, int left, int right = -1, const std::string& text = {}) {
        const bool commutes = operation == Operation::add || operation == Operation::multiply;
        const auto key = std::tuple(operation, commutes ? std::min(left, right) : left,
                                    commutes ? std::max(left, right) : right, text);
        const auto [entry, is_new] = by_operation_.try_emplace(key, int(steps_.size()));
        if (is_new)
            steps_.push_back({.operation = operation, .left = left, .right = right, .text = text});
        else
            steps_[static_cast<std::size_t>(entry->second)].field.clear();
        return entry->second;
    }

    int named(const std::string& name) {
        if (const EquationField* field = fields_.find(name)) {
            // What was there before, or is met again as something else, is not called after it.
            const std::size_t before = steps_.size();
            const int value = value_of(*canonical(balanced(field->exact)));
            if (static_cast<std::size_t>(value) >= before)
                steps_[static_cast<std::size_t>(value)].field = name;
            return value;
        }
        return step(Operation::name, -1, -1, name);
    }

    int number(const numeric& value) {
        if (value.is_negative())
            return step(Operation::negate, number(-value));
        const double nearest = nearest_double(value);
        const auto [entry, is_new] = by_number_.try_emplace(number_text(value), int(steps_.size()));
        if (!is_new)
            return entry->second;
        // A decimal stands for itself; 1/3 is a quotient, where doubles hold both of its sides.
        const bool decimal = exact_rational(nearest).is_equal(value);
        const bool quotient = !decimal && value.is_rational() &&
                              value.numer().int_length() < bits_of_a_double &&
                              value.denom().int_length() < bits_of_a_double;
        Step one{.operation = Operation::number, .numerator = nearest};
        if (quotient) {
            one.numerator = value.numer().to_double();
            one.denominator = value.denom().to_double();
        }
        steps_.push_back(one);
        return entry->second;
    }

    /// Of −a the a, and the sign is changed: it goes to the sum or product that this is part of.
    int without_sign(int value, bool& negative) const {
        const Step& one = steps_[static_cast<std::size_t>(value)];
        if (one.operation != Operation::negate)
            return value;
        negative = !negative;
        return one.left;
    }

    int sum(const CanonicalNode& node) {
        std::optional<int> total;
        std::vector<int> subtracted;
        for (const Canonical& term : node.operands) {
            bool negative = term->coefficient.is_negative();
            const int value = without_sign(
                negative ? value_of(*with_coefficient(*term, -term->coefficient)) : value_of(*term),
                negative);
            if (negative)
                subtracted.push_back(value);
            else
                total = total ? step(Operation::add, *total, value) : value;
        }
        const bool positive = total.has_value();
        for (const int value : subtracted)
            total = total ? step(positive ? Operation::subtract : Operation::add, *total, value)
                          : value;
        return positive ? *total : step(Operation::negate, *total);
    }

    /// Numerator over denominator; a coefficient 1/q gives q to the latter.
    int product(const CanonicalNode& node) {
        std::optional<int> above;
        std::optional<int> below;
        bool negative = node.coefficient.is_negative();
        const auto multiply = [&](std::optional<int>& target, int value) {
            const int factor = without_sign(value, negative);
            target = target ? step(Operation::multiply, *target, factor) : factor;
        };
        const numeric coefficient = GiNaC::abs(node.coefficient);
        const bool divides_alone = coefficient.is_rational() && !coefficient.is_integer() &&
                                   coefficient.numer().is_equal(1);
        if (divides_alone)
            below = number(coefficient.denom());
        else if (!coefficient.is_equal(1))
            above = number(coefficient);
        for (const Canonical& factor : node.operands) {
            const bool divides = factor->kind == Kind::Power &&
                                 factor->operands[1]->kind == Kind::Number &&
                                 factor->operands[1]->coefficient.is_negative();
            if (divides)
                multiply(below, power_of(*factor->operands[0], -factor->operands[1]->coefficient));
            else
                multiply(above, value_of(*factor));
        }
        const int numerator = above ? *above : number(1);
        const int result = below ? step(Operation::divide, numerator, *below) : numerator;
        return negative ? step(Operation::negate, result) : result;
    }

    int power(const CanonicalNode& base, const CanonicalNode& exponent) {
        if (exponent.kind == Kind::Number)
            return power_of(base, exponent.coefficient);
        return step(Operation::power, value_of(base), value_of(exponent));
    }

    int power_of(const CanonicalNode& base, const numeric& exponent) {
        if (exponent.is_negative())
            return step(Operation::divide, number(1), power_of(base, -exponent));
        const numeric twice = exponent * 2;
        if (exponent.is_integer() && exponent <= longest_repeated_product)
            return repeated(value_of(base), exponent.to_int());
        if (twice.is_integer() && twice <= longest_repeated_product)
            return repeated(step(Operation::square_root, value_of(base)), twice.to_int());
        return step(Operation::power, value_of(base), number(exponent));
    }

    int repeated(int base, int exponent) {
        if (exponent == 1)
            return base;
        const int half = repeated(base, exponent / 2);
        const int square = step(Operation::multiply, half, half);
        return exponent % 2 == 0 ? square : step(Operation::multiply, square, base);
    }

    [[nodiscard]] Program only_needed(const std::vector<int>& outputs) const {
        std::vector<bool> needed(steps_.size(), false);
        for (const int output : outputs)
            needed[static_cast<std::size_t>(output)] = true;
        for (std::size_t i = steps_.size(); i-- > 0;)
            for (const int operand : {steps_[i].left, steps_[i].right})
                if (needed[i] && operand >= 0)
                    needed[static_cast<std::size_t>(operand)] = true;
        Program program;
        std::vector<int> places(steps_.size(), -1);
        const auto place = [&](int value) {
            return value < 0 ? -1 : places[static_cast<std::size_t>(value)];
        };
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            if (!needed[i])
                continue;
            places[i] = static_cast<int>(program.steps_.size());
            program.steps_.push_back(steps_[i]);
            program.steps_.back().left = place(steps_[i].left);
            program.steps_.back().right = place(steps_[i].right);
        }
        for (const int output : outputs)
            program.outputs_.push_back(place(output));
        return program;
    }

    const Fields& fields_;
    std::vector<Step> steps_;
    std::map<std::string, int> by_key_;
    std::map<std::string, int> by_number_;
    std::map<std::tuple<Operation, int, int, std::string>, int> by_operation_;
};

bool Program::uses(const std::string& name) const {
    return std::any_of(steps_.begin(), steps_.end(), [&](const Step& step) {
        return step.operation == Operation::name && step.text == name;
    });
}

void Program::rename(const std::function<std::string(const std::string&)>& other) {
    for (Step& step : steps_)
        if (step.operation == Operation::name)
            step.text = other(step.text);
}

Program program_of(const std::vector<ex>& expressions, const Fields& fields) {
    return ProgramBuilder(fields).program(expressions);
}

} // namespace tvbeam

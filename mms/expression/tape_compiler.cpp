#include "mms/expression/tape_compiler.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/balanced.hpp"
#include "mms/expression/canonical.hpp"
#include "mms/expression/magnitude.hpp"
#include "mms/expression/numeric_value.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::numeric;
using Kind = CanonicalNode::Kind;

namespace {

constexpr int largest_multiplied_power = 1000;

/// The long double nearest to a rational, or one beside it.
long double nearest_long_double(const numeric& rational) {
    // A quotient of 80 to 82 bits, in three parts of 30 that doubles hold exactly.
    const int shift = 81 - (rational.numer().int_length() - rational.denom().int_length());
    const auto shifted = [](const numeric& value, int bits) {
        return bits > 0 ? value * GiNaC::pow(numeric(2), numeric(bits)) : value;
    };
    numeric quotient = GiNaC::iquo(GiNaC::abs(shifted(rational.numer(), shift)),
                                   shifted(rational.denom(), -shift));
    const numeric part = GiNaC::pow(numeric(2), numeric(30));
    long double value = 0.0L;
    long double weight = 1.0L;
    for (int i = 0; i < 3; ++i) {
        value += weight * GiNaC::irem(quotient, part).to_double();
        quotient = GiNaC::iquo(quotient, part);
        weight *= 0x1p30L;
    }
    return std::ldexp(rational.is_negative() ? -value : value, -shift);
}

} // namespace

/// Builds a tape in two passes: expressions become values, each defined once; then values get
/// registers.
class TapeCompiler {
public:
    TapeCompiler() {
        values_.resize(2);
        values_[0].needs_x = true;
        values_[1].needs_t = true;
    }

    Tape compile(const std::vector<ex>& expressions) {
        std::vector<Sized> nodes;
        std::vector<int> outputs;
        nodes.reserve(expressions.size());
        outputs.reserve(expressions.size());
        for (const ex& expression : expressions) {
            const Canonical node = canonical(expression);
            nodes.push_back(roomy(has_quotient(*node) ? canonical(balanced(expression)) : node));
        }
        choose_width(nodes);
        for (const Sized& sized : nodes)
            outputs.push_back(value_of(*sized.node));
        return allocate(outputs);
    }

    double constant(const ex& expression) {
        const Sized sized = roomy(canonical(expression));
        choose_width({sized});
        const auto& value = values_[index(value_of(*sized.node))].constant;
        if (!value)
            throw AlgebraError("it is not a number");
        const auto result = static_cast<double>(*value);
        if (!std::isfinite(result))
            throw AlgebraError("it is not a finite number in double precision");
        return result;
    }

private:
    using Operation = Tape::Operation;

    struct Value {
        std::optional<long double> constant;
        Operation operation = Operation::Add;
        int left = -1; ///< −1 for x, t and constants
        int right = -1;
        bool needs_x = false;
        bool needs_t = false;

        [[nodiscard]] bool needs_both() const { return needs_x && needs_t; }
    };

    static std::size_t index(int value) { return static_cast<std::size_t>(value); }

    struct Sized {
        Canonical node;
        Magnitude size;
    };

    /// The same with its sums rescaled if doubles have no room for them.
    static Sized roomy(const Canonical& node) {
        const Magnitude size = magnitude(*node);
        if (fits_doubles(size))
            return {node, size};
        const Canonical changed = rescaled(node);
        return {changed, magnitude(*changed)};
    }

    static bool has_quotient(const CanonicalNode& node) {
        if (node.kind == Kind::Power && node.operands[1]->coefficient.is_negative())
            return true;
        return std::any_of(node.operands.begin(), node.operands.end(),
                           [](const Canonical& operand) { return has_quotient(*operand); });
    }

    /// Long double is for what has a size within the range of doubles but parts that may leave it.
    void choose_width(const std::vector<Sized>& nodes) {
        constexpr double range = 1020.0;
        bool fits = true;
        bool representable = true;
        for (const auto& [node, size] : nodes) {
            fits = fits && fits_doubles(size);
            representable = representable && size.whole <= range;
        }
        wide_ = !fits && representable;
    }

    // First pass.

    int value_of(const CanonicalNode& node) {
        const auto known = by_key_.find(node.key);
        if (known != by_key_.end())
            return known->second;
        const int value = new_value_of(node);
        by_key_.emplace(node.key, value);
        return value;
    }

    int new_value_of(const CanonicalNode& node) {
        switch (node.kind) {
        case Kind::Number:
            return rational_value(node.coefficient);
        case Kind::Name:
            return named(node.name);
        case Kind::Sum:
            return sum(node);
        case Kind::Product:
            return product(node, node.coefficient);
        case Kind::Power:
            return power(*node.operands[0], *node.operands[1]);
        case Kind::Function:
            return function(node);
        }
        return 0;
    }

    int named(const std::string& name) {
        if (name == "x")
            return 0;
        if (name == "t")
            return 1;
        if (name == "pi")
            return constant_value(wide_ ? std::numbers::pi_v<long double> : std::numbers::pi);
        throw AlgebraError("'" + name + "' has no value");
    }

    int rational_value(const numeric& value) {
        return constant_value(wide_ ? nearest_long_double(value) : nearest_double(value));
    }

    int constant_value(long double value) {
        if (!std::isfinite(wide_ ? value : static_cast<double>(value)))
            throw AlgebraError("a constant in it is not a finite number in double precision");
        const auto [entry, is_new] = by_constant_.try_emplace(value, int(values_.size()));
        if (is_new)
            values_.emplace_back().constant = value;
        return entry->second;
    }

    int apply(Operation operation, int left, int right = -1) {
        const Value& a = values_[index(left)];
        const Value& b = values_[index(right < 0 ? left : right)];
        if (a.constant && b.constant)
            return constant_value(wide_ ? Tape::apply(operation, *a.constant, *b.constant)
                                        : Tape::apply(operation, static_cast<double>(*a.constant),
                                                      static_cast<double>(*b.constant)));
        const bool commutes = operation == Operation::Add || operation == Operation::Multiply;
        if (commutes && right < left)
            std::swap(left, right);
        const bool needs_x = a.needs_x || b.needs_x;
        const bool needs_t = a.needs_t || b.needs_t;
        const auto [entry, is_new] =
            by_operation_.try_emplace({operation, left, right}, int(values_.size()));
        if (is_new)
            values_.push_back({std::nullopt, operation, left, right, needs_x, needs_t});
        return entry->second;
    }

    /// A sum, with terms of negative coefficient subtracted.
    int sum(const CanonicalNode& node) {
        std::optional<int> total;
        std::vector<int> subtracted;
        for (const Canonical& term : node.operands) {
            if (term->coefficient.is_negative()) {
                subtracted.push_back(value_of(*with_coefficient(*term, -term->coefficient)));
                continue;
            }
            const int value = value_of(*term);
            total = total ? apply(Operation::Add, *total, value) : value;
        }
        for (const int value : subtracted)
            total =
                total ? apply(Operation::Subtract, *total, value) : apply(Operation::Negate, value);
        return *total;
    }

    /// A product: what is constant comes first, so that it folds, then what depends on t, so that
    /// it is computed once for many x; negative powers are divided by in the end.
    int product(const CanonicalNode& node, const numeric& coefficient) {
        std::optional<int> above;
        std::optional<int> below;
        const auto multiply = [this](std::optional<int>& target, int value) {
            target = target ? apply(Operation::Multiply, *target, value) : value;
        };
        const bool negated = coefficient.is_equal(-1);
        if (!negated && !coefficient.is_equal(1))
            above = rational_value(coefficient);
        std::vector<Canonical> factors = node.operands;
        while (const auto value = power_with_logarithm(factors))
            multiply(above, *value);
        for (const Canonical& factor : factors) {
            const bool divides = factor->kind == Kind::Power &&
                                 factor->operands[1]->kind == Kind::Number &&
                                 factor->operands[1]->coefficient.is_negative();
            if (divides)
                multiply(below, power_of(*factor->operands[0], -factor->operands[1]->coefficient));
            else
                multiply(above, value_of(*factor));
        }
        int result = 0;
        if (above && below)
            result = apply(Operation::Divide, *above, *below);
        else
            result = above ? *above : apply(Operation::Reciprocal, *below);
        return negated ? apply(Operation::Negate, result) : result;
    }

    /// Takes a pair b^a, log(b) out of the factors of a product, if there is one, and gives its
    /// value: at b = 0 it is 0 times infinity, and 0 for a > 0.
    std::optional<int> power_with_logarithm(std::vector<Canonical>& factors) {
        for (std::size_t i = 0; i < factors.size(); ++i) {
            if (factors[i]->kind != Kind::Function || factors[i]->name != "log")
                continue;
            const Canonical base = factors[i]->operands[0];
            for (std::size_t k = 0; k < factors.size(); ++k) {
                const Canonical power = factors[k];
                const bool bare = power->key == base->key;
                if (!bare && (power->kind != Kind::Power || power->operands[0]->key != base->key))
                    continue;
                const int exponent = bare ? constant_value(1.0L) : value_of(*power->operands[1]);
                factors.erase(factors.begin() + static_cast<std::ptrdiff_t>(std::max(i, k)));
                factors.erase(factors.begin() + static_cast<std::ptrdiff_t>(std::min(i, k)));
                return apply(Operation::PowerLog, value_of(*base), exponent);
            }
        }
        return std::nullopt;
    }

    int power(const CanonicalNode& base, const CanonicalNode& exponent) {
        if (exponent.kind == Kind::Number)
            return power_of(base, exponent.coefficient);
        return apply(Operation::Power, value_of(base), value_of(exponent));
    }

    int power_of(const CanonicalNode& base, const numeric& exponent) {
        if (exponent.is_negative())
            return apply(Operation::Reciprocal, power_of(base, -exponent));
        const numeric twice = exponent * 2;
        if (exponent.is_integer() && exponent <= largest_multiplied_power)
            return integer_power(value_of(base), exponent.to_int());
        if (twice.is_integer() && twice <= largest_multiplied_power)
            return integer_power(apply(Operation::SquareRoot, value_of(base)), twice.to_int());
        return apply(Operation::Power, value_of(base), rational_value(exponent));
    }

    int integer_power(int base, int exponent) {
        if (exponent == 1)
            return base;
        const int half = apply(Operation::Square, integer_power(base, exponent / 2));
        return exponent % 2 == 0 ? half : apply(Operation::Multiply, half, base);
    }

    int function(const CanonicalNode& node) {
        static const std::map<std::string, Operation> operations = {
            {"sin", Operation::Sin},   {"cos", Operation::Cos},   {"tan", Operation::Tan},
            {"asin", Operation::Asin}, {"acos", Operation::Acos}, {"atan", Operation::Atan},
            {"sinh", Operation::Sinh}, {"cosh", Operation::Cosh}, {"tanh", Operation::Tanh},
            {"exp", Operation::Exp},   {"log", Operation::Log},   {"step", Operation::Step}};
        const auto found = operations.find(node.name);
        if (found == operations.end())
            throw AlgebraError("the function " + node.name + " cannot be evaluated");
        return apply(found->second, value_of(*node.operands[0]));
    }

    // Second pass.

    [[nodiscard]] std::vector<bool> needed_for(const std::vector<int>& outputs) const {
        std::vector<bool> needed(values_.size(), false);
        for (const int output : outputs)
            needed[index(output)] = true;
        // Operands are defined before the values that use them.
        for (std::size_t i = values_.size(); i-- > 0;) {
            if (!needed[i])
                continue;
            for (const int operand : {values_[i].left, values_[i].right})
                if (operand >= 0)
                    needed[index(operand)] = true;
        }
        return needed;
    }

    /// The operations in an order in which their operands come first, those of t alone and then
    /// those of x alone before all others, and when each value is read.
    struct Schedule {
        std::vector<int> order;
        std::vector<std::size_t> last_use; ///< place in the order; its size: an output
        std::vector<bool> read_with_both;  ///< by an operation of both x and t

        [[nodiscard]] bool is_output(std::size_t value) const {
            return last_use[value] == order.size();
        }
    };

    [[nodiscard]] Schedule schedule(const std::vector<bool>& needed,
                                    const std::vector<int>& outputs) const {
        Schedule result{{},
                        std::vector<std::size_t>(values_.size(), 0),
                        std::vector<bool>(values_.size(), false)};
        const auto group = [](const Value& value) {
            return value.needs_both() ? 2 : value.needs_x ? 1 : 0;
        };
        for (const int wanted : {0, 1, 2})
            for (std::size_t i = 2; i < values_.size(); ++i)
                if (needed[i] && !values_[i].constant && group(values_[i]) == wanted)
                    result.order.push_back(static_cast<int>(i));
        for (std::size_t at = 0; at < result.order.size(); ++at) {
            const Value& value = values_[index(result.order[at])];
            for (const int operand : {value.left, value.right}) {
                if (operand < 0)
                    continue;
                result.last_use[index(operand)] = at;
                if (value.needs_both())
                    result.read_with_both[index(operand)] = true;
            }
        }
        for (const int output : outputs)
            result.last_use[index(output)] = result.order.size();
        return result;
    }

    /// Whether a value is of t or of x alone and read after the operations of that one: its
    /// register is then its own to the end, as a constant's is.
    [[nodiscard]] bool persists(std::size_t value, const Schedule& when) const {
        return !values_[value].needs_both() &&
               (when.read_with_both[value] || when.is_output(value));
    }

    [[nodiscard]] Tape allocate(const std::vector<int>& outputs) const {
        const std::vector<bool> needed = needed_for(outputs);
        const Schedule when = schedule(needed, outputs);
        Tape tape;
        tape.wide_ = wide_;
        std::vector<int> registers(values_.size(), -1);
        registers[0] = 0;
        registers[1] = 1;
        for (std::size_t i = 2; i < values_.size(); ++i)
            if (needed[i] && values_[i].constant) {
                registers[i] = tape.register_count_++;
                tape.constants_.push_back({registers[i], *values_[i].constant});
            }
        std::vector<int> free;
        for (std::size_t at = 0; at < when.order.size(); ++at) {
            const std::size_t target = index(when.order[at]);
            const Value& value = values_[target];
            const auto release = [&](int operand) {
                const bool releasable = operand >= 2 && !values_[index(operand)].constant &&
                                        !persists(index(operand), when) &&
                                        when.last_use[index(operand)] == at;
                if (releasable)
                    free.push_back(registers[index(operand)]);
            };
            release(value.left);
            if (value.right != value.left)
                release(value.right);
            if (free.empty())
                free.push_back(tape.register_count_++);
            registers[target] = free.back();
            free.pop_back();
            tape.instructions_.push_back({value.operation, registers[target],
                                          registers[index(value.left)],
                                          value.right < 0 ? -1 : registers[index(value.right)]});
            if (!value.needs_x)
                ++tape.time_only_count_;
            else if (!value.needs_t)
                ++tape.place_only_count_;
        }
        for (std::size_t i = 0; i < values_.size(); ++i)
            if (registers[i] >= 0 && !values_[i].constant && persists(i, when))
                (values_[i].needs_x ? tape.of_place_ : tape.of_time_).push_back(registers[i]);
        for (const int output : outputs)
            tape.outputs_.push_back(registers[index(output)]);
        return tape;
    }

    bool wide_ = false;
    std::vector<Value> values_; ///< values 0 and 1 are x and t
    std::map<std::string, int> by_key_;
    std::map<long double, int> by_constant_;
    std::map<std::tuple<Operation, int, int>, int> by_operation_;
};

Tape compile_tape(const std::vector<ex>& expressions) {
    return TapeCompiler().compile(expressions);
}

double numeric_value(const ex& constant) {
    return TapeCompiler().constant(constant);
}

double nearest_double(const numeric& rational) {
    const double value = rational.to_double();
    if (!std::isfinite(value))
        throw AlgebraError("a number in it is beyond the range of double precision");
    return value;
}

} // namespace tvbeam

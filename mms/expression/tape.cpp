#include "mms/expression/tape.hpp"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace tvbeam {

namespace {

/// Points evaluated at a time: a few dozen registers of this length stay in the first-level cache.
constexpr Eigen::Index block_size = 128;

template <typename Real, typename Function>
void each(const Real* left, Real* target, Eigen::Index size, const Function& function) {
    for (Eigen::Index i = 0; i < size; ++i)
        target[i] = function(left[i]);
}

/// Whether something was too large or too small for its type since this was last asked.
bool left_range() {
    constexpr int left = FE_OVERFLOW | FE_DIVBYZERO | FE_UNDERFLOW;
    const bool result = std::fetestexcept(left) != 0;
    if (result)
        std::feclearexcept(left);
    return result;
}

/// An exponential underflows at most points of a layer, where its being zero means nothing: it is
/// not counted, or all of them would be computed in long double.
template <typename Run>
void run_exponential(const Run& run) {
    const bool before = std::fetestexcept(FE_UNDERFLOW) != 0;
    run();
    if (!before && std::fetestexcept(FE_UNDERFLOW) != 0)
        std::feclearexcept(FE_UNDERFLOW);
}

} // namespace

template <typename Real>
Real Tape::apply(Operation operation, Real left, Real right) {
    Registers<Real> registers(1, 3);
    registers << left, right, Real(0);
    run({operation, 2, 0, 1}, registers, 1);
    return registers(0, 2);
}

template double Tape::apply(Operation, double, double);
template long double Tape::apply(Operation, long double, long double);

// The functions are the standard library's, point by point: vectorised ones round differently in
// the last, incomplete packet, so that a value would depend on its place in the array. Long, since
// it is a table with one row an operation.
template <typename Real>
void Tape::run(const Instruction& instruction, Registers<Real>& registers, Eigen::Index size) {
    const Real* a = registers.col(instruction.left).data();
    const Real* b = instruction.right < 0 ? a : registers.col(instruction.right).data();
    Real* c = registers.col(instruction.target).data();
    switch (instruction.operation) {
    case Operation::Add:
        for (Eigen::Index i = 0; i < size; ++i)
            c[i] = a[i] + b[i];
        return;
    case Operation::Subtract:
        for (Eigen::Index i = 0; i < size; ++i)
            c[i] = a[i] - b[i];
        return;
    case Operation::Multiply:
        for (Eigen::Index i = 0; i < size; ++i)
            c[i] = a[i] * b[i];
        return;
    case Operation::Divide:
        for (Eigen::Index i = 0; i < size; ++i)
            c[i] = a[i] / b[i];
        return;
    case Operation::Power:
        for (Eigen::Index i = 0; i < size; ++i)
            c[i] = std::pow(a[i], b[i]);
        return;
    case Operation::PowerLog:
        // Where the power goes to zero, the product does.
        for (Eigen::Index i = 0; i < size; ++i)
            c[i] =
                a[i] == Real(0) && b[i] > Real(0) ? Real(0) : std::pow(a[i], b[i]) * std::log(a[i]);
        return;
    case Operation::Negate:
        return each(a, c, size, [](Real v) { return -v; });
    case Operation::Reciprocal:
        return each(a, c, size, [](Real v) { return Real(1) / v; });
    case Operation::Square:
        return each(a, c, size, [](Real v) { return v * v; });
    case Operation::SquareRoot:
        return each(a, c, size, [](Real v) { return std::sqrt(v); });
    case Operation::Sin:
        return each(a, c, size, [](Real v) { return std::sin(v); });
    case Operation::Cos:
        return each(a, c, size, [](Real v) { return std::cos(v); });
    case Operation::Tan:
        return each(a, c, size, [](Real v) { return std::tan(v); });
    case Operation::Asin:
        return each(a, c, size, [](Real v) { return std::asin(v); });
    case Operation::Acos:
        return each(a, c, size, [](Real v) { return std::acos(v); });
    case Operation::Atan:
        return each(a, c, size, [](Real v) { return std::atan(v); });
    case Operation::Sinh:
        return each(a, c, size, [](Real v) { return std::sinh(v); });
    case Operation::Cosh:
        return each(a, c, size, [](Real v) { return std::cosh(v); });
    case Operation::Tanh:
        return each(a, c, size, [](Real v) { return std::tanh(v); });
    case Operation::Exp:
        return run_exponential([&] { each(a, c, size, [](Real v) { return std::exp(v); }); });
    case Operation::Log:
        return each(a, c, size, [](Real v) { return std::log(v); });
    case Operation::Step: // as GiNaC's: 1/2 at 0
        return each(a, c, size, [](Real v) {
            return v > Real(0) ? Real(1) : v < Real(0) ? Real(0) : v + Real(0.5);
        });
    }
}

namespace {

/// One x or one t at no points gives no values.
Eigen::Index points_of(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t) {
    if (x.size() != t.size() && x.size() != 1 && t.size() != 1)
        throw std::invalid_argument(
            "Tape::evaluate: x and t must have one size, or one of them size 1");
    return std::min(x.size(), t.size()) == 0 ? 0 : std::max(x.size(), t.size());
}

} // namespace

Eigen::ArrayXXd Tape::evaluate_wide(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t) const {
    Eigen::ArrayXXd values(output_count(), points_of(x, t));
    if (values.cols() > 0)
        evaluate_in<long double>(x, t, values);
    return values;
}

Eigen::ArrayXXd Tape::evaluate(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t) const {
    const Eigen::Index points = points_of(x, t);
    Eigen::ArrayXXd values(output_count(), points);
    if (points > 0 && wide_)
        evaluate_in<long double>(x, t, values);
    else if (points > 0) {
        left_range();
        evaluate_in<double>(x, t, values);
        if (left_range())
            repeat_what_left_range(x, t, values);
    }
    return values;
}

// By halves down to the points that did, so that the others stay as they are wherever they stand
// in the array.
void Tape::repeat_what_left_range(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t,
                                  Eigen::Ref<Eigen::ArrayXXd> values) const {
    const Eigen::Index points = values.cols();
    const auto part = [](const Eigen::ArrayXd& all, Eigen::Index begin, Eigen::Index size) {
        return all.size() == 1 ? all : Eigen::ArrayXd(all.segment(begin, size));
    };
    if (points == 1) {
        Eigen::ArrayXXd value(output_count(), 1);
        evaluate_in<long double>(part(x, 0, 1), part(t, 0, 1), value);
        left_range();
        values = value;
        return;
    }
    const Eigen::Index half = points / 2;
    for (const auto& [begin, size] : {std::pair{Eigen::Index{0}, half}, {half, points - half}}) {
        const Eigen::ArrayXd at_x = part(x, begin, size);
        const Eigen::ArrayXd at_t = part(t, begin, size);
        Eigen::ArrayXXd again(output_count(), size);
        evaluate_in<double>(at_x, at_t, again);
        if (left_range())
            repeat_what_left_range(at_x, at_t, values.middleCols(begin, size));
    }
}

template <typename Real>
void Tape::evaluate_in(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t,
                       Eigen::ArrayXXd& values) const {
    const Eigen::Index points = values.cols();
    const Eigen::Index rows = std::min(points, block_size);
    Registers<Real> registers(rows, register_count_);
    for (const Constant& constant : constants_)
        registers.col(constant.target).setConstant(static_cast<Real>(constant.value));
    if (x.size() == 1)
        registers.col(0).setConstant(static_cast<Real>(x(0)));
    const bool one_time = t.size() == 1;
    if (one_time) {
        registers(0, 1) = t(0);
        for (std::size_t i = 0; i < time_only_count_; ++i)
            run(instructions_[i], registers, 1);
        for (const int persistent : persistent_)
            registers.col(persistent).setConstant(Real(registers(0, persistent)));
    }

    for (Eigen::Index begin = 0; begin < points; begin += rows) {
        const Eigen::Index size = std::min(rows, points - begin);
        if (x.size() > 1)
            registers.col(0).head(size) = x.segment(begin, size).cast<Real>();
        if (!one_time)
            registers.col(1).head(size) = t.segment(begin, size).cast<Real>();
        for (std::size_t i = one_time ? time_only_count_ : 0; i < instructions_.size(); ++i)
            run(instructions_[i], registers, size);
        if (output_count() == 1)
            std::transform(registers.col(outputs_.front()).data(),
                           registers.col(outputs_.front()).data() + size, values.data() + begin,
                           [](Real value) { return static_cast<double>(value); });
        else
            for (Eigen::Index k = 0; k < output_count(); ++k)
                values.row(k).segment(begin, size) =
                    registers.col(outputs_[static_cast<std::size_t>(k)])
                        .head(size)
                        .transpose()
                        .template cast<double>();
    }
}

Tape Tape::only(const std::vector<Eigen::Index>& outputs) const {
    Tape result;
    result.register_count_ = register_count_;
    result.wide_ = wide_;
    std::vector<bool> needed(static_cast<std::size_t>(register_count_), false);
    const auto is_needed = [&](int at) { return needed[static_cast<std::size_t>(at)]; };
    for (const Eigen::Index output : outputs) {
        result.outputs_.push_back(outputs_.at(static_cast<std::size_t>(output)));
        needed[static_cast<std::size_t>(result.outputs_.back())] = true;
    }
    // Backwards: what is read later must have been written last before.
    for (std::size_t i = instructions_.size(); i > 0; --i) {
        if (i == time_only_count_)
            std::copy_if(persistent_.begin(), persistent_.end(),
                         std::back_inserter(result.persistent_), is_needed);
        const Instruction& instruction = instructions_[i - 1];
        if (!is_needed(instruction.target))
            continue;
        needed[static_cast<std::size_t>(instruction.target)] = false;
        needed[static_cast<std::size_t>(instruction.left)] = true;
        if (instruction.right >= 0)
            needed[static_cast<std::size_t>(instruction.right)] = true;
        result.instructions_.push_back(instruction);
        result.time_only_count_ += i <= time_only_count_ ? 1 : 0;
    }
    std::reverse(result.instructions_.begin(), result.instructions_.end());
    std::copy_if(constants_.begin(), constants_.end(), std::back_inserter(result.constants_),
                 [&](const Constant& constant) { return is_needed(constant.target); });
    return result;
}

} // namespace tvbeam

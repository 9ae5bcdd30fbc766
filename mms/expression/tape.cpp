#include "mms/expression/tape.hpp"

#include <algorithm>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
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

namespace {

/// The number of places where the points are all places of a grid at one time after the other, to
/// the last bit; 0 where they are not.
Eigen::Index places_of_grid(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t) {
    if (x.size() == 1 || t.size() == 1)
        return x.size();
    const auto same = [](double one, double other) {
        return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
    };
    const auto is_first = [&](double at) { return same(at, t(0)); };
    const auto places = std::ranges::find_if_not(t, is_first) - t.begin();
    if (t.size() % places != 0)
        return 0;
    for (auto begin = places; begin < t.size(); begin += places)
        if (!std::equal(x.begin(), x.begin() + places, x.begin() + begin, same) ||
            !std::all_of(t.begin() + begin, t.begin() + begin + places,
                         [&](double at) { return same(at, t(begin)); }))
            return 0;
    return places;
}

} // namespace

template <typename Real>
auto Tape::registers_of(Eigen::Index points) const -> Registers<Real> {
    Registers<Real> registers(std::min(points, block_size), register_count_);
    for (const Constant& constant : constants_)
        registers.col(constant.target).setConstant(static_cast<Real>(constant.value));
    return registers;
}

template <typename Real>
void Tape::run_all(std::size_t begin, std::size_t end, Registers<Real>& registers,
                   Eigen::Index size) const {
    for (std::size_t i = begin; i < end; ++i)
        run(instructions_[i], registers, size);
}

/// The outputs at so many points from a register's place, in the columns from `at`.
template <typename Real>
void Tape::store(const Registers<Real>& registers, Eigen::Index from, Eigen::Index size,
                 Eigen::ArrayXXd& values, Eigen::Index at) const {
    for (Eigen::Index k = 0; k < output_count(); ++k) {
        const Real* const result =
            registers.col(outputs_[static_cast<std::size_t>(k)]).data() + from;
        double* target = values.data() + at * output_count() + k;
        for (Eigen::Index i = 0; i < size; ++i, target += output_count())
            *target = static_cast<double>(result[i]);
    }
}

template <typename Real>
void Tape::evaluate_in(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t,
                       Eigen::ArrayXXd& values) const {
    const Eigen::Index points = values.cols();
    if (const Eigen::Index places = places_of_grid(x, t); points > 1 && places > 0)
        return evaluate_on_grid<Real>(
            x.head(places), t.size() == 1 ? t : t(Eigen::seqN(0, points / places, places)), values);
    auto registers = registers_of<Real>(points);
    for (Eigen::Index begin = 0; begin < points; begin += registers.rows()) {
        const Eigen::Index size = std::min(registers.rows(), points - begin);
        registers.col(0).head(size) = x.segment(begin, size).cast<Real>();
        registers.col(1).head(size) = t.segment(begin, size).cast<Real>();
        run_all(0, instructions_.size(), registers, size);
        store(registers, 0, size, values, begin);
    }
}

// Column of the place i at the time j: j · places + i.
template <typename Real>
void Tape::evaluate_on_grid(const Eigen::ArrayXd& places, const Eigen::ArrayXd& times,
                            Eigen::ArrayXXd& values) const {
    const Eigen::Index count = times.size();
    auto registers = registers_of<Real>(values.cols());
    const Eigen::Index rows = registers.rows();
    const std::size_t of_both = time_only_count_ + place_only_count_;
    Registers<Real> at_times(count, static_cast<Eigen::Index>(of_time_.size()));
    for (Eigen::Index begin = 0; begin < count; begin += rows) {
        const Eigen::Index size = std::min(rows, count - begin);
        registers.col(1).head(size) = times.segment(begin, size).cast<Real>();
        run_all(0, time_only_count_, registers, size);
        for (std::size_t k = 0; k < of_time_.size(); ++k)
            at_times.col(static_cast<Eigen::Index>(k)).segment(begin, size) =
                registers.col(of_time_[k]).head(size);
    }
    for (Eigen::Index first = 0; first < places.size(); first += rows) {
        const Eigen::Index width = std::min(rows, places.size() - first);
        const Eigen::Index at_once = std::min(count, rows / width);
        registers.col(0).head(width) = places.segment(first, width).cast<Real>();
        run_all(time_only_count_, of_both, registers, width);
        for (const int of_place : of_place_) {
            Real* const value = registers.col(of_place).data();
            if (width == 1)
                std::fill_n(value, at_once, *value);
            else
                for (Eigen::Index j = 1; j < at_once; ++j)
                    std::copy_n(value, width, value + j * width);
        }
        for (Eigen::Index time = 0; time < count; time += at_once) {
            const Eigen::Index now = std::min(at_once, count - time);
            // Of one time they stand there since the first block, which no other is longer than.
            for (std::size_t k = 0; k < of_time_.size() && (count > 1 || first == 0); ++k) {
                const Real* const from = &at_times(time, static_cast<Eigen::Index>(k));
                Real* const value = registers.col(of_time_[k]).data();
                if (width == 1)
                    std::copy_n(from, now, value);
                else
                    for (Eigen::Index j = 0; j < now; ++j)
                        std::fill_n(value + j * width, width, from[j]);
            }
            run_all(of_both, instructions_.size(), registers, now * width);
            if (width == places.size())
                store(registers, 0, now * width, values, time * width);
            else
                for (Eigen::Index j = 0; j < now; ++j)
                    store(registers, j * width, width, values, (time + j) * places.size() + first);
        }
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
    const std::size_t of_both = time_only_count_ + place_only_count_;
    // Backwards: what is read later must have been written last before.
    for (std::size_t i = instructions_.size();; --i) {
        if (i == of_both) {
            std::ranges::copy_if(of_time_, std::back_inserter(result.of_time_), is_needed);
            std::ranges::copy_if(of_place_, std::back_inserter(result.of_place_), is_needed);
        }
        if (i == 0)
            break;
        const Instruction& instruction = instructions_[i - 1];
        if (!is_needed(instruction.target))
            continue;
        needed[static_cast<std::size_t>(instruction.target)] = false;
        needed[static_cast<std::size_t>(instruction.left)] = true;
        if (instruction.right >= 0)
            needed[static_cast<std::size_t>(instruction.right)] = true;
        result.instructions_.push_back(instruction);
        if (i <= time_only_count_)
            ++result.time_only_count_;
        else if (i <= of_both)
            ++result.place_only_count_;
    }
    std::reverse(result.instructions_.begin(), result.instructions_.end());
    std::copy_if(constants_.begin(), constants_.end(), std::back_inserter(result.constants_),
                 [&](const Constant& constant) { return is_needed(constant.target); });
    return result;
}

} // namespace tvbeam

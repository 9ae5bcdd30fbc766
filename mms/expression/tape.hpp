#pragma once

#include "mms/expression/enclosure.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace tvbeam {

/// Several expressions in x and t, compiled to one list of instructions in which common
/// subexpressions stand once. Made by compile_tape (tape_compiler.hpp). Evaluation changes nothing
/// and may run in several threads at once. Where an intermediate result could leave the range of a
/// double, as 1000^118 does, it is done in long double, and so it is at points where one does, as
/// x^-80 at x = 1e-4; the values are doubles. An exponential that underflows is zero, and with it
/// what is multiplied by it, however large.
class Tape {
public:
    /// The values of the expressions at the points (x_i, t_i); shape: one row an expression, one
    /// column a point. x and t have the same size, or one of them has size 1 and stands for every
    /// point. A value depends on its point only, not on where in the array the point stands. Where
    /// the points are a grid, all its places at one time after the other, what depends on x or on t
    /// alone is computed once for each.
    [[nodiscard]] Eigen::ArrayXXd evaluate(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t) const;

    /// The same, each operation in long double: where large terms cancel, steps of rounding are
    /// 2048 times smaller.
    [[nodiscard]] Eigen::ArrayXXd evaluate_wide(const Eigen::ArrayXd& x,
                                                const Eigen::ArrayXd& t) const;

    /// What one expression does at x while t is in [begin, end]: bounds of all its values and of
    /// all its derivatives in t, rounded outwards. They hold for the constants as they stand in the
    /// tape; where it may have no value, or a jump, there are none.
    [[nodiscard]] Enclosure enclose(Eigen::Index output, double x, double begin, double end) const;

    /// The tape of these expressions alone, with the instructions that they need. Their values are
    /// the same to the last bit, but where an intermediate result of another left the range.
    [[nodiscard]] Tape only(const std::vector<Eigen::Index>& outputs) const;

    /// Whether it is always computed in long double.
    [[nodiscard]] bool is_wide() const { return wide_; }

    [[nodiscard]] Eigen::Index output_count() const {
        return static_cast<Eigen::Index>(outputs_.size());
    }
    [[nodiscard]] std::size_t instruction_count() const { return instructions_.size(); }
    [[nodiscard]] int register_count() const { return register_count_; }

private:
    friend class TapeCompiler;
    friend class TapeEnclosure;

    enum class Operation : std::uint8_t {
        Add,
        Subtract,
        Multiply,
        Divide,
        Power,
        PowerLog, // a^b log a; of two registers, as those before
        Negate,
        Reciprocal,
        Square,
        SquareRoot, // of one
        Sin,
        Cos,
        Tan,
        Asin,
        Acos,
        Atan,
        Sinh,
        Cosh,
        Tanh,
        Exp,
        Log,
        Step,
    };

    struct Instruction {
        Operation operation;
        int target;
        int left;
        int right; ///< −1 for operations of one register
    };

    struct Constant {
        int target;
        long double value;
    };

    template <typename Real>
    using Registers = Eigen::Array<Real, Eigen::Dynamic, Eigen::Dynamic>;

    template <typename Real>
    static Real apply(Operation operation, Real left, Real right);
    template <typename Real>
    static void run(const Instruction& instruction, Registers<Real>& registers, Eigen::Index size);
    template <typename Real>
    void evaluate_in(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t,
                     Eigen::ArrayXXd& values) const;
    template <typename Real>
    void evaluate_on_grid(const Eigen::ArrayXd& places, const Eigen::ArrayXd& times,
                          Eigen::ArrayXXd& values) const;
    template <typename Real>
    [[nodiscard]] Registers<Real> registers_of(Eigen::Index points) const;
    template <typename Real>
    void run_all(std::size_t begin, std::size_t end, Registers<Real>& registers,
                 Eigen::Index size) const;
    template <typename Real>
    void store(const Registers<Real>& registers, Eigen::Index from, Eigen::Index size,
               Eigen::ArrayXXd& values, Eigen::Index at) const;
    void repeat_what_left_range(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t,
                                Eigen::Ref<Eigen::ArrayXXd> values) const;
    template <typename Real>
    [[nodiscard]] Enclosure enclose_in(Eigen::Index output, double x, double begin,
                                       double end) const;

    // Registers 0 and 1 hold x and t. The instructions that do not need x come first, then those
    // that do not need t: at the points of a grid each runs once a time, or once a place. Registers
    // in of_time_ and of_place_ are read by the rest, or are outputs, and never written by it.
    std::vector<Constant> constants_;
    std::vector<Instruction> instructions_;
    std::size_t time_only_count_ = 0;
    std::size_t place_only_count_ = 0;
    std::vector<int> of_time_;
    std::vector<int> of_place_;
    std::vector<int> outputs_; ///< the register of each expression's value
    int register_count_ = 2;
    bool wide_ = false; ///< computed in long double, whose range is 1e±4932
};

} // namespace tvbeam

#include "mms/equations/infix.hpp"

#include <array>
#include <charconv>

namespace tvbeam {

namespace {

using Operation = Program::Operation;

/// How tightly a piece of text holds together.
enum class Tightness { sum, product, power, atom };

struct Piece {
    std::string text;
    Tightness tightness = Tightness::atom;
};

class InfixWriter {
public:
    InfixWriter(const Program& program, const InfixStyle& style,
                const std::function<std::string(int)>& named)
        : program_(program), style_(style), named_(named) {}

    [[nodiscard]] Piece own(int index) const {
        const auto& step = program_.steps()[static_cast<std::size_t>(index)];
        switch (step.operation) {
        case Operation::number:
            return number(step);
        case Operation::name:
            return {step.text};
        case Operation::add:
            return binary(step, " + ", Tightness::sum, Tightness::product);
        case Operation::subtract:
            return binary(step, " - ", Tightness::sum, Tightness::product);
        case Operation::multiply:
            return binary(step, "*", Tightness::product, Tightness::power);
        case Operation::divide:
            return binary(step, "/", Tightness::product, Tightness::power);
        case Operation::power:
            return power(step);
        case Operation::negate:
            return {"-" + at_least(Tightness::product, step.left), Tightness::sum};
        case Operation::square_root:
            return {style_.function_prefix + "sqrt(" + operand(step.left).text + ")"};
        case Operation::function:
            break;
        }
        return {style_.function_prefix + step.text + "(" + operand(step.left).text + ")"};
    }

private:
    [[nodiscard]] Piece operand(int index) const {
        const std::string name = named_(index);
        return name.empty() ? own(index) : Piece{name};
    }
    [[nodiscard]] std::string at_least(Tightness tightness, int index) const {
        Piece piece = operand(index);
        return piece.tightness < tightness ? "(" + piece.text + ")" : piece.text;
    }
    [[nodiscard]] Piece binary(const Program::Step& step, const char* sign, Tightness left,
                               Tightness right) const {
        return {at_least(left, step.left) + sign + at_least(right, step.right), left};
    }
    [[nodiscard]] Piece power(const Program::Step& step) const {
        if (style_.power.empty())
            return {style_.function_prefix + "pow(" + operand(step.left).text + ", " +
                    operand(step.right).text + ")"};
        return {at_least(Tightness::atom, step.left) + style_.power +
                    at_least(Tightness::atom, step.right),
                Tightness::power};
    }
    [[nodiscard]] Piece number(const Program::Step& step) const {
        const std::string numerator = literal_text(step.numerator, style_);
        if (step.denominator == 1.0)
            return {numerator};
        return {numerator + "/" + literal_text(step.denominator, style_), Tightness::product};
    }

    const Program& program_;
    const InfixStyle& style_;
    const std::function<std::string(int)>& named_;
};

} // namespace

std::string literal_text(double value, const InfixStyle& style) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    std::string text(buffer.data(), end);
    if (style.decimal_point && text.find_first_of(".e") == std::string::npos)
        text += ".0";
    return text + style.number_ending;
}

std::string infix_text(const Program& program, int step, const InfixStyle& style,
                       const std::function<std::string(int)>& named) {
    return InfixWriter(program, style, named).own(step).text;
}

std::string readable_text(const Program& program, int step, std::size_t longest) {
    const InfixStyle style{.decimal_point = false, .power = "^"};
    std::string text = infix_text(program, step, style, [&](int index) {
        return program.steps()[static_cast<std::size_t>(index)].field;
    });
    if (text.size() > longest)
        text = text.substr(0, longest) + "…";
    return text;
}

} // namespace tvbeam

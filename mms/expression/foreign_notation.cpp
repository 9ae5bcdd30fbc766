#include "mms/expression/foreign_notation.hpp"

#include "mms/text/characters.hpp"

#include <span>
#include <utility>

namespace tvbeam {

namespace {

using Advice = std::pair<std::string_view, std::string_view>;

constexpr std::string_view phases = "solutions are smooth; one of the beam that is not is given in "
                                    "phases, each [[phase]] with `until`";

constexpr Advice functions[] = {
    {"ln", "the natural logarithm is log(…)"},
    {"log10", "the decimal logarithm of y is log(y)/log(10)"},
    {"log2", "the binary logarithm of y is log(y)/log(2)"},
    {"arcsin", "it is called asin(…)"},
    {"arccos", "it is called acos(…)"},
    {"arctan", "it is called atan(…)"},
    {"pow", "y to the power n is y^n"},
    {"cbrt", "the cube root of y is y^(1/3)"},
    {"sec", "it is 1/cos(…)"},
    {"abs", phases},
    {"fabs", phases},
    {"max", phases},
    {"min", phases},
    {"sign", phases},
    {"sgn", phases},
    {"heaviside", phases},
    {"Heaviside", phases},
    {"step", phases},
    {"H", phases},
    {"if", phases},
    {"where", phases},
};

constexpr Advice symbols[] = {
    {"e", "e^y is written exp(y)"}, {"E", "e^y is written exp(y)"},
    {"Pi", "it is called pi"},      {"PI", "it is called pi"},
    {"T", "the time is t"},         {"time", "the time is t"},
    {"X", "the place is x"},        {"y", "the beam has one coordinate, x"},
};

constexpr Advice characters[] = {
    {"π", "it is written pi"},
    {"²", "a square is written ^2"},
    {"³", "a cube is written ^3"},
    {"·", "a product is written with *"},
    {"×", "a product is written with *"},
    {"−", "a minus is written -"},
    {"–", "a minus is written -"},
    {"÷", "a quotient is written with /"},
    {"√", "a root is written sqrt(…)"},
    {"α", "it is written alpha"},
    {"ζ", "it is written zeta"},
    {"θ_A", "it is written theta_A"},
    {"θ", "the temperature is not a symbol of its own formula"},
};

std::string found(std::span<const Advice> known, std::string_view name) {
    for (const auto& [word, advice] : known)
        if (word == name)
            return "; " + std::string(advice);
    return {};
}

} // namespace

std::string advice_on_function(std::string_view name) {
    return found(functions, name);
}

std::string advice_on_symbol(std::string_view name) {
    return found(symbols, name);
}

std::string advice_on_character(std::string_view rest) {
    for (const auto& [character, advice] : characters)
        if (rest.starts_with(character))
            return "; " + std::string(advice);
    if (rest.size() > 1 && rest[0] == ',' && is_digit(rest[1]))
        return "; a decimal number is written with a point: 3.14";
    return {};
}

} // namespace tvbeam

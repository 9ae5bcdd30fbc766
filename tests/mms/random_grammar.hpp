#pragma once

#include <random>
#include <string>
#include <vector>

namespace tvbeam {

/// Expressions in x and t of what the parser knows, at random: steep, flat, with large powers.
class Grammar {
public:
    explicit Grammar(unsigned seed) : random_(seed) {}

    std::string expression(int depth = 3) {
        if (depth == 0)
            return leaf();
        const std::string a = expression(depth - 1);
        switch (pick(12)) {
        case 0:
            return "(" + a + " + " + expression(depth - 1) + ")";
        case 1:
            return "(" + a + " - " + expression(depth - 1) + ")";
        case 2:
        case 3:
            return a + "*" + expression(depth - 1);
        case 4:
            return a + "/(1 + (" + expression(depth - 1) + ")^2)";
        case 5:
        case 6:
            return "(" + linear() + ")^" + std::to_string(1 + pick(pick(2) == 0 ? 400 : 12));
        case 7:
            return "(" + linear() + ")^(-" + std::to_string(1 + pick(200)) + ")*" + a;
        case 8:
            return "(1 + " + linear() + "^2)^(" + std::to_string(1 + pick(50)) + "/2)*" + a;
        case 9:
            return "x^(4 + " + linear() + ")";
        case 10:
            return "1/(1 + exp(" + std::to_string(1 + pick(2000)) + "*(" + linear() + ")))*" + a;
        default:
            return function() + "(" + a + ")";
        }
    }

private:
    int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

    std::string leaf() {
        static const std::vector<std::string> leaves = {"x", "t", "pi*x", "x*t", "(1-x)", "2"};
        return pick(4) == 0 ? decimal() : leaves[static_cast<std::size_t>(pick(6))];
    }

    std::string decimal() {
        static const std::vector<std::string> forms = {"0.", "0.0", "0.00", "1.", "12."};
        return forms[static_cast<std::size_t>(pick(5))] + std::to_string(1 + pick(999));
    }

    /// Like 0.99*x + 0.01*t or 1 - 0.001*x*t.
    std::string linear() {
        switch (pick(4)) {
        case 0:
            return "(" + decimal() + "*x + " + decimal() + "*t)";
        case 1:
            return "(1 - " + decimal() + "*x)";
        case 2:
            return "(1 - " + decimal() + "*x*t)";
        default:
            return "(" + decimal() + " + x - " + decimal() + "*t)";
        }
    }

    std::string function() {
        static const std::vector<std::string> names = {"sin",  "cos", "exp",  "tanh",
                                                       "atan", "exp", "cosh", "sinh"};
        return names[static_cast<std::size_t>(pick(8))];
    }

    std::mt19937 random_;
};

} // namespace tvbeam

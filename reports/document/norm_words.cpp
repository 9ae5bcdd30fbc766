#include "reports/document/norm_words.hpp"

#include "core/norms/norms.hpp"

namespace tvbeam {

std::string norm_words(const std::string& name) {
    const auto norm = Norm::named(name);
    if (!norm)
        return name;
    const std::string root = norm->root();
    if (root == "corollary")
        return "left side of Corollary 2.2";
    const auto bar = root.find('_');
    const std::string quantity = root.substr(0, bar);
    std::string spaces = root.substr(bar + 1);
    const bool greatest = spaces.starts_with("Linf");
    spaces.erase(0, greatest ? 4 : 2);
    std::string words = quantity == "theta"   ? "temperature"
                        : quantity == "sigma" ? "contact stress"
                                              : "deflection";
    words += greatest ? " in L∞(0,T" : " in L²(0,T";
    if (spaces.starts_with("L2"))
        words += "; L²)";
    else if (spaces.starts_with("H1"))
        words += "; H¹)";
    else if (spaces.starts_with("H2"))
        words += spaces == "H2semi" ? "; H² seminorm)" : "; H²)";
    else
        words += ")";
    return norm->squared ? words + ", squared" : words;
}

} // namespace tvbeam

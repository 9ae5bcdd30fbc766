#include "mms/expression/symbols.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/text/number_text.hpp"

#include <cmath>

namespace tvbeam {

const ModelSymbols& model_symbols() {
    static const ModelSymbols symbols;
    return symbols;
}

const SymbolTable& model_symbol_table() {
    const ModelSymbols& s = model_symbols();
    static const SymbolTable table = {
        {"x", s.x},   {"t", s.t},   {"alpha", s.alpha},    {"zeta", s.zeta},
        {"g1", s.g1}, {"g2", s.g2}, {"theta_A", s.theta_A}};
    return table;
}

GiNaC::exmap beam_values(const Beam& beam) {
    const ModelSymbols& s = model_symbols();
    GiNaC::exmap values;
    const auto set = [&values](const GiNaC::realsymbol& symbol, double value) {
        if (!std::isfinite(value))
            throw InputError({}, symbol.get_name() + " is " + number_text(value) +
                                     "; it must be finite");
        values[symbol] = exact_rational(value);
    };
    set(s.alpha, beam.alpha);
    set(s.zeta, beam.zeta);
    set(s.theta_A, beam.theta_A);
    if (std::isfinite(beam.stops.lower))
        set(s.g1, beam.stops.lower);
    if (std::isfinite(beam.stops.upper))
        set(s.g2, beam.stops.upper);
    return values;
}

void require_stops_in_use(const SourceText& source, const Beam& beam) {
    const auto require = [&source](double stop, const std::string& name) {
        if (std::isfinite(stop))
            return;
        if (const auto place = first_use(source, name))
            throw InputError(*place, "'" + name +
                                         "' is used, but the beam has no stop on that side; give "
                                         "the beam the stop, or write a number");
    };
    require(beam.stops.lower, "g1");
    require(beam.stops.upper, "g2");
}

} // namespace tvbeam

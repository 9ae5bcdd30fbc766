#include "mms/equations/system_checks.hpp"

#include "mms/equations/infix.hpp"
#include "mms/equations/program.hpp"
#include "mms/equations/rounded.hpp"
#include "mms/equations/singularities.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/printing.hpp"
#include "mms/text/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

namespace tvbeam {

using GiNaC::ex;
using Role = DerivedFunction::Role;

namespace {

constexpr std::size_t point_count = 64;
constexpr std::size_t longest_shown = 60;

Program located_program(const std::vector<ex>& formulas, const Fields& fields,
                        const DerivedFunction& function) {
    try {
        return program_of(formulas, fields);
    } catch (const AlgebraError& error) {
        throw InputError(function.source, function.name + ": " + error.what());
    }
}

class SystemCheck {
public:
    explicit SystemCheck(DerivedSystem& derived)
        : derived_(derived), points_(points_inside(derived.system, point_count)) {}

    void require_exact_values() {
        for (const DerivedFunction* exact : derived_.of_role(Role::exact))
            require_values(*exact);
    }

    std::vector<Remark> remarks() {
        require_exact_values();
        for (const DerivedFunction* source : derived_.of_role(Role::source)) {
            look_for_zero(*source);
            look_for_unexercised(*source);
        }
        look_for_idle_parameters();
        for (const auto& function : derived_.functions)
            if (function.role != Role::exact)
                look_for_singularity(function);
        return remarks_;
    }

private:
    void say(const Place& place, const std::string& text) { remarks_.push_back({place, text}); }

    [[nodiscard]] std::map<std::string, Rounded> rounded_names_at(const DomainPoint& point) const {
        std::map<std::string, Rounded> names;
        for (const auto& [name, value] : names_at(derived_, point))
            names[name] = value;
        return names;
    }

    [[nodiscard]] std::vector<Rounded> values_of(const Program& program) const {
        std::vector<Rounded> result;
        for (const auto& point : points_)
            result.push_back(program.evaluate(rounded_names_at(point)).front());
        return result;
    }

    [[nodiscard]] bool is_proven_zero(const ex& formula) const {
        try {
            return is_identically_zero(derived_.fields.exact(formula));
        } catch (const AlgebraError&) {
            return false; // too large to be looked through
        }
    }

    /// Where the algebra does not see it; a spike between the points may be what the values hide.
    static std::string where_looked() {
        return ", to rounding, at all " + std::to_string(point_count) +
               " points that were looked at";
    }

    /// " is zero everywhere", of a formula that has no other value at any point.
    [[nodiscard]] std::string zero_words(const ex& formula) const {
        return is_proven_zero(formula) ? " is zero everywhere" : " is zero" + where_looked();
    }

    /// Where the algebra does not see it, the values do.
    [[nodiscard]] bool is_zero(const ex& formula, const DerivedFunction& of) const {
        const Program program = located_program({formula}, derived_.fields, of);
        const auto values = values_of(program);
        return std::all_of(values.begin(), values.end(),
                           [](const Rounded& value) { return value.may_be_zero(); });
    }

    /// An exact value must be finite in all of the domain.
    void require_values(const DerivedFunction& exact) {
        const Program program = located_program({exact.formula}, derived_.fields, exact);
        const std::string advice = "; choose another solution, or a [domain] without that place";
        for (const auto& found : singularities_of(program, derived_, derived_.system.domain)) {
            using Kind = Singularity::Kind;
            if (found.kind == Kind::pole || found.kind == Kind::no_value)
                throw InputError(exact.source, exact.of + " has no value: " + found.text + advice);
            if (found.kind == Kind::overflow)
                throw InputError(exact.source, exact.of + ": " + found.text + advice);
            say(exact.source,
                exact.of + (found.kind == Kind::kink ? " is not smooth: " : ": ") + found.text +
                    (found.kind == Kind::kink
                         ? "; where a derivative that the equations have jumps there, what is "
                           "derived lacks a delta function"
                         : ""));
            said_[exact.of].push_back(found);
        }
        for (const Rounded& value : values_of(program))
            if (!(std::abs(value.value) <= std::numeric_limits<double>::max()))
                throw InputError(exact.source,
                                 exact.of + " has values beyond the range of doubles" + advice);
    }

    /// At a kink a derivative that is zero elsewhere may have a delta function.
    [[nodiscard]] bool is_kinked(const EquationField& field) const {
        const auto said = said_.find(field.unknown);
        if (said == said_.end() || said->second.front().kind != Singularity::Kind::kink)
            return false;
        const ex& exact = derived_.fields.find(field.unknown)->exact;
        for (std::size_t i = 0; i < coordinate_count; ++i)
            if (field.orders[i] > 0 && !exact.has(coordinate(i)))
                return false;
        return true;
    }

    [[nodiscard]] bool has_kinked(const ex& formula) const {
        return std::ranges::any_of(derived_.fields.occurring_in(formula),
                                   [&](const EquationField* field) { return is_kinked(*field); });
    }

    void look_for_zero(const DerivedFunction& source) {
        if (has_kinked(source.formula))
            return;
        if (is_zero(source.formula, source))
            say(source.source, source.name + zero_words(source.formula) +
                                   ": the solution meets the equation already, as one must that "
                                   "has no source; otherwise, does it test anything?");
    }

    void look_for_unexercised(const DerivedFunction& source) {
        for (const EquationField* field : derived_.fields.occurring_in(source.formula)) {
            if (is_kinked(*field) || !is_zero(field->symbol, source))
                continue;
            ex coefficient;
            try {
                coefficient = plain_derivative(source.formula, field->symbol);
            } catch (const AlgebraError&) {
                coefficient = field->symbol; // what it is multiplied by is not said
            }
            std::string text = formula_text(coefficient);
            if (text.size() > longest_shown)
                text = text.substr(0, longest_shown) + "…";
            say(source.source, field->symbol.get_name() + zero_words(field->symbol) +
                                   ": its coefficient in " + source.name + ", " + text +
                                   ", is not tested");
        }
    }

    /// d/dp of a formula, through what the exact solution has of p, too.
    [[nodiscard]] ex derivative_by(const DerivedParameter& parameter, const ex& formula) const {
        ex result = plain_derivative(formula, parameter.symbol);
        for (const EquationField* field : derived_.fields.occurring_in(formula))
            result = checked_sum(result,
                                 checked_product(plain_derivative(formula, field->symbol),
                                                 plain_derivative(field->exact, parameter.symbol)));
        return result;
    }

    /// Whether it has an effect on a function, as far as is known: its derivative is not zero. That
    /// is looked at beside its value, too: (k - 1)^2 does not depend on k at k = 1 alone.
    [[nodiscard]] bool has_effect(const DerivedParameter& parameter,
                                  const DerivedFunction& function) const {
        constexpr double beside = 1.0 / 16.0;
        try {
            const ex slope = derivative_by(parameter, function.formula);
            if (slope.is_zero())
                return false;
            if (has_kinked(slope))
                return true;
            const Program program = program_of({slope}, derived_.fields);
            const double step = parameter.value == 0.0 ? beside : beside * parameter.value;
            for (const bool is_moved : {false, true})
                for (const auto& point : points_) {
                    auto names = rounded_names_at(point);
                    if (is_moved)
                        names[parameter.name] = parameter.value + step;
                    const Rounded value = program.evaluate(names).front();
                    const bool has_value = !is_moved || std::isfinite(value.value);
                    if (has_value && !value.may_be_zero())
                        return true;
                }
            return false;
        } catch (const AlgebraError&) {
            return true; // too large to be looked through
        }
    }

    /// In which function a parameter without effect stands for nothing.
    [[nodiscard]] std::string idle_words(const DerivedParameter& parameter) const {
        for (const auto& function : derived_.functions)
            if (const ex slope = derivative_by(parameter, function.formula); !slope.is_zero())
                return ": " + function.name + " is the same " +
                       (is_proven_zero(slope) ? "for all values of it"
                                              : "at and beside its value" + where_looked()) +
                       ", and what it multiplies there is not tested";
        return "";
    }

    void look_for_idle_parameters() {
        std::vector<ex> formulas;
        for (const auto& function : derived_.functions)
            formulas.push_back(function.formula);
        const Program all = located_program(formulas, derived_.fields, derived_.functions.front());
        for (std::size_t i = 0; i < derived_.parameters.size(); ++i) {
            const DerivedParameter& parameter = derived_.parameters[i];
            const Place& place = derived_.system.parameters[i].place;
            if (parameter.is_number)
                say(place, "parameter " + parameter.name + " stands in whole exponents, and " +
                               number_text(parameter.value) + " for it everywhere");
            else if (const bool is_used = all.uses(parameter.name);
                     !is_used ||
                     std::ranges::none_of(derived_.functions, [&](const DerivedFunction& function) {
                         return has_effect(parameter, function);
                     }))
                say(place, "parameter " + parameter.name +
                               " has no effect on anything that is derived" +
                               (is_used ? idle_words(parameter) : ""));
        }
    }

    /// Where a function is asked for; a boundary value without a place anywhere, as boundaries may
    /// be within: of a hole, or of a curved domain.
    [[nodiscard]] DomainPart part_for(const DerivedFunction& function) const {
        DomainPart part = derived_.system.domain;
        for (const auto& [name, value] : function.at)
            part[name] = {value, value};
        return part;
    }

    /// What the exact values have is not said of their derivatives again, unless these have worse,
    /// or have it in another place.
    void look_for_singularity(const DerivedFunction& function) {
        std::vector<Singularity> known;
        for (const EquationField* field : derived_.fields.occurring_in(function.formula))
            if (const auto said = said_.find(field->unknown); said != said_.end())
                known.insert(known.end(), said->second.begin(), said->second.end());
        const Program program = located_program({function.formula}, derived_.fields, function);
        for (const auto& found : singularities_of(program, derived_, part_for(function))) {
            using Kind = Singularity::Kind;
            // Where one could not be excluded is of no account: it may be anywhere.
            if (std::ranges::any_of(known, [&](const Singularity& said) {
                    return found.kind >= said.kind &&
                           (found.kind == Kind::not_excluded || found.place == said.place);
                }))
                continue;
            const std::string what = found.kind == Kind::pole       ? " has no value: "
                                     : found.kind == Kind::no_value ? " has no value in places: "
                                     : found.kind == Kind::kink     ? " is not smooth: "
                                                                    : ": ";
            say(function.source, function.name + what + found.text);
        }
    }

    DerivedSystem& derived_;
    std::vector<DomainPoint> points_;
    std::map<std::string, std::vector<Singularity>> said_; ///< by unknown, the worst first
    std::vector<Remark> remarks_;
};

} // namespace

std::vector<Remark> checked_system(DerivedSystem& derived) {
    return SystemCheck(derived).remarks();
}

void require_exact_values(DerivedSystem& derived) {
    SystemCheck(derived).require_exact_values();
}

std::vector<DomainPoint> points_inside(const EquationSystem& system, std::size_t count) {
    // 1/g, 1/g², … with g^5 = g + 1.
    constexpr double g = 1.1673039782614187;
    std::vector<DomainPoint> points(count);
    for (std::size_t i = 0; i < count; ++i) {
        double step = 1.0;
        for (const auto& name : system.coordinates) {
            step /= g;
            const DomainInterval range = system.domain.at(name);
            const double part = std::fmod(0.5 + double(i + 1) * step, 1.0);
            points[i][name] = range.begin + part * (range.end - range.begin);
        }
    }
    return points;
}

std::map<std::string, long double> names_at(const DerivedSystem& derived,
                                            const DomainPoint& point) {
    std::map<std::string, long double> names = {{"pi", std::numbers::pi_v<long double>}};
    for (const auto& parameter : derived.parameters)
        names[parameter.name] = parameter.value;
    for (const auto& [name, value] : point)
        names[name] = value;
    return names;
}

} // namespace tvbeam

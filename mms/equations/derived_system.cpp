#include "mms/equations/derived_system.hpp"

#include "mms/equations/equation_language.hpp"
#include "mms/equations/equation_names.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/numeric_value.hpp"
#include "mms/text/error_text.hpp"
#include "mms/text/number_text.hpp"

#include <algorithm>
#include <set>

namespace tvbeam {

using GiNaC::ex;
using Role = DerivedFunction::Role;

namespace {

constexpr int largest_expanded_power = 100; // of a polynomial
constexpr int largest_power = 1000;         // of checked_power

GiNaC::exmap values_of(const std::vector<DerivedParameter>& parameters) {
    GiNaC::exmap values;
    for (const auto& parameter : parameters)
        values[parameter.symbol] = parameter.exact;
    return values;
}

/// Whether it has a symbol other than those of the values.
bool varies(const ex& expression, const GiNaC::exmap& values) {
    for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::symbol>(*part) && !values.contains(*part))
            return true;
    return false;
}

/// Whether it may be negative, where only whole powers of it have a value.
bool may_be_negative(const ex& expression, const GiNaC::exmap& values) {
    try {
        return varies(expression, values) || numeric_value(substituted(expression, values)) < 0.0;
    } catch (const AlgebraError&) {
        return false;
    }
}

/// The parameters in a whole exponent of what may be negative; none where it is no such.
std::set<std::string> in_whole_exponent(const ex& base, const ex& exponent,
                                        const std::vector<DerivedParameter>& parameters) {
    const GiNaC::exmap values = values_of(parameters);
    std::set<std::string> used;
    for (const auto& parameter : parameters)
        if (exponent.has(parameter.symbol))
            used.insert(parameter.name);
    if (used.empty() || !may_be_negative(base, values))
        return {};
    const auto value = number_with(exponent, values);
    const int largest = varies(base, values) ? largest_expanded_power : largest_power;
    const bool is_whole = value && value->is_integer() && GiNaC::abs(*value) <= largest;
    return is_whole ? used : std::set<std::string>{};
}

class Derivation {
public:
    /// numbers: parameters that their numbers stand for.
    explicit Derivation(const EquationSystem& system, std::set<std::string> numbers = {})
        : numbers_(std::move(numbers)) {
        derived_.system = system;
    }

    /// Those that should be such, after the result.
    [[nodiscard]] const std::set<std::string>& in_whole_exponents() const {
        return in_whole_exponents_;
    }

    DerivedSystem result() {
        for (std::size_t i = 0; i < coordinate_count; ++i)
            names_[coordinate_names()[i]] = Tensor::scalar(coordinate(i));
        for (const auto& parameter : system().parameters)
            add_parameter(parameter);
        add_unknowns();
        for (const auto& definition : system().definitions) {
            names_[definition.name] = tensor_of(definition);
            require_free_components(definition, names_[definition.name]);
        }
        for (const auto& equation : system().equations)
            add_equation(equation);
        require_determined();
        for (const auto& unknown : derived_.unknowns)
            add_exact(unknown);
        for (const auto& entry : system().boundary)
            add_boundary(entry);
        for (const auto& entry : system().initial)
            add_initial(entry);
        require_different_names();
        for (const auto& formula : texts_)
            for (auto part = formula.preorder_begin(); part != formula.preorder_end(); ++part)
                if (GiNaC::is_a<GiNaC::power>(*part))
                    in_whole_exponents_.merge(
                        in_whole_exponent(part->op(0), part->op(1), derived_.parameters));
        return std::move(derived_);
    }

private:
    [[nodiscard]] const EquationSystem& system() const { return derived_.system; }

    /// The value of an entry of the file: of one text, or of several, which are the components.
    Tensor tensor_of(const NamedEntries& named) {
        std::vector<Tensor> values;
        for (const SourceText& entry : named.entries) {
            values.push_back(parse_tensor(entry, names_, derived_.fields, system().dimension,
                                          values_of(derived_.parameters)));
            texts_.insert(texts_.end(), values.back().entries.begin(), values.back().entries.end());
        }
        if (values.size() == 1)
            return values.front();
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!values[i].is_scalar())
                throw InputError(named.entries[i].begin(), "a component of " + named.name + " is " +
                                                               shape_text(values[i]) +
                                                               "; it must be a scalar");
        return tensor_list(values);
    }

    static void require_vector(const NamedEntries& named, const Tensor& value) {
        if (value.rank == Tensor::Rank::matrix)
            throw InputError(named.entries.front().begin(),
                             named.name + " is " + shape_text(value) +
                                 "; it must be a scalar or a vector");
    }

    /// v1 is a component of a vector v, and nothing else.
    void require_free_components(const NamedEntries& named, const Tensor& value) const {
        if (value.rank != Tensor::Rank::vector)
            return;
        const auto components = component_names(named.name, value.rows);
        for (const auto* block : {&system().parameters, &system().unknowns, &system().definitions})
            for (const auto& other : *block)
                if (value.rows > 1 &&
                    std::find(components.begin(), components.end(), other.name) != components.end())
                    throw InputError(other.place, "'" + other.name + "' is a component of " +
                                                      named.name + "; call it something else");
    }

    void add_parameter(const NamedEntries& named) {
        const SourceText& text = named.entries.front();
        const Tensor value = parse_tensor(text, {}, derived_.fields, 1);
        if (!value.is_scalar())
            throw InputError(text.begin(), "parameter " + named.name + " is " + shape_text(value) +
                                               "; it must be a number");
        DerivedParameter parameter{named.name, GiNaC::realsymbol(named.name),
                                   value.entries.front()};
        parameter.value = located(text, "parameter " + named.name,
                                  [&] { return numeric_value(parameter.exact); });
        parameter.is_number = numbers_.contains(named.name);
        names_[named.name] =
            Tensor::scalar(parameter.is_number ? parameter.exact : ex(parameter.symbol));
        derived_.parameters.push_back(parameter);
    }

    /// Exact values first, of which each may use those before it; equations see fields.
    void add_unknowns() {
        TensorTable fields;
        for (const auto& unknown : system().unknowns) {
            Tensor exact = tensor_of(unknown);
            require_vector(unknown, exact);
            require_free_components(unknown, exact);
            names_[unknown.name] = exact;
            const auto components = component_names(unknown.name, exact.entries.size());
            for (std::size_t i = 0; i < components.size(); ++i) {
                exact.entries[i] = derived_.fields.add(components[i], exact.entries[i]);
                derived_.unknowns.push_back(components[i]);
                unknown_texts_.push_back(&unknown);
            }
            fields[unknown.name] = exact;
        }
        for (const auto& [name, field] : fields)
            names_[name] = field;
    }

    void add(Role role, const std::string& name, const std::string& of, const NamedEntries& named,
             std::size_t component, const ex& formula,
             const std::map<std::string, double>& at = {}) {
        const SourceText& text = named.entries[named.entries.size() > 1 ? component : 0];
        derived_.functions.push_back(
            {role, name, of, place_text(at), text.text(), text.begin(), formula, at});
    }

    void add_equation(const NamedEntries& named) {
        const Tensor value = tensor_of(named);
        require_vector(named, value);
        const auto names = component_names(named.name, value.entries.size());
        for (std::size_t i = 0; i < names.size(); ++i) {
            add(Role::source, names[i], names[i], named, i, value.entries[i]);
            if (derived_.fields.occurring_in(value.entries[i]).empty())
                throw InputError(derived_.functions.back().source,
                                 "equation " + names[i] +
                                     " has no unknown in it, or what it has of them cancels; it "
                                     "must say something of the unknowns of [unknowns]");
        }
    }

    void require_determined() const {
        std::set<std::string> occurring;
        const auto equations = derived_.of_role(Role::source);
        for (const DerivedFunction* equation : equations)
            for (const EquationField* field : derived_.fields.occurring_in(equation->formula))
                occurring.insert(field->unknown);
        for (std::size_t i = 0; i < derived_.unknowns.size(); ++i)
            if (!occurring.contains(derived_.unknowns[i]))
                throw InputError(unknown_texts_[i]->place,
                                 "unknown " + derived_.unknowns[i] +
                                     " is in no equation; give it one, or leave it out");
        if (equations.size() < derived_.unknowns.size())
            throw InputError(system().equations.front().place,
                             "there are fewer equations, " + std::to_string(equations.size()) +
                                 ", than unknowns, " + std::to_string(derived_.unknowns.size()) +
                                 ", counted by components; every unknown needs one");
    }

    void add_exact(const std::string& unknown) {
        const auto at = std::find(derived_.unknowns.begin(), derived_.unknowns.end(), unknown);
        const NamedEntries& named =
            *unknown_texts_[static_cast<std::size_t>(at - derived_.unknowns.begin())];
        const std::size_t component =
            derived_.unknowns.size() == 1 ? 0 : component_of(unknown, named);
        add(Role::exact, unknown + "_exact", unknown, named, component,
            derived_.fields.find(unknown)->symbol);
        for (std::size_t i = 0; i + 1 < coordinate_count; ++i) {
            const std::string& name = coordinate_names()[i];
            if (std::find(system().coordinates.begin(), system().coordinates.end(), name) ==
                system().coordinates.end())
                continue;
            Orders orders{};
            orders[i] = 1;
            const ex slope = located(named.entries.front(), "the gradient of " + unknown, [&] {
                return ex(derived_.fields.of(unknown, orders).symbol);
            });
            add(Role::gradient, std::string(unknown).append("_exact_").append(name), unknown, named,
                component, slope);
        }
    }

    static std::size_t component_of(const std::string& unknown, const NamedEntries& named) {
        const auto names = component_names(named.name, named.entries.size());
        const auto found = std::find(names.begin(), names.end(), unknown);
        return found == names.end() ? 0 : static_cast<std::size_t>(found - names.begin());
    }

    /// "x = 1"; empty: everywhere.
    static std::string place_text(const std::map<std::string, double>& at) {
        return at.empty() ? "" : at.begin()->first + " = " + exact_text(at.begin()->second);
    }

    /// A boundary or initial value: at the solution, and in the place.
    void add_values(Role role, const NamedEntries& named, const std::string& ending,
                    const GiNaC::exmap& in_place, const std::map<std::string, double>& at) {
        const std::string place = place_text(at);
        const Tensor value = tensor_of(named);
        require_vector(named, value);
        const auto names = component_names(named.name, value.entries.size());
        for (std::size_t i = 0; i < names.size(); ++i) {
            const SourceText& text = named.entries[named.entries.size() > 1 ? i : 0];
            const ex formula = located(text, names[i] + (place.empty() ? "" : " at " + place), [&] {
                return substituted(derived_.fields.exact(value.entries[i]), in_place);
            });
            add(role, names[i] + ending, names[i], named, i, formula, at);
        }
    }

    void add_boundary(const BoundaryEntry& entry) {
        if (entry.variable.empty()) {
            add_values(Role::boundary, entry.value, "", {}, {});
            return;
        }
        TensorTable known;
        for (const auto& parameter : derived_.parameters)
            known[parameter.name] = Tensor::scalar(parameter.symbol);
        const GiNaC::exmap values = values_of(derived_.parameters);
        const Tensor position = parse_tensor(entry.position, known, derived_.fields, 1, values);
        if (!position.is_scalar())
            throw InputError(entry.position.begin(),
                             "on is " + shape_text(position) + "; it must be a number");
        const ex exact = position.entries.front();
        const double at = located(entry.position, "on",
                                  [&] { return numeric_value(substituted(exact, values)); });
        const DomainInterval range = system().domain.at(entry.variable);
        if (at != range.begin && at != range.end)
            throw InputError(
                entry.position.begin(),
                entry.variable + " = " +
                    number_text_beside(at, std::abs(at - range.begin) < std::abs(at - range.end)
                                               ? range.begin
                                               : range.end) +
                    " is not on the boundary of the domain, " + entry.variable + " from " +
                    number_text(range.begin) + " to " + number_text(range.end) +
                    "; [domain] says where it ends");
        const auto index = static_cast<std::size_t>(
            std::find(coordinate_names().begin(), coordinate_names().end(), entry.variable) -
            coordinate_names().begin());
        add_values(Role::boundary, entry.value, "", {{coordinate(index), exact}},
                   {{entry.variable, at}});
    }

    void add_initial(const NamedEntries& named) {
        if (std::find(system().coordinates.begin(), system().coordinates.end(), "t") ==
            system().coordinates.end())
            throw InputError(named.place, "there is no t in the file, so that there is nothing "
                                          "initial; leave [initial] out");
        const double begin = system().domain.at("t").begin;
        add_values(Role::initial, named, "_initial",
                   {{coordinate(coordinate_count - 1), exact_rational(begin)}}, {{"t", begin}});
    }

    /// What is called alike in code, as the components of f and an equation f1.
    void require_different_names() const {
        std::set<std::string> names;
        for (const auto& parameter : derived_.parameters)
            names.insert(parameter.name);
        for (const auto& unknown : derived_.unknowns)
            if (!names.insert(unknown).second)
                throw InputError(system().unknowns.front().place,
                                 "two things are called " + unknown +
                                     ", a component of a vector among them; rename one");
        for (const auto& function : derived_.functions)
            if (!names.insert(function.name).second)
                throw InputError(function.source,
                                 "two things are called " + function.name +
                                     ", a component of a vector among them; rename one");
    }

    DerivedSystem derived_;
    TensorTable names_;
    std::vector<const NamedEntries*> unknown_texts_; ///< for each component
    std::vector<ex> texts_;                          ///< what was read
    std::set<std::string> numbers_;
    std::set<std::string> in_whole_exponents_;
};

} // namespace

std::vector<const DerivedFunction*> DerivedSystem::of_role(Role role) const {
    std::vector<const DerivedFunction*> result;
    for (const auto& function : functions)
        if (function.role == role)
            result.push_back(&function);
    return result;
}

DerivedSystem derive_system(const EquationSystem& system) {
    Derivation derivation(system);
    DerivedSystem derived = derivation.result();
    const auto& numbers = derivation.in_whole_exponents();
    return numbers.empty() ? std::move(derived) : Derivation(system, numbers).result();
}

} // namespace tvbeam

#include "mms/equations/singularities.hpp"

#include "mms/equations/infix.hpp"
#include "mms/equations/rounded.hpp"
#include "mms/equations/system_checks.hpp"
#include "mms/expression/plain_evaluation.hpp"
#include "mms/text/number_text.hpp"

#include <boost/numeric/interval.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

using Operation = Program::Operation;
namespace bni = boost::numeric::interval_lib;
// Libraries of mathematics are right to about an ulp and not rounded; widened() allows for that.
using Span =
    boost::numeric::interval<double, bni::policies<bni::save_state<bni::rounded_transc_std<double>>,
                                                   bni::checking_base<double>>>;

constexpr std::size_t most_evaluations = 4'000'000; ///< of steps, at points of the grid
constexpr std::size_t most_parts = 2'000;
constexpr std::size_t finest_grid = 9; ///< points along a coordinate
constexpr std::size_t longest_quoted = 60;
constexpr int fewest_digits = 6; ///< of a place

Span widened(const Span& a) {
    constexpr double relative = 1e-14;
    const double width = relative * std::max(std::abs(a.lower()), std::abs(a.upper()));
    return std::isfinite(width) ? Span(a.lower() - width, a.upper() + width) : a;
}

/// A step that is not smooth for every operand.
struct Critical {
    enum class Rule { not_zero, positive, cosine, below_one };
    Rule rule;
    int operand;
    bool pole; ///< where it is not met, infinite; otherwise a kink
    bool has_varying_exponent = false;
};

std::vector<Critical> criticals_of(const Program& program) {
    std::vector<Critical> result;
    using Rule = Critical::Rule;
    const auto is_constant = [&](int step) {
        return program.steps()[static_cast<std::size_t>(step)].operation == Operation::number;
    };
    const auto is_whole = [&](int step) {
        const auto& number = program.steps()[static_cast<std::size_t>(step)];
        return is_constant(step) && number.denominator == 1.0 &&
               number.numerator == std::floor(number.numerator);
    };
    for (const auto& step : program.steps()) {
        const std::string& name = step.text;
        if (step.operation == Operation::divide && !is_constant(step.right))
            result.push_back({Rule::not_zero, step.right, true});
        else if (step.operation == Operation::square_root)
            result.push_back({Rule::positive, step.left, false});
        else if (step.operation == Operation::power && is_whole(step.right))
            continue; // one too large to be written out is smooth, too
        else if (step.operation == Operation::power)
            result.push_back({Rule::positive, step.left, false, !is_constant(step.right)});
        else if (step.operation == Operation::function && name == "log")
            result.push_back({Rule::positive, step.left, true});
        else if (step.operation == Operation::function && name == "tan")
            result.push_back({Rule::cosine, step.left, true});
        else if (step.operation == Operation::function && (name == "asin" || name == "acos"))
            result.push_back({Rule::below_one, step.left, false});
    }
    // Of one operand the worst counts: where x is 0, log(x) has no value, and sqrt(x) has one.
    std::vector<Critical> different;
    for (const Critical& one : result) {
        const auto known = std::ranges::find_if(different, [&](const Critical& other) {
            return other.rule == one.rule && other.operand == one.operand;
        });
        if (known == different.end())
            different.push_back(one);
        else if (one.pole && !known->pole)
            *known = one;
    }
    return different;
}

/// What must be away from 0: of a sign that never changes (not_zero, cosine), or positive.
long double margin(const Critical& critical, long double operand) {
    switch (critical.rule) {
    case Critical::Rule::cosine:
        return std::cos(operand);
    case Critical::Rule::below_one:
        return 1.0L - std::abs(operand);
    default:
        return operand;
    }
}

/// Whether there is nothing on one side of 0.
bool is_one_sided(const Critical& critical) {
    return critical.rule == Critical::Rule::positive || critical.rule == Critical::Rule::below_one;
}

bool holds(const Critical& critical, const Span& operand) {
    const Span a = widened(operand);
    if (std::isnan(a.lower()) || std::isnan(a.upper()))
        return false;
    switch (critical.rule) {
    case Critical::Rule::not_zero:
        return a.lower() > 0.0 || a.upper() < 0.0;
    case Critical::Rule::positive:
        return a.lower() > 0.0;
    case Critical::Rule::cosine: {
        const Span c = widened(cos(a));
        return c.lower() > 0.0 || c.upper() < 0.0;
    }
    case Critical::Rule::below_one:
        return a.lower() > -1.0 && a.upper() < 1.0;
    }
    return false;
}

/// By step: whether it is the same in all of the domain.
std::vector<bool> constants_in(const Program& program, const DerivedSystem& derived) {
    const auto& coordinates = derived.system.coordinates;
    std::vector<bool> constant;
    for (const auto& step : program.steps()) {
        const auto is = [&](int operand) {
            return operand < 0 || constant[static_cast<std::size_t>(operand)];
        };
        constant.push_back(step.operation == Operation::name
                               ? std::find(coordinates.begin(), coordinates.end(), step.text) ==
                                     coordinates.end()
                               : is(step.left) && is(step.right));
    }
    return constant;
}

class Search {
public:
    Search(const Program& program, const DerivedSystem& derived, const DomainPart& part)
        : program_(program), derived_(derived), part_(part), criticals_(criticals_of(program)),
          is_constant_(constants_in(program, derived)) {}

    std::vector<Singularity> worst() {
        sample();
        std::vector<Singularity> found;
        std::vector<const Critical*> open;
        for (std::size_t i = 0; i < criticals_.size(); ++i)
            if (auto one = sampled(i))
                found.push_back(*std::move(one));
            else if (!is_constant_[static_cast<std::size_t>(criticals_[i].operand)])
                open.push_back(&criticals_[i]);
        const auto is_kinked_at_most = [&] {
            return std::ranges::all_of(
                found, [](const Singularity& one) { return one.kind == Singularity::Kind::kink; });
        };
        if (is_kinked_at_most() && without_value_)
            found.push_back(*without_value_);
        if (is_kinked_at_most() && !open.empty())
            if (auto one = not_excluded(open))
                found.push_back(*std::move(one));
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.kind < b.kind; });
        // One a place: a root that is divided by is a root and a divisor.
        std::set<std::string> places;
        std::erase_if(found,
                      [&](const Singularity& one) { return !places.insert(one.place).second; });
        constexpr std::size_t most_said = 3;
        if (found.size() > most_said) {
            found[most_said - 1].text +=
                " (and " + std::to_string(found.size() - most_said) + " more)";
            found.resize(most_said);
        }
        return found;
    }

private:
    struct Extremes {
        long double least = std::numeric_limits<long double>::infinity();
        long double greatest = -std::numeric_limits<long double>::infinity();
        DomainPoint at_least, at_greatest;
    };

    [[nodiscard]] std::vector<std::string> coordinates() const {
        return derived_.system.coordinates;
    }

    /// Margins at a grid of points that has the ends of the domain.
    void sample() {
        const auto names = coordinates();
        std::size_t along = finest_grid;
        const auto points = [&] { return std::pow(double(along), double(names.size())); };
        while (along > 3 && points() * double(program_.steps().size()) > double(most_evaluations))
            along -= 2;
        extremes_.resize(criticals_.size());
        const auto count = static_cast<std::size_t>(points());
        for (std::size_t i = 0; i < count; ++i) {
            DomainPoint point;
            std::size_t rest = i;
            for (const auto& name : names) {
                const DomainInterval range = part_.at(name);
                const double part = double(rest % along) / double(along - 1);
                point[name] = (1.0 - part) * range.begin + part * range.end;
                rest /= along;
            }
            look_at(point);
        }
    }

    /// Whether a double holds it.
    static bool is_held(long double value) {
        return std::abs(value) <= std::numeric_limits<double>::max();
    }

    /// The first step that a double cannot hold, where an output then has no value either: 1/(1 +
    /// exp(1000 x)) is 0 all the same.
    void look_for_missing_values(const std::vector<long double>& values, const DomainPoint& point) {
        const auto beyond = std::find_if_not(values.begin(), values.end(), is_held);
        if (without_value_ || beyond == values.end())
            return;
        std::map<std::string, double> names;
        for (const auto& [name, value] : names_at(derived_, point))
            names[name] = static_cast<double>(value);
        const auto outputs = program_.evaluate(names);
        if (std::all_of(outputs.begin(), outputs.end(), is_held))
            return;
        without_value_ =
            without_value(static_cast<std::size_t>(beyond - values.begin()), values, point);
    }

    /// Why a step has no value where those before it have one.
    [[nodiscard]] Singularity without_value(std::size_t of, const std::vector<long double>& values,
                                            const DomainPoint& point) const {
        using Kind = Singularity::Kind;
        const Program::Step& step = program_.steps()[of];
        const auto critical = std::ranges::find_if(criticals_, [&](const Critical& one) {
            return is_one_sided(one) && one.operand == step.left;
        });
        const bool is_defined = !std::isnan(values[of]);
        const bool divides_by_zero = step.operation == Operation::power &&
                                     values[static_cast<std::size_t>(step.left)] == 0.0L;
        if (critical == criticals_.end() || (is_defined && !divides_by_zero))
            return {Kind::overflow,
                    readable_text(program_, static_cast<int>(of), longest_quoted) +
                        " is beyond the range of doubles " + text_of(point),
                    text_of(point)};
        const std::string place = place_of(*critical, point);
        if (is_defined)
            return {Kind::pole, said(*critical) + place, place};
        return {Kind::no_value, said_beyond(*critical, point) + place, place};
    }

    void look_at(const DomainPoint& point) {
        const auto values = program_.values(names_at(derived_, point));
        look_for_missing_values(values, point);
        for (std::size_t k = 0; k < criticals_.size(); ++k) {
            const long double here =
                margin(criticals_[k], values[static_cast<std::size_t>(criticals_[k].operand)]);
            Extremes& seen = extremes_[k];
            if (here < seen.least) {
                seen.least = here;
                seen.at_least = point;
            }
            if (here > seen.greatest) {
                seen.greatest = here;
                seen.at_greatest = point;
            }
        }
    }

    [[nodiscard]] long double margin_at(const Critical& critical, const DomainPoint& point) const {
        const auto values = program_.values(names_at(derived_, point));
        return margin(critical, values[static_cast<std::size_t>(critical.operand)]);
    }

    /// Not where it is only small, as exp(-50).
    [[nodiscard]] bool may_vanish(const Critical& critical, const DomainPoint& point) const {
        std::map<std::string, Span> names;
        for (const auto& [name, value] : names_at(derived_, point))
            names[name] = widened(Span(static_cast<double>(value)));
        return !holds(critical, program_.values(names)[static_cast<std::size_t>(critical.operand)]);
    }

    /// As x^(-1/2) is at x = 0.
    [[nodiscard]] bool is_infinite_at(const DomainPoint& point) const {
        const auto values = program_.evaluate(names_at(derived_, point));
        return std::any_of(values.begin(), values.end(),
                           [](long double value) { return std::isinf(value); });
    }

    /// The point between two, at which the margins have different signs, where it is 0.
    [[nodiscard]] DomainPoint crossing(const Critical& critical, DomainPoint below,
                                       DomainPoint above) const {
        constexpr int most = 2200; // from the largest double to the smallest
        for (int i = 0; i < most; ++i) {
            DomainPoint middle;
            for (const auto& [name, value] : below)
                middle[name] = 0.5 * value + 0.5 * above.at(name);
            if (middle == below || middle == above)
                break;
            (margin_at(critical, middle) < 0.0L ? below : above) = middle;
        }
        return above;
    }

    static std::string text_of(const DomainPoint& point, int digits = fewest_digits) {
        std::string text;
        for (const auto& [name, value] : point)
            text.append(text.empty() ? "" : ", ")
                .append(name)
                .append(" = ")
                .append(number_text(value, digits));
        return text.empty() ? "everywhere" : "at " + text;
    }

    [[nodiscard]] std::string place_of(const Critical& critical, const DomainPoint& point) const {
        return is_constant_[static_cast<std::size_t>(critical.operand)]
                   ? "everywhere"
                   : text_of(point, digits_of(critical, point));
    }

    /// So many that at the place as it is written the margin is about 0, too, or what it is.
    [[nodiscard]] int digits_of(const Critical& critical, const DomainPoint& point) const {
        constexpr int all = 17; // which no two doubles share
        const long double enough = std::max(1e-3L, 2.0L * std::abs(margin_at(critical, point)));
        int digits = fewest_digits;
        for (; digits < all; ++digits) {
            DomainPoint written;
            for (const auto& [name, value] : point)
                written[name] = decimal<double>(number_text(value, digits));
            if (!(std::abs(margin_at(critical, written)) > enough))
                break;
        }
        return digits;
    }

    /// "the argument x of a root"
    [[nodiscard]] std::string named(const Critical& critical) const {
        const std::string operand = readable_text(program_, critical.operand, longest_quoted);
        switch (critical.rule) {
        case Critical::Rule::not_zero:
            return "the divisor " + operand;
        case Critical::Rule::positive:
            if (critical.has_varying_exponent)
                return "the base " + operand + " of a power";
            return "the argument " + operand + (critical.pole ? " of log" : " of a root");
        case Critical::Rule::cosine:
            return "the argument " + operand + " of tan";
        case Critical::Rule::below_one:
            break;
        }
        return "the argument " + operand + " of asin or acos";
    }

    [[nodiscard]] std::string said(const Critical& critical) const {
        return named(critical) + (critical.rule == Critical::Rule::cosine
                                      ? " is an odd multiple of pi/2 "
                                  : critical.rule == Critical::Rule::below_one ? " is 1 in size "
                                                                               : " is 0 ");
    }

    /// Of what is beyond the edge: by itself, or by rounding alone.
    [[nodiscard]] std::string said_beyond(const Critical& critical,
                                          const DomainPoint& point) const {
        std::map<std::string, Rounded> names;
        for (const auto& [name, value] : names_at(derived_, point))
            names[name] = value;
        const Rounded operand = program_.values(names)[static_cast<std::size_t>(critical.operand)];
        const bool is_positive = critical.rule == Critical::Rule::positive;
        const Rounded margin = is_positive            ? operand
                               : operand.value > 0.0L ? Rounded(1.0L) - operand
                                                      : operand + Rounded(1.0L);
        if (margin.may_be_zero())
            return named(critical) + (is_positive ? " is 0 or, by rounding, negative "
                                                  : " is 1 in size or, by rounding, more ");
        return named(critical) + (is_positive ? " is negative " : " is above 1 in size ");
    }

    [[nodiscard]] std::optional<Singularity> sampled(std::size_t i) const {
        const Critical& critical = criticals_[i];
        const Extremes& seen = extremes_[i];
        using Kind = Singularity::Kind;
        constexpr long double zero = 1e-15L; // what sin(pi) is of
        const bool one_sided = is_one_sided(critical);
        const bool crosses = seen.least < -zero && seen.greatest > zero;
        const bool same = is_constant_[static_cast<std::size_t>(critical.operand)];
        const auto with = [&](Kind kind, const DomainPoint& point) {
            const std::string place = place_of(critical, point);
            return Singularity{kind, said(critical) + place, place};
        };
        if (crosses) {
            Singularity found = with(one_sided ? Kind::no_value : Kind::pole,
                                     crossing(critical, seen.at_least, seen.at_greatest));
            if (one_sided)
                found.text += critical.rule == Critical::Rule::positive
                                  ? ", and negative on one side"
                                  : ", and greater on one side";
            return found;
        }
        if (one_sided && seen.least < -zero)
            return Singularity{Kind::no_value, said(critical) + "or beyond everywhere",
                               "everywhere"};
        for (const auto& [value, point] :
             {std::pair(seen.least, &seen.at_least), std::pair(seen.greatest, &seen.at_greatest)})
            if (std::abs(value) <= zero && may_vanish(critical, *point) &&
                !(same && !critical.pole && !is_infinite_at(*point))) // no kink in x
                return with(critical.pole || is_infinite_at(*point) ? Kind::pole : Kind::kink,
                            *point);
        return std::nullopt;
    }

    /// Halves the domain until all rules hold in every part.
    [[nodiscard]] std::optional<Singularity>
    not_excluded(const std::vector<const Critical*>& open) const {
        DomainPart whole;
        for (const auto& name : coordinates())
            whole[name] = part_.at(name);
        std::vector<DomainPart> left = {whole};
        std::size_t looked_at = 0;
        while (!left.empty()) {
            const DomainPart box = left.back();
            left.pop_back();
            const auto all = broken_in(open, box);
            if (all.empty())
                continue;
            if (++looked_at > most_parts || !can_be_halved(box)) {
                const DomainPoint middle = middle_of(box);
                // A root may be 0 where it is a divisor, too.
                const auto pole = std::ranges::find_if(all, [&](const Critical* one) {
                    return one->pole && vanishes_at(*one, middle);
                });
                const Critical* broken = pole == all.end() ? all.front() : *pole;
                const std::string place = text_of(middle, digits_of(*broken, middle));
                if (is_below_beside(*broken, middle))
                    return Singularity{Singularity::Kind::no_value, said(*broken) + place, place};
                if (vanishes_at(*broken, middle))
                    return Singularity{broken->pole ? Singularity::Kind::pole
                                                    : Singularity::Kind::kink,
                                       said(*broken) + place, place};
                return Singularity{Singularity::Kind::not_excluded,
                                   "it could not be excluded that " + said(*broken) + "near " +
                                       place.substr(3),
                                   place};
            }
            halve(box, whole, left);
        }
        return std::nullopt;
    }

    /// Whether a margin that is of one sign touches 0 in a place, as (x - 0.3)^2 does: it is of the
    /// size that rounding of the place leaves beside its greatest, and beside what it is close by
    /// on both sides along a coordinate. What is small all about, as exp(-40 x), is not 0.
    [[nodiscard]] bool vanishes_at(const Critical& critical, const DomainPoint& point) const {
        constexpr long double of_greatest = 1e-14L;
        constexpr long double of_close_by = 1e-9L;
        constexpr int halvings = 10;
        const auto of = static_cast<std::size_t>(&critical - criticals_.data());
        const long double here = std::abs(margin_at(critical, point));
        if (here >
            of_greatest * std::max(std::abs(extremes_[of].least), std::abs(extremes_[of].greatest)))
            return false;
        return std::ranges::any_of(point, [&](const auto& coordinate) {
            const std::string& name = coordinate.first;
            const double at = coordinate.second;
            const DomainInterval range = part_.at(name);
            const double step = std::ldexp(range.end - range.begin, -halvings);
            return std::ranges::all_of(std::array{at - step, at + step}, [&](double beside) {
                DomainPoint other = point;
                other[name] = std::clamp(beside, range.begin, range.end);
                return here <= of_close_by * std::abs(margin_at(critical, other));
            });
        });
    }

    /// Whether what must be positive is negative close to a place: between the points of the grid.
    [[nodiscard]] bool is_below_beside(const Critical& critical, const DomainPoint& point) const {
        if (!is_one_sided(critical))
            return false;
        constexpr int finest = 45; // halvings of the domain
        constexpr long double rounding = 1e-15L;
        for (const auto& [name, at] : point) {
            const DomainInterval range = part_.at(name);
            for (int k = 1; k <= finest; ++k)
                for (const double side : {-1.0, 1.0}) {
                    DomainPoint beside = point;
                    beside[name] = at + side * std::ldexp(range.end - range.begin, -k);
                    if (beside[name] >= range.begin && beside[name] <= range.end &&
                        margin_at(critical, beside) < -rounding)
                        return true;
                }
        }
        return false;
    }

    [[nodiscard]] std::vector<const Critical*> broken_in(const std::vector<const Critical*>& open,
                                                         const DomainPart& box) const {
        std::map<std::string, Span> names;
        for (const auto& [name, value] : names_at(derived_, {}))
            names[name] = widened(Span(static_cast<double>(value)));
        for (const auto& [name, range] : box)
            names[name] = Span(range.begin, range.end);
        const auto values = program_.values(names);
        std::vector<const Critical*> broken;
        std::ranges::copy_if(open, std::back_inserter(broken), [&](const Critical* critical) {
            return !holds(*critical, values[static_cast<std::size_t>(critical->operand)]);
        });
        return broken;
    }

    static DomainPoint middle_of(const DomainPart& box) {
        DomainPoint point;
        for (const auto& [name, range] : box)
            point[name] = 0.5 * (range.begin + range.end);
        return point;
    }

    /// Whether there is a double within.
    static bool has_middle(const DomainInterval& side) {
        const double middle = 0.5 * (side.begin + side.end);
        return side.begin < middle && middle < side.end;
    }

    static bool can_be_halved(const DomainPart& box) {
        return std::ranges::any_of(box, [](const auto& side) { return has_middle(side.second); });
    }

    /// Across the coordinate in which the part is longest, measured by the whole: of the
    /// smallest doubles by 0.
    static void halve(const DomainPart& box, const DomainPart& whole,
                      std::vector<DomainPart>& parts) {
        std::string longest;
        double length = 0.0;
        for (const auto& [name, range] : box) {
            const DomainInterval& all = whole.at(name);
            const double here = (range.end - range.begin) / (all.end - all.begin);
            if (has_middle(range) && (longest.empty() || here > length)) {
                length = here;
                longest = name;
            }
        }
        const double middle = 0.5 * (box.at(longest).begin + box.at(longest).end);
        parts.push_back(box);
        parts.back()[longest].end = middle;
        parts.push_back(box);
        parts.back()[longest].begin = middle;
    }

    const Program& program_;
    const DerivedSystem& derived_;
    const DomainPart& part_;
    std::vector<Critical> criticals_;
    std::vector<bool> is_constant_; ///< by step: it is the same everywhere
    std::vector<Extremes> extremes_;
    std::optional<Singularity> without_value_; ///< the first found of a step
};

} // namespace

std::vector<Singularity> singularities_of(const Program& program, const DerivedSystem& derived,
                                          const DomainPart& part) {
    return Search(program, derived, part).worst();
}

} // namespace tvbeam

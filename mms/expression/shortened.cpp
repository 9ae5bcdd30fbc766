#include "mms/expression/shortened.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/canonical.hpp"
#include "mms/expression/printing.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

constexpr std::size_t longest_combined = 4000;
constexpr std::size_t longest_sum = 600;

/// Bases and exponents of a term, without its number.
using Factors = std::map<ex, numeric, GiNaC::ex_is_less>;

Factors factors_of(const ex& term) {
    const GiNaC::exvector parts =
        is_a<GiNaC::mul>(term) ? GiNaC::exvector(term.begin(), term.end()) : GiNaC::exvector{term};
    Factors factors;
    for (const ex& part : parts)
        if (is_a<GiNaC::power>(part) && is_a<numeric>(part.op(1)))
            factors[part.op(0)] = ex_to<numeric>(part.op(1));
        else if (!is_a<numeric>(part))
            factors[part] = 1;
    return factors;
}

/// t x - t as t (x - 1). GiNaC's own (collect_common_factors) does it in another way from run to
/// run, as its addresses fall.
ex with_common_taken_out(const ex& sum) {
    if (!is_a<GiNaC::add>(sum))
        return sum;
    Factors common = factors_of(sum.op(0));
    for (const ex& term : sum) {
        const Factors factors = factors_of(term);
        Factors shared;
        for (const auto& [base, exponent] : common)
            if (const auto found = factors.find(base);
                found != factors.end() && found->second.is_negative() == exponent.is_negative())
                shared[base] =
                    GiNaC::abs(found->second) < GiNaC::abs(exponent) ? found->second : exponent;
        common = std::move(shared);
        if (common.empty())
            return sum;
    }
    ex divisor = 1;
    for (const auto& [base, exponent] : common)
        divisor *= pow(base, exponent);
    ex rest = 0;
    for (const ex& term : sum)
        rest += term / divisor;
    return divisor * rest;
}

/// The same for the sums among the factors of a product.
ex with_common_taken_out_of_factors(const ex& product) {
    ex result = 1;
    for (const ex& factor : product)
        result *= with_common_taken_out(factor);
    return result;
}

/// Shortens the sums of an expression, from the innermost out. What is asked for again is kept: of
/// the terms of a sum each pair is looked at whenever two were joined.
class Shortening final : public GiNaC::map_function {
public:
    ex operator()(const ex& part) override {
        const bool is_whole = !std::exchange(is_within_, true);
        ex inside = is_a<GiNaC::add>(part) || is_a<GiNaC::mul>(part) || is_a<GiNaC::power>(part)
                        ? part.map(*this)
                        : part;
        if (length(inside) > longest_sum)
            return inside;
        if (is_a<GiNaC::mul>(inside))
            return shorter(with_common_taken_out_of_factors(inside), inside);
        if (!is_a<GiNaC::add>(inside))
            return inside;
        if (is_whole)
            return better_of_both_signs(inside,
                                        [](const ex& one) { return formula_text(one).size(); });
        // GiNaC has a sum that is a factor with the one or the other sign, as its addresses fall.
        const bool is_turned = begins_with_minus(*canonical(inside));
        const ex better = better_of_both_signs(is_turned ? -inside : inside,
                                               [this](const ex& one) { return length(one); });
        return is_turned ? -better : better;
    }

private:
    /// Without a sign in front, which another part may take.
    std::size_t length(const ex& expression) {
        const auto [known, is_new] = lengths_.try_emplace(expression, 0);
        if (is_new) {
            known->second =
                std::min(formula_text(expression).size(), formula_text(-expression).size());
            lengths_[-expression] = known->second;
        }
        return known->second;
    }

    /// Of two equal ones; where they are alike in length, the first.
    ex shorter(const ex& one, const ex& other) { return length(other) < length(one) ? other : one; }

    /// The shortest of a sum as it is, multiplied out, and with what its terms have in common taken
    /// out.
    ex shortest(const ex& sum) {
        const auto [known, is_new] = shortest_.try_emplace(sum, 0);
        if (is_new) {
            const ex expanded = moderately_expanded(sum);
            const ex one = with_common_taken_out(sum);
            known->second = expanded.is_equal(sum)
                                ? shorter(one, sum)
                                : shorter(shorter(one, with_common_taken_out(expanded)),
                                          shorter(sum, expanded));
        }
        return known->second;
    }

    /// Two terms that are shorter by a fifth together are put together, those first that gain most.
    ex with_pairs_joined(ex sum) {
        constexpr std::size_t most_terms = 12;
        while (is_a<GiNaC::add>(sum) && sum.nops() <= most_terms) {
            const GiNaC::exvector terms = ordered_operands(sum); // the same in every run
            std::size_t most = 0;
            ex joined = sum;
            for (std::size_t i = 0; i < terms.size(); ++i)
                for (std::size_t j = i + 1; j < terms.size(); ++j) {
                    const ex pair = terms[i] + terms[j];
                    const ex one = shortest(pair);
                    const std::size_t before = length(pair);
                    const std::size_t after = length(one);
                    if (5 * after <= 4 * before && before - after > most) {
                        most = before - after;
                        joined = sum - pair + one;
                    }
                }
            if (most == 0)
                return sum;
            sum = shorter(sum, joined);
            if (!sum.is_equal(joined))
                return sum;
        }
        return sum;
    }

    ex shortest_by_any(const ex& sum) { return shorter(shortest(sum), with_pairs_joined(sum)); }

    template <typename Length>
    ex better_of_both_signs(const ex& sum, const Length& length_of) {
        const ex one = shortest_by_any(sum);
        const ex other = -shortest_by_any(-sum);
        return std::pair(length_of(other), formula_text(other)) <
                       std::pair(length_of(one), formula_text(one))
                   ? other
                   : one;
    }

    bool is_within_ = false;
    std::map<ex, std::size_t, GiNaC::ex_is_less> lengths_; ///< of texts
    std::map<ex, ex, GiNaC::ex_is_less> shortest_;         ///< of sums
};

} // namespace

ex shortened(const ex& expression) {
    if (formula_text(expression).size() > longest_combined)
        return expression;
    try {
        return Shortening()(expression);
    } catch (const std::runtime_error&) { // GiNaC cannot divide all that it can hold
        return expression;
    } catch (const GiNaC::pole_error&) { // in what is multiplied out, a divisor may be zero
        return expression;
    }
}

} // namespace tvbeam

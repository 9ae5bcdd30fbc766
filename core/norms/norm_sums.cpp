#include "core/norms/norm_sums.hpp"

#include "core/worse.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvbeam {

QuantitySet quantities_of(const std::vector<Norm>& norms) {
    QuantitySet set{};
    for (const auto& norm : norms) {
        const QuantitySet more = norm.quantities();
        for (std::size_t q = 0; q < quantity_count; ++q)
            set[q] = set[q] || more[q];
    }
    return set;
}

bool all_finite(const std::vector<double>& errors) {
    return std::all_of(errors.begin(), errors.end(),
                       [](double error) { return std::isfinite(error); });
}

NormSums::NormSums(std::vector<Norm> norms)
    : norms_(std::move(norms)), needed_(quantities_of(norms_)) {
    for (const auto& norm : norms_)
        for (const auto& part : norm.parts) {
            Sum sum{part.kind == TimeNorm::Kind::Linf, {}, 0.0};
            for (std::size_t q = 0; q < quantity_count; ++q)
                if (part.quantities[q])
                    sum.quantities.push_back(q);
            sums_.push_back(std::move(sum));
        }
}

void NormSums::add(double dt, const Squares& squares) {
    evaluations_ += std::count(needed_.begin(), needed_.end(), true);
    for (auto& sum : sums_) {
        double square = 0.0;
        for (const std::size_t q : sum.quantities)
            square += squares[q];
        if (!sum.greatest)
            sum.value += dt * square;
        else
            sum.value = worse(sum.value, square);
    }
}

std::vector<double> NormSums::values() const {
    std::vector<double> values;
    values.reserve(norms_.size());
    auto sum = sums_.begin();
    for (const auto& norm : norms_) {
        double square = 0.0;
        for (std::size_t part = 0; part < norm.parts.size(); ++part)
            square += (sum++)->value;
        values.push_back(norm.squared ? square : std::sqrt(square));
    }
    return values;
}

} // namespace tvbeam

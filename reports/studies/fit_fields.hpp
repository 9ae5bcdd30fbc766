#pragma once

#include "studies/orders/two_term_fit.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <functional>

namespace tvbeam {

/// A fit of the two-term model in JSON: status ok, p, q, a, b, rho, each null where it is not
/// determined, rms, how many records are used, and those that are rejected, each with a reason
/// behind widths_of(record), an object; or status failed and the reason.
nlohmann::ordered_json
fit_json(const TwoTermFit& fit,
         const std::function<nlohmann::ordered_json(std::size_t)>& widths_of);

} // namespace tvbeam

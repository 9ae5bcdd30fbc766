#pragma once

#include "mms/equations/derived_system.hpp"
#include "mms/equations/program.hpp"

#include <optional>
#include <string>

namespace tvbeam {

/// Where a program is not smooth, or may not be.
struct Singularity {
    enum class Kind {
        pole,     ///< a divisor is 0, tan or log is infinite
        no_value, ///< beyond what sqrt, log, asin or acos is defined on
        kink,     ///< at the edge of that: no derivative there, or an infinite one
        not_excluded,
    };
    Kind kind;
    std::string text; ///< "1 - 2*x is 0 at x = 0.5"
};

/// The worst that is found of a program on the domain; nothing: it is smooth everywhere.
std::optional<Singularity> singularity_of(const Program& program, const DerivedSystem& derived);

} // namespace tvbeam

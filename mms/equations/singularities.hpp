#pragma once

#include "mms/equations/derived_system.hpp"
#include "mms/equations/program.hpp"

#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// Where a program is not smooth, or may not be.
struct Singularity {
    enum class Kind {
        pole,     ///< a divisor is 0, tan or log is infinite
        no_value, ///< beyond what sqrt, log, asin or acos is defined on
        overflow, ///< a value that is needed is beyond the range of doubles
        kink,     ///< at the edge of that: no derivative there, or an infinite one
        not_excluded,
    };
    Kind kind;
    std::string text;  ///< "1 - 2*x is 0 at x = 0.5"
    std::string place; ///< "at x = 0.5"
};

/// A part of the domain: of each coordinate an interval, or a value.
using DomainPart = std::map<std::string, DomainInterval>;

/// What is found of a program on a part of the domain, the worst first and one a place, at most
/// three and how many more; none: it is smooth everywhere. Overflow is what leaves an output
/// without a value in doubles, at the points of a grid that has the ends of the domain.
std::vector<Singularity> singularities_of(const Program& program, const DerivedSystem& derived,
                                          const DomainPart& part);

} // namespace tvbeam

#pragma once

#include <gsl/gsl_errno.h>

#include <new>
#include <stdexcept>
#include <string>

namespace tvbeam {

/// GSL's own handler of errors ends the program, out of memory too. A source file that calls GSL
/// includes this header, and there is an exception in its place, from before main() on: bad_alloc
/// where memory is short, else domain_error with GSL's reason. A program may set another handler.
[[noreturn]] inline void throw_gsl_error(const char* reason, const char* /*file*/, int /*line*/,
                                         int error) {
    if (error == GSL_ENOMEM)
        throw std::bad_alloc();
    throw std::domain_error(std::string("GSL: ") + reason);
}

inline const bool gsl_errors_are_thrown = (gsl_set_error_handler(&throw_gsl_error), true);

} // namespace tvbeam

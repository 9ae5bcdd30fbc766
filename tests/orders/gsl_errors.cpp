// What GSL refuses does not end the program of somebody who analyses orders.

#include <boost/test/unit_test.hpp>
#include <gsl/gsl_errno.h>

#include <new>
#include <stdexcept>
#include <string>

BOOST_AUTO_TEST_SUITE(gsl_errors)

BOOST_AUTO_TEST_CASE(errors_of_gsl_are_exceptions_with_its_reason) {
    BOOST_CHECK_EXCEPTION(gsl_error("not for this argument", __FILE__, __LINE__, GSL_EDOM),
                          std::domain_error, [](const std::domain_error& error) {
                              return error.what() == std::string("GSL: not for this argument");
                          });
    BOOST_CHECK_THROW(gsl_error("no room", __FILE__, __LINE__, GSL_ENOMEM), std::bad_alloc);
}

BOOST_AUTO_TEST_SUITE_END()

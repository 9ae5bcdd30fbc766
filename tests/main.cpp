#define BOOST_TEST_MODULE tvbeam
#include <boost/test/unit_test.hpp>

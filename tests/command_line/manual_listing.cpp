// The listing of the manual of studies is a file that is compiled and run.

#include <boost/test/unit_test.hpp>

#include <fstream>
#include <sstream>
#include <string>

namespace {

std::string contents(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

} // namespace

BOOST_AUTO_TEST_CASE(the_manual_lists_the_solution_in_cpp_as_it_is_compiled) {
    const std::string listing = contents(TVBEAM_LISTING);
    BOOST_REQUIRE(!listing.empty());
    BOOST_TEST((contents(TVBEAM_MANUAL).find("```cpp\n" + listing + "```\n") != std::string::npos),
               "studies/README.md does not hold " TVBEAM_LISTING);
}

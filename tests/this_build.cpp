#include "tests/this_build.hpp"

#include <cstdlib>

bool short_tests = TVBEAM_SHORT_TESTS;
const std::string tvbeam_binary = TVBEAM_BINARY;

namespace {

// Before anything else is initialised, as sweeps at namespace scope.
[[gnu::constructor(101)]] void look_at_the_environment() {
    short_tests = short_tests || std::getenv("TVBEAM_SHORT_TESTS") != nullptr;
}

} // namespace

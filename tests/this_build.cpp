#include "tests/this_build.hpp"

const bool short_tests = TVBEAM_SHORT_TESTS;
const std::string tvbeam_binary = TVBEAM_BINARY;

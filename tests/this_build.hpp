#pragma once

#include <string>

// What differs between the builds, told apart when the tests run and not when they are compiled:
// the optimised build and the one under the sanitizers then share the objects of the tests, where a
// compiler cache is.

// Short forms of sweeps, for the sanitizers, and where TVBEAM_SHORT_TESTS is set.
extern bool short_tests;

// The program of this build.
extern const std::string tvbeam_binary;

#pragma once

#include <stdexcept>
#include <string>

namespace tvbeam {

/// Where a piece of input stands. line and column count from 1; 0 means unknown and is not printed.
struct Place {
    std::string file;
    int line = 0;
    int column = 0;
};

/// Input that breaks a rule. what() reads `file:line:column: message`; the message states the rule,
/// the offending value and what to do.
class InputError : public std::runtime_error {
public:
    InputError(const Place& place, const std::string& message);
};

} // namespace tvbeam

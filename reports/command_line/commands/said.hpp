#pragma once

#include <string>

namespace tvbeam {

/// A line on standard error, after the program's name.
void say(const std::string& message);

/// The same, in place of a progress line that may stand there.
void say_interrupted(const std::string& message);

/// Colour on a terminal, unless NO_COLOR is set (https://no-color.org).
[[nodiscard]] bool coloured();

} // namespace tvbeam

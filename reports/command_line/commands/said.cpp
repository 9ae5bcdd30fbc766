#include "reports/command_line/commands/said.hpp"

#include "reports/document/visible_text.hpp"

#include <cstdio>
#include <cstdlib>

#include <unistd.h>

namespace tvbeam {

void say(const std::string& message) {
    std::fprintf(stderr, "tvbeam: %s\n", visible(message).c_str());
}

void say_interrupted(const std::string& message) {
    if (isatty(STDERR_FILENO) == 1)
        std::fputs("\r\033[K", stderr);
    say(message);
}

bool coloured() {
    const char* no_color = std::getenv("NO_COLOR");
    return isatty(STDOUT_FILENO) == 1 && (no_color == nullptr || *no_color == '\0');
}

} // namespace tvbeam

#include "reports/command_line/commands/said.hpp"

#include "mms/text/visible_text.hpp"
#include "reports/document/text_table.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <sys/ioctl.h>
#include <unistd.h>

namespace tvbeam {

namespace {

std::size_t terminal_width() {
    constexpr std::size_t usual = 80;
    constexpr std::size_t narrowest = 40;
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return usual;
    return std::max<std::size_t>(narrowest, size.ws_col);
}

} // namespace

void say(const std::string& message) {
    std::string text = "tvbeam: " + visible(message) + "\n";
    // A line in a file or a pipe is one message.
    if (isatty(STDERR_FILENO) == 1)
        text = wrapped(text, 4, terminal_width());
    std::fputs(text.c_str(), stderr);
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

#include "reports/command_line/commands/shell_words.hpp"

#include <algorithm>

namespace tvbeam {

std::string word(const std::string& text) {
    const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("_./=:,+@%-").find(c) != std::string_view::npos;
    });
    if (plain)
        return text;
    std::string quoted = "'";
    for (const char c : text)
        quoted += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
    return quoted + "'";
}

std::string shard_command_line(const std::string& scene, const std::vector<std::string>& overrides,
                               const std::string& directory) {
    std::string line = "tvbeam run " + word(scene);
    for (const auto& setting : overrides)
        line += " --set " + word(setting);
    return line + " --out " + word(directory) + " --shard ";
}

} // namespace tvbeam

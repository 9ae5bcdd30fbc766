#include "reports/command_line/commands/destination.hpp"

#include <filesystem>
#include <system_error>

namespace tvbeam {

namespace {

/// Whether two reports are wanted in the same file, or both on standard output.
bool same_place(const std::string& first, const std::string& second) {
    if (first.empty() || second.empty())
        return false;
    std::error_code error;
    return first == second || std::filesystem::weakly_canonical(first, error) ==
                                  std::filesystem::weakly_canonical(second, error);
}

} // namespace

Destination destination(const std::string& name) {
    return opened([&] { return Destination(name); });
}

void require_apart(const std::string& first, const std::string& file, const std::string& second,
                   const std::string& other) {
    if (same_place(file, other))
        throw InputError({first + " " + file + " " + second + " " + other},
                         "two reports do not fit in one place; give one of them another");
}

void require_no_input(const std::string& option, const std::string& file,
                      const std::vector<std::string>& inputs) {
    for (const auto& input : inputs)
        if (file != "-" && same_place(file, input))
            throw InputError({option + " " + file},
                             "would take the place of a file that is read; give it another");
}

std::vector<std::string> files_of(const Scene& scene) {
    std::vector<std::string> files{scene.file};
    if (scene.solver)
        for (const auto& file : scene.solver->files)
            files.push_back(file.source.string());
    return files;
}

} // namespace tvbeam

#pragma once

#include "tests/temporary_directory.hpp"
#include "tests/this_build.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <sys/wait.h>

namespace tvbeam {

/// What a call of the program gave.
struct Called {
    int exit = -1;
    std::string output; ///< standard output
    std::string errors; ///< standard error
};

/// Calls tvbeam with arguments as a shell reads them, after what `first` does.
inline Called call(const TemporaryDirectory& directory, const std::string& arguments,
                   const std::string& first = "") {
    const std::string errors = (directory.path() / "stderr").string();
    const std::string command = first + tvbeam_binary + " " + arguments + " 2>" + errors;
    Called called;
    FILE* pipe = popen(command.c_str(), "r");
    BOOST_REQUIRE(pipe != nullptr);
    std::array<char, 4096> buffer{};
    for (std::size_t count = 0; (count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        called.output.append(buffer.data(), count);
    const int status = pclose(pipe);
    called.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    called.errors = directory.read("stderr");
    std::filesystem::remove(errors);
    return called;
}

inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace tvbeam

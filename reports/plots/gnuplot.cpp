#include "reports/plots/gnuplot.hpp"

#include "reports/files/output_file.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace tvbeam {

namespace {

/// A directory that goes with its object.
class ScratchDirectory {
public:
    explicit ScratchDirectory(const std::filesystem::path& inside) {
        std::string name = (inside / "tvbeam-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw OutputError("cannot make a directory for plots, '" + name +
                              "': " + std::generic_category().message(errno));
        path_ = name;
    }
    ~ScratchDirectory() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;
    ScratchDirectory(ScratchDirectory&&) = delete;
    ScratchDirectory& operator=(ScratchDirectory&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// Runs `gnuplot -d script` in a directory, what it says going to the file `said`. 0, or the number
/// of the error that kept it from starting, or −1 where it failed.
int run_gnuplot(const std::filesystem::path& directory, std::string script,
                const std::string& said) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, said.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    std::string program = "gnuplot";
    std::string defaults = "-d"; // not what a file of the user's says
    const std::array<char*, 4> arguments{program.data(), defaults.data(), script.data(), nullptr};
    // In a group of its own: Ctrl-C asks tvbeam to end, which it does when the files are written.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t process = 0;
    const int error =
        posix_spawnp(&process, "gnuplot", &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        return error;
    int status = 0;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR)
            return -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : -1;
}

/// The first line of a message that says what is wrong.
std::string first_words(const std::string& said) {
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);)
        if (line.find_first_not_of(" \t^") != std::string::npos &&
            line.find("line ") != std::string::npos)
            return line.substr(line.find_first_not_of(" \t"));
    return said.empty() ? "it gave no reason" : said.substr(0, said.find('\n'));
}

} // namespace

DrawnPlots draw(const std::vector<Plot>& plots) {
    DrawnPlots drawn{std::vector<DrawnPlot>(plots.size()), {}};
    std::error_code error_code;
    const auto inside = std::filesystem::temp_directory_path(error_code);
    if (error_code) {
        drawn.failure = "there is no directory for temporary files: " + error_code.message();
        return drawn;
    }
    const ScratchDirectory scratch(inside);
    for (std::size_t i = 0; i < plots.size(); ++i) {
        const Plot& plot = plots[i];
        OutputFile(scratch.path() / (plot.name + ".gp")).commit(plot.script);
        OutputFile(scratch.path() / (plot.name + ".dat")).commit(plot.data);
        const int error = run_gnuplot(scratch.path(), plot.name + ".gp", "said");
        if (error > 0) {
            drawn.failure = error == ENOENT ? "gnuplot is not installed"
                                            : "gnuplot cannot be run: " +
                                                  std::generic_category().message(error);
            break;
        }
        if (error < 0)
            drawn.failure = "gnuplot failed on " + plot.name +
                            ".gp: " + first_words(text_of(scratch.path() / "said"));
        else
            drawn.plots[i] = {text_of(scratch.path() / (plot.name + ".svg")),
                              text_of(scratch.path() / (plot.name + ".png"))};
    }
    return drawn;
}

} // namespace tvbeam

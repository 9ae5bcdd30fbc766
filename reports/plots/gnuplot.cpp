#include "reports/plots/gnuplot.hpp"

#include "mms/text/file_text.hpp"
#include "mms/text/input_error.hpp"
#include "reports/command_line/end_requests.hpp"
#include "reports/files/output_file.hpp"
#include "reports/files/temporary.hpp"
#include "reports/plots/gnuplot_script.hpp"

#include <boost/crc.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <new>
#include <sstream>
#include <string_view>
#include <system_error>

namespace tvbeam {

namespace {

/// A directory that goes with its object.
class ScratchDirectory {
public:
    explicit ScratchDirectory(const std::filesystem::path& inside) {
        remove_left_behind(inside);
        path_ = temporary_path(inside);
        if (mkdir(path_.c_str(), S_IRWXU) != 0)
            throw OutputError("cannot make a directory for plots, '" + path_.string() +
                              "': " + std::generic_category().message(errno));
    }
    ~ScratchDirectory() {
        // Once more where there was no memory for a moment; after that a later run takes it away.
        for (int attempt = 0; attempt < 2; ++attempt)
            try {
                std::error_code error;
                std::filesystem::remove_all(path_, error);
                if (!error)
                    return;
            } catch (const std::bad_alloc&) {
                continue;
            }
    }
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;
    ScratchDirectory(ScratchDirectory&&) = delete;
    ScratchDirectory& operator=(ScratchDirectory&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Whether what gnuplot wrote has all its parts: it takes no notice of a full disk.
bool is_whole_svg(std::string_view text) {
    text = text.substr(0, text.find_last_not_of(" \r\n") + 1);
    return text.starts_with("<?xml") && text.ends_with("</svg>");
}

/// https://www.w3.org/TR/png: a signature, then chunks: length, type, contents, check sum of the
/// two before; the last is IEND.
bool is_whole_png(std::string_view text) {
    constexpr std::string_view signature = "\x89PNG\r\n\x1A\n";
    constexpr std::size_t around = 12; // what a chunk has beside its contents
    const auto number = [&text](std::size_t at) {
        std::size_t value = 0;
        for (std::size_t i = at; i < at + 4; ++i)
            value = value << 8U | static_cast<unsigned char>(text[i]);
        return value;
    };
    if (!text.starts_with(signature))
        return false;
    text.remove_prefix(signature.size());
    while (text.size() >= around) {
        const std::size_t length = number(0);
        if (length > text.size() - around)
            return false;
        boost::crc_32_type sum;
        sum.process_bytes(text.data() + 4, length + 4);
        if (sum.checksum() != number(length + 8))
            return false;
        if (text.substr(4, 4) == "IEND")
            return text.size() == around;
        text.remove_prefix(length + around);
    }
    return false;
}

bool is_whole_pdf(std::string_view text) {
    text = text.substr(0, text.find_last_not_of(" \r\n") + 1);
    return text.starts_with("%PDF-") && text.ends_with("%%EOF");
}

constexpr std::size_t largest_picture = 256 << 20; // bytes

/// What a file holds, where it is whole. Throws InputError.
std::string picture(const std::filesystem::path& file, bool (*is_whole)(std::string_view)) {
    std::string text = file_text(file.string(), largest_picture);
    if (!is_whole(text))
        throw InputError({}, "gnuplot wrote only a part of " + file.filename().string() +
                                 "; is there room in '" +
                                 file.parent_path().parent_path().string() + "'?");
    return text;
}

/// Waits until the process is through, and ends it where the end is asked for. Its status; −1 where
/// it cannot be known.
int status_of(pid_t process) {
    constexpr timespec between{.tv_sec = 0, .tv_nsec = 5'000'000};
    for (;;) {
        int status = 0;
        const pid_t ended = waitpid(process, &status, WNOHANG);
        if (ended == process)
            return status;
        if (ended < 0 && errno != EINTR)
            return -1;
        if (EndRequests::made())
            kill(process, SIGKILL);
        nanosleep(&between, nullptr);
    }
}

/// Runs `gnuplot -d script` in a directory, what it says going to the file `said`. 0, or the number
/// of the error that kept it from starting, or −1 where it failed.
int run_gnuplot(const std::filesystem::path& directory, std::string script,
                const std::string& said) {
    int error = 0;
    // Each step may lack memory; without one of them the files would be written elsewhere.
    const auto unless_failed = [&error](auto step, auto... given) {
        if (error == 0)
            error = step(given...);
    };
    posix_spawn_file_actions_t actions;
    if ((error = posix_spawn_file_actions_init(&actions)) != 0)
        return error;
    unless_failed(posix_spawn_file_actions_addchdir_np, &actions, directory.c_str());
    unless_failed(posix_spawn_file_actions_addopen, &actions, STDIN_FILENO, "/dev/null", O_RDONLY,
                  mode_t{0});
    unless_failed(posix_spawn_file_actions_addopen, &actions, STDOUT_FILENO, said.c_str(),
                  O_WRONLY | O_CREAT | O_TRUNC, mode_t{0600});
    unless_failed(posix_spawn_file_actions_adddup2, &actions, STDOUT_FILENO, STDERR_FILENO);
    std::string program = "gnuplot";
    std::string defaults = "-d"; // not what a file of the user's says
    const std::array<char*, 4> arguments{program.data(), defaults.data(), script.data(), nullptr};
    // In a group of its own: Ctrl-C asks tvbeam to end, which ends gnuplot.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t process = 0;
    unless_failed(posix_spawnp, &process, "gnuplot", &actions, &attributes, arguments.data(),
                  environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        return error;
    const int status = status_of(process);
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

/// The figures are added to drawn. Throws OutputError and InputError.
void draw(const std::vector<Plot>& plots, const std::filesystem::path& inside, DrawnPlots& drawn) {
    const ScratchDirectory scratch(inside);
    for (std::size_t i = 0; i < plots.size(); ++i) {
        const Plot& plot = plots[i];
        OutputFile(scratch.path() / (plot.name + ".gp"))
            .commit(gnuplot_script(plot.drawing, plot.name));
        OutputFile(scratch.path() / (plot.name + ".dat")).commit(gnuplot_data(plot.drawing));
        if (EndRequests::made())
            throw OutputError("the end was asked for");
        const int error = run_gnuplot(scratch.path(), plot.name + ".gp", "said");
        if (error > 0)
            throw OutputError(error == ENOENT ? "gnuplot is not installed"
                                              : "gnuplot cannot be run: " +
                                                    std::generic_category().message(error));
        if (EndRequests::made())
            throw OutputError("the end was asked for");
        if (error < 0)
            drawn.failure =
                "gnuplot failed on " + plot.name + ".gp: " +
                first_words(file_text((scratch.path() / "said").string(), largest_picture));
        else
            drawn.plots[i] = {picture(scratch.path() / (plot.name + ".svg"), is_whole_svg),
                              picture(scratch.path() / (plot.name + ".png"), is_whole_png),
                              picture(scratch.path() / (plot.name + ".pdf"), is_whole_pdf)};
    }
}

} // namespace

DrawnPlots draw(const std::vector<Plot>& plots) {
    DrawnPlots drawn{std::vector<DrawnPlot>(plots.size()), {}};
    std::error_code error;
    const auto inside = std::filesystem::temp_directory_path(error);
    if (error) {
        drawn.failure = "there is no directory for temporary files: " + error.message();
        return drawn;
    }
    try {
        draw(plots, inside, drawn);
    } catch (const OutputError& failure) {
        drawn.failure = failure.what();
    } catch (const InputError& failure) {
        drawn.failure = failure.what();
    }
    return drawn;
}

} // namespace tvbeam

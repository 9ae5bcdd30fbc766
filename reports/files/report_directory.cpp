#include "reports/files/report_directory.hpp"

#include "reports/files/descriptor.hpp"
#include "reports/formats/report_format.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <list>
#include <system_error>
#include <utility>

namespace tvbeam {

namespace {

/// All of them, or none.
void publish(std::list<OutputFile>& files) {
    try {
        for (auto& file : files)
            file.publish();
    } catch (const OutputError&) {
        for (auto& file : files)
            file.revoke();
        throw;
    }
    for (const auto& file : files)
        file.sync();
}

} // namespace

ReportDirectory::ReportDirectory(std::filesystem::path path, const ReportBlock& block)
    : path_(std::move(path)) {
    for (const auto& format : report_formats())
        if (block.files.empty() ? format->is_written_unasked() : block.names(format->name()))
            formats_.push_back(format.get());
    make(path_);
    lock();
    for (const auto* format : formats_)
        for (const auto& name : format->certain_files()) {
            make((path_ / name).parent_path());
            OutputFile{path_ / name};
        }
}

ReportDirectory::~ReportDirectory() {
    if (lock_ >= 0)
        close(lock_);
    for (const auto& directory : made_)
        rmdir(directory.c_str()); // fails where something was written
}

void ReportDirectory::make(const std::filesystem::path& directory) {
    std::error_code error;
    if (std::filesystem::is_directory(directory, error))
        return;
    if (std::filesystem::exists(directory, error))
        throw OutputError("cannot write to '" + directory.string() +
                          "': it is not a directory; name one, or one that is to be made");
    if (directory.has_parent_path())
        make(directory.parent_path());
    if (!std::filesystem::create_directory(directory, error) && error)
        throw OutputError("cannot make the directory '" + directory.string() +
                          "': " + error.message());
    made_.insert(made_.begin(), directory);
}

std::vector<std::filesystem::path> ReportDirectory::earlier_files() const {
    std::vector<std::filesystem::path> files;
    for (const auto& format : report_formats())
        if (!format->is_written_unasked() ||
            std::find(formats_.begin(), formats_.end(), format.get()) != formats_.end())
            for (auto& file : format->earlier_files(path_))
                files.push_back(std::move(file));
    return files;
}

void ReportDirectory::lock() {
    lock_ = uncut([&] { return open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
    if (lock_ < 0 || uncut([&] { return flock(lock_, LOCK_EX | LOCK_NB); }) != 0) {
        const std::string reason = std::generic_category().message(errno);
        const bool taken = lock_ >= 0 && errno == EWOULDBLOCK;
        throw OutputError("cannot write to '" + path_.string() + "': " +
                          (taken ? "another tvbeam is writing there; wait for it, or name another "
                                   "directory"
                                 : reason));
    }
}

std::string ReportDirectory::write(const Reported& result) {
    const auto any = [this](bool (ReportFormat::*asks)() const) {
        return std::any_of(formats_.begin(), formats_.end(),
                           [asks](const auto* format) { return (format->*asks)(); });
    };
    const auto plots = any(&ReportFormat::describes_plots) ? result.plots() : std::vector<Plot>();
    const DrawnPlots drawn =
        plots.empty() || !any(&ReportFormat::shows_plots) ? DrawnPlots() : draw(plots);
    std::list<OutputFile> files;
    std::set<std::string> written;
    for (const auto* format : formats_)
        for (const auto& [name, text] : format->write({result, plots, drawn})) {
            files.emplace_back(path_ / name).prepare(text);
            written.insert(name);
        }
    auto earlier = earlier_files(); // by what is replaced
    publish(files);
    for (auto& file : earlier_files()) // beside what is new
        earlier.push_back(std::move(file));
    std::error_code ignored;
    for (const auto& file : earlier)
        if (!written.contains(file) && !result.directories.contains(*file.begin()))
            std::filesystem::remove(path_ / file, ignored);
    if (drawn.failure.empty())
        return "";
    const bool are_described =
        std::ranges::any_of(written, [](const auto& name) { return name.starts_with("plots/"); });
    return drawn.failure + "; the pictures are left out" +
           (are_described ? ", their scripts and data are in '" + (path_ / "plots").string() + "'"
                          : "");
}

} // namespace tvbeam

#include "reports/command_line/commands/record.hpp"

#include "reports/files/file_lock.hpp"

#include <filesystem>
#include <system_error>

namespace tvbeam {

namespace {

/// Standard output, a device and a pipe hold nothing.
bool holds_nothing(const std::string& name) {
    std::error_code error;
    return name == "-" ||
           (std::filesystem::exists(name, error) && !std::filesystem::is_regular_file(name, error));
}

} // namespace

Record::Record(const std::string& file)
    : file_(holds_nothing(file) ? "" : file), destination_(destination(file)),
      earlier_(earlier_baseline(file_)) {}

void Record::write(const std::vector<BaselineEntry>& entries) {
    std::optional<FileLock> lock;
    if (!file_.empty())
        lock.emplace(file_);
    destination_.write(baseline_of(entries, file_));
}

} // namespace tvbeam

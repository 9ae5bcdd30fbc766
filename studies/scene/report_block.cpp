#include "studies/scene/report_block.hpp"

#include "mms/text/nearest_name.hpp"
#include "studies/scene/toml_reader.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

/// In the order of ReportFile.
const std::vector<std::string>& names() {
    static const std::vector<std::string> all{"json", "csv", "markdown", "latex", "plots", "html"};
    return all;
}

ReportFile file_named(const TableReader& table, const std::string& name, std::size_t index) {
    const auto found = std::find(names().begin(), names().end(), name);
    if (found != names().end())
        return static_cast<ReportFile>(found - names().begin());
    std::string list;
    for (const auto& known : names())
        list += (list.empty() ? "'" : ", '") + known + "'";
    throw InputError(table.place("files", index), table.full("files") + " names '" + name +
                                                      "'; known are " + list +
                                                      did_you_mean(name, names()));
}

} // namespace

bool ReportBlock::wants(ReportFile file) const {
    return std::find(files.begin(), files.end(), file) != files.end();
}

ReportBlock read_report(TableReader table) {
    ReportBlock report;
    if (const auto wanted = table.texts("files")) {
        report.files.clear();
        for (std::size_t i = 0; i < wanted->size(); ++i) {
            const ReportFile file = file_named(table, (*wanted)[i], i);
            if (report.wants(file))
                throw InputError(table.place("files", i), table.full("files") + " names '" +
                                                              (*wanted)[i] + "' twice; remove one");
            report.files.push_back(file);
        }
        if (report.files.empty())
            throw InputError(table.place("files"),
                             table.full("files") + " is empty; name what --out is to write, e.g. "
                                                   "[\"html\"], or leave it out for all");
    }
    table.finish();
    return report;
}

} // namespace tvbeam

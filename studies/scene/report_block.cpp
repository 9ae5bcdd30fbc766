#include "studies/scene/report_block.hpp"

#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tvbeam {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

bool ReportBlock::names(const std::string& file) const {
    return contains(files, file);
}

ReportBlock read_report(TableReader table, const std::vector<std::string>& known) {
    ReportBlock report;
    if (const auto wanted = table.texts("files")) {
        for (std::size_t i = 0; i < wanted->size(); ++i) {
            const std::string& name = (*wanted)[i];
            if (!known.empty() && !contains(known, name))
                throw table.error("files",
                                  fmt::format(" names '{}'; known are '{}'{}", name,
                                              fmt::join(known, "', '"), did_you_mean(name, known)),
                                  i);
            if (report.names(name))
                throw table.error("files", " names '" + name + "' twice; remove one", i);
            report.files.push_back(name);
        }
        if (report.files.empty())
            throw table.error("files", " is empty; name what --out is to write, e.g. "
                                       "[\"html\"], or leave it out for all but pgfplots");
    }
    table.finish();
    return report;
}

} // namespace tvbeam

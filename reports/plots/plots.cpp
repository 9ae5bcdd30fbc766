#include "reports/studies/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace tvbeam {

namespace {

std::string file_part(std::string name) {
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

} // namespace

std::vector<Plot> with_file_names(std::vector<Plot> plots) {
    std::set<std::string> taken;
    for (const auto& plot : plots)
        if (file_part(plot.name) == plot.name)
            taken.insert(plot.name);
    for (auto& plot : plots) {
        const std::string name = file_part(plot.name);
        if (name == plot.name)
            continue;
        plot.name = name;
        for (int number = 2; !taken.insert(plot.name).second; ++number)
            plot.name = fmt::format("{}_{}", name, number);
    }
    return plots;
}

std::vector<Plot> plots_of(const StudyResult& result) {
    std::vector<Plot> all;
    for (const auto* report : reports_of(result))
        for (auto& plot : report->plots(result))
            all.push_back(std::move(plot));
    return with_file_names(std::move(all));
}

} // namespace tvbeam

#include "reports/studies/study_report.hpp"

namespace tvbeam {

std::vector<Plot> plots_of(const StudyResult& result) {
    std::vector<Plot> all;
    for (const auto* report : reports_of(result))
        for (auto& plot : report->plots(result))
            all.push_back(std::move(plot));
    return all;
}

} // namespace tvbeam

#include "reports/studies/study_report.hpp"

#include <algorithm>

namespace tvbeam {

constexpr RowMaker<StudyReport> reports[] = {
    make_row<StudyReport, struct LadderReport>,
    make_row<StudyReport, struct OrdersReport>,
    make_row<StudyReport, struct WorkPrecisionReport>,
    make_row<StudyReport, struct EvolutionReport>,
    make_row<StudyReport, struct StressReport>,
    make_row<StudyReport, struct SensitivityReport>,
};

const RowsOf<StudyReport>& study_reports() {
    static const auto all = made_of(reports);
    return all;
}

const StudyReport& report_of(const StudyKind& kind) {
    return **std::find_if(study_reports().begin(), study_reports().end(),
                          [&](const auto& report) { return report->study() == kind.name(); });
}

std::vector<const StudyReport*> reports_of(const StudyResult& result) {
    std::vector<const StudyReport*> all;
    for (const auto& [kind, record] : result.records.entries())
        all.push_back(&report_of(*kind));
    return all;
}

} // namespace tvbeam

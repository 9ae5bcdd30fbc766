#pragma once

#include "reports/document/document.hpp"
#include "reports/files/long_text.hpp"
#include "reports/plots/plot.hpp"
#include "studies/study.hpp"
#include "studies/table_rows.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// The table of one study as CSV (RFC 4180, but with \n): numbers read back to the same doubles, an
/// undefined number is an empty field.
struct StudyCsv {
    std::string name; ///< of its file without .csv: that of the study, or of a part of it
    LongText text;
};

/// What reports say of one kind of study, from the record that a result has of it.
class StudyReport {
public:
    virtual ~StudyReport() = default;

    [[nodiscard]] virtual std::string study() const = 0; ///< StudyKind::name

    [[nodiscard]] virtual std::vector<Section> sections(const StudyResult& result) const = 0;
    [[nodiscard]] virtual nlohmann::ordered_json json(const StudyResult& result) const = 0;
    [[nodiscard]] virtual std::vector<StudyCsv> csvs(const StudyResult& result) const = 0;
    [[nodiscard]] virtual std::vector<Plot> plots(const StudyResult& /*result*/) const {
        return {};
    }

    /// Names of its CSV files, and what the first line of each begins with.
    [[nodiscard]] virtual std::vector<std::pair<std::string, std::string>> csv_heads() const = 0;
};

/// One for every kind of study.
const RowsOf<StudyReport>& study_reports();

/// That of a kind of study.
const StudyReport& report_of(const StudyKind& kind);

/// Those of the studies that a result has records of, in their order.
std::vector<const StudyReport*> reports_of(const StudyResult& result);

} // namespace tvbeam

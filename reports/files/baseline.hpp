#pragma once

#include "studies/data/data_analysis.hpp"
#include "studies/gates/check.hpp"
#include "studies/study.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Figures by name that a baseline keeps: of a scene, the errors of every run and the figures() of
/// its studies that are above round-off; of a table, its numbers. NaN: the run failed.
struct BaselineEntry {
    std::string name;
    Place place; ///< for messages
    std::map<std::string, double> figures;
};
BaselineEntry baseline_entry(const StudyResult& result);

/// Throws InputError where the clock decides which runs a scene makes: no digits of another attempt
/// can be held against it.
void require_recordable(const Scene& scene);
BaselineEntry baseline_entry(const DataAnalysis& analysis);

/// Entries as JSON (schema tvbeam-baseline/1), to hold later runs against. earlier: an earlier
/// baseline, whose entries of other names stay; empty: none. Throws InputError where two have one
/// name, or one has nothing to keep.
std::string baseline_of(const std::vector<BaselineEntry>& entries, const std::string& earlier = {});

/// What stands in a file that a baseline is to be recorded in: a baseline, or nothing. Throws
/// InputError where it is something else.
std::string earlier_baseline(const std::string& file);

/// A recorded baseline.
class Baseline {
public:
    /// Throws InputError when the file is missing or is not a baseline.
    explicit Baseline(const std::string& file);

    /// Holds new figures against what was recorded by their name: every error within the relative
    /// tolerance of the recorded one, on both sides. A scene, run or norm that was not recorded, or
    /// that is not there any more, does not hold. The figures found are always those of the new
    /// result.
    [[nodiscard]] std::vector<CheckedExpectation> check(const BaselineEntry& entry,
                                                        double tolerance) const;

private:
    /// What stands for a figure: its number, or none where the run failed.
    struct Recorded {
        std::optional<double> number;
        std::string text;
    };

    std::string file_;
    std::map<std::string, std::map<std::string, Recorded>> scenes_;
};

} // namespace tvbeam

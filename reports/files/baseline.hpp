#pragma once

#include "mms/text/input_error.hpp"
#include "studies/data/data_analysis.hpp"
#include "studies/gates/check.hpp"
#include "studies/study.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tvbeam {

/// Figures by name that a baseline keeps: of a scene, the errors of every run and the figures() of
/// its studies that are above round-off; of a table, its numbers. NaN: the run failed.
struct BaselineEntry {
    std::string name;
    Place place; ///< for messages
    std::map<std::string, double> figures;
    /// Of figures that are rounding, what they are below: another processor has others.
    std::map<std::string, double> rounding = {};
    /// Figures of runs that were not made: a record of before this was kept may have them as none.
    std::set<std::string> not_made = {};
    std::string said = {}; ///< all that the result says (said_result.hpp), as JSON; empty: not kept
    std::string file = {}; ///< that it is of; empty: of none, as of standard input
    bool is_table = false; ///< of which columns are chosen call by call
};
BaselineEntry baseline_entry(const StudyResult& result);

/// With all that the result says and its expectations looked at.
BaselineEntry whole_entry(const StudyResult& result,
                          const std::vector<CheckedExpectation>& checked);

/// Throws InputError where the clock decides which runs a scene makes: no digits of another attempt
/// can be held against it.
void require_recordable(const Scene& scene);

/// Its name is that of the file, with DataAnalysis::chosen as options: t.csv --where scheme=Euler.
BaselineEntry baseline_entry(const DataAnalysis& analysis);

/// Adds a name; throws InputError where it is there already: a baseline goes by them.
void require_another_name(std::set<std::string>& names, const std::string& name,
                          const Place& place);

/// Entries as JSON (schema tvbeam-baseline/1), to hold later runs against, with the files that they
/// are of, relative to the folder of the baseline. file: that they are to be recorded in, whose
/// entries of other names stay; empty: none. Throws InputError where two have one name, one has
/// nothing to keep, or the file has no room for it.
std::string baseline_of(const std::vector<BaselineEntry>& entries, const std::string& file = {});

/// A recorded baseline.
class Baseline {
public:
    /// Throws InputError when the file is missing or is not a baseline.
    explicit Baseline(const std::string& file);

    /// Holds new figures against what was recorded by their name: every error within the relative
    /// tolerance of the recorded one, on both sides, or rounding as that was. A scene, run or norm
    /// that was not recorded, or that is not there any more, does not hold. The figures found are
    /// always those of the new result. Of what it says besides (held_values.hpp) only what does not
    /// hold is told.
    [[nodiscard]] std::vector<CheckedExpectation> check(const BaselineEntry& entry,
                                                        double tolerance) const;

    /// Throws InputError where an entry would take the place of what it does not replace: numbers
    /// alone that of all that a result says; what is of one file that of another of the same name,
    /// which is still there; a table the figures of columns and widths that it leaves out.
    void require_room(const BaselineEntry& entry) const;

    /// Whether what the scene says was recorded, too.
    [[nodiscard]] bool has_said(const std::string& scene) const { return said_.contains(scene); }

private:
    void require_same_file(const BaselineEntry& entry) const;
    void require_same_columns(const BaselineEntry& entry) const;

    /// What stands for a figure: its number, or none where the run failed.
    struct Recorded {
        std::optional<double> number;
        std::string text;
    };

    std::string file_;
    std::map<std::string, std::map<std::string, Recorded>> scenes_;
    std::map<std::string, std::string> said_;  ///< BaselineEntry::said
    std::map<std::string, std::string> files_; ///< as they stand in it
};

/// What stands in a file that a baseline is to be recorded in: a baseline, or nothing. Throws
/// InputError where it is something else.
std::optional<Baseline> earlier_baseline(const std::string& file);

} // namespace tvbeam

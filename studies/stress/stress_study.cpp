#include "mms/text/toml_reader.hpp"
#include "studies/stress/stress.hpp"
#include "studies/study_kind.hpp"
#include "studies/table_row.hpp"

#include <algorithm>

namespace tvbeam {

/// The block [stress], whose cases bring their own beams, schemes and problems.
struct StressStudy final : KindOf<StressBlock, StressResult> {
    std::string name() const override { return "stress"; }
    bool poses_problem() const override { return false; }

    std::any read(TableReader& table, const SolverKeys& /*keys*/) const override {
        return read_stress(table);
    }
    /// Of the cases; a contraction map and a round-off table aside.
    double work(const std::any& block, const Method& /*own*/) const override {
        double work = 0.0;
        for (const auto& sweep : block_in(block).sweeps)
            for (const auto& parameters : sweep.cases)
                work += work_of(parameters);
        return work;
    }
    std::any run(const std::any& block, const StudyContext& context) const override {
        return run_stress(block_in(block), context.execution);
    }
    Ending ending(const std::any& record) const override {
        const auto failed =
            std::find_if(record_in(record).cases.begin(), record_in(record).cases.end(),
                         [](const StressCase& one) { return one.outcome == Outcome::failed; });
        return {.failed = record_in(record).failed(),
                .interrupted = record_in(record).interrupted,
                .reason = failed == record_in(record).cases.end() ? "" : failed->reason};
    }
    std::map<std::string, double> figures(const std::any& record) const override {
        return record_in(record).figures();
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, StressStudy>();

} // namespace tvbeam

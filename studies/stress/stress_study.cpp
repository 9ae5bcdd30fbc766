#include "mms/text/toml_reader.hpp"
#include "studies/stress/stress.hpp"
#include "studies/study_kind.hpp"
#include "studies/table_row.hpp"

namespace tvbeam {

/// The block [stress], whose cases bring their own beams, schemes and problems.
struct StressStudy final : KindOf<StressBlock, StressResult> {
    std::string name() const override { return "stress"; }
    bool poses_problem() const override { return false; }

    std::any read(TableReader& table, const SolverKeys& /*keys*/) const override {
        return read_stress(table);
    }
    double work(const std::any& block, const Method& /*own*/) const override {
        double work = 0.0;
        for (const auto& parts : parts_of(block_in(block)))
            for (std::size_t i = 0; i < parts.count; ++i)
                work += parts.work(i);
        return work;
    }
    std::vector<Parts> parts(const std::any& block) const override {
        return parts_of(block_in(block));
    }
    std::any run(const std::any& block, const StudyContext& context) const override {
        return run_stress(block_in(block), context.execution);
    }
    Ending ending(const std::any& record) const override {
        return {.failed = record_in(record).failed(),
                .interrupted = record_in(record).interrupted,
                .reason = record_in(record).cases.first_failure()};
    }
    std::map<std::string, double> figures(const std::any& record) const override {
        return record_in(record).figures();
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, StressStudy>();

} // namespace tvbeam

#include "mms/text/toml_reader.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study_kind.hpp"
#include "studies/table_row.hpp"

namespace tvbeam {

/// The block [evolution].
struct EvolutionStudy final : KindOf<EvolutionBlock, EvolutionResult> {
    std::string name() const override { return "evolution"; }

    std::any read(TableReader& table, const SolverKeys& /*keys*/) const override {
        return read_evolution(table);
    }
    std::vector<Series> series(const std::any& block, const Method& own) const override {
        return {{"evolution", block_in(block).final_time, own, {}, {block_in(block).rung}}};
    }
    Needs needs(const std::any& block, const StudyContext& context) const override {
        return needs_of(block_in(block), context.scene.beam.stops);
    }
    std::any run(const std::any& block, const StudyContext& context) const override {
        return run_evolution(context.scene, block_in(block), context.data, context.execution);
    }
    Ending ending(const std::any& record) const override {
        return {.failed = record_in(record).run.status != RungStatus::ok,
                .interrupted = record_in(record).run.status == RungStatus::interrupted,
                .reason = record_in(record).run.reason};
    }
    std::map<std::string, double> figures(const std::any& record) const override {
        return record_in(record).figures();
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, EvolutionStudy>();

} // namespace tvbeam

#include "mms/text/toml_reader.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/runs/defects.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study.hpp"
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
        return run_evolution(context.scene, block_in(block),
                             context.defects.added_to(context.data, block_in(block).rung),
                             context.execution);
    }
    Ending ending(const std::any& record) const override {
        return {.failed = record_in(record).run.status != RungStatus::ok,
                .interrupted = record_in(record).run.status == RungStatus::interrupted,
                .failures = record_in(record).run.status == RungStatus::failed ? 1 : 0,
                .reason = record_in(record).run.reason};
    }
    std::map<std::string, double> figures(const std::any& record) const override {
        return record_in(record).figures();
    }
    void expect(TableReader& table, const std::any& block,
                std::vector<Expectation>& expectations) const override {
        expect_words(table, "events", expectations, [](const StudyResult& result) {
            std::vector<std::string> events;
            for (const auto& event : result.get<EvolutionResult>()->events)
                events.push_back(name_of(event.kind) + " " + name_of(event.stop));
            return events;
        });
        StudyKind::expect(table, block, expectations);
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, EvolutionStudy>();

} // namespace tvbeam

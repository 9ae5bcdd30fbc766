#include "mms/text/toml_reader.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study.hpp"
#include "studies/study_kind.hpp"
#include "studies/table_row.hpp"
#include "studies/work_precision/sooner_expectation.hpp"
#include "studies/work_precision/work_precision.hpp"

namespace tvbeam {

/// The block [work_precision].
struct WorkPrecisionStudy final : KindOf<WorkPrecisionBlock, WorkPrecisionResult> {
    std::string name() const override { return "work_precision"; }
    bool measures() const override { return true; }
    bool timed() const override { return true; }

    std::any read(TableReader& table, const SolverKeys& keys) const override {
        return read_work_precision(table, keys);
    }
    std::vector<Series> series(const std::any& block, const Method& /*own*/) const override {
        return series_of(block_in(block));
    }
    /// With norms, to warm up, and timed.
    double work(const std::any& block, const Method& own) const override {
        return (block_in(block).runs + 2) * StudyKind::work(block, own);
    }
    std::any run(const std::any& block, const StudyContext& context) const override {
        auto result = run_work_precision(block_in(block), context.solver, context.execution);
        if (context.scene.solver) // a program may wait for what is not the processor
            result.busy_remark.clear();
        return result;
    }
    Runs runs(const std::any& record) const override {
        Runs runs;
        for (const auto& scheme : record_in(record).schemes)
            runs.push_back(&scheme.runs);
        return runs;
    }
    Ending ending(const std::any& record) const override {
        Ending ending = StudyKind::ending(record);
        ending.interrupted = ending.interrupted || record_in(record).interrupted;
        return ending;
    }
    void expect(TableReader& table, const std::any& block,
                std::vector<Expectation>& expectations) const override {
        const auto record = [](const StudyResult& result) -> const WorkPrecisionResult& {
            return *result.get<WorkPrecisionResult>();
        };
        for (const auto& scheme : block_in(block).schemes)
            if (table.is_table(scheme.name))
                table.require_free(scheme.name);
        expect_sooner(table, block_in(block), record, expectations);
        const auto all = series_of(block_in(block));
        for (std::size_t i = 0; i < all.size(); ++i)
            if (auto scheme = table.table(block_in(block).schemes[i].name)) {
                const std::size_t before = expectations.size();
                require_free_names(*scheme, block_in(block).norms);
                expect_counters(*scheme, all[i], expectations);
                for_each_measure(*scheme, block_in(block).norms, expectations,
                                 [&](TableReader& norm, std::size_t k) {
                                     expect_orders(norm, all[i], k, expectations);
                                     expect_errors(norm, all[i], k, expectations);
                                 });
                finish_expecting(*scheme, before, expectations);
            }
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, WorkPrecisionStudy>();

} // namespace tvbeam

#include "mms/text/toml_reader.hpp"
#include "studies/runs/defects.hpp"
#include "studies/scene/model_keys.hpp"
#include "studies/sensitivity/sensitivity.hpp"
#include "studies/study.hpp"
#include "studies/table_row.hpp"

namespace tvbeam {

namespace {

SensitivityBlock read_sensitivity(TableReader& table) {
    SensitivityBlock block;
    if (const auto range = table.band("range", " of factors > 0")) {
        block.smallest = range->lowest;
        block.largest = range->highest;
        if (!(block.smallest > 0.0))
            throw table.error("range", " must be two factors > 0");
    }
    if (auto defects = table.table("defect"))
        for (const auto& name : defects->unread())
            block.defects.push_back({name, read_defect(*defects->table(name))});
    if (block.defects.empty())
        throw InputError(table.place(), "the block has no defect; give one as "
                                        "[sensitivity.defect.NAME], with the keys of [defect]");
    table.finish();
    return block;
}

} // namespace

/// The block [sensitivity], which runs when all others have.
struct SensitivityStudy final : KindOf<SensitivityBlock, SensitivityResult> {
    std::string name() const override { return "sensitivity"; }
    bool poses_problem() const override { return false; }
    bool judges_expectations() const override { return true; }

    std::any read(TableReader& table, const SolverKeys& /*keys*/) const override {
        return read_sensitivity(table);
    }
    std::any run(const std::any& /*block*/, const StudyContext& context) const override {
        // What cannot be is refused before anything else runs.
        for (const auto& defect : context.scene.get<SensitivityBlock>()->defects)
            Defects(defect.adds, context.scene);
        return SensitivityResult{};
    }
    void conclude(const std::any& block, std::any& record, const StudyResult& all,
                  const StudyContext& context) const override {
        if (!all.interrupted())
            record = find_sensitivity(block_in(block), all, context);
    }
    Ending ending(const std::any& record) const override {
        return {.failed = false, .interrupted = record_in(record).interrupted, .reason = {}};
    }
    /// The least factor that is caught; 0 where that may be any below the smallest that is tried.
    std::map<std::string, double> figures(const std::any& record) const override {
        const SensitivityResult& result = record_in(record);
        std::map<std::string, double> figures;
        const auto add = [&](const std::string& name, const std::optional<double>& least) {
            if (least)
                figures[name] = *least > result.smallest ? *least : 0.0;
        };
        for (const auto& defect : result.defects) {
            add(defect.name, defect.least_of_all());
            for (std::size_t i = 0; i < defect.least.size(); ++i)
                add(defect.name + ", " + result.expectations[i], defect.least[i]);
        }
        return figures;
    }
};

template std::unique_ptr<const StudyKind> make_row<StudyKind, SensitivityStudy>();

} // namespace tvbeam

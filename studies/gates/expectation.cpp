#include "studies/gates/expectation.hpp"

#include "studies/scene/scene.hpp"
#include "studies/scene/toml_reader.hpp"

namespace tvbeam {

namespace {

using Figure = Expectation::Figure;

void add(std::vector<Expectation>& expectations, TableReader& table, const char* key, Figure figure,
         const std::string& study, const std::string& norm) {
    if (const auto band = table.band(key))
        expectations.push_back(
            {figure, study, norm, 0, band->lowest, band->highest, table.place(key)});
}

void add_errors(std::vector<Expectation>& expectations, TableReader& table,
                const std::string& study, const std::string& norm, std::size_t rungs) {
    const double within = table.number("within").value_or(1e-3);
    if (!(within > 0.0 && within < 1.0))
        throw InputError(table.place("within"),
                         table.full("within") + " must be a part between 0 and 1");
    const auto errors = table.numbers("errors");
    if (!errors)
        return;
    if (errors->size() != rungs)
        throw InputError(table.place("errors"),
                         table.full("errors") + " has " + std::to_string(errors->size()) +
                             " values for " + std::to_string(rungs) + " rungs; give one a rung");
    for (std::size_t i = 0; i < rungs; ++i)
        expectations.push_back({Figure::error, study, norm, i, (*errors)[i] * (1.0 - within),
                                (*errors)[i] * (1.0 + within), table.place("errors", i)});
}

void add_ratios(std::vector<Expectation>& expectations, TableReader& table, const std::string& norm,
                const LadderBlock& ladder) {
    const auto bands = table.bands("ratios");
    if (!bands)
        return;
    if (!ladder.printed || !ladder.printed->figures.contains(norm))
        throw InputError(table.place("ratios"), table.full("ratios") +
                                                    " compares with printed figures, but "
                                                    "ladder.printed has none for " +
                                                    norm);
    const std::size_t rungs = ladder.rungs.size();
    if (bands->size() != 1 && bands->size() != rungs)
        throw InputError(table.place("ratios"), table.full("ratios") + " has " +
                                                    std::to_string(bands->size()) + " bands for " +
                                                    std::to_string(rungs) +
                                                    " rungs; give one for all, or one a rung");
    for (std::size_t i = 0; i < rungs; ++i) {
        const auto& band = (*bands)[bands->size() == 1 ? 0 : i];
        expectations.push_back(
            {Figure::ratio, "ladder", norm, i, band.lowest, band.highest, table.place("ratios")});
    }
}

/// The names by which a study's norms stand in [expect].
std::vector<std::string> names_of(const std::vector<Norm>& norms, bool roots) {
    std::vector<std::string> names;
    names.reserve(norms.size());
    for (const auto& norm : norms)
        names.push_back(roots ? norm.root() : norm.name);
    return names;
}

template <typename Read>
void for_each_norm(TableReader& expect, const char* study, const std::vector<std::string>& measured,
                   const Read& read) {
    auto block = expect.table(study);
    if (!block)
        return;
    if (measured.empty())
        throw InputError(expect.place(study), expect.full(study) +
                                                  " expects something of a study that the scene "
                                                  "does not run: it has no block [" +
                                                  study + "] with norms");
    for (const auto& name : measured)
        if (auto table = block->table(name)) {
            read(*table, name);
            table->finish();
        }
    block->finish();
}

void add_work_precision(std::vector<Expectation>& expectations, TableReader& expect,
                        const WorkPrecisionBlock* timed) {
    auto block = expect.table("work_precision");
    if (!block)
        return;
    if (timed == nullptr)
        throw InputError(expect.place("work_precision"),
                         expect.full("work_precision") +
                             " expects something of a study that the scene does not run: it has no "
                             "block [work_precision]");
    for (const auto& scheme : timed->schemes)
        for_each_norm(*block, scheme.name.c_str(), names_of(timed->norms, false),
                      [&](TableReader& table, const std::string& norm) {
                          const std::string study = "work_precision." + scheme.name;
                          add(expectations, table, "orders", Figure::order, study, norm);
                          add_errors(expectations, table, study, norm, scheme.rungs.size());
                      });
    block->finish();
}

} // namespace

std::vector<Expectation> read_expectations(TableReader table, const LadderBlock* ladder,
                                           const OrdersBlock* orders,
                                           const WorkPrecisionBlock* timed,
                                           const std::vector<std::string>& figured) {
    // A study that the scene does not run measures no norm.
    const LadderBlock no_ladder;
    const OrdersBlock no_orders;
    const LadderBlock& rungs = ladder != nullptr ? *ladder : no_ladder;
    const OrdersBlock& grid = orders != nullptr ? *orders : no_orders;
    std::vector<Expectation> expectations;
    for_each_norm(table, "ladder", names_of(rungs.norms, false),
                  [&](TableReader& norm_table, const std::string& norm) {
                      add(expectations, norm_table, "orders", Figure::order, "ladder", norm);
                      add_ratios(expectations, norm_table, norm, rungs);
                      add_errors(expectations, norm_table, "ladder", norm, rungs.rungs.size());
                      add(expectations, norm_table, "predicted", Figure::predicted, "ladder", norm);
                  });
    for_each_norm(table, "orders", names_of(grid.norms, true),
                  [&](TableReader& norm_table, const std::string& norm) {
                      const auto add_band = [&](const char* key, Figure figure) {
                          add(expectations, norm_table, key, figure, "orders", norm);
                      };
                      add_band("p", Figure::p);
                      add_band("q", Figure::q);
                      add_band("a", Figure::a);
                      add_band("b", Figure::b);
                      add_band("rho", Figure::rho);
                      if (norm == "corollary")
                          add_band("constant", Figure::constant);
                  });
    add_work_precision(expectations, table, timed);
    for (const auto& study : figured)
        if (auto figures = table.table(study)) {
            for (const auto& name : figures->keys())
                add(expectations, *figures, name.c_str(), Figure::named, study, name);
            figures->finish();
        }
    table.finish();
    return expectations;
}

} // namespace tvbeam

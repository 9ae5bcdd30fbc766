#include "studies/ladder/ladder_block.hpp"

#include "mms/text/toml_reader.hpp"

namespace tvbeam {

namespace {

PublishedFigures read_printed(TableReader table, const LadderBlock& ladder,
                              const SolverKeys& keys) {
    PublishedFigures printed;
    printed.source = table.text("source").value_or("published");
    printed.figures = read_by_measure(
        table, keys, ladder.norms, [&](const std::string& name, const std::vector<double>& list) {
            if (list.size() != ladder.rungs.size())
                throw table.error(name, " has " + std::to_string(list.size()) + " values for " +
                                            std::to_string(ladder.rungs.size()) +
                                            " levels; give one a level, or none: --set " +
                                            table.full("").substr(0, table.full("").size() - 1) +
                                            "={}");
        });
    return printed;
}

} // namespace

LadderBlock read_ladder(TableReader& table, const SolverKeys& keys) {
    LadderBlock ladder;
    ladder.final_time = read_final_time(table);
    ladder.rungs = read_rungs(table, ladder.final_time);
    ladder.norms = read_norms(table, keys);
    if (auto printed = table.table("printed"))
        ladder.printed = read_printed(*std::move(printed), ladder, keys);
    table.finish();
    return ladder;
}

} // namespace tvbeam

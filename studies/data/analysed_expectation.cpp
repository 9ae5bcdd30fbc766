#include "studies/data/analysed_expectation.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/data/data_check.hpp"
#include "studies/scene/scene.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

constexpr std::size_t most_tables = 200;

DataChoice read_choice(TableReader& table) {
    DataChoice choice;
    choice.sizes = table.texts("size").value_or(choice.sizes);
    choice.dimension = table.number("dimension");
    if (choice.dimension && !(*choice.dimension > 0.0))
        throw table.error("dimension",
                          " is " + message_text(*choice.dimension) + "; it must be > 0");
    choice.step = table.text("step");
    choice.errors = table.texts("error").value_or(choice.errors);
    choice.values = table.texts("value").value_or(choice.values);
    choice.sigma = table.text("sigma");
    choice.where = table.texts("where").value_or(choice.where);
    return choice;
}

/// What an analysis comes to, with what it assumed beside what it found and was not to be.
std::vector<CheckedExpectation> checked_analysis(const DataAnalysis& analysis,
                                                 const NamedToml& holds) {
    auto checked = check(analysis, holds);
    for (auto& one : checked)
        for (const auto& remark : analysis.remarks)
            if (!one.holds)
                one.found += " (" + remark + ")";
    if (!checked.empty())
        checked.front().analysed = std::make_shared<const DataAnalysis>(analysis);
    return checked;
}

/// A table is what another program wrote: one that is none violates what is expected of it.
CheckedExpectation no_table(const InputError& error) {
    return {.what = "table",
            .expected = "a table that can be analysed",
            .found = error.what(),
            .place = {},
            .holds = false,
            .examined = error.what()};
}

} // namespace

void expect_analysed(TableReader& expect, const Scene& scene,
                     std::vector<Expectation>& expectations) {
    auto tables = expect.tables("analyse");
    if (tables.size() > most_tables)
        throw expect.error("analyse", " has " + std::to_string(tables.size()) +
                                          " tables; at most " + std::to_string(most_tables) +
                                          " are analysed");
    for (auto& table : tables) {
        const auto file = table.text("file");
        if (!file || file->empty())
            throw table.error("file",
                              " is missing or empty; name the table, relative to the scene");
        const auto holds = table.text("holds");
        if (!holds)
            throw table.error("holds", " is missing; give what is expected of the columns, as "
                                       "'L2.order = [1.9, 2.1]'");
        const NamedToml expected{*holds, scene.file + ": " + table.full("holds")};
        parse_toml(expected.text, expected.name); // is refused before anything is read
        const DataChoice choice = read_choice(table);
        table.finish();

        const std::filesystem::path folder = std::filesystem::path(scene.file).parent_path();
        const auto path = (folder.empty() ? "." : folder) / *file;
        std::optional<DataAnalysis> analysis;
        std::vector<CheckedExpectation> checked;
        try {
            std::error_code ignored;
            if (!std::filesystem::is_regular_file(path, ignored))
                throw InputError({path.string()}, "is no regular file, or there is none");
            analysis = analyse(read_data(path.string(), choice));
        } catch (const InputError& error) {
            checked = {no_table(error)};
        }
        if (analysis)
            checked = checked_analysis(*analysis, expected);
        for (auto& one : checked) {
            one.what = what_of(table, "holds") + ", " + *file + ": " + one.what;
            one.place = table.place("holds");
        }
        expectations.push_back(
            [checked = std::move(checked)](const StudyResult& /*result*/) { return checked; });
    }
}

} // namespace tvbeam

#include "studies/data/analysed_expectation.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/data/data_check.hpp"
#include "studies/scene/scene.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

namespace tvbeam {

namespace {

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
    return choice;
}

} // namespace

void expect_analysed(TableReader& expect, const Scene& scene,
                     std::vector<Expectation>& expectations) {
    const auto folder = std::filesystem::path(scene.file).parent_path();
    for (auto& table : expect.tables("analyse")) {
        const auto file = table.text("file");
        if (!file || file->empty())
            throw table.error("file",
                              " is missing or empty; name the table, relative to the scene");
        const auto path = folder / *file;
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(path, ignored))
            throw table.error("file",
                              " is '" + *file + "', and there is no regular file " + path.string());
        const DataAnalysis analysis = analyse(read_data(path.string(), read_choice(table)));
        const auto holds = table.text("holds");
        if (!holds)
            throw table.error("holds", " is missing; give what is expected of the columns, as "
                                       "'L2.order = [1.9, 2.1]'");
        auto checked = check(analysis, {*holds, scene.file + ": " + table.full("holds")});
        for (auto& one : checked) {
            one.what = what_of(table, "holds") + ": " + one.what;
            one.place = table.place("holds");
        }
        table.finish();
        expectations.push_back(
            [checked = std::move(checked)](const StudyResult& /*result*/) { return checked; });
    }
}

} // namespace tvbeam

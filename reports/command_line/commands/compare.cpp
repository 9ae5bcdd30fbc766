#include "mms/text/visible_text.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/document/text_table.hpp"
#include "reports/files/compared_results.hpp"
#include "reports/files/output_file.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

/// Of what differs; the rest is counted.
constexpr std::size_t shown = 20;

std::string part_text(const std::string& heading, const std::vector<ResultDifference>& found) {
    if (found.empty())
        return {};
    std::string text = heading + "\n";
    for (std::size_t i = 0; i < std::min(shown, found.size()); ++i) {
        const ResultDifference& one = found[i];
        text += "  " +
                wrapped(fmt::format("{}: {} against {}{}", one.what, one.first.value_or("nothing"),
                                    one.second.value_or("nothing"),
                                    one.relative ? ", by a part of " + significant(*one.relative, 2)
                                                 : ""),
                        6);
    }
    if (found.size() > shown)
        text += fmt::format("  and {} more\n", found.size() - shown);
    return text;
}

int compare_command(const std::string& first, const std::string& second, double tolerance) {
    const ComparedResults compared = compare_results(first, second, tolerance);
    std::string text = part_text("What was asked for differs:", compared.scene) +
                       part_text("What was found differs, the most first:", compared.results);
    text += fmt::format("{} values are the same in both{}, {} differ\n", compared.equal,
                        tolerance > 0.0 ? fmt::format(" to a part of {}", tolerance) : "",
                        compared.results.size());
    for (const std::string& what : compared.not_compared)
        text += "not compared: " + wrapped(what, 2);
    write_standard_output(visible(text));
    return compared.results.empty() ? done : violated;
}

/// Not by CLI::Range, which lets nan pass.
const CLI::Validator part(
    [](std::string& text) {
        double value = 0.0;
        const bool holds = CLI::detail::lexical_cast(text, value) && value >= 0.0 && value <= 1.0;
        return holds ? std::string() : text + " is no part from 0 to 1";
    },
    "", "part");

} // namespace

Command add_compare(CLI::App& app) {
    auto* compare = app.add_subcommand(
        "compare", "Say what differs between two results, and by how much; exit 1 where something "
                   "that was found does. Run times are not compared.\n"
                   "Example: tvbeam compare before/result.json after/result.json");
    struct Files {
        std::string first;
        std::string second;
        double tolerance = 0.0;
    };
    const auto files = std::make_shared<Files>();
    compare->add_option("first", files->first, "a result.json, or the directory that holds it")
        ->required();
    compare->add_option("second", files->second, "the other")->required();
    compare
        ->add_option("--tolerance", files->tolerance,
                     "what was found is the same where it differs by at most this part")
        ->check(part)
        ->type_name("PART")
        ->capture_default_str();
    return {compare,
            [files] { return compare_command(files->first, files->second, files->tolerance); }};
}

} // namespace tvbeam

#include "mms/text/input_error.hpp"
#include "mms/text/nearest_name.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/key_reports.hpp"
#include "reports/files/output_file.hpp"
#include "studies/scene/scene_keys.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

int keys_command(const std::string& word) {
    const std::string text = keys_text(scene_keys(), word);
    if (text.empty()) {
        std::vector<std::string> words;
        for (const auto& entry : scene_keys().entries())
            words.push_back(entry.path.substr(entry.path.rfind('.') + 1));
        throw InputError({}, "no key of a scene has to do with '" + word + "'" +
                                 did_you_mean(word, words) + "; tvbeam keys lists all");
    }
    write_standard_output(text);
    return done;
}

} // namespace

Command add_keys(CLI::App& app) {
    auto* keys =
        app.add_subcommand("keys", "List the blocks and keys that a scene may have, with type, "
                                   "default and meaning.\nExample: tvbeam keys norms");
    const auto word = std::make_shared<std::string>();
    keys->add_option("word", *word, "only those with it in their names or meanings")
        ->type_name("WORD");
    const auto form = std::make_shared<std::string>("text");
    keys->add_option("--as", *form,
                     "names: those that --set takes, one a line; schema: a JSON schema, by which "
                     "editors complete and check scenes; manual: the page tvbeam-scene(5)")
        ->check(CLI::IsMember({"text", "names", "schema", "manual"}))
        ->type_name("FORM")
        ->excludes("word");
    return {keys, [word, form]() -> int {
                if (*form == "text")
                    return keys_command(*word);
                write_standard_output(*form == "names"    ? keys_names(scene_keys())
                                      : *form == "schema" ? keys_schema(scene_keys())
                                                          : keys_manual(scene_keys()));
                return done;
            }};
}

} // namespace tvbeam

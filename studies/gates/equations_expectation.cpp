#include "studies/gates/equations_expectation.hpp"

#include "mms/equations/code.hpp"
#include "mms/equations/system_checks.hpp"
#include "mms/equations/system_text.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/scene/scene.hpp"
#include "studies/scene/shipped.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

constexpr std::size_t most_systems = 200;

/// A file of equations, or the text of one, and what of it is asked for.
struct Asked {
    std::string file = "text"; ///< the name of the text, where there is one
    std::optional<std::string> text = {};
    std::optional<CodeLanguage> language = {}; ///< none: the report
};

struct Said {
    std::string text = {};
    std::vector<std::string> remarks = {};
    std::string refused = {}; ///< why; empty: it is not
};

Said said_of(const Asked& asked) {
    try {
        DerivedSystem derived =
            derive_system(asked.text ? parse_equation_system(*asked.text, asked.file)
                                     : read_equation_system(asked.file));
        Said said;
        if (!asked.language)
            for (const auto& remark : checked_system(derived))
                said.remarks.push_back(remark.text);
        said.text = asked.language ? system_code(derived, *asked.language) : system_text(derived);
        return said;
    } catch (const InputError& error) {
        return {.refused = error.what()};
    }
}

Asked read_asked(TableReader& table, const Scene& scene) {
    const auto file = table.text("file");
    Asked asked{.text = table.text("text")};
    if (file.has_value() == asked.text.has_value())
        throw table.error("", " must have a file of equations, or the text of one: give `file` or "
                              "`text`");
    const std::filesystem::path folder = std::filesystem::path(scene.file).parent_path();
    if (file)
        asked.file = find_file(Shipped::equations, *file, folder, table.place("file")).string();
    if (const auto language = table.choice("language", code_language_names()))
        asked.language = code_language(code_language_names()[*language]);
    return asked;
}

/// Words that not every text holds.
std::vector<std::string> read_words(TableReader& table, const std::string& key) {
    auto words = table.texts(key).value_or(std::vector<std::string>());
    for (std::size_t i = 0; i < words.size(); ++i)
        if (std::ranges::none_of(words[i],
                                 [](unsigned char letter) { return std::isalnum(letter); }))
            throw table.error(key, " must hold words of what is said", i);
    return words;
}

/// What one text of these words comes to, each an expectation of its own.
std::vector<CheckedExpectation> found_words(const Said& said, const std::vector<std::string>& words,
                                            bool refused, CheckedExpectation one) {
    const bool fits = said.refused.empty() != refused;
    const std::string& text = refused ? said.refused : said.text;
    std::vector<CheckedExpectation> checked;
    const std::string what = one.what;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& wanted = words[i];
        one.what = what + "." + std::to_string(i);
        one.expected = (refused ? "refused with \"" : "\"") + wanted + "\"";
        one.holds = fits && text.find(wanted) != std::string::npos;
        one.found = refused ? (fits ? said.refused : "that it is not refused")
                            : (fits ? "nothing of the kind" : said.refused);
        checked.push_back(one);
    }
    return checked;
}

} // namespace

void expect_equations(TableReader& expect, const Scene& scene,
                      std::vector<Expectation>& expectations) {
    auto tables = expect.tables("equations");
    if (tables.size() > most_systems)
        throw expect.error("equations", " has " + std::to_string(tables.size()) +
                                            " systems; at most " + std::to_string(most_systems) +
                                            " are derived");
    for (auto& table : tables) {
        const Asked asked = read_asked(table, scene);
        const auto says = read_words(table, "says");
        const auto refused = read_words(table, "refused");
        if (asked.language && (says.empty() || table.has("remarks")))
            throw table.error("language", " is of code, of which nothing but `says` is expected");
        if (refused.empty() == (says.empty() && !table.has("remarks")))
            throw table.error("", " must expect that it is `refused`, or else what it `says`, its "
                                  "`remarks`, or both");
        const bool is_refused = !refused.empty();
        const auto& words = is_refused ? refused : says;
        const std::string key = is_refused ? "refused" : "says";
        if (!words.empty())
            expectations.push_back(
                [asked, words, is_refused,
                 one = CheckedExpectation{what_of(table, key), "", "", table.place(key), false}](
                    const StudyResult& /*result*/) {
                    return found_words(said_of(asked), words, is_refused, one);
                });
        expect_sentences(table, "remarks", expectations, [asked](const StudyResult& /*result*/) {
            const Said said = said_of(asked);
            return said.refused.empty() ? said.remarks : std::vector{said.refused};
        });
        table.finish();
    }
}

} // namespace tvbeam

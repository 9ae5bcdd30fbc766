#include "studies/gates/equations_expectation.hpp"

#include "mms/equations/code.hpp"
#include "mms/equations/system_checks.hpp"
#include "mms/equations/system_text.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/scene/scene.hpp"
#include "studies/scene/shipped.hpp"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

constexpr std::size_t most_systems = 200;

/// A file of equations, or the text of one, and in which form it is asked for.
struct AskedSystem {
    std::string file = "text"; ///< the name of the text, where there is one
    std::optional<std::string> text = {};
    std::optional<CodeLanguage> language = {}; ///< none: the report
};

/// What is expected of it, with the place of each list and how it is called.
struct ExpectedOfSystem {
    std::vector<std::string> says;
    std::optional<std::vector<std::string>> remarks;
    std::vector<std::string> refused;
    std::map<std::string, std::pair<std::string, Place>> names;
};

struct Said {
    std::string text = {};
    std::string latex = {};
    std::vector<std::string> remarks = {};
    std::string refused = {}; ///< why, behind the name of the file; empty: it is not
};

Said said_of(const AskedSystem& asked) {
    try {
        DerivedSystem derived =
            derive_system(asked.text ? parse_equation_system(*asked.text, asked.file)
                                     : read_equation_system(asked.file));
        Said said;
        if (asked.language) {
            require_exact_values(derived);
            said.text = system_code(derived, *asked.language);
            return said;
        }
        for (const auto& remark : checked_system(derived))
            said.remarks.push_back(remark.text);
        said.text = system_text(derived);
        said.latex = system_latex(derived);
        return said;
    } catch (const InputError& error) {
        const std::string message = error.what();
        return {.refused =
                    message.starts_with(asked.file) ? message.substr(asked.file.size()) : message};
    }
}

CheckedExpectation holds_words(const Said& said, const std::string& wanted, bool refused) {
    const bool fits = said.refused.empty() != refused;
    const std::string& text = said.refused.empty() ? said.text : said.refused;
    return {.what = {},
            .expected = (refused ? "refused with \"" : "\"") + wanted + "\"",
            .found = (said.refused.empty() ? "" : "refused: ") + beginning_of(text),
            .place = {},
            .holds = fits && text.find(wanted) != std::string::npos};
}

CheckedExpectation holds_remarks(const Said& said, const std::vector<std::string>& wanted) {
    const auto listed = [](const std::vector<std::string>& texts) {
        return texts.empty() ? "nothing" : boost::algorithm::join(texts, ", ");
    };
    return {.what = {},
            .expected = listed(wanted),
            .found = said.refused.empty() ? listed(said.remarks) : "refused: " + said.refused,
            .place = {},
            .holds = said.refused.empty() &&
                     std::ranges::equal(said.remarks, wanted,
                                        [](const std::string& remark, const std::string& begin) {
                                            return remark.starts_with(begin);
                                        })};
}

/// All that is expected of a system, which is derived once.
std::vector<CheckedExpectation> checked_system_of(const AskedSystem& asked,
                                                  const ExpectedOfSystem& wanted) {
    const Said said = said_of(asked);
    std::vector<CheckedExpectation> checked;
    const auto add = [&](CheckedExpectation one, const char* key, const std::string& index) {
        const auto& [what, place] = wanted.names.at(key);
        one.what = what + index;
        one.place = place;
        checked.push_back(std::move(one));
    };
    for (std::size_t i = 0; i < wanted.says.size(); ++i)
        add(holds_words(said, wanted.says[i], false), "says", "." + std::to_string(i));
    for (std::size_t i = 0; i < wanted.refused.size(); ++i)
        add(holds_words(said, wanted.refused[i], true), "refused", "." + std::to_string(i));
    if (wanted.remarks)
        add(holds_remarks(said, *wanted.remarks), "remarks", "");
    checked.front().examined =
        said.text + said.latex + boost::algorithm::join(said.remarks, "\n") + said.refused;
    return checked;
}

AskedSystem read_asked(TableReader& table, const Scene& scene) {
    const auto file = table.text("file");
    AskedSystem asked{.text = table.text("text")};
    if (file && asked.text)
        throw table.error("", " has both `file` and `text`; remove one");
    if (!file && !asked.text)
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

ExpectedOfSystem read_wanted(TableReader& table, const AskedSystem& asked) {
    ExpectedOfSystem wanted{
        read_words(table, "says"), table.texts("remarks"), read_words(table, "refused"), {}};
    for (const char* key : {"says", "remarks", "refused"})
        wanted.names[key] = {what_of(table, key), table.place(key)};
    if (asked.language && wanted.remarks)
        throw table.error("remarks", " are of equations, not of their code: leave language out");
    if (wanted.remarks && std::ranges::find(*wanted.remarks, "") != wanted.remarks->end())
        throw table.error("remarks", " has a text without a letter, with which any begins");
    if (wanted.refused.empty() == (wanted.says.empty() && !wanted.remarks))
        throw table.error("", " must expect that it is `refused`, or else what it `says`, its "
                              "`remarks`, or both");
    return wanted;
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
        const AskedSystem asked = read_asked(table, scene);
        const ExpectedOfSystem wanted = read_wanted(table, asked);
        expectations.push_back([asked, wanted](const StudyResult& /*result*/) {
            return checked_system_of(asked, wanted);
        });
        table.finish();
    }
}

} // namespace tvbeam

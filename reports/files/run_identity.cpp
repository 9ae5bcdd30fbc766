#include "reports/files/run_identity.hpp"

#include "core/sine/sine_run.hpp"
#include "mms/text/characters.hpp"
#include "reports/files/build_ids.hpp"
#include "reports/files/provenance.hpp"
#include "studies/external/external_runs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace tvbeam {

namespace {

using Identity = nlohmann::ordered_json;

/// Where two values differ, without the numbers of entries in lists: /ladder/dt/2 → ladder/dt.
std::string key_of(const std::string& pointer) {
    std::string key = pointer.empty() ? pointer : pointer.substr(1);
    for (auto slash = key.find_last_of('/');
         slash != std::string::npos &&
         std::all_of(key.begin() + static_cast<std::ptrdiff_t>(slash) + 1, key.end(), is_digit);
         slash = key.find_last_of('/'))
        key.erase(slash);
    return key;
}

} // namespace

nlohmann::ordered_json run_identity(const Scene& scene) {
    const Provenance provenance = provenance_of(scene);
    Identity binaries = Identity::object();
    for (const auto& [name, id] : build_ids())
        binaries[name] = id;
    Identity text = Identity::parse(scene.json());
    for (const char* words : {"title", "long", "expect", "report", "short"})
        text.erase(words); // no result depends on them
    Identity identity{{"scene", std::move(text)},
                      {"build",
                       {{"version", provenance.version},
                        {"commit", provenance.commit},
                        {"compiler", provenance.compiler},
                        {"type", provenance.build_type},
                        {"flags", provenance.flags},
                        {"binaries", std::move(binaries)}}},
                      {"processor", {{"kernel", sine_unit()}}}};
    if (const auto* solution = std::get_if<Solution>(&scene.problem)) {
        Identity& lines = identity["scene"]["text of the solution"] = Identity::array();
        for (const auto& parameter : solution->parameters)
            lines.push_back(parameter.name + " = " + parameter.value.text());
        for (const auto& phase : solution->phases)
            lines.push_back({phase.until ? phase.until->text() : "", phase.theta.text(),
                             phase.u.text(), phase.sigma ? phase.sigma->text() : ""});
    }
    if (scene.solver) {
        const RunIdentities identities(*scene.solver);
        for (const auto& series : scene.series())
            for (std::size_t level = 0; level < series.rungs.size(); ++level)
                identity["solver"].push_back(identities.of(series, level));
    }
    return identity;
}

std::string difference_of(const nlohmann::ordered_json& there, const nlohmann::ordered_json& here) {
    for (const auto& [part, words] : {std::pair<std::string, std::string>{"scene", "another scene"},
                                      {"build", "another build of tvbeam"},
                                      {"solver", "another state of the program under study"},
                                      {"processor", "another kind of processor"}}) {
        if (there.value(part, Identity()) == here.value(part, Identity()))
            continue;
        if (part == "solver")
            return words; // its parts are runs, by number
        std::set<std::string> keys;
        for (const auto& change :
             Identity::diff(there.value(part, Identity()), here.value(part, Identity())))
            keys.insert(key_of(change["path"]));
        std::string listed;
        for (const auto& key : keys)
            if (!key.empty())
                listed += (listed.empty() ? "" : ", ") + key;
        return listed.empty() ? words : fmt::format("{} ({})", words, listed);
    }
    return {};
}

} // namespace tvbeam

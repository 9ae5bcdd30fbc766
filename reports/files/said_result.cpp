#include "reports/files/said_result.hpp"

#include "reports/analysis/analysis_reports.hpp"
#include "reports/document/result_document.hpp"
#include "reports/files/json_values.hpp"
#include "reports/files/said_report.hpp"
#include "reports/formats/json_report.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/predicted_work.hpp"
#include "studies/stress/stress_tally.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

/// Other numbers in the next run, or said elsewhere: what was asked for, and where it was.
bool is_left_out(const std::string& key) {
    return key == "schema" || key == "scene" || key == "provenance" || key == "file" ||
           key == "seconds" || key == "time_to_reach" || key == "interrupted" || key == "errors" ||
           key == "printed"; // a baseline has the errors by themselves
}

/// Whether the keys of an object are names that the user gave, which may be like ours.
bool holds_names(const std::string& key) {
    return key == "norms" || key == "orders" || key == "verdict" || key == "reason" ||
           key == "values";
}

/// Lists that are longer go by their digest.
constexpr std::size_t longest_list = 24;
constexpr std::size_t few = 5; ///< numbers that stand in a digest themselves

double rounded(double number) {
    const std::string text = fmt::format("{:.10g}", number);
    double result = number;
    const auto ended = std::from_chars(text.data(), text.data() + text.size(), result);
    return ended.ec == std::errc() ? result : number; // at either end of the range
}

Json digest_of(const std::vector<Json>& values) {
    Json digest{{"count", values.size()}};
    std::map<std::string, std::size_t> texts;
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    double sum = 0.0;
    std::size_t numbers = 0;
    for (const Json& value : values)
        if (value.is_number()) {
            const double number = value;
            least = std::min(least, number);
            greatest = std::max(greatest, number);
            sum += number;
            ++numbers;
        } else {
            ++texts[value.is_string() ? without_numbers(value) : value.dump()];
        }
    if (numbers > 0) {
        digest.update({{"least", rounded(least)},
                       {"greatest", rounded(greatest)},
                       {"mean", rounded(sum / static_cast<double>(numbers))}});
        for (std::size_t i = 0; i < few; ++i)
            digest["some"].push_back(values[i * (values.size() - 1) / (few - 1)]);
    }
    for (const auto& [text, count] : texts)
        digest["texts"][text] = count;
    return digest;
}

/// A long list by the digests of what stands at one place of its elements.
Json digest_of(const Json& list) {
    std::map<std::string, std::vector<Json>> places;
    for (const Json& element : list)
        for (auto& [place, value] : json_values(element, is_left_out))
            places[place].push_back(value);
    if (places.size() == 1 && places.begin()->first.empty())
        return digest_of(places.begin()->second);
    Json digest = Json::object();
    for (const auto& [place, values] : places)
        digest[place] = digest_of(values);
    return digest;
}

/// Paths without the folder of the scene, which is another elsewhere. x/(x + 1) is no path of x/.
std::string without_folder(const std::string& text, const std::string& folder) {
    const auto is_of_path = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '.' ||
               c == '_' || c == '-';
    };
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const bool begins = at == 0 || !is_of_path(text[at - 1]);
        std::size_t end = at;
        while (begins && end < text.size() && is_of_path(text[end]))
            ++end;
        if (end == at) {
            result += text[at++];
            continue;
        }
        std::string path = text.substr(at, end - at);
        std::error_code error;
        if (path.starts_with(folder) && path.size() > folder.size() &&
            (folder.starts_with('/') || std::filesystem::exists(path, error)))
            path.erase(0, folder.size());
        result += path.starts_with("./") ? path.substr(2) : path;
        at = end;
    }
    return result;
}

/// folder: of the scene. named: the keys are names that the user gave.
Json kept_of(const Json& json, const std::string& folder, bool named = false) {
    if (json.is_object()) {
        Json kept = Json::object();
        for (const auto& [key, value] : json.items())
            if (named || !is_left_out(key))
                kept[key] = kept_of(value, folder, holds_names(key));
        return kept;
    }
    if (json.is_array()) {
        Json kept = Json::array();
        for (const auto& value : json)
            kept.push_back(kept_of(value, folder));
        const bool is_of_texts = !kept.empty() && kept[0].is_string();
        return kept.size() > longest_list && !is_of_texts ? digest_of(kept) : kept;
    }
    if (json.is_number_float())
        return rounded(json);
    return json.is_string() ? Json(without_folder(json, folder)) : json;
}

/// Which case of a stress study comes nearest to the limit of a check is decided by round-off.
bool names_worst_case(const std::string& text) {
    return std::ranges::any_of(stress_checks(), [&](const NamedCheck& check) {
        return !check.words.empty() && text.starts_with(check.words + ": ");
    });
}

/// Of studies that are not timed; their tables hold the numbers that stand in the JSON.
Json sentences_of(const StudyResult& result) {
    Json sentences = result_document(result).head;
    for (const auto& [kind, record] : result.records.entries())
        for (const auto& section :
             kind->timed() ? std::vector<Section>() : report_of(*kind).sections(result))
            for (const auto& block : section.blocks) {
                if (const auto* paragraph = std::get_if<Paragraph>(&block))
                    sentences.push_back(paragraph->text);
                else if (const auto* item = std::get_if<Item>(&block);
                         item != nullptr && !names_worst_case(item->text))
                    sentences.push_back(item->text);
                else if (const auto* finding = std::get_if<Finding>(&block))
                    sentences.push_back(finding->text);
            }
    return sentences;
}

Json examined_by(const std::vector<CheckedExpectation>& checked) {
    Json examined = Json::object();
    for (const auto& one : checked) {
        if (one.analysed)
            examined[one.what] = Json::parse(analysis_json(*one.analysed));
        else if (!one.examined.empty())
            examined[one.what] = one.examined;
    }
    return examined;
}

} // namespace

Json said_by(const StudyResult& result, const std::vector<CheckedExpectation>& checked) {
    Json json = result_json(result);
    bool timed = false;
    for (const auto& [kind, record] : result.records.entries())
        if (kind->timed()) {
            json[kind->name()].erase("remarks"); // on seconds
            timed = true;
        }
    json["basis"] = result.scene.scheme.basis == Basis::nodal ? "nodal" : "automatic";
    json["predicted"] = predicted_work(result.scene).text();
    json["sentences"] = sentences_of(result);
    json["examined"] = examined_by(checked);
    if (!timed) {
        json["tables"] = tables_said_by(result);
        json["files"] = files_said_by(result);
    }
    const std::filesystem::path folder = std::filesystem::path(result.scene.file).parent_path();
    return kept_of(json, ((folder.empty() ? "." : folder) / "").string());
}

} // namespace tvbeam

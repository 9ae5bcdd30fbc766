#include "mms/solution.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/solution_expressions.hpp"
#include "mms/text/nearest_name.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <system_error>

namespace tvbeam {

namespace {

constexpr std::streamsize largest_file = 1'000'000;

class SolutionReader {
public:
    SolutionReader(std::string_view document, const std::string& file)
        : document_(document), file_(file) {}

    Solution read() {
        const toml::table root = parsed();
        Solution solution;
        solution.name =
            plain_string(root, "name").value_or(std::filesystem::path(file_).stem().string());
        if (solution.name.empty())
            throw InputError(root.contains("name") ? place(*root.get("name")) : Place{file_},
                             "name is empty; give the solution a name");
        solution.source = plain_string(root, "source").value_or("");
        solution.purpose = plain_string(root, "purpose").value_or("");
        require_known_keys(
            root, {"name", "source", "purpose", "theta", "u", "sigma", "phase", "parameters"});
        solution.parameters = parameters(root);
        solution.phases = phases(root);
        expressions_of(solution);
        return solution;
    }

private:
    [[nodiscard]] toml::table parsed() const {
        try {
            return toml::parse(document_, file_);
        } catch (const toml::parse_error& error) {
            const toml::source_position at = error.source().begin;
            throw InputError({file_, int(at.line), int(at.column)},
                             "not a TOML document: " + std::string(error.description()));
        }
    }

    [[nodiscard]] Place place(const toml::node& node) const {
        return {file_, int(node.source().begin.line), int(node.source().begin.column)};
    }

    [[nodiscard]] Place place(const toml::key& key) const {
        return {file_, int(key.source().begin.line), int(key.source().begin.column)};
    }

    /// Where the key of an entry that is there stands.
    [[nodiscard]] Place key_place(const toml::table& table, std::string_view name) const {
        return place(table.find(name)->first);
    }

    static std::string type_name(const toml::node& node) {
        switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "an array";
        case toml::node_type::string:
            return "a string";
        case toml::node_type::integer:
        case toml::node_type::floating_point:
            return "a number";
        case toml::node_type::boolean:
            return "a boolean";
        default:
            return "a date or time";
        }
    }

    void require_known_keys(const toml::table& table, const std::vector<std::string>& known) const {
        for (const auto& [key, value] : table) {
            if (std::find(known.begin(), known.end(), key.str()) != known.end())
                continue;
            std::string hint = did_you_mean(key.str(), known);
            if (hint.empty()) {
                for (const std::string& name : known)
                    hint += (hint.empty() ? "; known are " : ", ") + name;
            }
            throw InputError(place(key), "unknown key '" + std::string(key.str()) + "'" + hint);
        }
    }

    [[nodiscard]] std::optional<std::string> plain_string(const toml::table& table,
                                                          std::string_view key) const {
        const toml::node* node = table.get(key);
        if (node == nullptr)
            return std::nullopt;
        if (!node->is_string())
            throw InputError(place(*node), std::string(key) + " is " + type_name(*node) +
                                               "; it must be a string");
        return node->as_string()->get();
    }

    /// An expression: a string, or a number as it is.
    [[nodiscard]] SourceText expression(const toml::node& node, const std::string& what) const {
        if (node.is_string())
            return SourceText::of_toml_string(node.as_string()->get(), document_, place(node));
        std::array<char, 40> buffer{};
        std::to_chars_result written{};
        if (node.is_integer()) {
            written = std::to_chars(buffer.begin(), buffer.end(), node.as_integer()->get());
        } else if (node.is_floating_point()) {
            const double value = node.as_floating_point()->get();
            if (!std::isfinite(value))
                throw InputError(place(node), what + " must be finite");
            written = std::to_chars(buffer.begin(), buffer.end(), value);
        } else {
            throw InputError(place(node), what + " is " + type_name(node) +
                                              "; it must be an expression in quotes, or a number");
        }
        return {std::string(buffer.begin(), written.ptr), place(node)};
    }

    [[nodiscard]] std::vector<SolutionParameter> parameters(const toml::table& root) const {
        std::vector<SolutionParameter> result;
        const toml::node* node = root.get("parameters");
        if (node == nullptr)
            return result;
        const toml::table* table = node->as_table();
        if (table == nullptr)
            throw InputError(place(*node), "parameters is " + type_name(*node) +
                                               "; it must be a table of named numbers");
        for (const auto& [key, value] : *table) {
            const std::string name(key.str());
            require_free_name(name, place(key));
            result.push_back({name, expression(value, "parameter " + name)});
        }
        return result;
    }

    static void require_free_name(const std::string& name, const Place& place) {
        const auto is_letter = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
        };
        const auto fits = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); };
        if (name.empty() || !is_letter(name.front()) ||
            !std::all_of(name.begin(), name.end(), fits))
            throw InputError(place, "parameter '" + name +
                                        "' is not a name: letters, digits and _ only, no digit "
                                        "first");
        const auto& functions = function_names();
        if (name == "pi" || model_symbol_table().contains(name) ||
            std::find(functions.begin(), functions.end(), name) != functions.end())
            throw InputError(place,
                             "parameter '" + name + "' hides a known name; call it something else");
    }

    [[nodiscard]] std::vector<SolutionPhase> phases(const toml::table& root) const {
        const toml::node* node = root.get("phase");
        if (node == nullptr)
            return {phase(root, nullptr)};
        const toml::array* list = node->as_array();
        if (list == nullptr || list->empty() || !list->is_homogeneous(toml::node_type::table))
            throw InputError(key_place(root, "phase"),
                             "phase must be a list of tables; write [[phase]] before each");
        std::vector<SolutionPhase> result;
        for (const toml::node& entry : *list) {
            const toml::table& table = *entry.as_table();
            require_known_keys(table, {"until", "theta", "u", "sigma"});
            SolutionPhase next = phase(root, &table);
            const bool last = result.size() + 1 == list->size();
            const toml::node* until = table.get("until");
            if (last && until != nullptr)
                throw InputError(key_place(table, "until"),
                                 "the last phase has no until: it holds for all later times");
            if (!last && until == nullptr)
                throw InputError(place(table), "until is missing; every phase but the last says "
                                               "when it ends");
            if (until != nullptr)
                next.until = expression(*until, "until");
            result.push_back(next);
        }
        return result;
    }

    /// The phase with what the top of the file says for all phases, and what its own table says.
    [[nodiscard]] SolutionPhase phase(const toml::table& root, const toml::table* own) const {
        const auto find = [&](std::string_view key) -> std::optional<SourceText> {
            const toml::node* at_top = root.get(key);
            const toml::node* in_phase = own == nullptr ? nullptr : own->get(key);
            if (at_top != nullptr && in_phase != nullptr)
                throw InputError(key_place(*own, key),
                                 std::string(key) + " is given here and at line " +
                                     std::to_string(at_top->source().begin.line) +
                                     " for all phases; leave one out");
            const toml::node* node = at_top != nullptr ? at_top : in_phase;
            if (node == nullptr)
                return std::nullopt;
            return expression(*node, std::string(key));
        };
        const auto require = [&](std::string_view key) {
            auto found = find(key);
            if (!found)
                throw InputError(own == nullptr ? Place{file_} : place(*own),
                                 std::string(key) + " is missing; a solution gives theta and u" +
                                     (own == nullptr ? "" : ", at the top or in every phase"));
            return *found;
        };
        SolutionPhase result;
        result.theta = require("theta");
        result.u = require("u");
        result.sigma = find("sigma");
        return result;
    }

    std::string_view document_;
    std::string file_;
};

} // namespace

Solution parse_solution(std::string_view document, const std::string& file) {
    return SolutionReader(document, file).read();
}

Solution read_solution(const std::filesystem::path& path) {
    const std::string file = path.string();
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        throw InputError({file}, "is a directory; give a solution file");
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        throw InputError({file}, "cannot be opened; is the path right?");
    std::string document(static_cast<std::size_t>(largest_file) + 1, '\0');
    stream.read(document.data(), largest_file + 1);
    document.resize(static_cast<std::size_t>(stream.gcount()));
    if (stream.bad())
        throw InputError({file}, "cannot be read");
    if (document.size() > static_cast<std::size_t>(largest_file))
        throw InputError({file}, "is larger than " + std::to_string(largest_file) +
                                     " bytes; it is no solution file");
    return parse_solution(document, file);
}

} // namespace tvbeam

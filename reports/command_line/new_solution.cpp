#include "reports/command_line/new_solution.hpp"

#include "mms/text/input_error.hpp"
#include "reports/files/output_file.hpp"
#include "studies/scene/shipped.hpp"

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <string_view>

namespace tvbeam {

namespace {

constexpr std::string_view solution_text =
    R"toml(# An exact solution: what the beam is to do. The sources and data that make it one are derived from it;
# `tvbeam derive NAME.toml` prints them, what of the model they test, and the orders to expect.
name    = "NAME"
source  = "made by me"
purpose = "say in one line what it is for; `tvbeam list` prints that of the shipped ones"

# Expressions know x (0: the clamped end, 1: the tip) and t; alpha, zeta, g1, g2, theta_A of the scene's beam;
# pi and the parameters below; + - * / ^ and sin cos tan asin acos atan sinh cosh tanh exp log sqrt.
theta = "cos(t)*sin(pi*x)"       # temperature: theta_A at x = 0, zero at x = 1
u     = "k*x^2*(3 - x)*sin(t)"   # deflection: zero with its slope at x = 0, between the stops at x = 1
# sigma = "0"                    # stress: its value at x = 1 is the contact force, >= 0 on g1, <= 0 on g2, else 0.
                                 # Where it depends on x, a body force sigma_x acts.

[parameters]
k = 0.01

# A solution may have phases; theta, u and sigma then stand in each, or above for all. Pressed on g2 from t = 1 on:
#
# [[phase]]
# until = 1
# u     = "g2*x^2*(3 - x)/2*t*(2 - t)"
# [[phase]]
# u     = "g2*x^2*(3 - x)/2"
# sigma = "1 - t"
)toml";

constexpr std::string_view scene_text =
    R"toml(# What is run: `tvbeam run NAME-scene.toml` prints the table, `tvbeam check NAME-scene.toml` checks it against [expect].
title    = "NAME"
solution = "./NAME.toml"

[beam]
alpha = 0.3                 # thermal expansion, without unit; 0: no coupling
zeta  = 0.1                 # viscosity, a time
stops = [-0.1, 0.1]         # g1, g2; -inf or inf: none on that side; leave it out: no stops
# theta_A = 0.5             # temperature at the clamped end; 0 when left out

[scheme]
time         = "euler"      # or "bdf2", "sdirk2", both of order 2: then dt = "0.1/s" will do
thermal_mass = "consistent" # or "lumped"

[ladder]                    # one problem on finer and finer meshes
final_time = 1.0
elements   = [8, 16, 32]
dt         = "0.64/s^2"     # falls like h^2, as the time error of Euler is of order 1; or a list, one a mesh
norms      = ["theta_L2L2", "u_LinfH2semi"]

# Each observed order must lie between these. To hold the errors as well: errors = [...], one a mesh, or
# `tvbeam check NAME-scene.toml --record baseline.json` once, and --baseline baseline.json from then on.
[expect.ladder.theta_L2L2]
orders = [1.95, 2.05]

[expect.ladder.u_LinfH2semi]
orders = [1.95, 2.05]
)toml";

std::string with_name(std::string_view text, const std::string& name) {
    constexpr std::string_view placeholder = "NAME";
    std::string result;
    for (auto at = text.find(placeholder); at != std::string_view::npos;
         at = text.find(placeholder)) {
        result.append(text.substr(0, at)).append(name);
        text.remove_prefix(at + placeholder.size());
    }
    return result.append(text);
}

void require_name(const std::string& name) {
    constexpr std::size_t longest = 64;
    const auto fits = [](char c) {
        return (std::isalnum(static_cast<unsigned char>(c)) != 0 &&
                (static_cast<unsigned char>(c) & 0x80U) == 0U) ||
               c == '-' || c == '_';
    };
    if (name.ends_with(".toml"))
        throw InputError({}, "'" + name + "' has the ending of a file; give the name alone: " +
                                 name.substr(0, name.size() - std::string_view(".toml").size()));
    if (name.empty() || name.size() > longest || name.front() == '-' ||
        !std::all_of(name.begin(), name.end(), fits))
        throw InputError({}, "'" + name +
                                 "' is no name for a solution: letters, digits, - and _, at most " +
                                 std::to_string(longest) + " of them, no - first");
}

} // namespace

std::array<StarterFile, 2> starter_files(const std::string& name) {
    require_name(name);
    return {{{name + ".toml", with_name(solution_text, name)},
             {name + "-scene.toml", with_name(scene_text, name)}}};
}

std::array<StarterFile, 2> solver_starter_files(const std::string& name) {
    require_name(name);
    const std::string shipped = "heat-solver";
    const auto scene = find_file(Shipped::scene, shipped);
    const auto read = [&](const std::string& ending) {
        std::ifstream stream(scene.parent_path() / (shipped + ending));
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        return StarterFile{name + ending, boost::algorithm::replace_all_copy(text, shipped, name)};
    };
    return {read(".py"), read(".toml")};
}

void write_starter_files(const std::array<StarterFile, 2>& files,
                         const std::filesystem::path& directory) {
    for (const auto& file : files)
        // A dangling link is there, too.
        if (std::error_code error;
            std::filesystem::exists(std::filesystem::symlink_status(directory / file.name, error)))
            throw InputError({}, "'" + file.name +
                                     "' is there already, and nothing was written; remove it or "
                                     "choose another name");
    OutputFile solution(directory / files[0].name);
    OutputFile scene(directory / files[1].name);
    solution.commit(files[0].text);
    try {
        scene.commit(files[1].text);
    } catch (...) {
        std::error_code error;
        std::filesystem::remove(directory / files[0].name, error);
        throw;
    }
}

} // namespace tvbeam

#include "tests/bench/settings.hpp"

#include "core/low_rank/separated.hpp"
#include "mms/manufactured_problem.hpp"
#include "studies/scene/shipped.hpp"
#include "tests/marching.hpp"

#include <fmt/format.h>

#include <utility>

namespace tvbeam::bench {

namespace {

const Beam paper_beam{.alpha = 0.017, .zeta = 0.1, .stops = {-0.02, 0.1}};

ProblemData paper_problem(const Beam& beam) {
    const auto file = find_file(Shipped::solution, "copetti-fernandez-2011");
    return manufactured_problem({read_solution(file), beam, final_time});
}

Setting on(const Beam& beam) {
    return {beam,
            std::make_shared<const ProblemData>(paper_problem(beam)),
            Scheme{.thermal_mass = ThermalMass::lumped},
            {*Norm::named("theta_L2L2_sq"), *Norm::named("u_LinfH2semi_sq")}};
}

} // namespace

Setting full() {
    static const Setting setting = on(paper_beam);
    return setting;
}

Setting without_coupling() {
    Beam beam = paper_beam;
    beam.alpha = 0.0;
    return on(beam);
}

Setting without_stops() {
    Setting setting = full();
    setting.beam.stops = {};
    return setting;
}

Setting without_norms() {
    Setting setting = full();
    setting.norms.clear();
    return setting;
}

Setting with_all_norms() {
    Setting setting = full();
    setting.norms.clear();
    for (const auto& name : Norm::names())
        setting.norms.push_back(*Norm::named(name));
    return setting;
}

Setting with_general_sources() {
    Setting setting = full();
    ProblemData data = *setting.data;
    for (Field* field : {&data.heat_source, &data.moment_load, &data.couple_load,
                         &data.curvature_initial, &data.theta_initial})
        *field = unseparated(*field, *setting.data);
    setting.data = std::make_shared<const ProblemData>(std::move(data));
    return setting;
}

std::vector<std::pair<std::string, Setting>> of_low_rank() {
    const std::pair<std::string, std::string> formulas[] = {
        {"x*(1-x)*exp(-x*t)", "x^2*(1-x)^2*exp(-x*t)/10"},
        {"x*(1-x)/(1+x+t)", "x^2*cos(x*t)/30"},
        {"sin(pi*x)*exp(-(x-t)^2)", "x^2*sin(2*x+t)/40"},
        {"sin(pi*x*(1+t*(1-x)))", "x^2*sin(x*t)/20"},
    };
    std::vector<std::pair<std::string, Setting>> all;
    for (const auto& [theta, u] : formulas) {
        const std::string text =
            fmt::format("name = \"low-rank\"\ntheta = \"{}\"\nu = \"{}\"\n", theta, u);
        Setting setting = full();
        setting.data = std::make_shared<const ProblemData>(
            manufactured_problem({parse_solution(text, "low-rank"), setting.beam, final_time}));
        const auto rank = separated(*setting.data, setting.norms, final_time).rank;
        all.emplace_back(fmt::format("solution {}, {} products", all.size() + 1, rank), setting);
    }
    return all;
}

Setting by_fixed_point() {
    Setting setting = full();
    setting.scheme.algorithm = Algorithm::fixed_point;
    return setting;
}

Setting in_nodal_basis(Setting setting) {
    setting.scheme.basis = Basis::nodal;
    return setting;
}

Setting with_time(Setting setting, const std::string& name) {
    setting.scheme.time = TimeScheme::named(name);
    return setting;
}

Setting with_mass(Setting setting, ThermalMass mass) {
    setting.scheme.thermal_mass = mass;
    return setting;
}

RunRequest request(const Setting& setting, const March& march) {
    return {setting.beam, Mesh::uniform(march.elements), setting.scheme, final_time, march.steps,
            setting.norms};
}

} // namespace tvbeam::bench

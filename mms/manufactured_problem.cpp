#include "mms/manufactured_problem.hpp"

#include "mms/admissible/admissibility.hpp"
#include "mms/derivation.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/plain_solution.hpp"
#include "mms/problem_builder.hpp"
#include "mms/sampled_fields.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

using GiNaC::ex;

namespace {

std::vector<ex> formulas(const DerivedSolution& solution, ex DerivedPhase::*member) {
    std::vector<ex> result;
    for (const DerivedPhase& phase : solution.derived)
        result.push_back(phase.*member);
    return result;
}

ProblemData built(const DerivedSolution& solution, double final_time) {
    std::vector<TimePhase> phases;
    for (const PhaseExpressions& phase : solution.phases)
        phases.push_back({phase.begin_value, phase.end_value});
    ProblemBuilder builder(phases, final_time);
    const auto field = [&](ex DerivedPhase::*member) {
        return builder.field(formulas(solution, member));
    };
    const auto amplitude = [&](ex DerivedPhase::*member) {
        return builder.amplitude(formulas(solution, member));
    };

    ProblemData problem;
    problem.heat_source = field(&DerivedPhase::heat_source);
    problem.moment_load = field(&DerivedPhase::moment_load);
    problem.couple_load = field(&DerivedPhase::couple_load);
    problem.body_force = field(&DerivedPhase::body_force);
    problem.end_moment = amplitude(&DerivedPhase::end_moment);

    ExactSolution exact;
    exact.theta = field(&DerivedPhase::theta);
    exact.theta_x = field(&DerivedPhase::theta_x);
    exact.u = field(&DerivedPhase::u);
    exact.u_x = field(&DerivedPhase::u_x);
    exact.u_xx = field(&DerivedPhase::u_xx);
    exact.stress = amplitude(&DerivedPhase::contact_stress);
    problem.theta_initial = exact.theta;
    problem.curvature_initial = exact.u_xx;
    problem.exact = std::move(exact);
    for (std::size_t i = 0; i + 1 < phases.size(); ++i)
        problem.phase_ends.push_back(phases[i].end);
    builder.finish(problem);
    return problem;
}

/// That every field, separated into products and compiled, is what the text says.
void require_as_written(const ProblemData& problem, const PlainSolution& plain) {
    const ExactSolution& exact = *problem.exact;
    for (std::size_t phase = 0; phase < plain.phase_count(); ++phase) {
        const SampledFields sampled(problem, plain.x(phase), plain.t(phase));
        const auto require = [&](const auto& field, Computed quantity, const std::string& what) {
            plain.require(phase, quantity, what, sampled.of(field));
        };
        require(exact.theta, Computed::theta, "theta");
        require(exact.theta_x, Computed::theta_x, "theta_x");
        require(exact.u, Computed::u, "u");
        require(exact.u_x, Computed::u_x, "u_x");
        require(exact.u_xx, Computed::u_xx, "u_xx");
        require(exact.stress, Computed::contact_stress, "sigma(1,t)");
        require(problem.heat_source, Computed::heat_source, "f of (1)");
        require(problem.moment_load, Computed::moment_load, "the integral of G of (3)");
        require(problem.couple_load, Computed::couple_load, "G of (3)");
        require(problem.body_force, Computed::body_force, "q of (2)");
        require(problem.end_moment, Computed::end_moment, "m of (9)");
    }
}

} // namespace

ProblemData manufactured_problem(const AdmissibleSolution& solution) {
    try {
        ProblemData problem = built(solution.derived(), solution.final_time());
        problem.exact->law_distance = solution.remarks().law_distance;
        problem.exact->tip_is_sampled = solution.remarks().tip_is_sampled;
        require_as_written(problem, solution.plain());
        return problem;
    } catch (const AlgebraError& error) {
        throw InputError(solution.solution().phases.front().theta.begin(),
                         std::string("the solution cannot be evaluated: ") + error.what());
    }
}

} // namespace tvbeam

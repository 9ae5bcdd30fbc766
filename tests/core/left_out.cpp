// What a scene does not need is not computed and not allocated: the counters of the result show it.

#include "core/run.hpp"
#include "mms/manufactured_problem.hpp"
#include "mms/solution.hpp"
#include "tests/marching.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(left_out)

namespace {

const std::string solution = "theta = 'exp(-t)*sin(pi*x)'\nu = '(x^3/6 - x^2/2)*cos(t)/100'";

constexpr std::int64_t steps = 40;

RunResult result_of(const Beam& beam, const std::vector<std::string>& names,
                    const Scheme& scheme = {}, const std::string& text = solution) {
    std::vector<Norm> norms;
    for (const auto& name : names)
        norms.push_back(*Norm::named(name));
    return run({beam, Mesh::uniform(30), scheme, 1.0, steps, norms},
               manufactured_problem({parse_solution(text, "test"), beam, 1.0}));
}

const Beam full{.alpha = 0.4, .zeta = 0.1, .stops = {-0.1, 0.1}};
const auto bases = boost::unit_test::data::make({Basis::automatic, Basis::nodal});

const std::vector<std::string> both{"theta_L2L2", "u_LinfH2semi"};

} // namespace

BOOST_DATA_TEST_CASE(a_full_scene_does_every_part, bases, basis) {
    const Scheme scheme{.basis = basis};
    const Counters counters = result_of(full, both, scheme).counters;
    BOOST_TEST(counters.steps == steps);
    BOOST_TEST(counters.sine_steps == (basis == Basis::automatic ? steps : 0));
    BOOST_TEST(counters.heat_solves == steps);
    BOOST_TEST(counters.beam_solves == steps);
    BOOST_TEST(counters.coupling_updates == steps);
    BOOST_TEST(counters.load_updates == steps);
    BOOST_TEST(counters.tip_evaluations == steps);
    BOOST_TEST(counters.norm_evaluations == 2 * steps);
    BOOST_TEST(counters.source_evaluations == 0); // everything separates
    BOOST_TEST(counters.fixed_point_iterations == 0);
}

BOOST_DATA_TEST_CASE(without_alpha_nothing_is_coupled, bases, basis) {
    const Scheme scheme{.basis = basis};
    Beam beam = full;
    beam.alpha = 0.0;
    const Counters counters = result_of(beam, both, scheme).counters;
    BOOST_TEST(counters.coupling_updates == 0);
    BOOST_TEST(counters.heat_solves == steps);
    BOOST_TEST(counters.doubles_allocated <
               result_of(full, both, scheme).counters.doubles_allocated);
}

BOOST_DATA_TEST_CASE(without_alpha_a_field_that_no_norm_reads_is_not_solved_for, bases, basis) {
    const Scheme scheme{.basis = basis};
    Beam beam = full;
    beam.alpha = 0.0;
    const Counters heat = result_of(beam, {"theta_L2L2"}, scheme).counters;
    BOOST_TEST(heat.beam_solves == 0);
    BOOST_TEST(heat.tip_evaluations == 0);
    BOOST_TEST(heat.heat_solves == steps);
    const Counters bending = result_of(beam, {"u_LinfH2semi"}, scheme).counters;
    BOOST_TEST(bending.heat_solves == 0);
    BOOST_TEST(bending.beam_solves == steps);
    // With coupling each field acts on the other, and both are needed.
    BOOST_TEST(result_of(full, {"theta_L2L2"}, scheme).counters.beam_solves == steps);
    BOOST_TEST(result_of(full, {"u_LinfH2semi"}, scheme).counters.heat_solves == steps);
}

BOOST_DATA_TEST_CASE(without_stops_the_tip_is_not_looked_at, bases, basis) {
    const Scheme scheme{.basis = basis};
    Beam beam = full;
    beam.stops = {};
    const Counters counters = result_of(beam, both, scheme).counters;
    BOOST_TEST(counters.tip_evaluations == 0);
    BOOST_TEST(counters.contact_steps == 0);
    BOOST_TEST(counters.doubles_allocated <
               result_of(full, both, scheme).counters.doubles_allocated);
}

BOOST_DATA_TEST_CASE(without_sources_no_load_is_added, bases, basis) {
    const Scheme scheme{.basis = basis};
    // θ = 0, u = 0 needs neither f nor G.
    const Counters counters = result_of(full, both, scheme, "theta = '0'\nu = '0'").counters;
    BOOST_TEST(counters.load_updates == 0);
    BOOST_TEST(counters.source_evaluations == 0);
    BOOST_TEST(counters.heat_solves == steps);
}

BOOST_DATA_TEST_CASE(without_norms_nothing_is_integrated, bases, basis) {
    const Scheme scheme{.basis = basis};
    const Counters counters = result_of(full, {}, scheme).counters;
    BOOST_TEST(counters.norm_evaluations == 0);
    BOOST_TEST(counters.heat_solves == steps);
    BOOST_TEST(counters.beam_solves == steps);
    BOOST_TEST(counters.doubles_allocated <
               result_of(full, {"u_LinfH2semi"}, scheme).counters.doubles_allocated);
}

BOOST_DATA_TEST_CASE(what_is_left_out_does_not_change_what_remains,
                     boost::unit_test::data::make(all_runs), scheme) {
    // The tip stays between the stops, so they only cost time; and a field read alone is the field
    // read with the other.
    const auto with = result_of(full, both, scheme).errors;
    Beam open = full;
    open.stops = {};
    const auto without = result_of(open, both, scheme).errors;
    BOOST_TEST(with[0] == without[0], boost::test_tools::tolerance(1e-12));
    BOOST_TEST(with[1] == without[1], boost::test_tools::tolerance(1e-8));
    Beam uncoupled = full;
    uncoupled.alpha = 0.0;
    const auto together = result_of(uncoupled, both, scheme).errors;
    BOOST_TEST(result_of(uncoupled, {"theta_L2L2"}, scheme).errors[0] == together[0]);
    BOOST_TEST(result_of(uncoupled, {"u_LinfH2semi"}, scheme).errors[0] == together[1]);
}

BOOST_DATA_TEST_CASE(stops_that_are_never_met_change_no_bit, bases, basis) {
    const Scheme scheme{.basis = basis};
    Beam none = full;
    none.stops = {};
    Beam far = full;
    far.stops = {-1e300, 1e300};
    const RunResult without = result_of(none, both, scheme);
    const RunResult with = result_of(far, both, scheme);
    BOOST_TEST(with.counters.tip_evaluations == steps);
    BOOST_TEST(without.counters.tip_evaluations == 0);
    for (std::size_t k = 0; k < both.size(); ++k)
        BOOST_TEST(with.errors[k] == without.errors[k]);
}

BOOST_DATA_TEST_CASE(a_norm_is_the_same_whatever_else_is_measured, bases, basis) {
    // The sums are the same ones; in the sine basis their terms may be grouped differently.
    const Scheme scheme{.basis = basis};
    const RunResult together = result_of(full, both, scheme);
    for (std::size_t k = 0; k < both.size(); ++k) {
        const RunResult alone = result_of(full, {both[k]}, scheme);
        BOOST_TEST(std::abs(alone.errors[0] - together.errors[k]) <=
                   30.0 * std::numeric_limits<double>::epsilon() * together.errors[k]);
    }
}

BOOST_AUTO_TEST_SUITE_END()

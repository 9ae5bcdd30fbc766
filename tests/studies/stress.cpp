// Stress studies: how cases are sampled and judged.

#include "studies/stress/stress.hpp"
#include "core/certify/contact_law.hpp"
#include "core/certify/initial_state.hpp"
#include "core/contraction.hpp"
#include "core/run.hpp"
#include "core/time/time_levels.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/scene/scene.hpp"
#include "studies/stress/scratch.hpp"
#include "studies/stress/stress_cases.hpp"
#include "studies/stress/stress_problem.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(stress)

namespace {

StressBlock read_block(const std::string& text) {
    const TemporaryDirectory directory;
    return *read_scene(directory.write("scene.toml", text)).get<StressBlock>();
}

std::vector<StressParameters> cases_of(const std::string& text) {
    const StressBlock block = read_block(text);
    std::vector<StressParameters> cases;
    for (std::size_t i = 0; i < block.cases(); ++i)
        cases.push_back(block.case_at(i));
    return cases;
}

/// Ten steps of implicit Euler.
StressParameters loaded_case(double alpha, std::int64_t elements) {
    StressParameters loaded;
    loaded.alpha = alpha;
    loaded.zeta = 0.1;
    loaded.dt = 0.01;
    loaded.elements = elements;
    loaded.steps = 10;
    loaded.load = 1.0;
    loaded.time = "euler";
    return loaded;
}

} // namespace

BOOST_AUTO_TEST_CASE(samplings_take_the_cases_that_they_say) {
    const std::string lists = "alpha = [0.0, 1.0, 2.0]\nelements = [2, 4]\ngap = [1.0, inf]\n"
                              "sides = [\"both\", \"lower\"]\n";
    const auto cases = [&](const std::string& sampling) {
        return cases_of("[stress.sweep.a]\n" + lists + sampling);
    };
    // inf has no sides: three kinds of stops. One at a time: 1 + 2 + 1 + 2.
    BOOST_TEST(cases("sampling = \"each\"").size() == 6U);
    BOOST_TEST(cases("sampling = \"product\"").size() == 18U);
    const auto sobol = cases("sampling = \"sobol\"\npoints = 64");
    BOOST_TEST(sobol.size() == 64U);
    std::set<std::pair<double, std::int64_t>> seen;
    for (const auto& one : sobol)
        seen.insert({one.alpha, one.elements});
    BOOST_TEST(seen.size() == 6U); // every pair of the two lists
}

BOOST_AUTO_TEST_CASE(work_bounds_the_steps) {
    const auto cases = cases_of("[stress.sweep.a]\nelements = [10, 1000]\nsteps = 50\nwork = 5000");
    BOOST_TEST(cases[0].steps == 50);
    BOOST_TEST(cases[1].steps == 5);
}

BOOST_AUTO_TEST_CASE(mistakes_are_pointed_at) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"[stress]", "asks for nothing"},
        {"[stress.sweep.a]\nalpha = [-1.0]", "its values must be >= 0"},
        {"[stress.sweep.a]\ntime = [\"rk4\"]", "holds 'rk4'"},
        {"[stress.sweep.a]\npoints = 3", "belongs to sampling"},
        {"[stress.sweep.a]\nload = [inf]", "finite"}};
    for (const auto& mistake : mistakes) {
        const auto says_so = [&](const InputError& error) {
            return std::string(error.what()).find(mistake.second) != std::string::npos;
        };
        BOOST_CHECK_EXCEPTION(read_block(mistake.first), InputError, says_so);
    }
}

BOOST_AUTO_TEST_CASE(both_descriptions_of_the_loads_agree) {
    // μ = ∫_y^1 G dx − m, with G = couple_load constant in x.
    StressParameters parameters;
    parameters.dt = 0.1;
    parameters.steps = 7;
    parameters.elements = 4;
    parameters.load = 2.0;
    const Mesh mesh = Mesh::uniform(4);
    const ProblemData problem = stress_problem(parameters, mesh);
    for (const double t : {0.0, 0.13, 0.7}) {
        const Eigen::ArrayXd g = values(problem, problem.couple_load, mesh.nodes, t);
        const double m = problem.amplitudes(Eigen::ArrayXd::Constant(1, t))(*problem.end_moment, 0);
        const Eigen::ArrayXd mu = values(problem, problem.moment_load, mesh.nodes, t);
        BOOST_TEST((mu - (g * (1.0 - mesh.nodes) - m)).abs().maxCoeff() <= 1e-15);
    }
}

BOOST_AUTO_TEST_CASE(outcomes_have_their_reasons) {
    const StressParameters ordinary = loaded_case(0.5, 10);
    const StressCase certified = judge(ordinary);
    BOOST_TEST(name_of(certified.outcome) == "certified", certified.reason);
    BOOST_TEST(certified.reason.empty());
    BOOST_TEST(certified.checks->path.has_value());

    StressParameters diverging = ordinary;
    diverging.algorithm = Algorithm::fixed_point;
    diverging.alpha = 100.0;
    BOOST_TEST(name_of(judge(diverging).outcome) == "refused");
    BOOST_TEST(judge(diverging).reason.find("would not contract") != std::string::npos);

    StressParameters rounded = ordinary;
    rounded.algorithm = Algorithm::fixed_point;
    rounded.elements = 100'000;
    BOOST_TEST(name_of(judge(rounded).outcome) == "refused");
    BOOST_TEST(judge(rounded).reason.find("h^-4") != std::string::npos);

    StressParameters huge = ordinary;
    huge.load = 1e308;
    BOOST_TEST(name_of(judge(huge).outcome) == "stopped");
    BOOST_TEST(judge(huge).reason.find("not finite") != std::string::npos);

    StressParameters stiff = ordinary;
    stiff.alpha = 1e200;
    BOOST_TEST(name_of(judge(stiff).outcome) == "refused");

    StressParameters tiny = ordinary;
    tiny.load = 1e-320;
    BOOST_TEST(name_of(judge(tiny).outcome) == "refused");
    tiny.load = 1e-300; // so viscous a beam bends by 1e-300 Δt/ζ = 1e-316
    tiny.zeta = 1e12;
    tiny.dt = 1e-4;
    BOOST_TEST(name_of(judge(tiny).outcome) == "stopped");
    BOOST_TEST(judge(tiny).reason.find("underflow") != std::string::npos);
    BOOST_TEST(!judge(tiny).checks.has_value()); // which would count among the greatest

    // λ₁Δt = 987: each step leaves a thousandth of the mode, and 130 less than any double.
    StressParameters decayed = ordinary;
    decayed.load = 0.0;
    decayed.initial = InitialData::smooth;
    decayed.dt = 100.0;
    decayed.steps = 130;
    BOOST_TEST(name_of(judge(decayed).outcome) == "stopped");
    BOOST_TEST(judge(decayed).reason.find("underflow") != std::string::npos);

    // εα = 2: the curvature is the rounding of the temperature.
    StressParameters coupled = ordinary;
    coupled.load = 0.0;
    coupled.initial = InitialData::smooth;
    coupled.zeta = 0.0;
    coupled.alpha = 1e16;
    BOOST_TEST(name_of(judge(coupled).outcome) == "stopped");
    BOOST_TEST(judge(coupled).reason.find("round-off") != std::string::npos);

    // So viscous a beam moves by 1e-198 a step, whose square is none.
    StressParameters viscous = ordinary;
    viscous.alpha = 0.0;
    viscous.zeta = 1e200;
    viscous.dt = 100.0;
    viscous.elements = 1;
    BOOST_TEST(name_of(judge(viscous).outcome) == "certified", judge(viscous).reason);
}

// What is lost below the range of doubles the coupling makes larger.
BOOST_AUTO_TEST_CASE(a_strong_coupling_of_what_falls_below_doubles_is_no_failure) {
    for (const double alpha : {1e4, 1e6, 1e8})
        for (const double load : {1e-303, 1e-305, 1e-307})
            for (const double dt : {1e-10, 1e-3, 1.0})
                for (const auto& time : TimeScheme::names()) {
                    StressParameters one;
                    one.alpha = alpha;
                    one.zeta = 0.0;
                    one.dt = dt;
                    one.elements = 3;
                    one.load = load;
                    one.time = time;
                    one.steps = 12;
                    one.initial = InitialData::zero;
                    const StressCase found = judge(one);
                    BOOST_TEST(name_of(found.outcome) != "failed", alpha << ", " << load << ", "
                                                                         << dt << ", " << time
                                                                         << ": " << found.reason);
                }
}

BOOST_AUTO_TEST_CASE(contraction_is_measured_as_it_is_predicted_for_the_running_scheme) {
    // One solve of the running scheme, whatever its starter does, with c = leading/Δt.
    for (const auto& time : TimeScheme::names())
        for (const auto mass : {ThermalMass::consistent, ThermalMass::lumped}) {
            BOOST_TEST_CONTEXT(time << ", " << name_of(mass)) {
                const ContractionBlock block{{1e-5, 0.3, 1.0}, {1e-3, 0.1}, 0.05, 8, time, mass};
                const ContractionMap map = contraction_map(
                    block, {measure_contraction(block, 0), measure_contraction(block, 1)});
                const double c = TimeScheme::named(time).stages.back().leading / 0.1;
                BOOST_TEST(map.predicted(1, 2) ==
                           contraction({.alpha = 1.0, .zeta = 0.05}, Mesh::uniform(8), mass, c));
                BOOST_TEST(map.least_ratio() >= 1.0 - 1e-4);
                BOOST_TEST(map.greatest_ratio() <= 1.0 + 1e-4);
                BOOST_TEST(map.predicted(0, 0) < ContractionMap::least_measurable);
            }
        }
}

// BDF2 starts by a scheme whose first step has the greater contraction: runs are refused by it.
BOOST_AUTO_TEST_CASE(a_contraction_map_refuses_what_runs_refuse) {
    for (const auto& time : TimeScheme::names()) {
        const ContractionBlock block{{1.8, 2.0, 2.2, 2.4, 2.7, 3.0}, {0.3, 1.0}, 0.1, 10, time,
                                     ThermalMass::consistent};
        const ContractionMap map =
            contraction_map(block, {measure_contraction(block, 0), measure_contraction(block, 1)});
        int refused = 0;
        for (const double dt : block.dt)
            for (const double alpha : block.alpha) {
                StressParameters one;
                one.alpha = alpha;
                one.zeta = block.zeta;
                one.dt = dt;
                one.elements = block.elements;
                one.time = time;
                one.algorithm = Algorithm::fixed_point;
                one.steps = 2;
                refused += judge(one).outcome == Outcome::refused ? 1 : 0;
            }
        BOOST_TEST(map.refused() == refused, time);
        BOOST_TEST(refused > 0, time);
    }
}

BOOST_AUTO_TEST_CASE(a_form_that_stops_says_why_and_meets_no_expectation) {
    RoundOffBlock block;
    block.alpha = 100.0;
    block.dt = 0.1;
    block.steps = 2;
    block.time = "euler";
    block.elements = {4};
    block.finest_hermite = 4;
    const RoundOffTable table{{measure_round_off(block, 0)}};
    BOOST_TEST(!table.rows[0].hermite.value.has_value());
    BOOST_TEST(table.rows[0].hermite.reason.find("would not contract") != std::string::npos);
    BOOST_TEST(std::isnan(table.least_hermite_ratio()));
    BOOST_TEST(std::isnan(table.greatest_hermite_ratio()));
    BOOST_TEST(std::isfinite(table.greatest_moment_floor()));

    block.finest_hermite = 2; // not run, hence no reason
    BOOST_TEST(measure_round_off(block, 0).hermite.reason.empty());
}

// Without viscosity A = -alpha T at once, as with next to none.
BOOST_AUTO_TEST_CASE(the_discretisation_error_without_viscosity_is_that_of_next_to_none) {
    RoundOffBlock block;
    block.alpha = 0.3;
    block.dt = 1e-3;
    block.steps = 3;
    block.time = "euler";
    block.elements = {2, 16};
    for (std::size_t i = 0; i < block.elements.size(); ++i) {
        block.zeta = 1e-9;
        const double wanted = measure_round_off(block, i).discretisation_error;
        block.zeta = 0.0;
        const double found = measure_round_off(block, i).discretisation_error;
        BOOST_TEST(std::abs(found / wanted - 1.0) < 1e-4, found << " " << wanted);
        // T = exp(-pi^2 t/(1 + alpha^2)), of which Euler has (1 + z)^-n with z = lambda dt/(1 +
        // alpha^2) and the eigenvalue lambda of the mesh; both relative to the first step's.
        const double h = 1.0 / static_cast<double>(block.elements[i]);
        const double square = std::pow(std::sin(std::numbers::pi * h / 2.0), 2);
        const double lambda = 12.0 * square / (h * h) / (3.0 - 2.0 * square);
        const double inertia = 1.0 + block.alpha * block.alpha;
        double error = 0.0;
        for (int n = 1; n <= 3; ++n)
            error = std::max(error, std::abs(std::pow(1.0 + lambda * block.dt / inertia, -n) -
                                             std::exp(-std::numbers::pi * std::numbers::pi *
                                                      block.dt * n / inertia)));
        error /= std::exp(-std::numbers::pi * std::numbers::pi * block.dt / inertia);
        BOOST_TEST(std::abs(found / error - 1.0) < 0.02, found << " " << error);
    }
}

BOOST_AUTO_TEST_CASE(no_floor_is_found_of_norms_whose_squares_underflow) {
    RoundOffBlock block;
    block.zeta = 0.1;
    block.dt = 1e-3;
    block.steps = 3;
    block.time = "euler";
    block.elements = {8};
    for (const double alpha : {0.3, 1e-170}) {
        block.alpha = alpha;
        const auto row = measure_round_off(block, 0);
        BOOST_TEST(row.sine.has_value() == (alpha == 0.3));
        BOOST_TEST(row.moment.value.value_or(1.0) < 1e-13);
    }
}

// What overflows in the judge is no failure of the solver.
BOOST_AUTO_TEST_CASE(data_beyond_the_range_of_the_checks_are_refused_and_do_not_fail) {
    StressParameters viscous = loaded_case(0.0, 4);
    viscous.load = 0.0;
    viscous.initial = InitialData::zero;
    viscous.zeta = 1e15;
    viscous.dt = 1e-300;
    StressParameters heated = viscous;
    heated.zeta = 1.0;
    heated.dt = 0.01;
    heated.load = 1e-300;
    heated.theta_A = 1e300;
    for (const auto& [parameters, words] :
         {std::pair(viscous, "zeta/dt is above 1e300"),
          {heated, "theta_A is above 1e300 times what bends the beam"}}) {
        const StressCase judged = judge(parameters);
        BOOST_TEST(name_of(judged.outcome) == "refused");
        BOOST_TEST(judged.reason.find(words) != std::string::npos, judged.reason);
    }
}

BOOST_AUTO_TEST_CASE(hermite_form_warns_where_round_off_may_exceed_its_error) {
    // In the paper's row with s = 160 round-off moves the second figure, by s = 320 it swamps the
    // error; a few steps of it suffice, because viscosity remembers ζ/Δt of them.
    const auto remarks = [](const std::string& algorithm, const std::string& elements,
                            const std::string& dt) {
        const Scene scene =
            read_scene("table1-fixed-point",
                       {"ladder.final_time=0.01", "ladder.elements=[" + elements + "]",
                        "ladder.dt=[" + dt + "]", "ladder.printed={}",
                        "ladder.norms=['u_LinfH2semi']", "scheme={algorithm='" + algorithm + "'}"});
        return run_study(scene).get<LadderResult>()->norms.at(0).remarks;
    };
    const auto warns = [](const std::vector<std::string>& remarks) {
        return std::any_of(remarks.begin(), remarks.end(), [](const std::string& remark) {
            return remark.find("h^-4") != std::string::npos;
        });
    };
    BOOST_TEST(!warns(remarks("fixed-point", "10", "1e-3")));
    BOOST_TEST(warns(remarks("fixed-point", "640", "1e-4")));
    BOOST_TEST(!warns(remarks("direct", "640", "1e-4")));
}

// Each of temperature, curvature and contact stress counts by itself, and what is not a number is
// no agreement.
BOOST_AUTO_TEST_CASE(every_norm_of_the_two_paths_is_compared) {
    const std::vector<double> nodal{0.5, 0.5, 0.5};
    const std::array<double, 3> scales{1.0, 1.0, 1.0};
    BOOST_TEST(path_difference(nodal, nodal, scales) == 0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double> sine = nodal;
        sine[k] *= 1.0 + 0x1p-40; // 2^-41, of 2^-52
        BOOST_TEST(path_difference(nodal, sine, scales) == 0x1p11,
                   boost::test_tools::tolerance(1e-9));
        sine[k] = std::nan("");
        BOOST_TEST(std::isnan(path_difference(nodal, sine, scales)), k);
        BOOST_TEST(std::isnan(path_difference(sine, nodal, scales)), k);
    }
    // Also one in front of numbers.
    BOOST_TEST(std::isnan(path_difference({std::nan(""), 0.5, 0.5}, {0.5, 0.4, 0.3}, scales)));
}

// Squares of 1e-165 are no numbers: what is that small is not compared, and what is not compared is
// no failure.
BOOST_AUTO_TEST_CASE(paths_are_compared_only_where_their_squares_are_numbers) {
    StressParameters small;
    small.alpha = 0.5;
    small.zeta = 0.1;
    small.dt = 0.01;
    small.elements = 8;
    small.load = 0.0;
    for (const auto& time : TimeScheme::names())
        for (const double theta_A : {1e-165, 1e-100}) {
            small.time = time;
            small.theta_A = theta_A;
            const StressCase result = judge(small);
            BOOST_TEST(name_of(result.outcome) == "certified", result.reason);
            BOOST_TEST(result.checks->path.has_value() == (theta_A == 1e-100));
        }
}

// Each by itself, at both sides where it has two; what is no number holds nothing.
BOOST_AUTO_TEST_CASE(every_check_beyond_its_limit_is_named) {
    BOOST_TEST(violation({}) == "");
    const double nan = std::nan("");
    const auto named = [](const std::string& word, const auto& set,
                          std::initializer_list<double> bad, double good) {
        for (const double value : bad) {
            StressChecks checks;
            checks.path_limit = 30.0;
            set(checks, value);
            BOOST_TEST(violation(checks).find(word) != std::string::npos, word << value);
        }
        StressChecks checks;
        checks.path_limit = 30.0;
        set(checks, good);
        BOOST_TEST(violation(checks) == "", word);
    };
    const double over = 1.01;
    named(
        "heat equation", [](StressChecks& c, double v) { c.heat_residual = v; },
        {over * StressLimits::residual, nan}, StressLimits::residual);
    named(
        "beam equation", [](StressChecks& c, double v) { c.beam_residual = v; },
        {over * StressLimits::residual, nan}, StressLimits::residual);
    named(
        "energy law", [](StressChecks& c, double v) { c.energy = v; },
        {over * StressLimits::energy, nan}, StressLimits::energy);
    named(
        "beyond a stop", [](StressChecks& c, double v) { c.penetration = v; },
        {over * StressLimits::contact, nan}, StressLimits::contact);
    named(
        "wrong sign", [](StressChecks& c, double v) { c.wrong_sign = v; },
        {over * StressLimits::contact, nan}, StressLimits::contact);
    named(
        "without contact", [](StressChecks& c, double v) { c.complementarity = v; },
        {over * StressLimits::contact, nan}, StressLimits::contact);
    named(
        "initial state", [](StressChecks& c, double v) { c.initial = v; },
        {over * StressLimits::initial, nan}, StressLimits::initial);
    named(
        "sine basis", [](StressChecks& c, double v) { c.path = v; }, {30.3, nan}, 30.0);
    named(
        "order in dt", [](StressChecks& c, double v) { c.order_defect = v; },
        {over * StressLimits::order, -over * StressLimits::order, nan}, -StressLimits::order);
    named(
        "of the predicted one", [](StressChecks& c, double v) { c.error = v; },
        {1.11, 0.9, 0.0, nan}, 0.92);
}

// Of the curvature; the tip has no part of it.
BOOST_AUTO_TEST_CASE(limits_are_wider_by_what_the_form_leaves_but_those_of_contact) {
    const auto says = [](double StressChecks::*check, double value) {
        StressChecks checks;
        checks.allowance = 1e-4;
        checks.*check = value;
        return violation(checks) != "" && checks.closeness(true) > 1.0;
    };
    const double epsilon = std::numeric_limits<double>::epsilon();
    for (const auto& [check, limit] : {std::pair(&StressChecks::energy, 1e-4),
                                       {&StressChecks::heat_residual, 1e-4 / epsilon},
                                       {&StressChecks::beam_residual, 1e-4 / epsilon},
                                       {&StressChecks::initial, 1e-4}}) {
        BOOST_TEST(!says(check, 0.99 * limit));
        BOOST_TEST(says(check, 1.02 * limit));
    }
    for (const auto check :
         {&StressChecks::penetration, &StressChecks::wrong_sign, &StressChecks::complementarity})
        BOOST_TEST(says(check, 1.01 * StressLimits::contact));
}

// On a mesh that leaves the Hermite form few digits of its curvature a tip that passes its stop is
// seen all the same: certified figures are of the tip's own size.
BOOST_AUTO_TEST_CASE(fixed_points_on_fine_meshes_are_judged_by_the_size_of_the_tip) {
    StressParameters pressed = loaded_case(0.1, 1000);
    pressed.algorithm = Algorithm::fixed_point;
    pressed.steps = 20;
    pressed.theta_A = 0.5;
    pressed.stops = {-1e-3, 1e-3};
    const StressCase fine = judge(pressed);
    BOOST_TEST(name_of(fine.outcome) == "certified", fine.reason);
    BOOST_TEST(fine.checks->allowance > 0.0);
    BOOST_TEST(fine.checks->allowance <= 1e-3);
    BOOST_TEST(fine.checks->penetration < 1e-15);
    // Of the terms as they are: measured by what is allowed for, the residual would be a few units.
    BOOST_TEST(fine.checks->beam_residual > 1e5);
    StressParameters finer = pressed;
    finer.elements = 2000;
    BOOST_TEST(name_of(judge(finer).outcome) == "refused");

    const Mesh mesh = Mesh::uniform(pressed.elements);
    const Beam beam{pressed.alpha, pressed.zeta, pressed.theta_A, pressed.stops};
    const ProblemData data = stress_problem(pressed, mesh);
    Scheme scheme;
    scheme.algorithm = Algorithm::fixed_point;
    scheme.time = TimeScheme::named(pressed.time);
    const Beam free{pressed.alpha, pressed.zeta, pressed.theta_A, {}};
    const auto solver = make_solver(free, data, mesh, scheme, pressed.dt, Needs{true, true, true});
    const auto state = [&]() -> SolverState {
        return {solver->temperature(), solver->curvature(), solver->contact_stress()};
    };
    SolveRecorder recorder(beam, data, mesh, pressed.time, pressed.dt, {.least_size = 1.0},
                           state());
    double penetration = 0.0;
    solver->observe([&](const Solve&) {
        penetration = std::max(penetration,
                               contact_defects(beam, mesh, recorder.record(state())).penetration);
    });
    TimeLevels levels(data, scheme.time, pressed.dt * static_cast<double>(pressed.steps),
                      pressed.steps);
    for (std::int64_t n = 1; n <= pressed.steps; ++n) {
        BOOST_REQUIRE(solver->step(levels.at(n)).empty());
        BOOST_REQUIRE(recorder.end_step().empty());
    }
    BOOST_TEST(penetration > 1e-3);
}

// By a part of 1e-6, of temperature or curvature, at any place.
BOOST_AUTO_TEST_CASE(another_initial_state_than_that_of_the_data_is_seen) {
    for (const auto initial : {InitialData::smooth, InitialData::rough, InitialData::random})
        for (const auto algorithm : {Algorithm::direct, Algorithm::fixed_point}) {
            StressParameters start;
            start.initial = initial;
            start.elements = 12;
            start.theta_A = 0.5;
            start.dt = 0.01;
            start.steps = 4;
            start.time = "euler";
            const Mesh mesh = Mesh::uniform(start.elements);
            const ProblemData data = stress_problem(start, mesh);
            Scheme scheme;
            scheme.algorithm = algorithm;
            const Beam beam{0.5, 0.1, start.theta_A, {}};
            const auto solver =
                make_solver(beam, data, mesh, scheme, start.dt, Needs{true, true, true});
            const SolverState state{solver->temperature(), solver->curvature(), 0.0};
            const auto defect = [&](const SolverState& of) {
                return initial_defect(beam, data, mesh, {}, of);
            };
            BOOST_TEST(defect(state) < 1e-9);
            SolverState warmer = state;
            warmer.theta *= 1.000001;
            BOOST_TEST(defect(warmer) > 1e-7);
            SolverState bent = state;
            bent.w *= 1.000001;
            BOOST_TEST(defect(bent) > 1e-7);
            SolverState once = state;
            once.w(1, 5) += 1e-6;
            BOOST_TEST(defect(once) > 1e-7);
            once.w(1, 5) = std::numeric_limits<double>::quiet_NaN();
            BOOST_TEST(!(defect(once) <= 1.0));
        }
}

// However busy the machine is: no longer than it was waited for.
BOOST_AUTO_TEST_CASE(seconds_of_a_case_are_seconds) {
    StressParameters few;
    few.elements = 10;
    few.steps = 20;
    few.time = "euler";
    few.dt = 0.01;
    const auto start = std::chrono::steady_clock::now();
    const StressCase result = judge(few);
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    BOOST_TEST(result.seconds > 0.0);
    BOOST_TEST(result.seconds <= waited.count());
}

// Of the limit of each; those of contact count with stops alone.
BOOST_AUTO_TEST_CASE(closeness_is_that_of_the_check_nearest_to_its_limit) {
    StressChecks none;
    BOOST_TEST(none.closeness(true) == 0.0);
    const auto half = [](double StressChecks::*check, double limit) {
        StressChecks checks;
        checks.*check = limit / 2;
        return std::pair(checks.closeness(false), checks.closeness(true));
    };
    const std::pair either(0.5, 0.5);
    const std::pair with_stops(0.0, 0.5);
    BOOST_TEST((half(&StressChecks::energy, StressLimits::energy) == either));
    BOOST_TEST((half(&StressChecks::heat_residual, StressLimits::residual) == either));
    BOOST_TEST((half(&StressChecks::beam_residual, StressLimits::residual) == either));
    BOOST_TEST((half(&StressChecks::initial, StressLimits::initial) == either));
    BOOST_TEST((half(&StressChecks::penetration, StressLimits::contact) == with_stops));
    BOOST_TEST((half(&StressChecks::wrong_sign, StressLimits::contact) == with_stops));
    BOOST_TEST((half(&StressChecks::complementarity, StressLimits::contact) == with_stops));
    StressChecks others;
    others.order_defect = -StressLimits::order / 4;
    BOOST_TEST(others.closeness(false) == 0.25);
    others.path_limit = 30.0;
    others.path = 10.0;
    BOOST_TEST(others.closeness(true) == 1.0 / 3.0, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(error_of_the_mode_is_the_predicted_one) {
    StressParameters mode;
    mode.alpha = 0.5;
    mode.zeta = 0.1;
    mode.dt = 0.01;
    mode.elements = 10;
    mode.steps = 20;
    mode.initial = InitialData::smooth;
    for (const auto& time : TimeScheme::names()) {
        mode.time = time;
        const StressCase result = judge(mode);
        BOOST_TEST(name_of(result.outcome) == "certified", result.reason);
        BOOST_TEST(*result.checks->error == 1.0, boost::test_tools::tolerance(1e-9));
    }
}

// Steps of a hundredth of the slowest time, 1/π²: the next term of the error is about as small a
// part of it.
BOOST_AUTO_TEST_CASE(order_in_time_is_seen_by_doubling_the_steps) {
    StressParameters mode;
    mode.alpha = 0.5;
    mode.zeta = 0.1;
    mode.dt = 1e-3;
    mode.elements = 10;
    mode.steps = 50;
    mode.initial = InitialData::smooth;
    for (const auto& time : TimeScheme::names()) {
        mode.time = time;
        const StressCase result = judge(mode);
        BOOST_REQUIRE_MESSAGE(result.checks && result.checks->order_defect, time);
        BOOST_TEST(std::abs(*result.checks->order_defect) < 0.03, time);
    }
    mode.dt = 10.0; // no step shows an order where the mode decays in one
    BOOST_TEST(!judge(mode).checks->order_defect);
}

BOOST_AUTO_TEST_CASE(a_heated_end_is_certified_by_every_scheme) {
    StressParameters heated;
    heated.alpha = 0.5;
    heated.zeta = 0.1;
    heated.dt = 0.01;
    heated.elements = 10;
    heated.steps = 20;
    heated.load = 1.0;
    for (const auto& time : TimeScheme::names())
        for (const double theta_A : {-0.7, 0.3})
            for (const auto algorithm : {Algorithm::direct, Algorithm::fixed_point}) {
                heated.time = time;
                heated.theta_A = theta_A;
                heated.algorithm = algorithm;
                const StressCase result = judge(heated);
                BOOST_TEST(name_of(result.outcome) == "certified", result.reason);
            }
}

// With zeta = 0 the curvature leaps in the first step, and the square of its rate is beyond the
// range of floating point; those of the steps after it are numbers.
// Without stops the problem is linear: what is larger by 2^30 has the same defects in parts of
// itself.
BOOST_AUTO_TEST_CASE(checks_do_not_depend_on_the_size_of_the_data) {
    for (const auto& time : TimeScheme::names()) {
        StressParameters ordinary;
        ordinary.alpha = 0.5;
        ordinary.zeta = 0.1;
        ordinary.dt = 0.01;
        ordinary.elements = 20;
        ordinary.steps = 20;
        ordinary.load = 1e-3;
        ordinary.theta_A = 1.0;
        ordinary.time = time;
        const StressCase one = judge(ordinary);
        StressParameters large = ordinary;
        large.load = std::ldexp(ordinary.load, 30);
        large.theta_A = std::ldexp(ordinary.theta_A, 30);
        const StressCase other = judge(large);
        BOOST_TEST_CONTEXT(time << ": " << one.reason << other.reason) {
            BOOST_REQUIRE(one.checks && other.checks);
            const auto close = boost::test_tools::tolerance(0.5);
            BOOST_TEST(other.checks->heat_residual == one.checks->heat_residual, close);
            BOOST_TEST(other.checks->beam_residual == one.checks->beam_residual, close);
            BOOST_TEST(other.checks->energy == one.checks->energy, close);
            BOOST_REQUIRE((one.checks->path && other.checks->path));
            BOOST_TEST(*other.checks->path == *one.checks->path, close);
        }
    }
}

BOOST_AUTO_TEST_CASE(what_was_not_a_number_once_is_not_certified_by_later_steps) {
    StressParameters leap;
    leap.alpha = 1.0;
    leap.zeta = 0.0;
    leap.dt = 1e307;
    leap.elements = 2;
    leap.initial = InitialData::smooth;
    leap.time = "bdf2";
    for (const std::int64_t steps : {1, 3}) {
        leap.steps = steps;
        BOOST_TEST(name_of(judge(leap).outcome) != "certified");
    }
}

// Round-off of the two bases: where that of temperature and curvature is the same, what differs is
// the contact stress alone.
BOOST_AUTO_TEST_CASE(a_contact_stress_that_alone_differs_between_the_bases_is_seen) {
    StressParameters pressed;
    pressed.stops = {.lower = -0.01, .upper = 0.01};
    pressed.load = 1.0;
    int alone = 0;
    for (const double alpha : {0.0, 0.1, 1.0})
        for (const double zeta : {0.0, 0.1, 1.0})
            for (const double dt : {0.1, 1.0})
                for (const std::int64_t elements : {1, 2, 4})
                    for (const auto& time : TimeScheme::names()) {
                        pressed.alpha = alpha;
                        pressed.zeta = zeta;
                        pressed.dt = dt;
                        pressed.elements = elements;
                        pressed.steps = 2;
                        pressed.time = time;
                        const Mesh mesh = Mesh::uniform(elements);
                        const ProblemData data = stress_problem(pressed, mesh);
                        RunRequest request{{alpha, zeta, 0.0, pressed.stops},
                                           mesh,
                                           {},
                                           2 * dt,
                                           2,
                                           {*Norm::named("theta_LinfL2"),
                                            *Norm::named("u_LinfH2semi"),
                                            *Norm::named("sigma_L2")}};
                        request.scheme.time = TimeScheme::named(time);
                        const auto sine = run(request, data).errors;
                        request.scheme.basis = Basis::nodal;
                        const auto nodal = run(request, data).errors;
                        if (sine[0] != nodal[0] || sine[1] != nodal[1] || sine[2] == nodal[2])
                            continue;
                        ++alone;
                        BOOST_TEST(judge(pressed).checks->path.value() > 0.0);
                    }
    BOOST_TEST(alone > 0);
}

BOOST_AUTO_TEST_CASE(cases_are_counted_by_regime_and_checks_by_their_extremes) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    StressCase one;
    one.parameters.alpha = 20.0;
    one.parameters.time = "bdf2";
    one.checks = StressChecks();
    one.checks->energy = 3e-16;
    one.checks->path = 6.0;
    one.checks->path_limit = 30.0;
    StressCase refused = one;
    refused.outcome = Outcome::refused;
    refused.checks.reset();
    StressCase other = one;
    other.parameters.alpha = 10.0;
    other.parameters.stops = {-0.1, 0.1};
    other.checks->energy = 1e-16;
    other.checks->penetration = 2e-17;
    StressTallies tallies;
    for (const auto& each : {one, refused, other})
        tallies.add(each);
    auto figures = tallies.figures();
    BOOST_TEST(figures.at("certified") == 2.0);
    BOOST_TEST(figures.at("alpha > 10.certified") == 1.0);
    BOOST_TEST(figures.at("alpha > 10.refused") == 1.0);
    BOOST_TEST(figures.at("alpha 0.01 to 10.certified") == 1.0);
    BOOST_TEST(figures.at("time bdf2.refused") == 1.0);
    BOOST_TEST(figures.at("energy.count") == 2.0);
    BOOST_TEST(figures.at("energy.least") == 1e-16);
    BOOST_TEST(figures.at("energy.greatest") == 3e-16);
    BOOST_TEST(figures.at("path.greatest") == 0.2); // of its limit
    BOOST_TEST(figures.at("penetration.count") == 1.0);
    BOOST_TEST(figures.at("error.count") == 0.0);
    BOOST_TEST(figures.count("error.greatest") == 0U);
    other.checks->energy = nan; // meets no band, from either side
    tallies.add(other);
    tallies.add(one);
    figures = tallies.figures();
    BOOST_TEST(std::isnan(figures.at("energy.least")));
    BOOST_TEST(std::isnan(figures.at("energy.greatest")));
}

// A stop that is not there is infinitely far: it does not say how narrow the gap to the other is.
BOOST_AUTO_TEST_CASE(the_regime_of_stops_is_that_of_the_nearer_one) {
    const double none = std::numeric_limits<double>::infinity();
    const auto regime = [](const Stops& stops) {
        StressParameters parameters;
        parameters.stops = stops;
        return regimes_of(parameters).at(4);
    };
    BOOST_TEST(regime({-none, none}) == "stops none");
    BOOST_TEST(regime({-1e-9, none}) == "stops one, < 1e-6");
    BOOST_TEST(regime({-none, 1e-9}) == "stops one, < 1e-6");
    BOOST_TEST(regime({-1e-3, none}) == "stops one, >= 1e-6");
    BOOST_TEST(regime({-1e-9, 1.0}) == "stops both, < 1e-6");
    BOOST_TEST(regime({-1.0, 1e-9}) == "stops both, < 1e-6");
    BOOST_TEST(regime({-1.0, 1e-3}) == "stops both, >= 1e-6");
}

// All eight sets of checks that a case may have been asked for.
BOOST_DATA_TEST_CASE(of_a_kept_case_every_check_is_there_that_was_made_and_no_other,
                     boost::unit_test::data::xrange(8), made) {
    StressCase one;
    one.checks.emplace();
    if ((made & 1) != 0)
        one.checks->path = 1.5;
    if ((made & 2) != 0)
        one.checks->error = 2.5;
    if ((made & 4) != 0)
        one.checks->order_defect = 3.5;
    StressCases cases;
    cases.add(one);
    const auto kept = cases.at(0).checks;
    BOOST_REQUIRE(kept);
    BOOST_TEST((kept->path == one.checks->path));
    BOOST_TEST((kept->error == one.checks->error));
    BOOST_TEST((kept->order_defect == one.checks->order_defect));
}

// Of as many bytes as fit into memory, and of one more: those behind stand in a file.
BOOST_AUTO_TEST_CASE(scratch_is_as_large_as_what_was_written_wherever_it_stands) {
    Scratch scratch;
    BOOST_TEST(scratch.size() == 0U);
    const std::string first = "first";
    const std::string last = "last";
    scratch.write(0, first.data(), first.size());
    BOOST_TEST(scratch.size() == first.size());
    const std::size_t far = Scratch::most_in_memory + 7;
    scratch.write(far, last.data(), last.size());
    BOOST_TEST(scratch.size() == far + last.size());
    for (const auto& [place, text] : {std::pair(std::size_t{0}, first), {far, last}}) {
        std::string read(text.size(), ' ');
        scratch.read(place, read.data(), read.size());
        BOOST_TEST(read == text);
    }
    char between = 'x';
    scratch.read(far - 1, &between, 1);
    BOOST_TEST(between == '\0');
}

BOOST_AUTO_TEST_SUITE_END()

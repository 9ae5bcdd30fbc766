// The orders that `derive` forecasts, against runs: every shipped solution and a family of contacts
// of our own, by every time scheme.

#include "core/run.hpp"
#include "mms/forecast/expected_orders.hpp"
#include "mms/manufactured_problem.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/scene/solution_setting.hpp"
#include "tests/slope.hpp"
#include "tests/sweep.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(forecasts)

namespace {

/// The norms that a march in the sine basis measures: fast enough for meshes on which the error of
/// time stands alone.
const std::vector<std::string> norm_names{"theta_L2L2", "theta_LinfL2", "u_LinfH2semi", "sigma_L2"};

struct Problem {
    Solution solution;
    Beam beam;
    double final_time;
};

Forecast in_dt(const ExpectedOrder& order, const std::string& scheme) {
    return scheme == "euler" ? order.euler : scheme == "bdf2" ? order.bdf2 : order.sdirk2;
}

std::vector<double> errors(const Problem& problem, const ProblemData& data,
                           const std::string& scheme, std::int64_t elements, std::int64_t steps) {
    std::vector<Norm> norms;
    for (const auto& name : norm_names)
        norms.push_back(*Norm::named(name));
    const RunResult result = run({problem.beam,
                                  Mesh::uniform(elements),
                                  Scheme{.time = TimeScheme::named(scheme)},
                                  problem.final_time,
                                  steps,
                                  norms,
                                  {}},
                                 data);
    BOOST_REQUIRE_MESSAGE(result.status == RunStatus::ok, result.reason);
    return result.errors;
}

/// In each list the times at which phases end, multiples of T/16 and T/3, lie at one fraction of a
/// step for all counts: an error that depends on the fraction then has an order.
const std::vector<std::int64_t> of_sixteenths{66, 98, 130, 194, 258, 370, 514, 722};
const std::vector<std::int64_t> of_thirds{64, 91, 130, 181, 256, 361, 511, 724};
/// Where a rate jumps, the largest error over time is at first another one than in the end.
const std::vector<std::int64_t> fine_of_thirds{1024, 1450, 2050, 2896};

/// What remains of a norm when the steps are small: the error of space. A record shows the order of
/// time where it is this many times as large.
constexpr double clear_of_space = 10.0;

/// How far a least-squares slope over the counts may be off, from steps that are not small enough.
/// At a switch the heat has a layer at the clamped end, where 1 − x is not zero, of a width ~ √Δt:
/// norms with a maximum over time see it, and the slope drifts. A stress whose contact begins at an
/// instant that a run finds to one step scatters, the more so at sqrt(2), which lies elsewhere in
/// each step.
double slack(const ExpectedOrders& expected, const std::string& norm) {
    if (norm == "sigma_L2" && !expected.contact.onsets.empty())
        return expected.contact.onsets[0].t == std::sqrt(2.0) ? 0.5 : 0.25;
    return norm.find("Linf") != std::string::npos && !expected.switches.empty() ? 0.3 : 0.1;
}

/// Elements enough for the error of space to be small; a source that does not separate is evaluated
/// at every point in every step.
std::int64_t elements_for(const ProblemData& data) {
    return data.heat_source.is_separable() && data.moment_load.is_separable() ? 4096 : 384;
}

void check_forecast(const Problem& problem, const std::string& scheme,
                    const std::vector<std::int64_t>& counts, const std::string& name) {
    const ExpectedOrders expected =
        expected_orders({problem.solution, problem.beam, problem.final_time});
    const ProblemData data =
        manufactured_problem({problem.solution, problem.beam, problem.final_time});
    const std::int64_t elements = elements_for(data);
    std::vector<std::vector<double>> found;
    for (const std::int64_t count : counts)
        found.push_back(errors(problem, data, scheme, elements, count));
    // 48: the ends of phases are time levels then.
    const auto in_space = errors(problem, data, "sdirk2", elements, 48 * (counts.back() / 9));
    for (std::size_t k = 0; k < norm_names.size(); ++k) {
        const auto order =
            std::find_if(expected.orders.begin(), expected.orders.end(),
                         [&](const ExpectedOrder& one) { return one.norm == norm_names[k]; });
        if (order == expected.orders.end())
            continue;
        const Forecast forecast = in_dt(*order, scheme);
        std::vector<double> dt;
        std::vector<double> of_time;
        for (std::size_t i = 0; i < counts.size(); ++i)
            if (found[i][k] > clear_of_space * in_space[k]) {
                dt.push_back(1.0 / static_cast<double>(counts[i]));
                of_time.push_back(found[i][k]);
            }
        const std::string what = name + ", " + scheme + ", " + norm_names[k];
        if (!forecast.has_error()) {
            BOOST_TEST(dt.empty(), what << ": an error where none is forecast, " << found[0][k]
                                        << " over " << in_space[k]);
            continue;
        }
        const double fitted = dt.size() >= 4 ? slope(dt, of_time) : 0.0;
        BOOST_TEST_MESSAGE(what << ": " << fitted << " of " << dt.size() << ", forecast "
                                << forecast.least << " to " << forecast.greatest
                                << (forecast.is_known() ? "" : " (not known)"));
        if (dt.size() < 4 || !forecast.is_known())
            continue;
        const double off = slack(expected, norm_names[k]);
        BOOST_TEST((fitted >= forecast.least - off && fitted <= forecast.greatest + off),
                   what << " has the order " << fitted << ", forecast " << forecast.least << " to "
                        << forecast.greatest);
    }
}

/// A solution by one of the shipped names; the layer e^(−1000 t) is left out, which none of these
/// steps resolves.
std::vector<std::string> shipped() {
    if (short_tests) // the orders are those of any build
        return {"three-phases"};
    std::vector<std::string> names;
    for (const auto& file : shipped_files(Shipped::solution))
        if (file.name != "stiff-layer")
            names.push_back(file.name);
    return names;
}

std::vector<int> powers(int least, int greatest) {
    if (short_tests)
        return {2};
    std::vector<int> result;
    for (int power = least; power <= greatest; ++power)
        result.push_back(power);
    return result;
}

/// The tip comes up to g2 like (a − t)^m, and is pressed from t = a on by a force like (t − a)^k.
Problem onset(int m, int k, double alpha, double zeta) {
    const std::string shape = "g2*(3*x^2 - x^3)/2";
    const std::string inner = " + g2*x^2*(1 - x)^2*sin(t)";
    const std::string text = "theta = 'cos(t)*sin(pi*x)'\n[parameters]\na = '2/3'\n"
                             "[[phase]]\nuntil = 'a'\nu = '" +
                             shape + "*(1 - (1 - t/a)^" + std::to_string(m) + ")" + inner +
                             "'\n[[phase]]\nu = '" + shape + inner +
                             "'\nsigma = '-(1 + t)*(t - a)^" + std::to_string(k) + "'\n";
    return {parse_solution(text, "onset.toml"), {alpha, zeta, 0.0, {-0.02, 0.1}}, 2.0};
}

} // namespace

BOOST_DATA_TEST_CASE(orders_in_time_of_shipped_solutions_are_those_forecast,
                     data::make(shipped()) * data::make(TimeScheme::names()), name, scheme) {
    if (!is_swept(position(shipped(), name) + position(TimeScheme::names(), scheme), 3))
        return;
    const SolutionSetting setting = solution_setting(name);
    check_forecast({setting.solution, setting.beam, setting.final_time}, scheme, of_sixteenths,
                   name);
}

BOOST_DATA_TEST_CASE(orders_in_time_across_an_onset_are_those_forecast,
                     data::make(powers(1, 4)) * data::make(powers(0, 3)) *
                         data::make(TimeScheme::names()),
                     m, k, scheme) {
    if (!is_swept(static_cast<std::size_t>(m + k) + position(TimeScheme::names(), scheme), 3))
        return;
    const std::string name = "m = " + std::to_string(m) + ", k = " + std::to_string(k);
    check_forecast(onset(m, k, 0.4, 0.15), scheme, m == 1 ? fine_of_thirds : of_thirds, name);
}

// Without coupling the stop takes a jump along 1 − x away; without viscosity the tip answers at
// once, and the stress keeps the order of u.
BOOST_DATA_TEST_CASE(orders_in_time_without_coupling_or_viscosity_are_those_forecast,
                     data::make(powers(1, 3)) * data::make(TimeScheme::names()), m, scheme) {
    for (const auto& [alpha, zeta] : {std::pair{0.0, 0.15}, {0.4, 0.0}, {0.0, 0.0}})
        check_forecast(onset(m, 1, alpha, zeta), scheme, m == 1 ? fine_of_thirds : of_thirds,
                       "m = " + std::to_string(m) + ", alpha = " + std::to_string(alpha) +
                           ", zeta = " + std::to_string(zeta));
}

// A difference of what is zero but for round-off, at its own instant, is no jump: sigma, of the
// size 3, ends with 3 sin(pi) = 4e-16, and is zero from then on.
BOOST_AUTO_TEST_CASE(a_jump_of_nothing_is_none) {
    const Solution solution = parse_solution("theta = 'cos(t)*sin(pi*x)'\n"
                                             "[[phase]]\nuntil = '7/10'\n"
                                             "u = 'g2*(3*x^2 - x^3)/2'\n"
                                             "sigma = '-3*sin(10*pi*t/7)'\n"
                                             "[[phase]]\n"
                                             "u = 'g2*(3*x^2 - x^3)/2/(1 + (t - 7/10)^3)'\n",
                                             "nothing.toml");
    const ExpectedOrders expected =
        expected_orders({solution, {0.4, 0.15, 0.0, {-0.02, 0.1}}, 2.0});
    BOOST_TEST(expected.contact.onsets.empty());
    for (const std::string& reason : expected.reasons)
        BOOST_TEST(reason.find("sigma jumps") == std::string::npos, reason);
    const ExpectedOrder& stress = expected.orders.back();
    BOOST_REQUIRE(stress.norm == "sigma_L2");
    BOOST_TEST(stress.euler.least == 1.0);
    BOOST_TEST(stress.bdf2.least == 2.0);
}

// The tip meets the stop with a velocity and stops dead: u_xxt jumps at the very time of the onset,
// so that u has an order p from 1 to 2 there. The gap ~ τ and the force ~ τ leave max(p − 1/2, p/2)
// and max(p − 1/2, 3p/4) of it: 1/2 to 3/2.
BOOST_AUTO_TEST_CASE(a_jump_at_the_time_of_an_onset_lowers_the_order_that_it_leaves) {
    const Solution solution = parse_solution("theta = 'cos(t)*sin(pi*x)'\n"
                                             "[[phase]]\nuntil = 1\n"
                                             "u = 'g2*(3*x^2 - x^3)/2*t'\n"
                                             "[[phase]]\n"
                                             "u = 'g2*(3*x^2 - x^3)/2'\n"
                                             "sigma = '-(t - 1)'\n",
                                             "onset.toml");
    const ExpectedOrders expected =
        expected_orders({solution, {0.4, 0.15, 0.0, {-0.02, 0.1}}, 2.0});
    BOOST_REQUIRE(expected.contact.onsets.size() == 1);
    BOOST_TEST(expected.contact.onsets[0].t == expected.switches.at(0).t);
    const ExpectedOrder& stress = expected.orders.back();
    BOOST_REQUIRE(stress.norm == "sigma_L2");
    for (const Forecast& order : {stress.bdf2, stress.sdirk2}) {
        BOOST_TEST(order.least == 0.5);
        BOOST_TEST(order.greatest == 1.5);
    }
}

// The force begins so steeply, beside the error of a tip that hardly moves, that one step makes
// that good: half an order is lost however small these steps are.
BOOST_AUTO_TEST_CASE(an_onset_that_one_step_makes_good_costs_the_stress_half_an_order) {
    const Problem problem{parse_solution("theta = 0\n[[phase]]\nuntil = 1\n"
                                         "u = 'g2*x^2*(3 - x)/2*(1 - (1 - t)^2)'\n"
                                         "[[phase]]\nu = 'g2*x^2*(3 - x)/2'\nsigma = '1 - t'\n",
                                         "onset.toml"),
                          {0.0, 0.1, 0.0, {-0.001, 0.001}},
                          2.0};
    const ExpectedOrders expected =
        expected_orders({problem.solution, problem.beam, problem.final_time});
    const ExpectedOrder& stress = expected.orders.back();
    BOOST_REQUIRE(stress.norm == "sigma_L2");
    BOOST_TEST(stress.euler.least == 0.5);
    BOOST_TEST(stress.euler.greatest == 0.75);
    BOOST_TEST(stress.bdf2.least == 1.5);
    const ProblemData data =
        manufactured_problem({problem.solution, problem.beam, problem.final_time});
    std::vector<double> dt;
    std::vector<double> found;
    for (const std::int64_t steps : {32, 128, 512, 2048, 8192}) {
        dt.push_back(problem.final_time / static_cast<double>(steps));
        found.push_back(errors(problem, data, "euler", 2, steps).back());
    }
    BOOST_TEST(std::abs(slope(dt, found) - 0.5) < 0.01);
}

// A tip that leaves like s^3 sticks while its error is larger than that.
BOOST_AUTO_TEST_CASE(a_jump_where_the_last_contact_ends_is_one_of_the_stress) {
    const Problem problem{parse_solution("[[phase]]\nuntil = 1\ntheta = '(1 - x)*sin(x)'\n"
                                         "u = 'g2*x^2*(3 - x)/2'\nsigma = -1\n"
                                         "[[phase]]\ntheta = '(1 - x)*sin(x)*t'\n"
                                         "u = 'g2*x^2*(3 - x)/2*(1 - (t - 1)^3/2)'\nsigma = 0\n",
                                         "release.toml"),
                          {3.0, 0.0, 0.0, {-0.2, 0.1}},
                          2.0};
    const ExpectedOrders expected =
        expected_orders({problem.solution, problem.beam, problem.final_time});
    const ExpectedOrder& stress = expected.orders.back();
    BOOST_REQUIRE(stress.norm == "sigma_L2");
    for (const Forecast& order : {stress.bdf2, stress.sdirk2}) {
        BOOST_TEST(order.least == 1.0);
        BOOST_TEST(order.greatest == 2.0);
    }
    check_forecast(problem, "bdf2", of_sixteenths, "a release with a jump"); // a level of each
}

// The velocity of a tip in a penalised stop jumps, within a step: one that answers in a time of a
// few steps leaves sigma the order of u; one that answers at once half an order less than one, and
// u an error of epsilon times that of sigma.
BOOST_AUTO_TEST_CASE(a_jump_in_a_penalised_stop_leaves_half_an_order_if_it_is_stiff) {
    const auto problem = [](double zeta, double epsilon) {
        return Problem{parse_solution("theta = 0\n[[phase]]\nuntil = 1\n"
                                      "u = '1.5*g2*t^2*x^2*(3 - x)/2'\n"
                                      "[[phase]]\nu = '1.5*g2*t*x^2*(3 - x)/2'\n",
                                      "tip.toml"),
                       {0.0, zeta, 0.0, {-0.2, 0.1, epsilon}},
                       2.0};
    };
    const auto row = [&](const Problem& one, const std::string& norm) {
        const ExpectedOrders expected = expected_orders({one.solution, one.beam, one.final_time});
        return *std::ranges::find(expected.orders, norm, &ExpectedOrder::norm);
    };
    const Problem soft = problem(0.5, 0.3);
    const Problem stiff = problem(0.1, 1e-3);
    for (const std::string& scheme : TimeScheme::names()) {
        BOOST_TEST(row(soft, "sigma_L2").in_dt(scheme).least == 1.0);
        BOOST_TEST(row(stiff, "sigma_L2").in_dt(scheme).least == 0.5);
        BOOST_TEST(row(stiff, "u_L2H2").in_dt(scheme).least == 0.5);
        BOOST_TEST(row(stiff, "u_LinfH2").in_dt(scheme).least == 0.0);
        BOOST_TEST(row(stiff, "theta_L2L2").in_dt(scheme).has_error() == false);
        for (const Problem& one : {soft, stiff})
            check_forecast(one, scheme, {31, 63, 127, 255, 511}, "a jump in a penalised stop");
    }
}

// With alpha = 0 the temperature does not see the stops that a solution of rigid ones misses.
BOOST_AUTO_TEST_CASE(errors_that_see_the_stops_alone_stall_at_penalised_ones) {
    const Solution solution = parse_solution("theta = 'sin(pi*x)*exp(-t)'\n[[phase]]\nuntil = 1\n"
                                             "u = 'g2*x^2*(3 - x)/2*(1 - (1 - t)^2)'\nsigma = 0\n"
                                             "[[phase]]\nu = 'g2*x^2*(3 - x)/2'\n"
                                             "sigma = '-(t - 1)'\n",
                                             "rigid.toml");
    for (const double alpha : {0.0, 0.3}) {
        const ExpectedOrders expected =
            expected_orders({solution, {alpha, 0.2, 0.0, {-0.1, 0.1, 0.01}}, 2.0});
        BOOST_REQUIRE(expected.law_distance > 0.0);
        for (const ExpectedOrder& order : expected.orders)
            BOOST_TEST(order.bdf2.is_known() == (alpha == 0.0 && order.norm.starts_with("theta")),
                       order.norm);
        BOOST_TEST(expected.reasons.back().find(alpha == 0.0
                                                    ? "errors of u and sigma do not fall"
                                                    : ": errors do not fall") != std::string::npos,
                   expected.reasons.back());
    }
}

// Stages of SDIRK2 are of order 2 for a tip that is linear in t, of 1 for any other. The steps are
// far above 3ζε = 4.5e-5.
BOOST_AUTO_TEST_CASE(only_an_uneven_tip_in_a_penalised_stop_costs_sdirk2_an_order) {
    const auto problem = [](const std::string& tip) {
        return Problem{parse_solution("theta = 'sin(pi*x)*exp(-t)'\nu = 'g2*(5 + " + tip +
                                          ")/4*(3*x^2 - x^3)/2 + g2*x^2*(1 - x)^2*exp(-t)'\n",
                                      "tip.toml"),
                       {0.4, 0.15, 0.0, {-1.0, 0.1, 1e-4}},
                       1.0};
    };
    const auto stress = [](const Problem& one) {
        const ExpectedOrders expected = expected_orders({one.solution, one.beam, one.final_time});
        bool loses = false;
        for (const std::string& reason : expected.reasons)
            loses = loses || reason.find("but for SDIRK2") != std::string::npos;
        BOOST_REQUIRE(expected.orders.back().norm == "sigma_L2");
        return std::pair{expected.orders.back().sdirk2, loses};
    };
    for (const auto& [tip, least] : {std::pair{"t", 2.0}, {"0", 2.0}, {"sin(t)", 1.0}}) {
        const auto [forecast, loses] = stress(problem(tip));
        BOOST_TEST(forecast.least == least, tip);
        BOOST_TEST(forecast.greatest == 2.0, tip);
        BOOST_TEST(loses == (least < 2.0), tip);
        check_forecast(problem(tip), "sdirk2", {16, 23, 32, 45, 64}, tip);
    }
}

// The first step of BDF2 is one of SDIRK2, whose force is wrong by an error of order 1 over a time
// Δt: where the tip is on the stop then, or comes to it from there, and not where it comes later.
BOOST_AUTO_TEST_CASE(a_tip_that_starts_in_a_penalised_stop_costs_bdf2_an_order) {
    const auto problem = [](const std::string& tip) {
        return Problem{parse_solution("theta = 'sin(pi*x)*exp(-t)'\nu = 'g2*(" + tip +
                                          ")*(3*x^2 - x^3)/2 + g2*x^2*(1 - x)^2*exp(-t)'\n",
                                      "tip.toml"),
                       {0.4, 0.15, 0.0, {-1.0, 0.1, 1e-4}},
                       1.0};
    };
    struct Case {
        std::string tip;
        bool loses;
        bool enters; ///< from outside
    };
    for (const auto& [tip, loses, enters] : {Case{"(5 + sin(t))/4", true, false},
                                             {"1 + exp(t) - cos(t)", true, false},
                                             {"(5 + t)/4", false, false},
                                             {"1 - t + 2*t^2", false, true},
                                             {"0.8 + t^3", false, true}}) {
        const Problem one = problem(tip);
        const ExpectedOrders expected = expected_orders({one.solution, one.beam, one.final_time});
        for (const ExpectedOrder& order : expected.orders) {
            const double own = order.norm == "corollary" ? 4.0 : 2.0;
            const bool is_maximum =
                order.norm.find("Linf") != std::string::npos || order.norm == "corollary";
            // A stop that is met within one step takes half an order of the stress.
            const double free = enters && order.norm == "sigma_L2" ? own - 0.5 : own;
            const double least = !loses ? free : own / 2.0 * (is_maximum ? 1.0 : 1.5);
            BOOST_TEST(order.bdf2.least == least, tip << ", " << order.norm);
            BOOST_TEST(order.bdf2.greatest == (loses ? 1.5 * own : own), tip << ", " << order.norm);
        }
        bool is_said = false;
        for (const std::string& reason : expected.reasons)
            is_said = is_said || reason.find("first step of BDF2") != std::string::npos;
        BOOST_TEST(is_said == loses, tip);
        if (loses || enters)
            check_forecast(one, "bdf2", {16, 23, 32, 45, 64}, tip);
    }
}

// A tip that comes up like s^m and a force that begins like s^k, of which no power up to 6 is seen:
// the orders p(2j + 1)/(2j + 2), with j = m − 1 and j = k, are in the range that is forecast.
BOOST_AUTO_TEST_CASE(a_high_power_of_an_onset_leaves_less_than_a_flat_one) {
    for (const int j : {6, 7}) {
        const Problem problem = onset(j + 1, j, 0.4, 0.15);
        const ExpectedOrders expected =
            expected_orders({problem.solution, problem.beam, problem.final_time});
        const ExpectedOrder& stress = expected.orders.back();
        BOOST_REQUIRE(stress.norm == "sigma_L2");
        const double share = (2.0 * j + 1.0) / (2.0 * j + 2.0);
        BOOST_TEST(stress.in_h.least <= 2.0 * share);
        BOOST_TEST(stress.in_h.least > 1.8);
        BOOST_TEST(stress.in_h.greatest >= 2.0 * share);
        for (const auto& [forecast, of_u] :
             {std::pair{stress.euler, 1.0}, {stress.bdf2, 2.0}, {stress.sdirk2, 2.0}}) {
            BOOST_TEST(forecast.least == of_u - 0.5); // in steps that make it good at once
            BOOST_TEST(forecast.greatest >= of_u * share);
        }
        for (const std::string& reason : expected.reasons)
            BOOST_TEST(reason.find("any power") == std::string::npos, reason);
    }
}

// u_xxt goes to its value at t = 0 like s^β, however small β is: u has the order 1 + β. With a
// large ζ what the first steps leave does not decay, and the order shows early.
BOOST_AUTO_TEST_CASE(a_steep_cusp_lowers_the_order_too) {
    for (const double beta : {0.02, 0.04, 0.3}) {
        const std::string power = std::to_string(1.0 + beta);
        const Problem problem{
            parse_solution("theta = 't*sin(pi*x)'\nu = 'x^2*(1 - x)^2*t^" + power + "'\n",
                           "cusp.toml"),
            {0.0, 5.0, 0.0, {}},
            1.0};
        const ExpectedOrders expected =
            expected_orders({problem.solution, problem.beam, problem.final_time});
        BOOST_REQUIRE(expected.cusps.size() == 1);
        BOOST_TEST(std::abs(expected.cusps[0].u_xxt_power - beta) < 1e-6);
        for (const std::string scheme : {"bdf2", "sdirk2"})
            check_forecast(problem, scheme, of_sixteenths, "u ~ t^" + power);
    }
}

// Within a phase a run sees u_xxt ~ |t − a|^(1/2) from both sides, and has no value of it at a: of
// all counts a lies in the middle of a step, where the error then has an order.
BOOST_AUTO_TEST_CASE(a_cusp_within_a_phase_lowers_the_order_too) {
    const Problem problem{parse_solution("theta = '0'\n"
                                         "u = 'x^2*(3 - x)*((t - 0.43)^2)^0.75'\n",
                                         "cusp.toml"),
                          {0.0, 1.0, 0.0, {}},
                          1.0};
    const AdmissibleSolution solution(problem.solution, problem.beam, problem.final_time);
    const ExpectedOrders expected = expected_orders(solution);
    BOOST_REQUIRE(expected.cusps.size() == 1);
    BOOST_TEST(expected.cusps[0].t == 0.43);
    BOOST_TEST(expected.cusps[0].is_within_phase);
    BOOST_TEST(std::abs(expected.cusps[0].u_xxt_power - 0.5) < 1e-4);
    const ProblemData data = manufactured_problem(solution);
    for (const std::string scheme : {"bdf2", "sdirk2"}) {
        std::vector<double> dt;
        std::vector<double> found;
        for (const std::int64_t count : {1650, 2350, 3350, 4750, 6650}) {
            dt.push_back(1.0 / static_cast<double>(count));
            found.push_back(errors(problem, data, scheme, 4, count)[2]);
        }
        const auto order = std::ranges::find(expected.orders, "u_LinfH2semi", &ExpectedOrder::norm);
        const Forecast forecast = in_dt(*order, scheme);
        BOOST_TEST(std::abs(forecast.least - 1.5) < 1e-4);
        BOOST_TEST(slope(dt, found) > forecast.least - 0.1, scheme << ": " << slope(dt, found));
        BOOST_TEST(slope(dt, found) < forecast.greatest + 0.1, scheme << ": " << slope(dt, found));
    }
}

// The element at an end misses u_xx ~ s^(p − 2) by h^(p − 3/2) in L², more than h² for p < 7/2.
BOOST_AUTO_TEST_CASE(a_rough_end_lowers_the_order_in_h) {
    for (const std::string base : {"x", "(1 - x)"})
        for (const double power : {3.05, 3.2, 3.4, 3.6, 4.0}) {
            const std::string p = std::to_string(power);
            const std::string rough = base + "^" + p;
            const std::string clamped = base == "x" ? rough : rough + " - 1 + " + p + "*x";
            const Problem problem{
                parse_solution("theta = 't*x*(1 - x)'\nu = 't*(" + clamped + ")'\n", "rough.toml"),
                {0.0, 0.15, 0.0, {}},
                1.0};
            const ExpectedOrders expected =
                expected_orders({problem.solution, problem.beam, problem.final_time});
            BOOST_TEST(expected.rough_end.has_value() == (power < 3.5));
            const Forecast in_h =
                std::ranges::find(expected.orders, "u_LinfH2semi", &ExpectedOrder::norm)->in_h;
            const double order = std::min(power - 1.5, 2.0);
            // 1 − x has four digits at the distances from x = 1 that are looked at.
            BOOST_TEST(std::abs(in_h.least - order) < 1e-4, rough << ": " << in_h.least);
            const ProblemData data =
                manufactured_problem({problem.solution, problem.beam, problem.final_time});
            std::vector<double> h;
            std::vector<double> found;
            for (const std::int64_t elements : {64, 128, 256, 512, 1024}) {
                h.push_back(1.0 / static_cast<double>(elements));
                found.push_back(errors(problem, data, "euler", elements, 4)[2]);
            }
            BOOST_TEST(std::abs(slope(h, found) - order) < 0.06,
                       rough << " has the order " << slope(h, found) << ", forecast " << order);
        }
}

// u_xxxx ~ s^(−1/2): the square of it has the integral ln(1/h) from h on, and the element at the
// end misses u_xx by h² sqrt(ln(1/h)), of which no multiple of h² is an error's size.
BOOST_AUTO_TEST_CASE(a_rough_end_at_the_limit_lowers_the_order_by_a_logarithm) {
    for (const std::string rough :
         {"x^(7/2)", "(1 - x)^3.5 - 1 + 3.5*x", "x^(7/2) + x^2*sin(9*x)"}) {
        const Problem problem{
            parse_solution("theta = 't*sin(pi*x)'\nu = '0.05*sin(t)*(" + rough + ")'\n",
                           "rough.toml"),
            {0.0, 0.15, 0.0, {}},
            1.0};
        const ExpectedOrders expected =
            expected_orders({problem.solution, problem.beam, problem.final_time});
        BOOST_REQUIRE(expected.rough_end.has_value());
        BOOST_TEST(expected.rough_end->power == 0.5);
        const Forecast in_h =
            std::ranges::find(expected.orders, "u_LinfH2semi", &ExpectedOrder::norm)->in_h;
        BOOST_TEST(in_h.least == 2.0);
        BOOST_TEST(std::ranges::any_of(expected.reasons, [](const std::string& reason) {
            return reason.find("sqrt(ln(1/h))") != std::string::npos;
        }));
    }
    // With the power 0.52 in place of 1/2 the square is integrable.
    BOOST_TEST(!expected_orders(
                    {parse_solution("theta = 't*sin(pi*x)'\nu = 'sin(t)*x^3.52'\n", "smooth.toml"),
                     {0.0, 0.15, 0.0, {}},
                     1.0})
                    .rough_end);
}

// A layer has a finite slope, however thin it is: nothing of it is a cusp.
BOOST_AUTO_TEST_CASE(a_thin_layer_is_no_cusp) {
    for (const std::string rate : {"1e10", "1e12", "2e12", "4e12", "1e13", "1e15"})
        BOOST_TEST(expected_orders({parse_solution("theta = 't*sin(pi*x)'\n"
                                                   "u = 'x^2*(1 - x)^2*(t + exp(-" +
                                                       rate + "*t)/" + rate + ")'\n",
                                                   "layer.toml"),
                                    {0.0, 0.15, 0.0, {}},
                                    1.0})
                       .cusps.empty(),
                   rate);
}

BOOST_AUTO_TEST_SUITE_END()

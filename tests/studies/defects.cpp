// What a block [defect] adds to a problem, by every path of the solver.

#include "mms/text/input_error.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(defects)

namespace {

/// Two solutions on one beam; from the second follow, by hand, f = θ_t − θ_xx − αu_xxt and μ =
/// −(u_xx + ζu_xxt + αθ).
const std::string first = "theta = 'cos(t)*sin(pi*x) + x*(1 - x)*exp(x*t)'\n"
                          "u = 'k*x^2*(sin(t + x) + 1)'\n[parameters]\nk = 0.02\n";
const std::string second = "theta = '(1 + t)*x*(1 - x)'\nu = 'x^2*(t^2 + 1)/50'\n";
const std::string f = "x*(1 - x) + 2*(1 + t) - alpha*4*t/50";
const std::string mu = "-((2*t^2 + 2 + zeta*4*t)/50 + alpha*(1 + t)*x*(1 - x))";

const std::string beam = "[beam]\nalpha = 0.4\nzeta = 0.15\n";
const std::string evolution = "[evolution]\nfinal_time = 1\nelements = 7\ndt = 0.05\n"
                              "probes = ['theta@0.3', 'u@0.6', 'u@1', 'energy']\n";

StudyResult result_of(const std::string& solution, const std::string& scene,
                      const std::vector<std::string>& overrides) {
    const TemporaryDirectory directory;
    directory.write("solution.toml", solution);
    return run_study(read_scene(
        directory.write("scene.toml", "solution = './solution.toml'\n" + scene), overrides));
}

/// The greatest difference of two histories, over the greatest value.
double difference(const StudyResult& one, const StudyResult& other) {
    double difference = 0.0;
    double greatest = 0.0;
    const auto& probes = one.get<EvolutionResult>()->probes;
    for (std::size_t k = 0; k < probes.size(); ++k)
        for (std::size_t i = 0; i < probes[k].values.size(); ++i) {
            const double value = other.get<EvolutionResult>()->probes[k].values[i];
            difference = std::max(difference, std::abs(probes[k].values[i] - value));
            greatest = std::max(greatest, std::abs(value));
        }
    return difference / greatest;
}

const std::vector<std::vector<std::string>> paths{
    {"scheme.time=euler"},
    {"scheme.time=bdf2", "scheme.thermal_mass=lumped"},
    {"scheme.time=sdirk2"},
    {"scheme.algorithm=fixed-point", "scheme.tolerance=1e-13"},
    {"scheme.algorithm=fixed-point", "scheme.tolerance=1e-13", "scheme.time=sdirk2"}};

double round_off(const std::vector<std::string>& path) {
    return path.front().find("fixed") == std::string::npos ? 1e-13 : 1e-10;
}

} // namespace

BOOST_AUTO_TEST_CASE(that_are_the_difference_of_two_problems_turn_one_into_the_other) {
    const std::string defect = "[defect]\n"
                               "heat_source = '(" +
                               f +
                               ") - (theta_t - theta_xx - alpha*u_xxt)'\n"
                               "moment_load = '(" +
                               mu +
                               ") + u_xx + zeta*u_xxt + alpha*theta'\n"
                               "theta0 = 'x*(1 - x) - theta'\n"
                               "u0 = 'x^2/50 - k*x^2*(sin(x) + 1)'\n";
    for (const auto& path : paths) {
        const auto wanted = result_of(second, beam + evolution, path);
        BOOST_TEST(difference(result_of(first, beam + evolution, path), wanted) > 1e-2);
        BOOST_TEST(difference(result_of(first, beam + evolution + defect, path), wanted) <
                   round_off(path));
    }
}

// By (2), the moment of a body force is ∫_y^1 (x − y) q dx: of x t it is t ((1 − y³)/3 −
// y (1 − y²)/2); of e^(ax) it is e^a ((1 − y)/a − 1/a²) + e^(ay)/a², whether a is 1 or 1 + t, which
// does not separate.
BOOST_AUTO_TEST_CASE(of_a_body_force_and_of_its_moment_load_are_the_same) {
    for (const auto& path : paths)
        for (const auto& [q, moment] :
             {std::pair{"x*t", "t*((1 - x^3)/3 - x*(1 - x^2)/2)"},
              {"t*exp(x)", "t*(exp(x) - x*exp(1))"},
              {"exp(x*(1 + t))", "exp(1 + t)*((1 - x)/(1 + t) - 1/(1 + t)^2) + "
                                 "exp(x*(1 + t))/(1 + t)^2"}}) {
            const auto with = [&](const std::string& defect) {
                return result_of(first, beam + evolution + "[defect]\n" + defect, path);
            };
            const double found = difference(with("body_force = '" + std::string(q) + "'"),
                                            with("moment_load = '" + std::string(moment) + "'"));
            BOOST_TEST(found < round_off(path), q << ": " << found);
        }
}

// A defect that names h and dt is in each run the one with their numbers.
BOOST_AUTO_TEST_CASE(know_the_width_and_the_step_of_each_run) {
    const std::string ladder = "[ladder]\nfinal_time = 0.1\nelements = [4, 8]\n"
                               "dt = [0.05, 0.02]\nnorms = ['theta_L2L2', 'u_LinfH2semi']\n";
    const auto errors = [&](const std::string& source, std::size_t level) {
        const auto result = result_of(
            second, beam + ladder + "[defect]\nheat_source = '" + source + "*sin(pi*x)'\n", {});
        return result.get<LadderResult>()->rungs[level].errors;
    };
    for (const std::size_t level : {0, 1}) {
        const std::string h = level == 0 ? "1/4" : "1/8";
        const std::string dt = level == 0 ? "1/20" : "1/50";
        const auto named = errors("1000*h*dt^2", level);
        const auto written = errors("1000*" + h + "*(" + dt + ")^2", level);
        for (std::size_t k = 0; k < named.size(); ++k)
            BOOST_TEST(std::abs(named[k] - written[k]) < 1e-14 * written[k]);
        BOOST_TEST(named != errors("1000*" + h + "*(1/30)^2", level));
    }
}

// In sines as in nodal values, also where a source of the defect alone does not separate.
BOOST_AUTO_TEST_CASE(are_the_same_in_sines_and_in_nodal_values) {
    const std::string scene = beam + "[ladder]\nfinal_time = 0.5\nelements = [8, 16]\n"
                                     "dt = [0.05, 0.025]\nnorms = ['theta_L2L2', 'u_LinfH2semi']\n"
                                     "[defect]\nu0 = 'x^2/100'\nmoment_load = 't*exp(x)'\n";
    for (const auto& [source, sines] : {std::pair{"exp(x + t)", true}, {"exp(x*t)", false}}) {
        const std::string all = scene + "heat_source = '" + source + "'\n";
        const auto automatic = result_of(second, all, {});
        const auto nodal = result_of(second, all, {"scheme.basis=nodal"});
        for (std::size_t level : {0, 1}) {
            const auto& run = automatic.get<LadderResult>()->rungs[level];
            const auto& other = nodal.get<LadderResult>()->rungs[level];
            BOOST_TEST((run.count("sine_steps") > 0) == sines);
            for (std::size_t k = 0; k < run.errors.size(); ++k)
                BOOST_TEST(std::abs(run.errors[k] - other.errors[k]) < 1e-10 * other.errors[k]);
        }
    }
}

// The reference is the problem's: the run on its own mesh, which else has no error, has the
// defect's.
BOOST_AUTO_TEST_CASE(are_not_added_to_the_reference) {
    const std::string scene = beam + "[reference]\nelements = 16\ndt = 0.025\n"
                                     "[ladder]\nfinal_time = 0.5\nelements = [8, 16]\n"
                                     "dt = [0.05, 0.025]\nnorms = ['theta_L2L2']\n";
    const auto last = [&](const std::string& defect) {
        return result_of(second, scene + defect, {}).get<LadderResult>()->rungs[1].errors[0];
    };
    const double error = last("[defect]\nheat_source = 'sin(pi*x)'\n");
    BOOST_TEST(last("") == 0.0);
    BOOST_TEST(error > 0.0);
    // A linear problem answers a defect of twice the size by twice as much.
    BOOST_TEST(std::abs(last("[defect]\nheat_source = '2*sin(pi*x)'\n") - 2.0 * error) <
               1e-9 * error);
}

BOOST_AUTO_TEST_CASE(that_cannot_be_are_refused_at_their_place_before_anything_runs) {
    const auto refusal = [](const std::string& defect, const std::string& solution = first) {
        try {
            result_of(solution, beam + evolution + "[defect]\n" + defect, {});
        } catch (const InputError& error) {
            const std::string message = error.what();
            return message.substr(message.find_last_of('/', message.find(".toml:")) + 1);
        }
        return std::string("accepted");
    };
    const auto refused = [&](const std::string& defect, const std::string& message) {
        const std::string found = refusal(defect);
        BOOST_TEST(found.substr(0, message.size()) == message, found);
    };
    refused("", "scene.toml:10:1: a defect is empty");
    refused("heat_source = 'x +* t'", "scene.toml:11:19: ");
    refused("heat_source = 'theta_xt'", "scene.toml:11:16: unknown symbol 'theta_xt'");
    refused("theta0 = 'x*t'", "scene.toml:11:13: unknown symbol 't'");
    refused("body_force = '1/(t - 1)'", "scene.toml:11:15: body_force is not finite");
    refused("u0 = 'x*h'", "scene.toml:11:7: (5): the slope of u0");
    refused("moment_load = 'g1'", "scene.toml:11:16: 'g1' is used");
    refused("couple_load = '1'", "scene.toml:11:1: unknown key 'defect.couple_load'");
    BOOST_TEST(
        refusal("heat_source = 'h'", first + "h = 3\n")
            .starts_with(
                "solution.toml:5:5: the parameter 'h' has a name that [defect] has a meaning for"));
}

BOOST_AUTO_TEST_SUITE_END()

// Solutions in phases: which formula holds at a time level, and what an end within a step costs.

#include "core/run.hpp"
#include "mms/autodiff_problem.hpp"
#include "mms/manufactured_problem.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/study.hpp"
#include "tests/marching.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <tuple>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(phases)

namespace {

const Beam beam{0.3, 0.2, 0.5, {-2.0, 2.0}};

std::string decimal(int tenths) {
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
}

/// The end of a phase that is level n of a run, in decimals whose doubles do not multiply to it:
/// T = k/10, t_n = T n/N = j/10.
struct Coincidence {
    int k, N, n, j;
};

std::ostream& operator<<(std::ostream& stream, const Coincidence& c) {
    return stream << "T = " << decimal(c.k) << ", " << c.N << " steps, end " << decimal(c.j);
}

/// Some of those that an ulp decides wrongly, drawn from all of them with T ≤ 2, N ≤ 60.
std::vector<Coincidence> wrongly_decided(std::size_t count) {
    std::vector<Coincidence> all;
    for (int k = 2; k <= 20; ++k)
        for (int N = 4; N <= 60; ++N)
            for (int n = 2; n + 1 < N; ++n)
                if (const int j = k * n / N; j * N == k * n && k / 10.0 * n / N > j / 10.0)
                    all.push_back({k, N, n, j});
    std::shuffle(all.begin(), all.end(), std::mt19937(11));
    all.resize(count);
    return all;
}

/// Its motion is linear in time up to `end` and after it, and the spaces hold it.
std::string straight(const std::string& end) {
    return "theta = 'theta_A*(1 - x)'\n[[phase]]\nuntil = '" + end +
           "'\nu = '(3*x^2 - x^3)*t/20'\n[[phase]]\nu = '(3*x^2 - x^3)*(2*" + end + " - t)/20'\n";
}

/// θ̃_t jumps, u_xxt too, and nothing is held by any scheme.
std::string curved(const std::string& end) {
    return "[[phase]]\nuntil = '" + end +
           "'\ntheta = 'theta_A*(1 - x) + exp(t)*sin(pi*x)'\nu = 'x^2*(3 - x)*t*exp(t)/60'\n"
           "[[phase]]\ntheta = 'theta_A*(1 - x) + exp(" +
           end + ")*sin(pi*x)*cos(t - " + end + ")'\nu = 'x^2*(3 - x)*(" + end + "*exp(" + end +
           ")/60 - (t - " + end + ")^2/6)'\n";
}

ProblemData problem(const std::string& text, double final_time) {
    return manufactured_problem({parse_solution(text, "phases.toml"), beam, final_time});
}

/// The same with every function read 1e-9 earlier next to the end, where the former phase holds
/// beyond doubt, and without anything said of phases.
ProblemData early(const ProblemData& problem, double end) {
    const auto moved = [end](double t) { return std::abs(t - end) < 1e-9 ? t - 1e-9 : t; };
    ProblemData result = problem;
    result.phase_ends.clear();
    result.amplitudes = [moved, amplitudes = problem.amplitudes](const Eigen::ArrayXd& t) {
        return amplitudes(t.unaryExpr(moved));
    };
    for (Field* field : {&result.heat_source, &result.moment_load, &result.couple_load,
                         &result.body_force, &result.exact->theta, &result.exact->theta_x,
                         &result.exact->u, &result.exact->u_x, &result.exact->u_xx})
        if (field->rest)
            field->rest = [moved, rest = field->rest](const Eigen::ArrayXd& x, double t) {
                return rest(x, moved(t));
            };
    return result;
}

std::vector<double> errors(const Scheme& scheme, const Coincidence& c, const ProblemData& problem,
                           const std::vector<std::string>& norms) {
    RunRequest request{beam, Mesh::uniform(8), scheme, c.k / 10.0, c.N, {}};
    for (const auto& name : norms)
        request.norms.push_back(*Norm::named(name));
    const RunResult result = run(request, problem);
    BOOST_REQUIRE_MESSAGE(result.status == RunStatus::ok, result.reason);
    return result.errors;
}

const std::vector<std::string> sine_norms{"theta_L2L2", "u_LinfH2semi", "sigma_L2"};
const std::vector<std::string> general_norms{"theta_L2H1", "u_LinfL2", "u_L2H2"};

/// straight() in C++, which branches on its end.
struct Straight {
    double end;
    double theta_A;

    template <typename Real>
    Real theta(const Real& x, const Real& /*t*/) const {
        return theta_A * (1.0 - x);
    }
    template <typename Real>
    Real u(const Real& x, const Real& t) const {
        return (3.0 * x * x - x * x * x) * (t <= end ? t : 2.0 * end - t) / 20.0;
    }
};

struct StraightWithEnds : Straight {
    std::vector<double> phase_ends = {end};
};

StudyResult studied(const std::string& solution, const std::string& scene) {
    const TemporaryDirectory directory;
    directory.write("phases.toml", solution);
    return run_study(
        read_scene(directory.write("scene.toml", "solution = './phases.toml'\n" + scene)));
}

std::string scene(const std::string& time, const std::string& ladder) {
    return "[beam]\nalpha = 0.3\nzeta = 0.2\ntheta_A = 0.5\n[scheme]\ntime = '" + time +
           "'\n[ladder]\n" + ladder;
}

} // namespace

// Euler and SDIRK2 are exact for a motion in straight lines whose corner is a level.
BOOST_DATA_TEST_CASE(a_corner_at_a_level_is_met_exactly, data::make(all_runs), scheme) {
    if (scheme.time.history > 0)
        return; // it looks across the corner
    for (const Coincidence& c : wrongly_decided(12))
        BOOST_TEST_CONTEXT(c) {
            const std::string end = decimal(c.j);
            for (const auto& norms : {sine_norms, general_norms})
                for (const double error :
                     errors(scheme, c, problem(straight(end), c.k / 10.0), norms))
                    BOOST_TEST(error < 1e-10);
            for (const double error :
                 errors(scheme, c,
                        autodiff_problem(Straight{c.j / 10.0, beam.theta_A}, beam, c.k / 10.0),
                        sine_norms))
                BOOST_TEST(error < 1e-10);
        }
}

// A level at the end of a phase belongs to it, in sources and exact values alike.
BOOST_DATA_TEST_CASE(a_level_that_ends_a_phase_belongs_to_it, data::make(all_runs), scheme) {
    for (const Coincidence& c : wrongly_decided(12))
        BOOST_TEST_CONTEXT(c) {
            const ProblemData exact = problem(curved(decimal(c.j)), c.k / 10.0);
            for (const auto& norms : {sine_norms, general_norms}) {
                const auto found = errors(scheme, c, exact, norms);
                const auto expected = errors(scheme, c, early(exact, c.j / 10.0), norms);
                for (std::size_t i = 0; i < found.size(); ++i)
                    BOOST_TEST(std::abs(found[i] - expected[i]) < 1e-6 * expected[i] + 1e-10,
                               norms[i] << ": " << found[i] << ", " << expected[i]);
            }
        }
}

// sqrt(2)/10 is no decimal: it is met where the solution says that a phase ends there.
BOOST_AUTO_TEST_CASE(a_solution_in_code_names_the_ends_of_its_phases) {
    const double end = std::sqrt(2.0) / 10.0;
    int past = 0;
    for (int N = 3; N <= 60; ++N)
        for (int n = 1; n < N; ++n) {
            const double final_time = end / n * N;
            if (!(final_time * n / N > end))
                continue;
            ++past;
            StraightWithEnds solution;
            solution.end = end;
            solution.theta_A = beam.theta_A;
            solution.phase_ends = {end};
            const ProblemData problem = autodiff_problem(solution, beam, final_time);
            const RunResult result = run(
                {beam, Mesh::uniform(3), Scheme{}, final_time, N, {*Norm::named("u_LinfH2semi")}},
                problem);
            BOOST_TEST(result.errors.at(0) < 1e-12, final_time << ", " << N);
        }
    BOOST_TEST(past > 10);
}

// θ̃ and u rest while the stress on the tip goes from −1 to −2.
BOOST_AUTO_TEST_CASE(an_evolution_shows_the_phase_that_a_level_ends) {
    for (const Coincidence& c : wrongly_decided(12)) {
        const std::string end = decimal(c.j);
        const TemporaryDirectory directory;
        directory.write("pressed.toml", "theta = '0'\nu = 'g2*(3*x^2 - x^3)/2'\n[[phase]]\n"
                                        "until = '" +
                                            end + "'\nsigma = '-1'\n[[phase]]\nsigma = '-2'\n");
        const auto dt = "evolution.dt=" + message_text(c.k / 10.0 / c.N);
        const auto result = *run_study(read_scene(directory.write("scene.toml", R"toml(
solution = "./pressed.toml"
[beam]
zeta  = 0.1
alpha = 0.2
stops = [-0.1, 0.1]
[evolution]
final_time = )toml" + decimal(c.k) + R"toml(
elements   = 4
dt         = 1
probes     = ["stress"]
)toml"),
                                                  {dt}))
                                 .get<EvolutionResult>();
        const auto level = static_cast<std::size_t>(c.n);
        BOOST_TEST_CONTEXT(c) {
            BOOST_TEST(result.t[level] == c.j / 10.0);
            BOOST_TEST(result.probes[0].exact[level] == -1.0);
            BOOST_TEST(result.probes[0].exact[level + 1] == -2.0);
            BOOST_TEST(result.probes[0].values[level] == -1.0, boost::test_tools::tolerance(1e-9));
            BOOST_TEST(result.probes[0].values[level + 1] == -2.0,
                       boost::test_tools::tolerance(1e-9));
        }
    }
}

BOOST_AUTO_TEST_CASE(a_reference_run_meets_the_end_too) {
    const std::string ladder =
        scene("euler", "final_time = 0.4\nelements = [8, 8, 8]\nnorms = ['u_LinfH2semi']\n");
    for (const std::string steps : {"[0.1, 0.05, 0.025]", "[0.05, 0.025, 0.0125]"})
        for (const std::string richardson : {"false", "true"}) {
            std::string text = ladder;
            text.append("dt = ").append(steps);
            text.append("\n[reference]\nelements = 32\ndt = 0.00625\nrichardson = ");
            text.append(richardson).append("\n");
            const StudyResult result = studied(straight("0.3"), text);
            BOOST_REQUIRE(!result.failed());
            for (const auto& rung : result.get<LadderResult>()->rungs)
                BOOST_TEST(rung.errors.at(0) < 1e-11);
        }
}

// T/3 lies at a third of a step for N = 4, 16, 64, …: the part of the step stays, and the order can
// be seen. The tip is held.
BOOST_DATA_TEST_CASE(an_end_within_a_step_leaves_the_orders_that_are_said,
                     data::make(TimeScheme::names()), time) {
    const std::string held = "[[phase]]\nuntil = '0.1'\ntheta = 'exp(t)*sin(pi*x)'\n"
                             "u = 'g2*(3*x^2 - x^3)/2 + x^2*(1 - x)*t^2'\nsigma = '-1 - t'\n"
                             "[[phase]]\ntheta = 'exp(0.1)*sin(pi*x)'\n"
                             "u = 'g2*(3*x^2 - x^3)/2 + x^2*(1 - x)*(0.11 - t)'\n"
                             "sigma = '-1 - t'\n";
    const StudyResult result = studied(
        held, "[beam]\nalpha = 0.3\nzeta = 0.2\nstops = [-0.1, 0.1]\n[scheme]\ntime = '" + time +
                  "'\n[ladder]\nfinal_time = 0.3\nelements = [256, 256, 256]\n"
                  "dt = [0.0046875, 0.001171875, 0.00029296875]\n"
                  "norms = ['theta_L2L2', 'u_LinfH2semi_sq', 'sigma_L2']\n");
    const auto& norms = result.get<LadderResult>()->norms;
    BOOST_TEST(std::abs(norms[0].orders.back().value() - 1.0) < 0.25);
    BOOST_TEST(std::abs(norms[1].orders.back().value() - 2.0) < 0.25);
    BOOST_TEST(std::abs(norms[2].orders.back().value() - 1.0) < 0.25);
    BOOST_REQUIRE(result.remarks.size() == 1U);
    for (const std::string words :
         {"At t = 0.1,", "theta_t - alpha u_xxt by ", "zeta u_xxt by ",
          "(dt = 0.0046875, 0.001171875",
          // What a held tip has of it, theory says for all places in a step.
          time == "euler" ? "the order 2 in u_LinfH2semi_sq and 1 in theta_L2L2 and sigma_L2"
                          : "the order 2 in u_LinfH2semi_sq, 1 to 2 in sigma_L2 and 1 in "
                            "theta_L2L2"})
        BOOST_TEST(result.remarks[0].find(words) != std::string::npos, result.remarks[0]);
}

// The same of a tip that stops dead, at t = 1 of 3. The constant of Euler is small beside the error
// of order 1.
BOOST_DATA_TEST_CASE(an_impact_within_a_step_leaves_half_an_order_to_the_stress,
                     data::make({"bdf2", "sdirk2"}), time) {
    const StudyResult result = run_study(
        read_scene("impact", {std::string("scheme.time=") + time, "ladder.final_time=3",
                              "ladder.elements=[256,256]", "ladder.dt=[0.01171875,0.0029296875]",
                              "ladder.norms=['sigma_L2']"}));
    BOOST_TEST(std::abs(result.get<LadderResult>()->norms[0].orders.back().value() - 0.5) < 0.1);
    BOOST_REQUIRE(result.remarks.size() == 1U);
    BOOST_TEST(result.remarks[0].find("the order 0.5 to 1.5 in sigma_L2") != std::string::npos,
               result.remarks[0]);
}

// Of the stress both say what theory says: of one whose tip is free, or in a penalised stop, when
// its velocity jumps, and of one that a jump may keep on the stop that it leaves.
BOOST_AUTO_TEST_CASE(the_stress_has_the_orders_that_theory_says) {
    const auto words = [](const std::string& solution, const std::string& beam_text,
                          const std::string& time) {
        const StudyResult result =
            studied(solution, beam_text + "[scheme]\ntime = '" + time +
                                  "'\n[ladder]\nfinal_time = 2\nelements = [4, 4]\n"
                                  "dt = [0.08, 0.016]\nnorms = ['sigma_L2', 'u_LinfH2']\n");
        BOOST_REQUIRE(result.remarks.size() == 1U);
        return result.remarks[0];
    };
    const std::string shape = "*g2*x^2*(3 - x)/2'\n";
    const std::string in_stop = "theta = 0\n[[phase]]\nuntil = 1.01\nu = '1.5*t^2" + shape +
                                "[[phase]]\nu = '1.5*1.01*t" + shape;
    const std::string soft = "[beam]\nalpha = 0.0\nzeta = 0.5\nstops = [-0.2, 0.1]\n"
                             "contact = { law = 'penalty', epsilon = 0.3 }\n";
    const std::string stiff = "[beam]\nalpha = 0.0\nzeta = 0.1\nstops = [-0.2, 0.1]\n"
                              "contact = { law = 'penalty', epsilon = 1e-3 }\n";
    const std::string before = "theta = 0\n[[phase]]\nuntil = 0.49\nu = '(1 - 0.51^2)*t/0.49" +
                               shape + "sigma = 0\n[[phase]]\nuntil = 1\nu = '(1 - (1 - t)^2)" +
                               shape + "sigma = 0\n[[phase]]\nu = '1" + shape +
                               "sigma = '-(t - 1)'\n";
    const std::string rigid = "[beam]\nalpha = 0.0\nzeta = 0.5\nstops = [-0.1, 0.1]\n";
    const std::string release = "[[phase]]\nuntil = 1.01\ntheta = '(1 - x)*sin(x)'\nu = '1" +
                                shape +
                                "sigma = -1\n[[phase]]\ntheta = '(1 - x)*sin(x)*t/1.01'\n"
                                "u = '(1 - (t - 1.01)^3/2)" +
                                shape + "sigma = 0\n";
    const std::string coupled = "[beam]\nalpha = 3.0\nzeta = 0.0\nstops = [-0.2, 0.1]\n";
    for (const auto& [text, time, said] :
         {std::tuple{words(in_stop, soft, "euler"), "euler",
                     "the order 1 in sigma_L2 and u_LinfH2"},
          {words(in_stop, soft, "bdf2"), "bdf2", "the order 1 to 2 in sigma_L2 and 1 in u_LinfH2"},
          {words(in_stop, stiff, "euler"), "euler",
           "the order 0.5 to 1 in sigma_L2 and 0 to 1 in u_LinfH2"},
          {words(before, rigid, "euler"), "euler",
           "the order 1 in u_LinfH2 and 0.5 to 0.75 in sigma_L2"},
          {words(release, coupled, "sdirk2"), "sdirk2",
           "1 to 2 in sigma_L2 (where the error keeps the tip on its stop)"}})
        BOOST_TEST(text.find(said) != std::string::npos, time << ": " << text);
}

BOOST_AUTO_TEST_CASE(an_end_is_spoken_of_where_it_costs_something) {
    const std::string ladder =
        "final_time = 0.4\nelements = [4, 8]\ndt = [0.1, 0.05]\nnorms = ['u_LinfL2']\n";
    for (const std::string& time : TimeScheme::names()) {
        // At a level only a scheme that looks across it pays.
        const auto level = studied(curved("0.3"), scene(time, ladder)).remarks;
        BOOST_TEST(level.size() == (time == "bdf2" ? 1U : 0U));
        if (!level.empty())
            BOOST_TEST(level[0].find("looks back across it") != std::string::npos, level[0]);
        BOOST_TEST(studied(curved("0.29"), scene(time, ladder)).remarks.size() == 1U);
        // After the end of the run nobody sees it.
        BOOST_TEST(studied(curved("0.5"), scene(time, ladder)).remarks.empty());
        BOOST_TEST(studied(curved("0.4"), scene(time, ladder)).remarks.empty());
    }
    // Uncoupled, the temperature has no part in a corner of the deflection.
    for (const std::string norm : {"theta_L2L2", "u_L2H2"})
        BOOST_TEST(
            studied(straight("0.29"), "[beam]\nalpha = 0.0\nzeta = 0.2\n[ladder]\nfinal_time = "
                                      "0.4\nelements = [4]\ndt = [0.1]\nnorms = ['" +
                                          norm + "']\n")
                .remarks.size() == (norm == "u_L2H2" ? 1U : 0U));
    // Where no stop is touched the stress has no error.
    const auto of_stress = [](const std::string& norms) {
        return studied(straight("0.29"), "[beam]\nalpha = 0.3\nzeta = 0.2\nstops = [-1.0, 1.0]\n"
                                         "[ladder]\nfinal_time = 0.4\nelements = [4]\n"
                                         "dt = [0.1]\nnorms = [" +
                                             norms + "]\n")
            .remarks;
    };
    BOOST_TEST(of_stress("'sigma_L2'").empty());
    BOOST_REQUIRE(of_stress("'sigma_L2', 'u_L2H2'").size() == 1U);
    BOOST_TEST(of_stress("'sigma_L2', 'u_L2H2'")[0].find("the order 1 in u_L2H2, and an error") !=
                   std::string::npos,
               of_stress("'sigma_L2', 'u_L2H2'")[0]);
    // Only σ̃ jumps there, and the sources with it.
    const StudyResult table1 = run_study(
        read_scene("table1", {"ladder.elements=[10]", "ladder.dt=[1e-3]", "ladder.printed={}"}));
    BOOST_TEST(table1.remarks.empty());
}

BOOST_AUTO_TEST_SUITE_END()

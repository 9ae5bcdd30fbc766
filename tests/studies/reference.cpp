// Errors against a computed reference: the same orders as against the exact solution, and an honest
// account of the reference's own error.

#include "core/space/cells.hpp"
#include "core/space/linear_elements.hpp"
#include "mms/text/input_error.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/gates/check.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/reference/piecewise_polynomial.hpp"
#include "studies/reference/reference_solution.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <tuple>

using namespace tvbeam;
using Eigen::ArrayXd;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(references)

namespace {

const std::string free_beam = R"(solution = "free-oscillation"
[beam]
alpha = 0.3
zeta = 0.05
stops = [-0.1, 0.1]
)";

const std::string pressed_beam = R"(solution = "pressed-on-g1"
[beam]
alpha = 0.4
zeta = 0.15
stops = [-0.05, 0.1]
)";

const std::string grid = R"([orders]
final_time = 1
elements = [8, 16, 32, 64]
dt = [0.02, 0.01, 0.005, 0.0025]
norms = ["theta_L2L2", "u_LinfH2semi"]
)";

const std::string steps = R"([ladder]
final_time = 1
elements = [8, 16, 32]
dt = [0.02, 0.01, 0.005]
norms = ["theta_L2L2", "u_L2H2"]
)";

std::string reference(int elements, const std::string& dt, bool richardson = false) {
    return "[reference]\nelements = " + std::to_string(elements) + "\ndt = " + dt +
           "\nrichardson = " + (richardson ? "true" : "false") + "\n";
}

Scene scene_of(const std::string& text) {
    const TemporaryDirectory directory;
    return read_scene(directory.write("scene.toml", text));
}

StudyResult study_of(const std::string& text) {
    return run_study(scene_of(text));
}

LadderResult ladder_of(const std::string& text) {
    return *study_of(text).get<LadderResult>();
}

/// The greatest distance of a reference from the exact solution, at the levels of one rung, field
/// by field: θ̃, θ̃_x, u, u_x, u_xx, σ̃.
std::vector<double> distances(const Scene& scene) {
    const double final_time = scene.get<LadderBlock>()->final_time;
    const ProblemData exact = problem_of(scene, final_time);
    ProblemData computed = problem_of(scene, final_time);
    BOOST_REQUIRE(measure_against_reference(scene, computed).failure.empty());
    const ArrayXd x = ArrayXd::LinSpaced(203, 0.001, 0.999);
    std::vector<double> result(6, 0.0);
    const Rung& rung = scene.get<LadderBlock>()->rungs.front();
    for (std::int64_t n = 1; n <= rung.steps; ++n) {
        const double t = final_time * static_cast<double>(n) / static_cast<double>(rung.steps);
        std::size_t at = 0;
        for (const auto field : {&ExactSolution::theta, &ExactSolution::theta_x, &ExactSolution::u,
                                 &ExactSolution::u_x, &ExactSolution::u_xx}) {
            const ArrayXd error = values(computed, (*computed.exact).*field, x, t) -
                                  values(exact, (*exact.exact).*field, x, t);
            result[at] = std::max(result[at], error.abs().maxCoeff());
            ++at;
        }
        const auto stress = [t](const ProblemData& problem) {
            return problem.exact->stress
                       ? problem.amplitudes(ArrayXd::Constant(1, t))(*problem.exact->stress, 0)
                       : 0.0;
        };
        result[at] = std::max(result[at], std::abs(stress(computed) - stress(exact)));
    }
    return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(piecewise_cubics_reproduce_cubics_and_integrate_what_they_differentiate) {
    const auto f = [](const ArrayXd& x) -> ArrayXd { return x.cube() - 2.0 * x.square() + 0.5; };
    const ArrayXd nodes = ArrayXd::LinSpaced(6, 0.0, 1.0);
    const ArrayXd x = ArrayXd::LinSpaced(38, 0.0, 1.0);
    const auto p = PiecewisePolynomial::cubic(f(nodes).matrix());
    BOOST_TEST((p(x) - f(x)).abs().maxCoeff() < 1e-14);
    BOOST_TEST((p.derivative()(x) - (3.0 * x.square() - 4.0 * x)).abs().maxCoeff() < 1e-13);
    BOOST_TEST((p.derivative().integral()(x) - (f(x) - 0.5)).abs().maxCoeff() < 1e-14);
    // Of x⁴ in the middle of an inner element the cubic through its four nearest nodes misses
    // 9/16 h⁴; one to a side would miss more.
    const auto quartic = PiecewisePolynomial::cubic(nodes.pow(4).matrix());
    const ArrayXd middle = ArrayXd::LinSpaced(3, 0.3, 0.7);
    BOOST_TEST(
        ((quartic(middle) - middle.pow(4)).abs() / std::pow(0.2, 4) - 9.0 / 16.0).abs().maxCoeff() <
        1e-10);
    BOOST_CHECK_THROW(PiecewisePolynomial::cubic(Eigen::Vector3d::Zero()), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(equal_cells_are_exact_for_a_kink_between_them) {
    const SpaceFunction kink = [](const ArrayXd& x) -> ArrayXd { return (x - 1.0 / 3.0).abs(); };
    const Mesh one = Mesh::uniform(1);
    const double integral = hat_loads(with_equal_cells(one, 3), kink).sum();
    BOOST_TEST(std::abs(integral - 5.0 / 18.0) < 1e-15);
    BOOST_TEST(std::abs(hat_loads(one, kink).sum() - 5.0 / 18.0) > 1e-4);
}

BOOST_AUTO_TEST_CASE(a_reference_gives_the_orders_that_the_exact_solution_gives) {
    const OrdersResult exact = *study_of(free_beam + grid).get<OrdersResult>();
    const auto hold = [&](const std::string& block, double orders, double constants) {
        const StudyResult study = study_of(free_beam + grid + block);
        BOOST_REQUIRE(study.reference);
        for (std::size_t k = 0; k < exact.norms.size(); ++k) {
            const TwoTermFit& fit = study.get<OrdersResult>()->norms[k].fit;
            const TwoTermModel& wanted = exact.norms[k].fit.model;
            BOOST_REQUIRE(fit.holds());
            BOOST_TEST(std::abs(fit.model.p - wanted.p) < orders, fit.model.p << " " << wanted.p);
            BOOST_TEST(std::abs(fit.model.q - wanted.q) < orders, fit.model.q << " " << wanted.q);
            // Both terms where the runs are.
            BOOST_TEST(std::abs(fit.model.spatial(1.0 / 32) / wanted.spatial(1.0 / 32) - 1.0) <
                       constants);
            BOOST_TEST(std::abs(fit.model.temporal(5e-3) / wanted.temporal(5e-3) - 1.0) <
                       constants);
        }
    };
    // Half of the finest Δt: without the account of its error, q would be 1.18.
    hold(reference(256, "1.25e-3"), 0.02, 0.03);
    hold(reference(256, "6.25e-4"), 0.02, 0.02);
    hold(reference(128, "1.25e-3", true), 1e-3, 0.002);
}

BOOST_AUTO_TEST_CASE(
    an_extrapolated_reference_is_closer_to_the_exact_solution_than_its_finest_run) {
    for (const auto& beam : {free_beam, pressed_beam}) {
        const auto finest = distances(scene_of(beam + steps + reference(32, "2.5e-3")));
        const auto extrapolated = distances(scene_of(beam + steps + reference(32, "2.5e-3", true)));
        for (std::size_t k = 0; k < 5; ++k)
            BOOST_TEST(extrapolated[k] < 0.1 * finest[k],
                       "field " << k << ": " << extrapolated[k] << " of " << finest[k]);
        if (beam == pressed_beam) {
            BOOST_TEST(finest[5] > 0.0);
            BOOST_TEST(extrapolated[5] < 0.1 * finest[5]);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_rung_that_is_the_reference_has_no_error_and_no_order) {
    const StudyResult study = study_of(free_beam + steps + reference(32, "5e-3"));
    const LadderResult& ladder = *study.get<LadderResult>();
    for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
        BOOST_TEST(ladder.rungs[1].errors[k] > 1e-5);
        BOOST_TEST(ladder.rungs[2].errors[k] == 0.0);
        BOOST_TEST(ladder.norms[k].orders[1].has_value());
        BOOST_TEST(!ladder.norms[k].orders[2].has_value());
        BOOST_TEST((ladder.norms[k].verdicts[2].verdict == Verdict::exact));
    }
    // The rung before it is within a factor of two, the first is not.
    const std::string& remark = ladder.reference_remark;
    BOOST_TEST(remark.find("s = 16 (dt = 0.01), s = 32 (dt = 0.005)") != std::string::npos, remark);
    BOOST_TEST(remark.find("s = 8 ") == std::string::npos, remark);
}

BOOST_AUTO_TEST_CASE(a_norm_integrates_the_kinks_of_the_reference_exactly) {
    // One step: the error is piecewise linear on the mesh of the reference.
    const std::string rung =
        "[ladder]\nfinal_time = 0.1\nelements = [5]\ndt = [0.1]\nnorms = [\"theta_LinfL2\"]\n";
    const Mesh fine = Mesh::uniform(15);
    const auto nodal = [&](int elements) {
        const Scene scene = scene_of(free_beam + rung + reference(elements, "0.1"));
        ProblemData problem = problem_of(scene, 0.1);
        measure_against_reference(scene, problem);
        return problem.exact->theta.rest(fine.nodes, 0.1);
    };
    const double wanted = std::sqrt(squared_norm(fine, (nodal(15) - nodal(5)).matrix()));
    const StudyResult study = study_of(free_beam + rung + reference(15, "0.1"));
    BOOST_TEST(std::abs(study.get<LadderResult>()->rungs[0].errors[0] / wanted - 1.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_rung_close_to_the_reference_in_dt_alone_is_remarked) {
    const std::string remark =
        ladder_of(free_beam + steps + reference(96, "2.5e-3")).reference_remark;
    BOOST_TEST(remark.starts_with("The level s = 32 (dt = 0.005) has"), remark);
}

BOOST_AUTO_TEST_CASE(rungs_far_from_the_reference_or_one_extrapolated_are_not_remarked) {
    const std::string measured = free_beam + steps;
    for (const auto& block : {reference(1600, "1e-4"), reference(32, "2.5e-3", true)})
        BOOST_TEST(ladder_of(measured + block).reference_remark.empty());
}

// A reference with h/3 and Δt/5 has 1/3 and 1/5 of a first-order error, 1/9 and 1/25 of a
// second-order one.
BOOST_AUTO_TEST_CASE(what_the_reference_has_of_the_finest_error_is_said) {
    const std::string remark =
        ladder_of(free_beam + steps + reference(96, "1e-3")).reference_remark;
    BOOST_TEST(remark.find("33 % of a first-order part in h and 11 % of a second-order one, 20 % "
                           "of a first-order part in dt and 4 % of a second-order one") !=
                   std::string::npos,
               remark);
}

// Of a square 1 − (1 − r)² of it is missing where r of the error is.
BOOST_AUTO_TEST_CASE(what_the_reference_has_of_the_finest_square_is_said) {
    const std::string ladder = "[ladder]\nfinal_time = 1\nelements = [8, 16, 32]\n"
                               "dt = [0.02, 0.01, 0.005]\n";
    const std::string squares = "; their squares by up to 56 % of a first-order part in h and 21 % "
                                "of a second-order one, 36 % of a first-order part in dt and 7.8 % "
                                "of a second-order one. richardson";
    for (const auto& [norm, is_square] :
         {std::pair{"theta_L2L2_sq", true}, {"corollary", true}, {"theta_L2L2", false}}) {
        const std::string remark =
            ladder_of(free_beam + ladder + "norms = ['" + norm + "']\n" + reference(96, "1e-3"))
                .reference_remark;
        BOOST_TEST((remark.find(squares) != std::string::npos) == is_square, remark);
    }
}

// Errors of Euler's steps alone: every level lacks the error in h, and no order does.
BOOST_AUTO_TEST_CASE(a_width_that_no_rung_refines_brings_none_close_to_the_reference) {
    const std::string steps_alone = R"([ladder]
final_time = 1
elements = [32, 32, 32]
dt = [0.02, 0.01, 0.005]
norms = ["theta_L2L2"]
)";
    const LadderResult ladder = ladder_of(free_beam + steps_alone + reference(32, "2e-4"));
    BOOST_TEST(std::abs(*ladder.norms[0].orders[2] - 1.0) < 0.05);
    BOOST_TEST(ladder.reference_remark.find("within a factor") == std::string::npos);
    BOOST_TEST(ladder.reference_remark.find("all of the part in h, 4 % of a first-order part in "
                                            "dt") != std::string::npos,
               ladder.reference_remark);
    BOOST_TEST(ladder_of(free_beam + steps_alone + reference(32, "2.5e-3"))
                   .reference_remark.starts_with("The level s = 32 (dt = 0.005) has"));
}

// theta0 is 0 where theta_A is 1.
BOOST_AUTO_TEST_CASE(an_extrapolated_reference_of_a_jump_is_remarked) {
    const auto remark_of = [](const std::string& beam, bool richardson) {
        return ladder_of("[data]\nheat_source = '0'\n[beam]\nalpha = 0\nzeta = 0.1\n" + beam +
                         "[ladder]\nfinal_time = 0.1\nelements = [4, 8]\ndt = [0.1, 0.05]\n"
                         "norms = [\"theta_L2L2\"]\n" +
                         reference(32, "0.0125", richardson))
            .reference_remark;
    };
    BOOST_TEST(remark_of("theta_A = 1\n", true).find("the temperature jumps at t = 0") !=
               std::string::npos);
    BOOST_TEST(remark_of("", true).empty());
    // sin(pi) is zero but for rounding.
    BOOST_TEST(ladder_of("[data]\ntheta0 = 'sin(pi*(1 - x))'\n[beam]\nalpha = 0\nzeta = 0.1\n"
                         "[ladder]\nfinal_time = 0.1\nelements = [4, 8]\ndt = [0.1, 0.05]\n"
                         "norms = [\"theta_L2L2\"]\n" +
                         reference(32, "0.0125", true))
                   .reference_remark.empty());
    // Nor is it recommended.
    BOOST_TEST(remark_of("theta_A = 1\n", false).ends_with("A finer one has less."));
    BOOST_TEST(remark_of("", false).ends_with(
        "richardson = true extrapolates that away, if the solution is smooth."));
}

// Errors against one that Richardson extrapolates were 0.6 of the true ones at a phase end within
// a step, and nothing said so.
BOOST_AUTO_TEST_CASE(a_reference_of_a_solution_whose_rates_jump_is_remarked_like_a_jump) {
    const auto remark_of = [](const std::string& second, bool richardson) {
        const TemporaryDirectory directory;
        directory.write("bent.toml",
                        "[[phase]]\nuntil = 0.47\ntheta = 'sin(pi*x)*t'\nu = 'x^2*t/50'\n"
                        "[[phase]]\ntheta = '" +
                            second + "'\nu = 'x^2*t/50'\n");
        const std::string scene =
            directory.write("scene.toml", "solution = 'bent.toml'\n[beam]\nalpha = 0.3\n"
                                          "zeta = 0.1\n[ladder]\nfinal_time = 1\n"
                                          "elements = [4, 8]\ndt = [0.1, 0.05]\n"
                                          "norms = ['theta_L2L2']\n" +
                                              reference(32, "0.0125", richardson));
        return run_study(read_scene(scene)).get<LadderResult>()->reference_remark;
    };
    const std::string bent = "sin(pi*x)*(0.94 - t)";
    const std::string smooth = "sin(pi*x)*t + 0";
    BOOST_TEST(remark_of(bent, true).find("rates jump in time") != std::string::npos,
               remark_of(bent, true));
    BOOST_TEST(remark_of(bent, false).ends_with("A finer one has less."), remark_of(bent, false));
    BOOST_TEST(remark_of(smooth, true).empty(), remark_of(smooth, true));
}

// Without viscosity u_xx goes to −αθ − μ + λ(1 − x) at once. Of θ0 = 12 x (1 − x), α = 1/2 and a
// body force of 8 that is −6 x (1 − x) − 4 (1 − x)² + λ(1 − x); with λ = 3 the tip is at −1/2.
BOOST_AUTO_TEST_CASE(initial_data_that_are_not_in_balance_are_remarked_like_a_jump) {
    struct Start {
        std::string theta0, u0, force, beam;
        std::string jump; ///< what is said of it; empty: nothing
    };
    const std::string at_once = "the temperature jump at t = 0";
    const std::string soon = "relaxes within about 0.0004 from t = 0";
    const std::string bent = "0.1*x^2*(3 - x)";
    const std::string balanced = "x^4/2 - x^3"; // u_xx = −6 x (1 − x)
    for (const auto& [theta0, u0, force, beam, jump] : std::vector<Start>{
             {"sin(pi*x)", bent, "0", "alpha = 0.5\nzeta = 0\n", at_once},
             {"sin(pi*x)", bent, "0", "alpha = 0.5\nzeta = 5e-4\n", soon},
             {"sin(pi*x)", bent, "0", "alpha = 0.5\nzeta = 0.1\n", ""},
             {"sin(pi*x)", bent, "0", "alpha = 0\nzeta = 0\n", ""}, // no step remembers u
             {"12*x*(1 - x)", balanced, "0", "alpha = 0.5\nzeta = 0\n", ""},
             {"12*x*(1 - x)", balanced, "0", "alpha = 0.5\nzeta = 5e-4\n", ""},
             {"12*x*(1 - x)", balanced, "1", "alpha = 0.5\nzeta = 0\n", at_once},
             {"12*x*(1 - x)", balanced, "sin(t)", "alpha = 0.5\nzeta = 0\n", ""},
             // The tip is at −1/2, where it is free as without the stop, or pressed.
             {"12*x*(1 - x)", balanced, "0", "alpha = 0.5\nzeta = 0\nstops = [-0.5, 1]\n", ""},
             {"12*x*(1 - x)", balanced, "8", "alpha = 0.5\nzeta = 0\nstops = [-0.5, 1]\n", at_once},
             {"12*x*(1 - x)", "(x^4 - x^3)/6 - x^2/2", "8",
              "alpha = 0.5\nzeta = 0\nstops = [-0.5, 1]\n", ""}}) {
        const std::string scene = "[data]\ntheta0 = '" + theta0 + "'\nu0 = '" + u0 +
                                  "'\nbody_force = '" + force + "'\n[beam]\n" + beam +
                                  "[ladder]\nfinal_time = 0.1\nelements = [4, 8]\n" +
                                  "dt = [0.02, 0.01]\nnorms = ['theta_L2L2']\n";
        const auto remark_of = [&](bool richardson) {
            return ladder_of(scene + reference(32, "0.0025", richardson)).reference_remark;
        };
        BOOST_TEST_INFO(theta0 << ", " << u0 << ", " << force << ", " << beam);
        if (jump.empty()) {
            BOOST_TEST(remark_of(true).empty(), remark_of(true));
            BOOST_TEST(remark_of(false).ends_with(
                "richardson = true extrapolates that away, if the solution is smooth."));
        } else {
            BOOST_TEST(remark_of(true).find(jump) != std::string::npos, remark_of(true));
            BOOST_TEST(remark_of(false).ends_with("A finer one has less."));
        }
    }
}

// Of a beam without memory, whose tip answers to the load of its time alone: an extrapolated
// reference adds its own rounding, with weights that are 11/3 together.
BOOST_AUTO_TEST_CASE(rounding_against_a_reference_is_no_order) {
    const std::string measured = "[data]\nbody_force = '100*cos(2*pi*t)'\n"
                                 "u0 = '-0.05*x^2*(3 - x)'\n[beam]\nalpha = 0\nzeta = 0\n"
                                 "stops = [-0.1, 0.1]\n[ladder]\nfinal_time = 1\n"
                                 "elements = [4, 8, 16]\ndt = [0.1, 0.05, 0.02]\n"
                                 "norms = ['u_LinfH2', 'sigma_L2']\n";
    const LadderResult ladder = ladder_of(measured + reference(64, "0.005", true));
    const LadderNorm& stress = ladder.norms[1];
    BOOST_TEST(std::abs(*ladder.norms[0].orders[2] - 2.0) < 0.05);
    BOOST_REQUIRE(stress.remarks.size() == 1u);
    BOOST_TEST(stress.remarks[0].starts_with("sigma_L2: no error is larger than rounding may be"),
               stress.remarks[0]);
    for (const auto& row : stress.verdicts)
        BOOST_TEST((row.verdict == Verdict::unresolved), row.reason);
}

BOOST_AUTO_TEST_CASE(the_stress_is_measured_against_the_reference_s) {
    const std::string ladder = R"([ladder]
final_time = 2
elements = [8, 16]
dt = [0.02, 0.01]
norms = ["sigma_L2"]
)";
    const LadderResult exact = ladder_of(pressed_beam + ladder);
    const std::string measured = pressed_beam + ladder;
    for (const auto& [block, tolerance] : {std::pair{reference(256, "6.25e-4"), 0.08},
                                           std::pair{reference(64, "2.5e-3", true), 0.02}}) {
        const LadderResult found = ladder_of(measured + block);
        for (std::size_t i = 0; i < 2; ++i) {
            const double ratio = found.rungs[i].errors[0] / exact.rungs[i].errors[0];
            BOOST_TEST(std::abs(ratio - 1.0) < tolerance, ratio);
        }
    }
}

BOOST_DATA_TEST_CASE(a_reference_serves_every_time_scheme, data::make(TimeScheme::names()), time) {
    // The reference's own error is (1/8)² of the finer rung's in h, and in Δt as little or less;
    // that of the extrapolated one is of higher order.
    const std::string measured = free_beam + "[scheme]\ntime = '" + time + "'\n" +
                                 "[ladder]\nfinal_time = 1\nelements = [32, 64]\n"
                                 "dt = [0.1, 0.05]\nnorms = ['theta_L2L2', 'u_LinfH2semi']\n";
    const LadderResult exact = ladder_of(measured);
    for (const auto& block : {reference(512, "7.8125e-4"), reference(256, "0.0125", true)}) {
        const LadderResult found = ladder_of(measured + block);
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t k = 0; k < 2; ++k) {
                const double ratio = found.rungs[i].errors[k] / exact.rungs[i].errors[k];
                BOOST_TEST(std::abs(ratio - 1.0) < 0.03, ratio);
            }
    }
}

BOOST_AUTO_TEST_CASE(predictions_are_of_what_is_measured_against_the_reference) {
    const std::string ladder = R"([ladder]
final_time = 1
elements = [32, 64, 128]
dt = [0.01, 0.005, 0.0025]
norms = ["theta_L2L2_sq"]
)";
    const StudyResult study = study_of(free_beam + grid + ladder + reference(256, "1.25e-3"));
    const LadderNorm& norm = study.get<LadderResult>()->norms.front();
    for (std::size_t i = 0; i < 3; ++i) {
        const double ratio =
            study.get<LadderResult>()->rungs[i].errors[0] / norm.predictions[i].value;
        BOOST_TEST(std::abs(ratio - 1.0) < 0.03, ratio);
    }
    // The measured orders rise towards the reference; the model knows better.
    BOOST_TEST(*norm.orders[2] > 2.8);
    BOOST_TEST(norm.remarks.empty()); // all but one rung are close to the reference in dt or h
    BOOST_TEST((norm.verdicts[2].verdict == Verdict::asymptotic), norm.verdicts[2].reason);
}

BOOST_AUTO_TEST_CASE(a_reference_is_not_known_at_a_time_that_no_rung_has) {
    const Scene scene = scene_of(free_beam + steps + reference(32, "2.5e-3"));
    ProblemData problem = problem_of(scene, 1.0);
    measure_against_reference(scene, problem);
    const ArrayXd x = ArrayXd::Constant(1, 0.5);
    BOOST_CHECK_NO_THROW(problem.exact->theta.rest(x, 0.015)); // of the rung with dt = 0.005
    BOOST_CHECK_THROW(problem.exact->theta.rest(x, 0.0175), std::domain_error); // 7 steps of 2.5e-3
    BOOST_CHECK_THROW(problem.exact->u.rest(x, 0.016), std::domain_error);
    BOOST_CHECK_THROW(problem.exact->u.rest(x, 1.02), std::domain_error);
    // A fiftieth of a step off is another time.
    BOOST_CHECK_THROW(problem.exact->theta.rest(x, 0.01505), std::domain_error);
}

BOOST_AUTO_TEST_CASE(
    an_evolution_beside_a_reference_changes_no_error_and_has_its_own_exact_values) {
    // It ends between two steps of the reference.
    const std::string evolution =
        "[evolution]\nfinal_time = 1.4625\nelements = 8\ndt = 0.0125\nprobes = ['u@1']\n";
    for (const auto& beam : {free_beam, pressed_beam})
        for (const bool richardson : {false, true}) {
            const std::string measured = beam + steps + reference(32, "0.0025", richardson);
            const StudyResult alone = study_of(measured);
            const StudyResult beside = study_of(measured + evolution);
            BOOST_TEST(!beside.failed());
            for (std::size_t i = 0; i < 3; ++i)
                BOOST_TEST(beside.get<LadderResult>()->rungs[i].errors ==
                               alone.get<LadderResult>()->rungs[i].errors,
                           boost::test_tools::per_element());
            const ProbeHistory& tip = beside.get<EvolutionResult>()->probes[0];
            BOOST_TEST(tip.exact ==
                           study_of(beam + evolution).get<EvolutionResult>()->probes[0].exact,
                       boost::test_tools::per_element());
            BOOST_TEST(*tip.greatest_error() > 0.0);
        }
}

BOOST_AUTO_TEST_CASE(a_fixed_point_is_measured_against_its_reference) {
    const std::string fixed_point = "[scheme]\nalgorithm = 'fixed-point'\ntolerance = 1e-11\n";
    const std::string curvature =
        "[ladder]\nfinal_time = 1\nelements = [8, 16]\ndt = [0.02, 0.01]\n"
        "norms = ['u_LinfH2semi']\n";
    for (const auto& block : {reference(32, "0.0025"), reference(32, "0.0025", true)}) {
        const LadderResult iterated = ladder_of(free_beam + fixed_point + curvature + block);
        const LadderResult direct = ladder_of(free_beam + curvature + block);
        for (std::size_t i = 0; i < 2; ++i)
            BOOST_TEST(iterated.rungs[i].errors.at(0) == direct.rungs[i].errors.at(0),
                       boost::test_tools::tolerance(1e-6));
    }
}

BOOST_AUTO_TEST_CASE(a_reference_that_fails_fails_every_run_with_its_reason) {
    const StudyResult study = study_of("[data]\ntheta0 = '1e300*sin(pi*x)'\n[beam]\nalpha = 1e100\n"
                                       "zeta = 0\n" +
                                       steps + reference(32, "2.5e-3"));
    BOOST_REQUIRE(study.reference);
    BOOST_TEST(!study.reference->failure.empty());
    BOOST_TEST(study.failed());
    for (const auto& rung : study.get<LadderResult>()->rungs)
        BOOST_TEST(rung.reason.find("the reference run failed: ") != std::string::npos,
                   rung.reason);
}

BOOST_AUTO_TEST_CASE(without_norms_no_reference_is_run) {
    const StudyResult study = study_of(
        free_beam + "[ladder]\nfinal_time = 1\nelements = [8]\ndt = [0.1]\n" + reference(8, "0.1"));
    BOOST_TEST(!study.reference);
    BOOST_TEST(study.left_out.back() == "reference run: no norm asks for it");
}

namespace {

struct Wrong {
    std::string block;
    std::string place; ///< line:column; the block's head is in line 11
    std::string message;
};

std::ostream& operator<<(std::ostream& stream, const Wrong& wrong) {
    return stream << wrong.message;
}

const std::vector<Wrong> wrong_blocks{
    {"dt = 1e-3", "11:1", "reference.elements is missing"},
    {"elements = 96", "11:1", "reference.dt is missing"},
    {"elements = 96\ndt = 1e-3\nrichardsn = true", "14:1",
     "unknown key 'reference.richardsn'; did you mean 'richardson'?"},
    {"elements = 96.0\ndt = 1e-3", "12:12",
     "reference.elements is a number; it must be an integer"},
    {"elements = 96\ndt = 1e-3\nrichardson = 1", "14:14",
     "reference.richardson is an integer; it must be true or false"},
    {"elements = 0\ndt = 1e-3", "12:12", "reference.elements is 0; a mesh has 1 to 10000000"},
    {"elements = 48\ndt = 1e-3", "12:12",
     "reference.elements is 48; it must be a multiple of the 32 of ladder.elements"},
    {"elements = 16\ndt = 1e-3", "12:12",
     "reference.elements is 16, coarser than the 32 of ladder.elements"},
    {"elements = 96\ndt = 0", "13:6", "reference.dt is 0; it must be > 0"},
    {"elements = 96\ndt = 0.01", "13:6",
     "reference.dt is 0.01, coarser than the 0.005 of ladder.dt"},
    {"elements = 96\ndt = 0.0015", "13:6",
     "reference.dt is 0.0015; it must divide the 0.02 of ladder.dt into a whole number of steps, "
     "not 13.3333333333"},
    {"elements = 96\ndt = 1e-300", "13:6", "at most 1e12 are possible"},
    {"elements = 96\ndt = 5e-3\nrichardson = true", "13:6",
     "reference.dt is 0.005; with richardson = true its double, the step of one of the runs, must "
     "be no larger than the 0.005 of ladder.dt"},
    {"elements = 96\ndt = 1e-3\nrichardson = true", "13:6",
     "its double, the step of one of the runs, must divide the 0.005 of ladder.dt into a whole "
     "number of steps, not 2.5"},
    {"elements = 3200000\ndt = 1e-3", "12:12",
     "the reference would keep 50 time levels of 3200000 elements, 3.6 GiB; at most 1 GiB"},
};

} // namespace

BOOST_DATA_TEST_CASE(a_wrong_block_is_told_at_its_place, data::make(wrong_blocks), wrong) {
    const TemporaryDirectory directory;
    const std::string file =
        directory.write("wrong.toml", free_beam + steps + "[reference]\n" + wrong.block + "\n");
    std::string message = "accepted";
    try {
        read_scene(file);
    } catch (const InputError& error) {
        message = error.what();
    }
    BOOST_TEST(message.starts_with(file + ":" + wrong.place + ":"),
               message << " must start with " << file << ":" << wrong.place);
    BOOST_TEST(message.find(wrong.message) != std::string::npos,
               message << " must say " << wrong.message);
}

// Also where a step divides the first dt and not the next.
BOOST_AUTO_TEST_CASE(the_step_that_a_refusal_names_is_taken) {
    for (const auto& [dt, given, named] : {std::tuple("0.1, 0.05", "0.04", "0.025"),
                                           {"0.1, 0.02", "0.015", "0.01"},
                                           {"0.2, 0.125", "0.03", "0.025"}}) {
        const std::string ladder =
            std::string("[ladder]\nfinal_time = 1\nelements = [4, 8]\ndt = [") + dt +
            "]\nnorms = [\"theta_L2L2\"]\n";
        for (const bool richardson : {false, true}) {
            const auto part = [&](const std::string& step) {
                return fmt::format("{:.12g}", std::stod(step) / (richardson ? 2.0 : 1.0));
            };
            BOOST_CHECK_EXCEPTION(
                scene_of(free_beam + ladder + reference(8, part(given), richardson)), InputError,
                [&](const InputError& error) {
                    BOOST_TEST(
                        std::string(error.what()).ends_with("one that does is " + part(named)),
                        error.what());
                    return true;
                });
            BOOST_CHECK_NO_THROW(
                scene_of(free_beam + ladder + reference(8, part(named), richardson)));
        }
    }
}

BOOST_AUTO_TEST_CASE(richardson_needs_an_even_number_of_elements) {
    const std::string ladder =
        "[ladder]\nfinal_time = 1\nelements = [3]\ndt = [0.1]\nnorms = [\"theta_L2L2\"]\n";
    for (const int elements : {3, 9})
        BOOST_CHECK_EXCEPTION(
            scene_of(free_beam + ladder + reference(elements, "0.05", true)), InputError,
            [](const InputError& error) {
                return std::string(error.what()).find("needs an even number, 6 or more") !=
                       std::string::npos;
            });
    BOOST_CHECK_NO_THROW(scene_of(free_beam + ladder + reference(6, "0.05", true)));
}

BOOST_AUTO_TEST_CASE(the_paper_s_second_experiment_has_the_orders_of_the_scheme) {
    const auto all = check(
        run_study(read_scene("figure1-orders", {}, {.short_form = true, .expectations = true})));
    BOOST_TEST(all.size() == 8u);
    for (const auto& one : all)
        BOOST_TEST(one.holds, one.what << " is " << one.found << ", not " << one.expected);
}

// From u = 0 to g2 in the first step of every run; in a stage alone; from one stop to the other.
BOOST_AUTO_TEST_CASE(an_extrapolated_reference_across_any_change_of_contact_is_remarked) {
    const auto remark_of = [](const std::string& u0, const std::string& force,
                              const std::string& beam, const std::string& time) {
        return ladder_of("[data]\ntheta0 = '0'\nu0 = '" + u0 + "'\nbody_force = '" + force +
                         "'\n[beam]\n" + beam + "\nstops = [-0.02, 0.1]\n[scheme]\ntime = '" +
                         time + "'\n[ladder]\nfinal_time = 0.4\nelements = [4, 8]\n" +
                         "dt = [0.04, 0.02]\nnorms = ['sigma_L2']\n" + reference(16, "0.01", true))
            .reference_remark;
    };
    const std::string change = "and a contact begins or ends";
    const std::string beam = "alpha = 0.1\nzeta = 0.1";
    const std::string slack = "alpha = 0\nzeta = 0"; // the tip follows −q/8
    for (const auto& remark :
         {remark_of("0", "-20*(1 + t)", beam, "euler"),
          remark_of("0", "-60*exp(-((t - 0.091716)/0.001)^2)", slack, "sdirk2"),
          remark_of("-0.01*x^2*(3 - x)", "-20*tanh((t - 0.21)/0.001)", slack, "euler")})
        BOOST_TEST(remark.find(change) != std::string::npos, remark);
    BOOST_TEST(remark_of("-0.01*x^2*(3 - x)", "20*(1 + t)", beam, "euler").empty()); // held on g1
}

BOOST_AUTO_TEST_CASE(a_grid_says_what_its_reference_leaves_open) {
    const auto remark_of = [](const std::string& text) {
        return study_of(text).get<OrdersResult>()->reference_remark;
    };
    const std::string forced = "[data]\ntheta0 = '2*sin(pi*x)'\nu0 = '0.05*x^2'\n"
                               "body_force = '5*sin(2*pi*t)*x'\n[beam]\nalpha = 0.3\nzeta = 0.1\n"
                               "stops = [-0.02, 0.1]\n[orders]\nfinal_time = 0.4\n"
                               "elements = [4, 8, 16]\ndt = [0.04, 0.02, 0.01]\n"
                               "norms = ['theta_L2L2']\n";
    BOOST_TEST(remark_of(forced + reference(32, "5e-3", true)).find("a contact begins or ends") !=
               std::string::npos);
    BOOST_TEST(remark_of(forced + reference(64, "2.5e-3")).empty()); // its error is in the model
    const std::string close = remark_of(free_beam + grid + reference(64, "2.5e-3"));
    BOOST_TEST(close.starts_with("The runs with s = 32, s = 64, dt = 0.005, dt = 0.0025 have an h "
                                 "or dt within a factor of two of the reference's"),
               close);
    BOOST_TEST(close.find("One of them is the reference itself") != std::string::npos, close);
}

BOOST_AUTO_TEST_SUITE_END()

// Time schemes are rows of data: each has the order that it claims, whatever solves its stages.

#include "mms/manufactured_problem.hpp"
#include "mms/solution.hpp"
#include "tests/marching.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <stdexcept>

using namespace tvbeam;
namespace data = boost::unit_test::data;

namespace tvbeam {
static std::ostream& operator<<(std::ostream& stream, const TimeScheme& scheme) {
    return stream << scheme.name;
}
} // namespace tvbeam

BOOST_AUTO_TEST_SUITE(time_schemes)

namespace {

/// A row that is not shipped: Alexander's SDIRK3 (1977), L-stable, γ the middle root of
/// γ³ − 3γ² + 3γ/2 − 1/6 = 0. From Δt y_t(Y_i) = (Y_i − y*_i)/γ,
/// y*_2 = y + (c − γ)/γ E_1 and y*_3 = y + (b_1/γ − b_2 (c − γ)/γ²) E_1 + b_2/γ E_2.
TimeScheme sdirk3() {
    const double g = 0.4358665215084589994;
    const double c = (1.0 + g) / 2.0;
    const double b1 = -(6.0 * g * g - 16.0 * g + 1.0) / 4.0;
    const double b2 = (6.0 * g * g - 20.0 * g + 5.0) / 4.0;
    return {"sdirk3",
            3,
            {{1.0 / g, g, {}},
             {1.0 / g, c, {(c - g) / g}},
             {1.0 / g, 1.0, {b1 / g - b2 * (c - g) / (g * g), b2 / g}}},
            0,
            ""};
}

std::vector<TimeScheme> all_rows() {
    std::vector<TimeScheme> rows;
    for (const auto& name : TimeScheme::names())
        rows.push_back(TimeScheme::named(name));
    rows.push_back(sdirk3());
    return rows;
}

const std::vector<std::string> norms{"theta_LinfL2", "u_LinfH2semi"};

/// The errors of a run in time alone: in space the solution is represented exactly.
std::vector<double> errors(const Scheme& scheme, std::int64_t steps) {
    // θ̃ and u_xx are multiples of 1 − x; the error of θ̃ is what the beam's does to it.
    const Beam beam{.alpha = 0.6, .zeta = 0.3, .theta_A = 2.0};
    const std::string text = "theta = 'theta_A*(1 - x)'\nu = '(x^3/6 - x^2/2)*sin(2*t)'";
    const ProblemData problem = manufactured_problem({parse_solution(text, "test"), beam, 1.0});
    std::vector<Norm> asked;
    asked.reserve(norms.size());
    for (const auto& name : norms)
        asked.push_back(*Norm::named(name));
    const RunResult result = run({beam, Mesh::uniform(20), scheme, 1.0, steps, asked}, problem);
    BOOST_REQUIRE_MESSAGE(result.status == RunStatus::ok, result.reason);
    return result.errors;
}

} // namespace

BOOST_DATA_TEST_CASE(last_stage_ends_the_step_and_constants_are_kept, data::make(all_rows()), row) {
    // y* = y^{n−1} for a constant y whatever the weights, because they multiply differences; the
    // derivative of a linear y is exact when c (fraction − Σ weights·times) = 1.
    BOOST_TEST(row.stages.back().fraction == 1.0);
    for (std::size_t i = 0; i < row.stages.size(); ++i) {
        const Stage& stage = row.stages[i];
        double star = 0.0; // of y = t with t_{n−1} = 0, Δt = 1
        for (std::size_t j = 0; j < stage.weights.size(); ++j) {
            const auto history = static_cast<std::size_t>(row.history);
            star += stage.weights[j] * (j < history ? 1.0 : row.stages[j - history].fraction);
        }
        BOOST_TEST(stage.leading * (stage.fraction - star) == 1.0,
                   boost::test_tools::tolerance(1e-14));
    }
}

BOOST_DATA_TEST_CASE(order_is_the_one_claimed,
                     data::make(all_rows()) * data::make({Basis::automatic, Basis::nodal}), row,
                     basis) {
    const Scheme scheme{.time = row, .basis = basis};
    const std::int64_t steps = row.order == 1 ? 1600 : 100 * row.order * row.order;
    const auto coarse = errors(scheme, steps);
    const auto fine = errors(scheme, 2 * steps);
    for (std::size_t k = 0; k < norms.size(); ++k)
        BOOST_TEST(std::abs(std::log2(coarse[k] / fine[k]) - row.order) <= 0.05,
                   norms[k] << ": " << coarse[k] << ", " << fine[k]);
}

BOOST_AUTO_TEST_CASE(schemes_with_history_begin_with_their_starter) {
    const TimeScheme& bdf2 = TimeScheme::named("bdf2");
    BOOST_TEST(bdf2.at_step(1).name == "sdirk2");
    BOOST_TEST(bdf2.at_step(2).name == "bdf2");
    BOOST_TEST(TimeScheme::named("euler").at_step(1).name == "euler");
    BOOST_CHECK_THROW(TimeScheme::named("rk4"), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(parts_of_a_scheme_are_named_as_in_scenes) {
    BOOST_TEST(name_of(ThermalMass::consistent) == "consistent");
    BOOST_TEST(name_of(ThermalMass::lumped) == "lumped");
    BOOST_TEST(name_of(Algorithm::direct) == "direct");
    BOOST_TEST(name_of(Algorithm::fixed_point) == "fixed-point");
}

BOOST_AUTO_TEST_SUITE_END()

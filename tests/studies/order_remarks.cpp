// What the orders of a ladder mean, in words: a reason is given only where the orders show it.

#include "studies/ladder/order_remarks.hpp"
#include "core/norms/norms.hpp"
#include "core/round_off.hpp"
#include "core/time/time_scheme.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/runs/round_off_remark.hpp"
#include "studies/scene/scene.hpp"
#include "studies/study.hpp"
#include "tests/temporary_directory.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

using namespace tvbeam;
namespace data = boost::unit_test::data;

BOOST_AUTO_TEST_SUITE(order_remarks_in_words)

namespace {

struct Case {
    std::string name;
    std::function<double(double h)> error;
    std::string said;
    std::vector<std::string> not_said;
};

std::ostream& operator<<(std::ostream& stream, const Case& c) {
    return stream << c.name;
}

const std::string cancel = "two terms of the error cancel";
const std::string lower = "a term of lower order takes over";
const std::string settles = "the last two orders agree, as where coarse levels";
const std::string unknown = " is not known";

// h = 1/10, 1/20, …: seven rungs.
const std::vector<Case> cases = {
    // 1/(1/h² + 30/h): from the order 1 up to 2, and never beyond.
    {"order 2 from below",
     [](double h) { return h * h / (1.0 + 30.0 * h); },
     settles,
     {cancel, lower, unknown}},
    // |3 h² − h/8| changes its sign between the second and the third rung.
    {"a change of sign",
     [](double h) { return std::abs(3.0 * h * h - h / 8.0); },
     cancel,
     {settles, lower, unknown}},
    {"a slower term",
     [](double h) { return 3.0 * h * h + h / 40.0; },
     lower,
     {settles, cancel, unknown}},
    {"the order grows",
     [](double h) { return std::pow(h, 1.0 + 0.1 / h / 10.0); },
     unknown,
     {settles, cancel, lower}},
    {"down and up again",
     [](double h) { return h * h * (1.0 + std::exp(-std::pow(std::log2(40.0 * h), 2.0))); },
     unknown,
     {settles, lower}},
};

} // namespace

BOOST_DATA_TEST_CASE(a_reason_is_the_one_that_the_orders_show, data::make(cases)) {
    std::vector<Refinement> ladder;
    for (const double elements : {10.0, 20.0, 40.0, 80.0, 160.0, 320.0, 640.0})
        ladder.push_back({.h = 1.0 / elements, .error = sample.error(1.0 / elements)});
    const auto remarks = order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, nullptr);
    BOOST_REQUIRE(remarks.size() == 1U);
    BOOST_TEST(remarks[0].find(sample.said) != std::string::npos, remarks[0]);
    for (const auto& wrong : sample.not_said)
        BOOST_TEST(remarks[0].find(wrong) == std::string::npos, remarks[0]);
}

// Roots of order 2: their squares have the order 4.
BOOST_AUTO_TEST_CASE(orders_that_alternate_go_to_and_fro) {
    std::vector<Refinement> ladder;
    double error = 1.0;
    for (int i = 0; i < 9; ++i) {
        ladder.push_back({.h = 0.25 / (1 << i), .error = error});
        error /= std::exp2(i % 2 == 0 ? 2.58 : 1.42);
    }
    const auto remarks = order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, nullptr);
    BOOST_REQUIRE(remarks.size() == 1U);
    BOOST_TEST(remarks[0] == "theta_L2L2: order 2.58 up to s = 8; then it goes to and fro, between "
                             "1.42 and 2.58; it has not settled, and why is not known.");
    // A dip is none.
    ladder.resize(4);
    BOOST_TEST(order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, nullptr)[0].find(
                   "to and fro") == std::string::npos);
    // Nor is an error that grows, or orders that rise from pair to pair.
    const auto remark = [](const std::vector<double>& orders) {
        std::vector<Refinement> rows{{.h = 0.25, .error = 1.0}};
        for (const double order : orders)
            rows.push_back(
                {.h = rows.back().h / 2, .error = rows.back().error * std::exp2(-order)});
        return order_remarks(measure_of(*Norm::named("theta_L2L2")), rows, nullptr).front();
    };
    BOOST_TEST(remark({1, -2, 1, -2, 1, -2}).find("no longer shrinks") != std::string::npos);
    // Those of an error that hangs on where a time level is have a scatter of their own.
    const auto wild = remark({2.31, -0.68, 2.49, -0.39, 2.58});
    BOOST_TEST(wild.find("to and fro, between -0.68 and 2.58") != std::string::npos, wild);
    BOOST_TEST(wild.find("cancel") == std::string::npos, wild);
    BOOST_TEST(remark({1, 0.8, 1.05, 0.85, 1.1, 0.9, 1.15, 0.95, 1.2, 1}).find("to and fro") ==
               std::string::npos);
}

BOOST_AUTO_TEST_CASE(of_a_square_both_orders_are_named) {
    std::vector<Refinement> roots;
    for (const double h : {0.1, 0.05, 0.025})
        roots.push_back({.h = h, .error = h * h});
    const auto remarks = order_remarks(measure_of(*Norm::named("theta_L2L2_sq")), roots, nullptr);
    BOOST_REQUIRE(remarks.size() == 1U);
    BOOST_TEST(remarks[0].find("order 4.00 (the square of order 2.00)") != std::string::npos,
               remarks[0]);
}

// The last order is 0.3 off the others, or 0.1.
BOOST_AUTO_TEST_CASE(orders_are_one_to_within_0_15) {
    const auto remark = [](double last) {
        std::vector<Refinement> ladder{{.h = 0.1, .error = 1.0}};
        for (const double order : {2.0, 2.0, last})
            ladder.push_back(
                {.h = ladder.back().h / 2.0, .error = ladder.back().error * std::exp2(-order)});
        return order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, nullptr).at(0);
    };
    BOOST_TEST(remark(1.7).starts_with(
                   "theta_L2L2: order 2.00 up to s = 40; then it falls, to 1.70 at s = 80"),
               remark(1.7));
    BOOST_TEST(remark(1.9) == "theta_L2L2: order 1.90 to 2.00 up to s = 80.");
}

namespace {

/// h² and Δt/160 with Δt = h. times: the errors, over what the model has for them.
std::vector<std::string> remarks_by_model(const std::vector<double>& elements,
                                          TermsKnown terms = {}, double times = 1.0) {
    const TwoTermModel model{.a = 1.0, .p = 2.0, .b = 1.0 / 160.0, .q = 1.0, .rho = 0.0};
    std::vector<Refinement> ladder;
    ladder.reserve(elements.size());
    for (const double s : elements)
        ladder.push_back(
            {.h = 1.0 / s, .dt = 1.0 / s, .error = times * model.error(1.0 / s, 1.0 / s)});
    return order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, &model, false, terms);
}

} // namespace

// Orders 2 ± 0.4 and 1 ± 0.7: which of the two remains nobody knows.
BOOST_AUTO_TEST_CASE(past_the_ladder_nothing_is_said_of_orders_that_are_not_told_apart) {
    const auto says_what_remains = [](TermsKnown terms) {
        return remarks_by_model({10.0, 20.0, 40.0}, terms).at(1).find("The order that remains") !=
               std::string::npos;
    };
    BOOST_TEST(says_what_remains({0.4, 0.5}));
    BOOST_TEST(!says_what_remains({0.4, 0.7}));
}

// At s = 40 the term of Δt is 40/160 of the other.
BOOST_AUTO_TEST_CASE(the_slower_error_is_told_as_a_part_of_the_faster) {
    const auto remarks = remarks_by_model({10.0, 20.0, 40.0});
    BOOST_REQUIRE(remarks.size() == 2U);
    const std::string said =
        "theta_L2L2: the order 2.00 is that of the space error; the time error, "
        "of order 1.00 along this ladder, is 0.25 times as large at s = 40 and "
        "hidden.";
    BOOST_TEST(remarks[1].starts_with(said), remarks[1]);
}

// A size that is open by its half is none.
BOOST_AUTO_TEST_CASE(of_a_hidden_error_no_size_is_said_that_is_not_known) {
    const TermsKnown terms{.part_a = 0.1, .part_b = 0.9};
    const auto remarks = remarks_by_model({2.0, 4.0, 8.0}, terms); // 8/160 = 0.05 of the other
    BOOST_REQUIRE(remarks.size() == 2U);
    // Of what is larger it is seen.
    BOOST_TEST(remarks_by_model({20.0, 40.0, 80.0}, terms).at(1).find("0.50 times as large") !=
               std::string::npos);
    // Nor which dominates, where a model has what is not known at all as large as the other, and
    // not the ladder's errors.
    const TermsKnown none{.part_a = 0.1, .part_b = 3.0};
    for (const double finest : {80.0, 640.0, 81920.0}) {
        const std::vector<double> elements{finest / 4, finest / 2, finest};
        BOOST_TEST(remarks_by_model(elements, none, 1.2).at(1) ==
                   "theta_L2L2: how large the time error is beside the space error is not known.");
        BOOST_TEST(remarks_by_model(elements, none).at(1).find("how large") == std::string::npos);
    }
    BOOST_TEST(remarks[1] == "theta_L2L2: the order 2.00 is that of the space error; the time "
                             "error, of order 1.00 along this ladder, is smaller at s = 8 and "
                             "hidden; its size is not known.");
}

// Nor of the space error where that of Δt is 200 times as large, on the whole ladder or beside what
// stays along it.
BOOST_AUTO_TEST_CASE(of_what_a_slower_error_hides_no_size_is_said_that_is_not_known) {
    const TwoTermModel model{.a = 1.0, .p = 2.0, .b = 50.0, .q = 1.0, .rho = 0.0};
    for (const bool stays : {false, true}) {
        std::vector<Refinement> ladder;
        for (const double s : {4.0, 8.0, 16.0}) {
            const double dt = stays ? 1.0 / 4 : 1.0 / s;
            ladder.push_back({.h = 1 / s, .dt = dt, .error = model.error(1 / s, dt)});
        }
        const auto said = [&](const TermsKnown& terms) {
            return order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, &model, false,
                                 terms)
                .at(1);
        };
        const auto open = said({.part_a = 30.0, .part_b = 0.1});
        BOOST_TEST(open.find("size is not known") != std::string::npos, open);
        BOOST_TEST(open.find("times as large") == std::string::npos, open);
        const auto known = said({.part_a = 0.1, .part_b = 0.1});
        BOOST_TEST(known.find("times as large") != std::string::npos, known);
    }
}

// Δt = 0.8 h on every level, one of which stands there twice.
BOOST_AUTO_TEST_CASE(a_repeated_level_changes_no_proportions) {
    std::vector<Refinement> ladder;
    for (const auto& [s, error] : {std::pair{8.0, 1.0}, {16.0, 0.3}, {16.0, 0.3}, {32.0, 0.12}})
        ladder.push_back({.h = 1 / s, .dt = 0.8 / s, .error = error});
    const auto remarks = order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, nullptr);
    BOOST_TEST(remarks.at(0).find("proportions") == std::string::npos, remarks.at(0));
}

// Of levels that have no error nothing is known, nor what they refine.
BOOST_AUTO_TEST_CASE(a_level_that_was_not_run_changes_no_proportions) {
    std::vector<Refinement> ladder;
    for (const auto& [s, error] : {std::pair{8.0, 1.0}, {16.0, 0.3}, {32.0, 0.12}})
        ladder.push_back({.h = 1 / s, .dt = 0.8 / s, .error = error});
    const auto said = [&] {
        return order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, nullptr).at(0);
    };
    ladder.push_back({.h = 1.0 / 320, .dt = 0.02, .error = std::nan("")});
    BOOST_TEST(said().find("proportions") == std::string::npos, said());
    ladder.back().error = 0.01;
    BOOST_TEST(said().find("proportions") != std::string::npos, said());
}

// 1e-3 against 1/100 at the end: that of the norm, whatever the table shows.
BOOST_AUTO_TEST_CASE(how_large_one_error_is_beside_the_other_is_said_of_the_norm_before_squaring) {
    const TwoTermModel model{.a = 1.0, .p = 2.0, .b = 0.05, .q = 1.0, .rho = 0.0};
    std::vector<Refinement> ladder;
    for (const double s : {4.0, 8.0, 16.0})
        ladder.push_back({.h = 1 / s, .dt = 1 / s, .error = model.error(1 / s, 1 / s)});
    const auto said = [&](const std::string& norm) {
        return order_remarks(measure_of(*Norm::named(norm)), ladder, &model, false,
                             {.part_a = 0.1, .part_b = 0.1})
            .at(1);
    };
    BOOST_TEST(said("theta_L2L2").find("is 0.80 times as large at") != std::string::npos,
               said("theta_L2L2"));
    BOOST_TEST(said("theta_L2L2_sq").find("is 0.80 times as large before squaring at") !=
                   std::string::npos,
               said("theta_L2L2_sq"));
}

// Ratios of 2 and 3: the orders between the rows are no order of the ladder.
BOOST_AUTO_TEST_CASE(a_model_explains_no_ladder_of_uneven_ratios) {
    BOOST_TEST(remarks_by_model({10.0, 20.0, 60.0}).size() == 1U);
}

namespace {

std::vector<std::string> remarks_along(const TwoTermModel& model,
                                       const std::vector<Refinement>& widths) {
    std::vector<Refinement> ladder = widths;
    for (auto& rung : ladder)
        rung.error = model.error(rung.h, rung.dt);
    return order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, &model);
}

} // namespace

// h² + Δt/10 with Δt = 0.1, 0.1, 0.1, 0.025: of order 1.50, 0.88 and 2.00 from row to row. The
// terms fall alike in the last step alone.
BOOST_AUTO_TEST_CASE(a_model_explains_no_ladder_of_uneven_steps) {
    const auto remarks =
        remarks_along({.a = 1.0, .p = 2.0, .b = 0.1, .q = 1.0, .rho = 1.0},
                      {{1.0 / 4, 0.1}, {1.0 / 8, 0.1}, {1.0 / 16, 0.1}, {1.0 / 32, 0.025}});
    BOOST_REQUIRE(remarks.size() == 1U);
    BOOST_TEST(remarks[0] ==
               "theta_L2L2: order 1.50 up to s = 8; then it falls, to 0.88 at s = 16, "
               "and rises, to 2.00 at s = 32.");
}

// Δt = 0.01 stays: its term is 0.01 against h² = 9.8e-4 at s = 32, and against 0.0039 at s = 16.
BOOST_AUTO_TEST_CASE(what_stays_along_a_ladder_is_why_its_orders_fall) {
    const auto remarks = remarks_along({.a = 1.0, .p = 2.0, .b = 1.0, .q = 1.0, .rho = 1.0},
                                       {{1.0 / 8, 0.01}, {1.0 / 16, 0.01}, {1.0 / 32, 0.01}});
    BOOST_REQUIRE(remarks.size() == 2U);
    BOOST_TEST(remarks[0].find("not known") == std::string::npos, remarks[0]);
    BOOST_TEST(remarks[1] ==
               "theta_L2L2: the time error stays as it is along this ladder, as dt is "
               "the same; at s = 32 it is 10 times as large as the space error.");
}

// Correlations that are zero but for rounding, and one that is not.
BOOST_AUTO_TEST_CASE(terms_cancel_only_where_their_correlation_is_seen) {
    for (const auto& [rho, cancels] : {std::pair{-4e-15, false}, {4e-15, false}, {-0.5, true}}) {
        const auto remarks = remarks_along({.a = 1.0, .p = 2.0, .b = 0.001, .q = 1.0, .rho = rho},
                                           {{0.1, 0.1}, {0.05, 0.05}, {0.025, 0.025}});
        BOOST_REQUIRE(remarks.size() == 2U);
        BOOST_TEST((remarks[1].find("opposite signs") != std::string::npos) == cancels, remarks[1]);
    }
}

// From one level on an error may be zero: then no finer one has another.
BOOST_AUTO_TEST_CASE(an_error_that_is_zero_between_others_is_said) {
    const auto said = [](std::initializer_list<double> errors) {
        std::vector<Refinement> ladder;
        double h = 0.5;
        for (const double error : errors)
            ladder.push_back({.h = h /= 2, .dt = 0.1, .error = error});
        for (const auto& remark :
             order_remarks(measure_of(*Norm::named("theta_L2L2")), ladder, nullptr))
            if (const auto at = remark.find("the error is zero at s = "); at != std::string::npos)
                return remark.substr(at + 25, remark.find(", a finer") - at - 25);
        return std::string();
    };
    BOOST_TEST(said({16.0, 4.0, 0.0, 0.25}) == "16, and not at s = 32");
    BOOST_TEST(said({16.0, 4.0, 0.0, 0.25, 0.0625}) == "16, and not at s = 32");
    BOOST_TEST(said({16.0, 0.0, 0.0, 0.25}) ==
               "8, and not at s = 32"); // nor is it zero at 16 alone
    BOOST_TEST(said({16.0, 0.0, 4.0, 0.0}) == "8, and not at s = 16");
    BOOST_TEST(said({16.0, 4.0, 0.0, 0.0}).empty());
    BOOST_TEST(said({16.0, 4.0, 1.0, 0.25}).empty());
}

namespace {

/// What is said of these errors, of one level after the other, in a norm; empty: nothing.
std::string said_of_rounding(const std::string& scene_name, const std::vector<double>& errors,
                             const std::string& norm = "theta_L2L2") {
    const Scene scene = read_scene(scene_name);
    const ProblemData problem = problem_of(scene, 1.0);
    Series series{"ladder", 1.0, method_of(scene.scheme), {measure_of(*Norm::named(norm))}, {}};
    std::vector<RungResult> runs;
    std::int64_t s = 8;
    for (const double error : errors) {
        const Rung rung{s, s, 1.0 / static_cast<double>(s)};
        series.rungs.push_back(rung);
        runs.push_back({.rung = rung, .errors = {error}});
        s *= 2;
    }
    const auto found = rounding_errors(scene, problem, series, runs, runs, 0);
    return found ? found->sentence : "";
}

} // namespace

// Theory says of nothing-heated that the scheme is exact for it, of table1 that it is not: there
// what falls by its order is an error of the scheme, however small.
BOOST_AUTO_TEST_CASE(whether_small_errors_are_rounding_is_for_theory_to_say) {
    const std::vector<double> falling{4e-18, 2e-18, 1e-18, 5e-19};
    const std::vector<double> standing{4e-18, 2e-18, 3e-18, 2e-18};
    for (const auto& errors : {falling, standing})
        BOOST_TEST(
            said_of_rounding("nothing-heated", errors).starts_with("every error is rounding"));
    BOOST_TEST(said_of_rounding("table1", falling).empty());
    BOOST_TEST(said_of_rounding("table1", standing).find("though the scheme is not exact") !=
               std::string::npos);
    for (const std::string scene : {"nothing-heated", "table1"})
        BOOST_TEST(said_of_rounding(scene, {1e-3, 5e-4, 2.5e-4}).empty());
}

// Linear in t before and behind a kink at t = 1/2: with steps of 1/8 that is a level, and Euler and
// SDIRK2 are exact; BDF2 differences across it. What is quadratic on one side has an error.
BOOST_AUTO_TEST_CASE(a_scheme_that_may_be_exact_is_not_said_to_be_not) {
    const std::vector<double> standing{4e-18, 2e-18, 3e-18, 2e-18};
    const TemporaryDirectory directory;
    for (const auto& [behind, in_pieces] : {std::pair{"1 - t", true}, {"2*t^2", false}})
        for (const std::string scheme : {"euler", "bdf2", "sdirk2"}) {
            directory.write("kink.toml",
                            "theta = 0\n[[phase]]\nuntil = '1/2'\nu = 'x^2*(3 - x)*t'\n"
                            "[[phase]]\nu = 'x^2*(3 - x)*(" +
                                std::string(behind) + ")'\n");
            const std::string scene = directory.write(
                "scene.toml",
                "solution = './kink.toml'\n[beam]\nalpha = 0\nzeta = 0.2\n[scheme]\ntime = '" +
                    scheme +
                    "'\n[ladder]\nfinal_time = 1\nelements = [8, 16]\ndt = '1/s'\n"
                    "norms = ['u_LinfH2']\n");
            const std::string said = said_of_rounding(scene, standing, "u_LinfH2");
            const bool denied = said.find("though the scheme is not exact") != std::string::npos;
            BOOST_TEST(denied == (scheme == "bdf2" || !in_pieces),
                       scheme << ", " << behind << ": " << said);
        }
}

// u is at rest, and no scheme has an error in it; it comes from a force of 2000.
BOOST_AUTO_TEST_CASE(what_large_loads_leave_of_a_small_deflection_is_rounding) {
    const TemporaryDirectory directory;
    directory.write("pressed.toml", "theta = 'sin(pi*x)*(1+t)'\nu = 'g2*(3*x^2-x^3)/2'\n"
                                    "sigma = '-1000*(1+t)'\n");
    const StudyResult result = run_study(read_scene(
        directory.write("s.toml", "solution = './pressed.toml'\n[beam]\nalpha = 0\nzeta = 0.3\n"
                                  "stops = [-0.1, 0.1]\n[scheme]\ntime = 'bdf2'\n"
                                  "[ladder]\nfinal_time = 1\nelements = [8, 16, 32, 64, 128]\n"
                                  "dt = '0.08/s'\n"
                                  "norms = ['sigma_L2', 'u_LinfH2', 'u_L2H2', 'u_LinfL2']\n"),
        {}));
    for (const auto& norm : result.get<LadderResult>()->norms) {
        BOOST_REQUIRE(norm.remarks.size() == 1);
        BOOST_TEST(norm.remarks[0].find("every error is rounding") != std::string::npos,
                   norm.remarks[0]);
    }
}

// sigma = exp(t), up to e at t = 1.
BOOST_AUTO_TEST_CASE(rounding_of_a_stress_is_said_to_be_of_the_stress) {
    const TemporaryDirectory directory;
    directory.write("pressed.toml",
                    "theta = 'sin(pi*x)'\nu = 'g1*(3*x^2-x^3)/2'\nsigma = 'exp(t)'\n");
    const std::string scene = directory.write(
        "s.toml", "solution = './pressed.toml'\n[beam]\nalpha = 0\nzeta = 0.1\n"
                  "stops = [-0.1, 0.2]\n[ladder]\nfinal_time = 1\nelements = [8, 16]\n"
                  "dt = [0.025, 0.025]\nnorms = ['sigma_L2']\n");
    const std::string said = said_of_rounding(scene, {1e-15, 2e-15}, "sigma_L2");
    BOOST_TEST(said.starts_with("every error is rounding, 2e-15 at most of 2.7"), said);
}

namespace {

/// A ladder of the fixed point's, of a deflection that every scheme is exact for.
StudyResult of_hermite_form(const TemporaryDirectory& directory, const std::string& scheme,
                            const std::string& ladder) {
    directory.write("moved.toml", "theta = 'sin(pi*x)*t'\nu = '0.01*x^2*t'\n");
    return run_study(read_scene(
        directory.write("s.toml", "solution = './moved.toml'\n[beam]\nalpha = 0\nzeta = 0.01\n"
                                  "[scheme]\nalgorithm = 'fixed-point'\ntime = '" +
                                      scheme + "'\n[ladder]\nfinal_time = 1\n" + ladder),
        {}));
}

} // namespace

// All of these errors are round-off: of u_xx = 0.02 t, and of the others like it.
BOOST_AUTO_TEST_CASE(round_off_of_the_hermite_form_is_within_what_is_predicted) {
    const TemporaryDirectory directory;
    for (const std::string& scheme : TimeScheme::names()) {
        const StudyResult result =
            of_hermite_form(directory, scheme,
                            "elements = [8, 16, 16, 64, 128]\n"
                            "dt = [0.1, 0.0125, 0.005, 0.005, 0.005]\nnorms = ['u_LinfH2semi']\n");
        for (const RungResult& run : result.get<LadderResult>()->rungs) {
            const double most = 0.02 * hermite_round_off(scheme, run.rung.elements, 0.01,
                                                         run.rung.dt, run.rung.steps);
            BOOST_TEST(run.errors.at(0) < most, scheme << ", s = " << run.rung.elements);
            BOOST_TEST(run.errors.at(0) > most / 500.0, scheme << ", s = " << run.rung.elements);
        }
    }
}

BOOST_AUTO_TEST_CASE(round_off_of_the_hermite_form_is_named_of_every_norm_of_the_deflection) {
    const TemporaryDirectory directory;
    const StudyResult result = of_hermite_form(
        directory, "sdirk2",
        "elements = [16, 32, 64, 128]\ndt = '0.8/s'\n"
        "norms = ['u_LinfH2semi', 'u_LinfH2', 'u_L2H2', 'u_LinfH1', 'u_LinfL2_sq']\n");
    for (const auto& norm : result.get<LadderResult>()->norms) {
        bool is_named = false;
        for (const auto& remark : norm.remarks) {
            is_named =
                is_named || remark.find("round-off of the Hermite form") != std::string::npos;
            BOOST_TEST(remark.find("not known") == std::string::npos, remark);
            BOOST_TEST(remark.find("terms of the error cancel") == std::string::npos, remark);
        }
        BOOST_TEST(is_named);
    }
}

// sigma_L2 is sixteen times what the direct algorithm has, and stays so with a smaller tolerance.
BOOST_AUTO_TEST_CASE(what_a_smaller_tolerance_leaves_is_not_of_the_iteration) {
    const TemporaryDirectory directory;
    directory.write("pressed.toml", "theta = '0.01*sin(pi*x)*exp(-t)'\nu = 'g2*(3*x^2-x^3)/2'\n"
                                    "sigma = '-exp(t)'\n");
    const StudyResult result = run_study(read_scene(
        directory.write("s.toml",
                        "solution = './pressed.toml'\n[beam]\nalpha = 0.01\nzeta = 0.1\n"
                        "stops = [-inf, 0.05]\n[scheme]\nalgorithm = 'fixed-point'\n"
                        "time = 'bdf2'\n[ladder]\nfinal_time = 1\nelements = [32, 64, 128]\n"
                        "dt = '0.1/s'\nnorms = ['u_LinfL2', 'sigma_L2', 'theta_L2L2']\n"),
        {}));
    bool is_named = false;
    for (const auto& remark : result.remarks) {
        is_named = is_named || remark.find("by the direct algorithm: the difference is round-off "
                                           "of the Hermite form") != std::string::npos;
        BOOST_TEST(remark.find("what the fixed-point iteration leaves") == std::string::npos,
                   remark);
    }
    BOOST_TEST(is_named);
}

// The tolerance, and a hundredth of it, are above all that is computed: both end the iteration at
// its first step.
BOOST_AUTO_TEST_CASE(what_a_large_tolerance_leaves_is_of_the_iteration) {
    const TemporaryDirectory directory;
    directory.write("small.toml",
                    "theta = '1e-9*sin(pi*x)*(1+t)'\nu = '1e-11*(1-cos(pi*x))*(1+t)'\n");
    const StudyResult result = run_study(read_scene(
        directory.write("s.toml", "solution = './small.toml'\n[beam]\nalpha = 0.9\nzeta = 0.15\n"
                                  "[scheme]\nalgorithm = 'fixed-point'\n[ladder]\n"
                                  "final_time = 1\nelements = [16, 32]\ndt = [0.0125, 0.003125]\n"
                                  "norms = ['theta_L2L2']\n"),
        {}));
    bool is_named = false;
    for (const auto& remark : result.remarks) {
        is_named =
            is_named || remark.find("what the fixed-point iteration leaves") != std::string::npos;
        BOOST_TEST(remark.find("no tolerance makes smaller") == std::string::npos, remark);
    }
    BOOST_TEST(is_named);
}

// The square of 1e155 is beyond the range of doubles, and no error is small beside infinity.
BOOST_AUTO_TEST_CASE(what_is_as_large_as_the_square_root_of_doubles_is_no_rounding) {
    const TemporaryDirectory directory;
    directory.write("large.toml", "theta = '1e155*sin(pi*x)'\nu = '0'\n");
    const StudyResult result = run_study(read_scene(
        directory.write("s.toml",
                        "solution = './large.toml'\n[beam]\nalpha = 0.1\nzeta = 0.3\n"
                        "[ladder]\nfinal_time = 1.0\nelements = [2, 4, 8, 16]\n"
                        "dt = '1/s'\nnorms = ['theta_L2L2', 'theta_LinfL2', 'theta_L2H1']\n"),
        {}));
    for (const auto& norm : result.get<LadderResult>()->norms)
        for (const auto& remark : norm.remarks)
            BOOST_TEST(remark.find("rounding") == std::string::npos, remark);
}

// alpha u_xx is 60000 times as large as the temperature; what is measured is the latter.
BOOST_AUTO_TEST_CASE(rounding_is_said_to_be_of_the_norm_that_is_measured) {
    const TemporaryDirectory directory;
    directory.write("linear.toml", "theta = 'theta_A*(1-x)'\nu = '0.01*x^3*t'\n");
    const StudyResult result = run_study(
        read_scene(directory.write("s.toml", "solution = './linear.toml'\n[beam]\nalpha = 1e6\n"
                                             "zeta = 0.1\ntheta_A = 1\n[mesh]\ngrading = 3\n"
                                             "[ladder]\nfinal_time = 1.0\n"
                                             "elements = [8, 16, 32, 64]\ndt = '0.1'\n"
                                             "norms = ['theta_L2L2']\n"),
                   {}));
    const auto& remarks = result.get<LadderResult>()->norms[0].remarks;
    BOOST_REQUIRE(!remarks.empty());
    BOOST_TEST(remarks[0].find(" at most of 0.58, which comes from terms of 3.5e+04: ") !=
                   std::string::npos,
               remarks[0]);
}

BOOST_AUTO_TEST_CASE(a_range_of_orders_of_a_square_has_the_range_of_the_root) {
    std::vector<Refinement> roots{{.h = 0.125, .error = 1.0}};
    for (const double order : {0.86, 0.83, 0.93, 1.0})
        roots.push_back({.h = roots.back().h / 2, .error = roots.back().error * std::exp2(-order)});
    const auto remarks = order_remarks(measure_of(*Norm::named("u_LinfH2_sq")), roots, nullptr);
    BOOST_REQUIRE(!remarks.empty());
    BOOST_TEST(remarks[0].find("order 1.66 to 2.00 (the square of order 0.83 to 1.00)") !=
                   std::string::npos,
               remarks[0]);
}

BOOST_AUTO_TEST_SUITE_END()

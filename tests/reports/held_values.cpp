// What a result says is held against what it said: words to the letter, numbers as far as round-off
// may change them, and no further.

#include "reports/files/held_values.hpp"
#include "reports/files/said_result.hpp"
#include "studies/study.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <utility>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(held_figures)

namespace {

using Json = nlohmann::ordered_json;

bool same(const Json& recorded, const Json& found) {
    return held_values(recorded, found, 1e-6).empty();
}

/// Whether a number at the place holds as another one.
bool same_at(const std::string& pointer, double recorded, double found, Json beside = {}) {
    const Json::json_pointer place(pointer);
    Json other = beside;
    beside[place] = recorded;
    other[place] = found;
    return same(beside, other);
}

} // namespace

BOOST_AUTO_TEST_CASE(words_are_the_same_to_the_letter) {
    const auto words = [](const char* recorded, const char* found) {
        return same({{"reason", recorded}}, {{"reason", found}});
    };
    BOOST_TEST(words("rising", "rising"));
    BOOST_TEST(!words("rising", "falling"));
    BOOST_TEST(!words("rising", "rising past 2.00"));
    BOOST_TEST(!words("rising past 2.00", "rising"));
    BOOST_TEST(!same({{"reason", "rising"}}, {{"reason", nullptr}}));
    // Whole numbers count something, and a letter before digits makes a name of them.
    BOOST_TEST(!words("of 1000 cases", "of 1001 cases"));
    BOOST_TEST(!words("theta_L2.5", "theta_L2.5001"));
    // A line is broken where its digits leave no room: elsewhere with other round-off.
    BOOST_TEST(words("0.20000001 against\n      0.3, by a part", "0.2 against 0.3, by a part"));
    BOOST_TEST(words("0.2 against 0.3, by a part", "0.20000001 against\n      0.3, by a part"));
    BOOST_TEST(!words("0.2 against 0.3", "0.2 against  0.3"));
    BOOST_TEST(!words("0.2 against\n  0.3", "0.2 against\n    0.3"));
    BOOST_TEST(!words("0.2 against 0.3", "0.2 against\n      "));
}

BOOST_AUTO_TEST_CASE(numbers_of_sentences_are_those_of_printed_figures) {
    const auto words = [](const char* recorded, const char* found) {
        return same({{"sentences", {recorded}}}, {{"sentences", {found}}});
    };
    BOOST_TEST(words("past 2.0000e-3 at s = 8", "past 2.0018e-3 at s = 8"));
    BOOST_TEST(!words("past 2.0000e-3 at s = 8", "past 2.0030e-3 at s = 8"));
    // A part of 0.001 and one in the last digit, which is 1e-7.
    BOOST_TEST(words("past 2.0000e-3 at s = 8", "past 2.0020500e-3 at s = 8"));
    BOOST_TEST(words("order 1.933 ± 0.096", "order 1.932 ± 0.093"));
    BOOST_TEST(!words("order 1.933 ± 0.096", "order 1.928 ± 0.096"));
    BOOST_TEST(!words("order 1.933 ± 0.096", "order 1.933 ± 0.086"));
    // One in the last digit, beside ± only.
    BOOST_TEST(words("order 0.12 ± 0.05", "order 0.13 ± 0.06"));
    BOOST_TEST(!words("order 0.12 to 0.13", "order 0.13 to 0.13"));
    BOOST_TEST(words("9.999e-4 ± 1", "1.000e-3 ± 1"));
    BOOST_TEST(!words("up to s = 1999.", "up to s = 2000."));
    BOOST_TEST(words("1.99 over it", "2.00 over it"));
    BOOST_TEST(!words("1.98 over it", "2.00 over it"));
    BOOST_TEST(words("passed by 6.2e-16 at most", "passed by 9.9e-14 at most"));
    BOOST_TEST(!words("passed by 6.2e-16 at most", "passed by 1.1e-13 at most"));
}

// Among their numbers are rounding errors, and orders of those.
BOOST_AUTO_TEST_CASE(rows_of_tables_are_held_to_a_factor) {
    const auto rows = [](const std::string& before, const std::string& now) {
        const auto table = [](const std::string& row) {
            return Json{{"tables", {{{"count", 1}, {"rows", {row}}}}}};
        };
        return same(table(before), table(now));
    };
    BOOST_TEST(rows("8 | 0.0625 | 1.00e-3", "8 | 0.0625 | 1.33e-3"));
    BOOST_TEST(!rows("8 | 0.0625 | 1.00e-3", "8 | 0.0625 | 1.35e-3"));
    BOOST_TEST(rows("8 | 3e-16 | 1.00e-3", "8 | 3e-16 | 3.30e-3"));
    BOOST_TEST(!rows("8 | 3e-16 | 1.00e-3", "8 | 3e-16 | 3.50e-3"));
    BOOST_TEST(rows("3e-16 | 1.00e-3", "3e-16 | 3.30e-3"));
    BOOST_TEST(rows("8 | -1e-17 | 0.92", "8 | 0 | 0.80"));
    BOOST_TEST(!rows("8 | -1.00", "8 | 1.00"));
    BOOST_TEST(!rows("8 | 0.0625 | 1.00e-3", "16 | 0.0625 | 1.00e-3"));
    BOOST_TEST(!rows("8 | 0.0625 | 1.00e-3", "8 | 0.0625 | "));
    BOOST_TEST(rows("8 | 0 | 0.02", "8 | 9e-13 | 0.01"));
    BOOST_TEST(!rows("8 | 0 | 0.02", "8 | 2e-12 | 0.02"));
    BOOST_TEST(!rows("8 | 0 | 0.02", "8 | 0 | 0.01"));
    BOOST_TEST(rows("8 | 0.00", "8 | 0.01"));
    BOOST_TEST(!rows("8 | 0.00", "8 | 0.05"));
}

BOOST_AUTO_TEST_CASE(an_interval_is_held_to_its_half_width) {
    // Half width 0.1.
    const Json interval{{"limit", {{"value", 3.0}, {"low", 2.9}, {"high", 3.1}}}};
    BOOST_TEST(same_at("/limit/value", 3.0, 3.004, interval));
    BOOST_TEST(!same_at("/limit/value", 3.0, 3.006, interval));
    BOOST_TEST(same_at("/limit/low", 2.9, 2.904, interval));
    BOOST_TEST(!same_at("/limit/high", 3.1, 3.106, interval));
    BOOST_TEST(same_at("/norms/L2/p_uncertainty", 0.1, 0.104));
    BOOST_TEST(!same_at("/norms/L2/p_uncertainty", 0.1, 0.106));
}

BOOST_AUTO_TEST_CASE(a_fit_is_held_to_the_interval_of_its_order) {
    // Half width 0.2, of which 5 % are 0.01, and exp(0.01 ln 100) = 1.047.
    const Json fit{{"norms", {{"L2", {{"p", 2.0}, {"p_uncertainty", 0.2}, {"a", 1.0}}}}}};
    BOOST_TEST(same_at("/norms/L2/p", 2.0, 2.0099, fit));
    BOOST_TEST(!same_at("/norms/L2/p", 2.0, 2.0101, fit));
    BOOST_TEST(same_at("/norms/L2/a", 1.0, 1.045, fit));
    BOOST_TEST(!same_at("/norms/L2/a", 1.0, 1.048, fit));
    // That of the other width has no say.
    BOOST_TEST(!same_at("/norms/L2/b", 1.0, 1.002, fit));
    BOOST_TEST(!same_at("/norms/L2/q", 1.0, 1.002, fit));
}

BOOST_AUTO_TEST_CASE(figures_of_fits_and_plain_figures_are_held_to_a_part) {
    for (const std::string place : {"/norms/L2/p", "/norms/L2/rho_se", "/norms/L2/a",
                                    "/methods/gci/uncertainty", "/predicted/L2"}) {
        BOOST_TEST(same_at(place, 2.0, 2.001), place);
        BOOST_TEST(!same_at(place, 2.0, 2.003), place);
    }
    BOOST_TEST(same_at("/orders/L2", 0.0, 0.0009));
    BOOST_TEST(!same_at("/orders/L2", 0.0, 0.0011));
    BOOST_TEST(same_at("/events/t", 2.0, 2.000001));
    BOOST_TEST(!same_at("/events/t", 2.0, 2.000003));
    // Counted is counted.
    BOOST_TEST(!same({{"steps", 10'000'000}}, {{"steps", 10'000'001}}));
}

BOOST_AUTO_TEST_CASE(round_off_is_held_to_its_size) {
    BOOST_TEST(same_at("/beyond", 1e-17, 9e-15));
    BOOST_TEST(!same_at("/beyond", 1e-17, 2e-14));
    BOOST_TEST(same_at("/stress/cases/checks.path/greatest", 0.5, 3.9));
    BOOST_TEST(same_at("/stress/cases/checks.heat_residual/greatest", 20.0, 79.0));
    BOOST_TEST(!same_at("/stress/cases/checks.heat_residual/greatest", 20.0, 81.0));
    BOOST_TEST(!same_at("/stress/cases/checks.path_limit/greatest", 20.0, 21.0));
    BOOST_TEST(same_at("/norms/L2/rms", 2.0, 2.9));
    BOOST_TEST(!same_at("/norms/L2/rms", 2.0, 3.1));
    BOOST_TEST(same_at("/stress/roundoff/hermite", 1e-9, 3.9e-9));
    BOOST_TEST(!same_at("/stress/roundoff/hermite", 1e-9, 4.1e-9));
    BOOST_TEST(!same_at("/stress/roundoff/hermite_predicted", 1e-9, 1.1e-9));
    BOOST_TEST(same_at("/separation/residual", 1e-15, 9e-14));
    BOOST_TEST(!same_at("/separation/residual", 1e-15, 2e-13));
    BOOST_TEST(same_at("/evolution/periods/changes/u@1", 1e-14, 1e-12));
    BOOST_TEST(!same_at("/evolution/periods/changes/u@1", 1e-14, 2e-11));
}

BOOST_AUTO_TEST_CASE(another_basis_counts_otherwise) {
    const auto said = [](const char* basis, const char* words, int steps) {
        return Json{{"basis", basis}, {"head", words}, {"counters", {{"sine_steps", steps}}}};
    };
    const Json recorded = said("automatic", "Euler, sine basis", 8);
    BOOST_TEST(same(recorded, said("nodal", "Euler, nodal values", 0)));
    BOOST_TEST(!same(recorded, said("nodal", "BDF2, nodal values", 0)));
    BOOST_TEST(!same(recorded, said("automatic", "Euler, nodal values", 8)));
    BOOST_TEST(!same(recorded, said("automatic", "Euler, sine basis", 7)));
}

BOOST_AUTO_TEST_CASE(what_only_one_says_is_told) {
    const auto more = held_values({{"a", 1}}, {{"a", 1}, {"b", "new"}}, 1e-6);
    BOOST_REQUIRE(more.size() == 1U);
    BOOST_TEST(more[0].what == "b");
    BOOST_TEST(!more[0].first);
    const auto fewer = held_values({{"a", 1}, {"b", "old"}}, {{"a", 1}}, 1e-6);
    BOOST_REQUIRE(fewer.size() == 1U);
    BOOST_TEST(!fewer[0].second);
}

// Runs that are repeated have one name; each is compared.
BOOST_AUTO_TEST_CASE(runs_of_one_name_are_held_one_by_one) {
    const auto runs = [](double first, double second) {
        return Json{
            {"runs",
             {{{"elements", 4}, {"errors", first}}, {{"elements", 4}, {"errors", second}}}}};
    };
    BOOST_TEST(same(runs(1.0, 2.0), runs(1.0, 2.0)));
    BOOST_TEST(!same(runs(1.0, 2.0), runs(1.5, 2.0)));
    BOOST_TEST(!same(runs(1.0, 2.0), runs(1.0, 2.5)));
}

// By which runs are taken for those of another basis: of one, they count the same.
BOOST_AUTO_TEST_CASE(what_a_result_says_names_the_basis_that_it_was_asked_for) {
    for (const std::string basis : {"automatic", "nodal"}) {
        const auto result = run_study(read_scene("cubic-deflection", {"scheme.basis=" + basis}));
        BOOST_TEST(said_by(result, {}).at("basis") == basis);
    }
}

BOOST_AUTO_TEST_SUITE_END()

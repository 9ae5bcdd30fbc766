// What is derived, against an independent derivation: differences of a hundred digits of what was
// written a second time by hand.

#include "mms/derived_formulas.hpp"
#include "mms/equations/program.hpp"
#include "mms/equations/system_checks.hpp"
#include "mms/expression/symbols.hpp"
#include "tests/equations/counterparts.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <set>

namespace data = boost::unit_test::data;
using namespace tvbeam;
using Role = DerivedFunction::Role;

namespace {

std::vector<std::string> shipped_systems() {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(TVBEAM_SYSTEMS_DIR))
        names.insert(entry.path().stem().string());
    return {names.begin(), names.end()};
}

DerivedSystem shipped(const std::string& name) {
    return derive_system(
        read_equation_system(std::string(TVBEAM_SYSTEMS_DIR) + "/" + name + ".toml"));
}

testing::Point point_of(const DomainPoint& point) {
    testing::Point result;
    const char* names[] = {"x", "y", "z", "t"};
    for (std::size_t i = 0; i < 4; ++i)
        result[i] = point.contains(names[i]) ? point.at(names[i]) : 0.0;
    return result;
}

long double value_of(const DerivedSystem& derived, const GiNaC::ex& formula,
                     const DomainPoint& point) {
    return program_of({formula}, derived.fields).evaluate(names_at(derived, point)).front();
}

} // namespace

BOOST_AUTO_TEST_SUITE(equation_sources)

BOOST_AUTO_TEST_CASE(at_least_eight_systems_are_shipped_each_with_a_counterpart) {
    BOOST_TEST(shipped_systems().size() >= 8);
    for (const auto& name : shipped_systems())
        BOOST_TEST(testing::counterparts().contains(name), name);
}

BOOST_DATA_TEST_CASE(sources_are_those_of_differences_in_a_hundred_digits,
                     data::make(shipped_systems())) {
    DerivedSystem derived = shipped(sample);
    const auto& counterparts = testing::counterparts().at(sample);
    const auto sources = derived.of_role(Role::source);
    BOOST_TEST(sources.size() == counterparts.size());
    const std::size_t count = short_tests ? 3 : 100;
    for (const DerivedFunction* source : sources) {
        const Program program = program_of({source->formula}, derived.fields);
        for (const auto& point : points_inside(derived.system, count)) {
            const long double found = program.evaluate(names_at(derived, point)).front();
            const auto expected =
                static_cast<long double>(counterparts.at(source->name)(point_of(point)));
            // 0 is 0 up to what rounding leaves of terms of the size of 100.
            BOOST_TEST(std::abs(found - expected) <=
                           1e-12L * std::abs(expected) + (expected == 0.0L ? 1e-16L : 0.0L),
                       source->name << ": " << found << " and " << expected);
        }
    }
}

BOOST_DATA_TEST_CASE(gradients_are_those_of_the_exact_values, data::make(shipped_systems())) {
    DerivedSystem derived = shipped(sample);
    for (const DerivedFunction* slope : derived.of_role(Role::gradient)) {
        const std::string coordinate(1, slope->name.back());
        const GiNaC::ex exact = derived.fields.find(slope->of)->symbol;
        for (auto point : points_inside(derived.system, 5)) {
            const long double found = value_of(derived, slope->formula, point);
            constexpr double h = 0x1p-17; // error h², of third derivatives up to 100
            point[coordinate] += h;
            const long double above = value_of(derived, exact, point);
            point[coordinate] -= 2 * h;
            const long double below = value_of(derived, exact, point);
            BOOST_TEST(std::abs(found - (above - below) / (2 * h)) < 1e-6L, slope->name);
        }
    }
}

BOOST_AUTO_TEST_CASE(the_beam_s_own_derivation_and_its_equations_agree) {
    DerivedSystem derived = shipped("beam");
    const Solution solution = parse_solution("theta = \"cos(t)*sin(pi*x)\"\n"
                                             "u = \"x^2*(3 - x)*sin(t)/100\"\n",
                                             "beam");
    std::map<std::string, std::string> own;
    for (const auto& formula : derived_formulas(solution, false))
        own[formula.symbol] = formula.text;
    const std::map<std::string, std::string> names = {
        {"f", "f"}, {"G", "G"}, {"m", "m"}, {"theta0", "theta_initial"}, {"u0", "u_initial"}};
    for (const auto& [symbol, name] : names) {
        // Both texts are read by the parser of solutions.
        const GiNaC::ex expected =
            parse_expression(SourceText(own.at(symbol), {"own", 1, 1}), model_symbol_table());
        const auto& functions = derived.functions;
        const auto function = std::find_if(functions.begin(), functions.end(),
                                           [&](const auto& one) { return one.name == name; });
        BOOST_REQUIRE(function != functions.end());
        for (const auto& point : points_inside(derived.system, 100)) {
            auto values = names_at(derived, point);
            const long double there = program_of({expected}, {}).evaluate(values).front();
            const long double here = value_of(derived, function->formula, point);
            BOOST_TEST(std::abs(here - there) <= 1e-17L * (1.0L + std::abs(there)), name);
        }
    }
}

// Of processor time, which other programs do not take.
BOOST_AUTO_TEST_CASE(compressible_flow_in_space_is_derived_within_five_seconds) {
    const std::clock_t start = std::clock();
    DerivedSystem derived = shipped("compressible-navier-stokes");
    BOOST_TEST(checked_system(derived).empty());
    BOOST_TEST(static_cast<double>(std::clock() - start) < 5.0 * CLOCKS_PER_SEC);
}

BOOST_AUTO_TEST_SUITE_END()

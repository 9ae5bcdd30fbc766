// Operators against what they mean, written by components in the same language.

#include "mms/equations/program.hpp"
#include "mms/equations/system_checks.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <ostream>

namespace data = boost::unit_test::data;
using namespace tvbeam;

namespace {

struct Meaning {
    std::string text;
    std::string components;
};

std::ostream& operator<<(std::ostream& stream, const Meaning& meaning) {
    return stream << meaning.text;
}

const std::vector<Meaning> in_the_plane = {
    {"grad(u)", "[diff(u, x), diff(u, y)]"},
    {"div(v)", "diff(w_1, x) + diff(w_2, y)"},
    {"div([[u, x*u], [y*u, 2*u]])", "[diff(u, x) + diff(x*u, y), diff(y*u, x) + diff(2*u, y)]"},
    {"laplace(v)", "[diff(w_1, x, 2) + diff(w_1, y, 2), diff(w_2, x, 2) + diff(w_2, y, 2)]"},
    {"curl(v)", "diff(w_2, x) - diff(w_1, y)"},
    {"curl(u)", "[diff(u, y), -diff(u, x)]"},
    {"dot(grad(v), v)",
     "[diff(w_1, x)*w_1 + diff(w_1, y)*w_2, diff(w_2, x)*w_1 + diff(w_2, y)*w_2]"},
    {"dot(v, grad(v))",
     "[w_1*diff(w_1, x) + w_2*diff(w_2, x), w_1*diff(w_1, y) + w_2*diff(w_2, y)]"},
    {"dot(dot([[u, 2], [3, u]], [[x, 5], [y, 7]]), [1, 0])", "[u*x + 2*y, 3*x + u*y]"},
    {"inner(grad(v), [[1, 2], [3, 4]])",
     "diff(w_1, x) + 2*diff(w_1, y) + 3*diff(w_2, x) + 4*diff(w_2, y)"},
    {"dot(outer(v, [1, 2]), [3, 5])", "[13*w_1, 13*w_2]"},
    {"dot(transpose([[1, 2], [3, u]]), v)", "[w_1 + 3*w_2, 2*w_1 + u*w_2]"},
    {"dot(sym([[1, 2], [4, u]]), v)", "[w_1 + 3*w_2, 3*w_1 + u*w_2]"},
    {"trace(grad(v))", "diff(w_1, x) + diff(w_2, y)"},
    {"dot(identity*u, v)", "u*v"},
    {"v1*diff(v2, x)", "w_1*diff(w_2, x)"},
    {"last11*last12", "diff(u, x)*diff(u, y)"}, // of a vector called last1
    {"slope2 + 3*slope1", "diff(u, y) + 3*diff(u, x)"},
    {"diff(u, x, 2, y)", "diff(diff(diff(u, y), x), x)"},
    {"diff(sin(u*x), x)", "cos(u*x)*(u + x*diff(u, x))"},
};

} // namespace

BOOST_AUTO_TEST_SUITE(equation_operators)

BOOST_DATA_TEST_CASE(operators_are_what_they_are_by_components, data::make(in_the_plane)) {
    const auto derived = [&](const std::string& equation) {
        return derive_system(parse_equation_system(
            "[unknowns]\nu = \"exp(x*y)*sin(x + t)\"\nv = [\"x^2*cos(y)*t\", \"sin(x*y) + y^3\"]\n"
            "[definitions]\nw_1 = \"dot(v, [1, 0])\"\nw_2 = \"dot(v, [0, 1])\"\n"
            "slope = \"grad(u)\"\nlast1 = \"grad(u)\"\n"
            "[equations]\nf = \"" +
                equation + "\"\ng = \"u\"\nh = \"v\"\n",
            "operators.toml"));
    };
    const DerivedSystem left = derived(sample.text);
    const DerivedSystem right = derived(sample.components);
    const auto sources = left.of_role(DerivedFunction::Role::source);
    const auto expected = right.of_role(DerivedFunction::Role::source);
    BOOST_REQUIRE(sources.size() == expected.size());
    for (std::size_t i = 0; i < sources.size(); ++i)
        for (const auto& point : points_inside(left.system, 10)) {
            const auto names = names_at(left, point);
            const long double a =
                program_of({sources[i]->formula}, left.fields).evaluate(names).front();
            const long double b =
                program_of({expected[i]->formula}, right.fields).evaluate(names).front();
            BOOST_TEST(std::abs(a - b) <= 1e-17L * (1.0L + std::abs(b)));
        }
}

BOOST_AUTO_TEST_SUITE_END()

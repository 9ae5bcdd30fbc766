// What is wrong with a file of equations is said in one line: where, which rule, what to do.

#include "mms/equations/code.hpp"
#include "mms/equations/system_checks.hpp"
#include "tests/this_build.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <chrono>
#include <ostream>

namespace data = boost::unit_test::data;
using namespace tvbeam;

namespace {

/// A file, the place that is named, and a part of what is said.
struct Wrong {
    std::string file;
    std::string place;
    std::string said;
};

std::ostream& operator<<(std::ostream& stream, const Wrong& wrong) {
    return stream << wrong.said;
}

/// [unknowns] u and [equations] f as given, which stand on lines 2 and 4.
std::string of(const std::string& unknown, const std::string& equation,
               const std::string& rest = {}) {
    return "[unknowns]\nu = \"" + unknown + "\"\n[equations]\nf = \"" + equation + "\"\n" + rest;
}

std::string repeated(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i)
        result += text;
    return result;
}

/// Of x, each another one.
std::string factors(int count) {
    std::string result = "x";
    for (int i = 0; i < count; ++i)
        result += "*(1 + sin(" + std::to_string(i) + "*x)*exp(x))";
    return result;
}

const std::string good = "sin(x)*t";

const std::vector<Wrong> wrong_files = {
    // the file
    {"u = \n", ":1:", ""},
    {"[unknowns]\nu = \"x\"\n", "", "[equations] is missing"},
    {"[equations]\nf = \"x\"\n", "", "[unknowns] is missing"},
    {"[unknowns]\n[equations]\nf = \"x\"\n", ":1:", "[unknowns] is missing or empty"},
    {of(good, "u") + "[boundry]\nq = \"u\"\n", ":5:", "did you mean 'boundary'"},
    {of(good, "u") + "[unknown]\nv = \"x\"\n", ":5:", "did you mean 'unknowns'"},
    {"name = \"\"\n" + of(good, "u"), ":1:8", "name is empty"},
    {"[unknowns]\nu = true\n[equations]\nf = \"u\"\n", ":2:", "an expression in quotes"},
    {"[unknowns]\nu = []\n[equations]\nf = \"u\"\n", ":2:", "1 to 9"},
    {"[unknowns]\nu = [\"x\", [\"y\"]]\n[equations]\nf = \"u\"\n",
     ":2:", "an expression in quotes"},
    {"dimension = 1\n" + of("x*y", "laplace(u)"), ":1:13", "it must be 2 to 3"},
    {"dimension = 4\n" + of(good, "diff(u, x)"), ":1:13", "it must be 1 to 3"},
    // names
    {"[unknowns]\nx = \"t\"\n[equations]\nf = \"1\"\n", ":2:1", "hides a known name"},
    {"[unknowns]\ngrad = \"t\"\n[equations]\nf = \"1\"\n", ":2:1", "hides a known name"},
    {of(good, "u", "[parameters]\nu = 1\n"), ":2:1", "call one of them something else"},
    {of(good, "u", "[parameters]\nu_x = 1\n"), ":6:1", "reads as a derivative of u"},
    {of(good, "u", "[parameters]\nu_exact = 1\n"), ":6:1", "call it something else"},
    {"[unknowns]\n\"2u\" = \"t\"\n[equations]\nf = \"1\"\n", ":2:1", "is not a name"},
    {"[unknowns]\nu = [\"x\", \"t\"]\nu1 = \"x\"\n[equations]\nf = \"u\"\n", ":2:1",
     "call one of them something else"},
    // expressions
    {of("sin(x", "u"), ":2:9", "'(' is never closed"},
    {of("[x, t", "u"), ":2:6", "'[' is never closed"},
    {of("x]", "u"), ":2:7", "expected an operator or the end"},
    {of("", "u"), ":2:6", "the expression is empty"},
    {of("x", "v"), ":4:6", "unknown symbol 'v'"},
    {of("[x, 1]", "u1 + u2 + u3"), ":4:16", "unknown symbol 'u3'"},
    {of("[x, 1]", "u1 + u01"), ":4:11", "unknown symbol 'u01'"},
    {of("x", "u1"), ":4:6", "unknown symbol 'u1'"},
    {of("[x, 1]", "u", "[definitions]\nu1 = \"x\"\n"), ":6:1", "'u1' is a component of u"},
    {of("x", "u", "[definitions]\nq = \"[u, 2]\"\nq2 = \"3\"\n"), ":7:1",
     "'q2' is a component of q"},
    {of("x", "laplac(u)"), ":4:6", "did you mean 'laplace'"},
    {of("x", "lambda*u", "[parameters]\nlamda = 1\n"), ":4:6", "did you mean 'lamda'"},
    {of("u*x", "u"), ":2:6", "unknown symbol 'u'"},
    {of("x", "diff(u)"), ":4:6", "diff needs what it differentiates by"},
    {of("x", "diff(u, k)", "[parameters]\nk = 1\n"), ":4:6", "is no coordinate"},
    {of("x", "diff(u, x, 0)"), ":4:6", "it must be 1 to 8"},
    {of("x", "diff(u, x, 8, x)"), ":4:6", "of an order above 8"},
    {of("x", "sin(u, x)"), ":4:11", "takes one argument, more are given"},
    {of("x", "grad()"), ":4:11", "none is given"},
    {of("x", "dot(u)"), ":4:6", "dot takes two arguments"},
    // shapes
    {of("[x, y]", "u + 1"), ":4:8", "both must have one shape"},
    {of("[x, y]", "u*u"), ":4:7", "write dot(a, b), inner(a, b) or outer(a, b)"},
    {of("[x, y]", "u^2"), ":4:7", "the square of a vector is dot(v, v)"},
    {of("[x, y]", "1/u"), ":4:7", "only a scalar divides"},
    {of("[x, y]", "sin(u)"), ":4:6", "sin is of a scalar"},
    {of("[x, y]", "grad(u)"), ":4:6", "it must be a scalar or a vector"},
    {of("[x, y, t]", "div(u)"), ":4:6", "a component for each coordinate"},
    {of("[x, t]", "curl(u)"), ":4:6", "curl of a vector of 2 has no meaning in 1 dimensions"},
    {of("[x, y]", "sym(u)"), ":4:6", "sym is for square matrices"},
    {of("[x, y]", "dot(grad(u), [1, 2, 3])"), ":4:6", "the last size of the one"},
    {of("[x, [y, 1]]", "u"), ":2:6", "its entries must have one shape"},
    {"[unknowns]\nu = [\"x\", \"[1, 2]\"]\n[equations]\nf = \"u\"\n", ":2:12",
     "it must be a scalar"},
    // what cannot be computed
    {of("x", "u/0"), ":4:7", "division by zero"},
    {of("x^(10^10)", "u"), ":2:7", "at most 1000"},
    {of("(3^999)^999*x", "u"), ":2:13", "too large"},
    {of("x", repeated("(", 200) + "u" + repeated(")", 200)), ":4:", "within each other"},
    {of("x", "u" + repeated(" + u", 2000)), ":4:", "at most 4096 characters"},
    {of(factors(100), "diff(u, x, 8)"), ":4:6", "too large"},
    {of("x", "diff(exp(" + repeated("sin(u*", 60) + "x" + repeated(")", 61) + ", x, 4)"), ":4:6",
     "too large"},
    {of("x", "u", "[parameters]\nk = \"x\"\n"), ":6:6", "unknown symbol 'x'"},
    {of("x", "u", "[parameters]\nk = \"log(0)\"\n"), ":6:", "no value"},
    {of("x", "u*(n^n)^(m-2)", "[parameters]\nm = 2\nn = 0\n"), ":4:10", "0^0 has no value"},
    {of("x*(n^n)^(m-2)", "u", "[parameters]\nm = 2\nn = 0\n"), ":2:10", "0^0 has no value"},
    {of("x*n^n", "u", "[parameters]\nn = 0\n"), ":2:9", "0^0 has no value"},
    {of("x + atan(n)*n^(m-2)", "u", "[parameters]\nm = 2\nn = 0\n"), ":2:19", "0^0 has no value"},
    {of("x", "q*u", "[definitions]\nq = \"n^n\"\n[parameters]\nn = 0\n"), ":6:7",
     "0^0 has no value"},
    {of("x + log(n)^(m-2)", "u", "[parameters]\nm = 2\nn = 0\n"), ":2:6",
     "the argument n of log is 0"},
    // what does not fit together
    {of("x", "x + 1"), ":4:6", "has no unknown in it"},
    {of("x", "(q - q)*u", "[parameters]\nq = 2\n"), ":4:6", "what it has of them cancels"},
    {"[unknowns]\nu = \"x\"\nv = \"t\"\n[equations]\nf = \"u\"\ng = \"2*u\"\n", ":3:1",
     "unknown v is in no equation"},
    {"[unknowns]\nu = \"x\"\nv = \"t\"\n[equations]\nf = \"u + v\"\n", ":5:1",
     "fewer equations, 1, than unknowns, 2"},
    {of("x", "diff(u, x)", "[initial]\nu = \"u\"\n"), ":6:1", "there is no t in the file"},
    {of("x", "u", "[boundary]\nq = { on = \"x\", value = \"u\" }\n"), ":6:13",
     "a plane of one coordinate"},
    {of("x", "u", "[boundary]\nq = { on = \"t = 0\", value = \"u\" }\n"), ":6:13",
     "a plane of one coordinate"},
    {of("x", "u", "[boundary]\nq = { on = \"x = 0.5\", value = \"u\" }\n"), ":6:16",
     "is not on the boundary of the domain"},
    {of("x", "u", "[boundary]\nq = { on = \"x = 1\" }\n"), ":6:", "has no value"},
    {of("x", "u", "[domain]\nx = [1, 0]\n"), ":6:", "domain.x"},
    {of("x", "u", "[domain]\nr = [0, 1]\n"), ":6:", "domain.r"},
    {of("1/(t + x)", "diff(u, t)",
        "[initial]\nu = \"u/x\"\n[boundary]\nq = { on = \"x = 0\", "
        "value = \"u/x\" }\n"),
     ":8:", "q at x = 0"},
    // poles
    {of("1/(1 - 2*x)", "diff(u, x)"), ":2:6", "u has no value"},
    {of("log(x)", "diff(u, x)"), ":2:6", "u has no value"},
    {of("tan(2*x)", "diff(u, x)"), ":2:6", "an odd multiple of pi/2"},
    {of("sqrt(x - 1/3)", "diff(u, x)"), ":2:6", "u has no value"},
    {of("asin(2*x)", "diff(u, x)"), ":2:6", "u has no value"},
    {of("exp(1000*x)", "diff(u, x)"), ":2:6", "beyond the range of doubles"},
};

std::string refusal(const std::string& file) {
    try {
        DerivedSystem derived = derive_system(parse_equation_system(file, "my.toml"));
        checked_system(derived);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

BOOST_AUTO_TEST_SUITE(equation_files)

BOOST_DATA_TEST_CASE(wrong_files_are_refused_in_one_line_with_their_place,
                     data::make(wrong_files)) {
    const auto start = std::chrono::steady_clock::now();
    const std::string said = refusal(sample.file);
    BOOST_TEST(said.starts_with("my.toml" + sample.place), said);
    BOOST_TEST(said.find(sample.said) != std::string::npos, said);
    BOOST_TEST(said.find('\n') == std::string::npos, said);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    BOOST_TEST(elapsed.count() < (short_tests ? 20.0 : 1.0));
}

BOOST_AUTO_TEST_CASE(there_are_at_least_forty_of_them) {
    BOOST_TEST(wrong_files.size() >= 40);
}

BOOST_AUTO_TEST_CASE(names_that_are_one_in_a_language_are_refused_there) {
    const auto derived = derive_system(parse_equation_system(
        of("K*k*x", "diff(u, x)", "[parameters]\nk = 1\nK = 2\n"), "my.toml"));
    BOOST_TEST(!system_code(derived, CodeLanguage::c).empty());
    BOOST_CHECK_THROW(system_code(derived, CodeLanguage::fortran), InputError);
}

BOOST_AUTO_TEST_SUITE_END()

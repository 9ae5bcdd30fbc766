#include "mms/admissibility.hpp"
#include "mms/manufactured_problem.hpp"
#include "tests/suited_beam.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace data = boost::unit_test::data;
using namespace tvbeam;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
const Beam between_stops = {0.017, 0.1, 0.0, {-0.02, 0.1}};
const Beam heated = {0.017, 0.1, 0.5, {-0.02, 0.1}};
const Beam without_stops = {0.017, 0.1, 0.0, {}};

struct Case {
    std::string document;
    Beam beam;
    std::string place;
    std::vector<std::string> message; ///< parts of it; none: the solution is admissible
};

std::ostream& operator<<(std::ostream& stream, const Case& c) {
    return stream << c.document;
}

std::string solution(const std::string& theta, const std::string& u,
                     const std::string& sigma = "0") {
    return "theta = \"" + theta + "\"\nu = \"" + u + "\"\nsigma = \"" + sigma + "\"\n";
}

/// Two phases that meet at t = 1.
std::string phases(const std::string& before, const std::string& after) {
    return "[[phase]]\nuntil = 1\n" + before + "[[phase]]\n" + after;
}

const std::string sine = "theta = \"sin(pi*x)\"\n";

const std::vector<Case> cases = {
    // (5)
    {solution("sin(pi*x)", "x^2*t/100 + t/1000"),
     between_stops,
     "2:6",
     {"(5): u(0,t) is", "at t = 0.0078125", "it must be 0", "x^2"}},
    {solution("sin(pi*x)", "x*t/100"),
     between_stops,
     "2:6",
     {"(5): u_x(0,t) is", "at t = 0.0078125", "it must be 0", "x^2"}},
    {solution("sin(pi*x)", "x^2*(sin(t)^2 + cos(t)^2 - 1 + t)/100"), between_stops, "", {}},
    // The clamped end holds by cos² + sin² = 1, which is not expanded to zero: the numerical check.
    {solution("sin(pi*x)", "(x + sin(t)^2 + cos(t)^2 - 1)^2/100"), between_stops, "", {}},
    {solution("sin(pi*x)", "(x + sin(t)^2 + cos(t)^2 - 1)^2/100 + 1e-9"),
     between_stops,
     "2:6",
     {"(5): u(0,t) is", "at t = 0;"}},
    // (10)
    {solution("cos(pi*x)", "0"),
     between_stops,
     "1:10",
     {"(10): theta(0,t) is 1 at t = 0", "theta_A"}},
    {solution("sin(pi*x)", "0"),
     heated,
     "1:10",
     {"(10): theta(0,t) is 0 at t = 0", "it must be 0.5", "theta_A*(1 - x)"}},
    {solution("theta_A*(1-x) + sin(pi*x)", "0"), heated, "", {}},
    {solution("t*x", "0"),
     between_stops,
     "1:10",
     {"(10): theta(1,t) is 0.0078125 at t = 0.0078125", "it must be 0"}},
    // (6): the tip is at t/10 - 0.05.
    {solution("0", "x^2*(t/10 - 0.05)"),
     between_stops,
     "2:6",
     {"(6): u(1,t) is -0.05 at t = 0;", "at least g1 = -0.02"}},
    {solution("0", "x^2*t/10"),
     between_stops,
     "2:6",
     {"(6): u(1,t) is 0.100781 at t = 1.00781;", "at most g2 = 0.1"}},
    {solution("0", "x^2*t/10"), {0.0, 0.0, 0.0, {-0.02, infinite}}, "", {}},
    {solution("0", "x^2*(t - 1)"), {0.0, 0.0, 0.0, {-infinite, 1.0}}, "", {}},
    {solution("0", "x^2*g2"), between_stops, "", {}},
    // (7)
    {solution("0", "x^2*t/100", "-t"),
     between_stops,
     "3:10",
     {"(7): sigma(1,t) is -0.0078125 at t = 0.0078125, where u(1,t) is 7.8125e-05", "it must be 0",
      "set sigma to 0"}},
    {solution("0", "x^2*t/100", "-t"),
     without_stops,
     "3:10",
     {"(7): sigma(1,t) is -0.0078125 at t = 0.0078125", "no stops"}},
    // (8)
    {solution("0", "x^2*g2", "t"),
     between_stops,
     "3:10",
     {"(8): sigma(1,t) is 0.0078125 at t = 0.0078125, where u(1,t) is 0.1",
      "at most 0 at the stop g2"}},
    {solution("0", "x^2*g1", "-t"),
     between_stops,
     "3:10",
     {"(8): sigma(1,t) is -0.0078125 at t = 0.0078125, where u(1,t) is -0.02",
      "at least 0 at the stop g1"}},
    {solution("0", "x^2*g2", "-t"), between_stops, "", {}},
    {solution("0", "x^2*g1", "t"), between_stops, "", {}},
    // A stop that is not there.
    {solution("0", "x^2*g2"), without_stops, "2:10", {"'g2' is used, but the beam has no stop"}},
    {solution("g1*x*(1-x)", "0"), {0.0, 0.0, 0.0, {-infinite, 0.1}}, "1:10", {"'g1' is used"}},
    {solution("0", "0", "g2 - g2"), without_stops, "3:10", {"'g2' is used"}},
    // Continuity.
    {phases("theta = \"sin(pi*x)\"\nu = 0\n", "theta = \"2*sin(pi*x)\"\nu = 0\n"),
     between_stops,
     "6:10",
     {"(1): theta jumps by", "at t = 1, x = 0.03125"}},
    {sine + phases("u = \"x^2*t/100\"\n", "u = \"x^2/50\"\n"),
     between_stops,
     "6:6",
     {"(3): u jumps by", "at t = 1, x = 0.03125"}},
    {sine + phases("u = \"x^2*t/100\"\n", "u = \"x^2/100\"\n"), between_stops, "", {}},
    // A bump of the curvature that is invisible in u to 1e-12 of it.
    {sine + phases("u = \"x^2/100\"\n", "u = \"x^2/100 + 1e-16*sin(pi*x*64)^2/64\"\n"),
     between_stops,
     "6:6",
     {"(3): u_xx jumps by", "at t = 1"}},
    // The jump is at a time after the last one.
    {sine + "[[phase]]\nuntil = 2\nu = 0\n[[phase]]\nu = \"x^2\"\n", between_stops, "", {}},
    {sine + "[[phase]]\nuntil = 5\nu = 0\n[[phase]]\nu = \"x\"\n", between_stops, "", {}},
    // Finite values.
    {solution("exp(exp(10*t))*sin(pi*x)", "0"),
     between_stops,
     "1:10",
     {"theta is not finite at x = 0, t = 0.6875 (it is nan)"}},
    {solution("sin(pi*x)", "x^2*log(1 - t)"),
     without_stops,
     "2:6",
     {"u is not finite at x = 0, t = 1"}},
    {solution("sin(pi*x)*sqrt(t)", "0"),
     between_stops,
     "1:10",
     {"a derivative of theta is not finite at x = 0, t = 0"}},
    {solution("sin(pi*x)", "x^(5/2)/100"),
     without_stops,
     "2:6",
     {"a derivative of u is not finite at x = 0, t = 0"}},
    {solution("x*log(x)", "0"), between_stops, "1:10", {"theta is not finite at x = 0, t = 0"}},
    {solution("0", "x^2*g2", "-1/t"),
     between_stops,
     "3:10",
     {"sigma is not finite at x = 0, t = 0"}},
    {solution("sin(pi*x)*1e400", "0"), between_stops, "1:10", {"beyond the range"}},
    {solution("sin(pi*x)", "x^2/alpha"),
     {0.0, 0.0, 0.0, {-1.0, 1.0}},
     "2:6",
     {"u has no value with this beam's numbers: division by zero"}},
    {solution("2^(x*10^10)*(1-x)*x", "0"), between_stops, "1:10", {"constant exponent"}},
};

std::vector<std::string> shipped() {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(TVBEAM_SOLUTIONS_DIR))
        paths.push_back(entry.path().string());
    return paths;
}

} // namespace

BOOST_AUTO_TEST_SUITE(mms_admissibility)

BOOST_DATA_TEST_CASE(a_broken_rule_is_named_with_equation_time_and_place, data::make(cases)) {
    const Solution parsed = parse_solution(sample.document, "my.toml");
    if (sample.message.empty()) {
        BOOST_CHECK_NO_THROW(require_admissible(parsed, sample.beam, 2.0));
        return;
    }
    BOOST_CHECK_EXCEPTION(
        require_admissible(parsed, sample.beam, 2.0), InputError, [&](const InputError& error) {
            const std::string what = error.what();
            const std::string place = "my.toml:" + sample.place + ": ";
            BOOST_TEST_INFO(what);
            BOOST_TEST(what.substr(0, place.size()) == place);
            for (const std::string& part : sample.message)
                BOOST_TEST(what.find(part) != std::string::npos, part << " in " << what);
            return true;
        });
    BOOST_CHECK_THROW(manufactured_problem(parsed, sample.beam, 2.0), InputError);
}

BOOST_DATA_TEST_CASE(shipped_solutions_are_admissible_for_any_material,
                     data::make(shipped()) * data::make({0.0, 0.017, 1e3}) *
                         data::make({0.0, 0.1, 1e4}),
                     path, alpha, zeta) {
    const Solution parsed = read_solution(path);
    for (const double theta_A : {-3.0, 0.0, 1e3})
        BOOST_CHECK_NO_THROW(
            require_admissible(parsed, suited({alpha, zeta, theta_A, {-0.02, 0.1}}, parsed), 2.0));
}

BOOST_AUTO_TEST_CASE(beams_and_times_must_be_finite) {
    const Solution parsed = parse_solution(solution("sin(pi*x)", "0"), "my.toml");
    BOOST_CHECK_THROW(require_admissible(parsed, between_stops, 0.0), InputError);
    BOOST_CHECK_THROW(require_admissible(parsed, between_stops, infinite), InputError);
    BOOST_CHECK_THROW(require_admissible(parsed, between_stops, std::nan("")), InputError);
    BOOST_CHECK_THROW(require_admissible(parsed, {std::nan(""), 0.0, 0.0, {}}, 1.0), InputError);
    BOOST_CHECK_THROW(require_admissible(parsed, {0.0, infinite, 0.0, {}}, 1.0), InputError);
}

BOOST_AUTO_TEST_SUITE_END()

#include "mms/admissible/sampled_rules.hpp"
#include "mms/manufactured_problem.hpp"
#include "tests/suited_beam.hpp"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace data = boost::unit_test::data;
using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(mms_admissibility)

namespace {

/// How far an admissible solution is from the law of its stops; throws InputError for any other.
double law_distance(const Solution& solution, const Beam& beam, double final_time) {
    return manufactured_problem({solution, beam, final_time}).exact->law_distance;
}

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
     {"(5): u(0,t) is 0.002 at t = 2", "it must be 0", "x^2"}},
    {solution("sin(pi*x)", "x*t/100"),
     between_stops,
     "2:6",
     {"(5): u_x(0,t) is 0.02 at t = 2", "it must be 0", "x^2"}},
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
     {"(10): theta(0,t) is 1 at t = 0", "it must be 0 = theta_A"}},
    {solution("sin(pi*x)", "0"),
     heated,
     "1:10",
     {"(10): theta(0,t) is 0 at t = 0", "it must be 0.5", "theta_A*(1 - x)"}},
    {solution("theta_A*(1-x) + sin(pi*x)", "0"), heated, "", {}},
    {solution("t*x", "0"),
     between_stops,
     "1:10",
     {"(10): theta(1,t) is 2 at t = 2", "it must be 0"}},
    // (6): the tip is at t/10 - 0.05.
    {solution("0", "x^2*(t/10 - 0.05)"),
     between_stops,
     "2:6",
     {"(6): u(1,t) is -0.05 at t = 0;", "at least g1 = -0.02"}},
    {solution("0", "x^2*t/10"),
     between_stops,
     "2:6",
     {"(6): u(1,t) is 0.10087 at t = 1.0087;", "at most g2 = 0.1"}},
    {solution("0", "x^2*t/10"), {0.0, 0.0, 0.0, {-0.02, infinite}}, "", {}},
    {solution("0", "x^2*(t - 1)"), {0.0, 0.0, 0.0, {-infinite, 1.0}}, "", {}},
    {solution("0", "x^2*g2"), between_stops, "", {}},
    // (7)
    {solution("0", "x^2*t/100", "-t"),
     between_stops,
     "3:10",
     {"(7): sigma(1,t) is -2 at t = 2, where u(1,t) is 0.02", "it must be 0", "set sigma to 0"}},
    {solution("0", "x^2*t/100", "-t"),
     without_stops,
     "3:10",
     {"(7): sigma(1,t) is -2 at t = 2", "no stops"}},
    // (8)
    {solution("0", "x^2*g2", "t"),
     between_stops,
     "3:10",
     {"(8): sigma(1,t) is 2 at t = 2, where u(1,t) is 0.1", "at most 0 at the stop g2"}},
    {solution("0", "x^2*g1", "-t"),
     between_stops,
     "3:10",
     {"(8): sigma(1,t) is -2 at t = 2, where u(1,t) is -0.02", "at least 0 at the stop g1"}},
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
     {"(1): theta jumps by 1 at t = 1, x = 0.5"}},
    {sine + phases("u = \"x^2*t/100\"\n", "u = \"x^2/50\"\n"),
     between_stops,
     "6:6",
     {"(3): u jumps by 0.01 at t = 1, x = 1"}},
    {sine + phases("u = \"x^2*t/100\"\n", "u = \"x^2/100\"\n"), between_stops, "", {}},
    // A bump of the curvature that is invisible in u to 1e-12 of it.
    {sine + phases("u = \"x^2/100\"\n", "u = \"x^2/100 + 1e-16*sin(pi*x*64)^2/64\"\n"),
     between_stops,
     "6:6",
     {"(3): u_xx jumps by", "at t = 1"}},
    // A slope that jumps for a while, and one that jumps by little.
    {solution("sin(pi*x) + sqrt((x - 0.3137)^2)*x*(1 - x)*exp(-800*(t - 0.65)^2)", "0"),
     between_stops,
     "1:10",
     {"theta_x jumps by", "x = 0.3137"}},
    {solution("sin(pi*x) + 0.005*sqrt((x - 0.3137)^2)*x*(1 - x)", "0"),
     between_stops,
     "1:10",
     {"theta_x jumps by", "x = 0.3137"}},
    // Beside a curvature that takes most of it off on the first grid.
    {solution("sin(pi*x) + 0.002*sqrt((x - 0.3137)^2)*x*(1 - x)", "0"),
     between_stops,
     "1:10",
     {"theta_x jumps by", "x = 0.3137"}},
    // The jump is at a time after the last one.
    {sine + "[[phase]]\nuntil = 2\nu = 0\n[[phase]]\nu = \"x^2\"\n", between_stops, "", {}},
    {sine + "[[phase]]\nuntil = 5\nu = 0\n[[phase]]\nu = \"x\"\n", between_stops, "", {}},
    // Finite values.
    {solution("exp(exp(10*t))*sin(pi*x)", "0"),
     between_stops,
     "1:10",
     {"theta is not finite at x = 0.5, t = 0.656496 (it is inf)"}},
    {solution("sin(pi*x)", "x^2*log(1 - t)"),
     without_stops,
     "2:6",
     {"u is not finite at x = 0, t = 1"}},
    {solution("sin(pi*x)*sqrt(t)", "0"),
     between_stops,
     "1:10",
     {"theta_t is not finite at x = 0, t = 0"}},
    {solution("sin(pi*x)", "x^(5/2)/100"),
     without_stops,
     "2:6",
     {"u_xxx is not finite at x = 0, t = 0"}},
    {solution("x*log(x)", "0"), between_stops, "1:10", {"theta_x is not finite at x = 0, t = 0"}},
    {solution("0", "x^2*g2", "-1/t"),
     between_stops,
     "3:10",
     {"sigma is not finite at x = 0, t = 0"}},
    // Between the points of the grid: poles of any order, in x, in t and moving.
    {solution("sin(pi*x)/(x - 7/10)", "0"),
     between_stops,
     "1:10",
     {"theta ", "x = 0.7, t = 0 (it is "}},
    {solution("sin(pi*x)*1e-3/(x - sqrt(2)/2)^2", "0"),
     between_stops,
     "1:10",
     {"theta ", " x = 0.707107, t = 0 (it is "}},
    {solution("sin(pi*x)*t/(t^2 - 2)", "0"), between_stops, "1:10", {"theta ", "t = 1.41421 ("}},
    {solution("sin(pi*x)/(x - t - 1/7)^3", "0"), between_stops, "1:10", {"theta ", "(it is "}},
    // On them: the double next to a pole of tan has a value.
    {solution("x*(1-x)*tan(pi*x)", "0"),
     between_stops,
     "1:10",
     {"theta grows without bound towards x = 0.5, t = "}},
    {solution("x*(1-x)*tan(pi*(x + t))", "0"),
     between_stops,
     "1:10",
     {"theta grows without bound"}},
    {solution("x*(1-x)/cos(pi*t)", "0"),
     between_stops,
     "1:10",
     {"theta grows without bound towards x = 0.5, t = ", ".5 (it is "}},
    {solution("x*(1-x)*tan(pi*t/4)", "0"), // at the final time
     between_stops,
     "1:10",
     {"theta grows without bound towards x = 0.5, t = 2 (it is "}},
    {solution("0", "x^2*(1-x)^2*tan(pi*x)"),
     without_stops,
     "2:6",
     {"u grows without bound towards x = 0.5, t = 0 (it is "}},
    // Halfway between two of them.
    {solution("x*(1-x)*tan(32*pi*x)", "0"), between_stops, "1:10", {" grows without bound"}},
    // Of log, derivatives alone.
    {solution("sin(pi*x)", "x^2*1e-9*log((x - 0.7)^2)"),
     without_stops,
     "2:6",
     {"u_x grows without bound towards x = 0.7, t = 0 (it is "}},
    // Narrow, steep and nearly singular, but bounded.
    {solution("sin(pi*x)*exp(-((x - 0.7)*1e5)^2)", "0"), between_stops, "", {}},
    {solution("sin(pi*x)*tanh(1e7*(x - 0.7))", "0"), between_stops, "", {}},
    {solution("sin(pi*x)*exp(-((x - 0.5)*1e7)^2)", "0"), between_stops, "", {}},
    {solution("sin(pi*x)/((x - 0.5)^2 + 1e-12)", "0"), between_stops, "", {}},
    {solution("sin(pi*x)/(x + 1e-9)", "0"), between_stops, "", {}},
    {solution("sin(pi*x)/((t - 0.7)^2 + 1e-12)", "0"), between_stops, "", {}},
    // u_x and theta_x do not jump at x = 0.5, where they are looked at, and in time u_xxt does not.
    {solution("x*(1 - x)*(x - 0.5)*sqrt((x - 0.5)^2)",
              "x^2*(x - 0.5)*sqrt((x - 0.5)^2)*(t - 0.5)*sqrt((t - 0.5)^2)/9"),
     between_stops,
     "",
     {}},
    {solution("sin(pi*x)", "t*x^2*((x - 0.5)^2)^1.5/99"), between_stops, "", {}},
    {solution("sin(pi*x)*sqrt((x - 0.5)^2)", "0"),
     between_stops,
     "1:10",
     {"theta_x jumps by 2 at t = 0.", ", x = 0.5; it must be continuous"}},
    {solution("sin(pi*x)*1e400", "0"), between_stops, "1:10", {"beyond the range"}},
    {solution("sin(pi*x)", "x^2/alpha"),
     {0.0, 0.0, 0.0, {-1.0, 1.0}},
     "2:6",
     {"u cannot be computed with this beam's numbers: division by zero"}},
    {solution("2^(x*10^10)*(1-x)*x", "0"), between_stops, "1:10", {"constant exponent"}},
};

/// A wrong solution, the whole message that it is refused with, and what the message advises.
struct Repair {
    std::string wrong;
    Beam beam;
    std::string message;
    std::string repaired;
    std::optional<Beam> repaired_beam = std::nullopt; ///< none: the same beam
};

std::ostream& operator<<(std::ostream& stream, const Repair& r) {
    return stream << r.wrong;
}

const std::vector<Repair> repairs = {
    // (5): what u has too much of at x = 0.
    {solution("0", "x^2/100 + t/1000"), between_stops,
     "2:6: (5): u(0,t) is 0.002 at t = 2; it must be 0 at the clamped end: subtract "
     "t/1000 from u, or give u a factor x^2",
     solution("0", "x^2/100 + t/1000 - t/1000")},
    {solution("0", "sin(x*t)/100"), between_stops,
     "2:6: (5): u_x(0,t) is 0.02 at t = 2; it must be 0 at the clamped end: subtract "
     "t*x/100 from u, or give u a factor x^2",
     solution("0", "sin(x*t)/100 - t*x/100")},
    // (10), either end.
    {solution("cos(pi*x/2)*t", "0"), heated,
     "1:10: (10): theta(0,t) is 2 at t = 2; it must be 0.5 = theta_A: add (2*t - 1)*(x - 1)/2 to "
     "theta",
     solution("cos(pi*x/2)*t + (t - 1/2)*(x - 1)", "0")},
    {solution("sin(pi*x)", "0"), heated,
     "1:10: (10): theta(0,t) is 0 at t = 0; it must be 0.5 = theta_A: add theta_A*(1 - x) to theta",
     solution("sin(pi*x) + theta_A*(1 - x)", "0")},
    {solution("sin(3*pi*x/2)*exp(-t)", "0"), between_stops,
     "1:10: (10): theta(1,t) is -1 at t = 0; it must be 0: add exp(-t)*x to theta",
     solution("sin(3*pi*x/2)*exp(-t) + exp(-t)*x", "0")},
    // (6): 0.1/0.15 = 0.66666…, rounded so that the stop is kept.
    {solution("0", "x^2*sin(pi*t/2)*0.15"), between_stops,
     "2:6: (6): u(1,t) is 0.100448 at t = 0.467117; it must be at most g2 = 0.1; it is greatest, "
     "0.15, at t = 1: multiply u by 0.6666, or move g2 to 0.15",
     solution("0", "0.6666*x^2*sin(pi*t/2)*0.15")},
    {solution("0", "x^2*(sin(pi*t/2)*0.15 - 0.05)"), between_stops,
     "2:6: (6): u(1,t) is -0.05 at t = 0; it must be at least g1 = -0.02; it is least, -0.05, at t "
     "= 0: multiply u by 0.4, or move g1 to -0.05",
     solution("0", "x^2*(sin(pi*t/2)*0.15 - 0.05)"), Beam{0.017, 0.1, 0.0, {-0.05, 0.1}}},
    // Moving a stop that u is written with moves u; the other one does not.
    {solution("0", "g2*x^2*(1 + t)"), between_stops,
     "2:6: (6): u(1,t) is 0.100827 at t = 0.00827357; it must be at most g2 = 0.1; it is greatest, "
     "0.3, at t = 2: multiply u by 0.3333",
     solution("0", "0.3333*g2*x^2*(1 + t)")},
    {solution("0", "g1*x^2*(1 + 2*t)"), between_stops,
     "2:6: (6): u(1,t) is -0.0203309 at t = 0.00827357; it must be at least g1 = -0.02; it is "
     "least, "
     "-0.1, at t = 2: multiply u by 0.2",
     solution("0", "0.2*g1*x^2*(1 + 2*t)")},
    {solution("0", "-g1*5*x^2*(1 + t)"), between_stops,
     "2:6: (6): u(1,t) is 0.100827 at t = 0.00827357; it must be at most g2 = 0.1; it is greatest, "
     "0.3, at t = 2: multiply u by 0.3333, or move g2 to 0.3",
     solution("0", "-0.3333*g1*5*x^2*(1 + t)")},
    // Peaks between two of the 257 times, with widths of 1e-3, of 1e-9, and beside a broad one.
    {solution("0", "x^2*exp(-1e6*(t - 0.3333)^2)"), between_stops,
     "2:6: (6): u(1,t) is 1 at t = 0.3333; it must be at most g2 = 0.1; it is greatest, 1, at t = "
     "0.3333: multiply u by 0.1, or move g2 to 1",
     solution("0", "0.1*x^2*exp(-1e6*(t - 0.3333)^2)")},
    {solution("0", "x^2*exp(-1e18*(t - 0.3333)^2)"), between_stops,
     "2:6: (6): u(1,t) is 1 at t = 0.3333; it must be at most g2 = 0.1; it is greatest, 1, at t = "
     "0.3333: multiply u by 0.1, or move g2 to 1",
     solution("0", "x^2*exp(-1e18*(t - 0.3333)^2)"), Beam{0.017, 0.1, 0.0, {-0.02, 1.0}}},
    {solution("0", "x^2*(sin(t)/20 - exp(-1e18*(t - 1/3)^2)/8)"), between_stops,
     "2:6: (6): u(1,t) is -0.10864 at t = 0.333333; it must be at least g1 = -0.02; it is least, "
     "-0.10864, at t = 0.333333: multiply u by 0.184, or move g1 to -0.1087",
     solution("0", "0.184*x^2*(sin(t)/20 - exp(-1e18*(t - 1/3)^2)/8)")},
    // Pressed against g2 in the second phase: what is made smaller there would come off the stop.
    {phases("theta = 0\nu = \"x^2*g2*(1 + t*(1 - t))\"\n",
            "theta = 0\nu = \"x^2*g2\"\nsigma = \"1 - t\"\n"),
     between_stops,
     "4:6: (6): u(1,t) is 0.100412 at t = 0.00413679; it must be at most g2 = 0.1; it is greatest, "
     "0.125, at t = 0.5: change u(1,t) by -0.025 there; (3*x^2 - x^3)/2 is a deflection that is 1 "
     "at the tip",
     phases("theta = 0\nu = \"x^2*g2*(1 + t*(1 - t)) - g2*t*(1 - t)*(3*x^2 - x^3)/2\"\n",
            "theta = 0\nu = \"x^2*g2\"\nsigma = \"1 - t\"\n")},
    // (7): a force on a tip that is free.
    {solution("0", "x^2*t/100", "-t"), between_stops,
     "3:10: (7): sigma(1,t) is -2 at t = 2, where u(1,t) is 0.02; it must be "
     "0 strictly between the stops: set sigma to 0 in this phase, or bring the tip to g1, "
     "0.04 away",
     solution("0", "x^2*t/100", "0")},
    {solution("0", "x^2*t/100", "-t"), without_stops,
     "3:10: (7): sigma(1,t) is -2 at t = 2, where u(1,t) is 0.02; it must be "
     "0, as the beam has no stops; leave sigma out or give the beam stops",
     solution("0", "x^2*t/100")},
    // (8): the wrong sign all the time, and from a time on.
    {solution("0", "x^2*g2", "exp(t)"), between_stops,
     "3:10: (8): sigma(1,t) is 7.38906 at t = 2, where u(1,t) is 0.1; it must be at most 0 at the "
     "stop "
     "g2: change its sign, sigma = \"-(exp(t))\"",
     solution("0", "x^2*g2", "-(exp(t))")},
    {solution("0", "x^2*g1", "3/2 - t"), between_stops,
     "3:10: (8): sigma(1,t) is -0.5 at t = 2, where u(1,t) is -0.02; it must be at "
     "least 0 at the stop g1: it changes its sign at t = 1.5; end the phase there",
     "theta = 0\nu = \"x^2*g1\"\n[[phase]]\nuntil = 1.5\nsigma = \"3/2 - t\"\n[[phase]]\n"},
    {solution("0", "x^2*g2", "1/2 - t"), between_stops,
     "3:10: (8): sigma(1,t) is 0.5 at t = 0, where u(1,t) is 0.1; it must be at most 0 at the stop "
     "g2: it changes its sign at t = 0.5; begin the contact there",
     "theta = 0\nu = \"x^2*g2\"\n[[phase]]\nuntil = 0.5\n[[phase]]\nsigma = \"1/2 - t\"\n"},
    // Zero at t = 0, then of the wrong sign: it has that from the start all the same.
    {solution("0", "x^2*g2", "t*(1/2 - t)"), between_stops,
     "3:10: (8): sigma(1,t) is 0.0624988 at t = 0.251082, where u(1,t) is 0.1; it must be at "
     "most 0 at the stop g2: it changes its sign at t = 0.5; begin the contact there",
     "theta = 0\nu = \"x^2*g2\"\n[[phase]]\nuntil = 0.5\n[[phase]]\n"
     "sigma = \"t*(1/2 - t)\"\n"},
    // A time and the one when the sign changes, as many digits of both as tell them apart.
    {"[[phase]]\nuntil = 0.9999999\ntheta = 0\nu = \"x^2*g2\"\n[[phase]]\ntheta = 0\n"
     "u = \"x^2*g2\"\nsigma = \"1 - t\"\n",
     between_stops,
     "8:10: (8): sigma(1,t) is 1e-07 at t = 0.9999999, where u(1,t) is 0.1; it must be at most 0 "
     "at the stop g2: it changes its sign at t = 1; begin the contact there",
     "[[phase]]\nuntil = 1\ntheta = 0\nu = \"x^2*g2\"\n[[phase]]\ntheta = 0\n"
     "u = \"x^2*g2\"\nsigma = \"1 - t\"\n"},
    // Phases that do not meet: by how much, in which term, and where they would.
    {sine + phases("u = \"x^2*t/100\"\n", "u = \"x^2*(1/50 - (t - 2)^2/1000)\"\n"), between_stops,
     "6:6: (3): u jumps by 0.009 at t = 1, x = 1; it must be continuous: subtract 9*x^2/1000 from "
     "u of the later phase, or move until to 2, where the phases meet",
     sine + phases("u = \"x^2*t/100\"\n", "u = \"x^2*(1/50 - (t - 2)^2/1000) - 9*x^2/1000\"\n")},
    {phases("theta = \"sin(pi*x)\"\nu = 0\n",
            "theta = \"t*sin(pi*x) + exp(-t)*x*(1 - x)\"\nu = 0\n"),
     between_stops,
     "6:10: (1): theta jumps by 0.0919699 at t = 1, x = 0.5; it must be continuous: add "
     "exp(-1)*x*(x - 1) to theta of the later phase",
     phases("theta = \"sin(pi*x)\"\nu = 0\n",
            "theta = \"t*sin(pi*x) + exp(-t)*x*(1 - x) + exp(-1)*x*(x - 1)\"\nu = 0\n")},
    // As near as that they meet only where it is written with more digits; what differs by a
    // constant meets nowhere.
    {sine + phases("u = \"x^2*t/100\"\n", "u = \"x^2*(1/100 + 1e-9)\"\n"), between_stops,
     "6:6: (3): u jumps by 1e-09 at t = 1, x = 1; it must be continuous: subtract x^2/1000000000 "
     "from u of the later phase, or move until to 1.0000001, where the phases meet",
     sine + "[[phase]]\nuntil = 1.0000001\nu = \"x^2*t/100\"\n[[phase]]\n"
            "u = \"x^2*(1/100 + 1e-9)\"\n"},
    // Both are the same at the beginning, which is no end; they meet again at 0.4, and at 1.6,
    // behind
    // the third phase.
    {sine + "[[phase]]\nuntil = 0.3\nu = \"x^2*t*(0.4 - t)*(1.6 - t)/10\"\n[[phase]]\nuntil = 1.5\n"
            "u = 0\n[[phase]]\nu = 0\n",
     between_stops,
     "7:5: (3): u jumps by -0.0039 at t = 0.3, x = 1; it must be continuous: add 39*x^2/10000 to u "
     "of the later phase, or move until to 0.4, where the phases meet",
     sine + "[[phase]]\nuntil = 0.4\nu = \"x^2*t*(0.4 - t)*(1.6 - t)/10\"\n[[phase]]\n"
            "until = 1.5\nu = 0\n[[phase]]\nu = 0\n"},
    {sine + phases("u = \"x^2/100\"\n", "u = \"x^2*(1/100 + 1e-11)\"\n"), between_stops,
     "6:6: (3): u jumps by 1e-11 at t = 1, x = 1; it must be continuous: subtract "
     "x^2/100000000000 from u of the later phase",
     sine + phases("u = \"x^2/100\"\n", "u = \"x^2*(1/100 + 1e-11) - x^2/100000000000\"\n")},
    // No finite value.
    {solution("sin(pi*x)", "x^2*log(1 - t)"), without_stops,
     "2:6: u is not finite at x = 0, t = 1 (it is nan); write it so that it and its derivatives "
     "exist everywhere on [0, 1] x [0, 2], or end the run before that time",
     solution("sin(pi*x)", "x^2*log(1 + t)")},
    // A stop that the beam does not have.
    {solution("0", "x^2*g2"), without_stops,
     "2:10: 'g2' is used, but the beam has no stop on that side; give the beam the stop, or "
     "write a number",
     solution("0", "x^2*g2"), between_stops},
};

std::vector<std::string> shipped() {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(TVBEAM_SOLUTIONS_DIR))
        paths.push_back(entry.path().string());
    return paths;
}

} // namespace

// Penalised stops, ε = 1/10, and a tip of 3/20 at most: the law makes −1/2 of it.
// Where it ends, not where it was looked at; a run that ends before that has a solution.
BOOST_AUTO_TEST_CASE(a_solution_is_said_to_end_where_it_does) {
    const auto refusal = [](const std::string& theta, double final_time) -> std::string {
        try {
            law_distance(parse_solution("theta = 'sin(pi*x)*" + theta + "'\nu = 0\n", "my.toml"),
                         {0.5, 0.1, 0.0, {}}, final_time);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const std::string end = "or end the run before that time";
    for (const auto& [theta, time] : {std::pair("sqrt(0.5-t)", "0.5"),
                                      {"log(0.7531 - t)", "0.7531"},
                                      {"sqrt(t - 0.2)*sqrt(0.3-t)", "0"}}) {
        const std::string text = refusal(theta, 1.0);
        BOOST_TEST(text.find("theta is not finite at x = ") != std::string::npos, text);
        BOOST_TEST(text.find(std::string(", t = ") + time + " (it is ") != std::string::npos, text);
        BOOST_TEST((text.find(end) != std::string::npos) == (std::string(time) != "0"), text);
    }
    BOOST_TEST(refusal("sqrt(0.5-t)", 0.4999) == "");
    BOOST_TEST(refusal("log(0.7531 - t)", 0.753) == "");
}

BOOST_AUTO_TEST_CASE(a_value_is_told_apart_from_what_it_must_be) {
    const auto refusal = [](const std::string& text, const Beam& beam) -> std::string {
        try {
            law_distance(parse_solution(text, "my.toml"), beam, 1.0);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const std::string off_law = refusal("theta = 0\nu = '1.2*g2*(3*x^2-x^3)/2'\n"
                                        "sigma = '-2-2e-11*t'\n",
                                        {0.017, 0.1, 0.0, {-0.1, 0.1, 0.01}});
    BOOST_TEST(off_law.find("sigma(1,t) is -2.0000000000") != std::string::npos, off_law);
    BOOST_TEST(off_law.find("/epsilon = -2:") != std::string::npos, off_law);
    const std::string off_end = refusal("theta = '(theta_A + 1e-10)*(1 - x)'\nu = 0\n",
                                        {0.017, 0.1, 0.123456789, {-0.1, 0.1}});
    BOOST_TEST(off_end.find("theta(0,t) is 0.1234567891 at t = 0; it must be 0.123456789 = ") !=
                   std::string::npos,
               off_end);
}

BOOST_AUTO_TEST_CASE(a_penalised_solution_obeys_the_law_of_its_stops) {
    const Beam beam{0.017, 0.1, 0.0, {-0.02, 0.1, 0.1}};
    const std::string u = "x^2*3/20*t/2";
    const auto require = [&](const std::string& text) {
        return law_distance(parse_solution(text, "my.toml"), beam, 2.0);
    };
    // σ by the law, or given and equal to it.
    BOOST_TEST(require("theta = 0\nu = '" + u + "'\n") == 0.0);
    BOOST_TEST(require("theta = 0\n[[phase]]\nuntil = '4/3'\nu = '" + u +
                       "'\nsigma = 0\n[[phase]]\nu = '" + u + "'\nsigma = '-(3/40*t - g2)*10'\n") ==
               0.0);
    const auto refused = [&](const std::string& sigma, const std::vector<std::string>& parts) {
        BOOST_CHECK_EXCEPTION(
            require("theta = 0\nu = '" + u + "'\nsigma = '" + sigma + "'\n"), InputError,
            [&](const InputError& error) {
                const std::string what = error.what();
                BOOST_TEST_INFO(what);
                BOOST_TEST(what.find("my.toml:3:10: (7)(8) of penalised stops: sigma(1,t) is") ==
                           0U);
                for (const auto& part : parts)
                    BOOST_TEST(what.find(part) != std::string::npos, part);
                return true;
            });
    };
    // Twice the law, the other sign, a force between the stops.
    refused("0", {"it must be -(u(1,t) - g2)/epsilon", "leave sigma out"});
    refused("3/4*t - 1", {"it must be 0 between the stops"});
    // The solution of rigid stops is accepted, and its distance from the law told: the tip stays at
    // g2 under a force of up to 2, for which the stop would yield by 1/5.
    BOOST_TEST(require("theta = 0\nu = 'x^2*g2'\nsigma = '-t'\n") == 0.2,
               boost::test_tools::tolerance(1e-12));
    // Neither the one nor the other.
    BOOST_CHECK_THROW(require("theta = 0\nu = 'x^2*g2'\nsigma = 't'\n"), InputError);
}

// sin(m pi x) is 0 at all points of one distance of which m is a multiple of the number.
BOOST_DATA_TEST_CASE(a_sine_of_any_whole_multiple_of_pi_is_seen,
                     data::make({1, 8, 32, 33, 64, 100, 128, 256, 257, 512, 1000, 1024, 4096}), m) {
    const std::string k = std::to_string(m);
    const auto refusal = [](const std::string& text) -> std::string {
        try {
            law_distance(parse_solution(text, "my.toml"), between_stops, 1.0);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    /// The size that is said after these words, and the rest.
    const auto said = [](const std::string& refused, const std::string& words) {
        const auto found = refused.find(words);
        BOOST_REQUIRE_MESSAGE(found != std::string::npos, words << " in " << refused);
        return std::abs(std::stod(refused.substr(found + words.size())));
    };
    const std::string sine_x = "sin(" + k + "*pi*x)";
    const std::string sine_t = "sin(" + k + "*pi*t)";
    // All are of the greatest size 1, or a hundredth; of the points that are up to a fourth of the
    // mean distance off even ones, the farthest see sin(pi/4) of it.
    const auto in_second = [&](const std::string& theta, const std::string& u) {
        return refusal("[[phase]]\nuntil = '1/2'\ntheta = 'sin(pi*x)'\nu = '0'\n[[phase]]\ntheta = "
                       "'sin(pi*x)" +
                       theta + "'\nu = '" + u + "'\n");
    };
    BOOST_TEST(said(in_second(" + " + sine_x, "0"), "(1): theta jumps by ") > 0.6);
    BOOST_TEST(said(in_second("", "0.01*x^2*(1 - cos(" + k + "*pi*x))"), "(3): u jumps by ") >
               0.005);
    BOOST_TEST(said(refusal(solution("sin(pi*x) + x*" + sine_t, "0")), "(10): theta(1,t) is ") >
               0.7);
    BOOST_TEST(said(refusal(solution("sin(pi*x)", "0.01*x*" + sine_t)), "(5): u_x(0,t) is ") >
               0.007);
    BOOST_TEST(said(refusal(solution("sin(pi*x)", "0.01*" + sine_t)), "(5): u(0,t) is ") > 0.007);
    BOOST_TEST(said(refusal(solution("0", "0", sine_t)), "(7): sigma(1,t) is ") > 0.7);
}

// ε|σ̃| ≤ 1.5e-14, at the stop 2e-14, is less than 1e-12 |u|, and less than the rounding of u(1,t)
// from 1e-17 on.
BOOST_DATA_TEST_CASE(a_stop_that_yields_unseen_neither_pulls_nor_pushes_a_free_tip,
                     data::make({1e-14, 1e-15, 1e-17, 1e-20}), epsilon) {
    const Beam beam{0.4, 0.15, 0.0, {-infinite, 0.1, epsilon}};
    const auto distance = [&](const std::string& u, const std::string& sigma) {
        return law_distance(parse_solution(solution("sin(pi*x)", u, sigma), "my.toml"), beam, 1.0);
    };
    const auto refused = [&](const std::string& u, const std::string& sigma,
                             const std::string& rule) {
        BOOST_CHECK_EXCEPTION(distance(u, sigma), InputError, [&](const InputError& error) {
            const std::string what = error.what();
            return what.starts_with("my.toml:3:10: " + rule);
        });
    };
    const std::string at_stop = "g2*(3*x^2 - x^3)/2 + x^2*(1 - x)^2*sin(t)";
    refused("x^2*(3 - x)*sin(t)/100", "1 + t/2", "(7): sigma(1,t) is 1.5 at t = 1");
    refused("x^2*(3 - x)*sin(t)/100", "-1 - t/2", "(7): sigma(1,t) is -1.5 at t = 1");
    refused(at_stop, "1 + t/2", "(8): sigma(1,t) is 1.5 at t = 1");
    // Of rigid stops: the penalised one would yield by 2ε.
    BOOST_TEST(distance(at_stop, "-1 - t") / epsilon == 2.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(distance(at_stop, "0") == 0.0);
    BOOST_TEST(distance("x^2*(3 - x)*sin(t)/100", "0") == 0.0);
}

// A tip that passes its stop by ε|σ̃|, to a rounding of 2e-17, is one of penalised stops.
BOOST_AUTO_TEST_CASE(a_stop_that_yields_little_yields) {
    const Beam beam{0.4, 0.15, 0.0, {-infinite, 0.1, 1e-14}};
    const Solution parsed =
        parse_solution(solution("0", "(g2 + 1e-14*(1 + t))*x^2", "-1 - t"), "my.toml");
    BOOST_TEST(law_distance(parsed, beam, 1.0) == 0.0);
    // Where it comes to the stop at t = 1 the law, written out, is rounding of the tip over
    // epsilon.
    const std::string tip = "exp(log(g2) + 1e-5*(t - 1)^2)";
    const Solution comes =
        parse_solution("theta = 'sin(pi*x)'\n"
                       "[[phase]]\nuntil = 1\nu = 'x^2*g2*(1 - (1 - t)^2/2)'\nsigma = '0'\n"
                       "[[phase]]\nu = 'x^2*" +
                           tip + "'\nsigma = '-(" + tip + " - g2)/1e-6'\n",
                       "my.toml");
    BOOST_CHECK_NO_THROW(law_distance(comes, {0.4, 0.15, 0.0, {-0.5, 0.03, 1e-6}}, 2.0));
}

BOOST_DATA_TEST_CASE(a_broken_rule_is_named_with_equation_time_and_place, data::make(cases)) {
    const Solution parsed = parse_solution(sample.document, "my.toml");
    if (sample.message.empty()) {
        BOOST_CHECK_NO_THROW(law_distance(parsed, sample.beam, 2.0));
        return;
    }
    BOOST_CHECK_EXCEPTION(
        law_distance(parsed, sample.beam, 2.0), InputError, [&](const InputError& error) {
            const std::string what = error.what();
            const std::string place = "my.toml:" + sample.place + ": ";
            BOOST_TEST_INFO(what);
            BOOST_TEST(what.substr(0, place.size()) == place);
            for (const std::string& part : sample.message)
                BOOST_TEST(what.find(part) != std::string::npos, part << " in " << what);
            return true;
        });
    BOOST_CHECK_THROW(manufactured_problem({parsed, sample.beam, 2.0}), InputError);
}

BOOST_DATA_TEST_CASE(shipped_solutions_are_admissible_for_any_material,
                     data::make(shipped()) * data::make({0.0, 0.017, 1e3}) *
                         data::make({0.0, 0.1, 1e4}),
                     path, alpha, zeta) {
    const Solution parsed = read_solution(path);
    for (const double theta_A : {-3.0, 0.0, 1e3}) {
        const auto exact = manufactured_problem(
                               {parsed, suited({alpha, zeta, theta_A, {-0.02, 0.1}}, parsed), 2.0})
                               .exact;
        // Between the sampled times, too.
        BOOST_TEST(!exact->tip_is_sampled);
    }
}

BOOST_AUTO_TEST_CASE(what_is_not_proven_is_said) {
    const auto is_sampled = [](const std::string& u) {
        return manufactured_problem(
                   {parse_solution(solution("0", u), "my.toml"), between_stops, 2.0})
            .exact->tip_is_sampled;
    };
    BOOST_TEST(!is_sampled("x^2*g2*sin(t)^2"));
    // g2 by an identity that arithmetic on intervals does not know.
    BOOST_TEST(is_sampled("x^2*g2*(sin(3*t)^2 + cos(3*t)^2)"));
    // The same, away from the stop.
    BOOST_TEST(!is_sampled("x^2*g2*(sin(3*t)^2 + cos(3*t)^2)/2"));
}

// Neither sampled time sees the peak: 1e-9 wide, upwards or downwards.
BOOST_AUTO_TEST_CASE(a_single_stop_is_passed_by_a_narrow_peak) {
    const auto passes = [](const std::string& peak, const Stops& stops) {
        const Solution sharp =
            parse_solution(solution("0", "x^2*" + peak + "*exp(-1e18*(t - 0.3333)^2)"), "my.toml");
        try {
            manufactured_problem({sharp, {0.017, 0.1, 0.0, stops}, 2.0});
            return false;
        } catch (const InputError&) {
            return true;
        }
    };
    const double none = std::numeric_limits<double>::infinity();
    const Stops g1_alone = {-0.1, none};
    const Stops g2_alone = {-none, 0.1};
    BOOST_TEST(passes("1", g2_alone));
    BOOST_TEST(passes("(-1)", g1_alone));
    BOOST_TEST(!passes("(-1)", g2_alone));
    BOOST_TEST(!passes("1", g1_alone));
}

// As above, of a force on a tip that stays on its stop; and a parabola, whose top no sampled time
// meets.
BOOST_AUTO_TEST_CASE(a_stop_pulls_between_sampled_times) {
    const auto pulls = [](const std::string& sigma, bool upper) {
        const Solution pressed =
            parse_solution(solution("0", std::string(upper ? "g2" : "g1") + "*x^2*(3 - x)/2",
                                    (upper ? "" : "-") + std::string("(") + sigma + ")"),
                           "my.toml");
        try {
            manufactured_problem({pressed, {0.3, 0.1, 0.0, {-0.1, 0.1}}, 1.0});
            return false;
        } catch (const InputError& error) {
            BOOST_TEST(std::string(error.what()).starts_with("my.toml:3:10: (8): sigma(1,t) is "),
                       error.what());
            return true;
        }
    };
    for (const bool upper : {true, false}) {
        BOOST_TEST(pulls("-1e-3 + 1.1e-3*exp(-1e18*(t - 0.3333)^2)", upper));
        BOOST_TEST(!pulls("-1e-3 + 0.9e-3*exp(-1e18*(t - 0.3333)^2)", upper));
        BOOST_TEST(pulls("-(t - 0.3333)^2 + 1e-6", upper));
        BOOST_TEST(!pulls("-(t - 0.3333)^2", upper));
    }
}

BOOST_DATA_TEST_CASE(a_wrong_solution_is_told_the_nearest_repair, data::make(repairs)) {
    BOOST_CHECK_EXCEPTION(law_distance(parse_solution(sample.wrong, "my.toml"), sample.beam, 2.0),
                          InputError, [&](const InputError& error) {
                              BOOST_TEST(std::string(error.what()) == "my.toml:" + sample.message);
                              return true;
                          });
    // And it is one: who does as told has an admissible solution.
    BOOST_CHECK_NO_THROW(law_distance(parse_solution(sample.repaired, "my.toml"),
                                      sample.repaired_beam.value_or(sample.beam), 2.0));
}

// The times of a series are more than those of the grid on which a solution must be finite.
BOOST_AUTO_TEST_CASE(an_end_value_that_is_not_a_number_is_none) {
    const Eigen::ArrayXd times{{0.0, 1.0}};
    const Eigen::ArrayXd differences{{0.0, std::nan("")}};
    BOOST_CHECK_EXCEPTION(
        require_value(differences, times, 0.0, 1e-12, {"my.toml", 2, 6}, "u(0,t)", "0"), InputError,
        [](const InputError& error) {
            return std::string(error.what()).find("at t = 1;") != std::string::npos;
        });
}

BOOST_AUTO_TEST_CASE(beams_and_times_must_be_finite) {
    const Solution parsed = parse_solution(solution("sin(pi*x)", "0"), "my.toml");
    BOOST_CHECK_THROW(law_distance(parsed, between_stops, 0.0), InputError);
    BOOST_CHECK_THROW(law_distance(parsed, between_stops, infinite), InputError);
    BOOST_CHECK_THROW(law_distance(parsed, between_stops, std::nan("")), InputError);
    BOOST_CHECK_THROW(law_distance(parsed, {std::nan(""), 0.0, 0.0, {}}, 1.0), InputError);
    BOOST_CHECK_THROW(law_distance(parsed, {0.0, infinite, 0.0, {}}, 1.0), InputError);
}

BOOST_AUTO_TEST_SUITE_END()

#include "tests/fuzz/targets.hpp"

#include "mms/manufactured_problem.hpp"
#include "mms/solution.hpp"
#include "mms/text/input_error.hpp"

#include <array>
#include <cstdlib>
#include <iostream>
#include <limits>

namespace tvbeam::fuzz {

void require(bool holds, const std::string& what) {
    if (holds)
        return;
    std::cerr << "broken: " << what << std::endl;
    std::abort();
}

bool solution(std::span<const std::uint8_t> data) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::array<Beam, 4> beams = {
        Beam{0.017, 0.1, 0.0, {-0.02, 0.1}}, Beam{0.3, 0.0, 0.5, {-infinity, 0.1}},
        Beam{0.0, 1e-3, 0.0, {}}, Beam{1.0, 0.1, 0.0, {-0.02, 0.1, 1e-3}}};
    const std::size_t beam = taken(data) % beams.size();
    try {
        const Solution parsed = parse_solution(text_of(data), "fuzz.toml");
        const ProblemData problem = manufactured_problem({parsed, beams[beam], 1.0});
        require(problem.exact.has_value(), "a solution without an exact solution");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

} // namespace tvbeam::fuzz

// A mutator that knows words: of TOML, of scenes, of expressions. Half of the time bytes are
// changed as libFuzzer does.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

constexpr std::array words = {"[beam]\n",
                              "[mesh]\n",
                              "[scheme]\n",
                              "[ladder]\n",
                              "[orders]\n",
                              "[evolution]\n",
                              "[data]\n",
                              "[reference]\n",
                              "[work_precision]\n",
                              "[[work_precision.scheme]]\n",
                              "[stress.sweep.a]\n",
                              "[stress.contraction]\n",
                              "[stress.roundoff]\n",
                              "[expect]\n",
                              "[expect.ladder.theta_L2L2]\n",
                              "[expect.orders.theta_L2L2]\n",
                              "[expect.evolution]\n",
                              "[short.ladder]\n",
                              "[report]\n",
                              "[defect]\n",
                              "[sensitivity]\n",
                              "[sensitivity.defect.a]\n",
                              "[parameters]\n",
                              "[[phase]]\n",
                              "[ladder.printed]\n",
                              "title = ",
                              "solution = ",
                              "alpha = ",
                              "zeta = ",
                              "stops = ",
                              "theta_A = ",
                              "contact = ",
                              "grading = ",
                              "nodes = ",
                              "algorithm = ",
                              "time = ",
                              "thermal_mass = ",
                              "tolerance = ",
                              "basis = ",
                              "final_time = ",
                              "elements = ",
                              "dt = ",
                              "norms = ",
                              "probes = ",
                              "every = ",
                              "period = ",
                              "runs = ",
                              "targets = ",
                              "name = ",
                              "sampling = ",
                              "points = ",
                              "steps = ",
                              "gap = ",
                              "sides = ",
                              "load = ",
                              "initial = ",
                              "until = ",
                              "theta = ",
                              "u = ",
                              "sigma = ",
                              "theta0 = ",
                              "u0 = ",
                              "heat_source = ",
                              "body_force = ",
                              "moment_load = ",
                              "orders = ",
                              "errors = ",
                              "within = ",
                              "p = ",
                              "q = ",
                              "range = ",
                              "files = ",
                              "long = true\n",
                              "true",
                              "false",
                              "0",
                              "1",
                              "-1",
                              "0.5",
                              "1e300",
                              "1e-300",
                              "inf",
                              "-inf",
                              "nan",
                              "9999999",
                              "[",
                              "]",
                              "{ ",
                              " }",
                              ", ",
                              "\"",
                              "'",
                              "\"\"\"",
                              "#",
                              "\n",
                              ".",
                              "=",
                              "\"theta_L2L2\"",
                              "\"u_LinfH2semi\"",
                              "\"corollary\"",
                              "\"theta@0.5\"",
                              "\"u@1\"",
                              "\"stress\"",
                              "\"energy\"",
                              "\"euler\"",
                              "\"bdf2\"",
                              "\"sdirk2\"",
                              "\"direct\"",
                              "\"fixed-point\"",
                              "\"penalty\"",
                              "\"0.1/s\"",
                              "\"table1\"",
                              "\"copetti-fernandez-2011\"",
                              "x",
                              "t",
                              "pi",
                              "alpha",
                              "zeta",
                              "g1",
                              "g2",
                              "theta_A",
                              "+",
                              "-",
                              "*",
                              "/",
                              "^",
                              "(",
                              ")",
                              "sin(",
                              "cos(",
                              "tan(",
                              "asin(",
                              "acos(",
                              "atan(",
                              "sinh(",
                              "cosh(",
                              "tanh(",
                              "exp(",
                              "log(",
                              "sqrt(",
                              "x^2",
                              "(1-x)",
                              "sin(pi*x)",
                              "exp(-t)",
                              "h",
                              "error",
                              "L2",
                              "value",
                              "drag",
                              "ndofs",
                              "sigma",
                              ";",
                              "\t",
                              "1.5-103",
                              "1,5",
                              "\"study\":",
                              "\"index\":",
                              "\"result\":",
                              "\"elements\":",
                              "\"steps\":",
                              "\"dt\":",
                              "\"failed\":",
                              "\"reason\":",
                              "\"seconds\":",
                              "\"counters\":",
                              "\"errors\":",
                              "\"uncertainties\":",
                              "\"outcome\":",
                              "\"checks\":",
                              "\"schema\":",
                              "\"scenes\":",
                              "null",
                              "[unknowns]\n",
                              "[equations]\n",
                              "[definitions]\n",
                              "[boundary]\n",
                              "[initial]\n",
                              "[domain]\n",
                              "dimension = ",
                              "diff(",
                              "grad(",
                              "div(",
                              "laplace(",
                              "curl(",
                              "dot(",
                              "inner(",
                              "outer(",
                              "sym(",
                              "trace(",
                              "transpose(",
                              "identity",
                              "on = ",
                              "y",
                              "z",
                              "u",
                              "v"};

/// The begin of a random word, number or sign, and its end.
std::pair<std::size_t, std::size_t> some_word(const std::string& text, std::mt19937& random) {
    const auto is_word = [&](std::size_t at) {
        return std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_';
    };
    std::size_t begin = random() % text.size();
    std::size_t end = begin + 1;
    while (is_word(begin) && begin > 0 && is_word(begin - 1))
        --begin;
    while (is_word(end - 1) && end < text.size() && is_word(end))
        ++end;
    return {begin, end};
}

std::pair<std::size_t, std::size_t> some_line(const std::string& text, std::mt19937& random) {
    const std::size_t at = random() % text.size();
    const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    return {begin, std::min(text.find('\n', at), text.size() - 1) + 1};
}

void change(std::string& text, std::mt19937& random) {
    const std::string word = words[random() % words.size()];
    if (text.empty()) {
        text = word;
        return;
    }
    const auto [begin, end] = some_word(text, random);
    const auto [line, line_end] = some_line(text, random);
    switch (random() % 6) {
    case 0:
        text.insert(begin, word);
        return;
    case 1:
        text.replace(begin, end - begin, word);
        return;
    case 2:
        text.erase(begin, end - begin);
        return;
    case 3:
        text.insert(begin, text.substr(line, line_end - line));
        return;
    case 4:
        text.erase(line, line_end - line);
        return;
    default:
        text.insert(line, word);
    }
}

} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    std::mt19937 random(seed);
    if (random() % 2 == 0)
        return LLVMFuzzerMutate(data, size, most);
    std::string text(reinterpret_cast<const char*>(data), size);
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
        change(text, random);
    text.resize(std::min(text.size(), most));
    std::memcpy(data, text.data(), text.size());
    return text.size();
}

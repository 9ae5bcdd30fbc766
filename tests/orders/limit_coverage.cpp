// Do 95 % intervals of limits hold them? Random sequences, as Phillips and Roy score estimators:
// orders from 1/2 to 6, a next term of up to three times the first, alternating signs, logarithms,
// scatter up to 3 %, a floor; ratios from 1.04 to 3, 3 to 12 levels. The constants of LimitTuning
// were set on another seed.

#include "studies/orders/limit_engine.hpp"
#include "tests/this_build.hpp"

#include <boost/test/unit_test.hpp>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace tvbeam;

BOOST_AUTO_TEST_SUITE(limit_engine)

namespace {

const int sequences = short_tests ? 150 : 1200;
/// Below this the finest value is its limit, but for rounding.
constexpr double least_error = 1e-12;

class Random {
public:
    double between(double low, double high) { return gsl_ran_flat(generator_.get(), low, high); }
    double normal() { return gsl_ran_gaussian(generator_.get(), 1); }
    template <class List>
    auto one_of(const List& list) {
        return list[gsl_rng_uniform_int(generator_.get(), list.size())];
    }

private:
    std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> generator_{gsl_rng_alloc(gsl_rng_mt19937),
                                                                 gsl_rng_free};
};

const std::array<std::string, 6> families{"pure",    "next term",   "logarithm",
                                          "scatter", "alternating", "floor"};

struct Sequence {
    std::string family;
    double limit = 0;
    std::vector<ValueRow> rows;
};

Sequence draw(Random& random) {
    Sequence one{random.one_of(families), random.between(-1, 1), {}};
    const double p = random.between(0.5, 6);
    const double ratio = std::exp(random.between(std::log(1.04), std::log(3.0)));
    const int levels = static_cast<int>(random.between(3, 13));
    const double power = random.one_of(std::array{1.0, 2.0});
    const bool noisy = one.family == "scatter" || one.family == "floor";
    const double next = one.family == "next term" ? random.between(-3, 3)
                        : noisy                   ? random.between(-0.5, 0.5)
                                                  : 0.0;
    const double logarithm = one.family == "logarithm" ? random.between(0, 1) : 0.0;
    const double scatter = one.family == "scatter" ? random.between(0, 0.03) : 0.0;
    const double floor = one.family == "floor" ? std::pow(ratio, (1 - levels) * p) *
                                                     std::pow(10, random.between(-2, 0))
                                               : 0.0;
    for (int k = 0; k < levels; ++k) {
        const double h = std::pow(ratio, -k);
        double error =
            std::pow(h, p) * (1 + next * std::pow(h, power)) * (1 - logarithm * std::log(h));
        if (one.family == "alternating" && k % 2 == 1)
            error = -error;
        error = error * (1 + scatter * random.normal()) + floor * random.between(-0.5, 0.5);
        one.rows.push_back({h, one.limit + error});
    }
    return one;
}

struct Score {
    int asked = 0;
    int answered = 0;
    int held = 0;
    std::vector<double> widths; ///< over the error of the finest value

    void add(bool answer, double distance, double half, double error) {
        ++asked;
        if (!answer)
            return;
        ++answered;
        held += std::abs(distance) <= half ? 1 : 0;
        widths.push_back(2 * half / error);
    }
    double share() const { return answered == 0 ? 0.0 : static_cast<double>(held) / answered; }
    double width() {
        std::sort(widths.begin(), widths.end());
        return widths.empty() ? 0.0 : widths[widths.size() / 2];
    }
};

} // namespace

BOOST_AUTO_TEST_CASE(
    intervals_hold_the_limit_in_every_family_and_are_narrower_than_those_of_the_named_methods) {
    Random random;
    std::map<std::string, std::map<std::string, Score>> scores;
    for (int k = 0; k < sequences; ++k) {
        const auto one = draw(random);
        const double finest = one.rows.back().value;
        const double error = std::abs(finest - one.limit);
        if (error < least_error)
            continue;
        const auto limit = estimate_limit(one.rows);
        for (const auto& key : {std::string("all"), one.family}) {
            auto& row = scores[key];
            row["engine"].add(limit.limit.determined, limit.limit.value - one.limit,
                              limit.limit.half_width(), error);
            for (const auto& [name, method] : {std::pair{"GCI", limit.gci},
                                               {"Celik", limit.celik},
                                               {"Eca-Hoekstra", limit.eca_hoekstra}})
                row[name].add(method.has_value(), finest - one.limit,
                              method ? method->uncertainty : 0, error);
        }
    }
    for (auto& [family, row] : scores) {
        for (auto& [name, score] : row)
            BOOST_TEST_MESSAGE(family << ", " << name << ": answers " << score.answered << " of "
                                      << score.asked << ", holds " << 100 * score.share()
                                      << " %, median width " << score.width());
        // Few levels far from the limit may run apart: 3 %, up to three deviations of a sample so
        // large.
        const double asked = row["engine"].asked;
        BOOST_TEST(row["engine"].answered >= 0.97 * asked - 3 * std::sqrt(0.03 * 0.97 * asked));
        BOOST_TEST(row["engine"].share() >= (family == "all" ? 0.95 : 0.9),
                   family << " holds " << row["engine"].share());
    }
    auto& all = scores["all"];
    for (const char* method : {"GCI", "Celik", "Eca-Hoekstra"}) {
        BOOST_TEST(all["engine"].share() >= all[method].share(), method);
        BOOST_TEST(all["engine"].width() < all[method].width(), method);
    }
}

BOOST_AUTO_TEST_SUITE_END()

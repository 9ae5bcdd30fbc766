#include "mms/rough_times.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/sample_points.hpp"

#include <algorithm>
#include <limits>
#include <string>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using GiNaC::ex;

namespace {

constexpr double zero = 1e-12; // of the greatest value

std::string name_of(const ex& function) {
    return GiNaC::ex_to<GiNaC::function>(function).get_name();
}

/// The bases of all powers that are no integers and change in time, each as its own sign of a zero.
/// Of asin(v) and acos(v) 1 - v^2, with v_t: where v turns back from 1 or -1 the first is so flat
/// that its zero is known to half of the digits.
GiNaC::exmap bases_of(const PhaseExpressions& phase) {
    GiNaC::exmap bases;
    for (const ex& formula : {phase.theta, phase.u})
        for (auto part = formula.preorder_begin(); part != formula.preorder_end(); ++part) {
            if (part->nops() == 0 || !depends_on(part->op(0), model_symbols().t))
                continue;
            if (GiNaC::is_a<GiNaC::power>(*part) && !part->op(1).info(GiNaC::info_flags::integer))
                bases[part->op(0)] = part->op(0);
            else if (GiNaC::is_a<GiNaC::function>(*part) &&
                     (name_of(*part) == "asin" || name_of(*part) == "acos"))
                bases[1 - GiNaC::pow(part->op(0), 2)] = derivative(part->op(0), model_symbols().t);
        }
    return bases;
}

/// Where |base| is least between two times, to the last digit of what has no rounding there.
double time_of_least(const auto& size, double begin, double end) {
    constexpr int closer = 32; // each a quarter of the one before
    CloseLook look{begin, end};
    double best = begin;
    for (int i = 0; i < closer; ++i) {
        const ArrayXd times = look.samples();
        Index least = 0;
        size(times).minCoeff(&least);
        best = times(least);
        look = look.next_to(best, look.spacing());
    }
    return best;
}

/// tape: a base and its sign of a zero.
void add_zeros(const Tape& tape, double begin, double end, std::vector<double>& zeros) {
    constexpr Index samples = 513;
    constexpr double flat = 1e-7; // of the length: where what is quadratic in t is rounding
    const ArrayXd places{{0.4321, 0.8765}};
    const auto sizes_of = [&](Index row, double x, const ArrayXd& t) -> ArrayXd {
        const ArrayXd values = tape.evaluate(ArrayXd::Constant(1, x), t).row(row).abs();
        return values.isFinite().select(values, std::numeric_limits<double>::max());
    };
    const auto sizes = [&](double x, const ArrayXd& t) { return sizes_of(0, x, t); };
    const auto size = [&](const ArrayXd& t) { return sizes(places(0), t); };
    const auto sign = [&](const ArrayXd& t) { return sizes_of(1, places(0), t); };
    const ArrayXd times = ArrayXd::LinSpaced(samples, begin, end);
    const ArrayXd on_grid = size(times);
    for (Index k = 0; k < samples; ++k) {
        const Index before = std::max<Index>(k - 1, 0);
        const Index after = std::min(k + 1, samples - 1);
        if (on_grid(k) > on_grid(before) || on_grid(k) > on_grid(after))
            continue;
        const double near = time_of_least(size, times(before), times(after));
        const double part = flat * (end - begin);
        const ArrayXd at = ArrayXd::Constant(1, time_of_least(sign, near - part, near + part));
        if (std::all_of(places.begin(), places.end(), [&](double x) {
                return sizes(x, at)(0) <= zero * sizes(x, times).maxCoeff();
            }))
            zeros.push_back(at(0));
    }
}

} // namespace

std::vector<double> rough_times(const PhaseExpressions& phase, double final_time) {
    constexpr double beside = 1e-9; // of the length: the ends are not within, nor two times one
    const double begin = phase.begin_value;
    const double end = std::min(phase.end_value, final_time);
    std::vector<double> zeros;
    for (const auto& [base, sign] : bases_of(phase))
        try {
            add_zeros(compile_tape({base, sign}), begin, end, zeros);
        } catch (const AlgebraError&) {
            continue; // no doubles hold it by itself
        }
    std::sort(zeros.begin(), zeros.end());
    std::vector<double> times;
    for (const double t : zeros)
        if (std::min(t - (times.empty() ? begin : times.back()), end - t) > beside * (end - begin))
            times.push_back(t);
    return times;
}

} // namespace tvbeam

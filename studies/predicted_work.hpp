#pragma once

#include "studies/scene/scene.hpp"

#include <string>

namespace tvbeam {

/// A processor makes about so many steps of elements in a second, and so long takes a run besides.
inline constexpr double steps_a_second = 1e8;
inline constexpr double seconds_a_run = 2e-4;

/// What the runs of a scene take, before any of them is made. Within a factor of ten: processors
/// differ, contact and norms cost more than steps without them. Of a [solver] only the runs count,
/// and its time-out is a bound.
struct PredictedWork {
    double runs = 0.0;    ///< single ones, of all studies
    double steps = 0.0;   ///< elements times time steps (work_of)
    double seconds = 0.0; ///< on one core: 1e8 of those a second, and 0.2 ms a run
    double bytes = 0.0;   ///< 1 kB a run, 100 B a case of [stress], 400 a node of the largest mesh,
                          ///< and what an evolution keeps

    /// At most, with the runs that `until` may add within its budget, or with as many seconds a
    /// run as [solver] allows. 0: there is neither.
    double at_most = 0.0;
    std::string bounded_by = {}; ///< what that rests on, in words

    /// "3.1e+09 steps of elements in 12 runs, about 31 s on one core and 40 MB; at most 2 min with
    /// the runs that ladder.until may add".
    [[nodiscard]] std::string text() const;
};

PredictedWork predicted_work(const Scene& scene);

/// Beyond these a scene runs only if it says `long = true`, or whoever runs it does.
inline constexpr double longest_work = 6.0 * 3600.0; ///< s
inline constexpr double largest_work = 4e9;          ///< bytes

/// Whether a scene that does not say `long = true` is predicted to take more.
bool is_too_long(const Scene& scene, const PredictedWork& predicted);

/// Throws InputError, with the prediction, where a scene that does not say `long = true` is
/// predicted to take more.
void require_short_enough(const Scene& scene, const PredictedWork& predicted);

} // namespace tvbeam

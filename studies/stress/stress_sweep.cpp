#include "core/gsl_errors.hpp"
#include "studies/stress/stress_block.hpp"

#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <utility>

namespace tvbeam {

namespace {

/// Indices into the lists, point after point.
std::vector<std::uint16_t> sobol_points(const std::vector<StressAxis>& axes, std::size_t count) {
    const std::unique_ptr<gsl_qrng, decltype(&gsl_qrng_free)> generator(
        gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(axes.size())), &gsl_qrng_free);
    if (!generator)
        throw std::bad_alloc();
    std::vector<std::uint16_t> points;
    points.reserve(count * axes.size());
    std::vector<double> unit(axes.size());
    for (std::size_t n = 0; n < count; ++n) {
        gsl_qrng_get(generator.get(), unit.data());
        for (std::size_t k = 0; k < axes.size(); ++k)
            points.push_back(static_cast<std::uint16_t>(
                std::floor(unit[k] * static_cast<double>(axes[k].values))));
    }
    return points;
}

std::size_t product_of(const std::vector<StressAxis>& axes) {
    std::size_t all = 1;
    for (const auto& axis : axes)
        all *= axis.values;
    return all;
}

} // namespace

StressSweep::StressSweep(std::string name, std::vector<StressAxis> axes, Sampling sampling,
                         std::size_t points, std::int64_t steps, std::int64_t work)
    : name_(std::move(name)), axes_(std::move(axes)), sampling_(sampling), steps_(steps),
      work_(work) {
    switch (sampling_) {
    case Sampling::each:
        size_ = 1;
        for (const auto& axis : axes_)
            size_ += axis.values - 1;
        break;
    case Sampling::product:
        size_ = product_of(axes_);
        break;
    case Sampling::sobol:
        size_ = points;
        sobol_ = sobol_points(axes_, points);
        break;
    }
}

std::vector<std::size_t> StressSweep::values_of(std::size_t index) const {
    std::vector<std::size_t> values(axes_.size(), 0);
    switch (sampling_) {
    case Sampling::each:
        for (std::size_t k = 0; k < axes_.size() && index > 0; ++k) {
            values[k] = index < axes_[k].values ? index : 0;
            index -= std::min(index, axes_[k].values - 1);
        }
        break;
    case Sampling::product: // the last list goes through its values first
        for (std::size_t k = axes_.size(); k-- > 0; index /= axes_[k].values)
            values[k] = index % axes_[k].values;
        break;
    case Sampling::sobol:
        for (std::size_t k = 0; k < axes_.size(); ++k)
            values[k] = sobol_[index * axes_.size() + k];
        break;
    }
    return values;
}

StressParameters StressSweep::at(std::size_t index) const {
    StressParameters parameters;
    const auto values = values_of(index);
    for (std::size_t k = 0; k < axes_.size(); ++k)
        axes_[k].set(parameters, values[k]);
    parameters.steps = std::clamp<std::int64_t>(work_ / parameters.elements,
                                                std::min<std::int64_t>(2, steps_), steps_);
    parameters.seed = static_cast<unsigned>(index + 1);
    return parameters;
}

} // namespace tvbeam

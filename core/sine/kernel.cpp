#include "core/sine/kernel.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

using Index = std::int64_t;
using Lanes [[gnu::vector_size(64), gnu::may_alias]] = double;

/// One group of modes, in registers.
struct Modes {
    Lanes packs[packs_in_group] = {};

    Modes() = default;

    [[gnu::always_inline]] explicit Modes(const Pack* from) {
        for (Index v = 0; v < packs_in_group; ++v)
            packs[v] = *reinterpret_cast<const Lanes*>(from + v);
    }
    [[gnu::always_inline]] void store(Pack* to) const {
        for (Index v = 0; v < packs_in_group; ++v)
            *reinterpret_cast<Lanes*>(to + v) = packs[v];
    }
    [[gnu::always_inline]] Modes& operator+=(const Modes& other) {
        for (Index v = 0; v < packs_in_group; ++v)
            packs[v] += other.packs[v];
        return *this;
    }
    [[gnu::always_inline]] Modes& operator-=(const Modes& other) {
        for (Index v = 0; v < packs_in_group; ++v)
            packs[v] -= other.packs[v];
        return *this;
    }
    [[gnu::always_inline]] Modes& operator*=(const Modes& other) {
        for (Index v = 0; v < packs_in_group; ++v)
            packs[v] *= other.packs[v];
        return *this;
    }
    [[gnu::always_inline]] Modes& operator*=(double factor) {
        for (auto& pack : packs)
            pack *= factor;
        return *this;
    }
    [[gnu::always_inline]] friend Modes operator+(const Modes& left, const Modes& right) {
        Modes result = left;
        return result += right;
    }
    [[gnu::always_inline]] friend Modes operator-(const Modes& left, const Modes& right) {
        Modes result = left;
        return result -= right;
    }
    [[gnu::always_inline]] friend Modes operator*(const Modes& left, const Modes& right) {
        Modes result = left;
        return result *= right;
    }
    [[gnu::always_inline]] friend Modes operator*(double factor, const Modes& right) {
        Modes result = right;
        return result *= factor;
    }
    /// Adds the packs to one.
    [[gnu::always_inline]] void add_to(Pack& sum) const {
        Lanes total = packs[0];
        for (Index v = 1; v < packs_in_group; ++v)
            total += packs[v];
        *reinterpret_cast<Lanes*>(&sum) += total;
    }
};

/// value + Σ_j weights_j T_j over the columns first … last − 1.
[[gnu::always_inline]] inline Modes combined(const Modes& value, const SineBlock& block,
                                             const Pack* table, const double* weights,
                                             Index weight_stride, Index first, Index last) {
    Modes sum = value;
    for (Index j = first; j < last; ++j)
        sum += weights[j * weight_stride] * Modes(table + j * block.stride);
    return sum;
}

/// θ and a of one group with their increments.
template <Index increments>
struct State {
    static constexpr Index kept = increments > 0 ? increments : Index{1};
    Modes theta;
    Modes bend;
    Modes theta_increments[kept];
    Modes bend_increments[kept];
};

template <Index increments, bool coupled>
[[gnu::always_inline]] inline void load(State<increments>& state, const SineBlock& block,
                                        Index place) {
    const Pack* from = block.before + place;
    const auto next = [&] {
        const Modes modes(from);
        from += block.stride;
        return modes;
    };
    state.theta = next();
    if constexpr (coupled)
        state.bend = next();
    for (Index e = 0; e < increments; ++e) {
        state.theta_increments[e] = next();
        if constexpr (coupled)
            state.bend_increments[e] = next();
    }
}

template <Index increments, bool coupled>
[[gnu::always_inline]] inline void store(const State<increments>& state, const SineBlock& block,
                                         Index place) {
    Pack* to = block.after + place;
    const auto next = [&](const Modes& modes) {
        modes.store(to);
        to += block.stride;
    };
    next(state.theta);
    if constexpr (coupled)
        next(state.bend);
    for (Index e = 0; e < increments; ++e) {
        next(state.theta_increments[e]);
        if constexpr (coupled)
            next(state.bend_increments[e]);
    }
    state.theta.add_to(*block.sum);
}

/// Makes increment e the difference of (theta, bend) and the state at the step's begin.
template <Index increments, bool coupled>
[[gnu::always_inline]] inline void remember(State<increments>& state, Index e, const Modes& theta,
                                            const Modes& bend) {
    for (Index at = 0; at < increments; ++at)
        if (at == e) {
            state.theta_increments[at] = theta - state.theta;
            if constexpr (coupled)
                state.bend_increments[at] = bend - state.bend;
        }
}

/// What a group reads in every step.
struct Group {
    const Pack* table;
    Index columns;
    Modes stiffness;
    Modes inverse;
};

/// One solve: θ*, a* become θ, a.
template <bool coupled>
[[gnu::always_inline]] inline void solve(const SineBlock& block, const Group& group, Index at,
                                         Modes& theta, Modes& bend) {
    // The loads first: they wait for nothing, while the state of one step waits for that of the
    // step before.
    Modes rest = combined(Modes{}, block, group.table, block.loads + at, block.load_stride, 0,
                          group.columns);
    rest -= group.stiffness * theta;
    Modes balance;
    if constexpr (coupled) {
        balance = bend + block.alpha * theta;
        rest -= block.exchange * balance;
    }
    const Modes change = rest * group.inverse;
    theta += change;
    if constexpr (coupled) {
        bend -= block.kappa * (balance + block.alpha * change);
        if (block.tip != nullptr)
            (bend * Modes(group.table)).add_to(block.tip[at]);
    }
}

/// Adds the squares of the errors in the modes z of one group after a step.
[[gnu::always_inline]] inline void add_squares(std::span<const SineSquare> squares,
                                               const SineBlock& block, Index index, Index step,
                                               const Modes& z) {
    const Index place = index * packs_in_group;
    for (const SineSquare& square : squares) {
        const Modes error =
            combined(z, block, square.table + place, square.weights + step, square.weight_stride,
                     square.first_column, square.active_columns[index]);
        Modes weighted = error;
        if (square.factors != nullptr)
            weighted *= Modes(square.factors + place);
        (error * weighted).add_to(square.squares[step]);
        if (square.arm != nullptr)
            (error * Modes(square.arm + place)).add_to(square.moments[step]);
    }
}

template <Index increments, bool coupled>
[[gnu::always_inline]] inline void march_group(const SineBlock& block, Index index) {
    const Index place = index * packs_in_group;
    const Group group{block.table + place, block.active_columns[index],
                      Modes(block.stiffness + place), Modes(block.inverse + place)};
    State<increments> state;
    load<increments, coupled>(state, block, place);

    for (Index step = 0; step < block.steps; ++step) {
        Modes theta = state.theta;
        Modes bend = state.bend;
        for (Index stage = 0; stage < block.stages; ++stage) {
            if (increments > 0 && stage > 0) {
                theta = state.theta;
                bend = state.bend;
            }
            for (Index e = 0; e < increments; ++e) {
                const double weight = block.increment_weights[stage * increments + e];
                theta += weight * state.theta_increments[e];
                if constexpr (coupled)
                    bend += weight * state.bend_increments[e];
            }
            solve<coupled>(block, group, step * block.stages + stage, theta, bend);
            if (increments > 0 && stage + 1 < block.stages)
                remember<increments, coupled>(state, block.history + stage, theta, bend);
        }
        if (increments > 0 && block.history > 0) {
            for (Index e = increments - 1; e > 0; --e)
                if (e < block.history) {
                    state.theta_increments[e] = state.theta_increments[e - 1];
                    state.bend_increments[e] = state.bend_increments[e - 1];
                }
            remember<increments, coupled>(state, 0, theta, bend);
        }
        state.theta = theta;
        if constexpr (coupled)
            state.bend = bend;
        add_squares(block.of_temperature, block, index, step, theta);
        if constexpr (coupled)
            add_squares(block.of_curvature, block, index, step, bend);
    }
    if (block.after != nullptr)
        store<increments, coupled>(state, block, place);
}

template <Index increments, bool coupled>
[[gnu::always_inline]] inline void march_all(const SineBlock& block) {
    for (Index group = 0; group < block.groups; ++group)
        march_group<increments, coupled>(block, group);
}

/// While it lives, what is smaller than any normal number counts as zero: a mode that has decayed
/// so far would cost a hundred times what another does.
#ifdef __x86_64__
class FlushToZero {
public:
    FlushToZero() : before_(__builtin_ia32_stmxcsr()) {
        __builtin_ia32_ldmxcsr(before_ | flush_results | flush_operands);
    }
    ~FlushToZero() { __builtin_ia32_ldmxcsr(before_); }
    FlushToZero(const FlushToZero&) = delete;
    FlushToZero& operator=(const FlushToZero&) = delete;
    FlushToZero(FlushToZero&&) = delete;
    FlushToZero& operator=(FlushToZero&&) = delete;

private:
    static constexpr unsigned flush_results = 1U << 15U;
    static constexpr unsigned flush_operands = 1U << 6U;
    unsigned before_;
};
#else
struct FlushToZero {
    FlushToZero() {} // such modes cost time elsewhere, and are right
};
#endif

[[gnu::always_inline]] inline void march_with_these_units(const SineBlock& block) {
    switch (2 * block.increments + (block.coupled ? 1 : 0)) {
    case 0:
        return march_all<0, false>(block);
    case 1:
        return march_all<0, true>(block);
    case 2:
        return march_all<1, false>(block);
    case 3:
        return march_all<1, true>(block);
    case 4:
        return march_all<2, false>(block);
    default:
        return march_all<2, true>(block);
    }
}

// What is inlined is compiled for the units that the function is for. clang 14 cannot ask for
// levels.
#if defined(__x86_64__) && !defined(__clang__)
[[gnu::target("arch=x86-64-v4")]] void march_v4(const SineBlock& block) {
    march_with_these_units(block);
}
[[gnu::target("arch=x86-64-v3")]] void march_v3(const SineBlock& block) {
    march_with_these_units(block);
}
#endif
void march_anywhere(const SineBlock& block) {
    march_with_these_units(block);
}

} // namespace

std::span<const SineKernel> sine_kernels() {
    static const SineKernel kernels[] = {
#if defined(__x86_64__) && !defined(__clang__)
        {"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0, &march_v4},
        {"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0, &march_v3},
#endif
        {"any", true, &march_anywhere},
    };
    return kernels;
}

const SineKernel& chosen_sine_kernel() {
    static const SineKernel& chosen =
        *std::find_if(sine_kernels().begin(), sine_kernels().end(),
                      [](const SineKernel& kernel) { return kernel.runs_here; });
    return chosen;
}

void march(const SineBlock& block) {
    const FlushToZero flush;
    chosen_sine_kernel().march(block);
}

} // namespace tvbeam
